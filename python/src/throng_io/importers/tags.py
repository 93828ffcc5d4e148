# SPDX-License-Identifier: Apache-2.0
"""What OpenStreetMap's tags mean for people on foot."""
from __future__ import annotations

import dataclasses
import re
from collections.abc import Mapping

# Widths where the map tells none, m.
WIDTHS = {"footway": 2.5, "path": 1.5, "steps": 2.5, "pedestrian": 6.0, "living_street": 6.0, "corridor": 2.5,
          "cycleway": 2.5, "track": 2.5, "service": 4.0, "residential": 6.0, "unclassified": 6.0, "crossing": 3.0}
WALKED = {"footway", "path", "steps", "pedestrian", "living_street", "corridor", "track"}
BARRIERS = {"wall": (0.3, 2.0), "fence": (0.1, 1.5), "hedge": (0.6, 1.5), "retaining_wall": (0.4, 1.5),
            "city_wall": (1.5, 6.0), "guard_rail": (0.3, 1.0), "handrail": (0.1, 1.0), "railing": (0.1, 1.0)}
STOREY = 3.0
PLAZAS = {"place": {"square"}, "leisure": {"park", "pitch", "playground"}, "railway": {"platform"},
          "public_transport": {"platform"}}


@dataclasses.dataclass(frozen=True)
class Meaning:
    kind: str                 # building, barrier, road, area; or "" with why
    what: str
    size: float = 0.0         # width or thickness, m
    height: float | None = None
    why: str = ""


def metres(text: str | None, default: float) -> float:
    """4, 4 m, 4.5m, 12 ft, 1.5;2: the first number."""
    found = re.match(r"\s*(\d+(?:\.\d+)?)\s*(m|ft|')?", text or "")
    return float(found[1]) * (0.3048 if found[2] in ("ft", "'") else 1.0) if found else default


def other_storey(tags: Mapping[str, str]) -> bool:
    """Not on the ground: the ground has one storey."""
    levels = re.findall(r"-?\d+(?:\.\d+)?", f"{tags.get('level', '')};{tags.get('layer', '')}")
    return tags.get("tunnel") in ("yes", "culvert") or tags.get("location") == "underground" or (
        bool(levels) and all(float(level) != 0 for level in levels))


def meaning(tags: Mapping[str, str], closed: bool) -> Meaning | None:
    """Nothing for what has no tags that concern people on foot."""
    building = tags.get("building") or tags.get("building:part")
    if building and building != "no":
        if not closed:
            return Meaning("", "buildings", why="no closed outline")
        if other_storey(tags):
            return Meaning("", "buildings", why="on another storey")
        height = metres(tags.get("height"), metres(tags.get("building:levels"), 2.0) * STOREY)
        return Meaning("building", "buildings", height=height)
    if tags.get("barrier"):
        return _barrier(tags)
    plaza = next((f"{key}={tags[key]}" for key, values in PLAZAS.items() if tags.get(key) in values), None)
    if closed and (plaza or (tags.get("area") == "yes" and tags.get("highway"))):
        if other_storey(tags):
            return Meaning("", "plazas", why="on another storey")
        return Meaning("area", "plazas")
    return _road(tags)


def _barrier(tags: Mapping[str, str]) -> Meaning:
    kind = tags["barrier"]
    if kind not in BARRIERS:
        return Meaning("", f"barriers of the kind {kind}", why="people pass, or it is no line")
    if other_storey(tags):
        return Meaning("", "barriers", why="on another storey")
    thickness, height = BARRIERS[kind]
    return Meaning("barrier", "barriers", min(metres(tags.get("width"), thickness), 5.0),
                   metres(tags.get("height"), height))


def _road(tags: Mapping[str, str]) -> Meaning | None:
    kind = tags.get("highway")
    if not kind:
        known = next((key for key in ("natural", "landuse", "waterway", "railway", "amenity", "indoor", "power")
                      if key in tags), None)
        return Meaning("", f"{known}={tags[known]}", why="has no counterpart") if known else None
    walked = kind in WALKED or tags.get("foot") in ("yes", "designated", "permissive")
    if not walked or tags.get("foot") in ("no", "private") or tags.get("access") in ("no", "private"):
        return Meaning("", f"highway={kind}", why="not for people on foot")
    if other_storey(tags):
        return Meaning("", f"highway={kind}", why="on another storey")
    crossing = tags.get("footway") == "crossing" or tags.get("path") == "crossing"
    what = "crossings" if crossing else "steps" if kind == "steps" else "footways"
    return Meaning("road", what, metres(tags.get("width"), WIDTHS["crossing"] if crossing else WIDTHS.get(kind, 3.0)))
