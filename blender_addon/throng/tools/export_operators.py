# SPDX-License-Identifier: Apache-2.0
"""Export Crowd as Alembic, and as USD: says beforehand what is written and how large it gets."""
import time

import bpy
from bpy.props import BoolProperty, EnumProperty, IntProperty, StringProperty
from bpy_extras.io_utils import ExportHelper

from ..blender.polls import available
from ..crowd.queries import OnCrowds, bake_path, chosen_crowds
from ..formats import BakeError
from .export_files import Plan, Unwritten, Wanted, megabytes, there, view_of, write


class ExportsCrowds(ExportHelper):
    """What both have in common. A file of people may hold their bodies, arrows that tell what streams do, and the
    set."""

    bl_options = {"REGISTER", "PRESET"}

    frame_start: IntProperty(name="First Frame", default=1)
    frame_end: IntProperty(name="Last Frame", default=250)
    bodies: BoolProperty(name="Bodies", default=True, description="Everybody's body, in one mesh for each crowd")
    points: BoolProperty(name="Points", default=True,
                         description="For each person a small arrow, which has what the streams say as maps of UV")
    setting: BoolProperty(name="Set", default=False, description="All other meshes, cameras and lights of the scene")
    most: IntProperty(name="Most People", default=100, min=1, soft_max=20000,
                      description="At most so many: those who come nearest to the camera in its picture, or the first "
                                  "ones where the scene has none")
    detail: EnumProperty(name="Detail", items=[
        ("fine", "Fine", "As near the camera: bent into the pose of the moment where the crowd has bones"),
        ("middle", "Middle", "A third of the triangles, where the crowd has levels of detail"),
        ("far", "Far", "A tenth of the triangles, where the crowd has levels of detail")])

    @classmethod
    def poll(cls, context):
        if not there(cls.exporter()):
            return available(cls, f"This Blender is built without {cls.format_name}")
        return OnCrowds.poll.__func__(cls, context)

    def invoke(self, context, event):
        self.frame_start, self.frame_end = context.scene.frame_start, context.scene.frame_end
        return super().invoke(context, event)

    def plan(self, context):
        if self.frame_end < self.frame_start:
            raise Unwritten(f"the last frame ({self.frame_end}) is before the first one ({self.frame_start})")
        if not (self.bodies or self.points):
            raise Unwritten("nothing is asked for: neither bodies nor points")
        view = view_of(context.scene)
        return Plan(chosen_crowds(context), self.frame_start, self.frame_end,
                    Wanted(self.bodies, self.points, self.setting, self.most, self.detail, view))

    def draw(self, context):
        layout = self.layout
        layout.use_property_split = True
        for name in ("frame_start", "frame_end", "bodies", "points", "setting", "most", "detail"):
            layout.prop(self, name)
        try:
            lines, icon = list(self._told(context)), "INFO"
        except (Unwritten, BakeError, OSError) as error:
            lines, icon = [str(error)], "ERROR"
        for line in lines:
            layout.label(text=line, icon=icon)

    _known = (None, ())

    def _told(self, context):
        """Looked up anew when something is changed: it reads the streams."""
        key = (self.frame_start, self.frame_end, self.bodies, self.points, self.setting, self.most, self.detail,
               view_of(context.scene), *(f"{crowd.name} {bake_path(crowd)}" for crowd in chosen_crowds(context)))
        if self._known[0] != key:
            type(self)._known = (key, tuple(self.plan(context).lines()))
        return self._known[1]

    def execute(self, context):
        began = time.monotonic()
        try:
            plan = self.plan(context)
            size = write(context, self.filepath, plan, lambda path: self.save(path, plan))
        except (Unwritten, BakeError, OSError) as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        told = f"{plan.people:,} people, {plan.frames:,} frames, {megabytes(size)}, {time.monotonic() - began:.1f} s"
        self.report({"INFO"}, f"{self.filepath}: {told}")
        return {"FINISHED"}


class THRONG_OT_export_alembic(ExportsCrowds, bpy.types.Operator):
    """Write the selected crowds, or all, as Alembic: bodies, and points that tell what the streams do"""

    bl_idname = "throng.export_alembic"
    bl_label = "Export Crowd as Alembic"
    format_name, filename_ext = "Alembic", ".abc"
    filter_glob: StringProperty(default="*.abc", options={"HIDDEN"})

    @staticmethod
    def exporter():
        return bpy.ops.wm.alembic_export

    @staticmethod
    def save(path, plan):
        bpy.ops.wm.alembic_export(filepath=path, start=plan.first, end=plan.last, as_background_job=False,
                                  evaluation_mode="RENDER", uvs=True, packuv=False, vcolors=True, face_sets=True,
                                  orcos=False, normals=False, export_hair=False, export_particles=False)


class THRONG_OT_export_usd(ExportsCrowds, bpy.types.Operator):
    """Write the selected crowds, or all, as USD: bodies, and points that tell what the streams do. The command
    throng-io export-usd writes instances and skeletons, in a hundredth of the room"""

    bl_idname = "throng.export_usd"
    bl_label = "Export Crowd as USD"
    format_name, filename_ext = "USD", ".usdc"
    filter_glob: StringProperty(default="*.usdc;*.usda;*.usd", options={"HIDDEN"})

    @staticmethod
    def exporter():
        return bpy.ops.wm.usd_export

    @staticmethod
    def save(path, _plan):
        names = {"rename_uvmaps": False}  # from 4.2 on
        known = bpy.ops.wm.usd_export.get_rna_type().properties.keys()
        bpy.ops.wm.usd_export(filepath=path, export_animation=True, evaluation_mode="RENDER", export_uvmaps=True,
                              export_normals=False, export_materials=True,
                              **{name: value for name, value in names.items() if name in known})


CLASSES = (THRONG_OT_export_alembic, THRONG_OT_export_usd)
_register_classes, _unregister_classes = bpy.utils.register_classes_factory(CLASSES)


def _menu(self, _context):
    for operator in CLASSES:
        if there(operator.exporter()):
            self.layout.operator(operator.bl_idname, text=f"Throng crowd ({operator.filename_ext})")


def register():
    _register_classes()
    bpy.types.TOPBAR_MT_file_export.append(_menu)


def unregister():
    bpy.types.TOPBAR_MT_file_export.remove(_menu)
    _unregister_classes()
