# SPDX-License-Identifier: Apache-2.0
"""A crowd from above as discs in the viewport, which no scene holds and no render shows."""
import math

import bpy
import gpu
import numpy
from gpu_extras.batch import batch_for_shader

_ROUND, _PLAIN = 10, 4     # corners of a disc
_MANY = 5000               # people, from which on discs are plain
_RIM = 1.35                # of a pale disc below each, which tells it from whatever it lies on: times its radius
_handle = {}


def triangles(places, radii, colours):
    """(corners, colours) of the triangles that discs are made of: (n, 3) and (n, 4), three rows to a triangle."""
    corners = _ROUND if len(places) < _MANY else _PLAIN
    angles = numpy.arange(corners) * (2.0 * math.pi / corners)
    rim = numpy.stack([numpy.cos(angles), numpy.sin(angles), numpy.zeros(corners)], 1)
    fan = numpy.stack([numpy.zeros_like(rim), rim, numpy.roll(rim, -1, 0)], 1).reshape(-1, 3)
    discs = places[:, None, :] + radii[:, None, None] * fan[None, :, :]
    shades = numpy.concatenate([colours, numpy.ones((len(colours), 1))], 1)
    return discs.reshape(-1, 3).astype(numpy.float32), numpy.repeat(shades, len(fan), 0).astype(numpy.float32)


def draw(places, radii, colours):
    """For draw handlers."""
    if not len(places):
        return
    shader = gpu.shader.from_builtin("SMOOTH_COLOR" if bpy.app.version >= (3, 6, 0) else "3D_SMOOTH_COLOR")
    gpu.state.depth_test_set("LESS_EQUAL")
    gpu.state.depth_mask_set(False)  # so that no disc hides what is drawn over it
    for larger, shades in ((_RIM, numpy.ones_like(colours)), (1.0, colours)):
        corners, each = triangles(places, larger * radii, shades)
        batch_for_shader(shader, "TRIS", {"pos": corners, "color": each}).draw(shader)
    gpu.state.depth_test_set("NONE")


def show(drawing):
    """From here on, drawing() is called whenever a 3D view is drawn."""
    hide()
    if not bpy.app.background:
        _handle["discs"] = bpy.types.SpaceView3D.draw_handler_add(drawing, (), "WINDOW", "POST_VIEW")


def hide():
    if _handle:
        bpy.types.SpaceView3D.draw_handler_remove(_handle.pop("discs"), "WINDOW")
