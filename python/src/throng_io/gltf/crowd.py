# SPDX-License-Identifier: Apache-2.0
"""A bake as one glTF file: people with skeletons and one animation, others as instances that stand still, and what they
walk on."""
from __future__ import annotations

import dataclasses
import os
import pathlib

import numpy

from ..bakes.bake import Bake
from ..bakes.surroundings import things_of
from ..base.errors import ThrongError
from ..base.whole_files import whole_file
from ..skinned.carried import bent
from ..skinned.members import LEVELS
from ..skinned.motions import joints_of, track_of
from ..skinned.shot import Shot, Wanted
from . import axes, meshopt
from .document import Document
from .figures import Figure
from .instances import Instances
from .meshes import Meshes
from .moves import Moves, beside_those_above
from .moving import MovingThings

SUFFIX = ".glb"
MOST_BYTES = 100_000_000     # of a file, where nobody says how many people are wanted
BYTES_OF_JSON = 9_000        # a person, about


@dataclasses.dataclass(frozen=True)
class Form:
    """How it is written."""
    levels: tuple[str, ...] = LEVELS[:1]  # of detail; where there are several, the first one is shown
    quantize: bool = False
    compress: bool = False

    def check(self) -> None:
        for level in self.levels:
            if level not in LEVELS:
                raise ThrongError(f"level: expected one of {', '.join(LEVELS)}, found {level!r}")
        if self.compress:
            meshopt.check()

    @property
    def numbers(self) -> tuple[int, ...]:
        return tuple(sorted({LEVELS.index(level) for level in self.levels}))


@dataclasses.dataclass(frozen=True)
class Written:
    people: int      # with skeletons
    instances: int   # who stand still
    left_out: int    # others who are ever there


def export_gltf(bake: Bake, path: str | os.PathLike, wanted: Wanted = Wanted(), form: Form = Form(),
                others: bool = False, ground: bool = True) -> Written:
    """@param others whoever has no skeleton is an instance of a mesh, as in the first frame"""
    if pathlib.Path(path).suffix.lower() != SUFFIX:
        raise ThrongError(f"{os.fspath(path)}: expected a name that ends in {SUFFIX}")
    form.check()
    crowd = Crowd(Shot(bake, wanted), form)
    if ground:
        crowd.surroundings()
    people = crowd.people(capped=wanted.most is None)
    stand = crowd.others() if others else 0
    with whole_file(path) as beside:
        crowd.finish(beside)
    return Written(people, stand, len(crowd.shot.nearest) - people - stand)


def write_surroundings(path: str | os.PathLike, shot: Shot, form: Form = Form()) -> None:
    """All that is not a person, in a file of its own."""
    around = Crowd(shot, form)
    around.surroundings()
    around.finish(path)


class Crowd:
    def __init__(self, shot: Shot, form: Form):
        self.shot, self.form = shot, form
        self.to = Document(form.compress)
        self.meshes = Meshes(self.to, form.quantize)
        self.moves = Moves(self.to, form.quantize)
        self.figures: dict[int, Figure] = {}
        self.spans: dict[bytes, int] = {}
        self.written: set[int] = set()

    def surroundings(self) -> None:
        """What stands there, and what moves besides people."""
        for thing in things_of(self.shot.bake):
            kind = thing.place.partition("/")[2].rstrip("0123456789")
            mesh = self.meshes.solid(thing.place, thing.points, thing.faces, kind, thing.colour)
            self.to.root(name=thing.name or thing.place.rpartition("/")[2], mesh=mesh)
        MovingThings(self.meshes, self.moves, self.shot).write()

    # ---- people

    def people(self, capped: bool) -> int:
        """How many are written: where they are capped, as many as a file of MOST_BYTES holds."""
        wanted = set(self.shot.rows)
        order = [row for row in self.shot.nearest if row in wanted]
        for first in range(0, len(order), 64):
            some = order[first:first + 64]
            streams = self.shot.streams(some)
            for place, row in enumerate(some):
                if capped and self.to.size + BYTES_OF_JSON * len(self.written) > MOST_BYTES:
                    return len(self.written)
                self._person(row, {name: each[:, place] for name, each in streams.items()})
                self.written.add(row)
        return len(self.written)

    def _figure(self, number: int) -> Figure:
        if number not in self.figures:
            self.figures[number] = Figure(self.meshes, number, self.shot.member(number), self.form.numbers)
        return self.figures[number]

    def _person(self, row: int, streams: dict[str, numpy.ndarray]) -> None:
        """A node that goes where the person goes, with the joints in it, and beside it the mesh that hangs on them."""
        number, name = self.shot.member_of[row], f"person {row:05d}"
        figure, there = self._figure(number), self.shot.there[:, row]
        nodes, tops = figure.skeleton()
        root = self.to.root(name=name, children=tops, extras={
            "row": row, "member": number, "group": str(self.shot.bake.people["group"][row])})
        figure.shown_by(f"{name} body", figure.skin(nodes, root), self.shot.tint(row))
        shown = {key: each[there] for key, each in streams.items()}
        times = self._times(there)
        self._goes(root, row, times, shown)
        self._is_there(root, there, float(self.shot.sizes[row]))
        member = figure.member
        track = track_of(row, self.shot.frames[there] + 1, shown, float(self.shot.sizes[row]),
                         self.shot.ground)
        joints = joints_of(bent(member, self.shot.repertoire, track), member.places, member.parents)
        self.moves.joints(nodes, beside_those_above(member.places, member.parents), times, joints)

    def _times(self, there: numpy.ndarray) -> int:
        """Whoever is there in the same frames has the same times."""
        key = there.tobytes()
        if key not in self.spans:
            self.spans[key] = self.moves.times(self.shot.seconds[there])
        return self.spans[key]

    def _goes(self, root: int, row: int, times: int, streams: dict[str, numpy.ndarray]) -> None:
        headings = numpy.unwrap(numpy.arctan2(streams["dir"][:, 1], streams["dir"][:, 0]))
        self.moves.move(root, "translation", times, self.moves.places([axes.world(streams["pos"])])[0])
        self.moves.move(root, "rotation", times, self.moves.turns([axes.facing(headings)])[0])

    def _is_there(self, root: int, there: numpy.ndarray, size: float) -> None:
        """Who is not there has no size."""
        if size != 1.0:
            self.to.lists["nodes"][root]["scale"] = [size] * 3
        if there.all():
            return
        changes = numpy.nonzero(numpy.diff(there, prepend=~there[:1]))[0]
        sizes = numpy.where(there[changes], size, 0.0)[:, None].repeat(3, axis=1)
        times = self.moves.times(self.shot.seconds[changes])
        self.moves.move(root, "scale", times, self.moves.places([sizes])[0], "STEP")

    # ---- others

    def others(self) -> int:
        """Whoever is there in the first frame and not written yet."""
        rows = [row for row in numpy.nonzero(self.shot.there[0])[0].tolist() if row not in self.written]
        Instances(self.meshes, self.shot).write(rows)
        return len(rows)

    def finish(self, path: str | os.PathLike) -> None:
        shot = self.shot
        self.moves.write("crowd", {"fps": shot.bake.fps / shot.every, "first_frame": int(shot.frames[0])})
        self.to.extras = {"bake": shot.bake.name, "origin": shot.bake.origin.tolist()}
        self.to.write(path)
