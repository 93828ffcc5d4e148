# SPDX-License-Identifier: Apache-2.0
"""Tables of people above people. Scripts of their own make them, which say more by `--help`."""

import sys

from runs import ROOT, output_of


def by_script(runs, name, seeds):
    script, numbers = ROOT / "scripts" / name, runs.seeds(seeds)
    words = [sys.executable, script, runs.program, *(["--quick"] if runs.quick else []), "--seeds", *numbers]
    return runs.known(f"{name}, seeds {numbers}", lambda: output_of(*words).strip(), script, numbers, runs.quick)


def stairs(runs):
    return by_script(runs, "stair_flows.py", 3)


def building(runs):
    return by_script(runs, "building_out.py", 3)
