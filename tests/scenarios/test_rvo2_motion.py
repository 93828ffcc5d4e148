# SPDX-License-Identifier: Apache-2.0
"""The script that measures how people move in the reference library."""
import csv
import json
import os
import pathlib
import subprocess
import sys

import numpy
import pytest

SCRIPTS = pathlib.Path(__file__).resolve().parents[2] / "scripts"
sys.path.insert(0, str(SCRIPTS))
import rvo2_motion  # noqa: E402


def test_walls_become_slabs_and_outlines_that_turn_left():
    square = {"points": [[0, 0], [0, 4], [4, 4], [4, 0]], "closed": True, "thickness": 0.2}  # clockwise
    line = {"points": [[0, 0], [10, 0], [10, 5]], "closed": False, "thickness": 0.2}
    outlines = rvo2_motion.outline_of(square) + rvo2_motion.outline_of(line)
    assert len(outlines) == 3
    for outline, area in zip(outlines, (16.0, 2.0, 1.0)):
        corners = zip(outline, outline[1:] + outline[:1])
        assert sum((a.conjugate() * b).imag for a, b in corners) / 2.0 == pytest.approx(area)


def test_its_motion_is_measured_as_a_bake_is(tmp_path):
    command = [sys.executable, SCRIPTS / "rvo2_motion.py", os.environ["THRONG_BINARY"], "-o", tmp_path, "--scenario",
               "ring"]
    found = json.loads(subprocess.run([*command, "--seconds", "4"], check=True, capture_output=True,
                                      text=True).stdout.splitlines()[-1])
    assert found == {"scenario": "ring", "agents": 256, "arrived": 0, "deepest_overlap_percent": 0.0,
                     "overlapping_percent": 0.0, "wall_crossings": 0}
    pos = numpy.load(tmp_path / "ring" / "streams" / "pos.npy")
    assert pos.shape == (120, 256, 3)
    walked = numpy.hypot(*(pos[-1] - pos[0])[:, :2].T)
    assert (walked > 0.9 * 1.3 * 119 / 30).all() and (walked < 1.01 * 1.3 * 119 / 30).all(), \
        "everybody goes straight on at its speed until people meet"


def test_who_comes_to_its_goal_leaves_and_is_in_the_table(tmp_path):
    command = [sys.executable, SCRIPTS / "rvo2_motion.py", os.environ["THRONG_BINARY"], "-o", tmp_path, "--scenario",
               "corridor"]
    found = json.loads(subprocess.run([*command, "--seconds", "8"], check=True, capture_output=True,
                                      text=True).stdout.splitlines()[-1])
    with open(tmp_path / "corridor" / "agents.csv", newline="") as file:
        arrived = [int(row["arrival_frame"]) - 1 for row in csv.DictReader(file) if row["outcome"] == "arrived"]
    alive = numpy.load(tmp_path / "corridor" / "streams" / "state.npy")[..., 0]
    assert 0 < len(arrived) == found["arrived"] == 4096 - alive[-1].sum()
    assert sorted(arrived) == sorted(int(numpy.argmin(alive[:, row])) for row in numpy.nonzero(alive[-1] == 0.0)[0])
    assert found["wall_crossings"] == 0
