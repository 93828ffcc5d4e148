# SPDX-License-Identifier: Apache-2.0
"""Runs inside Blender: cells on the ground as an overlay and as a mask, rendered from straight above, with and without the add-on."""
import json
import os
import shutil
import sys

import bpy

PIXELS = 8.0  # per metre


def look_from_above(scene, low, high):
    camera = bpy.data.objects.new("above", bpy.data.cameras.new("above"))
    camera.data.type, camera.data.ortho_scale = "ORTHO", high[0] - low[0]
    camera.location = (0.5 * (low[0] + high[0]), 0.5 * (low[1] + high[1]), 50.0)
    scene.collection.objects.link(camera)
    scene.camera = camera
    scene.render.engine = "CYCLES"
    scene.cycles.samples, scene.cycles.use_denoising, scene.cycles.use_adaptive_sampling = 4, False, False
    scene.cycles.filter_width = 0.01
    scene.render.use_motion_blur = False
    scene.render.resolution_x, scene.render.resolution_y = (int(PIXELS * (high[axis] - low[axis])) for axis in (0, 1))
    scene.render.resolution_percentage = 100
    settings = scene.render.image_settings
    if hasattr(settings, "media_type"):
        settings.media_type = "IMAGE"
    settings.file_format, settings.color_mode, settings.color_depth = "OPEN_EXR", "RGB", "32"


def render(scene, frame, path):
    scene.frame_set(frame)
    scene.render.filepath = path
    bpy.ops.render.render(write_still=True)


def only_ground_is_seen(crowd):
    for thing in bpy.context.scene.objects:
        if thing.type == "MESH" and not thing.name.startswith(("Throng ground", "Throng road", "Throng area", "Throng cells")):
            thing.hide_render = True
    crowd.hide_render = True
    for light in [thing for thing in bpy.context.scene.objects if thing.type == "LIGHT"]:
        light.hide_render = True
    world = bpy.data.worlds.new("white")
    world.use_nodes = True
    next(node for node in world.node_tree.nodes if node.type == "BACKGROUND").inputs[0].default_value = (1.0, 1.0, 1.0, 1.0)
    bpy.context.scene.world = world


def with_the_add_on(addon, bake, folder):
    sys.path.insert(0, addon)
    import throng

    bpy.ops.wm.read_factory_settings(use_empty=True)
    throng.register()
    bpy.ops.wm.save_as_mainfile(filepath=os.path.join(folder, "overlay.blend"))
    assert bpy.ops.import_scene.throng(filepath=os.path.join(bake, "bake.json")) == {"FINISHED"}
    scene = bpy.context.scene
    crowd = next(thing for thing in scene.objects if "throng pos" in thing.modifiers)
    manifest = json.load(open(os.path.join(bake, "bake.json")))
    only_ground_is_seen(crowd)
    look_from_above(scene, manifest["bounds"]["min"], manifest["bounds"]["max"])
    result = {"objects": len(scene.objects)}
    render(scene, 25, os.path.join(folder, "bare.exr"))
    assert bpy.ops.throng.cells(kind="overlay", strength=1.0) == {"FINISHED"}
    assert bpy.ops.throng.cells(kind="overlay", strength=1.0) == {"FINISHED"}
    result["with overlay"] = len(scene.objects)
    bpy.ops.wm.save_mainfile()
    assert sum(material.name.startswith("throng cells") for material in bpy.data.materials) == 1
    assert bpy.ops.throng.cells(kind="mask", strength=1.0) == {"FINISHED"}
    assert not any(thing.name.startswith(("throng cells", "Throng cells")) for things in (bpy.data.materials, bpy.data.meshes) for thing in things)
    result["with mask"] = len(scene.objects)
    render(scene, 25, os.path.join(folder, "mask.exr"))
    assert bpy.ops.throng.cells(kind="mask", strength=1.0) == {"FINISHED"}
    render(scene, 25, os.path.join(folder, "mask-again.exr"))
    # Cells go where their crowd goes: in time, and to the bake that it plays.
    assert bpy.ops.throng.show(offset=10) == {"FINISHED"}
    render(scene, 35, os.path.join(folder, "mask-later.exr"))
    assert bpy.ops.throng.show(offset=0) == {"FINISHED"}
    shutil.copytree(bake, bake + "-retake")
    shutil.copy(os.path.join(bake, "diagrams", "diagram.0001.exr"), os.path.join(bake + "-retake", "diagrams", "diagram.0021.exr"))
    assert bpy.ops.throng.relink(filepath=os.path.join(bake + "-retake", "bake.json")) == {"FINISHED"}
    render(scene, 25, os.path.join(folder, "mask-of-retake.exr"))
    assert bpy.ops.throng.relink(filepath=os.path.join(bake, "bake.json")) == {"FINISHED"}
    render(scene, 25, os.path.join(folder, "mask-back.exr"))
    # Streets that are built anew, with the materials that they had, are not darkened twice.
    roads = [thing for thing in scene.objects if thing.name.startswith("Throng road")]
    worn = {thing: thing.material_slots[0].material for thing in roads}
    for thing in roads:
        thing.material_slots[0].material = bpy.data.materials[worn[thing]["throng_of"]]
    assert bpy.ops.throng.cells(kind="mask", strength=1.0) == {"FINISHED"}
    assert all(thing.material_slots[0].material == worn[thing] for thing in roads)
    render(scene, 25, os.path.join(folder, "mask-anew.exr"))
    # Without images the cells go; shown in part only, nothing is asked for; when the images are back, so are the cells.
    shutil.rmtree(os.path.join(bake + "-retake", "diagrams"))
    assert bpy.ops.throng.relink(filepath=os.path.join(bake + "-retake", "bake.json")) == {"FINISHED"}
    render(scene, 25, os.path.join(folder, "mask-lost.exr"))
    assert bpy.ops.throng.show(percent=50.0, offset=0) == {"FINISHED"}
    assert bpy.ops.throng.relink(filepath=os.path.join(bake, "bake.json")) == {"FINISHED"}
    render(scene, 25, os.path.join(folder, "mask-found.exr"))
    assert bpy.ops.throng.cells(kind="overlay") == {"FINISHED"}
    bpy.data.objects.remove(next(thing for thing in scene.objects if "throng_cells" in thing))
    assert bpy.ops.throng.reload() == {"FINISHED"}
    result["removed by hand"] = not any("throng_cells" in thing for thing in scene.objects)
    assert bpy.ops.throng.cells(kind="mask", strength=1.0) == {"FINISHED"}
    assert bpy.ops.throng.cells(kind="none") == {"FINISHED"}
    result["left"] = sorted(thing.name for things in (bpy.data.node_groups, bpy.data.images, bpy.data.actions) for thing in things if "cells" in thing.name or "diagram" in thing.name)
    own = bpy.data.materials.new("artist's")
    own.use_nodes = True
    assert bpy.ops.throng.cells(kind="overlay") == {"FINISHED"}
    tree = next(group for group in bpy.data.node_groups if group.name.endswith(" cells"))
    own.node_tree.nodes.new("ShaderNodeGroup").node_tree = tree
    assert bpy.ops.throng.cells(kind="none") == {"FINISHED"}
    result["kept"] = tree.name in bpy.data.node_groups and any(node.type == "TEX_IMAGE" and node.image for node in tree.nodes)
    render(scene, 25, os.path.join(folder, "none.exr"))
    diagrams = os.path.join(bake, "diagrams")
    os.rename(diagrams, diagrams + "-away")
    try:
        bpy.ops.throng.cells(kind="overlay")
        result["missing"] = "accepted"
    except RuntimeError as error:
        result["missing"] = str(error)
    os.rename(diagrams + "-away", diagrams)
    print("RESULT " + json.dumps(result))


def on_a_farm(folder):
    assert not hasattr(bpy.types, "THRONG_OT_cells")
    for frame in (25, 26, 30):
        render(bpy.context.scene, frame, os.path.join(folder, f"overlay.{frame}.exr"))


given = sys.argv[sys.argv.index("--") + 1:]
if len(given) == 3:
    with_the_add_on(*given)
else:
    on_a_farm(*given)
