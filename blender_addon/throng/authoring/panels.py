# SPDX-License-Identifier: Apache-2.0
"""The layout in the sidebar: drawing, the active part, flows, events, simulation, bars, and baking."""
import textwrap

import bpy

from ..blender.panels import InSidebar
from . import fields, levels
from .bake_operator import running
from .codecs import UNSET
from .panel_parts import (
    change, destination, distribution, letters, list_of, optional, order, people, place, problems_of, who)
from .seat_panel import block_of_seats
from .values import MISSING


class VIEW3D_PT_throng_layout(InSidebar, bpy.types.Panel):
    bl_label = "Layout"
    bl_parent_id = "VIEW3D_PT_throng"

    def draw(self, context):
        layout = self.layout
        grid = layout.grid_flow(columns=2, align=True)
        for part, icon in (("level", "MESH_GRID"), ("link", "MOD_ARRAY"), ("road", "CURVE_PATH"),
                           ("wall", "MOD_SOLIDIFY"), ("area", "MESH_PLANE"), ("patch", "SHADING_TEXTURE"),
                           ("seats", "ALIGN_JUSTIFY"), ("formation", "COMMUNITY"), ("line", "IPO_LINEAR")):
            grid.operator(f"throng.add_{part}", icon=icon)
        if any(thing.throng_layout.kind == "LEVEL" for thing in context.scene.objects):
            layout.prop(context.scene.throng_layout, "draw_on")
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
        if part.kind in levels.ON_LEVELS and (part.level or context.scene.throng_layout.draw_on):
            box.prop(part, "level")
        if part.kind == "LEVEL":
            box.prop(thing, "location", index=2, text="Height")
        if part.kind == "LINK":
            self._link(box, thing, part.link)
        if part.kind == "PATCH":
            optional(box, part.patch, "cost")
            box.prop(part.patch, "pace")
            box.prop(part.patch, "room")
            box.prop(part.patch, "begins")
            optional(box, part.patch, "ends")
        if part.kind == "SEATS":
            block_of_seats(box, thing)
        if part.kind == "FORMATION":
            self._formation(box, part.formation, context.scene.throng_layout)
        problems_of(context, box, lambda problem: problem.target == thing)

    @staticmethod
    def _link(box, thing, link):
        if thing.type != "CURVE":
            box.label(text="A lift, as the layout tells")
            return
        for name in ("type", "begins", "ends", "width"):
            box.prop(link, name)
        for name in ("speed", "walking", "stand") if link.type in levels.MOVING else ():
            box.prop(link, name)

    @staticmethod
    def _formation(box, formation, data):
        box.prop(formation, "type")
        names = {"circle": ("radius", "count"), "grid": ("rows", "columns", "spacing", "jitter")}
        for name in names.get(formation.type, ()):
            box.prop(formation, name)
        for name in {"circle": ("ring_spacing", "along"), "grid": ("people_count",)}.get(formation.type, ()):
            optional(box, formation, name)
        box.prop_search(formation, "behaviour", data, "behaviours")
        if formation.type == "grid" and not formation.behaviour:
            box.prop(formation, "goal_kind")
            if formation.goal_kind == "PLACE":
                destination(box, formation.goal, "formation.goal", "")
            elif formation.goal_kind == "OFFSET":
                box.prop(formation, "goal_offset", text="")
            else:
                box.prop(formation, "goal_line", text="")
        box.prop(formation, "start")
        distribution(box, formation, "wait")
        box.prop(formation, "arrival")
        box.prop(formation, "goal_tolerance")
        people(box.column(), formation.people)


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


class VIEW3D_PT_throng_flows(InSidebar, bpy.types.Panel):
    bl_label = "Flows"
    bl_parent_id = "VIEW3D_PT_throng"

    def draw(self, context):
        layout, data = self.layout, context.scene.throng_layout
        flow = list_of(layout, data, "flows", "active_flow", "THRONG_UL_flows", "throng.add_flow")
        if flow is None:
            return
        where = f"flows[{data.active_flow}]"
        problems_of(context, layout, lambda problem: problem.where == "flows" and problem.index == data.active_flow)
        place(layout, flow.source, "From")
        layout.prop_search(flow, "behaviour", data, "behaviours")
        if not flow.behaviour:
            destination(layout, flow.to, f"{where}.to")
        row = layout.row(align=True)
        row.prop(flow, "amount", text="")
        if flow.amount != "KEPT":
            row.prop(flow, "count" if flow.amount == "COUNT" else "rate")
        layout.prop(flow, "start")
        optional(layout, flow, "end")
        layout.prop(flow, "arrival")
        if not flow.behaviour:
            self._stops(layout, flow, where)
        people(layout.box().column(), flow.people)

    @staticmethod
    def _stops(layout, flow, where):
        row = layout.row()
        row.label(text="On the Way")
        change(row, f"{where}.via", "ADD", "ADD")
        for index, stop in enumerate(flow.via):
            box = layout.box()
            destination(box, stop.at, f"{where}.via[{index}].at", "At")
            distribution(box, stop, "wait")
            if stop.wait.kind != UNSET:
                box.prop(stop, "activity")
                if stop.activity == "queue":
                    box.prop(stop, "line")
                    box.prop(stop, "spacing")
                else:
                    box.prop(stop, "facing")
            order(box.row(align=True), f"{where}.via", index)


class VIEW3D_PT_throng_events(InSidebar, bpy.types.Panel):
    bl_label = "Events"
    bl_parent_id = "VIEW3D_PT_throng"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        layout, data = self.layout, context.scene.throng_layout
        event = list_of(layout, data, "events", "active_event", "THRONG_UL_events")
        if event is None:
            return
        problems_of(context, layout, lambda problem: problem.where == "events" and problem.index == data.active_event)
        layout.prop(event, "time")
        layout.prop(event, "kind")
        if event.kind in ("open", "close"):
            layout.prop(event, "wall")
        elif event.kind == "flow":
            layout.prop_search(event, "flow", data, "flows")
            layout.prop(event, "rate")
        else:
            where = f"events[{data.active_event}]"
            destination(layout, event.destination, f"{where}.destination")
            layout.prop(event, "arrival")
            who(layout, event.who, f"{where}.who", "Who (by default everybody)")


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
        problems_of(context, column, lambda problem: problem.pointer.startswith("/simulation"))


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
        problems_of(context, column, lambda problem: problem.pointer.startswith("/motion"))

    @staticmethod
    def _rule(context, column, rule, about, rows):
        for line in textwrap.wrap(about, letters(context)):
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
            change(row, "bars", "REMOVE", "X", index)
            for name in ("least", "most"):
                optional(box, bar, name)
        change(layout, "bars", "ADD", "ADD")
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
        problems_of(context, layout, lambda _problem: True)

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
