# SPDX-License-Identifier: Apache-2.0
"""The page about the passes is what the passes say."""
import json
import subprocess
import sys

import pytest

from conftest import EXAMPLES, ROOT

PASSES = ["gates", "cells", "routes", "spawn", "diagram", "sensing", "avoidance", "contacts", "motion"]


def test_the_page_is_up_to_date(throng):
    subprocess.run([sys.executable, str(ROOT / "scripts" / "passes_page.py"), throng.binary, "--check"], check=True)


def test_every_pass_is_told_of_any_layout(throng):
    told = json.loads(throng("devices", "--passes", EXAMPLES / "circle.json", "--json").stdout)
    rows = {entry["pass"]: entry["rows"] for entry in told["passes"]}
    assert list(rows) == PASSES
    assert rows["spawn"] == []  # everybody is there from the start
    steer, avoid, carry_on = rows["avoidance"]
    assert steer["what"] == "shaders/motion/steer.comp" and steer["declared"] == "avoidance"
    assert carry_on["what"] == "shaders/motion/carry_on.comp"
    assert [row["launches"] for row in (carry_on, avoid)] == pytest.approx([0.75, 0.25])
    for buffers in (steer["writes"], avoid["reads"]):
        assert "preferred velocities" in {buffer["buffer"] for buffer in buffers}


def test_the_table_says_the_same_in_words(throng):
    table = throng("devices", "--passes").stdout
    written = [line.split()[0] for line in table.splitlines() if "shaders/" in line]
    assert [name for name in PASSES if name in written] == PASSES[1:]
    assert max(map(len, table.splitlines())) <= 120
    assert "bodies 32/person" in table
