# SPDX-License-Identifier: Apache-2.0
"""Renders what people in seats do, one pose beside the other: sitting, ready, clapping, rising, cheering, singing. Or
how they get up (`--what settling`), or what they do with their hands where they stand (`--what hands`).
Where THRONG_BODIES names a library of bodies, of people shaped from it.

blender -b --factory-startup --python-exit-code 1 -P scripts/render_seats.py -- OUT.png [--members N,N,...] [--width W]
        [--height H] [--samples N] [--denoise] [--what seats|settling|hands]
"""
import argparse
import os
import sys

import bpy
from mathutils import Vector

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "blender_addon"))
import throng  # noqa: E402
from throng import cast  # noqa: E402
from throng.cast import library, sitting  # noqa: E402
from throng.cast.sheets import pose_mesh  # noqa: E402
from throng.environment import lights, materials, stands  # noqa: E402
from throng.environment.shapes import Shape  # noqa: E402
from throng.people import casting, members  # noqa: E402

SHOWN = {
    "seats": (("sit", 0), ("ready", 2), ("clap", 4), ("rise", 3), ("rise", 6), ("cheer", 0), ("cheer", 4), ("sing", 2)),
    "settling": (("settle", 0), ("settle", 2), ("settle", 4), ("settle", 6), ("settle", 8), ("settle", 11)),
    "hands": (("raise", 0), ("raise", 3), ("applaud", 4), ("jubilate", 8), ("sway", 2), ("wave", 3), ("wave", 10)),
}
APART, ROWS = 0.95, 1.7  # m


def arguments():
    parser = argparse.ArgumentParser(prog="render_seats.py")
    parser.add_argument("picture")
    parser.add_argument("--members", default="0,1,4", help="of the cast, a row each")
    parser.add_argument("--width", type=int, default=960)
    parser.add_argument("--height", type=int, default=400)
    parser.add_argument("--samples", type=int, default=32)
    parser.add_argument("--denoise", action="store_true")
    parser.add_argument("--what", choices=SHOWN, default="seats")
    return parser.parse_args(sys.argv[sys.argv.index("--") + 1:] if "--" in sys.argv else sys.argv[1:])


def build_cast(count):
    repertoire, dress = cast.Repertoire((1.446,), 3, len(sitting.CLIPS)), None
    if members.found():
        roles = casting.roles_for([casting.Walker()], count)
        dress = lambda made: members.write_roles(made, roles)
    return library.build_cast(count, repertoire, dress=dress), repertoire


def place_of(name, pose):
    """m ahead of the seat's middle: the bake moves who settles."""
    share = pose / (sitting.CLIPS[[clip.name for clip in sitting.CLIPS].index("settle")].poses - 1)
    return sitting.AHEAD * share * share * (3.0 - 2.0 * share) if name == "settle" else 0.0


def seat(scene, plain, repertoire, numbers, what):
    shape, shell = Shape("seats"), materials.plain("seat", (0.035, 0.085, 0.20), 0.45)
    names = [clip.name for clip in sitting.CLIPS]
    for row, member in enumerate(numbers):
        for place, (name, pose) in enumerate(SHOWN[what]):
            number = repertoire.upright() + sitting.poses_in(names.index(name)) + pose
            shown = bpy.data.objects.new(name, pose_mesh(library.figures_of(plain)[0, member], number))
            shown.location = (-ROWS * row + place_of(name, pose), -APART * place, 0.0)
            shown["tint"] = [(member * share + 0.1) % 1.0 for share in (0.618, 0.414, 0.303)]
            scene.collection.objects.link(shown)
            if what != "hands":
                stands.add_seat(shape, (-ROWS * row, -APART * place), (0.0, -1.0), 0.0, 0.22, shell)
    scene.collection.objects.link(shape.to_object())


def look(scene, rows, count):
    middle = Vector((-0.5 * ROWS * (rows - 1), -0.5 * APART * (count - 1) - 0.3, 0.66))
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.location = middle + Vector((8.2, -5.6, 2.6))
    camera.rotation_euler = (middle - camera.location).to_track_quat("-Z", "Y").to_euler()
    camera.data.lens = 41.0
    scene.collection.objects.link(camera)
    scene.camera = camera


def main():
    options = arguments()
    bpy.ops.wm.read_factory_settings(use_empty=True)
    throng.register()
    scene, numbers = bpy.context.scene, [int(number) for number in options.members.split(",")]
    plain, repertoire = build_cast(max(numbers) + 1)
    for material in [each for each in bpy.data.materials if each.name.startswith("throng") and each.node_tree]:
        for node in material.node_tree.nodes:
            if node.type == "ATTRIBUTE":
                node.attribute_type = "OBJECT"  # there are no instances here to bring random numbers
    seat(scene, plain, repertoire, numbers, options.what)
    ground = Shape("ground")
    ground.flat([(-90.0, -90.0), (90.0, -90.0), (90.0, 90.0), (-90.0, 90.0)], 0.0,
                materials.plain("ground", (0.16, 0.155, 0.15)))
    scene.collection.objects.link(ground.to_object())
    lights.build_light(scene, scene.collection)
    look(scene, len(numbers), len(SHOWN[options.what]))
    scene.render.engine = "CYCLES"
    scene.cycles.samples, scene.cycles.use_denoising = options.samples, options.denoise
    scene.render.resolution_x, scene.render.resolution_y = options.width, options.height
    scene.render.resolution_percentage = 100
    scene.render.filepath = os.path.abspath(options.picture)
    bpy.ops.render.render(write_still=True)


main()
