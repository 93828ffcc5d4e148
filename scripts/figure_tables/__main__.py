# SPDX-License-Identifier: Apache-2.0
"""The command line of scripts/figures."""

import argparse
import pathlib
import shutil
import sys
import time
import typing

import benchmarks
import blender
import bodies
import jobs
import motion
import pages
import storeys
from runs import ROOT, Runs


class Table(typing.NamedTuple):
    page: str
    minutes: int  # expected, on two idle cores without a GPU
    make: typing.Callable


TABLES = {
    "scenarios": Table("motion-validation.md", 8, motion.scenarios),
    "rvo2-motion": Table("motion-validation.md", 15, motion.rvo2_motion),
    "seeds": Table("motion-validation.md", 30, motion.seeds),
    "large": Table("motion-validation.md", 150, motion.large),
    "rooms": Table("motion-validation.md", 12, motion.rooms),
    "door-widths": Table("motion-validation.md", 8, motion.door_widths),
    "headway": Table("motion-validation.md", 3, motion.headway),
    "steadiness": Table("motion-validation.md", 8, motion.steadiness),
    "doors": Table("motion-validation.md", 5, motion.doors),
    "stairs": Table("motion-validation.md", 5, storeys.stairs),
    "building": Table("motion-validation.md", 4, storeys.building),
    "bodies": Table("motion-validation.md", 25, bodies.bodies),
    "ablations": Table("motion-notebook.md", 80, motion.ablations),
    "ablations-doors": Table("motion-notebook.md", 60, motion.ablations_doors),
    "diagrams": Table("benchmarks/llvmpipe/diagrams.md", 15, benchmarks.diagrams),
    "proximity": Table("benchmarks/llvmpipe/proximity.md", 3, benchmarks.proximity),
    "rvo2": Table("benchmarks/llvmpipe/rvo2.md", 10, benchmarks.rvo2),
    "step": Table("benchmarks/step.md", 2, benchmarks.step),
    "predicted": Table("benchmarks/predicted.md", 1, benchmarks.predicted),
    "jobs": Table("benchmarks/jobs.md", 12, jobs.jobs),
    "batch": Table("benchmarks/batch.md", 3, benchmarks.batch),
    "blender": Table("benchmarks/blender.md", 15, blender.blender),
}


def arguments():
    parser = argparse.ArgumentParser(prog="scripts/figures", description="Makes the tables of figures in docs/ anew.")
    parser.add_argument("names", nargs="*", metavar="NAME", help="only these; by default all")
    parser.add_argument("--list", action="store_true", help="name the tables, with the minutes that each takes")
    parser.add_argument(
        "--quick",
        action="store_true",
        help="a trial: one seed, some seconds of each scenario, into a copy in build/figures/docs",
    )
    parser.add_argument(
        "--program",
        type=pathlib.Path,
        default=ROOT / "build" / "release" / "throng",
        help="measure this program instead of building one from the checkout",
    )
    options = parser.parse_args()
    unknown = [name for name in options.names if name not in TABLES]
    if unknown:
        parser.error(f"no table is called {', '.join(unknown)}: --list names them")
    return options


def list_tables():
    width = max(map(len, TABLES))
    for name, made in TABLES.items():
        print(f"{name:{width}}  {made.minutes:4} min  docs/{made.page}")
    print(f"{'all':{width}}  {sum(made.minutes for made in TABLES.values()):4} min")


def main():
    options = arguments()
    if options.list:
        list_tables()
        return
    docs, results = ROOT / "docs", ROOT / "build" / "figures" / "results"
    if options.quick:
        docs = ROOT / "build" / "figures" / "docs"
        shutil.rmtree(docs, ignore_errors=True)
        shutil.copytree(ROOT / "docs", docs)
    names = options.names or list(TABLES)
    for name in names:  # before hours are spent
        pages.place_of(name, (docs / TABLES[name].page).read_text())
    runs = Runs(options.program, results, docs, options.quick)
    for name in names:
        start = time.monotonic()
        print(f"{name}:", file=sys.stderr, flush=True)
        body = TABLES[name].make(runs)
        pages.put(docs / TABLES[name].page, name, f"{body}\n\n{pages.paragraph(runs.stamp(name))}")
        print(
            f"{name}: {(time.monotonic() - start) / 60:.1f} min, {docs / TABLES[name].page}",
            file=sys.stderr,
            flush=True,
        )


if __name__ == "__main__":
    main()
