# SPDX-License-Identifier: Apache-2.0
"""What of the ground before a camera is in the sun, between houses."""
import math

from .plane import inside

_CHESTS = 1.2  # m above the ground
_STEP = 0.5    # m on the way towards the sun
_AHEAD = (3.0, 5.0, 7.0, 10.0, 13.0)  # m before the camera
_ASIDE = (-0.25, 0.0, 0.25)           # of that


def houses_of(geometry):
    """[(outline, height)] of all that stands and is closed."""
    return [([tuple(p[:2]) for p in wall["points"]], float(wall.get("height", 3.0)))
            for wall in geometry.get("walls", []) if wall.get("closed")]


def in_sun(houses, place, sun):
    """Whether the sun shines on a chest at a place. @param sun the unit vector towards it"""
    across, rise = math.hypot(*sun[:2]) or 1e-6, sun[2]
    ux, uy = sun[0] / across, sun[1] / across
    for outline, height in houses:
        reach = (height - _CHESTS) * across / max(rise, 1e-3)
        if any(inside(outline, (place[0] + ux * away, place[1] + uy * away))
               for away in (_STEP * step for step in range(int(reach / _STEP) + 1))):
            return False
    return True


def sunny_share(houses, place, way, sun):
    """The share of those whom a camera sees from near that are in the sun. @param way the camera looks, in the plane"""
    seen = [(place[0] + (way[0] - way[1] * aside) * ahead, place[1] + (way[1] + way[0] * aside) * ahead)
            for ahead in _AHEAD for aside in _ASIDE]
    return sum(in_sun(houses, point, sun) for point in seen) / len(seen)
