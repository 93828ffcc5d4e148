# SPDX-License-Identifier: Apache-2.0
"""Houses of a set: of which kind they are, and that the rooms behind their windows are deep."""
import json

import numpy
import pytest

from conftest import EXAMPLES
from results import ADDON, HERE, result_of
from throng.setting.houses import KINDS, kind_of, number_of

LAYOUT = EXAMPLES / "intersection.json"


def block(x, y, size=20.0):
    return [(x, y), (x + size, y), (x + size, y + size), (x, y + size)]


def test_a_house_is_of_a_kind_by_its_place_alone():
    assert kind_of(block(5, 5)) == kind_of(block(5, 5)[::-1]) == kind_of(block(9, 9, 12.0)) in KINDS
    assert number_of(block(5, 5)) == number_of(block(5, 5)[2:] + block(5, 5)[:2]) != number_of(block(6, 5))


@pytest.mark.parametrize("apart", [30, 45, 60, 90])
def test_streets_have_all_kinds_and_no_row_of_one_kind(apart):
    kinds = [[kind_of(block(apart * i, apart * j)) for i in range(12)] for j in range(12)]
    counts = [sum(row.count(kind) for row in kinds) for kind in KINDS]
    assert min(counts) > 20
    for row in [*kinds, *zip(*kinds)]:
        assert len(set(row)) > 1


def test_houses_next_to_each_other_differ():
    kinds = [kind_of(block(30 * i, 0)) for i in range(2, 5)]
    assert set(kinds) == set(KINDS)


@pytest.fixture(scope="module")
def built(blender):
    """What check_houses.py has seen."""
    return result_of(blender(HERE / "check_houses.py", ADDON, LAYOUT))


def test_an_example_has_three_kinds_of_houses(built):
    facings = {"plaster", "bricks", "concrete"}
    found = [facings & {name.split()[1] for name in house["materials"]} for house in built["houses"].values()]
    assert all(len(names) == 1 for names in found) and set().union(*found) == facings and built["beyond"] == 6


def test_a_house_stays_what_it_is_under_another_name(built):
    assert built["houses"] == built["again"] and len(built["houses"]) == 4


def test_houses_are_cheap_keep_their_height_and_have_windows(built):
    heights = {wall["id"]: wall["height"] for wall in json.loads(LAYOUT.read_text())["walls"]}
    for name, house in built["houses"].items():
        assert house["faces"] < 7000 and house["panes"] > 100 and house["glass"] > 150.0
        assert house["low"] >= 0.0 and heights[name] < house["top"] < heights[name] + 5.0
        assert all(material.startswith("throng ") for material in house["materials"]), "by names that can be found"
        assert house["maps"] == ["rooms"]


def test_every_pane_is_in_one_room(built):
    for panes in built["rooms"].values():
        assert all(len(rooms) == 1 for rooms in panes)
        assert len({tuple(rooms[0]) for rooms in panes}) > 40


def test_rooms_follow_the_light_of_the_day(built):
    daylight, lamps, lit = built["lit late"]
    assert 0.0 < daylight < 1.0 and 0.0 < lamps < 1.0 and 0.0 < lit < 0.5


def test_rooms_behind_panes_are_deep(built):
    """A picture on the pane would be the same at the same place of it, from wherever it is seen."""
    def alike(name):
        rows = [numpy.array(grey).reshape(12, 11) for grey in built[name]]
        return numpy.corrcoef(*((row - row.mean(axis=1, keepdims=True)).ravel() for row in rows))[0, 1]

    assert numpy.std(built["deep"][0]) > 0.02 and numpy.std(built["flat"][0]) > 0.02
    assert alike("flat") > 0.65 and alike("deep") < 0.4
