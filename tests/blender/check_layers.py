# SPDX-License-Identifier: Apache-2.0
"""Runs inside Blender: layers are added by operators, written, applied, compared, changed and applied again."""
import json
import math
import os
import shutil
import sys

import bpy
from mathutils import Matrix

addon, folder = sys.argv[-2:]
sys.path[:0] = [addon, os.path.dirname(os.path.abspath(__file__))]
import throng  # noqa: E402
from asking import refused  # noqa: E402
from throng.crowd.queries import bake_path, crowd_objects  # noqa: E402
from throng.crowd.verify import verify  # noqa: E402
from throng.layers import applying, scene_values  # noqa: E402
from throng.overrides import operators as override_operators, picking  # noqa: E402
from throng.overrides.override_file import read_layers  # noqa: E402

BAKE, FILE = os.path.join(folder, "street"), os.path.join(folder, "street.overrides.json")
bpy.ops.wm.read_factory_settings(use_empty=True)
throng.register()
bpy.ops.wm.save_as_mainfile(filepath=os.path.join(folder, "scene.blend"))
came = bpy.ops.import_scene.throng(filepath=os.path.join(BAKE, "bake.json"), scenery=False, camera=False)
assert came == {"FINISHED"}
scene, ops = bpy.context.scene, bpy.ops.throng
crowd = crowd_objects(scene)[0]
result = {"version": list(bpy.app.version)}
written = lambda: json.load(open(FILE, encoding="utf-8"))


def people(of):
    """{row: [x, y]} as the scene shows them now."""
    graph = bpy.context.evaluated_depsgraph_get()
    return {i.persistent_id[1]: [round(v, 4) for v in i.matrix_world.translation[:2]] for i in graph.object_instances
            if i.is_instance and i.parent and i.parent.original == of}


def whom(index=-1):
    return json.loads(crowd.throng_layers[index].who)


# --- selectors from the scene ----------------------------------------------------------------------------------------
result["nobody"] = refused(ops.add_layer, selector="people")
result["no_region"] = refused(ops.add_layer, selector="region")
result["no_camera"] = refused(ops.add_layer, selector="seen")
result["no_name"] = refused(ops.add_layer, selector="group")
result["nothing"] = refused(ops.compare_layers)
crowd.location = (100.0, 0.0, 0.0)  # what is in the file is in the world of the bake, wherever the crowd has been put
bpy.context.view_layer.update()
scene.frame_set(41)
scene.cursor.location = (105.0, 1.0, 0.0)
ops.add_layer(selector="near", within=2.0, now=True, operation="look_at", name="near")
mesh = bpy.data.meshes.new("region")
mesh.from_pydata([(0, 0, 0), (4, 0, 0), (4, 3, 0), (0, 3, 0), (2, 1, 0)], [],
                 [(0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4)])
region = bpy.data.objects.new("region", mesh)
scene.collection.objects.link(region)
region.location = (102.0, -1.0, 5.0)
bpy.context.view_layer.objects.active = region
bpy.context.view_layer.update()
ops.add_layer(selector="region", operation="hide", name="region")
camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
scene.collection.objects.link(camera)
scene.camera = camera
scene.render.resolution_x, scene.render.resolution_y = 1600, 800
camera.matrix_world = Matrix.Translation((110.0, 0.0, 10.0))  # straight down
ops.add_layer(selector="seen", now=True, operation="hide", name="seen")
camera.keyframe_insert("location", frame=1)
camera.location.x += 5.0
camera.keyframe_insert("location", frame=49)
ops.add_layer(selector="seen", step=24, operation="hide", name="moving")
picking.pick(crowd, [3, 16])
ops.add_layer(selector="people", operation="tint", name="picked", others=True, share=0.5, seed=4)
result["selectors"] = {item.name: json.loads(item.who) for item in crowd.throng_layers}
result["frame"] = scene.frame_current
for _ in range(len(crowd.throng_layers)):
    ops.change_layers(action="REMOVE")
assert not os.path.exists(FILE)

# --- what is done, written and applied -------------------------------------------------------------------------------
crowd.location = (0.0, 0.0, 0.0)
scene.frame_set(61)
ops.add_layer(selector="group", words="ring", operation="duplicate", copies=2, by=(20.0, 0.0, 0.0), name="more")
ops.add_layer(selector="rows", first=0, last=2, operation="hide")
ops.add_layer(selector="copies", words="more", operation="move", by=(0.0, 5.0, 0.0), turn=math.radians(90.0))
ops.add_layer(selector="rows", first=5, last=5, operation="bend", by=(0.0, 0.5, 0.0), name="bend")
ops.add_layer(selector="everybody", operation="hide", name="off")
crowd.throng_layers[-1].enabled = False
result["done"] = [[item.name, json.loads(item.do)] for item in crowd.throng_layers]
ops.hide_people(rows="6")  # a single one goes along
result["reports"] = applying.apply(bpy.context, crowd)
layered = applying.layered_crowd(scene, crowd)
result["crowds"] = [crowd.hide_viewport, layered.hide_viewport, os.path.basename(os.path.dirname(bake_path(layered))),
                    len(layered.data.vertices), layered["throng_cast"] == crowd["throng_cast"],
                    override_operators._crowd(bpy.context) == crowd, verify(layered, scene)]
result["shown"] = people(layered)
result["hidden"] = len(people(crowd))
assert ops.compare_layers() == {"FINISHED"}
result["compared"] = [crowd.hide_viewport, layered.hide_viewport, sorted(people(crowd))]
ops.compare_layers()
result["file"] = written()

# --- changed, and applied again --------------------------------------------------------------------------------------
crowd.throng_layer_index = 1
ops.change_layers(action="UP")
result["order"] = [item.name for item in crowd.throng_layers]
crowd.throng_layers[0].who = '{"rows": [0, 3]}'
assert ops.apply_layers() == {"FINISHED"}
again = applying.layered_crowd(scene, crowd)
result["again"] = [again == layered, len(crowd_objects(scene)), sorted(people(again))]
crowd.throng_layers[2].do = '{"mvoe": {"by": [1, 0, 0]}}'
result["wrong_key"] = [refused(ops.apply_layers), crowd.throng_layer_index]
crowd.throng_layers[2].do = '{"move": '
result["no_json"] = refused(ops.apply_layers)
ops.reload_layers()
result["reloaded"] = [item.name for item in crowd.throng_layers]
document = written()
document["layers"] = document["layers"][:1]
json.dump(document, open(FILE, "w", encoding="utf-8"))
result["others"] = refused(ops.apply_layers)
ops.reload_layers()
result["theirs"] = [item.name for item in crowd.throng_layers]
ops.hide_people(rows="8")
result["kept"] = [[entry["id"] for entry in written()["overrides"]], len(written()["layers"])]
ops.clear_people(rows="6 8")
shutil.copytree(BAKE, os.path.join(folder, "retake"))
applying.compare(scene, crowd, False)
again.select_set(False)
crowd.select_set(True)
assert ops.relink(filepath=os.path.join(folder, "retake", "bake.json")) == {"FINISHED"}
result["retake"] = [os.path.basename(applying.save(crowd)),
                    [each["name"] for each in read_layers(os.path.join(folder, "retake.overrides.json"))]]
applying.compare(scene, crowd, True)
bpy.data.objects.remove(again)
result["gone"] = [refused(ops.compare_layers), crowd.hide_viewport]
bpy.ops.wm.save_as_mainfile(filepath=os.path.join(folder, "scene.blend"))
throng.unregister()
print("RESULT " + json.dumps(result))
