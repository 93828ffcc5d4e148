# SPDX-License-Identifier: Apache-2.0
"""What stands in a set, and where, without a Blender."""
import math

import numpy
import pytest

from results import ADDON  # noqa: F401  it puts the add-on on the path
from sample_bake import SMALL_CAST, write_bake
from throng.formats import load_bake
from throng.setting import dressing, horizon, lamp_places, street_ends
from throng.setting.plane import distance_to, inside
from throng.setting.relief import Relief
from throng.setting.space import Space, crossings
from throng.setting.trodden import Trodden

FORMS = {**dict.fromkeys(dressing.CARS, dressing.CAR), "bench": dressing.BENCH, "bin": dressing.BIN,
         "bollard": dressing.BOLLARD, "planter": dressing.PLANTER}
ALONG = [(x, 3.0) for x in numpy.arange(-60.0, 60.0, 0.2)]  # people walk along one side of a street
STREET = {"roads": [{"id": "street", "centreline": [[-60.0, 0.0], [60.0, 0.0]], "width": 9.0}],
          "walls": [{"id": "north", "closed": True, "height": 12.0,
                     "points": [[-60.0, 8.0], [60.0, 8.0], [60.0, 20.0], [-60.0, 20.0]]},
                    {"id": "south", "closed": True, "height": 12.0,
                     "points": [[60.0, -8.0], [-60.0, -8.0], [-60.0, -20.0], [60.0, -20.0]]}]}
BOUNDS = ((-60.0, -20.0), (60.0, 20.0))


def dressed(geometry=None, places=ALONG, name="street", **options):
    return dressing.dress(STREET if geometry is None else geometry, Trodden(places), BOUNDS, name, **options)


def in_street(things):
    return [thing for thing in things if abs(thing.x) < 60.0 and abs(thing.y) < 8.0]


def test_a_grid_knows_where_people_were_and_how_near():
    trodden = Trodden([(0.1, 0.1), (5.0, 0.0)])
    assert not trodden.free([(0.1, 0.1)], 0.0) and not trodden.free([(9.0, 9.0), (5.4, 0.0)], 0.5)
    assert trodden.free([(2.5, 0.0), (5.0, 1.2), (-40.0, 70.0)], 0.5)
    assert Trodden([]).free([(1.0, 1.0)], 3.0)


def test_a_bakes_grid_has_everybody_who_is_there_and_nobody_who_is_not(tmp_path):
    pos, _, state = write_bake(tmp_path / "bake", **SMALL_CAST)
    trodden = Trodden.of_bake(load_bake(str(tmp_path / "bake")))
    there = pos[state[..., 0] > 0.5][:, :2]
    assert not any(trodden.free([place], 0.0) for place in there[::7])
    random = numpy.random.default_rng(3).uniform(-25.0, 25.0, (400, 2))
    for place in random:
        near = numpy.hypot(*(there - place).T).min()
        assert not (trodden.free([place], 0.6) and near < 0.6) and (near < 1.1 or trodden.free([place], 0.6))
    assert trodden.grid.sum() == len(numpy.unique(numpy.floor(there / trodden.cell), axis=0))


def test_cars_park_along_the_kerb_where_nobody_walks():
    cars = [thing for thing in in_street(dressed()) if thing.kind in dressing.CARS]
    assert len(cars) > 10
    for car in cars:  # 25 cm from the kerb at y = -4.5, as one drives on the right: towards +x there
        assert car.y == pytest.approx(-4.5 + 0.25 + 0.5 * dressing.CAR[1], abs=0.01)
        assert math.cos(car.heading) > 0.99
    free = [thing for thing in in_street(dressed(places=[])) if thing.kind in dressing.CARS]
    assert {round(car.y) for car in free} == {-3, 3} and {round(math.cos(car.heading)) for car in free} == {-1, 1}


def corners_of(thing):
    """A thing's corners on the ground."""
    length, width, _ = FORMS.get(thing.kind, dressing.TREE)
    u = (math.cos(thing.heading), math.sin(thing.heading))
    return [(thing.x + u[0] * s * length - u[1] * t * width, thing.y + u[1] * s * length + u[0] * t * width)
            for s, t in ((-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5))]


def test_nothing_is_where_people_walk_in_walls_or_in_each_other():
    things = dressed()
    rings = [corners_of(thing) for thing in things]
    walls = [[tuple(p) for p in wall["points"]] for wall in STREET["walls"]]
    for thing, ring in zip(things, rings):
        margin = FORMS.get(thing.kind, dressing.TREE)[2]
        sides = list(zip(ring, ring[1:] + ring[:1]))
        assert all(min(distance_to(a, b, place) for a, b in sides) >= margin - 0.01 for place in ALONG[::3]
                   if abs(place[0] - thing.x) < 5.0), thing
        assert not any(inside(wall, corner) for wall in walls for corner in ring)
        assert thing.kind in dressing.CARS or all(abs(y) > 4.5 or abs(x) > 60.0 for x, y in ring), "off the road"
    for i, ring in enumerate(rings):
        assert not any(inside(other, corner) for j, other in enumerate(rings) if j != i for corner in ring)


def test_furniture_has_its_back_to_a_wall():
    benches = [thing for thing in in_street(dressed()) if thing.kind == "bench"]
    assert len(benches) > 8
    for bench in benches:
        front = (bench.x + math.sin(bench.heading), bench.y - math.cos(bench.heading))
        assert abs(front[1]) < abs(bench.y) and 7.0 < abs(bench.y) < 7.8


def test_the_same_name_gives_the_same_set_and_another_name_another():
    assert dressed() == dressed() != dressed(name="lane")


def test_full_streets_stay_empty():
    everywhere = [(x, y) for x in numpy.arange(-60.0, 60.2, 0.5) for y in numpy.arange(-7.9, 8.0, 0.5)]
    assert in_street(dressed(places=everywhere)) == [] != in_street(dressed(places=[]))


def test_crossings_keep_clear_of_cars():
    geometry = {"roads": [*STREET["roads"], {"id": "lane", "centreline": [[0, -40], [0, 40]], "width": 6.0}]}
    space = Space(geometry, Trodden([]))
    assert crossings(space, space.roads[0]) == [(-3.0 + 60.0, 3.0 + 60.0)]
    cars = [thing for thing in dressed(geometry, []) if thing.kind in dressing.CARS]
    assert cars and all(abs(car.x) > 12.0 or abs(car.y) > 13.0 for car in cars)
    assert any(thing.kind == "bollard" and abs(thing.x) < 9.0 for thing in dressed(geometry, []))


def test_lamps_are_left_alone():
    lamps = lamp_places.lamp_places(STREET["roads"])
    assert len(lamps) == 7 and {abs(y) for _, y in lamps} == {5.0}
    things = dressed(places=[], lamps=lamps)
    assert all(not inside(corners_of(thing), lamp) for thing in things for lamp in lamps)


def test_streets_go_on_where_nothing_is_ahead_and_houses_stand_along_them():
    roads, houses = street_ends.beyond(STREET)
    assert [road["centreline"][0] for road in roads] == [[-60.0, 0.0], [60.0, 0.0]]
    assert [road["centreline"][1][0] for road in roads] == [-60.0 - street_ends.LENGTH, 60.0 + street_ends.LENGTH]
    assert len(houses) > 20
    for house in houses:
        ring = street_ends.corners(*house)
        assert all(abs(y) > 4.5 + 3.0 for _, y in ring) or abs(house[0]) > 60.0 + street_ends.LENGTH
        front = (house[0] + house[2][1] * 8.0, house[1] - house[2][0] * 8.0)
        assert abs(front[1]) < abs(house[1]) or abs(front[0]) < abs(house[0]), "it looks at the street"
    walled = {"roads": STREET["roads"], "walls": [{"points": [[80, -9], [80, 9]]}]}
    roads, houses = street_ends.beyond(walled)
    assert [road["centreline"][0][0] for road in roads] == [-60.0] and houses == [], "no houses in the country"


@pytest.fixture(scope="module")
def slope():
    """(positions, corners) of a slope of 200 m, 0.1 m up for each to the east."""
    xs = numpy.arange(0.0, 201.0, 20.0)
    return ([value for y in xs for x in xs for value in (x, y, 0.1 * x)],
            [c for row in range(10) for i in range(row * 11, row * 11 + 10)
             for c in (i, i + 1, i + 12, i, i + 12, i + 11)])


def test_heights_of_a_mesh_and_of_the_country_round_it(slope):
    relief, (border, _) = Relief(*slope), horizon.border_of(*slope)
    assert relief.height(33.0, 71.0) == pytest.approx(3.3) and relief.height(-1.0, 5.0) is None
    country, _ = horizon.country(border)
    for x, y, z in country[40:400:13]:
        assert horizon.height(border, x, y) == pytest.approx(z, abs=1e-6)


def test_trees_stand_on_hills_and_round_them(slope):
    relief, (border, _) = Relief(*slope), horizon.border_of(*slope)
    path = [(100.0, y) for y in numpy.arange(0.0, 200.0, 0.5)]
    trees = dressing.dress_country(*slope, {"roads": []}, Trodden(path), "hill")
    on = [tree for tree in trees if relief.height(*tree[1:3]) is not None]
    off = [tree for tree in trees if relief.height(*tree[1:3]) is None]
    assert len(on) > 10 and len(off) > 100 and all(abs(tree[1] - 100.0) > 4.0 for tree in on)
    assert all(tree[5] == pytest.approx(0.1 * tree[1] - 0.1) for tree in on)
    assert all(tree[5] == pytest.approx(horizon.height(border, *tree[1:3]) - 0.1) for tree in off)
