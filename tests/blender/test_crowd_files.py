# SPDX-License-Identifier: Apache-2.0
"""Export Crowd as Alembic and as USD: what Blender's own importers make of the files is what the streams say."""
import json

import numpy
import pytest

from results import ADDON, HERE
from sample_bake import SMALL_CAST, write_bake

FPS, SMALLEST = 24.0, 800  # vertices of anybody's body are more


@pytest.fixture(scope="module")
def written(blender, tmp_path_factory):
    """(what came back, (pos, dir, state) of the bake)."""
    folder = tmp_path_factory.mktemp("crowd-files")
    (folder / "files").mkdir()
    streams = write_bake(folder / "bake", agents=27, **SMALL_CAST)
    blender(HERE / "check_crowd_files.py", ADDON, folder / "bake", folder / "files")
    return json.loads((folder / "files" / "result.json").read_text()), streams


@pytest.fixture
def alembic(written):
    found, streams = written
    if not found["there"]["Alembic"]:
        pytest.skip("this Blender is built without Alembic")
    return found, streams


def points_of(frame):
    return next(mesh for mesh in frame.values() if mesh["maps"])


def bodies_of(frame):
    return max(frame.values(), key=lambda mesh: len(mesh["places"]))


def arrows_of(frame):
    """What the arrows of a file say: {map: P x 2}, tips, velocities."""
    mesh = points_of(frame)
    return ({name: numpy.array(values) for name, values in mesh["maps"].items()}, numpy.array(mesh["places"])[::3],
            numpy.array(mesh["velocities"])[::3] @ numpy.array(mesh["turns"]).T)


def check_points(frames, streams, tolerance=1e-3):
    pos, direction, state = streams
    seen = set()
    for text, frame in frames.items():
        number = int(text) - 1
        maps, tips, velocities = arrows_of(frame)
        who = numpy.rint(maps["person_member"][:, 0]).astype(int)
        there = numpy.nonzero(state[number, :, 0] > 0.5)[0]
        assert sorted(who) == there.tolist()
        seen.add(len(there))
        assert numpy.abs(tips - pos[number, who]).max() < tolerance
        goes = (pos[number + 1, who] - pos[number, who]) * FPS
        assert numpy.abs(velocities - goes).max() < 0.01
        assert numpy.abs(maps["activity_phase"] - state[number, who][:, [0, 2]]).max() < 1e-4
        heading, speed = maps["heading_speed"].T
        assert numpy.abs(numpy.stack([numpy.cos(heading), numpy.sin(heading), speed], 1)
                         - direction[number, who]).max() < 1e-4
        assert (maps["size_there"] == 1.0).all()
    assert len(seen) > 1  # people came or left


def test_alembic_has_everybody_where_the_streams_have_them(alembic):
    found, streams = alembic
    check_points(found["alembic"], streams)
    assert all(len(points_of(frame)["colours"]["tint"]) == len(points_of(frame)["places"]) // 3
               for frame in found["alembic"].values())


def test_bodies_are_where_people_are_and_go_as_they_do(alembic):
    found, (pos, _, state) = alembic
    for text, frame in found["alembic"].items():
        number, mesh = int(text) - 1, bodies_of(frame)
        places, there = numpy.array(mesh["places"]), state[number, :, 0] > 0.5
        assert len(places) > SMALLEST * there.sum()
        away = numpy.linalg.norm(places[:, None, :2] - pos[None, number, :, :2], axis=2)
        assert away[:, there].min(axis=1).max() < 0.8  # no body is anybody's who is not there
        assert away[:, there].min(axis=0).max() < 0.4
        assert abs(places[:, 2].min()) < 0.05 and 1.5 < places[:, 2].max() < 2.1
        velocities, nearest = numpy.array(mesh["velocities"]), away.argmin(axis=1)
        high = places[:, 2] > 1.4  # heads: their limbs hardly move
        for row in numpy.nonzero(there)[0]:
            own = high & (nearest == row) & (away[:, row] < 0.25)
            goes = (pos[number + 1, row] - pos[number, row]) * FPS
            assert numpy.abs(velocities[own].mean(axis=0) - goes)[:2].max() < 0.25


def test_usd_by_blender_has_the_same(written):
    found, streams = written
    if not found["there"]["USD"]:
        pytest.skip("this Blender is built without USD")
    assert found["same with USD"]
    check_points(found["usd"], streams)
    assert all(len(bodies_of(frame)["places"]) > SMALLEST for frame in found["usd"].values())


def test_who_is_in_the_picture_comes_before_all_others(written):
    found, _ = written
    ahead, aside, behind, beside, above = found["away"]
    assert ahead == 10.0 and 10.0 < aside < 11.0 and min(behind, beside, above) > 1e6


def test_the_nearest_alone_and_the_set(alembic):
    found, (pos, _, _) = alembic
    for frame in found["few"].values():
        assert len(points_of(frame)["places"]) <= 9 and not any("bodies" in name for name in frame)
        assert any("wall" in name.lower() for name in frame)


def test_the_scene_stays_as_it_was_and_nothing_is_half_written(alembic):
    found, _ = alembic
    assert found["same"] and found["same after refusals"] and found["kept"]
    for told, why in zip(found["refused"], ("there is no folder", "is a folder", "is before the first",
                                            "has no coarser meshes", "nothing is asked for", "the disk is full")):
        assert why in told


def test_it_says_beforehand_what_it_takes(alembic):
    found, _ = alembic
    people, vertices, size = found["told"]
    assert people == "27 of 27 people, 29 frames" and "vertices a frame" in vertices and size.startswith("About ")
    (lines, fields), (wrong, _) = found["dialogue"]
    assert [line.removeprefix("INFO: ") for line in lines] == found["told"]
    assert {"frame_start", "frame_end", "bodies", "points", "setting", "most", "detail"} == set(fields)
    assert wrong == ["ERROR: the last frame (3) is before the first one (4)"]
    told, written_ = found["size"]
    assert abs(told / written_ - 1.0) < 0.25


def test_without_an_exporter_nobody_can_ask(written):
    found, _ = written
    assert found["asked"] == found["there"]
