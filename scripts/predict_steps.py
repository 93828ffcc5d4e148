#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Predicts steps per second on a GPU that is not at hand: Markdown, for docs/benchmarks/predicted.md.

The program counts the launches of a step and the bytes that each must read and write (`throng bench launches`, on any
device). A launch takes what it takes for nobody (asking, starting, chains of dependent reads) and a time that grows
with its bytes; both are fitted to what was measured launch by launch on one GPU (docs/benchmarks/h100/steps.md). On
another one, the second part goes with the bandwidth of its memory, by its data sheet.

Usage: predict_steps.py THRONG [--gpu NAME=GB/S ...] [--people N ...]
"""
import argparse
import json
import pathlib
import re
import statistics
import subprocess
from typing import NamedTuple

ROOT = pathlib.Path(__file__).resolve().parent.parent
MEASURED = ROOT / "docs" / "benchmarks" / "h100" / "steps.md"
BANDWIDTH = 3350.0  # GB/s, of the GPU measured, by its data sheet
GPUS = {"NVIDIA H100 SXM": 3350.0, "NVIDIA A100 SXM 80 GB": 2039.0, "NVIDIA RTX 4090": 1008.0,
        "NVIDIA RTX 3060 12 GB": 360.0, "NVIDIA L4": 300.0, "NVIDIA RTX 4060": 272.0}  # GB/s, by their data sheets
PEOPLE = (16384, 262144)


class Cost(NamedTuple):
    """What one launch takes, us: for nobody, and for each person."""
    alone: float
    a_person: float


def rows_below(text, heading):
    table = text[text.index(heading):].split("\n\n", 2)[1]
    return [[cell.strip(" `") for cell in line.strip("|").split("|")] for line in table.splitlines()[2:]]


def number(cell):
    return float(cell.replace(",", ""))


def whole_steps(text):
    """Of each number of people, ms a step with the diagram."""
    table = text[text.index("## Whole steps"):]
    lines = [line for line in table.splitlines() if re.match(r"\| [\d,]+ \|", line)]
    return {int(number(cells[0])): number(cells[1]) for cells in (line.strip("| ").split("|") for line in lines)}


def measured_launches(text, people):
    """Of each program, how often it runs in a step and how long once, us."""
    rows = rows_below(text, f"## Launch by launch, {people:,} people")
    return {row[1]: (number(row[2]), number(row[3])) for row in rows if row[3]}


def fitted(text):
    """Reading the device's clock before each launch takes a while, too: what whole steps need is what remains."""
    whole = whole_steps(text)
    small, large = (measured_launches(text, people) for people in PEOPLE)
    clock = [(sum(often * each for often, each in table.values()) - 1000.0 * whole[people]) /
             sum(often for often, _ in table.values()) for people, table in zip(PEOPLE, (small, large))]
    costs = {}
    for program, (_, few) in small.items():
        few, many = few - clock[0], large[program][1] - clock[1]
        slope = max(many - few, 0.0) / (PEOPLE[1] - PEOPLE[0])
        costs[program] = Cost(few - slope * PEOPLE[0], slope)
    return costs


def counted(program):
    """The launches of a step as this program makes it: (pass, what, launches, bytes a person)."""
    told = subprocess.run([program, "bench", "launches", "--people", "16384", "--steps", "8", "--json"], check=True,
                          capture_output=True, text=True)
    return [(each["pass"], each["what"], each["launches"], each["bytes_per_person"])
            for each in json.loads(told.stdout)["launches"]]


def cost_of(what, size, costs, sizes):
    """What is new since the measurement costs what the middle one of the others does for its bytes."""
    if what in costs:
        return costs[what]
    per_byte = statistics.median(cost.a_person / sizes[each] for each, cost in costs.items()
                                 if sizes.get(each))
    return Cost(statistics.median(cost.alone for cost in costs.values()), per_byte * size)


def predicted(launches, costs, people, bandwidth):
    """us a step of each launch: (pass, what, us)."""
    sizes = {what: size for _, what, _, size in launches}
    found = []
    for name, what, often, size in launches:
        cost = cost_of(what, size, costs, sizes)
        found.append((name, what, often * (cost.alone + cost.a_person * people * BANDWIDTH / bandwidth)))
    return found


def by_pass(found):
    passes = {}
    for name, _, time in found:
        passes[name] = passes.get(name, 0.0) + time
    return passes


def least(launches, people, bandwidth):
    """us a step that the bytes alone need."""
    return sum(often * size * people for _, _, often, size in launches) / bandwidth / 1000.0


def table_of_gpus(launches, costs, gpus, counts):
    lines = ["| GPU | GB/s | people | ms a step | steps/s | its bytes alone, ms | most of it: pass (share), launch |",
             "| --- | ---: | ---: | ---: | ---: | ---: | --- |"]
    for name, bandwidth in gpus.items():
        for people in counts:
            found = predicted(launches, costs, people, bandwidth)
            step = sum(time for _, _, time in found)
            passes = by_pass(found)
            longest = max(passes, key=passes.get)
            launch = max(found, key=lambda each: each[2])[1]
            lines.append(f"| {name} | {bandwidth:,.0f} | {people:,} | {step / 1000:.3f} | {1e6 / step:,.0f} | "
                         f"{least(launches, people, bandwidth) / 1000:.3f} | {longest} "
                         f"({100 * passes[longest] / step:.0f} %), `{launch}` |")
    return "\n".join(lines)


def table_of_passes(launches, costs, gpus, people):
    names = list(by_pass(predicted(launches, costs, people, BANDWIDTH)))
    lines = ["| GPU, us a step | " + " | ".join(names) + " |", "| --- |" + " ---: |" * len(names)]
    for gpu, bandwidth in gpus.items():
        passes = by_pass(predicted(launches, costs, people, bandwidth))
        lines.append(f"| {gpu} | " + " | ".join(f"{passes[name]:,.0f}" for name in names) + " |")
    return "\n".join(lines)


def as_measured(launches, text):
    """The launches of the program that was measured, as often in a step as it made them."""
    often = {what: each for what, (each, _) in measured_launches(text, PEOPLE[0]).items()}
    return [(name, what, often[what], size) for name, what, _, size in launches if what in often]


def table_of_trust(then, costs, whole):
    """Of the launches that were measured, the sizes that were not fitted."""
    lines = ["| people | predicted, ms | measured, ms | off by |", "| ---: | ---: | ---: | ---: |"]
    for people, time in whole.items():
        step = sum(each[2] for each in predicted(then, costs, people, BANDWIDTH)) / 1000.0
        fitted_to = " (fitted to)" if people in PEOPLE else ""
        lines.append(f"| {people:,} | {step:.3f} | {time:.3f}{fitted_to} | {100 * (step / time - 1):+.0f} % |")
    return "\n".join(lines)


def tables(program, gpus=None, counts=PEOPLE):
    gpus, text = gpus or GPUS, MEASURED.read_text(encoding="utf-8")
    costs, launches = fitted(text), counted(program)
    return "\n".join([
        table_of_gpus(launches, costs, gpus, counts),
        f"\nPass by pass, {counts[-1]:,} people:\n",
        table_of_passes(launches, costs, gpus, counts[-1]),
        "\nThe GPU that was measured, with the launches that it was measured with:\n",
        table_of_trust(as_measured(launches, text), costs, whole_steps(text))])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--gpu", action="append", default=[], metavar="NAME=GB/S")
    parser.add_argument("--people", type=int, action="append")
    options = parser.parse_args()
    gpus = {name: float(speed) for name, speed in (each.rsplit("=", 1) for each in options.gpu)} or GPUS
    counts = options.people or list(PEOPLE)
    print(tables(options.program, gpus, counts))


if __name__ == "__main__":
    main()
