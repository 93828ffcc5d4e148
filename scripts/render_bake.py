# SPDX-License-Identifier: Apache-2.0
"""Imports a bake with the add-on of this checkout and renders a still, or a film, without a display.

blender -b --factory-startup --python-exit-code 1 -P scripts/render_bake.py -- BAKE OUT.png [--frame N] [--samples N]
        [--width W] [--height H] [--engine cycles|eevee|workbench] [--shot crane|street|wide]
        [--view X,Y,Z,X,Y,Z] [--also SHOT=OUT.png]... [--light noon|overcast|late|night] [--wet [AMOUNT]] [--levels]
        [--close M] [--cells overlay|mask] [--denoise] [--film SECONDS] [--save FILE.blend]
"""
import argparse
import os
import sys

import bpy
from mathutils import Vector

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "blender_addon"))
import throng  # noqa: E402


def share(text):
    try:
        value = float(text)
    except ValueError:
        value = -1.0
    if not 0.0 <= value <= 1.0:
        raise argparse.ArgumentTypeError(f"expected how much, from 0 (dry) to 1 (puddles), found `{text}`")
    return value


SHOTS = ("crane", "street", "wide")
CLOSE = 8.0  # m


def shot_and_picture(text):
    shot, _, picture = text.partition("=")
    if shot not in SHOTS or not picture:
        raise argparse.ArgumentTypeError(f"expected one of {', '.join(SHOTS)}, `=` and a picture, found `{text}`")
    return shot, picture


def from_and_to(text):
    try:
        numbers = [float(number) for number in text.split(",")]
    except ValueError:
        numbers = []
    if len(numbers) != 6:
        raise argparse.ArgumentTypeError(f"expected where the camera is and what it looks at, six numbers, found "
                                         f"`{text}`")
    return numbers[:3], numbers[3:]


def arguments():
    parser = argparse.ArgumentParser(prog="render_bake.py")
    parser.add_argument("bake")
    parser.add_argument("picture")
    parser.add_argument("--frame", type=int, help="the scene's frame; by default the one the camera was set up for")
    parser.add_argument("--samples", type=int, default=96)
    parser.add_argument("--width", type=int, default=960)
    parser.add_argument("--height", type=int, default=540)
    parser.add_argument("--engine", choices=("cycles", "eevee", "workbench"), default="cycles")
    parser.add_argument("--shot", choices=SHOTS, default="crane")
    parser.add_argument("--view", type=from_and_to, metavar="X,Y,Z,X,Y,Z",
                        help="from where to where the camera looks, in metres, instead of a shot; --view=-1,... where "
                             "the first is below zero")
    parser.add_argument("--also", type=shot_and_picture, action="append", default=[], metavar="SHOT=OUT.png",
                        help="the same moment from elsewhere, as another picture")
    parser.add_argument("--light", choices=("noon", "overcast", "late", "night"), default="late")
    parser.add_argument("--wet", type=share, nargs="?", const=1.0, default=0.0, metavar="AMOUNT",
                        help="how wet the ground is, from 0 to 1, which has puddles; 1 unless told")
    parser.add_argument("--levels", action="store_true", help="with coarser people far away")
    parser.add_argument("--close", type=float, default=CLOSE, metavar="M",
                        help=f"people so near the camera, {CLOSE:g} m unless told, have more detail; 0: nobody has")
    parser.add_argument("--cells", choices=("overlay", "mask"), help="with the bake's diagram images on the ground")
    parser.add_argument("--denoise", action="store_true", help="as far as this Blender has a denoiser")
    parser.add_argument("--film", type=float, metavar="SECONDS",
                        help="the picture is a film, `OUT.mp4`, that begins at the frame")
    parser.add_argument("--save", help="also save the scene; paths in it are relative")
    return parser.parse_args(sys.argv[sys.argv.index("--") + 1:] if "--" in sys.argv else [])


ENGINES = {"cycles": ("CYCLES",), "eevee": ("BLENDER_EEVEE_NEXT", "BLENDER_EEVEE"), "workbench": ("BLENDER_WORKBENCH",)}


def set_up_render(scene, options):
    engines = ENGINES[options.engine]
    known = bpy.types.RenderSettings.bl_rna.properties["engine"].enum_items.keys()
    scene.render.engine = next((name for name in engines if name in known), engines[-1])
    scene.render.resolution_x, scene.render.resolution_y = options.width, options.height
    scene.render.resolution_percentage = 100
    scene.render.image_settings.file_format = "PNG"
    scene.render.use_persistent_data = False
    for flag in [name for name in dir(scene.render) if name.startswith("use_stamp_")]:
        setattr(scene.render, flag, False)  # pictures carry no paths of the machine that rendered them
    if options.engine == "cycles":
        cycles = scene.cycles
        cycles.samples, cycles.use_adaptive_sampling, cycles.adaptive_threshold = options.samples, True, 0.02
        cycles.use_denoising = options.denoise  # not every build has a denoiser
        cycles.max_bounces, cycles.diffuse_bounces, cycles.glossy_bounces, cycles.transmission_bounces = 4, 3, 2, 2
        cycles.caustics_reflective = cycles.caustics_refractive = False


def look(camera, place, aim):
    camera.constraints.clear()
    camera.animation_data_clear()
    camera.location, camera.rotation_mode = place, "QUATERNION"
    camera.rotation_quaternion = (Vector(aim) - Vector(place)).to_track_quat("-Z", "Y")
    camera.data.dof.use_dof = False


def render(scene, frame, picture, close):
    if close > 0.0 and throng.people.members.found():
        bpy.ops.throng.close(by="camera", distance=close, frames="now")
    scene.render.filepath = os.path.abspath(picture)
    bpy.ops.render.render(write_still=True)
    print(f"rendered frame {frame}: {picture}")


def render_film(scene, options, frame):
    scene.frame_start, scene.frame_end = frame, frame + max(1, round(options.film * scene.render.fps)) - 1
    if options.close > 0.0 and throng.people.members.found():
        bpy.ops.throng.close(by="camera", distance=options.close, frames="shot")
    settings, video = scene.render.image_settings, scene.render.ffmpeg
    if hasattr(settings, "media_type"):  # from 5.0 on
        settings.media_type = "VIDEO"
    settings.file_format = "FFMPEG"
    video.format, video.codec, video.constant_rate_factor, video.gopsize = "MPEG4", "H264", "MEDIUM", 12
    video.audio_codec = "NONE"
    scene.render.filepath, scene.render.use_persistent_data = os.path.abspath(options.picture), True
    bpy.ops.render.render(animation=True)
    print(f"rendered frames {scene.frame_start} to {scene.frame_end}: {options.picture}")


def main():
    options = arguments()
    bpy.ops.wm.read_factory_settings(use_empty=True)
    throng.register()
    scene = bpy.context.scene
    if options.save:  # first, so that the import can store relative paths
        bpy.ops.wm.save_as_mainfile(filepath=os.path.abspath(options.save))
    bake = options.bake if options.bake.endswith(".json") else os.path.join(options.bake, "bake.json")
    bpy.ops.import_scene.throng(filepath=os.path.abspath(bake))
    set_up_render(scene, options)
    if options.light != "late":
        bpy.ops.throng.light(time=options.light)
    if options.shot != "crane":
        bpy.ops.throng.shot(kind=options.shot)  # by the light's shadows, so after it
    if options.view:
        look(scene.camera, *options.view)
    if options.wet:
        bpy.ops.throng.rain(amount=options.wet)
    if options.cells:
        bpy.ops.throng.cells(kind=options.cells)
    if options.levels:
        bpy.ops.throng.levels(by="camera")
    crowd = next(c for c in bpy.data.collections if "throng_bake" in c)
    frame = options.frame if options.frame is not None else crowd["throng_camera_frame"]
    scene.frame_set(frame)
    if options.save:
        bpy.ops.wm.save_mainfile(compress=True)
    if options.film:
        render_film(scene, options, frame)
        return
    render(scene, frame, options.picture, options.close)
    for shot, picture in options.also:
        bpy.ops.throng.shot(kind=shot)
        render(scene, frame, picture, options.close)


main()
