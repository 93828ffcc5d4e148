# SPDX-License-Identifier: Apache-2.0
"""Measures how the people near the camera move, on the meshes that are rendered: how far soles slide while they are on
the ground, and how much faster any vertex becomes from one frame to the next than the body it belongs to.

THRONG_BODIES=bodies.npz blender -b --factory-startup --python-exit-code 1 -P scripts/measure_motion.py -- BAKE
        [--frames FIRST LAST] [--reach M] [--at X Y] [--json]
"""
import argparse
import json
import os
import sys

import bpy
import numpy

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "blender_addon"))
import throng  # noqa: E402
from throng.cast import bones, gait  # noqa: E402
from throng.cast.sheets import sheet_of  # noqa: E402
from throng.crowd import near, own  # noqa: E402
from throng.crowd.names import INSTANCERS  # noqa: E402
from throng.crowd.queries import cast_of, crowd_objects  # noqa: E402

SOLE = 0.025      # m above the ground: what of a planted foot is lower
WALKS = 0.3       # m/s: slower people are left out where feet are looked at, which turn and shuffle on the spot
JUMP = 0.04       # m a frame, in a frame
LOW = 0.36        # of somebody's height: below it are feet, shanks and knees, which swing


def arguments():
    parser = argparse.ArgumentParser(prog="measure_motion.py")
    parser.add_argument("bake")
    parser.add_argument("--frames", type=int, nargs=2, default=(700, 760), metavar=("FIRST", "LAST"))
    parser.add_argument("--reach", type=float, default=6.0, help="m: people so near to the place")
    parser.add_argument("--at", type=float, nargs=2, default=(0.0, 0.0), metavar=("X", "Y"))
    parser.add_argument("--json", action="store_true")
    return parser.parse_args(sys.argv[sys.argv.index("--") + 1:] if "--" in sys.argv else [])


def import_people(options):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    throng.register()
    scene = bpy.context.scene
    bake = options.bake if options.bake.endswith(".json") else os.path.join(options.bake, "bake.json")
    bpy.ops.import_scene.throng(filepath=os.path.abspath(bake), scenery=False, walls=False, relative=False)
    crowd = crowd_objects(scene)[0]
    camera = scene.camera or bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    if not scene.camera:
        scene.collection.objects.link(camera)
        scene.camera = camera
    camera.constraints.clear()
    camera.animation_data_clear()
    camera.location, camera.rotation_euler = (*options.at, 1.6), (0.0, 0.0, 0.0)  # looks down: all round are before it
    bpy.ops.throng.near(by="camera", reach=options.reach, most=1000, whole=True)
    for name, final in zip(INSTANCERS, (True, False)):
        crowd.modifiers[name].show_viewport = final
    return scene, crowd


def people_at(scene, crowd, frame):
    """{row: (V, 3)} of those who are bent."""
    scene.frame_set(frame)
    mesh = crowd.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
    if "throng_row" not in mesh.attributes:
        return {}
    rows, points = numpy.empty(len(mesh.vertices), numpy.int32), numpy.empty(3 * len(mesh.vertices), numpy.float32)
    mesh.attributes["throng_row"].data.foreach_get("value", rows)
    mesh.vertices.foreach_get("co", points)
    points = points.reshape(-1, 3)
    return {int(row): points[rows == row] for row in numpy.unique(rows)}


class Streams:
    """Where bodies are and whither they face, of a bake, and the frame that the scene begins with."""

    def __init__(self, bake):
        folder = bake if os.path.isdir(bake) else os.path.dirname(bake)
        about = json.load(open(os.path.join(folder, "bake.json"), encoding="utf-8"))
        self.first = about["frame_start"]
        read = lambda name: numpy.load(os.path.join(folder, about["streams"][name]["npy"]), mmap_mode="r")
        self.places, self.headings, self.states = read("pos"), read("dir"), read("state")
        self.gaits = [gait.gait_of(stride) for stride in about["strides"]]

    def of(self, row, frame):
        """(place, (3, 2) axes) of somebody at a frame of the scene"""
        x, y = self.headings[frame - self.first, row, :2]
        return self.places[frame - self.first, row], numpy.array([[x, -y, 0.0], [y, x, 0.0], [0.0, 0.0, 1.0]])


    def planted(self, row, frame):
        """Which feet are flat on the ground by the clip, (right, left)."""
        activity, _, phase = self.states[frame - self.first, row]
        if self.headings[frame - self.first, row, 2] < WALKS:
            return False, False
        walked = self.gaits[min(round(float(activity) % 1.0 * 16.0), len(self.gaits) - 1)]
        since = [(float(phase) - walked.down - after) % 1.0 for after in (0.0, 0.5)]
        return tuple(walked.flat_from < each < walked.flat_until for each in since)


class Feet:
    """Which vertices of somebody's mesh are on the bones of feet and toes."""

    def __init__(self, crowd, streams, frame):
        self.crowd, self.streams, self.frame = crowd, streams, frame
        self.figures = near.boned_members(cast_of(crowd))
        self._known = {}

    def of(self, row):
        """(right, left): numbers"""
        variation = int(self.streams.states[self.frame - self.streams.first, row, 1])
        member = own.member_of(self.crowd, row, variation, False)
        if member not in self._known:
            mesh = self.figures[member].data
            hangs = numpy.empty(4 * len(mesh.vertices), numpy.float32)
            mesh.attributes[bones.HANGS].data.foreach_get("color", hangs)
            first = numpy.floor(hangs.reshape(-1, 4)[:, 0]).astype(int)
            limbs = list(sheet_of(self.figures[member])[bones.LIMBS])
            self._known[member] = [numpy.flatnonzero(numpy.isin(first, limbs[start + 2:start + 4])) for start in (4, 0)]
        return self._known[member]


class Soles:
    """How far each foot slides while it is flat on the ground."""

    def __init__(self):
        self.frames, self.steps, self._seen = [], [], {}

    def add(self, row, frame, points, ground):
        """Somebody in a frame of those that follow each other."""
        self._seen.setdefault(row, []).append((frame, points[:, :2], points[:, 2] - ground))

    def finish(self, streams, feet_of):
        """@param feet_of (row) gives the numbers of the vertices of the right foot and of the left one"""
        for row, seen in self._seen.items():
            for side, foot in enumerate(feet_of(row)):
                self._add_foot(row, seen, foot, side, streams)

    def _add_foot(self, row, seen, foot, side, streams):
        slid = None
        for (last, before, low), (frame, now, then) in zip(seen, seen[1:]):
            sole = foot[(low[foot] < SOLE) & (then[foot] < SOLE)]
            flat = frame == last + 1 and all(streams.planted(row, each)[side] for each in (last, frame))
            if flat and len(sole):
                way = (now[sole] - before[sole]).mean(axis=0)
                self.frames.append(float(numpy.linalg.norm(way)))
                slid = way if slid is None else slid + way
            elif slid is not None:
                self.steps.append(float(numpy.linalg.norm(slid)))
                slid = None


class Jumps:
    """How much the way of any vertex, as its own body sees it, changes from one frame to the next, above and below LOW
    of its height."""

    def __init__(self):
        self.most = {"legs to above the knee": [], "all else": []}
        self._ways = {}

    def add(self, row, before, now, placed):
        """@param placed Streams.of() then and now"""
        seen = [(points - place) @ axes for points, (place, axes) in zip((before, now), placed)]
        way, height = seen[1] - seen[0], seen[1][:, 2]
        last = self._ways.get(row)
        self._ways[row] = way
        if last is None or len(last) != len(way):
            return
        change = numpy.linalg.norm(way - last, axis=1)
        low = height < LOW * height.max()
        for name, part in (("legs to above the knee", low), ("all else", ~low)):
            self.most[name].append(float(change[part].max(initial=0.0)))

    def forget(self, rows):
        self._ways = {row: way for row, way in self._ways.items() if row in rows}


def checked(streams, options):
    """The frames that the bake has of those asked for."""
    last = streams.first + len(streams.places) - 1
    frames = max(options.frames[0], streams.first), min(options.frames[1], last)
    if frames[1] - frames[0] < 2:
        sys.exit(f"measure_motion.py: the bake has the frames {streams.first} to {last}: of {options.frames[0]} to "
                 f"{options.frames[1]} there are not three to look at")
    return frames


def measured(scene, crowd, streams, frames):
    soles, jumps, before, people = Soles(), Jumps(), {}, set()
    for frame in range(frames[0], frames[1] + 1):
        now = people_at(scene, crowd, frame)
        both = [row for row in now if row in before and len(now[row]) == len(before[row])]
        jumps.forget(both)
        for row in both:
            jumps.add(row, before[row], now[row], [streams.of(row, each) for each in (frame - 1, frame)])
        for row, points in now.items():
            soles.add(row, frame, points, streams.of(row, frame)[0][2])
        people.update(both)
        before = now
    soles.finish(streams, Feet(crowd, streams, frames[0]).of)
    return {"people": len(people), "frames": len(soles.frames), "steps": len(soles.steps),
            "slide a frame, m": spread(soles.frames, 0.01), "slide a step, m": spread(soles.steps, 0.01),
            **{f"jump of {name}, m": spread(values, JUMP) for name, values in jumps.most.items()}}


def spread(values, bar):
    values = numpy.asarray(values)
    if not len(values):
        return {}
    return {"mean": float(values.mean()), "median": float(numpy.median(values)),
            "99 %": float(numpy.percentile(values, 99)), "most": float(values.max()), "bar": bar,
            "share above the bar": float((values > bar).mean())}


def main():
    options = arguments()
    streams = Streams(options.bake)
    frames = checked(streams, options)
    found = measured(*import_people(options), streams, frames)
    if not found["people"]:
        sys.exit(f"measure_motion.py: nobody is bent within {options.reach:g} m of {options.at[0]:g}, "
                 f"{options.at[1]:g} in the frames {frames[0]} to {frames[1]}")
    if options.json:
        print("RESULT " + json.dumps(found))
        return
    for name, value in found.items():
        print(f"{name}: {value}" if not isinstance(value, dict) else
              f"{name}: " + ", ".join(f"{key} {number:.4f}" for key, number in value.items()))


main()
