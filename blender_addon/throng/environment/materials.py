# SPDX-License-Identifier: Apache-2.0
"""Procedural surfaces. Coordinates are the object's own, in metres, so patterns keep their size."""
import bpy

from .shading import not_a_lamp
from .weather import mark_soft


def _nodes_of(material):
    """(nodes, links, the shader) of a material made here."""
    nodes = material.node_tree.nodes
    return nodes, material.node_tree.links, next(node for node in nodes if node.type == "BSDF_PRINCIPLED")


def _set_specular(shader, value):
    for name in ("Specular", "Specular IOR Level"):  # before Blender 4.0, and since
        if name in shader.inputs:
            shader.inputs[name].default_value = value


def emission_of(shader):
    """The name of the input for the colour of light."""
    return "Emission Color" if "Emission Color" in shader.inputs else "Emission"  # since Blender 4.0, and before


def _base(name, colour, roughness):
    material = bpy.data.materials.new(f"throng {name}")
    material.use_nodes = True
    material.diffuse_color = (*colour, 1.0)
    nodes, links, shader = _nodes_of(material)
    shader.inputs["Base Color"].default_value = (*colour, 1.0)
    shader.inputs["Roughness"].default_value = roughness
    return material, nodes, links, shader


def plain(name, colour, roughness=0.7):
    """One colour."""
    found = bpy.data.materials.get(f"throng {name}")
    return found or _base(name, colour, roughness)[0]


def mottled(name, dark, light, scale, roughness=0.85, fine=40.0, bump=0.0):
    """Two colours mixed by coarse and fine noise: asphalt, plaster, stone."""
    found = bpy.data.materials.get(f"throng {name}")
    if found:
        return found
    material, nodes, links, shader = _base(name, light, roughness)
    position = nodes.new("ShaderNodeTexCoord").outputs["Object"]
    factors = []
    for size, detail in ((scale, 6.0), (fine, 2.0)):
        noise = nodes.new("ShaderNodeTexNoise")
        noise.inputs["Scale"].default_value = size
        noise.inputs["Detail"].default_value = detail
        links.new(position, noise.inputs["Vector"])
        factors.append(noise.outputs[0])
    mean = nodes.new("ShaderNodeMath")
    mean.operation = "ADD"
    links.new(factors[0], mean.inputs[0])
    links.new(factors[1], mean.inputs[1])
    ramp = nodes.new("ShaderNodeValToRGB")
    ramp.color_ramp.elements[0].position, ramp.color_ramp.elements[0].color = 0.36, (*dark, 1.0)
    ramp.color_ramp.elements[1].position, ramp.color_ramp.elements[1].color = 0.64, (*light, 1.0)
    half = nodes.new("ShaderNodeMath")
    half.operation = "MULTIPLY"
    half.inputs[1].default_value = 0.5
    links.new(mean.outputs[0], half.inputs[0])
    links.new(half.outputs[0], ramp.inputs[0])
    links.new(ramp.outputs[0], shader.inputs["Base Color"])
    if bump:
        node = nodes.new("ShaderNodeBump")
        node.inputs["Strength"].default_value = bump
        node.inputs["Distance"].default_value = 0.02
        links.new(factors[1], node.inputs["Height"])
        links.new(node.outputs[0], shader.inputs["Normal"])
    return material


def slabs(name, colour, joint, size):
    """Paving: slabs of `size` metres with joints, each a little different."""
    found = bpy.data.materials.get(f"throng {name}")
    if found:
        return found
    material, nodes, links, shader = _base(name, colour, 0.8)
    brick = nodes.new("ShaderNodeTexBrick")
    brick.inputs["Scale"].default_value = 1.0
    brick.inputs["Brick Width"].default_value = size
    brick.inputs["Row Height"].default_value = size * 0.6
    brick.inputs["Mortar Size"].default_value = 0.012
    brick.inputs["Color1"].default_value = (*colour, 1.0)
    brick.inputs["Color2"].default_value = (*(0.82 * c for c in colour), 1.0)
    brick.inputs["Mortar"].default_value = (*joint, 1.0)
    links.new(nodes.new("ShaderNodeTexCoord").outputs["Object"], brick.inputs["Vector"])
    links.new(brick.outputs["Color"], shader.inputs["Base Color"])
    return material


def outskirts(paving, low, high, beyond):
    """A copy of `paving` that goes over into fields `beyond` metres outside a rectangle, with rounded
    corners and a ragged edge."""
    material = paving.copy()
    material.name = "throng ground"
    nodes, links, shader = _nodes_of(material)
    place = nodes.new("ShaderNodeTexCoord").outputs["Object"]

    def vector(operation, a, b=None):
        node = nodes.new("ShaderNodeVectorMath")
        node.operation = operation
        for slot, value in zip(node.inputs, (a, b)):
            if isinstance(value, tuple):
                slot.default_value = value
            elif value is not None:
                links.new(value, slot)
        return node.outputs["Value" if operation == "LENGTH" else "Vector"]

    def noise(size, detail):
        node = nodes.new("ShaderNodeTexNoise")
        node.inputs["Scale"].default_value, node.inputs["Detail"].default_value = size, detail
        links.new(place, node.inputs["Vector"])
        return node.outputs[0]

    half = tuple(0.5 * (b - a) for a, b in zip(low, high))
    corner = 0.7 * min(half)
    from_middle = vector("ABSOLUTE", vector("SUBTRACT", vector("MULTIPLY", place, (1.0, 1.0, 0.0)),
                                            (0.5 * (low[0] + high[0]), 0.5 * (low[1] + high[1]), 0.0)))
    out = vector("LENGTH", vector("MAXIMUM", vector("SUBTRACT", from_middle, (half[0] - corner, half[1] - corner, 0.0)),
                                  (0.0, 0.0, 0.0)))
    ragged = nodes.new("ShaderNodeMath")
    ragged.operation = "MULTIPLY_ADD"
    ragged.inputs[1].default_value = 22.0
    links.new(noise(0.09, 6.0), ragged.inputs[0])
    links.new(out, ragged.inputs[2])
    edge = nodes.new("ShaderNodeMapRange")
    edge.inputs["From Min"].default_value = corner + beyond + 9.0
    edge.inputs["From Max"].default_value = corner + beyond + 13.0
    links.new(ragged.outputs[0], edge.inputs["Value"])
    mark_soft(material, edge.outputs[0])
    # Parcels of crops, meadow and bare earth, each a little uneven.
    parcels = nodes.new("ShaderNodeTexVoronoi")
    parcels.inputs["Scale"].default_value, parcels.inputs["Randomness"].default_value = 0.012, 0.85
    links.new(place, parcels.inputs["Vector"])
    crops = nodes.new("ShaderNodeValToRGB")
    crops.color_ramp.interpolation = "CONSTANT"
    while len(crops.color_ramp.elements) < 5:
        crops.color_ramp.elements.new(0.5)
    for element, (position, colour) in zip(crops.color_ramp.elements, (
        (0.0, (0.030, 0.045, 0.012)), (0.28, (0.055, 0.062, 0.020)), (0.48, (0.085, 0.066, 0.032)),
        (0.66, (0.022, 0.034, 0.010)), (0.82, (0.115, 0.095, 0.040)))):
        element.position, element.color = position, (*colour, 1.0)
    links.new(parcels.outputs["Color"], crops.inputs[0])
    fields = nodes.new("ShaderNodeHueSaturation")
    uneven = nodes.new("ShaderNodeMapRange")
    uneven.inputs["To Min"].default_value, uneven.inputs["To Max"].default_value = 0.35, 1.65
    links.new(noise(0.4, 9.0), uneven.inputs["Value"])
    links.new(uneven.outputs[0], fields.inputs["Value"])
    links.new(crops.outputs[0], fields.inputs["Color"])
    _set_specular(shader, 0.12)  # or ground far away mirrors the sky like a lake
    mix = nodes.new("ShaderNodeMixRGB")
    for source, slot in ((edge.outputs[0], "Fac"), (shader.inputs["Base Color"].links[0].from_socket, "Color1"),
                         (fields.outputs[0], "Color2")):
        links.new(source, mix.inputs[slot])
    links.new(mix.outputs[0], shader.inputs["Base Color"])
    return material


def mown(name, dark, light, width):
    """Grass, mown to and fro in stripes of `width` metres."""
    found = bpy.data.materials.get(f"throng {name}")
    if found:
        return found
    material = mottled(name, tuple(0.8 * c for c in dark), light, 0.6, 0.9, 9.0, 0.2)
    nodes, links, shader = _nodes_of(material)
    ways = nodes.new("ShaderNodeSeparateXYZ")
    links.new(nodes.new("ShaderNodeTexCoord").outputs["Object"], ways.inputs[0])
    stripe = [nodes.new("ShaderNodeMath") for _ in range(2)]
    stripe[0].operation, stripe[0].inputs[1].default_value = "PINGPONG", width
    stripe[1].operation, stripe[1].inputs[1].default_value = "GREATER_THAN", 0.5 * width
    shade = nodes.new("ShaderNodeHueSaturation")
    shade.inputs["Value"].default_value = 0.72
    for a, b in ((ways.outputs[0], stripe[0].inputs[0]), (stripe[0].outputs[0], stripe[1].inputs[0]),
                 (stripe[1].outputs[0], shade.inputs["Fac"]),
                 (shader.inputs["Base Color"].links[0].from_socket, shade.inputs["Color"])):
        links.new(a, b)
    links.new(shade.outputs[0], shader.inputs["Base Color"])
    return material


def glass():
    """Panes of cars, doors and skylights: dark behind a reflecting surface. Houses have rooms.pane()."""
    found = bpy.data.materials.get("throng glass")
    if found:
        return found
    material, _, _, shader = _base("glass", (0.018, 0.024, 0.030), 0.06)
    _set_specular(shader, 0.9)
    return material


def clear(name, colour, share):
    """A pane that one sees through. @param share of it that one does not see through"""
    found = bpy.data.materials.get(f"throng {name}")
    if found:
        return found
    material, _, _, shader = _base(name, colour, 0.04)
    _set_specular(shader, 0.6)
    shader.inputs["Alpha"].default_value = share
    if bpy.app.version < (4, 2, 0):
        material.blend_method, material.shadow_method = "BLEND", "NONE"
    else:
        material.surface_render_method = "BLENDED"
    return material


def glowing(name, colour, strength):
    """A lamp of a colour that is looked at, and lights nothing."""
    found = bpy.data.materials.get(f"throng {name}")
    if found:
        return found
    material, _, _, shader = _base(name, colour, 0.3)
    shader.inputs[emission_of(shader)].default_value = (*colour, 1.0)
    shader.inputs["Emission Strength"].default_value = strength
    not_a_lamp(material)
    return material


def glow(material, strength):
    """Lets a surface shine, warm as lamps are."""
    _, links, shader = _nodes_of(material)
    shader.inputs[emission_of(shader)].default_value = (1.0, 0.66, 0.34, 1.0)
    not_a_lamp(material)  # lamps stand there, too: what shines lights little and costs much noise
    socket = shader.inputs["Emission Strength"]
    for link in [*socket.links]:
        links.remove(link)
    socket.default_value = strength
    return material
