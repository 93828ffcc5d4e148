#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""How many people stairs and an escalator take, and how fast they walk there at which density, beside published
figures: the table of docs/motion-validation.md.

Usage: stair_flows.py THRONG [--seeds 1 2 3]; `scripts/figures stairs` does all of it
"""
import argparse
import json
import pathlib
import statistics
import subprocess
import tempfile

import numpy

WIDTH = 2.0  # m, of stairs
RUN, RISE = 8.0, 4.0  # m
RATES = (0.4, 0.8, 1.2, 2.5)  # persons/(s m) that want to go there
MAXIMA = {"down": 1.1, "up": 0.88}  # persons/(s m): IMO, MSC.1/Circ.1533, table 1.2
# SFPE handbook, stairs of 7 in by 11 in: m/s along the slope, with 0.266 m^2 for each of the people.
SFPE_SPEED, SFPE_AREA = 1.08, 0.266
COUNT = 160


def box(x0, y0, x1, y1):
    return [[x0, y0], [x1, y0], [x1, y1], [x0, y1]]


def layout(link, way, rate, seed):
    """A hall and a gallery with nothing between them but a link in the middle."""
    start, goal = ("below", "above") if way == "up" else ("above", "below")
    return {
        "throng": 1, "simulation": {"duration": min(30 + COUNT / rate, 240), "seed": seed},
        "levels": [{"id": "hall", "floor": box(-22, -6, 0, 6)},
                   {"id": "gallery", "height": RISE, "floor": box(0, -6, 14, 6)}],
        "links": [link],
        "areas": [{"id": "below", "polygon": box(-21, -5, -13, 5)},
                  {"id": "above", "level": "gallery", "polygon": box(6, -5, 13, 5)}],
        "flows": [{"id": way, "from": start, "to": goal, "count": COUNT, "end": COUNT / rate}]}


def stairs():
    return {"id": "link", "from": "hall", "to": "gallery", "path": [[-RUN, 0], [0, 0]], "width": WIDTH}


def escalator(**more):
    return {"id": "link", "type": "escalator", "from": "hall", "to": "gallery", "path": [[-7, 0], [0, 0]], **more}


def measured(program, scene):
    """persons/(s m) over the middle, and in its middle part persons/m^2 and m/s in plan, while the flow lasts."""
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(scratch)
        (folder / "layout.json").write_text(json.dumps(scene))
        subprocess.run([program, "bake", folder / "layout.json", "-o", folder / "bake", "-q", "--no-gltf"],
                       check=True, stdout=subprocess.DEVNULL)
        told = subprocess.run([program, "measure", folder / "bake", "--json"], stdout=subprocess.PIPE, check=True)
        places = numpy.load(folder / "bake" / "streams" / "pos.npy")
        there = numpy.load(folder / "bake" / "streams" / "state.npy")[..., 0] > 0
    link = json.loads(told.stdout)["links"][0]
    length = 4.0
    on_link = there & (abs(places[..., 0] + 0.5 * RUN) < 0.5 * length) & (abs(places[..., 1]) < 0.5 * WIDTH + 0.2)
    on_link &= (places[..., 2] > 0.1) & (places[..., 2] < RISE - 0.1)
    steps = abs(numpy.diff(places[..., 0], axis=0)) * 24
    busy = numpy.flatnonzero(on_link.sum(axis=1))
    frames = slice(busy[0] + 24 * 15, busy[-1] - 24 * 15)  # s: the first and the last are alone
    both = (on_link[1:] & on_link[:-1])[frames]
    return link["specific_flow"], on_link[frames].sum(axis=1).mean() / (length * WIDTH), steps[frames][both].mean()


def means(program, scenes):
    found = [measured(program, scene) for scene in scenes]
    return [statistics.mean(values) for values in zip(*found)]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--seeds", type=int, nargs="+", default=[1, 2, 3])
    parser.add_argument("--quick", action="store_true", help="a trial: people who arrive at one rate only")
    options = parser.parse_args()
    print("| | asked for, persons/(s m) | flow, persons/(s m) | at most (IMO) | persons/m^2 | m/s along the slope "
          "| SFPE at that density |\n| --- | --- | --- | --- | --- | --- | --- |")
    slope = numpy.hypot(1.0, RISE / RUN)
    for way, most in MAXIMA.items():
        for rate in RATES[-1:] if options.quick else RATES:
            flow, density, speed = means(options.program, [layout(stairs(), way, rate * WIDTH, seed)
                                                           for seed in options.seeds])
            published = SFPE_SPEED * (1 - SFPE_AREA * max(density, 0.55))
            print(f"| stairs {way} | {rate:g} | {flow:.2f} | {most:g} | {density:.2f} | {speed * slope:.2f} "
                  f"| {published:.2f} |", flush=True)
    for name, more in (("escalator of 1 m, all stand on both sides", {"walking": 0}),
                       ("escalator of 1 m, 40 % walk on the left", {"walking": 0.4, "stand": "right"})):
        flow, _, _ = means(options.program, [layout(escalator(**more), "up", 3.0, seed) for seed in options.seeds])
        print(f"| {name} | 3 | {flow:.2f} | | | | |", flush=True)


if __name__ == "__main__":
    main()
