# SPDX-License-Identifier: Apache-2.0
import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty, StringProperty
from bpy_extras.io_utils import ImportHelper

from ..blender.panels import InSidebar
from ..crowd.queries import ChangesCrowds, OnCrowds, changed_crowds, chosen_crowds, crowd_objects, earlier_crowds
from ..crowd.verify import verify
from ..formats import BakeError
from ..overrides.operators import report_orphans
from ..people import members
from . import cells, culling, cutaway, film_look
from .importer import import_bake
from .update import reload, set_offset, set_viewport_percent


class IMPORT_SCENE_OT_throng(bpy.types.Operator, ImportHelper):
    """Import a crowd baked by Throng"""

    bl_idname = "import_scene.throng"
    bl_label = "Import Throng bake"
    bl_options = {"REGISTER", "UNDO", "PRESET"}

    filename_ext = ".json"
    filter_glob: StringProperty(default="*.json", options={"HIDDEN"})
    frame_start: IntProperty(name="First Frame", default=1,
                             description="The scene's frame that shows the bake's first frame")
    walls: BoolProperty(name="Walls", default=True, description="Build the layout's walls as meshes")
    roads: BoolProperty(name="Roads", default=True, description="Build the layout's roads and areas as meshes")
    scenery: BoolProperty(name="Ground and Light", default=True, description="Add a ground, a sun and a sky")
    dressing: BoolProperty(name="Dressing", default=True,
                           description="With the ground: cars, trees, benches and the like where nobody walks, and "
                                       "streets that go on where the layout's end")
    camera: BoolProperty(name="Camera", default=True, description="Add a camera that frames the crowd")
    people: IntProperty(name="Different People", default=members.MEMBERS, min=1, max=90,
                        description="How many people the crowd draws on, where they are shaped from a library of "
                                    "bodies: more take more memory, and time to make")
    bend: BoolProperty(name="Bend Near People", default=True,
                       description="Before a camera, people who are shaped from a library of bodies are bent into the "
                                   "pose of the moment; all others take the next one that there is")
    relative: BoolProperty(name="Relative Paths", default=True,
                           description="Store the streams' paths relative to the .blend, once that is saved")

    def execute(self, context):
        try:
            crowd = import_bake(context, self.filepath, frame_start=self.frame_start, walls=self.walls,
                                roads=self.roads, scenery=self.scenery, camera=self.camera, relative=self.relative,
                                dressing=self.dressing, people=self.people, bend=self.bend)
        except BakeError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        report_orphans(self,
                       [f"{item.name}: {item.detail}" for item in crowd.throng_overrides if item.status == "orphaned"])
        self.report({"INFO"}, f"Imported {len(crowd.data.vertices)} people")
        return {"FINISHED"}


class _ChangesCrowds(ChangesCrowds):
    bl_options = {"REGISTER", "UNDO"}

    def follow(self, crowds):
        """The ground shows the cells of what these crowds play now."""
        for line in [line for crowd in crowds for line in cells.follow(crowd)]:
            self.report({"WARNING"}, line)


class THRONG_OT_verify(OnCrowds, bpy.types.Operator):
    """Say what is wrong with the bakes of the selected crowds, or of all"""

    bl_idname = "throng.verify"
    bl_label = "Verify Bakes"
    bl_options = {"REGISTER"}

    def execute(self, context):
        found = [f"{crowd.name}: {problem}" for crowd in chosen_crowds(context)
                 for problem in verify(crowd, context.scene)]
        if found:
            self.report({"WARNING"}, "\n".join(found))
        else:
            self.report({"INFO"}, "All bakes are whole")
        return {"FINISHED"}


class THRONG_OT_reload(_ChangesCrowds, bpy.types.Operator):
    bl_idname = "throng.reload"
    bl_label = "Re-load Bakes"
    bl_description = ("Play the selected crowds' bakes as they are now: after baking again, or after files have moved. "
                      "Looks and settings stay")

    def execute(self, context):
        try:
            orphans = [orphan for crowd in changed_crowds(context) for orphan in reload(crowd, context.scene)]
        except BakeError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        report_orphans(self, orphans)
        self.follow(changed_crowds(context))
        return {"FINISHED"}


class THRONG_OT_relink(_ChangesCrowds, bpy.types.Operator, ImportHelper):
    """Let the selected crowd play another bake. Looks and settings stay"""

    bl_idname = "throng.relink"
    bl_label = "Choose Another Bake"
    filename_ext = ".json"
    filter_glob: StringProperty(default="*.json", options={"HIDDEN"})

    def execute(self, context):
        crowds = changed_crowds(context)
        if len(crowds) != 1:
            self.report({"ERROR"}, "Select one crowd: each plays a bake of its own")
            return {"CANCELLED"}
        try:
            orphans = reload(crowds[0], context.scene, self.filepath)
        except BakeError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        report_orphans(self, orphans)
        self.follow(crowds)
        return {"FINISHED"}


class THRONG_OT_show(_ChangesCrowds, bpy.types.Operator):
    """How the selected crowds are shown: how many people in the viewport, and when they begin"""

    bl_idname = "throng.show"
    bl_label = "Show Crowds"

    percent: FloatProperty(name="In the Viewport", default=100.0, min=0.0, max=100.0, subtype="PERCENTAGE",
                           description="Renders show everybody")
    offset: IntProperty(name="Later by", default=0, description="Frames that the crowd plays later")

    def invoke(self, context, _event):
        crowd = changed_crowds(context)[0]
        self.percent, self.offset = crowd.get("throng_percent", 100.0), crowd.get("throng_offset", 0)
        return context.window_manager.invoke_props_dialog(self)

    def execute(self, context):
        chosen = changed_crowds(context)
        later = [crowd for crowd in chosen if crowd.get("throng_offset", 0) != self.offset]
        for crowd in chosen:
            set_viewport_percent(crowd, self.percent)
            set_offset(crowd, self.offset)
        self.follow(later)
        return {"FINISHED"}


class THRONG_OT_cull(_ChangesCrowds, bpy.types.Operator):
    """Leave out people whom nobody sees: outside the active box (a cube empty) or outside the scene's camera"""

    bl_idname = "throng.cull"
    bl_label = "Cull Crowds"

    by: EnumProperty(name="By", items=[("none", "Nothing", "Everybody is there"),
                                       ("box", "Box", "The active empty, or a new one round the crowd"),
                                       ("camera", "Camera", "What the scene's camera sees")])
    margin: FloatProperty(name="Margin", default=3.0, min=0.0, subtype="DISTANCE",
                          description="Whoever is out by less stays, for shadows and reflections")

    def execute(self, context):
        camera = context.scene.camera
        if self.by == "camera" and (not camera or camera.type != "CAMERA"):
            self.report({"ERROR"}, "The scene has no camera")
            return {"CANCELLED"}
        active = context.view_layer.objects.active
        for crowd in changed_crowds(context):
            if self.by == "none":
                culling.remove(crowd)
                continue
            target = camera
            if self.by == "box":
                target = active if active and active.type == "EMPTY" else culling.box(context.scene, crowd)
            culling.apply(crowd, context.scene, self.by, target, self.margin)
        return {"FINISHED"}


class THRONG_OT_cutaway(_ChangesCrowds, bpy.types.Operator):
    """Take off what is above a height, or a level with all above it, to look into the storeys below"""

    bl_idname = "throng.cutaway"
    bl_label = "Cut Storeys Away"

    by: EnumProperty(name="By", items=[("height", "Height", "All that is above it"),
                                       ("level", "Level", "This level, and all above its floor"),
                                       ("none", "Nothing", "Everything is there")])
    height: FloatProperty(name="Height", default=2.5, subtype="DISTANCE", description="Above the crowd's origin")
    level: StringProperty(name="Level", description="As the layout calls it")

    def execute(self, context):
        for crowd in changed_crowds(context):
            if self.by == "none":
                cutaway.remove(crowd)
                continue
            try:
                cutaway.apply(crowd, self.height if self.by == "height" else cutaway.floor_of(crowd, self.level))
            except BakeError as error:
                self.report({"ERROR"}, str(error))
                return {"CANCELLED"}
        return {"FINISHED"}


class THRONG_OT_film_look(bpy.types.Operator):
    bl_idname = "throng.film_look"
    bl_label = "Film Look"
    bl_description = ("Set up rendering as for film: noise, motion blur, depth of field, a crane move, haze, "
                      "and layers to composite with")
    bl_options = {"REGISTER", "UNDO"}

    preset: EnumProperty(name="For", items=[("preview", "Preview", "Small and quick, PNG"),
                                            ("plate", "Plate", "HD, multilayer EXR with Cryptomatte"),
                                            ("final", "Final", "As a plate, with four times the samples")])
    crane: BoolProperty(name="Crane Move", default=True, description="The camera rises and drifts over the shot")
    haze: FloatProperty(name="Haze", default=0.3, min=0.0, max=1.0,
                        description="How much of what is far is lost in the air")

    def execute(self, context):
        if not hasattr(context.scene, "cycles"):
            self.report({"ERROR"}, "Film looks render with Cycles: enable the add-on Cycles Render Engine "
                                   "in Blender's preferences")
            return {"CANCELLED"}
        try:
            film_look.apply(context.scene, self.preset, crane=self.crane, haze=self.haze)
        except BakeError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        return {"FINISHED"}


class VIEW3D_PT_throng(InSidebar, bpy.types.Panel):
    bl_label = "Throng"

    def draw(self, context):
        layout = self.layout
        layout.operator(IMPORT_SCENE_OT_throng.bl_idname, icon="IMPORT")
        for crowd in crowd_objects(context.scene):
            row = layout.row()
            row.label(text=crowd.name, icon="COMMUNITY")
            row.label(text=f"{len(crowd.data.vertices):,} people")
        for crowd in earlier_crowds(context.scene):
            layout.label(text=f"{crowd.name}: of an earlier version, import its bake again", icon="ERROR")
        column = layout.column(align=True)
        for operator in (THRONG_OT_show, THRONG_OT_cull, THRONG_OT_cutaway, THRONG_OT_verify, THRONG_OT_reload,
                         THRONG_OT_relink):
            column.operator(operator.bl_idname)
        row = layout.row(align=True)
        for preset in ("preview", "plate", "final"):
            row.operator(THRONG_OT_film_look.bl_idname, text=preset.capitalize()).preset = preset


CLASSES = (IMPORT_SCENE_OT_throng, THRONG_OT_verify, THRONG_OT_reload, THRONG_OT_relink, THRONG_OT_show, THRONG_OT_cull,
           THRONG_OT_cutaway, THRONG_OT_film_look, VIEW3D_PT_throng)


def _menu(self, _context):
    self.layout.operator(IMPORT_SCENE_OT_throng.bl_idname, text="Throng bake (bake.json)")

_register_classes, _unregister_classes = bpy.utils.register_classes_factory(CLASSES)


def register():
    _register_classes()
    bpy.types.TOPBAR_MT_file_import.append(_menu)


def unregister():
    bpy.types.TOPBAR_MT_file_import.remove(_menu)
    _unregister_classes()
