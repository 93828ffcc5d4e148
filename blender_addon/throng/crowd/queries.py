# SPDX-License-Identifier: Apache-2.0
"""Which crowds a scene has, and what they say of themselves. Nothing is changed here."""
import os

import bpy

from .. import cast
from ..blender.polls import available
from ..cast import library, sitting
from .names import CACHES, SEATS

LAYERED_OF = "throng_layered_of"  # on a crowd that shows the layers of another: that one


def caches(crowd):
    """The modifiers that read a crowd's streams."""
    return [modifier for modifier in crowd.modifiers
            if modifier.type == "MESH_CACHE" and modifier.name.startswith("throng ")]


def crowd_objects(scene):
    """All crowds of a scene that this version of the add-on can work on."""
    return [thing for thing in scene.objects if is_crowd(thing)]


def earlier_crowds(scene):
    """Those of earlier versions, or without a cast: they play as they are, and no more."""
    return [thing for thing in scene.objects if _plays(thing) and not is_crowd(thing)]


def _plays(thing):
    return all(name in thing.modifiers for name in CACHES)


def is_crowd(thing):
    """Whether an object is a crowd with a cast, as this version of the add-on makes them."""
    return _plays(thing) and "throng_levels" in (thing.get("throng_cast") or ())


def why_fixed(crowd):
    """Why a crowd cannot be changed in this .blend; empty where it can."""
    library = crowd.library or crowd.data.library
    if not library:
        return ""
    return (f"{crowd.name} is linked from {library.filepath}: open that file to change it, or make it local (Object > "
            "Relations > Make Local > All)")


def why_no_crowd(scene):
    """What to do where a scene has no crowd to work on."""
    if earlier_crowds(scene):
        return "The scene's crowds are of an earlier version of Throng: import their bakes again"
    instanced = [thing.name for thing in scene.objects if thing.instance_type == "COLLECTION"
                 and thing.instance_collection and any(map(_plays, thing.instance_collection.all_objects))]
    if instanced:
        return (f"The crowd in {instanced[0]} is an instance of a collection: work on it in the file that it comes "
                "from, or link the collection itself")
    return "The scene has no crowd: import a bake first (File > Import > Throng bake)"


class OnCrowds:
    """Operators and panels that are there while the scene has a crowd."""

    @classmethod
    def poll(cls, context):
        return available(cls, "" if crowd_objects(context.scene) else why_no_crowd(context.scene))


class ChangesCrowds:
    """Operators that are there while the scene has a crowd that can be changed, and none is selected that cannot."""

    @classmethod
    def poll(cls, context):
        chosen = chosen_crowds(context)
        if not chosen:
            return available(cls, why_no_crowd(context.scene))
        fixed = [crowd for crowd in chosen if why_fixed(crowd)]
        selected = any(crowd.select_get() for crowd in fixed)
        return available(cls, why_fixed(fixed[0]) if selected or len(fixed) == len(chosen) else "")


def chosen_crowds(context):
    """The crowds that are selected, or all of the scene."""
    crowds = crowd_objects(context.scene)
    return [crowd for crowd in crowds if crowd.select_get()] or crowds


def changed_crowds(context):
    """Those of them that can be changed."""
    return [crowd for crowd in chosen_crowds(context) if not why_fixed(crowd)]


def absolute(thing, path):
    """A path that an object has, from wherever its .blend is: `//` is beside that, and not beside one that links it."""
    return os.path.normpath(bpy.path.abspath(path, library=thing.library))


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
    stream = absolute(crowd, crowd.modifiers["throng pos"].filepath)
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
    return cast.Repertoire.of(tuple(crowd["throng_strides"]), gaits_of(crowd), clips_of(cast_of(crowd)))


def clips_of(shown):
    """How many clips of those who sit or raise their hands a cast has; old files say whether it has an audience's."""
    clips = shown.get(SEATS, 0)
    return sitting.AUDIENCE if clips == 1 else int(clips)


def figure(crowd, number, level=0):
    """The object of a member at a level of detail (cast.sheets); None where there is none."""
    return library.figures_of(cast_of(crowd)).get((level, number))


def members_of(crowd):
    """[(name, whether it is a character of one's own)], by number."""
    finest = sorted((member, each) for (level, member), each in library.figures_of(cast_of(crowd)).items()
                    if level == 0)
    return [(each.get("throng_character", each.name), "throng_character" in each) for _, each in finest]
