# SPDX-License-Identifier: Apache-2.0
"""People who have a seat: their poses, and which of them Blender shows when."""
import json
import math
import pathlib
import struct

import numpy
import pytest

from pose_names import pose_name
from results import result_of
from sample_bake import SMALL_CAST, write_bake
from throng import cast
from throng.cast import gait, people, seat_mouths, seat_rows, sitting

HERE = pathlib.Path(__file__).resolve().parent
ADDON = HERE.parent.parent / "blender_addon"
BUILD = gait.Build()
ALL = len(sitting.CLIPS)


def angle(a, b, c):
    """At b, degrees."""
    u, v = numpy.subtract(a, b), numpy.subtract(c, b)
    return math.degrees(math.acos(u @ v / (numpy.linalg.norm(u) * numpy.linalg.norm(v))))


def leg_of(pose, build):
    hip = (pose.pelvis[0], pose.pelvis[2] - gait.HIP_DROP)
    ankle = pose.feet[0].ankle
    return hip, gait.knee_of(hip, ankle, build), ankle


@pytest.mark.parametrize("size", [0.92, 1.0, 1.08])
def test_who_sits_has_bent_knees_level_thighs_and_feet_on_the_ground(size):
    build = BUILD.scaled(size)
    for pose in sitting.poses_of(build, 1):
        hip, knee, ankle = leg_of(pose, build)
        assert abs(angle(hip, knee, ankle) - 90.0) < 10.0
        assert abs(math.degrees(math.asin((knee[1] - hip[1]) / build.thigh))) < 9.0
        assert ankle[1] == pytest.approx(build.ankle, abs=0.001)


def test_a_childs_feet_dangle():
    build = people.build_of(people.CAST[11])
    hip, knee, ankle = leg_of(sitting.sitting(build), build)
    assert ankle[1] > build.ankle + 0.01 and knee[1] > hip[1] - 0.1


def test_clips_begin_and_end_where_others_do():
    first = {clip.name: sitting.poses_in(number) for number, clip in enumerate(sitting.CLIPS)}
    last = {clip.name: sitting.poses_in(number) + clip.poses - 1 for number, clip in enumerate(sitting.CLIPS)}
    poses = sitting.poses_of(BUILD, ALL)
    apart = lambda one, other: max(abs(a - b) for a, b in zip(flat(poses[one]), flat(poses[other])))
    assert apart(first["sit"], first["ready"]) < 0.01 and apart(first["sit"], first["rise"]) < 0.01
    assert apart(last["ready"], first["clap"]) < 0.01
    assert apart(last["rise"], first["cheer"]) < 0.01 and apart(last["rise"], first["sing"]) < 0.01
    assert apart(first["sit"], last["rise"]) > 0.3
    assert apart(first["sit"], first["settle"]) < 0.01
    for name in ("applaud", "jubilate", "sway", "wave"):
        assert apart(last["raise"], first[name]) < 0.01, name
    standing = flat(gait.idle_pose(BUILD))
    for pose in (last["settle"], first["raise"]):  # who stands has its arms at its sides
        assert max(abs(a - b) for a, b in zip(flat(poses[pose]), standing)) < 0.01


def test_feet_are_drawn_back_and_then_stay_while_one_gets_up():
    """In the bake the place moves, by as much as the pose takes back."""
    clip = next(number for number, clip in enumerate(sitting.CLIPS) if clip.name == "settle")
    feet = []
    for index in range(25):
        share = index / 24
        pose = sitting.seated_pose(clip, share, BUILD)
        feet.append(pose.feet[0].ankle[0] + sitting.AHEAD * share * share * (3.0 - 2.0 * share))
    moved = numpy.diff(feet)
    assert (moved < 1e-9).all(), "back only"
    assert numpy.abs(moved[17:]).max() < 1e-9 and abs(feet[-1] - sitting.AHEAD) < 0.03
    assert abs(feet[0] - sitting.sitting(BUILD).feet[0].ankle[0]) < 1e-9


def test_nobody_jumps_within_a_clip():
    poses = sitting.poses_of(BUILD, ALL)
    for number, clip in enumerate(sitting.CLIPS):
        own = [flat(each) for each in poses[sitting.poses_in(number):][:clip.poses]]
        steps = [max(abs(a - b) for a, b in zip(one, other)) for one, other in zip(own, own[1:])]
        assert max(steps) < 0.55, clip.name


def flat(value):
    if isinstance(value, (int, float)):
        return [float(value)]
    if isinstance(value, gait.Foot):
        return flat(value.ankle)
    if isinstance(value, gait.Pose):
        return [number for each in (value.pelvis, value.lean, value.tilt, value.feet, value.arms, value.aside)
                for number in flat(each)]
    return [number for each in value for number in flat(each)]


def test_rows_on_a_terrain_are_built_from_below_the_ground_up_to_their_heights():
    row = {"line": [[0, 0], [0.5, 0], [2, 0]], "height": 3.0, "heights": [3.0, 3.2, 4.1]}
    block = {"pitch": 0.8, "width": 0.5, "rise": 0.0, "ground": 1.5, "rows": [row]}
    seats = seat_rows.seats_of(block, row)
    assert [place[0] for place, _, _ in seats] == pytest.approx([0.25, 0.75, 1.25, 1.75])
    assert [height for _, _, height in seats] == pytest.approx([3.1, 3.35, 3.65, 3.95])
    faces = list(seat_rows.step_faces(*seat_rows.step_of(block, row), seat_rows.heights_of(row),
                                      seat_rows.bottom_of(block, row)))
    tops = {round(x, 6): max(z for face in faces for u, _, z in face if u == x) for face in faces for x, _, _ in face}
    assert tops == {0.0: 3.0, 0.5: 3.2, 2.0: 4.1}
    assert {z for face in faces for _, _, z in face} == {3.0, 3.2, 4.1, 1.2}, "0.3 m into the ground"


def test_steps_of_an_aisle_on_a_terrain_lead_from_the_ground():
    aisle = {"line": [[0, -1.5], [0, -0.4], [0, 0.6]], "width": 1.2, "heights": [2.0, 2.2, 2.5]}
    block = {"pitch": 1.0, "rise": 0.0, "rows": [{"line": [[0, 0], [1, 0]], "height": 2.2}], "ground": 1.9}
    assert [height for _, _, height in seat_rows.treads_of(block, aisle)] == pytest.approx([2.1, 2.2, 2.35, 2.5])
    level = {key: value for key, value in aisle.items() if key != "heights"}
    block["rise"] = 0.3
    assert [height for _, _, height in seat_rows.treads_of(block, level)] == pytest.approx([1.1, 2.2, 2.35, 2.5])


def test_clips_are_the_activities_of_the_bake():
    text = (HERE.parent.parent / "base" / "activities.h").read_text()
    for number, word in enumerate(("sits", "readies", "claps", "rises", "cheers", "sings", "settles", "raises",
                                   "applauds", "jubilates", "sways", "waves")):
        assert f"{word} = {sitting.FIRST + number}," in text
    assert all(clip.poses % cast.BEATS == 0 for clip in sitting.CLIPS)


def test_only_casts_of_bakes_with_seats_sit():
    without = cast.Repertoire((1.4,), 0)
    audience, everything = (cast.Repertoire((1.4,), 0, sitting.clips_for(poses)) for poses in ("audience", "all"))
    assert audience.count == without.count + 44 and everything.count == audience.count + 68
    for with_seats in (audience, everything):
        for level in range(cast.LEVELS):
            assert len(with_seats.sources(level)) == with_seats.poses(level)
            assert with_seats.upright(level) == without.poses(level)


OPENING = {"pitch": 0.9, "rise": 0.4}
PASSAGE = {"line": [[0, -9.25], [0, -3.15], [0, -2.3]], "heights": [-1.5, 1.2, 1.2], "width": 1.2}
SIDE = {"line": [[0, -2.3 - 0.9 * row] for row in range(4)], "heights": [1.2, 1.6, 2.0, 2.4], "width": 0.9}
FLIGHTS = [{"line": [[0, 0.4 - 0.9 * row] for row in range(4)], "heights": [0, 0.4, 0.8, 1.2], "width": 1.2},
           *({**SIDE, "line": [[x, y] for _, y in SIDE["line"]]} for x in (1.15, -1.15))]


def test_one_walks_through_an_opening_and_over_it():
    """Nothing stands across the passage at the height of a chest, and something lies over it where rows go on."""
    aisle = {"line": PASSAGE["line"], "width": 1.2, "passage": PASSAGE, "flights": FLIGHTS}
    mouth = seat_mouths.Mouth(OPENING, aisle)
    assert mouth.rows == 3 and len(mouth.sides) == 2 and mouth.length == pytest.approx(6.1)
    faces = [numpy.array(face) for face in seat_mouths.faces_of({**OPENING, "aisles": [aisle]}, aisle)]
    over = []
    for y in numpy.arange(-9.0, -2.4, 0.1):
        floor = mouth.floor(-3.15 - y)
        for face in faces:
            low, high = face.min(axis=0), face.max(axis=0)
            across = high[1] - low[1] < 1e-6 and low[0] < 0.0 < high[0]
            assert not (across and abs(low[1] - y) < 0.05 and low[2] < floor + 1.2 < high[2]), y
        over.append(any(face[:, 0].min() < 0 < face[:, 0].max() and face[:, 1].min() <= y <= face[:, 1].max()
                        and floor + 2.0 < face[:, 2].mean() < floor + 3.5 for face in faces))
    assert not over[-1] and over[0] and over[len(over) // 2]
    tops = {round(float(face[:, 2].max()), 6) for face in faces if numpy.ptp(face[:, 2]) < 1e-6}
    assert {0.0, 0.2, 0.4, 0.8, 1.2, 1.6, 2.0, 2.4} <= tops, "two steps to a row"


def seated_bake(folder, agents=24, frames=40, clips=ALL):
    """A sample bake all of whose people have a seat or do something with their hands, each in another clip. Returns the
    states."""
    _, direction, state = write_bake(folder, agents=agents, frames=frames, **SMALL_CAST)
    rows = numpy.arange(agents)
    state[..., 0] = sitting.FIRST + rows % clips
    state[..., 2] = 0.03 * numpy.arange(len(state))[:, None] + 0.37 * rows
    direction[..., 2] = 0.0
    for name, stream in (("state", state), ("dir", direction)):
        with open(folder / "streams" / f"{name}.pc2", "wb") as file:
            file.write(struct.pack("<12siiffi", b"POINTCACHE2\0", 1, agents, 1.0, 1.0, frames) + stream.tobytes())
    manifest = json.loads((folder / "bake.json").read_text())
    manifest["geometry"]["seats"] = [{"id": "north", "pitch": 0.8, "width": 0.5, "rise": 0.4, "rows": [
        {"line": [[0, 0], [5, 0]], "height": 0.5}, {"line": [[0, -0.8], [5, -0.8]], "height": 0.9}]}]
    manifest["geometry"]["walls"].append({"id": "north stand", "closed": True, "height": 0.01, "thickness": 0.2,
                                          "points": [[0, 0.4], [5, 0.4], [5, -1.2], [0, -1.2]]})
    if clips == ALL:
        manifest["poses"] = True
        manifest["geometry"]["seats"][0]["aisles"] = [{"line": [[6, 1.1], [6, 0.3], [6, -0.5]], "width": 1.2}]
    (folder / "bake.json").write_text(json.dumps(manifest))
    return state


def expected(state, row, level):
    clip = int(state[row, 0]) - sitting.FIRST
    phase, share = float(state[row, 2]) % 1.0, cast.BEATS // cast.LEVEL_BEATS[level]
    count = sitting.CLIPS[clip].poses // share
    if sitting.CLIPS[clip].there_and_back:
        place = (1.0 - abs(2.0 * phase - 1.0)) * (count - 1)
        near = {math.floor(place + 0.5 + hair) for hair in (-1e-3, 0.0, 1e-3)}
    else:
        near = {min(math.floor(phase * count + hair), count - 1) for hair in (-1e-3, 0.0, 1e-3)}
    repertoire = cast.Repertoire((1.0,), 1, ALL)
    first = repertoire.upright(level) + sitting.poses_in(clip) // share
    return {pose_name(int(state[row, 1]), first + each, level) for each in near}


def test_blender_shows_everybody_in_the_pose_of_the_moment(blender, tmp_path):
    state = seated_bake(tmp_path / "bake")
    result = result_of(blender(HERE / "check_seats.py", ADDON, tmp_path / "bake"))
    for shot in result["shots"]:
        assert len(shot["people"]) == 24
        for row, name in shot["people"].items():
            wanted = expected(state[shot["frame"] - 1], int(row), shot["level"])
            assert not wanted.isdisjoint(name.split("|")), (shot["frame"], row, name, wanted)
    sits, risen, cheers, stands = result["hips"]
    assert sits < stands - 0.3 and abs(risen - stands) < 0.03 and abs(cheers - stands) < 0.03, "heroes do the same"
    assert list(result["stands"]) == ["Throng stand north"]
    assert result["stands"]["Throng stand north"]["faces"] > 20 * 8 + 4 * 5
    assert result["stands"]["Throng stand north"]["top"] == pytest.approx(0.9 + 0.42 + 0.36, abs=0.01)
    assert "Throng wall north stand" not in result["walls"] and len(result["walls"]) == 3


def test_a_full_stadium_scrubs_as_quickly_as_a_walking_crowd(blender, tmp_path):
    """The bar that 16,384 who walk have, in processor time."""
    seated_bake(tmp_path / "bake", agents=16384, frames=28, clips=sitting.AUDIENCE)
    found = result_of(blender(HERE / "check_speed.py", ADDON, tmp_path / "bake"))
    assert found["people"] == 16384 and 1000.0 * found["frame"] < 18.0, found
