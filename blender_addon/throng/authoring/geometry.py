# SPDX-License-Identifier: Apache-2.0
"""Points out of objects, and objects out of points. In bulk: no operator is called for a point."""
import bpy
import mathutils

from . import curves


class AuthoringError(Exception):
    """A layout cannot be imported or exported; the message says why, `target` is the object it is about."""

    def __init__(self, message, target=None):
        super().__init__(message)
        self.target = target


def _mapped(matrix, flat, stride):
    """(x, y) in the world of a flat list of positions."""
    (a, b, c, d), (e, f, g, h) = matrix[0], matrix[1]
    return [(a * x + b * y + c * z + d, e * x + f * y + g * z + h)
            for x, y, z in zip(flat[::stride], flat[1::stride], flat[2::stride])]


def _values(collection, name, stride):
    flat = [0.0] * (stride * len(collection))
    collection.foreach_get(name, flat)
    return flat


def _bezier(spline, matrix, tolerance):
    knots, left, right = (_mapped(matrix, _values(spline.bezier_points, name, 3), 3)
                          for name in ("co", "handle_left", "handle_right"))
    points = [knots[0]]
    count = len(knots)
    for i in range(count if spline.use_cyclic_u else count - 1):
        j = (i + 1) % count
        points += curves.flatten(knots[i], right[i], left[j], knots[j], tolerance)
    return points[:-1] if spline.use_cyclic_u else points


def splines_of(thing, tolerance):
    """[(points in the world, cyclic)] of a curve object."""
    result = []
    for spline in thing.data.splines:
        if spline.type == "BEZIER":
            result.append((_bezier(spline, thing.matrix_world, tolerance), spline.use_cyclic_u))
        elif spline.type == "POLY":
            result.append((_mapped(thing.matrix_world, _values(spline.points, "co", 4), 4), spline.use_cyclic_u))
        else:
            raise AuthoringError(f"{thing.name} is a NURBS curve: convert it to Bezier or Poly "
                                 "(Curve > Set Spline Type)", thing)
    if not result:
        raise AuthoringError(f"{thing.name} has no points: draw its curve, or unmark it", thing)
    return result


def outlines_of(thing):
    """The footprint of a mesh object, with its modifiers, as (outlines, height)."""
    graph = bpy.context.evaluated_depsgraph_get()
    evaluated = thing.evaluated_get(graph)
    mesh = evaluated.to_mesh()
    try:
        positions = _mapped(thing.matrix_world, _values(mesh.vertices, "co", 3), 3)
        rotation = thing.matrix_world.to_3x3().inverted_safe().transposed()
        turned = -1.0 if thing.matrix_world.determinant() < 0.0 else 1.0
        faces = [list(polygon.vertices) for polygon in mesh.polygons]
        normals = [turned * (rotation @ polygon.normal).normalized().z for polygon in mesh.polygons]
        if turned < 0.0:
            faces = [face[::-1] for face in faces]
        heights = [(thing.matrix_world @ vertex.co).z for vertex in mesh.vertices]
    finally:
        evaluated.to_mesh_clear()
    outlines = curves.footprint(positions, faces, normals)
    if not outlines:
        raise AuthoringError(f"{thing.name} has no footprint: it needs at least one face", thing)
    return outlines, max(heights) - min(heights)


def _middle(points):
    """Somewhere near the middle, in whole centimetres: where an object's origin is put."""
    return [round(0.5 * (min(values) + max(values)), 2) for values in zip(*points)]


def new_curve(name, points, cyclic):
    """A flat poly curve; its origin is in its middle."""
    data = bpy.data.curves.new(name, "CURVE")
    data.dimensions = "2D"
    data.fill_mode = "NONE"
    thing = bpy.data.objects.new(name, data)
    fill_curve(thing, points, cyclic)
    return thing


def fill_curve(thing, points, cyclic):
    middle = _middle(points)
    thing.location = (*middle, 0.0)
    x0, y0, _ = thing.location  # as single floats
    spline = thing.data.splines.new("POLY")
    spline.points.add(len(points) - 1)
    spline.points.foreach_set("co", [part for x, y in points for part in (x - x0, y - y0, 0.0, 1.0)])
    spline.use_cyclic_u = cyclic


def new_arc(name, centre):
    """A curve whose points are made of numbers (seat_drawing.py); its origin is the middle of the circle."""
    data = bpy.data.curves.new(name, "CURVE")
    data.dimensions = "2D"
    data.fill_mode = "NONE"
    thing = bpy.data.objects.new(name, data)
    thing.location = (*centre, 0.0)
    return thing


ROLE, AGENT = "throng_role", "throng_agent"


def fill_people(mesh, pairs):
    """A list of people: for each an edge from where they stand to their goal, and whose it is in the layout's list."""
    mesh.clear_geometry()
    mesh.vertices.add(2 * len(pairs))
    mesh.vertices.foreach_set("co", [part for pair in pairs for x, y in pair for part in (x, y, 0.0)])
    mesh.edges.add(len(pairs))
    mesh.edges.foreach_set("vertices", range(2 * len(pairs)))
    for name, values in ((ROLE, [0, 1] * len(pairs)), (AGENT, [i + 1 for i in range(len(pairs)) for _ in (0, 1)])):
        if name not in mesh.attributes:
            mesh.attributes.new(name, "INT", "POINT")
        mesh.attributes[name].data.foreach_set("value", values)
    mesh.update()


def people_of(thing):
    """[(position, goal, number in the layout's list or -1)] of a list formation."""
    mesh = thing.data
    positions = _mapped(thing.matrix_world, _values(mesh.vertices, "co", 3), 3)

    def values(name):
        found = [0] * len(positions)
        if name in mesh.attributes:
            mesh.attributes[name].data.foreach_get("value", found)
        return found

    roles, agents = values(ROLE), values(AGENT)
    ends = [0] * (2 * len(mesh.edges))
    mesh.edges.foreach_get("vertices", ends)
    if 2 * len(mesh.edges) != len(set(ends)) or len(set(ends)) != len(positions):
        raise AuthoringError(f"{thing.name} is a list of people: an edge for each, from where they stand to "
                             "their goal, and nothing else", thing)
    pairs = [(b, a) if roles[a] > roles[b] else (a, b) for a, b in zip(ends[::2], ends[1::2])]
    result = [(positions[a], positions[b], agents[a] - 1) for a, b in pairs]
    return sorted(result, key=lambda each: each[2] if each[2] >= 0 else len(result))


def top_of(thing):
    """m: how high people walk on a level. A curve is flat, and people walk on top of a mesh."""
    if thing.type != "MESH":
        return thing.matrix_world.translation.z
    return max((thing.matrix_world @ mathutils.Vector(corner)).z for corner in thing.bound_box)
