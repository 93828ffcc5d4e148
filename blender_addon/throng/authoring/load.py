# SPDX-License-Identifier: Apache-2.0
"""A layout's own bake in its scene: the crowd, and the streets and buildings that were drawn."""
import bpy

from .. import environment
from ..crowd.queries import collection_of, crowd_objects
from ..formats import load_bake, read_manifest
from ..tools import cells
from ..tools.importer import import_bake
from ..tools.update import reload
from .exporter import origin_of


def _crowd_of(scene):
    crowd = scene.throng_layout.crowd
    return crowd if crowd in crowd_objects(scene) else None


def _move(things, offset):
    for thing in things:
        if thing.parent is None:
            thing.location.x += offset[0]
            thing.location.y += offset[1]


def load(context, path, own_meshes=()):
    """Loads the bake of the scene's layout: the first time as a new crowd, later in its place. Returns what could not
    follow, in sentences. Raises BakeError before anything is changed.

    own_meshes: indices of the layout's walls that are meshes of the user's, which are not built a second time.
    """
    scene = context.scene
    layout, bake = scene.throng_layout, load_bake(path)
    offset = [baked - here for baked, here in zip(bake.origin, origin_of(scene))]
    crowd = _crowd_of(scene)
    if crowd is None:
        crowd = import_bake(context, path, frame_start=scene.frame_start, walls=False, roads=False,
                            scenery=layout.build_scenery, camera=layout.build_camera and scene.camera is None)
        layout.crowd = crowd
        _move(collection_of(crowd).objects, offset)
    else:
        reload(crowd, scene, path)
        crowd.location[:2] = offset
    _build(context, collection_of(crowd) or scene.collection, read_manifest(path), set(own_meshes), offset)
    return cells.follow(crowd)


def _build(context, collection, manifest, own_meshes, offset):
    """Streets and buildings as the layout has them now, in the place of those of the bake before."""
    scene = context.scene
    layout = scene.throng_layout
    if not (layout.build_streets or layout.build_walls):
        return
    built = layout.built
    if built is None:
        built = layout.built = bpy.data.collections.new(f"{collection.name} set")
        collection.children.link(built)
    for thing in list(built.objects):
        data = thing.data
        bpy.data.objects.remove(thing)
        if data is not None and data.users == 0:
            bpy.data.meshes.remove(data)
    geometry = dict(manifest.get("geometry") or {})
    geometry["walls"] = [wall for i, wall in enumerate(geometry.get("walls", [])) if i not in own_meshes]
    environment.build_environment(context, {**manifest, "geometry": geometry}, built, walls=layout.build_walls,
                                  roads=layout.build_streets, ground=False, light=False, camera=False,
                                  frame_start=scene.frame_start)
    _move(built.objects, offset)
    layout.show_solid = False
