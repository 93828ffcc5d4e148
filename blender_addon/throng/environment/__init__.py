# SPDX-License-Identifier: Apache-2.0
"""What the crowd walks among: walls, roads, ground, light and a camera, all from the bake's manifest."""
from ..formats.terrain_mesh import read_mesh
from . import camera as camera_module
from . import dressing, lifts, lights, stands, streets, traffic, terrain as terrain_module, walls as walls_module


def read_terrain(bake):
    """The terrain's mesh for build_environment(), or None where the ground is flat. Raises formats.BakeError."""
    return read_mesh(bake.terrain_path) if bake.terrain_path else None


def _walls_seen(geometry):
    """Not the outlines of stands, which are there themselves, nor where terrain ends."""
    outlines = stands.stand_names(geometry)
    return [wall for wall in geometry.get("walls", [])
            if wall.get("id", "").rstrip("_") not in outlines and not wall.get("edge")]


def build_environment(context, manifest, collection, *, walls=True, roads=True, ground=True, light=True, camera=True,
                      frame_start=1, terrain=None, bake=None, folder=None, people=None):
    """Everything in the bake's own frame (metres from its origin). A terrain takes the place of the flat ground,
    and of roads and areas.

    @param folder the bake's, where it has vehicles or lifts
    @param people (cast, repertoire) of those who are seen in vehicles, or None
    @param bake what the set is dressed for, with cars, trees and the like where nobody walks; not dressed without
    """
    geometry = manifest.get("geometry") or {}
    if walls:
        for wall in _walls_seen(geometry):
            thing = walls_module.build_wall(wall)
            walls_module.key_gate(thing, wall, float(manifest["fps"]), frame_start)
            collection.objects.link(thing)
        for thing in stands.build_stands(geometry):
            collection.objects.link(thing)
    if roads and not manifest.get("terrain"):
        for thing in streets.build_streets(geometry):
            collection.objects.link(thing)
    if ground:
        for thing in (terrain_module.build_terrain(*terrain, manifest) if terrain else streets.build_ground(manifest)):
            collection.objects.link(thing)
    traffic.build_traffic(collection, manifest, folder, frame_start, roads, terrain, people)
    lifts.build_lifts(collection, manifest, folder, frame_start)
    if bake:
        collection["throng_dressing"] = dressing.build_dressing(bake, collection, terrain)
    if light:
        lights.build_light(context.scene, collection, manifest=manifest)
    if camera:
        camera_module.build_camera(context.scene, manifest, collection)
