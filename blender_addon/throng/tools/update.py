# SPDX-License-Identifier: Apache-2.0
"""Crowds that are in a scene already: shown later or in part, and brought up to date with their bakes."""
import os

from ..blender.nodes import set_input
from ..blender.paths import stored_path
from ..cast import sitting
from ..characters import members
from ..crowd import own, playback
from ..crowd.queries import bake_path, caches, cast_of, clips_of, collection_of
from ..formats import POSE, BakeError, load_bake
from ..overrides import native
from ..overrides.layer import Arrival
from . import mattes
from .importer import set_frame_rate


def set_offset(crowd, frames):
    """Plays a crowd so many frames later (or earlier, below zero)."""
    base = crowd.get("throng_frame_start", 1)
    for cache in caches(crowd):
        cache.frame_start = base + frames
    crowd["throng_offset"] = frames
    native.follow(crowd)


def set_viewport_percent(crowd, percent):
    """Shows only so many of the people in the viewport; renders show all."""
    share = 2.0 if percent >= 100.0 else max(0.0, percent / 100.0)
    set_input(crowd.modifiers["throng people (viewport)"], "Share", share)
    crowd["throng_percent"] = percent
    crowd.update_tag()


def reload(crowd, scene, path=None):
    """Plays another bake, or the same after it was baked again: the cast, its materials and all settings
    stay. Overrides find their people again; returns those that don't, in sentences. Raises BakeError
    before anything is changed."""
    bake = load_bake(path or bake_path(crowd))
    if list(bake.strides) != list(crowd.get("throng_strides", bake.strides)):
        raise BakeError("this bake walks with other strides than the cast was made for: import it anew")
    played = {cache.name.removeprefix("throng ") for cache in caches(crowd)}
    if played - set(POSE) != set(bake.streams) - set(POSE):
        raise BakeError("one of the two bakes has a terrain and the other has none: import it anew")
    if sitting.clips_for(bake.poses) > clips_of(cast_of(crowd)):
        raise BakeError("in this bake people sit, and nobody in the cast was made for it: import it anew")
    overrides = Arrival(bake, crowd)
    members.widen(crowd, bake.gaits)
    mesh = crowd.data
    if len(mesh.vertices) != bake.agents:
        mesh.clear_geometry()
        mesh.vertices.add(bake.agents)
        playback.give_natures(mesh)
    own.give(crowd, crowd["throng_cast"], bake.folder)
    relative = crowd.modifiers["throng pos"].filepath.startswith("//")
    paths = {stream: stored_path(bake.stream_path(stream), relative) for stream in bake.streams}
    if played != set(paths):
        playback.follow_pose(crowd, paths)
    for stream, file in paths.items():
        crowd.modifiers[f"throng {stream}"].filepath = file
    set_frame_rate(scene, bake.fps)
    start = crowd.get("throng_frame_start", 1) + crowd.get("throng_offset", 0)
    scene.frame_end = max(scene.frame_end, start + bake.frames - 1)
    collection = collection_of(crowd)
    if collection:
        collection["throng_bake"] = os.path.join(bake.folder, "bake.json")
    overrides.place(crowd)
    mattes.follow(crowd)
    crowd.update_tag()
    return overrides.orphans
