# SPDX-License-Identifier: Apache-2.0
"""Crowds on their way to other programs: most exporters take no instances of nodes along, and say nothing. Throng says
it in their dialogues, in the sidebar, and when the export is made where the exporter asks add-ons."""
import importlib.util

import bpy
from bpy.props import BoolProperty

from ..blender.nodes import Maths, new_tree, own_tree
from ..blender.panels import Below
from ..crowd.queries import ChangesCrowds, OnCrowds, changed_crowds, crowd_objects

MODIFIER = "throng realize"
_WHERE = "Realize for Export before, or Export Crowd instead (sidebar, Throng, To Other Programs)"
# What each exporter makes of people who are instances.
LEAVE_OUT = {"WM_OT_usd_export": f"USD gets no bodies of people: {_WHERE}",
             "WM_OT_alembic_export": f"Alembic gets no bodies of people: {_WHERE}",
             "EXPORT_SCENE_OT_fbx": f"FBX gets no people, and realised ones stand still: {_WHERE}",
             "EXPORT_SCENE_OT_gltf": "glTF gets no people, unless its Geometry Nodes Instances are switched on, and "
                                     "these stand still: take the bake's crowd.glb, in which they walk"}


def is_realised(crowd):
    return MODIFIER in crowd.modifiers


def instanced(scene):
    """The crowds of a scene that exporters see as instances."""
    return [crowd for crowd in crowd_objects(scene) if not is_realised(crowd)]


def realising_tree():
    found = own_tree("Throng realize")
    if found:
        return found
    geometry = [("Geometry", "NodeSocketGeometry")]
    tree, inputs, outputs = new_tree("Throng realize", geometry, geometry)
    maths = Maths(tree)
    node = maths.node("GeometryNodeRealizeInstances")
    maths.link(inputs.outputs[0], node.inputs[0])
    maths.link(node.outputs[0], outputs.inputs[0])
    return tree


def realise(crowd, wanted):
    """Makes everybody's pose a part of one mesh, which every exporter knows; or instances again."""
    if wanted and not is_realised(crowd):
        crowd.modifiers.new(MODIFIER, "NODES").node_group = realising_tree()
    elif not wanted and is_realised(crowd):
        crowd.modifiers.remove(crowd.modifiers[MODIFIER])
    crowd.update_tag()


def say(sentence):
    """In the console, and in the window where there is one. Exporters may call from another thread: later, then."""
    print(f"Throng: warning: {sentence}")
    if bpy.app.background:
        return

    def show():
        bpy.context.window_manager.popup_menu(lambda menu, _: menu.layout.label(text=sentence), title="Throng",
                                              icon="ERROR")

    bpy.app.timers.register(show, first_interval=0.1)


def _names(crowds):
    return ", ".join(crowd.name for crowd in crowds)


def gltf_problem(scene, settings):
    """What is wrong with a glTF export of a scene; empty where it has no crowd."""
    crowds = [crowd for crowd in crowd_objects(scene) if crowd.select_get() or not settings.get("gltf_selected")]
    shown = [crowd for crowd in crowds if settings.get("gltf_apply" if is_realised(crowd) else "gltf_gn_mesh")]
    lost = [crowd for crowd in crowds if crowd not in shown]
    if lost:
        needs = ("Apply Modifiers has to be on for realised crowds" if any(map(is_realised, lost))
                 else "Geometry Nodes Instances bring them along where Blender has that option (from 4.0 on), standing "
                 "still")
        return f"the people of {_names(lost)} are not in this glTF: {needs}; in the bake's crowd.glb they walk"
    if shown:
        return (f"the people of {_names(shown)} stand still in this glTF, as in frame {scene.frame_current}; in the "
                "bake's crowd.glb they walk")
    return ""


def glTF2_pre_export_callback(settings):  # noqa: N802, the exporter looks for this name
    problem = gltf_problem(bpy.context.scene, settings)
    log = settings.get("log")
    if problem and hasattr(log, "messages"):  # which the exporter's operator reports
        log.warning(f"Throng: {problem}", popup=True)
    elif problem:
        say(problem)


def usd_problem(scene):
    crowds = instanced(scene)
    return f"the people of {_names(crowds)} have no bodies in this USD: {_WHERE}" if crowds else ""


_HOOKS = []
if hasattr(bpy.types, "USDHook"):  # not where Blender is built without USD

    class ThrongUsdHook(bpy.types.USDHook):
        bl_idname = "throng_usd_hook"
        bl_label = "Throng"

        @staticmethod
        def on_export(_context):
            problem = usd_problem(bpy.context.scene)
            if problem:
                say(problem)
            return True

    if importlib.util.find_spec("pxr"):  # or calling it ends Blender: the module bpy has no Python of USD
        _HOOKS.append(ThrongUsdHook)


class THRONG_OT_realize(ChangesCrowds, bpy.types.Operator):
    bl_idname = "throng.realize"
    bl_label = "Realize for Export"
    bl_description = ("Make the people of the selected crowds, or of all, one mesh that USD, Alembic and other "
                      "exporters know. Files get large: take it back after the export")
    bl_options = {"REGISTER", "UNDO"}

    realize: BoolProperty(name="Realize", default=True)

    def execute(self, context):
        for crowd in changed_crowds(context):
            realise(crowd, self.realize)
        return {"FINISHED"}


def _wrapped(layout, text, icon, width=44):
    """A sentence on as many lines as a narrow panel needs."""
    line = ""
    for word in [*text.split(), None]:
        if word is None or len(line) + len(word) >= width:
            layout.label(text=line, icon=icon)
            line, icon = "", "BLANK1"
        line += f" {word}" if line else word or ""


class VIEW3D_PT_throng_export(OnCrowds, Below, bpy.types.Panel):
    bl_label = "To Other Programs"

    def draw(self, context):
        layout, crowds = self.layout, instanced(context.scene)
        if crowds:
            _wrapped(layout, "People are instances: USD, Alembic and FBX get no bodies of them", "ERROR")
        else:
            _wrapped(layout, "People are realised: slow, and nobody can be picked", "INFO")
        _wrapped(layout, "glTF: take the bake's crowd.glb, in which people walk", "INFO")
        column = layout.column(align=True)
        for operator in ("throng.export_alembic", "throng.export_usd"):
            column.operator(operator)
        row = layout.row(align=True)
        row.operator(THRONG_OT_realize.bl_idname).realize = True
        row.operator(THRONG_OT_realize.bl_idname, text="Instances Again").realize = False


class FILEBROWSER_PT_throng_export(bpy.types.Panel):
    """In the dialogues of exporters that leave people out."""

    bl_space_type, bl_region_type, bl_parent_id = "FILE_BROWSER", "TOOL_PROPS", "FILE_PT_operator"
    bl_label = "Throng"

    @classmethod
    def poll(cls, context):
        operator = context.space_data.active_operator
        return operator is not None and operator.bl_idname in LEAVE_OUT and bool(instanced(context.scene))

    def draw(self, context):
        _wrapped(self.layout, LEAVE_OUT[context.space_data.active_operator.bl_idname], "ERROR")


CLASSES = (THRONG_OT_realize, VIEW3D_PT_throng_export, FILEBROWSER_PT_throng_export, *_HOOKS)

register, unregister = bpy.utils.register_classes_factory(CLASSES)
