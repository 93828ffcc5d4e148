# SPDX-License-Identifier: Apache-2.0
"""The script that takes rules out one by one."""
import json
import os
import pathlib
import subprocess
import sys

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "scripts" / "ablate.py"


def test_every_rule_is_found_in_the_shaders():
    subprocess.run([sys.executable, SCRIPT, "--check"], check=True)


def test_every_rule_can_be_taken_out_which_changes_what_people_do_and_nothing_is_measured_twice(tmp_path):
    command = [sys.executable, SCRIPT, os.environ["THRONG_BINARY"], "-o", tmp_path, "--scenario", "trap-narrow-door", "imo-4"]
    first = subprocess.run(command, check=True, capture_output=True, text=True)
    rows = [json.loads(line) for line in (tmp_path / "results.jsonl").read_text().splitlines()]
    assert len(rows) == 2 * 15 and all(row["agents"] == (20 if row["scenario"] == "trap-narrow-door" else 100) for row in rows)
    figures = {}
    for row in rows:
        figures.setdefault(row["variant"], []).extend(row[key] for key in ("seconds", "deepest_overlap_percent", "acceleration_p99", "backward_percent"))
    whole = figures.pop("all rules")
    assert [variant for variant, row in figures.items() if row == whole] == [], figures
    again = subprocess.run(command, check=True, capture_output=True, text=True)
    assert again.stdout == first.stdout == (tmp_path / "table.md").read_text()
    assert not again.stderr
