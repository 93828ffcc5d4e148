# SPDX-License-Identifier: Apache-2.0
"""The add-on in a real Blender: playback against the arrays, farms without the add-on, errors, installation."""
import json
import math
import os
import pathlib
import shutil
import subprocess
import sys

import numpy
import pytest

from conftest import ROOT

sys.path.insert(0, str(pathlib.Path(__file__).parent))
sys.path.insert(0, str(ROOT / "blender_addon"))
from sample_bake import write_bake  # noqa: E402
from pose_names import pose_name  # noqa: E402
from throng import cast, formats  # noqa: E402

ADDON = ROOT / "blender_addon"
REPERTOIRE = cast.Repertoire((0.7, 1.0, 1.4, 1.8))


def result_of(output):
    return json.loads(next(line for line in output.splitlines() if line.startswith("RESULT "))[7:])


def wrapped(angle):
    return abs((angle + math.pi) % (2.0 * math.pi) - math.pi)


def expected_poses(state, direction, row, frame, level=0, repertoire=REPERTOIRE):
    """Names of the poses that somebody may have: those who stand have a beat of their own."""
    activity, variation, phase = state[row]
    if direction[row, 2] > 0.1:
        poses = [repertoire.walking_pose(round((activity % 1.0) * 16), phase, level)]
    else:
        pick = row % 4 if int(activity) == 2 else row % 2
        beat = (row * 0.618034 + frame / 80.0) % 1.0 * cast.BEATS
        beats = {int(beat), int(beat + 1e-3) % cast.BEATS, int(beat - 1e-3) % cast.BEATS}
        poses = [repertoire.standing_pose(cast.gait.STANDING_CLIPS[pick], b, level) for b in beats]
    return [pose_name(int(variation), pose, level) for pose in poses]


def test_instances_are_where_the_arrays_say_at_frames_and_between(blender, tmp_path):
    pos, direction, state = write_bake(tmp_path / "bake")
    times = [(1, 0.0), (30, 0.0), (11, 0.5), (2, 0.25), (40, 0.0), (26, 0.6), (5, 0.0), (500, 0.0), (18, 0.75)]
    result = result_of(blender(pathlib.Path(__file__).parent / "check_playback.py", ADDON, tmp_path / "bake", json.dumps(times)))
    assert result["fps"] == 24.0 and result["range"] == [1, 40]
    for frame, hidden in result["gate"]:  # open from 0.5 to 1.2 s
        assert hidden == (13 <= frame < 30), frame
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
            assert set(name.split("|")) & {pose for k in nearest for frame in scene_frames for pose in expected_poses(state[k], direction[low], row, frame)}


def test_figures_bring_every_pose_in_order(blender):
    found = result_of(blender(pathlib.Path(__file__).parent / "check_sheets.py", ADDON))
    for figure in found["shown"]:
        assert figure["count"] == figure["expected"] and figure["off"] == 0.0 and figure["velocity_off"] < 1e-4 and figure["faces"]
        assert figure["blurring"] == (figure["walking"] if figure["level"] < 2 else 0), "those who stand have no velocities"
        assert figure["materials"] == [[f"throng {name}" for name in cast.people.MATERIALS]]
    assert not any(found["left"].values()), "nothing is left of figures that are removed"


def test_a_cast_has_only_the_gaits_of_its_bake_and_gets_others_when_a_new_bake_walks_with_them(blender, tmp_path):
    few = write_bake(tmp_path / "few", gaits=(2, 1))
    many = write_bake(tmp_path / "many", gaits=(0, 1, 3))
    result = result_of(blender(pathlib.Path(__file__).parent / "check_gaits.py", ADDON, tmp_path / "few", tmp_path / "many"))
    narrow, wide = cast.Repertoire.of(REPERTOIRE.strides, (1, 2)), REPERTOIRE
    for shown, repertoire in zip(result["shots"], (narrow, wide, wide)):
        for row, name in shown["copy"].items():
            assert set(name.split("|")) & set(expected_poses(few[2][9], few[1][9], int(row), 10, repertoire=repertoire))
        assert len(shown["copy"]) > 50
    for shown, (_, direction, state), repertoire in zip(result["shots"], (few, many, few), (narrow, wide, wide)):  # fewer take nothing away
        assert shown["poses"] == 8 * repertoire.count and shown["coarse"] == 8 * repertoire.poses(1)
        assert {int(row) for row in shown["people"]} == set(numpy.nonzero(state[9, :, 0] > 0.5)[0])
        for row, name in shown["people"].items():
            assert set(name.split("|")) & set(expected_poses(state[9], direction[9], int(row), 10, repertoire=repertoire))
    assert all(shown["look"] == result["shots"][0]["look"] for shown in result["shots"]), "new poses have the materials that the old ones had"


def test_the_pose_does_not_change_while_the_shutter_is_open(blender, tmp_path):
    write_bake(tmp_path / "bake")
    times = [(frame, sub) for frame in (8, 19, 33) for sub in (0.0,)] + [(frame - 1, 0.76) for frame in (8, 19, 33)] + [(frame, 0.24) for frame in (8, 19, 33)]
    shots = {(s["frame"], s["sub"]): s["people"] for s in result_of(blender(pathlib.Path(__file__).parent / "check_playback.py", ADDON, tmp_path / "bake",
                                                                          json.dumps(times)))["shots"]}
    for frame in (8, 19, 33):
        middle = {row: values[0] for row, values in shots[(frame, 0.0)].items()}
        for other in ((frame - 1, 0.76), (frame, 0.24)):
            assert {row: values[0] for row, values in shots[other].items()} == middle


def test_a_saved_scene_renders_without_the_add_on_and_after_moving(blender, tmp_path):
    write_bake(tmp_path / "shot" / "bake")
    blender(ROOT / "scripts" / "render_bake.py", tmp_path / "shot" / "bake", tmp_path / "with.png", "--engine", "workbench", "--width", 320, "--height", 180,
            "--samples", 1, "--frame", 20, "--save", tmp_path / "shot" / "scene.blend")
    shutil.move(str(tmp_path / "shot"), str(tmp_path / "farm"))
    script = tmp_path / "farm.py"
    script.write_text("""
import bpy, sys
assert not hasattr(bpy.types, 'IMPORT_SCENE_OT_throng') and 'throng' not in sys.modules
caches = [m.filepath for o in bpy.data.objects for m in o.modifiers if m.type == 'MESH_CACHE']
assert len(caches) == 3 and all(path.startswith('//') for path in caches), caches
bpy.context.scene.render.filepath = sys.argv[-1]
bpy.ops.render.render(write_still=True)
""")
    blender(script, tmp_path / "without.png", blend=tmp_path / "farm" / "scene.blend")
    compare = tmp_path / "compare.py"
    compare.write_text("""
import bpy, sys
a, b = (bpy.data.images.load(path) for path in sys.argv[-2:])
pixels, others = list(a.pixels), list(b.pixels)
assert len(pixels) == len(others) == 320 * 180 * 4
assert max(abs(x - y) for x, y in zip(pixels, others)) < 0.02
assert len(set(round(x, 2) for x in pixels)) > 20, 'nothing to see'
""")
    blender(compare, tmp_path / "with.png", tmp_path / "without.png")


@pytest.mark.parametrize("damage, words", [
    (lambda bake: (bake / "streams" / "pos.pc2").unlink(), "cannot be read"),
    (lambda bake: os.truncate(bake / "streams" / "dir.pc2", 5000), "truncated"),
    (lambda bake: (bake / "bake.json").write_text("{"), "not JSON"),
    (lambda bake: (bake / "bake.json").write_text("{}"), "not the manifest"),
    (lambda bake: (bake / "bake.json").write_text((bake / "bake.json").read_text().replace('"version": 1', '"version": 9')), "update the add-on"),
    (lambda bake: (bake / "bake.json").write_text((bake / "bake.json").read_text().replace('"agents": 63', '"agents": 64')), "different bakes")])
def test_broken_bakes_are_refused_with_one_clear_sentence(tmp_path, damage, words):
    write_bake(tmp_path / "bake")
    formats.load_bake(str(tmp_path / "bake"))
    damage(tmp_path / "bake")
    with pytest.raises(formats.BakeError, match=words):
        formats.load_bake(str(tmp_path / "bake"))


def test_the_operator_reports_errors_and_changes_nothing(blender, tmp_path):
    script = tmp_path / "broken.py"
    script.write_text("""
import bpy, sys
sys.path.insert(0, sys.argv[-2])
import throng
bpy.ops.wm.read_factory_settings(use_empty=True)
throng.register()
before = len(bpy.data.objects), len(bpy.data.collections), len(bpy.data.meshes)
try:
    bpy.ops.import_scene.throng(filepath=sys.argv[-1])
    raise SystemExit('no error was reported')
except RuntimeError as error:
    assert 'cannot be read' in str(error) and 'Traceback' not in str(error), error
assert before == (len(bpy.data.objects), len(bpy.data.collections), len(bpy.data.meshes))
throng.unregister()
assert not hasattr(bpy.types, 'IMPORT_SCENE_OT_throng')
""")
    blender(script, ADDON, tmp_path / "absent" / "bake.json")


def test_crowds_are_verified_mended_moved_and_shown_in_part(blender, tmp_path):
    write_bake(tmp_path / "one")
    write_bake(tmp_path / "two", agents=120, frames=60, seed=3)
    manifest = tmp_path / "two" / "bake.json"
    manifest.write_text(manifest.read_text().replace('"sample"', '"other"'))
    found = result_of(blender(pathlib.Path(__file__).parent / "check_crowds.py", ADDON, tmp_path / "one", tmp_path / "two", tmp_path))
    assert found["counts"] == [63, 120] and found["sound"] == [[], []]
    assert found["later"]
    shown, of, subset = found["part"]
    assert 0.1 * of < shown < 0.55 * of and subset and found["same"] <= 2
    assert len(found["missing"]) == 1 and "dir.pc2" in found["missing"][0] and "cannot be read" in found["missing"][0]
    assert len(found["fps"]) == 1 and "30 frames a second" in found["fps"][0]
    assert any("123 people, the bake 120" in problem for problem in found["rows"])
    assert found["mended"] == [[], []] and found["look"][:3] == [1.0, 0.0, 0.0]
    assert found["relinked"] == [120, "//two/streams/pos.pc2"] and found["after"] == "//two/streams/pos.pc2"
    assert "cannot be read" in found["broken"]
    assert found["reopened"] == [[], []] and min(found["people"]) > 50


CAST_MATERIALS = {f"throng {name}" for name in cast.people.MATERIALS}
WANTED = {"CryptoObject": ["Throng sample crowd", "Throng wall house"], "CryptoAsset": ["Throng sample crowd"], "CryptoMaterial": ["throng top", "throng skin"]}


def coverage(channels, layer, number):
    """How much of each pixel a Cryptomatte name covers. Pairs of a name's number and its share go through red, green, and blue, alpha."""
    wanted, total = numpy.uint32(int(number, 16)), 0.0
    for rank in range(3):
        planes = [next(c.pixels for name, c in channels.items() if name.lower().endswith(f"{layer}0{rank}.{plane}".lower())) for plane in "RGBA"]
        for numbers, shares in (planes[:2], planes[2:]):
            total = total + numpy.where(numpy.ascontiguousarray(numbers, numpy.float32).view(numpy.uint32) == wanted, shares, 0.0)
    return total


def test_the_film_look_and_its_layers(blender, tmp_path):
    import OpenEXR

    write_bake(tmp_path / "bake")
    found = result_of(blender(pathlib.Path(__file__).parent / "check_film_look.py", ADDON, tmp_path / "bake", tmp_path))
    for preset, size in (("preview", [960, 540]), ("plate", [1920, 1080]), ("final", [1920, 1080])):
        look = found[preset]
        assert look["engine"] == "CYCLES" and look["size"] == size and look["blur"] == [True, 0.5]
        assert look["transform"] == ("AgX" if found["version"] >= [4, 0, 0] else "Filmic")
        assert look["format"] == ("PNG" if preset == "preview" else "OPEN_EXR_MULTILAYER") and look["focus"] == (preset != "preview")
        assert math.dist(look["start"], look["end"]) > 0.5 and look["end"][2] > look["start"][2], "the crane rises"
        assert look["start"] == pytest.approx(found["preview"]["start"], abs=1e-4), "applied again, it is where it was"
    assert found["preview"]["samples"] < found["plate"]["samples"] < found["final"]["samples"]
    mattes = []
    for frame in (20, 21):
        with OpenEXR.File(str(tmp_path / f"plate.{frame:04d}.exr"), separate_channels=True) as file:
            channels = {name: channel for part in file.parts for name, channel in part.channels.items()}
            header = {key: value for part in file.parts for key, value in part.header.items()}
        names = " ".join(channels)
        assert "CryptoAsset00" in names and "Mist" in names and ("Depth" in names or ".Z" in names)
        manifests = {header[key.replace("/manifest", "/name")].split(".")[-1]: json.loads(value) for key, value in header.items()
                     if key.startswith("cryptomatte/") and key.endswith("/manifest")}
        crowd = coverage(channels, "CryptoObject", manifests["CryptoObject"]["Throng sample crowd"])
        clothes = sum(coverage(channels, "CryptoMaterial", number) for name, number in manifests["CryptoMaterial"].items() if name in CAST_MATERIALS)
        assert 0.005 < crowd.mean() < 0.9 and abs(crowd - clothes).max() < 1e-3, "the crowd's matte is that of all that people are made of"
        for kind, wanted in WANTED.items():
            assert set(wanted) <= set(manifests[kind]) and not any("person" in name or "pose" in name for name in manifests[kind])
        mattes.append(crowd.mean())
        combined = next(channel for name, channel in channels.items() if name.endswith("Combined.R"))
        assert numpy.isfinite(combined.pixels).all() and combined.pixels.std() > 0.01
    assert mattes[0] == pytest.approx(mattes[1], rel=0.2), "the matte goes on in the next frame, whatever poses people take"


@pytest.mark.parametrize("people, seconds, milliseconds", [(16384, 10.0, 18.0), (65536, 40.0, 55.0)])
def test_large_crowds_import_and_scrub_quickly(blender, tmp_path, people, seconds, milliseconds):
    """The fastest of sixty changes of frame, and still two to three times what it takes alone: other tests are going on."""
    write_bake(tmp_path / "bake", agents=people, frames=28)
    found = result_of(blender(pathlib.Path(__file__).parent / "check_speed.py", ADDON, tmp_path / "bake"))
    assert found["people"] > 0.7 * people
    assert found["import"] < seconds and 1000.0 * found["frame"] < milliseconds, found


def test_only_those_outside_a_box_or_the_cameras_view_are_left_out(blender, tmp_path):
    write_bake(tmp_path / "bake", agents=400)
    found = result_of(blender(pathlib.Path(__file__).parent / "check_culling.py", ADDON, tmp_path / "bake"))
    left, exact, unmoved = found["box"]
    assert 10 < left < 0.5 * found["all"] and exact and unmoved
    for left, of, wrong in found["camera"]:
        assert 0 < left < of and wrong == []
    assert found["again"]


def test_levels_of_detail_follow_the_camera_and_can_be_taken_out_again(blender, tmp_path):
    pos, direction, state = write_bake(tmp_path / "bake", agents=400, variations=cast.VARIATIONS)
    found = result_of(blender(pathlib.Path(__file__).parent / "check_levels.py", ADDON, tmp_path / "bake", tmp_path))
    once = 2 * cast.VARIATIONS  # of everybody the figure and its sheet of poses, as objects and as meshes
    assert found["sizes"] == [[once] * 2, [once] * 2, [cast.LEVELS * once] * 2] and found["after"] == [once] * 2
    # A person of 1.75 m is 120 and 40 pixels tall there: the sensor is 36 mm wide, the picture 1920 x 1080.
    pixels = [1.75 / distance * found["lens"] / 36.0 * 1920.0 for distance in found["defaults"]]
    assert pixels == pytest.approx([120.0, 40.0], rel=1e-3)
    assert "perspective" in found["ortho"] and "nearer" in found["order"]
    assert found["off"] == found["before"] and not any("_l" in name for name in found["off"].values())
    assert len([name for name in found["trees"] if name.startswith("Throng instancer")]) == 1
    levels = set()
    for frame, sub, camera, people in found["shots"]:
        assert len(people) > 300
        t = frame + sub - 1.0
        low, near = math.floor(t), int(math.floor(t + 0.5))
        for row, name in people.items():
            row = int(row)
            at = pos[low, row] * (1.0 - (t - low)) + pos[min(low + 1, 39), row] * (t - low)
            distance = math.dist(at, camera)
            if min(abs(distance - 9.5), abs(distance - 18.5)) < 1e-3:
                continue
            level = (distance > 9.5) + (distance > 18.5)
            levels.add(level)
            assert set(name.split("|")) & set(expected_poses(state[near], direction[low], row, near + 1, level)), (frame, sub, row, distance)
    assert levels == {0, 1, 2}
    middle, opened, closed = ({row: name for row, name in people.items()} for frame, sub, _, people in found["shots"] if (frame, sub) in ((25, 0.0), (24, 0.76), (25, 0.24)))
    changed = [row for row in middle if {opened[row], closed[row]} != {middle[row]}]
    for row in changed:  # the camera goes 2.5 m a frame here
        distances = [math.dist(pos[24, int(row)], camera) for frame, sub, camera, _ in found["shots"] if frame in (24, 25)]
        assert any(min(distances) - 0.1 < edge < max(distances) + 0.1 for edge in (9.5, 18.5)), "the level changes only for who crosses a distance"
    assert 0 < len(changed) < 0.2 * len(middle)
    assert found["farm"] == found["shots"][1][3]


def test_crowds_come_from_other_files_and_copies_share_a_cast(blender, tmp_path):
    _, _, state = write_bake(tmp_path / "bake")
    found = result_of(blender(pathlib.Path(__file__).parent / "check_files.py", ADDON, tmp_path / "bake", tmp_path))
    alive = int((state[19, :, 0] > 0.5).sum())
    assert found["alone"] == alive
    assert found["appended"] == [alive, alive, 0, alive], "poses of the cast are nowhere but in the crowd"
    assert found["linked"] == [2 * alive, alive] and found["beside"] == alive
    assert [found[f"copies {step}"] for step in range(4)] == [[alive, alive, figures] for figures in (24, 24, 24, 8)]
    assert found["mine"] and found["earlier"] == [alive, 0, 2, False]


def test_the_zip_installs(blender, tmp_path):
    archive = tmp_path / "throng.zip"
    subprocess.run([sys.executable, str(ROOT / "scripts" / "build_addon.py"), str(archive)], check=True)
    script = tmp_path / "install.py"
    script.write_text("""
import bpy, sys
bpy.ops.preferences.addon_install(filepath=sys.argv[-1])
bpy.ops.preferences.addon_enable(module='throng')
assert hasattr(bpy.types, 'IMPORT_SCENE_OT_throng')
""")
    blender(script, archive, environment={"BLENDER_USER_SCRIPTS": str(tmp_path / "scripts"), "BLENDER_USER_CONFIG": str(tmp_path / "config")})


def test_the_extension_builds_and_is_valid(tmp_path):
    """With the tool of the current Blender's own distribution."""
    python = ROOT / "build" / "bpy" / "bin" / "python"
    tools = sorted(python.parent.parent.glob("lib/python*/site-packages/bpy/*/scripts/addons_core/bl_pkg/cli/blender_ext.py"))
    if not tools:
        pytest.skip("the Python module bpy is not installed (scripts/test does)")
    run = lambda *words: subprocess.run([python, tools[-1], *words], capture_output=True, text=True)
    built = run("build", "--source-dir", ADDON / "throng", "--output-dir", tmp_path)
    assert built.returncode == 0, built.stdout + built.stderr
    packed = next(tmp_path.glob("throng-*.zip"))
    checked = run("validate", packed)
    assert checked.returncode == 0 and "Success" in checked.stdout, checked.stdout + checked.stderr


def test_a_real_bake_imports_and_its_caches_equal_the_arrays(blender, bakes, tmp_path):
    bake = bakes("intersection")
    script = tmp_path / "real.py"
    script.write_text("""
import bpy, json, os, sys
sys.path.insert(0, sys.argv[-2])
import throng
bpy.ops.wm.read_factory_settings(use_empty=True)
throng.register()
bpy.ops.import_scene.throng(filepath=os.path.join(sys.argv[-1], 'bake.json'))
scene = bpy.context.scene
assert scene.camera and scene.world and any(o.type == 'LIGHT' for o in bpy.data.objects)
crowd = bpy.data.objects['Throng intersection crowd']
crowd.modifiers['throng people (viewport)'].show_viewport = False
result = []
for frame in (1, 700, 1400):
    scene.frame_set(frame)
    mesh = crowd.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
    result.append([list(v.co) for v in mesh.vertices])
print('RESULT ' + json.dumps(result))
""")
    frames = result_of(blender(script, ADDON, bake))
    stored = numpy.load(bake / "streams" / "pos.npy", mmap_mode="r")
    for frame, found in zip((0, 699, 1399), frames):
        assert numpy.abs(numpy.array(found) - stored[frame]).max() < 1e-5


def test_all_but_film_looks_works_without_cycles(blender, tmp_path):
    write_bake(tmp_path / "bake")
    script = tmp_path / "no_cycles.py"
    script.write_text(f"""
import addon_utils, bpy, sys
sys.path.insert(0, {str(ADDON)!r})
import throng
bpy.ops.wm.read_factory_settings(use_empty=True)
addon_utils.disable('cycles')
assert not hasattr(bpy.context.scene, 'cycles')
throng.register()
assert bpy.ops.import_scene.throng(filepath={str(tmp_path / "bake" / "bake.json")!r}) == {{'FINISHED'}}
assert bpy.ops.throng.light(time='night') == {{'FINISHED'}}
try:
    bpy.ops.throng.film_look(preset='plate')
    raise SystemExit('accepted')
except RuntimeError as error:
    assert 'enable the add-on Cycles' in str(error), error
""")
    blender(script)
