# SPDX-License-Identifier: Apache-2.0
"""People whose ways are given, on floors above each other and beside each other."""
import csv
import json

import numpy
import pytest

import terrain_files

RATE = 24


def box(x0, y0, x1, y1):
    return [[x0, y0], [x1, y0], [x1, y1], [x0, y1]]


FLOORS = [{"id": "ground", "floor": box(-12, -12, 12, 12)}, {"id": "deck", "height": 4.2, "floor": box(-11, -3, 11, 3)}]
OVER = [[1, -8, 0], [13, 8, 0]]
UNDER = [[1, 0, -8], [13, 0, 8]]


def walker(name, start, goal, level=None):
    """Groups of one, that who they are does not depend on who else there is."""
    told = {"id": name, "type": "agents", "arrival": "leave",
            "agents": [{"position": start, "goal": goal, "speed": 1.3, "radius": 0.25}]}
    return {**told, "level": level} if level else told


def given(name, *ways, level=None):
    told = {"id": name, "ways": list(ways), "people": {"radius": 0.25}}
    return {**told, "level": level} if level else told


def write(folder, told):
    folder.mkdir(exist_ok=True)
    simulation = {"duration": 14, "smoothing": 0}
    (folder / "layout.json").write_text(json.dumps({"throng": 1, "simulation": simulation, **told}))
    return folder / "layout.json"


def bake(throng, folder, told):
    """({name: places in each frame}, {name: whether it is there}), by the groups of one that people are."""
    throng("bake", write(folder, told), "-o", folder / "bake", "-q", "--no-gltf")
    pos, state = (numpy.load(folder / "bake" / "streams" / f"{name}.npy") for name in ("pos", "state"))
    with open(folder / "bake" / "agents.csv", newline="") as file:
        names = [row["group"] for row in csv.DictReader(file)]
    return ({name: pos[:, row] for row, name in enumerate(names)},
            {name: state[:, row, 0] > 0.5 for row, name in enumerate(names)})


def nearest(places, there, one, other):
    both = there[one] & there[other]
    return numpy.hypot(*(places[one] - places[other])[both, :2].T).min()


@pytest.mark.quick
def test_one_walks_over_another(throng, tmp_path):
    """At 7 s they are in one place of the plan. Who comes along on the deck makes room for who is given there, and who
    walks below does not know of it."""
    told = {"levels": FLOORS, "given": [given("over", OVER, level="deck"), given("under", UNDER)],
            "formations": [walker("on deck", [8, 0.05], [-7, 0.05], "deck"), walker("below", [8, 0.05], [-7, 0.05])]}
    places, there = bake(throng, tmp_path / "both", told)
    at = numpy.arange(len(places["over"])) / RATE
    for name, way, height in (("over", OVER, 4.2), ("under", UNDER, 0.0)):
        assert numpy.array_equal(there[name], (at >= 1) & (at <= 13))
        along = numpy.clip((at - 1) / 12, 0, 1)[:, None]
        expected = (1 - along) * numpy.array(way[0][1:]) + along * numpy.array(way[1][1:])
        assert numpy.abs(places[name][:, :2] - expected)[there[name]].max() < 1e-4
        assert numpy.abs(places[name][there[name], 2] - height).max() < 0.01
    assert nearest(places, there, "over", "under") < 0.05
    assert nearest(places, there, "on deck", "over") > 0.495
    figures = json.loads(throng("measure", tmp_path / "both" / "bake", "--json").stdout)
    assert figures["given"]["deepest_overlap_percent"] < 1 and figures["given"]["wall_crossings"] == 0
    assert figures["deepest_overlap_percent"] == 0 and figures["arrived"] == 2

    alone, _ = bake(throng, tmp_path / "below", {**told, "given": told["given"][1:]})
    assert numpy.array_equal(alone["below"], places["below"])
    assert not numpy.array_equal(alone["on deck"], places["on deck"])


SEAM = 1.3  # m: within a cell of the raster, more of which is east of it
WHOLE = {"all": [[-12, -12], [SEAM, -12], [12, -12], [12, 12], [SEAM, 12], [-12, 12]]}
HALVES = {"west": box(-12, -12, SEAM, 12), "east": box(SEAM, -12, 12, 12)}


def beside(floors):
    """One comes along the edge of a floor, in the way of who walks on the floor beside it."""
    west, east = list(floors)[0], list(floors)[-1]
    return {"levels": [{"id": name, "floor": floor} for name, floor in floors.items()],
            "given": [given("along", [[1, 1.29, -8], [7, 1.29, 0], [13, 0.4, 7]], level=west)],
            "formations": [walker("meets", [1.45, 8], [1.45, -9], east), walker("west", [1.0, 2], [1.0, -9], west)]}


@pytest.mark.quick
def test_nobody_notices_where_a_floor_ends(throng, tmp_path):
    places, there = bake(throng, tmp_path / "whole", beside(WHOLE))
    cut, there_cut = bake(throng, tmp_path / "cut", beside(HALVES))
    assert nearest(places, there, "meets", "along") < 0.8
    for name in places:
        assert numpy.array_equal(there[name], there_cut[name]), name
        assert numpy.abs(places[name] - cut[name])[there[name]].max() < 1e-4, name
    for name in ("meets", "west"):
        assert nearest(cut, there_cut, name, "along") > 0.495
    walked = []
    for folder in ("whole", "cut"):
        with open(tmp_path / folder / "bake" / "agents.csv", newline="") as file:
            walked.append([float(row["distance_walked"]) for row in csv.DictReader(file)])
    assert numpy.abs(numpy.subtract(*walked)).max() < 0.01 and max(map(max, walked)) < 25


@pytest.mark.quick
def test_files_have_levels_and_flat_ground_has_the_same_ways(throng, tmp_path):
    way = [(2 + 0.1 * i, -5 + 0.12 * i, float(numpy.sin(0.15 * i))) for i in range(80)]
    for name, levels in (("deck", {"levels": FLOORS}), ("flat", {})):
        (tmp_path / name).mkdir()
        rows = "".join(f"0,{t:.6f},{x:.6f},{y:.6f}\n" for t, x, y in way)
        (tmp_path / name / "seen.csv").write_text("id,time,x,y\n" + rows)
        told = {"id": "seen", "file": "seen.csv", "offset": [0.5, -0.25]}
        edge = given("edge", [[2, -11, 3], [10, 11, 3]])
        bake(throng, tmp_path / name, {
            **levels, "given": [{**each, "level": "deck"} if levels else each for each in (told, edge)]})
    deck, flat = (numpy.load(tmp_path / name / "bake" / "streams" / "pos.npy") for name in ("deck", "flat"))
    there = numpy.load(tmp_path / "deck" / "bake" / "streams" / "state.npy")[..., 0] > 0.5
    assert there.sum(0).min() > 150
    assert numpy.abs(deck - flat)[there, :2].max() < 1e-4
    assert numpy.abs(deck[there, 2] - 4.2).max() < 0.01 and not flat[there, 2].any()


CORNER = [[-9, -9], [9, -9], [9, 9], [0, 9], [0, 0], [-9, 0]]
STAIRS = {"levels": [{"id": "ground", "floor": box(-14, -5, 14, 5)},
                     {"id": "upper", "height": 3.4, "floor": box(-3, -5, 14, 5)}],
          "links": [{"id": "stairs", "from": "ground", "to": "upper", "path": [[-9, 2], [-3, 2]], "width": 2.4}]}
LIFT = {"id": "lift", "type": "lift", "at": [6, 4], "levels": ["ground", "deck"], "size": [2, 2], "doors": -90}
UP = [[1, -13, 2], [5, -9.5, 2.2], [11, -2.5, 1.8], [15, 6, 0.5]]


def along(way, at):
    """(frames, 2): where somebody is."""
    way = numpy.array([point[:3] for point in way], float)
    return numpy.stack([numpy.interp(at, way[:, 0], way[:, axis]) for axis in (1, 2)], 1)


@pytest.mark.parametrize("warmup", [0, 8])
@pytest.mark.quick
def test_ways_go_up_stairs_and_down(throng, tmp_path, warmup):
    """Also of somebody who is on the stairs already when all begins. Below, nobody knows of who is above."""
    down = [[time - (9 if warmup else 0), x, y] for time, (x, y) in
            zip((0, 8, 18), ((4, 1.4), (-3, 1.3), (-12, 1.0)))]
    told = {**STAIRS, "given": [given("up", UP), given("down", down, level="upper")],
            "formations": [walker("meets", [8, 0.55], [-2, 0.55], "upper"), walker("below", [8, 0.55], [2, 0.55])],
            "simulation": {"duration": 15, "smoothing": 0, "warmup": warmup}}
    places, there = bake(throng, tmp_path / "both", told)
    at = numpy.arange(len(places["up"])) / RATE
    for name, way in (("up", UP), ("down", down)):
        now = there[name]
        assert now.sum() > 120
        assert numpy.abs(places[name][:, :2] - along(way, at))[now].max() < 1e-4, name
        ideal = numpy.clip((places[name][:, 0] + 9) / 6, 0, 1) * 3.4
        assert numpy.abs(places[name][:, 2] - ideal)[now].max() < 0.35, name  # steps
    assert numpy.abs(places["up"][at < 4.9, 2]).max() < 0.01 and numpy.abs(places["up"][at > 12, 2] - 3.4).max() < 0.01
    if not warmup:
        assert nearest(places, there, "meets", "up") > 0.495
    alone, _ = bake(throng, tmp_path / "below", {**told, "given": []})
    assert numpy.array_equal(alone["below"], places["below"])
    figures = json.loads(throng("measure", tmp_path / "both" / "bake", "--json").stdout)
    assert figures["given"]["wall_crossings"] == 0 and figures["given"]["deepest_wall_penetration"] < 0.01


@pytest.mark.quick
def test_heights_say_where_a_way_begins(throng, tmp_path):
    """In place of levels; where they lie between two grounds the nearer one counts, up to a metre off."""
    ways = {"deck": [[1, -8, 0, 4.2], [13, 8, 0, 4.0]], "ground": [[1, -8, 0, -0.3], [13, 8, 0]],
            "nearly": [[1, -8, 1, 3.3], [13, 8, 1]]}
    told = {"levels": FLOORS, "given": [given(name, way) for name, way in ways.items()]}
    places, there = bake(throng, tmp_path / "heights", told)
    for name, height in (("deck", 4.2), ("ground", 0), ("nearly", 4.2)):
        assert numpy.abs(places[name][there[name], 2] - height).max() < 0.01, name
    told["given"] = [given("lost", [[1, -8, 0, 2.1], [13, 8, 0]])]
    said = throng("bake", write(tmp_path / "between", told), "-o", tmp_path / "bake", expect=3).stderr
    assert "person 0 tells a height of 2.1 m" in said and "at [-8, 0]" in said


@pytest.mark.quick
def test_escalators_carry_who_stands_on_them(throng, tmp_path):
    """Somebody given moves as the steps do, and so does who stands behind it."""
    escalator = {**STAIRS["links"][0], "type": "escalator", "width": 1.0, "speed": 0.5}
    way = [[1, -12, 2], [4, -9, 2], [16, -3, 2], [19, 3, 2]]
    told = {**STAIRS, "links": [escalator], "given": [given("rides", way)],
            "formations": [walker("follows", [-13.5, 2], [3, 2])], "simulation": {"duration": 22, "smoothing": 0}}
    places, there = bake(throng, tmp_path / "rides", told)
    at = numpy.arange(len(places["rides"])) / RATE
    assert numpy.abs(places["rides"][:, :2] - along(way, at))[there["rides"]].max() < 1e-4
    with open(tmp_path / "rides" / "bake" / "agents.csv", newline="") as file:
        walked = {row["group"]: float(row["distance_walked"]) for row in csv.DictReader(file)}
    assert walked["rides"] < 10  # not the 6 m of steps


@pytest.mark.parametrize("told, words", [
    ({"given": [given("hero", OVER, level="roof")]}, ["there is no level `roof`", "list it under `levels`"]),
    ({"levels": FLOORS, "given": [given("hero", OVER, level="dek")]}, ["there is no level `dek`", "`deck`"]),
    ({"levels": FLOORS, "given": [given("hero", OVER, UNDER, UNDER, level="deck")]},
     ["given `hero`: person 1 is beyond the floor of level `deck` at [0, -8], at 1 s, and 1 more of them likewise",
      "name the `level` on which it begins"]),
    ({"levels": [{"id": "corner", "floor": CORNER}], "given": [given("hero", [[0, -8, -1], [10, 1, 8]])]},
     ["person 0 is beyond the floor of level `corner` at [-6.9"]),
    ({**STAIRS, "given": [given("hero", [[0, -7, -4], [10, -7, 4.5]])]},
     ["person 0 is where stairs or lifts leave no room on level `ground` at [-7, 0.", "end it before that place"]),
    ({**STAIRS, "given": [given("hero", [[0, -13, 2], [5, -6, 2], [10, -6, 4.5]])]},
     ["person 0 is beyond the sides of link `stairs` at [-6, 3.", "name the `level` on which it begins"]),
    ({**STAIRS, "given": [given("hero", [[0, 2, 0, 1.7], [5, 3, 0]])]},
     ["person 0 tells a height of 1.7 m where its ground, level `ground`, is at 0 m, at [2, 0]", "within 1 m"]),
    ({**STAIRS, "given": [given("hero", [[0, 2, 0, 3.4], [5, 3, 0, 0.2]])]},
     ["person 0 tells a height of 0.2 m where its ground, level `upper`, is at 3.4 m, at [3, 0], at 5 s"]),
    ({"levels": FLOORS, "links": [LIFT], "given": [given("hero", [[0, 6, -8], [5, 6, 4.5]])]},
     ["person 0 is where stairs or lifts leave no room on level `ground` at [6, 3], at 4.4 s"]),
])
@pytest.mark.quick
def test_mistakes_with_levels_are_told(throng, tmp_path, told, words):
    said = throng("bake", write(tmp_path / "bad", told), "-o", tmp_path / "bake", expect=3).stderr
    assert "layout.json:1:" in said and said.count("error") == 1, said
    for each in words:
        assert each in said, said
    assert not (tmp_path / "bake").exists()


@pytest.mark.quick
def test_the_file_is_named_where_its_people_leave_the_floor(throng, tmp_path):
    told = {"levels": FLOORS, "given": [{"id": "seen", "level": "deck", "file": "seen.csv"}]}
    path = write(tmp_path / "bad", told)
    (path.parent / "seen.csv").write_text("id,time,x,y\n" + "".join(f"0,{t},1,{t}\n" for t in range(6)))
    said = throng("check", path, expect=3).stderr
    column = path.read_text().index('"seen.csv"') + 1
    assert f"layout.json:1:{column}:" in said and "beyond the floor of level `deck` at [1, 3." in said


def bridge():
    """A street 40 m long, a deck 5 m above it across, and a ramp that leads from the street up to it."""
    corners = [(-20, -20, 0), (20, -20, 0), (20, 20, 0), (-20, 20, 0),
               (-3, -20, 5), (3, -20, 5), (3, 2, 5), (-3, 2, 5), (3, 17, 0), (-3, 17, 0)]
    faces = [(0, 1, 2), (0, 2, 3), (4, 5, 6), (4, 6, 7), (7, 6, 8), (7, 8, 9)]
    return terrain_files.glb(corners, faces)


RAMP = [[0, 0, 19], [12, 0, 4], [24, 0.5, -15]]
STREET = [[0, -15, -10], [24, 15, -10]]


@pytest.mark.parametrize("levels", [True, False])
@pytest.mark.quick
def test_ways_run_over_terrain_above_and_below(throng, tmp_path, levels):
    """One goes up a ramp and along a bridge, another passes below it in the same place of the plan at the same time."""
    given_ways = [given("over", RAMP), given("under", STREET), given("starts above", [[0, 0, -3, 5], [10, 1, -12]])]
    told = {"terrain": {"file": "ground.glb"}, "given": given_ways, "simulation": {"duration": 24, "smoothing": 0},
            "formations": [walker("below", [10, -9.95], [-14, -9.95])]}
    if levels:
        told["levels"] = [{"id": "street", "at": [-15, -10, 0]}]
    for name in ("both", "without"):
        path = write(tmp_path / name, told)
        (path.parent / "ground.glb").write_bytes(bridge())
    places, there = bake(throng, tmp_path / "both", told)
    at = numpy.arange(len(places["over"])) / RATE
    for name, way in (("over", RAMP), ("under", STREET), ("starts above", given_ways[2]["ways"][0])):
        assert numpy.abs(places[name][:, :2] - along(way, at))[there[name]].max() < 1e-4, name
    y = places["over"][:, 1]
    assert numpy.abs(places["over"][:, 2] - numpy.clip((17 - y) / 3, 0, 5)).max() < 0.15
    assert numpy.abs(places["under"][:, 2]).max() < 0.05
    assert numpy.abs(places["starts above"][there["starts above"], 2] - 5).max() < 0.05
    told["given"] = [given_ways[1]]
    alone, _ = bake(throng, tmp_path / "without", told)
    assert numpy.array_equal(alone["below"], places["below"])
    assert nearest(places, there, "below", "under") > 0.495


@pytest.mark.parametrize("way, words", [
    ([[0, 0, 0, 5], [9, 9, 0]], "person 0 is beyond the ground of level"), ([[0, 30, 0], [9, 9, 0]], "at [30, 0]"),
    ([[0, 0, 0, 2.5], [9, 1, 0]], "tells a height of 2.5 m"),
])
@pytest.mark.quick
def test_mistakes_on_terrain_are_told(throng, tmp_path, way, words):
    told = {"terrain": {"file": "ground.glb"}, "levels": [{"id": "street", "at": [-15, -10, 0]}],
            "given": [given("hero", RAMP), given("lost", way)]}
    path = write(tmp_path / "bad", told)
    (path.parent / "ground.glb").write_bytes(bridge())
    said = throng("check", path, expect=3).stderr
    assert words in said and "given `lost`" in said and "layout.json:1:" in said
