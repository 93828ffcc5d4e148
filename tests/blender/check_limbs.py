# SPDX-License-Identifier: Apache-2.0
"""Runs inside Blender: near people with feet held where the bake says, trunks that turn, heads that look. ADDON BAKE
"""
import json
import os
import shutil
import sys

import bpy
import numpy

addon, bake = sys.argv[-2:]
sys.path[:0] = [addon, os.path.dirname(os.path.abspath(__file__))]
import throng  # noqa: E402
from throng.cast import bones, library, sheets  # noqa: E402
from throng.crowd import own  # noqa: E402
from throng.crowd.queries import cast_of, crowd_objects  # noqa: E402
from throng.crowd.verify import verify  # noqa: E402
from throng.people import casting  # noqa: E402
from throng.people.roster import Role  # noqa: E402
from throng.tools import update  # noqa: E402

casting.roles_for = lambda walkers, count: [Role(0), Role(1)]
throng.register()
way, state = (numpy.load(os.path.join(bake, "streams", f"{name}.npy")) for name in ("dir", "state"))
FRAME = 20
result = {}


def crowd_of(folder):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    assert bpy.ops.import_scene.throng(filepath=os.path.join(folder, "bake.json"), scenery=False, walls=False,
                                       roads=False, relative=False, people=2) == {"FINISHED"}
    camera = bpy.context.scene.camera
    camera.location, camera.rotation_euler = (0.0, -12.0, 3.0), (1.35, 0.0, 0.0)
    assert bpy.ops.throng.near(by="camera", reach=40.0, most=1000, whole=True) == {"FINISHED"}
    return crowd_objects(bpy.context.scene)[0]


def bent(crowd):
    """{row: (V, 3)}"""
    bpy.context.scene.frame_set(FRAME)
    mesh = crowd.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
    flat, rows = numpy.empty(3 * len(mesh.vertices), numpy.float32), numpy.empty(len(mesh.vertices), numpy.int32)
    mesh.vertices.foreach_get("co", flat)
    mesh.attributes["throng_row"].data.foreach_get("value", rows)
    return {int(row): flat.reshape(-1, 3)[rows == row].astype(float) for row in numpy.unique(rows)}


def whole_bones(crowd, row):
    """(V,): the bone that a vertex hangs on alone, or -1; the limbs' bones; and how much bones are of the trunk."""
    figure = library.figures_of(cast_of(crowd))[0, own.member_of(crowd, row, int(state[FRAME - 1, row, 1]), False)]
    hangs = numpy.empty(4 * len(figure.data.vertices), numpy.float32)
    figure.data.attributes[bones.HANGS].data.foreach_get("color", hangs)
    hangs = hangs.reshape(-1, 4)
    alone = (hangs[:, 1:] % 1.0).max(axis=1) == 0.0
    return numpy.where(alone, hangs[:, 0].astype(int), -1), \
        numpy.array(sheets.sheet_of(figure)[bones.LIMBS]), numpy.array(sheets.sheet_of(figure)[bones.TRUNK])


def turned(before, after):
    """(the angle in the plane by which points have turned best, how far they are from it)"""
    one, other = before - before.mean(axis=0), after - after.mean(axis=0)
    angle = numpy.arctan2((one[:, 0] * other[:, 1] - one[:, 1] * other[:, 0]).sum(), (one[:, :2] * other[:, :2]).sum())
    cosine, sine = numpy.cos(angle), numpy.sin(angle)
    back = numpy.stack([cosine * one[:, 0] - sine * one[:, 1], sine * one[:, 0] + cosine * one[:, 1], one[:, 2]], 1)
    return float(angle), float(numpy.abs(back - other).max())


def rotation(before, after, heading):
    """(about the way ahead, the left, and up, rad; how far points are from it) of what has turned (Kabsch 1976)."""
    one, other = before - before.mean(axis=0), after - after.mean(axis=0)
    left, _, right = numpy.linalg.svd(one.T @ other)
    turn = (left @ numpy.diag([1.0, 1.0, numpy.sign(numpy.linalg.det(left @ right))]) @ right).T
    axis = numpy.array([turn[2, 1] - turn[1, 2], turn[0, 2] - turn[2, 0], turn[1, 0] - turn[0, 1]])
    sine = max(float(numpy.linalg.norm(axis)) / 2.0, 1e-12)
    axis *= numpy.arctan2(sine, (numpy.trace(turn) - 1.0) / 2.0) / (2.0 * sine)
    cosine, sine, _ = heading
    return [float(cosine * axis[0] + sine * axis[1]), float(cosine * axis[1] - sine * axis[0]), float(axis[2])], \
        float(numpy.abs(one @ turn.T - other).max())


def stretched(before, after):
    """How much the distances between points have changed at most."""
    far = lambda points: numpy.linalg.norm(points[:, None] - points[None], axis=2)
    return float(numpy.abs(far(before) - far(after)).max())


plain = f"{bake}-plain"
shutil.copytree(bake, plain)
with open(os.path.join(plain, "bake.json")) as file:
    manifest = json.load(file)
for stream in ("left_foot", "right_foot", "carriage", "gaze"):
    del manifest["streams"][stream]
with open(os.path.join(plain, "bake.json"), "w") as file:
    json.dump(manifest, file)
crowd = crowd_of(plain)
result["caches without"] = sorted(each.name for each in crowd.modifiers if each.type == "MESH_CACHE")
without = bent(crowd)
crowd = crowd_of(bake)
result["caches"] = sorted(each.name for each in crowd.modifiers if each.type == "MESH_CACHE")
held = bent(crowd)
result["same people"] = sorted(held) == sorted(without)
result["rows"] = {}
for row in held:
    before, after = without[row], held[row]
    bone, limbs, shares = whole_bones(crowd, row)
    chains, (neck, head) = limbs[:8].reshape(2, 4), limbs[8:]
    cosine, sine, _ = way[FRAME - 1, row]
    found = {"highest": float((after - before)[before[:, 2].argmax(), 2])}
    for side, name in enumerate(("left", "right")):
        foot, calf, thigh = (bone == chains[side][part] for part in (2, 1, 0))
        shift = after[foot] - before[foot]
        move = shift.mean(axis=0)
        found[name] = {"move": [float(cosine * move[0] + sine * move[1]), float(cosine * move[1] - sine * move[0]),
                                float(move[2])],
                       "apart": float(numpy.abs(shift - move).max()), "turned": turned(before[foot], after[foot]),
                       "stretched": max(stretched(before[part][:60], after[part][:60])
                                        for part in (calf, thigh) if part.sum() > 3)}
    above = (bone >= 0) & (shares[bone] == 1.0) & (bone != head) & (bone != neck)
    found["shoulders"] = rotation(before[above], after[above], way[FRAME - 1, row])
    legs = numpy.isin(bone, limbs[:8])
    found["legs"] = float(numpy.abs(after[legs] - before[legs]).max())
    ahead = lambda side: float((after[bone == chains[side][2]].mean(axis=0)
                                - after[bone == chains[1 - side][2]].mean(axis=0)) @ (cosine, sine, 0.0))
    found["stride"] = abs(ahead(0))
    head, neck = bone == head, bone == neck
    forward = (after[head] - after[head].mean(axis=0)) @ (cosine, sine, 0.0)
    before_it = (before[head] - before[head].mean(axis=0)) @ (cosine, sine, 0.0)
    ahead = before_it.argmax()  # the nose, or a hat's brim
    found["head"] = {"turned": turned(before[head], after[head]),
                     "rotation": rotation(before[head], after[head], way[FRAME - 1, row])[0],
                     "stretched": stretched(before[head][:90], after[head][:90]),
                     "up": float((after[head] - after[head].mean(axis=0))[ahead, 2]
                                 - (before[head] - before[head].mean(axis=0))[ahead, 2]),
                     "ahead": float(forward[ahead]),
                     "neck": turned(before[neck], after[neck])[0] if neck.sum() > 3 else None}
    result["rows"][row] = found

# baked again without them, and again with them
same = lambda one, other: max(float(numpy.abs(one[row] - other[row]).max()) for row in one)
trees = len(bpy.data.node_groups)
update.reload(crowd, bpy.context.scene, os.path.join(plain, "bake.json"))
result["without"] = [sorted(each.name for each in crowd.modifiers if each.type == "MESH_CACHE"),
                     same(bent(crowd), without)]
crowd.modifiers["throng pos"].filepath = os.path.join(bake, "streams", "pos.pc2")
result["told"] = [problem for problem in verify(crowd, bpy.context.scene) if "feet" in problem]
update.reload(crowd, bpy.context.scene, os.path.join(bake, "bake.json"))
problems = [problem for problem in verify(crowd, bpy.context.scene) if "is not in the list" not in problem]
result["with"] = [same(bent(crowd), held), problems, len(bpy.data.node_groups) - trees]

# and where it tells how heads turn on their chests, which counts before what it tells of gazes
for folder, name in ((f"{bake}-turned", "attention"), (f"{bake}-straight", "no_attention")):
    shutil.copytree(bake, folder)
    with open(os.path.join(folder, "bake.json")) as file:
        manifest = json.load(file)
    manifest["streams"]["attention"] = {form: f"streams/{name}.{form}" for form in ("npy", "pc2")}
    with open(os.path.join(folder, "bake.json"), "w") as file:
        json.dump(manifest, file)
    update.reload(crowd, bpy.context.scene, os.path.join(folder, "bake.json"))
    result[name] = [sorted(each.name for each in crowd.modifiers if each.type == "MESH_CACHE"),
                    {row: float(numpy.abs(points - held[row]).max()) for row, points in bent(crowd).items()}]
print("RESULT " + json.dumps(result))
