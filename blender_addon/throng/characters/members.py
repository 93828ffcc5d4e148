# SPDX-License-Identifier: Apache-2.0
"""Who is in a crowd's cast: characters that join it, replace somebody, and leave again. The cast's order is in the package `cast`."""
import json

import bpy

from .. import cast
from ..cast import library
from ..cast.sheets import remove_figures
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


def is_current(crowd):
    """Whether a crowd has a cast, as this version of the add-on makes them."""
    return "throng_levels" in (crowd.get("throng_cast") or ())


def cast_of(crowd):
    """The cast that a crowd shows."""
    return crowd["throng_cast"]


def _gaits_of(crowd):
    """(first, last) of a crowd's cast."""
    return tuple(cast_of(crowd)["throng_gaits"])


def repertoire_of(crowd):
    """What everybody in a crowd's cast can do."""
    return cast.Repertoire.of(tuple(crowd["throng_strides"]), _gaits_of(crowd))


def widen(crowd, gaits=None):
    """Lets a cast walk with more gaits, from a first to a last one; with all of them unless told.

    A crowd has only those that its bake walks with, as every pose costs time in every frame. Characters that were brought along cannot be
    made again, so whoever brings one widens the crowd to all gaits first: here, everybody is a shipped person whose poses are made anew.
    """
    first, last = _gaits_of(crowd)
    wanted = (min(first, gaits[0]), max(last, gaits[1])) if gaits else (0, len(crowd["throng_strides"]) - 1)
    if wanted == (first, last):
        return
    shown = cast_of(crowd)
    shown["throng_gaits"] = wanted
    for number in range(shown["throng_variations"]):
        materials = list(figure(crowd, number).data.materials)
        _discard(shown, number, keep=materials)
        library.add_person(shown, number, repertoire_of(crowd), materials)
    changed(crowd)


def figure(crowd, number, level=0):
    """The object of a member at a level of detail (cast.sheets); None where there is none."""
    return library.figures_of(cast_of(crowd)).get((level, number))


def members(crowd):
    """[(name, whether it is a character of one's own)], by number."""
    finest = sorted((member, each) for (level, member), each in library.figures_of(cast_of(crowd)).items() if level == 0)
    return [(each.get("throng_character", each.name), "throng_character" in each) for _, each in finest]


def report_of(crowd, number):
    """What was found and chosen when a character was added, in lines."""
    return json.loads(figure(crowd, number)["throng_report"])


def _discard(shown, number, keep=()):
    """Removes a member at all levels, with its materials that nobody else has, unless they are to be kept."""
    figures = [each for (_, member), each in library.figures_of(shown).items() if member == number]
    materials = {material for each in figures for material in each.data.materials if material and material not in keep}
    images = {node.image for material in materials if material.node_tree for node in material.node_tree.nodes if getattr(node, "image", None)}
    remove_figures(figures)
    for brought in (materials, images):
        bpy.data.batch_remove([each for each in brought if each.users == 0])


def crowds_of(shown):
    """All crowds that show a cast: copies of a crowd share its."""
    return [thing for thing in bpy.data.objects if thing.get("throng_cast") == shown]


def changed(crowd):
    """To be called when figures of a crowd's cast have come or gone."""
    from ..playback import set_cast

    shown = cast_of(crowd)
    for each in crowds_of(shown):
        set_cast(each, shown)


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
    shown = cast_of(crowd)
    _discard(shown, number)
    for level, posed in enumerate(character.levels):
        made = library.add_figure(shown, level, number, f"Throng character {character.name}", posed)
        made["throng_character"], made["throng_report"] = character.name, json.dumps(character.report.lines())
    shown["throng_variations"] = max(shown["throng_variations"], number + 1)
    changed(crowd)


def remove(crowd, number):
    """Takes a character out. Where it had replaced somebody, that one comes back; those who joined after it move up."""
    shown = cast_of(crowd)
    count = shown["throng_variations"]
    if not 0 <= number < count or not members(crowd)[number][1]:
        raise CharacterError(f"{number} is no character that was added")
    _discard(shown, number)
    if number < shown["throng_shipped"]:
        library.add_person(shown, number, repertoire_of(crowd), _shipped_materials(shown))
    else:
        for (_, member), each in library.figures_of(shown).items():
            if member > number:
                each["throng_member"] = member - 1
        shown["throng_variations"] = count - 1
    changed(crowd)


def _shipped_materials(shown):
    """Those of a shipped person who is there still, so that changed looks stay; else new ones."""
    from ..cast import people
    from ..cast.materials import cast_materials

    for each in library.figures_of(shown).values():
        if "throng_person" in each:
            return list(each.data.materials)
    return cast_materials(people.MATERIALS)
