# SPDX-License-Identifier: Apache-2.0
"""Terrains with faces above each other: people walk on and under them, and nobody notices where they are cut."""
import json
import math

import numpy
import pytest

import terrain_files


class Mesh:
    def __init__(self):
        self.positions, self.triangles = [], []

    def face(self, *corners):
        first = len(self.positions)
        self.positions.extend(corners)
        self.triangles.extend((first, first + k, first + k + 1) for k in range(1, len(corners) - 1))

    def flat(self, x0, y0, x1, y1, z):
        self.ramp(x0, y0, x1, y1, z, z)

    def ramp(self, x0, y0, x1, y1, low, high):
        """Rises along x."""
        self.face((x0, y0, low), (x1, y0, high), (x1, y1, high), (x0, y1, low))


def box(x0, y0, x1, y1):
    return [[x0, y0], [x1, y0], [x1, y1], [x0, y1]]


def bridge(height=4.0):
    """A plain, and 4 m wide over it a plate with a ramp at either end."""
    mesh = Mesh()
    mesh.flat(-40, -15, 40, 15, 0)
    mesh.ramp(-30, -2, -10, 2, 0, height)
    mesh.flat(-10, -2, 10, 2, height)
    mesh.ramp(10, -2, 30, 2, height, 0)
    return mesh


def bridge_height(x, height=4.0):
    return height * numpy.clip((30 - numpy.abs(x)) / 20, 0, 1)


LEVELS = [{"id": "street", "at": [0, 10, 0]}, {"id": "deck", "at": [0, 0, 4]}]
AREAS = [{"id": "west", "polygon": box(-38, -3, -34, 3)}, {"id": "east", "polygon": box(34, -3, 38, 3)},
         {"id": "north", "polygon": box(-3, 10, 3, 14)}, {"id": "south", "polygon": box(-3, -14, 3, -10)},
         {"id": "top", "level": "deck", "polygon": box(-4, -1.8, 4, 1.8)},
         {"id": "below", "polygon": box(-4, -1.8, 4, 1.8)}]


def layout(levels=LEVELS, **members):
    return {"throng": 1, "simulation": {"duration": 120}, "terrain": {"file": "ground.glb"}, "levels": levels,
            "areas": AREAS, **members}


def write(folder, mesh, given):
    (folder / "ground.glb").write_bytes(terrain_files.glb(mesh.positions, mesh.triangles))
    (folder / "layout.json").write_text(json.dumps(given))
    return folder / "layout.json"


def bake(throng, folder, mesh, given, *options):
    throng("bake", write(folder, mesh, given), "-o", folder / "bake", "-q", "--no-gltf", *options)
    return folder / "bake"


def stream(folder, name):
    return numpy.load(folder / "streams" / f"{name}.npy").astype(float)


def measured(throng, folder):
    return json.loads(throng("measure", folder, "--json").stdout)


def test_people_walk_on_a_bridge_and_under_it(throng, tmp_path):
    """Over the bridge by its deck, and between its ends the other way below it, each to the level that is named."""
    flows = [{"id": "over", "from": "west", "to": "east", "via": ["top"], "count": 30, "end": 15},
             {"id": "up", "from": "east", "to": "top", "count": 20, "end": 15},
             {"id": "under", "from": "north", "to": "south", "count": 30, "end": 15},
             {"id": "hidden", "from": "south", "to": "below", "count": 5, "end": 2, "arrival": "stay"}]
    folder = bake(throng, tmp_path, bridge(), layout(flows=flows))
    figures = measured(throng, folder)
    assert (figures["arrived"], figures["wall_crossings"]) == (85, 0)
    assert figures["deepest_overlap_percent"] < 2
    places, there = stream(folder, "pos"), stream(folder, "state")[..., 0] > 0
    x, y, heights = places[..., 0], places[..., 1], stream(folder, "ground")[..., 2]
    on_bridge = there & (heights > 0.05)
    assert abs(heights - bridge_height(x))[on_bridge].max() < 0.01
    assert abs(y)[on_bridge & (heights > 0.25)].max() < 2 - 0.15  # nobody falls; lower edges are stepped off
    assert abs(heights)[there & ~on_bridge].max() < 0.05
    hidden = slice(80, 85)
    assert (heights[-1, hidden] == 0).all() and there[-1, hidden].all()
    flat = there & (abs(abs(x) - 10) > 1) & (abs(abs(x) - 30) > 2)
    # Places are told to a centimetre, as are heights; bodies stand where their feet are, and who turns on a slope has one
    # above the other.
    off = abs(places[..., 2] - numpy.where(on_bridge, bridge_height(x), 0))
    beside_a_drop = on_bridge & (abs(y) > 1.2)  # who turns there has a foot where the smooth ground bends down
    assert off[flat & ~beside_a_drop].max() < 0.015 and off[flat].max() < 0.13
    steps = numpy.linalg.norm(numpy.diff(places, axis=0), axis=2)[there[1:] & there[:-1]]
    assert steps.max() < 0.2  # m a frame: nobody jumps
    above = sum((numpy.linalg.norm(up[:, None, :2] - down[None, :, :2], axis=2) < 0.5).any()
                for up, down in ((frame[alive & (frame[:, 2] > 3.9)], frame[alive & (frame[:, 2] < 0.1)])
                                 for frame, alive in zip(places, there)) if len(up) and len(down))
    assert above > 20


def test_who_walks_down_a_ramp_keeps_its_line(throng, tmp_path):
    """The edge of a ramp is no stairs: nobody walks along it because it is cheap."""
    given = layout(flows=[{"id": "down", "from": "top", "to": "east", "count": 1, "end": 1}])
    given["areas"] = [{"id": "top", "level": "deck", "polygon": box(-1, -0.1, 1, 0.1)},
                      {"id": "east", "polygon": box(37, -0.1, 38, 0.1)}]
    folder = bake(throng, tmp_path, bridge(), given)
    assert measured(throng, folder)["arrived"] == 1
    y = stream(folder, "pos")[stream(folder, "state")[..., 0] > 0][:, 1]
    assert len(y) > 24 * 20 and abs(y).max() < 0.3


def test_without_names_everything_is_on_the_lowest_ground(throng, tmp_path):
    flows = [{"id": "in", "from": "north", "to": "top", "count": 3, "end": 1, "arrival": "stay"}]
    given = layout(levels=[], flows=flows)
    given["areas"] = [{key: value for key, value in area.items() if key != "level"} for area in AREAS]
    given["areas"].append({"id": "ramp", "polygon": box(-20, -1, -16, 1)})
    folder = bake(throng, tmp_path, bridge(), given)
    assert abs(stream(folder, "pos")[..., 2]).max() < 0.01
    manifest = json.loads((folder / "bake.json").read_text())
    assert [level["id"] for level in manifest["levels"]] == ["surface-1", "surface-2"]


def test_one_surface_is_as_it_was(throng, tmp_path):
    """Whoever says which surface people walk on gets that one, uncut."""
    flows = [{"id": "in", "from": "west", "to": "north", "count": 3, "end": 1}]
    given = layout(flows=flows)
    del given["levels"]
    given["areas"] = AREAS[:4]
    given["terrain"]["surface"] = "lowest"
    manifest = json.loads((bake(throng, tmp_path, bridge(), given) / "bake.json").read_text())
    assert "levels" not in manifest and manifest["terrain"]["surface"] == "lowest"


TURNS, RADIUS, HALF, PER_TURN = 2, 8.0, 1.5, 3.2


def spiral():
    """Up round a middle, two turns and 6.4 m, from a plain to a plate outside."""
    mesh, pieces = Mesh(), 48
    mesh.flat(-20, -20, 20, 20, 0)

    def at(k, radius):
        angle = 2 * math.pi * k / pieces
        return radius * math.cos(angle), radius * math.sin(angle), PER_TURN * k / pieces
    for k in range(TURNS * pieces):
        mesh.face(at(k, RADIUS - HALF), at(k, RADIUS + HALF), at(k + 1, RADIUS + HALF), at(k + 1, RADIUS - HALF))
    mesh.flat(RADIUS - HALF, 0, RADIUS + HALF, 8, TURNS * PER_TURN)
    return mesh


def test_a_ramp_may_wind_over_itself(throng, tmp_path):
    given = {"throng": 1, "simulation": {"duration": 220}, "terrain": {"file": "ground.glb"},
             "levels": [{"id": "plain", "at": [-15, 0, 0]}, {"id": "top", "at": [8, 5, TURNS * PER_TURN]}],
             "areas": [{"id": "foot", "polygon": box(12, -8, 16, -4)},
                       {"id": "head", "level": "top", "polygon": box(7, 5, 9, 7.5)}],
             "flows": [{"id": "up", "from": "foot", "to": "head", "count": 12, "end": 10},
                       {"id": "down", "from": "head", "to": "foot", "count": 12, "end": 10}]}
    folder = bake(throng, tmp_path, spiral(), given)
    figures = measured(throng, folder)
    assert (figures["arrived"], figures["wall_crossings"]) == (24, 0)
    places, there = stream(folder, "pos"), stream(folder, "state")[..., 0] > 0
    heights, radius = stream(folder, "ground")[..., 2], numpy.hypot(places[..., 0], places[..., 1])
    on_ramp = there & (heights > 0.25) & (heights < TURNS * PER_TURN - 0.1)  # m: lower edges are stepped off
    assert (abs(radius - RADIUS)[on_ramp]).max() < HALF
    turn = numpy.mod(numpy.arctan2(places[..., 1], places[..., 0]) / (2 * math.pi), 1)
    over = numpy.mod(heights / PER_TURN - turn + 0.5, 1) - 0.5
    assert abs(over * PER_TURN)[on_ramp].max() < 0.02  # chords are a little below the arc of the middle


FAR = box(-28, -28, -25, 28)


@pytest.mark.parametrize("outline", [box(-28, -28, -3.8, 28), [(-28, -28), (28, -28), (28, 4.1), (-28, -14.3)]])
def test_nobody_notices_where_a_flat_ground_is_cut(throng, once, tmp_path, outline):
    """A plate 5 m up, which a plate below it cuts near where that one ends: among people, and far from them."""
    random = numpy.random.default_rng(4)
    kept = []
    for point in random.uniform(-9, 9, (300, 2)):
        if all(numpy.hypot(*(point - other)) > 0.7 for other in kept):
            kept.append(point)
    gates = {"w": box(-11.5, -2, -10.5, 2), "e": box(10.5, -2, 11.5, 2), "s": box(-2, -11.5, 0.3, -10.5),
             "n": box(-2, 10.5, 0.3, 11.5)}
    given = {"throng": 1, "simulation": {"duration": 5, "smoothing": 0, "avoid_congestion": False},
             "terrain": {"file": "ground.glb"}, "levels": [{"id": "deck", "at": [11, 11, 5]}],
             "areas": [{"id": name, "polygon": polygon} for name, polygon in gates.items()],
             "formations": [{"id": f"p{i}", "type": "grid", "origin": [round(float(x), 3), round(float(y), 3)],
                             "rows": 1, "columns": 1, "goal": "wesn"[i % 4], "arrival": "leave"}
                            for i, (x, y) in enumerate(kept)]}

    def plates(below):
        mesh = Mesh()
        mesh.flat(-26, -26, 26, 26, 5)
        mesh.ramp(26, -26, 50, -22, 5, 0)  # the way down, so that the lower one is walked on
        mesh.flat(50, -26, 54, -22, 0)
        mesh.flat(-28, -32, 54, -28, 0)
        mesh.flat(50, -28, 54, -26, 0)
        mesh.face(*((x, y, 0) for x, y in below))
        return mesh
    whole = once("uncut plate", lambda folder: bake(throng, folder, plates(FAR), given)) / "bake"
    parts = bake(throng, tmp_path, plates(outline), given)
    grounds = json.loads(throng("check", tmp_path / "layout.json", "--json").stdout)[0]["grounds"]
    assert len(grounds) == 2 and min(ground["area"] for ground in grounds) > 150
    there = stream(whole, "state")[..., 0] > 0
    assert (there == (stream(parts, "state")[..., 0] > 0)).all() and there.sum() > 10_000
    apart = numpy.linalg.norm(stream(whole, "pos")[..., :2] - stream(parts, "pos")[..., :2], axis=2)
    assert apart[there].max() < 1e-3


def passage(floor, over=None):
    """A floor along x from -10 to 10, 6 m wide, and over its middle perhaps a beam."""
    mesh = Mesh()
    for x0, x1, z in floor:
        mesh.flat(x0, -3, x1, 3, z)
    if over:
        mesh.flat(-1, -3, 1, 3, over + 0.3)
        mesh.face((-1, 3, over), (1, 3, over), (1, -3, over), (-1, -3, over))
    return mesh


PASSAGES = {
    "headroom of 2.1 m": (passage([(-10, 10, 0)], 2.1), True),
    "headroom of 1.8 m": (passage([(-10, 10, 0)], 1.8), False),
    "a step of 0.2 m": (passage([(-10, 0, 0), (0, 10, 0.2)]), True),
    "a step of 0.3 m": (passage([(-10, 0, 0), (0, 10, 0.3)]), False),
    "a slope of 40 degrees": (passage([(-10, 0, 0)]), True), "a slope of 50 degrees": (passage([(-10, 0, 0)]), False)}


@pytest.mark.parametrize("name", PASSAGES)
def test_what_can_be_walked_on(throng, tmp_path, name):
    mesh, passes = PASSAGES[name]
    top = 0.0
    if "slope" in name:
        top = math.tan(math.radians(40 if passes else 50))
        mesh = passage([(-10, 0, 0), (1, 10, top)])
        mesh.ramp(0, -3, 1, 3, 0, top)
    given = {"throng": 1, "simulation": {"duration": 30}, "terrain": {"file": "ground.glb"},
             "levels": [{"id": "floor", "at": [-8, 0, 0]}],
             "areas": [{"id": "a", "polygon": box(-9, -2, -7, 2)}, {"id": "b", "polygon": box(7, -2, 9, 2)}],
             "flows": [{"id": "through", "from": "a", "to": "b", "count": 4, "end": 2}]}
    if not passes:
        failed = throng("check", write(tmp_path, mesh, given), expect=None)
        assert failed.returncode == 3 and "through" in failed.stderr
        return
    folder = bake(throng, tmp_path, mesh, given)
    figures = measured(throng, folder)
    assert (figures["arrived"], figures["wall_crossings"]) == (4, 0)


def test_check_tells_what_it_found(throng, tmp_path):
    mesh = bridge()
    mesh.flat(20, 8, 24, 12, 6)  # a roof
    flows = [{"id": "up", "from": "west", "to": "top", "count": 3, "end": 1}]
    told = throng("check", write(tmp_path, mesh, layout(flows=flows))).stdout
    assert "2 grounds" in told and "street: " in told and "deck: " in told
    assert "joined to street" in told and "joined to deck" in told
    assert "nobody gets to 16.0 m^2" in told


@pytest.mark.parametrize("change, message", [
    ({"levels": [{"id": "deck", "at": [0, 0, 2]}]}, "level `deck`: nobody can stand at [0.00, 0.00, 2.00]"),
    ({"levels": [{"id": "deck", "at": [90, 0, 2]}]}, "there is no ground there with 2 m of headroom"),
    ({"levels": [{"id": "deck", "floor": box(0, 0, 1, 1)}]}, "no floors of its own"),
    ({"levels": [{"id": "deck"}]}, "`at` is missing"),
    ({"terrain": {"file": "ground.glb", "surface": "highest"}}, "has no levels"),
    ({"areas": [{"id": "off", "polygon": box(60, 0, 62, 2)}]}, "area `off`: there is no ground of the terrain"),
])
def test_mistakes_are_told(throng, tmp_path, change, message):
    failed = throng("check", write(tmp_path, bridge(), {**layout(), **change}), expect=None)
    assert failed.returncode == 3 and message in failed.stderr
    assert "layout.json:1:" in failed.stderr


def test_a_level_at_a_place_needs_a_terrain(throng, tmp_path):
    (tmp_path / "layout.json").write_text(json.dumps({"throng": 1, "levels": [{"id": "deck", "at": [0, 0, 2]}]}))
    failed = throng("check", tmp_path / "layout.json", expect=None)
    assert failed.returncode == 3 and "level `deck` has no `floor`" in failed.stderr


def test_the_bridge_of_the_examples_is_walked_over_and_under(throng, bakes):
    """Everybody arrives, also those who watch from the deck, and at one moment some are right above others."""
    folder = bakes("bridge-terrain")
    figures = measured(throng, folder)
    assert (figures["arrived"], figures["agents"], figures["wall_crossings"]) == (518, 518, 0)
    assert figures["deepest_overlap_percent"] < 2
    places, there = stream(folder, "pos"), stream(folder, "state")[..., 0] > 0

    def is_above_another(frame):
        deck, street = (places[frame, there[frame] & those, :2]
                        for those in (places[frame, :, 2] > 5.1, places[frame, :, 2] < 0.2))
        return (numpy.linalg.norm(deck[:, None] - street[None], axis=2) < 0.5).any()

    assert any(is_above_another(frame) for frame in range(600, 1200, 50))


def test_what_is_wider_than_its_ground_does_nothing_on_others(throng, tmp_path):
    """An area round everything is on the lowest ground alone, and so is slow ground; the deck is beside it in the
    plane."""
    def over(folder, patches):
        folder.mkdir()
        areas = [*AREAS, {"id": "all", "level": "street", "polygon": box(-90, -90, 90, 90)}]
        flows = [{"id": "down", "from": "top", "to": "east", "count": 10, "end": 5},
                 {"id": "many", "from": "all", "to": "north", "count": 100, "end": 1}]
        given = layout(areas=areas, flows=flows, patches=patches, simulation={"duration": 25})
        baked = bake(throng, folder, bridge(), given)
        there, speeds = stream(baked, "state")[..., 0] > 0.5, stream(baked, "dir")[..., 2]
        up = there & (stream(baked, "ground")[..., 2] > 3.9)
        assert not up[24, 10:].any(), "nobody comes into being on the deck"
        return speeds[:, :10][up[:, :10]].mean()
    alone = over(tmp_path / "alone", [])
    slow = {"id": "slow", "level": "street", "polygon": box(-90, -90, 90, 90), "pace": 0.3}
    assert over(tmp_path / "slow", [slow]) > 0.9 * alone
