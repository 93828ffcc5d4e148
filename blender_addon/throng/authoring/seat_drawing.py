# SPDX-License-Identifier: Apache-2.0
"""Blocks of seats in the viewport: rows, aisles, flights of steps, openings and passages as a bake will have them.

They are a mesh of an object that is in no scene, which the modifier of the block's curve reads, in the curve's own
frame: it is moved and turned with it, and built anew only when numbers or points have changed.
"""
import math

import bpy
import numpy
from bpy.app.handlers import persistent

from ..blender.meshes import fill
from ..blender.nodes import get_input, own_tree, set_input
from ..cast import seat_rows
from ..environment import stands
from . import colours, seat_plan
from .geometry import AuthoringError, splines_of, top_of

MODIFIER, TREE = "Throng drawing", "Throng drawing seats"
_SLOTS = {"stone": 0, "seat": 1, "passage": 2}
_NUMBERS = ("shape", "radius", "begins", "ends", "rows", "pitch", "width", "rise", "height", "aisles", "aisle_width",
            "use_leave")
_MOUTHS = ("at", "row", "use_passage", "passage")
_SEEN = 5  # decimals of what makes a difference


def _grounds(scene, thing):
    """m: how high the ground is of a block, and at the foot of its passages."""
    levels = [each for each in scene.objects if each.throng_layout.kind == "LEVEL"]
    first = min(levels, key=lambda level: (level.throng_layout.order, level.name), default=None)
    own, foot = thing.throng_layout.level, thing.throng_layout.seats.mouths.level
    ground = top_of(own) if own in levels else 0.0
    beside = own if own in levels else first  # unless told, the first one's
    return ground, top_of(foot) if foot in levels else top_of(beside) if beside else 0.0


def walked_in(scene):
    """Names of blocks to whose seats people walk, or leave them."""
    layout, goals = scene.throng_layout, _goals_in(scene)
    blocks = [block for goal in goals if goal.mode == "SEATS" for block in goal.seats]
    states = [state for behaviour in layout.behaviours for state in behaviour.states]
    blocks += [block for state in states if state.does == "sit" for block in state.seats]
    left = (each for each in _blocks_in(scene) if each.throng_layout.seats.use_leave)
    return {thing.name for thing in (*left, *(block.target for block in blocks)) if thing}


def _goals_in(scene):
    parts = [thing.throng_layout for thing in scene.objects]
    return [*(flow.to for flow in scene.throng_layout.flows),
            *(part.formation.goal for part in parts if part.kind == "FORMATION")]


def _blocks_in(scene):
    return [thing for thing in scene.objects if thing.throng_layout.kind == "SEATS"]


def _first_row(thing, tolerance):
    """In the world, as it is exported."""
    seats, matrix = thing.throng_layout.seats, thing.matrix_world
    if seats.shape == "LINE":
        return splines_of(thing, tolerance)[0][0]
    (a, b, _, x), (c, d, _, y) = matrix[0], matrix[1]
    turn, ends = math.degrees(math.atan2(c, a)), (seats.begins, _end_of(seats))
    ends = (turn - ends[1], turn - ends[0]) if a * d < b * c else (turn + ends[0], turn + ends[1])
    return seat_plan.arc_front((x, y), seats.radius * abs(matrix.to_scale().x), *ends)


def _end_of(seats):
    """Of an arc that cannot be, one that can be seen."""
    return min(max(seats.ends, seats.begins + 1.0), seats.begins + 360.0)


def block_of(scene, thing, walked):
    """The numbers of a block, for its plan. Raises AuthoringError where its curve is none. @param walked walked_in()"""
    seats, mouths = thing.throng_layout.seats, thing.throng_layout.seats.mouths
    ground, foot = _grounds(scene, thing)
    return seat_plan.Block(
        front=_first_row(thing, scene.throng_layout.tolerance), rows=seats.rows, pitch=seats.pitch, width=seats.width,
        rise=seats.rise, height=seats.height + ground, aisles=seats.aisles, aisle_width=seats.aisle_width,
        mouths=mouths.at, mouth_row=mouths.row, passage=mouths.passage if mouths.use_passage else None,
        foot=foot, walked=thing.name in walked)


def _plain_seats(plan):
    """(seats, faces, corners, 3) of all of a block: what is sat on, and what is leant on, from both sides."""
    faces = seat_rows.seat_faces((0.0, 0.0), (1.0, 0.0), 0.0, seat_rows.SIDE * float(plan["width"]))
    aside, forward, up = numpy.moveaxis(numpy.array([faces[1], faces[2], faces[4]]), -1, 0)
    seats = [(*place, *way, height) for row in plan["rows"] for place, way, height in seat_rows.seats_of(plan, row)]
    x, y, along_x, along_y, height = numpy.reshape(seats, (-1, 5)).T[:, :, None, None]
    return numpy.stack([x + along_x * aside - along_y * forward, y + along_y * aside + along_x * forward, height + up],
                       axis=-1)


def _fill(mesh, plan, matrix):
    """@param matrix from the world to the object"""
    built = list(stands.built_of(plan))
    seats = _plain_seats(plan)
    sizes = [len(face) for face, _ in built] + [seats.shape[2]] * (seats.shape[0] * seats.shape[1])
    slots = [_SLOTS[of] for _, of in built] + [_SLOTS["seat"]] * (len(sizes) - len(built))
    points = numpy.concatenate([numpy.reshape([corner for face, _ in built for corner in face], (-1, 3)),
                                seats.reshape(-1, 3)])
    turn, shift = numpy.array(matrix)[:3, :3], numpy.array(matrix)[:3, 3]
    fill(mesh, points @ turn.T + shift, numpy.arange(len(points)), sizes)
    mesh.polygons.foreach_set("material_index", slots)
    mesh.polygons.foreach_set("use_smooth", [False] * len(sizes))
    mesh.update(calc_edges=True)


def _signature(scene, thing, walked):
    """What the drawing depends on."""
    seats, matrix = thing.throng_layout.seats, thing.matrix_world
    points = []
    if seats.shape == "LINE":
        for spline in thing.data.splines:
            some = spline.bezier_points if spline.type == "BEZIER" else spline.points
            points += [spline.type, spline.use_cyclic_u]
            for name in ("co", "handle_left", "handle_right") if spline.type == "BEZIER" else ("co",):
                flat = [0.0] * (len(some) * (3 if spline.type == "BEZIER" else 4))
                some.foreach_get(name, flat)
                points += [round(value, _SEEN) for value in flat]
    turned = matrix.to_3x3()
    shape = [value for row in turned.transposed() @ turned for value in row] + list(turned[2])
    return repr([points, [round(value, _SEEN) for value in shape], turned.determinant() > 0.0,
                 *(getattr(seats, name) for name in _NUMBERS), *(getattr(seats.mouths, name) for name in _MOUTHS),
                 thing.name in walked, _grounds(scene, thing), scene.throng_layout.tolerance])


def stand_of(thing):
    """The object that holds what is drawn of a block, or None."""
    modifier = thing.modifiers.get(MODIFIER) if thing.throng_layout.kind == "SEATS" else None
    return get_input(modifier, "Stand") if modifier and modifier.node_group else None


def show(thing, modifier, walked=None):
    """Brings what is drawn of a block up to date. @param walked walked_in() its scene, where it is known"""
    scene = next(iter(thing.users_scene), None)
    if scene is None:
        return
    walked = walked_in(scene) if walked is None else walked
    _keep_arc(thing)
    signature, stand = _signature(scene, thing, walked), get_input(modifier, "Stand")
    if stand is not None and stand.get("throng_signature") == signature:
        return
    if stand is None or stand.users > 1:  # a copy shows what it was copied from until it is another
        mesh = bpy.data.meshes.new("Throng seats")
        for kind in ("SEATS", "SEAT", "PASSAGE"):
            mesh.materials.append(colours.material_of(kind))
        stand = bpy.data.objects.new("Throng seats", mesh)
        set_input(modifier, "Stand", stand)
    _draw(scene, thing, stand, walked)
    stand["throng_signature"] = signature
    thing.update_tag()


def _draw(scene, thing, stand, walked):
    stand.data.clear_geometry()
    stand["throng_seats"], stand["throng_problem"] = 0, ""
    try:
        made = seat_plan.plan_of(block_of(scene, thing, walked))
    except AuthoringError as error:
        stand["throng_problem"] = str(error)
        return
    if made is None:
        stand["throng_problem"] = "rows so far behind a first row that bends so sharply cross themselves"
        return
    plan, stand["throng_seats"] = made
    if not plan["rows"]:
        stand["throng_problem"] = "there is room for no seat"
        return
    frame = thing.matrix_world.copy()
    frame.translation.z = 0.0  # heights are drawn over where the object is
    _fill(stand.data, plan, frame.inverted_safe())


def _keep_arc(thing):
    """The curve of an arc is its first row, whatever has been done to its points."""
    seats = thing.throng_layout.seats
    if seats.shape != "ARC" or thing.mode == "EDIT":
        return
    wanted = [part for x, y in seat_plan.arc_front((0.0, 0.0), seats.radius, seats.begins, _end_of(seats))
              for part in (x, y, 0.0, 1.0)]
    splines = thing.data.splines
    if len(splines) == 1 and splines[0].type == "POLY" and 4 * len(splines[0].points) == len(wanted):
        found = [0.0] * len(wanted)
        splines[0].points.foreach_get("co", found)
        if max(abs(a - b) for a, b in zip(found, wanted)) < 1e-3:
            return
    splines.clear()
    spline = splines.new("POLY")
    spline.points.add(len(wanted) // 4 - 1)
    spline.points.foreach_set("co", wanted)


@persistent
def follow(scene, graph):
    """Curves are shaped, objects are scaled, and what a block is like may hang on other things of the layout."""
    tree = own_tree(TREE)
    if tree is None or not tree.users:  # there are no seats
        return
    if not any(isinstance(update.id, (bpy.types.Object, bpy.types.Curve, bpy.types.Scene)) for update in graph.updates):
        return
    walked = walked_in(scene)
    for thing in _blocks_in(scene):
        if thing.type == "CURVE" and thing.library is None:
            modifier = thing.modifiers.get(MODIFIER)
            if modifier and modifier.node_group:
                show(thing, modifier, walked)


def forget(stand):
    """When a block goes, so does what was drawn of it."""
    if stand is not None and not stand.users:
        mesh = stand.data
        bpy.data.objects.remove(stand)
        bpy.data.meshes.remove(mesh)


def register():
    bpy.app.handlers.depsgraph_update_post.append(follow)


def unregister():
    bpy.app.handlers.depsgraph_update_post.remove(follow)
