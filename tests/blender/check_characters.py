# SPDX-License-Identifier: Apache-2.0
"""Runs inside Blender: a character of known strides joins the cast of a sample crowd, by file and from the scene;
errors change nothing."""
import json
import math
import os
import sys

import bpy
import numpy
from mathutils import Matrix

addon, here, bake, folder = sys.argv[-4:]
sys.path[:0] = [addon, here]
import throng  # noqa: E402
import walker  # noqa: E402
from throng import cast  # noqa: E402
from pose_names import Names  # noqa: E402
from throng.cast.sheets import points_of  # noqa: E402
from throng.characters import character  # noqa: E402
from throng.characters.members import report_of  # noqa: E402
from throng.crowd.queries import crowd_objects, figure, members_of, repertoire_of  # noqa: E402

if "bool" not in vars(numpy):
    numpy.bool = bool
bpy.ops.wm.read_factory_settings(use_empty=True)
throng.register()
glb = os.path.join(folder, "walker.glb")
result = {"errors": {}}


def counts():
    kinds = ("objects", "meshes", "materials", "images", "actions", "armatures", "scenes", "collections", "node_groups")
    return {kind: len(getattr(bpy.data, kind)) for kind in kinds}


# A file: looks along -x, 1.7 m tall, a walk that begins in the middle of a step, two cycles of another with root
# motion.
armature = walker.make(heading=180.0)
walker.add_clip(armature, "Idle", frames=20)
walker.add_clip(armature, "walk_cycle", stride=1.2, offset=0.25)
walker.add_clip(armature, "Walking_Fast", stride=1.7, stance=0.55, frames=22, cycles=2, travels=True)
walker.add_clip(armature, "Running_A", stride=2.4, stance=0.35, frames=18)
walker.add_clip(armature, "Walking_Backwards", stride=1.0, backwards=True)
walker.add_clip(armature, "Jump_Idle", frames=20)
bpy.ops.export_scene.gltf(filepath=glb, export_format="GLB")
bpy.ops.wm.read_factory_settings(use_empty=True)
throng.unregister()
throng.register()

bpy.ops.wm.save_as_mainfile(filepath=os.path.join(folder, "scene.blend"))
assert bpy.ops.import_scene.throng(filepath=os.path.join(bake, "bake.json"), scenery=False,
                                   camera=False) == {"FINISHED"}
scene = bpy.context.scene
crowd = crowd_objects(scene)[0]
repertoire = repertoire_of(crowd)
shipped = len(members_of(crowd))


def refused(label, operator, **properties):
    """The error's words; nothing may have changed."""
    before, names = counts(), members_of(crowd)
    try:
        operator(**properties)
        result["errors"][label] = "no error"
    except RuntimeError as error:
        result["errors"][label] = str(error)
    assert counts() == before and members_of(crowd) == names, (label, before, counts())


with open(os.path.join(folder, "words.glb"), "w", encoding="utf-8") as file:
    file.write("not a model")
with open(glb, "rb") as file, open(os.path.join(folder, "half.glb"), "wb") as half:
    half.write(file.read()[:20000])
with open(os.path.join(folder, "empty.gltf"), "w", encoding="utf-8") as file:
    json.dump({"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "scene": 0, "nodes": [{"name": "nothing"}]},
              file)
for label in ("words.glb", "half.glb", "empty.gltf", "absent.glb"):
    refused(label, bpy.ops.throng.add_character, filepath=os.path.join(folder, label))
refused("no clip of that name", bpy.ops.throng.add_character, filepath=glb, walk="Stroll")
refused("no such member", bpy.ops.throng.add_character, filepath=glb, replace=shipped + 5)
refused("walks backwards only", bpy.ops.throng.add_character, filepath=glb, walk="Walking_Backwards", run="Idle",
        heading="-X")

most, character.MOST_POINTS = character.MOST_POINTS, 100000
refused("too many vertices", bpy.ops.throng.add_character, filepath=glb)
character.MOST_POINTS = most

before = counts()
assert bpy.ops.throng.add_character(filepath=glb) == {"FINISHED"}
after = counts()
result["left"] = {kind: after[kind] - before[kind] for kind in after}
result["members"] = members_of(crowd)[shipped:]
joined = figure(crowd, shipped)
result["report"] = report_of(crowd, shipped)


def feet_of(figure):
    """(K, 2, V, 3) of right and left foot: the two boxes' vertices, told by where they are when somebody stands."""
    poses = points_of(figure)
    standing = poses[repertoire.standing_pose("idle", 0)]
    low = standing[:, 2] < walker.ANKLE + 0.005
    sides = [numpy.nonzero(low & (standing[:, 1] < 0.0))[0], numpy.nonzero(low & (standing[:, 1] > 0.0))[0]]
    return numpy.array([[pose[side] for side in sides] for pose in poses[:repertoire.walking()]])


soles = feet_of(joined)
result["feet"] = soles[..., ::7, :].round(5).tolist()
mesh, poses, velocity = joined.data, points_of(joined), points_of(joined, "velocity")
stride = repertoire.strides[1]
seconds = 2.0 * cast.gait.gait_of(stride).seconds / cast.POSES
expected = (poses[31] - poses[29]) / seconds
result["velocity"] = float(numpy.abs(velocity[30] - expected).max())
result["still"] = float(numpy.abs(velocity[repertoire.walking():]).max())
result["standing_height"] = float(numpy.ptp(poses[repertoire.standing_pose("idle", 0), :, 2]))
result["look"] = {"materials": [m.name.split(".")[0] for m in mesh.materials], "uv": len(mesh.uv_layers),
                  "packed": all(image.packed_file is not None for image in bpy.data.images if image.source == "FILE")}

# Who is who in the crowd: the newcomer has its share, and saved scenes show it without the add-on.
scene.frame_set(20)


def shown():
    graph, names = bpy.context.evaluated_depsgraph_get(), Names()
    found = {}
    for instance in graph.object_instances:
        if instance.is_instance and instance.parent and instance.parent.original == crowd:
            number = int(names.of(instance.object.data)[1:3])
            found[number] = found.get(number, 0) + 1
    return found


result["shown"] = shown()
assert bpy.ops.throng.reload() == {"FINISHED"}
result["after_reload"] = shown()

# Levels of detail, from far away: the newcomer's own coarser meshes; off again, nothing is left over.
camera = bpy.data.objects.new("far", bpy.data.cameras.new("far"))
scene.collection.objects.link(camera)
scene.camera, camera.location = camera, (0.0, -300.0, 2.0)
before = counts()
result["levels"] = {}
for level, (near, far) in ((1, (10.0, 1000.0)), (2, (10.0, 20.0))):
    assert bpy.ops.throng.levels(by="camera", near=near, far=far) == {"FINISHED"}
    names = Names()
    triangles = [sum(len(p.vertices) - 2 for p in instance.object.data.polygons)
                 for instance in bpy.context.evaluated_depsgraph_get().object_instances
                 if instance.is_instance and (name := names.of(instance.object.data)).startswith(f"m{shipped:02d}")
                 and name.endswith(f"_l{level}")]
    result["levels"][level] = [len(triangles), triangles[0], len(points_of(figure(crowd, shipped, level)))]
    result["levels"]["finest"] = sum(len(p.vertices) - 2 for p in joined.data.polygons)
result["shown_far"] = shown()
assert bpy.ops.throng.remove_character(member=shipped) == {"FINISHED"}  # it leaves and comes while levels are on
assert bpy.ops.throng.add_character(filepath=glb) == {"FINISHED"}
result["shown_again"] = shown()
assert bpy.ops.throng.levels(by="none") == {"FINISHED"}
after = counts()
result["left_by_levels"] = {kind: after[kind] - before[kind] for kind in after if kind != "node_groups"}
bpy.data.objects.remove(camera)

# A second one replaces a shipped person, with clips whose names say nothing, twice as large, looking along y, a walk
# that does not close its loop.
second = walker.make(heading=90.0, name="Nameless", scale=2.5)
walker.add_clip(second, "Clip.001", stride=1.3, heading=90.0, offset=0.6, closed=False)
walker.add_clip(second, "Clip.002", frames=20, heading=90.0)
bpy.context.view_layer.objects.active = second
place = tuple(second.location), second.animation_data.use_nla
before = counts()
assert bpy.ops.throng.add_armature(replace=2, height=1.6, keep="*stick*", character_name="Second") == {"FINISHED"}
assert place == (tuple(second.location), second.animation_data.use_nla) and second.animation_data.action is None
result["scenes"] = counts()["scenes"] - before["scenes"], counts()["armatures"] - before["armatures"]
replaced = figure(crowd, 2)
result["second"] = {"report": report_of(crowd, 2), "count": len(points_of(replaced)),
                    "vertices": len(replaced.data.vertices),
                    "smooth": sum(p.use_smooth for p in replaced.data.polygons) > 0.9 * len(replaced.data.polygons)}
result["second_feet"] = feet_of(replaced)[..., ::7, :].round(5).tolist()

# Unsuitable armatures in the scene.
second.animation_data_clear()
for action in [each for each in bpy.data.actions if each.name.startswith("Clip")]:
    bpy.data.actions.remove(action)
refused("no clips", bpy.ops.throng.add_armature)
walker.add_clip(second, "Sleep", frames=20, heading=90.0)
refused("no walk", bpy.ops.throng.add_armature)
for child in second.children:
    child.data.transform(Matrix.Scale(0.0, 4))
refused("no size", bpy.ops.throng.add_armature)
for child in list(second.children):
    bpy.data.objects.remove(child)
refused("no meshes", bpy.ops.throng.add_armature)
bpy.context.view_layer.objects.active = crowd
refused("no armature", bpy.ops.throng.add_armature)
bpy.data.objects.remove(second)

# Out again: who was replaced comes back, the other leaves, and the crowd is as it was.
assert bpy.ops.throng.remove_character(member=2) == {"FINISHED"}
result["restored"] = members_of(crowd)[2]
refused("not a character", bpy.ops.throng.remove_character, member=2)
assert bpy.ops.throng.remove_character(member=shipped) == {"FINISHED"}
result["at_the_end"] = [len(members_of(crowd)), max(shown())]
assert bpy.ops.throng.add_character(filepath=glb, walk="walk_cycle: 1.5", run="walk_cycle", idle="Jump_Idle",
                                    heading="-X", height=2.5, leave_out="none, *stick") == {"FINISHED"}
result["said"] = report_of(crowd, shipped)
bpy.ops.wm.save_mainfile()
throng.unregister()
bpy.ops.wm.open_mainfile(filepath=os.path.join(folder, "scene.blend"))
scene = bpy.context.scene
crowd = next(thing for thing in scene.objects if "throng pos" in thing.modifiers)
scene.frame_set(20)
result["without_add_on"] = shown()
assert math.isfinite(result["velocity"])
print("RESULT " + json.dumps(result))
