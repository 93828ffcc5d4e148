# SPDX-License-Identifier: Apache-2.0
"""Renders the shipped cast in a row, at its levels of detail.

blender -b --factory-startup --python-exit-code 1 -P scripts/render_figures.py -- OUT.png [--width W] [--height H]
        [--samples N] [--gait N] [--phase P]
"""
import argparse
import os
import sys

import bpy

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "blender_addon"))
from throng import cast  # noqa: E402
from throng.cast import library  # noqa: E402
from throng.cast.sheets import pose_mesh  # noqa: E402
from throng.environment import lights  # noqa: E402

STRIDES = tuple(1.446 * 1.28 ** k for k in range(-3, 3))  # as of `throng bake`


def arguments():
    parser = argparse.ArgumentParser(prog="render_figures.py")
    parser.add_argument("picture")
    parser.add_argument("--width", type=int, default=960)
    parser.add_argument("--height", type=int, default=400)
    parser.add_argument("--samples", type=int, default=32)
    parser.add_argument("--gait", type=int, default=3, help="0 shuffles, 3 walks, 5 runs")
    parser.add_argument("--phase", type=float, default=0.04, help="of the first one's cycle")
    return parser.parse_args(sys.argv[sys.argv.index("--") + 1:] if "--" in sys.argv else [])


def place(scene, variation, level, x, y, pose, plain):
    figure = library.figures_of(plain)[level, variation]
    shown = bpy.data.objects.new(figure.name, pose_mesh(figure, pose))
    shown.location, shown.rotation_euler = (x, y, 0.0), (0.0, 0.0, -1.15)
    scene.collection.objects.link(shown)


def colour(materials):
    """There are no instances here to bring random numbers: each person's objects bring them."""
    for material in materials:
        for node in material.node_tree.nodes:
            if node.type == "ATTRIBUTE":
                node.attribute_type = "OBJECT"


def main():
    options = arguments()
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    repertoire = cast.Repertoire(STRIDES)
    plain = library.build_cast(cast.VARIATIONS, repertoire)
    library.add_levels(plain, repertoire)
    colour([material for material in bpy.data.materials if material.name.startswith("throng")])
    for level in range(cast.LEVELS):
        for variation in range(cast.VARIATIONS):
            pose = repertoire.walking_pose(options.gait, options.phase + 0.37 * variation, level)
            place(scene, variation, level, 0.93 * (variation - 0.5 * (cast.VARIATIONS - 1)), 2.4 * level, pose, plain)
            scene.collection.objects[-1]["tint"] = [(variation * share) % 1.0 for share in (0.618, 0.414, 0.303)]
    mesh = bpy.data.meshes.new("ground")
    mesh.from_pydata([(-90, -40, 0), (90, -40, 0), (90, 140, 0), (-90, 140, 0)], [], [(0, 1, 2, 3)])
    stone = bpy.data.materials.new("ground")
    stone.use_nodes = True
    surface = next(node for node in stone.node_tree.nodes if node.type == "BSDF_PRINCIPLED")
    surface.inputs["Base Color"].default_value = (0.16, 0.155, 0.15, 1.0)
    mesh.materials.append(stone)
    scene.collection.objects.link(bpy.data.objects.new("ground", mesh))
    lights.build_light(scene, scene.collection)
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.data.lens = 61.0
    camera.location, camera.rotation_euler = (0.0, -18.5, 5.2), (1.36, 0.0, 0.0)
    scene.collection.objects.link(camera)
    scene.camera = camera
    scene.render.engine = "CYCLES"
    scene.cycles.samples, scene.cycles.use_denoising = options.samples, False
    scene.render.resolution_x, scene.render.resolution_y = options.width, options.height
    scene.render.resolution_percentage = 100
    scene.render.filepath = os.path.abspath(options.picture)
    bpy.ops.render.render(write_still=True)


main()
