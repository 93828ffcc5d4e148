# SPDX-License-Identifier: Apache-2.0
"""Heroes: single people outside the crowd, as armatures with keys, who walk as they did in it, for
an animator to change."""
import math
from dataclasses import replace

import bpy
import numpy
from mathutils import Matrix, Vector

from .. import cast
from ..cast import gait, library, people, sitting
from ..cast.bones import bones_of
from ..cast.materials import cast_materials
from ..cast.sheets import sheet_of
from ..characters import legs
from ..crowd import own
from ..crowd.footing import HIGH, REACH
from ..crowd.names import NATURE
from ..crowd.poses import FRAMES_A_ROUND, STANDING_SPEED
from ..crowd.queries import repertoire_of, terrain_of
from ..formats import BakeError
from ..motions.members import moves
from ..people import figures, members
from ..people.library import LibraryError
from ..people.materials import material_of
from ..people.puppet import Puppet
from . import skeleton
from .dyes import linear

_SHAPE_KEYS = {"Blink": "lids", "Mouth": "mouth", "Smile": "smile"}
HERO, HERO_OF, HERO_ROW = "throng_hero", "throng_hero_of", "throng_hero_row"


def heroes_of(crowd):
    """The armatures of a crowd's heroes by name."""
    return {thing[HERO]: thing for thing in bpy.data.objects
            if thing.get(HERO_OF) == crowd and thing.type == "ARMATURE"}


def _matrix(bone):
    return Matrix([(*row, place) for row, place in zip(zip(bone.left, bone.along, bone.ahead), bone.head)]
                  + [(0.0, 0.0, 0.0, 1.0)])


class _Curves:
    """The keys of one object: actions have slots from Blender 4.4, and no curves of their own from 5.0."""

    def __init__(self, thing, name):
        self.action = bpy.data.actions.new(name)
        data = thing.animation_data_create()
        data.action = self.action
        if hasattr(self.action, "slots"):
            slot = self.action.slots.new(id_type="OBJECT", name=thing.name)
            strip = self.action.layers.new("Layer").strips.new(type="KEYFRAME")
            self.curves = strip.channelbag(slot, ensure=True).fcurves
            data.action_slot = slot
        else:
            self.curves = self.action.fcurves

    def add(self, path, index, frames, values, stepped=False):
        curve = self.curves.new(path, index=index)
        curve.keyframe_points.add(len(frames))
        curve.keyframe_points.foreach_set("co", [v for pair in zip(frames, values) for v in pair])
        kinds = bpy.types.Keyframe.bl_rna.properties["interpolation"].enum_items
        curve.keyframe_points.foreach_set("interpolation",
                                          [kinds["CONSTANT" if stepped else "LINEAR"].value] * len(frames))
        curve.update()


def _bones_at(who, sample, frame, strides, nature):
    """As the instancer picks poses, but at the phase itself instead of the nearest of its steps."""
    activity, _, phase = sample.state
    if activity > sitting.FIRST - 0.5:
        return who.seated(*sitting.place_at(activity, phase))
    if sample.direction[2] > STANDING_SPEED:
        return who.walking(min(len(strides) - 1, round((activity % 1.0) * 16.0)), strides, phase % 1.0)
    clip = int(nature[0] % (4 if int(activity) == 2 else 2))
    return who.standing(clip, (nature[1] + frame / FRAMES_A_ROUND) % 1.0)


class _ByGaits:
    """Somebody who moves as the cast's gaits have it."""

    def walking(self, index, strides, phase):
        return self.bones(gait.walk_pose(phase, self.build, gait.gait_of(strides[index])))

    def standing(self, clip, beat):
        return self.bones(gait.standing_pose(gait.STANDING_CLIPS[clip], beat, self.build))

    def seated(self, clip, share):
        return self.bones(sitting.seated_pose(clip, share, self.build))


class Lofted(_ByGaits):
    """A person of cast/people.py as a hero."""

    def __init__(self, person, materials):
        self.person, self.materials, self.build = person, materials, people.build_of(person)
        self.rest = skeleton.rest_pose(person)

    def bones(self, pose):
        return skeleton.bones_of(self.person, pose)

    def body(self, strides):
        """(vertices, faces, the material of each, [(bone, weight)] of each vertex)"""
        plan = skeleton.plan_of(self.person)
        return (skeleton.vertices_of(self.person, self.rest), plan.faces, plan.materials,
                skeleton.weights_of(self.person, strides))

    def finish(self, body):
        """What else its mesh has. @param body the object"""


class Shaped(_ByGaits):
    """A member of a cast that is shaped from bodies as a hero, in full detail."""

    def __init__(self, role):
        self.role, self.puppet = role, Puppet(role)
        self.materials = [material_of(kind, self.puppet.look, members.bodies()) for kind in self.puppet.model.materials]
        self.build, self.rest = self.puppet.build, self.puppet.rest

    def bones(self, pose):
        return self.puppet.bones(pose, skeleton.bone_between)

    def body(self, _strides):
        model, weights = self.puppet.model, self.puppet.weights(skeleton.BONES)
        blends = [[(skeleton.BONES[bone], float(row[bone])) for bone in row.nonzero()[0]] for row in weights]
        return self.puppet.vertices().tolist(), model.faces.tolist(), model.material_of.tolist(), blends

    def finish(self, body):
        model = self.puppet.model
        figures.add_pattern(body.data, model)
        body.shape_key_add(name="Basis", from_mix=False)
        for name, expression in _SHAPE_KEYS.items():
            key = body.shape_key_add(name=name, from_mix=False)
            places = numpy.ascontiguousarray(self.puppet.vertices(model.moves[expression]), numpy.float32)
            key.data.foreach_set("co", places.ravel())


class Moved(Shaped):
    """One of them who moves as a clip does that was brought along (motions): as its sheet has it."""

    def __init__(self, role, figure, repertoire):
        super().__init__(role)
        self.repertoire, self.poses = repertoire, bones_of(sheet_of(figure))

    def walking(self, index, strides, phase):
        number = min(max(index - self.repertoire.first, 0), len(self.repertoire.strides) - 1)
        return self._between(number * cast.POSES, cast.POSES, phase)

    def standing(self, clip, beat):
        return self._between(self.repertoire.walking() + clip * cast.BEATS, cast.BEATS, beat)

    def _between(self, first, count, share):
        """Bones between the two poses of a round that are nearest."""
        pose, rest = int(share * count) % count, share * count % 1.0
        led = (1.0 - rest) * self.poses[first + pose] + rest * self.poses[first + (pose + 1) % count]
        led[:, :, :3] = legs.rotation_part(led)[0]
        return self.puppet.bones_at(members.of_all_bones(self.role, self.repertoire, led), skeleton.bone_between)


def _build_armature(name, who, collection):
    armature = bpy.data.armatures.new(name)
    thing = bpy.data.objects.new(name, armature)
    collection.objects.link(thing)
    rest = who.bones(who.rest)
    layer = bpy.context.view_layer
    active, selected = layer.objects.active, list(bpy.context.selected_objects)
    layer.objects.active = thing
    bpy.ops.object.mode_set(mode="EDIT")
    for bone_name in skeleton.BONES:
        bone, edit = rest[bone_name], armature.edit_bones.new(bone_name)
        edit.head, edit.tail = bone.head, bone.tail
        edit.align_roll(bone.ahead)
        if skeleton.PARENTS[bone_name]:
            edit.parent = armature.edit_bones[skeleton.PARENTS[bone_name]]
    bpy.ops.object.mode_set(mode="OBJECT")
    layer.objects.active = active
    for each in selected:
        each.select_set(True)
    for bone in thing.pose.bones:
        bone.rotation_mode = "QUATERNION"
    return thing


def _build_body(name, who, strides, armature, collection):
    vertices, faces, material_of_faces, weights = who.body(strides)
    mesh = bpy.data.meshes.new(f"{name} body")
    mesh.from_pydata(vertices, [], faces)
    for material in who.materials:
        mesh.materials.append(material)
    mesh.polygons.foreach_set("use_smooth", [True] * len(faces))
    mesh.polygons.foreach_set("material_index", material_of_faces)
    mesh.update()
    body = bpy.data.objects.new(mesh.name, mesh)
    collection.objects.link(body)
    who.finish(body)
    groups = {bone: body.vertex_groups.new(name=bone) for bone in skeleton.BONES}
    for index, blend in enumerate(weights):
        for bone, weight in blend:
            groups[bone].add([index], weight, "REPLACE")
    body.parent = armature
    body.modifiers.new("Armature", "ARMATURE").object = armature
    return body


def shipped_person(crowd, variation):
    """Whom of the shipped cast a variation shows as; None where somebody brought it along."""
    shown = crowd["throng_cast"]
    figure = library.figures_of(shown).get((0, variation % shown["throng_variations"]))
    if figure is None or "throng_person" not in figure:
        return None
    if shown.get("throng_bodies"):
        member = figure["throng_person"]
        role = members.role_of(shown, member)
        return Moved(role, figure, repertoire_of(crowd)) if moves(shown, member) else Shaped(role)
    return Lofted(people.CAST[figure["throng_person"]], list(figure.data.materials))


def _dress(crowd, body, row, change):
    """The crowd's own materials find the colours on the object when it is not an instance."""
    body["tint"] = list(crowd.data.attributes["tint"].data[row].vector)
    if isinstance(change.tint, str):
        body["throng_dyed"], body["throng_dye"] = 1.0, list(linear(change.tint))


def _on_terrain(crowd, samples, over):
    """Who is moved or comes at another time stands on the scene's terrain anew, as native.py has it for the crowd."""
    terrain = terrain_of(crowd)
    if not terrain:
        return samples
    to_terrain = terrain.matrix_world.inverted() @ crowd.matrix_world

    def height(x, y, z):
        hit, place, _, _ = terrain.ray_cast(to_terrain @ Vector((x, y, z + HIGH)),
                                            to_terrain.to_3x3() @ Vector((0.0, 0.0, -1.0)))
        return (to_terrain.inverted() @ place).z if hit else None

    result = []
    for sample in samples:
        (x, y, z), (cosine, sine, _) = sample.position, sample.direction
        middle, ahead, behind = (height(x + reach * cosine, y + reach * sine, z) for reach in (0.0, REACH, -REACH))
        if middle is not None:
            z = 0.5 * middle + 0.25 * sum(middle if other is None else other for other in (ahead, behind)) + over
        result.append(replace(sample, position=(x, y, z)))
    return result


def _key_root(curves, frames, samples):
    for axis in range(3):
        curves.add("location", axis, frames, [sample.position[axis] for sample in samples])
    headings, last = [], None
    for sample in samples:
        heading = math.atan2(sample.direction[1], sample.direction[0])
        last = heading if last is None else last + math.remainder(heading - last, 2.0 * math.pi)
        headings.append(last)
    curves.add("rotation_euler", 2, frames, headings)


def _key_bones(curves, armature, frames, skeletons):
    rest = {bone.name: bone.matrix_local.copy() for bone in armature.data.bones}
    for name, parent in skeleton.PARENTS.items():
        offset = (rest[parent].inverted() @ rest[name] if parent else rest[name]).inverted()
        places, turns, last = [], [], None
        for bones in skeletons:
            pose = _matrix(bones[name])
            basis = offset @ (_matrix(bones[parent]).inverted() @ pose if parent else pose)
            turn = basis.to_quaternion()
            if last and last.dot(turn) < 0.0:
                turn.negate()
            places.append(basis.to_translation())
            turns.append(turn)
            last = turn
        path = f'pose.bones["{name}"]'
        for axis in range(4):
            curves.add(f"{path}.rotation_quaternion", axis, frames, [turn[axis] for turn in turns])
        if max(place.length for place in places) > 1e-3:  # hips, and what stretches a little
            for axis in range(3):
                curves.add(f"{path}.location", axis, frames, [place[axis] for place in places])


def _key_presence(thing, name, frames, alive):
    """Not there before it enters and after it has left."""
    if all(alive):
        return
    curves = _Curves(thing, name)
    changes = [i for i in range(len(frames)) if i == 0 or alive[i] != alive[i - 1]]
    for path in ("hide_viewport", "hide_render"):
        curves.add(path, 0, [frames[i] for i in changes], [float(not alive[i]) for i in changes], stepped=True)


def promote(crowd, bake, rows, people_of_bake, row, change):
    """Makes somebody a hero; `change` is its override. The crowd's instance is not hidden. Returns the armature."""
    collection = crowd.users_collection[0] if crowd.users_collection else bpy.context.scene.collection
    first = people_of_bake[row].frame
    start = crowd.modifiers["throng pos"].frame_start
    samples = [rows.changed(row, first, change, frame, hides=False) for frame in range(rows.frames)]
    if change.moves or change.retimes:
        samples = _on_terrain(crowd, samples, change.move[2])
    frames = [start + frame for frame in range(rows.frames)]
    alive = [sample.state[0] > 0.5 for sample in samples]
    variation = own.member_of(crowd, row, int(samples[0].state[1]), change.character is not None)
    try:
        who = shipped_person(crowd, variation)
    except LibraryError as error:
        raise BakeError(str(error)) from error
    who = who or Lofted(people.CAST[variation % cast.VARIATIONS], cast_materials(people.MATERIALS))
    strides = tuple(crowd.get("throng_strides", bake.strides))
    nature = crowd.data.attributes[NATURE].data[row].vector

    armature = _build_armature(change.hero, who, collection)
    armature[HERO], armature[HERO_OF], armature[HERO_ROW] = change.hero, crowd, row
    body = _build_body(change.hero, who, strides, armature, collection)
    body[HERO_OF] = crowd
    _dress(crowd, body, row, change)
    armature.parent = crowd
    armature.rotation_mode = "XYZ"
    armature.scale = [change.scale or 1.0] * 3
    curves = _Curves(armature, f"{change.hero} walk")
    _key_root(curves, frames, samples)
    shown = [i for i in range(len(frames)) if alive[i]] or [0]
    span = range(shown[0], shown[-1] + 1)
    skeletons = [_bones_at(who, samples[i], frames[i], strides, nature) for i in span]
    _key_bones(curves, armature, [frames[i] for i in span], skeletons)
    _key_presence(body, f"{change.hero} presence", frames, alive)
    return armature


def demote(crowd, name):
    """Removes a hero and all that was made for it."""
    armature = heroes_of(crowd).get(name)
    if not armature:
        return
    bodies = [thing for thing in bpy.data.objects if thing.parent == armature and thing.get(HERO_OF) == crowd]
    for thing in (*bodies, armature):
        data, action = thing.data, thing.animation_data.action if thing.animation_data else None
        bpy.data.objects.remove(thing)
        if action and action.users == 0:
            bpy.data.actions.remove(action)
        if data.users == 0:
            (bpy.data.armatures if isinstance(data, bpy.types.Armature) else bpy.data.meshes).remove(data)
