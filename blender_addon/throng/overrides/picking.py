# SPDX-License-Identifier: Apache-2.0
"""Who is meant in the viewport: instances cannot be selected, so people are found by the ray through the mouse."""
import math

import bpy
import gpu
from bpy_extras import view3d_utils
from gpu_extras.batch import batch_for_shader
from mathutils import Vector

from ..blender.polls import available
from ..crowd.queries import crowd_objects

PICKED = "throng_picked"  # rows, as a text: numbers between blanks
BODY_HEIGHT, BODY_REACH = 1.75, 0.45  # m: a click this near to somebody's middle line is on them
NEAR = 1.5                            # m: a click beside everybody means the nearest within this


def instances_of(crowd, depsgraph):
    """(row, matrix) of everybody who is shown."""
    for instance in depsgraph.object_instances:
        if instance.is_instance and instance.parent and instance.parent.original == crowd:
            yield instance.persistent_id[1], instance.matrix_world


def _ray_to_body(origin, direction, feet, head):
    """How near a ray passes the line from feet to head, and how far along it does."""
    body = head - feet
    between = origin - feet
    a, b, c = direction.dot(direction), direction.dot(body), body.dot(body)
    d, e = direction.dot(between), body.dot(between)
    denominator = a * c - b * b
    along_body = (a * e - b * d) / denominator if denominator > 1e-9 else 0.5
    along_body = min(1.0, max(0.0, along_body))
    along_ray = max(0.0, (b * along_body - d) / a)
    return ((origin + direction * along_ray) - (feet + body * along_body)).length, along_ray


def person_at_ray(crowd, depsgraph, origin, direction):
    """The row of the first person that a ray meets, else of the nearest to it within NEAR; None where nobody is."""
    origin, direction = Vector(origin), Vector(direction).normalized()
    hits, misses = [], []
    for row, matrix in instances_of(crowd, depsgraph):
        feet = matrix.translation.copy()
        head = matrix @ Vector((0.0, 0.0, BODY_HEIGHT))
        distance, along = _ray_to_body(origin, direction, feet, head)
        size = (head - feet).length / BODY_HEIGHT
        if distance <= BODY_REACH * size:
            hits.append((along, row))
        else:
            misses.append((distance, row))
    if hits:
        return min(hits)[1]
    nearest = min(misses, default=None)
    return nearest[1] if nearest and nearest[0] <= NEAR else None


def picked(crowd):
    """The rows that are picked: by the picker, and those whose points are selected while the crowd is in edit mode."""
    rows = [int(word) for word in crowd.get(PICKED, "").split()]
    if crowd.mode == "EDIT":
        crowd.update_from_editmode()
        rows += [vertex.index for vertex in crowd.data.vertices if vertex.select]
    return sorted(set(rows))


def pick(crowd, rows):
    crowd[PICKED] = " ".join(str(row) for row in sorted(set(rows)))


_OTHERS = {"MIDDLEMOUSE", "WHEELUPMOUSE", "WHEELDOWNMOUSE", "MOUSEMOVE", "TIMER"}  # what the view has to hear of


class THRONG_OT_pick_people(bpy.types.Operator):
    """Click people to pick them; Shift adds or takes away. Enter or the right button ends"""

    bl_idname = "throng.pick_people"
    bl_label = "Pick People"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        in_view = context.area is not None and context.area.type == "VIEW_3D"
        return available(cls, "" if in_view else "People are picked in the 3D view; scripts name their rows instead")

    def invoke(self, context, _event):
        context.window_manager.modal_handler_add(self)
        context.window.cursor_modal_set("EYEDROPPER")
        context.workspace.status_text_set("Click people to pick them, with Shift to add; Enter "
                                          "or the right button ends")
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        if event.type in {"RET", "NUMPAD_ENTER", "ESC", "RIGHTMOUSE"} and event.value == "PRESS":
            context.window.cursor_modal_restore()
            context.workspace.status_text_set(None)
            return {"FINISHED"}
        if event.type == "LEFTMOUSE" and event.value == "PRESS":
            if not self._click(context, event):
                return {"PASS_THROUGH"}
            return {"RUNNING_MODAL"}
        return {"PASS_THROUGH"} if event.type in _OTHERS or event.ctrl else {"RUNNING_MODAL"}

    @staticmethod
    def _click(context, event):
        region = next((r for r in context.area.regions if r.type == "WINDOW"), None)
        at = (event.mouse_x - region.x, event.mouse_y - region.y) if region else (-1, -1)
        if not region or not (0 <= at[0] < region.width and 0 <= at[1] < region.height):
            return False
        view = context.space_data.region_3d
        origin = view3d_utils.region_2d_to_origin_3d(region, view, at)
        direction = view3d_utils.region_2d_to_vector_3d(region, view, at)
        pick_at(context, origin, direction, extend=event.shift)
        context.area.tag_redraw()
        return True


def pick_at(context, origin, direction, extend=False):
    """Picks whoever a ray meets in any crowd of the scene; returns (crowd, row) or None."""
    depsgraph = context.evaluated_depsgraph_get()
    found = None
    for crowd in crowd_objects(context.scene):
        row = person_at_ray(crowd, depsgraph, origin, direction)
        if row is not None and found is None:
            found = crowd, row
        elif not extend:
            pick(crowd, [])
    if found:
        crowd, row = found
        before = set(picked(crowd))
        pick(crowd, before ^ {row} if extend else [row])
        context.view_layer.objects.active = crowd
    return found


_handle = None
_rings = {}  # by crowd's name: (what they were worked out for, points)


def _rings_of(crowd, frame, depsgraph):
    """Lines round the feet of those who are picked; going through all instances is worth doing once a frame only."""
    rows = set(picked(crowd))
    wanted = (frame, frozenset(rows), tuple(item.text for item in crowd.throng_overrides))
    known, points = _rings.get(crowd.name, (None, []))
    if known == wanted:
        return points
    points = []
    for row, matrix in instances_of(crowd, depsgraph):
        if row in rows:
            ring = [matrix @ Vector((0.45 * math.cos(a), 0.45 * math.sin(a), 0.05))
                    for a in (math.tau * i / 24 for i in range(25))]
            points += [tuple(point) for pair in zip(ring, ring[1:]) for point in pair]
    _rings[crowd.name] = wanted, points
    return points


def _draw():
    context = bpy.context
    points = []
    for crowd in crowd_objects(context.scene):
        if crowd.get(PICKED) and crowd.mode != "EDIT":
            points += _rings_of(crowd, context.scene.frame_current, context.evaluated_depsgraph_get())
    if not points:
        return
    shader = gpu.shader.from_builtin("UNIFORM_COLOR" if bpy.app.version >= (4, 0, 0) else "3D_UNIFORM_COLOR")
    batch = batch_for_shader(shader, "LINES", {"pos": points})
    shader.bind()
    shader.uniform_float("color", (1.0, 0.55, 0.05, 1.0))
    batch.draw(shader)


def start_drawing():
    global _handle
    if not bpy.app.background and _handle is None:
        _handle = bpy.types.SpaceView3D.draw_handler_add(_draw, (), "WINDOW", "POST_VIEW")


def stop_drawing():
    global _handle
    if _handle is not None:
        bpy.types.SpaceView3D.draw_handler_remove(_handle, "WINDOW")
        _handle = None
