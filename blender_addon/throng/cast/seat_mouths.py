# SPDX-License-Identifier: Apache-2.0
"""Stands whose aisles go out behind them or through openings (vomitories), as boxes and steps: the flights of
steps, the walls beside an opening, what goes on over it, and the passage behind it. Pure Python."""
import math

CHEEK = 0.1     # m: sides of a passage, as authoring/layout/seat_mouths.cpp has them
SLAB = 0.15     # m: what people walk on
HEADROOM = 2.1  # m
WIDEST = 1.9    # m from a passage to the middle of the steps beside it, at most
_PARAPET = 0.95
_BEFORE = 0.35  # m: so far before the first row that goes on over it, room for those who walk along there
_RISER = 0.18   # m, of the steps of a passage that slopes
_FLAT = 0.12    # rise over run up to which a passage is a ramp


def has_passages(block):
    return any("passage" in aisle for aisle in block.get("aisles", ()))


def treads_of(flight, pitch):
    """(front edge, back edge, height, how much higher than the step before) of each step of a flight, two to a row,
    from the front."""
    line, half = [tuple(point) for point in flight["line"]], 0.5 * flight["width"]
    heights, found = flight["heights"], []
    for i, (x, y) in enumerate(line):
        if len(line) < 2:
            break
        (px, py), (qx, qy) = (line[i - 1], (x, y)) if i else (line[0], line[1])
        size = math.dist((px, py), (qx, qy)) or 1.0
        u, v = (qx - px) / size, (qy - py) / size
        before = heights[i - 1] if i else heights[0]
        steps = [(-0.15, 0.35, heights[i])] if i == 0 else \
            [(-0.65, -0.15, 0.5 * (before + heights[i])), (-0.15, 0.35, heights[i])]
        for begin, end, height in steps:
            front, back = ([(x + at * pitch * u + side * half * v, y + at * pitch * v - side * half * u)
                            for side in (-1.0, 1.0)] for at in (begin, end))
            found.append((front, back, height, 0.5 * (heights[i] - before) if i else SLAB))
    return found


class Mouth:
    """One opening or passage. Places are (metres beside its middle, metres behind the opening)."""

    def __init__(self, block, aisle):
        passage = aisle["passage"]
        self.pitch, self.rise = float(block["pitch"]), float(block["rise"])
        foot, opening, landing = [tuple(point) for point in passage["line"]]
        self.length = math.dist(foot, opening)
        self.back = tuple((f - o) / self.length for f, o in zip(foot, opening))
        self.origin, self.half = opening, 0.5 * float(passage["width"])
        self.foot, self.landing = passage["heights"][0], passage["heights"][1]
        self.sides = [flight for flight in aisle["flights"]
                      if len(flight["line"]) > 1 and abs(flight["heights"][0] - self.landing) < 1e-6
                      and self.half < self._beside(flight["line"][0]) < self.half + WIDEST
                      and self.half < self._beside(flight["line"][1]) < self.half + WIDEST]
        self.rows = len(self.sides[0]["line"]) - 1 if self.sides else 0  # that are cut behind the landing

    def _beside(self, place):
        """m from the passage's axis."""
        u, v = self.back
        return abs((place[0] - self.origin[0]) * v - (place[1] - self.origin[1]) * u)

    def at(self, beside, behind, height):
        u, v = self.back
        return (self.origin[0] + beside * v + behind * u, self.origin[1] - beside * u + behind * v, height)

    def floor(self, behind):
        return self.landing + (self.foot - self.landing) * min(max(behind / self.length, 0.0), 1.0)

    def tread(self, behind):
        """Of the rows at its side, evenly."""
        return self.landing + self.rise * max(behind / self.pitch, 0.0)

    @property
    def covered_from(self):
        """Where rows go on over it; behind it where there is no opening."""
        return max(self.rows - 1, 0) * self.pitch if self.sides else 0.0


def _prism(mouth, beside, behind, low, high):
    """Faces of a block between two places beside and two behind; its heights are two each, before and behind."""
    (a, b), (c, d) = beside, behind
    corners = [mouth.at(u, v, (low if up == 0 else high)[0 if v == c else 1])
               for up in (0, 1) for u, v in ((a, c), (b, c), (b, d), (a, d))]
    return [[corners[i] for i in face] for face in
            ((0, 1, 2, 3), (4, 7, 6, 5), (0, 4, 5, 1), (1, 5, 6, 2), (2, 6, 7, 3), (3, 7, 4, 0))]


def _passage_floor(mouth):
    """A ramp, or steps."""
    half, rise = mouth.half, mouth.foot - mouth.landing
    if abs(rise) < _FLAT * mouth.length:
        return _prism(mouth, (-half, half), (0.0, mouth.length), [mouth.landing - SLAB, mouth.foot - SLAB],
                      [mouth.landing, mouth.foot])
    count, faces = max(1, round(abs(rise) / _RISER)), []
    for step in range(count):
        behind = (mouth.length * step / count, mouth.length * (step + 1) / count)
        height = mouth.landing + rise * (step + 0.5) / count
        faces += _prism(mouth, (-half, half), behind, [height - SLAB - abs(rise) / count] * 2, [height] * 2)
    return faces


def walls_of(mouth):
    """Faces of what is seen from the stand: walls beside the opening and the parapet over it, and the landing."""
    if not mouth.sides:
        return []
    half, low = mouth.half, mouth.landing
    end = max(mouth.covered_from - _BEFORE, 0.0)
    wide = half + 2.0 * CHEEK + 0.9
    faces = _prism(mouth, (-wide, wide), (-mouth.pitch, 0.0), [low - SLAB - mouth.rise] * 2, [low] * 2)
    for side in (-1.0, 1.0):
        beside = sorted((side * half, side * (half + CHEEK)))
        faces += _prism(mouth, beside, (0.0, end + CHEEK), [mouth.floor(0.0) - SLAB, mouth.floor(end) - SLAB],
                        [mouth.tread(0.5 * mouth.pitch) + _PARAPET, mouth.tread(end) + _PARAPET])
    over = mouth.tread(mouth.rows * mouth.pitch)
    faces += _prism(mouth, (-half, half), (end, end + CHEEK), [over - SLAB] * 2, [over + _PARAPET + 0.05] * 2)
    faces += _prism(mouth, (-half, half), (end, mouth.covered_from), [over - SLAB] * 2, [over] * 2)
    return faces + _prism(mouth, (-wide, wide), (mouth.covered_from, mouth.covered_from + mouth.pitch),
                          [over - SLAB] * 2, [over] * 2)


def passage_of(mouth):
    """Faces of the passage, which is dark."""
    half, end, faces = mouth.half, mouth.covered_from, _passage_floor(mouth)
    if not mouth.sides or mouth.length - end < 0.5:
        return faces
    for side in (-1.0, 1.0):
        beside = sorted((side * half, side * (half + CHEEK)))
        faces += _prism(mouth, beside, (end, mouth.length), [mouth.floor(end) - SLAB, mouth.foot - SLAB],
                        [mouth.floor(end) + HEADROOM, mouth.foot + HEADROOM])
    return faces + _prism(mouth, (-half - CHEEK, half + CHEEK), (end, mouth.length),
                          [mouth.floor(end) + HEADROOM, mouth.foot + HEADROOM],
                          [mouth.floor(end) + HEADROOM + CHEEK, mouth.foot + HEADROOM + CHEEK])


def faces_of(block, aisle):
    """All of it: flights of steps as slabs, the opening and the passage."""
    mouth = Mouth(block, aisle)
    return flights_of(mouth, aisle) + walls_of(mouth) + passage_of(mouth)


def flights_of(mouth, aisle):
    """Faces of the flights of steps, as slabs."""
    return [face for flight in aisle["flights"] for front, back, height, rise in treads_of(flight, mouth.pitch)
            for face in _step_faces(front, back, height - rise - SLAB, height)]


def _step_faces(front, back, bottom, height):
    """Of a straight step between two edges."""
    (a, b), (c, d) = front, back
    low, high = ([(*corner, z) for corner in (a, b, d, c)] for z in (bottom, height))
    return [low[::-1], high] + [[low[i], low[(i + 1) % 4], high[(i + 1) % 4], high[i]] for i in range(4)]
