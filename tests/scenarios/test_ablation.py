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
# Where a rule is seen at work, for how many seconds.
SEEN = {
    "imo-4": (25, ["room_by_time_to_collision", "no_braking_for_oncoming", "impatience", "no_swerving_in_crowds",
                   "cushion", "room_to_step", "headway", "symmetry_breaking", "search_beside_walls", "planted_feet",
                   "walls_ahead", "standing_fast", "contact_momentum", "routes_round_jams", "politeness", "platoons",
                   "feet", "slip", "gaps", "grid"]),
    "trap-narrow-door": (20, ["headway_in_peace"]),
    "company": (20, ["company", "waiting_for_company"]),
    "bidirectional": (8, ["kerb"]),
    "hill": (10, ["slope_pace"]),
    "station": (15, ["room_of_the_standing"]),
}


def ablate(folder, *words):
    return subprocess.run([sys.executable, SCRIPT, os.environ["THRONG_BINARY"], "-o", folder, *words], check=True,
                          capture_output=True, text=True)


def known_variants():
    spec = importlib.util.spec_from_file_location("ablate", SCRIPT)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module.variants()


def test_all_that_can_be_left_out_is_tested():
    seen = [name for _, names in SEEN.values() for name in names]
    assert sorted([*seen, "all"]) == sorted(known_variants())


@pytest.mark.parametrize("scenario", SEEN)
def test_a_rule_that_is_switched_off_changes_what_people_do_and_nothing_is_measured_twice(tmp_path, scenario):
    seconds, names = SEEN[scenario]
    words = ["--scenario", scenario, "--set", f"simulation.duration={seconds}", "--only", "all", *names]
    first = ablate(tmp_path, *words)
    rows = [json.loads(line) for line in (tmp_path / "results.jsonl").read_text().splitlines()]
    assert [row["name"] for row in rows] == ["all", *sorted(names, key=list(known_variants()).index)]
    figures = {row["name"]: [row[figure] for figure in FIGURES] for row in rows}
    whole = figures.pop("all")
    assert [name for name, row in figures.items() if row == whole] == [], figures
    again = ablate(tmp_path, *words)
    assert again.stdout == first.stdout == (tmp_path / "table.md").read_text()
    assert not again.stderr
