# SPDX-License-Identifier: Apache-2.0
"""Who is in the sun between houses, where the answer is known."""
import math

import pytest

import results  # noqa: F401  it puts the add-on on the path
from throng.setting.sunlight import houses_of, in_sun, sunny_share

HOUSE = {"closed": True, "height": 11.2, "points": [[0, 0], [10, 0], [10, 10], [0, 10]]}


def sun(elevation, x, y):
    up = math.radians(elevation)
    return x * math.cos(up), y * math.cos(up), math.sin(up)


@pytest.mark.parametrize("away, lit", [(9.0, False), (11.0, True)])
def test_a_house_of_10_m_above_chests_throws_a_shadow_of_10_m_at_45_degrees(away, lit):
    houses = houses_of({"walls": [HOUSE]})
    assert in_sun(houses, (5.0, -away), sun(45.0, 0.0, 1.0)) is lit
    assert in_sun(houses, (5.0, 10.0 + away), sun(45.0, 0.0, 1.0)), "no shadow falls towards the sun"
    assert in_sun(houses, (-away, -3.0), sun(45.0, 1.0, 0.0)), "none beside the house either"


def test_shadows_are_long_when_the_sun_is_low():
    houses = houses_of({"walls": [HOUSE]})
    assert not in_sun(houses, (5.0, -17.0), sun(30.0, 0.0, 1.0))
    assert in_sun(houses, (5.0, -18.0), sun(30.0, 0.0, 1.0))


def test_open_walls_throw_none():
    assert houses_of({"walls": [HOUSE | {"closed": False}]}) == [] and houses_of({}) == []


def test_the_share_is_of_those_before_the_camera():
    houses = houses_of({"walls": [HOUSE]})
    assert sunny_share(houses, (5.0, -12.0), (0.0, -1.0), sun(45.0, 0.0, 1.0)) == 1.0
    assert sunny_share(houses, (5.0, -15.5), (0.0, 1.0), sun(45.0, 0.0, 1.0)) == pytest.approx(2.0 / 5.0)
