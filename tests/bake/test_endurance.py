# SPDX-License-Identifier: Apache-2.0
"""Memory stays flat and nothing slows down in long work: scripts/endurance, for as long as a test may take. Its own
figures are in docs/benchmarks/endurance.md."""
import os
import subprocess
import sys

import pytest

from conftest import ROOT

TOO_SHORT = 2
HOURS = [("hours", 10), ("hours", 24), ("hours", 24, 4), ("hours", 24, 16)]
SCENARIOS = [("batch", 200), ("batch", 600), ("batch", 2000)]


@pytest.fixture
def endure(throng):
    def run(*words, **environment):
        return subprocess.run([sys.executable, ROOT / "scripts" / "endurance", *map(str, words)], text=True,
                              capture_output=True, env={**os.environ, "THRONG_BINARY": throng.binary, **environment})

    return run


@pytest.fixture
def endure_long_enough(endure):
    """The first of several works that takes long enough to tell: machines differ by more than ten times."""
    def run(*works, **environment):
        for work in works:
            told = endure(*work, **environment)
            if told.returncode != TOO_SHORT:
                break
        return told

    return run


def growth_in(told):
    return float(told.split(" MiB per ")[0].split()[-1])


@pytest.mark.slow
def test_a_long_bake_needs_no_more_memory_with_its_time(endure_long_enough, tmp_path):
    told = endure_long_enough(*HOURS, TMPDIR=str(tmp_path))
    assert "MiB per hour" in told.stdout, told.stderr
    assert growth_in(told.stdout) < 1.0, told.stdout


@pytest.mark.slow
def test_a_leak_of_fifty_bytes_a_frame_and_stream_would_be_seen(endure_long_enough, faults, tmp_path):
    told = endure_long_enough(*HOURS, TMPDIR=str(tmp_path), LD_PRELOAD=str(faults), THRONG_LEAK="50")
    assert told.returncode == 1 and growth_in(told.stdout) >= 1.0, told.stdout + told.stderr


@pytest.mark.slow
def test_a_worker_needs_no_more_memory_with_its_scenarios(endure_long_enough, tmp_path):
    told = endure_long_enough(*SCENARIOS, TMPDIR=str(tmp_path))
    assert "MiB per thousand" in told.stdout, told.stderr
    assert growth_in(told.stdout) < 20.0, told.stdout  # 4 MiB in the fewest
