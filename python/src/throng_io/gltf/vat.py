# SPDX-License-Identifier: Apache-2.0
"""Vertex animation textures: for engines that draw crowds as instances and bend them as they draw. Of each member a
mesh, and of each of its clips where its vertices are and how they look, a row (or some) of a texture for each key."""
from __future__ import annotations

import dataclasses
import os
import pathlib

import numpy

from ..bakes.bake import Bake
from ..base.errors import ThrongError
from ..base.whole_files import whole_folder
from ..skinned.clips import Clip, poses_of_clip
from ..skinned.members import LEVELS, Member
from ..skinned.posed import posed
from ..skinned.shot import Shot, Wanted
from . import axes, textures
from .crowd import write_surroundings
from .document import Document
from .kit import SURROUNDINGS, top_of, write_table
from .meshes import ALL16, Meshes, Shaped, shaped

WIDEST = 4096        # columns of a texture
LOOKS = numpy.array([1.0, 1.0, 1.0])


@dataclasses.dataclass(frozen=True)
class Written:
    people: int
    members: int
    textures: int


@dataclasses.dataclass(frozen=True)
class Layout:
    """Where in a texture vertices are."""
    vertices: int

    @property
    def width(self) -> int:
        return min(self.vertices, WIDEST)

    @property
    def rows(self) -> int:
        """Of a key."""
        return -(-self.vertices // WIDEST)

    def places(self) -> numpy.ndarray:
        """V x 2: middles of their pixels; of all columns, and of all rows of a key."""
        number = numpy.arange(self.vertices)
        return numpy.stack([(number % self.width + 0.5) / self.width, (number // self.width + 0.5) / self.rows], axis=1)

    def picture(self, values: numpy.ndarray) -> numpy.ndarray:
        """(K * rows) x width x 3 of K x V x 3; what is left of the last row of a key is 0."""
        keys = len(values)
        whole = numpy.zeros((keys, self.rows * self.width, 3))
        whole[:, :self.vertices] = values
        return whole.reshape(keys * self.rows, self.width, 3)


def export_vat(bake: Bake, folder: str | os.PathLike, wanted: Wanted = Wanted(), level: str = LEVELS[-1],
               texture: str = "float", ground: bool = True) -> Written:
    """The folder must not be there yet. @param texture one of textures.KINDS; @param ground with what people walk
    among, in a file of its own"""
    textures.check(texture)
    if level not in LEVELS:
        raise ThrongError(f"level: expected one of {', '.join(LEVELS)}, found {level!r}")
    shot = Shot(bake, wanted)
    clips, numbers = shot.clips, shot.members
    with whole_folder(folder) as beside:
        told = {}
        for number in numbers:
            told[number] = Animated(shot, number, LEVELS.index(level)).write(beside, clips, texture)
        if ground:
            write_surroundings(beside / SURROUNDINGS, shot)
        write_table(beside, shot, clips, {number: f"member{number:02d}.glb" for number in numbers},
                    textures={"kind": texture, "members": told})
    return Written(len(shot.rows), len(numbers), 2 * len(numbers) * len(clips))


class Animated:
    """A member as one mesh, in all of its clips."""

    def __init__(self, shot: Shot, number: int, level: int):
        self.shot, self.number, self.name = shot, number, f"member{number:02d}"
        self.member: Member = shot.member(number)
        self.parts = {name: part for name, part in self.member.levels[level].items() if len(part.faces)}
        self.rest = {name: shaped(part) for name, part in self.parts.items()}
        self.layout = Layout(sum(len(part.points) for part in self.rest.values()))

    def write(self, folder: pathlib.Path, clips: list[Clip], texture: str) -> dict:
        """What is told of it in crowd.json."""
        self._mesh(folder / f"{self.name}.glb")
        bent = {clip.name: self._bent(clip) for clip in clips}
        low = numpy.min([places.min(axis=(0, 1)) for places, _ in bent.values()], axis=0).astype(numpy.float32)
        high = numpy.max([places.max(axis=(0, 1)) for places, _ in bent.values()], axis=0).astype(numpy.float32)
        files = {}
        for name, (places, looks) in bent.items():
            files[name] = {kind: f"{self.name}_{name}_{kind}{textures.KINDS[texture]}"
                           for kind in ("position", "normal")}
            textures.write(folder / files[name]["position"], self.layout.picture(places), texture, low, high)
            textures.write(folder / files[name]["normal"], self.layout.picture(looks), texture, -LOOKS, LOOKS)
        return {"vertices": self.layout.vertices, "width": self.layout.width, "rows": self.layout.rows,
                "low": low.tolist(), "high": high.tolist(), "clips": files}

    def _bent(self, clip: Clip) -> tuple[numpy.ndarray, numpy.ndarray]:
        """(places, looks), K x V x 3 each, in the file's axes."""
        poses = poses_of_clip(clip, self.member.poses, self.shot.repertoire)
        places, looks = [], []
        for name, part in self.parts.items():
            order = self.rest[name].of
            bent = posed(part.points, part.normals, part.joints, part.weights, poses)
            places.append(axes.own(bent[0])[:, order])
            looks.append(axes.own(bent[1])[:, order])
        return numpy.concatenate(places, axis=1), numpy.concatenate(looks, axis=1)

    def _mesh(self, path: pathlib.Path) -> None:
        """At rest; TEXCOORD_1 tells where in textures its vertices are, COLOR_0 has no opacity where tops show."""
        document = Document()
        meshes = Meshes(document)
        whole = self._whole()
        places = document.vertices(self.layout.places().astype(numpy.float32))
        attributes = meshes.attributes(whole, None, hung=False) | {
            "COLOR_0": document.vertices(self._colours(), normalized=True), "TEXCOORD_0": places, "TEXCOORD_1": places}
        mesh = document.add("meshes", name=self.name, primitives=[{
            "attributes": attributes, "indices": document.indices(whole.faces),
            "material": meshes.material("dressed")}])
        document.root(name=self.name, mesh=mesh)
        document.extras = {"member": self.number}
        document.write(path)

    def _whole(self) -> Shaped:
        parts = list(self.rest.values())
        firsts = numpy.cumsum([0] + [len(part.points) for part in parts])
        joined = [numpy.concatenate([getattr(part, name) for part in parts])
                  for name in ("points", "normals", "joints", "weights")]
        faces = numpy.concatenate([part.faces + first for part, first in zip(parts, firsts)])
        return Shaped(*joined, numpy.zeros((0, 3)), faces, numpy.arange(firsts[-1]))

    def _colours(self) -> numpy.ndarray:
        top = top_of(self.member, self.number)
        found = [numpy.concatenate([part.colours, numpy.ones((len(part.colours), 1))], axis=1) if len(part.colours)
                 else numpy.tile([*top, 0.0], (len(part.points), 1)) for part in self.rest.values()]
        return numpy.rint(numpy.concatenate(found) * ALL16).astype(numpy.uint16)
