# SPDX-License-Identifier: Apache-2.0
"""A rigged character in Blender: its armature, meshes and clips, and where its bones are when a clip plays."""
import fnmatch
from dataclasses import dataclass, field

import bpy
import numpy

from ..blender.actions import curves_of
from . import CharacterError
from .roles import words_of
from .skin import Skin

_HELD = set("hand handslot wrist weapon prop slot item attach tool".split())


@dataclass
class Clip:
    name: str
    action: object
    slot: object = None  # from Blender 4.4

    @property
    def range(self):
        start, end = self.action.frame_range
        return float(start), float(end)


@dataclass
class Rig:
    armature: object
    meshes: list
    clips: list
    held: list = field(default_factory=list)  # names of what hands hold, left out


def _moves_bones(action, armature):
    """Whether an action was made for such bones."""
    bones = {curve.data_path.split('"')[1] for curve in curves_of(action) if curve.data_path.startswith('pose.bones["')}
    return bool(bones) and len(bones & set(armature.data.bones.keys())) * 2 > len(bones)


def _own_clips(data):
    """Those on NLA tracks, and the one in the armature's hand."""
    for track in data.nla_tracks:
        for strip in track.strips:
            if strip.action:
                named = len(track.strips) == 1 and not track.name.startswith("NlaTrack")
                yield Clip(track.name if named else strip.action.name, strip.action,
                           getattr(strip, "action_slot", None))
    if data.action:
        yield Clip(data.action.name, data.action, getattr(data, "action_slot", None))


def clips_of(armature):
    """Clips on the armature's NLA tracks and in its hand; where there are none, every action in the file
    that moves such bones."""
    found = {}
    for clip in _own_clips(armature.animation_data) if armature.animation_data else ():
        found.setdefault(clip.action.name, clip)
    if len(found) < 2:
        for action in bpy.data.actions:
            if action.name not in found and _moves_bones(action, armature):
                found[action.name] = Clip(action.name, action)
    return [clip for clip in found.values() if _moves_bones(clip.action, armature)]


def _belongs(thing, armature):
    if is_skinned(thing, armature):
        return True
    while thing.parent:
        thing = thing.parent
        if thing == armature:
            return True
    return False


def is_skinned(thing, armature):
    return any(m.type == "ARMATURE" and m.object == armature for m in thing.modifiers)


def bone_above(thing, armature):
    """The bone that a rigid thing hangs on, itself or by its parents; empty where there is none."""
    while thing.parent and thing.parent != armature:
        thing = thing.parent
    return thing.parent_bone if thing.parent_type == "BONE" else ""


def _in_hand(thing, armature):
    """Whether a rigid thing hangs on a hand, or on what is below one."""
    if is_skinned(thing, armature) or not any(is_skinned(each, armature) for each in bpy.data.objects):
        return False  # where all is rigid, this is the hand
    bone = armature.data.bones.get(bone_above(thing, armature))
    while bone:
        if _HELD & set(words_of(bone.name)):
            return True
        bone = bone.parent
    return False


def _matches(name, patterns):
    return any(fnmatch.fnmatchcase(name.lower(), pattern) for pattern in patterns)


def patterns_of(text):
    return [part.strip().lower() for part in text.split(",") if part.strip()]


def rig_of(armature, leave_out="", keep=""):
    """The character that hangs on an armature. `leave_out` and `keep` are names of meshes, by comma, with * and ?; what
    hands hold is left out unless it is kept."""
    out, kept = patterns_of(leave_out), patterns_of(keep)
    meshes, held = [], []
    for thing in bpy.data.objects:
        if thing.type != "MESH" or not thing.data.polygons or not _belongs(thing, armature):
            continue
        if _matches(thing.name, kept):
            meshes.append(thing)
        elif _matches(thing.name, out) or thing.hide_render:
            continue
        elif _in_hand(thing, armature):
            held.append(thing.name)
        else:
            meshes.append(thing)
    meshes.sort(key=lambda thing: thing.name)
    if not meshes:
        raise CharacterError(f"no mesh hangs on the armature {armature.name}: a character needs meshes with an "
                             "Armature modifier, or parented to bones")
    clips = clips_of(armature)
    if not clips:
        raise CharacterError(f"the armature {armature.name} has no clips: a character needs at least one that walks "
                             "(an action on its bones)")
    return Rig(armature, meshes, clips, held)


class Stage:
    """A scene of its own where a character plays clips, so that nothing else is evaluated. Leaves all as it was."""

    def __init__(self, rig):
        self.rig = rig
        self.scene = bpy.data.scenes.new("throng stage")
        armature = rig.armature
        self.scene.collection.objects.link(armature)
        for parent in _parents(armature):
            self.scene.collection.objects.link(parent)
        self.bones = _parents_first(armature.data.bones)
        self.names = [bone.name for bone in self.bones]
        self.parents = [self.names.index(bone.parent.name) if bone.parent else -1 for bone in self.bones]
        self.rest = numpy.array([bone.matrix_local for bone in self.bones])
        data = armature.animation_data or armature.animation_data_create()
        self._before = (data.action, getattr(data, "action_slot", None), data.use_nla, armature.data.pose_position,
                        {bone.name: bone.matrix_basis.copy() for bone in armature.pose.bones},
                        armature.matrix_basis.copy())
        armature.data.pose_position = "POSE"

    def __enter__(self):
        return self

    def __exit__(self, *_):
        armature = self.rig.armature
        data = armature.animation_data
        action, slot, data.use_nla, armature.data.pose_position, bases, basis = self._before
        _assign(data, action, slot)
        armature.matrix_basis = basis
        for name, matrix in bases.items():
            armature.pose.bones[name].matrix_basis = matrix
        bpy.data.scenes.remove(self.scene)

    def _graph(self):
        layer = self.scene.view_layers[0]
        layer.update()
        return layer.depsgraph

    def _matrices(self):
        """(B, 4, 4) of all bones in the world."""
        armature = self.rig.armature.evaluated_get(self._graph())
        world = numpy.array(armature.matrix_world)
        return numpy.array([world @ numpy.array(armature.pose.bones[name].matrix) for name in self.names])

    def rest_pose(self):
        return numpy.array(self.rig.armature.matrix_world) @ self.rest

    def sample(self, clip, frames):
        """(len(frames), B, 4, 4): where the bones are in the world at those frames of a clip, which may
        lie between whole ones."""
        data = self.rig.armature.animation_data
        data.use_nla = False
        for bone in self.rig.armature.pose.bones:
            bone.matrix_basis.identity()
        _assign(data, clip.action, clip.slot)
        found = []
        for frame in frames:
            whole = int(numpy.floor(frame))
            self.scene.frame_set(whole, subframe=float(frame - whole))
            found.append(self._matrices())
        return numpy.array(found)

    def _resting(self):
        """{mesh object: where it is relative to the armature when that rests}."""
        armature = self.rig.armature
        things = {each for thing in self.rig.meshes for each in (thing, *_parents(thing))}
        things -= {armature, *_parents(armature)}
        for thing in things:
            self.scene.collection.objects.link(thing)
        armature.data.pose_position = "REST"
        graph = self._graph()
        to_armature = numpy.linalg.inv(numpy.array(armature.evaluated_get(graph).matrix_world))
        found = {thing: to_armature @ numpy.array(thing.evaluated_get(graph).matrix_world) for thing in self.rig.meshes}
        armature.data.pose_position = "POSE"
        for thing in things:
            self.scene.collection.objects.unlink(thing)
        return found

    def skin(self):
        """The skin of all meshes; rigid things that hang on bones count, too."""
        index = {name: place for place, name in enumerate(self.names)}
        self.resting = self._resting()
        rests, bones, weights = [], [], []
        for thing in self.rig.meshes:
            count = len(thing.data.vertices)
            flat = numpy.empty(3 * count, numpy.float32)
            thing.data.vertices.foreach_get("co", flat)
            matrix = self.resting[thing]
            if is_skinned(thing, self.rig.armature):
                which, much = _weights_of(thing, index)
            else:
                which, much = numpy.zeros((count, 4), int), numpy.zeros((count, 4))
                bone = bone_above(thing, self.rig.armature)
                if bone in index:
                    which[:, 0], much[:, 0] = index[bone], 1.0
            rests.append(flat.reshape(-1, 3) @ matrix[:3, :3].T + matrix[:3, 3])
            bones.append(which)
            weights.append(much)
        skin = Skin(numpy.concatenate(rests), numpy.concatenate(bones), numpy.concatenate(weights))
        if skin.weights.sum() < 1e-6:
            raise CharacterError("no vertex follows a bone: meshes need an Armature modifier and vertex groups with "
                                 "the bones' names, or bones as parents")
        return skin


def _weights_of(thing, index):
    names = {group.index: index.get(group.name, -1) for group in thing.vertex_groups}
    which, much = numpy.zeros((len(thing.data.vertices), 4), int), numpy.zeros((len(thing.data.vertices), 4))
    for vertex in thing.data.vertices:
        known = sorted(((g.weight, names[g.group]) for g in vertex.groups if names.get(g.group, -1) >= 0),
                       reverse=True)[:4]
        for slot, (weight, bone) in enumerate(known):
            which[vertex.index, slot], much[vertex.index, slot] = bone, weight
    return which, much


def _assign(data, action, slot=None):
    data.action = action
    if action is not None and hasattr(data, "action_slot"):
        data.action_slot = slot or (data.action_suitable_slots[0] if data.action_suitable_slots else None)


def _parents(thing):
    while thing.parent:
        thing = thing.parent
        yield thing


def _parents_first(bones):
    ordered, queue = [], [bone for bone in bones if not bone.parent]
    while queue:
        bone = queue.pop(0)
        ordered.append(bone)
        queue.extend(bone.children)
    return ordered
