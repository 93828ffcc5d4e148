# SPDX-License-Identifier: Apache-2.0
"""The scenarios that motion is judged by, as users run them. Those of thousands of people are left to `throng scenarios`,
but for the two that crowds are known to jam in."""
import json
import shutil

import pytest

HOLD_ALL_BARS = [
    "ring", "rimea-1", "rimea-4-050", "rimea-4-100", "rimea-4-200", "rimea-4-300", "rimea-6", "bottleneck-100", "imo-4",
    "trap-head-on", "trap-four-way", "trap-pocket", "trap-dense-start", "trap-reversed-winding", "trap-narrow-door", "trap-fast-thin-wall",
]


@pytest.fixture(scope="module")
def scenario(throng, tmp_path_factory):
    """scenario("ring") is what `throng scenarios --json` prints of it; `expect` is its exit status."""
    folder = tmp_path_factory.mktemp("scenarios")

    def run(name, expect=0):
        figures = json.loads(throng("scenarios", "--run", name, "--json", "-o", folder, expect=expect).stdout)
        shutil.rmtree(folder / name)  # thousands of people for minutes are gigabytes
        return figures

    return run


@pytest.mark.parametrize("name", HOLD_ALL_BARS)
def test_the_bars_of_the_layout_hold(scenario, name):
    assert scenario(name)["missed"] == []


@pytest.mark.parametrize("name", ["crossing", "corridor"])
def test_streams_of_thousands_get_through_each_other(scenario, name):
    """Jams are chaotic, and another device may add in another order: the last few are not held against it here."""
    figures = scenario(name, expect=None)
    assert figures["agents"] == 4096
    assert figures["arrived"] >= 0.99 * 4096
    assert figures["deepest_overlap_percent"] < 2
    assert figures["overlapping_percent"] < 0.1
    assert figures["wall_crossings"] == 0


def test_a_counterflow_slows_a_corridor_down(scenario):
    """IMO test 8: the more come the other way, the longer it takes."""
    seconds = [scenario(f"imo-8-{others}")["seconds"] for others in (0, 10, 50, 100)]
    assert seconds == sorted(seconds)
    assert seconds[-1] > 1.5 * seconds[0]


def test_wider_doors_let_more_people_through(scenario):
    """RiMEA test 12."""
    flows = [scenario(f"bottleneck-{width}", expect=None)["flow"] for width in ("080", "100", "120")]
    assert flows == sorted(flows)
    assert flows[-1] > 1.5 * flows[0]


def test_twice_the_exits_take_about_half_the_time(scenario):
    """RiMEA test 9."""
    two, four = scenario("rimea-9-two-exits", expect=None), scenario("rimea-9-four-exits", expect=None)
    assert two["arrived"] == four["arrived"] == 1000
    assert 1.6 <= two["seconds"] / four["seconds"] <= 2.4
