# SPDX-License-Identifier: Apache-2.0
"""The film look in one click: how the scene is rendered, photographed and written, by Blender version."""
from dataclasses import dataclass

import bpy
from mathutils import Vector

from ..blender.builds import can_denoise
from ..blender.nodes import socket
from ..environment.lights import lights_of, set_colours, tame_fireflies
from . import mattes


@dataclass(frozen=True)
class Look:
    width: int
    height: int
    samples: int
    noise: float       # adaptive threshold
    layers: bool       # multilayer EXR with passes; otherwise PNG
    depth_of_field: bool


PRESETS = {
    "preview": Look(960, 540, 48, 0.06, False, False),
    "plate": Look(1920, 1080, 192, 0.02, True, True),
    "final": Look(1920, 1080, 768, 0.008, True, True),
}
HAZE_COLOUR = (0.62, 0.68, 0.76)  # where the light is the scene's own


def apply(scene, preset, *, crane=True, haze=0.3):
    """Sets up the whole look; harmless to apply again. Raises BakeError before anything is changed."""
    look = PRESETS[preset]
    if look.layers:
        mattes.apply(scene)
    _set_render(scene, look)
    set_colours(scene)
    _set_output(scene, look)
    camera = scene.camera
    if camera and camera.type == "CAMERA":
        camera.data.dof.use_dof = look.depth_of_field
        if crane:
            _set_crane(scene, camera)
    _set_haze(scene, haze)


def _set_render(scene, look):
    scene.render.engine = "CYCLES"
    cycles = scene.cycles
    cycles.samples, cycles.use_adaptive_sampling, cycles.adaptive_threshold = look.samples, True, look.noise
    # Without a denoiser grain has to be bought with samples: twice as many.
    cycles.use_denoising = can_denoise()
    if not cycles.use_denoising:
        cycles.samples = 2 * look.samples
    cycles.max_bounces, cycles.diffuse_bounces, cycles.glossy_bounces, cycles.transmission_bounces = 6, 3, 2, 2
    cycles.caustics_reflective = cycles.caustics_refractive = False
    tame_fireflies(scene)
    scene.render.resolution_x, scene.render.resolution_y = look.width, look.height
    scene.render.resolution_percentage = 100
    scene.render.use_motion_blur, scene.render.motion_blur_shutter = True, 0.5  # 180 degrees
    if hasattr(scene.render, "motion_blur_position"):
        scene.render.motion_blur_position = "CENTER"
    else:
        cycles.motion_blur_position = "CENTER"


def _set_output(scene, look):
    settings = scene.render.image_settings
    if hasattr(settings, "media_type"):  # 5.0 asks first what kind of thing it is
        settings.media_type = "MULTI_LAYER_IMAGE" if look.layers else "IMAGE"
    settings.file_format = "OPEN_EXR_MULTILAYER" if look.layers else "PNG"
    if look.layers:
        settings.color_depth, settings.exr_codec = "32", "ZIP"  # Cryptomatte's numbers bear no loss
    for layer in scene.view_layers:
        layer.use_pass_z = layer.use_pass_mist = look.layers
        for matte in ("object", "asset", "material"):
            setattr(layer, f"use_pass_cryptomatte_{matte}", look.layers)
        if look.layers:
            layer.pass_cryptomatte_depth = 6


def _set_crane(scene, camera):
    """A slow rise and drift over the shot, always aimed at the same place."""
    name = f"{camera.name} aim"
    aim = bpy.data.objects.get(name)
    if not aim:
        aim = bpy.data.objects.new(name, None)
        scene.collection.objects.link(aim)
        forward = camera.matrix_world.to_quaternion() @ Vector((0.0, 0.0, -1.0))
        distance = camera.data.dof.focus_distance or 15.0
        aim.location = camera.matrix_world.translation + forward * distance
        aim.empty_display_size = 0.5
        track = camera.constraints.new("TRACK_TO")
        track.target, track.track_axis, track.up_axis = aim, "TRACK_NEGATIVE_Z", "UP_Y"
        camera["throng_crane"] = list(camera.location)
    camera.data.dof.focus_object = aim
    start = Vector(tuple(camera["throng_crane"]))
    way = (aim.location - start).length
    side = (aim.location - start).cross(Vector((0.0, 0.0, 1.0))).normalized()
    for frame, along, up in ((scene.frame_start, -0.04, -0.03), (scene.frame_end, 0.04, 0.05)):
        camera.location = start + side * (along * way) + Vector((0.0, 0.0, up * way))
        camera.keyframe_insert("location", frame=frame)


def _set_haze(scene, amount):
    """Air between us and what is far: the mist pass, mixed in by the compositor, so that it costs no samples
    and can be taken out."""
    _set_mist(scene, amount)
    tree = _compositor(scene)
    tree.nodes.clear()
    layers = tree.nodes.new("CompositorNodeRLayers")
    strength = tree.nodes.new("CompositorNodeMath" if hasattr(bpy.types, "CompositorNodeMath") else "ShaderNodeMath")
    strength.operation = "MULTIPLY"
    strength.inputs[1].default_value = amount
    tree.links.new(layers.outputs["Mist"], strength.inputs[0])
    factor, first, second, mixed = _mix_sockets(tree)
    second.default_value = (*next((light.haze for light in lights_of(scene)), HAZE_COLOUR), 1.0)
    tree.links.new(strength.outputs[0], factor)
    tree.links.new(layers.outputs["Image"], first)
    tree.links.new(mixed, _output_socket(tree))


def _set_mist(scene, amount):
    camera, world = scene.camera, scene.world
    if world:
        reach = (camera.data.dof.focus_distance if camera and camera.type == "CAMERA" else 0.0) or 30.0
        mist = world.mist_settings
        mist.start, mist.depth, mist.falloff = 0.6 * reach, 12.0 * reach, "LINEAR"
    for layer in scene.view_layers:
        layer.use_pass_mist = layer.use_pass_mist or amount > 0.0


def _mix_sockets(tree):
    """A new node that mixes two colours: (how much of the second, the first, the second, the mixture)."""
    if hasattr(bpy.types, "CompositorNodeMixRGB"):
        mix = tree.nodes.new("CompositorNodeMixRGB")
        return mix.inputs[0], mix.inputs[1], mix.inputs[2], mix.outputs[0]
    mix = tree.nodes.new("ShaderNodeMix")
    mix.data_type = "RGBA"
    return socket(mix.inputs, "Factor"), socket(mix.inputs, "A"), socket(mix.inputs, "B"), socket(mix.outputs, "Result")


def _output_socket(tree):
    """Where the finished picture goes: from 5.0 on a compositor is a group of nodes with an output."""
    if hasattr(bpy.types, "CompositorNodeComposite"):
        return tree.nodes.new("CompositorNodeComposite").inputs[0]
    if not any(each.name == "Image" for each in tree.interface.items_tree):
        tree.interface.new_socket(name="Image", in_out="OUTPUT", socket_type="NodeSocketColor")
    return tree.nodes.new("NodeGroupOutput").inputs[0]


def _compositor(scene):
    """The scene's compositor tree, made if it has none."""
    if hasattr(scene, "compositing_node_group"):  # 5.0
        if not scene.compositing_node_group:
            scene.compositing_node_group = bpy.data.node_groups.new("Throng film look", "CompositorNodeTree")
        return scene.compositing_node_group
    scene.use_nodes = True
    return scene.node_tree

