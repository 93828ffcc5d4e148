# SPDX-License-Identifier: Apache-2.0
"""Vehicles and lifts in a glTF file: nodes that move, with parts that roll, slide or fold. Parts of one shape share a
mesh."""
from __future__ import annotations

import numpy

from ..bakes.moving import Moving, Part, Shape, moving_things
from ..skinned.shot import Shot
from . import axes
from .meshes import Meshes
from .moves import Moves


class MovingThings:
    def __init__(self, meshes: Meshes, moves: Moves, shot: Shot):
        self.meshes, self.moves, self.to, self.shot = meshes, moves, meshes.to, shot
        self.shapes: dict[int, int] = {}
        self.times: int | None = None

    def write(self) -> None:
        for thing in moving_things(self.shot.bake, self.shot.frames):
            self._thing(thing)

    def _thing(self, thing: Moving) -> None:
        children = [self._part(part) for part in thing.parts]
        place, turn = axes.world(thing.places), _turns(thing.headings, 1)
        node = self.to.root(name=thing.name, children=children, translation=place[0].tolist(),
                            rotation=turn[0].tolist())
        self._move(node, "translation", place)
        self._move(node, "rotation", turn)
        if not thing.there.all():
            self._move(node, "scale", thing.there[:, None].astype(float).repeat(3, axis=1), "STEP")

    def _part(self, part: Part) -> int:
        places = axes.world(numpy.atleast_2d(part.places))
        node = self.to.add("nodes", name=part.name, mesh=self._mesh(part.shape),
                           translation=places[0].tolist() if places[0].any() else None)
        self._move(node, "translation", places)
        if part.rolls is not None:
            self._move(node, "rotation", _turns(-part.rolls, 2))
        if part.broad is not None:
            ones = numpy.ones(len(part.broad))
            self._move(node, "scale", numpy.column_stack([ones, ones, part.broad]))
        return node

    def _move(self, node: int, path: str, values: numpy.ndarray, interpolation: str | None = None) -> None:
        """Of what changes; all else is as the node says."""
        if (values == values[0]).all():
            if path == "scale":
                self.to.lists["nodes"][node]["scale"] = values[0].tolist()
            return
        if self.times is None:
            self.times = self.moves.times(self.shot.seconds)
        made = self.moves.turns if path == "rotation" else self.moves.places
        self.moves.move(node, path, self.times, made([values])[0], interpolation)

    def _mesh(self, shape: Shape) -> int:
        if id(shape) not in self.shapes:
            self.shapes[id(shape)] = self.meshes.solid(shape.name, shape.points, shape.faces, shape.name, shape.colour)
        return self.shapes[id(shape)]


def _turns(angles: numpy.ndarray, axis: int) -> numpy.ndarray:
    """F x 4: turns about an axis of the file, each the one near that before."""
    half = 0.5 * numpy.unwrap(angles)
    found = numpy.zeros((len(half), 4))
    found[:, axis], found[:, 3] = numpy.sin(half), numpy.cos(half)
    return found
