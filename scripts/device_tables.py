#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Times the step of a crowd on one device, launch by launch and beside RVO2 on the CPU's threads: Markdown.

Usage: device_tables.py THRONG RVO2_STEP [--device N] [--bandwidth GB/S] [--most PEOPLE] [--rounds N]
(`scripts/benchmark` runs it)
"""
import argparse
import json
import os
import platform
import statistics
import subprocess
import tempfile

import compare_rvo2

COUNTS = (256, 4096, 16384, 65536, 262144, 1048576)
CLOSELY = (16384, 262144)  # launch by launch
WAYS = {"diagram": "voronoi", "grid": "grid"}


def launches(options, people, way):
    """What `throng bench launches` says; of three runs the one that is median by the time of a step."""
    command = [options.program, "bench", "launches", "--people", str(people), "--proximity", WAYS[way], "--steps",
               "240", "--json"]
    command += ["--device", str(options.device)] if options.device >= 0 else []
    runs = [json.loads(subprocess.run(command, check=True, capture_output=True).stdout) for _ in range(3)]
    return sorted(runs, key=lambda run: run["step_ms"])[1]


def rvo2_ms(options, people):
    """ms a step, the median of some rounds, and on how many threads."""
    with tempfile.TemporaryDirectory() as folder:
        crowd = os.path.join(folder, "crowd.csv")
        compare_rvo2.Throng(options.program, people, "grid", crowd).close()
        peer = compare_rvo2.Rvo2(options.peer, crowd)
        rounds = max(3, min(options.rounds, 4_000_000 // people))
        times = [peer.step() for _ in range(rounds)]
        peer.close()
    return statistics.median(times), peer.threads


def whole_steps(options, found):
    lines = ["| people | diagram, ms | steps/s | grid, ms | steps/s | RVO2, ms | diagram / RVO2 | grid / RVO2 | "
             "asking, ms |", "| --- |" + " --- |" * 8]
    for people in counts(options):
        diagram, grid = found[people, "diagram"], found[people, "grid"]
        rvo2, _ = found[people, "RVO2"]
        row = [f"{people:,}"]
        for each in (diagram, grid):
            row += [f"{each['step_ms']:.3f}", f"{1000.0 / each['step_ms']:,.0f}"]
        row += [f"{rvo2:.3f}", f"{diagram['step_ms'] / rvo2:.3f}", f"{grid['step_ms'] / rvo2:.3f}",
                f"{diagram['asking_ms']:.3f}"]
        lines.append("| " + " | ".join(row) + " |")
    return "\n".join(lines)


def by_launch(told, bandwidth):
    """The launches of a step; where the bandwidth is known, also the least time that their bytes need."""
    head = ["pass", "program or transfer", "launches a step", "us a launch", "us a step", "bytes a person", "GB/s"]
    head += ["its bytes alone, us"] if bandwidth else []
    lines = ["| " + " | ".join(head) + " |", "|" + " --- |" * len(head)]
    for row in told["launches"]:
        each = 1000.0 * row["step_ms"] / row["launches"]
        amount = row["bytes_per_person"] * told["people"]
        cells = [row["pass"], f"`{row['what']}`", f"{row['launches']:.3g}", f"{each:.1f}",
                 f"{1000.0 * row['step_ms']:.1f}", str(row["bytes_per_person"] or "-"),
                 f"{amount / each / 1000.0:,.0f}" if amount else "-"]
        cells += [f"{amount / bandwidth / 1000.0:.2f}" if amount else "-"] if bandwidth else []
        lines.append("| " + " | ".join(cells) + " |")
    total = sum(row["step_ms"] for row in told["launches"])
    number = sum(row["launches"] for row in told["launches"])
    lines.append(f"| a step | | {number:.3g} | | {1000.0 * total:.1f} |" + " |" * (len(head) - 5))
    return "\n".join(lines)


def counts(options):
    return [people for people in COUNTS if people <= options.most]


def processor():
    with open("/proc/cpuinfo", encoding="utf-8") as file:
        names = [line.split(":")[1].strip() for line in file if line.startswith("model name")]
    return names[0] if names else platform.machine()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("peer")
    parser.add_argument("--device", type=int, default=-1)
    parser.add_argument("--bandwidth", type=float, default=0.0, help="of the device's memory, GB/s")
    parser.add_argument("--most", type=int, default=COUNTS[-1], help="no crowds larger than this")
    parser.add_argument("--rounds", type=int, default=101, help="of RVO2, at most")
    options = parser.parse_args()
    found = {}
    for people in counts(options):
        for way in WAYS:
            found[people, way] = launches(options, people, way)
        found[people, "RVO2"] = rvo2_ms(options, people)
    smallest = found[COUNTS[0], "diagram"]
    print(f"""{smallest['device']}; {processor()}, {os.cpu_count()} threads.

## Whole steps

ms a step among 240 that nothing waits between, two steps to a decision; "asking" is what the CPU needs to ask for a
step with the diagram. RVO2: one `doStep`, built with -O3 and OpenMP, {found[COUNTS[0], 'RVO2'][1]} threads.

{whole_steps(options, found)}
""")
    for people in CLOSELY:
        if people > options.most:
            continue
        print(f"""## Launch by launch, {people:,} people, diagram

{by_launch(found[people, 'diagram'], options.bandwidth)}
""")


if __name__ == "__main__":
    main()
