# SPDX-License-Identifier: Apache-2.0
"""Flows in the viewport: a line from place to place, with an arrow at its end."""
import math

import bpy
import gpu
from gpu_extras.batch import batch_for_shader

from .geometry import AuthoringError, outlines_of, splines_of

_HEIGHT = 0.3   # m above the ground
COLOURS = ((0.95, 0.60, 0.10), (0.20, 0.65, 0.95), (0.90, 0.30, 0.55), (0.40, 0.80, 0.35), (0.75, 0.55, 0.95),
           (0.95, 0.90, 0.35))
_handle = {}


def _position(ref, tolerance):
    """Where a place is, or None."""
    thing = ref.target
    if thing is None or thing.throng_layout.kind not in ("ROAD", "AREA", "SEATS"):
        return None
    points = splines_of(thing, tolerance)[0][0] if thing.type == "CURVE" else outlines_of(thing)[0][0]
    if thing.throng_layout.kind == "ROAD":
        return points[0 if ref.end == "start" else -1]
    return tuple(sum(values) / len(points) for values in zip(*points))


def _positions(destination, tolerance):
    return [position for position in (_position(ref, tolerance) for ref in _refs(destination)) if position]


def _refs(destination):
    if destination.mode == "SEATS":
        return destination.seats
    return [destination.place] if destination.mode == "PLACE" else destination.places


def flow_lines(flow, tolerance):
    """[(a, b)]: from its place through its stops to where people go, each of several ways."""
    here = [position for position in [_position(flow.source, tolerance)] if position]
    lines = []
    for destination in [stop.at for stop in flow.via] + [flow.to]:
        there = _positions(destination, tolerance)
        lines += [(a, b) for a in here for b in there]
        here = there or here
    return lines


def arrow(a, b, side=0.0):
    """The strokes of an arrow from a to b, bowed a little to the left, so that to and fro do not hide each other."""
    dx, dy = b[0] - a[0], b[1] - a[1]
    size = math.hypot(dx, dy) or 1.0
    ux, uy = dx / size, dy / size
    bow = 0.06 * size + side
    points = [(a[0] + dx * t - uy * bow * 4.0 * t * (1.0 - t), a[1] + dy * t + ux * bow * 4.0 * t * (1.0 - t))
              for t in (i / 16 for i in range(17))]
    tip, before = points[-1], points[-2]
    angle = math.atan2(tip[1] - before[1], tip[0] - before[0])
    head = min(1.5, 0.2 * size)
    wings = [(tip[0] - head * math.cos(angle + turn), tip[1] - head * math.sin(angle + turn)) for turn in (0.45, -0.45)]
    return list(zip(points, points[1:])) + [(tip, wing) for wing in wings]


def strokes(scene):
    """[(colour, [(a, b)])]: everything that is drawn for a scene's flows."""
    layout = scene.throng_layout
    result = []
    for index, flow in enumerate(layout.flows):
        try:
            lines = flow_lines(flow, layout.tolerance)
        except AuthoringError:  # a curve without points: export says so
            continue
        result.append((COLOURS[index % len(COLOURS)],
                       [stroke for a, b in lines for stroke in arrow(a, b, 0.15 * index)]))
    return result


def _draw():
    scene = bpy.context.scene
    if not scene.throng_layout.show_flows or not len(scene.throng_layout.flows):
        return
    shader = gpu.shader.from_builtin("UNIFORM_COLOR" if bpy.app.version >= (3, 6, 0) else "3D_UNIFORM_COLOR")
    gpu.state.line_width_set(2.0)
    for colour, lines in strokes(scene):
        batch = batch_for_shader(shader, "LINES", {"pos": [(x, y, _HEIGHT) for stroke in lines for x, y in stroke]})
        shader.bind()
        shader.uniform_float("color", (*colour, 1.0))
        batch.draw(shader)
    gpu.state.line_width_set(1.0)


def register():
    if not bpy.app.background:
        _handle["flows"] = bpy.types.SpaceView3D.draw_handler_add(_draw, (), "WINDOW", "POST_VIEW")


def unregister():
    if _handle:
        bpy.types.SpaceView3D.draw_handler_remove(_handle.pop("flows"), "WINDOW")
