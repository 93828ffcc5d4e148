# SPDX-License-Identifier: Apache-2.0
"""Every rule of motion can be switched off, and does something."""
import importlib.util
import json
import os
import pathlib
import subprocess
import sys

import pytest

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "scripts" / "ablate.py"
FIGURES = ("arrived", "seconds", "deepest_overlap_percent", "acceleration_p99", "backward_percent", "way")
# Where a rule is seen at work that is not seen at the door of imo-4, and for how many seconds it is looked at.
AT_THE_DOOR = "imo-4"
SECONDS = {AT_THE_DOOR: 25, "trap-narrow-door": 20, "company": 20, "bidirectional": 8, "hill": 10, "station": 15}
ELSEWHERE = {"headway_in_peace": "trap-narrow-door", "company": "company", "waiting_for_company": "company",
             "kerb": "bidirectional", "slope_pace": "hill", "room_of_the_standing": "station"}


def ablate(folder, *words):
    return subprocess.run([sys.executable, SCRIPT, os.environ["THRONG_BINARY"], "-o", folder, *words], check=True,
                          capture_output=True, text=True)


def known_variants():
    spec = importlib.util.spec_from_file_location("ablate", SCRIPT)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module.variants()


@pytest.mark.parametrize("scenario", SECONDS)
def test_a_rule_that_is_switched_off_changes_what_people_do_and_nothing_is_measured_twice(tmp_path, scenario):
    names = [name for name in known_variants() if name == "all" or ELSEWHERE.get(name, AT_THE_DOOR) == scenario]
    words = ["--scenario", scenario, "--set", f"simulation.duration={SECONDS[scenario]}", "--only", *names]
    first = ablate(tmp_path, *words)
    rows = [json.loads(line) for line in (tmp_path / "results.jsonl").read_text().splitlines()]
    assert [row["name"] for row in rows] == names
    figures = {row["name"]: [row[figure] for figure in FIGURES] for row in rows}
    whole = figures.pop("all")
    assert [name for name, row in figures.items() if row == whole] == [], figures
    again = ablate(tmp_path, *words)
    assert again.stdout == first.stdout == (tmp_path / "table.md").read_text()
    assert not again.stderr
