# SPDX-License-Identifier: Apache-2.0
"""RiMEA's test 8: a building of three storeys empties, and how fast people walk is seen in how long that takes."""
import csv
import json

import numpy
import pytest

from conftest import ROOT

LAYOUT = json.loads((ROOT / "scenarios" / "rimea-8.json").read_text())
WIDTH = LAYOUT["links"][0]["width"]  # m
MOST_DOWN = 1.1  # persons/(s m): IMO MSC.1/Circ.1533, table 1.2


def emptied(throng, folder, *settings):
    throng("bake", ROOT / "scenarios" / "rimea-8.json", "-o", folder, "-q", "--no-gltf",
           *(word for setting in settings for word in ("--set", setting)))
    figures = json.loads(throng("measure", folder, "--json", expect=None).stdout)
    with open(folder / "agents.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    storeys = numpy.array([int(row["group"][-1]) for row in rows])
    out = numpy.array([int(row["arrival_frame"] or -1) for row in rows]) / 24.0
    return figures, storeys, out


@pytest.fixture(scope="module")
def speeds(throng, tmp_path_factory):
    """{m/s: what was measured} of everybody walking as fast."""
    folder = tmp_path_factory.mktemp("building")
    return {speed: emptied(throng, folder / str(speed), *(f"formations.{i}.people.speed={speed}" for i in range(3)))
            for speed in (0.8, 1.3)}


@pytest.mark.slow
def test_everybody_is_out_the_lower_storeys_first(speeds):
    for figures, storeys, out in speeds.values():
        assert figures["agents"] == figures["arrived"] == 240 and figures["wall_crossings"] == 0
        middle = [numpy.median(out[storeys == storey]) for storey in range(3)]
        assert middle == sorted(middle)
        # Those who come down the upper stairs and those of the first floor go down the lower ones together.
        assert out[storeys == 0].max() < min(out[storeys == storey].max() for storey in (1, 2))


@pytest.mark.slow
def test_everybody_walks_down_the_stairs_below_its_storey(speeds):
    for figures, _, _ in speeds.values():
        first, second = figures["links"]
        assert (first["back"] - first["forward"], second["back"] - second["forward"]) == (160, 80)
        assert max(first["specific_flow"], second["specific_flow"]) < 1.2 * MOST_DOWN


@pytest.mark.slow
def test_stairs_take_no_more_than_has_been_counted(throng, tmp_path, speeds):
    """Over three crowds; of one, up to a fifth more."""
    figures = [speeds[1.3][0]] + [emptied(throng, tmp_path / str(seed), f"simulation.seed={seed}",
                                          *(f"formations.{i}.people.speed=1.3" for i in range(3)))[0]
                                  for seed in (2, 3)]
    flows = numpy.array([[link["specific_flow"] for link in each["links"]] for each in figures])
    assert flows.mean(axis=0).max() < MOST_DOWN and flows.max() < 1.2 * MOST_DOWN


@pytest.mark.slow
def test_wider_stairs_take_more_and_no_more_than_has_been_counted(throng, tmp_path, speeds):
    wide, _, out = emptied(throng, tmp_path / "wide", "links.0.width=1.6", "links.1.width=1.6",
                           *(f"formations.{i}.people.speed=1.3" for i in range(3)))
    assert wide["arrived"] == 240 and out.max() < 0.9 * speeds[1.3][2].max()
    assert max(link["specific_flow"] for link in wide["links"]) < MOST_DOWN


@pytest.mark.slow
def test_who_walks_slower_takes_longer(speeds):
    slow, fast = speeds[0.8][2], speeds[1.3][2]
    assert 1.2 < numpy.median(slow) / numpy.median(fast) < 1.3 / 0.8 + 0.1
    # Nobody flies: 24 m of corridor and hall and two flights of 4.6 m in plan, at 0.69 m/s at most on those.
    assert fast[-80:].min() > 2 * 4.6 / 0.69 + 5.0 / 1.3
