# SPDX-License-Identifier: Apache-2.0
"""The layout in the sidebar: drawing, the active part, flows, events, simulation, bars, and baking."""
import textwrap

import bpy

from ..blender.panels import InSidebar
from . import fields
from .bake_operator import described, running
from .codecs import MIX, UNSET
from .values import MISSING

_A = {"NUMBER": ("Value",), "uniform": ("From", "To"), "normal": ("Mean", "Deviation"),
      "log_normal": ("Mean of log", "Deviation of log")}


def _distribution(layout, owner, name):
    part = getattr(owner, name)
    column = layout.column(align=True)
    column.prop(part, "kind", text=owner.bl_rna.properties[name].name)
    labels = _A.get(part.kind, ())
    row = column.row(align=True)
    for attribute, label in zip("ab", labels):
        row.prop(part, attribute, text=label)
    if part.kind in ("normal", "log_normal"):
        for attribute in ("least", "most"):
            _optional(column, part, attribute)


def _optional(layout, owner, name):
    row = layout.row(align=True)
    row.prop(owner, f"use_{name}")
    inner = row.row()
    inner.active = getattr(owner, f"use_{name}")
    inner.prop(owner, name, text="")


def _people(layout, people):
    _distribution(layout, people, "speed")
    _distribution(layout, people, "radius")
    for name, weights in (("profile", "profile_weights"), ("groups", "group_weights")):
        layout.prop(people, name)
        if getattr(people, name) == MIX:
            layout.prop(people, weights, text="")
    layout.prop(people, "look")
    row = layout.row(align=True)
    row.prop(people, "maximum_speed_factor")
    row.prop(people, "headway")
    _distribution(layout, people, "reaction")


def _place(layout, ref, text="", weight=False):
    row = layout.row(align=True)
    row.prop(ref, "target", text=text)
    if ref.target is None and ref.text:
        row.prop(ref, "text", text="")
    elif ref.target is not None and ref.target.throng_layout.kind == "ROAD":
        row.prop(ref, "end", text="")
    if weight:
        row.prop(ref, "weight", text="")
    return row


def _change(layout, where, action, icon, index=-1):
    operator = layout.operator("throng.list", text="", icon=icon)
    operator.where, operator.action, operator.index = where, action, index


def _destination(layout, destination, where, text="To"):
    column = layout.column(align=True)
    column.prop(destination, "mode", text=text)
    if destination.mode == "PLACE":
        _place(column, destination.place)
        return
    for index, ref in enumerate(destination.places):
        _change(_place(column, ref, weight=destination.mode == "CHOOSE"), f"{where}.places", "REMOVE", "X", index)
    _change(column, f"{where}.places", "ADD", "ADD")


def _problems_of(context, layout, chosen):
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
            for line in textwrap.wrap(text, _letters(context)):
                column.label(text=line)


def _letters(context):
    """How many letters fit into a line of the panel."""
    return max(20, int(context.region.width / (7.5 * context.preferences.system.ui_scale)) - 8)


class VIEW3D_PT_throng_layout(InSidebar, bpy.types.Panel):
    bl_label = "Layout"
    bl_parent_id = "VIEW3D_PT_throng"

    def draw(self, context):
        layout = self.layout
        grid = layout.grid_flow(columns=2, align=True)
        for part, icon in (("road", "CURVE_PATH"), ("wall", "MOD_SOLIDIFY"), ("area", "MESH_PLANE"),
                           ("patch", "SHADING_TEXTURE"), ("formation", "COMMUNITY"), ("line", "IPO_LINEAR")):
            grid.operator(f"throng.add_{part}", icon=icon)
        layout.operator_menu_enum("throng.mark", "kind")
        if context.object:
            self._part(context, context.object)
        row = layout.row(align=True)
        row.prop(context.scene.throng_layout, "show_flows", text="Flows", toggle=True)
        row.prop(context.scene.throng_layout, "show_solid", text="Solid", toggle=True)

    def _part(self, context, thing):
        part = thing.throng_layout
        if part.kind == "NONE":
            return
        box = self.layout.box()
        box.prop(thing, "name", text=part.kind.capitalize())
        names = {"ROAD": ("width", "one_way"), "WALL": ("thickness", "height") if thing.type == "CURVE" else ()}
        for name in names.get(part.kind, ()):
            box.prop(part, name)
        if part.kind == "PATCH":
            _optional(box, part.patch, "cost")
            box.prop(part.patch, "pace")
            box.prop(part.patch, "begins")
            _optional(box, part.patch, "ends")
        if part.kind == "FORMATION":
            self._formation(box, part.formation)
        _problems_of(context, box, lambda problem: problem.target == thing)

    @staticmethod
    def _formation(box, formation):
        box.prop(formation, "type")
        names = {"circle": ("radius", "count"), "grid": ("rows", "columns", "spacing", "jitter")}
        for name in names.get(formation.type, ()):
            box.prop(formation, name)
        for name in {"circle": ("ring_spacing", "along"), "grid": ("people_count",)}.get(formation.type, ()):
            _optional(box, formation, name)
        if formation.type == "grid":
            box.prop(formation, "goal_kind")
            if formation.goal_kind == "PLACE":
                _destination(box, formation.goal, "formation.goal", "")
            elif formation.goal_kind == "OFFSET":
                box.prop(formation, "goal_offset", text="")
            else:
                box.prop(formation, "goal_line", text="")
        box.prop(formation, "start")
        _distribution(box, formation, "wait")
        box.prop(formation, "arrival")
        box.prop(formation, "goal_tolerance")
        _people(box.column(), formation.people)


class THRONG_UL_flows(bpy.types.UIList):
    def draw_item(self, context, layout, _data, item, _icon, _active, _property, index):
        problems = context.scene.throng_layout.problems
        wrong = any(problem.where == "flows" and problem.index == index and problem.is_error for problem in problems)
        layout.prop(item, "name", text="", emboss=False, icon="ERROR" if wrong else "FORWARD")
        layout.label(text=f"{item.count}" if item.amount == "COUNT" else f"{item.rate:g}/s")


class THRONG_UL_events(bpy.types.UIList):
    def draw_item(self, context, layout, _data, item, _icon, _active, _property, index):
        problems = context.scene.throng_layout.problems
        wrong = any(problem.where == "events" and problem.index == index and problem.is_error for problem in problems)
        wall = item.wall.name if item.wall else item.text
        what = {"open": wall, "close": wall, "flow": item.flow}.get(item.kind, "")
        layout.label(text=f"{item.time:g} s: {item.kind.replace('_', ' ')} {what}", icon="ERROR" if wrong else "TIME")


def _list(layout, data, name, active, kind, add=None):
    row = layout.row()
    row.template_list(kind, "", data, name, data, active, rows=3)
    column = row.column(align=True)
    if add:
        column.operator(add, text="", icon="ADD")
    else:
        _change(column, name, "ADD", "ADD")
    for action, icon in (("REMOVE", "REMOVE"), ("UP", "TRIA_UP"), ("DOWN", "TRIA_DOWN")):
        _change(column, name, action, icon, getattr(data, active))
    items = getattr(data, name)
    index = getattr(data, active)
    return items[index] if 0 <= index < len(items) else None


class VIEW3D_PT_throng_flows(InSidebar, bpy.types.Panel):
    bl_label = "Flows"
    bl_parent_id = "VIEW3D_PT_throng"

    def draw(self, context):
        layout, data = self.layout, context.scene.throng_layout
        flow = _list(layout, data, "flows", "active_flow", "THRONG_UL_flows", "throng.add_flow")
        if flow is None:
            return
        where = f"flows[{data.active_flow}]"
        _problems_of(context, layout, lambda problem: problem.where == "flows" and problem.index == data.active_flow)
        _place(layout, flow.source, "From")
        _destination(layout, flow.to, f"{where}.to")
        row = layout.row(align=True)
        row.prop(flow, "amount", text="")
        if flow.amount != "KEPT":
            row.prop(flow, "count" if flow.amount == "COUNT" else "rate")
        layout.prop(flow, "start")
        _optional(layout, flow, "end")
        layout.prop(flow, "arrival")
        self._stops(layout, flow, where)
        _people(layout.box().column(), flow.people)

    @staticmethod
    def _stops(layout, flow, where):
        row = layout.row()
        row.label(text="On the Way")
        _change(row, f"{where}.via", "ADD", "ADD")
        for index, stop in enumerate(flow.via):
            box = layout.box()
            _destination(box, stop.at, f"{where}.via[{index}].at", "At")
            _distribution(box, stop, "wait")
            if stop.wait.kind != UNSET:
                box.prop(stop, "activity")
                if stop.activity == "queue":
                    box.prop(stop, "line")
                    box.prop(stop, "spacing")
                else:
                    box.prop(stop, "facing")
            row = box.row(align=True)
            for action, icon in (("UP", "TRIA_UP"), ("DOWN", "TRIA_DOWN"), ("REMOVE", "X")):
                _change(row, f"{where}.via", action, icon, index)


class VIEW3D_PT_throng_events(InSidebar, bpy.types.Panel):
    bl_label = "Events"
    bl_parent_id = "VIEW3D_PT_throng"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        layout, data = self.layout, context.scene.throng_layout
        event = _list(layout, data, "events", "active_event", "THRONG_UL_events")
        if event is None:
            return
        _problems_of(context, layout, lambda problem: problem.where == "events" and problem.index == data.active_event)
        layout.prop(event, "time")
        layout.prop(event, "kind")
        if event.kind in ("open", "close"):
            layout.prop(event, "wall")
        elif event.kind == "flow":
            layout.prop_search(event, "flow", data, "flows")
            layout.prop(event, "rate")
        else:
            where = f"events[{data.active_event}]"
            _destination(layout, event.destination, f"{where}.destination")
            layout.prop(event, "arrival")
            row = layout.row()
            row.label(text="Who (by default everybody)")
            _change(row, f"{where}.who", "ADD", "ADD")
            for index, member in enumerate(event.who):
                row = layout.row(align=True)
                if not member.target:
                    row.prop_search(member, "name", data, "flows", text="")
                if not member.name:
                    row.prop(member, "target", text="")
                _change(row, f"{where}.who", "REMOVE", "X", index)


class VIEW3D_PT_throng_simulation(InSidebar, bpy.types.Panel):
    bl_label = "Simulation"
    bl_parent_id = "VIEW3D_PT_throng"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        column, simulation = self.layout.column(), context.scene.throng_layout.simulation
        column.operator("throng.settings_from_scene")
        for codec, *_ in fields.SIMULATION:
            column.prop(simulation, codec.key)
        column.prop(context.scene.throng_layout, "tolerance")
        _problems_of(context, column, lambda problem: problem.pointer.startswith("/simulation"))


class VIEW3D_PT_throng_motion(InSidebar, bpy.types.Panel):
    bl_label = "Motion"
    bl_parent_id = "VIEW3D_PT_throng"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        column, motion = self.layout.column(), context.scene.throng_layout.motion
        column.prop(motion, "shown")
        for name, label, about, rows in fields.MOTION:
            rule = getattr(motion, name)
            if name == motion.shown:
                self._rule(context, column.box().column(), rule, about, rows)
            elif any(codec.present(rule) != codec.shown(MISSING) for codec, *_ in rows):
                self._changed(column, name, label)
        _problems_of(context, column, lambda problem: problem.pointer.startswith("/motion"))

    @staticmethod
    def _rule(context, column, rule, about, rows):
        for line in textwrap.wrap(about, _letters(context)):
            column.label(text=line)
        for codec, *_ in rows:
            part = column.row()
            part.active = codec.key == "enabled" or getattr(rule, "enabled", True)
            part.prop(rule, codec.key)

    @staticmethod
    def _changed(column, name, label):
        """Rules whose numbers are not Throng's own are not to be forgotten."""
        operator = column.operator("wm.context_set_enum", text=f"Changed: {label}", icon="MODIFIER")
        operator.data_path, operator.value = "scene.throng_layout.motion.shown", name


class VIEW3D_PT_throng_bars(InSidebar, bpy.types.Panel):
    bl_label = "Expectations"
    bl_parent_id = "VIEW3D_PT_throng"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        layout, data = self.layout, context.scene.throng_layout
        for index, bar in enumerate(data.bars):
            box = layout.box()
            row = box.row()
            row.prop(bar, "figure", text="")
            _change(row, "bars", "REMOVE", "X", index)
            for name in ("least", "most"):
                _optional(box, bar, name)
        _change(layout, "bars", "ADD", "ADD")
        layout.prop(data, "expect_line")


class VIEW3D_PT_throng_bake(InSidebar, bpy.types.Panel):
    bl_label = "Bake"
    bl_parent_id = "VIEW3D_PT_throng"

    def draw(self, context):
        layout, data = self.layout, context.scene.throng_layout
        layout.prop(data, "name")
        layout.prop(data, "folder")
        grid = layout.grid_flow(columns=2, align=True)
        for name in ("build_streets", "build_walls", "build_scenery", "build_camera"):
            grid.prop(data, name)
        if running():
            self._progress(layout, data)
        else:
            row = layout.row(align=True)
            row.scale_y = 1.4
            row.operator("throng.bake", icon="RENDER_ANIMATION")
            row.operator("throng.check", icon="CHECKMARK")
        _problems_of(context, layout, lambda _problem: True)

    @staticmethod
    def _progress(layout, data):
        row = layout.row(align=True)
        if hasattr(row, "progress"):
            row.progress(factor=0.01 * data.progress, text=f"{data.progress:.0f} %")
        else:
            row.prop(data, "progress", text="Done", slider=True)
        row.operator("throng.bake_cancel", text="", icon="X")
        layout.label(text=data.status)


CLASSES = (VIEW3D_PT_throng_layout, VIEW3D_PT_throng_bake, THRONG_UL_flows, THRONG_UL_events, VIEW3D_PT_throng_flows,
           VIEW3D_PT_throng_events, VIEW3D_PT_throng_simulation, VIEW3D_PT_throng_motion,
           VIEW3D_PT_throng_bars)

register, unregister = bpy.utils.register_classes_factory(CLASSES)
