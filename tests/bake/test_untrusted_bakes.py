# SPDX-License-Identifier: Apache-2.0
"""Bakes from anybody: whatever bake.json, the table and the streams say, the commands that read them end, and say what
is wrong."""
import json
import os
import shutil

import numpy
import pytest

from test_bakes import SMALL, write

READERS = (("info",), ("measure",), ("report", "-o", "r.html"), ("preview", "-o", "p.png"))


@pytest.fixture(scope="module")
def baked(throng, once):
    def make(folder):
        layout = {**SMALL, "simulation": {"duration": 0.5}, "walls": [{"points": [[0, 20], [30, 20]]}]}
        throng("bake", write(folder / "layout.json", layout), "-o", folder / "bake", "-q", "--no-gltf")

    return once("untrusted-bake", make) / "bake"


@pytest.fixture
def own(baked, tmp_path):
    shutil.copytree(baked, tmp_path / "bake")
    return tmp_path / "bake"


def changed(bake, **members):
    """members: "bounds__min": [0, 0] and so on."""
    manifest = json.loads((bake / "bake.json").read_text())
    for path, value in members.items():
        *way, last = [int(word) if word.isdigit() else word for word in path.split("__")]
        holder = manifest
        for word in way:
            holder = holder[word]
        if value is None:
            del holder[last]
        else:
            holder[last] = value
    (bake / "bake.json").write_text(json.dumps(manifest))


def all_read(confined, bake, expect, **options):
    """What they say; none leaves half a page or picture."""
    said = []
    for command, *words in READERS:
        finished = confined(command, bake, *words, cwd=bake.parent, expect=None, **options)
        assert finished.returncode in (0, 1, 3), (command, finished.returncode, finished.stderr)
        assert finished.returncode in expect, (command, finished.stdout, finished.stderr)
        assert finished.returncode == 0 or finished.stderr, command
        said.append(finished.stderr)
    return said


def nobody(bake, frames):
    """The same bake with these frames of no people."""
    for path in (bake / "streams").glob("*.npy"):
        numpy.save(path, numpy.zeros((frames, 0, 3), "<f4")) if frames < 1e6 else path.write_bytes(header(frames))
    head = (bake / "agents.csv").read_text().splitlines()[0]
    (bake / "agents.csv").write_text(head + "\n")
    changed(bake, frames=frames, agents=0)


def header(frames):
    text = f"{{'descr': '<f4', 'fortran_order': False, 'shape': ({frames}, 0, 3), }}".ljust(117) + "\n"
    return b"\x93NUMPY\x01\x00" + len(text).to_bytes(2, "little") + text.encode()


@pytest.mark.parametrize("members", [
    {"fps": 0}, {"fps": -24}, {"fps": 0.001}, {"fps": 1e-300}, {"fps": 1e300}, {"frames": 2**32 - 1}, {"frames": -1},
    {"bounds__max": [1e12, 1e12]}, {"bounds__max": [8589934591, 2147483647]}, {"bounds__min": [1e300, 1e300]},
    {"geometry__walls__0__points": []}, {"geometry__walls__0__points": [[0, 0]]},
    {"geometry__walls__0__points": [[0, 0], [1e12, 0]]}, {"geometry__walls__0__thickness": -1},
    {"geometry__walls__0__thickness": 1e300}, {"geometry__roads__0__width": "wide"}, {"origin": [0, 0, "up"]},
    {"terrain": []}, {"terrain": {"surface": 7}}, {"variations": "many"}, {"inputs": 5}, {"generator": []},
    {"account__refused_reasons": 3}, {"files__0__path": "../layout.json"}, {"name": None},
], ids=str)
def test_manifests_that_make_no_sense_are_told_with_the_member(confined, own, members):
    changed(own, **members)
    for said in all_read(confined, own, (3,)):
        assert "bake.json: `/" in said
    assert not [path for path in own.parent.iterdir() if path != own]


@pytest.mark.parametrize("members", [
    {"bounds__max": [2147483647, 2147483647]}, {"bounds__max": [4294967, 20]}, {"bounds__min": [-1e9, -1e9]},
    {"geometry__walls__0__points": [[-4e9, -4e9], [4e9, 4e9]]}, {"geometry__walls__0__thickness": 4e9},
    {"geometry__walls__0__gate": {"open_at_start": True, "toggles": [-1e300, 1e300]}},
    {"geometry__roads__0__width": 4e9}, {"device": {}}, {"origin": [4e9, -4e9, 0]},
], ids=str)
def test_manifests_of_any_size_are_read_in_little_memory_and_time(confined, own, members):
    changed(own, **members)
    all_read(confined, own, (0, 3), megabytes=500)


@pytest.mark.parametrize("text", ["[" * 100000, '{"a":' * 100000, "{" + ",".join(f'"{i}":0' for i in range(100000)) + "}",
                                  "", "null", '"\ud800"', "\x1b[31m", '"' + "endless " * 5000],
                         ids=("arrays", "objects", "keys", "empty", "null", "surrogate", "escape", "token"))
def test_what_is_no_manifest_is_told(confined, own, text):
    (own / "bake.json").write_bytes(text.encode("utf-8", "surrogatepass"))
    for said in all_read(confined, own, (3,)):
        assert "bake.json" in said and "\x1b" not in said and len(said) < 1500


def test_bakes_without_people_or_frames_are_read(confined, own):
    nobody(own, 2_000_000)
    changed(own, fps=240)
    all_read(confined, own, (0, 1))
    nobody(own, 0)
    for said in all_read(confined, own, (0, 3))[1:]:
        assert "no frames" in said


@pytest.mark.parametrize("value", [float("nan"), float("inf"), 3e38])
def test_streams_that_hold_no_numbers_are_told(confined, own, value):
    path = own / "streams" / "pos.npy"
    stream = numpy.load(path)
    stream[:] = value
    numpy.save(path, stream)
    for said in all_read(confined, own, (0, 3))[1:]:
        assert "pos.npy" in said


def test_people_who_jump_as_far_as_can_be_are_measured(confined, own):
    path = own / "streams" / "pos.npy"
    stream = numpy.load(path)
    stream[::2] = -4e9
    stream[1::2] = 4e9
    numpy.save(path, stream)
    all_read(confined, own, (0, 1))


@pytest.mark.parametrize("column, value", [("radius", "nan"), ("radius", "-1"), ("radius", "1e30"), ("goal_x", "inf"),
                                           ("preferred_speed", ""), ("radius", "\x1b[31m")])
def test_tables_that_make_no_sense_are_told_with_the_line(confined, own, column, value):
    lines = (own / "agents.csv").read_text().splitlines()
    fields = lines[1].split(",")
    fields[lines[0].split(",").index(column)] = value
    (own / "agents.csv").write_text("\n".join([lines[0], ",".join(fields), *lines[2:]]) + "\n")
    for said in all_read(confined, own, (0, 3))[1:]:
        assert "agents.csv: line 2" in said and "\x1b" not in said


def test_no_control_characters_of_a_bake_reach_the_terminal(throng, own):
    changed(own, name="a\x1b[31m\x9b\u202eb", device__renderer="c\x07\rd")
    told = throng("info", own).stdout
    assert "a\\x1b[31m\\x9b\\u202eb" in told and "c\\x07\\x0dd" in told
    assert not any(letter in told for letter in "\x1b\x9b\u202e\x07\r")


# ---- nothing outside is read

@pytest.mark.parametrize("name", ["agents.csv", "layout.json", "streams/pos.npy", "streams/pos.pc2"])
def test_apply_takes_nothing_that_a_link_leads_to_outside(throng, own, tmp_path, name):
    shutil.move(own / name, tmp_path / "secret")
    os.symlink(tmp_path / "secret", own / name)
    write(tmp_path / "o.json", {"throng_overrides": 1, "overrides": []})
    said = throng("apply", own, "--overrides", tmp_path / "o.json", "-o", tmp_path / "new", expect=3).stderr
    assert name in said and "leads out of the folder" in said
    assert not (tmp_path / "new").exists() and not list(tmp_path.glob("new.tmp-*"))


def test_apply_takes_what_a_link_leads_to_inside(throng, own, tmp_path):
    shutil.move(own / "layout.json", own / "first.json")
    os.symlink("first.json", own / "layout.json")
    write(tmp_path / "o.json", {"throng_overrides": 1, "overrides": []})
    throng("apply", own, "--overrides", tmp_path / "o.json", "-o", tmp_path / "new", "--gltf", "no", "-q")
    assert (tmp_path / "new" / "layout.json").read_bytes() == (own / "first.json").read_bytes()


@pytest.mark.parametrize("command", [("check",), ("bake", "-q", "-o", "out"), ("batch", "-q", "-o", "out")])
def test_pipes_and_devices_are_no_files(throng, tmp_path, command):
    os.mkfifo(tmp_path / "pipe.json")
    for path in ("pipe.json", "/dev/zero"):
        assert "not a regular file" in throng(*command, path, cwd=tmp_path, expect=3, timeout=60).stderr


def test_shaders_and_measurements_of_devices_are_files_too(throng, tmp_path):
    layout = write(tmp_path / "layout.json", SMALL)
    shutil.copytree(os.path.join(os.path.dirname(__file__), "..", "..", "shaders"), tmp_path / "shaders")
    victim = tmp_path / "shaders" / "shared" / "walls.glsl"
    victim.unlink()
    os.mkfifo(victim)
    said = throng("bake", layout, "-o", tmp_path / "out", "-q", "--shader-dir", tmp_path / "shaders", expect=3,
                  timeout=60).stderr
    assert "not a regular file" in said and not (tmp_path / "out").exists()


def test_nothing_is_left_of_a_page_or_picture_that_cannot_be_written(throng, own):
    for command, name in ("report", "r.html"), ("preview", "p.png"):
        (own.parent / name / "taken").mkdir(parents=True)
        assert name in throng(command, own, "-o", name, cwd=own.parent, expect=5).stderr
    assert sorted(path.name for path in own.parent.iterdir()) == ["bake", "p.png", "r.html"]
