# SPDX-License-Identifier: Apache-2.0
"""Drawing a layout: adding and marking its parts, and its files."""
import math
import os

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty, StringProperty
from bpy_extras.io_utils import ExportHelper, ImportHelper

from ..blender.polls import available, in_object_mode
from . import display, fields, geometry, importer, levels
from .common_properties import ThrongBlock
from .exporter import default_name, export_layout, folder_of_files, layout_text, write_text
from .geometry import AuthoringError
from .properties import KINDS


def refused(operator, error):
    """Reports why nothing was done, and shows the object that it is about."""
    operator.report({"ERROR"}, str(error))
    if getattr(error, "target", None) is not None:
        select_only(bpy.context, error.target)
    return {"CANCELLED"}


def select_only(context, thing):
    for other in context.selected_objects:
        other.select_set(False)
    if thing.name in context.view_layer.objects:
        thing.select_set(True)
        context.view_layer.objects.active = thing


def _enter(context, thing, kind, **values):
    """A new part of the layout: linked, marked, selected. With the first one, the shot is the scene's."""
    if importer.is_empty(context.scene):
        take_shot(context.scene)
    with display.quietly():
        part = thing.throng_layout
        part.kind, part.order = kind, importer.next_order(context.scene)
        for name, value in values.items():
            setattr(part, name, value)
    thing.hide_render = True
    importer.layout_collection(context.scene).objects.link(thing)
    draw_on = context.scene.throng_layout.draw_on
    if draw_on is not None and (draw_on.throng_layout.kind != "LEVEL" or draw_on.name not in context.scene.objects):
        draw_on = context.scene.throng_layout.draw_on = None  # it was deleted
    if kind in levels.ON_LEVELS and draw_on is not None:
        part.level = draw_on
    display.refresh(thing)
    select_only(context, thing)
    context.view_layer.update()
    return thing


def take_shot(scene):
    """The scene's frame rate and range as the layout's."""
    simulation = scene.throng_layout.simulation
    simulation.fps = scene.render.fps / scene.render.fps_base
    simulation.duration = (scene.frame_end - scene.frame_start + 1) / simulation.fps


class _Adds:
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        return in_object_mode(cls, context)

    def add_curve(self, context, name, corners, cyclic, kind, **values):
        """A curve round the 3D cursor, turned by the operator's angle."""
        cursor = context.scene.cursor.location
        cosine, sine = math.cos(self.angle), math.sin(self.angle)
        points = [(cursor.x + cosine * x - sine * y, cursor.y + sine * x + cosine * y) for x, y in corners]
        return _enter(context, geometry.new_curve(name, points, cyclic), kind, **values)


def _rectangle(x, y):
    return [(-0.5 * x, -0.5 * y), (0.5 * x, -0.5 * y), (0.5 * x, 0.5 * y), (-0.5 * x, 0.5 * y)]


class THRONG_OT_add_road(_Adds, bpy.types.Operator):
    """Add a road: a curve to shape in edit mode, with a width"""

    bl_idname = "throng.add_road"
    bl_label = "Add Road"
    length: FloatProperty(name="Length", default=40.0, min=0.1, subtype="DISTANCE")
    width: FloatProperty(name="Width", default=6.0, min=0.5, subtype="DISTANCE")
    angle: FloatProperty(name="Angle", subtype="ANGLE")
    one_way: BoolProperty(name="One Way")

    def execute(self, context):
        half = 0.5 * self.length
        self.add_curve(context, "Road", [(-half, 0.0), (half, 0.0)], False, "ROAD", width=self.width,
                       one_way=self.one_way)
        return {"FINISHED"}


class THRONG_OT_add_wall(_Adds, bpy.types.Operator):
    """Add a wall: an open curve with a thickness, or a closed solid"""

    bl_idname = "throng.add_wall"
    bl_label = "Add Wall"
    length: FloatProperty(name="Length", default=10.0, min=0.1, subtype="DISTANCE")
    depth: FloatProperty(name="Depth", default=10.0, min=0.1, subtype="DISTANCE", description="Of a closed one")
    closed: BoolProperty(name="Closed", description="A solid, for example a building")
    thickness: FloatProperty(name="Thickness", default=0.2, min=0.0, subtype="DISTANCE")
    height: FloatProperty(name="Height", default=3.0, min=0.01, subtype="DISTANCE")
    angle: FloatProperty(name="Angle", subtype="ANGLE")

    def execute(self, context):
        half = 0.5 * self.length
        corners = _rectangle(self.length, self.depth) if self.closed else [(-half, 0.0), (half, 0.0)]
        self.add_curve(context, "Wall", corners, self.closed, "WALL", thickness=self.thickness, height=self.height)
        return {"FINISHED"}


class _AddsRectangle(_Adds):
    length: FloatProperty(name="Length", default=8.0, min=0.1, subtype="DISTANCE")
    depth: FloatProperty(name="Depth", default=8.0, min=0.1, subtype="DISTANCE")
    angle: FloatProperty(name="Angle", subtype="ANGLE")

    def execute(self, context):
        self.add_curve(context, self.kind.capitalize(), _rectangle(self.length, self.depth), True, self.kind)
        return {"FINISHED"}


class THRONG_OT_add_area(_AddsRectangle, bpy.types.Operator):
    """Add an area: a plaza, an entry, an exit"""

    bl_idname = "throng.add_area"
    bl_label = "Add Area"
    kind = "AREA"


class THRONG_OT_add_patch(_AddsRectangle, bpy.types.Operator):
    """Add ground that people avoid, or walk on at another pace: a lawn, mud"""

    bl_idname = "throng.add_patch"
    bl_label = "Add Patch"
    kind = "PATCH"


class THRONG_OT_add_level(_Adds, bpy.types.Operator):
    """Add a floor on which people walk above, or below, others; what is added next is on it"""

    bl_idname = "throng.add_level"
    bl_label = "Add Level"
    height: FloatProperty(name="Height", default=0.0, subtype="DISTANCE")
    length: FloatProperty(name="Length", default=30.0, min=0.1, subtype="DISTANCE")
    depth: FloatProperty(name="Depth", default=20.0, min=0.1, subtype="DISTANCE")
    angle: FloatProperty(name="Angle", subtype="ANGLE")

    def execute(self, context):
        thing = self.add_curve(context, "Level", _rectangle(self.length, self.depth), True, "LEVEL")
        thing.location.z = self.height
        context.scene.throng_layout.draw_on = thing
        context.view_layer.update()
        return {"FINISHED"}


_TURNS = {"STRAIGHT": lambda length, apart: [(0.0, 0.0), (length, 0.0)],
          "QUARTER": lambda length, apart: [(0.0, 0.0), (0.5 * length + apart, 0.0),
                                            (0.5 * length + apart, 0.5 * length + apart)],
          "HALF": lambda length, apart: [(0.0, 0.0), (0.5 * length + 0.5 * apart, 0.0),
                                         (0.5 * length + 0.5 * apart, apart), (0.0, apart)]}


class THRONG_OT_add_link(_Adds, bpy.types.Operator):
    bl_idname = "throng.add_link"
    bl_label = "Add Link"
    bl_description = ("Add stairs, a ramp, an escalator or a travelator from the 3D cursor on. Of two selected levels "
                      "it leads from the lower to the higher one")
    type: EnumProperty(name="Type", items=[(word, word.capitalize(), "") for word in fields.LINK_TYPES])
    turn: EnumProperty(name="Turn", items=[("STRAIGHT", "Straight", "One flight"),
                                           ("QUARTER", "Quarter", "Two flights and a landing, to the left"),
                                           ("HALF", "Half", "Two flights beside each other and a landing")])
    width: FloatProperty(name="Width", default=2.0, min=0.5, subtype="DISTANCE")
    length: FloatProperty(name="Length", default=0.0, min=0.0, subtype="DISTANCE",
                          description="Of its slopes, in plan; 0: as the rise asks for")
    angle: FloatProperty(name="Angle", subtype="ANGLE")

    def execute(self, context):
        ends = self._levels(context)
        if len(ends) < 2:
            self.report({"ERROR"}, "A link joins two levels: add them first, or select two")
            return {"CANCELLED"}
        low, high = ends
        rise = geometry.top_of(high) - geometry.top_of(low)
        slope = {"stairs": 0.6, "ramp": 0.08, "escalator": 0.577, "travelator": 0.1}[self.type]
        points = _TURNS[self.turn](self.length or max(rise / slope, 1.0), self.width + 0.3)
        thing = self.add_curve(context, self.type.capitalize(), points, False, "LINK")
        with display.quietly():
            link = thing.throng_layout.link
            link.type, link.width, link.begins, link.ends = self.type, self.width, low, high
        thing.location.z = geometry.top_of(low)
        display.refresh(thing)
        context.view_layer.update()
        return {"FINISHED"}

    @staticmethod
    def _levels(context):
        """The lower and the higher: of those that are selected, or if these are not two, of all."""
        def found(things):
            kept = [thing for thing in things if thing.throng_layout.kind == "LEVEL"]
            return sorted(kept, key=geometry.top_of)

        chosen, every = found(context.selected_objects), found(context.scene.objects)
        return chosen if len(chosen) == 2 else every[:2]

class THRONG_OT_add_seats(_Adds, bpy.types.Operator):
    """Add a block of seats: a curve to shape in edit mode, its first row, or part of a circle. People look to its left,
    or at the middle"""

    bl_idname = "throng.add_seats"
    bl_label = "Add Seats"
    shape: EnumProperty(name="First Row", items=[("LINE", "Curve", "People look to its left"),
                                                 ("ARC", "Arc", "People look at its middle, the 3D cursor")])
    length: FloatProperty(name="Length", default=16.0, min=0.1, subtype="DISTANCE", description="Of a curve")
    radius: FloatProperty(name="Radius", default=15.0, min=1.0, subtype="DISTANCE", description="Of an arc")
    span: FloatProperty(name="Span", default=math.radians(90.0), min=math.radians(1.0), max=math.tau, subtype="ANGLE",
                        description="Of an arc")
    rows: IntProperty(name="Rows", default=6, min=1, max=200)
    rise: FloatProperty(name="Rise", default=0.4, min=0.0, subtype="DISTANCE")
    aisles: IntProperty(name="Aisles", default=1, min=0, max=60)
    angle: FloatProperty(name="Angle", subtype="ANGLE")

    def execute(self, context):
        if self.shape == "LINE":
            half = 0.5 * self.length
            thing = self.add_curve(context, "Seats", [(-half, 0.0), (half, 0.0)], False, "SEATS")
        else:
            thing = geometry.new_arc("Seats", context.scene.cursor.location[:2])
            thing.rotation_euler.z = self.angle
            _enter(context, thing, "SEATS")
        with display.quietly():
            part = thing.throng_layout.seats
            part.shape, part.rows, part.rise, part.aisles = self.shape, self.rows, self.rise, self.aisles
            half = 0.5 * math.degrees(self.span)
            part.radius, part.begins, part.ends = self.radius, -half, half
        display.refresh(thing)
        context.view_layer.update()
        return {"FINISHED"}


class THRONG_OT_add_line(_Adds, bpy.types.Operator):
    """Add a line: where people queue, are mirrored or are counted"""

    bl_idname = "throng.add_line"
    bl_label = "Add Line"
    length: FloatProperty(name="Length", default=6.0, min=0.1, subtype="DISTANCE")
    angle: FloatProperty(name="Angle", subtype="ANGLE")

    def execute(self, context):
        self.add_curve(context, "Line", [(0.0, 0.0), (self.length, 0.0)], False, "LINE")
        return {"FINISHED"}


class THRONG_OT_add_formation(_Adds, bpy.types.Operator):
    """Add people who stand here at a given moment"""

    bl_idname = "throng.add_formation"
    bl_label = "Add Formation"
    type: EnumProperty(name="Type",
                       items=[("circle", "Circle", "Everybody's goal is the opposite point"),
                              ("grid", "Grid", "Rows and columns"),
                              ("agents", "List", "An edge for each person, from where they stand to their goal")])

    def execute(self, context):
        thing = bpy.data.objects.new(self.type.capitalize(), bpy.data.meshes.new("Throng formation"))
        thing.location = context.scene.cursor.location
        with display.quietly():
            thing.throng_layout.formation.type = self.type
        if self.type == "agents":
            geometry.fill_people(thing.data, [((0.0, 0.0), (5.0, 0.0))])
        _enter(context, thing, "FORMATION")
        return {"FINISHED"}


class THRONG_OT_mark(bpy.types.Operator):
    """Make the selected objects a part of the layout, or take them out of it"""

    bl_idname = "throng.mark"
    bl_label = "Mark Selected as"
    bl_options = {"REGISTER", "UNDO"}
    kind: EnumProperty(name="Kind", items=KINDS)

    @classmethod
    def poll(cls, context):
        return in_object_mode(cls, context) and available(
            cls, "" if context.selected_objects else "Nothing is selected: select curves, meshes or empties first")

    def execute(self, context):
        fitting = {"NONE": None, "ROAD": ("CURVE",), "LEVEL": ("CURVE", "MESH"), "LINK": ("CURVE",),
                   "LINE": ("CURVE",), "SEATS": ("CURVE",), "AREA": ("CURVE", "MESH"),
                   "PATCH": ("CURVE", "MESH"), "WALL": ("CURVE", "MESH"), "FORMATION": ("MESH",),
                   "POINT": ("EMPTY",)}[self.kind]
        unfit = [thing.name for thing in context.selected_objects if fitting and thing.type not in fitting]
        if unfit:
            words = " or ".join(word.lower() for word in fitting)
            of = "seats are" if self.kind == "SEATS" else f"a {self.kind.lower()} is"
            self.report({"ERROR"}, f"{', '.join(unfit)}: {of} a {words}")
            return {"CANCELLED"}
        for thing in context.selected_objects:
            part = thing.throng_layout
            part.order = importer.next_order(context.scene)
            part.raw = part.imported_name = ""
            if self.kind == "FORMATION":
                part.formation.type = "agents"
            elif self.kind == "SEATS":
                part.seats.shape = "LINE"
            part.kind = self.kind
            if thing.type == "CURVE":
                thing.hide_render = self.kind != "NONE"
        return {"FINISHED"}


_PLACE_KINDS = ("ROAD", "AREA")


class THRONG_OT_add_flow(bpy.types.Operator):
    bl_idname = "throng.add_flow"
    bl_label = "Add Flow"
    bl_description = ("Add a flow of people. Of two selected places, it goes from the other one to the active one; "
                      "of one road, from its start to its end")
    bl_options = {"REGISTER", "UNDO"}
    count: IntProperty(name="People", default=100, min=0)

    def execute(self, context):
        layout = context.scene.throng_layout
        names = {flow.name for flow in layout.flows}
        flow = layout.flows.add()
        flow.name = next(name for name in (f"Flow {number}" for number in range(len(layout.flows), 2**30))
                         if name not in names)
        flow.count = self.count
        chosen = [thing for thing in context.selected_objects if thing.throng_layout.kind in _PLACE_KINDS]
        last = context.view_layer.objects.active
        if last in chosen:
            first = next((thing for thing in chosen if thing != last), last)
            flow.source.target, flow.to.place.target, flow.to.place.end = first, last, "end"
        layout.active_flow = len(layout.flows) - 1
        return {"FINISHED"}


class THRONG_OT_list(bpy.types.Operator):
    """Add to a list, or take out of it"""

    bl_idname = "throng.list"
    bl_label = "Change List"
    bl_options = {"REGISTER", "UNDO", "INTERNAL"}
    where: StringProperty()   # path from the scene's layout to the collection
    action: EnumProperty(items=[("ADD", "Add", ""), ("REMOVE", "Remove", ""), ("UP", "Up", ""), ("DOWN", "Down", "")])
    index: IntProperty(default=-1)

    def execute(self, context):
        of_object = self.where.startswith(("formation.", "seats."))
        owner = context.object.throng_layout if of_object else context.scene.throng_layout
        group = owner.path_resolve(self.where)
        index = self.index if self.index >= 0 else len(group) - 1
        if self.action == "ADD":
            added = group.add()
            self._name(group, added)
            self._take_selected(context, added)
        elif not 0 <= index < len(group):
            return {"CANCELLED"}
        elif self.action == "REMOVE":
            group.remove(index)
        else:
            group.move(index, max(0, min(len(group) - 1, index + (-1 if self.action == "UP" else 1))))
        return {"FINISHED"}

    @staticmethod
    def _take_selected(context, added):
        """A block of seats that is selected is the one that is meant."""
        thing = context.object
        if isinstance(added, ThrongBlock) and thing and thing.select_get() and thing.throng_layout.kind == "SEATS":
            added.target = thing

    def _name(self, group, added):
        """Behaviours, states and given people have names, and a behaviour begins with its first state."""
        what = self.where.rpartition(".")[2]
        if what == "conditions":
            added.kind = added.kind  # one that the rule has not yet
        if what == "shows":
            added.time.kind = "NUMBER"
        words = {"behaviours": "Behaviour", "states": "State", "given": "Given"}
        if what not in words:
            return
        names, word = {each.name for each in group}, words[what]
        added.name = next(name for name in (f"{word} {number}" for number in range(len(group), 2**30))
                          if name not in names)
        if what == "states" and len(group) == 1:
            owner = self.where.rpartition(".")[0]
            bpy.context.scene.throng_layout.path_resolve(owner).start = added.name


class THRONG_OT_settings_from_scene(bpy.types.Operator):
    """Take the frame rate and the length from the scene"""

    bl_idname = "throng.settings_from_scene"
    bl_label = "From Scene"
    bl_options = {"REGISTER", "UNDO"}

    def execute(self, context):
        take_shot(context.scene)
        return {"FINISHED"}


class EXPORT_SCENE_OT_throng_layout(bpy.types.Operator, ExportHelper):
    """Write the roads, walls, flows ... of the scene as a layout for `throng bake`"""

    bl_idname = "export_scene.throng_layout"
    bl_label = "Export Throng layout"
    filename_ext = ".json"
    filter_glob: StringProperty(default="*.json", options={"HIDDEN"})

    def invoke(self, context, event):
        if not self.filepath:
            self.filepath = os.path.join(os.path.dirname(bpy.data.filepath), default_name(context.scene) + ".json")
        return super().invoke(context, event)

    def execute(self, context):
        try:
            document, _ = export_layout(context)
            write_text(self.filepath, layout_text(document))
        except AuthoringError as error:
            return refused(self, error)
        beside = folder_of_files(context.scene, document)
        if beside and beside != os.path.dirname(os.path.abspath(self.filepath)):
            self.report({"WARNING"}, f"The layout names files that lie in {beside}: copy them beside it")
        self.report({"INFO"}, f"Wrote {self.filepath}")
        return {"FINISHED"}


class IMPORT_SCENE_OT_throng_layout(bpy.types.Operator, ImportHelper):
    """Put a layout into the scene as curves, flows and settings that can be edited"""

    bl_idname = "import_scene.throng_layout"
    bl_label = "Import Throng layout"
    bl_options = {"REGISTER", "UNDO"}
    filename_ext = ".json"
    filter_glob: StringProperty(default="*.json", options={"HIDDEN"})
    replace: BoolProperty(name="Replace", description="Take out the layout that is in the scene")

    def execute(self, context):
        try:
            things = importer.import_layout(context, self.filepath, self.replace)
        except AuthoringError as error:
            return refused(self, error)
        self.report({"INFO"}, f"{len(things)} objects, {len(context.scene.throng_layout.flows)} flows")
        return {"FINISHED"}


CLASSES = (THRONG_OT_add_level, THRONG_OT_add_link,
           THRONG_OT_add_road, THRONG_OT_add_wall, THRONG_OT_add_area, THRONG_OT_add_patch,
           THRONG_OT_add_seats, THRONG_OT_add_line, THRONG_OT_add_formation,
           THRONG_OT_mark, THRONG_OT_add_flow, THRONG_OT_list, THRONG_OT_settings_from_scene,
           EXPORT_SCENE_OT_throng_layout, IMPORT_SCENE_OT_throng_layout)


def _import_menu(self, _context):
    self.layout.operator(IMPORT_SCENE_OT_throng_layout.bl_idname, text="Throng layout (.json)")


def _export_menu(self, _context):
    self.layout.operator(EXPORT_SCENE_OT_throng_layout.bl_idname, text="Throng layout (.json)")

_register_classes, _unregister_classes = bpy.utils.register_classes_factory(CLASSES)


def register():
    _register_classes()
    bpy.types.TOPBAR_MT_file_import.append(_import_menu)
    bpy.types.TOPBAR_MT_file_export.append(_export_menu)


def unregister():
    bpy.types.TOPBAR_MT_file_export.remove(_export_menu)
    bpy.types.TOPBAR_MT_file_import.remove(_import_menu)
    _unregister_classes()
