# SPDX-License-Identifier: Apache-2.0
"""The stream `wish`: what people want, where nothing and where everything is in their way."""
import csv
import json

import numpy
import pytest

# One walks along x and meets nobody. One walks along y up to a closed gate. One comes late.
LAYOUT = {"throng": 1, "name": "wishes", "simulation": {"duration": 9, "seed": 5},
          "roads": [{"id": "east", "centreline": [[0, 0], [40, 0]], "width": 4}, {"id": "north", "centreline": [[0, 20], [0, 40]], "width": 2},
                    {"id": "late", "centreline": [[20, 20], [20, 40]], "width": 4}],
          "walls": [{"id": "gate", "points": [[-2, 28], [2, 28]], "thickness": 0.2}, {"id": "left", "points": [[-2, 18], [-2, 42]]}, {"id": "right", "points": [[2, 18], [2, 42]]}],
          "events": [{"at": 8.9, "open": "gate"}],
          "flows": [{"id": "walker", "from": "east:start", "to": "east:end", "count": 1, "end": 0.1},
                    {"id": "stopped", "from": "north:start", "to": "north:end", "count": 1, "end": 0.1},
                    {"id": "late", "from": "late:start", "to": "late:end", "count": 1, "start": 6, "end": 6.1}]}


def streams(bake, *names):
    return [numpy.load(bake / "streams" / f"{name}.npy") for name in names]


def speeds(bake):
    with open(bake / "agents.csv", newline="") as file:
        return [float(row["preferred_speed"]) for row in csv.DictReader(file)]


@pytest.fixture(scope="module")
def wished(throng, tmp_path_factory):
    folder = tmp_path_factory.mktemp("wish")
    (folder / "layout.json").write_text(json.dumps(LAYOUT))
    throng("bake", folder / "layout.json", "-o", folder / "bake", "-q", "--wish", "--density")
    return folder


def test_who_is_alone_wants_to_go_where_it_goes(wished):
    wish, position, state = streams(wished / "bake", "wish", "pos", "state")
    there = state[:, 0, 0] > 0.5
    assert there.sum() > 200
    assert numpy.hypot(wish[there, 0, 0], wish[there, 0, 1]) == pytest.approx(speeds(wished / "bake")[0], abs=0.01)
    on_the_way = numpy.nonzero(there)[0][48:-48]
    velocity = numpy.diff(position[:, 0, :2], axis=0)[on_the_way] * 24.0
    assert numpy.abs(wish[on_the_way, 0, :2] - velocity).max() < 0.05
    assert wish[on_the_way, 0, 2].max() < 0.1


def test_who_stands_before_a_gate_wants_to_go_on_and_is_held_up(wished):
    wish, position, state = streams(wished / "bake", "wish", "pos", "state")
    last = 7 * 24
    assert state[last, 1, 0] > 0.5 and numpy.abs(position[last, 1, :2] - position[last - 24, 1, :2]).max() < 0.2
    assert numpy.hypot(*wish[last, 1, :2]) == pytest.approx(speeds(wished / "bake")[1], abs=0.01)
    assert wish[last, 1, 2] > 0.7 > 0.3 > wish[48, 1, 2]


def test_who_is_not_there_wants_nothing(wished):
    wish, state = streams(wished / "bake", "wish", "state")
    there = state[:, :, 0] > 0.5
    assert (wish[~there] == 0).all() and not there[0, 2] and there[-1, 2]
    assert (numpy.hypot(wish[there][:, 0], wish[there][:, 1]) > 0).all(), "from the first frame on"


def test_nothing_else_changes(throng, wished, manifest_of):
    throng("bake", wished / "layout.json", "-o", wished / "without", "-q", "--density")
    for name in ("streams/pos.npy", "streams/dir.npy", "streams/state.npy", "streams/density.npy", "agents.csv", "crowd.glb"):
        assert (wished / "bake" / name).read_bytes() == (wished / "without" / name).read_bytes()
    with_wish, without = manifest_of(wished / "bake"), manifest_of(wished / "without")
    assert with_wish["streams"].pop("wish")["units"] == ["m/s", "m/s", "1"] and with_wish["streams"] == without["streams"]
    assert with_wish["inputs"] != without["inputs"]


def test_wishes_turn_and_hasten_with_their_person(throng, wished):
    wish, position, state = streams(wished / "bake", "wish", "pos", "state")
    entries = []
    for row, change in ((0, {"move": {"turn": 90}}), (1, {"retime": {"speed": 2.0}})):
        first = int(numpy.argmax(state[:, row, 0] > 0.5))
        entries.append({"id": row, "group": ("walker", "stopped")[row], "spawn": {"frame": first, "position": position[first, row].tolist()}, **change})
    (wished / "bake.overrides.json").write_text(json.dumps({"throng_overrides": 1, "overrides": entries}))
    throng("apply", wished / "bake", "-o", wished / "final", "-q")
    (after,) = streams(wished / "final", "wish")
    assert numpy.abs(after[:, 0, 0] + wish[:, 0, 1]).max() < 1e-6 and numpy.abs(after[:, 0, 1] - wish[:, 0, 0]).max() < 1e-6
    first = entries[1]["spawn"]["frame"]
    assert numpy.abs(after[first + 20, 1, :2] - 2.0 * wish[first + 40, 1, :2]).max() < 1e-6
    assert after[first + 20, 1, 2] == pytest.approx(wish[first + 40, 1, 2], abs=1e-6)
    assert (after[:, 2] == wish[:, 2]).all()
