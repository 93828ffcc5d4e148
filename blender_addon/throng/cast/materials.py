# SPDX-License-Identifier: Apache-2.0
"""Materials of the cast. Three random numbers a person (the instance attribute `tint`) pick its colours."""
import bpy

# Linear colours. Streets are mostly dark and muted, with a few strong accents.
PALETTES = {
    "skin": [(0.62, 0.39, 0.28), (0.50, 0.29, 0.19), (0.70, 0.47, 0.36), (0.36, 0.20, 0.125), (0.56, 0.34, 0.23),
             (0.20, 0.105, 0.065), (0.66, 0.43, 0.31), (0.10, 0.052, 0.034)],
    "hair": [(0.012, 0.009, 0.007), (0.035, 0.020, 0.011), (0.016, 0.011, 0.008), (0.10, 0.055, 0.024),
             (0.055, 0.030, 0.016), (0.22, 0.13, 0.055), (0.20, 0.19, 0.18), (0.009, 0.008, 0.008)],
    "top": [(0.018, 0.020, 0.026), (0.32, 0.31, 0.29), (0.020, 0.040, 0.095), (0.11, 0.115, 0.12), (0.21, 0.022, 0.026),
            (0.055, 0.075, 0.048), (0.29, 0.20, 0.105), (0.56, 0.54, 0.50), (0.025, 0.026, 0.028),
            (0.035, 0.105, 0.135), (0.055, 0.030, 0.060), (0.42, 0.22, 0.030), (0.17, 0.20, 0.25),
            (0.095, 0.060, 0.040)],
    "bottom": [(0.014, 0.016, 0.022), (0.030, 0.045, 0.085), (0.055, 0.080, 0.140), (0.045, 0.043, 0.042),
               (0.165, 0.135, 0.095), (0.020, 0.020, 0.022), (0.095, 0.095, 0.098), (0.060, 0.040, 0.028)],
    "shoes": [(0.010, 0.010, 0.011), (0.050, 0.026, 0.014), (0.50, 0.49, 0.47), (0.020, 0.019, 0.018),
              (0.090, 0.055, 0.030)],
    "grey": [(0.42, 0.41, 0.40), (0.30, 0.29, 0.28), (0.55, 0.54, 0.52), (0.20, 0.19, 0.185)],
    "eyes": [(0.014, 0.009, 0.006), (0.022, 0.014, 0.009), (0.020, 0.026, 0.034)],
    "extra": [(0.060, 0.028, 0.016), (0.015, 0.015, 0.017), (0.26, 0.030, 0.030), (0.030, 0.060, 0.110),
              (0.110, 0.095, 0.060), (0.35, 0.30, 0.22)],
}
# Which of the three numbers picks, and how often it goes round the palette: different multiples keep the choices
# independent.
_PICKS = {"skin": (2, 1.0), "hair": (2, 7.0), "top": (0, 1.0), "bottom": (1, 1.0), "shoes": (1, 9.0),
          "extra": (0, 11.0), "grey": (2, 7.0), "eyes": (2, 13.0)}
_ROUGHNESS = {"skin": 0.48, "hair": 0.55, "top": 0.85, "bottom": 0.85, "shoes": 0.42, "extra": 0.7, "grey": 0.55,
              "eyes": 0.15}


def _material(name):
    material = bpy.data.materials.new(f"throng {name}")
    material.use_nodes = True
    nodes, links = material.node_tree.nodes, material.node_tree.links
    shader = next(node for node in nodes if node.type == "BSDF_PRINCIPLED")
    shader.inputs["Roughness"].default_value = _ROUGHNESS[name]
    for specular in ("Specular", "Specular IOR Level"):  # renamed in Blender 4.0
        if specular in shader.inputs:
            shader.inputs[specular].default_value = 0.25 if name in ("top", "bottom") else 0.45
    attribute = nodes.new("ShaderNodeAttribute")
    attribute.attribute_type, attribute.attribute_name = "INSTANCER", "tint"
    separate = nodes.new("ShaderNodeSeparateXYZ")
    links.new(attribute.outputs["Vector"], separate.inputs[0])
    component, rounds = _PICKS[name]
    multiply = nodes.new("ShaderNodeMath")
    multiply.operation = "MULTIPLY"
    multiply.inputs[1].default_value = rounds
    links.new(separate.outputs[component], multiply.inputs[0])
    fraction = nodes.new("ShaderNodeMath")
    fraction.operation = "FRACT"
    links.new(multiply.outputs[0], fraction.inputs[0])
    ramp = nodes.new("ShaderNodeValToRGB")
    ramp.color_ramp.interpolation = "CONSTANT"
    colours = PALETTES[name]
    while len(ramp.color_ramp.elements) > 1:
        ramp.color_ramp.elements.remove(ramp.color_ramp.elements[-1])
    for index, colour in enumerate(colours):
        element = ramp.color_ramp.elements[0] if index == 0 else ramp.color_ramp.elements.new(index / len(colours))
        element.position, element.color = index / len(colours), (*colour, 1.0)
    links.new(fraction.outputs[0], ramp.inputs[0])
    links.new(ramp.outputs[0], shader.inputs["Base Color"])
    material.diffuse_color = (*colours[0], 1.0)
    return material


def cast_materials(names):
    return [_material(name) for name in names]
