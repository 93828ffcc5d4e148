# SPDX-License-Identifier: Apache-2.0
"""Playback in a real Blender: instances against the arrays, figures and poses, farms without the
add-on, large crowds."""
import json
import math
import shutil

import numpy
import pytest

from conftest import ROOT
from expected_poses import REPERTOIRE, is_expected
from results import ADDON, HERE, result_of
from sample_bake import SMALL_CAST, write_bake
from throng import cast


def wrapped(angle):
    return abs((angle + math.pi) % (2.0 * math.pi) - math.pi)


BETWEEN = [(1, 0.0), (30, 0.0), (11, 0.5), (2, 0.25), (40, 0.0), (26, 0.6), (5, 0.0), (500, 0.0), (18, 0.75)]
SHUTTER = [(frame, [(frame, 0.0), (frame - 1, 0.76), (frame, 0.24)]) for frame in (8, 19, 33)]


@pytest.fixture(scope="module")
def played(blender, tmp_path_factory):
    """(what check_playback.py has seen, the bake's pos, dir, state)."""
    folder = tmp_path_factory.mktemp("played")
    streams = write_bake(folder / "bake")
    times = BETWEEN + [time for _, open_times in SHUTTER for time in open_times]
    return result_of(blender(HERE / "check_playback.py", ADDON, folder / "bake", json.dumps(times))), *streams


@pytest.mark.quick
def test_instances_are_where_the_arrays_say_at_frames_and_between(played):
    result, pos, direction, state = played
    assert result["fps"] == 24.0 and result["range"] == [1, 40]
    for frame, hidden in result["gate"]:  # open from 0.5 to 1.2 s
        assert hidden == (13 <= frame < 30), frame
    assert len(result["shots"]) == len(BETWEEN) + 9
    for shot in result["shots"]:
        t = min(max(shot["frame"] + shot["sub"] - 1.0, 0.0), 39.0)
        low, high = int(math.floor(t)), min(int(math.floor(t)) + 1, 39)
        blend = t - low
        # `state` is read without interpolation, at the nearest frame; a half may go either way
        nearest = [k for k in {int(math.floor(t + 0.5)), int(math.ceil(t - 0.5))} if 0 <= k < 40]
        people = {int(row): values for row, values in shot["people"].items()}
        assert set(people) in [set(numpy.nonzero(state[k, :, 0] > 0.5)[0]) for k in nearest]
        for row, (name, x, y, heading) in people.items():
            at = pos[low, row] * (1.0 - blend) + pos[high, row] * blend
            assert math.hypot(at[0] - x, at[1] - y) < 1e-5
            facing = direction[low, row] * (1.0 - blend) + direction[high, row] * blend
            assert wrapped(math.atan2(facing[1], facing[0]) - heading) < 1e-4
            scene_frames = {math.floor(shot["frame"] + shot["sub"] + 0.5), math.ceil(shot["frame"] + shot["sub"] - 0.5)}
            assert any(is_expected(name, state[k], direction[low], row, frame) for k in nearest
                       for frame in scene_frames)


def test_figures_bring_every_pose_in_order(blender, tmp_path):
    found = result_of(blender(HERE / "check_sheets.py", ADDON, tmp_path))
    for figure in found["shown"]:
        assert figure["count"] == figure["expected"] and figure["faces"]
        assert figure["off"] == 0.0 and figure["velocity_off"] < 1e-4
        blurring = figure["walking"] if figure["level"] < 2 else 0
        assert figure["blurring"] == blurring, "those who stand have no velocities"
        assert figure["materials"] == [[f"throng {name}" for name in cast.people.MATERIALS]]
    assert not any(found["left"].values()), "nothing is left of figures that are removed"


def test_a_cast_has_only_the_gaits_of_its_bake_and_gets_others_when_a_new_bake_walks_with_them(blender, tmp_path):
    few = write_bake(tmp_path / "few", gaits=(2, 1))
    many = write_bake(tmp_path / "many", gaits=(0, 1, 3))
    result = result_of(blender(HERE / "check_gaits.py", ADDON, tmp_path / "few", tmp_path / "many"))
    narrow, wide = cast.Repertoire.of(REPERTOIRE.strides, (1, 2)), REPERTOIRE
    for shown, repertoire in zip(result["shots"], (narrow, wide, wide)):
        for row, name in shown["copy"].items():
            assert is_expected(name, few[2][9], few[1][9], int(row), 10, repertoire=repertoire)
        assert len(shown["copy"]) > 50
    # fewer take nothing away
    for shown, (_, direction, state), repertoire in zip(result["shots"], (few, many, few), (narrow, wide, wide)):
        assert shown["poses"] == 8 * repertoire.count and shown["coarse"] == 8 * repertoire.poses(1)
        assert {int(row) for row in shown["people"]} == set(numpy.nonzero(state[9, :, 0] > 0.5)[0])
        for row, name in shown["people"].items():
            assert is_expected(name, state[9], direction[9], int(row), 10, repertoire=repertoire)
    first, *others = (shown["look"] for shown in result["shots"])
    assert all(look == first for look in others), "new poses have the materials that the old ones had"


def test_the_pose_does_not_change_while_the_shutter_is_open(played):
    shots = {(shot["frame"], shot["sub"]): shot["people"] for shot in played[0]["shots"]}
    for _, times in SHUTTER:
        middle, *others = ({row: values[0] for row, values in shots[time].items()} for time in times)
        assert len(middle) > 50 and all(other == middle for other in others)


def test_a_saved_scene_renders_without_the_add_on_and_after_moving(blender, tmp_path):
    write_bake(tmp_path / "shot" / "bake", **SMALL_CAST)
    blender(ROOT / "scripts" / "render_bake.py", tmp_path / "shot" / "bake", tmp_path / "with.png", "--engine",
            "workbench", "--width", 320, "--height", 180, "--samples", 1, "--frame", 20, "--save",
            tmp_path / "shot" / "scene.blend")
    shutil.move(str(tmp_path / "shot"), str(tmp_path / "farm"))
    script = tmp_path / "farm.py"
    script.write_text("""
import bpy, sys
assert not hasattr(bpy.types, 'IMPORT_SCENE_OT_throng') and 'throng' not in sys.modules
caches = [m.filepath for o in bpy.data.objects for m in o.modifiers if m.type == 'MESH_CACHE']
assert len(caches) == 3 and all(path.startswith('//') for path in caches), caches
bpy.context.scene.render.filepath = sys.argv[-1]
bpy.ops.render.render(write_still=True)
a, b = (bpy.data.images.load(path) for path in sys.argv[-2:])
pixels, others = list(a.pixels), list(b.pixels)
assert len(pixels) == len(others) == 320 * 180 * 4
assert max(abs(x - y) for x, y in zip(pixels, others)) < 0.02
assert len(set(round(x, 2) for x in pixels)) > 20, 'nothing to see'
""")
    blender(script, tmp_path / "with.png", tmp_path / "without.png", blend=tmp_path / "farm" / "scene.blend")


@pytest.mark.parametrize("people, seconds, milliseconds", [(16384, 10.0, 18.0), (65536, 40.0, 55.0)])
def test_large_crowds_import_and_scrub_quickly(blender, tmp_path, people, seconds, milliseconds):
    """The fastest of sixty changes of frame, in processor time: other tests are going on."""
    write_bake(tmp_path / "bake", agents=people, frames=28)
    found = result_of(blender(HERE / "check_speed.py", ADDON, tmp_path / "bake"))
    assert found["people"] > 0.7 * people
    assert found["import"] < seconds and 1000.0 * found["frame"] < milliseconds, found


def test_only_those_outside_a_box_or_the_cameras_view_are_left_out(blender, tmp_path):
    write_bake(tmp_path / "bake", agents=400, **SMALL_CAST)
    found = result_of(blender(HERE / "check_culling.py", ADDON, tmp_path / "bake"))
    left, exact, unmoved = found["box"]
    assert 10 < left < 0.5 * found["all"] and exact and unmoved
    for left, of, wrong in found["camera"]:
        assert 0 < left < of and wrong == []
    before, everybody, part, boxed = found["new box"]
    assert before < part < everybody == boxed, "a new box is round everybody, whoever was culled or not shown before"
    assert found["again"]
