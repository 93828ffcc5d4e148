# SPDX-License-Identifier: Apache-2.0
"""A bake's people in the formats of other programs."""
from __future__ import annotations

import contextlib
import csv
import hashlib
import os
import sqlite3
from collections.abc import Iterator
from typing import Protocol

import numpy
import shapely

from ..base.errors import ThrongError, need
from ..base.whole_files import whole_file

COLUMNS = ("frame", "seconds", "id", "group", "x", "y", "z", "heading", "speed", "activity")


class Crowd(Protocol):
    """What is needed of a bake."""
    frames: int
    agents: int
    fps: float
    origin: numpy.ndarray
    people: numpy.ndarray
    pos: numpy.ndarray
    dir: numpy.ndarray
    state: numpy.ndarray

    def walkable(self, margin: float = 1.0) -> shapely.Polygon: ...


def blocks(bake: Crowd, every: int, rows: numpy.ndarray | None = None, most: int = 200_000) -> Iterator[dict]:
    """{column: values} of those who are there, some frames at a time."""
    if every < 1:
        raise ThrongError(f"every: expected 1 or more, found {every}")
    people = numpy.arange(bake.agents) if rows is None else numpy.asarray(rows)
    together = max(1, most // max(1, len(people)))
    shown = numpy.arange(0, bake.frames, every)
    for first in range(0, len(shown), together):
        frames = shown[first:first + together]
        looked = slice(frames[0], frames[-1] + 1, every)
        state = bake.state[looked][:, people, 0]
        at, who = numpy.nonzero(state > 0.5)
        place = bake.pos[looked][:, people][at, who].astype(float) + bake.origin
        motion = bake.dir[looked][:, people][at, who]
        yield {"frame": frames[at] // every, "seconds": frames[at] / bake.fps, "id": people[who],
               "group": bake.people["group"][people[who]], "x": place[:, 0], "y": place[:, 1], "z": place[:, 2],
               "heading": numpy.arctan2(motion[:, 1], motion[:, 0]), "speed": motion[:, 2],
               "activity": numpy.floor(state[at, who] + 1e-4).astype(int), "ways": motion[:, :2]}


def to_pandas(bake: Crowd, every: int = 1, rows: numpy.ndarray | None = None):
    pandas = need("pandas", "pandas")
    found = list(blocks(bake, every, rows))
    return pandas.DataFrame({name: numpy.concatenate([block[name] for block in found]) for name in COLUMNS})


def to_pedpy(bake: Crowd, every: int = 1, rows: numpy.ndarray | None = None, area: shapely.Polygon | None = None):
    pedpy = need("pedpy", "pedpy")
    table = to_pandas(bake, every, rows)[["id", "frame", "x", "y"]]
    return (pedpy.TrajectoryData(data=table, frame_rate=bake.fps / every),
            pedpy.WalkableArea(bake.walkable() if area is None else area))


def to_csv(bake: Crowd, path: str | os.PathLike, every: int = 1) -> None:
    with whole_file(path) as beside, open(beside, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(COLUMNS)
        for block in blocks(bake, every):
            formats = {"seconds": "{:.4f}", "x": "{:.4f}", "y": "{:.4f}", "z": "{:.4f}", "heading": "{:.4f}",
                       "speed": "{:.4f}"}
            columns = [[formats[name].format(value) for value in block[name]] if name in formats
                       else [_harmless(value) for value in block[name].tolist()] for name in COLUMNS]
            writer.writerows(zip(*columns))


def _harmless(value: int | str) -> int | str:
    """No formula for a spreadsheet, as in agents.csv."""
    return "'" + value if isinstance(value, str) and value[:1] in tuple("=+-@\t\r") else value


# As JuPedSim's own writer makes them, its version 2.
TABLES = """
CREATE TABLE trajectory_data (frame INTEGER NOT NULL, id INTEGER NOT NULL, pos_x REAL NOT NULL, pos_y REAL NOT NULL,
                              ori_x REAL NOT NULL, ori_y REAL NOT NULL);
CREATE TABLE metadata (key TEXT NOT NULL UNIQUE PRIMARY KEY, value TEXT NOT NULL);
CREATE TABLE geometry (hash INTEGER NOT NULL, wkt TEXT NOT NULL);
CREATE UNIQUE INDEX geometry_hash ON geometry (hash);
CREATE TABLE frame_data (frame INTEGER NOT NULL, geometry_hash INTEGER NOT NULL);
"""


def to_jupedsim_sqlite(bake: Crowd, path: str | os.PathLike, every: int = 1,
                       area: shapely.Polygon | None = None) -> None:
    ground = bake.walkable() if area is None else area
    number = int.from_bytes(hashlib.sha256(ground.wkt.encode()).digest()[:7], "little")
    low_x, low_y, high_x, high_y = ground.bounds
    about = {"version": 2, "fps": bake.fps / every, "xmin": low_x, "xmax": high_x, "ymin": low_y, "ymax": high_y}
    with whole_file(path) as beside, contextlib.closing(sqlite3.connect(beside)) as database, database:
        database.executescript(TABLES)
        database.executemany("INSERT INTO metadata VALUES (?, ?)",
                             [(key, str(value)) for key, value in about.items()])
        database.execute("INSERT INTO geometry VALUES (?, ?)", (number, ground.wkt))
        database.executemany("INSERT INTO frame_data VALUES (?, ?)",
                             [(frame, number) for frame in range(len(range(0, bake.frames, every)))])
        for block in blocks(bake, every):
            columns = [block[name].tolist() for name in ("frame", "id", "x", "y")]
            ways = block["ways"].astype(float)
            database.executemany("INSERT INTO trajectory_data VALUES (?, ?, ?, ?, ?, ?)",
                                 zip(*columns, ways[:, 0].tolist(), ways[:, 1].tolist()))
        database.execute("CREATE INDEX frame_id_idx ON trajectory_data (frame, id)")
