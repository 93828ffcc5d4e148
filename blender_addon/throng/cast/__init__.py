# SPDX-License-Identifier: Apache-2.0
"""The people that the add-on ships: a collection of pose meshes, made when it is first needed."""
from . import gait, people

VARIATIONS = len(people.CAST)


def pose_name(variation, pose):
    return f"throng_v{variation:02d}_p{pose:02d}"


def poses_of(person, poses, stride_length):
    """The walk's poses in order, then the idle one. Tall or small, everybody takes the bake's stride: feet must not slide."""
    build = people.build_of(person)
    walk = [gait.walk_pose(index / poses, build, stride_length) for index in range(poses)]
    return walk + [gait.idle_pose(build)]


def build_cast(variations, poses, stride_length, library_name="Throng cast"):
    """A collection whose children, sorted by name, are variation * (poses + 1) + pose; pose == poses stands still."""
    import bpy

    from .materials import cast_materials

    collection = bpy.data.collections.new(library_name)
    materials = cast_materials(people.MATERIALS)
    for variation in range(variations):
        person = people.CAST[variation % VARIATIONS]
        for index, pose in enumerate(poses_of(person, poses, stride_length)):
            figure = people.build_figure(person, pose)
            mesh = bpy.data.meshes.new(pose_name(variation, index))
            mesh.from_pydata(figure.vertices, [], figure.faces)
            for material in materials:
                mesh.materials.append(material)
            mesh.polygons.foreach_set("material_index", figure.materials)
            mesh.polygons.foreach_set("use_smooth", [True] * len(figure.faces))
            mesh.update()
            collection.objects.link(bpy.data.objects.new(mesh.name, mesh))
    return collection
