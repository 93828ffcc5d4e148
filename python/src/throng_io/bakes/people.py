# SPDX-License-Identifier: Apache-2.0
"""The table of a bake: a row for each person."""
from __future__ import annotations

import csv
import pathlib

import numpy

from ..base.errors import BakeError

# Columns of agents.csv; those that a bake has besides are read as texts.
COLUMNS = {
    "id": "i8", "group": "U", "kind": "U", "radius": "f4", "preferred_speed": "f4", "variation": "i4", "party": "i8",
    "spawn_frame": "i8", "arrival_frame": "i8", "outcome": "U", "reason": "U", "goal_x": "f8", "goal_y": "f8",
    "distance_walked": "f4", "shortest_way": "f4", "profile": "U", "look": "U",
    "colours": "U", "scale": "f4",
}
NOBODY = {"i": -1, "f": numpy.nan}  # what an empty cell stands for


def _plain(text: str) -> str:
    """Texts that spreadsheets would take for formulas have an apostrophe before them."""
    return text[1:] if len(text) > 1 and text[0] == "'" and text[1] in "=+-@\t\r" else text


def _column(texts: list[str], kind: str, name: str, path: pathlib.Path) -> numpy.ndarray:
    if kind == "U":
        return numpy.array([_plain(text) for text in texts], dtype=str)
    values = numpy.full(len(texts), NOBODY[kind[0]], dtype=kind)
    for row, text in enumerate(texts):
        if text:
            try:
                values[row] = float(text) if kind[0] == "f" else int(text)
            except ValueError:
                raise BakeError(f"{path}:{row + 2}: {name}: expected a number, found {text!r}") from None
    return values


def read_people(path: pathlib.Path) -> numpy.ndarray:
    """A structured array: people["group"], people[3]["radius"]. Frames count from 0; -1 and NaN say that there is
    none."""
    try:
        with open(path, newline="", encoding="utf-8") as file:
            header, *rows = list(csv.reader(file))
    except (OSError, ValueError, csv.Error) as error:
        raise BakeError(f"{path} cannot be read: {error}") from error
    wrong = next((number for number, row in enumerate(rows, 2) if len(row) != len(header)), None)
    if wrong:
        raise BakeError(f"{path}:{wrong}: expected {len(header)} values")
    columns = {name: _column([row[place] for row in rows], COLUMNS.get(name, "U"), name, path)
               for place, name in enumerate(header)}
    table = numpy.empty(len(rows), dtype=[(name, values.dtype) for name, values in columns.items()])
    for name, values in columns.items():
        table[name] = values
    return table
