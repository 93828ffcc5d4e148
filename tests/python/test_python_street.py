# SPDX-License-Identifier: Apache-2.0
"""Signals and zebras of a street, for files: which lamp is on when, and where stripes are."""
import math
import types

import numpy
import pytest
import shapely

from conftest import ROOT  # noqa: F401  (the package's path)
from throng_io.base.geometry import stripes, way_beside
from throng_io.bakes.moving import moving_things
from throng_io.bakes.surroundings import things_of

PHASES = [("drive", 3.0, ["lane"]), ("clear", 1.0, []), ("walk", 2.0, [])]
TRAFFIC = {
    "crossings": [{"id": "zebra", "polygon": [[6, -2], [10, -2], [10, 2], [6, 2]]}],
    "lanes": [{"id": "lane", "points": [[0, -20], [8, 0], [16, 20]], "width": 4.0,
               "stops": [{"at": [6, -5], "signal": "lights"}, {"at": [9, 3]}]}],
    "signals": [{"id": "lights", "offset": 1.5, "phases": [
        {"name": name, "seconds": seconds, "crossings": [], "lanes": lanes} for name, seconds, lanes in PHASES]}]}


@pytest.fixture
def bake():
    about = {"geometry": {"traffic": TRAFFIC, "walls": [], "roads": []}, "bounds": {"min": [0, -20], "max": [16, 20]}}
    return types.SimpleNamespace(about=about, fps=4.0, origin=numpy.array([100.0, 50.0, 0.0]), frames=60)


def test_one_lamp_is_on_as_the_signal_goes(bake):
    frames = numpy.arange(60)
    signal, = moving_things(bake, frames)
    assert (signal.kind, [part.name for part in signal.parts]) == ("Signals", ["post", "red_lamp", "green_lamp"])
    _, red, green = signal.parts
    assert (red.broad + green.broad == 1.0).all()
    for frame in frames:
        place = (frame / 4.0 + 1.5) % 6.0
        assert green.broad[frame] == (place < 3.0), place
    assert green.broad.sum() == 30


def test_posts_stand_to_the_right_of_the_lane_and_lamps_look_back(bake):
    signal, = moving_things(bake, numpy.arange(3))
    along = numpy.array([8.0, 20.0]) / math.hypot(8.0, 20.0)
    away = signal.places[0, :2] + bake.origin[:2] - [6.0, -5.0]
    assert away @ [along[1], -along[0]] == pytest.approx(2.45, abs=1e-6)
    assert abs(away @ along) < 1e-6 and signal.headings[0] == pytest.approx(math.atan2(20.0, 8.0))
    lamp = signal.parts[1].shape
    a, b, c = lamp.points[lamp.faces[0][:3]]
    assert numpy.cross(b - a, c - b)[0] < 0.0  # of its own, x leads along the lane


def test_zebras_have_stripes_along_the_lane(bake):
    things = {thing.place: thing for thing in things_of(bake)}
    crossing, painted = things["Ground/crossing0"], things["Ground/stripes0"]
    assert painted.points[:, 2].min() > crossing.points[:, 2].max()
    assert min(painted.colour) > 5 * max(crossing.colour)
    area = sum(shapely.Polygon(painted.points[face, :2]).area for face in painted.faces)
    assert area == pytest.approx(8.0, abs=1.2)  # half of it
    whole = shapely.box(6, -2, 10, 2)
    assert whole.buffer(1e-6).covers(shapely.MultiPoint(painted.points[:, :2] + bake.origin[:2]))
    for piece in shapely.get_parts(stripes(whole, (1.0, 0.0), 0.5)):
        assert piece.bounds[2] - piece.bounds[0] == 4.0 and piece.bounds[3] - piece.bounds[1] == 0.5


def test_the_way_beside_a_place_is_that_of_the_nearest_piece():
    points = [[0, 0], [10, 0], [10, 10]]
    place, way = way_beside(points, (12, 6))
    assert place == pytest.approx((10.0, 6.0)) and way == pytest.approx((0.0, 1.0))
    place, way = way_beside(points, (-3, 1))  # before it begins
    assert place == pytest.approx((0.0, 0.0), abs=2e-3) and way == pytest.approx((1.0, 0.0))
