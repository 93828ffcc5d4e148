# SPDX-License-Identifier: Apache-2.0
"""Meshes of people in Blender."""
import bpy
import numpy

from ..blender.meshes import fill_with_triangles
from ..cast.sheets import drop_spare_attributes
from .materials import material_of

PATTERN = "pattern"
_FINE = 4096.0  # steps a metre of it: what is finer is not seen, and files are smaller without it


def mesh_of(name, model, points, look, bodies):
    """A mesh of somebody at a level of detail, its vertices at those points."""
    mesh = bpy.data.meshes.new(name)
    fill_with_triangles(mesh, points, model.faces.ravel())
    for kind in model.materials:
        mesh.materials.append(material_of(kind, look, bodies))
    mesh.polygons.foreach_set("material_index", model.material_of.astype(numpy.int32))
    mesh.polygons.foreach_set("use_smooth", numpy.ones(len(model.faces), bool))
    add_pattern(mesh, model)
    mesh.update(calc_edges=True)
    mesh.validate()
    drop_spare_attributes(mesh)
    return mesh


def add_pattern(mesh, model):
    pattern = mesh.attributes.new(PATTERN, "FLOAT_VECTOR", "POINT")
    rounded = numpy.rint(model.pattern * _FINE) / _FINE + 0.0
    pattern.data.foreach_set("vector", numpy.ascontiguousarray(rounded, numpy.float32).ravel())


def add_moves(mesh, moves):
    """What moves in a face, as attributes. @param moves as person.Model has them"""
    for name, values in moves.items():
        attribute = mesh.attributes.new(f"throng_{name}", "FLOAT_VECTOR", "POINT")
        attribute.data.foreach_set("vector", numpy.ascontiguousarray(values, numpy.float32).ravel())
