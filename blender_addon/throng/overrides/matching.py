# SPDX-License-Identifier: Apache-2.0
"""Who is meant in a bake that was made again. Pure Python.

authoring/overrides/matching.h has the same rule; tests/shared/override_matching.json holds both to the same answers.
"""
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

    First whoever is sure; then, nearest first, by (metres / MOST_METRES)^2 + (frames / MOST_FRAMES)^2, and among equals by the order of the
    entries and then the rows.
    """
    matches, taken = [Match("orphaned")] * len(entries), set()
    for index, entry in enumerate(entries):
        row = entry["id"]
        if row >= len(people) or row in taken or people[row].frame is None or people[row].group != entry["group"]:
            continue
        metres, frames = _compare(entry, people[row])
        if metres <= SURE_METRES and abs(frames) <= SURE_FRAMES:
            matches[index] = Match("sure", row, metres, frames)
            taken.add(row)
    if all(each.kind == "sure" for each in matches):
        return matches

    left = defaultdict(list)  # by group and square
    for row, person in enumerate(people):
        if person.frame is not None and row not in taken:
            left[(person.group, math.floor(person.place[0] / MOST_METRES), math.floor(person.place[1] / MOST_METRES))].append(row)
    pairs = []
    for index, entry in enumerate(entries):
        if matches[index].kind == "sure":
            continue
        column, line = (math.floor(v / MOST_METRES) for v in entry["spawn"]["position"][:2])
        for row in (row for x in (-1, 0, 1) for y in (-1, 0, 1) for row in left.get((entry["group"], column + x, line + y), ())):
            metres, frames = _compare(entry, people[row])
            if metres <= MOST_METRES and abs(frames) <= MOST_FRAMES:
                by_place, by_time = metres / MOST_METRES, frames / MOST_FRAMES
                pairs.append((by_place * by_place + by_time * by_time, index, row, Match("nearest", row, metres, frames)))
    for _, index, row, found in sorted(pairs, key=lambda pair: pair[:3]):
        if row not in taken and matches[index].kind == "orphaned":
            matches[index] = found
            taken.add(row)
    return matches


def orphan_reason(entry, people):
    """Why an entry has nobody, for its user."""
    if all(person.group != entry["group"] for person in people):
        return f"there is no group `{entry['group']}` in this bake"
    return f"nobody else of `{entry['group']}` enters within {MOST_METRES:g} m and {MOST_FRAMES:g} frames of its place and time"
