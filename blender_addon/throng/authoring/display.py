# SPDX-License-Identifier: Apache-2.0
"""How parts of a layout look in the viewport: roads as bands of their width, walls as solids, people as dots. Geometry
nodes do it, so that it follows while curves are edited; nothing of it is rendered."""
import contextlib
import math

import bpy

from . import colours, seat_drawing
from ..blender.nodes import Maths, new_tree, own_tree, set_input, socket
from .geometry import top_of

MODIFIER = seat_drawing.MODIFIER
_GEOMETRY = [("Geometry", "NodeSocketGeometry")]
_HEIGHTS = {"AREA": 0.005, "ROAD": 0.01, "PATCH": 0.015, "ARROW": 0.02}
DRAWN = ("LEVEL", "LINK", "ROAD", "AREA", "WALL", "PATCH", "SEATS")  # as curves
_ALONG = "throng_along"  # of a link's points: from 0 to 1
_MOST_SHOWN = 20000  # people of a formation
_state = {"quiet": False}


@contextlib.contextmanager
def quietly():
    """While many properties are set, nothing is refreshed."""
    _state["quiet"] = True
    try:
        yield
    finally:
        _state["quiet"] = False


def is_quiet():
    return _state["quiet"]


class _Drawing(Maths):
    """Nodes that draw."""

    def made(self, kind, inputs=(), **settings):
        node = self.node(kind, **settings)
        for name, value in inputs:
            slot = socket(node.inputs, name)
            if isinstance(value, bpy.types.NodeSocket):
                self.link(value, slot)
            else:
                slot.default_value = value
        return node

    def finish(self, geometry, kind):
        coloured = self.made("GeometryNodeSetMaterial",
                             [("Geometry", geometry), ("Material", colours.material_of(kind))])
        lifted = self.made("GeometryNodeTransform",
                           [("Geometry", coloured.outputs[0]), ("Translation", (0.0, 0.0, _HEIGHTS.get(kind, 0.0)))])
        return lifted.outputs[0]

    def sweep(self, curve, profile):
        return self.made("GeometryNodeCurveToMesh", [("Curve", curve), ("Profile Curve", profile)]).outputs[0]

    def joined(self, *geometries):
        join = self.node("GeometryNodeJoinGeometry")
        for geometry in geometries:
            self.link(geometry, join.inputs[0])
        return join.outputs[0]

    def across(self, width):
        """A profile that spans a width, to the left and right of a flat curve."""
        line = self.node("GeometryNodeCurvePrimitiveLine")
        for name, factor in (("Start", -0.5), ("End", 0.5)):
            end = self.node("ShaderNodeCombineXYZ")
            self.link(self.math("MULTIPLY", width, factor), end.inputs[0])
            self.link(end.outputs[0], line.inputs[name])
        return line.outputs[0]


def _road_tree():
    tree, inputs, outputs = new_tree("Throng drawing road",
                                     _GEOMETRY + [("Width", "NodeSocketFloat"), ("One Way", "NodeSocketFloat")],
                                     _GEOMETRY)
    draw = _Drawing(tree)
    curve, width, one_way = inputs.outputs[0], inputs.outputs["Width"], inputs.outputs["One Way"]
    band = draw.finish(draw.sweep(curve, draw.across(width)), "ROAD")
    # Arrows along one-way roads; on others, one at the start shows which end is which.
    spots = draw.made("GeometryNodeCurveToPoints", [("Curve", curve), ("Length", 4.0)], mode="LENGTH")
    first = draw.made("FunctionNodeCompare", data_type="INT", operation="EQUAL")
    draw.link(draw.node("GeometryNodeInputIndex").outputs[0], next(s for s in first.inputs if s.enabled))
    chosen = draw.math("MAXIMUM", first.outputs[0], one_way)
    arrow = draw.made("GeometryNodeMeshCircle", [("Vertices", 3), ("Radius", 0.7)], fill_type="NGON")
    arrows = draw.made("GeometryNodeInstanceOnPoints",
                       [("Points", spots.outputs["Points"]), ("Selection", draw.greater(chosen, 0.5)),
                        ("Instance", arrow.outputs[0])])
    heading = draw.made("FunctionNodeAlignEulerToVector", [("Vector", spots.outputs["Tangent"])], axis="X",
                        pivot_axis="Z")
    draw.link(heading.outputs[0], arrows.inputs["Rotation"])
    draw.link(draw.joined(band, draw.finish(arrows.outputs[0], "ARROW")), outputs.inputs[0])
    return tree


def _link_tree():
    """A band that climbs from the height of its curve."""
    tree, inputs, outputs = new_tree("Throng drawing link",
                                     _GEOMETRY + [("Width", "NodeSocketFloat"), ("Rise", "NodeSocketFloat")], _GEOMETRY)
    draw = _Drawing(tree)
    along = draw.store(inputs.outputs[0], _ALONG, draw.node("GeometryNodeSplineParameter").outputs["Factor"])
    flat = draw.sweep(along, draw.across(inputs.outputs["Width"]))
    up = draw.node("ShaderNodeCombineXYZ")
    draw.link(draw.math("MULTIPLY", draw.attribute(_ALONG), inputs.outputs["Rise"]), up.inputs[2])
    sloped = draw.made("GeometryNodeSetPosition", [("Geometry", flat), ("Offset", up.outputs[0])])
    draw.link(draw.finish(sloped.outputs[0], "LINK"), outputs.inputs[0])
    return tree


def _wall_tree():
    tree, inputs, outputs = new_tree("Throng drawing wall",
                                     _GEOMETRY + [("Thickness", "NodeSocketFloat"), ("Height", "NodeSocketFloat")],
                                     _GEOMETRY)
    draw = _Drawing(tree)
    height = inputs.outputs["Height"]
    split = draw.made("GeometryNodeSeparateGeometry", [("Geometry", inputs.outputs[0])], domain="CURVE")
    draw.link(draw.node("GeometryNodeInputSplineCyclic").outputs[0], split.inputs["Selection"])
    solid = draw.made("GeometryNodeFillCurve", [("Curve", split.outputs["Selection"])])
    bands = draw.sweep(split.outputs["Inverted"], draw.across(inputs.outputs["Thickness"]))
    floor = draw.joined(solid.outputs[0], bands)
    up = draw.node("ShaderNodeCombineXYZ")
    draw.link(height, up.inputs[2])
    top = draw.made("GeometryNodeExtrudeMesh", [("Mesh", floor), ("Offset", up.outputs[0]), ("Individual", False)],
                    mode="FACES")
    flat = draw.made("GeometryNodeSetShadeSmooth", [("Shade Smooth", False)])
    draw.link(top.outputs["Mesh"], flat.inputs[0])  # `Geometry`, later `Mesh`
    draw.link(draw.finish(flat.outputs[0], "WALL"), outputs.inputs[0])
    return tree


def _filled_tree(kind):
    tree, inputs, outputs = new_tree(f"Throng drawing {kind.lower()}", _GEOMETRY, _GEOMETRY)
    draw = _Drawing(tree)
    draw.link(draw.finish(draw.made("GeometryNodeFillCurve", [("Curve", inputs.outputs[0])]).outputs[0], kind),
              outputs.inputs[0])
    return tree


def _people_tree():
    """A dot for everybody, and the edges to their goals."""
    tree, inputs, outputs = new_tree("Throng drawing people", _GEOMETRY, _GEOMETRY)
    draw = _Drawing(tree)
    role = draw.node("GeometryNodeInputNamedAttribute", data_type="INT")
    role.inputs["Name"].default_value = "throng_role"
    stands = draw.made("FunctionNodeCompare", data_type="INT", operation="EQUAL")
    draw.link(socket(role.outputs, "Attribute"), next(s for s in stands.inputs if s.enabled))
    dot = draw.made("GeometryNodeMeshCone",
                    [("Vertices", 8), ("Radius Bottom", 0.25), ("Radius Top", 0.12), ("Depth", 1.7)])
    dots = draw.made("GeometryNodeInstanceOnPoints",
                     [("Points", inputs.outputs[0]), ("Selection", stands.outputs[0]), ("Instance", dot.outputs[0])])
    draw.link(draw.joined(inputs.outputs[0], draw.finish(dots.outputs[0], "FORMATION")), outputs.inputs[0])
    return tree


def _seats_tree():
    """What an object of its own holds, which Python builds (seat_drawing.py)."""
    tree, inputs, outputs = new_tree(seat_drawing.TREE, _GEOMETRY + [("Stand", "NodeSocketObject")], _GEOMETRY)
    draw = _Drawing(tree)
    read = draw.node("GeometryNodeObjectInfo", transform_space="ORIGINAL")
    draw.link(inputs.outputs["Stand"], read.inputs["Object"])
    draw.link(read.outputs["Geometry"], outputs.inputs[0])
    return tree


_TREES = {seat_drawing.TREE: _seats_tree, "Throng drawing road": _road_tree, "Throng drawing wall": _wall_tree,
          "Throng drawing people": _people_tree,
          "Throng drawing link": _link_tree, "Throng drawing level": lambda: _filled_tree("LEVEL"),
          "Throng drawing area": lambda: _filled_tree("AREA"), "Throng drawing patch": lambda: _filled_tree("PATCH")}


def _tree(name):
    return own_tree(name) or _TREES[name]()


def _tree_for(thing):
    kind = thing.throng_layout.kind
    if thing.type == "CURVE" and kind in DRAWN:
        return f"Throng drawing {kind.lower()}"
    return "Throng drawing people" if kind == "FORMATION" and thing.type == "MESH" else None


def refresh(thing):
    """Brings what an object shows up to date with its properties."""
    if _state["quiet"] or not isinstance(thing, bpy.types.Object):
        return
    part = thing.throng_layout
    name = _tree_for(thing)
    modifier = thing.modifiers.get(MODIFIER)
    if name is None:
        if modifier:
            thing.modifiers.remove(modifier)
        return
    if modifier is None:
        modifier = thing.modifiers.new(MODIFIER, "NODES")
    modifier.show_expanded = False
    modifier.node_group = _tree(name)
    if part.kind == "ROAD":
        set_input(modifier, "Width", part.width)
        set_input(modifier, "One Way", float(part.one_way))
    elif part.kind == "LINK":
        set_input(modifier, "Width", part.link.width)
        set_input(modifier, "Rise", _rise_of(part.link))
    elif part.kind == "WALL":
        set_input(modifier, "Thickness", part.thickness)
        set_input(modifier, "Height", part.height)
    elif part.kind == "SEATS":
        seat_drawing.show(thing, modifier)
    elif part.kind == "FORMATION" and part.formation.type != "agents":
        _show_places(thing.data, formation_places(part.formation))
    thing.update_tag()


def _rise_of(link):
    """m"""
    if link.begins is None or link.ends is None:
        return 0.0
    return top_of(link.ends) - top_of(link.begins)


def _show_places(mesh, places):
    mesh.clear_geometry()
    mesh.vertices.add(len(places))
    mesh.vertices.foreach_set("co", [part for x, y in places for part in (x, y, 0.0)])
    mesh.update()


def formation_places(formation):
    """Where the people of a circle or a grid stand, in the object's own frame, jitter aside."""
    places = []
    if formation.type == "circle":
        radius, left = formation.radius, min(formation.count, _MOST_SHOWN)
        are_apart = formation.ring_spacing > 0.0 and formation.along > 0.0
        rings = formation.use_ring_spacing and formation.use_along and are_apart
        while left > 0:
            on_ring = max(1, int(2.0 * math.pi * radius / formation.along)) if rings else formation.count
            for i in range(min(on_ring, left)):
                angle = 2.0 * math.pi * i / on_ring
                places.append((radius * math.cos(angle), radius * math.sin(angle)))
            left -= on_ring
            radius += formation.ring_spacing
        return places
    rows, columns = max(1, formation.rows), max(1, formation.columns)
    count = formation.people_count if formation.use_people_count else rows * columns
    for person in range(min(count, _MOST_SHOWN)):
        column, row = divmod(person, rows) if formation.use_people_count else divmod(person, columns)[::-1]
        places.append((column * formation.spacing, row * formation.spacing))
    return places
