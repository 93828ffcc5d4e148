# SPDX-License-Identifier: Apache-2.0
"""The country round a place, without a Blender."""
import array
import math

import pytest

import results  # noqa: F401  it puts the add-on on the path
from throng.setting import horizon


def grid(side, height, twice=False):
    """(positions, corners) of a square terrain of side x side corners, 1 m apart."""
    positions, corners = array.array("f"), array.array("I")
    for y in range(side):
        for x in range(side):
            positions.extend((x, y, height(x, y)))
    for y in range(side - 1):
        for x in range(side - 1):
            a = y * side + x
            corners.extend((a, a + 1, a + side + 1, a, a + side + 1, a + side))
    if twice:  # every triangle has corners of its own
        positions = array.array("f", (positions[3 * corner + axis] for corner in corners for axis in range(3)))
        corners = array.array("I", range(len(corners)))
    return positions, corners


def test_the_outline_of_a_grid_goes_round_it_once():
    positions, corners = grid(5, lambda x, y: 0.1 * x)
    ring = horizon.outline(corners, 25)
    places = [tuple(positions[3 * i:3 * i + 2]) for i in ring]
    assert len(places) == len(set(places)) == 16 and all(x in (0, 4) or y in (0, 4) for x, y in places)
    assert all(math.dist(a, b) == 1.0 for a, b in zip(places, places[1:] + places[:1]))


def test_ground_goes_on_from_a_terrains_edge_to_the_horizon():
    positions, corners = grid(9, lambda x, y: 3.0 * math.sin(x) + 0.5 * y)
    border, lid = horizon.border_of(positions, corners)
    assert not lid and len(border) == 32
    country, quads = horizon.country(border)
    assert country[:32] == [pytest.approx(p) for p in border], "no gap at the edge"
    middle = tuple(sum(p[axis] for p in border) / 32 for axis in range(3))
    out = [math.dist(p[:2], middle[:2]) for p in country]
    assert min(out[-32:]) > horizon.REACH
    assert all(a < b for i in range(32) for a, b in zip(out[i::32], out[i + 32::32])), "no fold"
    level = [z for distance, (_, _, z) in zip(out, country) if 310.0 < distance < 690.0]
    assert level and level == [pytest.approx(middle[2])] * len(level), "flat near by"
    far = [z - middle[2] for distance, (_, _, z) in zip(out, country) if distance > 3700.0]
    assert min(far) >= 0.0 and 60.0 < max(far) < 120.0, "hills far away"


def test_the_country_is_one_surface_that_faces_upwards():
    border = [(x, y, 0.0) for x, y in horizon.rectangle((-10.0, -4.0), (10.0, 4.0), 8)]
    country, quads = horizon.country(border)
    assert {corner for quad in quads for corner in quad} == set(range(len(country)))
    assert len(quads) == len(country) - len(border) == len(set(quads))
    for a, b, c, _ in quads:
        (ax, ay, _), (bx, by, _), (cx, cy, _) = country[a], country[b], country[c]
        assert (bx - ax) * (cy - ay) - (by - ay) * (cx - ax) > 0.0


def test_a_terrain_whose_triangles_share_no_corners_lies_on_a_plate():
    positions, corners = grid(6, lambda x, y: 0.2 * x, twice=True)
    border, lid = horizon.border_of(positions, corners)
    assert lid and [p[2] for p in border] == [pytest.approx(-0.05)] * len(border)
    assert {(x, y) for x, y, _ in border} >= {(0.0, 0.0), (5.0, 5.0), (5.0, 0.0), (0.0, 5.0)}
