# SPDX-License-Identifier: Apache-2.0
"""Routes that heed the crowd."""
import json

import numpy
import pytest

HALL = {
    "throng": 1,
    "simulation": {"duration": 25},
    "walls": [{"points": [[0, -12], [0, -1]], "thickness": 0.2}, {"points": [[0, 1], [0, 4]], "thickness": 0.2},
              {"points": [[0, 6], [0, 12]], "thickness": 0.2}],
    "formations": [
        {"id": "walker", "type": "agents", "arrival": "leave",
         "agents": [{"position": [-10, 0], "goal": [10, 0], "speed": 1.3, "radius": 0.25}]},
        {"id": "waiting", "type": "grid", "origin": [-1.2, -0.65], "rows": 3, "columns": 5, "spacing": 0.6,
         "goal": {"offset": [0, 0]}, "people": {"radius": 0.25}},
    ],
}


@pytest.mark.parametrize("heeds, door, seed", [(True, 5.0, 1), (True, 5.0, 2), (True, 5.0, 3), (False, 0.0, 1)])
@pytest.mark.quick
def test_a_door_full_of_people_is_avoided(throng, tmp_path, heeds, door, seed):
    """Also a test of two rules that keep people going past others who stand: docs/motion.md says how it ends without
    them."""
    layout = {**HALL, "simulation": {**HALL["simulation"], "avoid_congestion": heeds, "seed": seed}}
    (tmp_path / "hall.json").write_text(json.dumps(layout))
    throng("bake", tmp_path / "hall.json", "-o", tmp_path / "bake", "-q", "--no-gltf")
    way = numpy.load(tmp_path / "bake" / "streams" / "pos.npy")[:, 0, :2]
    through = way[numpy.argmin(numpy.abs(way[:, 0]))]
    assert through[1] == pytest.approx(door, abs=1.1)
