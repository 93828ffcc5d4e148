# SPDX-License-Identifier: Apache-2.0
"""Parts of the panels of layouts: how distributions, places, lists and what was said about something are drawn."""
import textwrap

from .bake_operator import described
from .codecs import MIX

_A = {"NUMBER": ("Value",), "uniform": ("From", "To"), "normal": ("Mean", "Deviation"),
      "log_normal": ("Mean of log", "Deviation of log")}


def distribution(layout, owner, name):
    part = getattr(owner, name)
    column = layout.column(align=True)
    column.prop(part, "kind", text=owner.bl_rna.properties[name].name)
    labels = _A.get(part.kind, ())
    row = column.row(align=True)
    for attribute, label in zip("ab", labels):
        row.prop(part, attribute, text=label)
    if part.kind in ("normal", "log_normal"):
        for attribute in ("least", "most"):
            optional(column, part, attribute)


def optional(layout, owner, name):
    row = layout.row(align=True)
    row.prop(owner, f"use_{name}")
    inner = row.row()
    inner.active = getattr(owner, f"use_{name}")
    inner.prop(owner, name, text="")


def place(layout, ref, text="", weight=False):
    row = layout.row(align=True)
    row.prop(ref, "target", text=text)
    if ref.target is None and ref.text:
        row.prop(ref, "text", text="")
    elif ref.target is not None and ref.target.throng_layout.kind == "ROAD":
        row.prop(ref, "end", text="")
    if weight:
        row.prop(ref, "weight", text="")
    return row


def change(layout, where, action, icon, index=-1):
    operator = layout.operator("throng.list", text="", icon=icon)
    operator.where, operator.action, operator.index = where, action, index


def order(row, where, index):
    """Earlier, later, or out of a list."""
    for action, icon in (("UP", "TRIA_UP"), ("DOWN", "TRIA_DOWN"), ("REMOVE", "X")):
        change(row, where, action, icon, index)


def destination(layout, chosen, where, text="To"):
    column = layout.column(align=True)
    column.prop(chosen, "mode", text=text)
    if chosen.mode == "PLACE":
        place(column, chosen.place)
    elif chosen.mode == "SEATS":
        blocks(column, chosen.seats, f"{where}.seats")
    else:
        places(column, chosen, where, chosen.mode == "CHOOSE")


def places(layout, chosen, where, weight=False):
    for index, ref in enumerate(chosen.places):
        change(place(layout, ref, weight=weight), f"{where}.places", "REMOVE", "X", index)
    change(layout, f"{where}.places", "ADD", "ADD")


def blocks(layout, chosen, where, text="Seats"):
    """Blocks of seats."""
    row = layout.row()
    row.label(text=text)
    change(row, where, "ADD", "ADD")
    for index, block in enumerate(chosen):
        row = layout.row(align=True)
        if block.target is None and block.name:
            row.prop(block, "name", text="")
        row.prop(block, "target", text="")
        change(row, where, "REMOVE", "X", index)


def who(layout, people, where, text):
    """Flows and given people by name, formations and seats as objects."""
    row = layout.row()
    row.label(text=text)
    change(row, where, "ADD", "ADD")
    for index, member in enumerate(people):
        change(one_of(layout, member), where, "REMOVE", "X", index)


def one_of(layout, member, text=""):
    """All of them are offered by name while one types; of what is an object, that is shown."""
    row = layout.row(align=True)
    row.prop(member, "target" if member.target else "name", text=text)
    return row


def problems_of(context, layout, chosen):
    """What was said about something, beside it."""
    for index, problem in enumerate(context.scene.throng_layout.problems):
        if not chosen(problem):
            continue
        column = layout.box().column(align=True)
        column.alert = problem.is_error
        row = column.row()
        about = described(context.scene.throng_layout, problem).removesuffix(problem.message).rstrip(": ")
        row.label(text=about or "Layout", icon="ERROR" if problem.is_error else "INFO")
        if problem.target or problem.where:
            row.operator("throng.show_problem", text="", icon="RESTRICT_SELECT_OFF").index = index
        for text in (problem.message, problem.hint):
            for line in textwrap.wrap(text, letters(context)):
                column.label(text=line)


def letters(context):
    """How many letters fit into a line of the panel."""
    return max(20, int(context.region.width / (7.5 * context.preferences.system.ui_scale)) - 8)


def list_of(layout, data, name, active, kind, add=None, owner=""):
    """A list to change, and the item of it that is shown below, or None. @param owner the path to what has the list"""
    row = layout.row()
    row.template_list(kind, "", data, name, data, active, rows=3)
    column = row.column(align=True)
    if add:
        column.operator(add, text="", icon="ADD")
    else:
        change(column, owner + name, "ADD", "ADD")
    for action, icon in (("REMOVE", "REMOVE"), ("UP", "TRIA_UP"), ("DOWN", "TRIA_DOWN")):
        change(column, owner + name, action, icon, getattr(data, active))
    items = getattr(data, name)
    index = getattr(data, active)
    return items[index] if 0 <= index < len(items) else None


def people(layout, who_):
    """Who they are."""
    distribution(layout, who_, "speed")
    layout.prop(who_, "body")
    distribution(layout, who_, "radius")
    for name, weights in (("profile", "profile_weights"), ("groups", "group_weights")):
        layout.prop(who_, name)
        if getattr(who_, name) == MIX:
            layout.prop(who_, weights, text="")
    layout.prop(who_, "look")
    row = layout.row(align=True)
    row.prop(who_, "maximum_speed_factor")
    row.prop(who_, "headway")
    distribution(layout, who_, "reaction")
