# SPDX-License-Identifier: Apache-2.0
"""Vehicles and lifts of a stage: a prim for each, moved and turned, with parts that roll, slide or fold. Parts of one
shape are references to one mesh."""
from __future__ import annotations

import numpy

from ..bakes.moving import Moving, Part, Shape, moving_things

SMALL = 1e-3  # times: who or what is not there is as small, too, for programs that show what is invisible for a time


class MovingThings:
    """Written into a stage (crowd.Stage)."""

    def __init__(self, stage):
        self.to, self.stage, self.geom, self.gf = stage, stage.stage, stage.geom, stage.gf
        self.frames = numpy.arange(0, stage.bake.frames, stage.every)
        self.codes = (self.frames + 1).tolist()
        self.shapes: dict[int, str] = {}
        self.taken: set[str] = set()

    def write(self) -> None:
        for thing in moving_things(self.to.bake, self.frames):
            self._thing(thing)

    def _named(self, folder: str, name: str) -> str:
        """A path that nothing else has."""
        plain = "".join(each if each.isascii() and each.isalnum() else "_" for each in name)
        plain = plain if plain[:1].isalpha() else f"_{plain}"
        path, number = f"{folder}/{plain}", 2
        while path in self.taken:
            path, number = f"{folder}/{plain}_{number}", number + 1
        self.taken.add(path)
        return path

    def _thing(self, thing: Moving) -> None:
        folder = f"/World/{thing.kind}"
        if not self.stage.GetPrimAtPath(folder):
            self.geom.Scope.Define(self.stage, folder)
        path = self._named(folder, thing.name)
        xform = self.geom.Xform.Define(self.stage, path)
        xform.GetPrim().SetDisplayName(thing.name)
        self._sampled(xform.AddTranslateOp(), thing.places, self._place)
        self._sampled(xform.AddRotateZOp(), numpy.degrees(thing.headings), float)
        if not thing.there.all():
            self._sampled(xform.CreateVisibilityAttr(), thing.there.astype(int),
                          lambda there: "inherited" if there else "invisible", steps=True)
            self._sampled(xform.AddScaleOp(), numpy.where(thing.there, 1.0, SMALL), self.gf.Vec3f)
        for part in thing.parts:
            self._part(f"{path}/{part.name}", thing.kind, part)

    def _part(self, path: str, kind: str, part: Part) -> None:
        prim = self.stage.DefinePrim(path, "Mesh")
        prim.GetReferences().AddInternalReference(self._shape(kind, part.shape))
        xform = self.geom.Xformable(prim)
        if part.places.any():
            self._sampled(xform.AddTranslateOp(), numpy.atleast_2d(part.places), self._place)
        if part.rolls is not None:
            self._sampled(xform.AddRotateYOp(), numpy.degrees(part.rolls), float)
        if part.broad is not None:
            self._sampled(xform.AddScaleOp(), part.broad, lambda broad: self.gf.Vec3f(1.0, broad, 1.0))

    def _shape(self, kind: str, shape: Shape) -> str:
        if id(shape) not in self.shapes:
            folder = f"/World/{kind}/Shapes"
            self.stage.CreateClassPrim(folder)
            path = self._named(folder, shape.name)
            self.stage.CreateClassPrim(path).SetTypeName("Mesh")
            mesh = self.geom.Mesh(self.stage.GetPrimAtPath(path))
            self.to.shaped(mesh, shape.points, [len(face) for face in shape.faces],
                           [corner for face in shape.faces for corner in face])
            mesh.CreateDisplayColorPrimvar(self.geom.Tokens.constant).Set([self.gf.Vec3f(*shape.colour)])
            self.shapes[id(shape)] = path
        return self.shapes[id(shape)]

    def _place(self, place: numpy.ndarray):
        return self.gf.Vec3d(*place.tolist())

    def _sampled(self, attribute, values: numpy.ndarray, made, steps: bool = False) -> None:
        """Samples where something changes, and one beside each; what never does has none. @param values F or F x 3;
        @param steps whether values hold until the next one"""
        if (values == values[0]).all():
            attribute.Set(made(values[0]))
            return
        same = (values[1:] == values[:-1]).reshape(len(values) - 1, -1).all(axis=1)
        before, after = numpy.append(False, same), numpy.append(same, False)
        for place in numpy.nonzero(~before if steps else ~(before & after))[0].tolist():
            attribute.Set(made(values[place]), self.codes[place])
