# SPDX-License-Identifier: Apache-2.0
"""Bakes on ground that is not flat: heights, slopes, speeds and feet against terrains of known shape."""
import csv
import json
import math

import numpy
import pytest

import terrain_files

TREADS, TREAD, RISE = 20, 0.3, 0.17


def ramp(x, _):
    """10 % up from x = 0 to 40, flat before and after."""
    return max(0.0, min(0.1 * x, 4.0))


@pytest.fixture(scope="module")
def walk(throng, tmp_path_factory):
    """walk(name, terrain file's bytes, from, to) is the bake of one person, and its streams while they are there."""
    folder = tmp_path_factory.mktemp("terrain")

    def bake(name, content, start, goal, *options, speed=1.3, **terrain):
        (folder / f"{name}.glb").write_bytes(content)
        person = {"position": start, "goal": goal, "speed": speed}
        (folder / f"{name}.json").write_text(json.dumps({
            "throng": 1, "simulation": {"duration": 60, "avoid_congestion": False},
            "terrain": {"file": f"{name}.glb", **terrain},
            "formations": [{"id": "one", "type": "agents", "agents": [person], "arrival": "leave"}]}))
        throng("bake", folder / f"{name}.json", "-o", folder / "bakes" / name, "-q", *options)
        streams = {stream: numpy.load(folder / "bakes" / name / "streams" / f"{stream}.npy")[:, 0]
                   for stream in ("pos", "dir", "state", "ground")}
        there = streams["state"][:, 0] > 0.5
        return folder / "bakes" / name, {stream: values[there].astype(float) for stream, values in streams.items()}

    return bake


def seconds(pos, start, end):
    """How long it takes from one x to another."""
    times = numpy.arange(len(pos)) / 24.0
    order = 1 if pos[-1, 0] > pos[0, 0] else -1
    at = lambda x: numpy.interp(order * x, order * pos[:, 0], times)
    return abs(at(end) - at(start))


@pytest.mark.quick
def test_a_ramp_is_stood_on_exactly_and_climbed_slowly(walk, throng):
    content = terrain_files.glb(*terrain_files.surface(ramp, (-20, -6), (60, 6), 4.0))
    bake, up = walk("up", content, [-10, 1.3], [50, -2.2], "--no-gltf")
    heights = numpy.array([ramp(x, y) for x, y, _ in up["pos"]])
    middle = (up["pos"][:, 0] > 1.5) & (up["pos"][:, 0] < 38.5)
    assert numpy.abs(up["pos"][:, 2] - heights)[middle].max() < 1e-3
    assert numpy.abs(up["pos"][:, 2] - heights).max() < 0.02, "rounded where the ramp begins and ends"
    assert numpy.abs(up["ground"][:, 2] - heights).max() < 1e-4
    slope = 0.1 * up["dir"][:, 0], -0.1 * up["dir"][:, 1]
    for column in (0, 1):
        assert numpy.abs(up["ground"][:, column] - slope[column])[middle].max() < 1e-3
    # Tobler's hiking function: exp(-3.5 x 0.1) uphill, exp(+3.5 x 0) at 10 % down, which is as far from 5 % down as
    # flat ground is.
    flat = 5.0 / seconds(up["pos"], -7.0, -2.0)
    assert 30.0 / seconds(up["pos"], 5.0, 35.0) / flat == pytest.approx(math.exp(-0.35), rel=0.01)
    _, down = walk("down", content, [50, 0], [-10, 0], "--no-gltf")
    assert 30.0 / seconds(down["pos"], 35.0, 5.0) / flat == pytest.approx(1.0, rel=0.01)
    throng("measure", bake)
    with open(bake / "agents.csv", newline="") as file:
        walked = float(next(csv.DictReader(file))["distance_walked"])
    assert numpy.hypot(*numpy.diff(up["pos"][:, :2], axis=0).T).sum() == pytest.approx(walked, abs=0.1), \
        "ways are measured in plan"


@pytest.mark.parametrize("name, start, goal, pace",
                         [("up", [-10, 0], [16, 0], 0.610), ("down", [16, 0], [-10, 0], 0.694)])
def test_stairs_are_climbed_at_the_pace_of_stairs_with_feet_on_the_treads(walk, name, start, goal, pace):
    content = terrain_files.glb(*terrain_files.stairs(TREADS, TREAD, RISE, 12, 4))
    _, seen = walk(f"stairs {name}", content, start, goal, "--no-gltf")
    x, z, slope, phase = seen["pos"][:, 0], seen["pos"][:, 2], seen["ground"][:, 0], seen["state"][:, 2]
    order = 1 if goal > start else -1
    took = seconds(seen["pos"], *((1.0, 5.0) if order > 0 else (5.0, 1.0)))
    assert 4.0 / took == pytest.approx(1.3 * pace / 1.34, rel=0.06), "Weidmann 1993"
    assert numpy.abs(numpy.diff(z)).max() < 0.05, "bodies go up and down without jerks"
    half_cycles = 2.0 * (phase - 0.28)
    errors = []
    for foot in range(math.floor(half_cycles[0]) + 1, math.floor(half_cycles[-1])):
        place = numpy.interp(foot, half_cycles, x)
        planted = (numpy.abs(half_cycles - foot) < 0.55) & (seen["dir"][:, 2] > 0.15)
        on = terrain_files.stair_height(place, TREADS, TREAD, RISE)
        errors += list(numpy.abs(z + slope * (place - x) * order - on)[planted])
    assert len(errors) > 400
    assert numpy.mean(errors) < 0.005 and numpy.percentile(errors, 95) < 0.02 and max(errors) < 0.07


def test_far_from_the_origin_it_is_the_same(walk, manifest_of):
    hill = lambda x, y: 2.0 * math.sin(0.1 * x) + 0.02 * y * y
    content = terrain_files.glb(*terrain_files.surface(hill, (-20, -8), (20, 8), 0.5))
    near_bake, near = walk("near", content, [-15, 3], [15, -3])
    far_bake, far = walk("far", content, [500_000 - 15, 4_200_003], [500_015, 4_200_000 - 3],
                         offset=[500_000, 4_200_000, 812.5])
    assert manifest_of(far_bake)["origin"][:2] == [500_000.0, 4_200_000.0]
    assert numpy.abs(near["pos"][:, :2] - far["pos"][:, :2]).max() < 1e-3, "people walk the same way"
    assert numpy.abs(near["pos"][:, 2] + 812.5 - far["pos"][:, 2]).max() < 1e-3
    assert numpy.abs(near["ground"][:, 2] - [hill(x, y) for x, y, _ in near["pos"]]).max() < 0.01
    assert numpy.abs(near["pos"][:, 2] - near["ground"][:, 2]).max() < 0.03


def test_a_bake_holds_its_terrain(walk, throng, manifest_of):
    content = terrain_files.glb(*terrain_files.surface(ramp, (-20, -6), (60, 6), 4.0))
    bake, seen = walk("held", content, [-10, 0], [12, 0], scale=1.0)
    manifest = manifest_of(bake)
    assert manifest["streams"]["ground"]["components"] == ["slope_along", "slope_across", "height"]
    assert manifest["terrain"]["source"] == "held.glb" and manifest["terrain"]["file"] == "terrain.glb"
    assert (manifest["terrain"]["lowest"], manifest["terrain"]["highest"]) == (0.0, pytest.approx(4.0))
    assert {"terrain.glb", "streams/ground.npy", "streams/ground.pc2"} <= {file["path"] for file in manifest["files"]}
    throng("info", bake, "--verify")
    pc2 = numpy.fromfile(bake / "streams" / "ground.pc2", "<f4", offset=32).reshape(-1, 3)
    assert numpy.array_equal(pc2, numpy.load(bake / "streams" / "ground.npy")[:, 0])
    for command in (["measure"], ["preview", "-o", bake.parent / "plate.png"],
                    ["report", "-o", bake.parent / "report.html"]):
        throng(command[0], bake, *command[1:])


def test_checkpoints_and_other_terrains_do_not_mix(walk, throng, tmp_path):
    """The terrain's content is among what a bake depends on."""
    flat = terrain_files.glb(*terrain_files.surface(lambda x, y: 0.0, (-20, -6), (60, 6), 4.0))
    sloped = terrain_files.glb(*terrain_files.surface(ramp, (-20, -6), (60, 6), 4.0))
    bakes = [walk("mixed", content, [-10, 0], [12, 0], "--no-gltf", "--force")[0] / "bake.json" for content in (flat,)]
    first = json.loads(bakes[0].read_text())["inputs"]
    second = json.loads((walk("mixed", sloped, [-10, 0], [12, 0], "--no-gltf",
                              "--force")[0] / "bake.json").read_text())["inputs"]
    assert first != second


@pytest.mark.parametrize("terrain, words", [
    ({"file": "absent.glb"}, ["3:22: error: /terrain/file:", "cannot open", "relative to the layout"]),
    ({"file": "hill.glb", "node": "lawn"}, ["3:42: error: /terrain/node:", "no node or mesh named `lawn`"]),
    ({"file": "hill.glb", "offset": [900, 0, 0]}, ["/terrain/file: no face of `hill.glb`", "x from 880.00 to 920.00",
                                                   "offset"]),
    ({"file": "junk.glb"}, ["/terrain/file:", "is not glTF"]),
    ({"file": ""}, ["/terrain/file: `file` is empty"])])
def test_terrains_that_cannot_be_used_are_told_where_they_are_named(throng, tmp_path, terrain, words):
    (tmp_path / "hill.glb").write_bytes(terrain_files.glb(*terrain_files.surface(ramp, (-20, -20), (20, 20), 4.0)))
    (tmp_path / "junk.glb").write_bytes(b"junk")
    layout = tmp_path / "layout.json"
    layout.write_text('{"throng": 1,\n'
                      ' "formations": [{"id": "f", "type": "circle", "centre": [0, 0], "radius": 5, "count": 9}],\n'
                      ' "terrain": ' +
                      json.dumps(terrain) + "}\n")
    for command in (["check", layout], ["bake", layout, "-o", tmp_path / "bake"]):
        refused = throng(*command, expect=3)
        for word in words:
            assert word in refused.stderr + refused.stdout, refused.stderr
    assert sorted(path.name for path in tmp_path.iterdir()) == ["hill.glb", "junk.glb", "layout.json"]


def test_overrides_set_people_on_the_ground_anew(throng, tmp_path, manifest_of):
    (tmp_path / "ramp.glb").write_bytes(terrain_files.glb(*terrain_files.surface(ramp, (-20, -9), (60, 9), 4.0)))
    agents = [{"position": [2, y], "goal": [30, y], "speed": 1.3} for y in (-3, 0, 3)]
    layout = {"throng": 1, "simulation": {"duration": 12}, "terrain": {"file": "ramp.glb"},
              "formations": [{"id": "three", "type": "agents", "agents": agents, "arrival": "leave"}]}
    (tmp_path / "ramp.json").write_text(json.dumps(layout))
    throng("bake", tmp_path / "ramp.json", "-o", tmp_path / "bake", "-q", "--no-gltf")
    entry = lambda row, y, **change: {"id": row, "group": "three", "spawn": {"frame": 0, "position": [2, y, 0.2]},
                                      **change}
    (tmp_path / "changes.json").write_text(json.dumps({"throng_overrides": 1, "overrides": [
        entry(0, -3, move={"by": [8, 0, 0]}), entry(1, 0, retime={"offset": 30, "speed": 1.2})]}))
    throng("apply", tmp_path / "bake", "--overrides", tmp_path / "changes.json", "-o", tmp_path / "changed", "--strict")
    before, after, slopes = (numpy.load(tmp_path / path / "streams" / f"{name}.npy")
                             for path, name in (("bake", "pos"), ("changed", "pos"), ("changed", "ground")))
    assert numpy.abs(after[:, 0, 0] - before[:, 0, 0] - 8.0).max() < 1e-4, "moved up the ramp"
    assert numpy.array_equal(after[:, 2], before[:, 2]), "untouched"
    assert numpy.abs(after[:, 1, 0] - before[:, 1, 0]).max() > 0.3, "comes at another time"
    for row in range(3):
        assert numpy.abs(after[:, row, 2] - 0.1 * after[:, row, 0]).max() < 1e-3, row
        assert numpy.abs(slopes[:, row, 0] - 0.1).max() < 2e-3
    throng("info", tmp_path / "changed", "--verify")
    assert manifest_of(tmp_path / "changed")["terrain"] == manifest_of(tmp_path / "bake")["terrain"]


def ridge(height):
    """A roof across the way from x = 10 to 30, that ends at y = -8 and 8."""
    def surface(x, y):
        return height * max(0.0, 1.0 - abs(x - 20.0) / 10.0) * min(max((8.0 - abs(y)) / 2.0, 0.0), 1.0)
    return surface


@pytest.mark.parametrize("extent", [50, 900], ids=["a small site", "a large one"])
def test_routes_lead_round_a_hill_where_that_is_quicker(throng, tmp_path, extent):
    """Over a roof of 60 % people would need four times as long as round its end; over one of 5 % they go straight. On
    a large site with walls, fields are worked out block by block."""
    walls = [{"id": "far", "points": [[extent, 40], [extent + 20, 40]]}]
    for name, height, settings, is_round in [("steep", 6.0, [], True), ("gentle", 0.5, [], False),
                                             ("unheeded", 6.0, ["--set", "motion.slope_pace.enabled=false"], False)]:
        (tmp_path / f"{name}.glb").write_bytes(
            terrain_files.glb(*terrain_files.surface(ridge(height), (-10, -30), (50, 30), 1.0)))
        (tmp_path / f"{name}.json").write_text(json.dumps({
            "throng": 1, "simulation": {"duration": 60, "avoid_congestion": False},
            "terrain": {"file": f"{name}.glb"}, "walls": walls,
            "areas": [{"id": "west", "polygon": [[-6, -1], [-4, -1], [-4, 1], [-6, 1]]},
                      {"id": "east", "polygon": [[44, -1], [46, -1], [46, 1], [44, 1]]}],
            "flows": [{"id": "f", "from": "west", "to": "east", "count": 3}],
            "formations": [{"id": "own", "type": "agents", "arrival": "leave", "agents": [
                {"position": [-5, 3], "goal": [45, -1]}, {"position": [-5, 5], "goal": [45.5, 1.2]}]}]}))
        throng("bake", tmp_path / f"{name}.json", "-o", tmp_path / name, "-q", "--no-gltf", *settings)
        pos = numpy.load(tmp_path / name / "streams" / "pos.npy")
        there = numpy.load(tmp_path / name / "streams" / "state.npy")[..., 0] > 0.5
        aside = numpy.abs(pos[..., 1])[there & (numpy.abs(pos[..., 0] - 20.0) < 2.0)]
        assert len(aside) > 10
        assert aside.min() > 7.0 if is_round else aside.max() < 4.5, (name, aside.min(), aside.max())
        with open(tmp_path / name / "agents.csv", newline="") as file:
            for row in csv.DictReader(file):
                # Ways are told in metres, whatever they cost.
                assert float(row["shortest_way"]) == pytest.approx(54.0 if is_round else 50.0, abs=3.0)


def test_a_bank_that_is_narrower_than_a_block_is_seen_on_a_large_site(throng, tmp_path):
    """A bank of 1 m in height and 1.5 m in width across the way, from y = -8 to 8: there is a way round it."""
    def bank(x, y):
        return min(max((x - 20.0) / 1.5, 0.0), 1.0) * min(max((8.0 - abs(y)) / 4.0, 0.0), 1.0)
    (tmp_path / "bank.glb").write_bytes(
        terrain_files.glb(*terrain_files.surface(bank, (-10, -30), (50, 30), 0.5)))
    found = {}
    for extent in (50, 900):
        (tmp_path / "bank.json").write_text(json.dumps({
            "throng": 1, "simulation": {"duration": 2, "avoid_congestion": False}, "terrain": {"file": "bank.glb"},
            "walls": [{"id": "far", "points": [[extent, 40], [extent + 20, 40]]}],
            "areas": [{"id": "west", "polygon": [[16, -1], [17, -1], [17, 1], [16, 1]]},
                      {"id": "east", "polygon": [[24, -1], [25, -1], [25, 1], [24, 1]]}],
            "flows": [{"id": "f", "from": "west", "to": "east", "count": 1, "end": 0.5}]}))
        throng("bake", tmp_path / "bank.json", "-o", tmp_path / "bake", "-q", "--no-gltf", "--force")
        with open(tmp_path / "bake" / "agents.csv", newline="") as file:
            found[extent] = float(next(csv.DictReader(file))["shortest_way"])
    assert found[900] == pytest.approx(found[50], abs=1.0), found
