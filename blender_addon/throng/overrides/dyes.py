# SPDX-License-Identifier: Apache-2.0
"""Somebody's own colour on the materials of the cast."""
from ..blender.nodes import of_person, socket
from ..people.palettes import linear


def _cast_materials(crowd):
    """Materials of all whom the crowd can show."""
    return {slot.material for thing in crowd["throng_cast"].all_objects for slot in thing.material_slots
            if slot.material}


def allow_dyes(crowd):
    """Lets the materials of top garments take somebody's own colour: the instance attributes `throng_dyed` (0
    or 1) and `throng_dye`."""
    for material in _cast_materials(crowd):
        if not material.name.startswith("throng top") or not material.use_nodes:
            continue
        nodes, links = material.node_tree.nodes, material.node_tree.links
        shader = next((node for node in nodes if node.type == "BSDF_PRINCIPLED"), None)
        if not shader or "Throng dye" in nodes:
            continue
        base = shader.inputs["Base Color"]
        mix = nodes.new("ShaderNodeMix")
        mix.name, mix.data_type = "Throng dye", "RGBA"
        own, factor, dyed = socket(mix.inputs, "A"), socket(mix.inputs, "Factor"), socket(mix.inputs, "B")
        if base.is_linked:
            links.new(base.links[0].from_socket, own)
        else:
            own.default_value = base.default_value
        for name, output, target in (("throng_dyed", "Fac", factor), ("throng_dye", "Color", dyed)):
            links.new(of_person(material.node_tree, name, output)[1], target)
        links.new(socket(mix.outputs, "Result"), base)
