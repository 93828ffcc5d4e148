# SPDX-License-Identifier: Apache-2.0
"""Runs inside Blender: a crowd of people shaped from a library of bodies. ADDON BAKE FOLDER"""
import json
import math
import os
import sys

import bpy
import numpy
from mathutils import Matrix

addon, bake, folder = sys.argv[-3:]
sys.path[:0] = [addon, os.path.dirname(os.path.abspath(__file__))]
import throng  # noqa: E402
from asking import refused  # noqa: E402
from pose_names import Names  # noqa: E402
from throng.cast import library, poses_of_build, sheets  # noqa: E402
from throng.crowd.queries import cast_of, crowd_objects, figure, repertoire_of  # noqa: E402
from throng.overrides import hero, skeleton  # noqa: E402
from throng.people import casting, members  # noqa: E402
from throng.people.puppet import Puppet  # noqa: E402

PEOPLE = 4
bpy.ops.wm.read_factory_settings(use_empty=True)
throng.register()
scene, result = bpy.context.scene, {}


def load():
    return bpy.ops.import_scene.throng(filepath=os.path.join(bake, "bake.json"), scenery=False, walls=False,
                                       roads=False, relative=False, people=PEOPLE, bend=False)


def shown():
    """{row: member} of whom the scene shows now."""
    graph, names = bpy.context.evaluated_depsgraph_get(), Names()
    return {i.persistent_id[1]: int(names.of(i.object.data)[1:3]) for i in graph.object_instances
            if i.is_instance and i.parent and i.parent.original == crowd}


found_at = os.environ["THRONG_BODIES"]
os.environ["THRONG_BODIES"] = os.path.join(folder, "none.npz")
result["missing"], result["left"] = refused(load), len(bpy.data.objects)
os.environ["THRONG_BODIES"] = found_at
assert load() == {"FINISHED"}
crowd = crowd_objects(scene)[0]
shape = cast_of(crowd)
scene.frame_set(20)
result["shown"] = shown()
figures = library.figures_of(shape)
result["figures"] = [len(figures), shape["throng_variations"]]
roles = members.roles_of(shape)
result["roles"] = [[role.look, role.profile] for role in roles]
old = [casting.person_of(role) for role in roles][3]
result["old"] = [old.body.years, old.stoop]

repertoire = repertoire_of(crowd)
told, shaped = [], []
for where in (os.path.join(folder, "kept"), os.path.join(folder, "kept"), ""):  # made, found again, and made anew
    os.environ["THRONG_CACHE"] = where
    for each in (members.maker_of, members._of_all_poses, members._leaders, members._bones):
        each.cache_clear()
    one = members.boned_of(str(roles[1]), 0, repertoire)
    points = numpy.empty(3 * len(one.mesh.vertices), numpy.float32)
    one.mesh.vertices.foreach_get("co", points)
    told.append([points, one.hangs, one.matrices(), *one.limbs])
    shaped.append(members.maker_of.cache_info().misses)
away = [max(float(numpy.abs(numpy.asarray(one, float) - numpy.asarray(other, float)).max())
            for one, other in zip(told[0], others)) for others in told[1:]]
result["kept"] = [shaped, away]
os.environ["THRONG_BODIES"] = os.path.join(folder, "none.npz")
result["no levels"] = refused(bpy.ops.throng.levels, by="camera"), len(library.figures_of(shape))
os.environ["THRONG_BODIES"] = found_at
assert bpy.ops.throng.levels(by="camera", near=4000.0, far=5000.0) == {"FINISHED"}
figures = library.figures_of(shape)
result["triangles"] = [[len(figures[level, member].data.polygons) for level in range(3)] for member in range(PEOPLE)]
result["poses"] = [len(sheets.points_of(figures[level, 1])) for level in range(3)]
result["expected poses"] = [repertoire.poses(level) for level in range(3)]
# poses by the few bones that files keep, beside those by all bones of the library
result["off bones"] = []
for member in range(PEOPLE):
    maker = members.maker_of(roles[member])
    poses = poses_of_build(maker.rig.build, repertoire)
    model = maker.model(0)
    off = numpy.linalg.norm(sheets.points_of(figures[0, member]) - model.posed(poses), axis=2)
    result["off bones"].append([float(numpy.quantile(off, 0.999)), float(off.max())])
kept = {sheets.sheet_of(each) for each in figures.values()}
result["sheets"] = [len(kept), max(len(each.data.vertices) for each in kept) // repertoire.poses(0)]
stands = [sheets.points_of(figures[0, member])[repertoire.walking()] for member in range(3)]
result["heights"] = [[float(points[:, 2].min()), float(points[:, 2].max()), casting.person_of(role).body.height]
                     for role, points in zip(roles, stands)]
result["between levels"] = max(
    float(numpy.abs(end(fine, axis=0) - end(coarse, axis=0)).max())
    for member in range(PEOPLE) for end in (numpy.min, numpy.max)
    for fine, coarse in [(sheets.points_of(figures[0, member])[3], sheets.points_of(figures[1, member])[3])])
result["materials"] = sorted({material.name for each in figures.values() for material in each.data.materials})

# velocities are those of the poses before and after
points = sheets.points_of(figures[0, 0])
look = bpy.data.scenes.new("one")
look.collection.objects.link(figures[0, 0])
look.view_layers[0].update()
worst, blurring = 0.0, 0
for instance in look.view_layers[0].depsgraph.object_instances:
    velocity = instance.object.data.attributes.get("velocity") if instance.is_instance else None
    pose = instance.persistent_id[1]
    if velocity and len(velocity.data):
        flat = numpy.empty(3 * len(velocity.data), numpy.float32)
        velocity.data.foreach_get("vector", flat)
        seconds = 2.0 * members.gait.gait_of(repertoire.strides[0]).seconds / 24
        wanted = (points[(pose + 1) % 24] - points[(pose - 1) % 24]) / seconds
        worst, blurring = max(worst, float(numpy.abs(flat.reshape(-1, 3) - wanted).max())), blurring + 1
result["velocities"] = [blurring, worst, "velocity" in sheets.sheet_of(figures[0, 0]).data.attributes]
bpy.data.scenes.remove(look)

# overrides: swapped, taken back, a hero
row = min(row for row, member in result["shown"].items() if member == 0)
assert bpy.ops.throng.swap_people(rows=str(row), character=2) == {"FINISHED"}
scene.frame_set(20)
now = shown()
result["swapped"] = [now[row], [each for each, member in result["shown"].items() if now[each] != member] == [row]]
bpy.ops.throng.clear_people(rows=str(row))
scene.frame_set(20)
result["back"] = shown() == result["shown"]

# culled by a box
places = {i.persistent_id[1]: i.matrix_world.translation.copy()
          for i in bpy.context.evaluated_depsgraph_get().object_instances
          if i.is_instance and i.parent and i.parent.original == crowd}
box = bpy.data.objects.new("box", None)
scene.collection.objects.link(box)
box.location, box.scale = (15.0, 0.0, 0.0), (15.0, 40.0, 5.0)
bpy.context.view_layer.objects.active = box
bpy.ops.throng.cull(by="box", margin=0.0)
result["culled"] = [shown() == {each: member for each, member in result["shown"].items() if places[each].x >= 0.0},
                    len(shown())]
bpy.ops.throng.cull(by="none")
bpy.data.objects.remove(box)


def chest_of(each):
    """The mean colour of somebody's chest, as Cycles has it."""
    own = next(i.matrix_world.copy() for i in bpy.context.evaluated_depsgraph_get().object_instances
               if i.is_instance and i.parent and i.parent.original == crowd and i.persistent_id[1] == each)
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.data.type, camera.data.ortho_scale, camera.data.clip_end = "ORTHO", 0.2, 1.1
    turned = Matrix.Rotation(0.5 * math.pi, 4, "Z") @ Matrix.Rotation(0.5 * math.pi, 4, "X")
    camera.matrix_world = own @ Matrix.Translation((1.0, 0.0, 1.22)) @ turned
    scene.collection.objects.link(camera)
    scene.camera, scene.render.engine = camera, "CYCLES"
    scene.cycles.samples, scene.cycles.use_denoising, scene.render.use_motion_blur = 4, False, False
    scene.render.resolution_x = scene.render.resolution_y = 16
    scene.render.filepath = os.path.join(folder, "chest.png")
    bpy.ops.render.render(write_still=True)
    picture = bpy.data.images.load(scene.render.filepath)
    pixels = numpy.array(picture.pixels[:]).reshape(-1, 4)[:, :3].mean(axis=0)
    bpy.data.images.remove(picture)
    bpy.data.objects.remove(camera)
    return [float(value) for value in pixels]


# tints: colours of their own, and draws, which are where the club's colours are picked by
scene.world = bpy.data.worlds.new("white")
scene.world.use_nodes = True
scene.world.node_tree.nodes["Background"].inputs[0].default_value = (1.0, 1.0, 1.0, 1.0)
fan = min(row for row, member in result["shown"].items() if member == 3)
result["chests"] = []
for draws in ((0.1, 0.9, 0.5), (0.6, 0.9, 0.5), None):
    tint = {"by": "draws", "draws": draws} if draws else {"by": "colour", "colour": (0.9, 0.02, 0.02)}
    assert bpy.ops.throng.tint_people(rows=str(fan), **tint) == {"FINISHED"}
    scene.frame_set(20)
    result["chests"].append(chest_of(fan))
bpy.ops.throng.clear_people(rows=str(fan))
scene.frame_set(20)


def bounds(mesh, matrix):
    flat = numpy.empty(3 * len(mesh.vertices), numpy.float32)
    mesh.vertices.foreach_get("co", flat)
    spots = flat.reshape(-1, 3) @ numpy.array(matrix)[:3, :3].T + numpy.array(matrix)[:3, 3]
    return numpy.concatenate([spots.min(axis=0), spots.max(axis=0)])


in_crowd = next(bounds(each.object.data, each.matrix_world)
                for each in bpy.context.evaluated_depsgraph_get().object_instances
                if each.is_instance and each.parent and each.parent.original == crowd and each.persistent_id[1] == row)
assert bpy.ops.throng.promote_person(rows=str(row), hero="Anna") == {"FINISHED"}
scene.frame_set(20)
anna = hero.heroes_of(crowd)["Anna"]
body = next(child for child in anna.children if child.type == "MESH")
worn = body.evaluated_get(bpy.context.evaluated_depsgraph_get())
result["hero"] = {"off": float(numpy.abs(bounds(worn.data, worn.matrix_world) - in_crowd).max()),
                  "triangles": len(body.data.polygons), "hidden": row not in shown(),
                  "materials": all(slot.material for slot in body.material_slots),
                  "pattern": "pattern" in body.data.attributes, "tint": len(body["tint"])}


# and faces have keys
def places_of(data):
    found = numpy.empty(3 * len(data), numpy.float32)
    data.foreach_get("co", found)
    return found.reshape(-1, 3)


keys = body.data.shape_keys.key_blocks
rest = places_of(keys["Basis"].data)
for name in ("Blink", "Mouth", "Smile"):
    moved = numpy.linalg.norm(places_of(keys[name].data) - rest, axis=1)
    lowest = rest[moved > 1e-3, 2].min() / rest[:, 2].max()
    result.setdefault("keys", {})[name] = float(moved.max()), float(lowest)
# a hero's own bones take every vertex where its person's pose has it
puppet, walk = Puppet(roles[0]), members.gait.walk_pose(0.75, members.maker_of(roles[0]).rig.build,
                                                         members.gait.gait_of(1.4))
rest, then = (puppet.bones(pose, skeleton.bone_between) for pose in (puppet.rest, walk))
axes = lambda bone: numpy.stack([bone.left, bone.along, bone.ahead], axis=1)
vertices, weights, taken = puppet.vertices(), puppet.weights(skeleton.BONES), 0.0
for column, name in enumerate(skeleton.BONES):
    turned = (vertices - rest[name].head) @ (axes(then[name]) @ axes(rest[name]).T).T + then[name].head
    taken = taken + weights[:, column:column + 1] * turned
off = numpy.linalg.norm(taken - puppet.model.posed([walk])[0], axis=1)
result["puppet"] = [float(value) for value in (numpy.median(off), numpy.quantile(off, 0.98),
                                               abs(weights.sum(axis=1) - 1.0).max())]
bpy.ops.throng.levels(by="none")
result["after"] = len(library.figures_of(shape))
bpy.ops.wm.save_as_mainfile(filepath=os.path.join(folder, "people.blend"), compress=True)
result["megabytes"] = os.path.getsize(os.path.join(folder, "people.blend")) / 1e6
print("RESULT " + json.dumps(result))
assert figure(crowd, 0)
