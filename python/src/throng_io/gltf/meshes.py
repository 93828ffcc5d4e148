# SPDX-License-Identifier: Apache-2.0
"""Meshes in a glTF file: points of parts as attributes, plain or quantized."""
from __future__ import annotations

import dataclasses

import numpy

from ..skinned.members import Part
from . import axes
from .document import Document

QUANTIZATION = "KHR_mesh_quantization"
FULL16, FULL8, ALL16 = 32767, 127, 65535
ROUGHNESS = 0.8

Colour = tuple[float, float, float]


@dataclasses.dataclass(frozen=True)
class Shaped:
    """A part whose corners have one colour each."""
    points: numpy.ndarray      # V x 3, of somebody's own, in the file's axes
    normals: numpy.ndarray     # V x 3
    joints: numpy.ndarray      # V x 4
    weights: numpy.ndarray     # V x 4
    colours: numpy.ndarray     # V x 3, or none
    faces: numpy.ndarray       # F x 3
    of: numpy.ndarray          # V: which of the part's points they are


def shaped(part: Part, points: numpy.ndarray | None = None, normals: numpy.ndarray | None = None) -> Shaped:
    """Where faces of several colours meet, points are there once for each. @param points, normals in a pose"""
    points = axes.own(part.points if points is None else points)
    normals = axes.own(part.normals if normals is None else normals)
    if not len(part.colours):
        return Shaped(points, normals, part.joints, part.weights, numpy.zeros((0, 3)), part.faces,
                      numpy.arange(len(points)))
    several = len(part.colours)
    corners = part.faces.ravel() * several + numpy.repeat(part.colour_of, 3)
    there, place = numpy.unique(corners, return_inverse=True)
    point = there // several
    return Shaped(points[point], normals[point], part.joints[point], part.weights[point],
                  part.colours[there % several], place.reshape(-1, 3), point)


def hangs(joints: numpy.ndarray, weights: numpy.ndarray) -> tuple[numpy.ndarray, numpy.ndarray]:
    """Joints, and shares of 65535 that add up to it. What has no share is on joint 0."""
    shares = numpy.rint(weights * ALL16).astype(int)
    shares[numpy.arange(len(shares)), shares.argmax(axis=1)] += ALL16 - shares.sum(axis=1)
    return numpy.where(shares > 0, joints, 0).astype(numpy.uint8), shares.astype(numpy.uint16)


@dataclasses.dataclass(frozen=True)
class Box:
    """What quantized points are told in: centre + half * point, -1 to 1."""
    centre: numpy.ndarray
    half: float

    @classmethod
    def round(cls, several: list[numpy.ndarray]) -> Box:
        low = numpy.min([points.min(axis=0) for points in several], axis=0)
        high = numpy.max([points.max(axis=0) for points in several], axis=0)
        return cls(0.5 * (low + high), float(0.5 * (high - low).max()))

    def matrix(self) -> numpy.ndarray:
        """4 x 4: from told points to m."""
        found = numpy.diag([self.half, self.half, self.half, 1.0])
        found[:3, 3] = self.centre
        return found


class Meshes:
    """How points become accessors of a document."""

    def __init__(self, document: Document, quantize: bool = False):
        self.to, self.quantize = document, quantize
        self.materials: dict[tuple, int] = {}

    def attributes(self, part: Shaped, box: Box | None, hung: bool = True) -> dict[str, int]:
        """Accessors of a part's points. @param hung on joints"""
        found = {"POSITION": self._points(part.points, box), "NORMAL": self._normals(part.normals)}
        if hung:
            joints, weights = hangs(part.joints, part.weights)
            found["JOINTS_0"] = self.to.vertices(joints)
            found["WEIGHTS_0"] = self.to.vertices(weights, normalized=True)
        if len(part.colours):
            whole = numpy.concatenate([part.colours, numpy.ones((len(part.colours), 1))], axis=1)
            found["COLOR_0"] = self.to.vertices(numpy.rint(whole * ALL16).astype(numpy.uint16), normalized=True)
        return found

    def _points(self, points: numpy.ndarray, box: Box | None) -> int:
        if box is None:
            return self.to.vertices(points.astype(numpy.float32), bounds=True)
        self.to.extension(QUANTIZATION, required=True)
        told = numpy.rint((points - box.centre) / box.half * FULL16).astype(numpy.int16)
        return self.to.vertices(told, normalized=True, bounds=True)

    def _normals(self, normals: numpy.ndarray) -> int:
        if not self.quantize:
            return self.to.vertices(normals.astype(numpy.float32))
        return self.to.vertices(numpy.rint(normals * FULL8).astype(numpy.int8), normalized=True)

    def solid(self, name: str, points: numpy.ndarray, faces: list[list[int]], kind: str, colour: Colour) -> int:
        """A mesh of the world's, with convex faces, which are shown as flat as they are. @param kind its material's"""
        triangles = numpy.array([[face[0], *face[corner:corner + 2]] for face in faces
                                 for corner in range(1, len(face) - 1)])
        places = self.to.vertices(axes.world(points).astype(numpy.float32), bounds=True)
        return self.to.add("meshes", name=name, primitives=[{
            "attributes": {"POSITION": places}, "indices": self.to.indices(triangles),
            "material": self.material(kind, colour)}])

    def material(self, name: str, colour: Colour | None = None) -> int:
        """What shows a colour, or those of points."""
        key = (name, colour)
        if key not in self.materials:
            factor = [round(float(each), 6) for each in colour] + [1.0] if colour else None
            self.materials[key] = self.to.add("materials", name=name, doubleSided=True, pbrMetallicRoughness={
                **({"baseColorFactor": factor} if factor else {}), "metallicFactor": 0.0, "roughnessFactor": ROUGHNESS})
        return self.materials[key]
