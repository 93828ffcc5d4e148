# SPDX-License-Identifier: Apache-2.0
"""Renders people shaped from a library of bodies (scripts/body_library.py): all in a row, a few from near, or a crowd.

THRONG_BODIES=bodies.npz blender -b --factory-startup --python-exit-code 1 -P scripts/render_cast.py -- OUT.png
        [--shot row|close|crowd] [--look LOOK] [--colours A B] [--profile PROFILE] [--first N] [--level near|0|1|2]
        [--width W] [--height H] [--samples N] [--denoise] [--light noon|overcast|late|night]
"""
import argparse
import math
import os
import runpy
import sys
import time

import bpy
import numpy

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "blender_addon"))
from throng.cast import gait  # noqa: E402
from throng.environment import lights, skies  # noqa: E402
from throng.people import figures, library, levels, person, roster  # noqa: E402

SIDELIGHT = (math.radians(50.0), 0.0, math.radians(-38.0))
BRIGHTER = 0.7  # stops: here are no streets whose walls are lit, too
LEVELS = {"near": levels.NEAR, "close": levels.CLOSE, "0": 0, "1": 1, "2": 2}


def arguments():
    parser = argparse.ArgumentParser(prog="render_cast.py")
    parser.add_argument("picture")
    parser.add_argument("--shot", choices=("row", "close", "crowd"), default="row")
    parser.add_argument("--look", choices=(*roster.LOOKS, "all"), default="all")
    parser.add_argument("--colours", nargs=2, metavar="COLOUR", default=(), help="of fans, such as #a01020 #ffffff")
    parser.add_argument("--profile", choices=roster.AGES, default="", help="as layouts have it")
    parser.add_argument("--first", type=int, default=0, help="the number of the first one")
    parser.add_argument("--level", choices=LEVELS, help="of detail; unless told what the shot needs")
    parser.add_argument("--width", type=int, default=1280)
    parser.add_argument("--height", type=int, default=720)
    parser.add_argument("--samples", type=int, default=48)
    parser.add_argument("--denoise", action="store_true", help="where the build has a denoiser; Debian's has none")
    parser.add_argument("--light", choices=list(skies.LIGHTS), default="noon")
    return parser.parse_args(sys.argv[sys.argv.index("--") + 1:] if "--" in sys.argv else [])


def simple_figures(options):
    """What crowds are of where there is no library: all of them in a row, whatever the shot."""
    print(f"render_cast.py: no library of bodies, so these are the simple figures: make one with "
          f"scripts/body_library.py, and set {library.VARIABLE} to it")
    script = os.path.join(os.path.dirname(os.path.abspath(__file__)), "render_figures.py")
    sys.argv = [script, "--", options.picture, *(f"--{name}={getattr(options, name)}"
                                                 for name in ("width", "height", "samples"))]
    runpy.run_path(script, run_name="__main__")


class Stage:
    def __init__(self, options, path):
        try:
            self.bodies = library.load(path)
        except library.LibraryError as error:
            sys.exit(f"render_cast.py: {error}")
        self.options, self.scene, self.made, self.seconds = options, bpy.context.scene, {}, 0.0

    def drawn(self, number):
        options = self.options
        look = roster.LOOKS[number % len(roster.LOOKS)] if options.look == "all" else options.look
        if look == "fans":
            look = " ".join((look, *options.colours))
        return roster.Role(number, look, options.profile).person()

    def place(self, number, level, x, y, heading, phase):
        """Somebody at a place; a phase of None stands."""
        started = time.perf_counter()
        if (number, level) not in self.made:
            who = self.drawn(number)
            maker = person.Maker(self.bodies, who)
            self.made[number, level] = who, maker.model(level)
        who, model = self.made[number, level]
        build = model.rig.build
        stride = gait.NORMAL_STRIDE * (0.75 + 0.25 * who.body.height / 1.7)
        pose = gait.standing_pose(gait.STANDING_CLIPS[number % 2], 0.3, build) if phase is None else \
            gait.walk_pose(phase % 1.0, build, gait.gait_of(stride))
        mesh = figures.mesh_of(f"person {number}", model, model.posed([pose])[0], who.look, self.bodies)
        shown = bpy.data.objects.new(mesh.name, mesh)
        shown.location, shown.rotation_euler = (x, y, 0.0), (0.0, 0.0, heading)
        draw = numpy.random.default_rng([number, int(1000 * x) & 0xffff])
        shown["tint"] = [float(value) for value in draw.random(3)]
        self.scene.collection.objects.link(shown)
        self.seconds += time.perf_counter() - started

    def camera(self, place, target, lens, focus=None):
        camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
        camera.data.lens, camera.location = lens, place
        away = numpy.subtract(target, place)
        camera.rotation_euler = (math.atan2(math.hypot(away[0], away[1]), -away[2]), 0.0,
                                 math.atan2(away[1], away[0]) - 0.5 * math.pi)
        if focus:
            camera.data.dof.use_dof, camera.data.dof.focus_distance = True, focus
            camera.data.dof.aperture_fstop = 4.0
        self.scene.collection.objects.link(camera)
        self.scene.camera = camera


def ahead(draw, spread):
    """Towards the camera, more or less."""
    return -0.5 * math.pi + draw.normal(0.0, spread)


def row(stage, level, draw):
    for index in range(16):
        phase = None if index % 4 == 3 else 0.02 + 0.27 * index
        stage.place(stage.options.first + index, level, 0.80 * (index - 7.5), 0.5 * (index % 2), ahead(draw, 0.18),
                    phase)
    stage.camera((0.0, -14.0, 1.45), (0.0, 0.0, 0.98), 38.0)


def close(stage, level, draw):
    for index in range(4):
        stage.place(stage.options.first + index, level, 0.62 * (index - 1.5), 0.12 * (index % 2), ahead(draw, 0.14),
                    None if index % 2 else 0.05 + 0.5 * index)
    stage.camera((0.0, -3.3, 1.58), (0.0, 0.0, 1.38), 44.0, 3.3)


def crowd(stage, _level, draw):
    spots = []
    while len(spots) < 260:
        y = 4.0 + 34.0 * draw.random() ** 0.8
        x = draw.uniform(-0.46, 0.46) * (y + 2.0)
        if all((x - a) ** 2 + (y - b) ** 2 > 0.62 for a, b in spots):
            spots.append((x, y))
    for index, (x, y) in enumerate(spots):
        level = levels.CLOSE if y < 7.0 else 0 if y < 12.0 else 1 if y < 24.0 else 2  # as scenes have it
        towards = 0.0 if draw.random() < 0.65 else math.pi
        stage.place(stage.options.first + index % 64, level, x, y, ahead(draw, 0.3) + towards, draw.random())
    stage.camera((0.0, -1.0, 2.1), (0.0, 16.0, 1.1), 34.0, 9.0)


def ground(scene):
    mesh = bpy.data.meshes.new("ground")
    mesh.from_pydata([(-90, -40, 0), (90, -40, 0), (90, 140, 0), (-90, 140, 0)], [], [(0, 1, 2, 3)])
    stone = bpy.data.materials.new("ground")
    stone.use_nodes = True
    surface = next(node for node in stone.node_tree.nodes if node.type == "BSDF_PRINCIPLED")
    surface.inputs["Base Color"].default_value = (0.075, 0.073, 0.071, 1.0)
    surface.inputs["Roughness"].default_value = 0.9
    mesh.materials.append(stone)
    scene.collection.objects.link(bpy.data.objects.new("ground", mesh))
    wall = bpy.data.meshes.new("wall")
    wall.from_pydata([(-60, 46, 0), (60, 46, 0), (60, 46, 24), (-60, 46, 24)], [], [(0, 1, 2, 3)])
    wall.materials.append(facade())
    scene.collection.objects.link(bpy.data.objects.new("wall", wall))


def facade():
    """Plaster with dark windows."""
    plaster = bpy.data.materials.new("facade")
    plaster.use_nodes = True
    nodes, links = plaster.node_tree.nodes, plaster.node_tree.links
    surface = next(node for node in nodes if node.type == "BSDF_PRINCIPLED")
    bricks, place, turned = (nodes.new(f"ShaderNode{kind}") for kind in ("TexBrick", "TexCoord", "Mapping"))
    turned.inputs["Rotation"].default_value = (0.5 * math.pi, 0.0, 0.0)
    bricks.offset = 0.0
    for name, value in (("Color1", (0.030, 0.038, 0.048, 1.0)), ("Color2", (0.060, 0.070, 0.082, 1.0)),
                        ("Mortar", (0.42, 0.33, 0.25, 1.0)), ("Scale", 1.0), ("Mortar Size", 0.75),
                        ("Brick Width", 3.0), ("Row Height", 3.8)):
        bricks.inputs[name].default_value = value
    links.new(place.outputs["Object"], turned.inputs[0])
    links.new(turned.outputs[0], bricks.inputs["Vector"])
    links.new(bricks.outputs[0], surface.inputs["Base Color"])
    return plaster


def main():
    options, path = arguments(), library.library_path()
    if path is None:
        return simple_figures(options)
    bpy.ops.wm.read_factory_settings(use_empty=True)
    stage, scene = Stage(options, path), bpy.context.scene
    level = LEVELS[options.level] if options.level else 0 if options.shot == "crowd" else levels.NEAR
    {"row": row, "close": close, "crowd": crowd}[options.shot](stage, level, numpy.random.default_rng(4))
    ground(scene)
    lights.build_light(scene, scene.collection, options.light)
    if options.light == "noon":  # faces, as a photographer would have them: lit from the side, and not from above
        sun = next(thing for thing in scene.collection.objects if thing.type == "LIGHT")
        sun.rotation_euler = SIDELIGHT
    scene.view_settings.exposure += BRIGHTER
    scene.render.engine = "CYCLES"
    scene.cycles.samples, scene.cycles.use_denoising = options.samples, options.denoise
    scene.cycles.max_bounces = 5
    scene.render.resolution_x, scene.render.resolution_y = options.width, options.height
    scene.render.resolution_percentage = 100
    if options.picture.endswith((".jpg", ".jpeg")):
        scene.render.image_settings.file_format, scene.render.image_settings.quality = "JPEG", 88
    scene.render.filepath = os.path.abspath(options.picture)
    for flag in [name for name in dir(scene.render) if name.startswith("use_stamp_")]:
        setattr(scene.render, flag, False)
    bpy.ops.render.render(write_still=True)
    triangles = sum(len(mesh.polygons) for mesh in bpy.data.meshes)
    print(f"{options.picture}: {len(bpy.data.meshes) - 2} meshes, {triangles - 2:,} triangles, "
          f"made in {stage.seconds:.1f} s")


main()
