#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Adults as they come, without a headway, radius or rule set by hand, beside what was measured with people: the flows
through doors and bottlenecks, how they queue, and how fast they walk in a crowd. A table for people with bodies
(`people.body`), and one for discs.

Usage: body_flows.py THRONG [--people body disc] [--seeds 1 2 3] [--case NAME ...] [--set SETTING ...]
"""
import argparse
import json
import math
import pathlib
import statistics
import subprocess
import sys
import tempfile

import numpy

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "scripts" / "figure_tables"))
import reading  # noqa: E402

PEOPLE = {"body": {"profile": "adult", "body": "adult"}, "disc": {"profile": "adult", "body": "disc"}}
SPECIFIC_FLOW = 1.9  # persons/(s m): Seyfried et al. 2009, for 0.9 to 2.5 m
DUESSELDORF = {"normal": [1.55, 0.18], "min": 1.0, "max": 2.1}  # m/s: how fast people of the experiments there like it
TWO_WAYS = 3.6  # m: how wide the corridor is that they pass each other in
NEAR_DOOR = 1.5  # m round the middle of a door, on the side where people wait
HEAD = "| | found (mean) | worst seed | wanted | holds | deepest overlap, % | steps backwards, % |"
RULE = "|" + " --- |" * (HEAD.count("|") - 1)


class Case:
    """One row of the table: a layout, what is measured of its bake, and the bounds of the mean."""

    def __init__(self, title, layout, measure, low, high, digits=2):
        self.title, self.layout, self.measure, self.low, self.high, self.digits = (
            title, layout, measure, low, high, digits)

    def off(self, value):
        """How far off the bounds, as a share of them; below 0 is within."""
        below = (self.low - value) / self.low if self.low else -1.0
        return max(below, (value - self.high) / self.high if self.high else -1.0)

    def wanted(self):
        if not self.low:
            return f"at most {self.high:.{self.digits}f}"
        return f"{self.low:.{self.digits}f} to {self.high:.{self.digits}f}"


def scenario(name, people, **changes):
    scene = json.loads((ROOT / "scenarios" / f"{name}.json").read_text())
    scene.pop("$schema")
    scene["formations"][0]["people"] = dict(people)
    scene["expect"] = {"line": scene["expect"]["line"]}
    scene["simulation"].update(changes)
    return scene


def box(x0, y0, x1, y1):
    return [[x0, y0], [x1, y0], [x1, y1], [x0, y1]]


def hall_before(width, people):
    """180 people at 3.3 per m^2 before a passage that is as long as those of Kretz and others: 0.4 m."""
    half, spacing = 0.5 * width, 0.55
    blocks = [{"points": box(0, side * 5.1, 0.4, side * half), "closed": True} for side in (1, -1)]
    outline = [{"points": [[0, 5], [-12, 5], [-12, -5], [0, -5]], "thickness": 0.2}]
    return {
        "throng": 1, "simulation": {"duration": 15 + 180 / (1.6 * width), "fps": 24, "substeps": 2},
        "walls": outline + blocks, "areas": [{"id": "out", "polygon": box(5, -3, 7, 3)}],
        "formations": [{"id": "crowd", "type": "grid", "origin": [-9.4, -3.85], "rows": 15, "columns": 12,
                        "spacing": spacing, "jitter": 0.02, "goal": "out", "arrival": "leave", "people": people}],
        "expect": {"line": [[0.2, -half], [0.2, half]]}}


def corridor_with_door(people):
    """148 people come into a corridor of 1.8 m as fast as it takes them, and leave it by a door of 0.7 m at its end."""
    # Closed behind them: else they walk round it.
    sides = [{"points": [[0, 0.95], [-21, 0.95], [-21, -0.95], [0, -0.95]], "thickness": 0.1}]
    ends = [{"points": [[0, side * 0.35], [0, side * 0.95]], "thickness": 0.0} for side in (1, -1)]
    return {
        "throng": 1, "simulation": {"duration": 140, "fps": 24, "substeps": 2}, "walls": sides + ends,
        "areas": [{"id": "in", "polygon": box(-20.6, -0.6, -18.6, 0.6)}, {"id": "out", "polygon": box(4, -2, 6, 2)}],
        "flows": [{"id": "walkers", "from": "in", "to": "out", "count": 148, "end": 55,
                   "people": {**people, "speed": DUESSELDORF}}],
        "expect": {"line": [[0, -0.35], [0, 0.35]]}}


def people_against_people(width, people):
    """About 150 come through an entrance of `width` at either end of a corridor 8 m long, all at once, and leave it to
    both sides: BOT-360 of the experiments in Duesseldorf, 2009 (Zhang and others 2012)."""
    half, side, walls, areas, formations = 0.5 * width, 0.5 * TWO_WAYS + 0.05, [], [], []
    for x in (-1, 1):
        walls.append({"points": [[x * 6.5, half], [x * 6.5, 8], [x * 19.5, 8], [x * 19.5, -8], [x * 6.5, -8],
                                 [x * 6.5, -half]], "thickness": 0.1})  # a hall, and its entrance
        for y in (-1, 1):
            walls.append({"points": [[x * 6.5, y * 8], [x * 4, y * 8], [x * 4, y * side], [0, y * side]],
                          "thickness": 0.1})
            areas.append({"id": f"out{x}{y}", "polygon": box(x * 4.3, y * 4.2, x * 6.2, y * 6.5)})
        formations.append({"id": "east" if x < 0 else "west", "type": "grid", "origin": [x * 7.5, x * -3.575],
                           "rotation": 0 if x > 0 else 180, "rows": 14, "columns": 11, "spacing": 0.55, "jitter": 0.02,
                           "goal": {"nearest": [f"out{-x}{y}" for y in (-1, 1)]}, "arrival": "leave",
                           "people": {**people, "speed": DUESSELDORF}})
    return {"throng": 1, "simulation": {"duration": 110, "fps": 24, "substeps": 2}, "walls": walls, "areas": areas,
            "formations": formations}


def first_frames(happens):
    """When it first happens to each of those to whom it does. (`happens`: frames by people)"""
    return happens.argmax(axis=0)[happens.any(axis=0)]


def through_the_middle(bake, measured):
    """persons/(s m) through a line across the middle of the corridor with two ways, from the first to the last."""
    about = json.loads((bake / "bake.json").read_text())
    x = reading.stream(bake, "pos")[:, :, 0] + about["origin"][0]
    there = reading.stream(bake, "state")[:, :, 0] > 0.5
    east = x[0] < 0.0
    times = first_frames((numpy.where(east, x, -x) > 0.0) & there)
    if len(times) < 0.95 * len(east):
        return 0.0  # stuck
    return len(times) / (times.max() - times.min()) * about["fps"] / TWO_WAYS


def flow_of(bake, measured):
    return measured.get("flow", 0.0)


def longest_jam(bake, measured):
    """s: the longest that nobody comes out through a door at x = 0, from the first who does, while somebody waits."""
    about = json.loads((bake / "bake.json").read_text())
    x = reading.stream(bake, "pos")[:, :, 0] + about["origin"][0]
    out = (x > 0.0) & (reading.stream(bake, "state")[:, :, 0] > 0.5)
    times = numpy.sort(first_frames(out))
    if not len(times):
        return len(x) / about["fps"]
    ends = times if len(times) == x.shape[1] else [*times, len(x) - 1]
    return numpy.diff(ends).max() / about["fps"]


def crowd_before(bake, measured):
    """persons/m^2 in a half disc before a door at x = 0, while at least half of the people are still to get through."""
    about = json.loads((bake / "bake.json").read_text())
    place = reading.stream(bake, "pos")[:, :, :2] + numpy.array(about["origin"][:2])
    there = reading.stream(bake, "state")[:, :, 0] > 0.5
    waiting = there & (place[..., 0] < 0.0)
    near = waiting & (numpy.hypot(place[..., 0], place[..., 1]) < NEAR_DOOR)
    frames = slice(round(10 * about["fps"]), None)  # s: they have got there by then
    busy = waiting[frames].sum(axis=1) >= 0.5 * waiting[0].sum()
    return float(near[frames][busy].sum(axis=1).mean()) / (0.5 * math.pi * NEAR_DOOR**2)


def share_of_weidmann(bake, measured):
    found = reading.speed_and_density(bake)
    return found["speed"] / found["usual"]


def cases(people):
    found = {}
    for name, width in (("080", 0.8), ("100", 1.0), ("120", 1.2)):
        bar = json.loads((ROOT / "scenarios" / f"bottleneck-{name}.json").read_text())["expect"]["flow"]
        layout = scenario(f"bottleneck-{name}", people, duration=85)
        found[f"kretz-{name}"] = Case(f"door of {width} m, per s (Kretz and others 2006)", layout, flow_of,
                                      bar["min"], bar["max"])
    for width in (0.9, 1.2, 1.6, 2.0, 2.5):
        usual = SPECIFIC_FLOW * width
        found[f"seyfried-{round(100 * width):03}"] = Case(
            f"bottleneck of {width} m, per s (Seyfried and others 2009)", hall_before(width, people), flow_of,
            0.85 * usual, 1.15 * usual)
    layout = corridor_with_door(people)
    found["corridor"] = Case("corridor with a door of 0.7 m, per s", layout, flow_of, 1.2, 1.8)
    found["jam"] = Case("there: longest that nobody comes out, s", layout, longest_jam, None, 5.0, 1)
    found["imo-4"] = Case("IMO 4, per s", scenario("imo-4", people, duration=90), flow_of, None, 1.33)
    for name in ("050", "100", "200", "300"):
        found[f"rimea-4-{name}"] = Case(
            f"{int(name) / 100:g} per m^2 in a corridor: speed over Weidmann's 1993",
            scenario(f"rimea-4-{name}", people), share_of_weidmann, 0.8, 1.2)
    for width, flow in ((1.6, 1.22), (2.0, 1.25)):
        found[f"two-ways-{round(100 * width)}"] = Case(
            f"two ways in a corridor of 3.6 m from entrances of {width} m, per s and m (Zhang and others 2012)",
            people_against_people(width, people), through_the_middle, 0.8 * flow, 1.2 * flow)
    found["density"] = Case("at a door of 0.8 m, persons/m^2 within 1.5 m", found["kretz-080"].layout, crowd_before,
                            3.0, 6.0, 1)
    return found


def bake_and_measure(program, layout, seed, settings, measures):
    """What each of `measures` says of a bake, and what `throng measure` says of overlaps and steps back."""
    layout["simulation"]["seed"] = seed
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(scratch)
        (folder / "layout.json").write_text(json.dumps(layout))
        words = [word for setting in settings for word in ("--set", setting)]
        subprocess.run([program, "bake", folder / "layout.json", "-o", folder / "bake", "-q", "--no-gltf", *words],
                       check=True, stdout=subprocess.DEVNULL)
        told = subprocess.run([program, "measure", folder / "bake", "--json"], stdout=subprocess.PIPE, check=True)
        measured = json.loads(told.stdout)
        return [float(each(folder / "bake", measured)) for each in measures], measured


def rows_of(found, program, seeds, settings, names):
    """Rows of the table. Cases of the same layout share its bakes."""
    chosen = {name: case for name, case in found.items() if not names or name in names}
    layouts = {id(case.layout): case.layout for case in chosen.values()}
    values, told = {name: [] for name in chosen}, {name: [] for name in chosen}
    for key, layout in layouts.items():
        sharing = [name for name, case in chosen.items() if id(case.layout) == key]
        for seed in seeds:
            results, measured = bake_and_measure(program, layout, seed, settings,
                                                 [chosen[name].measure for name in sharing])
            for name, value in zip(sharing, results):
                values[name].append(value)
                told[name].append(measured)
    for name, case in chosen.items():
        mean, worst = statistics.mean(values[name]), max(values[name], key=case.off)
        holds = "yes" if case.off(mean) <= 0.0 else "no"
        overlap = max(each["deepest_overlap_percent"] for each in told[name])
        back = max(each["backward_percent"] for each in told[name])
        digits = case.digits
        found_and_wanted = f"{mean:.{digits}f} | {worst:.{digits}f} | {case.wanted()}"
        yield f"| {case.title} | {found_and_wanted} | {holds} | {overlap:.1f} | {back:.2f} |"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--people", nargs="+", choices=PEOPLE, default=list(PEOPLE))
    parser.add_argument("--seeds", type=int, nargs="+", default=[1, 2, 3])
    parser.add_argument("--case", nargs="+", default=[], help="only these")
    parser.add_argument("--set", action="append", default=[], dest="settings", help="as of `throng bake`")
    options = parser.parse_args()
    for kind in options.people:
        title = {"body": "Bodies", "disc": "Discs"}[kind]
        print(f"{title}, seeds {' '.join(map(str, options.seeds))}:\n\n{HEAD}")
        print(RULE, flush=True)
        for row in rows_of(cases(PEOPLE[kind]), options.program, options.seeds, options.settings, options.case):
            print(row, flush=True)
        print()


if __name__ == "__main__":
    main()
