# SPDX-License-Identifier: Apache-2.0
"""A bake: its streams as views of the files, its people as a table, its ground as geometry."""
from __future__ import annotations

import enum
import functools
import json
import os
import pathlib
from typing import Any

import numpy
import shapely

from ..base import geometry
from ..base.errors import BakeError, need
from . import diagrams, exports
from .people import read_people
from .streams import Frames, form_of, open_stream

FORMAT, VERSION = "throng bake", 1


class Activity(enum.IntEnum):
    """What somebody does."""
    AWAY = 0      # not yet there, or not any more
    WALKING = 1
    STANDING = 2  # at the goal or at a stop
    LOOKING = 3
    QUEUING = 4
    SITTING = 5
    READYING = 6  # its hands, to clap in its seat
    CLAPPING = 7
    RISING = 8
    CHEERING = 9
    SINGING = 10
    SETTLING = 11  # in its seat, or getting up from it
    RAISING = 12   # its hands, on its feet, as what follows
    APPLAUDING = 13
    JUBILATING = 14
    SWAYING = 15
    WAVING = 16


class Bake:
    """A bake's folder. Streams are memory maps of its files: nothing is copied until numbers are asked for. Packed ones
    are unpacked then."""

    def __init__(self, folder: str | os.PathLike):
        self.folder = pathlib.Path(folder)
        self.about: dict[str, Any] = _manifest(self.folder)
        self.name: str = self.about["name"]
        self.fps: float = self.about["fps"]
        self.frames: int = self.about["frames"]
        self.agents: int = self.about["agents"]
        #: World position = origin + position of a stream.
        self.origin = numpy.array(self.about["origin"], dtype=float)
        self._opened: dict[str, numpy.ndarray] = {}
        self._readers: dict[str, Frames] = {}

    def __repr__(self) -> str:
        return f"Bake({str(self.folder)!r}: {self.agents} people, {self.frames} frames at {self.fps:g} fps)"

    # ---- streams

    @property
    def streams(self) -> list[str]:
        return list(self.about["streams"])

    def stream(self, name: str) -> numpy.ndarray:
        """Frames x people x components, float32, read-only: a view of the file, or all of a packed one, unpacked (in
        a temporary file where it is large; `read` unpacks some frames)."""
        if name not in self._opened:
            self._opened[name] = self._open(name)
        return self._opened[name]

    def read(self, name: str, first: int, last: int) -> numpy.ndarray:
        """Frames [first, last) of a stream, a copy: of a packed one, no more is unpacked."""
        if name in self._opened:
            return numpy.array(self._opened[name][first:last])
        if name not in self._readers:
            self._readers[name] = Frames(*self._file_of(name))
        return self._readers[name].read(first, last)

    def _open(self, name: str) -> numpy.ndarray:
        return open_stream(*self._file_of(name))

    def _file_of(self, name: str) -> tuple[pathlib.Path, str, tuple[int, int, int]]:
        """Path, form and shape."""
        told = self.about["streams"].get(name)
        if told is None:
            raise BakeError(f"{self.folder} has no stream {name!r}", f"it has {', '.join(self.streams)}")
        form = form_of(told)
        if form is None:
            raise BakeError(f"{self.folder} has no form of the stream {name!r} that this version reads",
                            "`throng convert` writes it in others")
        return _inside(self.folder, told[form]), form, (self.frames, self.agents, len(told["components"]))

    def component(self, name: str) -> numpy.ndarray:
        """Frames x people: a view of one number by its name, "speed", or "density.area" with its stream."""
        stream, _, component = name.rpartition(".")
        for candidate in [stream] if stream else self.streams:
            components = self.about["streams"].get(candidate, {}).get("components", [])
            if component in components:
                return self.stream(candidate)[:, :, components.index(component)]
        raise BakeError(f"{self.folder} has no component {name!r}")

    @property
    def pos(self) -> numpy.ndarray:
        """Where everybody is (x, y, z), m, from `origin`."""
        return self.stream("pos")

    @property
    def dir(self) -> numpy.ndarray:
        """Cosine and sine of the heading, speed in m/s."""
        return self.stream("dir")

    @property
    def state(self) -> numpy.ndarray:
        """Activity (with the gait in its fraction), variation, gait phase."""
        return self.stream("state")

    def world(self, frames: slice | int = slice(None), people: slice | numpy.ndarray = slice(None)) -> numpy.ndarray:
        """World positions in double precision: a copy of what is asked for."""
        return self.pos[frames, people].astype(float) + self.origin

    # ---- states by name

    def activity(self, frames: slice | int = slice(None)) -> numpy.ndarray:
        """What everybody does (`Activity`), as small whole numbers."""
        return numpy.floor(self.state[frames, ..., 0] + 1e-4).astype(numpy.int8)

    def there(self, frames: slice | int = slice(None)) -> numpy.ndarray:
        """Who is in the scene."""
        return self.state[frames, ..., 0] > 0.5

    def doing(self, activity: Activity | str, frames: slice | int = slice(None)) -> numpy.ndarray:
        """Who does something: bake.doing("queuing")."""
        wanted = Activity[activity.upper()] if isinstance(activity, str) else activity
        return self.activity(frames) == int(wanted)

    # ---- times

    @property
    def times(self) -> numpy.ndarray:
        """Seconds from the first frame, of each frame."""
        return numpy.arange(self.frames) / self.fps

    def frame_at(self, seconds: float) -> int:
        return int(numpy.clip(round(seconds * self.fps), 0, self.frames - 1))

    # ---- diagram images

    @property
    def storeys(self) -> list[str]:
        """What there are diagram images of: floors, links, lifts; none where nobody walks above anybody."""
        return diagrams.names(self.about)

    def diagram(self, frame: int, storey: str | None = None) -> diagrams.Diagram:
        """Whose ground is whose in a frame that has an image, of all, or of one of `storeys`."""
        return diagrams.read(self.about, self.folder, frame, storey)

    # ---- people

    @functools.cached_property
    def people(self) -> numpy.ndarray:
        """A structured array, a row for each person (docs: agents.csv)."""
        table = read_people(_inside(self.folder, self.about.get("table", "agents.csv")))
        if len(table) != self.agents:
            raise BakeError(f"{self.folder}: agents.csv has {len(table)} rows, expected {self.agents}")
        return table

    @functools.cached_property
    def groups(self) -> dict[str, numpy.ndarray]:
        """{flow or formation: rows of its people}."""
        names, place = numpy.unique(self.people["group"], return_inverse=True)
        return {str(name): numpy.nonzero(place == number)[0] for number, name in enumerate(names)}

    @property
    def account(self) -> dict[str, Any]:
        """What became of everybody."""
        return self.about["account"]

    def table(self):
        """The people as a data frame (needs pandas)."""
        pandas = need("pandas", "pandas")
        return pandas.DataFrame({name: self.people[name] for name in self.people.dtype.names}).set_index("id")

    # ---- ground

    @functools.cached_property
    def layout(self) -> dict[str, Any]:
        return _read_json(_inside(self.folder, self.about["layout"]["file"]))

    @functools.cached_property
    def walls(self) -> dict[str, shapely.Geometry]:
        """{id: the ground it covers}, in world coordinates."""
        return geometry.named(self.about["geometry"]["walls"], "wall", geometry.wall_shape)

    @functools.cached_property
    def roads(self) -> dict[str, shapely.Geometry]:
        return geometry.named(self.about["geometry"]["roads"], "road", geometry.road_shape)

    @functools.cached_property
    def areas(self) -> dict[str, shapely.Geometry]:
        return geometry.named(self.about["geometry"]["areas"], "area", geometry.area_shape)

    def walkable(self, margin: float = 1.0) -> shapely.Polygon:
        """Where people can be: the box of all that they walked, wider by the margin, without the walls; of several
        pieces, that with most of the people."""
        there = self.there()
        places = self.pos[:, :, :2][there].astype(float) + self.origin[:2]
        if not len(places):
            raise BakeError(f"nobody is ever there in {self.folder}")
        low, high = places.min(axis=0) - margin, places.max(axis=0) + margin
        reach = shapely.union_all([shapely.box(*low, *high), *self.roads.values()])
        return geometry.piece_with(geometry.walkable_ground(self.walls.values(), reach), places)

    # ---- to other programs

    def to_pedpy(self, every: int = 1, rows: numpy.ndarray | None = None, area: shapely.Polygon | None = None):
        """(pedpy.TrajectoryData, pedpy.WalkableArea): every N-th frame, of all people or of some rows."""
        return exports.to_pedpy(self, every, rows, area)

    def to_jupedsim_sqlite(self, path: str | os.PathLike, every: int = 1, area: shapely.Polygon | None = None) -> None:
        """A trajectory file as JuPedSim writes them (its version 2)."""
        exports.to_jupedsim_sqlite(self, path, every, area)

    def to_csv(self, path: str | os.PathLike, every: int = 1) -> None:
        """A line for each person and frame in which it is there."""
        exports.to_csv(self, path, every)

    def to_pandas(self, every: int = 1):
        """A row for each person and frame in which it is there (needs pandas)."""
        return exports.to_pandas(self, every)


def _inside(folder: pathlib.Path, name: str) -> pathlib.Path:
    """A file of the bake; others are none of its business."""
    path = pathlib.PurePosixPath(str(name))
    if path.is_absolute() or ".." in path.parts:
        raise BakeError(f"{folder}: bake.json names a file outside the bake: {name!r}")
    return folder / path


def _read_json(path: pathlib.Path) -> dict[str, Any]:
    try:
        found = json.loads(path.read_text(encoding="utf-8"))
    except FileNotFoundError as error:
        raise BakeError(f"{path} is not there", "a bake is a folder that `throng bake` made") from error
    except (OSError, ValueError, RecursionError) as error:
        raise BakeError(f"{path} cannot be read: {error}") from error
    if not isinstance(found, dict):
        raise BakeError(f"{path}: expected an object")
    return found


def _manifest(folder: pathlib.Path) -> dict[str, Any]:
    about = _read_json(folder / "bake.json")
    if about.get("format") != FORMAT:
        raise BakeError(f"{folder / 'bake.json'}: expected the format {FORMAT!r}, found {about.get('format')!r}")
    if about.get("version") != VERSION:
        raise BakeError(f"{folder / 'bake.json'}: version {about.get('version')} is not known, only {VERSION}")
    expected = {"name": str, "fps": (int, float), "frames": int, "agents": int, "streams": dict, "origin": list,
                "geometry": dict, "account": dict}
    for key, kind in expected.items():
        if not isinstance(about.get(key), kind):
            raise BakeError(f"{folder / 'bake.json'}: /{key}: not there, or of another kind than expected")
    return about
