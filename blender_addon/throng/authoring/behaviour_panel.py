# SPDX-License-Identifier: Apache-2.0
"""Behaviours in the sidebar: the states of one, what people do in each, and what ends it."""
import bpy

from ..blender.panels import InSidebar
from . import behaviours
from .panel_parts import (
    blocks, change, destination, distribution, list_of, one_of, optional, order, place, places, problems_of, who)

_WORDS = {"near": "Within", "crowded": "Persons/m²", "chance": "Share/s"}


class THRONG_UL_behaviours(bpy.types.UIList):
    def draw_item(self, context, layout, _data, item, _icon, _active, _property, index):
        problems = context.scene.throng_layout.problems
        wrong = any(each.where == "behaviours" and each.index == index and each.is_error for each in problems)
        layout.prop(item, "name", text="", emboss=False, icon="ERROR" if wrong else "OUTLINER_OB_ARMATURE")


class THRONG_UL_states(bpy.types.UIList):
    def draw_item(self, _context, layout, data, item, _icon, _active, _property, _index):
        layout.prop(item, "name", text="", emboss=False, icon="PLAY" if item.name == data.start else "DOT")
        layout.label(text=item.does.replace("_", " "))


class VIEW3D_PT_throng_behaviours(InSidebar, bpy.types.Panel):
    bl_label = "Behaviours"
    bl_parent_id = "VIEW3D_PT_throng"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        layout, data = self.layout, context.scene.throng_layout
        behaviour = list_of(layout, data, "behaviours", "active_behaviour", "THRONG_UL_behaviours")
        if behaviour is None:
            return
        number = data.active_behaviour
        problems_of(context, layout, lambda problem: problem.where == "behaviours" and problem.index == number)
        layout.prop_search(behaviour, "start", behaviour, "states")
        owner = f"behaviours[{number}]."
        state = list_of(layout, behaviour, "states", "active_state", "THRONG_UL_states", owner=owner)
        if state is not None:
            where = f"{owner}states[{behaviour.active_state}]"
            _state(layout.box().column(), state, where, behaviour)
            _rules(layout, state, where, behaviour)


def _state(column, state, where, behaviour):
    column.prop(state, "does")
    if state.does in ("walk_to", "gather"):
        destination(column, state.to, f"{where}.to")
    elif state.does in ("wander", "queue"):
        place(column, state.place, "In")
    elif state.does == "visit":
        places(column, state.to, f"{where}.to")
        _some(column, state)
    elif state.does == "flee":
        column.prop(state, "danger")
        if state.danger is None:
            place(column, state.place, "Place")
            if state.place.target is None:
                one_of(column, state.followed, "Or from")
    elif state.does == "sit":
        blocks(column, state.seats, f"{where}.seats")
    elif state.does == "follow":
        one_of(column, state.followed, "Whom")
        optional(column, state, "person")
    for key in [codec.key for codec in behaviours.KEYS[state.does]]:
        _further(column, state, key)
    if any(codec.key == "then" for codec in behaviours.KEYS[state.does]):
        column.prop_search(state, "then", behaviour, "states")


def _further(column, state, key):
    if key == "for":
        distribution(column, state, "lasts")
    elif key == "do":
        column.prop(state, "pose")
    elif key in ("facing", "line", "spacing", "beyond", "distance", "pace", "for_good"):
        column.prop(state, key)


def _some(column, state):
    row = column.row(align=True)
    row.prop(state, "use_count")
    inner = row.row(align=True)
    inner.active = state.use_count
    inner.prop(state, "least", text="")
    inner.prop(state, "most", text="")


def _rules(layout, state, where, behaviour):
    row = layout.row()
    row.label(text="Until")
    change(row, f"{where}.until", "ADD", "ADD")
    for number, rule in enumerate(state.until):
        box, path = layout.box(), f"{where}.until[{number}]"
        for index, condition in enumerate(rule.conditions):
            row = box.row(align=True)
            row.prop(condition, "kind", text="When" if index == 0 else "and")
            change(row, f"{path}.conditions", "REMOVE", "X", index)
            _condition(box, condition, f"{path}.conditions[{index}]")
        box.prop_search(rule, "then", behaviour, "states")
        row = box.row(align=True)
        change(row, f"{path}.conditions", "ADD", "ADD")
        order(row, f"{where}.until", number)


def _condition(box, condition, path):
    kind = condition.kind
    if kind in behaviours.TIMES:
        distribution(box, condition, "time")
    elif kind in behaviours.GATES:
        box.prop(condition, "wall")
    elif kind in behaviours.LIGHTS:
        box.prop(condition.place, "text", text="Crossing or Lane")
    elif kind in behaviours.PLACES and not (kind == "near" and len(condition.who)):
        place(box, condition.place, "Place")
    if kind == "empty" or kind == "near" and not condition.place.target:
        who(box, condition.who, f"{path}.who", "Of" if kind == "empty" else "Or anybody of")
    if kind in behaviours.NUMBERS:
        box.prop(condition, "number", text=_WORDS[kind])


CLASSES = (THRONG_UL_behaviours, THRONG_UL_states, VIEW3D_PT_throng_behaviours)

register, unregister = bpy.utils.register_classes_factory(CLASSES)
