# SPDX-License-Identifier: Apache-2.0
"""Runs inside Blender: people close to the camera have meshes of more detail in final pictures. ADDON BAKE FOLDER"""
import json
import os
import sys

import bpy
import numpy

addon, bake, folder = sys.argv[-3:]
sys.path.insert(0, addon)
import throng  # noqa: E402
from throng.crowd import close, faces, own  # noqa: E402
from throng.crowd.names import INSTANCERS, NATURE  # noqa: E402
from throng.crowd.queries import cast_of, crowd_objects  # noqa: E402
from throng.people import casting  # noqa: E402
from throng.people.roster import Role  # noqa: E402

PEOPLE = (0, 1, 9)  # a man, a woman, a girl
FRAME = 20
casting.roles_for = lambda walkers, count: [Role(number) for number in PEOPLE]
bpy.ops.wm.read_factory_settings(use_empty=True)
throng.register()
scene, result = bpy.context.scene, {}
assert bpy.ops.import_scene.throng(filepath=os.path.join(bake, "bake.json"), scenery=False, walls=False, roads=False,
                                   relative=False, people=len(PEOPLE)) == {"FINISHED"}
crowd = crowd_objects(scene)[0]
cast, camera = cast_of(crowd), scene.camera
pos, state = (numpy.load(os.path.join(bake, "streams", f"{name}.npy")) for name in ("pos", "state"))


def shown(crowd, final):
    """{row: how many vertices they have} of those who are bent, as final pictures or the screen have them."""
    for name, is_final in zip(INSTANCERS, (True, False)):
        crowd.modifiers[name].show_viewport = is_final == final
    scene.frame_set(FRAME)
    mesh = crowd.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
    rows = numpy.empty(len(mesh.vertices), numpy.int32)
    mesh.attributes["throng_row"].data.foreach_get("value", rows)
    points = numpy.empty(3 * len(mesh.vertices), numpy.float32)
    mesh.vertices.foreach_get("co", points)
    result["attributes"] = sorted(each.name for each in mesh.attributes if each.name.startswith("throng"))
    return {int(row): points.reshape(-1, 3)[rows == row] for row in numpy.unique(rows)}


def box(points):
    return numpy.concatenate([points.min(axis=0), points.max(axis=0)])


counts = lambda: [len(each) for each in (bpy.data.objects, bpy.data.meshes, bpy.data.node_groups)]
camera.location, camera.rotation_euler = (0.0, -12.0, 1.6), (1.5, 0.0, 0.0)  # looks along +y
assert bpy.ops.throng.near(by="camera", reach=14.0, most=1000, whole=True) == {"FINISHED"}
scene.frame_set(FRAME)
without, coarse = counts(), shown(crowd, True)
away = {row: float(numpy.linalg.norm(pos[FRAME - 1, row] - numpy.array(camera.location))) for row in coarse}
sizes = sorted(away.values())
distance = 0.5 * (sizes[len(sizes) // 2] + sizes[len(sizes) // 2 + 1])
member = {row: own.member_of(crowd, row, int(state[FRAME - 1, row, 1]), False) for row in coarse}

# a still: who is close in this frame
assert bpy.ops.throng.close(by="camera", distance=distance, most=1000, frames="now") == {"FINISHED"}
result["members"] = [sorted(close.meshes_of(cast)), sorted({member[row] for row in coarse if away[row] < distance})]
fine = shown(crowd, True)
result["finer"] = [sorted(row for row in fine if len(fine[row]) > 2 * len(coarse[row])),
                   sorted(row for row in coarse if away[row] < distance)]
result["same people"] = max(float(numpy.abs(box(fine[row]) - box(coarse[row])).max()) for row in coarse)
result["on screen"] = {row: len(each) for row, each in shown(crowd, False).items()} == {
    row: len(each) for row, each in coarse.items()}
result["triangles"] = [len(thing.data.polygons) for thing in close.meshes_of(cast).values()]

# faces, after the last frame, where bodies go no further
def marks_of(mesh):
    """(a vertex that lids take along, one that mouths do, one of an eye, one of the skin between them that nothing
    does), by number."""
    moves = {name: numpy.empty(3 * len(mesh.vertices), numpy.float32) for name in (*faces.SPARE[2:],)}
    for name, values in moves.items():
        mesh.attributes[name].data.foreach_get("vector", values)
    moves = {name: values.reshape(-1, 3) for name, values in moves.items()}
    places = numpy.empty(3 * len(mesh.vertices), numpy.float32)
    mesh.vertices.foreach_get("co", places)
    places = places.reshape(-1, 3)
    most = [int(numpy.abs(moves[name]).max(axis=1).argmax()) for name in (faces.LIDS, faces.MOUTH)]
    pupil = int(moves[faces.EYE][:, 0].argmax())
    still = numpy.all([~moves[name].any(axis=1) for name in moves], axis=0)
    away = numpy.linalg.norm(places - places[most[0]], axis=1) + numpy.where(still, 0.0, 9.0)
    return (*most, pupil, int(away.argmin()))


def distances(scene, marks, frames):
    """{row: (frames, 3) how far lids, mouths and pupils are from what nothing moves}"""
    global FRAME
    found = {row: [] for row in marks}
    for FRAME in frames:
        everybody = shown(crowd, True)
        for row, (*moving, still) in marks.items():
            found[row].append([numpy.linalg.norm(everybody[row][each] - everybody[row][still]) for each in moving])
    return {row: numpy.array(each) for row, each in found.items()}


FRAME, at = len(pos), FRAME
finest = {number: thing.data for number, thing in close.meshes_of(cast).items()}
marks = {row: marks_of(finest[member[row]]) for row, points in shown(crowd, True).items()
         if member.get(row) in finest and len(points) == len(finest[member[row]].vertices)}
marks = dict(list(marks.items())[:6])
for each in crowd.data.attributes[NATURE].data:
    each.vector[0] = 2.0  # whoever gathers talks
seen = distances(scene, marks, range(len(pos), len(pos) + 120))
result["blinks"] = [int((numpy.diff((numpy.abs(each[:, 0] - numpy.median(each[:, 0])) > 0.003).astype(int)) > 0).sum())
                    for each in seen.values()]
result["eyes"] = [float(numpy.ptp(each[:, 2])) for each in seen.values()]
result["mouths"] = [float(numpy.ptp(each[:, 1])) for each in seen.values()]
result["gather"] = [bool(state[-1, row, 0] >= 2.0) for row in seen]
again = distances(scene, marks, [len(pos) + 77])
result["any frame first"] = max(float(numpy.abs(again[row][0] - seen[row][77]).max()) for row in seen)
FRAME = at

# fewer than there are: the nearest
assert bpy.ops.throng.close(by="camera", distance=distance, most=4, frames="now") == {"FINISHED"}
few = [row for row, each in shown(crowd, True).items() if len(each) > 2 * len(coarse[row])]
result["few"] = [len(few), max(away[row] for row in few), min(away[row] for row in coarse if row not in few)]

# from a saved file without the add-on
path, name, before = os.path.join(folder, "close.blend"), crowd.name, shown(crowd, True)
bpy.ops.wm.save_as_mainfile(filepath=path)
throng.unregister()
bpy.ops.wm.open_mainfile(filepath=path)
scene = bpy.context.scene
after = shown(bpy.data.objects[name], True)
result["saved"] = sorted(before) == sorted(after) and max(
    float(numpy.abs(before[row] - after[row]).max()) for row in before)
throng.register()
crowd = bpy.data.objects[name]
cast = cast_of(crowd)

# nobody; then one who comes close for a moment of the shot, and no one else ever
assert bpy.ops.throng.close(by="none") == {"FINISHED"}
result["none"] = [len(close.meshes_of(cast)), counts() == without]
mover = min(coarse, key=away.get)
scene.frame_start, scene.frame_end = 1, len(pos)
scene.camera.location = [float(value) for value in pos[FRAME - 1, mover] - numpy.array([0.0, 1.0, 0.0])]
frame = scene.frame_current
assert bpy.ops.throng.close(by="camera", distance=1.0, most=50, frames="shot") == {"FINISHED"}
result["shot"] = [member[mover], sorted(close.meshes_of(cast)), scene.frame_current == frame]
assert bpy.ops.throng.near(by="none") == {"FINISHED"}
result["near off"] = [len(close.meshes_of(cast)), close.MOST in crowd, cast["throng_levels"]]
scene.camera = None
try:
    bpy.ops.throng.close(by="camera")
except RuntimeError as error:
    result["no camera"] = str(error)
print("RESULT " + json.dumps(result))
