# SPDX-License-Identifier: Apache-2.0
"""Runs inside Blender: motion of one's own, on a small crowd of people shaped from bodies. ADDON BAKE WIDER FOLDER"""
import json
import os
import sys

import bpy
import numpy

addon, bake, wider, folder = sys.argv[-4:]
sys.path[:0] = [addon, os.path.dirname(os.path.abspath(__file__))]
import clip_walker  # noqa: E402
import throng  # noqa: E402
import walker  # noqa: E402
from clip_walker import Walker  # noqa: E402
from throng.cast import bones, library, sheets  # noqa: E402
from throng.crowd import own  # noqa: E402
from throng.crowd.queries import cast_of, crowd_objects, repertoire_of  # noqa: E402
from throng.motions import members as motions  # noqa: E402
from throng.overrides import hero  # noqa: E402
from throng.people import casting  # noqa: E402
from throng.people import members as people  # noqa: E402
from throng.people.roster import Role  # noqa: E402

if "bool" not in vars(numpy):
    numpy.bool = bool
MAN, GIRL, STICK = range(3)
FRAME = 20
casting.roles_for = lambda walkers, count: [Role(number) for number in (0, 9, 10)]
bpy.ops.wm.read_factory_settings(use_empty=True)
throng.register()
glb = os.path.join(folder, "three.glb")
armature = walker.make(heading=180.0)
walker.add_clip(armature, "Idle", frames=20)
walker.add_clip(armature, "walk_cycle", stride=1.2, offset=0.25)
walker.add_clip(armature, "Running_A", stride=2.4, stance=0.35, frames=18)
bpy.ops.export_scene.gltf(filepath=glb, export_format="GLB")
bpy.ops.wm.read_factory_settings(use_empty=True)
throng.unregister()
throng.register()
scene, result = bpy.context.scene, {"errors": {}}


def written(name, text):
    path = os.path.join(folder, name)
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)
    return path


def clip(name, scale=100.0, **options):
    return written(name, clip_walker.bvh(Walker(**options), scale))


assert bpy.ops.import_scene.throng(filepath=os.path.join(bake, "bake.json"), scenery=False, walls=False, roads=False,
                                   relative=False, people=3) == {"FINISHED"}
crowd = crowd_objects(scene)[0]
cast = cast_of(crowd)
camera = scene.camera
camera.location, camera.rotation_euler = (0.0, -12.0, 3.0), (1.35, 0.0, 0.0)
assert bpy.ops.throng.near(by="camera", reach=14.0, most=1000, whole=True) == {"FINISHED"}
repertoire = repertoire_of(crowd)
sheet_of = lambda member: sheets.sheet_of(library.figures_of(cast)[0, member])
all_bones = lambda: {member: bones.bones_of(sheet_of(member)) for member in range(3)}
same = lambda one, other: all(numpy.array_equal(one[member], other[member]) for member in one)
first = all_bones()
counts = lambda: {kind: len(getattr(bpy.data, kind)) for kind in
                  ("objects", "meshes", "materials", "actions", "armatures", "scenes", "collections", "node_groups")}


def said():
    return [line for _, lines in motions.said(cast) for line in lines]


def seen():
    """({row: vertices of who is bent}, {row: (member, vertices)} of who is picked a pose for)"""
    scene.frame_set(FRAME)
    graph = bpy.context.evaluated_depsgraph_get()
    mesh = crowd.evaluated_get(graph).data
    flat, rows = numpy.empty(3 * len(mesh.vertices), numpy.float32), numpy.empty(len(mesh.vertices), numpy.int32)
    mesh.vertices.foreach_get("co", flat)
    mesh.attributes["throng_row"].data.foreach_get("value", rows)
    near = {int(row): flat.reshape(-1, 3)[rows == row].astype(float) for row in numpy.unique(rows)}
    far = {}
    for each in graph.object_instances:
        if each.is_instance and each.parent and each.parent.original == crowd:
            flat = numpy.empty(3 * len(each.object.data.vertices), numpy.float32)
            each.object.data.vertices.foreach_get("co", flat)
            far[each.persistent_id[1]] = flat.reshape(-1, 3).copy()
    return near, far


def member_of(row):
    return own.member_of(crowd, row, int(state[FRAME - 1, row, 1]), False)


state, way = (numpy.load(os.path.join(bake, "streams", f"{name}.npy")) for name in ("state", "dir"))
plain = seen()


def refused(label, call, **arguments):
    """The error's words; nothing may have changed."""
    before, poses = counts(), all_bones()
    try:
        call(**arguments)
        result["errors"][label] = "no error"
    except RuntimeError as error:
        result["errors"][label] = str(error)
    assert counts() == before and same(poses, all_bones()) and not said(), (label, before, counts())


add, walk = bpy.ops.throng.add_motion, clip("walk.bvh")
text = open(walk, encoding="utf-8").read()
refused("cut", add, filepath=written("cut.bvh", text[:len(text) * 2 // 3]))
head, frames = text.split("Frame Time: 0.0333333\n")
refused("nan", add, filepath=written("nan.bvh", f"{head}Frame Time: 0.0333333\nnan {frames.split(' ', 1)[1]}"))
refused("still", add, filepath=clip("still.bvh", stands=True, swing=0.0), role="WALK")
refused("backwards", add, filepath=clip("backwards.bvh", backwards=True))
refused("no stand", add, filepath=walk, role="IDLE")
refused("words", add, filepath=written("words.txt", "no motion"))
refused("words in glb", add, filepath=written("words.glb", "no motion"))
refused("absent", add, filepath=os.path.join(folder, "absent.bvh"))
refused("no clip", add, filepath=glb, clip="Dance")
refused("no member", add, filepath=walk, members="1, 7")
refused("no number", add, filepath=walk, members="everybody")
refused("stick", add, filepath=walk, members=str(STICK))
refused("no armature", bpy.ops.throng.add_armature_motion)
refused("nothing to remove", bpy.ops.throng.remove_motion)


def slides(member, gait):
    """m that what is on the ground goes there in a step of a gait, of the figure's own vertices."""
    points = sheets.points_of(library.figures_of(cast)[0, member])[24 * gait:24 * gait + 24].astype(float)
    stride, worst = repertoire.strides[gait], 0.0
    for left in (False, True):
        feet = points[:, (points[0, :, 2] < 0.5) & ((points[:, :, 1].mean(axis=0) > 0.0) == left)]
        slid, held = 0.0, 0
        for pose in range(24):
            now, then = feet[pose], feet[(pose + 1) % 24] + numpy.array([stride / 24.0, 0.0, 0.0])
            touching = (now[:, 2] < 0.004) & (then[:, 2] < 0.004)
            if touching.any():
                slid, held = slid + float(numpy.linalg.norm((then - now)[touching, :2], axis=1).min()), held + 1
        assert held > 6, held
        worst = max(worst, slid)
    return [worst, float(points[..., 2].min())]


def swings(member, gait):
    """(least, most) degrees of the right upper arm, by the sheet's bones."""
    role = people.role_of(cast, member)
    rig = people.maker_of(role).rig
    bone = people.leading(role, repertoire).tolist().index(rig.bodies.bone["upperarm_r"])
    turned = bones.bones_of(sheet_of(member))[24 * gait:24 * gait + 24, bone, :, :3]
    ahead = turned @ (rig.heads["lowerarm_r"] - rig.heads["upperarm_r"])
    angles = numpy.degrees(numpy.arctan2(ahead[:, 0], -ahead[:, 2]))
    return [float(angles.min()), float(angles.max())]


# one clip, from rest poses of two kinds: both give the same poses
before = counts()
assert add(filepath=walk) == {"FINISHED"}
result["left"] = counts() == before
result["report"] = said()
moved = all_bones()
taken = repertoire.strides.index(1.4)
changed = lambda one, other: sorted({int(pose) // 24 for pose in numpy.nonzero(
    numpy.abs(one - other).max(axis=(1, 2, 3)) > 1e-6)[0]})
result["changed"] = [changed(moved[member], first[member]) for member in range(3)]
result["slides"] = [slides(member, taken) for member in (MAN, GIRL)]
result["swings"] = [swings(member, taken) for member in (MAN, GIRL)]
shown = seen()
assert add(filepath=clip("walk.bvh", rest="down", scale=1.0)) == {"FINISHED"}
other = all_bones()
result["rests"] = [len(motions.said(cast)),
                   max(float(numpy.abs(moved[member] - other[member]).max()) for member in moved)]


def differs(one, other, rows):
    return [float(numpy.abs(one[row] - other[row]).max()) for row in rows if row in one and row in other]


def goes_so(row):
    """Whether a row is of somebody who walks with the gait that the clip was taken for, and not with a stick."""
    activity, _, _ = state[FRAME - 1, row]
    return way[FRAME - 1, row, 2] > 0.5 and round(float(activity) % 1.0 * 16.0) == repertoire.first + taken \
        and member_of(row) != STICK


rows = range(len(state[0]))
result["near"] = [differs(plain[0], shown[0], [row for row in rows if goes_so(row)]),
                  differs(plain[0], shown[0], [row for row in rows if not goes_so(row)])]
result["far"] = [differs(plain[1], shown[1], [row for row in rows if goes_so(row)]),
                 differs(plain[1], shown[1], [row for row in rows if not goes_so(row)])]

# it lasts: a bake of other gaits, levels of detail, a saved file without the add-on
assert bpy.ops.throng.relink(filepath=os.path.join(wider, "bake.json")) == {"FINISHED"}
wide = repertoire_of(crowd)
again = all_bones()[MAN]
place = 24 * wide.strides.index(1.4)
result["widened"] = [len(wide.strides), len(repertoire.strides),
                     float(numpy.abs(again[place:place + 24] - moved[MAN][24 * taken:24 * taken + 24]).max())]
assert bpy.ops.throng.relink(filepath=os.path.join(bake, "bake.json")) == {"FINISHED"}
repertoire, taken = wide, wide.strides.index(1.4)
shown = seen()
path = os.path.join(folder, "motions.blend")
bpy.ops.wm.save_as_mainfile(filepath=path)
names = crowd.name
throng.unregister()
bpy.ops.wm.open_mainfile(filepath=path)
scene, crowd = bpy.context.scene, bpy.data.objects[names]
result["saved"] = [max(differs(one, other, rows)) for one, other in zip(shown, seen())]
throng.register()
cast = cast_of(crowd)

# a hero walks as he does in the crowd
assert bpy.ops.throng.near(by="camera", reach=100.0, most=1000, whole=True) == {"FINISHED"}
shown = seen()
row = next(row for row in rows if goes_so(row) and member_of(row) == MAN and row in shown[0])
assert bpy.ops.throng.promote_person(rows=str(row), hero="Ben") == {"FINISHED"}
scene.frame_set(FRAME)
ben = hero.heroes_of(crowd)["Ben"]
body = next(child for child in ben.children if child.type == "MESH")
worn = body.evaluated_get(bpy.context.evaluated_depsgraph_get())
flat = numpy.empty(3 * len(worn.data.vertices), numpy.float32)
worn.data.vertices.foreach_get("co", flat)
spots = flat.reshape(-1, 3) @ numpy.array(worn.matrix_world)[:3, :3].T + numpy.array(worn.matrix_world)[:3, 3]
ends = lambda points: numpy.concatenate([points.min(axis=0), points.max(axis=0)])
result["hero"] = float(numpy.abs(ends(spots) - ends(shown[0][row])).max())
bpy.ops.throng.clear_people(rows=str(row))

# a glTF file of three clips, for the girl alone; only its walk, from the armature itself
assert add(filepath=glb, members=str(GIRL)) == {"FINISHED"}
result["gltf"] = [name for name, _ in motions.said(cast)], said()
mine = all_bones()
result["hers"] = [bool(numpy.array_equal(mine[MAN], again)), slides(GIRL, taken)]
result["stands"] = len(changed(mine[GIRL][repertoire.walking():], all_bones()[MAN][repertoire.walking():]))
actor = walker.make(heading=90.0, name="Actor", scale=2.5)
action = walker.add_clip(actor, "Clip.001", stride=1.3, heading=90.0, offset=0.6, closed=False)
actor.animation_data.action = action
bpy.context.view_layer.objects.active = actor
place = tuple(actor.location), actor.animation_data.action
assert bpy.ops.throng.add_armature_motion(members="0", every=True) == {"FINISHED"}
result["armature"] = said()[-8:]
result["armature stays"] = place == (tuple(actor.location), actor.animation_data.action)
result["every"] = changed(all_bones()[MAN], mine[MAN])
bpy.data.objects.remove(actor)

# taken away one by one
assert bpy.ops.throng.remove_motion(motion="Actor") == {"FINISHED"}
result["one removed"] = float(numpy.abs(all_bones()[MAN] - mine[MAN]).max())
assert bpy.ops.throng.remove_motion(members=str(GIRL)) == {"FINISHED"}
result["hers removed"] = [name for name, _ in motions.said(cast)]
assert bpy.ops.throng.remove_motion() == {"FINISHED"}
assert bpy.ops.throng.levels(by="none") == {"FINISHED"}
result["removed"] = [said(), motions.MOTIONS in cast]
assert bpy.ops.throng.relink(filepath=os.path.join(bake, "bake.json")) == {"FINISHED"}
last = all_bones()
place = wide.strides.index(repertoire_of(crowd).strides[0])
result["as before"] = max(float(numpy.abs(
    last[member][24 * taken:24 * taken + 24] - first[member][first_taken:first_taken + 24]).max())
    for first_taken in [24 * (taken - 1)] for member in range(3))

# people without bodies
bpy.ops.wm.read_factory_settings(use_empty=True)
del os.environ["THRONG_BODIES"]
assert bpy.ops.import_scene.throng(filepath=os.path.join(bake, "bake.json"), scenery=False, walls=False, roads=False,
                                   relative=False) == {"FINISHED"}
try:
    add(filepath=walk)
except RuntimeError as error:
    result["lofted"] = str(error)
print("RESULT " + json.dumps(result))
