# SPDX-License-Identifier: Apache-2.0
"""Seats and shows in the sidebar: a block of seats where the object is, and what audiences do as a list."""
import bpy

from ..blender.panels import InSidebar
from . import seat_drawing, seats
from .panel_parts import blocks, destination, distribution, list_of, optional, people, problems_of


def block_of_seats(box, thing):
    """The numbers of a block of seats."""
    part = thing.throng_layout.seats
    _told(box, thing)
    box.row().prop(part, "shape", expand=True)
    column = box.column(align=True)
    for name in ("radius", "begins", "ends") if part.shape == "ARC" else ():
        column.prop(part, name)
    for names in (("rows", "pitch", "rise", "height"), ("width", "occupancy")):
        column = box.column(align=True)
        for name in names:
            column.prop(part, name)
    column = box.column(align=True)
    column.prop(part, "aisles")
    if part.aisles > 0:
        column.prop(part, "aisle_width")
        _mouths(box, part.mouths)
    box.prop(part, "facing")
    box.prop(part, "on_terrain")
    box.prop(part, "use_leave")
    if part.use_leave:
        distribution(box, part, "leave_at")
        destination(box, part.leave_to, "seats.leave_to")
    people(box.box().column(), part.people)


def _mouths(box, mouths):
    column = box.column()
    column.prop(mouths, "at", text="Out")
    if mouths.at == "row":
        column.prop(mouths, "row")
    if mouths.at != "front":
        optional(column, mouths, "passage")
        column.prop(mouths, "level")


def _told(box, thing):
    """How many seats there are, or why none is drawn."""
    stand = seat_drawing.stand_of(thing)
    if stand is None:
        return
    problem = stand.get("throng_problem", "")
    if problem:
        box.label(text=problem[:1].upper() + problem[1:], icon="ERROR")
    else:
        box.label(text=f"{stand.get('throng_seats', 0):,} seats", icon="COMMUNITY")


class THRONG_UL_shows(bpy.types.UIList):
    def draw_item(self, context, layout, _data, item, _icon, _active, _property, index):
        problems = context.scene.throng_layout.problems
        wrong = any(each.where == "shows" and each.index == index and each.is_error for each in problems)
        where = ", ".join(block.target.name if block.target else block.name for block in item.who)
        layout.label(text=f"{item.do.capitalize()}: {where or 'everywhere'}", icon="ERROR" if wrong else "FORCE_WIND")


class VIEW3D_PT_throng_shows(InSidebar, bpy.types.Panel):
    bl_label = "Shows"
    bl_parent_id = "VIEW3D_PT_throng"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        layout, data = self.layout, context.scene.throng_layout
        show = list_of(layout, data, "shows", "active_show", "THRONG_UL_shows")
        if show is None:
            return
        number = data.active_show
        problems_of(context, layout, lambda problem: problem.where == "shows" and problem.index == number)
        layout.prop(show, "do")
        distribution(layout, show, "time")
        if seats.is_wave(show.do):
            layout.prop(show, "origin")
            for name in ("speed", "width", "laps"):
                layout.prop(show, name)
        else:
            distribution(layout, show, "lasts")
        layout.prop(show, "share")
        distribution(layout, show, "reaction")
        blocks(layout, show.who, f"shows[{number}].who", "Who (by default everybody)")


CLASSES = (THRONG_UL_shows, VIEW3D_PT_throng_shows)

register, unregister = bpy.utils.register_classes_factory(CLASSES)
