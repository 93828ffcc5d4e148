# SPDX-License-Identifier: Apache-2.0
"""People whose ways are given: they are where these say, and others make room for them."""
import csv
import json

import numpy
import pytest

RATE = 24


def bake(throng, folder, told, *options, files=()):
    for name, text in dict(files).items():
        (folder / name).write_text(text)
    (folder / "layout.json").write_text(json.dumps({"throng": 1, "simulation": {"duration": 12}, **told}))
    throng("bake", folder / "layout.json", "-o", folder / "bake", "-q", "--no-gltf", *options)
    streams = folder / "bake" / "streams"
    return [numpy.load(streams / f"{name}.npy") for name in ("pos", "dir", "state")]


def winding(seconds, step=0.1):
    """A way that no walker would choose, [time, x, y]."""
    time = numpy.arange(2, 2 + seconds, step)
    return numpy.stack([time, -5 + 1.2 * (time - 2), numpy.sin(1.5 * time)], 1).round(4)


def csv_of(ways):
    rows = [f"{person},{t},{x},{y}" for person, way in enumerate(ways) for t, x, y in way.tolist()]
    return "id,time,x,y\n" + "\n".join(rows) + "\n"


def expected(way, frames):
    at = numpy.arange(frames) / RATE
    there = (at >= way[0, 0] - 1e-6) & (at <= way[-1, 0] + 1e-6)
    return there, numpy.stack([numpy.interp(at, way[:, 0], way[:, axis]) for axis in (1, 2)], 1)


@pytest.mark.parametrize("source", ["file", "ways"])
@pytest.mark.quick
def test_they_are_where_their_ways_say(throng, tmp_path, source):
    way, still = winding(6), numpy.array([[0.0, 8, 8], [30, 8, 8]])
    told = {"id": "given", "file": "seen.csv"} if source == "file" else {
        "id": "given", "ways": [way.tolist(), still.tolist()]}
    ways = [way, still] if source == "ways" else [way]
    pos, dir, state = bake(throng, tmp_path, {"given": [told]}, files={"seen.csv": csv_of([way])})
    for row, each in enumerate(ways):
        there, places = expected(each, len(pos))
        assert numpy.array_equal(state[:, row, 0] > 0.5, there)
        assert numpy.abs(pos[there, row, :2] - places[there]).max() < 1e-4
    # With strides like everybody else's, and facing where it goes.
    there, _ = expected(way, len(pos))
    phase, speed = state[there, 0, 2], dir[there, 0, 2]
    assert phase[-1] - phase[0] > 3 and 1 < numpy.median(speed) < 2
    velocity = numpy.diff(pos[there, 0, :2], axis=0)
    facing = dir[there, 0, :2][:-1]
    assert (velocity * facing).sum(1).mean() > 0.8 * numpy.hypot(*velocity.T).mean()
    with open(tmp_path / "bake" / "agents.csv", newline="") as file:
        assert {row["kind"] for row in csv.DictReader(file)} == {"given"}


@pytest.mark.quick
def test_rounded_seconds_make_nobody_vanish(throng, tmp_path):
    """A file of 30 frames a second, whose times have two decimals."""
    time = (2 + numpy.arange(150) / 30).round(2)
    way = numpy.stack([time, 1.2 * (time - 2), 0 * time], 1)
    pos, _, state = bake(throng, tmp_path, {"given": [{"id": "given", "file": "seen.csv"}]},
                         files={"seen.csv": csv_of([way])})
    there, places = expected(way, len(pos))
    seen = state[:, 0, 0] > 0.5
    assert pos.shape[1] == 1 and (numpy.diff(numpy.flatnonzero(seen)) == 1).all()
    assert abs(int(seen.sum()) - int(there.sum())) <= 2  # at the ends, by a hundredth of a second
    assert numpy.abs(pos[there & seen, 0, :2] - places[there & seen]).max() < 0.02


def test_others_walk_round_them(throng, tmp_path):
    """One stands in the way, and one comes along it."""
    told = {"given": [{"id": "given", "people": {"radius": 0.25},
                       "ways": [[[0, 0, 0.05], [60, 0, 0.05]], [[0, 12, -0.05], [10.8, 1.2, -0.05]]]}],
            "formations": [{"id": "walker", "type": "agents", "arrival": "leave",
                            "agents": [{"position": [-6, 0], "goal": [8, 0], "speed": 1.3, "radius": 0.25}]}]}
    pos, _, state = bake(throng, tmp_path, told)
    walker, there = pos[:, 0, :2], state[:, 0, 0] > 0.5
    for row in (1, 2):
        assert numpy.hypot(*(walker - pos[:, row, :2]).T)[there].min() > 0.495
    assert not there[-1]  # it has arrived
    figures = json.loads(throng("measure", tmp_path / "bake", "--json").stdout)
    assert figures["agents"] == 1 and figures["arrived"] == 1 and figures["deepest_overlap_percent"] == 0
    assert figures["given"]["people"] == 2 and figures["given"]["deepest_overlap_percent"] < 1


@pytest.mark.quick
def test_what_they_walk_through_is_theirs(throng, tmp_path):
    """Through each other, and through a wall."""
    told = {"given": [{"id": "given", "ways": [[[0, -4, 0], [8, 4, 0]], [[0, 4, 0], [8, -4, 0]]]}],
            "walls": [{"points": [[2, -1], [2, 1]]}],
            "formations": [{"id": "one", "type": "agents", "agents": [{"position": [0, 9], "goal": [0, 9]}]}]}
    bake(throng, tmp_path, told)
    figures = json.loads(throng("measure", tmp_path / "bake", "--json").stdout)
    assert figures["wall_crossings"] == 0 and figures["overlapping_percent"] == 0
    assert figures["given"]["wall_crossings"] >= 2 and figures["given"]["deepest_overlap_percent"] > 90


@pytest.mark.quick
def test_a_crowd_makes_room(throng, tmp_path):
    """Somebody given walks through a dense crowd that stands, and nobody moves it."""
    told = {"given": [{"id": "given", "ways": [[[1, -4, 0.02], [9, 4, 0.02]]]}],
            "formations": [{"id": "crowd", "type": "grid", "origin": [-2, -2], "rows": 7, "columns": 7, "spacing": 0.66,
                            "goal": {"offset": [0, 0]}, "people": {"radius": 0.25}}]}
    pos, _, state = bake(throng, tmp_path, told)
    there = state[:, 49, 0] > 0.5
    at = numpy.arange(len(pos)) / RATE
    assert numpy.abs(pos[there, 49, 0] - (-4 + (at[there] - 1))).max() < 1e-4
    figures = json.loads(throng("measure", tmp_path / "bake", "--json").stdout)
    assert figures["given"]["deepest_overlap_percent"] < 8, figures["given"]


@pytest.mark.quick
def test_another_bake_is_a_file_of_ways(throng, tmp_path):
    """Its people walk where they walked, two seconds later and aside."""
    people = [{"position": [0, y], "goal": [9, 2 - y], "speed": 1.3} for y in (0, 1, 2)]
    (tmp_path / "first").mkdir()
    first, *_ = bake(throng, tmp_path / "first", {"simulation": {"duration": 6}, "formations": [
        {"id": "people", "type": "agents", "agents": people}]})
    again, _, state = bake(throng, tmp_path, {"given": [
        {"id": "given", "file": "first/bake", "start": 2, "offset": [0, 5]}]})
    there = state[:, :, 0] > 0.5
    assert not there[:2 * RATE].any() and there[2 * RATE:2 * RATE + len(first)].all()
    shown = again[2 * RATE:2 * RATE + len(first), :, :2]
    assert numpy.abs(shown - first[:, :, :2] - [0, 5]).max() < 1e-3


BAD = {
    "id,time,x,y\n0,0,0,0\n0,1,one,0\n": "bad.csv: 3:5",
    "id,frame,x,y\n0,0,0,0\n0,1,1,0\n": "frames a second",
    "id,time,x,y\n0,0,0,0\n0,1,1,0\n0,1,2,0\n": "two places",
    "id,time,x,y\n0,0,0,0\n": "frames a second",
    "": "frames a second",
    "id,time,x,y\n0,0,0,0\n1,1,1,0\n": "nobody in",
}


@pytest.mark.parametrize("text, words", BAD.items(), ids=range(len(BAD)))
@pytest.mark.quick
def test_bad_files_are_told(throng, tmp_path, text, words):
    (tmp_path / "bad.csv").write_text(text)
    (tmp_path / "layout.json").write_text('{"throng": 1, "given": [{"id": "given", "file": "bad.csv"}]}')
    told = throng("bake", tmp_path / "layout.json", "-o", tmp_path / "bake", expect=3).stderr
    assert words in told and "layout.json:1:" in told and "bad.csv" in told
    assert not (tmp_path / "bake").exists()


@pytest.mark.parametrize("given, words", [
    ({}, "exactly one of `file`"),
    ({"file": "none.csv"}, "none.csv"),
    ({"file": "a.csv", "ways": [[[0, 0, 0], [1, 1, 1]]]}, "exactly one of `file`"),
    ({"ways": [[[0, 0, 0]]]}, "2 to"),
    ({"ways": [[[0, 0, 0], [0, 1, 1]]]}, "comes after one at 0 s"),
    ({"ways": [[[0, 0], [1, 1]]]}, "[time, x, y]"),
    ({"ways": [[[0, 0, 0], [1, 1, 1]]], "fps": 5}, "`fps` has no meaning"),
])
@pytest.mark.quick
def test_mistakes_are_told(throng, tmp_path, given, words):
    (tmp_path / "layout.json").write_text(json.dumps({"throng": 1, "given": [{"id": "given", **given}]}))
    told = throng("check", tmp_path / "layout.json", expect=3).stderr
    assert words in told and "layout.json:1:" in told


@pytest.mark.quick
def test_people_who_are_too_fast_are_told_of(throng, tmp_path):
    """As where centimetres are taken for metres."""
    ways = [[[0, 0, 0], [5, 600, 0]], [[0, 0, 2], [5, 6, 2]]]
    (tmp_path / "layout.json").write_text(json.dumps({"throng": 1, "given": [{"id": "given", "ways": ways}]}))
    assert "1 of 2 people are faster than 10 m/s" in throng("check", tmp_path / "layout.json").stderr


@pytest.mark.parametrize("wall", [0.68, 0.72, 0.75])
@pytest.mark.parametrize("people", [{"body": "adult"}, {"radius": 0.235}], ids=["body", "disc"])
def test_nobody_is_pushed_through_a_wall_by_who_appears(throng, tmp_path, people, wall):
    """The wall is further off than a body reaches when the push begins, and within it before the step ends."""
    layout = {"throng": 1, "simulation": {"duration": 4, "seed": 1, "tile_radius": 1.0, "smoothing": 0},
              "walls": [{"points": [[wall, -6], [wall, 6]], "thickness": 0.02}],
              "formations": [{"id": "stands", "type": "agents", "arrival": "stay", "people": people,
                              "agents": [{"position": [0, 0], "goal": [0, 0], "heading": 0}]}],
              "given": [{"id": "appears", "people": {"radius": 0.9}, "ways": [[[1, -0.1, 0], [3.9, -0.1, 0]]]}]}
    (tmp_path / "layout.json").write_text(json.dumps(layout))
    throng("bake", tmp_path / "layout.json", "-o", tmp_path / "bake", "-q", "--no-gltf")
    places = numpy.load(tmp_path / "bake" / "streams" / "pos.npy")[:, 0, 0]
    assert 0.2 < places.max() < wall - 0.01  # pushed, and kept off
    assert json.loads(throng("measure", tmp_path / "bake", "--json").stdout)["wall_crossings"] == 0
