# SPDX-License-Identifier: Apache-2.0
"""People who stand still in a glTF file: meshes in a pose, each of them many times (EXT_mesh_gpu_instancing)."""
from __future__ import annotations

import numpy

from ..cast import POSES
from ..people import palettes
from ..skinned.members import LEVELS
from ..skinned.motions import WALKS_FROM, seats_of
from ..skinned.posed import posed
from ..skinned.shot import Shot
from . import axes
from .meshes import Box, Meshes, Shaped, shaped

INSTANCING = "EXT_mesh_gpu_instancing"
USUAL_STRIDE = 1.3   # m, of those who are frozen as they walk
PHASES = 4           # of a cycle, in which they are


class Instances:
    def __init__(self, meshes: Meshes, shot: Shot):
        self.meshes, self.to, self.shot = meshes, meshes.to, shot

    def write(self, rows: list[int]) -> None:
        """As they are in the first frame of the shot."""
        if not rows:
            return
        streams = {name: each[0] for name, each in self._first(rows).items()}
        poses = self._poses(streams)
        kinds: dict[tuple[int, int], list[int]] = {}
        for place, row in enumerate(rows):
            kinds.setdefault((self.shot.member_of[row], int(poses[place])), []).append(place)
        name = self.to.extension(INSTANCING, required=True)
        sizes = self.shot.sizes[rows]
        for (number, pose), places in sorted(kinds.items()):
            mesh, box = self._prototype(number, pose)
            told = {each: streams[each][places] for each in ("pos", "dir")}
            self.to.root(name=f"others member{number:02d} pose{pose}", mesh=mesh, extensions={name: {
                "attributes": self._placed(told, sizes[places], box)}},
                extras={"rows": [rows[place] for place in places]})

    def _first(self, rows: list[int]) -> dict[str, numpy.ndarray]:
        frame = self.shot.frames[:1]
        bake = self.shot.bake
        return {name: numpy.array(bake.stream(name)[frame][:, rows], dtype=float) for name in ("pos", "dir", "state")}

    def _poses(self, streams: dict[str, numpy.ndarray]) -> numpy.ndarray:
        """Of the cast: for each of them a phase of the usual walk, or the first in which somebody stands; of who has a
        seat what it does."""
        repertoire = self.shot.repertoire
        first = POSES * int(numpy.abs(numpy.array(repertoire.strides) - USUAL_STRIDE).argmin())
        phases = numpy.rint(streams["state"][:, 2] % 1.0 * PHASES).astype(int) % PHASES
        found = numpy.where(streams["dir"][:, 2] > WALKS_FROM, first + phases * (POSES // PHASES), repertoire.walking())
        if not repertoire.clips:
            return found
        has, here, there, share = seats_of(streams["state"])
        return numpy.where(has, repertoire.upright() + numpy.where(share < 0.5, here, there), found)

    def _prototype(self, number: int, pose: int) -> tuple[int, Box | None]:
        member = self.shot.member(number)
        parts = [(name, self._posed(part, member.poses[pose]))
                 for name, part in member.levels[len(LEVELS) - 1].items() if len(part.faces)]
        box = Box.round([part.points for _, part in parts]) if self.meshes.quantize else None
        top = palettes.tops(member.role.look)
        materials = {"dressed": self.meshes.material("dressed"),
                     "tinted": self.meshes.material("top", top[number % len(top)])}
        return self.to.add("meshes", name=f"member{number:02d}_pose{pose}", primitives=[
            {"attributes": self.meshes.attributes(part, box, hung=False), "indices": self.to.indices(part.faces),
             "material": materials[name]} for name, part in parts]), box

    def _posed(self, part, pose: numpy.ndarray) -> Shaped:
        points, normals = posed(part.points, part.normals, part.joints, part.weights, pose[None])
        return shaped(part, points[0], normals[0])

    def _placed(self, told: dict[str, numpy.ndarray], sizes: numpy.ndarray, box: Box | None) -> dict[str, int]:
        """Instances also undo the box of quantized points."""
        headings = numpy.arctan2(told["dir"][:, 1], told["dir"][:, 0])
        places = axes.world(told["pos"])
        if box:
            turned = headings + axes.QUARTER
            x, y, z = box.centre
            places = places + sizes[:, None] * numpy.stack([
                numpy.cos(turned) * x + numpy.sin(turned) * z, numpy.full_like(turned, y),
                numpy.cos(turned) * z - numpy.sin(turned) * x], axis=1)
            sizes = sizes * box.half
        return {"TRANSLATION": self.to.numbers([places.astype(numpy.float32)])[0],
                "ROTATION": self.to.numbers([axes.facing(headings).astype(numpy.float32)])[0],
                "SCALE": self.to.numbers([sizes[:, None].repeat(3, axis=1).astype(numpy.float32)])[0]}
