# SPDX-License-Identifier: Apache-2.0
"""Feet of near people are held where the bake says, trunks turn and heads look as it says, in a real Blender:
Debian's and the newest."""
import json
import struct

import numpy
import pytest

from conftest import blender_module, blender_program
from results import ADDON, HERE, result_of
from sample_bake import write_bake

pytestmark = pytest.mark.parametrize("blender", [blender_program, blender_module], indirect=True,
                                     ids=["blender", "bpy"])
AGENTS, TURN_STEPS = 12, 512.0
# row: (of the left foot forward, left, turn, lift; the same of the right one); others stay as they are
MOVES = {0: ((0.10, -0.04, 0.0, 0.0), (0.0, 0.0, 0.0, 0.0)), 1: ((0.0, 0.0, 0.0, 0.0), (-0.08, 0.06, 0.0, 0.03)),
         2: ((0.0, 0.0, 0.5, 0.0), (0.0, 0.0, -0.7, 0.05)), 3: ((0.05, 0.05, -0.3, 0.04), (-0.05, 0.0, 0.9, 0.0)),
         4: ((0.40, 0.10, 0.0, 0.0), (-0.40, -0.10, 0.0, 0.0))}
FAR = 4  # whose legs are too short for it
GAZES = {7: (0.9, 0.0), 8: (-0.5, 0.0), 9: (0.0, 0.4)}  # row: yaw, pitch
CARRIAGES = {5: (0.6, 0.0), 6: (-0.4, 0.0), 10: (0.0, 0.12)}  # row: twist, lean
STOPS = 11  # whose pose stands in the middle of a stride


@pytest.fixture(scope="module")
def seen(blender, bodies, tmp_path_factory):
    folder = tmp_path_factory.mktemp("limbs") / "bake"
    pos, way, _ = write_bake(folder, agents=AGENTS, variations=4, gaits=(1, 2))
    feet = numpy.zeros((2, *pos.shape), numpy.float32)
    for row, both in MOVES.items():
        for side, (forward, left, turn, lift) in enumerate(both):
            feet[side, :, row] = forward, left, round(turn * TURN_STEPS) + lift
    gaze = numpy.zeros_like(feet[0])
    for row, (yaw, pitch) in GAZES.items():
        gaze[:, row, :2] = yaw, pitch
    carriage = numpy.zeros_like(feet[0])
    share = numpy.clip((way[..., 2] - 0.03) / 0.32, 0.0, 1.0)  # as it is where no stream tells it
    carriage[..., 0] = share * share * (3.0 - 2.0 * share)
    carriage[:, STOPS, 0] = 0.0
    for row, values in CARRIAGES.items():
        carriage[:, row, 1:] = values
    attention = numpy.stack([2.0 * (gaze[..., 0] - 0.5 * carriage[..., 1]), 2.0 * gaze[..., 1],
                             numpy.full(gaze.shape[:2], 0.5)], 2).astype(numpy.float32)
    manifest = json.loads((folder / "bake.json").read_text())
    for name, stream in zip(("left_foot", "right_foot", "carriage", "gaze", "attention", "no_attention"),
                            (*feet, carriage, gaze, attention, numpy.zeros_like(gaze))):
        numpy.save(folder / "streams" / f"{name}.npy", stream)
        (folder / "streams" / f"{name}.pc2").write_bytes(
            struct.pack("<12siiffi", b"POINTCACHE2\0", 1, AGENTS, 1.0, 1.0, len(pos)) + stream.tobytes())
        if "attention" in name:
            continue
        manifest["streams"][name] = {form: f"streams/{name}.{form}" for form in ("npy", "pc2")}
    (folder / "bake.json").write_text(json.dumps(manifest))
    found = result_of(blender(HERE / "check_limbs.py", ADDON, folder, environment={"THRONG_BODIES": str(bodies)}))
    found["rows"] = {int(row): value for row, value in found["rows"].items()}
    return found


def test_crowds_read_the_streams_of_feet_and_heads_where_there_are_any(seen):
    every = ["throng dir", "throng pos", "throng state"]
    assert seen["caches without"] == every
    assert seen["caches"] == sorted([*every, "throng carriage", "throng gaze", "throng left_foot",
                                           "throng right_foot"])
    assert seen["same people"]


def test_feet_are_moved_turned_and_lifted_as_the_bake_says(seen):
    for row, both in MOVES.items():
        if row == FAR:
            continue
        for name, (forward, left, turn, lift) in zip(("left", "right"), both):
            foot = seen["rows"][row][name]
            angle, off = foot["turned"]
            assert angle == pytest.approx(turn, abs=2e-3), (row, name)
            assert off < 1e-3, "feet keep their form"
            if turn == 0.0:
                assert foot["move"] == pytest.approx([forward, left, lift], abs=2e-3), (row, name)
                assert foot["apart"] < 1e-3


def test_who_is_told_nothing_stays_as_they_are(seen):
    others = [row for row in seen["rows"] if row not in (*MOVES, STOPS)]
    assert others
    for row in others:
        for name in ("left", "right"):
            assert seen["rows"][row][name]["apart"] < 1e-3
            assert numpy.abs(seen["rows"][row][name]["move"]).max() < 1e-3


def test_heads_look_where_the_bake_says(seen):
    assert set(GAZES) & set(seen["rows"]), "somebody who looks is near"
    for row in set(seen["rows"]) - {STOPS}:
        found, (yaw, pitch) = seen["rows"][row], GAZES.get(row, (0.0, 0.0))
        head = found["head"]
        assert head["stretched"] < 1e-3, row
        if pitch == 0.0:
            assert head["turned"][0] == pytest.approx(yaw, abs=2e-3) and head["turned"][1] < 1e-3, row
            if head["neck"] is not None:
                assert head["neck"] == pytest.approx(0.4 * yaw, abs=2e-3), row
        else:
            assert head["up"] > 0.5 * numpy.sin(pitch) * head["ahead"] > 0.0, "noses go up"


def test_heads_turn_on_chests_by_the_weight(seen):
    """Half of twice the turn; where there is no weight heads face where hips do, whatever they would gaze at."""
    caches, off = seen["attention"]
    assert "throng attention" in caches and "throng gaze" not in caches
    assert max(off.values()) < 1e-4
    _, off = seen["no_attention"]
    assert {int(row) for row, moved in off.items() if moved > 1e-4} == set(GAZES) & set(seen["rows"])


def test_trunks_turn_and_lean_as_the_bake_says_over_legs_that_stay(seen):
    assert set(CARRIAGES) <= set(seen["rows"])
    for row, found in seen["rows"].items():
        twist, lean = CARRIAGES.get(row, (0.0, 0.0))
        if row in (*MOVES, STOPS):
            continue
        rotation, off = found["shoulders"]
        assert rotation == pytest.approx([0.0, lean, twist], abs=2e-3) and off < 1e-3, row
        assert found["legs"] < 1e-3, row
        if row in CARRIAGES:
            assert found["head"]["rotation"] == pytest.approx([0.0, 0.0, 0.0], abs=0.01), "heads stay as they are"


def test_poses_stand_where_the_bake_says_so_though_the_speed_does_not(seen):
    strides = {row: found["stride"] for row, found in seen["rows"].items()}
    assert strides[STOPS] < 0.08 < 0.2 < max(strides.values())
    assert seen["rows"][STOPS]["legs"] > 0.1, "it walked without the stream"


def test_bones_keep_their_lengths(seen):
    for row, found in seen["rows"].items():
        assert max(found["left"]["stretched"], found["right"]["stretched"]) < 2e-3, row


def test_bodies_sink_where_legs_are_too_short(seen):
    far = seen["rows"][FAR]
    assert -0.16 < far["highest"] < -0.02
    for name, wanted in (("left", [0.40, 0.10, 0.0]), ("right", [-0.40, -0.10, 0.0])):
        assert far[name]["move"] == pytest.approx(wanted, abs=0.12), "as near as it gets"
    assert all(abs(found["highest"]) < 0.03 for row, found in seen["rows"].items() if row not in (FAR, STOPS))


def test_feet_come_and_go_as_a_bake_is_made_again(seen):
    caches, off = seen["without"]
    assert caches == seen["caches without"] and off < 1e-6
    assert len(seen["told"]) == 4 and all("re-load mends it" in each for each in seen["told"])
    off, problems, trees = seen["with"]
    assert off < 1e-6 and problems == [] and trees == 0
