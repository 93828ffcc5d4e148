# SPDX-License-Identifier: Apache-2.0
"""The command line of scripts/figures."""

import argparse
import concurrent.futures
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
from runs import ROOT, Runs, on_one_core


class Table(typing.NamedTuple):
    page: str
    minutes: int  # expected, on two idle cores without a GPU
    make: typing.Callable
    timed: bool = False  # has figures of time, so nothing else may be at work meanwhile


TABLES = {
    "scenarios": Table("motion-validation.md", 8, motion.scenarios),
    "rvo2-motion": Table("motion-validation.md", 15, motion.rvo2_motion),
    "seeds": Table("motion-validation.md", 60, motion.seeds),
    "seeds-adults": Table("motion-validation.md", 30, motion.seeds_adults),
    "large": Table("motion-validation.md", 45, motion.large),
    "large-ring": Table("motion-validation.md", 100, motion.large_ring),
    "large-streets": Table("motion-validation.md", 25, motion.large_streets),
    "rooms": Table("motion-validation.md", 12, motion.rooms),
    "door-widths": Table("motion-validation.md", 8, motion.door_widths),
    "headway": Table("motion-validation.md", 3, motion.headway),
    "steadiness": Table("motion-validation.md", 8, motion.steadiness),
    "doors": Table("motion-validation.md", 12, motion.doors),
    "stairs": Table("motion-validation.md", 5, storeys.stairs),
    "building": Table("motion-validation.md", 4, storeys.building),
    "bodies": Table("motion-validation.md", 25, bodies.bodies),
    "ablations": Table("motion-notebook.md", 80, motion.ablations),
    "ablations-doors": Table("motion-notebook.md", 60, motion.ablations_doors),
    "diagrams": Table("benchmarks/llvmpipe/diagrams.md", 15, benchmarks.diagrams, timed=True),
    "proximity": Table("benchmarks/llvmpipe/proximity.md", 3, benchmarks.proximity, timed=True),
    "rvo2": Table("benchmarks/llvmpipe/rvo2.md", 10, benchmarks.rvo2, timed=True),
    "step": Table("benchmarks/step.md", 2, benchmarks.step, timed=True),
    "predicted": Table("benchmarks/predicted.md", 1, benchmarks.predicted, timed=True),
    "jobs": Table("benchmarks/jobs.md", 12, jobs.jobs, timed=True),
    "batch": Table("benchmarks/batch.md", 3, benchmarks.batch, timed=True),
    "blender": Table("benchmarks/blender.md", 15, blender.blender, timed=True),
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
    parser.add_argument(
        "--jobs",
        type=int,
        default=1,
        metavar="N",
        help="N tables at once, each on one core; those with figures of time come after them, one by one",
    )
    options = parser.parse_args()
    if options.jobs < 1:
        parser.error("--jobs takes 1 or more")
    unknown = [name for name in options.names if name not in TABLES]
    if unknown:
        parser.error(f"no table is called {', '.join(unknown)}: --list names them")
    return options


def list_tables():
    width = max(map(len, TABLES))
    for name, made in TABLES.items():
        print(f"{name:{width}}  {made.minutes:4} min  docs/{made.page}")
    print(f"{'all':{width}}  {sum(made.minutes for made in TABLES.values()):4} min")


def made(runs, name):
    start = time.monotonic()
    print(f"{name}:", file=sys.stderr, flush=True)
    body = TABLES[name].make(runs)
    print(f"{name}: {(time.monotonic() - start) / 60:.1f} min", file=sys.stderr, flush=True)
    return f"{body}\n\n{pages.paragraph(runs.stamp(name))}"


def made_at_once(runs, names, jobs):
    """Those that take longest first."""
    names = sorted(names, key=lambda name: -TABLES[name].minutes)
    with on_one_core(), concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        running = {pool.submit(made, runs, name): name for name in names}
        for done in concurrent.futures.as_completed(running):
            yield running[done], done.result()


def made_in_turn(runs, names):
    for name in names:
        yield name, made(runs, name)


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
    at_once = [name for name in names if options.jobs > 1 and not TABLES[name].timed]
    in_turn = [name for name in names if name not in at_once]
    for found in (made_at_once(runs, at_once, options.jobs), made_in_turn(runs, in_turn)):
        for name, text in found:
            pages.put(docs / TABLES[name].page, name, text)


if __name__ == "__main__":
    main()
