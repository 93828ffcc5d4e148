# SPDX-License-Identifier: Apache-2.0
"""`throng measure --follow`: people followed through the rules of motion, beside the bake that they are of."""
import collections
import csv
import json
import re
import shutil

import numpy
import pytest

from conftest import ROOT

HALL = {"throng": 1, "name": "hall", "simulation": {"duration": 16, "seed": 2},
        "areas": [{"id": "entry", "polygon": [[-8, -2], [-6, -2], [-6, 2], [-8, 2]]},
                  {"id": "exit", "polygon": [[8, -2], [10, -2], [10, 2], [8, 2]]}],
        "walls": [{"id": "gate", "points": [[2, -4], [2, 4]], "thickness": 0.2},
                  {"id": "north", "points": [[-9, 4], [11, 4]]}, {"id": "south", "points": [[-9, -4], [11, -4]]}],
        "events": [{"at": 12, "open": "gate"}],
        "flows": [{"id": "visitors", "from": "entry", "to": "exit", "rate": 1.5, "end": 4}]}


@pytest.fixture(scope="module")
def hall(throng, once):
    def make(folder):
        (folder / "hall.json").write_text(json.dumps(HALL))
        throng("bake", folder / "hall.json", "-o", folder / "bake", "-q", "--no-gltf")

    return once("followed-hall", make) / "bake"


@pytest.fixture(scope="module")
def followed(throng, hall, once):
    """Two people, their tables and the accounts."""
    def make(folder):
        told = throng("measure", hall, "--follow", 0, "--follow", 2, "--plots", folder / "why", "--json")
        (folder / "told.json").write_text(told.stdout)

    folder = once("followed", make)
    return folder / "why", json.loads((folder / "told.json").read_text())


def lines(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


def contents(folder):
    return {path.relative_to(folder): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


def test_they_go_where_the_bake_has_them(followed, hall, manifest_of):
    tables, told = followed
    manifest = manifest_of(hall)
    places = numpy.load(hall / "streams" / "pos.npy", mmap_mode="r")
    steps = [step for step in lines(tables / "follow-steps.csv") if int(step["step"]) % manifest["substeps"] == 0]
    assert len(steps) > 300 and {step["row"] for step in steps} == {"0", "2"}
    off = [numpy.hypot(*(places[int(step["step"]) // manifest["substeps"], int(step["row"]), :2] -
                         (float(step["x_m"]), float(step["y_m"])))) for step in steps]
    assert max(off) < 0.2  # recorded places are averaged over a quarter of a second
    assert told["furthest_off"] < 0.2


def test_the_closed_gate_is_what_holds_them_up(followed):
    tables, told = followed
    [first, other] = told["people"]
    assert (first["row"], other["row"]) == (0, 2)
    for person in (first, other):
        spell = person["longest_standstill"]
        assert person["standing_seconds"] > 0.5 and 10 < spell["from"] < 12 < spell["to"] < 12.2
        assert spell["place"][0] == pytest.approx(2 - 0.1 - 0.25, abs=0.1)  # a body's radius before the gate
        assert spell["causes"]["walls_ahead"] > 0.9 and sum(spell["causes"].values()) == pytest.approx(1, abs=1e-4)
        assert person["held_back"]["walls_ahead"] > 0.9
    gaps = {step["wall_gap_m"] for step in lines(tables / "follow-steps.csv")
            if step["row"] == "0" and 11.5 < float(step["time_s"]) < 12}
    assert gaps and max(map(float, gaps)) < 0.1


def test_what_rules_did_leads_from_one_velocity_to_the_next(followed):
    tables, _ = followed
    changes = collections.defaultdict(lambda: numpy.zeros(2))
    for line in lines(tables / "follow.csv"):
        if line["changed"] == "velocity":
            changes[line["row"], int(line["step"])] += [float(line["after_x"]) - float(line["before_x"]),
                                                        float(line["after_y"]) - float(line["before_y"])]
    velocity = {(step["row"], int(step["step"])): numpy.array([float(step["velocity_x_m_s"]),
                                                              float(step["velocity_y_m_s"])])
                for step in lines(tables / "follow-steps.csv")}
    off = [numpy.abs(now - velocity[row, step - 1] - changes[row, step]).max()
           for (row, step), now in velocity.items() if (row, step - 1) in velocity]
    assert len(off) > 600 and max(off) < 0.01


def test_the_docs_have_the_columns(followed):
    tables, _ = followed
    page = (ROOT / "docs" / "follow.md").read_text()
    told = re.findall(r"^\| ([a-z0-9_, ]+) \|", page.split("## Tables and plots")[1], re.M)
    documented = {name for cell in told for name in cell.split(", ")} - {"column"}
    written = {name for table in ("follow.csv", "follow-steps.csv") for name in lines(tables / table)[0]}
    assert written == documented


def test_each_has_a_plot(followed):
    tables, _ = followed
    for row in (0, 2):
        assert (tables / f"follow-{row}.png").read_bytes().startswith(b"\x89PNG")


def test_only_some_of_the_time_and_the_bake_stays_as_it_is(throng, hall, tmp_path):
    before = contents(hall)
    throng("measure", hall, "--follow", 0, "--from", 5, "--to", 6, "--plots", tmp_path)
    times = [float(step["time_s"]) for step in lines(tmp_path / "follow-steps.csv")]
    assert 5 < min(times) < 5.1 and 5.95 < max(times) < 6.05
    assert contents(hall) == before


def test_bakes_before_and_after_are_the_same(throng, hall, tmp_path):
    throng("measure", hall, "--follow", 1, "--to", 4)
    throng("bake", hall / "layout.json", "-o", tmp_path / "again", "-q", "--no-gltf")
    streams = contents(hall / "streams")
    assert streams and contents(tmp_path / "again" / "streams") == streams


@pytest.mark.parametrize("arguments, told", [
    (["--follow", 4096], "hall has rows 0 to "), (["--follow", -1], "-1"),
    (["--follow", 0, "--from", 5, "--to", 5], "5 s is not after 5 s"), (["--from", 2], "--follow")])
def test_what_cannot_be_asked(throng, hall, arguments, told):
    finished = throng("measure", hall, *arguments, expect=2)
    assert told in finished.stderr and finished.stderr.count("\n") <= 2


def test_who_is_not_there_is_named(throng, hall):
    assert "row 0 is not there" in throng("measure", hall, "--follow", 0, "--to", 0.02, expect=3).stderr


def test_a_bake_without_its_layout(throng, hall, tmp_path):
    bake = shutil.copytree(hall, tmp_path / "bare")
    (bake / "layout.json").unlink()
    assert "has no layout.json" in throng("measure", bake, "--follow", 0, expect=3).stderr
    shutil.copy(ROOT / "docs" / "examples" / "queue.json", bake / "layout.json")
    assert "it is not its layout" in throng("measure", bake, "--follow", 0, expect=3).stderr


def test_people_who_are_no_discs(throng, tmp_path):
    """Before a gate narrower than a chest is broad, shoulders turn; the tables tell which way chests point."""
    visitors = {**HALL["flows"][0], "people": {"body": {"breadth": 0.47, "depth": 0.25}}}
    jambs = [{"id": f"jamb {side}", "points": [[2, side * 0.2], [2, side * 4]], "thickness": 0.0} for side in (1, -1)]
    layout = {**HALL, "walls": HALL["walls"][1:] + jambs, "events": [], "flows": [visitors]}
    (tmp_path / "layout.json").write_text(json.dumps(layout))
    throng("bake", tmp_path / "layout.json", "-o", tmp_path / "bake", "--no-gltf", "-q")
    told = throng("measure", tmp_path / "bake", "--follow", 0, "--plots", tmp_path / "why", "--json")
    assert json.loads(told.stdout)["furthest_off"] < 0.2
    steps = lines(tmp_path / "why" / "follow-steps.csv")
    aside = {step["step"]: abs(float(step["chest_x"]) * float(step["facing_y"]) -
                               float(step["chest_y"]) * float(step["facing_x"])) for step in steps}
    before = [step for step in steps if -4 < float(step["x_m"]) < -1]
    within = [step for step in steps if abs(float(step["x_m"]) - 2) < 0.1]
    assert before and max(aside[step["step"]] for step in before) < 0.2
    assert within and min(aside[step["step"]] for step in within) > 0.4
    turns = [line for line in lines(tmp_path / "why" / "follow.csv") if line["changed"] == "chest"]
    assert "shoulders" in {line["rule"] for line in turns}
    places = numpy.load(tmp_path / "bake" / "streams" / "pos.npy")
    assert max(places[:, 0, 0]) > 4  # it has come through


STOREYS = {"throng": 1, "name": "storeys", "simulation": {"duration": 30, "seed": 2},
           "levels": [{"id": "hall", "floor": [[-20, -5], [0, -5], [0, 5], [-20, 5]]},
                      {"id": "gallery", "height": 3, "floor": [[0, -5], [10, -5], [10, 5], [0, 5]]}],
           "links": [{"id": "stairs", "from": "hall", "to": "gallery", "path": [[-6, 2.5], [0, 2.5]]},
                     {"id": "escalator", "type": "escalator", "from": "hall", "to": "gallery",
                      "path": [[-6, -2.5], [0, -2.5]]}],
           "areas": [{"id": "below", "polygon": [[-19, 1], [-15, 1], [-15, 4], [-19, 4]]},
                     {"id": "beside", "polygon": [[-12, -4], [-9, -4], [-9, -1], [-12, -1]]},
                     {"id": "above", "level": "gallery", "polygon": [[6, 1], [9, 1], [9, 4], [6, 4]]},
                     {"id": "yonder", "level": "gallery", "polygon": [[6, -4], [9, -4], [9, -1], [6, -1]]}],
           "flows": [{"id": "climb", "from": "below", "to": "above", "count": 4, "end": 2},
                     {"id": "ride", "from": "beside", "to": "yonder", "count": 4, "end": 2}]}


def test_people_are_followed_from_storey_to_storey(throng, tmp_path, manifest_of):
    """Where they are in the world, and no rule makes anybody fly where it walks over a seam or rides."""
    (tmp_path / "storeys.json").write_text(json.dumps(STOREYS))
    throng("bake", tmp_path / "storeys.json", "-o", tmp_path / "bake", "-q", "--no-gltf")
    with open(tmp_path / "bake" / "agents.csv", newline="") as file:
        groups = [row["group"] for row in csv.DictReader(file)]
    rows = {"climb": groups.index("climb"), "ride": groups.index("ride")}
    told = throng("measure", tmp_path / "bake", "--follow", rows["climb"], "--follow", rows["ride"], "--plots",
                  tmp_path / "why", "--json")
    assert json.loads(told.stdout)["furthest_off"] < 0.2 and "another device" not in told.stderr
    places = numpy.load(tmp_path / "bake" / "streams" / "pos.npy")
    substeps = manifest_of(tmp_path / "bake")["substeps"]
    for row in rows.values():
        steps = [step for step in lines(tmp_path / "why" / "follow-steps.csv")
                 if step["row"] == str(row) and int(step["step"]) % substeps == 0]
        heights = [places[int(step["step"]) // substeps, row, 2] for step in steps]
        assert min(heights) < 0.1 and max(heights) > 2.9
        assert {(float(step["goal_x_m"]) > 5, float(step["goal_y_m"]) * places[0, row, 1] >= 0)
                for step in steps} == {(True, True)}
    influences = [line for line in lines(tmp_path / "why" / "follow.csv") if line["changed"] == "velocity"]
    assert len(influences) > 100
    assert max(abs(float(line[key])) for line in influences for key in ("after_x", "after_y")) < 3  # m/s
    # On the escalator velocities are relative to it: it adds to nobody's, and nothing takes that away again.
    told_of = {(line["rule"], line["row"]) for line in influences
               if abs(float(line["after_x"]) - float(line["before_x"])) > 0.2}
    assert ("maximum_speed", str(rows["ride"])) not in told_of


def test_on_a_terrain_people_are_followed_over_the_ground_that_the_bake_has(throng, tmp_path):
    """Far from the origin, and without the file that the layout names."""
    given = tmp_path / "given"
    given.mkdir()
    layout = json.loads((ROOT / "examples" / "hill.json").read_text())
    for road in layout["roads"]:
        road["centreline"] = [[x + 40000, y - 2000] for x, y in road["centreline"]]
    del layout["$schema"]
    layout |= {"simulation": {"duration": 6, "warmup": 10, "seed": 11},
               "terrain": {"file": "hill.glb", "offset": [40000, -2000, 0]}}
    (given / "hill.json").write_text(json.dumps(layout))
    shutil.copy(ROOT / "examples" / "hill.glb", given)
    throng("bake", given / "hill.json", "-o", tmp_path / "bake", "-q", "--no-gltf")
    shutil.rmtree(given)
    told = json.loads(throng("measure", tmp_path / "bake", "--follow", 0, "--json").stdout)
    assert told["furthest_off"] < 0.2
