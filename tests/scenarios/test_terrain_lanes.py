# SPDX-License-Identifier: Apache-2.0
"""Lanes and crossings on a terrain that is cut: vehicles drive on their ground, and stop for those who are on it."""
import json

import numpy
import pytest

from test_terrain_links import DECK, Baked, Mesh, box, layout

LANE = {"id": "lane", "points": [[-60, 0], [60, 0]]}
CROSSING = {"id": "zebra", "polygon": [[5, -3], [11, -3], [11, 3], [5, 3]]}


def crowd(on, at=(8.0, 0.0)):
    """Four people who stand together, on the deck or below it."""
    places = [[at[0] + 0.6 * (i % 2), at[1] + 0.6 * (i // 2)] for i in range(4)]
    return {"id": on, "type": "agents", "level": on, "arrival": "stay",
            "agents": [{"position": place, "goal": place} for place in places]}


def scene(mesh, **members):
    given = layout(mesh, [], **members)
    given["areas"] = []
    given["simulation"]["duration"] = 30
    return {"lanes": [LANE], "vehicles": [{"id": "cars", "lane": "lane", "times": [1, 6]}], **given}


class Driven(Baked):
    def __init__(self, *arguments):
        super().__init__(*arguments)
        columns = self.manifest["vehicles"]["columns"]
        track = numpy.load(self.folder / "vehicles.npy")
        self.track = {name: track[..., i].astype(float) for i, name in enumerate(columns)}
        self.drives = self.track["state"] > 0


@pytest.mark.parametrize("slope", [0, 0.02])
def test_vehicles_stop_only_for_those_on_their_ground(throng, tmp_path, slope):
    """People stand over the lane on the deck: nobody brakes. The same below, and both cars stop before them."""
    mesh = Mesh(slope=slope)
    free = Driven(throng, tmp_path, mesh, scene(mesh, formations=[crowd("deck")]))
    assert abs(free.places[-1, :, 2] - DECK).max() < 0.01
    drives = free.drives
    assert (~drives[-1]).all() and free.track["speed"][drives].min() > 9.9
    x = free.track["x"]
    on_ground = drives & (abs(x) < 28)
    assert abs(free.track["z"] - slope * x)[on_ground].max() < 0.02
    (tmp_path / "below").mkdir()
    held = Driven(throng, tmp_path / "below", mesh, scene(mesh, formations=[crowd("street"), {**crowd("deck"), "id": "up"}]))
    last = held.track["x"][-1]
    assert held.drives[-1].all() and held.track["speed"][-1].max() < 0.01
    assert 3.0 < last[0] < 8.0 - 2.0 and last[1] < last[0] - 4.5  # the middle of a car of 4.5 m, and one behind it


def test_vehicles_let_people_over_a_crossing_under_a_bridge(throng, tmp_path):
    mesh = Mesh()
    given = scene(mesh, crossings=[CROSSING])
    given["areas"] = [{"id": "south", "polygon": box(4, -9, 12, -3)}, {"id": "north", "polygon": box(4, 3, 12, 9)},
                      {"id": "deck-south", "level": "deck", "polygon": box(4, -5, 12, -3)},
                      {"id": "deck-north", "level": "deck", "polygon": box(4, 3, 12, 5)}]
    given["roads"] = [{"id": "over", "level": "deck", "centreline": [[8, -5], [8, 5]], "width": 6}]
    given["flows"] = [{"id": "below", "from": "south", "to": "north", "count": 12, "end": 10},
                      {"id": "above", "from": "deck-south", "to": "deck-north", "count": 12, "end": 10}]
    given["simulation"]["duration"] = 50
    crossed = Driven(throng, tmp_path, mesh, given)
    assert crossed.figures["arrived"] == 24 and (~crossed.drives[-1]).all()
    low = crossed.there & (crossed.places[..., 2] < 1)
    on = low & (abs(crossed.y) < 1.2) & (abs(crossed.x - 8) < 3)
    assert on.any()
    for frame in numpy.flatnonzero(on.any(1)):  # no car is where people are
        cars = crossed.track["x"][frame][crossed.drives[frame]]
        people = crossed.x[frame][on[frame]]
        assert not any((abs(people - car) < 2.0).any() for car in cars)
    given["flows"] = given["flows"][1:]
    (tmp_path / "above").mkdir()
    free = Driven(throng, tmp_path / "above", mesh, given)
    assert free.track["speed"][free.drives].min() > 9.9 > crossed.track["speed"][crossed.drives].min()


@pytest.mark.parametrize("change, message", [
    (lambda mesh, given: given["lanes"][0].update(level="deck"), "lane `lane` leads from the ground `street` onto `deck`"),
    (lambda mesh, given: given["lanes"][0].update(points=[[-60, 50], [60, 50]]),
     "lane `lane`: there is no ground of the terrain at (-60.00, 50.00)"),
    (lambda mesh, given: given["crossings"][0].update(polygon=box(5, 40, 9, 44)),
     "crossing `zebra`: there is no ground of the terrain"),
    (lambda mesh, given: given["lanes"][0].update(level="roof"), "there is no level `roof`"),
    (lambda mesh, given: given.update(links=[{"id": "way", "from": "street", "to": "deck", "width": 2,
                                              "path": [[-7, 2.5], [0, 2.5]]}]),
     "lane `lane` comes to where the ground `street` goes on as `way`"),
])
def test_mistakes_are_told(throng, tmp_path, change, message):
    mesh = Mesh()
    given = scene(mesh, formations=[crowd("deck")], crossings=[dict(CROSSING)])
    given["lanes"] = [dict(LANE)]
    change(mesh, given)
    path = mesh.write(tmp_path, given)
    told = throng("check", path, expect=3)
    errors = [line for line in told.stderr.splitlines() if ": error: " in line]
    assert message in errors[0] and errors[0].startswith(f"{path}:1:"), told.stderr


def test_levels_without_a_terrain_have_no_lanes(throng, tmp_path):
    mesh = Mesh()
    given = scene(mesh, formations=[crowd("deck")])
    del given["terrain"]
    given["levels"] = [{"id": "street", "floor": box(-30, -20, 30, 20)},
                       {"id": "deck", "height": DECK, "floor": box(0, -6, 16, 6)}]
    told = throng("check", mesh.write(tmp_path, given), expect=3)
    assert "have lanes and crossings only on a `terrain`" in told.stderr
    assert json.loads((tmp_path / "layout.json").read_text())["lanes"]


def test_vehicles_on_one_deck_are_nothing_to_those_on_another(throng, tmp_path):
    """Trams come in from far behind their lane and leave far beyond it, and in the plane there are others' grounds."""
    mesh = Mesh()
    mesh.box(-24, 8, -8, 20, DECK - 0.3, DECK)  # a second deck, eight metres away
    places = [[-23.2 + 0.9 * i, 9.5 + 0.9 * j] for i in range(16) for j in range(11)]
    given = layout(mesh, [])
    given.update(areas=[], formations=[{"id": "crowd", "type": "agents", "level": "second", "arrival": "stay",
                                        "agents": [{"position": place, "goal": place} for place in places]}],
                 lanes=[{"id": "east", "level": "deck", "points": [[1, 0], [15, 0]]},
                        {"id": "west", "level": "deck", "points": [[15, -3], [1, -3]]}])
    given["levels"].append({"id": "second", "at": [-15, 14, DECK]})
    given["simulation"]["duration"] = 11
    moved = []
    for times in ([1], [10.9]):
        given["vehicles"] = [{"id": f"trams-{lane}", "lane": lane, "kind": "tram", "times": times}
                             for lane in ("east", "west")]
        (tmp_path / str(times[0])).mkdir()
        moved.append(Baked(throng, tmp_path / str(times[0]), mesh, given).places[: 10 * 24])
    assert (moved[0] == moved[1]).all()


def test_a_crossing_ends_with_its_ground(throng, tmp_path):
    """However far its outline reaches: in the plane there are others' grounds beyond, and nobody is stopped for those."""
    mesh = Mesh()
    far = {"id": "zebra", "polygon": [[5, -3], [11, -3], [11, 110], [5, 110]]}
    bake = Driven(throng, tmp_path, mesh, scene(mesh, crossings=[far], formations=[crowd("deck")]))
    assert (~bake.drives[-1]).all() and bake.track["speed"][bake.drives].min() > 9.9
