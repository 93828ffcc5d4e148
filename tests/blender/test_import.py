# SPDX-License-Identifier: Apache-2.0
"""Imports in a real Blender: real bakes, broken bakes, crowds that are mended, moved, appended and copied."""
import os

import numpy
import pytest

from results import ADDON, HERE, result_of
from sample_bake import SMALL_CAST, write_bake
from throng import formats


def replace(path, old, new):
    path.write_text(path.read_text().replace(old, new))


@pytest.mark.parametrize("damage, words", [
    (lambda bake: (bake / "streams" / "pos.pc2").unlink(), "cannot be read"),
    (lambda bake: os.truncate(bake / "streams" / "dir.pc2", 5000), "truncated"),
    (lambda bake: (bake / "bake.json").write_text("{"), "not JSON"),
    (lambda bake: (bake / "bake.json").write_text("{}"), "not the manifest"),
    (lambda bake: replace(bake / "bake.json", '"version": 1', '"version": 9'), "update the add-on"),
    (lambda bake: replace(bake / "bake.json", '"agents": 63', '"agents": 64'), "different bakes")])
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
    write_bake(tmp_path / "one", **SMALL_CAST)
    write_bake(tmp_path / "two", agents=120, frames=60, seed=3, **SMALL_CAST)
    manifest = tmp_path / "two" / "bake.json"
    manifest.write_text(manifest.read_text().replace('"sample"', '"other"'))
    found = result_of(blender(HERE / "check_crowds.py", ADDON, tmp_path / "one", tmp_path / "two", tmp_path))
    assert found["counts"] == [63, 120] and found["sound"] == [[], []]
    assert found["later"]
    shown, of, subset = found["part"]
    assert 0.1 * of < shown < 0.55 * of and subset and found["same"] <= 2
    assert len(found["missing"]) == 1 and "dir.pc2" in found["missing"][0] and "cannot be read" in found["missing"][0]
    assert len(found["flipped"]) == 1 and "streams/pos.npy has been changed or damaged" in found["flipped"][0]
    assert found["stranger"] == ["notes.txt is not in the list of bake.json"]
    assert len(found["fps"]) == 1 and "30 frames a second" in found["fps"][0]
    assert any("123 people, the bake 120" in problem for problem in found["rows"])
    assert found["mended"] == [[], []] and found["look"][:3] == [1.0, 0.0, 0.0]
    assert found["relinked"] == [120, "//two/streams/pos.pc2"] and found["after"] == "//two/streams/pos.pc2"
    assert "cannot be read" in found["broken"]
    assert found["reopened"] == [[], []] and min(found["people"]) > 50


def test_crowds_come_from_other_files_and_copies_share_a_cast(blender, tmp_path):
    _, _, state = write_bake(tmp_path / "bake", **SMALL_CAST)
    found = result_of(blender(HERE / "check_files.py", ADDON, tmp_path / "bake", tmp_path))
    alive = int((state[19, :, 0] > 0.5).sum())
    assert found["alone"] == alive
    assert found["appended"] == [alive, alive, 0, alive], "poses of the cast are nowhere but in the crowd"
    assert found["linked"] == [2 * alive, alive] and found["beside"] == alive
    assert [found[f"copies {step}"] for step in range(4)] == [[alive, alive, figures] for figures in (6, 6, 6, 2)]
    assert found["mine"] and found["earlier"] == [alive, 0, 2, False]


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
    write_bake(tmp_path / "bake", **SMALL_CAST)
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
