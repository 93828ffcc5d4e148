# SPDX-License-Identifier: Apache-2.0
"""Who is on stairs is nowhere to be felt by people on the floor below them, and the other way round."""
import json

import numpy
import pytest


def box(x0, y0, x1, y1):
    return [[x0, y0], [x1, y0], [x1, y1], [x0, y1]]


# From (-7, 0) up to a gallery: people stand upright below it from x = -3.15 on, and it is as near to its lower end as
# people sense up to x = -2.
FLIGHT = {"path": [[-7, 0], [0, 0]], "width": 2}
BENT = {"path": [[-1, -4.2], [-5, -4.2], [-5, 0], [0, 0]], "width": 1.6}
BELOW = {"straight": (FLIGHT, (-2.65, -0.5), ("west", "top", "north")),
         "half turn": (BENT, (-0.6, -0.4), ("top", "west", "edge"))}


def layout(stairs, origin, way, climb):
    """Six people who stand in a box below stairs, and thirty who walk over these, or stay on their floor."""
    begin, beyond, beside = way
    levels = [{"id": "hall", "floor": box(-20, -10, 10, 10)},
              {"id": "gallery", "height": 4, "floor": box(0, -6, 16, 6)}]
    places = [[origin[0] + 0.5 * (i % 2), origin[1] + 0.5 * (i // 2)] for i in range(6)]
    below = {"id": "below", "type": "agents", "arrival": "stay",
             "agents": [{"position": place, "goal": place} for place in places]}
    fence = box(origin[0] - 0.35, origin[1] - 0.35, origin[0] + 0.85, origin[1] + 1.35)
    flows = [{"id": "walkers", "from": begin, "to": beyond if climb else beside, "count": 30, "end": 8}]
    return {"throng": 1, "simulation": {"duration": 45, "smoothing": 0, "walls_hide": True}, "levels": levels,
            "links": [{"id": "stairs", "from": "hall", "to": "gallery", **stairs}],
            "walls": [{"id": "fence", "points": [*fence, fence[0]], "thickness": 0.05, "height": 2.5}],
            "areas": [{"id": "west", "polygon": box(-16, -7, -12, 7)},
                      {"id": "north", "polygon": box(-16, 8, -12, 9.5)},
                      {"id": "edge", "level": "gallery", "polygon": box(14, -5.5, 15.5, -4.5)},
                      {"id": "top", "level": "gallery", "polygon": box(11, -4, 15, 4)}],
            "formations": [below], "flows": flows}


@pytest.mark.parametrize("name", BELOW)
def test_people_below_stairs_stand_as_if_nobody_were_on_them(throng, tmp_path, name):
    stairs, origin, way = BELOW[name]
    places = {}
    for climb in (False, True):
        (tmp_path / "layout.json").write_text(json.dumps(layout(stairs, origin, way, climb)))
        folder = tmp_path / f"bake-{climb}"
        throng("bake", tmp_path / "layout.json", "-o", folder, "-q", "--no-gltf")
        there = numpy.load(folder / "streams" / "state.npy")[..., 0] > 0
        pos = numpy.load(folder / "streams" / "pos.npy")
        places[climb] = pos[:, -6:]
        assert there[-1, -6:].all() and abs(pos[-1, -6:, 2]).max() < 0.01
    moved = numpy.linalg.norm((places[True] - places[False]).astype(float), axis=2)
    assert moved.max() < 1e-6
