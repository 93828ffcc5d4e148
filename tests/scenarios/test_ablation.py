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
    command = [sys.executable, SCRIPT, os.environ["THRONG_BINARY"], "-o", tmp_path, "--scenario", "trap-narrow-door"]
    first = subprocess.run(command, check=True, capture_output=True, text=True)
    rows = {row["variant"]: row for row in (json.loads(line) for line in (tmp_path / "results.jsonl").read_text().splitlines())}
    assert len(rows) == 14 and all(row["agents"] == 20 for row in rows.values())
    figures = {variant: [row[key] for key in ("seconds", "deepest_overlap_percent", "acceleration_p99", "backward_percent")] for variant, row in rows.items()}
    whole = figures.pop("all rules")
    unchanged = {variant for variant, row in figures.items() if row == whole}
    assert unchanged <= {"everybody senses exactly (the grid) instead of through the diagram"}, figures
    again = subprocess.run(command, check=True, capture_output=True, text=True)
    assert again.stdout == first.stdout == (tmp_path / "table.md").read_text()
    assert not again.stderr
