# SPDX-License-Identifier: Apache-2.0
"""`throng measure` against figures worked out here from the same streams, in another language."""
import csv
import json
import struct

import numpy
import pytest

from test_bakes import SMALL, crossings, deepest_overlap, streams, write


def measured(throng, bake, *arguments, expect=0):
    return json.loads(throng("measure", bake, "--json", *arguments, expect=expect).stdout)


def rows(bake):
    with open(bake / "agents.csv", newline="") as file:
        return list(csv.DictReader(file))


@pytest.fixture(scope="module")
def crossing(bakes, throng):
    bake = bakes("intersection")
    return bake, measured(throng, bake)


def test_the_account_is_that_of_the_bake(crossing, manifest_of):
    bake, figures = crossing
    account = manifest_of(bake)["account"]
    for key in ("agents", "arrived", "walking", "refused"):
        assert figures[key] == account[key]
    last = max(int(row["arrival_frame"]) for row in rows(bake) if row["arrival_frame"])
    fps = manifest_of(bake)["fps"]
    assert figures["seconds"] == pytest.approx(last / fps if figures["arrived"] == figures["agents"]
                                               else figures["duration"], rel=1e-5)


def test_overlaps_and_walls_agree_with_an_independent_look(crossing, manifest_of):
    bake, figures = crossing
    deepest, pairs = deepest_overlap(bake, 1)
    assert figures["deepest_overlap_percent"] == pytest.approx(max(deepest, 0.0), abs=1e-3)
    count, depth = crossings(bake, manifest_of(bake))
    assert figures["wall_crossings"] == count == 0
    assert figures["deepest_wall_penetration"] == pytest.approx(max(depth, 0.0), abs=2e-3)


def test_motion_agrees_with_numpy(throng, bakes, manifest_of):
    bake = bakes("circle")
    figures = measured(throng, bake)
    fps = manifest_of(bake)["fps"]
    data = streams(bake)
    position, facing = (numpy.asarray(data[name][:, :, :2], dtype=float) for name in ("pos", "dir"))
    arrival = numpy.array([int(row["arrival_frame"] or 10**9) for row in rows(bake)])
    frames = numpy.arange(len(position))[:, None]
    velocity = numpy.diff(position, axis=0) * fps
    speed = numpy.hypot(velocity[..., 0], velocity[..., 1])
    walking = (frames[1:] < arrival) & (speed >= 0.1)
    turn = numpy.abs(numpy.arctan2(facing[:-1, :, 0] * facing[1:, :, 1] - facing[:-1, :, 1] * facing[1:, :, 0],
                                   (facing[:-1] * facing[1:]).sum(axis=2))) * 180 / numpy.pi * fps
    assert figures["heading_rate"]["p99"] == pytest.approx(numpy.percentile(turn[walking], 99), abs=1.5)
    assert figures["heading_rate"]["worst"] == pytest.approx(turn[walking].max(), rel=1e-3)
    acceleration = numpy.linalg.norm(numpy.diff(velocity, axis=0), axis=2) * fps
    assert figures["acceleration"]["p99"] == pytest.approx(numpy.percentile(acceleration[walking[1:]], 99), abs=0.05)
    assert figures["acceleration"]["worst"] == pytest.approx(acceleration[walking[1:]].max(), rel=1e-3)
    backward = ((velocity * facing[1:]).sum(axis=2) < -0.05) & walking
    assert figures["backward_percent"] == pytest.approx(100 * backward.sum() / walking.sum(), rel=1e-3)
    way = (numpy.hypot(*numpy.moveaxis(numpy.diff(position, axis=0), 2, 0)) * (frames[1:] < arrival)).sum(axis=0)
    straight = numpy.linalg.norm(position[numpy.minimum(arrival, len(position) - 1),
                                          numpy.arange(len(arrival))] - position[0], axis=1)
    arrived = arrival < len(position)
    shortest = numpy.maximum(straight, [float(row["shortest_way"]) for row in rows(bake)])
    assert figures["detour_ratio"] == pytest.approx(numpy.median((way / shortest)[arrived]), rel=1e-3)
    assert 3.35 < figures["effort"] < 6.0


def test_the_shortest_way_leads_round_walls(throng, tmp_path):
    layout = {"throng": 1, "simulation": {"duration": 30}, "walls": [{"points": [[10, -5], [10, 5]], "thickness": 0.2}],
              "areas": [{"id": "goal", "polygon": [[20, -1], [22, -1], [22, 1], [20, 1]]}],
              "formations": [{"id": "one", "type": "grid", "origin": [0, 0], "rows": 1, "columns": 1, "goal": "goal",
                              "arrival": "leave",
                              "people": {"speed": 1.3, "radius": 0.25}}]}
    throng("bake", write(tmp_path / "detour.json", layout), "-o", tmp_path / "bake", "-q", "--no-gltf")
    corner = 5.0 + 0.1 + 0.25  # the end of the wall, and half a body
    shortest = numpy.hypot(10.0, corner) + numpy.hypot(10.0, corner - 1.0)
    assert float(rows(tmp_path / "bake")[0]["shortest_way"]) == pytest.approx(shortest, rel=0.04)
    figures = measured(throng, tmp_path / "bake")
    assert figures["detour_ratio"] == pytest.approx(1.0, abs=0.06)
    assert figures["time_ratio"] == pytest.approx(1.05, abs=0.08)


def test_a_line_counts_those_who_cross_it(throng, tmp_path, manifest_of):
    lane = {"throng": 1, "simulation": {"duration": 40},
            "roads": [{"id": "r", "centreline": [[0, 0], [30, 0]], "width": 4}],
            "flows": [{"id": "f", "from": "r:start", "to": "r:end", "count": 40, "end": 20}]}
    throng("bake", write(tmp_path / "lane.json", lane), "-o", tmp_path / "bake", "-q", "--no-gltf")
    figures = measured(throng, tmp_path / "bake", "--line", "15", "-2", "15", "2")
    position = streams(tmp_path / "bake")["pos"][:, :, 0] + manifest_of(tmp_path / "bake")["origin"][0]
    passed = numpy.nonzero((position[:-1] < 15) & (position[1:] >= 15))[0]
    fps = manifest_of(tmp_path / "bake")["fps"]
    flow = (len(passed) - 1) / ((passed.max() - passed.min()) / fps) / 4.0
    assert figures["specific_flow"] == pytest.approx(flow, rel=1e-3)
    assert "flow over the line" in throng("measure", tmp_path / "bake", "--line", "15", "-2", "15", "2").stdout


def test_density_is_known_for_people_on_a_grid(throng, tmp_path):
    # Bodies that stay where they are, 0.8 m apart: a cell of 0.64 m^2 inside the grid.
    block = {"throng": 1, "simulation": {"duration": 1},
             "formations": [{"id": "b", "type": "grid", "origin": [0, 0], "rows": 30, "columns": 30, "spacing": 0.8,
                             "goal": {"offset": [0, 0]}}]}
    throng("bake", write(tmp_path / "block.json", block), "-o", tmp_path / "bake", "-q", "--no-gltf")
    figures = measured(throng, tmp_path / "bake")
    assert figures["high_density"] == pytest.approx(1 / 0.64, rel=0.06)
    assert figures["mean_speed"] < 0.05


def test_bars_of_the_layout_decide_the_exit_code(throng, tmp_path):
    for bar, code in (({"arrived": {"min": 0.0}, "wall_crossings": {"max": 0}}, 0), ({"arrived": {"min": 1.0}}, 1)):
        layout = {**SMALL, "expect": bar}
        throng("bake", write(tmp_path / "bars.json", layout), "-o", tmp_path / "bake", "--force", "-q", "--no-gltf")
        told = throng("measure", tmp_path / "bake", expect=code)
        assert ("arrived is" in told.stderr and "expected at least 1" in told.stderr) == (code == 1)
        assert len(measured(throng, tmp_path / "bake", expect=code)["missed"]) == code
    wrong = write(tmp_path / "wrong.json", {**SMALL, "expect": {"arived": {"min": 1}, "stuck": {}}})
    told = throng("check", wrong, expect=3).stderr
    assert "did you mean `arrived`?" in told and "says neither `min` nor `max`" in told


def test_plots_are_drawn_and_damage_is_told(throng, tmp_path):
    throng("bake", write(tmp_path / "small.json", SMALL), "-o", tmp_path / "bake", "-q", "--no-gltf")
    throng("measure", tmp_path / "bake", "--plots", tmp_path / "plots")
    for name in ("arrivals", "overlaps", "speed_by_density"):
        assert struct.unpack(">I", (tmp_path / "plots" / f"{name}.png").read_bytes()[16:20])[0] == 1200
    stream = tmp_path / "bake" / "streams" / "dir.npy"
    stream.write_bytes(stream.read_bytes()[:-40])
    assert "dir.npy" in throng("measure", tmp_path / "bake", expect=3).stderr


def test_scenarios_bake_and_measure_themselves(throng, tmp_path):
    names = throng("scenarios", "--list").stdout.split()
    assert {"ring", "annulus", "corridor", "crossing"} <= set(names)
    told = json.loads(throng("scenarios", "--run", "ring", "--json", "-o", tmp_path).stdout)
    assert told["agents"] == told["arrived"] == 256 and told["seconds"] < 101 and told["wall_crossings"] == 0
    assert told["overlapping_percent"] < 0.1 and told["deepest_overlap_percent"] < 2 and told["missed"] == []
    assert throng("check", tmp_path / "ring.json").returncode == 0
    cut = throng("scenarios", "--run", "ring", "--json", "-o", tmp_path, "--set", "simulation.duration=5", expect=1)
    assert json.loads(cut.stdout)["missed"] == ["arrived is 0, expected at least 1"]
    assert "there are: annulus" in throng("scenarios", "--run", "rong", expect=2).stderr


def test_formations_of_rings_and_counted_grids_stand_where_they_should(throng, tmp_path, manifest_of):
    layout = {"throng": 1, "simulation": {"duration": 0.2},
              "formations": [{"id": "r", "type": "circle", "centre": [0, 0], "radius": 10, "count": 100,
                              "ring_spacing": 2, "along": 2},
                             {"id": "g", "type": "grid", "origin": [40, 0], "rows": 4, "columns": 3, "count": 10,
                              "goal": {"mirror": [[50, 0], [50, 1]]}}]}
    throng("bake", write(tmp_path / "f.json", layout), "-o", tmp_path / "bake", "-q", "--no-gltf")
    start = streams(tmp_path / "bake")["pos"][0, :, :2] + numpy.array(manifest_of(tmp_path / "bake")["origin"][:2])
    radii = numpy.hypot(*start[:100].T)
    # 2 pi 10 / 2 = 31.4, then 37.7 and 43.98: rings of 31, 37 and, of the last 43, the 32 that are left.
    assert [int((abs(radii - r) < 0.01).sum()) for r in (10, 12, 14)] == [31, 37, 32]
    assert numpy.allclose(start[100:], [[40 + i // 4, i % 4] for i in range(10)], atol=1e-3)
    goals = [(float(row["goal_x"]), float(row["goal_y"])) for row in rows(tmp_path / "bake")][100:]
    assert numpy.allclose(goals, [[60 - i // 4, i % 4] for i in range(10)], atol=1e-3)
    wrong = {**layout, "formations": [{**layout["formations"][1], "count": 13}]}
    told = throng("check", write(tmp_path / "w.json", wrong), expect=3).stderr
    assert "`count` (13) is more than 4 rows of 3 hold" in told
