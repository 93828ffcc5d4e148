# SPDX-License-Identifier: Apache-2.0
"""Runs the program throng: checks, bakes and batches, with progress, and errors as exceptions."""
from __future__ import annotations

import csv
import json
import os
import pathlib
import shutil
import sqlite3
import subprocess
import tempfile
import threading
from collections.abc import Callable
from typing import Any

from ..base.errors import Diagnostic, InvalidLayout, ProgramError, ThrongError, need
from .bake import Bake

Layout = dict[str, Any] | str | os.PathLike
Progress = Callable[[dict[str, Any]], None]
INVALID, STOPPED = 3, 85
INSIDE = pathlib.Path(__file__).parents[1] / "bin" / "throng"  # in wheels that carry it


def find_program(program: str | os.PathLike | None = None) -> str:
    """The program: as given, that of THRONG_BINARY, the one in this package, or the one on the path."""
    wanted = program or os.environ.get("THRONG_BINARY") or (INSIDE if INSIDE.exists() else "throng")
    found = shutil.which(os.fspath(wanted))
    if not found:
        raise ThrongError(f"the program {os.fspath(wanted)!r} is not there",
                          "set THRONG_BINARY to it, or give program=")
    return found


def _raise(code: int, told: str, heard: str) -> None:
    try:
        error = json.loads(told)["error"]
    except (ValueError, KeyError, TypeError):
        lines = heard.strip().splitlines()
        raise ProgramError(lines[-1] if lines else f"throng ended with {code}", code) from None
    kind = InvalidLayout if code == INVALID else ProgramError
    raise kind(error["message"], code, error.get("hint", ""),
               [Diagnostic.of(each) for each in error.get("diagnostics", [])])


def _run(arguments: list[str], progress: Progress | None, accepted: tuple[int, ...], text: str | None = None) -> str:
    """What the program says on its standard output. JSON lines on the other one go to `progress`; where that raises,
    the program is stopped."""
    with subprocess.Popen(arguments, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                          text=True, encoding="utf-8", errors="replace") as process:
        told: list[str] = []
        reader = threading.Thread(target=lambda: told.append(process.stdout.read()), daemon=True)
        writer = threading.Thread(target=_feed, args=(process.stdin, text or ""), daemon=True)
        reader.start()
        writer.start()
        heard: list[str] = []
        try:
            for line in process.stderr:
                event = _event(line)
                if event is None:
                    heard.append(line)
                elif progress:
                    progress(event)
        except BaseException:
            process.terminate()
            raise
        process.wait()
        reader.join()
        writer.join()
    if process.returncode not in accepted:
        _raise(process.returncode, "".join(told), "".join(heard))
    return "".join(told)


def _feed(pipe, text: str) -> None:
    try:
        with pipe:
            pipe.write(text)
    except BrokenPipeError:  # the program did not want to read it
        pass


def _event(line: str) -> dict[str, Any] | None:
    try:
        event = json.loads(line)
    except ValueError:
        return None
    return event if isinstance(event, dict) else None


def _as_text(layout: Layout) -> tuple[str, str | None]:
    """The argument that stands for a layout, and what to feed to the program's input."""
    if isinstance(layout, dict):
        try:
            return "-", json.dumps(layout, allow_nan=False)
        except (TypeError, ValueError) as error:
            raise ThrongError(f"the layout cannot be written as JSON: {error}") from error
    return os.fspath(layout), None


def check(layout: Layout, program: str | os.PathLike | None = None) -> list[Diagnostic]:
    """Everything that is wrong with a layout, or nothing."""
    name, text = _as_text(layout)
    told = json.loads(_run([find_program(program), "check", "--json", "--", name], None, (0, INVALID), text))
    return [Diagnostic.of(each) for file in told for each in file["diagnostics"]]


def bake(layout: Layout, output: str | os.PathLike, *, progress: Progress | None = None, force: bool = False,
         settings: dict[str, Any] | None = None, gltf: bool = False, options: tuple[str, ...] = (),
         program: str | os.PathLike | None = None) -> Bake:
    """Bakes a layout (a dict, or a file) into a folder. `progress` is called with {"progress": percent, "frame": ...};
    `settings` override values of the layout ({"simulation.seed": 7}); `options` go to `throng bake` as they are."""
    name, text = _as_text(layout)
    if not isinstance(settings or {}, dict):
        raise ThrongError("settings: expected a dict")
    arguments = [find_program(program), "bake", "--json", "-o", os.fspath(output), *options]
    arguments += ["--force"] if force else []
    arguments += [] if gltf else ["--no-gltf"]
    for key, value in (settings or {}).items():
        arguments += ["--set", f"{key}={json.dumps(value)}"]
    _run([*arguments, "--", name], progress, (0,), text)
    return Bake(output)


def measure(baked: Bake | str | os.PathLike, program: str | os.PathLike | None = None) -> dict[str, Any]:
    """What `throng measure` says of a bake, with the bars that were missed."""
    folder = baked.folder if isinstance(baked, Bake) else baked
    return json.loads(_run([find_program(program), "measure", "--json", "--", os.fspath(folder)], None, (0, 1)))


class Batch:
    """A batch's folder."""

    def __init__(self, folder: str | os.PathLike):
        self.folder = pathlib.Path(folder)
        if not (self.folder / "results.sqlite").is_file():
            raise ThrongError(f"{self.folder / 'results.sqlite'} is not there", "`throng batch` makes it")

    def rows(self) -> list[dict[str, Any]]:
        """What came of each scenario, with its parameters (docs: the view `results`)."""
        database = sqlite3.connect(f"{(self.folder / 'results.sqlite').absolute().as_uri()}?mode=ro", uri=True)
        try:
            asked = database.execute("SELECT * FROM results ORDER BY number")
            names = [column[0] for column in asked.description]
            return [dict(zip(names, row)) for row in asked]
        except sqlite3.Error as error:
            raise ThrongError(f"{self.folder / 'results.sqlite'} cannot be read: {error}") from error
        finally:
            database.close()

    def table(self):
        """The rows as a data frame (needs pandas)."""
        return need("pandas", "pandas").DataFrame(self.rows()).set_index("id")

    def bake(self, scenario: str) -> Bake:
        """The bake of a scenario, where the family keeps them."""
        return Bake(self.folder / "bakes" / scenario)

    def to_csv(self, path: str | os.PathLike) -> None:
        rows = self.rows()
        with open(path, "w", newline="", encoding="utf-8") as file:
            writer = csv.DictWriter(file, fieldnames=list(rows[0]) if rows else ["id"])
            writer.writeheader()
            writer.writerows(rows)


def batch(family: Layout, output: str | os.PathLike, *, progress: Progress | None = None, workers: int | None = None,
          options: tuple[str, ...] = (), program: str | os.PathLike | None = None) -> Batch:
    """Bakes and measures a family of scenarios (a dict, or a file). Scenarios that fail have their reason in their
    row."""
    found = find_program(program)
    arguments = [found, "batch", "--json", "-o", os.fspath(output), *options]
    arguments += ["--workers", str(workers)] if workers else []
    if not isinstance(family, dict):
        _run([*arguments, os.fspath(family)], progress, (0, 1))
        return Batch(output)
    # Families are read from files: paths in them start at the working folder.
    with tempfile.NamedTemporaryFile("w", suffix=".json", prefix=".throng-family-", dir=os.getcwd(),
                                     encoding="utf-8") as file:
        json.dump(family, file, allow_nan=False)
        file.flush()
        _run([*arguments, file.name], progress, (0, 1))
    return Batch(output)
