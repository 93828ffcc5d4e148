# SPDX-License-Identifier: Apache-2.0
"""What whole jobs take, from the command to its last byte. Nothing else should run on the machine meanwhile."""

import json
import shutil

import fair
from benchmarks import FAMILIES
from job_watch import watch
from pages import paragraph, table
from runs import ROOT, output_of

STADIUM = {"radius": 60, "stand": 30, "exits": 16, "exit_width": 6, "people": 16384, "duration": 20}


def generated(runs, path, kind, **numbers):
    settings = [word for name, value in numbers.items() for word in ("--set", f"{name}={value}")]
    output_of(runs.program, "generate", kind, *settings, "-o", path)
    return path


def small_batch(path, count):
    (generate, _) = FAMILIES[next(iter(FAMILIES))]
    axes = [{"parameter": "seed", "range": [1, count]}]
    path.write_text(json.dumps({"throng_family": 1, "generate": generate, "axes": axes}))
    return path


def every_job(runs, folder):
    """Names, and commands that are run one after the other: later ones read what earlier ones bake."""
    shorter = ["--set", "simulation.duration=2"] if runs.quick else []
    people, scenarios = (10_000, 4) if runs.quick else (1_000_000, 1000)
    stadium = generated(runs, folder / "stadium.json", "stadium", **STADIUM)
    marathon = generated(runs, folder / "marathon.json", "marathon", people=people, waves=10, duration=100)
    stands = folder / "fair.json"
    stands.write_text(json.dumps(fair.layout()))
    family = small_batch(folder / "family.json", scenarios)
    street, ring = folder / "intersection", folder / "stadium"

    def bake(layout, to):
        return [runs.program, "bake", layout, "-o", to, "--json", *shorter]

    return {
        "`bake` of `intersection`: 1,024 people, 120 s": bake(ROOT / "examples" / "intersection.json", street),
        "`bake` of a stadium: 16,384 people, 20 s": bake(stadium, ring),
        "`bake` of a fair: 1,025 people with 3,075 goals of their own, 478 wall segments, 60 s": bake(
            stands, folder / "fair"
        ),
        f"`batch` of {scenarios:,} corridors: 200 people, 5 s": [
            runs.program,
            "batch",
            family,
            "-o",
            folder / "batch",
            "--quiet",
        ],
        "`preview` of `intersection` to MP4: 2,880 frames": [
            runs.program,
            "preview",
            street,
            "-o",
            folder / "street.mp4",
        ],
        "`preview` of the stadium to MP4: 480 frames": [runs.program, "preview", ring, "-o", folder / "ring.mp4"],
        "`report` of `intersection`": [runs.program, "report", street, "-o", folder / "street.html"],
        "`report` of the stadium": [runs.program, "report", ring, "-o", folder / "ring.html"],
        "`measure` of `intersection`": [runs.program, "measure", street],
        "`measure` of the stadium": [runs.program, "measure", ring],
        f"`check` of a marathon's start: {people:,} people": [runs.program, "check", marathon],
    }


def seconds(value):
    if value is None:
        return "-"
    return f"{value:.2f}" if value < 10 else f"{value:.1f}"


def row(name, took):
    parts = ["-"] * 4
    if took["first"] is not None:
        parts = [
            seconds(took["first"]),
            seconds(took["last"] - took["first"]),
            seconds(took["wall"] - took["last"]),
            seconds(took["frames"]),
        ]
    return [name, seconds(took["wall"]), seconds(took["processor"]), *parts, f"{took['memory']:.0f}"]


def jobs(runs):
    folder = runs.scratch("jobs")
    rows = [row(name, watch(command)) for name, command in every_job(runs, folder).items()]
    shutil.rmtree(folder)
    head = [
        "job",
        "in all, s",
        "of processors, s",
        "until the first frame",
        "frames",
        "after the last frame",
        "of a processor: recording and writing",
        "memory at most, MiB",
    ]
    return "\n\n".join([paragraph("One run each, one after the other."), table(head, rows)])
