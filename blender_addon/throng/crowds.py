# SPDX-License-Identifier: Apache-2.0
"""Crowds that are in a scene already: what is wrong with their bakes, and bringing them up to date."""
import os

import bpy

from . import nodes, playback
from .characters import members
from .formats import STREAMS, Bake, BakeError, check_pc2, load_bake, read_manifest
from .overrides import native

CACHES = tuple(f"throng {stream}" for stream in STREAMS)


def caches(crowd):
    """The modifiers that read a crowd's streams."""
    return [modifier for modifier in crowd.modifiers if modifier.type == "MESH_CACHE" and modifier.name.startswith("throng ")]


def crowd_objects(scene):
    """All crowds of a scene that this version of the add-on can work on."""
    return [thing for thing in _playing(scene) if members.is_current(thing)]


def earlier_crowds(scene):
    """Those of earlier versions, or without a cast: they play as they are, and no more."""
    return [thing for thing in _playing(scene) if not members.is_current(thing)]


def _playing(scene):
    return [thing for thing in scene.objects if all(name in thing.modifiers for name in CACHES)]


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


def bake_path(crowd):
    """The manifest that a crowd plays, as an absolute path: beside its streams, wherever these have gone."""
    stream = bpy.path.abspath(crowd.modifiers["throng pos"].filepath)
    return os.path.join(os.path.dirname(os.path.dirname(stream)), "bake.json")


def verify(crowd, scene):
    """What is wrong with a crowd's bake, in sentences; empty when all is well."""
    path = bake_path(crowd)
    try:
        bake = Bake(read_manifest(path), os.path.dirname(path))
    except BakeError as error:
        return [str(error)]
    problems = []
    for stream in bake.streams:
        if f"throng {stream}" not in crowd.modifiers:
            problems.append("the bake has a terrain and the crowd in the scene has none: import it anew")
            continue
        try:
            check_pc2(bake.stream_path(stream), bake.agents, bake.frames)
        except BakeError as error:
            problems.append(str(error))
        stored = os.path.normpath(bpy.path.abspath(crowd.modifiers[f"throng {stream}"].filepath))
        if stored != os.path.normpath(bake.stream_path(stream)):
            problems.append(f"the stream {stream} is played from {stored}, not from the bake's folder: re-load mends it")
    if len(crowd.data.vertices) != bake.agents:
        problems.append(f"the scene has {len(crowd.data.vertices)} people, the bake {bake.agents}: re-load mends it")
    if not bake.complete:
        problems.append("the bake was stopped before its last frame")
    fps = scene.render.fps / scene.render.fps_base
    if abs(fps - bake.fps) > 1e-3:
        problems.append(f"the scene plays {fps:g} frames a second, the bake has {bake.fps:g}: re-load mends it")
    return problems


def set_offset(crowd, frames):
    """Plays a crowd so many frames later (or earlier, below zero)."""
    base = crowd.get("throng_frame_start", 1)
    for cache in caches(crowd):
        cache.frame_start = base + frames
    crowd["throng_offset"] = frames
    native.follow(crowd)


def set_viewport_percent(crowd, percent):
    """Shows only so many of the people in the viewport; renders show all."""
    nodes.set_input(crowd.modifiers["throng people (viewport)"], "Share", 2.0 if percent >= 100.0 else max(0.0, percent / 100.0))
    crowd["throng_percent"] = percent
    crowd.update_tag()


def reload(crowd, scene, path=None):
    """Plays another bake, or the same after it was baked again: the cast, its materials and all settings stay. Overrides find their people
    again; returns those that don't, in sentences. Raises BakeError before anything is changed."""
    from .importer import set_frame_rate, stored_path
    from .overrides.layer import Arrival

    bake = load_bake(path or bake_path(crowd))
    if list(bake.strides) != list(crowd.get("throng_strides", bake.strides)):
        raise BakeError("this bake walks with other strides than the cast was made for: import it anew")
    if len(caches(crowd)) != len(bake.streams):
        raise BakeError("one of the two bakes has a terrain and the other has none: import it anew")
    overrides = Arrival(bake, crowd)
    members.widen(crowd, bake.gaits)
    mesh = crowd.data
    if len(mesh.vertices) != bake.agents:
        mesh.clear_geometry()
        mesh.vertices.add(bake.agents)
        playback.give_natures(mesh)
    relative = crowd.modifiers["throng pos"].filepath.startswith("//")
    for stream in bake.streams:
        crowd.modifiers[f"throng {stream}"].filepath = stored_path(bake.stream_path(stream), relative)
    set_frame_rate(scene, bake.fps)
    start = crowd.get("throng_frame_start", 1) + crowd.get("throng_offset", 0)
    scene.frame_end = max(scene.frame_end, start + bake.frames - 1)
    collection = collection_of(crowd)
    if collection:
        collection["throng_bake"] = os.path.join(bake.folder, "bake.json")
    overrides.place(crowd)
    crowd.update_tag()
    return overrides.orphans

