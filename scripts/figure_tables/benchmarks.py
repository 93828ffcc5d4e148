# SPDX-License-Identifier: Apache-2.0
"""Tables of times. Each takes Runs and returns Markdown. Nothing else should run on the machine meanwhile."""

import csv
import json
import shutil
import subprocess
import sys
import tempfile

from pages import paragraph, table
from runs import ROOT, on_one_core, output_of

sys.path.insert(0, str(ROOT / "scripts"))
import compare_rvo2  # noqa: E402
import predict_steps  # noqa: E402
import rvo2_peer  # noqa: E402

DRAWING_ALONE = "gradient1, drawing alone"


def benched(runs, kind):
    """The CSV of `throng bench KIND`: its rows, and where it is."""
    rounds = ["--rounds", "1", "--most", "300"] if runs.quick else []

    def timed():
        folder = runs.scratch(f"bench-{kind}")
        output_of(runs.program, "bench", kind, "-o", folder, *rounds)
        return (folder / f"{kind}.csv").read_text()

    text = runs.known(f"bench {kind}", timed, "bench", kind, rounds)
    target = runs.docs / "benchmarks" / "llvmpipe" / f"{kind}.csv"
    target.write_text(text)
    subprocess.run([sys.executable, ROOT / "scripts" / "plot_benchmarks.py", target.parent], check=True)
    return list(csv.DictReader(text.splitlines()))


def in_order(rows, key):
    return list(dict.fromkeys(row[key] for row in rows))


def by_case(rows, cell):
    """A table of methods by cases; `cell` makes text of a row."""
    measured = [row for row in rows if row["source"] == "measured"]
    cases = list(dict.fromkeys((int(row["sites"]), row["radius_px"]) for row in measured))
    found = {(row["method"], int(row["sites"])): cell(row) for row in measured}
    lines = [
        [method, *(found.get((method, sites), "-") for sites, _ in cases)] for method in in_order(measured, "method")
    ]
    return table(["method", *(f"{sites:,} r {radius}" for sites, radius in cases)], lines)


def milliseconds(text):
    value = float(text)
    return f"{value:.2f}" if value < 10 else f"{value:.1f}" if value < 100 else f"{value:.0f}"


def wrong_pixels(row):
    percent = 100.0 * float(row["wrong_share"])
    return "0" if percent == 0.0 else f"{percent:.4f} %" if percent < 0.01 else f"{percent:.2f} %"


def diagrams(runs):
    rows = benched(runs, "diagrams")
    times = by_case(
        rows,
        lambda row: f"{milliseconds(row['median_ms'])} ({milliseconds(row['p10_ms'])}-"
        f"{milliseconds(row['p90_ms'])})",
    )
    ratios = by_case(rows, lambda row: f"{float(row['ratio']):.2f}")
    took = [f"{row['took']} at {int(row['sites']):,}" for row in rows if row.get("took")]
    return "\n\n".join(
        [
            "Milliseconds, median (10th to 90th percentile):",
            times,
            *([paragraph(f"`auto` took {'; '.join(took)}.")] if took else []),
            f'Ratio to "{DRAWING_ALONE}", median over the rounds:',
            ratios,
            "Pixels with a wrong owner, against comparing all sites on the CPU:",
            by_case(rows, wrong_pixels),
        ]
    )


def proximity(runs):
    rows = benched(runs, "proximity")
    ways, counts = in_order(rows, "way"), in_order(rows, "people")
    head = ["way", *(f"{int(count):,}" for count in counts)]

    def matrix(cell):
        found = {(row["way"], row["people"]): cell(row) for row in rows}
        return table(head, [[way, *(found.get((way, count), "-") for count in counts)] for way in ways])

    return "\n\n".join(
        [
            "Finding neighbours, ms a step (median), by number of people:",
            matrix(lambda row: milliseconds(row["search_ms"])),
            "The whole step, ms (median):",
            matrix(lambda row: milliseconds(row["step_ms"])),
            "Recall of the nearest neighbours:",
            matrix(lambda row: f"{100.0 * float(row['recall']):.3f} %"),
        ]
    )


def rvo2(runs):
    counts = [1024, 4096] if runs.quick else [4096, 16384, 65536, 262144, 1048576]
    rounds = 2 if runs.quick else 15
    program, peer = str(runs.program), str(rvo2_peer.build(ROOT / "build" / "rvo2"))

    def memory():  # twice: the first fills the driver's cache of shaders, and compiling takes memory, too
        compare_rvo2.base_memory_of(program, peer)
        return compare_rvo2.base_memory_of(program, peer)

    base = runs.known("memory of one person", memory, "base memory")
    with tempfile.TemporaryDirectory() as folder:
        found = [
            runs.known(
                f"{people:,} people beside RVO2",
                lambda people=people: compare_rvo2.compare(program, peer, people, rounds, folder),
                "rvo2",
                people,
                rounds,
            )
            for people in counts
        ]
    sizes = [people for people in counts if people >= 16384] or counts
    flat = runs.known("how flat it is", lambda: compare_rvo2.flatness(program, sizes, rounds), "flat", sizes, rounds)
    flat = {name: {int(people): cost for people, cost in costs.items()} for name, costs in flat.items()}
    return compare_rvo2.tables(found, base, flat, rounds)


STEP_PASSES = ("cells", "diagram", "sensing", "avoidance", "contacts", "motion")


def step(runs):
    bench = runs.program.parent / "bench" / "throng_bench"
    small = "wholeStep/256/"
    only = "wholeStep/4096/|stepOverGradient1" if runs.quick else "wholeStep/[0-9]{4,}/|stepOverGradient1"

    def measured(which):
        return json.loads(output_of(bench, "--benchmark_format=json", f"--benchmark_filter={which}"))

    def small_crowds():
        """As bakes have them (cli/baking/baker.cpp)."""
        with on_one_core():
            return measured(small)

    alone = runs.known("steps of small crowds", small_crowds, bench, small)
    told = runs.known("the step beside one diagram", lambda: measured(only), bench, only)
    told["benchmarks"] = alone["benchmarks"] + told["benchmarks"]
    benches = {each["name"].split("/")[0]: each for each in told["benchmarks"]}
    pair = benches["stepOverGradient1"]
    rows = [
        [
            f"{int(each['name'].split('/')[1]):,}",
            milliseconds(each["real_time"]),
            *(f"{each[name]:.2f}" if name in each else "-" for name in passes_of(each)),
        ]
        for each in told["benchmarks"]
        if each["name"].startswith("wholeStep/")
    ]
    whole = next(each for each in told["benchmarks"] if each["name"].startswith("wholeStep/"))
    return "\n\n".join(
        [
            paragraph(
                f"Whole step of 16,384 people {pair['step_ms']:.1f} ms, gradient1 diagram {pair['gradient1_ms']:.1f} "
                f"ms, ratio (median of pairs) **{pair['ratio']:.2f}**. 256 people step on one thread, as in bakes."
            ),
            table(["people", "step", *passes_of(whole)], rows),
        ]
    )


def predicted(runs):
    """Of GPUs that are not at hand: nothing of this machine is in it but counts."""
    return predict_steps.tables(str(runs.program))


def passes_of(bench):
    """The counters of a whole step: its passes, in their order where that is known."""
    usual = {
        "name",
        "family_index",
        "per_family_instance_index",
        "run_name",
        "run_type",
        "repetitions",
        "repetition_index",
        "threads",
        "iterations",
        "real_time",
        "cpu_time",
        "time_unit",
    }
    names = [name for name in bench if name not in usual]
    return sorted(names, key=lambda name: STEP_PASSES.index(name) if name in STEP_PASSES else len(STEP_PASSES))


FAMILIES = {
    "a corridor of 40 x 8 m, 200 people (20 a second from either end), 5 s at 24 frames/s and 2 steps a frame": (
        {"kind": "corridor", "length": 40, "width": 8, "forth": 20, "back": 20, "duration": 5},
        1000,
    ),
    "a plaza of 30 m with 12 random pillars, four exits, 200 people, 5 s": (
        {"kind": "plaza", "size": 30, "rate": 40, "duration": 5},
        200,
    ),
}
COSTS = """SELECT count(*) AS scenarios, avg(agents) AS people, 1000 * avg(load_seconds) AS load_ms,
    1000 * avg(setup_seconds) AS setup_ms, 1000 * avg(simulate_seconds) AS simulate_ms,
    1000 * avg(total_seconds - simulate_seconds) AS beyond_ms,
    (SELECT max(peak_memory_mib) FROM scenarios WHERE number <= 100) AS memory_first,
    max(peak_memory_mib) AS memory_all FROM scenarios"""


def batch_costs(runs, generate, count):
    family = {"throng_family": 1, "generate": generate, "axes": [{"parameter": "seed", "range": [1, count]}]}

    def baked():
        folder = runs.scratch("batch")
        (folder / "family.json").write_text(json.dumps(family))
        output_of(runs.program, "batch", folder / "family.json", "-o", folder / "out", "--quiet")
        told = json.loads(output_of(runs.program, "batch", "query", folder / "out", "--json", "--sql", COSTS))
        shutil.rmtree(folder)
        return told[0]

    return runs.known(f"a batch of {count:,}: {generate['kind']}", baked, "batch", json.dumps(family), COSTS)


def batch(runs):
    parts = []
    for about, (generate, count) in FAMILIES.items():
        count = 4 if runs.quick else count
        cost = batch_costs(runs, generate, count)
        rows = [
            ["simulation, mean", f"{cost['simulate_ms']:.0f} ms"],
            ["reading the layout, making the scene", f"{cost['load_ms']:.1f} ms"],
            ["setting up the simulation", f"{cost['setup_ms']:.1f} ms"],
            ["**beyond the simulation, mean**", f"**{cost['beyond_ms']:.0f} ms**"],
            [
                "memory of a worker, first 100 scenarios, all",
                f"{cost['memory_first']:.0f} MiB, {cost['memory_all']:.0f} MiB",
            ],
        ]
        parts += [paragraph(f"{count:,} scenarios: {about}, seeds 1 to {count:,}."), table(["", ""], rows)]
    return "\n\n".join(parts)
