# SPDX-License-Identifier: Apache-2.0
"""Writes shaders as nodes that all supported versions have."""
from ..blender.nodes import Maths


def not_a_lamp(material):
    """Cycles does not look for light at a material's surfaces, though they shine."""
    cycles = getattr(material, "cycles", None)  # none where that add-on is disabled
    if cycles and hasattr(cycles, "emission_sampling"):
        cycles.emission_sampling = "NONE"
    elif cycles:
        cycles.sample_as_light = False


class Shading(Maths):
    """Arithmetic on numbers, vectors and colours in a shader's tree."""

    def _feed(self, slot, value):
        if hasattr(value, "links"):  # a socket
            self.link(value, slot)
        elif isinstance(value, tuple) and len(value) == 3 and slot.type == "RGBA":
            slot.default_value = (*value, 1.0)
        elif value is not None:
            slot.default_value = value

    def vector(self, operation, *values):
        node = self.node("ShaderNodeVectorMath", operation=operation)
        for slot, value in zip(node.inputs, values):
            self._feed(slot, value)
        return node.outputs["Value" if operation in ("LENGTH", "DOT_PRODUCT") else "Vector"]

    def times(self, vector, factor):
        """A vector, scaled by a number."""
        node = self.node("ShaderNodeVectorMath", operation="SCALE")
        self._feed(node.inputs[0], vector)
        self._feed(node.inputs["Scale"], factor)
        return node.outputs[0]

    def combine(self, x, y, z):
        node = self.node("ShaderNodeCombineXYZ")
        for slot, value in zip(node.inputs, (x, y, z)):
            self._feed(slot, value)
        return node.outputs[0]

    def separate(self, vector):
        node = self.node("ShaderNodeSeparateXYZ")
        self._feed(node.inputs[0], vector)
        return node.outputs

    def noise(self, place, scale, detail, roughness=0.5):
        node = self.node("ShaderNodeTexNoise")
        self._feed(node.inputs["Vector"], place)
        for name, value in (("Scale", scale), ("Detail", detail), ("Roughness", roughness)):
            node.inputs[name].default_value = value
        return node.outputs[0]

    def white_noise(self, place):
        """A random number for a place."""
        node = self.node("ShaderNodeTexWhiteNoise")
        self._feed(node.inputs["Vector"], place)
        return node.outputs["Value"]

    def smooth(self, value, low, high, to_low=0.0, to_high=1.0):
        """From one number to another as a value goes from `low` to `high`, without corners."""
        node = self.node("ShaderNodeMapRange", interpolation_type="SMOOTHSTEP")
        for slot, number in zip(("Value", "From Min", "From Max", "To Min", "To Max"),
                                (value, low, high, to_low, to_high)):
            self._feed(node.inputs[slot], number)
        return node.outputs[0]

    def mix(self, factor, first, second):
        """Between two colours."""
        node = self.node("ShaderNodeMixRGB")
        for slot, value in zip(("Fac", "Color1", "Color2"), (factor, first, second)):
            self._feed(node.inputs[slot], value)
        return node.outputs[0]

    def add_colours(self, first, second):
        node = self.node("ShaderNodeMixRGB", blend_type="ADD")
        for slot, value in zip(("Fac", "Color1", "Color2"), (1.0, first, second)):
            self._feed(node.inputs[slot], value)
        return node.outputs[0]

    def between(self, factor, first, second):
        """Between two numbers."""
        return self.math("MULTIPLY_ADD", self.math("SUBTRACT", second, first), factor, first)
