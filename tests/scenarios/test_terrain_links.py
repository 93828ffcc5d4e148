# SPDX-License-Identifier: Apache-2.0
"""Stairs, ramps and escalators that a layout builds onto a terrain: they begin and end on its grounds."""
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
    return {"throng": 1, "simulation": {"duration": 90, "smoothing": 0}, "terrain": {"file": "ground.glb"},
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
    assert (way["forward"], way["back"]) == (20, 20)
    [made] = baked.manifest["links"]
    assert made["heights"] == pytest.approx([low, DECK], abs=0.01)
    on_stairs = baked.there & (baked.x > begin + 0.05) & (baked.x < -0.05) & (abs(baked.y) < 1)
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
