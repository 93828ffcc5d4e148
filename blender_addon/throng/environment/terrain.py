# SPDX-License-Identifier: Apache-2.0
"""The terrain that a bake brings along, as the ground."""
import bpy
import numpy

from ..blender.meshes import fill_with_triangles
from ..setting import horizon
from . import materials
from .shapes import inside
from .streets import _pieces, build_country
from .weather import mark_soft, weathered

ROAD = "throng_road"  # 1 on roads and areas, 0 beside them


def _on_road(pieces, x, y):
    """How much of a place belongs to a road or an area: it fades over half a metre beside it."""
    best = 0.0
    for a, along, size, half in pieces:
        dx, dy = x - a[0], y - a[1]
        t = dx * along[0] + dy * along[1]
        beyond = max(-t, t - size, abs(along[0] * dy - along[1] * dx) - half)
        best = max(best, min(1.0, max(0.0, 1.0 - 2.0 * beyond)))
    return best


def _shares(positions, geometry):
    """Per corner, 1 on roads and areas and 0 beside them."""
    pieces = [(a, along, size, 0.5 * float(road["width"])) for road in geometry.get("roads", [])
              for a, _, along, size in _pieces(road)]
    areas = [[tuple(point) for point in area["polygon"]] for area in geometry.get("areas", [])]
    return [max(_on_road(pieces, x, y), 1.0 if any(inside(area, (x, y)) for area in areas) else 0.0)
            for x, y in zip(positions[0::3], positions[1::3])]


_MEADOW = 45.0  # m round a terrain; fields begin beyond


def build_terrain(positions, corners, manifest):
    """The ground and what is round it, as objects."""
    border, lid = horizon.border_of(positions, corners)
    low, high = (tuple(pick(p[axis] for p in border) for axis in range(2)) for pick in (min, max))
    around = weathered(materials.outskirts(_material(), low, high, _MEADOW))
    thing = _terrain(positions, corners, manifest)
    weathered(thing.data.materials[0])
    return [thing, build_country(border, around, lid)]


def _terrain(positions, corners, manifest):
    mesh = bpy.data.meshes.new("Throng terrain")
    fill_with_triangles(mesh, numpy.reshape(positions, (-1, 3)), corners)
    mesh.polygons.foreach_set("use_smooth", [True] * len(mesh.polygons))
    # Floors above each other are paved.
    shares = ([1.0] * (len(positions) // 3) if manifest["terrain"].get("surface") == "levels"
              else _shares(positions, manifest.get("geometry") or {}))
    mesh.attributes.new(ROAD, "FLOAT", "POINT").data.foreach_set("value", shares)
    mesh.materials.append(_material())
    mesh.validate()
    mesh.update()
    return bpy.data.objects.new("Throng terrain", mesh)


def _material():
    """Grass and bare earth, trodden on roads and areas."""
    found = bpy.data.materials.get("throng terrain")
    if found:
        return found
    material = materials.mottled("terrain", (0.075, 0.085, 0.035), (0.17, 0.16, 0.075), 0.22, 0.95, 14.0, 0.3)
    nodes, links = material.node_tree.nodes, material.node_tree.links
    shader = next(node for node in nodes if node.type == "BSDF_PRINCIPLED")
    grass = shader.inputs["Base Color"].links[0].from_socket
    noise = next(node for node in nodes if node.type == "TEX_NOISE")
    earth = nodes.new("ShaderNodeValToRGB")
    earth.color_ramp.elements[0].position, earth.color_ramp.elements[0].color = 0.3, (0.20, 0.155, 0.105, 1.0)
    earth.color_ramp.elements[1].position, earth.color_ramp.elements[1].color = 0.7, (0.34, 0.29, 0.215, 1.0)
    links.new(noise.outputs[0], earth.inputs[0])
    share = nodes.new("ShaderNodeAttribute")
    share.attribute_name = ROAD
    ragged = nodes.new("ShaderNodeMath")  # the edge wanders with the noise
    ragged.operation = "ADD"
    links.new(share.outputs["Fac"], ragged.inputs[0])
    links.new(noise.outputs[0], ragged.inputs[1])
    edge = nodes.new("ShaderNodeMapRange")
    edge.inputs["From Min"].default_value, edge.inputs["From Max"].default_value = 0.85, 1.15
    links.new(ragged.outputs[0], edge.inputs["Value"])
    grown = nodes.new("ShaderNodeMath")
    grown.operation, grown.inputs[0].default_value = "SUBTRACT", 1.0
    links.new(edge.outputs[0], grown.inputs[1])
    mark_soft(material, grown.outputs[0])
    mix = nodes.new("ShaderNodeMixRGB")
    links.new(edge.outputs[0], mix.inputs[0])
    links.new(grass, mix.inputs[1])
    links.new(earth.outputs[0], mix.inputs[2])
    links.new(mix.outputs[0], shader.inputs["Base Color"])
    return material
