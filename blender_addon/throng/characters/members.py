# SPDX-License-Identifier: Apache-2.0
"""Who is in a crowd's cast: characters that join it, replace somebody, and leave again. The cast's order is
in the package `cast`."""
import json

import bpy

from ..cast import library, people
from ..cast.materials import cast_materials
from ..cast.sheets import remove_figures
from ..crowd.playback import cast_changed
from ..crowd.queries import cast_of, figure, gaits_of, members_of, repertoire_of
from . import CharacterError


def widen(crowd, gaits=None):
    """Lets a cast walk with more gaits, from a first to a last one; with all of them unless told.

    A crowd has only those that its bake walks with, as every pose costs time in every frame. Characters that were
    brought along cannot be made again, so whoever brings one widens the crowd to all gaits first: here, everybody is a
    shipped person whose poses are made anew.
    """
    first, last = gaits_of(crowd)
    wanted = (min(first, gaits[0]), max(last, gaits[1])) if gaits else (0, len(crowd["throng_strides"]) - 1)
    if wanted == (first, last):
        return
    shown = cast_of(crowd)
    shown["throng_gaits"] = wanted
    for number in range(shown["throng_variations"]):
        materials = list(figure(crowd, number).data.materials)
        _discard(shown, number, keep=materials)
        library.add_person(shown, number, repertoire_of(crowd), materials)
    cast_changed(crowd)


def report_of(crowd, number):
    """What was found and chosen when a character was added, in lines."""
    return json.loads(figure(crowd, number)["throng_report"])


def _discard(shown, number, keep=()):
    """Removes a member at all levels, with its materials that nobody else has, unless they are to be kept."""
    figures = [each for (_, member), each in library.figures_of(shown).items() if member == number]
    materials = {material for each in figures for material in each.data.materials if material and material not in keep}
    images = {node.image for material in materials if material.node_tree for node in material.node_tree.nodes
              if getattr(node, "image", None)}
    remove_figures(figures)
    for brought in (materials, images):
        bpy.data.batch_remove([each for each in brought if each.users == 0])


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
    cast_changed(crowd)


def remove(crowd, number):
    """Takes a character out. Where it had replaced somebody, that one comes back; those who joined after it move up."""
    shown = cast_of(crowd)
    count = shown["throng_variations"]
    if not 0 <= number < count or not members_of(crowd)[number][1]:
        raise CharacterError(f"{number} is no character that was added")
    _discard(shown, number)
    if number < shown["throng_shipped"]:
        library.add_person(shown, number, repertoire_of(crowd), _shipped_materials(shown))
    else:
        for (_, member), each in library.figures_of(shown).items():
            if member > number:
                each["throng_member"] = member - 1
        shown["throng_variations"] = count - 1
    cast_changed(crowd)


def _shipped_materials(shown):
    """Those of a shipped person who is there still, so that changed looks stay; else new ones."""
    for each in library.figures_of(shown).values():
        if "throng_person" in each:
            return list(each.data.materials)
    return cast_materials(people.MATERIALS)
