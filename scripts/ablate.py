#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What each rule of motion buys: bakes scenarios with one rule after the other taken out of the shaders, measures them and writes a table.

Usage: ablate.py THRONG -o FOLDER [--scenario corridor crossing] [--only 3 4 ...]
       ablate.py --check     whether every rule is still found in the shaders

What has been measured stays in FOLDER/results.jsonl and is not measured again while program, shaders and layout are the same.
"""
import argparse
import hashlib
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent

NO_BRAKING_RULE = ("anticipation.glsl", "along *= 1.0 - max(oncoming, manners.impatience);", "along *= 1.0 - manners.impatience;")
NO_IMPATIENCE = ("anticipation.glsl", "return clamp((nervousness - PATIENT) / (IMPATIENT - PATIENT), 0.0, 1.0);", "return 0.0;")
NO_HEADWAY_IN_PEACE = ("anticipation.glsl", "const float HEADWAY_IN_PEACE = 0.1;", "const float HEADWAY_IN_PEACE = 0.0;")
NO_STANDING_FAST = ("contact.comp", "bracing * STANDING_FAST * smoothstep", "bracing * 1.0e-6 * smoothstep")

# name in the table: (name for --only, edits of shaders [(file, what stands there, what takes its place)], settings).
# Edits leave every uniform in use: the program sets them all.
VARIANTS = {
    "all rules": ("all", [], []),
    "people brake for oncoming people, too (no rule 3)": ("3", [NO_BRAKING_RULE], []),
    "nobody grows impatient (no rule 4)": ("4", [NO_IMPATIENCE], []),
    "neither rule 3 nor rule 4": ("3+4", [NO_BRAKING_RULE, NO_IMPATIENCE], []),
    "people swerve for those who cross, however dense the crowd (no rule 5)": (
        "5", [("anticipation.glsl", "float crowding = clamp((float(sensed) - SWERVE_FREELY) / (SWERVE_NO_MORE - SWERVE_FREELY), 0.0, 1.0);", "float crowding = 0.0;")], []),
    "routes do not heed jams (no rule 6)": ("6", [], ["simulation.avoid_congestion=false"]),
    "the stuck do not look for another way (no rule 7)": ("7", [("steer.comp", "float despair = smoothstep(0.7, 0.95, nervousness);",
              "float despair = steps_done == 0u ? nervousness : 0.0;")], []),
    "platoons do not spread (no headway in peace, rule 8)": ("8", [NO_HEADWAY_IN_PEACE], []),
    "who is carried off does not stand fast (no rule 10)": ("10", [NO_STANDING_FAST], []),
    "neither of these two": ("8+10", [NO_HEADWAY_IN_PEACE, NO_STANDING_FAST], []),
    "nobody plants its feet (no rule 11)": (
        "11", [("avoid.comp", "if (in_traffic && isUnderWay(walker))", "if (in_traffic && in_peace && !in_peace)"),
               ("move.comp", "if (!stops && length(wish) > STANDING_SPEED) return", "if (false) return")], []),
    "who is pushed back plants its feet, and does not slip past": ("slip", [("feet.glsl", "const float SLIP = 1.5;", "const float SLIP = 0.0;")], []),
    "no cushion, no room to step": (
        "gaps", [("anticipation.glsl", "vec2 touch = cushion(offset, relative, reach) * patience;", "vec2 touch = vec2(0.0);"),
                 ("anticipation.glsl", "const float FOLLOWING_GAP = 0.1;", "const float FOLLOWING_GAP = 0.0;")], []),
    "contact without Chebyshev's weights": ("weights", [("contact.comp", "position = mix(targets_after[slot], position, momentum);",
                 "position = mix(targets_after[slot], position, min(momentum, 1.0));")], []),
    "everybody senses exactly (the grid) instead of through the diagram": ("grid", [], ["simulation.proximity=grid"]),
}


def edited_shaders(edits, folder, shaders=ROOT / "shaders"):
    """A copy of the shaders without a rule. Raises ValueError where the rule is not where it should be."""
    shutil.copytree(shaders, folder)
    for file, found, instead in edits:
        path = pathlib.Path(folder) / file
        text = path.read_text()
        if text.count(found) != 1:
            raise ValueError(f"shaders/{file} has `{found}` {text.count(found)} times, not once")
        path.write_text(text.replace(found, instead))
    return folder


def hash_of(*things):
    """Of files, folders and whatever can be printed."""
    known = hashlib.sha256()
    for thing in things:
        files = sorted(path for path in thing.rglob("*") if path.is_file()) if isinstance(thing, pathlib.Path) and thing.is_dir() else [thing]
        for each in files:
            known.update(each.read_bytes() if isinstance(each, pathlib.Path) else repr(each).encode())
    return known.hexdigest()[:16]


def measured(program, scenario, edits, settings, shaders):
    """What `throng measure` says of a bake without the rule."""
    with tempfile.TemporaryDirectory() as scratch:
        shaders = edited_shaders(edits, pathlib.Path(scratch) / "shaders", shaders)
        bake = pathlib.Path(scratch) / "bake"
        subprocess.run([program, "bake", ROOT / "scenarios" / f"{scenario}.json", "-o", bake, "--no-gltf", "-q", "--shader-dir", shaders,
                        *(word for each in settings for word in ("--set", each))], check=True, stdout=subprocess.DEVNULL)
        result = subprocess.run([program, "measure", bake, "--json"], stdout=subprocess.PIPE, check=False)
        if result.returncode not in (0, 1):  # 1: a bar is missed
            raise SystemExit(result.returncode)
        return json.loads(result.stdout)


def table(rows):
    lines = ["| scenario | | at goal by T | all there after | deepest overlap, % of 2a | overlapping pairs, % of people | acceleration, 99th percentile | steps backwards |",
             "| --- | --- | --- | --- | --- | --- | --- | --- |"]
    for row in rows:
        after = f"{row['seconds']:.0f} s" if row["arrived"] == row["agents"] else "-"
        lines.append(f"| {row['scenario']} | {row['variant']} | {row['arrived']:,} | {after} | {row['deepest_overlap_percent']:.1f} | {row['overlapping_percent']:.3f} "
                     f"| {row['acceleration_p99']:.1f} m/s^2 | {row['backward_percent']:.2f} % |")
    return "\n".join(lines)


def row_of(scenario, variant, report):
    return {"scenario": scenario, "variant": variant, "agents": report["agents"], "arrived": report["arrived"], "seconds": report["seconds"],
            "deepest_overlap_percent": report["deepest_overlap_percent"], "overlapping_percent": report["overlapping_percent"],
            "acceleration_p99": report["acceleration"]["p99"], "backward_percent": report["backward_percent"]}


def check():
    for _, edits, _ in VARIANTS.values():
        with tempfile.TemporaryDirectory() as scratch:
            edited_shaders(edits, pathlib.Path(scratch) / "shaders")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", nargs="?")
    parser.add_argument("-o", "--output", type=pathlib.Path)
    parser.add_argument("--scenario", nargs="+", default=["corridor", "crossing"])
    parser.add_argument("--only", nargs="+", default=[], choices=[short for short, _, _ in VARIANTS.values()])
    parser.add_argument("--check", action="store_true")
    options = parser.parse_args()
    if options.check:
        check()
        return
    if not options.program or not options.output:
        parser.error("needs the program and -o FOLDER")
    options.output.mkdir(parents=True, exist_ok=True)
    known = options.output / "results.jsonl"
    earlier = [json.loads(line) for line in known.read_text().splitlines()] if known.exists() else []
    rows = []
    with tempfile.TemporaryDirectory() as scratch:
        shaders = edited_shaders([], pathlib.Path(scratch) / "shaders")  # as they are now, whatever is edited meanwhile
        for scenario in options.scenario:
            for variant, (short, edits, settings) in VARIANTS.items():
                if options.only and short not in options.only:
                    continue
                of = hash_of(pathlib.Path(options.program), shaders, ROOT / "scenarios" / f"{scenario}.json", edits, settings)
                row = next((row for row in earlier if row["of"] == of), None)
                if not row:
                    print(f"{scenario}: {variant} ...", file=sys.stderr, flush=True)
                    row = {**row_of(scenario, variant, measured(options.program, scenario, edits, settings, shaders)), "of": of}
                    with known.open("a") as file:
                        file.write(json.dumps(row) + "\n")
                rows.append(row)
                (options.output / "table.md").write_text(table(rows) + "\n")
    print(table(rows))


if __name__ == "__main__":
    main()
