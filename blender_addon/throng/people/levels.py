# SPDX-License-Identifier: Apache-2.0
"""How finely people are made at each level of detail, and the triangles of the base mesh at each."""
from dataclasses import dataclass
from functools import lru_cache

import numpy

NEAR = -2   # for pictures from a few metres and for single people
CLOSE = -1  # for people of a crowd within some metres of the camera (crowd/near.py); all others take 0, 1 and 2
_THIN = 0.08  # of a triangle: its height over its longest edge


@dataclass(frozen=True)
class Detail:
    """How many vertices stay of each, of a whole body; of clothes, how often triangles are cut in four after that."""
    head: int
    hands: int
    skin: int       # the rest of the body
    cloth: int      # of a suit from neck to toes
    skirt: int
    finer: int      # times
    locks: float    # of hair, beside the full number
    pieces: float   # of each lock, the same
    hairs: float    # of beards, the same
    eyes: int       # rings, 0 for none
    trimmed: bool   # pockets, lapels, collars with folds, brows


DETAILS = {
    NEAR: Detail(99999, 99999, 99999, 99999, 99999, 1, 1.0, 1.0, 1.0, 8, True),
    CLOSE: Detail(2000, 700, 800, 1200, 420, 1, 0.33, 0.6, 0.5, 5, True),
    0: Detail(400, 100, 250, 520, 160, 0, 0.045, 0.5, 0.0, 2, True),
    1: Detail(120, 40, 92, 225, 70, 0, 0.018, 0.5, 0.0, 1, False),
    2: Detail(32, 14, 24, 58, 28, 0, 0.0, 0.5, 0.0, 0, False),
}


def _regions(bodies, vertices):
    """Of the body's vertices: 0 head, 1 hands, 2 the rest."""
    strongest = numpy.array(bodies.bones)[bodies.weights[vertices].argmax(axis=1)]
    head = numpy.isin(strongest, ("head", "neck_01"))
    hands = (numpy.char.find(strongest, "_0") > 0) & (numpy.char.find(strongest, "spine") < 0) & ~head
    hands |= numpy.char.startswith(strongest, "hand_")
    return numpy.select([head, hands], [0, 1], 2)


def coarser(triangles, gone, into, chosen):
    """Triangles after the chosen merges."""
    into_ = numpy.arange(int(max(triangles.max(), gone.max(initial=0), into.max(initial=0))) + 1)
    for one, other in zip(gone[chosen][::-1], into[chosen][::-1]):
        into_[one] = into_[other]
    triangles = into_[triangles]
    a, b, c = triangles.T
    triangles = triangles[(a != b) & (b != c) & (c != a)]
    _, first = numpy.unique(numpy.sort(triangles, axis=1), axis=0, return_index=True)
    return triangles[numpy.sort(first)]


def _lie_as(points, one, others):
    """Whether triangles face where one does, more or less."""
    normals = [numpy.cross(points[b] - points[a], points[c] - points[a]) for a, b, c in (one[::-1], *others)]
    return all(normal @ normals[0] > 0.7 * numpy.linalg.norm(normal) * numpy.linalg.norm(normals[0])
               for normal in normals[1:])


def without_slivers(points, triangles):
    """Triangles without those whose corners are nearly on a line: a face that moves turns them over, and they darken
    what is around them. The longest edge of each goes, and its neighbour's other corner gets one instead."""
    triangles = triangles.copy()
    for _ in range(3):
        corners = points[triangles]
        edges = numpy.linalg.norm(corners[:, [1, 2, 0]] - corners, axis=2)
        area = numpy.linalg.norm(numpy.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
        slivers = numpy.flatnonzero(area < _THIN * edges.max(axis=1) ** 2)
        if not len(slivers):
            break
        whose = {(a, b): number for number, (one, two, three) in enumerate(triangles.tolist())
                 for a, b in ((one, two), (two, three), (three, one))}
        done = set()
        for sliver in slivers.tolist():
            a, b, c = numpy.roll(triangles[sliver], -int(edges[sliver].argmax())).tolist()
            other = whose.get((b, a))
            if other is None or {sliver, other} & done:
                continue
            d = next(corner for corner in triangles[other].tolist() if corner not in (a, b))
            if (c, d) in whose or (d, c) in whose or not _lie_as(points, (a, b, d), ((a, d, c), (d, b, c))):
                continue
            triangles[sliver], triangles[other] = (a, d, c), (d, b, c)
            done |= {sliver, other}
    return triangles


@lru_cache(maxsize=32)
def triangles_of(bodies, group, level):
    """The triangles of a group at a level, of the library's vertices."""
    detail = DETAILS[level]
    triangles, (gone, into) = bodies.triangles(group), bodies.merges(group)
    vertices = bodies.vertices_of(group)
    if group == "body":
        regions, left = _regions(bodies, vertices), (detail.head, detail.hands, detail.skin)
    else:
        regions = numpy.zeros(len(vertices), int)
        left = (detail.skirt if "skirt" in group else detail.cloth,)
    region_of = numpy.full(len(bodies.vertices), -1)
    region_of[vertices] = regions
    chosen = numpy.zeros(len(gone), bool)
    for region, stay in enumerate(left):
        own = numpy.nonzero(region_of[gone] == region)[0]
        chosen[own[:max(0, int((regions == region).sum()) - stay)]] = True
    triangles = coarser(triangles, gone, into, chosen)
    return without_slivers(bodies.vertices, triangles) if group == "body" and level == CLOSE else triangles
