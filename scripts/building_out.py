#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""How long a building of three storeys takes to empty, by how fast people walk and how wide its stairs are: the table
of docs/motion-validation.md (RiMEA's test 8, scenarios/rimea-8.json).

Usage: building_out.py THRONG [--seeds 1 2 3 4 5]; `scripts/figures building` does all of it
"""
import argparse
import csv
import json
import pathlib
import statistics
import subprocess
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
SCENARIO = ROOT / "scenarios" / "rimea-8.json"
FPS = 24.0
# What is changed, in words, and how: everything else is as in the scenario.
CASES = {"0.8 m/s": {"speed": 0.8}, "1.0 m/s": {"speed": 1.0}, "1.3 m/s": {"speed": 1.3},
         "adults, 1.34 +- 0.26 m/s": {}, "adults, stairs of 1.6 m": {"width": 1.6},
         "adults, one in each room": {"every": 2}}


def layout_of(case, seed):
    layout = json.loads(SCENARIO.read_text())
    layout["simulation"]["seed"] = seed
    for formation in layout["formations"]:
        if "speed" in case:
            formation["people"]["speed"] = case["speed"]
        formation["agents"] = formation["agents"][::case.get("every", 1)]
    for link in layout["links"]:
        link["width"] = case.get("width", link["width"])
    return layout


def emptied(program, layout):
    """Seconds until the last of each storey is out, how many are, and persons/(s m) over each of the stairs."""
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(scratch)
        (folder / "layout.json").write_text(json.dumps(layout))
        subprocess.run([program, "bake", folder / "layout.json", "-o", folder / "bake", "-q", "--no-gltf"], check=True,
                       stdout=subprocess.DEVNULL)
        told = json.loads(subprocess.run([program, "measure", folder / "bake", "--json"], check=True,
                                         stdout=subprocess.PIPE).stdout)
        with open(folder / "bake" / "agents.csv", newline="") as file:
            people = list(csv.DictReader(file))
    last = {storey: max(int(row["arrival_frame"] or -1) for row in people if row["group"] == f"storey-{storey}") / FPS
            for storey in range(3)}
    return {"agents": told["agents"], "arrived": told["arrived"], "last": last,
            "flows": {link["id"]: link["specific_flow"] for link in told["links"]}}


def mean_and_worst(values, digits):
    return f"{statistics.mean(values):.{digits}f} ({max(values):.{digits}f})"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--seeds", type=int, nargs="+", default=[1, 2, 3, 4, 5])
    parser.add_argument("--quick", action="store_true", help="a trial: one way to change the building only")
    options = parser.parse_args()
    columns = ["people", "out", "ground floor, s", "first, s", "second, s", "stairs 1 to 0, persons/(s m)",
               "stairs 2 to 1, persons/(s m)"]
    print("| " + " | ".join(["", *columns]) + " |\n|" + " --- |" * (len(columns) + 1))
    for name, case in list(CASES.items())[-1 if options.quick else 0:]:
        runs = [emptied(options.program, layout_of(case, seed)) for seed in options.seeds]
        people = {run["agents"] for run in runs}
        cells = [", ".join(map(str, people)), f"{min(run['arrived'] for run in runs)}",
                 *(mean_and_worst([run["last"][storey] for run in runs], 0) for storey in range(3)),
                 *(mean_and_worst([run["flows"][f"stairs-{number}"] for run in runs], 2) for number in (1, 2))]
        print("| " + " | ".join([name, *cells]) + " |", flush=True)


if __name__ == "__main__":
    main()
