# SPDX-License-Identifier: Apache-2.0
"""Meshes of more detail for those of the near people who are closest to the camera, in final pictures (near.py shows
them): of members of the cast, at rest, on the same bones as the coarser ones. Only those are made that a shot needs."""
import bpy

from ..blender.nodes import drop_object
from ..cast import bones
from ..people import levels, members

MOST = "throng_most_close"    # of a crowd: how many at most are shown in more detail
_MEMBER = "throng_close_for"  # of an object in the cast: whose mesh it is


def meshes_of(cast):
    """{member: object}"""
    return {thing[_MEMBER]: thing for thing in cast.objects if _MEMBER in thing}


def add(cast, member, repertoire):
    mesh, hangs = members.mesh_on_bones(members.role_of(cast, member), levels.CLOSE, repertoire)
    bones.hang(mesh, hangs)
    mesh.name = f"Throng person {member:02d} close"
    made = bpy.data.objects.new(mesh.name, mesh)
    made[_MEMBER] = member
    cast.objects.link(made)


def forget(cast):
    for thing in meshes_of(cast).values():
        drop_object(thing)
