# SPDX-License-Identifier: Apache-2.0
"""Who is in a pixel, solved from the sums that two passes hold: of known mixtures, without a Blender."""
import json
import subprocess
import sys

import numpy
import OpenEXR
import pytest

from conftest import ROOT

sys.path[:0] = [str(ROOT / "blender_addon" / "throng" / "formats"), str(ROOT / "scripts")]
from person_codes import person_codes, person_name  # noqa: E402
from person_mattes import murmur3  # noqa: E402
from person_solver import solve  # noqa: E402

PEOPLE = 16384
NAMES = [person_name("town", row) for row in range(PEOPLE)]


def mixtures(count, smallest, random):
    """(rows (P, count), their shares (P, count)) of 400 pixels."""
    rows = random.permuted(numpy.tile(numpy.arange(PEOPLE), (400, 1)), axis=1)[:, :count]
    shares = smallest + random.dirichlet(numpy.ones(count), 400) * (0.95 - count * smallest)
    return rows, shares


def passes(rows, shares):
    """What a render would hold: sums in single precision."""
    codes = numpy.array([sum(person_codes(name), ()) for name in NAMES], numpy.float32)
    return (codes[rows] * shares[..., None].astype(numpy.float32)).sum(axis=1, dtype=numpy.float32).astype(float)


@pytest.mark.parametrize("count, smallest", [(1, 0.01), (2, 0.03)])
def test_one_and_two_people_follow_from_the_pixel_alone(count, smallest):
    rows, shares = mixtures(count, smallest, numpy.random.default_rng(3))
    found, amounts, lost = solve(passes(rows, shares)[None], NAMES, 6)
    right = wrong = 0
    for who, much, solved, amount in zip(rows, shares, found[0], amounts[0]):
        told = {row: share for row, share in zip(solved, amount) if row >= 0}
        fits = set(told) == set(who) and all(abs(told[row] - share) < 0.01 for row, share in zip(who, much))
        right, wrong = right + fits, wrong + (len(told) == count and not fits)
    # whose x are too much alike take what is around them, of which there is nothing here
    assert right >= (396 if count == 1 else 385) and not wrong and lost < 16.0


@pytest.mark.parametrize("count", [3, 4])
def test_more_people_are_found_among_those_around(count):
    """Rows of pixels: somebody alone in each of `count`, then all of them in one."""
    rows, shares = mixtures(count, 0.08, numpy.random.default_rng(4))
    alone = [passes(rows[:, [i]], numpy.full((400, 1), 0.9)) for i in range(count)]
    nobody = numpy.zeros((400, 6))  # keeps strangers out of reach
    values = numpy.stack([*alone[:2], passes(rows, shares), *alone[2:]] + [nobody] * 5, axis=1)
    found, amounts, lost = solve(values.reshape(1, -1, 6), NAMES, 6)
    found, amounts = (each.reshape(400, -1, 6)[:, 2] for each in (found, amounts))
    right = sum(set(solved[solved >= 0]) == set(who) and abs(sorted(amount)[-1] - max(much)) < 0.01
                for who, much, solved, amount in zip(rows, shares, found, amounts))
    assert right >= 396 and lost < 4.0


def test_names_have_the_numbers_that_other_programs_give_them():
    assert (murmur3("hello"), murmur3("hello, world"), murmur3("The quick brown fox jumps over the lazy dog")) == \
        (0x248bfa47, 0x149bbb7f, 0x2e4ff723)


def run(*arguments):
    return subprocess.run([sys.executable, ROOT / "scripts" / "person_mattes.py", *map(str, arguments)],
                          capture_output=True, text=True)


def test_bad_input_is_told_and_nothing_is_written(tmp_path):
    bake, picture, out = tmp_path / "bake.json", tmp_path / "plain.exr", tmp_path / "out.exr"
    bake.write_text(json.dumps({"name": "town", "agents": 3}))
    pixels = {"Combined.R": OpenEXR.Channel(numpy.zeros((2, 2), numpy.float32))}
    with OpenEXR.File({"compression": OpenEXR.ZIP_COMPRESSION, "type": OpenEXR.scanlineimage}, pixels) as file:
        file.write(str(picture))
    (tmp_path / "text.exr").write_text("no picture")
    for arguments, told in (((picture, out, bake), "has no pass ThrongPersonA: render"),
                            ((tmp_path / "text.exr", out, bake), "text.exr: not an OpenEXR image"),
                            ((picture, out, tmp_path), "has no pass"),
                            ((picture, out, tmp_path / "nowhere"), "not a bake")):
        process = run(*arguments)
        assert process.returncode == 3 and told in process.stderr, process.stderr
        assert len(process.stderr.strip().splitlines()) == 1 and not out.exists()
