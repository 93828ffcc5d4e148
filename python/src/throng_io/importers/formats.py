# SPDX-License-Identifier: Apache-2.0
"""Which importer reads a file: by its name, and by what is in it."""
from __future__ import annotations

import dataclasses
import pathlib
from collections.abc import Callable

from ..base.errors import ImportFailed
from . import dxf, geojson, jupedsim, menge, osm, steersuite, svg, umans, vadere
from .files import read_json, read_xml, tag
from .options import Options
from .report import Report
from .scene import Scene
from .visitors import add_people

Read = Callable[[pathlib.Path, Scene, Options], None]


@dataclasses.dataclass(frozen=True)
class Imported:
    layout: dict
    report: Report


def _scene_only(read: Callable[[pathlib.Path, Scene], None]) -> Read:
    """Scenes say everything themselves."""
    return lambda path, scene, options: read(path, scene)


XML: dict[str, Read] = {menge.ROOT: _scene_only(menge.read), steersuite.ROOT: _scene_only(steersuite.read),
                        umans.ROOT: _scene_only(umans.read), osm.ROOT: osm.read, svg.ROOT: svg.read}


def _xml(path: pathlib.Path) -> Read:
    root = read_xml(path)
    if tag(root) not in XML:
        raise ImportFailed(f"no scene that is known: its root is <{tag(root)}>", str(path), root.sourceline,
                           hint=f"known are {', '.join(f'<{name}>' for name in XML)}")
    return XML[tag(root)]


def _json(path: pathlib.Path) -> Read:
    found = read_json(path)
    if vadere.is_one(found):
        return _scene_only(vadere.read)
    if geojson.is_one(found):
        return geojson.read
    raise ImportFailed("no scene that is known", str(path), hint="known are GeoJSON and Vadere's scenarios")


BY_NAME: dict[str, Read] = {".wkt": _scene_only(jupedsim.read_wkt), ".sqlite": _scene_only(jupedsim.read_sqlite),
                            ".scenario": _scene_only(vadere.read), ".geojson": geojson.read, ".osm": osm.read,
                            ".svg": svg.read, ".dxf": dxf.read}
BY_CONTENT: dict[str, Callable[[pathlib.Path], Read]] = {".xml": _xml, ".json": _json}


def read_scene(file: str | pathlib.Path, options: Options = Options()) -> Imported:
    """A file of another program as a layout, with a report."""
    path = pathlib.Path(file)
    suffix = path.suffix.lower()
    if suffix not in BY_NAME and suffix not in BY_CONTENT:
        raise ImportFailed(f"files that end in {suffix or 'nothing'} are not known", str(path),
                           hint=f"known are {', '.join(sorted([*BY_NAME, *BY_CONTENT]))}")
    read = BY_NAME.get(suffix) or BY_CONTENT[suffix](path)
    scene = Scene(path.stem, Report(str(path)))
    read(path, scene, options)
    if not (scene.walls or scene.areas or scene.roads or scene.flows or scene.formations):
        raise ImportFailed("has nothing that a layout can hold", str(path), hint=str(scene.report))
    add_people(scene, options.people)
    return Imported(scene.layout(), scene.report)
