# SPDX-License-Identifier: Apache-2.0
"""Heights of a mesh of triangles."""
import numpy


class Relief:
    def __init__(self, positions, corners):
        """@param positions x, y, z, x, ... @param corners three for each triangle"""
        places = numpy.asarray(positions, float).reshape(-1, 3)
        self.bounds = tuple(map(tuple, (places[:, :2].min(axis=0), places[:, :2].max(axis=0))))
        self.a, self.b, self.c = (places[numpy.asarray(corners, int)[i::3]] for i in range(3))
        u, v = (self.b - self.a)[:, :2], (self.c - self.a)[:, :2]
        self.u, self.v, self.turn = u, v, u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]

    def height(self, x, y):
        """Of the highest triangle at a place, or None where there is none."""
        way = numpy.array((x, y)) - self.a[:, :2]
        with numpy.errstate(divide="ignore", invalid="ignore"):
            s = (way[:, 0] * self.v[:, 1] - way[:, 1] * self.v[:, 0]) / self.turn
            t = (self.u[:, 0] * way[:, 1] - self.u[:, 1] * way[:, 0]) / self.turn
            hit = (s >= -1e-9) & (t >= -1e-9) & (s + t <= 1.0 + 1e-9)
        if not hit.any():
            return None
        a, b, c = self.a[hit, 2], self.b[hit, 2], self.c[hit, 2]
        return float((a + s[hit] * (b - a) + t[hit] * (c - a)).max())
