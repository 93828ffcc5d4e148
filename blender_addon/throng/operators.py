# SPDX-License-Identifier: Apache-2.0
import bpy
from bpy.props import BoolProperty, IntProperty, StringProperty
from bpy_extras.io_utils import ImportHelper

from .formats import BakeError


class IMPORT_SCENE_OT_throng(bpy.types.Operator, ImportHelper):
    """Import a crowd baked by Throng"""

    bl_idname = "import_scene.throng"
    bl_label = "Import Throng bake"
    bl_options = {"REGISTER", "UNDO", "PRESET"}

    filename_ext = ".json"
    filter_glob: StringProperty(default="*.json", options={"HIDDEN"})
    frame_start: IntProperty(name="First Frame", default=1, description="The scene's frame that shows the bake's first frame")
    walls: BoolProperty(name="Walls", default=True, description="Build the layout's walls as meshes")
    roads: BoolProperty(name="Roads", default=True, description="Build the layout's roads and areas as meshes")
    scenery: BoolProperty(name="Ground and Light", default=True, description="Add a ground, a sun and a sky")
    camera: BoolProperty(name="Camera", default=True, description="Add a camera that frames the crowd")
    relative: BoolProperty(name="Relative Paths", default=True, description="Store the streams' paths relative to the .blend, once that is saved")

    def execute(self, context):
        from .importer import import_bake

        try:
            crowd = import_bake(context, self.filepath, frame_start=self.frame_start, walls=self.walls, roads=self.roads,
                                scenery=self.scenery, camera=self.camera, relative=self.relative)
        except BakeError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        self.report({"INFO"}, f"Imported {len(crowd.data.vertices)} people")
        return {"FINISHED"}


def _menu(self, _context):
    self.layout.operator(IMPORT_SCENE_OT_throng.bl_idname, text="Throng bake (bake.json)")


def register():
    bpy.utils.register_class(IMPORT_SCENE_OT_throng)
    bpy.types.TOPBAR_MT_file_import.append(_menu)


def unregister():
    bpy.types.TOPBAR_MT_file_import.remove(_menu)
    bpy.utils.unregister_class(IMPORT_SCENE_OT_throng)
