# SPDX-License-Identifier: Apache-2.0
"""Runs inside Blender: people near the camera, who are bent into the pose of the moment. ADDON BAKE FOLDER"""
import json
import os
import sys

import bpy
import numpy

addon, bake, folder = sys.argv[-3:]
sys.path[:0] = [addon, os.path.dirname(os.path.abspath(__file__))]
import throng  # noqa: E402
from asking import refused  # noqa: E402
from throng.cast import library, sheets  # noqa: E402
from throng.crowd import own, poses  # noqa: E402
from throng.crowd.names import INSTANCERS  # noqa: E402
from throng.crowd.queries import cast_of, crowd_objects, repertoire_of  # noqa: E402
from throng.people import casting  # noqa: E402
from throng.people.roster import Role  # noqa: E402

PEOPLE = (0, 1, 9)  # a man, a woman, a girl
FRAME, FPS = 20, 24.0
casting.roles_for = lambda walkers, count: [Role(number) for number in PEOPLE]
bpy.ops.wm.read_factory_settings(use_empty=True)
throng.register()
scene, result = bpy.context.scene, {}
pos, way, state = (numpy.load(os.path.join(bake, "streams", f"{name}.npy")) for name in ("pos", "dir", "state"))


def load(**options):
    return bpy.ops.import_scene.throng(filepath=os.path.join(bake, "bake.json"), scenery=False, walls=False,
                                       roads=False, relative=False, people=len(PEOPLE), **options)


def bent(crowd, frame=FRAME, values="position"):
    """{row: (V, 3)} of those who are bent."""
    scene.frame_set(frame)
    mesh = crowd.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
    count = len(mesh.vertices)
    flat, rows = numpy.empty(3 * count, numpy.float32), numpy.empty(count, numpy.int32)
    if not count:
        return {}
    if values == "position":
        mesh.vertices.foreach_get("co", flat)
    else:
        mesh.attributes[values].data.foreach_get("vector", flat)
    mesh.attributes["throng_row"].data.foreach_get("value", rows)
    return {int(row): flat.reshape(-1, 3)[rows == row].astype(float) for row in numpy.unique(rows)}


def instanced(crowd):
    graph = bpy.context.evaluated_depsgraph_get()
    return {i.persistent_id[1] for i in graph.object_instances
            if i.is_instance and i.parent and i.parent.original == crowd}


def picked(crowd):
    """[distance from the camera, the level of the figure whose pose it is] of those who are not bent."""
    scene.frame_set(FRAME)
    figures, found = library.figures_of(cast_of(crowd)), []
    for i in bpy.context.evaluated_depsgraph_get().object_instances:
        if i.is_instance and i.parent and i.parent.original == crowd:
            row, count = i.persistent_id[1], len(i.object.data.vertices)
            member = own.member_of(crowd, row, int(state[FRAME - 1, row, 1]), False)
            sizes = [len(figures[level, member].data.vertices) for level in range(3)]
            found.append([float(numpy.linalg.norm(pos[FRAME - 1, row] - numpy.array(camera.location))),
                          sizes.index(count)])
    return found


def smooth(value, low, high):
    share = numpy.clip((value - low) / (high - low), 0.0, 1.0)
    return share * share * (3.0 - 2.0 * share)


def walk(points, gait, phase):
    place = phase % 1.0 * 24
    pose = int(place)
    first = 24 * gait
    return points[first + pose] + (place - pose) * (points[first + (pose + 1) % 24] - points[first + pose])


def expected(crowd, row, frame=FRAME, slopes=(0.0, 0.0)):
    """Where somebody's vertices should be: poses blended vertex by vertex, on ground of these slopes along the heading
    and to the left of it."""
    repertoire, at = repertoire_of(crowd), frame - 1
    activity, variation, phase = (float(value) for value in state[at, row])
    figure = library.figures_of(cast_of(crowd))[0, own.member_of(crowd, row, int(variation), False)]
    points = sheets.points_of(figure).astype(float)
    told = activity % 1.0 * 16.0
    gait = round(told)
    before, left = divmod((told - gait) * 32.0 + 1e-4, 1.0)
    walks = walk(points, gait - repertoire.first, phase)
    if left > 0.01:
        was = walk(points, int(before) - repertoire.first, phase)
        walks = walks + smooth(left, 0.0, 1.0) * (was - walks)
    clip = row % 4 % (4 if int(activity) == 2 else 2)
    rounds = (row * 0.618034 % 1.0 + frame / poses.FRAMES_A_ROUND) % 1.0 * 4
    beat, first = int(rounds), repertoire.walking() + 4 * clip
    stands = points[first + beat]
    stands = stands + smooth(rounds - beat, 0.67, 1.0) * (points[first + (beat + 1) % 4] - stands)
    cosine, sine, speed = (float(value) for value in way[at, row])
    body = stands + smooth(speed, 0.03, 0.35) * (walks - stands)
    body[:, 2] += slopes[0] * body[:, 0] + slopes[1] * body[:, 1]
    turned = numpy.stack([cosine * body[:, 0] - sine * body[:, 1], sine * body[:, 0] + cosine * body[:, 1],
                          body[:, 2]], axis=1)
    return turned + pos[at, row]


assert load() == {"FINISHED"}
crowd = crowd_objects(scene)[0]
shape, camera = cast_of(crowd), scene.camera
result["by default"] = ["throng near" in crowd.modifiers, shape["throng_levels"]]
camera.location, camera.rotation_euler = (0.0, -12.0, 3.0), (1.35, 0.0, 0.0)  # looks along +y
assert bpy.ops.throng.near(by="camera", reach=14.0, most=1000) == {"FINISHED"}
on_screen, figures = bent(crowd), library.figures_of(cast_of(crowd))
result["on screen"] = []
for row, points in on_screen.items():
    member = own.member_of(crowd, row, int(state[FRAME - 1, row, 1]), False)
    result["on screen"].append([float(numpy.linalg.norm(pos[FRAME - 1, row] - numpy.array(camera.location))),
                                len(points), [len(figures[level, member].data.vertices) for level in range(3)]])
assert bpy.ops.throng.near(by="camera", reach=14.0, most=1000, whole=True) == {"FINISHED"}
found = bent(crowd)
result["bent"], result["instanced"] = sorted(found), sorted(instanced(crowd))
result["off"] = {row: float(numpy.linalg.norm(points - expected(crowd, row), axis=1).max())
                 for row, points in found.items()}
mesh = crowd.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
tints = numpy.empty(3 * len(mesh.vertices), numpy.float32)
mesh.attributes["tint"].data.foreach_get("vector", tints)
rows = numpy.empty(len(mesh.vertices), numpy.int32)
mesh.attributes["throng_row"].data.foreach_get("value", rows)
wanted = numpy.array([each.vector for each in crowd.data.attributes["tint"].data])
result["tints"] = float(numpy.abs(tints.reshape(-1, 3) - wanted[rows]).max())
result["blurs on screen"] = "velocity" in mesh.attributes
result["materials"] = len(mesh.materials)

# others, on the screen and as rendered
camera.location = (0.0, -30.0, 3.0)
bpy.ops.throng.near(by="camera", reach=5.0, most=1000)
result["picked on screen"] = picked(crowd)
for flip in (False, True):
    for name, shown in zip(INSTANCERS, (not flip, flip)):
        crowd.modifiers[name].show_viewport = shown
    if not flip:
        result["picked as rendered"] = picked(crowd)
bpy.ops.throng.near(by="camera", reach=5.0, most=1000, whole=True)
result["picked whole"] = picked(crowd)
camera.location = (0.0, -12.0, 3.0)
bpy.ops.throng.near(by="camera", reach=14.0, most=1000, whole=True)

# on ground that slopes
slope = crowd.data.attributes.new("throng_ground", "FLOAT_VECTOR", "POINT")
slope.data.foreach_set("vector", [0.2, -0.1, 0.0] * len(crowd.data.vertices))
result["leaning"] = max(float(numpy.linalg.norm(points - expected(crowd, row, slopes=(0.2, -0.1)), axis=1).max())
                        for row, points in bent(crowd).items() if row > 1)
crowd.data.attributes.remove(crowd.data.attributes["throng_ground"])

# as rendered: what vertices do in a frame is what their velocity says
for name, shown in zip(INSTANCERS, (True, False)):
    crowd.modifiers[name].show_viewport = shown
velocities = bent(crowd, values="velocity")
earlier, later = bent(crowd, FRAME - 1), bent(crowd, FRAME + 1)
straight = [row for row in velocities if row > 1 and row in earlier and row in later and way[FRAME, row, 2] > 0.5]
off = [numpy.linalg.norm((later[row] - earlier[row]) * FPS / 2.0 - velocities[row], axis=1) for row in straight]
result["velocities"] = [len(straight), float(numpy.median(numpy.concatenate(off))),
                        float(numpy.quantile(numpy.concatenate(off), 0.99))]
for name, shown in zip(INSTANCERS, (False, True)):
    crowd.modifiers[name].show_viewport = shown

# fewer than there are: the nearest
assert bpy.ops.throng.near(by="camera", reach=14.0, most=5, whole=True) == {"FINISHED"}
few = bent(crowd)
away = {row: float(numpy.linalg.norm(pos[FRAME - 1, row] - numpy.array(camera.location))) for row in found}
result["few"] = [len(few), max(away[row] for row in few),
                 min((away[row] for row in found if row not in few), default=99.0)]
result["all are there"] = sorted({*few, *instanced(crowd)}) == sorted({*found, *result["instanced"]})

# larger, from a saved file without the add-on, and nobody at all
row = min(few)
assert bpy.ops.throng.scale_people(rows=str(row), scale=1.25) == {"FINISHED"}
tall = lambda people: float(people[row][:, 2].max() - people[row][:, 2].min())
result["scaled"] = tall(bent(crowd)) / tall(few)
path = os.path.join(folder, "near.blend")
bpy.ops.wm.save_as_mainfile(filepath=path)
before = bent(crowd)
name = crowd.name
throng.unregister()
bpy.ops.wm.open_mainfile(filepath=path)
scene = bpy.context.scene
after = bent(bpy.data.objects[name])
result["saved"] = sorted(before) == sorted(after) and max(
    float(numpy.abs(before[row] - after[row]).max()) for row in before)
throng.register()
crowd = bpy.data.objects[name]
counts = lambda: [len(each) for each in (bpy.data.objects, bpy.data.meshes, bpy.data.node_groups)]
bpy.ops.throng.levels(by="none")
result["levels stay"] = cast_of(crowd)["throng_levels"]
assert bpy.ops.throng.near(by="none") == {"FINISHED"}
result["none"] = [len(bent(crowd)), len(instanced(crowd)), cast_of(crowd)["throng_levels"]]
without = counts()
bpy.ops.throng.near(by="camera")
bpy.ops.throng.near(by="camera")
bpy.ops.throng.near(by="none")
result["nothing is left"] = counts() == without

# a member without bones, as those are who were brought along: it takes poses, however near
bpy.ops.throng.near(by="camera", reach=14.0, most=1000, whole=True)
member = {row: own.member_of(crowd, row, int(state[FRAME - 1, row, 1]), False) for row in range(len(way[0]))}
result["without bones"] = [sorted({member[row] for row in bent(crowd)})]
del sheets.sheet_of(library.figures_of(cast_of(crowd))[0, 2])["throng_bones"]
bpy.ops.throng.near(by="none")
bpy.ops.throng.near(by="camera", reach=14.0, most=1000, whole=True)
result["without bones"] += [sorted({member[row] for row in people(crowd)}) for people in (bent, instanced)]

# people without bones
bpy.ops.wm.read_factory_settings(use_empty=True)
del os.environ["THRONG_BODIES"]
scene = bpy.context.scene
assert bpy.ops.import_scene.throng(filepath=os.path.join(bake, "bake.json"), scenery=False, walls=False, roads=False,
                                   relative=False) == {"FINISHED"}
result["plain"] = ["throng near" in crowd_objects(scene)[0].modifiers, refused(bpy.ops.throng.near, by="camera")]
scene.camera = None
result["no camera"] = refused(bpy.ops.throng.near, by="camera")
print("RESULT " + json.dumps(result))
