# SPDX-License-Identifier: Apache-2.0
"""Which crowds a scene has, and what they say of themselves. Nothing is changed here."""
import os

import bpy

from .. import cast
from ..cast import library
from .names import CACHES


def caches(crowd):
    """The modifiers that read a crowd's streams."""
    return [modifier for modifier in crowd.modifiers
            if modifier.type == "MESH_CACHE" and modifier.name.startswith("throng ")]


def crowd_objects(scene):
    """All crowds of a scene that this version of the add-on can work on."""
    return [thing for thing in _playing(scene) if _is_current(thing)]


def earlier_crowds(scene):
    """Those of earlier versions, or without a cast: they play as they are, and no more."""
    return [thing for thing in _playing(scene) if not _is_current(thing)]


def _playing(scene):
    return [thing for thing in scene.objects if all(name in thing.modifiers for name in CACHES)]


def _is_current(crowd):
    """Whether a crowd has a cast, as this version of the add-on makes them."""
    return "throng_levels" in (crowd.get("throng_cast") or ())


class OnCrowds:
    """Operators and panels that are there while the scene has a crowd."""

    @classmethod
    def poll(cls, context):
        return bool(crowd_objects(context.scene))


def chosen_crowds(context):
    """The crowds that are selected, or all of the scene."""
    crowds = crowd_objects(context.scene)
    return [crowd for crowd in crowds if crowd.select_get()] or crowds


def collection_of(crowd):
    return next((collection for collection in crowd.users_collection if "throng_bake" in collection), None)


def terrain_of(crowd):
    """The mesh of the bake's terrain, if the scene has it."""
    if "throng ground" not in crowd.modifiers:
        return None
    return next((thing for collection in crowd.users_collection for thing in collection.objects
                 if thing.name.startswith("Throng terrain")), None)


def bake_path(crowd):
    """The manifest that a crowd plays, as an absolute path: beside its streams, wherever these have gone."""
    stream = bpy.path.abspath(crowd.modifiers["throng pos"].filepath)
    return os.path.join(os.path.dirname(os.path.dirname(stream)), "bake.json")


def cast_of(crowd):
    """The cast that a crowd shows."""
    return crowd["throng_cast"]


def crowds_of(shown):
    """All crowds that show a cast: copies of a crowd share its."""
    return [thing for thing in bpy.data.objects if thing.get("throng_cast") == shown]


def gaits_of(crowd):
    """(first, last) of a crowd's cast."""
    return tuple(cast_of(crowd)["throng_gaits"])


def repertoire_of(crowd):
    """What everybody in a crowd's cast can do."""
    return cast.Repertoire.of(tuple(crowd["throng_strides"]), gaits_of(crowd))


def figure(crowd, number, level=0):
    """The object of a member at a level of detail (cast.sheets); None where there is none."""
    return library.figures_of(cast_of(crowd)).get((level, number))


def members_of(crowd):
    """[(name, whether it is a character of one's own)], by number."""
    finest = sorted((member, each) for (level, member), each in library.figures_of(cast_of(crowd)).items()
                    if level == 0)
    return [(each.get("throng_character", each.name), "throng_character" in each) for _, each in finest]
