# SPDX-License-Identifier: Apache-2.0
"""Runs inside Blender: cells on the ground as an overlay and as a mask, from above, with and without the add-on."""
import importlib
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
    ground = ("Throng ground", "Throng road", "Throng area", "Throng cells")
    for thing in bpy.context.scene.objects:
        if thing.type == "MESH" and not thing.name.startswith(ground):
            thing.hide_render = True
    crowd.hide_render = True
    for light in [thing for thing in bpy.context.scene.objects if thing.type == "LIGHT"]:
        light.hide_render = True
    world = bpy.data.worlds.new("white")
    world.use_nodes = True
    background = next(node for node in world.node_tree.nodes if node.type == "BACKGROUND")
    background.inputs[0].default_value = (1.0, 1.0, 1.0, 1.0)
    bpy.context.scene.world = world


def cells(kind, **settings):
    assert bpy.ops.throng.cells(kind=kind, **settings) == {"FINISHED"}


def play(bake):
    assert bpy.ops.throng.relink(filepath=os.path.join(bake, "bake.json")) == {"FINISHED"}


def own_names():
    """Of all that cells have brought, but for objects."""
    data = bpy.data
    return sorted(thing.name for things in (data.node_groups, data.images, data.actions) for thing in things
                  if "cells" in thing.name or "diagram" in thing.name)


class Check:
    """One scene, and what was seen in it."""

    def __init__(self, addon, bake, folder):
        sys.path.insert(0, addon)
        bpy.ops.wm.read_factory_settings(use_empty=True)
        importlib.import_module("throng").register()
        bpy.ops.wm.save_as_mainfile(filepath=os.path.join(folder, "overlay.blend"))
        assert bpy.ops.import_scene.throng(filepath=os.path.join(bake, "bake.json")) == {"FINISHED"}
        self.scene, self.bake, self.retake, self.folder = bpy.context.scene, bake, bake + "-retake", folder
        with open(os.path.join(bake, "bake.json"), encoding="utf-8") as file:
            bounds = json.load(file)["bounds"]
        only_ground_is_seen(next(thing for thing in self.scene.objects if "throng pos" in thing.modifiers))
        look_from_above(self.scene, bounds["min"], bounds["max"])
        self.result = {"objects": len(self.scene.objects)}
        self.render("bare")

    def render(self, name, frame=25):
        render(self.scene, frame, os.path.join(self.folder, f"{name}.exr"))

    def has_overlay(self):
        return any("throng_cells" in thing for thing in self.scene.objects)

    def overlay(self):
        """Put there twice, it is there once. It stays in the file that a farm renders."""
        cells("overlay", strength=1.0)
        cells("overlay", strength=1.0)
        self.result["with overlay"] = len(self.scene.objects)
        bpy.ops.wm.save_mainfile()
        assert sum(material.name.startswith("throng cells") for material in bpy.data.materials) == 1

    def mask(self):
        cells("mask", strength=1.0)
        names = [thing.name for things in (bpy.data.materials, bpy.data.meshes) for thing in things]
        assert not any(name.lower().startswith("throng cells") for name in names)
        self.result["with mask"] = len(self.scene.objects)
        self.render("mask")
        cells("mask", strength=1.0)
        self.render("mask-again")

    def follow(self):
        """Cells go where their crowd goes: in time, and to the bake that it plays."""
        assert bpy.ops.throng.show(offset=10) == {"FINISHED"}
        self.render("mask-later", 35)
        assert bpy.ops.throng.show(offset=0) == {"FINISHED"}
        shutil.copytree(self.bake, self.retake)
        shutil.copy(os.path.join(self.bake, "diagrams", "diagram.0001.exr"),
                    os.path.join(self.retake, "diagrams", "diagram.0021.exr"))
        play(self.retake)
        self.render("mask-of-retake")
        play(self.bake)
        self.render("mask-back")

    def rebuild_streets(self):
        """Streets that are built anew, with the materials that they had, are not darkened twice."""
        roads = [thing for thing in self.scene.objects if thing.name.startswith("Throng road")]
        worn = {thing: thing.material_slots[0].material for thing in roads}
        for thing in roads:
            thing.material_slots[0].material = bpy.data.materials[worn[thing]["throng_of"]]
        cells("mask", strength=1.0)
        assert all(thing.material_slots[0].material == worn[thing] for thing in roads)
        self.render("mask-anew")

    def lose_images(self):
        """Without images the cells go; shown in part only, nothing is asked for; with the images they come back."""
        shutil.rmtree(os.path.join(self.retake, "diagrams"))
        play(self.retake)
        self.render("mask-lost")
        assert bpy.ops.throng.show(percent=50.0, offset=0) == {"FINISHED"}
        play(self.bake)
        self.render("mask-found")

    def take_away(self):
        cells("overlay")
        bpy.data.objects.remove(next(thing for thing in self.scene.objects if "throng_cells" in thing))
        assert bpy.ops.throng.reload() == {"FINISHED"}
        self.result["removed by hand"] = not self.has_overlay()
        cells("mask", strength=1.0)
        cells("none")
        self.result["left"] = own_names()

    def keep_what_an_artist_uses(self):
        own = bpy.data.materials.new("artist's")
        own.use_nodes = True
        cells("overlay")
        tree = next(group for group in bpy.data.node_groups if group.name.endswith(" cells"))
        own.node_tree.nodes.new("ShaderNodeGroup").node_tree = tree
        cells("none")
        is_whole = any(node.type == "TEX_IMAGE" and node.image for node in tree.nodes)
        self.result["kept"] = tree.name in bpy.data.node_groups and is_whole
        self.render("none")

    def ask_for_missing_images(self):
        diagrams = os.path.join(self.bake, "diagrams")
        os.rename(diagrams, diagrams + "-away")
        try:
            bpy.ops.throng.cells(kind="overlay")
            self.result["missing"] = "accepted"
        except RuntimeError as error:
            self.result["missing"] = str(error)
        os.rename(diagrams + "-away", diagrams)


def with_the_add_on(addon, bake, folder):
    check = Check(addon, bake, folder)
    for step in (check.overlay, check.mask, check.follow, check.rebuild_streets, check.lose_images, check.take_away,
                 check.keep_what_an_artist_uses, check.ask_for_missing_images):
        step()
    print("RESULT " + json.dumps(check.result))


def on_a_farm(folder):
    assert not hasattr(bpy.types, "THRONG_OT_cells")
    for frame in (25, 26, 30):
        render(bpy.context.scene, frame, os.path.join(folder, f"overlay.{frame}.exr"))


given = sys.argv[sys.argv.index("--") + 1:]
if len(given) == 3:
    with_the_add_on(*given)
else:
    on_a_farm(*given)
