# SPDX-License-Identifier: Apache-2.0
"""Rails in the lanes that trams follow."""
import math

import numpy

from . import materials
from .shapes import Shape, direction
from .streets import MARK_Z

_GAUGE, _BROAD, _GROOVE = 1.435, 0.055, 0.04  # m
_ON_LANE = 0.5                                # m: as far as a tram may be off a lane that it follows


def build_rails(traffic, manifest, track):
    """What is laid in the street, as objects: none where no tram comes.

    @param track vehicles.npy
    """
    trams = [number for number, what in enumerate(manifest["vehicles"]["list"]) if what["kind"] == "tram"]
    places = [track[numpy.flatnonzero(track[:, number, 6] > 0.0)[:1], number, :2] for number in trams]
    rails = Shape("Throng rails")
    for lane in traffic["lanes"]:
        if any(len(place) and _apart(lane, place[0]) <= _ON_LANE for place in places):
            _lay(rails, [tuple(point[:2]) for point in lane["points"]])
    return [rails.to_object()] if rails.faces else []


def _apart(lane, place):
    """m, from the lane's line, which goes on straight at both ends."""
    line = [tuple(point[:2]) for point in lane["points"]]
    found = []
    for number, (a, b) in enumerate(zip(line, line[1:])):
        (ux, uy), size = direction(a, b)
        along = (place[0] - a[0]) * ux + (place[1] - a[1]) * uy
        least, most = (-math.inf if number == 0 else 0.0), (math.inf if number == len(line) - 2 else size)
        along = min(max(along, least), most)
        found.append(math.hypot(place[0] - a[0] - ux * along, place[1] - a[1] - uy * along))
    return min(found)


def _lay(shape, line):
    steel = materials.plain("rail", (0.30, 0.29, 0.28), 0.25)
    groove = materials.plain("rail groove", (0.006, 0.006, 0.006), 0.9)
    for a, b in zip(line, line[1:]):
        (ux, uy), size = direction(a, b)
        for side in (-1.0, 1.0):
            inner = side * 0.5 * _GAUGE
            for near, far, material in ((inner, inner + side * _BROAD, steel), (inner - side * _GROOVE, inner, groove)):
                low, high = sorted((near, far))
                shape.flat([(a[0] + ux * s - uy * t, a[1] + uy * s + ux * t)
                            for s, t in ((0.0, low), (size, low), (size, high), (0.0, high))], 0.75 * MARK_Z, material)
