# SPDX-License-Identifier: Apache-2.0
"""`throng apply`: bakes with changes to single people, and the same people found again in other takes; the add-on's
reading of all that, too."""
import csv
import json
import shutil
import signal
import subprocess
import sys

import jsonschema
import numpy
import pytest

from conftest import ROOT
from processor_time import HANGS

sys.path.insert(0, str(ROOT / "blender_addon"))
from throng.formats import BakeError, load_bake  # noqa: E402
from throng.overrides import matching, override_file, rows as rows_module  # noqa: E402

STREET = {"throng": 1, "name": "street", "simulation": {"duration": 5, "seed": 7},
          "roads": [{"id": "road", "centreline": [[0, 0], [24, 0]], "width": 6}],
          "flows": [{"id": "f", "from": "road:start", "to": "road:end", "count": 30, "end": 4}],
          "formations": [{"id": "ring", "type": "circle", "centre": [10, 12], "radius": 4, "count": 7}]}
HIDDEN, MOVED, RETIMED, LOOKS, HERO = 3, 6, 7, 9, 33


def streams(bake, names=("pos", "dir", "state")):
    return {name: numpy.load(bake / "streams" / f"{name}.npy") for name in names}


def table(bake):
    with open(bake / "agents.csv", newline="") as file:
        return list(csv.DictReader(file))


def person(bake, row):
    """The fingerprint of somebody."""
    found = table(bake)[row]
    frame = int(found["spawn_frame"])
    position = streams(bake)["pos"][frame, row].astype(float) + json.loads((bake / "bake.json").read_text())["origin"]
    return {"id": row, "group": found["group"], "spawn": {"frame": frame, "position": position.tolist()}}


def write(path, entries):
    path.write_text(json.dumps({"throng_overrides": 1, "overrides": entries}, indent=1))
    return path


def entries_for(bake):
    return [{**person(bake, HIDDEN), "hide": True},
            {**person(bake, MOVED), "move": {"by": [1.5, -2.0, 0.25], "turn": 30}},
            {**person(bake, RETIMED), "retime": {"offset": -9.5, "speed": 1.3}, "move": {"by": [0, 1, 0]}},
            {**person(bake, LOOKS), "character": 5, "tint": [0.1, 0.2, 0.3], "scale": 1.2},
            {**person(bake, HERO), "hero": "Anna"}]


@pytest.fixture(scope="module")
def street(throng, once):
    def make(folder):
        (folder / "street.json").write_text(json.dumps(STREET))
        throng("bake", folder / "street.json", "-o", folder / "street", "-q", "--density", "--diagrams", "60")
        write(folder / "street.overrides.json", entries_for(folder / "street"))
        throng("apply", folder / "street", "-o", folder / "final", "-q")

    return once("street", make)


@pytest.mark.quick
def test_the_new_bake_is_whole_and_says_what_was_applied(throng, street, manifest_of):
    assert "verified" in throng("info", street / "final", "--verify").stdout
    before, after = manifest_of(street / "street"), manifest_of(street / "final")
    assert [entry["match"] for entry in after["applied"]["entries"]] == ["sure"] * 5
    assert after["applied"]["overrides"] == "street.overrides.json"
    assert after["account"]["refused"] == before["account"]["refused"] + 2 \
        and after["account"]["refused_reasons"]["hidden by an override"] == 1
    assert after["gltf"] and after["diagrams"] is None and not (street / "final" / "diagrams").exists()
    assert after["inputs"] != before["inputs"] and after["geometry"] == before["geometry"]
    assert (street / "final" / "layout.json").read_bytes() == (street / "street" / "layout.json").read_bytes()
    for name in ("pos", "dir", "state", "density"):
        npy = numpy.load(street / "final" / "streams" / f"{name}.npy")
        assert (street / "final" / "streams" / f"{name}.pc2").read_bytes()[32:] == npy.tobytes()
    rows = table(street / "final")
    assert (rows[LOOKS]["scale"], rows[LOOKS]["tint"], rows[LOOKS]["variation"]) == ("1.2", "0.1 0.2 0.3", "5")
    assert rows[HIDDEN]["outcome"] == rows[HERO]["outcome"] == "refused" and rows[0]["overrides"] == ""
    measured = json.loads(throng("measure", street / "final", "--json").stdout)
    assert measured["agents"] == 37 and measured["refused"] == 2


@pytest.mark.quick
def test_known_answers_frame_by_frame(street):
    before, after = streams(street / "street"), streams(street / "final")
    untouched = [row for row in range(37) if row not in (HIDDEN, MOVED, RETIMED, LOOKS, HERO)]
    for name in before:
        assert (before[name][:, untouched] == after[name][:, untouched]).all()
    assert (after["state"][:, [HIDDEN, HERO], 0] == 0).all() and (before["state"][:, HERO, 0] > 0.5).all()
    assert (after["pos"][:, [HIDDEN, HERO]] == before["pos"][:, [HIDDEN, HERO]]).all()
    assert (after["state"][:, LOOKS, 1] == 5).all()

    first = int(table(street / "street")[MOVED]["spawn_frame"])
    assert first > 0
    turn = numpy.exp(1j * numpy.radians(30.0))
    way = before["pos"][:, MOVED, 0] + 1j * before["pos"][:, MOVED, 1].astype(float)
    moved = (way - way[first]) * turn + way[first] + (1.5 - 2.0j)
    assert numpy.abs(after["pos"][:, MOVED, 0] + 1j * after["pos"][:, MOVED, 1] - moved).max() < 1e-5
    assert numpy.abs(after["pos"][:, MOVED, 2] - before["pos"][:, MOVED, 2] - 0.25).max() < 1e-6
    facing = (before["dir"][:, MOVED, 0] + 1j * before["dir"][:, MOVED, 1]) * turn
    assert numpy.abs(after["dir"][:, MOVED, 0] + 1j * after["dir"][:, MOVED, 1] - facing).max() < 1e-6

    first = int(table(street / "street")[RETIMED]["spawn_frame"])
    frames = len(before["pos"])
    at = first + (numpy.arange(frames) - first + 9.5) * 1.3
    inside = at.clip(0, frames - 1)
    for axis in range(3):
        expected = numpy.interp(inside, numpy.arange(frames), before["pos"][:, RETIMED, axis]) + (axis == 1)
        assert numpy.abs(after["pos"][:, RETIMED, axis] - expected).max() < 1e-5
    phase = numpy.interp(inside, numpy.arange(frames), before["state"][:, RETIMED, 2])
    assert numpy.abs(after["state"][:, RETIMED, 2] - phase).max() < 1e-5
    assert (after["state"][:, RETIMED, 0] == before["state"][numpy.floor(inside + 0.5).astype(int), RETIMED, 0]).all()
    heading = numpy.interp(inside, numpy.arange(frames),
                           numpy.unwrap(numpy.arctan2(before["dir"][:, RETIMED, 1], before["dir"][:, RETIMED, 0])))
    assert numpy.abs(numpy.exp(1j * heading) - (after["dir"][:, RETIMED, 0]
                                                + 1j * after["dir"][:, RETIMED, 1])).max() < 1e-5
    speed = numpy.interp(inside, numpy.arange(frames), before["dir"][:, RETIMED, 2]) * 1.3 * (at == inside)
    assert (at > frames - 1).any() and numpy.abs(after["dir"][:, RETIMED, 2] - speed).max() < 1e-5
    entered = numpy.nonzero(after["state"][:, RETIMED, 0] > 0.5)[0][0]
    assert int(table(street / "final")[RETIMED]["spawn_frame"]) == entered


@pytest.mark.quick
def test_the_add_on_works_out_the_same_rows(street):
    """The two implementations, in their two languages, from the same files."""
    bake = load_bake(str(street / "street"))
    expected = streams(street / "final")
    entries = override_file.read_beside(bake.folder)
    with rows_module.Rows(bake) as rows:
        people = rows_module.Table(bake, rows).people
        for entry, found in zip(entries, matching.match(entries, people)):
            assert found.kind == "sure" and found.row == entry["id"]
            change = override_file.change_of(entry)
            for frame in range(bake.frames):
                sample = rows.changed(found.row, people[found.row].frame, change, frame)
                for name, values in (("pos", sample.position), ("dir", sample.direction), ("state", sample.state)):
                    assert numpy.abs(expected[name][frame, found.row] - values).max() < 2e-6, (entry, frame, name)


MATCHING = json.loads((ROOT / "tests" / "shared" / "override_matching.json").read_text())["cases"]


@pytest.mark.parametrize("case", MATCHING, ids=lambda case: case["name"])
def test_matching_in_python_gives_the_known_answers(case):
    people = [matching.Entrant(group, frame, (x, y, z)) for group, frame, x, y, z in case["people"]]
    entries = [{"id": id, "group": group, "spawn": {"frame": frame, "position": [x, y, z]}} for id, group, frame, x, y,
               z in case["overrides"]]
    assert [[found.kind, found.row] for found in matching.match(entries, people)] == case["answers"]


def test_a_retake_with_another_seed_keeps_what_it_can_and_tells_the_rest(throng, street, tmp_path):
    throng("bake", street / "street.json", "-o", tmp_path / "take2", "-q", "--no-gltf", "--set", "simulation.seed=8")
    shutil.copy(street / "street.overrides.json", tmp_path / "take2.overrides.json")
    told = json.loads(throng("apply", tmp_path / "take2", "--dry-run", "--json").stdout)
    assert [entry["id"] for entry in told] == [HIDDEN, MOVED, RETIMED, LOOKS, HERO]
    assert told[-1]["match"] == "sure", "formations stand where they stood"
    assert {entry["match"] for entry in told[:-1]} <= {"sure", "nearest", "orphaned"} \
        and any(entry["match"] == "nearest" for entry in told)
    taken = [entry["row"] for entry in told if "row" in entry]
    assert len(set(taken)) == len(taken)
    for entry in told:
        if entry["match"] == "nearest":
            before, after = person(street / "street", entry["id"]), person(tmp_path / "take2", entry["row"])
            apart = numpy.linalg.norm(numpy.subtract(before["spawn"]["position"], after["spawn"]["position"]))
            assert before["group"] == after["group"] and apart == pytest.approx(entry["metres"], abs=1e-6) \
                and apart <= 3.0
            assert after["spawn"]["frame"] - before["spawn"]["frame"] == entry["frames"]
    bake = load_bake(str(tmp_path / "take2"))
    with rows_module.Rows(bake) as rows:
        people = rows_module.Table(bake, rows).people
    found = matching.match(override_file.read_beside(bake.folder), people)
    assert [(each.kind, each.row) for each in found] == [(entry["match"], entry.get("row")) for entry in told], \
        "the add-on finds the same"


def test_a_retake_with_fewer_people_reports_orphans_and_drops_nobody_silently(throng, street, tmp_path, manifest_of):
    throng("bake", street / "street.json", "-o", tmp_path / "take3", "-q", "--no-gltf", "--set", "flows.0.count=1",
           "--set", "flows.0.end=0.2")
    arguments = ("apply", tmp_path / "take3", "--overrides", street / "street.overrides.json")
    listing = throng(*arguments, "--dry-run").stdout
    assert listing.count("orphaned") == 3 and "nobody else of `f` enters within 3 m and 48 frames" in listing \
        and not (tmp_path / "out").exists()
    strict = throng(*arguments, "-o", tmp_path / "out", "--strict", "-q", expect=3)
    assert "3 of 5 overrides are orphaned" in strict.stderr and not (tmp_path / "out").exists()
    loose = throng(*arguments, "-o", tmp_path / "out", "-q")
    assert loose.stderr.count("is orphaned") == 3 and "street.overrides.json:" in loose.stderr \
        and "3 orphaned" in loose.stdout
    applied = manifest_of(tmp_path / "out")["applied"]["entries"]
    assert [entry["match"] for entry in applied].count("orphaned") == 3 \
        and all("reason" in entry for entry in applied if entry["match"] == "orphaned")
    assert "gltf" in manifest_of(tmp_path / "out") and not (tmp_path / "out" / "crowd.glb").exists(), \
        "as the bake has none"


def test_bakes_are_replaced_with_force_only_and_never_their_own_source(throng, street, tmp_path):
    out = tmp_path / "out"
    throng("apply", street / "street", "-o", out, "-q", "--gltf", "no")
    first = (out / "bake.json").read_bytes()
    assert "--force" in throng("apply", street / "street", "-o", out, "-q", expect=5).stderr
    assert (out / "bake.json").read_bytes() == first
    throng("apply", street / "street", "-o", out, "-q", "--force", "--gltf", "yes")
    assert (out / "crowd.glb").exists()
    assert "is the bake that is read" in throng("apply", street / "street", "-o", street / "street", "--force",
                                                expect=5).stderr
    assert "--dry-run" in throng("apply", street / "street", expect=2).stderr
    throng("apply", street / "street", "-o", tmp_path / "twin", "-q", "--gltf", "yes")
    assert (tmp_path / "twin" / "bake.json").read_bytes() == (out / "bake.json").read_bytes(), "the same bytes again"


def test_ctrl_c_leaves_nothing(throng, street, tmp_path):
    bake = tmp_path / "big"
    shutil.copytree(street / "street", bake)
    manifest = json.loads((bake / "bake.json").read_text())
    # Long enough to be stopped: all but the first frames are holes in the files.
    frames, people = 1_000_000, manifest["agents"]
    manifest["frames"] = frames
    del manifest["streams"]["density"]
    manifest["files"] = [file for file in manifest["files"] if not file["path"].startswith("streams/")]
    for name in manifest["streams"]:
        shape = f"{{'descr': '<f4', 'fortran_order': False, 'shape': ({frames}, {people}, 3), }}"
        head = b"\x93NUMPY\x01\x00" + (118).to_bytes(2, "little") + shape.encode().ljust(117) + b"\n"
        with open(bake / "streams" / f"{name}.npy", "r+b") as file:
            file.write(head)
            file.truncate(128 + frames * people * 12)
    (bake / "bake.json").write_text(json.dumps(manifest))
    write(tmp_path / "big.overrides.json", [])
    process = subprocess.Popen([throng.binary, "apply", str(bake), "-o", str(tmp_path / "out"), "--json"],
                               stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    while '"frame": ' not in process.stderr.readline():
        assert process.poll() is None
    process.send_signal(signal.SIGINT)
    _, told = process.communicate(timeout=HANGS)
    assert process.returncode == 130 and "nothing was written" in told
    assert sorted(path.name for path in tmp_path.iterdir()) == ["big", "big.overrides.json"]


GOOD = {"id": 3, "group": "f", "spawn": {"frame": 7, "position": [1, 2, 0]}, "hide": True}
DOCUMENTS = [({"overrides": [GOOD]}, True), ({"overrides": []}, True), ({"overrides": None}, False),
             ({"throng_overrides": 2, "overrides": []}, False),
             ({"overrides": [], "more": 1}, False), ({"overrides": [GOOD], "$schema": "x"}, True)] + \
    [({"overrides": [{**GOOD, **change}]}, valid) for change, valid in (
        ({"hide": 1}, False), ({"hide": False, "scale": 2}, True), ({"scale": 0.05}, False), ({"scale": "2"}, False),
        ({"tint": "#12345g"}, False),
        ({"tint": "#12345A"}, True), ({"tint": "#1234"}, False), ({"tint": [0, 1, 1.5]}, False),
        ({"tint": [0, 1, 0.5]}, True), ({"character": -1}, False),
        ({"character": 2}, True), ({"move": {"by": [0, 1]}}, False), ({"move": {"turn": 361}}, False),
        ({"move": {"to": [0, 0, 0]}}, False),
        ({"move": {"by": [0, 1, 2], "turn": -45.5}}, True), ({"retime": {"offset": 3.5}}, True),
        ({"retime": {"speed": 0}}, False), ({"retime": 3}, False),
        ({"hero": ""}, False), ({"hero": "Anna", "note": ""}, True), ({"note": 3}, False), ({"id": 1.5}, False),
        ({"id": -1}, False), ({"group": ""}, False),
        ({"id": 3.0, "character": 2.0}, True), ({"spawn": {"frame": 0}}, False),
        ({"spawn": {"frame": 0, "position": [0, 0]}}, False), ({"spawn": {"frame": 0.5, "position": [0, 0, 0]}}, False),
        ({"spawn": {"frame": 0, "position": [0, 0, 1e9]}}, False), ({"colour": "#000000"}, False))]


def test_the_schema_and_both_readers_agree(throng, street, tmp_path):
    schema = json.loads(throng("schema", "--overrides").stdout)
    jsonschema.Draft7Validator.check_schema(schema)
    wrong = []
    for document, valid in DOCUMENTS:
        path = tmp_path / "overrides.json"
        path.write_text(json.dumps({"throng_overrides": 1, **document}))
        by_schema = jsonschema.Draft7Validator(schema).is_valid(json.loads(path.read_text()))
        by_cli = throng("apply", street / "street", "--overrides", path, "--dry-run", expect=None).returncode == 0
        try:
            override_file.read(str(path))
            by_add_on = True
        except override_file.OverrideError as error:
            by_add_on = str(path) not in str(error)
        if (by_schema, by_cli, by_add_on) != (valid,) * 3:
            wrong.append((document, valid, by_schema, by_cli, by_add_on))
    assert not wrong


def test_damaged_files_are_told_with_their_place(throng, street, tmp_path):
    path = tmp_path / "bad.json"
    apply = lambda: throng("apply", street / "street", "--overrides", path, "-o", tmp_path / "out", expect=3).stderr
    path.write_text('{"throng_overrides": 1,\n "overrides": [\n'
                    '  {"id": 3, "group": "f", "spawn": {"frame": 0, "position": [0, 0, 0]}, "sclae": 2}]}')
    told = apply()
    assert f"{path}:3:73: error: /overrides/0/sclae" in told and "did you mean `scale`?" in told and "^" in told
    path.write_text('{"throng_overrides": 1,\n "overrides": [,]}')
    assert f"{path}:2:16: error: syntax error" in apply()
    with pytest.raises(override_file.OverrideError, match=r"bad.json:2:\d+: not JSON"):
        override_file.read(str(path))
    path.write_text(json.dumps({"throng_overrides": 1, "overrides": [GOOD, {**GOOD, "scale": 2}]}))
    assert "has an override in line 1 already" in apply()
    with pytest.raises(override_file.OverrideError, match="has an override already"):
        override_file.read(str(path))
    path.write_text("[" * 5000)
    apply()
    with pytest.raises(override_file.OverrideError):
        override_file.read(str(path))
    path.unlink()
    assert "bad.json" in apply() and not (tmp_path / "out").exists()
    shutil.copytree(street / "street", tmp_path / "street")
    write(path, [GOOD])
    agents = tmp_path / "street" / "agents.csv"
    for damage, words in ((lambda text: "\n".join(text.splitlines()[:-1]) + "\n", "36 people where bake.json has 37"),
                          (lambda text: text.replace(",flow,", ",", 1), "line 2 has 19 fields")):
        whole = agents.read_text()
        agents.write_text(damage(whole))
        assert words in throng("apply", tmp_path / "street", "--overrides", path, "-o", tmp_path / "out",
                               expect=3).stderr
        agents.write_text(whole)
    agents.write_text(agents.read_text().replace("spawn_frame", "spown_frame"))
    bake = load_bake(str(tmp_path / "street"))
    with rows_module.Rows(bake) as rows, pytest.raises(BakeError, match="agents.csv is not the table"):
        rows_module.Table(bake, rows)


def test_files_are_written_whole_or_not_at_all(tmp_path):
    path = tmp_path / "street.overrides.json"
    override_file.write(str(path), [GOOD])
    assert override_file.read(str(path)) == [GOOD] and json.loads(path.read_text())["throng_overrides"] == 1
    with pytest.raises(override_file.OverrideError, match="/overrides/0/scale"):
        override_file.write(str(path), [{**GOOD, "scale": 99}])
    assert override_file.read(str(path)) == [GOOD] and [p.name for p in tmp_path.iterdir()] == [path.name]
    with pytest.raises(override_file.OverrideError, match="cannot be written"):
        override_file.write(str(tmp_path / "absent" / "x.json"), [GOOD])
    path.write_text(json.dumps({"throng_overrides": 1, "overrides": [{**GOOD, "id": 3.0, "character": 2.0}]}))
    assert override_file.read(str(path))[0]["id"].bit_length() == 2, "whole, however it is written"
    assert override_file.path_beside("/shots/a/street/") == "/shots/a/street.overrides.json"
