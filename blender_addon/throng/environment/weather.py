# SPDX-License-Identifier: Apache-2.0
"""What air and rain do to the ground's surfaces: two groups of nodes that all of them share, so that one number changes
a whole scene."""
import bpy

from ..blender.nodes import new_tree, own_tree
from .shading import Shading, not_a_lamp

HAZE, RAIN = "Throng haze", "Throng rain"
_SOFT = "soft ground"
_WET_ROUGHNESS, _PUDDLE_ROUGHNESS = 0.30, 0.035


def mark_soft(material, share):
    """Says where a material, which is not weathered yet, is fields and grass: rain makes those darker, and that is all.

    @param share a socket: 1 where it is soft, 0 where it is paved
    """
    nodes, links = material.node_tree.nodes, material.node_tree.links
    before = nodes.get(_SOFT)
    soft = nodes.new("ShaderNodeMath")
    soft.operation, soft.use_clamp = "MAXIMUM", True
    soft.inputs[1].default_value = 0.0
    links.new(share, soft.inputs[0])
    if before:
        before.name = f"{_SOFT} before"
        links.new(before.outputs[0], soft.inputs[1])
    soft.name = _SOFT


def weathered(material):
    """Lets a material's surface fade with distance, and get wet. Harmless to do again; returns the material."""
    nodes, links = material.node_tree.nodes, material.node_tree.links
    if any(node.type == "GROUP" and node.node_tree and node.node_tree.name == RAIN for node in nodes):
        return material
    shader = next(node for node in nodes if node.type == "BSDF_PRINCIPLED")
    rain = nodes.new("ShaderNodeGroup")
    rain.node_tree = _rain()
    specular = next(name for name in ("Specular IOR Level", "Specular") if name in shader.inputs)
    normal = shader.inputs["Normal"]
    for name, slot in (("Colour", shader.inputs["Base Color"]), ("Roughness", shader.inputs["Roughness"]),
                       ("Specular", shader.inputs[specular]), ("Normal", normal)):
        source = slot.links[0].from_socket if slot.links else None
        if source:
            links.new(source, rain.inputs[name])
        elif slot is normal:
            links.new(nodes.new("ShaderNodeNewGeometry").outputs["Normal"], rain.inputs[name])
        else:
            rain.inputs[name].default_value = slot.default_value
        links.new(rain.outputs[name], slot)
    if _SOFT in nodes:
        links.new(nodes[_SOFT].outputs[0], rain.inputs["Soft"])
    _through_air(nodes, links, shader)
    not_a_lamp(material)
    return material


def _through_air(nodes, links, shader):
    output = next(node for node in nodes if node.type == "OUTPUT_MATERIAL")
    air = nodes.new("ShaderNodeGroup")
    air.node_tree = _haze()
    links.new(shader.outputs[0], air.inputs[0])
    links.new(air.outputs[0], output.inputs["Surface"])


def set_rain(amount):
    """How wet the ground is: 0 dry, 0.5 damp, 1 with puddles."""
    _rain().nodes["Amount"].outputs[0].default_value = amount


def rain():
    """How wet the ground is."""
    tree = own_tree(RAIN)
    return tree.nodes["Amount"].outputs[0].default_value if tree else 0.0


def set_haze(colour, visibility):
    nodes = _haze().nodes
    nodes["Colour"].outputs[0].default_value = (*colour, 1.0)
    nodes["Visibility"].outputs[0].default_value = visibility


def _haze():
    tree = own_tree(HAZE)
    if tree:
        return tree
    tree, given, result = new_tree(HAZE, [("Surface", "NodeSocketShader")], [("Surface", "NodeSocketShader")],
                                   "ShaderNodeTree")
    shading = Shading(tree)
    colour = shading.node("ShaderNodeRGB", name="Colour")
    visibility = shading.node("ShaderNodeValue", name="Visibility")
    visibility.outputs[0].default_value = 2600.0
    distance = shading.node("ShaderNodeCameraData").outputs["View Distance"]
    through = shading.math("EXPONENT", shading.math("MULTIPLY", shading.math("DIVIDE", distance, visibility.outputs[0]),
                                                    -1.0))
    lost = shading.math("SUBTRACT", 1.0, through)
    # only what the camera itself sees: haze is no lamp
    lost = shading.math("MULTIPLY", lost, shading.node("ShaderNodeLightPath").outputs["Is Camera Ray"])
    air, mixed = shading.node("ShaderNodeEmission"), shading.node("ShaderNodeMixShader")
    shading.link(colour.outputs[0], air.inputs["Color"])
    shading.link(lost, mixed.inputs[0])
    shading.link(given.outputs[0], mixed.inputs[1])
    shading.link(air.outputs[0], mixed.inputs[2])
    shading.link(mixed.outputs[0], result.inputs[0])
    return tree


def _rain():
    tree = own_tree(RAIN)
    if tree:
        return tree
    sockets = [("Colour", "NodeSocketColor"), ("Roughness", "NodeSocketFloat"), ("Specular", "NodeSocketFloat"),
               ("Normal", "NodeSocketVector")]
    tree, given, result = new_tree(RAIN, [*sockets, ("Soft", "NodeSocketFloat")], sockets, "ShaderNodeTree")
    shading = Shading(tree)
    amount = shading.node("ShaderNodeValue", name="Amount").outputs[0]
    amount.default_value = 0.0
    geometry = shading.node("ShaderNodeNewGeometry")
    level = shading.smooth(shading.separate(geometry.outputs["Normal"])[2], 0.97, 0.998)
    hollows = shading.noise(geometry.outputs["Position"], 0.30, 3.0)
    # water comes up in hollows from half wet on
    shore = shading.math("MULTIPLY_ADD", amount, -0.30, 0.87)
    puddle = shading.smooth(shading.math("SUBTRACT", hollows, shore), 0.0, 0.022)
    sealed = shading.math("SUBTRACT", 1.0, given.outputs["Soft"])
    puddle = shading.math("MULTIPLY", puddle, shading.math("MULTIPLY", level, sealed))
    damp = shading.math("MULTIPLY", amount, shading.smooth(hollows, 0.25, 0.60, 0.55, 1.0))
    shade = shading.math("SUBTRACT", 1.0, shading.math("MULTIPLY", damp, 0.60))
    dark = shading.times(given.outputs["Colour"], shade)
    shading.link(shading.mix(puddle, dark, shading.times(dark, 0.55)), result.inputs["Colour"])
    shiny = shading.math("MULTIPLY", damp, sealed)
    wet = shading.between(shiny, given.outputs["Roughness"], _WET_ROUGHNESS)
    shading.link(shading.between(puddle, wet, _PUDDLE_ROUGHNESS), result.inputs["Roughness"])
    shading.link(shading.between(shading.math("MAXIMUM", shading.math("MULTIPLY", shiny, level), puddle),
                                 given.outputs["Specular"], 0.5), result.inputs["Specular"])
    smooth = shading.vector("NORMALIZE", shading.vector("ADD", shading.times(
        given.outputs["Normal"], shading.math("SUBTRACT", 1.0, puddle)), shading.times(geometry.outputs["Normal"],
                                                                                      puddle)))
    shading.link(smooth, result.inputs["Normal"])
    return tree
