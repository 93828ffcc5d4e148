# SPDX-License-Identifier: Apache-2.0
"""Patches with a size: how broad bodies are changes with place and time, at a bounded rate, and all that measures goes
by the size of the moment."""
import json
import math

import numpy
import pytest

GROWTH = 0.1   # m/s, of a radius
STEPS = 1 / 12  # s: sizes change where people decide


def ground(size, polygon=((-90, -90), (90, -90), (90, 90), (-90, 90)), **told):
    return {"id": "rain", "polygon": [list(point) for point in polygon], "size": size, **told}


def walker(position, goal, **told):
    return {"position": list(position), "goal": list(goal), "speed": 1.3, **told}


def layout(patches, agents=(), duration=20, people=None, **others):
    formation = {"id": "people", "type": "agents", "agents": list(agents), "people": people or {"radius": 0.25}}
    return {"throng": 1, "simulation": {"duration": duration}, "patches": patches, "formations": [formation], **others}


def baked(throng, folder, told, *options):
    """The folder of the bake, and its streams."""
    (folder / "layout.json").write_text(json.dumps(told))
    throng("bake", folder / "layout.json", "-o", folder / "bake", "-q", "--no-gltf", *options)
    streams = folder / "bake" / "streams"
    return folder / "bake", {file.stem: numpy.load(file) for file in streams.glob("*.npy")}


def measured(throng, bake):
    return json.loads(throng("measure", bake, "--json").stdout)


@pytest.mark.parametrize("size", [0.5, 1.6, 2])
@pytest.mark.quick
def test_somebody_is_as_large_as_the_ground_makes_it_and_then_itself(throng, tmp_path, size):
    patch = ground(size, ((0, -5), (10, -5), (10, 5), (0, 5)))
    _, streams = baked(throng, tmp_path, layout([patch], [walker((-6, 0), (20, 0))], 24))
    x, radius = streams["pos"][:, 0, 0], 0.5 * streams["size"][:, 0, 1]
    assert numpy.allclose(streams["size"][:, 0, 0], radius / 0.25) and numpy.array_equal(*streams["size"][:, 0, 1:].T)
    assert (radius[x < 0] == 0.25).all()
    begin, end = numpy.argmax(x > 0) / 24, numpy.argmax(x > 10) / 24
    for frame in range(len(x)):
        time = frame / 24
        away = abs(0.25 * size - 0.25)
        since = numpy.clip(GROWTH * (time - begin), 0, away) - numpy.clip(GROWTH * (time - end), 0, away)
        assert radius[frame] == pytest.approx(0.25 + math.copysign(since, size - 1), abs=1.5 * GROWTH * STEPS)
    assert abs(radius - 0.25).max() == pytest.approx(abs(0.25 * size - 0.25))
    assert radius[-1] == 0.25


@pytest.mark.quick
def test_sizes_begin_and_end_and_are_multiplied(throng, tmp_path):
    patches = [ground(1.5, **{"from": 2, "until": 12}), {**ground(1.8, **{"from": 6}), "id": "storm"}]
    _, streams = baked(throng, tmp_path, layout(patches, [walker((0, 0), (0.1, 0))], 20))
    at = lambda second: streams["size"][round(24 * second), 0, 0]
    assert [at(1.9), at(19.9)] == [1, pytest.approx(1.8)]
    assert at(5) == pytest.approx(1.5)
    assert at(11) == pytest.approx(2)  # not 2.7


@pytest.mark.quick
def test_people_at_rest_spread_and_are_in_nobody(throng, tmp_path):
    spots = [(0.55 * (i % 9), 0.55 * (i // 9)) for i in range(63)]
    walls = [{"points": [[-1.2, -1], [5.6, -1], [5.6, 4.6], [-1.2, 4.6], [-1.2, -1]], "thickness": 0.1}]
    told = layout([ground(1.3, **{"from": 1})], [walker(spot, spot) for spot in spots], 14, walls=walls)
    bake, streams = baked(throng, tmp_path, told)
    assert streams["size"][-1, :, 0] == pytest.approx(1.3)
    found = measured(throng, bake)
    assert found["deepest_overlap_percent"] < 2 and found["deepest_wall_penetration"] < 0.002
    gaps = numpy.linalg.norm(streams["pos"][-1, :, None, :2] - streams["pos"][-1, None, :, :2], axis=-1)
    assert (gaps + 9 * numpy.eye(63)).min() > 0.98 * 0.65


def test_where_there_is_no_room_nobody_grows_into_anybody(throng, tmp_path):
    """Sixty-four in a room that holds them as they are, and never twice as large."""
    spots = [(0.55 * (i % 8), 0.55 * (i // 8)) for i in range(64)]
    walls = [{"points": [[-0.4, -0.4], [4.25, -0.4], [4.25, 4.25], [-0.4, 4.25], [-0.4, -0.4]]}]
    told = layout([ground(2, **{"from": 1})], [walker(spot, spot) for spot in spots], 10, walls=walls)
    bake, streams = baked(throng, tmp_path, told)
    assert 1.05 < streams["size"][-1, :, 0].mean() < 1.25
    area = (math.pi * (0.25 * streams["size"][-1, :, 0]) ** 2).sum()
    assert area < 0.9069 * 4.65 ** 2  # the densest that discs lie
    assert measured(throng, bake)["deepest_wall_penetration"] < 0.002


@pytest.mark.quick
def test_bodies_that_are_no_discs_keep_their_shape(throng, tmp_path):
    people = {"body": {"breadth": 0.48, "depth": 0.24}}
    told = layout([ground(1.25, **{"from": 1})], [walker((0, 0), (30, 0))], 8, people)
    bake, streams = baked(throng, tmp_path, told)
    assert streams["size"][0, 0] == pytest.approx([1, 0.48, 0.24], abs=1e-6)
    assert streams["size"][-1, 0] == pytest.approx([1.25, 0.6, 0.3], abs=1e-6)
    assert streams["chest"][-1, 0, 2] == pytest.approx(0.6, abs=0.02)  # as broad, across the way it faces


@pytest.mark.quick
def test_measuring_goes_by_the_size_of_the_moment(throng, tmp_path):
    """Two given people 0.6 m apart: bodies of 0.25 m are clear of each other, and of 0.4 m are not."""
    ways = [[[0, 0, y], [10, 0.01, y]] for y in (0, 0.6)]
    given = [{"id": "given", "ways": ways, "people": {"radius": 0.25}}]
    told = {"throng": 1, "simulation": {"duration": 8}, "given": given, "patches": [ground(1.6, **{"from": 2})]}
    bake, streams = baked(throng, tmp_path, told)
    assert streams["size"][-1, :, 1].sum() == pytest.approx(1.2, abs=0.01)  # they have grown until they touch
    assert measured(throng, bake)["given"]["deepest_overlap_percent"] < 0.1
    factors = streams["size"]
    factors[48:, :, 0] = 1.6
    numpy.save(bake / "streams" / "size.npy", factors)
    assert measured(throng, bake)["given"]["deepest_overlap_percent"] == pytest.approx(25, abs=0.1)


def test_levels_have_their_own(throng, tmp_path):
    floor = [[-9, -9], [9, -9], [9, 9], [-9, 9]]
    people = lambda name: {"id": name, "type": "agents", "level": name, "agents": [walker((0, 0), (1, 0))],
                           "people": {"radius": 0.25}}
    told = {"throng": 1, "simulation": {"duration": 6},
            "levels": [{"id": "low", "height": 0, "floor": floor}, {"id": "high", "height": 4, "floor": floor}],
            "patches": [{**ground(1.5, floor), "level": "high"}], "formations": [people("low"), people("high")]}
    _, streams = baked(throng, tmp_path, told)
    assert streams["size"][-1, :, 0].tolist() == [1, pytest.approx(1.5)]


def test_on_large_sites_too(throng, tmp_path):
    """Sixteen square kilometres: the diagram is kept in pages."""
    far = [{"points": [[-2000, -2000], [-1999, -2000]]}, {"points": [[2000, 2000], [1999, 2000]]}]
    patch = ground(2, ((-9, -9), (9, -9), (9, 9), (-9, 9)))
    told = layout([patch], [walker((0, 0), (0.5, 0)), walker((1.5, 0.2), (2, 0.2)), walker((50, 0), (51, 0))], 6,
                  walls=far)
    bake, streams = baked(throng, tmp_path, told)
    assert streams["size"][-1, :, 0].tolist() == [pytest.approx(2), pytest.approx(2), 1]
    assert measured(throng, bake)["deepest_overlap_percent"] < 2


@pytest.mark.quick
def test_forms_and_resumed_bakes_have_the_same(throng, tmp_path):
    spots = [(0.6 * (i % 5), 0.6 * (i // 5)) for i in range(20)]
    told = layout([ground(1.4, **{"from": 1})], [walker(spot, spot) for spot in spots], 4)
    bake, streams = baked(throng, tmp_path, told, "--streams", "npy,packed")
    throng("verify", bake)
    about = json.loads((bake / "bake.json").read_text())
    assert about["streams"]["size"]["units"] == ["1", "m", "m"] and about["geometry"]["patches"][0]["size"] == 1.4


@pytest.mark.quick
def test_layouts_without_sizes_have_no_such_stream(throng, tmp_path):
    patch = {**ground(1, **{"from": 1}), "pace": 0.8}
    bake, streams = baked(throng, tmp_path, layout([patch], [walker((0, 0), (3, 0))], 2))
    assert "size" not in streams and "size" not in json.loads((bake / "bake.json").read_text())["geometry"]["patches"][0]
    _, streams = baked(throng, tmp_path, layout([patch], [walker((0, 0), (3, 0))], 2), "--size", "--force")
    assert (streams["size"][..., 0] == 1).all() and streams["size"][..., 1:] == pytest.approx(0.5)


@pytest.mark.parametrize("patch, words", [
    (ground(0.4), "expected at least 0.5 and at most 2"), (ground(2.1), "expected at least 0.5 and at most 2"),
    (ground("large"), "expected a number"), ({"polygon": [[0, 0], [2, 0], [2, 2]]}, "neither `cost` nor `pace` nor `size`"),
    ({**ground(1.2), "level": "none"}, "none"),
])
@pytest.mark.quick
def test_mistakes_are_told(throng, tmp_path, patch, words):
    (tmp_path / "layout.json").write_text(json.dumps(layout([patch], [walker((0, 0), (0, 0.5))])))
    told = throng("check", tmp_path / "layout.json", expect=3).stderr
    assert words in told and "layout.json:1:" in told


@pytest.mark.quick
def test_copies_are_as_large_and_are_found_in_others(throng, tmp_path):
    """Two who stand 1.5 m apart; a copy of one stands 0.9 m from the other, which is too near at twice their size."""
    for size, pairs in ((2, 1), (1.5, 0)):
        folder = tmp_path / f"{size}"
        folder.mkdir()
        bake, _ = baked(throng, folder, layout([ground(size)], [walker((0, 0), (0, 0)), walker((1.5, 0), (1.5, 0))], 6))
        layer = {"name": "copies", "who": {"near": {"point": [1.5, 0], "within": 0.5}},
                 "do": {"duplicate": {"copies": 1, "by": [0.9, 0, 0]}}}
        (folder / "changes.json").write_text(json.dumps({"throng_overrides": 1, "overrides": [], "layers": [layer]}))
        throng("apply", bake, "--overrides", folder / "changes.json", "-o", folder / "applied", "-q")
        about = json.loads((folder / "applied" / "bake.json").read_text())
        assert numpy.load(folder / "applied" / "streams" / "size.npy")[-1, :, 0].tolist() == pytest.approx([size] * 3)
        assert about["applied"]["overlaps"]["pairs"] == pairs
