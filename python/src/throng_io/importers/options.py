# SPDX-License-Identifier: Apache-2.0
"""What one can say about a plan that is not in it."""
from __future__ import annotations

import dataclasses
import fnmatch


@dataclasses.dataclass(frozen=True)
class Options:
    walls: tuple[str, ...] = ()     # patterns of layers; none: those that are called walls, or all
    areas: tuple[str, ...] = ("*area*", "*zone*", "*entry*", "*entrance*", "*exit*")
    roads: tuple[str, ...] = ("*road*", "*footway*", "*path*")
    skip: tuple[str, ...] = ("*text*", "*dim*", "*furniture*", "*hatch*", "defpoints", "*door*")
    unit: float | None = None       # metres of a unit of the file; none: as the file says
    tolerance: float = 0.02         # m that curves may be off
    crs: str | None = None          # of GeoJSON that is not in degrees
    people: int = 0                 # to walk through a plan that has nobody

    def kind(self, layers: list[str], has_walls: bool) -> str | None:
        """walls, areas or roads by the names of layers, or nothing for those that are left out."""
        for kind, patterns in (("skip", self.skip), ("areas", self.areas), ("roads", self.roads)):
            if matches(layers, patterns):
                return None if kind == "skip" else kind
        chosen = self.walls or (NAMES_OF_WALLS if has_walls else ("*",))
        return "walls" if matches(layers, chosen) else None


NAMES_OF_WALLS = ("*wall*", "*wand*", "*wände*", "*mur*", "*muro*", "*column*", "*pillar*")


def matches(names: list[str], patterns: tuple[str, ...]) -> bool:
    return any(fnmatch.fnmatchcase(name.lower(), pattern.lower()) for name in names or [""] for pattern in patterns)
