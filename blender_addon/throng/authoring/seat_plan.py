# SPDX-License-Identifier: Apache-2.0
"""A block of seats as a bake will have it, from its numbers: rows, aisles, flights of steps and passages. What
authoring/layout/row_line.cpp, seat_rows.cpp and seat_mouths.cpp do, for whoever draws it before there is a bake. Pure
Python."""
import bisect
import dataclasses
import itertools
import math

_ARC_STEP = 1.0           # degrees
_HAIR = 1.0e-6            # seats
_BEFORE_THE_BLOCK = 0.7   # m, where people step off the ground
_BESIDE_THE_BLOCK = 0.45  # m, of a block without aisles
_SLAB, _CHEEK = 0.15, 0.1  # m
_FLIGHT = 0.9             # m, the width of the steps beside an opening
_HEADROOM = 2.1           # m


@dataclasses.dataclass
class Block:
    """Numbers of a block, m. Those that make no sense are brought to where something can be drawn."""
    front: list                # points of the first row
    rows: int = 1
    pitch: float = 0.8
    width: float = 0.5
    rise: float = 0.0
    height: float = 0.0        # of the first row, with that of its level
    aisles: int = 0
    aisle_width: float = 1.2
    mouths: str = "front"      # where aisles go out: front, back, row
    mouth_row: int = 1         # from 1
    passage: float = None      # m from the opening to its foot; None: to behind the block
    foot: float = 0.0          # m, of the ground there
    walked: bool = False       # people walk to it, or leave it

    def __post_init__(self):
        self.front = [point for i, point in enumerate(self.front)
                      if i == 0 or math.dist(point, self.front[i - 1]) > _HAIR]
        self.rows, self.aisles = min(max(self.rows, 1), 200), min(max(self.aisles, 0), 60)
        self.pitch, self.width = max(self.pitch, 0.1), max(self.width, 0.1)
        self.aisle_width = max(self.aisle_width, 0.0)

    @property
    def has_passages(self):
        return self.mouths != "front" and self.aisles > 0

    @property
    def ahead(self):
        """m before the middle of a seat, where others pass."""
        return min(max(self.pitch - 0.5, 0.3), 0.42)

    @property
    def behind(self):
        return (self.rows - 0.5) * self.pitch

    def tread(self, row):
        return self.height + row * self.rise

    def walk(self, row):
        """m behind the first row: where one walks before the seats of a row."""
        return row * self.pitch - self.ahead

    @property
    def landing(self):
        """The row on which people come out, from 0."""
        return self.rows - 1 if self.mouths == "back" else min(max(self.mouth_row - 1, 0), self.rows - 1)

    @property
    def opening(self):
        return (self.landing + 0.5) * self.pitch

    @property
    def passage_length(self):
        return self.behind - self.opening + _BEFORE_THE_BLOCK if self.passage is None else max(self.passage, 0.1)

    def floor(self, back):
        """m, of the passage so far behind the first row."""
        share = min(max((back - self.opening) / self.passage_length, 0.0), 1.0)
        return self.tread(self.landing) + share * (self.foot - self.tread(self.landing))

    @property
    def last_cut(self):
        """The last row that is cut for an opening; the landing where there is none."""
        if self.mouths != "row":
            return self.landing
        for row in range(self.landing + 1, self.rows):
            if self.tread(row) - _SLAB - self.floor((row - 0.5) * self.pitch) >= _HEADROOM:
                return row
        return self.rows - 1

    def gap(self, row):
        """m between the seats on either side of an aisle."""
        has_opening = self.mouths == "row" and self.landing + 1 < self.rows
        is_cut = has_opening and self.landing <= row <= self.last_cut
        return self.aisle_width + (2.0 * (_CHEEK + _FLIGHT) if is_cut else 0.0)


def arc_front(centre, radius, begin, end):
    """The first row of an arc. @param begin, end degrees, counter-clockwise"""
    steps = min(max(2, math.ceil((end - begin) / _ARC_STEP)), 360)
    angles = (math.radians(begin + (end - begin) * i / steps) for i in range(steps + 1))
    return [(centre[0] + radius * math.cos(angle), centre[1] + radius * math.sin(angle)) for angle in angles]


class RowLine:
    """The line that a row stands on, as a share of it goes from 0 to 1."""

    def __init__(self, front, back):
        pieces = [(b[0] - a[0], b[1] - a[1]) for a, b in zip(front, front[1:])]
        sizes = [math.hypot(*piece) for piece in pieces]
        self._left = [(-y / size, x / size) for (x, y), size in zip(pieces, sizes)]
        self.points = []
        for (x, y), before, after in zip(front, [self._left[0], *self._left], [*self._left, self._left[-1]]):
            u, v = before[0] + after[0], before[1] + after[1]
            by = 2.0 * back / max(u * u + v * v, 1e-9)
            self.points.append((x - by * u, y - by * v))
        passed = list(itertools.accumulate(sizes, initial=0.0))
        self.shares = [each / passed[-1] for each in passed]
        self._sizes = [math.dist(a, b) for a, b in zip(self.points, self.points[1:])]

    def length_between(self, low, high):
        total = 0.0
        for size, begin, end in zip(self._sizes, self.shares, self.shares[1:]):
            inner = min(high, end) - max(low, begin)
            total += size * inner / (end - begin) if inner > 0.0 else 0.0
        return total

    def advance(self, share, metres):
        """The share so many metres behind another."""
        if metres < 0.0:
            return self.advance(0.0, max(self.length_between(0.0, share) + metres, 0.0))
        for size, begin, end in zip(self._sizes, self.shares, self.shares[1:]):
            if end <= share:
                continue
            low = max(share, begin)
            rest = (end - low) * size / (end - begin)
            if metres <= rest and size > 0.0:
                return low + metres * (end - begin) / size
            metres -= rest
        return 1.0

    def _piece(self, share):
        return bisect.bisect_right(self.shares, share, 1, len(self.shares) - 1) - 1

    def at(self, share):
        i = self._piece(share)
        u = (share - self.shares[i]) / (self.shares[i + 1] - self.shares[i])
        (x, y), (p, q) = self.points[i], self.points[i + 1]
        return (x + u * (p - x), y + u * (q - y))

    def ahead_at(self, share):
        return self._left[self._piece(share)]

    def between(self, low, high):
        inner = [point for point, share in zip(self.points, self.shares) if low + 1e-9 < share < high - 1e-9]
        return [self.at(low), *inner, self.at(high)]

    def goes_on(self):
        """Whether it goes the way that the first row goes, everywhere."""
        return all((b[0] - a[0]) * v - (b[1] - a[1]) * u > 0.0
                   for a, b, (u, v) in zip(self.points, self.points[1:], self._left))


def _sections(block, line, gap):
    """[(from, to)]: shares between two aisles, or an aisle and an end."""
    found = []
    for i in range(block.aisles + 1):
        middle, after = i / (block.aisles + 1), (i + 1) / (block.aisles + 1)
        begin = 0.0 if i == 0 else line.advance(middle, 0.5 * gap)
        room = max(line.length_between(middle, after) - 0.5 * gap, 0.0)
        found.append((begin, after if i == block.aisles else line.advance(middle, room)))
    return found


def _seats_in(block, line, section):
    return math.floor(line.length_between(*section) / block.width + _HAIR) if section[1] > section[0] else 0


def _rows(block):
    """([{line, height}], how many seats)."""
    found, count = [], 0
    for row in range(block.rows):
        line = RowLine(block.front, row * block.pitch)
        for section in _sections(block, line, block.gap(row)):
            seats = _seats_in(block, line, section)
            count += seats
            if seats:
                found.append({"line": line.between(*section), "height": block.tread(row)})
    return found, count


def folds_back(block):
    """Whether rows behind the first one would turn back on themselves."""
    return not all(RowLine(block.front, back).goes_on() for back in (block.behind, -0.5 * block.pitch))


class _Aisle:
    def __init__(self, block, number):
        self.block, self.number = block, number
        self.share = (number + 1) / (block.aisles + 1) if block.aisles else float(number)

    def at(self, aside, back):
        line = RowLine(self.block.front, back)
        return line.at(line.advance(self.share, aside))

    def _place(self, back):
        """The middle of it; of a block without any, beside its rows."""
        line = RowLine(self.block.front, back)
        (x, y), (u, v) = line.at(self.share), line.ahead_at(self.share)
        side = 0.0 if self.block.aisles else _BESIDE_THE_BLOCK * (1.0 if self.number else -1.0)
        return (x + side * v, y - side * u)

    def line(self):
        block = self.block
        return [self._place(back) for back in (-0.5 * block.pitch - _BEFORE_THE_BLOCK,
                                               *(block.walk(row) for row in range(block.rows)))]

    def _flight(self, first, last, aside, width):
        block, rows = self.block, range(first, last + 1)
        return {"line": [self.at(aside, block.walk(row)) for row in rows],
                "heights": [block.tread(row) for row in rows], "width": width}

    def flights(self):
        block = self.block
        landing, cut, last, wide = block.landing, block.last_cut, block.rows - 1, block.aisle_width
        found = [self._flight(0, landing, 0.0, wide)] if landing > 0 else []
        if cut == landing:
            return found
        beside = 0.5 * wide + _CHEEK + 0.5 * _FLIGHT
        found += [self._flight(landing, cut, side * beside, _FLIGHT) for side in (1.0, -1.0)]
        return found + ([self._flight(cut, last, 0.0, wide)] if last > cut else [])

    def passage(self):
        block = self.block
        height = block.tread(block.landing)
        return {"line": [self.at(0.0, back) for back in (block.opening + block.passage_length, block.opening,
                                                         block.walk(block.landing))],
                "heights": [block.foot, height, height], "width": block.aisle_width}

    def described(self):
        if self.block.has_passages:
            passage = self.passage()
            return {"line": passage["line"], "width": passage["width"], "passage": passage, "flights": self.flights()}
        return {"line": self.line(), "width": self.block.aisle_width if self.block.aisles else 2.0 * _BESIDE_THE_BLOCK}


def plan_of(block):
    """(what a bake tells of the block, how many seats it has); None where it cannot be built."""
    if len(block.front) < 2 or folds_back(block):
        return None
    rows, count = _rows(block)
    shown = block.walked or block.has_passages
    aisles = [_Aisle(block, number).described() for number in range(block.aisles or 2)] if shown else []
    return {"pitch": block.pitch, "width": block.width, "rise": block.rise, "rows": rows, "aisles": aisles}, count
