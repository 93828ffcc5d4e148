# SPDX-License-Identifier: Apache-2.0
"""Who is meant in a bake that was made again. Pure Python.

authoring/overrides/matching.h has the same rule; tests/shared/override_matching.json holds both to the same answers.
"""
import itertools
import math
from collections import defaultdict
from dataclasses import dataclass

SURE_METRES, SURE_FRAMES = 0.5, 12.0   # within these, the same id and group is the same person
MOST_METRES, MOST_FRAMES = 3.0, 48.0   # further away nobody is taken for another


@dataclass(frozen=True)
class Entrant:
    """Somebody in a bake."""
    group: str
    frame: int = None     # of its entry, from 0; None: it never enters
    place: tuple = None   # m, world


@dataclass(frozen=True)
class Match:
    kind: str             # sure, nearest or orphaned
    row: int = None
    metres: float = 0.0
    frames: float = 0.0   # later above zero


def _compare(entry, person):
    x, y, z = (a - b for a, b in zip(person.place, entry["spawn"]["position"]))
    return math.sqrt(x * x + y * y + z * z), float(person.frame - entry["spawn"]["frame"])


def match(entries, people):
    """One Match for each entry, in their order; each person has at most one.

    First whoever is sure; then, nearest first, by (metres / MOST_METRES)^2 + (frames / MOST_FRAMES)^2, and among equals
    by the order of the entries and then the rows.
    """
    matches, taken = [Match("orphaned")] * len(entries), set()
    for index, entry in enumerate(entries):
        found = _sure(entry, people)
        if found and found.row not in taken:
            matches[index] = found
            taken.add(found.row)
    left = [index for index, each in enumerate(matches) if each.kind != "sure"]
    for index, found in _nearest_first(entries, left, people, taken):
        if found.row not in taken and matches[index].kind == "orphaned":
            matches[index] = found
            taken.add(found.row)
    return matches


def _sure(entry, people):
    """The Match of whoever has an entry's id, if that is who was meant."""
    row = entry["id"]
    if row >= len(people) or people[row].frame is None or people[row].group != entry["group"]:
        return None
    metres, frames = _compare(entry, people[row])
    return Match("sure", row, metres, frames) if metres <= SURE_METRES and abs(frames) <= SURE_FRAMES else None


def _square(place):
    return math.floor(place[0] / MOST_METRES), math.floor(place[1] / MOST_METRES)


def _nearest_first(entries, left, people, taken):
    """[(index of the entry, Match)] of all pairs of the entries that are left with people who are not taken,
    the nearest pair first."""
    if not left:
        return []
    free = defaultdict(list)  # by group and square
    for row, person in enumerate(people):
        if person.frame is not None and row not in taken:
            free[(person.group, *_square(person.place))].append(row)
    pairs = [(distance, index, found.row, found) for index in left
             for distance, found in _near(entries[index], people, free)]
    return [(index, found) for _, index, _, found in sorted(pairs, key=lambda pair: pair[:3])]


def _near(entry, people, free):
    """(distance, Match) of everybody who is near enough to be meant."""
    column, line = _square(entry["spawn"]["position"])
    for x, y in itertools.product((-1, 0, 1), repeat=2):
        for row in free.get((entry["group"], column + x, line + y), ()):
            metres, frames = _compare(entry, people[row])
            if metres <= MOST_METRES and abs(frames) <= MOST_FRAMES:
                by_place, by_time = metres / MOST_METRES, frames / MOST_FRAMES
                yield by_place * by_place + by_time * by_time, Match("nearest", row, metres, frames)


def orphan_reason(entry, people):
    """Why an entry has nobody, for its user."""
    if all(person.group != entry["group"] for person in people):
        return f"there is no group `{entry['group']}` in this bake"
    return (f"nobody else of `{entry['group']}` enters within {MOST_METRES:g} m and {MOST_FRAMES:g} frames "
            "of its place and time")
