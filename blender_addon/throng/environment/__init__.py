# SPDX-License-Identifier: Apache-2.0
"""What the crowd walks among: walls, roads, ground, light and a camera, all from the bake's manifest."""
from . import camera as camera_module
from . import lights, streets, walls as walls_module


def build_environment(context, manifest, collection, *, walls=True, roads=True, ground=True, light=True, camera=True, frame_start=1):
    """Everything in the bake's own frame (metres from its origin)."""
    geometry = manifest.get("geometry") or {}
    if walls:
        for wall in geometry.get("walls", []):
            thing = walls_module.build_wall(wall)
            walls_module.key_gate(thing, wall, float(manifest["fps"]), frame_start)
            collection.objects.link(thing)
    if roads:
        for thing in streets.build_streets(geometry):
            collection.objects.link(thing)
    if ground:
        collection.objects.link(streets.build_ground(manifest))
    if light:
        lights.build_light(context.scene, collection, manifest=manifest)
    if camera:
        camera_module.build_camera(context.scene, manifest, collection)
