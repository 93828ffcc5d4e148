#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What each rule of motion buys: bakes scenarios with one rule after the other switched off, measures them and writes
tables.

Usage: ablate.py THRONG -o FOLDER [--scenario corridor crossing] [--seed 1 2 3] [--only cushion all ...]
       ablate.py --list      what can be left out

A scenario is a name of scenarios/ or examples/, or a layout file. Rules that have nothing to do in a layout are passed
over there, unless --only names them. What has been measured stays in FOLDER/results.jsonl and is not measured again
while program, layout and settings are the same.
"""
import argparse
import hashlib
import json
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "scripts" / "figure_tables"))
from pages import paragraph, table  # noqa: E402
SCHEMA = ROOT / "authoring" / "layout" / "throng-layout.schema.json"

# What a layout has to have for a rule to have anything to do.
NEEDS = {"company": '"groups"', "waiting_for_company": '"groups"', "headway": '"headway"', "kerb": '"roads"',
         "slope_pace": '"terrain"', "riding": '"walking"', "climbing": '"stairs"', "at_rest": '"wait"',
         "routes_round_jams": "", "contact_momentum": ""}
FOR_BODIES = {"shoulders", "room_to_stride"}

# Beside one rule after the other: name for --only -> (what the table calls it, settings).
TOGETHER = {
    "politeness": ("neither impatience nor the rule about oncoming people",
                   ["motion.no_braking_for_oncoming.enabled=false", "motion.impatience.enabled=false"]),
    "platoons": ("neither headway in peace nor standing fast",
                 ["motion.headway_in_peace.enabled=false", "motion.standing_fast.enabled=false"]),
    "feet": ("no planted feet, no turning on the spot",
             ["motion.planted_feet.enabled=false", "motion.turning.on_the_spot=false"]),
    "slip": ("who is pushed back plants its feet, and does not slip past", ["motion.planted_feet.slip=0"]),
    "gaps": ("no cushion, no room to step", ["motion.cushion.enabled=false", "motion.room_to_step.enabled=false"]),
    "grid": ("everybody senses exactly (the grid) instead of through the diagram", ["simulation.proximity=grid"]),
}


def variants():
    """Name for --only -> (what the table calls it, settings)."""
    rules = json.loads(SCHEMA.read_text())["properties"]["motion"]["properties"]
    alone = {}
    for name, rule in rules.items():
        switch = rule["properties"].get("enabled")
        if switch:  # to the other side than usual
            word, value = ("without", "false") if switch["default"] else ("with", "true")
            alone[name] = (f"{word}: {rule['title']}", [f"motion.{name}.enabled={value}"])
    return {"all": ("all rules", []), **alone, **TOGETHER}


def layout_of(scenario):
    known = [ROOT / folder / f"{scenario}.json" for folder in ("scenarios", "scenarios/large", "examples")]
    return next((file for file in known if file.exists()), pathlib.Path(scenario))


def has_bodies(text):
    """Whether anybody in a layout has a body: whoever is given neither a radius nor a disc."""
    layout = json.loads(text)
    everybody = [each.get("people", {}) for kind in ("flows", "formations", "seats", "given")
                 for each in layout.get(kind, [])]
    return any("radius" not in people and people.get("body") != "disc" for people in everybody)


def chosen(layout, only):
    text = layout.read_text()
    bodies = has_bodies(text)
    return {name: variant for name, variant in variants().items()
            if (name in only if only else NEEDS.get(name, "") in text and (bodies or name not in FOR_BODIES))}


def hash_of(*things):
    """Of files and whatever can be printed."""
    known = hashlib.sha256()
    for thing in things:
        known.update(thing.read_bytes() if isinstance(thing, pathlib.Path) else repr(thing).encode())
    return known.hexdigest()[:16]


def measured(program, layout, settings):
    """What `throng measure` says of a bake with these settings."""
    with tempfile.TemporaryDirectory() as scratch:
        bake = pathlib.Path(scratch) / "bake"
        subprocess.run([program, "bake", layout, "-o", bake, "--no-gltf", "-q",
                        *(word for each in settings for word in ("--set", each))],
                       check=True, stdout=subprocess.DEVNULL)
        result = subprocess.run([program, "measure", bake, "--json"], stdout=subprocess.PIPE, check=False)
        if result.returncode not in (0, 1):  # 1: a bar is missed
            raise SystemExit(result.returncode)
        return json.loads(result.stdout)


def there(row):
    return f"{row['seconds']:.0f} s" if row["arrived"] == row["agents"] else f"{row['arrived']:,} of {row['agents']:,}"


def overlap(row):
    pairs = row["overlapping_percent"]
    return f"{row['deepest_overlap_percent']:.1f}" + (f" ({pairs:.3f})" if pairs >= 0.0005 else "")


# What a table of its own is about -> what stands in its cells.
FIGURES = {
    "All there after, or how many are at T": there,
    "Steps backwards, %": lambda row: f"{row['backward_percent']:.2f}",
    "Deepest overlap, % of 2a (overlapping pairs, % of people, where there are any)": overlap,
    "Acceleration, 99th percentile, m/s^2": lambda row: f"{row['acceleration_p99']:.1f}",
}


def tables(rows):
    """A table for each figure: what is left out downwards, scenarios across. What changes nothing is only named."""
    columns = list(dict.fromkeys((row["scenario"], row["seed"]) for row in rows))
    seeds = len({seed for _, seed in columns}) > 1
    cells = {}  # of each variant: what is known of it, by column
    for row in rows:
        cells.setdefault(row["variant"], {})[row["scenario"], row["seed"]] = row
    usual = next(iter(cells.values()))
    same = [name for name, known in cells.items() if known is not usual and
            all(figure(row) == figure(usual[column]) for column, row in known.items() for figure in FIGURES.values())]
    head = ["", *(f"{name}, seed {seed}" if seeds else name for name, seed in columns)]
    parts = []
    for title, figure in FIGURES.items():
        told = [[name, *(figure(known[column]) if column in known else "" for column in columns)]
                for name, known in cells.items() if name not in same]
        parts.append(f"{title}:\n\n{table(head, told)}")
    if same:
        parts.append(paragraph(f"The same figures as with all rules: {'; '.join(same)}."))
    return "\n\n".join(parts)


def row_of(scenario, seed, name, variant, report):
    return {"scenario": scenario, "seed": seed, "name": name, "variant": variant, "agents": report["agents"],
            "arrived": report["arrived"], "seconds": report["seconds"],
            "deepest_overlap_percent": report["deepest_overlap_percent"],
            "overlapping_percent": report["overlapping_percent"],
            "acceleration_p99": report["acceleration"]["p99"], "backward_percent": report["backward_percent"],
            "way": report["detour_ratio"]}


class Results:
    """Rows by what they were measured with, kept in a file."""

    def __init__(self, path):
        self.path = path
        rows = [json.loads(line) for line in path.read_text().splitlines()] if path.exists() else []
        self.rows = {row["of"]: row for row in rows}

    def row(self, of, measure):
        if of not in self.rows:
            self.rows[of] = {**measure(), "of": of}
            with self.path.open("a") as file:
                file.write(json.dumps(self.rows[of]) + "\n")
        return self.rows[of]


def run(program, scenarios, seeds, only, always, folder):
    results = Results(folder / "results.jsonl")
    rows = []
    for scenario in scenarios:
        layout = layout_of(scenario)
        for seed in seeds:
            for name, (variant, settings) in chosen(layout, only).items():
                settings = [*always, *settings, *([f"simulation.seed={seed}"] if seed else [])]

                def measure():
                    print(f"{layout.stem}: {variant} ...", file=sys.stderr, flush=True)
                    return row_of(layout.stem, seed or "own", name, variant, measured(program, layout, settings))

                rows.append(results.row(hash_of(pathlib.Path(program), layout, settings), measure))
                (folder / "tables.md").write_text(tables(rows) + "\n")
    return rows


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", nargs="?")
    parser.add_argument("-o", "--output", type=pathlib.Path)
    parser.add_argument("--scenario", nargs="+", default=["corridor", "crossing"])
    parser.add_argument("--seed", nargs="+", type=int, default=[None], help="instead of the layout's own")
    parser.add_argument("--only", nargs="+", default=[], choices=variants(), metavar="NAME")
    parser.add_argument("--set", nargs="+", default=[], dest="settings", help="in every bake, as for `throng bake`")
    parser.add_argument("--list", action="store_true")
    options = parser.parse_args()
    if options.list:
        for name, (variant, settings) in variants().items():
            print(f"{name}: {variant} ({', '.join(settings) or 'as it is'})")
        return
    if not options.program or not options.output:
        parser.error("needs the program and -o FOLDER")
    options.output.mkdir(parents=True, exist_ok=True)
    print(tables(run(options.program, options.scenario, options.seed, options.only, options.settings, options.output)))


if __name__ == "__main__":
    main()
