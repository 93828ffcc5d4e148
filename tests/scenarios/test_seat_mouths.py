# SPDX-License-Identifier: Apache-2.0
"""Stands that are left and entered by openings in their middle (vomitories) and behind their last row."""
import json

import numpy
import pytest

import written_bakes

WALKS, SITS = 1, 5
PITCH, RISE, LANDING, CONCOURSE = 0.9, 0.4, 3, -1.5
FOOT = -(9.5 * PITCH + 0.7)  # m: y of the foot of the passage, just behind the block
EXIT = {"id": "exit", "level": "concourse", "polygon": [[6, -22], [9, -22], [9, -19], [6, -19]]}
LEVELS = [{"id": "bowl", "floor": [[-8, 1], [8, 1], [8, 10], [-8, 10]]},
          {"id": "concourse", "height": CONCOURSE, "floor": [[-10, -24], [10, -24], [10, -5], [-10, -5]]}]
VOMITORY = {"at": "row", "row": LANDING + 1, "level": "concourse"}
LEAVES = {"at": {"uniform": [1, 3]}, "to": "exit"}


def stand(**more):
    """Ten rows of twelve, but for those that are cut round the opening."""
    return {"id": "stand", "front": [[-3.61, 0], [3.61, 0]], "rows": 10, "pitch": PITCH, "rise": RISE, "aisles": 1,
            **more}


def layout(duration, seats, **more):
    return {"throng": 1, "simulation": {"duration": duration, "seed": 3}, "levels": LEVELS, "areas": [EXIT],
            "seats": [seats], **more}


class Bake(written_bakes.Bake):
    def __init__(self, path):
        super().__init__(path)
        self.doing = numpy.floor(self.state[..., 0]).astype(int)
        self.there = self.doing > 0
        self.led = self.there & (self.pos[..., 2] > CONCOURSE + 0.01)

    def stepped_out(self):
        """The frame in which each person steps onto the concourse."""
        return numpy.argmax(self.there & ~self.led, axis=0)


@pytest.fixture(scope="module")
def bake(throng, tmp_path_factory):
    made = written_bakes.baker(throng, tmp_path_factory.mktemp("mouths"), "--streams", "npy")
    return lambda *given: Bake(made(*given))


@pytest.fixture(scope="module")
def leaving(bake):
    return bake("leaving", layout(125, stand(mouths=VOMITORY, leave=LEAVES)))


@pytest.fixture(scope="module")
def coming(bake):
    return bake("coming", layout(100, stand(mouths=VOMITORY, occupancy=0), flows=[
        {"id": "guests", "from": "exit", "to": {"seats": "stand"}, "count": 36, "end": 15}]))


@pytest.fixture(scope="module")
def by_the_back(bake):
    return bake("back", layout(75, stand(rows=4, mouths={"at": "back", "passage": 5, "level": "concourse"},
                                         leave=LEAVES)))


def test_everybody_leaves_by_the_opening(leaving):
    assert leaving.pos.shape[1] >= 95 and (leaving.doing[0] == SITS).all()
    assert {row["outcome"] for row in leaving.rows} == {"arrived"}
    out = leaving.stepped_out()
    places = leaving.pos[out, numpy.arange(len(out))]
    assert numpy.abs(places[:, 0]).max() < 0.6 and numpy.abs(places[:, 1] - FOOT).max() < 0.3


@pytest.mark.parametrize("bakes", ["leaving", "coming", "by_the_back"])
def test_nobody_jumps_and_the_ground_is_where_the_level_is(bakes, request):
    of = request.getfixturevalue(bakes)
    there = of.there[1:] & of.there[:-1]
    moved = numpy.diff(of.pos, axis=0)
    assert numpy.linalg.norm(moved[..., :2], axis=2)[there].max() < 2.6 / 24
    assert numpy.abs(moved[..., 2])[there].max() < 1.3 / 24
    ground = of.there & (of.pos[..., 1] < min(FOOT, -8.2) - 0.3)
    # Who goes in is led from where it asked to.
    assert numpy.abs(of.pos[..., 2][ground] - CONCOURSE).max() < (0.1 if bakes == "coming" else 1e-3)


@pytest.mark.parametrize("bakes", ["leaving", "coming"])
def test_who_is_in_a_row_is_on_its_tread(bakes, request):
    of = request.getfixturevalue(bakes)
    in_row = of.led & (numpy.abs(of.pos[..., 0]) > 1.7)
    row = numpy.round((0.25 - of.pos[..., 1][in_row]) / PITCH)
    assert in_row.sum() > 1000 and row.max() == 9
    assert numpy.abs(of.pos[..., 2][in_row] - RISE * row).max() < 0.01


def test_steps_are_level_and_not_a_slope(leaving):
    """On the aisle before the opening, people are on a tread or half of one for most of the time."""
    aisle = leaving.led & (numpy.abs(leaving.pos[..., 0]) < 0.35) & (leaving.pos[..., 1] > -LANDING * PITCH)
    heights = leaving.pos[..., 2][aisle] / (0.5 * RISE)
    assert aisle.sum() > 500 and (numpy.abs(heights - numpy.round(heights)) < 0.05).mean() > 0.5


def test_who_is_nearest_to_the_opening_is_out_first(leaving):
    row = numpy.round((0.25 - leaving.pos[0, :, 1]) / PITCH)
    out = leaving.stepped_out()
    assert numpy.abs(row - LANDING)[out.argsort()[:5]].max() <= 2
    ends = []
    for number in range(10):
        for side in (-1, 1):
            of_row = numpy.nonzero((row == number) & (side * leaving.pos[0, :, 0] > 0))[0]
            order = of_row[numpy.abs(leaving.pos[0, of_row, 0]).argsort()]
            ends.append(out[order[[0, -1]]])
    first, last = numpy.array(ends).T
    assert (last > first).mean() > 0.7


@pytest.mark.parametrize("bakes", ["leaving", "by_the_back"])
def test_streams_merge_without_anybody_in_anybody(bakes, request):
    of = request.getfixturevalue(bakes)
    nearest = 9.0
    for frame in range(0, len(of.pos), 3):
        places = of.pos[frame][of.led[frame] & (of.doing[frame] == WALKS)]
        if len(places) > 1:
            away = numpy.linalg.norm(places[:, None] - places[None], axis=2)
            nearest = min(nearest, away[numpy.triu_indices(len(places), 1)].min())
    assert nearest > 0.4


def test_both_streams_get_out_at_the_same_time(leaving):
    """Those from before the opening do not wait for those from behind, nor the other way round."""
    row = numpy.round((0.25 - leaving.pos[0, :, 1]) / PITCH)
    order = leaving.stepped_out().argsort()
    first = row[order[:40]]
    assert (first < LANDING).sum() > 8 and (first > LANDING).sum() > 8


def test_a_deep_stand_empties_to_the_last_row(bake):
    """On flat ground: the foot is behind the block."""
    seats = stand(front=[[-4.11, 0], [4.11, 0]], rows=17, mouths={"at": "row", "row": 6}, leave=LEAVES)
    gate = {"id": "exit", "polygon": [[6, -30], [9, -30], [9, -27], [6, -27]]}
    deep = bake("deep", {"throng": 1, "simulation": {"duration": 270, "fps": 12, "seed": 3}, "areas": [gate],
                         "seats": [seats]})
    assert deep.pos.shape[1] > 200 and {row["outcome"] for row in deep.rows} == {"arrived"}
    assert (deep.doing[-1] == 0).all()


def test_people_come_to_their_seats_by_it(coming):
    assert (coming.doing[-1] == SITS).all() and {row["outcome"] for row in coming.rows} == {"arrived"}
    row = numpy.round((0.25 - coming.pos[-1, :, 1]) / PITCH)
    assert (row < LANDING).any() and (row > LANDING + 4).any()
    under = coming.there & ~coming.led & (coming.pos[..., 1] > FOOT + 0.8) & (numpy.abs(coming.pos[..., 0]) < 0.7)
    assert not under.any(), "nobody walks into the passage's sides"


def test_measure_takes_them_for_what_they_are(throng, leaving, coming):
    for of, seated in ((leaving, 0), (coming, 36)):
        told = json.loads(throng("measure", of.path, "--json").stdout)
        assert told["wall_crossings"] == 0 and told["stuck"] == 0 and told.get("seated", 0) == seated
        assert told["overlapping_percent"] < 1.0


@pytest.mark.parametrize("seats, words", [
    (stand(mouths={"at": "row", "row": 11}, leave=LEAVES), "block `stand` has 10 rows: its aisles cannot come out on"),
    (stand(mouths={"at": "row"}, leave=LEAVES), "`row`"),
    (stand(mouths={"at": "back", "row": 2}, leave=LEAVES), "`row` is only of mouths at a row"),
    (stand(mouths={"at": "front", "passage": 2}, leave=LEAVES), "from the front straight onto the ground"),
    (stand(mouths={"at": "row", "row": 4, "level": "cellar"}, leave=LEAVES), "there is no level `cellar`"),
    (stand(level="attic", leave=LEAVES), "there is no level `attic`"),
    (stand(mouths={**VOMITORY, "passage": 30}, leave=LEAVES), "beside the floor of level `concourse`"),
    (stand(mouths={**VOMITORY, "passage": 2}, leave=LEAVES), "climb 2.70 m over 2.00 m: they climb at most 80 %"),
    (stand(mouths=VOMITORY, aisles=0, leave=LEAVES), "has no aisles that could go out there"),
    (stand(mouths=VOMITORY, aisles=5, leave=LEAVES), "and an aisle, where its openings need 1.60 m"),
])
def test_check_tells_what_is_wrong(throng, tmp_path, seats, words):
    path = tmp_path / "wrong.json"
    path.write_text(json.dumps(layout(5, seats)), "utf-8")
    told = throng("check", path, expect=3).stderr
    assert words in told and told.count("error:") == 1


def test_check_tells_of_a_passage_that_ends_in_a_wall(throng, tmp_path):
    path, wall = tmp_path / "wall.json", {"id": "pillar", "level": "concourse", "points": [[-1, -9.2], [1, -9.2]]}
    path.write_text(json.dumps(layout(5, stand(mouths=VOMITORY, leave=LEAVES), walls=[wall])), "utf-8")
    assert "aisle 1 of block `stand` ends in wall `pillar`" in throng("check", path, expect=3).stderr
