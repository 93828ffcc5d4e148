# SPDX-License-Identifier: Apache-2.0
"""Which importer reads a file: by its name, and by what is in it."""
from __future__ import annotations

import dataclasses
import pathlib
from collections.abc import Callable

from ..base.errors import ImportFailed
from . import jupedsim, menge, steersuite, umans, vadere
from .files import read_json, read_xml, tag
from .report import Report
from .scene import Scene

XML = {menge.ROOT: menge.read, steersuite.ROOT: steersuite.read, umans.ROOT: umans.read}


@dataclasses.dataclass(frozen=True)
class Imported:
    layout: dict
    report: Report


def _xml(path: pathlib.Path) -> Callable:
    root = read_xml(path)
    if tag(root) not in XML:
        raise ImportFailed(f"no scene that is known: its root is <{tag(root)}>", str(path), root.sourceline,
                           hint=f"known are {', '.join(f'<{name}>' for name in XML)}")
    return XML[tag(root)]


def _json(path: pathlib.Path) -> Callable:
    if vadere.is_one(read_json(path)):
        return vadere.read
    raise ImportFailed("no scene that is known", str(path))


BY_NAME: dict[str, Callable] = {".wkt": jupedsim.read_wkt, ".sqlite": jupedsim.read_sqlite, ".scenario": vadere.read}
BY_CONTENT: dict[str, Callable] = {".xml": _xml, ".json": _json}


def read_scene(file: str | pathlib.Path, name: str | None = None) -> Imported:
    """A file of another program as a layout, with a report."""
    path = pathlib.Path(file)
    suffix = path.suffix.lower()
    if suffix not in BY_NAME and suffix not in BY_CONTENT:
        raise ImportFailed(f"files that end in {suffix or 'nothing'} are not known", str(path),
                           hint=f"known are {', '.join(sorted([*BY_NAME, *BY_CONTENT]))}")
    read = BY_NAME.get(suffix) or BY_CONTENT[suffix](path)
    scene = Scene(name or path.stem, Report(str(path)))
    read(path, scene)
    if not (scene.walls or scene.areas or scene.roads or scene.flows or scene.formations):
        raise ImportFailed("has nothing that a layout can hold", str(path), hint=str(scene.report))
    return Imported(scene.layout(), scene.report)
