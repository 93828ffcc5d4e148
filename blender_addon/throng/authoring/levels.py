# SPDX-License-Identifier: Apache-2.0
"""Levels and links as objects: floors are curves or meshes at their height, stairs and the like curves from one to
another. A lift is an empty, of which the place is drawn and everything else is as the layout tells. Pure Python.

In a layout that names parts of a terrain, levels have a place in them instead of a floor, and are empties, too.
"""
from .fields import LINK
from .codecs import put_all, take_all
from .values import MISSING, is_number, is_point, short, single

ON_LEVELS = ("ROAD", "AREA", "WALL", "PATCH", "SEATS", "FORMATION")  # kinds of objects that are on one
MOVING = ("escalator", "travelator")
_OF_MOVING = ("speed", "walking", "stand")
_STEPS = 1.0  # m: how wide those are unless told


def is_lift(entry):
    return entry.get("type") == "lift"


def place_in_ground(entry):
    """(x, y, z) of a level that is a part of a terrain; None: it has a floor."""
    at = entry.get("at")
    is_place = isinstance(at, list) and len(at) in (2, 3) and all(is_number(part) for part in at)
    return tuple((*at, 0.0)[:3]) if is_place and "floor" not in entry else None


def height_of(entry):
    height = entry.get("height")
    return float(height) if is_number(height) else 0.0


def written_height(height, raw):
    """A level's height: what the layout has, to the last digit, unless it was moved."""
    before = raw.get("height", MISSING)
    if abs(height - (before if is_number(before) else 0.0)) <= 1e-6 + 2.0**-21 * abs(height):
        return before
    return short(height)


def put_link(link, entry, world):
    put_all(LINK, link, entry)
    if entry.get("type") in MOVING and not is_number(entry.get("width")):
        link.width = _STEPS
    link.begins, link.ends = (world.level(entry.get(key)) for key in ("from", "to"))


def take_link(link, raw, world):
    """The object's keys, but for its path."""
    result = take_all(LINK, link, raw)
    if link.type in MOVING:
        if "width" not in raw or raw.get("type") != link.type:
            result["width"] = short(link.width)
        if "width" not in raw and single(link.width) == _STEPS:
            del result["width"]
    else:
        for key in _OF_MOVING:
            if key not in raw:
                result.pop(key, None)
    for key, target in (("from", link.begins), ("to", link.ends)):
        if world.has_level(target):
            result[key] = world.name(target)
    return result


def take_lift(raw, world):
    """Its levels may be called otherwise by now."""
    result = dict(raw)
    for key in ("levels", "opposite"):
        if isinstance(raw.get(key), list):
            result[key] = [world.level_named(each) if isinstance(each, str) else each for each in raw[key]]
    return result


def put_level(thing, entry, world):
    """Brings something to the height of its level."""
    level = world.level(entry.get("level"))
    thing.throng_layout.level = level
    if level is not None:
        thing.location.z = level.location.z


def take_level(thing, raw, world):
    """The key `level`: nothing is on the first."""
    target, before = thing.throng_layout.level, raw.get("level", MISSING)
    name = level_of(target, before, world)
    return MISSING if before is MISSING and target == world.first_level() else name


def level_of(target, before, world):
    """What a level is called. @param before in the layout that was imported"""
    if not world.has_level(target):
        return MISSING if isinstance(before, str) and world.is_level(before) else before
    return world.name(target)


def moved_point(point, raw, origin):
    """[x, y] of an empty, and the layout's own digits where it was not moved."""
    if is_point(raw) and all(abs(now + off - old) <= 1e-6 + 2.0**-21 * abs(now)
                             for now, off, old in zip(point, origin, raw)):
        return raw
    return None
