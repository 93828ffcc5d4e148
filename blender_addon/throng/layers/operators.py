# SPDX-License-Identifier: Apache-2.0
"""The list of layers in the sidebar, and what is done with it."""
import math

import bpy
from bpy.props import (BoolProperty, CollectionProperty, EnumProperty, FloatProperty, FloatVectorProperty, IntProperty,
                       StringProperty)

from ..blender.panels import Below
from ..blender.polls import available
from ..crowd.queries import LAYERED_OF, crowd_objects, why_fixed, why_no_crowd
from ..formats import BakeError
from ..overrides import layer as overrides, picking
from . import applying, scene_values
from .wording import ACTIVITIES, OPERATIONS, SELECTORS, operation_text, parsed, selector_text, with_share


class ThrongLayer(bpy.types.PropertyGroup):
    """A layer as the file has it: `who` and `do` in JSON."""

    enabled: BoolProperty(name="Enabled", default=True, description="Whether the layer is there")
    who: StringProperty(name="Who", description="Whom it changes, in JSON (docs/layers.md)")
    do: StringProperty(name="What", description="What it does to them, in JSON (docs/layers.md)")
    note: StringProperty(name="Note")


def _crowd(context):
    """The crowd whose layers are meant: the active one, or the one that it shows the layers of; else the only one."""
    crowds = crowd_objects(context.scene)
    active = context.view_layer.objects.active
    if active in crowds:
        return active.get(LAYERED_OF) or active
    own = [crowd for crowd in crowds if LAYERED_OF not in crowd]
    return own[0] if len(own) == 1 else None


class _OnLayers:
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        if not crowd_objects(context.scene):
            return available(cls, why_no_crowd(context.scene))
        crowd = _crowd(context)
        return available(cls, why_fixed(crowd) if crowd else
                         "There are several crowds: make the one active that is meant")

    def execute(self, context):
        crowd = _crowd(context)
        try:
            applying.load_once(crowd)
            self.change(context, crowd)
        except BakeError as error:
            if getattr(error, "index", None) is not None:
                crowd.throng_layer_index = error.index
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        return {"FINISHED"}


class THRONG_OT_add_layer(_OnLayers, bpy.types.Operator):
    """Add a layer: whom it changes, and what it does to them"""

    bl_idname = "throng.add_layer"
    bl_label = "Add Layer"

    name: StringProperty(name="Name", description="By default what it does", options={"SKIP_SAVE"})
    selector: EnumProperty(name="Who", items=SELECTORS)
    words: StringProperty(name="Names", description="Between commas")
    first: IntProperty(name="From", default=0, min=0)
    last: IntProperty(name="To", default=0, min=0)
    within: FloatProperty(name="Within", default=2.0, min=0.0, unit="LENGTH")
    now: BoolProperty(name="In This Frame Only", description="Who is there now; without, at any time")
    step: IntProperty(name="Every", default=6, min=1, description="Frames between two looks at where the camera is")
    share: FloatProperty(name="Share", default=1.0, min=0.0, max=1.0, description="Of these; drawn by who they are")
    seed: IntProperty(name="Seed", default=0, min=0)
    others: BoolProperty(name="All Others", description="Whoever is none of these")
    operation: EnumProperty(name="What", items=OPERATIONS)
    by: FloatVectorProperty(name="By", subtype="TRANSLATION", size=3)
    turn: FloatProperty(name="Turn", subtype="ANGLE", min=-2.0 * math.pi, max=2.0 * math.pi)
    colour: FloatVectorProperty(name="Colour", subtype="COLOR_GAMMA", default=(0.63, 0.06, 0.13), min=0.0, max=1.0,
                                size=3)
    character: IntProperty(name="Character", default=0, min=0, max=65535)
    scale: FloatProperty(name="Scale", default=1.1, min=0.1, max=10.0)
    offset: FloatProperty(name="Later by", default=0.0, min=-1e6, max=1e6, description="Frames; earlier below zero")
    speed: FloatProperty(name="Speed", default=1.0, min=0.05, max=20.0)
    activity: EnumProperty(name="Activity", items=ACTIVITIES)
    copies: IntProperty(name="Copies", default=1, min=1, max=10000)
    scatter: FloatProperty(name="Scatter", default=0.0, min=0.0, unit="LENGTH")
    falloff: FloatProperty(name="Falloff", default=0.0, min=0.0, description="Frames; 0: as many as it needs")
    hero: StringProperty(name="Hero", default="Hero")

    _OF_SELECTOR = {"group": ("words",), "profile": ("words",), "look": ("words",), "copies": ("words",),
                    "rows": ("first", "last"), "party": ("first", "last"), "region": ("now",),
                    "seen": ("now", "step"), "near": ("within", "now")}
    _OF_OPERATION = {"move": ("by", "turn"), "tint": ("colour",), "character": ("character",), "scale": ("scale",),
                     "retime": ("offset", "speed"), "clip": ("activity",), "bend": ("by", "falloff"),
                     "duplicate": ("copies", "by", "turn", "offset", "scatter"), "hero": ("hero",)}

    def invoke(self, context, _event):
        return context.window_manager.invoke_props_dialog(self, width=360)

    def draw(self, _context):
        for key in ("name", "selector", *self._OF_SELECTOR.get(self.selector, ()), "share"):
            self.layout.prop(self, key)
        if self.share < 1.0:
            self.layout.prop(self, "seed")
        for key in ("others", "operation", *self._OF_OPERATION.get(self.operation, ())):
            self.layout.prop(self, key)

    def change(self, context, crowd):
        who = self._who(context, crowd)
        who = with_share({"not": who} if self.others else who, self.share, self.seed)
        do = {self.operation: self._value(context, crowd)}
        names = {item.name for item in crowd.throng_layers}
        wanted = self.name or f"{self.operation} {selector_text(who)}"
        name, number = wanted, 2
        while name in names:
            name, number = f"{wanted} {number}", number + 1
        applying.append(crowd, {"name": name, "who": who, "do": do})

    def _who(self, context, crowd):
        if self.selector in ("group", "profile", "look", "copies"):
            words = [word.strip() for word in self.words.split(",") if word.strip()]
            if not words:
                raise BakeError("Say by which name: Names is empty")
            return {self.selector: words[0] if len(words) == 1 else words}
        if self.selector in ("rows", "party"):
            return {self.selector: [min(self.first, self.last), max(self.first, self.last)]}
        if self.selector == "everybody":
            return {"everybody": True}
        if self.selector == "people":
            return {"people": self._picked(crowd)}
        return {self.selector: self._place(context, crowd)}

    @staticmethod
    def _picked(crowd):
        rows = picking.picked(crowd)
        if not rows:
            raise BakeError("Nobody is picked: use Pick People in the panel People")
        matched = overrides.Matched(overrides.bake_of(crowd), [])
        return [overrides.entry_for(matched, row) for row in rows]

    def _place(self, context, crowd):
        """Of selectors that look at where people are."""
        bake, scene = overrides.bake_of(crowd), context.scene
        matrix = scene_values.to_world(crowd, bake.origin)
        frame = min(scene_values.bake_frame(crowd, scene.frame_current), bake.frames - 1)
        frames = [frame, frame] if self.now else [0, bake.frames - 1]
        if self.selector == "region":
            made = {"polygon": scene_values.outline(context.view_layer.objects.active, matrix)}
        elif self.selector == "seen":
            made = {"views": scene_values.views(scene, crowd, matrix, frames, self.step)}
        else:
            place = scene_values.rounded((matrix @ scene.cursor.location)[:2])
            made = {"point": place, "within": round(self.within, 4)}
        return {**made, "frames": frames} if self.now else made

    def _value(self, context, crowd):
        """What stands behind the operation's key."""
        by = scene_values.rounded(self.by)
        moves = {"by": by, **({"turn": round(math.degrees(self.turn), 4)} if self.turn else {})}
        late = {"offset": round(self.offset, 4)} if self.offset else {}
        if self.operation == "look_at":
            matrix = scene_values.to_world(crowd, overrides.bake_of(crowd).origin)
            return {"point": scene_values.rounded(matrix @ context.scene.cursor.location)}
        if self.operation == "bend":
            frame = scene_values.bake_frame(crowd, context.scene.frame_current)
            falloff = {"falloff": round(self.falloff, 4)} if self.falloff > 0.0 else {}
            return {"points": [{"frame": frame, "by": by[:2]}], **falloff}
        return {"hide": True, "character": self.character, "scale": round(self.scale, 6), "hero": self.hero,
                "tint": "#" + "".join(f"{round(255.0 * part):02x}" for part in self.colour), "move": moves,
                "retime": {**late, "speed": round(self.speed, 6)}, "clip": {"activity": self.activity},
                "duplicate": {"copies": self.copies, **moves, **late,
                              **({"scatter": round(self.scatter, 4)} if self.scatter else {})}}[self.operation]


class THRONG_OT_change_layers(_OnLayers, bpy.types.Operator):
    """Take away the layer, or change its place: later layers see what earlier ones have left"""

    bl_idname = "throng.change_layers"
    bl_label = "Change Layers"

    action: EnumProperty(items=[(word, word.capitalize(), "") for word in ("REMOVE", "UP", "DOWN")])

    def change(self, _context, crowd):
        index, layers = crowd.throng_layer_index, crowd.throng_layers
        if not 0 <= index < len(layers):
            raise BakeError("There is no layer to change")
        if self.action == "REMOVE":
            layers.remove(index)
            crowd.throng_layer_index = max(0, min(index, len(layers) - 1))
            return
        target = index + (1 if self.action == "DOWN" else -1)
        if 0 <= target < len(layers):
            layers.move(index, target)
            crowd.throng_layer_index = target


class THRONG_OT_reload_layers(_OnLayers, bpy.types.Operator):
    """Take the layers of the file of overrides beside the bake as they are now"""

    bl_idname = "throng.reload_layers"
    bl_label = "Re-load Layers"

    def change(self, _context, crowd):
        applying.load(crowd)


class THRONG_OT_apply_layers(_OnLayers, bpy.types.Operator):
    """Write the layers beside the bake, apply them to it, and show the crowd that comes of it"""

    bl_idname = "throng.apply_layers"
    bl_label = "Apply Layers"

    def change(self, context, crowd):
        window = context.window
        if window:
            window.cursor_set("WAIT")
        try:
            lines, remarks = applying.apply(context, crowd)
        finally:
            if window:
                window.cursor_set("DEFAULT")
        if lines:
            self.report({"INFO"}, "\n".join(lines))
        if remarks:
            self.report({"WARNING"}, "\n".join(remarks))


class THRONG_OT_compare_layers(_OnLayers, bpy.types.Operator):
    """Show the crowd without its layers, or with them"""

    bl_idname = "throng.compare_layers"
    bl_label = "Without / With Layers"

    def change(self, context, crowd):
        applying.compare(context.scene, crowd, not crowd.hide_viewport)
        if applying.layered_crowd(context.scene, crowd) is None:
            raise BakeError("There is no crowd with the layers: Apply Layers first")


def _words(text, tell):
    try:
        return tell(parsed(text, ""))
    except (ValueError, KeyError, TypeError, AttributeError):
        return "?"


class THRONG_UL_layers(bpy.types.UIList):
    def draw_item(self, _context, layout, _crowd, item, _icon, _active, _name, _index=0):
        row = layout.row()
        row.prop(item, "enabled", text="")
        row.active = item.enabled
        row.prop(item, "name", text="", emboss=False)
        row.label(text=_words(item.who, selector_text))
        row.label(text=_words(item.do, operation_text))


class VIEW3D_PT_throng_layers(Below, bpy.types.Panel):
    bl_label = "Layers"

    @classmethod
    def poll(cls, context):
        return _crowd(context) is not None

    def draw(self, context):
        crowd, layout = _crowd(context), self.layout
        row = layout.row()
        row.template_list("THRONG_UL_layers", "", crowd, "throng_layers", crowd, "throng_layer_index", rows=4)
        column = row.column(align=True)
        column.operator(THRONG_OT_add_layer.bl_idname, text="", icon="ADD")
        for action, icon in (("REMOVE", "REMOVE"), ("UP", "TRIA_UP"), ("DOWN", "TRIA_DOWN")):
            column.operator(THRONG_OT_change_layers.bl_idname, text="", icon=icon).action = action
        if 0 <= crowd.throng_layer_index < len(crowd.throng_layers):
            item = crowd.throng_layers[crowd.throng_layer_index]
            for key in ("who", "do", "note"):
                layout.prop(item, key)
        layout.operator(THRONG_OT_apply_layers.bl_idname, icon="CHECKMARK")
        row = layout.row(align=True)
        row.operator(THRONG_OT_compare_layers.bl_idname, icon="ARROW_LEFTRIGHT")
        row.operator(THRONG_OT_reload_layers.bl_idname, text="", icon="FILE_REFRESH")


CLASSES = (ThrongLayer, THRONG_OT_add_layer, THRONG_OT_change_layers, THRONG_OT_reload_layers, THRONG_OT_apply_layers,
           THRONG_OT_compare_layers, THRONG_UL_layers, VIEW3D_PT_throng_layers)

_register_classes, _unregister_classes = bpy.utils.register_classes_factory(CLASSES)


def register():
    _register_classes()
    bpy.types.Object.throng_layers = CollectionProperty(type=ThrongLayer)
    bpy.types.Object.throng_layer_index = IntProperty(name="Layer")


def unregister():
    del bpy.types.Object.throng_layer_index, bpy.types.Object.throng_layers
    _unregister_classes()
