# SPDX-License-Identifier: Apache-2.0
"""Meshes from arrays."""
import bpy
import numpy


def fill(mesh, points, corners, sizes):
    """Gives a mesh that has nothing its vertices and faces. Edges are made by its update(calc_edges=True).

    @param points (V, 3) m; @param corners of one face after the other, as numbers of points; @param sizes how many
    corners each face has
    """
    sizes = numpy.asarray(sizes, numpy.int32)
    mesh.vertices.add(len(points))
    mesh.vertices.foreach_set("co", numpy.ascontiguousarray(points, numpy.float32).ravel())
    mesh.loops.add(len(corners))
    mesh.loops.foreach_set("vertex_index", numpy.ascontiguousarray(corners, numpy.int32))
    mesh.polygons.add(len(sizes))
    mesh.polygons.foreach_set("loop_start", numpy.cumsum(sizes, dtype=numpy.int32) - sizes)
    if bpy.app.version < (4, 1, 0):  # later ones tell by themselves
        mesh.polygons.foreach_set("loop_total", sizes)


def fill_with_triangles(mesh, points, corners):
    """The same of faces with three corners each."""
    fill(mesh, points, corners, numpy.full(len(corners) // 3, 3))
