# SPDX-License-Identifier: Apache-2.0
"""Single people of a bake: who they are (agents.csv), and what they do frame by frame (PC2), with changes. Pure Python,
as `throng apply` has it."""
import csv
import hashlib
import math
import mmap
import os
import struct
from dataclasses import dataclass

from ..formats import STREAMS, BakeError
from ..formats.whole_files import write_whole
from .matching import Entrant
from .override_file import Change

_HEADER = 32
_THREE = struct.Struct("<3f")


@dataclass(frozen=True)
class Sample:
    position: tuple
    direction: tuple  # cos, sin, m/s
    state: tuple      # activity, variation, phase


class Rows:
    """Random access to the people of a bake. Close it, or use it with `with`."""

    def __init__(self, bake):
        self.agents, self.frames, self._files, self._maps = bake.agents, bake.frames, [], []
        for stream in STREAMS:
            try:
                file = open(bake.stream_path(stream), "rb")
            except OSError as error:
                raise BakeError(f"the stream {stream} cannot be read: {error.strerror}") from None
            self._files.append(file)
            self._maps.append(mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ))

    def __enter__(self):
        return self

    def __exit__(self, *_):
        for thing in self._maps + self._files:
            thing.close()

    def _three(self, stream, row, frame):
        return _THREE.unpack_from(self._maps[stream], _HEADER + 12 * (frame * self.agents + row))

    def place(self, row, frame):
        return self._three(STREAMS.index("pos"), row, frame)

    def whole(self, row, frame):
        return Sample(*(self._three(STREAMS.index(stream), row, frame) for stream in ("pos", "dir", "state")))

    def at(self, row, frame, pace=1.0):
        """Somebody at a time between the frames. Positions, speed and phase are interpolated linearly, the heading by
        its angle; activity and variation are the nearest frame's. Beyond the bake's ends people stand as they did
        there. Speeds are scaled by the pace."""
        inside = min(max(frame, 0.0), self.frames - 1.0)
        low = int(math.floor(inside))
        share = inside - low
        before = self.whole(row, low)
        after = self.whole(row, low + 1) if share > 0.0 else before
        between = lambda a, b: a + (b - a) * share
        start = math.atan2(before.direction[1], before.direction[0])
        turn = math.remainder(math.atan2(after.direction[1], after.direction[0]) - start, 2.0 * math.pi)
        heading = start + turn * share
        speed = 0.0 if inside != frame else between(before.direction[2], after.direction[2]) * pace
        nearest = before if share < 0.5 else after
        return Sample(tuple(between(a, b) for a, b in zip(before.position, after.position)),
                      (math.cos(heading), math.sin(heading), speed),
                      (nearest.state[0], nearest.state[1], between(before.state[2], after.state[2])))

    def changed(self, row, first, change, frame, hides=True):
        """Somebody who entered at the frame `first`, in a frame of the shot, with its change."""
        if change.retimes:
            sample = self.at(row, first + (frame - first - change.delay) * change.speed, change.speed)
        else:
            sample = self.whole(row, frame)
        position, direction, state = sample.position, sample.direction, list(sample.state)
        if change.moves:
            pivot = self.place(row, first)
            c, s = math.cos(math.radians(change.turn)), math.sin(math.radians(change.turn))
            x, y = position[0] - pivot[0], position[1] - pivot[1]
            position = (pivot[0] + c * x - s * y + change.move[0], pivot[1] + s * x + c * y + change.move[1],
                        position[2] + change.move[2])
            direction = (c * direction[0] - s * direction[1], s * direction[0] + c * direction[1], direction[2])
        if change.character is not None:
            state[1] = float(change.character)
        if hides and change.hides:
            state[0] = 0.0
        return Sample(position, direction, tuple(state))


def _text(field):
    """A field as it was: what a spreadsheet would take for a formula is written with an apostrophe before it."""
    return field[1:] if field.startswith("'") and field.lstrip("'")[:1] in tuple("=+-@\t\r") else field


class Table:
    """agents.csv: who everybody is."""

    def __init__(self, bake, rows):
        path = os.path.join(bake.folder, "agents.csv")
        try:
            with open(path, encoding="utf-8", newline="") as file:
                lines = list(csv.DictReader(file))
            frames = [int(line["spawn_frame"]) if line["spawn_frame"] else None for line in lines]
            self.people = [Entrant(_text(line["group"])) if frame is None or frame >= bake.frames
                           else Entrant(_text(line["group"]), frame,
                                        tuple(a + b for a, b in zip(rows.place(row, frame), bake.origin)))
                           for row, (line, frame) in enumerate(zip(lines, frames))]
            self.looks = {row: _look(line) for row, line in enumerate(lines)
                          if line.get("tint") or line.get("scale", "1") not in ("", "1")}
        except OSError as error:
            raise BakeError(f"{path} cannot be read: {error.strerror}. Copy the whole bake "
                            "folder, not only bake.json") from None
        except (KeyError, ValueError, TypeError, csv.Error, struct.error) as error:
            raise BakeError(f"{path} is not the table of this bake ({error}): bake again") from None
        if len(self.people) != bake.agents:
            raise BakeError(f"{path} has {len(self.people)} people where bake.json has {bake.agents}: the "
                            "files are of different bakes")


def _look(line):
    """What `throng apply` has written about somebody's size and colours."""
    tint, scale = line.get("tint") or None, float(line.get("scale") or 1.0)
    if tint and not tint.startswith("#"):
        tint = tuple(float(number) for number in tint.split())
    return Change(tint=tint, scale=None if scale == 1.0 else scale)


def write_caches(folder, rows, people, changes):
    """Point caches of some people with their changes, as [row, ...] gives their order. Returns their paths by stream.

    Files are named by their content, so that a scene that was saved before keeps its own.
    """
    order = sorted(changes)
    data = {stream: bytearray() for stream in STREAMS}
    for frame in range(rows.frames):
        for row in order:
            sample = rows.changed(row, people[row].frame, changes[row], frame)
            for stream, values in (("pos", sample.position), ("dir", sample.direction), ("state", sample.state)):
                data[stream] += _THREE.pack(*values)
    paths = {}
    try:
        os.makedirs(folder, exist_ok=True)
        for stream, content in data.items():
            content = struct.pack("<12siiffi", b"POINTCACHE2\0", 1, len(order), 1.0, 1.0, rows.frames) + bytes(content)
            path = os.path.join(folder, f"{hashlib.blake2b(content, digest_size=8).hexdigest()}.{stream}.pc2")
            paths[stream] = path
            if not os.path.exists(path):
                write_whole(path, content)
    except OSError as error:
        raise BakeError(f"the retimed people cannot be written to {folder}: {error.strerror}") from None
    return paths
