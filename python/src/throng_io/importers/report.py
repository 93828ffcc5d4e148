# SPDX-License-Identifier: Apache-2.0
"""What was taken over from a file, and what was not, and why."""
from __future__ import annotations

import collections
import dataclasses


@dataclasses.dataclass
class Report:
    source: str
    taken: collections.Counter = dataclasses.field(default_factory=collections.Counter)
    left: collections.Counter = dataclasses.field(default_factory=collections.Counter)
    changed: collections.Counter = dataclasses.field(default_factory=collections.Counter)

    def took(self, what: str, count: int = 1) -> None:
        if count:
            self.taken[what] += count

    def left_out(self, what: str, why: str, count: int = 1) -> None:
        if count:
            self.left[what, why] += count

    def altered(self, what: str, how: str, count: int = 1) -> None:
        """Taken over, but not as it was."""
        if count:
            self.changed[what, how] += count

    def as_dict(self) -> dict:
        def rows(counted, second):
            return [{"what": what, second: why, "count": count} for (what, why), count in sorted(counted.items())]

        return {"source": self.source, "taken": dict(sorted(self.taken.items())), "left_out": rows(self.left, "why"),
                "changed": rows(self.changed, "how")}

    def __str__(self) -> str:
        lines = [f"{self.source}:", "  taken over: " + (", ".join(
            f"{count} {what}" for what, count in sorted(self.taken.items())) or "nothing")]
        for title, counted in (("changed", self.changed), ("left out", self.left)):
            lines += [f"  {title}: {count} {what}: {why}" for (what, why), count in sorted(counted.items())]
        return "\n".join(lines)
