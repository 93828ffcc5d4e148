#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""How people move in the reference library RVO2 (pyrvo): the same scenarios, measured by the same `throng measure`.

Usage: rvo2_motion.py THRONG -o FOLDER [--scenario ring corridor ...] [--seconds S]   (needs numpy and pyrvo)

`throng bake` says who is where at first, with what goal, radius and speed; RVO2 then moves everybody straight to the
goal, and its motion is written over the bake's. RVO2's settings: a step of 1/30 s, horizon 2 s, 10 neighbours within
3 m, at most 2 m/s. What prefers to go straight is turned by a random 0.0001 rad at most, as RVO2's own examples do, so
that nobody is stuck by mere symmetry.
"""
import argparse
import csv
import json
import pathlib
import random
import subprocess
import sys

import numpy
import pyrvo

ROOT = pathlib.Path(__file__).resolve().parent.parent
SCENARIOS = ("ring", "annulus", "corridor", "crossing", "uniform")
SIGHT, NEIGHBOURS, HORIZON, FASTEST = 3.0, 10, 2.0, 2.0
THERE = 0.3       # m: formations' goal_tolerance
AWAY = 1.0e5      # m: where those are put who have arrived, far from all


def first_places(program, layout, folder, seconds):
    """A bake of one frame, and how many frames there shall be."""
    described = json.loads(layout.read_text())
    simulation = described["simulation"]
    frames = round((seconds or simulation["duration"]) * simulation["fps"])
    one_frame = f"simulation.duration={1.0 / simulation['fps']}"
    command = [program, "bake", layout, "-o", folder, "--force", "--no-gltf", "--quiet", "--set", one_frame]
    subprocess.run(command, check=True)
    return frames, 1.0 / (simulation["fps"] * simulation["substeps"]), simulation["substeps"]


def outline_of(wall):
    """Closed walls as they are, counter-clockwise; each stretch of an open one as a slab."""
    points = [complex(*point[:2]) for point in wall["points"]]
    if wall["closed"]:
        area = sum((a.conjugate() * b).imag for a, b in zip(points, points[1:] + points[:1]))
        return [points if area > 0.0 else points[::-1]]
    slabs = []
    for a, b in zip(points, points[1:]):
        side = 0.5j * wall["thickness"] * (b - a) / abs(b - a)
        slabs.append([a - side, b - side, b + side, a + side])
    return slabs


class Crowd:
    """RVO2's people, by row of the bake."""

    def __init__(self, people, walls, places, step):
        self.simulator = pyrvo.RVOSimulator(step, SIGHT, NEIGHBOURS, HORIZON, HORIZON, 0.3, FASTEST)
        self.goals = numpy.array([[float(person["goal_x"]), float(person["goal_y"])] for person in people])
        self.speeds = numpy.array([float(person["preferred_speed"]) for person in people])
        self.there = numpy.zeros(len(people), bool)
        self.step_seconds, self.random = step, random.Random(1)
        for row, (place, person) in enumerate(zip(places, people)):
            self.simulator.add_agent((float(place[0]), float(place[1])))
            self.simulator.set_agent_radius(row, float(person["radius"]))
        for wall in walls:
            for outline in outline_of(wall):
                self.simulator.add_obstacle([(point.real, point.imag) for point in outline])
        self.simulator.process_obstacles()

    def places(self):
        found = [self.simulator.get_agent_position(row) for row in range(len(self.there))]
        return numpy.array([(place.x, place.y) for place in found])

    def step(self, places):
        """@returns where everybody is then; who arrives is taken out"""
        way = self.goals - places
        length = numpy.hypot(way[:, 0], way[:, 1])
        speed = numpy.minimum(self.speeds, length / self.step_seconds)
        for row in numpy.nonzero(~self.there)[0]:
            turn = 1.0e-4 * self.random.uniform(-1.0, 1.0)
            x, y = way[row] * (speed[row] / max(length[row], 1e-9))
            self.simulator.set_agent_pref_velocity(int(row), (x - turn * y, y + turn * x))
        self.simulator.do_step()
        after = self.places()
        after[self.there] = places[self.there]
        for row in numpy.nonzero(~self.there & (numpy.hypot(*(self.goals - after).T) <= THERE))[0]:
            self.there[row] = True
            self.simulator.set_agent_position(int(row), (AWAY + 100.0 * row, AWAY))
            self.simulator.set_agent_pref_velocity(int(row), (0.0, 0.0))
        return after


def move(folder, frames, step, substeps):
    """Writes RVO2's motion over the streams and the table of a bake."""
    manifest = json.loads((folder / "bake.json").read_text())
    with open(folder / "agents.csv", newline="") as file:
        people = list(csv.DictReader(file))
    first = numpy.load(folder / "streams" / "pos.npy")[0]
    crowd = Crowd(people, manifest["geometry"]["walls"], first, step)
    pos, heading, state = (numpy.zeros((frames, len(people), 3), numpy.float32) for _ in range(3))
    places = crowd.places()
    for frame in range(frames):
        before = places
        for _ in range(substeps if frame else 0):
            places = crowd.step(places)
        pos[frame, :, :2], way = places, places - before
        speed = numpy.hypot(way[:, 0], way[:, 1]) * manifest["fps"]
        angle = numpy.arctan2(way[:, 1], way[:, 0])
        heading[frame] = numpy.stack([numpy.cos(angle), numpy.sin(angle), speed], axis=1)
        state[frame, :, 0] = ~crowd.there
        if frame % 300 == 0:
            there = f"{int(crowd.there.sum())} of {len(people)} there"
            print(f"{manifest['name']}: frame {frame} of {frames}, {there}", file=sys.stderr, flush=True)
        if crowd.there.all():
            pos[frame:], heading[frame:] = pos[frame], heading[frame]
            break
    for name, stream in (("pos", pos), ("dir", heading), ("state", state)):
        numpy.save(folder / "streams" / f"{name}.npy", stream)
    arrived = numpy.where(crowd.there, state[..., 0].argmin(axis=0), -1)
    _describe(folder, manifest, people, frames, arrived.tolist())


def _describe(folder, manifest, people, frames, arrived):
    """@param arrived the first frame that each is gone from; -1: none"""
    there = sum(frame >= 0 for frame in arrived)
    manifest |= {"generator": "RVO2", "frames": frames, "duration": frames / manifest["fps"], "files": [], "gltf": None}
    manifest["account"] |= {"arrived": there, "walking": len(people) - there}
    for person, frame in zip(people, arrived):
        person["arrival_frame"] = frame + manifest["frame_start"] if frame >= 0 else ""
        person["outcome"] = "arrived" if frame >= 0 else "walking"
    with open(folder / "agents.csv", "w", newline="") as file:
        table = csv.DictWriter(file, people[0].keys())
        table.writeheader()
        table.writerows(people)
    manifest.pop("checksum", None)
    (folder / "bake.json").write_text(json.dumps(manifest))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("-o", "--output", type=pathlib.Path, required=True)
    parser.add_argument("--scenario", nargs="+", default=SCENARIOS, choices=SCENARIOS)
    parser.add_argument("--seconds", type=float, help="instead of the layout's duration")
    options = parser.parse_args()
    options.output.mkdir(parents=True, exist_ok=True)
    for scenario in options.scenario:
        folder = options.output / scenario
        layout = ROOT / "scenarios" / f"{scenario}.json"
        frames, step, substeps = first_places(options.program, layout, folder, options.seconds)
        move(folder, frames, step, substeps)
        measure = [options.program, "measure", folder, "--json"]  # exits with 1 where bars are missed
        measured = subprocess.run(measure, stdout=subprocess.PIPE, text=True).stdout
        (options.output / f"{scenario}.json").write_text(measured)
        found = json.loads(measured)
        keys = ("agents", "arrived", "deepest_overlap_percent", "overlapping_percent", "wall_crossings")
        print(json.dumps({"scenario": scenario} | {key: found.get(key) for key in keys}), flush=True)


if __name__ == "__main__":
    main()
