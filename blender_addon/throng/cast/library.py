# SPDX-License-Identifier: Apache-2.0
"""Makes a cast's meshes in Blender. The order of what is made is the cast's (see the package)."""
from array import array

import bpy

from . import LEVELS, PEOPLE_A_BLOCK, POSES, VARIATIONS, limb_velocities, people, plan_of, pose_name, poses_of
from .gait import gait_of
from .materials import cast_materials

BLURS_UNTIL = 1  # the last level whose limbs blur: further away they move by less than a pixel or two


def blocks_of(cast):
    """{(level, first variation): collection of poses}, whoever made them."""
    return {(block["throng_level"], block["throng_first"]): block for block in cast.children if "throng_first" in block}


def block_for(cast, level, variation):
    """The block that a person's poses are in, made if there is none."""
    first = variation - variation % PEOPLE_A_BLOCK[level]
    block = blocks_of(cast).get((level, first))
    if not block:
        block = bpy.data.collections.new(f"{cast.name} level {level} from {first:02d}")
        block["throng_level"], block["throng_first"] = level, first
        cast.children.link(block)
    return block


def objects_of(cast, level, variation):
    """The poses of a person, in order."""
    block = blocks_of(cast).get((level, variation - variation % PEOPLE_A_BLOCK[level]))
    start = pose_name(variation, 0)[:-3]
    return sorted((thing for thing in block.objects if thing.name.startswith(start)), key=lambda thing: thing.name) if block else []


def build_cast(variations, repertoire, name="Throng cast"):
    """A cast of that many people at level 0."""
    cast = bpy.data.collections.new(name)
    cast["throng_variations"] = variations
    materials = cast_materials(people.MATERIALS)
    for variation in range(variations):
        add_person(cast, variation, repertoire, materials)
    return cast


def add_person(cast, variation, repertoire, materials, levels=(0,)):
    """The shipped person of a number."""
    # Cryptomatte by asset goes by the parent: a person keeps its matte whatever the pose.
    holder = bpy.data.objects.new(f"Throng person {variation:02d}", None)
    holder["throng_person"] = variation % VARIATIONS
    figures = _figures(holder, repertoire)
    for level in levels:
        _fill(cast, level, variation, figures, repertoire, materials, holder)


def add_levels(cast, repertoire):
    """Makes the coarser levels."""
    if any(level > 0 for level, _ in blocks_of(cast)):
        return
    for variation in range(cast["throng_variations"]):
        finest = objects_of(cast, 0, variation)
        holder = finest[0].parent
        own = holder is not None and "throng_person" in holder
        figures = _figures(holder, repertoire) if own else None
        for level in range(1, LEVELS):
            if own:
                _fill(cast, level, variation, figures, repertoire, finest[0].data.materials, holder)
                continue
            add_brought(cast, level, variation, repertoire)


def add_brought(cast, level, variation, repertoire):
    """The coarser poses of somebody whom others brought along: with the meshes that came for that level, else with those of level 0."""
    finest = objects_of(cast, 0, variation)
    details = finest[0].parent.get("throng_details") if finest[0].parent else None
    coarse = sorted((thing for thing in details.objects if thing["throng_level"] == level), key=lambda thing: thing["throng_pose"]) if details else ()
    for index, source in enumerate(repertoire.sources(level)):
        twin = finest[source].copy()
        if coarse:
            twin.data = coarse[index].data
        twin.name = pose_name(variation, index, level)
        block_for(cast, level, variation).objects.link(twin)


def remove_levels(cast):
    """Throws the coarser levels away."""
    for (level, _), block in blocks_of(cast).items():
        if level > 0:
            meshes = {thing.data for thing in block.objects}
            things = [*block.objects]
            bpy.data.batch_remove([*things, block])
            bpy.data.batch_remove([mesh for mesh in meshes if mesh and mesh.users == 0])


def _figures(holder, repertoire):
    person = people.CAST[holder["throng_person"]]
    return [people.build_figure(person, pose) for pose in poses_of(person, repertoire)]


def drop_spare_attributes(mesh, keep_sharp=False):
    """What editing left in a mesh, and marks of sharp faces where there are none: Blender goes over the attributes of all poses in every frame."""
    for name in [each.name for each in mesh.attributes if each.name.startswith((".select_", ".uv_select_")) or (each.name == "sharp_face" and not keep_sharp)]:
        mesh.attributes.remove(mesh.attributes[name])


def _template(plan, flat, materials):
    mesh = bpy.data.meshes.new("throng template")
    mesh.from_pydata(list(zip(flat[::3], flat[1::3], flat[2::3])), [], plan.faces)
    for material in materials:
        mesh.materials.append(material)
    mesh.polygons.foreach_set("material_index", plan.materials)
    mesh.polygons.foreach_set("use_smooth", [True] * len(plan.faces))
    mesh.update()
    drop_spare_attributes(mesh)
    return mesh


def _fill(cast, level, variation, figures, repertoire, materials, holder):
    """Copies of one mesh, whose vertices alone differ: copying is much faster than making."""
    block = block_for(cast, level, variation)
    plan = plan_of(figures, repertoire, level)
    poses = [plan.vertices(figures[index].rings) for index in repertoire.sources(level)]
    standing = _template(plan, poses[-1], materials)
    walking = standing.copy()
    blurs = level <= BLURS_UNTIL
    if blurs:
        walking.attributes.new("velocity", "FLOAT_VECTOR", "POINT")
    for index, flat in enumerate(poses):
        mesh = (walking if index < repertoire.walking(level) else standing).copy()
        mesh.name = pose_name(variation, index, level)
        mesh.vertices.foreach_set("co", array("f", flat))
        if blurs and index < repertoire.walking(level):
            mesh.attributes["velocity"].data.foreach_set("vector", array("f", _velocities(poses, index, repertoire)))
        mesh.update()
        thing = bpy.data.objects.new(mesh.name, mesh)
        thing.parent = holder
        block.objects.link(thing)
    bpy.data.batch_remove([standing, walking])


def _velocities(poses, index, repertoire):
    """Limbs blur, too: each walking pose knows how fast its parts move at the gait's natural speed."""
    which, pose = divmod(index, POSES)
    cycle = which * POSES
    seconds = 2.0 * gait_of(repertoire.strides[which]).seconds / POSES
    return limb_velocities(poses[cycle + (pose - 1) % POSES], poses[cycle + (pose + 1) % POSES], seconds)
