# SPDX-License-Identifier: Apache-2.0
"""Tables of how people move. Each takes Runs and returns Markdown."""

import json
import subprocess
import sys

import reading
from pages import number, span_of, table
from runs import ROOT

CROWDS = {
    "ring": "256 on a circle",
    "annulus": "4,096 on rings, everybody to the other side",
    "corridor": "two blocks of 2,048 walk through each other",
    "crossing": "two blocks of 2,048 at right angles",
    "uniform": "65,536 at one per 4 m^2 to random goals",
}
LARGE = {
    "corridor-16384": "two blocks of 8,192",
    "crossing-16384": "two blocks of 8,192",
    "annulus-16384": "on rings",
}
MOTION = ("at goal by T", "all there after", "deepest overlap, % of 2a", "overlapping pairs, % of people")
BOTTLENECKS = {"bottleneck-080": "0.8 m", "bottleneck-100": "1.0 m", "bottleneck-120": "1.2 m"}
TRAPS = ("head-on", "four-way", "pocket", "dense-start", "reversed-winding", "narrow-door", "fast-thin-wall")
SEEDS = 16
HEADWAYS = (0.0, 0.02, 0.05, 0.1, 0.18)
RADII = ((0.22, 0.28), (0.20, 0.25), (0.18, 0.22), (0.17, 0.21))


def share(figures):
    """100 % is everybody: 4,095 of 4,096 are not."""
    if figures["arrived"] == figures["agents"]:
        return "100 %"
    percent = 100.0 * figures["arrived"] / figures["agents"]
    return f"{min(percent, 99.9):.{0 if percent < 99 else 1}f} %"


def there_after(figures):
    return f"{figures['seconds']:,.0f} s" if figures["arrived"] == figures["agents"] else "-"


def motion_of(figures):
    return [
        share(figures),
        there_after(figures),
        f"{figures['deepest_overlap_percent']:.2g}",
        number(figures["overlapping_percent"]),
    ]


def with_time(runs, name, about):
    return f"{name}, {about}, T = {runs.layout(name)['simulation']['duration']:,} s"


def each_seed(runs, name, count, *settings, read=None):
    """The figures of seeds 1 to count. The first is what layouts have that name none."""
    seeds = [[f"simulation.seed={value}"] if value > 1 else [] for value in runs.seeds(count)]
    return [runs.scenario(name, *seed, *settings, read=read) for seed in seeds]


def seeds_of(found):
    return f"seeds 1 to {len(found)}" if len(found) > 1 else "seed 1"


def scenarios(runs):
    rows = []
    for name, about in CROWDS.items():
        figures = runs.scenario(name)
        if name == "uniform":  # nobody is meant to arrive in its ten seconds
            rows.append([f"uniform, {about}, 10 s", "-", "-", *motion_of(figures)[2:]])
        else:
            rows.append([with_time(runs, name, about), *motion_of(figures)])
    return table(["scenario", *MOTION], rows)


def large(runs):
    return large_crowds(runs, LARGE)


def large_streets(runs):
    return large_crowds(runs, {"streets-65536": "to the nearest of 40 exits"})


def large_ring(runs):
    crowds = {"ring-16384": "on a circle"}
    return large_crowds(runs, crowds, "simulation.proximity=grid")  # 27 million cells of diagram else


def large_crowds(runs, crowds, *settings):
    rows = []
    for name, about in crowds.items():
        figures = runs.scenario(name, *settings)
        time = f"{figures['time_ratio']:.2f}"
        rows.append(
            [
                with_time(runs, name, about),
                *motion_of(figures),
                f"{figures['stuck']:,}",
                time,
                f"{figures['mean_density']:.1f}",
                f"{figures['lane_order']:.2f}",
            ]
        )
    return table(
        [
            "scenario",
            *MOTION,
            "stuck at the end",
            "time over the free time, median",
            "mean density, persons/m^2",
            "lane order",
        ],
        rows,
    )


def holding(found):
    """How many of some seeds hold all bars, and which do not hold what."""
    missing = {}
    for seed, each in enumerate(found, 1):
        for bar in each["missed"]:
            missing.setdefault(bar.partition(" is ")[0], []).append(str(seed))
    told = "; ".join(f"{bar}: not {', '.join(which)}" for bar, which in missing.items())
    return f"{sum(not each['missed'] for each in found)} of {len(found)}" + (f" ({told})" if told else "")


def seeds(runs):
    return seeds_table(runs, ["ring", "annulus", "corridor", "crossing"])


def seeds_adults(runs):
    return seeds_table(runs, ["crossing-adults"])


def seeds_table(runs, names):
    rows = []
    for name in names:
        found = each_seed(runs, name, SEEDS)
        away = [each["furthest_off"] for each in found if "furthest_off" in each]
        rows.append(
            [
                f"{name}, {seeds_of(found)}",
                holding(found),
                f"{span_of([each['seconds'] for each in found if each['arrived'] == each['agents']], 0)} s",
                span_of([each["deepest_overlap_percent"] for each in found]),
                number(max(each["overlapping_percent"] for each in found)),
                sum(each["wall_crossings"] for each in found),
                span_of(away) if away else "",
                span_of([each["off"] for each in found], 0) if away else "",
            ]
        )
    head = [
        "scenario",
        "hold all bars",
        "all there after",
        "deepest overlap, % of 2a",
        "overlapping pairs, % of people, worst seed",
        "walls crossed",
        "who gets furthest from its street, m beyond its edge",
        "people more than 15 m beyond it",
    ]
    return table(head, rows)


def steadiness(runs):
    rows = []
    for name in ("ring", "annulus", "corridor", "crossing"):
        as_recorded, simulated = runs.scenario(name), runs.scenario(name, "simulation.smoothing=0")
        rows.append(
            [
                name,
                f"{as_recorded['acceleration']['p99']:.1f}",
                f"{simulated['acceleration']['p99']:.1f}",
                f"{as_recorded['heading_rate']['p99']:.0f}",
                f"{as_recorded['backward_percent']:.2f}",
                f"{simulated['backward_percent']:.2f}",
                f"{as_recorded['deepest_overlap_percent']:.1f}",
            ]
        )
    return table(
        [
            "",
            "acceleration, 99th percentile, m/s^2",
            "the same as simulated",
            "turning, 99th percentile, degrees/s",
            "steps backwards, %",
            "as simulated",
            "deepest overlap, % of 2a",
        ],
        rows,
    )


def doors(runs):
    rows = []
    for name in ("imo-4", *BOTTLENECKS, "rimea-9-four-exits", "rimea-9-two-exits", "rimea-11", "imo-8-50", "imo-8-100"):
        found = each_seed(runs, name, SEEDS)
        flows = [each["flow"] for each in found if "flow" in each]
        rows.append(
            [
                f"{name}, {seeds_of(found)}",
                holding(found),
                f"{span_of(flows, 2)} ({sum(flows) / len(flows):.2f} on average)" if flows else "-",
                span_of([each["seconds"] for each in found], 0),
                span_of([each["acceleration"]["p99"] for each in found]),
                span_of([each["heading_rate"]["p99"] for each in found], 0),
                span_of([each["backward_percent"] for each in found], 2),
            ]
        )
    return table(
        [
            "scenario",
            "hold all bars",
            "flow, persons/s",
            "seconds",
            "acceleration, 99th percentile, m/s^2",
            "turning, 99th percentile, degrees/s",
            "steps backwards, %",
        ],
        rows,
    )


def door_widths(runs):
    rows = []
    for value in HEADWAYS[::4] if runs.quick else HEADWAYS:
        cells = []
        for least, most in RADII:
            flows = []
            for name in BOTTLENECKS:
                figures = runs.scenario(
                    name,
                    f"formations.0.people.headway={value:g}",
                    f'formations.0.people.radius={{"uniform": [{least}, {most}]}}',
                )
                star = "" if figures["arrived"] == figures["agents"] else "*"
                flows.append(f"{figures.get('flow', 0.0):.2f}{star}")
            cells.append(" / ".join(flows))
        rows.append([f"{value:g} s" if value else "none", *cells])
    names = [f"{least:.2f} to {most:.2f} m" for least, most in RADII]
    return table(["headway", f"shoulder breadth ({names[0]})", *names[1:]], rows)


def headway(runs):
    names = ("rimea-4-050", "rimea-4-100", "rimea-4-200", "rimea-4-300")
    rows, densities = [], {name: [] for name in names}
    for value in (0.0, 0.18, 0.3):
        cells = []
        for name in names:
            given = f"formations.0.people.headway={value:g}"
            found = each_seed(runs, name, 3, given, read=reading.speed_and_density)
            densities[name] += [each["density"] for each in found]
            cells.append(f"{sum(each['speed'] / each['usual'] for each in found) / len(found):.2f}")
        rows.append([f"{value:g} s" if value else "none given (0.1 s in peace)", *cells])
    return table(["persons per m^2", *(span_of(densities[name], 2) for name in names)], rows)


def slashes(values, digits):
    return " / ".join(f"{value:.{digits}f}" for value in values)


def rooms(runs):
    rows = [*rimea_rows(runs), company_row(runs), *imo_rows(runs), *bottleneck_rows(runs), trap_row(runs)]
    return table(["scenario", "found", "bar"], rows)


def rimea_rows(runs):
    alone, corner = runs.scenario("rimea-1"), runs.scenario("rimea-6")
    densities = [runs.scenario(f"rimea-4-{name}") for name in ("050", "100", "200", "300")]
    exits = runs.scenario("rimea-10")
    nearer = runs.scenario("rimea-11")
    four, two = runs.scenario("rimea-9-four-exits"), runs.scenario("rimea-9-two-exits")
    return [
        ["rimea-1, one person, 40 m at 1.33 m/s", f"{alone['seconds']:.1f} s", "26 to 34 s"],
        [
            "rimea-4, flow of discs in a corridor at 0.5 / 1 / 2 / 3 persons per m^2, headway 0.18 s",
            f"{slashes([each.get('flow', 0.0) for each in densities], 2)} per s",
            "within 15 % of Weidmann 1993: 2.75 / 4.23 / 5.14 / 4.01",
        ],
        [
            "rimea-6, 20 people round a corner",
            f"{corner['wall_crossings']} walls crossed, bodies at most "
            f"{1000 * corner['deepest_wall_penetration']:.1f} mm in a wall",
            "nobody in a wall by 1 mm",
        ],
        [
            "rimea-9, 1,000 adults as they come, room with four exits of 1 m and with two",
            f"{four['seconds']:.0f} and {two['seconds']:.0f} s: {two['seconds'] / four['seconds']:.2f} times",
            "all leave, in 1.6 to 2.4 times the time",
        ],
        [
            f"rimea-10, {exits['agents']} people in twelve cabins, each with an exit of its own",
            f"{exits['own_exit']} take it, {exits['seconds']:.0f} s",
            "everybody takes it",
        ],
        [
            "rimea-11, 1,000 adults as they come, most of them at one end of a room with two doors of 1 m",
            f"{nearer['further']} take the one that was further from where they began, {nearer['seconds']:.0f} s",
            "most take the nearer one, some the other",
        ],
    ]


def company_row(runs):
    groups = runs.scenario("company")
    return [
        "company, 2 x 100 people in groups through each other",
        f"members within {groups['apart']:.1f} m of their group's middle (median; {groups['furthest']:.1f} m at "
        f"worst), arrive within {groups['late']:.1f} s of each other",
        "not split",
    ]


def imo_rows(runs):
    flows = [each["flow"] for each in each_seed(runs, "imo-4", SEEDS)]
    return [
        [
            f"imo-4, 100 discs as wide as shoulders, door of 1 m, headway 0.13 s, {seeds_of(flows)}",
            f"{span_of(flows, 2)} per s ({sum(flows) / len(flows):.2f} on average)",
            "at most 1.33 per s on average",
        ],
        *(counterflow_row(runs, people) for people in ("discs", "adults as they come")),
    ]


def counterflow_row(runs, people):
    def bodies(others):
        if people == "discs":  # as the layouts say
            return []
        return [f"formations.{each}.people.body=adult" for each in range(2 if others else 1)]

    times = [[each["seconds"] for each in each_seed(runs, f"imo-8-{others}", SEEDS, *bodies(others))]
             for others in (0, 10, 50, 100)]
    longer = sum(list(each) == sorted(each) for each in zip(*times))
    return [
        f"imo-8, 100 {people} against 0 / 10 / 50 / 100 in a corridor 2 m wide, {seeds_of(times[0])}",
        f"{slashes([sum(each) / len(each) for each in times], 0)} s on average; {longer} of {len(times[0])} hold",
        "more take longer",
    ]


def trap_row(runs):
    traps = {name: runs.scenario(f"trap-{name}")["missed"] for name in TRAPS}
    missed = "; ".join(f"{name}: {', '.join(bars)}" for name, bars in traps.items() if bars)
    return [
        f"traps: {', '.join(TRAPS)}",
        missed or "all bars hold",
        "everybody arrives, nobody overlaps by more than 2 %, nobody passes a wall",
    ]


def bottleneck_rows(runs):
    for name, width in BOTTLENECKS.items():
        found = [each["flow"] for each in each_seed(runs, name, SEEDS)]
        bar = runs.layout(name)["expect"]["flow"]
        yield [
            f"bottleneck of {width}, 100 adults as they come, {seeds_of(found)}",
            f"{span_of(found, 2)} per s ({sum(found) / len(found):.2f} on average)",
            f"Kretz, Gruenebohm and Schreckenberg 2006 within 15 %: {bar['min']:.2f} to {bar['max']:.2f}",
        ]


def ablation(runs, names):
    """What scripts/ablate.py says, which keeps what it has measured itself."""
    folder = runs.folder.parent / f"ablations-{names[0]}"
    command = [sys.executable, ROOT / "scripts" / "ablate.py", runs.program, "-o", folder, "--scenario", *names]
    return subprocess.run([str(word) for word in command], check=True, stdout=subprocess.PIPE, text=True).stdout.strip()


def ablations(runs):
    return ablation(runs, ["trap-head-on"] if runs.quick else ["corridor", "crossing", "annulus"])


def ablations_doors(runs):
    names = ["imo-4", "bottleneck-080", "bottleneck-120", "rimea-9-two-exits", "rimea-11", "imo-8-50", "imo-8-100"]
    return ablation(runs, ["trap-narrow-door"] if runs.quick else names)


def rvo2_moved(runs, name):
    """What `throng measure` says of RVO2's motion in a scenario."""
    script, shorter = ROOT / "scripts" / "rvo2_motion.py", ["--seconds", "2"] if runs.quick else []

    def moved():
        folder = runs.scratch("rvo2-motion")
        command = [sys.executable, script, runs.program, "-o", folder, "--scenario", name, *shorter]
        told = subprocess.run(
            [str(word) for word in command], check=True, stdout=subprocess.PIPE, text=True, stderr=subprocess.DEVNULL
        ).stdout
        runs.scratch("rvo2-motion").rmdir()  # streams of minutes are gigabytes
        return json.loads(told.splitlines()[-1])

    return runs.known(f"RVO2, {name}", moved, script, name, shorter)


def rvo2_motion(runs):
    rows = []
    for name, about in CROWDS.items():
        figures = rvo2_moved(runs, name)
        title = f"uniform, {about}, 10 s" if name == "uniform" else with_time(runs, name, about)
        rows.append(
            [
                title,
                "-" if name == "uniform" else share(figures),
                f"{figures['deepest_overlap_percent']:.2g}",
                number(figures["overlapping_percent"], 1),
            ]
        )
    return table(["scenario", "RVO2: at goal by T", "deepest overlap, % of 2a", "overlapping pairs, % of people"], rows)
