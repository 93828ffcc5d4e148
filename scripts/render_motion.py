# SPDX-License-Identifier: Apache-2.0
"""Renders one person in poses of a walk: above as the add-on walks, below as a clip does that is brought along.

THRONG_BODIES=bodies.npz blender -b --factory-startup --python-exit-code 1 -P scripts/render_motion.py -- CLIP.bvh
        OUT.png [--person N] [--stride M] [--poses N] [--front] [--width W] [--samples N]
"""
import argparse
import math
import os
import sys

import bpy
import numpy

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "blender_addon"))
from throng.cast import POSES, gait  # noqa: E402
from throng.motions import bvh, reading, retarget  # noqa: E402
from throng.people import figures, library, person, rig, roster  # noqa: E402


def arguments():
    parser = argparse.ArgumentParser(prog="render_motion.py")
    parser.add_argument("clip")
    parser.add_argument("picture")
    parser.add_argument("--person", type=int, default=0)
    parser.add_argument("--stride", type=float, default=1.45, help="m")
    parser.add_argument("--poses", type=int, default=8)
    parser.add_argument("--front", action="store_true", help="seen from ahead, not from the right")
    parser.add_argument("--width", type=int, default=1400)
    parser.add_argument("--samples", type=int, default=16)
    return parser.parse_args(sys.argv[sys.argv.index("--") + 1:] if "--" in sys.argv else [])


def rows(options, maker):
    """([(bones, 3, 4)] of the add-on's walk, the same of the clip's)"""
    shown = [number * POSES // options.poses for number in range(options.poses)]
    own = [maker.rig.matrices(gait.walk_pose(number / POSES, maker.rig.build, gait.gait_of(options.stride)))
           for number in shown]
    wearer = retarget.Wearer.of(maker)
    walk = retarget.walk(reading.walk_of(reading.body_of(bvh.read(options.clip))), wearer)
    poses = walk.poses(walk.plan(options.stride))
    return own, [retarget.matrices(wearer, poses[number]) for number in shown]


def show(scene, maker, model, all_, options):
    for row, matrices in enumerate(all_):
        for number, place in enumerate(rig.skinned(model.points, model.weights, numpy.stack(matrices))):
            mesh = figures.mesh_of("pose", model, place, maker.person.look, maker.bodies)
            thing = bpy.data.objects.new("pose", mesh)
            thing.location = (1.15 * (number - 0.5 * (options.poses - 1)), 0.0, 2.1 * (len(all_) - 1 - row))
            thing.rotation_euler = (0.0, 0.0, -0.5 * math.pi if options.front else 0.0)
            thing["tint"] = [0.3, 0.6, 0.2]
            scene.collection.objects.link(thing)


def main():
    options = arguments()
    maker = person.Maker(library.load(library.library_path()), roster.Role(options.person).person())
    scene = bpy.context.scene
    for thing in list(bpy.data.objects):
        bpy.data.objects.remove(thing)
    show(scene, maker, maker.model(0), rows(options, maker), options)
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.data.type, camera.data.ortho_scale = "ORTHO", 1.15 * options.poses
    camera.location, camera.rotation_euler = (0.0, -10.0, 2.0), (0.5 * math.pi, 0.0, 0.0)
    scene.collection.objects.link(camera)
    scene.camera = camera
    sun = bpy.data.objects.new("sun", bpy.data.lights.new("sun", "SUN"))
    sun.data.energy, sun.rotation_euler = 3.0, (0.9, 0.0, -0.5)
    scene.collection.objects.link(sun)
    scene.world = scene.world or bpy.data.worlds.new("grey")
    scene.world.use_nodes = True
    scene.world.node_tree.nodes["Background"].inputs[0].default_value = (0.6, 0.62, 0.65, 1.0)
    scene.render.engine, scene.cycles.samples, scene.cycles.use_denoising = "CYCLES", options.samples, False
    scene.view_settings.view_transform = "Standard"
    high = int(options.width * 4.4 / (1.15 * options.poses))
    scene.render.resolution_x, scene.render.resolution_y = options.width, high
    scene.render.filepath = os.path.abspath(options.picture)
    bpy.ops.render.render(write_still=True)


main()
