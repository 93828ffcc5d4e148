# SPDX-License-Identifier: Apache-2.0
"""Stairs, ramps and escalators that a layout builds onto a terrain: they begin and end on its grounds."""
import csv
import json
import math

import numpy
import pytest

import terrain_files

DECK, SLAB, PARAPET = 4.0, 0.3, 1.1  # m


class Mesh:
    """A street that may slope along x, and over it a deck with parapets; all of it turned."""

    def __init__(self, degrees=0.0, slope=0.0):
        self.positions, self.triangles = [], []
        self.turn, self.slope = math.radians(degrees), slope
        self.face(*((x, y, slope * x) for x, y in box(-30, -20, 30, 20)))
        self.box(0, -6, 16, 6, DECK - SLAB, DECK)

    def turned(self, x, y):
        cosine, sine = math.cos(self.turn), math.sin(self.turn)
        return [cosine * x - sine * y, sine * x + cosine * y]

    def face(self, *corners):
        first = len(self.positions)
        self.positions.extend((*self.turned(x, y), z) for x, y, z in corners)
        self.triangles.extend((first, first + k, first + k + 1) for k in range(1, len(corners) - 1))

    def box(self, x0, y0, x1, y1, bottom, top):
        corners = box(x0, y0, x1, y1)
        self.face(*((x, y, top) for x, y in corners))
        self.face(*((x, y, bottom) for x, y in reversed(corners)))
        for (ax, ay), (bx, by) in zip(corners, corners[1:] + corners[:1]):
            self.face((ax, ay, bottom), (bx, by, bottom), (bx, by, top), (ax, ay, top))

    def parapets(self):
        """All round the deck, on its edge."""
        for corners in ((0, -6, 0.1, 6), (15.9, -6, 16, 6), (0, -6, 16, -5.9), (0, 5.9, 16, 6)):
            self.box(*corners, DECK - 0.1, DECK + PARAPET)
        return self

    def outline(self, *corners):
        return [self.turned(x, y) for x, y in box(*corners)]

    def write(self, folder, layout):
        (folder / "ground.glb").write_bytes(terrain_files.glb(self.positions, self.triangles))
        (folder / "layout.json").write_text(json.dumps(layout))
        return folder / "layout.json"


def box(x0, y0, x1, y1):
    return [[x0, y0], [x1, y0], [x1, y1], [x0, y1]]


def link(mesh, path, **more):
    return {"id": "way", "from": "street", "to": "deck", "path": [mesh.turned(x, y) for x, y in path], "width": 2,
            **more}


def layout(mesh, links, flows=(), **members):
    street, deck = mesh.turned(-20, 10), mesh.turned(13, 3)
    return {"throng": 1, "simulation": {"duration": 140, "smoothing": 0}, "terrain": {"file": "ground.glb"},
            "levels": [{"id": "street", "at": [*street, -20 * mesh.slope]}, {"id": "deck", "at": [*deck, DECK]}],
            "links": list(links),
            "areas": [{"id": "west", "polygon": mesh.outline(-26, -4, -22, 4)},
                      {"id": "under", "polygon": mesh.outline(10, -4, 14, 4)},
                      {"id": "top", "level": "deck", "polygon": mesh.outline(11, -4, 15, 4)}],
            "flows": list(flows), **members}


UP = {"id": "up", "from": "west", "to": "top", "count": 20, "end": 10}
DOWN = {"id": "down", "from": "top", "to": "west", "count": 20, "end": 10}
UNDER = {"id": "under", "from": "west", "to": "under", "count": 10, "end": 10}


class Baked:
    def __init__(self, throng, folder, mesh, given):
        throng("bake", mesh.write(folder, given), "-o", folder / "bake", "-q", "--no-gltf")
        self.folder = folder / "bake"
        self.manifest = json.loads((self.folder / "bake.json").read_text())
        self.figures = json.loads(throng("measure", self.folder, "--json").stdout)
        self.places = self.stream("pos")
        self.there = self.stream("state")[..., 0] > 0
        self.ground = self.stream("ground")[..., 2]
        cosine, sine = math.cos(mesh.turn), math.sin(mesh.turn)
        x, y = self.places[..., 0], self.places[..., 1]
        self.x, self.y = cosine * x + sine * y, cosine * y - sine * x  # turned back

    def stream(self, name):
        return numpy.load(self.folder / "streams" / f"{name}.npy").astype(float)

    def of(self, group):
        """Which rows are of a group."""
        with open(self.folder / "agents.csv", newline="") as file:
            return numpy.array([person["group"] == group for person in csv.DictReader(file)])

    def fastest(self):
        """m a frame."""
        both = self.there[1:] & self.there[:-1]
        return numpy.linalg.norm(numpy.diff(self.places[..., :2], axis=0), axis=2)[both].max()


def treads(x, begin, end, low, high):
    """Heights of steps of about 0.17 m, the last of which is level with the upper ground."""
    count = round(abs(high - low) / 0.17)
    at = numpy.floor((x - begin) / (end - begin) * count) + 1
    return low + (high - low) * numpy.clip(at, 0, count) / count


@pytest.mark.parametrize("degrees", [0, 25])
@pytest.mark.parametrize("slope", [0, 0.03])
def test_stairs_lead_from_the_street_to_a_deck(throng, tmp_path, degrees, slope):
    """Through the deck's parapet, which opens: treads are as high as they are to a centimetre."""
    mesh = Mesh(degrees, slope).parapets()
    begin, low = -7, -7 * slope
    baked = Baked(throng, tmp_path, mesh, layout(mesh, [link(mesh, [[begin, 0], [0, 0]])], [UP, DOWN, UNDER]))
    assert (baked.figures["arrived"], baked.figures["wall_crossings"]) == (50, 0)
    assert baked.figures["deepest_overlap_percent"] < 2
    [way] = baked.figures["links"]
    assert way["forward"] == way["back"] >= 20  # some are pushed back in the middle
    [made] = baked.manifest["links"]
    assert made["heights"] == pytest.approx([low, DECK], abs=0.01)
    climbs = baked.there & ~baked.of("under")  # who walks on the street, maybe below the stairs
    on_stairs = climbs & (baked.x > begin + 0.05) & (baked.x < -0.05) & (abs(baked.y) < 1)
    run = -begin / round((DECK - low) / 0.17)
    inside = abs(((baked.x - begin) / run) % 1 - 0.5) < 0.45  # not on the very edge of a tread
    expected = treads(baked.x, begin, 0, low, DECK)
    assert (on_stairs & inside).sum() > 3000
    assert abs(baked.ground - expected)[on_stairs & inside].max() < 0.01
    above = baked.there & (baked.x > 0.2) & (baked.ground > 2)
    assert abs(baked.ground - DECK)[above].max() < 0.01
    street = baked.there & ~on_stairs & (baked.ground < 2) & (abs(baked.y) > 1.2)
    assert abs(baked.ground - slope * baked.x)[street].max() < 0.01
    assert baked.fastest() < 0.15


WAYS = {"through the deck": ([[3, 0], [10, 0]], {}), "ramp": ([[-18, 0], [0, 0]], {"type": "ramp"}),
        "escalator": ([[-8, 0], [0, 0]], {"type": "escalator"}),
        "half turn": ([[-1, -4.2], [-5, -4.2], [-5, 0], [0, 0]], {"width": 1.6}),
        "beside the deck": ([[9, 8.5], [2, 8.5], [2, 6]], {"width": 1.6})}


@pytest.mark.parametrize("degrees", [0, 40])
@pytest.mark.parametrize("name", WAYS)
def test_ways_of_all_kinds_lead_onto_a_deck(throng, tmp_path, name, degrees):
    """Where a way goes through the deck it is open; nobody falls into it, and nobody gets on but over its ends."""
    path, more = WAYS[name]
    mesh = Mesh(degrees).parapets()
    flows = [UP, UNDER] + ([] if name == "escalator" else [DOWN])
    baked = Baked(throng, tmp_path, mesh, layout(mesh, [link(mesh, path, **more)], flows))
    assert (baked.figures["arrived"], baked.figures["wall_crossings"]) == (sum(flow["count"] for flow in flows), 0)
    assert baked.figures["deepest_overlap_percent"] < 2
    passed = [(way["forward"] >= 20, way["forward"] - way["back"]) for way in baked.figures["links"]]
    assert passed == [(True, 20 if name == "escalator" else 0)] * len(baked.manifest["links"])
    assert baked.fastest() < 0.15
    [flight, *_], [*_, last] = baked.manifest["links"], baked.manifest["links"]
    assert [flight["heights"][0], last["heights"][1]] == pytest.approx([0, DECK], abs=0.01)
    deck = baked.there & (baked.ground > DECK - 0.01)
    low, high = numpy.array([baked.x[deck], baked.y[deck]]).min(1), numpy.array([baked.x[deck], baked.y[deck]]).max(1)
    assert (low > [-1, -6]).all() and (high < [16, 8.6]).all()
    if name != "through the deck":
        return
    opening = deck & (abs(baked.y) < 0.9) & (baked.x > 5) & (baked.x < 9.6)
    assert not opening.any()


def test_a_travelator_lies_in_its_ground(throng, tmp_path):
    mesh = Mesh()
    belt = {"id": "way", "type": "travelator", "from": "street", "to": "street", "path": [[-18, 0], [-6, 0]], "width": 1.2,
            "speed": 0.6, "walking": 1.0}
    areas = [{"id": "begin", "polygon": box(-24, -3, -21, 3)}, {"id": "end", "polygon": box(-4, -3, -1, 3)}]
    given = layout(mesh, [belt], [{"id": "on", "from": "begin", "to": "end", "count": 10, "end": 10}])
    given["areas"] = areas
    baked = Baked(throng, tmp_path, mesh, given)
    assert baked.figures["arrived"] == 10
    assert abs(baked.ground[baked.there]).max() < 0.01
    on_belt = baked.there & (baked.x > -16) & (baked.x < -8) & (abs(baked.y) < 0.5)
    steps = numpy.diff(baked.x, axis=0)[on_belt[1:] & on_belt[:-1]] * 24
    assert on_belt.sum() > 100 and numpy.median(steps) > 1.6  # m/s: a walk and the belt


STAIRS = {"path": [[-7, 0], [0, 0]]}


def walled(mesh, x):
    """A wall across the way at x, from the street to over the deck."""
    mesh.face((x, -3, 0), (x, 3, 0), (x, 3, 9), (x, -3, 9))


@pytest.mark.parametrize("change, message", [
    (lambda mesh, way, given: way.update(path=[[-9, 0], [-2, 0]]),
     "link `way` ends on no ground of level `deck` at [-2.00, 0.00]"),
    (lambda mesh, way, given: way.update(path=[[1, 0], [-6, 0]]),
     "link `way` ends on no ground of level `deck` at [-6.00, 0.00]"),
    (lambda mesh, way, given: way.update(path=[[40, 0], [33, 0]]),
     "link `way` begins on no ground of level `street` at [40.00, 0.00]"),
    (lambda mesh, way, given: way.update(path=[[-2, 0], [0, 0]]),
     "link `way` climbs 4.00 m over 2.00 m: stairs climb at most 120 %"),
    (lambda mesh, way, given: walled(mesh, -3), "link `way` is in a wall of the terrain at [-3.00,"),
    (lambda mesh, way, given: walled(mesh, 0.2), "link `way` is in a wall of the terrain at [0.20,"),
    (lambda mesh, way, given: given.update(walls=[{"id": "fence", "level": "deck", "points": [[0.3, -2], [0.3, 2]]}]),
     "link `way` ends in wall `fence` at level `deck`"),
    (lambda mesh, way, given: way.update(to="attic"), "there is no level `attic`"),
])
def test_mistakes_are_told_with_their_place(throng, tmp_path, change, message):
    mesh = Mesh().parapets()
    way = link(mesh, **STAIRS)
    given = layout(mesh, [way], [UP])
    change(mesh, way, given)
    path = mesh.write(tmp_path, given)
    told = throng("check", path, expect=3)
    errors = [line for line in told.stderr.splitlines() if ": error: " in line]
    assert message in errors[0] and all(error.startswith(f"{path}:1:") for error in errors)
    assert "hint: " in told.stderr


def test_where_there_is_no_headroom_nobody_gets_on(throng, tmp_path):
    """A ceiling 1.5 m over the end of the stairs: no ground on the deck there."""
    mesh = Mesh()
    mesh.box(0, -3, 3, 3, DECK + 1.5, DECK + 1.8)
    told = throng("check", mesh.write(tmp_path, layout(mesh, [link(mesh, **STAIRS)], [UP])), expect=3)
    assert "link `way` ends on no ground of level `deck`" in told.stderr


def test_a_flight_that_half_misses_its_ground_is_told(throng, tmp_path):
    mesh = Mesh().parapets()
    told = throng("check", mesh.write(tmp_path, layout(mesh, [link(mesh, [[-7, 5.9], [0, 5.9]])], [UP])))
    assert "warning: /links/0: link `way` meets level `deck` with" in told.stderr
