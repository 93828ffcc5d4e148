# SPDX-License-Identifier: Apache-2.0
"""From where a crowd is seen, and in what light."""
import bpy
from bpy.props import EnumProperty, FloatProperty

from ..blender.panels import Below
from ..crowd.queries import ChangesCrowds, OnCrowds, bake_path, changed_crowds, collection_of
from ..environment import camera, lights, skies, weather
from ..formats import BakeError, read_manifest


def _staged(context):
    """The chosen crowd's collection and manifest. Raises BakeError."""
    crowd = changed_crowds(context)[0]
    collection = collection_of(crowd)
    if not collection:
        raise BakeError("this crowd's collection is not its import's any more: import the bake again")
    return collection, read_manifest(bake_path(crowd))


class _Stages(ChangesCrowds):
    bl_options = {"REGISTER", "UNDO"}

    def execute(self, context):
        try:
            self.stage(context.scene, *_staged(context))
        except BakeError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        return {"FINISHED"}


class THRONG_OT_shot(_Stages, bpy.types.Operator):
    """Put the crowd's camera somewhere else"""

    bl_idname = "throng.shot"
    bl_label = "Shot"
    kind: EnumProperty(name="From", items=[("crane", "A Crane", "Above the street, along it"),
                                           ("street", "The Street", "At eye level, in the crowd"),
                                           ("wide", "Afar", "Everybody is in the picture")])

    def stage(self, scene, collection, manifest):
        camera.build_camera(scene, manifest, collection, self.kind)


class THRONG_OT_light(_Stages, bpy.types.Operator):
    """Light the crowd's place"""

    bl_idname = "throng.light"
    bl_label = "Light"
    time: EnumProperty(name="Time", items=[
        ("noon", "Noon", "A high sun, blue sky and white clouds"),
        ("overcast", "Overcast", "Grey clouds all over, hardly a shadow"),
        ("late", "Late", "A late-afternoon sun, and clouds that it lights from the side"),
        ("night", "Night", "The moon, street lamps or floodlights, lit windows")])

    def stage(self, scene, collection, manifest):
        lights.build_light(scene, collection, self.time, manifest)


class THRONG_OT_rain(_Stages, bpy.types.Operator):
    """Say how wet the ground is, of all crowds in this file"""

    bl_idname = "throng.rain"
    bl_label = "Rain"
    amount: FloatProperty(name="Amount", default=1.0, min=0.0, max=1.0, subtype="FACTOR",
                          description="0 dry, 0.5 damp, 1 with puddles that mirror the street")

    def stage(self, _scene, _collection, _manifest):
        weather.set_rain(self.amount)


class VIEW3D_PT_throng_staging(OnCrowds, Below, bpy.types.Panel):
    bl_label = "Shot and Light"

    def draw(self, _context):
        for operator, key, choices in ((THRONG_OT_shot, "kind", camera.SHOTS), (THRONG_OT_light, "time", skies.TIMES)):
            row = self.layout.row(align=True)
            for choice in choices:
                setattr(row.operator(operator.bl_idname, text=choice.capitalize()), key, choice)
        row = self.layout.row(align=True)
        for text, amount in (("Dry", 0.0), ("Damp", 0.5), ("Wet", 1.0)):
            row.operator(THRONG_OT_rain.bl_idname, text=text).amount = amount


CLASSES = (THRONG_OT_shot, THRONG_OT_light, THRONG_OT_rain, VIEW3D_PT_throng_staging)

register, unregister = bpy.utils.register_classes_factory(CLASSES)
