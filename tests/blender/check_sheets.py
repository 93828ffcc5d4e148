# SPDX-License-Identifier: Apache-2.0
"""Runs inside Blender: whether figures bring an instance of every pose, in the repertoire's order, as the cast's
own reckoning has them, though what they are made of was worked out before, and kept. ADDON FOLDER"""
import json
import os
import sys
from itertools import chain

import bpy
import numpy

addon, os.environ["THRONG_CACHE"] = sys.argv[sys.argv.index("--") + 1:]
sys.path.insert(0, addon)
from throng import cast  # noqa: E402
from throng.cast import gait, library, people, sheets  # noqa: E402
from throng.cast.figure import build_figure  # noqa: E402

bpy.ops.wm.read_factory_settings(use_empty=True)
STRIDES = (1.1, 1.446)
repertoire = cast.Repertoire(STRIDES)
before = {kind: len(getattr(bpy.data, kind)) for kind in ("objects", "meshes", "node_groups")}


def all_levels():
    made = library.build_cast(cast.VARIATIONS, repertoire)
    library.add_levels(made, repertoire)
    return made


def corners(mesh):
    found = numpy.empty(len(mesh.loops), numpy.int32)
    mesh.loops.foreach_get("vertex_index", found)
    return found.tolist(), [face.loop_total for face in mesh.polygons], [face.material_index for face in mesh.polygons]


sheets.remove_figures(list(library.figures_of(all_levels()).values()))
for material in list(bpy.data.materials):
    bpy.data.materials.remove(material)
library.build_figure = None  # whatever it is asked for from here on, it fails
made = all_levels()
result = []
for member, level in ((0, 0), (3, 1), (8, 0), (11, 2)):
    figure = library.figures_of(made)[level, member]
    scene = bpy.data.scenes.new("one")
    scene.collection.objects.link(figure)
    layer = scene.view_layers[0]
    layer.update()
    person = people.CAST[member]
    figures = [build_figure(person, pose) for pose in cast.poses_of(person, repertoire)]
    plan = cast.plan_of(figures, repertoire, level)
    flat = [plan.vertices(figures[source].rings).astype(numpy.float32).ravel()
            for source in repertoire.sources(level)]
    shown = []
    for instance in layer.depsgraph.object_instances:
        if not instance.is_instance:
            continue
        mesh = instance.object.data
        points = numpy.empty(3 * len(mesh.vertices), numpy.float32)
        mesh.vertices.foreach_get("co", points)
        velocity = mesh.attributes.get("velocity")
        speeds = None
        if velocity:
            speeds = numpy.empty(points.size, numpy.float32)
            velocity.data.foreach_get("vector", speeds)
        shown.append((instance.persistent_id[1], points, speeds, [material.name for material in mesh.materials],
                      corners(mesh)))
    shown.sort(key=lambda each: each[0])
    seconds = [2.0 * gait.gait_of(stride).seconds / cast.POSES for stride in STRIDES]
    walking = repertoire.walking(level)
    off = [float(abs(points - wanted).max()) for (_, points, _, _, _), wanted in zip(shown, flat)]
    worst = 0.0
    for index, (_, _, speeds, _, _) in enumerate(shown[:walking] if level < 2 else ()):
        which, pose = divmod(index, cast.POSES)
        later, earlier = (flat[which * cast.POSES + near % cast.POSES] for near in (pose + 1, pose - 1))
        wanted = (later - earlier) / seconds[which]
        worst = max(worst, float(abs(speeds - wanted).max()))
    result.append({"count": len(shown), "expected": repertoire.poses(level), "off": max(off), "velocity_off": worst,
                   "blurring": sum(s is not None for _, _, s, _, _ in shown), "walking": walking, "level": level,
                   "materials": sorted({tuple(materials) for _, _, _, materials, _ in shown}),
                   "faces": all(faces == (list(chain.from_iterable(plan.faces)), list(map(len, plan.faces)),
                                          list(plan.materials)) for *_, faces in shown)})
    bpy.data.scenes.remove(scene)
sheets.remove_figures(list(library.figures_of(made).values()))
after = {kind: len(getattr(bpy.data, kind)) for kind in before}
print("RESULT " + json.dumps({"shown": result, "left": {kind: after[kind] - before[kind] for kind in before}}))
