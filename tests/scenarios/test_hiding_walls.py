# SPDX-License-Identifier: Apache-2.0
"""Walls that people look over, and walls that hide them (simulation.walls_hide)."""
import json

import numpy
import pytest


def way(throng, folder, name, height, hide, others):
    """Of somebody who walks along a wall, and perhaps others on its other side."""
    agent = lambda x, y, goal: {"position": [x, y], "goal": [goal, y], "speed": 1.3, "radius": 0.25}
    told = {"throng": 1, "simulation": {"duration": 10, "walls_hide": hide, "avoid_congestion": False},
            "walls": [{"points": [[-9, 0], [9, 0]], "thickness": 0.1, "height": height},
                      *({"points": [[-12, y], [12, y]]} for y in (-9, 9))],  # so that the site is as large
            "formations": [{"id": "one", "type": "agents", "agents": [agent(-6, -0.5, 6)]}]}
    if others:
        told["formations"].append({"id": "others", "type": "agents",
                                   "agents": [agent(x, 0.5, -x) for x in (-4, -2, 2, 4, 6)]})
    (folder / f"{name}.json").write_text(json.dumps(told))
    throng("bake", folder / f"{name}.json", "-o", folder / name, "-q", "--no-gltf")
    return numpy.load(folder / name / "streams" / "pos.npy")[:, 0]


@pytest.mark.quick
def test_nobody_makes_room_for_those_behind_a_high_wall(throng, tmp_path):
    for height, hide, is_same in ((3, True, True), (1.5, True, True), (1.0, True, False), (3, False, False)):
        alone, beside = (way(throng, tmp_path, f"{height}-{hide}-{others}", height, hide, others)
                         for others in (False, True))
        assert numpy.array_equal(alone, beside) == is_same, (height, hide)


@pytest.mark.quick
def test_who_comes_round_a_high_corner_is_seen_late(throng, tmp_path):
    """Two meet at the corner of a hedge: the higher it is, the later they turn aside."""
    def bake(height):
        agent = lambda position, goal: {"position": position, "goal": goal, "speed": 1.4, "radius": 0.25}
        told = {"throng": 1, "simulation": {"duration": 9, "walls_hide": True, "avoid_congestion": False},
                "walls": [{"closed": True, "points": [[0.5, 0.5], [9, 0.5], [9, 9], [0.5, 9]], "height": height}],
                "formations": [{"id": "two", "type": "agents",
                                "agents": [agent([6, 0.1], [-6, 0.1]), agent([0.1, 5.9], [0.1, -6])]}]}
        (tmp_path / f"{height}.json").write_text(json.dumps(told))
        throng("bake", tmp_path / f"{height}.json", "-o", tmp_path / str(height), "-q", "--no-gltf")
        return numpy.load(tmp_path / str(height) / "streams" / "pos.npy")[:, :2, :2]

    low, high = bake(0.8), bake(2.5)
    differ = numpy.argmax(numpy.abs(low - high).max((1, 2)) > 0.01)
    apart = numpy.hypot(*(low[differ, 0] - low[differ, 1]))
    assert differ > 0 and apart > 1.5, (differ, apart)
    for each in (low, high):
        assert numpy.hypot(*(each[:, 0] - each[:, 1]).T).min() > 0.49
