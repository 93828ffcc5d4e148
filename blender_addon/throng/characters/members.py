# SPDX-License-Identifier: Apache-2.0
"""Who is in a crowd's cast: characters that join it, replace somebody, and leave again. The cast's order is in the package `cast`."""
import json

import bpy

from .. import cast
from ..cast import library
from . import CharacterError


def pick(maths, variation, drawn, count):
    """Nodes that say which member somebody is.

    The bake draws among so many as it knew of; members that joined later take their share from all alike, by numbers that everybody has.
    @param variation the stream's value; @param drawn how many the bake draws among; @param count how many members there are
    """
    own = maths.math("MODULO", variation, float(count))
    later = count - drawn
    if later <= 0:
        return own
    draws = maths.node("ShaderNodeSeparateXYZ")
    maths.link(maths.attribute("tint", "FLOAT_VECTOR"), draws.inputs[0])
    joins, which = (maths.math("FRACT", maths.math("MULTIPLY", draws.outputs[axis], 97.0)) for axis in (0, 1))
    joined = maths.math("ADD", maths.math("FLOOR", maths.math("MULTIPLY", which, float(later))), float(drawn))
    taken = maths.math("MULTIPLY", maths.math("LESS_THAN", joins, later / count), maths.math("LESS_THAN", variation, drawn - 0.5))
    return maths.math("MULTIPLY_ADD", taken, maths.math("SUBTRACT", joined, own), own)


def cast_of(crowd):
    """The cast that a crowd shows."""
    if "throng_cast" not in crowd:
        raise CharacterError(f"{crowd.name} was imported by an earlier version of the add-on: import its bake again")
    return crowd["throng_cast"]


def _gaits_of(crowd):
    """(first, last) of a crowd's cast: the add-on once made all of them."""
    return tuple(cast_of(crowd).get("throng_gaits", (0, len(crowd["throng_strides"]) - 1)))


def repertoire_of(crowd):
    """What everybody in a crowd's cast can do."""
    return cast.Repertoire.of(tuple(crowd["throng_strides"]), _gaits_of(crowd))


def widen(crowd, gaits=None):
    """Lets a cast walk with more gaits, from a first to a last one; with all of them unless told.

    A crowd has only those that its bake walks with, as every pose costs time in every frame. Characters that were brought along cannot be
    made again, so whoever brings one widens the crowd to all gaits first: here, everybody is a shipped person whose poses are made anew.
    """
    if "throng_cast" not in crowd:
        return  # of an earlier version, which made all gaits
    first, last = _gaits_of(crowd)
    wanted = (min(first, gaits[0]), max(last, gaits[1])) if gaits else (0, len(crowd["throng_strides"]) - 1)
    if wanted == (first, last):
        return
    shown = cast_of(crowd)
    levels = _levels(shown)
    shown["throng_gaits"] = wanted
    for number in range(shown["throng_variations"]):
        materials = list(library.objects_of(shown, 0, number)[0].data.materials)
        _discard(shown, number, keep=materials)
        library.add_person(shown, number, repertoire_of(crowd), materials, levels)
    _changed(crowd)


def poses(crowd, level=0):
    """{member: [its pose objects, in order]}."""
    shown = cast_of(crowd)
    return {number: library.objects_of(shown, level, number) for number in range(shown["throng_variations"])}


def members(crowd):
    """[(name, whether it is a character of one's own)], by number."""
    holders = [things[0].parent for _, things in sorted(poses(crowd).items())]
    return [(holder.get("throng_character", holder.name), "throng_character" in holder) if holder else ("", False) for holder in holders]


def _levels(shown):
    return sorted({level for level, _ in library.blocks_of(shown)})


def _discard(shown, number, keep=()):
    """Removes a member at all levels, with the meshes that it brought, and with their materials that nobody else has, unless they are to be kept."""
    things = [thing for level in _levels(shown) for thing in library.objects_of(shown, level, number)]
    holders = {thing.parent for thing in things if thing.parent}
    details = [holder["throng_details"] for holder in holders if holder.get("throng_details")]
    stored = [thing for collection in details for thing in collection.objects]
    meshes = {thing.data for thing in things + stored}
    materials = {material for mesh in meshes for material in mesh.materials if material and material not in keep}
    images = {node.image for material in materials if material.node_tree for node in material.node_tree.nodes if getattr(node, "image", None)}
    bpy.data.batch_remove([*things, *stored, *details, *holders])
    for brought in (meshes, materials, images):
        bpy.data.batch_remove([each for each in brought if each.users == 0])


def _changed(crowd):
    from ..playback import set_cast

    shown = cast_of(crowd)
    bpy.data.batch_remove([block for block in library.blocks_of(shown).values() if not block.objects])
    for each in [thing for thing in bpy.data.objects if thing.get("throng_cast") == shown]:  # copies of a crowd share its cast
        set_cast(each, shown)


def _details(character, holder):
    """The coarser meshes, for when levels of detail are asked for: in a collection that nothing shows but the file keeps."""
    details = bpy.data.collections.new(f"{holder.name} details")
    for level, meshes in enumerate(character.meshes):
        for index, mesh in enumerate(meshes if level else ()):
            thing = bpy.data.objects.new(mesh.name, mesh)
            thing["throng_level"], thing["throng_pose"] = level, index
            details.objects.link(thing)
    holder["throng_details"] = details


def number_for(crowd, place=None):
    """The number that a character gets: of the one whom it replaces, or a new one."""
    count = cast_of(crowd)["throng_variations"]
    number = count if place is None else place
    if not 0 <= number <= count:
        raise CharacterError(f"the cast has members 0 to {count - 1}: there is no {number} to replace")
    if number > 99:
        raise CharacterError("a cast can have 100 members")
    return number


def put(crowd, character, number):
    """Makes a character the member of that number (number_for)."""
    repertoire, shown = repertoire_of(crowd), cast_of(crowd)
    count, levels = shown["throng_variations"], _levels(shown)
    _discard(shown, number)
    holder = bpy.data.objects.new(f"Throng character {character.name}", None)
    holder["throng_character"] = character.name
    holder["throng_report"] = json.dumps(character.report.lines())
    block = library.block_for(shown, 0, number)
    for index, mesh in enumerate(character.meshes[0]):
        thing = bpy.data.objects.new(cast.pose_name(number, index), mesh)
        mesh.name = thing.name
        thing.parent = holder
        block.objects.link(thing)
    _details(character, holder)
    for level in levels:
        if level > 0:
            library.add_brought(shown, level, number, repertoire)
    shown["throng_variations"] = max(count, number + 1)
    _changed(crowd)


def remove(crowd, number):
    """Takes a character out. Where it had replaced somebody, that one comes back; those who joined after it move up."""
    shown = cast_of(crowd)
    count, levels = shown["throng_variations"], _levels(shown)
    if not 0 <= number < count or not members(crowd)[number][1]:
        raise CharacterError(f"{number} is no character that was added")
    _discard(shown, number)
    if number < shown.get("throng_shipped", count):
        library.add_person(shown, number, repertoire_of(crowd), _shipped_materials(shown), levels)
    else:
        for later in range(number + 1, count):
            for level in levels:
                _renumber(shown, level, later, later - 1)
        shown["throng_variations"] = count - 1
    _changed(crowd)


def _renumber(shown, level, number, to):
    things = library.objects_of(shown, level, number)
    for index, thing in enumerate(things):
        thing.users_collection[0].objects.unlink(thing)
        thing.name = cast.pose_name(to, index, level)
        library.block_for(shown, level, to).objects.link(thing)


def _shipped_materials(shown):
    """Those of a shipped person who is there still, so that changed looks stay; else new ones."""
    from ..cast import people
    from ..cast.materials import cast_materials

    for block in library.blocks_of(shown).values():
        for thing in block.objects:
            if thing.parent and "throng_person" in thing.parent:
                return list(thing.data.materials)
    return cast_materials(people.MATERIALS)
