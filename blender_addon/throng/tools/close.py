# SPDX-License-Identifier: Apache-2.0
"""People close to the camera get meshes of more detail, for final pictures (crowd/close.py): who comes so close is
looked up in the frames of the shot, and only their meshes are made."""
import bpy
import numpy
from bpy.props import EnumProperty, FloatProperty, IntProperty

from ..blender.nodes import Maths, drop_tree, get_input, new_tree, set_input
from ..blender.panels import Below
from ..crowd import close, near, poses
from ..crowd.names import INSTANCERS, NEAR, WHO
from ..crowd.playback import cast_changed
from ..crowd.queries import cast_of, crowds_of, repertoire_of
from . import culling
from . import near as near_people
from .by_camera import NO_BONES, ByCamera, Refused

DISTANCE, MOST = 8.0, 24  # m, people
STEP = 6       # frames: between two looks nobody comes nearer by more than MARGIN
MARGIN = 0.7   # m
_GEOMETRY = [("Geometry", "NodeSocketGeometry")]


def _who_tree(cast):
    """Nodes that file away which member everybody is."""
    tree, inputs, outputs = new_tree("Throng who comes close", _GEOMETRY, _GEOMETRY)
    maths = Maths(tree)
    who = poses.member_in(maths, cast, maths.components("throng_state")[1])
    maths.link(maths.store(inputs.outputs[0], WHO, who, "INT"), outputs.inputs[0])
    return tree


def _looked_at(scene, crowd, frame, most):
    """Members who are close in a frame."""
    scene.frame_set(frame)
    mesh = crowd.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
    near_, who = numpy.empty(len(mesh.vertices), numpy.float32), numpy.empty(len(mesh.vertices), numpy.int32)
    mesh.attributes[NEAR].data.foreach_get("value", near_)
    mesh.attributes[WHO].data.foreach_get("value", who)
    nearest = numpy.argsort(-near_, kind="stable")[:most]
    return set(who[nearest[near_[nearest] > 1.0]].tolist())


def members_close(scene, crowd, distance, most, frames):
    """Members of a crowd's cast who come so close to the camera in any of some frames. The crowd's near people have
    been chosen (tools/near.py)."""
    chooser, instancers = crowd.modifiers[near.MODIFIER], [crowd.modifiers[name] for name in INSTANCERS]
    before, at = get_input(chooser, "Close"), scene.frame_current
    looks = [each.show_viewport for each in instancers]
    who = crowd.modifiers.new("throng who", "NODES")
    tree = who.node_group = _who_tree(cast_of(crowd))
    culling.put_before_instancer(crowd, who)
    try:
        for each in instancers:
            each.show_viewport = False
        set_input(chooser, "Close", distance + (MARGIN if len(frames) > 1 else 0.0))
        crowd.update_tag()
        return set().union(*(_looked_at(scene, crowd, frame, most) for frame in frames))
    finally:
        crowd.modifiers.remove(who)
        drop_tree(tree)
        set_input(chooser, "Close", before)
        for each, look in zip(instancers, looks):
            each.show_viewport = look
        crowd.update_tag()
        scene.frame_set(at)


def apply(crowd, scene, distance, most, frames, told=lambda done, all_: None):
    """At most so many people within `distance` metres before the camera have more detail. Returns how many meshes were
    made, or None where the crowd's cast keeps no bones. Raises LibraryError where meshes cannot be made."""
    cast = cast_of(crowd)
    if near.MODIFIER not in crowd.modifiers and not near_people.apply(crowd, scene.camera):
        return None
    boned = len(near.boned_members(cast))
    wanted = {member for member in members_close(scene, crowd, distance, most, frames) if member < boned}
    missing = sorted(wanted - set(close.meshes_of(cast)))
    for done, member in enumerate(missing):
        told(done, len(missing))
        close.add(cast, member, repertoire_of(crowd))
    crowd[close.MOST] = most
    set_input(crowd.modifiers[near.MODIFIER], "Close", float(distance))
    cast_changed(crowd)
    return len(missing)


def remove(crowd):
    """Near people have the meshes of everybody again."""
    if close.MOST not in crowd:
        return
    del crowd[close.MOST]
    if near.MODIFIER in crowd.modifiers:
        set_input(crowd.modifiers[near.MODIFIER], "Close", 0.0)
    cast = cast_of(crowd)
    if not any(close.MOST in other for other in crowds_of(cast)):
        close.forget(cast)
    cast_changed(crowd)


def _frames(scene, which):
    """Those that are looked at."""
    if which == "now":
        return [scene.frame_current]
    return sorted({*range(scene.frame_start, scene.frame_end + 1, STEP), scene.frame_end})


class THRONG_OT_close(ByCamera, bpy.types.Operator):
    """Show the people closest to the camera in more detail, in final pictures"""

    bl_idname = "throng.close"
    bl_label = "Close People"
    bl_options = {"REGISTER", "UNDO"}

    by: EnumProperty(name="By", items=[("camera", "Camera", "Those before the scene's camera"),
                                       ("none", "Nothing", "Nobody has more detail than others")])
    distance: FloatProperty(name="Distance", default=DISTANCE, min=0.5, max=100.0, subtype="DISTANCE",
                            description="How far from the camera people have more detail")
    most: IntProperty(name="Most", default=MOST, min=1, max=500,
                      description="At most so many have: where there are more, the distance shrinks")
    frames: EnumProperty(name="Frames", items=[("shot", "Shot", "Whoever comes close in any frame of the scene"),
                                               ("now", "This Frame", "Whoever is close now: for a still")])

    take_back = staticmethod(remove)

    def change(self, context, crowds):
        scene, manager = context.scene, context.window_manager
        frames = _frames(scene, self.frames)
        manager.progress_begin(0.0, 1.0)
        try:
            made = [apply(crowd, scene, self.distance, self.most, frames,
                          lambda done, all_: manager.progress_update(done / all_)) for crowd in crowds]
        finally:
            manager.progress_end()
        if all(each is None for each in made):
            raise Refused(NO_BONES)
        return (f"{sum(filter(None, made))} meshes made; at most {self.most} people within {self.distance:g} m are "
                "shown in more detail")


class VIEW3D_PT_throng_close(Below, bpy.types.Panel):
    bl_label = "Close People"

    def draw(self, _context):
        row = self.layout.row(align=True)
        row.operator(THRONG_OT_close.bl_idname, text="Detail").by = "camera"
        row.operator(THRONG_OT_close.bl_idname, text="Off").by = "none"


CLASSES = (THRONG_OT_close, VIEW3D_PT_throng_close)
register, unregister = bpy.utils.register_classes_factory(CLASSES)
