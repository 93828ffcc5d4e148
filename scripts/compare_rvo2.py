#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Times whole steps of Throng and of RVO2 in turn, over the same crowd, and prints tables.

RVO2 is built from source with -O3 and OpenMP (scripts/rvo2_peer.py) and uses all threads.

Usage: compare_rvo2.py THRONG RVO2_STEP [--people 4096 16384 ...] [--rounds 15]   (`scripts/figures rvo2` runs it)
"""
import argparse
import os
import statistics
import subprocess
import tempfile
import time

def memory_kib(process, key="VmRSS"):
    with open(f"/proc/{process}/status") as file:
        return int(next(line for line in file if line.startswith(key)).split()[1])


class Throng:
    """`throng bench step`, told when to step."""

    def __init__(self, program, people, proximity, crowd=None):
        command = [program, "bench", "step", "--people", str(people), "--proximity", proximity]
        command += ["--crowd", crowd] if crowd else []
        self.process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        self.device = self.process.stdout.readline().strip()

    def step(self):
        self.process.stdin.write("\n")
        self.process.stdin.flush()
        return float(self.process.stdout.readline())

    def memory_kib(self):
        return memory_kib(self.process.pid)

    def close(self):
        self.process.stdin.close()
        self.process.wait()


class Rvo2:
    """`rvo2_step`: the reference library as those who use it from C++ build it, on all threads."""

    def __init__(self, program, crowd):
        self.process = subprocess.Popen([program, crowd], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        self.threads = int(self.process.stdout.readline().split()[0])

    memory_kib, close = Throng.memory_kib, Throng.close

    def step(self):
        taken = Throng.step(self)
        time.sleep(0.02)  # its threads go on spinning for some ms, on the processors of whoever comes next
        return taken


def compare(program, peer, people, rounds, folder):
    crowd = os.path.join(folder, f"crowd-{people}.csv")
    contestants = {"diagram": Throng(program, people, "voronoi", crowd), "grid": Throng(program, people, "grid")}
    contestants["RVO2"] = Rvo2(peer, crowd)
    for _ in range(2):
        for contestant in contestants.values():
            contestant.step()
    times = {name: [] for name in contestants}
    for _ in range(rounds):
        for name, contestant in contestants.items():
            times[name].append(contestant.step())
    memory = {name: contestant.memory_kib() for name, contestant in contestants.items()}
    device, threads = contestants["diagram"].device, contestants["RVO2"].threads
    for contestant in contestants.values():
        contestant.close()
    return {"people": people, "device": device, "threads": threads, "memory": memory,
            "ms": {name: statistics.median(values) for name, values in times.items()}}


def flatness(program, counts, rounds):
    """What a person costs in crowds of several sizes, taken in turn, as the machine is now faster and now slower.

    @returns {proximity: {count: (us, ratio)}}; the ratio to the smallest crowd's is the median over the rounds
    """
    result = {}
    for name, proximity in (("diagram", "voronoi"), ("grid", "grid")):
        crowds = {people: Throng(program, people, proximity) for people in counts}
        costs = {people: [] for people in counts}
        for i in range(rounds + 1):
            for people, crowd in crowds.items():
                cost = 1000.0 * statistics.median(crowd.step() for _ in range(max(1, 262144 // people))) / people
                if i > 0:  # the first warms up
                    costs[people].append(cost)
        for crowd in crowds.values():
            crowd.close()
        base = costs[counts[0]]
        ratios = {people: [cost / least for cost, least in zip(costs[people], base)] for people in counts}
        result[name] = {people: (statistics.median(costs[people]), statistics.median(ratios[people]))
                        for people in counts}
    return result


def flatness_table(found):
    counts = list(found["diagram"])
    lines = ["| people | " + " | ".join(f"{people:,}" for people in counts) + " |", "| --- |" + " --- |" * len(counts)]
    for name, costs in found.items():
        lines.append(f"| {name}, us a person | " + " | ".join(f"{costs[people][0]:.3f}" for people in counts) + " |")
        beside = [f"{100.0 * (costs[people][1] - 1.0):+.0f} %" for people in counts]
        lines.append(f"| {name}, beside {counts[0]:,} | " + " | ".join(beside) + " |")
    return "\n".join(lines)


def table(results, base_memory):
    lines = ["| people | Throng, diagram | Throng, grid | RVO2 | diagram / RVO2 | grid / RVO2 | "
             "us a person: diagram | grid | RVO2 | KiB a person: diagram | grid | RVO2 |",
             "| --- |" + " --- |" * 11]
    for r in results:
        ms, n = r["ms"], r["people"]
        each = [f"{1000 * ms[k] / n:.3f}" for k in ("diagram", "grid", "RVO2")]
        kib = [f"{(r['memory'][k] - base_memory[k]) / n:.2f}" for k in ("diagram", "grid", "RVO2")]
        whole = [f"{ms[k]:.2f}" for k in ("diagram", "grid", "RVO2")]
        ratios = [f"{ms[k] / ms['RVO2']:.2f}" for k in ("diagram", "grid")]
        lines.append(f"| {n:,} | " + " | ".join(whole + ratios + each + kib) + " |")
    return "\n".join(lines)


def base_memory_of(program, peer):
    """What the programs need for one person: driver, shaders and threads, kept out of the memory a person."""
    base = {}
    with tempfile.TemporaryDirectory() as folder:
        crowd = os.path.join(folder, "one.csv")
        contestants = {"diagram": Throng(program, 1, "voronoi", crowd), "grid": Throng(program, 1, "grid")}
        contestants["RVO2"] = Rvo2(peer, crowd)
        for name, contestant in contestants.items():
            contestant.step()
            base[name] = contestant.memory_kib()
            contestant.close()
    return base


def tables(results, base_memory, flat, rounds):
    """What docs/benchmarks/llvmpipe/rvo2.md holds."""
    threads = results[0]["threads"]
    return f"""RVO2 built with -O3 and OpenMP, {threads} threads. Medians of {rounds} rounds, ms a step.

{table(results, base_memory)}

**How flat it is.** Whole steps of crowds of several sizes in turn, {rounds} rounds; ratios are medians over the rounds.

{flatness_table(flat)}"""


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("peer")
    parser.add_argument("--people", type=int, nargs="+", default=[4096, 16384, 65536, 262144, 1048576])
    parser.add_argument("--rounds", type=int, default=15)
    options = parser.parse_args()
    base_memory_of(options.program, options.peer)  # fills the driver's cache of shaders: compiling takes memory, too
    with tempfile.TemporaryDirectory() as folder:
        results = [compare(options.program, options.peer, people, options.rounds, folder)
                   for people in options.people]
    large = [people for people in options.people if people >= 16384] or options.people[:1]
    flat = flatness(options.program, large, options.rounds)
    print(tables(results, base_memory_of(options.program, options.peer), flat, options.rounds))


if __name__ == "__main__":
    main()
