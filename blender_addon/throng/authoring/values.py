# SPDX-License-Identifier: Apache-2.0
"""Numbers between a layout, which has doubles, and Blender, which has single floats. Pure Python.

What was not changed in Blender keeps the layout's own digits; what was changed is written with as few digits as say it.
"""
import struct

MISSING = object()  # stands for a key that is not there
_LARGEST_INT = 2**31 - 1


def is_number(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def single(value):
    """The nearest single float."""
    try:
        return struct.unpack("<f", struct.pack("<f", value))[0]
    except OverflowError:
        return float("inf") if value > 0 else float("-inf")


def whole(value):
    """As an IntProperty holds it."""
    return max(-_LARGEST_INT, min(_LARGEST_INT, int(value)))


def short(value):
    """The shortest decimal that is the same single float: 0.3 instead of 0.30000001192092896."""
    value = single(value)
    for digits in range(6, 10):
        text = float(f"{value:.{digits}g}")
        if single(text) == value:
            break
    return int(text) if text == int(text) else text


def keep_digits(value, raw):
    """The value, with raw's digits wherever both have the same number in the same place."""
    if is_number(value) and is_number(raw):
        return raw if single(value) == single(raw) else value
    if isinstance(value, dict) and isinstance(raw, dict):
        return {key: keep_digits(part, raw.get(key)) for key, part in value.items()}
    if isinstance(value, list) and isinstance(raw, list):
        return [keep_digits(part, old) for part, old in zip(value, raw + [None] * len(value))]
    return value


def is_point(value):
    return isinstance(value, list) and len(value) == 2 and all(is_number(part) for part in value)


def are_points(value, least):
    return isinstance(value, list) and len(value) >= least and all(is_point(point) for point in value)


def _kept(point, raw, origin, reach):
    """[x, y] of the layout's point, each where the position in Blender is what it became there: a few roundings
    apart. None: was moved."""
    tolerance = 2.0**-21 * reach + 1e-7
    return [old if abs(part + offset - old) <= tolerance else None for part, old, offset in zip(point, raw, origin)]


def keep_points(points, raw, origin):
    """The layout's points for positions in Blender: those that were not moved are `raw`'s own, to the last digit.

    When points were added or taken out, those before and those behind the change are still known.
    """
    reach = max((max(abs(x), abs(y)) for x, y in points), default=0.0)
    result = [[None, None]] * len(points)
    if len(raw) == len(points):
        result = [_kept(point, old, origin, reach) for point, old in zip(points, raw)]
    else:
        shorter = min(len(raw), len(points))
        first = 0
        while first < shorter and None not in _kept(points[first], raw[first], origin, reach):
            result[first] = raw[first]
            first += 1
        last = 1
        while last <= shorter - first and None not in _kept(points[-last], raw[-last], origin, reach):
            result[-last] = raw[-last]
            last += 1
    return [_filled(kept, point, origin) if None in kept else list(kept) for kept, point in zip(result, points)]


def _filled(kept, point, origin):
    return [now if old is None else old for old, now in zip(kept, world_point(point, origin))]


def world_point(point, origin):
    """A position in Blender as a layout's point."""
    return [_sum(short(part), offset) for part, offset in zip(point, origin)]


def _sum(part, offset):
    total = round(part + offset, 6)
    return int(total) if total == int(total) else total
