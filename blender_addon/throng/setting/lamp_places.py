# SPDX-License-Identifier: Apache-2.0
"""Where lamps of streets are."""
from .plane import along_of

APART, BEYOND_APART, MOST = 16.0, 27.0, 40  # m along a layout's own roads, and along those beyond


def lamp_places(roads, apart=APART, most=MOST):
    """[(x, y)] along both kerbs of roads, alternately."""
    places = []
    for road in roads:
        half, line, next_at, side = 0.5 * float(road["width"]) + 0.5, road["centreline"], 0.5 * apart, 1
        for a, b in zip(line, line[1:]):
            (ux, uy), size = along_of(a, b)
            while next_at < size:
                places.append((a[0] + ux * next_at - uy * half * side, a[1] + uy * next_at + ux * half * side))
                next_at, side = next_at + apart, -side
            next_at -= size
    return [p for p in places if not any(_on_road(p, road) for road in roads)][:most]


def _on_road(place, road):
    half = 0.5 * float(road["width"])
    for a, b in zip(road["centreline"], road["centreline"][1:]):
        (ux, uy), size = along_of(a, b)
        dx, dy = place[0] - a[0], place[1] - a[1]
        if 0.0 <= dx * ux + dy * uy <= size and abs(-dx * uy + dy * ux) < half:
            return True
    return False


def junctions(roads):
    """[(x, y)] where roads cross."""
    found = []
    lines = [[tuple(p[:2]) for p in road["centreline"]] for road in roads]
    for i, one in enumerate(lines):
        for other in lines[:i]:
            for a, b in zip(one, one[1:]):
                for c, d in zip(other, other[1:]):
                    turn = (b[0] - a[0]) * (d[1] - c[1]) - (b[1] - a[1]) * (d[0] - c[0])
                    if abs(turn) < 1e-6:
                        continue
                    s = ((c[0] - a[0]) * (d[1] - c[1]) - (c[1] - a[1]) * (d[0] - c[0])) / turn
                    t = ((c[0] - a[0]) * (b[1] - a[1]) - (c[1] - a[1]) * (b[0] - a[0])) / turn
                    if 0.0 <= s <= 1.0 and 0.0 <= t <= 1.0:
                        found.append((a[0] + s * (b[0] - a[0]), a[1] + s * (b[1] - a[1])))
    return found
