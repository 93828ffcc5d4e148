# SPDX-License-Identifier: Apache-2.0
"""Overrides in a real Blender: every operator against the instances' transforms, undo, files, farms, retakes, and the
same as `throng apply`."""
import csv
import json
import math
import shutil

import numpy
import pytest

from results import ADDON, HERE, result_of
from sample_bake import SMALL_CAST, write_bake

STREET = {"throng": 1, "name": "street", "simulation": {"duration": 5, "seed": 7},
          "roads": [{"id": "road", "centreline": [[0, 0], [24, 0]], "width": 6}],
          "flows": [{"id": "f", "from": "road:start", "to": "road:end", "count": 30, "end": 4}],
          "formations": [{"id": "ring", "type": "circle", "centre": [10, 12], "radius": 4, "count": 7}]}
FRAMES = ("1", "30", "63", "100", "120")


def pos(bake):
    return numpy.load(bake / "streams" / "pos.npy")


@pytest.fixture(scope="module")
def takes(throng, tmp_path_factory):
    """Three takes of a street: as it was, with another seed, with fewer people."""
    folder = tmp_path_factory.mktemp("takes")
    (folder / "street.json").write_text(json.dumps(STREET))
    fewer = ("--set", "flows.0.count=2", "--set", "flows.0.end=0.2")
    for name, options in (("take1", ()), ("take2", ("--set", "simulation.seed=8")), ("take3", fewer)):
        throng("bake", folder / "street.json", "-o", folder / name, "-q", "--no-gltf", *options)
    return folder


@pytest.fixture(scope="module")
def found(blender, throng, takes, tmp_path_factory):
    """What check_overrides.py has seen, and the folder that it worked in."""
    folder = tmp_path_factory.mktemp("overrides")
    for take in ("take1", "take2", "take3"):
        shutil.copytree(takes / take, folder / take)
    shutil.copytree(takes / "take1", folder / "street")
    document = {"throng_overrides": 1, "overrides": entries_of(folder / "street")}
    (folder / "expected.overrides.json").write_text(json.dumps(document))
    throng("apply", folder / "street", "--overrides", folder / "expected.overrides.json", "-o", folder / "applied",
           "-q")
    return result_of(blender(HERE / "check_overrides.py", ADDON, folder)), folder


def entries_of(bake):
    """What the check does by operators, written by hand."""
    with open(bake / "agents.csv", newline="") as file:
        table = list(csv.DictReader(file))
    places = pos(bake)

    def entry(row, **change):
        frame = int(table[row]["spawn_frame"])
        return {"id": row, "group": table[row]["group"],
                "spawn": {"frame": frame, "position": places[frame, row].astype(float).tolist()}, **change}

    frame, turn = int(table[11]["spawn_frame"]), 28.64789
    flat = lambda at: complex(*places[at, 11, :2].astype(float))
    away = (flat(99) - flat(frame)) * numpy.exp(1j * math.radians(turn)) + flat(frame)
    to_cursor = {"move": {"by": [round(-3.0 - away.real, 6), round(4.0 - away.imag, 6), 0.5], "turn": turn}}
    look = {"character": 5, "tint": [0.1, 0.2, 0.3], "scale": 1.2}
    return [entry(3, hide=True), entry(6, move={"by": [1.5, -2.0, 0.25], "turn": 30.0}),
            entry(7, retime={"offset": -9.5, "speed": 1.3}, move={"by": [0, 1, 0]}, **look), entry(9, **look),
            entry(15, tint="#a01020"), entry(11, **to_cursor), entry(13, **to_cursor)]


def test_people_are_found_by_the_ray_through_the_mouse(found):
    ray = found[0]["ray"]
    assert ray["ahead"] == ray["above"] == ray["beside"] == ray["row"] and ray["nobody"] is None and ray["far"] is None
    assert found[0]["picked"][0] == found[0]["picked"][1] and found[0]["by_points"] == [12]


def test_mistakes_are_reported_and_change_nothing(found):
    found = found[0]
    assert "Nobody is picked" in found["nobody"] and "no person 999" in found["stranger"]
    assert "found `three`" in found["words"]
    for told in (found["conflict"], found["cleared by both"]):
        assert "person 15 of `f` (tint) has been changed by somebody else" in told and "Re-load Overrides" in told
    assert "`Anna` already" in found["twice"]
    assert "person 18 is a character that was brought along" in found["brought"]
    imported, reloaded, more = found["damaged"]
    assert "/hide: expected true or false" in imported and "/hide: expected true or false" in reloaded and more == 0


def test_what_somebody_else_has_changed_in_the_file_is_taken_over(found):
    assert found[0]["merged"] and found[0]["theirs"], "what they have taken back is back"
    assert found[0]["reloaded"]


def test_clearing_brings_back_the_crowd_as_it_was(found):
    entries, modifiers, same, same_tints = found[0]["cleared"]
    assert entries == [] and modifiers == found[0]["modifiers"] and same and same_tints
    assert found[0]["emptied"] == [0, modifiers, True] and found[0]["rings"] == [2 * 48, True]
    assert "throng overrides" not in modifiers, "nothing is paid for where nothing is changed"


def test_undo_and_redo_take_the_file_along(found):
    assert found[0]["undo"] == [[1, False], [0, True, 0]] and found[0]["redo"] == [1, False, 1]


def test_nobody_else_is_touched(found):
    before, after = found[0]["before"], found[0]["after"]
    changed = {"3", "6", "7", "9", "11", "13"}
    for frame in FRAMES:
        assert "3" not in after[frame]
        for row in set(before[frame]) - changed:
            assert after[frame][row] == before[frame][row]


def test_people_are_moved_turned_swapped_and_scaled(found):
    found, folder = found
    entry = next(entry for entry in found["entries"] if entry["id"] == 6)
    pivot = pos(folder / "take1")[int(entry["spawn"]["frame"]), 6]
    for frame in ("63", "100", "120"):
        before, after = found["before"][frame], found["after"][frame]
        was, now = before["6"], after["6"]
        away = (complex(*was[1:3]) - complex(*pivot[:2])) * numpy.exp(1j * math.radians(30))
        assert abs(complex(*now[1:3]) - (away + complex(*pivot[:2]) + (1.5 - 2.0j))) < 1e-4
        assert now[3] == pytest.approx(0.25, abs=1e-5)
        assert math.remainder(now[4] - was[4] - math.radians(30), math.tau) == pytest.approx(0.0, abs=1e-4)
        assert after["9"][0].startswith("m05") and after["9"][5] == pytest.approx(1.2, abs=1e-5)
        assert after["9"][0][3:] == before["9"][0][3:], "the same pose of another character"
    assert found["at_cursor"] == pytest.approx([-3.0, 4.0, 0.5], abs=1e-4)


def test_people_are_tinted(found):
    found = found[0]
    for row, (was, now) in enumerate(zip(found["tints_before"], found["tints"])):
        assert now == pytest.approx([0.1, 0.2, 0.3] if row in (7, 9) else was, abs=1e-6)
    assert found["dye"] == [pytest.approx([0.3515, 0.0052, 0.0144], abs=1e-3), 1.0, 0.0]
    assert len(found["dyed_materials"]) >= 1


def test_retimed_people_have_caches_beside_the_bake(found):
    found = found[0]
    path, count = found["sidecar"]
    assert path.startswith("//street.overrides/") and path.endswith(".pos.pc2") and count == 1
    assert found["verify"] == [] and found["later"] < 1e-5
    assert all(status == "sure" for _, status in found["list"])


def test_entries_are_those_that_a_person_would_write(found):
    found, folder = found
    document = json.loads((folder / "expected.overrides.json").read_text())
    expected = {entry["id"]: entry for entry in document["overrides"]}
    assert {entry["id"] for entry in found["entries"]} == set(expected)
    for entry in found["entries"]:
        hand = expected[entry["id"]]
        assert set(entry) == set(hand) and entry["group"] == hand["group"] and entry["spawn"] == hand["spawn"]
        for key in set(entry) & {"move", "retime"}:
            for name, value in hand[key].items():
                assert entry[key][name] == pytest.approx(value, abs=1e-4)


def test_the_command_lines_bake_is_the_same_crowd(found):
    found, _ = found
    for frame in FRAMES:
        one, two = found["native"][frame], found["applied"][frame]
        assert set(one) == set(two) and len(one) > 5
        for row in one:
            assert one[row][0].split(".")[0] == two[row][0].split(".")[0], (frame, row)
            pairs = zip(one[row][1:4] + one[row][5:], two[row][1:4] + two[row][5:])
            assert max(abs(a - b) for a, b in pairs) < 1e-4, (frame, row)
            assert abs(math.remainder(one[row][4] - two[row][4], math.tau)) < 1e-4
    assert found["applied_tints"] < 1e-5 and found["applied_dye"] == 1.0


def test_heroes_walk_as_they_did_in_the_crowd(found):
    hero = found[0]["hero"]
    assert hero["root"] < 1e-4 and hero["in_crowd"] == [False, False] and hero["bones"] == 13 and hero["materials"]
    for mean, most, worst, speed, whole in hero["errors"]:
        assert speed > 0.1 and whole
        assert mean < 0.01 and most < 0.06 and worst < 0.12, "m between the skinned body and the crowd's pose"
    assert sum(most for _, most, *_ in hero["errors"]) / len(hero["errors"]) < 0.045, "poses differ"
    assert hero["tint"] == pytest.approx(found[0]["tints_before"][10], abs=1e-6)
    assert found[0]["presence"] == {"1": [True, True], "120": [False, False]}
    assert found[0]["demoted"] == [[], 0, 0, [True, True]]


def test_scenes_are_the_same_when_opened_again_and_imports_find_the_file(found):
    assert found[0]["reopened"] == [True, True, ["Anna", "Hero 16"]]
    assert found[0]["imported"] == [True, ["Anna", "Hero 16"]]


@pytest.mark.parametrize("take", ["take2", "take3"])
def test_a_retake_keeps_approved_work(found, throng, take):
    found, folder = found
    seen = found[take]
    assert seen["verify"] == [] and seen["entries"] == found["take2"]["entries"], "the file stays as it was"
    (folder / "now.overrides.json").write_text(json.dumps({"throng_overrides": 1, "overrides": seen["entries"]}))
    told = json.loads(throng("apply", folder / take, "--overrides", folder / "now.overrides.json", "--dry-run",
                             "--json").stdout)
    matches = [[entry["id"], entry["match"], entry.get("row", -1)] for entry in told]
    assert seen["matches"] == matches, "as the command line finds them"
    assert all(bool(detail) == (entry["match"] != "sure") for detail, entry in zip(seen["details"], told))
    assert seen["heroes"] == ["Anna", "Hero 16"], "an animator's work is never removed by a retake"


@pytest.mark.parametrize("take", ["take2", "take3"])
def test_a_retake_changes_whom_entries_mean_and_nobody_else(found, take):
    found, folder = found
    seen, stored = found[take], pos(folder / take)[99]
    by_id = {entry["id"]: entry for entry in seen["entries"]}
    shown = {int(row): values for row, values in seen["people"].items()}
    changed = {row: by_id[id] for id, _, row in seen["matches"] if row >= 0}
    for row, change in changed.items():
        assert (row in shown) == (not change.get("hide") and "hero" not in change)
        if "character" in change:
            assert shown[row][0].startswith("m05") and shown[row][5] == pytest.approx(1.2, abs=1e-5)
    for row in shown.keys() - changed.keys():
        assert shown[row][1:4] == pytest.approx(list(stored[row]), abs=1e-5)
        assert shown[row][5] == pytest.approx(1.0, abs=1e-6)


def test_a_retake_tells_orphans(found):
    kinds = {take: [kind for _, kind, _ in found[0][take]["matches"]] for take in ("take2", "take3")}
    assert sum(kind != "orphaned" for kind in kinds["take2"]) >= 3
    assert kinds["take3"].count("orphaned") >= 5
    assert any("nobody else of `f`" in detail for detail in found[0]["take3"]["details"])


def test_a_farm_without_the_add_on_shows_the_same(blender, found, tmp_path):
    found, folder = found
    shutil.rmtree(folder / "street")
    shutil.copytree(folder / "take1", folder / "street")
    shutil.copytree(folder, tmp_path / "farm")
    script = tmp_path / "farm.py"
    script.write_text("""
import bpy, json, math, sys
sys.path.insert(0, sys.argv[-2])
from pose_names import Names
assert not hasattr(bpy.types, 'IMPORT_SCENE_OT_throng') and 'throng' not in sys.modules
crowds = {o for o in bpy.data.objects if any(m.type == 'MESH_CACHE' for m in o.modifiers)}
assert len(crowds) == 2, crowds
result = {}
for frame in (1, 30, 63, 100, 120):
    bpy.context.scene.frame_set(frame)
    graph, names = bpy.context.evaluated_depsgraph_get(), Names()
    result[frame] = {i.persistent_id[1]: [names.of(i.object.data), *i.matrix_world.translation,
                                          math.atan2(i.matrix_world[1][0], i.matrix_world[0][0]),
                                          i.matrix_world.to_scale().x]
                     for i in graph.object_instances if i.is_instance and i.parent and i.parent.original in crowds}
anna = bpy.data.objects['Anna']
result['anna'] = list(anna.matrix_world.translation)
scene = bpy.context.scene
scene.render.engine = 'BLENDER_WORKBENCH'
scene.render.resolution_x, scene.render.resolution_y = 160, 90
camera = bpy.data.objects.new('camera', bpy.data.cameras.new('camera'))
scene.collection.objects.link(camera)
camera.location, camera.rotation_euler, scene.camera = (8.0, -14.0, 5.0), (1.2, 0.0, 0.0), camera
scene.render.filepath = sys.argv[-1]
bpy.ops.render.render(write_still=True)
print('RESULT ' + json.dumps(result))
""")
    seen = result_of(blender(script, HERE, tmp_path / "frame.png", blend=tmp_path / "farm" / "farm.blend"))
    for frame in FRAMES:
        assert set(seen[frame]) == set(found["final"][frame])
        for row, values in seen[frame].items():
            name, *numbers = found["final"][frame][row]
            assert values[0] == name and values[1:] == pytest.approx(numbers, abs=1e-5)
    assert seen["anna"] == pytest.approx(list(pos(folder / "take1")[119, 10]), abs=1e-4)
    assert (tmp_path / "frame.png").stat().st_size > 2000


def test_overrides_of_a_large_crowd_cost_little(blender, tmp_path):
    """The fastest of many changes of frame, with and without overrides in turn: other tests are going on."""
    write_bake(tmp_path / "bake", agents=16384, frames=28, **SMALL_CAST)
    lines = ["id,group,spawn_frame"] + [f"{row},f,{10 if row % 9 == 4 else 0}" for row in range(16384)]
    (tmp_path / "bake" / "agents.csv").write_text("\n".join(lines) + "\n")
    took = result_of(blender(HERE / "check_override_speed.py", ADDON, tmp_path / "bake"))
    assert took["all"] < 2.5 * took["none"] + 2.0, took
    assert took["operator"] < 10.0, took
