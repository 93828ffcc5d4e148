# SPDX-License-Identifier: Apache-2.0
"""The ground under feet, where a bake has a terrain: how high it is, and how it slopes."""
from __future__ import annotations

import numpy
import shapely

from ..bakes.bake import Bake
from ..bakes.surroundings import terrain_of

STEEPEST = 1.5      # of what feet can stand on: not the front of a tread
FAR = 1.0           # m: what is further above or below somebody is another floor


class Ground:
    def __init__(self, triangles: numpy.ndarray):
        """@param triangles T x 3 x 3, m, z up"""
        normals = numpy.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
        flat = numpy.abs(normals[:, 2]) * STEEPEST > numpy.linalg.norm(normals[:, :2], axis=1) + 1e-12
        self.corner, normals = triangles[flat, 0], normals[flat]
        self.slopes = -normals[:, :2] / normals[:, 2:]
        self.tree = shapely.STRtree(shapely.polygons(triangles[flat][:, :, :2]))

    @classmethod
    def of(cls, bake: Bake) -> Ground | None:
        if not bake.about.get("terrain"):
            return None
        thing = terrain_of(bake)
        return cls(thing.points[numpy.array(thing.faces)])

    def under(self, places: numpy.ndarray) -> tuple[numpy.ndarray, numpy.ndarray]:
        """(heights, slopes along x and y) of what is nearest above or below N places; NaN where nothing is."""
        heights, slopes = numpy.full(len(places), numpy.nan), numpy.zeros((len(places), 2))
        which, triangle = self.tree.query(shapely.points(places[:, :2]), predicate="intersects")
        found = self.corner[triangle, 2] + (
            self.slopes[triangle] * (places[which, :2] - self.corner[triangle, :2])).sum(axis=1)
        away = numpy.abs(found - places[which, 2])
        order = numpy.argsort(-away, kind="stable")  # the nearest one is the last to be told
        order = order[away[order] < FAR]
        heights[which[order]], slopes[which[order]] = found[order], self.slopes[triangle[order]]
        return heights, slopes
