# SPDX-License-Identifier: Apache-2.0
"""Puts a bake into the scene: the crowd, its cast, and what it walks among."""
import os

import bpy

from .. import cast, environment
from ..blender.paths import stored_path
from ..cast import library, sitting
from ..crowd import playback
from ..formats import BakeError, load_bake
from ..overrides.layer import Arrival
from ..people import casting, members
from ..people.library import LibraryError
from . import near


def set_frame_rate(scene, fps):
    whole = round(fps)
    scene.render.fps, scene.render.fps_base = whole, whole / fps


def set_up_scene(scene, bake, frame_start):
    """The bake's frame rate and range, and a shutter that is centred on the frame: poses change between shutters."""
    set_frame_rate(scene, bake.fps)
    scene.frame_start, scene.frame_end = frame_start, frame_start + bake.frames - 1
    scene.frame_set(frame_start)
    scene.render.use_motion_blur = True
    scene.render.motion_blur_shutter = 0.5
    if hasattr(scene.render, "motion_blur_position"):
        scene.render.motion_blur_position = "CENTER"
    elif hasattr(scene, "cycles"):  # not where that add-on is disabled
        scene.cycles.motion_blur_position = "CENTER"


def import_bake(context, path, *, frame_start=1, walls=True, roads=True, scenery=True, camera=True, relative=True,
                dressing=True, people=members.MEMBERS, bend=True):
    """Imports a bake and returns the crowd's object. Raises formats.BakeError before anything is changed.

    @param people how many different ones there are to be, where they are shaped from a library of bodies
    @param bend whether those near the camera are bent into their pose (tools/near.py), where they can be
    """
    bake = load_bake(path)
    if members.found():
        try:
            members.bodies()
        except LibraryError as error:
            raise BakeError(str(error)) from error
    overrides = Arrival(bake)
    terrain = environment.read_terrain(bake) if scenery else None
    scene = context.scene
    collection = bpy.data.collections.new(f"Throng {bake.name}")
    scene.collection.children.link(collection)
    collection["throng_bake"] = os.path.join(bake.folder, "bake.json")
    collection["throng_origin"] = bake.origin

    repertoire, dress = cast.Repertoire.of(bake.strides, bake.gaits, sitting.clips_for(bake.poses)), None
    variations = min(bake.variations, cast.VARIATIONS)
    if members.found():
        variations = min(people, max(1, bake.agents))
        roles = casting.roles_for(casting.read_walkers(bake.folder) or [casting.Walker()], variations)
        dress = lambda made: members.write_roles(made, roles)
    shown = library.build_cast(variations, repertoire, f"Throng {bake.name} cast", dress)
    paths = {stream: stored_path(bake.stream_path(stream), relative) for stream in bake.streams}
    crowd = playback.build_crowd(bake, f"Throng {bake.name} crowd", shown, frame_start, paths)
    set_up_scene(scene, bake, frame_start)
    environment.build_environment(context, bake.manifest, collection, walls=walls, roads=roads, ground=scenery,
                                  light=scenery, camera=camera, frame_start=frame_start, terrain=terrain,
                                  folder=bake.folder, bake=bake if scenery and dressing else None,
                                  people=(shown, repertoire))
    if bend and dress and scene.camera:
        near.apply(crowd, scene.camera)
    collection.objects.link(crowd)  # when all is there: whatever the scene has is worked out, poses that go away, too
    overrides.place(crowd)
    return crowd
