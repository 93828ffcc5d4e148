# SPDX-License-Identifier: Apache-2.0
"""People who are listed one by one: places on their way, times of their own, and mistakes in them."""
import json

import numpy
import pytest

import written_bakes

TOLERANCE = 0.4
WALL = {"id": "wall", "points": [[10, -6], [10, 6]], "thickness": 0.2}


def layout_of(agents, **keys):
    formation = {"id": "listed", "type": "agents", "goal_tolerance": TOLERANCE, "arrival": "leave", "agents": agents}
    return {"throng": 1, "name": "listed", "simulation": {"duration": 60, "seed": 3}, "walls": [WALL],
            "formations": [formation], **keys}


class Bake(written_bakes.Bake):
    def __init__(self, path):
        super().__init__(path)
        self.fps, self.places = self.manifest["fps"], self.pos[..., :2].astype(float)
        self.doing = self.state[..., 0].astype(int)

    def near(self, row, point):
        """Frames in which somebody is within the tolerance of a place."""
        away = numpy.hypot(*(self.places[:, row] - point).T)
        return numpy.flatnonzero((away <= TOLERANCE + 0.02) & (self.doing[:, row] > 0))


@pytest.fixture
def bake(throng, tmp_path):
    made = written_bakes.baker(throng, tmp_path)
    return lambda agents, name="bake", **keys: Bake(made(name, layout_of(agents, **keys)))


def refusal(throng, tmp_path, agents, **keys):
    path = tmp_path / "layout.json"
    path.write_text(json.dumps(layout_of(agents, **keys), indent=0))
    return throng("check", path, expect=3).stderr


def test_places_on_the_way_are_visited_in_their_order_round_walls(bake):
    way = [([20, 0], 4.0), ([20, 10], 0.0)]
    found = bake([{"position": [0, 0], "via": [{"point": point, "wait": wait} for point, wait in way],
                   "goal": [0, 10]}])
    first, second = (found.near(0, numpy.array(point)) for point, _ in way)
    assert first[0] < first[-1] < second[0] < int(found.rows[0]["arrival_frame"])
    assert 4.0 <= (first[-1] - first[0]) / found.fps < 7.0, "it waits there"
    assert (second[-1] - second[0]) / found.fps < 2.0, "it only passes"
    assert found.rows[0]["outcome"] == "arrived"
    beside = numpy.abs(found.places[:, 0, 0] - 10) < 0.2
    assert (numpy.abs(found.places[beside, 0, 1]) > 6).all(), "nobody goes through the wall"


def test_everybody_appears_and_sets_off_in_its_own_time_and_rows_are_in_the_order_of_starts(bake):
    starts, waits = [5.0, 0.0, 2.5, 0.0], [0.0, 3.0, 0.0, 0.0]
    found = bake([{"position": [0, 3 * n], "goal": [-9, 3 * n], "start": start, "wait": wait}
                  for n, (start, wait) in enumerate(zip(starts, waits))])
    order = [1, 3, 2, 0]
    for row, n in enumerate(order):
        assert float(found.rows[row]["goal_y"]) == 3 * n
        assert int(found.rows[row]["spawn_frame"]) / found.fps == pytest.approx(starts[n], abs=2 / found.fps)
        left = numpy.flatnonzero(found.places[:, row, 0] < -0.5)[0] / found.fps
        assert 0.2 < left - starts[n] - waits[n] < 1.5


def test_a_start_of_the_formation_is_that_of_each(bake):
    people = [{"position": [0, 0], "goal": [-9, 0]}, {"position": [0, 3], "goal": [-9, 3]}]
    formation = {"id": "listed", "type": "agents", "goal_tolerance": TOLERANCE, "arrival": "leave"}
    one = bake(people, "one", formations=[{**formation, "agents": people, "start": 2}])
    each = bake(people, "each", formations=[{**formation, "agents": [{**each, "start": 2} for each in people]}])
    assert (one.places == each.places).all() and (one.doing == each.doing).all()


def test_nobody_waits_for_company_that_goes_another_way(bake):
    people = [{"position": [0.6 * n, 0], "goal": [0.6 * n, -9],
               **({"via": [{"point": [0.6 * n, 20]}]} if n % 2 else {})} for n in range(8)]
    formation = {"id": "listed", "type": "agents", "goal_tolerance": TOLERANCE, "arrival": "leave", "agents": people,
                 "people": {"groups": "leisure"}}
    found = bake(people, formations=[formation], walls=[])
    for row in range(0, 8, 2):
        assert int(found.rows[row]["arrival_frame"]) / found.fps < 20


def test_people_of_a_level_go_their_way_on_it(bake):
    floor = [[-12, -12], [24, -12], [24, 12], [-12, 12]]
    people = [{"position": [0, 0], "via": [{"point": [5, 8]}], "goal": [0, -8]}]
    formation = {"id": "listed", "type": "agents", "goal_tolerance": TOLERANCE, "arrival": "leave", "agents": people,
                 "level": "up"}
    found = bake(people, formations=[formation], walls=[],
                 levels=[{"id": "down", "floor": floor}, {"id": "up", "height": 4, "floor": floor}])
    assert len(found.near(0, numpy.array([5, 8]))) and found.rows[0]["outcome"] == "arrived"


@pytest.mark.parametrize("person, words", [
    ({"via": [{"point": [10, 0]}]}, "person 0 has a place of its way in a wall"),
    ({"via": [{"wait": 2}]}, "needs `point`"),
    ({"via": [{"point": [1, 1], "wait": -1}]}, "at least 0"),
    ({"via": [{"point": [1, 1], "stay": 1}]}, "no key `stay`"),
    ({"start": -1}, "at least 0"),
])
def test_mistakes_are_told_at_their_place(throng, tmp_path, person, words):
    said = refusal(throng, tmp_path, [{"position": [0, 0], "goal": [5, 5], **person}])
    assert words in said and "layout.json:" in said


def test_a_behaviour_tells_the_way(throng, tmp_path):
    people = [{"position": [0, 0], "via": [{"point": [2, 2]}]}]
    formation = {"id": "listed", "type": "agents", "agents": people, "behaviour": "stroll"}
    behaviour = {"id": "stroll", "start": "stay", "states": {"stay": {"stay": 5}}}
    said = refusal(throng, tmp_path, people, formations=[formation], behaviours=[behaviour])
    assert "`via` is said twice" in said


STREET = {"throng": 1, "name": "street", "simulation": {"duration": 120, "seed": 3, "warmup": 10},
          "areas": [{"id": "west", "polygon": [[0, -20], [4, -20], [4, 20], [0, 20]]},
                    {"id": "east", "polygon": [[30, -20], [34, -20], [34, 20], [30, 20]]}]}


@pytest.fixture
def entries(throng, tmp_path):
    """When the people of one flow come in, s."""
    def bake(**keys):
        layout = {**STREET, "flows": [{"id": "f", "from": "west", "to": "east", **keys}]}
        (tmp_path / "street.json").write_text(json.dumps(layout))
        throng("bake", tmp_path / "street.json", "-o", tmp_path / "street", "-q", "--no-gltf", "--force")
        found = Bake(tmp_path / "street")
        return numpy.array([int(row["spawn_frame"]) / found.fps for row in found.rows]), found

    return bake


def test_people_come_at_the_moments_that_are_listed(entries):
    times = [31.25, 2.5, 40, 2.5, -4]
    found, bake = entries(times=times)
    assert found == pytest.approx([0, 2.5, 2.5, 31.25, 40], abs=1.5 / bake.fps)
    assert numpy.hypot(*(bake.places[0, 0] - [17, 0])) < 25 and bake.places[0, 0, 0] > 4, "it came in the warm-up"


def test_people_come_with_the_gaps_that_are_drawn(entries):
    found, bake = entries(gaps=2.5, start=5, end=60)
    assert found == pytest.approx(numpy.arange(7.5, 60, 2.5), abs=1.5 / bake.fps)
    mean, deviation = -0.5, 0.6
    found, _ = entries(gaps={"log_normal": [mean, deviation]}, start=1)
    gaps = numpy.log(numpy.maximum(numpy.diff(found), 1 / 24))
    assert len(found) == pytest.approx(119 / numpy.exp(mean + deviation ** 2 / 2), rel=0.15)
    assert numpy.exp(gaps).mean() == pytest.approx(numpy.exp(mean + deviation ** 2 / 2), rel=0.15)
    assert gaps.std() == pytest.approx(deviation, rel=0.25)


@pytest.mark.parametrize("keys, words", [
    ({"gaps": 2, "count": 5}, "this one has `count` and `gaps`"),
    ({}, "this one has none"),
    ({"gaps": 0}, "everybody would come at once"),
    ({"times": [1, "2"]}, "/flows/0/times/1"),
    ({"times": []}, "expected one moment or more"),
    ({"times": [1, -11]}, "-11 s is before everything begins, at -10 s"),
    ({"times": [1], "end": 20}, "`end` has no meaning"),
])
def test_one_way_of_coming_in_is_told(throng, tmp_path, keys, words):
    layout = {**STREET, "flows": [{"id": "f", "from": "west", "to": "east", **keys}]}
    (tmp_path / "layout.json").write_text(json.dumps(layout, indent=0))
    assert words in throng("check", tmp_path / "layout.json", expect=3).stderr


@pytest.mark.quick
def test_listed_people_go_to_places_and_each_draws_its_own(bake):
    """One of two rooms by weight, the nearest of both, a room by name, and all of that after places on the way."""
    corners = ((-1, -1), (1, -1), (1, 1), (-1, 1))
    square = lambda name, x, y: {"id": name, "polygon": [[x + i, y + j] for i, j in corners]}
    areas = [square("north", 0, 16), square("south", 0, -16), square("east", 22, 0)]
    drawn = {"choose": {"north": 3, "south": 1}}
    agents = [{"position": [0.8 * (i % 8) - 3, 0.8 * (i // 8) - 3], "goal": drawn} for i in range(64)]
    agents += [{"position": [4, 9], "goal": {"nearest": ["north", "south"]}}, {"position": [4, -9], "goal": "east"},
               {"position": [-5, 0], "via": [{"point": [-5, -12]}], "goal": drawn}]
    found = bake(agents, areas=areas)
    ends = numpy.array([found.places[found.doing[:, row] > 0, row][-1] for row in range(len(agents))])
    in_area = lambda which: (numpy.abs(ends - which["polygon"][0] - 1) < 1.6).all(1)
    north, south, east = (in_area(each) for each in areas)
    assert (north[:64] | south[:64]).all() and 39 <= north[:64].sum() <= 57  # 48, three deviations
    assert north[64] and east[65] and (north[66] or south[66])
    assert len(found.near(66, numpy.array([-5, -12]))) > 0
    assert all(row["outcome"] == "arrived" for row in found.rows)


def test_a_place_that_listed_people_cannot_go_to_is_told(throng, tmp_path):
    told = refusal(throng, tmp_path, [{"position": [0, 0], "goal": "nowhere"}])
    assert "nowhere" in told and "layout.json:" in told
