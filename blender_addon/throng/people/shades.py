# SPDX-License-Identifier: Apache-2.0
"""A few words for making materials of nodes."""
import bpy

from ..blender.nodes import socket


class Shade:
    """A new material with one principled shader."""

    def __init__(self, name):
        self.material = bpy.data.materials.new(name)
        self.material.use_nodes = True
        self.tree = self.material.node_tree
        self.shader = next(node for node in self.tree.nodes if node.type == "BSDF_PRINCIPLED")

    def see_through(self):
        """For a shader whose alpha is not 1 everywhere."""
        if bpy.app.version < (4, 2, 0):
            self.material.blend_method, self.material.shadow_method = "HASHED", "HASHED"
        else:
            self.material.surface_render_method = "DITHERED"

    def node(self, kind, **settings):
        made = self.tree.nodes.new(kind)
        for name, value in settings.items():
            setattr(made, name, value)
        return made

    def link(self, value, target):
        """A socket, a number or a colour, into a socket."""
        if isinstance(value, bpy.types.NodeSocket):
            self.tree.links.new(value, target)
        elif isinstance(value, (int, float)):
            target.default_value = value
        else:
            target.default_value = (*value, 1.0) if len(target.default_value) == 4 else value

    def set(self, value, *names):
        """Into the shader's input, which has had several names."""
        for name in names:
            if name in self.shader.inputs:
                self.link(value, self.shader.inputs[name])
                return

    def attribute(self, name, kind="GEOMETRY", output="Vector"):
        return self.node("ShaderNodeAttribute", attribute_name=name, attribute_type=kind).outputs[output]

    def split(self, vector):
        made = self.node("ShaderNodeSeparateXYZ")
        self.link(vector, made.inputs[0])
        return tuple(made.outputs)

    def combine(self, *values):
        made = self.node("ShaderNodeCombineXYZ")
        for value, target in zip(values, made.inputs):
            self.link(value, target)
        return made.outputs[0]

    def math(self, operation, *values):
        made = self.node("ShaderNodeMath", operation=operation)
        for value, target in zip(values, made.inputs):
            self.link(value, target)
        return made.outputs[0]

    def mix(self, first, second, share, blend="MIX"):
        made = self.node("ShaderNodeMix", data_type="RGBA", blend_type=blend)
        colours = [each for each in made.inputs if each.type == "RGBA"]
        factor = next(each for each in made.inputs if each.type == "VALUE")
        for value, target in zip((share, first, second), (factor, *colours)):
            self.link(value, target)
        return socket(made.outputs, "Result")

    def noise(self, vector, scale, detail=2.0, stretch=None):
        if stretch:
            mapping = self.node("ShaderNodeMapping")
            mapping.inputs["Scale"].default_value = stretch
            self.link(vector, mapping.inputs[0])
            vector = mapping.outputs[0]
        made = self.node("ShaderNodeTexNoise")
        self.link(vector, made.inputs["Vector"])
        made.inputs["Scale"].default_value, made.inputs["Detail"].default_value = scale, detail
        return made.outputs["Fac"] if "Fac" in made.outputs else made.outputs[0]

    def bump(self, height, strength, distance, before=None):
        made = self.node("ShaderNodeBump")
        made.inputs["Strength"].default_value, made.inputs["Distance"].default_value = strength, distance
        self.link(height, made.inputs["Height"])
        if before:
            self.link(before, made.inputs["Normal"])
        return made.outputs["Normal"]

    def palette(self, number, rounds, colours):
        """One of some colours, by a number that goes round the palette so many times."""
        share = self.math("FRACT", self.math("MULTIPLY", number, rounds))
        ramp = self.node("ShaderNodeValToRGB")
        ramp.color_ramp.interpolation = "CONSTANT"
        while len(ramp.color_ramp.elements) > 1:
            ramp.color_ramp.elements.remove(ramp.color_ramp.elements[-1])
        for index, colour in enumerate(colours):
            at = index / len(colours)
            element = ramp.color_ramp.elements[0] if index == 0 else ramp.color_ramp.elements.new(at)
            element.position, element.color = at, (*colour, 1.0)
        self.link(share, ramp.inputs[0])
        self.material.diffuse_color = (*colours[0], 1.0)
        return ramp.outputs[0]
