# SPDX-License-Identifier: Apache-2.0
"""Operators on the people who are picked, and the list of overrides in the sidebar."""
import math

import bpy
from bpy.props import (BoolProperty, CollectionProperty, EnumProperty, FloatProperty, FloatVectorProperty, IntProperty,
                       StringProperty)

from ..blender.polls import available
from ..crowd.queries import LAYERED_OF, crowd_objects, why_fixed, why_no_crowd
from ..formats import BakeError
from ..blender.panels import InSidebar
from . import hero, layer, picking


class ThrongOverride(bpy.types.PropertyGroup):
    """One person's changes, and whom they have been found to mean."""

    text: StringProperty(description="The entry as the file has it")
    status: StringProperty()
    row: IntProperty(default=-1)
    detail: StringProperty()


def _crowd(context):
    """The crowd that is meant: the active one, else one with people picked, else the only one that can be changed."""
    crowds = crowd_objects(context.scene)
    active = context.view_layer.objects.active
    if active in crowds:
        return active
    with_picks = [crowd for crowd in crowds if crowd.get(picking.PICKED)]
    own = [crowd for crowd in crowds if not why_fixed(crowd) and LAYERED_OF not in crowd] or crowds
    return with_picks[0] if with_picks else own[0] if len(own) == 1 else None


class _OnOneCrowd:
    """Operators that are there while it is clear which crowd is meant, and that can be changed."""

    @classmethod
    def poll(cls, context):
        if not crowd_objects(context.scene):
            return available(cls, why_no_crowd(context.scene))
        crowd = _crowd(context)
        return available(cls, why_fixed(crowd) if crowd else
                         "There are several crowds: make the one active that is meant, or pick people of it")


class _OnPeople(_OnOneCrowd):
    """Changes whoever is picked, or the rows that a script names."""

    bl_options = {"REGISTER", "UNDO"}
    rows: StringProperty(name="People", description="Rows between blanks; whoever is picked where this is empty",
                         options={"SKIP_SAVE"})

    def values(self, context, crowd, row):
        raise NotImplementedError

    def execute(self, context):
        crowd = _crowd(context)
        try:
            rows = [int(word) for word in self.rows.split()] if self.rows else picking.picked(crowd)
        except ValueError:
            self.report({"ERROR"}, f"Rows are numbers between blanks, found `{self.rows}`")
            return {"CANCELLED"}
        if not rows:
            self.report({"ERROR"}, "Nobody is picked: use Pick People, or select points of the crowd in edit mode")
            return {"CANCELLED"}
        edits = crowd.mode == "EDIT"
        if edits:  # attributes cannot be written there
            bpy.ops.object.mode_set(mode="OBJECT")
        try:
            report_others(self, self.apply(context, crowd, rows))
        except BakeError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        finally:
            if edits:
                bpy.ops.object.mode_set(mode="EDIT")
        return {"FINISHED"}

    def apply(self, context, crowd, rows):
        """Returns what layer.change() does."""
        return layer.set_for(crowd, rows, self.values(context, crowd, rows))


class THRONG_OT_hide_people(_OnPeople, bpy.types.Operator):
    """Leave out the people who are picked"""

    bl_idname = "throng.hide_people"
    bl_label = "Hide"

    def values(self, _context, _crowd, _rows):
        return {"hide": True}


class THRONG_OT_swap_people(_OnPeople, bpy.types.Operator):
    """Let the people who are picked appear as another character of the cast"""

    bl_idname = "throng.swap_people"
    bl_label = "Swap Character"

    character: IntProperty(name="Character", default=0, min=0, max=65535,
                           description="The variation; casts with fewer go round")

    def invoke(self, context, _event):
        return context.window_manager.invoke_props_dialog(self)

    def values(self, _context, _crowd, _rows):
        return {"character": self.character}


class THRONG_OT_tint_people(_OnPeople, bpy.types.Operator):
    """Give the people who are picked other colours"""

    bl_idname = "throng.tint_people"
    bl_label = "Tint"

    by: EnumProperty(name="By", items=[("colour", "Colour", "The colour of the top garment"),
                                       ("draws", "Numbers", "What the cast picks all colours by")])
    colour: FloatVectorProperty(name="Colour", subtype="COLOR_GAMMA", default=(0.63, 0.06, 0.13), min=0.0, max=1.0,
                                size=3)
    draws: FloatVectorProperty(name="Numbers", default=(0.5, 0.5, 0.5), min=0.0, max=1.0, size=3)

    def invoke(self, context, _event):
        return context.window_manager.invoke_props_dialog(self)

    def values(self, _context, _crowd, _rows):
        if self.by == "colour":
            return {"tint": "#" + "".join(f"{round(255.0 * part):02x}" for part in self.colour)}
        return {"tint": [round(float(number), 6) for number in self.draws]}


class THRONG_OT_scale_people(_OnPeople, bpy.types.Operator):
    """Make the people who are picked larger or smaller. Their steps get longer with them, so feet slide a little"""

    bl_idname = "throng.scale_people"
    bl_label = "Scale"

    scale: FloatProperty(name="Scale", default=1.1, min=0.1, max=10.0)

    def invoke(self, context, _event):
        return context.window_manager.invoke_props_dialog(self)

    def values(self, _context, _crowd, _rows):
        return {"scale": round(self.scale, 6)}


class THRONG_OT_move_people(_OnPeople, bpy.types.Operator):
    """Move the whole way of the people who are picked, and turn it about where they enter"""

    bl_idname = "throng.move_people"
    bl_label = "Move"

    by: FloatVectorProperty(name="By", subtype="TRANSLATION", size=3, default=(0.0, 0.0, 0.0))
    turn: FloatProperty(name="Turn", subtype="ANGLE", min=-2.0 * math.pi, max=2.0 * math.pi,
                        description="About the place of entry, counter-clockwise")
    to_cursor: BoolProperty(name="To the 3D Cursor",
                            description="The first who is picked stands at the cursor in this frame; the "
                                        "others keep their places by it")

    def invoke(self, context, _event):
        return context.window_manager.invoke_props_dialog(self)

    def apply(self, context, crowd, rows):
        move = {"by": [round(v, 6) for v in self.by]}
        if self.turn:
            move["turn"] = round(math.degrees(self.turn), 6)
        if self.to_cursor:
            cursor = crowd.matrix_world.inverted() @ context.scene.cursor.location
            stands = layer.place_at(crowd, rows[0], context.scene.frame_current, move.get("turn", 0.0))
            move["by"] = [round(a - b, 6) for a, b in zip(cursor, stands)]
        return layer.set_for(crowd, rows, {"move": move})


class THRONG_OT_retime_people(_OnPeople, bpy.types.Operator):
    """Let the people who are picked do what they do later, earlier, slower or faster"""

    bl_idname = "throng.retime_people"
    bl_label = "Retime"

    offset: FloatProperty(name="Later by", default=0.0, min=-1e6, max=1e6, description="Frames; earlier below zero")
    speed: FloatProperty(name="Speed", default=1.0, min=0.05, max=20.0)

    def invoke(self, context, _event):
        return context.window_manager.invoke_props_dialog(self)

    def values(self, _context, _crowd, _rows):
        return {"retime": {"offset": round(self.offset, 6), "speed": round(self.speed, 6)}}


class THRONG_OT_promote_person(_OnPeople, bpy.types.Operator):
    bl_idname = "throng.promote_person"
    bl_label = "Promote to Hero"
    bl_description = ("Make a hero of each person who is picked: an armature with keys, for an animator to change, "
                      "in the place of the crowd's")

    hero: StringProperty(name="Name", description="By default Hero and the row", options={"SKIP_SAVE"})

    def invoke(self, context, _event):
        return context.window_manager.invoke_props_dialog(self)

    def apply(self, _context, crowd, rows):
        if self.hero and len(rows) > 1:
            raise BakeError("Pick one person: heroes have a name each")
        taken = {layer.change_of(entry).hero for entry in layer.entries_of(crowd) if entry["id"] not in rows}
        names = {row: self.hero or f"Hero {row}" for row in rows}
        for row, name in names.items():
            if name in taken:
                raise BakeError(f"there is a hero `{name}` already")
            if not hero.shipped_person(crowd, layer.variation_of(crowd, row)):
                raise BakeError(f"person {row} is a character that was brought along: heroes are made "
                                "of the shipped cast only")
        return layer.set_each(crowd, {row: {"hero": name} for row, name in names.items()})


class THRONG_OT_clear_people(_OnPeople, bpy.types.Operator):
    """Take back all changes to the people who are picked; heroes are removed with their keys"""

    bl_idname = "throng.clear_people"
    bl_label = "Clear"

    def apply(self, _context, crowd, rows):
        return layer.remove(crowd, [index for index, item in enumerate(crowd.throng_overrides) if item.row in rows])


class THRONG_OT_clear_override(_OnOneCrowd, bpy.types.Operator):
    """Take back one entry of the list; a hero is removed with its keys"""

    bl_idname = "throng.clear_override"
    bl_label = "Clear Override"
    bl_options = {"REGISTER", "UNDO"}

    index: IntProperty(default=-1, options={"SKIP_SAVE"})

    def execute(self, context):
        crowd = _crowd(context)
        index = self.index if self.index >= 0 else crowd.throng_override_index
        if index >= len(crowd.throng_overrides):
            self.report({"ERROR"}, f"There is no entry {index}")
            return {"CANCELLED"}
        try:
            report_others(self, layer.remove(crowd, [index]))
        except BakeError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        return {"FINISHED"}


class THRONG_OT_reload_overrides(_OnOneCrowd, bpy.types.Operator):
    """Take the file of overrides beside the bake as it is now"""

    bl_idname = "throng.reload_overrides"
    bl_label = "Re-load Overrides"
    bl_options = {"REGISTER", "UNDO"}

    def execute(self, context):
        try:
            orphans = layer.load(_crowd(context))
        except BakeError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        report_orphans(self, orphans)
        return {"FINISHED"}


def report_others(operator, matched):
    """What somebody else had changed in the file is shown from now on: nobody should be surprised."""
    if matched.others:
        operator.report({"WARNING"}, f"Somebody else had changed the file, which is taken over: {matched.others}")


def report_orphans(operator, orphans):
    if orphans:
        operator.report({"WARNING"}, f"{len(orphans)} overrides have nobody in this bake:\n" + "\n".join(orphans))


class THRONG_UL_overrides(bpy.types.UIList):
    def draw_item(self, _context, row, _crowd, item, _icon, _active, _name, index=0):
        icons = {"sure": "CHECKMARK", "nearest": "QUESTION", "orphaned": "ERROR"}
        row.label(text=item.name, icon=icons.get(item.status, "DOT"))
        row.operator(THRONG_OT_clear_override.bl_idname, text="", icon="X", emboss=False).index = index


class VIEW3D_PT_throng_overrides(InSidebar, bpy.types.Panel):
    bl_label = "People"
    bl_parent_id = "VIEW3D_PT_throng"

    @classmethod
    def poll(cls, context):
        return _crowd(context) is not None

    def draw(self, context):
        crowd, layout = _crowd(context), self.layout
        rows = crowd.get(picking.PICKED, "").split()
        layout.operator(picking.THRONG_OT_pick_people.bl_idname, icon="EYEDROPPER")
        layout.label(text=f"Picked: {', '.join(rows[:8])}{' ...' if len(rows) > 8 else ''}" if rows
                     else "Nobody is picked")
        grid = layout.grid_flow(columns=2, align=True, even_columns=True)
        for operator in ON_PEOPLE:
            grid.operator(operator.bl_idname)
        layout.template_list("THRONG_UL_overrides", "", crowd, "throng_overrides", crowd, "throng_override_index",
                             rows=3)
        if crowd.throng_override_index < len(crowd.throng_overrides):
            item = crowd.throng_overrides[crowd.throng_override_index]
            if item.detail:
                layout.label(text=item.detail, icon="ERROR" if item.status == "orphaned" else "QUESTION")
        layout.operator(THRONG_OT_reload_overrides.bl_idname, icon="FILE_REFRESH")


ON_PEOPLE = (THRONG_OT_hide_people, THRONG_OT_swap_people, THRONG_OT_tint_people, THRONG_OT_scale_people,
             THRONG_OT_move_people, THRONG_OT_retime_people, THRONG_OT_promote_person, THRONG_OT_clear_people)
CLASSES = (ThrongOverride, picking.THRONG_OT_pick_people, *ON_PEOPLE, THRONG_OT_clear_override,
           THRONG_OT_reload_overrides, THRONG_UL_overrides, VIEW3D_PT_throng_overrides)

_register_classes, _unregister_classes = bpy.utils.register_classes_factory(CLASSES)


def register():
    _register_classes()
    bpy.types.Object.throng_overrides = CollectionProperty(type=ThrongOverride)
    bpy.types.Object.throng_override_index = IntProperty(name="Override")
    for handlers in (bpy.app.handlers.undo_post, bpy.app.handlers.redo_post):
        handlers.append(layer.write_after_undo)
    bpy.app.handlers.load_post.append(layer.forget)
    picking.start_drawing()


def unregister():
    picking.stop_drawing()
    for handlers in (bpy.app.handlers.undo_post, bpy.app.handlers.redo_post):
        handlers.remove(layer.write_after_undo)
    bpy.app.handlers.load_post.remove(layer.forget)
    del bpy.types.Object.throng_override_index, bpy.types.Object.throng_overrides
    _unregister_classes()
