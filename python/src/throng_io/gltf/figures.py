# SPDX-License-Identifier: Apache-2.0
"""A member of the cast in a glTF file: meshes at levels of detail, shared by all who are that member, and skeletons."""
from __future__ import annotations

import functools

import numpy

from ..skinned.members import Member
from . import axes
from .meshes import Box, Colour, Meshes, shaped
from .moves import beside_those_above

LOD = "MSFT_lod"


class Figure:
    def __init__(self, meshes: Meshes, number: int, member: Member, levels: tuple[int, ...]):
        """@param number of the member in the cast; @param levels numbers of members.LEVELS, the finest first"""
        self.meshes, self.to = meshes, meshes.to
        self.name, self.member, self.levels = f"member{number:02d}", member, levels
        self.parts = {level: {name: shaped(part) for name, part in member.levels[level].items() if len(part.faces)}
                      for level in levels}
        every = [part.points for parts in self.parts.values() for part in parts.values()]
        self.box = Box.round(every) if meshes.quantize else None
        self.attributes: dict[int, dict[str, dict]] = {}
        self.shown: dict[tuple[int, Colour], int] = {}

    def mesh(self, level: int, tint: Colour) -> int:
        """With the top in a colour: of each colour a mesh, whose points are the same."""
        key = (level, tint)
        if key not in self.shown:
            materials = {"dressed": self.meshes.material("dressed"), "tinted": self.meshes.material("top", tint)}
            primitives = [{**told, "material": materials[part]} for part, told in self._primitives(level).items()]
            self.shown[key] = self.to.add("meshes", name=f"{self.name}_LOD{level}", primitives=primitives)
        return self.shown[key]

    def _primitives(self, level: int) -> dict[str, dict]:
        if level not in self.attributes:
            self.attributes[level] = {name: {"attributes": self.meshes.attributes(part, self.box),
                                             "indices": self.to.indices(part.faces)}
                                      for name, part in self.parts[level].items()}
        return self.attributes[level]

    @functools.cached_property
    def binds(self) -> int:
        """The accessor of inverse bind matrices; they also undo the box of quantized points."""
        whole = numpy.tile(numpy.eye(4), (len(self.member.places), 1, 1))
        whole[:, :3, 3] = -axes.own(self.member.places)
        if self.box:
            whole = whole @ self.box.matrix()
        by_columns = numpy.swapaxes(whole, 1, 2).reshape(-1, 16).astype(numpy.float32)
        return self.to.numbers([by_columns])[0]

    def skeleton(self) -> tuple[list[int], list[int]]:
        """(nodes of joints, those of them that have none above): for one person."""
        member = self.member
        moves = axes.own(beside_those_above(member.places, member.parents))
        nodes = [self.to.add("nodes", name=path.rpartition("/")[2], translation=[round(each, 7) for each in move])
                 for path, move in zip(member.joints, moves.tolist())]
        for node, parent in zip(nodes, member.parents):
            if parent >= 0:
                self.to.lists["nodes"][nodes[parent]].setdefault("children", []).append(node)
        return nodes, [node for node, parent in zip(nodes, member.parents) if parent < 0]

    def skin(self, nodes: list[int], root: int) -> int:
        return self.to.add("skins", inverseBindMatrices=self.binds, joints=nodes, skeleton=root)

    def shown_by(self, name: str, skin: int, tint: Colour, extras: dict | None = None) -> int:
        """The node in the scene that shows the mesh: all levels of one, where there are several."""
        levels = [(f"{name}_LOD{level}" if len(self.levels) > 1 else name, self.mesh(level, tint))
                  for level in self.levels]
        coarser = [self.to.add("nodes", name=named, mesh=mesh, skin=skin) for named, mesh in levels[1:]]
        told = {self.to.extension(LOD): {"ids": coarser}} if coarser else None
        return self.to.root(name=levels[0][0], mesh=levels[0][1], skin=skin, extensions=told, extras=extras)
