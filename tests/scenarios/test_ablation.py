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


def test_a_scenario_is_measured_with_and_without_a_rule_and_only_once(tmp_path):
    command = [sys.executable, SCRIPT, os.environ["THRONG_BINARY"], "-o", tmp_path, "--scenario", "trap-head-on", "--only", "all", "gaps"]
    first = subprocess.run(command, check=True, capture_output=True, text=True)
    rows = [json.loads(line) for line in (tmp_path / "results.jsonl").read_text().splitlines()]
    assert [row["variant"] for row in rows] == ["all rules", "no cushion, no room to step"]
    assert all(row["agents"] == 2 and row["arrived"] == 2 for row in rows)
    again = subprocess.run(command, check=True, capture_output=True, text=True)
    assert again.stdout == first.stdout == (tmp_path / "table.md").read_text()
    assert not again.stderr
