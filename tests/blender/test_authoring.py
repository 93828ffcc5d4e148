# SPDX-License-Identifier: Apache-2.0
"""Layouts drawn in a real Blender: lossless files, changes that appear and nothing else, bakes from the panel, errors at what caused them."""
import json
import math
import pathlib
import random
import sys
import time

import pytest

from conftest import EXAMPLES, ROOT

sys.path.insert(0, str(ROOT / "blender_addon"))
from throng.authoring import curves, fields  # noqa: E402
from throng.authoring.bake_job import BakeJob, check_layout, parse_diagnostics  # noqa: E402
from throng.authoring.codecs import Choice, Flag, Whole  # noqa: E402
from throng.authoring.executable import ExecutableError, check_version, find_executable  # noqa: E402
from throng.authoring.values import keep_points, short, single  # noqa: E402

HERE = pathlib.Path(__file__).parent
ADDON = ROOT / "blender_addon"
EVERYTHING = HERE / "layouts" / "everything.json"
UTM = (448262.123, 5411932.678)


def result_of(output):
    return json.loads(next(line for line in output.splitlines() if line.startswith("RESULT "))[7:])


def differences(a, b, pointer=""):
    """JSON pointers of what differs; {} where a key or an item is there in one of them only."""
    if isinstance(a, dict) and isinstance(b, dict):
        return {p for key in a.keys() | b.keys() for p in (differences(a[key], b[key], f"{pointer}/{key}") if key in a and key in b else {f"{pointer}/{key}"})}
    if isinstance(a, list) and isinstance(b, list):
        longer = {f"{pointer}/{i}" for i in range(min(len(a), len(b)), max(len(a), len(b)))}
        return {p for i, (x, y) in enumerate(zip(a, b)) for p in differences(x, y, f"{pointer}/{i}")} | longer
    return set() if a == b and isinstance(a, bool) == isinstance(b, bool) else {pointer}


def moved(layout, x, y):
    """The layout elsewhere in the world."""
    points = {"centreline", "polygon", "points", "line", "centre", "origin", "facing", "position", "mirror", "anywhere"}

    def walk(value, key=""):
        if key in points and isinstance(value, list):
            return [value[0] + x, value[1] + y] if isinstance(value[0], (int, float)) else [[p[0] + x, p[1] + y] for p in value]
        if key == "goal" and isinstance(value, list):
            return [value[0] + x, value[1] + y]
        if isinstance(value, dict):
            return {k: walk(v, k) for k, v in value.items()}
        return [walk(v) for v in value] if isinstance(value, list) else value

    return walk(layout)


def layouts():
    return [path for folder in (EXAMPLES, ROOT / "scenarios") for path in sorted(folder.glob("*.json")) if "throng" in json.loads(path.read_text())]


def test_every_layout_goes_through_blender_unchanged(blender, throng, tmp_path):
    (tmp_path / "in").mkdir()
    (tmp_path / "out").mkdir()
    everything = json.loads(EVERYTHING.read_text(encoding="utf-8"))
    (tmp_path / "in" / "far.json").write_text(json.dumps(moved(everything, *UTM)))
    wave = [[0.1 * i, math.sin(0.01 * i) * 3.0] for i in range(10000)]
    draw = random.Random(5)
    people = [{"position": [draw.uniform(0, 90), draw.uniform(5, 80)], "goal": [draw.uniform(0, 90), draw.uniform(5, 80)]} for _ in range(1000)]
    (tmp_path / "in" / "bulk.json").write_text(json.dumps({"throng": 1, "walls": [{"points": wave}], "formations": [{"id": "list", "type": "agents", "agents": people}]}))
    (tmp_path / "in" / "bare.json").write_text('{"throng": 1, "walls": [], "expect": {}, "simulation": {}}')
    paths = layouts() + [EVERYTHING] + sorted((tmp_path / "in").glob("*.json"))
    assert len(paths) > 35
    times = result_of(blender(HERE / "check_round_trip.py", ADDON, tmp_path / "out", *paths))
    for path in paths:
        before, after = (json.loads(each.read_text(encoding="utf-8")) for each in (path, tmp_path / "out" / path.name))
        assert differences(before, after) == set(), path
    into, out, objects = times["bulk.json"]
    assert into < 3.0 and out < 3.0 and objects == 2, "10,000 points and 1,000 people take fractions of a second"
    # What is equal is as valid as it was; these few also show that the text is one that the program reads.
    throng("check", *(tmp_path / "out" / name for name in ("station.json", "intersection.json", "everything.json", "far.json")))


EDITS = {
    "nothing": set(),
    "move_wall": {f"/walls/2/points/{i}/0" for i in range(4)},
    "turn_wall": {f"/walls/2/points/{i}/{j}" for i in range(4) for j in range(2)},
    "move_one_point": {"/walls/2/points/1/0"},
    "insert_a_point": {"/roads/2/centreline/1/0", "/roads/2/centreline/2"},
    "change_width": {"/roads/2/width"},
    "add_flow": {"/flows/3"},
    "rename_area": {"/areas/1/id", "/flows/0/to", "/flows/1/via/2/choose/hall", "/flows/1/via/2/choose/foyer", "/flows/1/via/3/at", "/flows/1/via/4/at",
                    "/flows/1/to/choose/hall", "/flows/1/to/choose/foyer", "/flows/2/to/nearest/0", "/formations/4/goal/nearest/0",
                    "/events/3/go_to/choose/hall", "/events/3/go_to/choose/foyer", "/events/4/go_to"},
    "rename_flow": {"/flows/1/id", "/events/2/flow"},
    "people": {"/flows/2/people/profile"},
    "mean_speed": {"/flows/0/people/speed/log_normal/0"},
    "unset_speed": {"/flows/0/people/speed"},
    "stop_longer": {"/flows/1/via/4/wait"},
    "move_the_queue": {f"/flows/1/via/4/line/{i}/1" for i in range(3)},
    "amount": {"/flows/1/rate", "/flows/1/count"},
    "reorder_stops": {"/flows/1/via/0", "/flows/1/via/1"},
    "move_ring": {"/formations/0/centre/0"},
    "scale_ring": {"/formations/0/radius", "/formations/0/ring_spacing", "/formations/0/along"},
    "turn_block": {"/formations/1/rotation"},
    "move_a_person": {"/formations/5/agents/1/position/0"},
    "remove_a_person": None,
    "change_event": {"/events/0/at", "/events/1/close", "/events/1/open"},
    "change_seed": {"/simulation/seed"},
    "delete_wall": None,
    "duplicate_wall": None,
    "close_wall": {"/walls/3/closed", "/walls/3/points/2"},
    "change_bar": {"/expect/flow/max"},
}


def test_changes_appear_in_the_layout_and_only_there(blender, throng, tmp_path):
    before = json.loads(EVERYTHING.read_text(encoding="utf-8"))
    after = result_of(blender(HERE / "check_authoring_edits.py", ADDON, EVERYTHING, tmp_path))
    assert after.keys() == EDITS.keys()
    for name, expected in EDITS.items():
        if expected is not None:
            assert differences(before, after[name]) == expected, name
    walls = before["walls"]
    assert after["move_wall"]["walls"][2]["points"] == [[x + 2.5, y] for x, y in walls[2]["points"]]
    assert after["move_one_point"]["walls"][2]["points"][1] == [6.5, 20]
    centre = (12.5, 14.0)
    turned = [[centre[0] - (y - centre[1]), centre[1] + (x - centre[0])] for x, y in walls[2]["points"]]
    assert [math.dist(a, b) < 1e-5 for a, b in zip(after["turn_wall"]["walls"][2]["points"], turned)] == [True] * 4
    assert after["insert_a_point"]["roads"][2]["centreline"] == [[0, 30], [30, 30], [60, 30]]
    assert after["change_width"]["roads"][2]["width"] == 4.3
    assert after["add_flow"]["flows"][3] == {"id": "Flow 4", "from": "square", "to": "hall", "count": 7}
    assert after["rename_area"]["flows"][0]["to"] == "foyer" and after["rename_flow"]["events"][2]["flow"] == "way"
    assert after["stop_longer"]["flows"][1]["via"][4]["wait"] == 5.5
    assert after["amount"]["flows"][1]["count"] == 12 and "rate" not in after["amount"]["flows"][1]
    assert after["reorder_stops"]["flows"][1]["via"][:2] == before["flows"][1]["via"][1::-1]
    assert after["scale_ring"]["formations"][0]["radius"] == pytest.approx(2 * 5.123456789, abs=1e-5)
    assert after["turn_block"]["formations"][1]["rotation"] == pytest.approx(45.0, abs=1e-4)
    assert after["move_a_person"]["formations"][5]["agents"][1]["position"] == [-99.5, 2]
    assert after["remove_a_person"]["formations"][5]["agents"] == before["formations"][5]["agents"][1:]
    assert after["delete_wall"]["walls"] == walls[:2] + walls[3:]
    copies = after["duplicate_wall"]["walls"]
    assert copies[:3] == walls[:3] and copies[4:] == walls[3:]
    assert copies[3] == {**walls[2], "id": "house.001", "points": [[x + 100, y] for x, y in walls[2]["points"]]}
    assert after["close_wall"]["walls"][3]["closed"] is True
    assert after["mean_speed"]["flows"][0]["people"]["speed"]["log_normal"] == [0.3, 0.1]
    throng("check", *(tmp_path / f"{name}.json" for name in ("move_wall", "add_flow", "rename_area", "duplicate_wall")))


def test_a_scene_is_drawn_baked_mended_and_baked_again(blender, throng, tmp_path):
    x, y = UTM
    (tmp_path / "far.json").write_text(json.dumps({"throng": 1, "simulation": {"duration": 2, "warmup": 8}, "roads": [
        {"id": "far road", "centreline": [[x - 15, y], [x + 15.25, y]], "width": 4}], "flows": [
        {"id": "f", "from": "far road:start", "to": "far road:end", "count": 12}]}))
    found = result_of(blender(HERE / "check_drawing.py", ADDON, tmp_path, environment={"THRONG_BINARY": throng.binary}))
    assert found["unsaved"] == "save the .blend first: bakes are written beside it (or choose another folder)"
    layout = found["layout"]
    assert [road["width"] for road in layout["roads"]] == [8, 6] and layout["roads"][1]["one_way"] is True
    assert layout["roads"][0]["centreline"] == [[-20, 0], [20, 0]]
    assert len(layout["roads"][1]["centreline"]) > 8 and max(y for _, y in layout["roads"][1]["centreline"]) == pytest.approx(20.0)
    walls = {wall["id"]: wall for wall in layout["walls"]}
    assert walls["Wall"] == {"id": "Wall", "thickness": 0.4, "height": 2.5, "points": [[-5, -6], [5, -6]]}
    assert walls["Kiosk"]["closed"] and walls["Kiosk"]["height"] == 4 and len(walls["Kiosk"]["points"]) == 6, "an L of boxes has six corners"
    assert layout["flows"] == [{"id": "Flow 1", "from": "Road:start", "to": "Road:end", "count": 20}, {"id": "Flow 2", "from": "Area", "to": "Road:start", "count": 10}]
    assert found["twice"] and found["again"], "the same scene gives the same file, also after saving and opening"
    assert found["undone"] == {"add_road": True, "add_wall": True, "add_area": True, "add_formation": True, "add_flow": True}
    assert found["boxes"]["road"] == pytest.approx([40.0, 8.0, 0.0], abs=0.05)
    assert found["boxes"]["wall"] == pytest.approx([10.0, 0.4, 2.5], abs=1e-3)
    assert found["boxes"]["solid"] == pytest.approx([6.0, 4.0, 9.0], abs=1e-3)
    assert found["boxes"]["wider"] == pytest.approx([40.0, 11.0, 0.0], abs=0.05), "the drawing follows the property"

    people = found["first"]["people"]
    assert people == 42 and found["first"]["crowds"] == 1 and found["first"]["bake"] == ["shot"]
    assert found["first"]["streets"] and found["first"]["kiosk"] == 0, "the user's own mesh is not built a second time"
    assert found["second"] == {"people": 47, "crowds": 1, "same": True, "width": pytest.approx(6.0, abs=0.1)}

    assert found["errors"]["width"] == ["Road", "/roads/0/width", "Road"] and found["words"]["width"].startswith("Road width: 0 is out of range")
    assert found["errors"]["wall"][0] == "Wall" and found["errors"]["flow"][0] == 1 and found["words"]["flow"] == "Flow 2 to: choose where people go"
    assert found["errors"]["nurbs"][0] == "Area" and "NURBS" in found["words"]["nurbs"]
    assert found["kept"] == [47, True], "a bake that fails leaves the crowd and the bake before alone"
    assert "does not exist" in found["words"]["program"] and "--version" in found["words"]["other"]
    assert found["cancelled"] == ["cancelled", True, 47, []], "nothing is left of a cancelled bake"
    road, built, origin, crowds = found["far"]
    assert built == pytest.approx(0.248, abs=1e-3) and road == pytest.approx(0.248, abs=6e-3) and origin == [448262, 5411932] and crowds == 2
    count, aside, first, last = found["far people"]
    assert count >= 8 and aside < 3.0 and -16.0 < first < last < 17.0, "people walk on the road that was imported"
    assert "THRONG_OT_bake" not in found["types"]


def test_what_cannot_be_imported_is_refused_and_nothing_changes(blender, tmp_path):
    bad = {"syntax": "{", "family": '{"throng_family": 1}', "points": '{"throng": 1, "roads": [{"id": "a", "centreline": [[0, 0], "x"]}]}',
           "type": '{"throng": 1, "formations": [{"id": "a", "type": "star"}]}', "list": '{"throng": 1, "walls": {}}'}
    for name, text in bad.items():
        (tmp_path / f"{name}.json").write_text(text)
    script = tmp_path / "bad.py"
    script.write_text("""
import bpy, glob, json, os, sys
sys.path.insert(0, sys.argv[-2])
import throng
bpy.ops.wm.read_factory_settings(use_empty=True)
throng.register()
bpy.ops.throng.add_road()
before = len(bpy.data.objects), len(bpy.data.curves)
result = {}
for name in sorted(os.listdir(sys.argv[-1])):
    if not name.endswith('.json'):
        continue
    try:
        bpy.ops.import_scene.throng_layout(filepath=os.path.join(sys.argv[-1], name), replace=True)
    except RuntimeError as error:
        result[name[:-5]] = str(error)
    assert before == (len(bpy.data.objects), len(bpy.data.curves)), name
try:
    bpy.ops.import_scene.throng_layout(filepath=sys.argv[-1] + '/good/good.json')
except RuntimeError as error:
    result['twice'] = str(error)
try:
    bpy.ops.export_scene.throng_layout(filepath=sys.argv[-1] + '/nowhere/out.json')
except RuntimeError as error:
    result['folder'] = str(error)
print('RESULT ' + json.dumps(result))
""")
    (tmp_path / "good").mkdir()
    (tmp_path / "good" / "good.json").write_text('{"throng": 1}')
    found = result_of(blender(script, ADDON, tmp_path))
    words = {"syntax": "is not JSON", "family": "family", "points": "/roads/0/centreline: expected at least 2 points", "type": "/formations/0/type", "list": "/walls: expected a list",
             "twice": "there is a layout in this scene already", "folder": "cannot be written"}
    assert found.keys() == words.keys()
    for name, text in words.items():
        assert text in found[name] and "Traceback" not in found[name], name


def wait_for(job, condition, seconds=60.0):
    end = time.monotonic() + seconds
    while not condition() and time.monotonic() < end:
        job.poll()
        time.sleep(0.01)
    assert condition(), (job.state, job.message)


def test_a_job_bakes_and_tells_how_far_it_is(throng, tmp_path):
    job = BakeJob(throng.binary, str(EXAMPLES / "circle.json"), str(tmp_path / "bake"), ["--set", "simulation.duration=6", "--no-gltf"])
    assert job.poll() == "new"
    job.start()
    seen = []
    wait_for(job, lambda: seen.append(job.frame) or job.state != "running")
    assert job.state == "done" and job.percent == 100.0 and seen == sorted(seen) and job.frames == 144 and job.people == 256
    assert job.result["agents"] == 256 and job.diagnostics == [] and [path.name for path in tmp_path.iterdir()] == ["bake"]


@pytest.mark.parametrize("when", ["at once", "under way"])
def test_a_cancelled_job_leaves_what_was_there_before_and_nothing_else(throng, tmp_path, when):
    (tmp_path / "bake.partial").mkdir()  # of somebody who stopped a bake by hand
    (tmp_path / "bake.partial" / "bake.json").write_text("{}")
    job = BakeJob(throng.binary, str(EXAMPLES / "circle.json"), str(tmp_path / "bake"), ["--set", "simulation.duration=3000"])
    job.start()
    if when == "under way":
        wait_for(job, lambda: job.frame > 20)
    job.cancel()
    assert job.wait(30.0) == "cancelled" and job.message == "the bake was cancelled"
    left = {path.name for path in tmp_path.iterdir()}
    assert left <= {"bake.partial"} and (when == "under way" or left == {"bake.partial"})
    job.cancel()
    assert job.poll() == "cancelled"


def test_a_job_that_fails_says_why(throng, tmp_path):
    layout = tmp_path / "layout.json"
    layout.write_text('{"throng": 1,\n "roads": [{"id": "a", "centreline": [[0, 0], [9, 0]], "width": 0}],\n "flows": [{"id": "f", "from": "b", "to": "a:end", "count": 1}]}')
    job = BakeJob(throng.binary, str(layout), str(tmp_path / "bake"))
    job.start()
    assert job.wait(30.0) == "failed" and job.code == 3
    assert [(d.severity, d.pointer, d.line) for d in job.diagnostics] == [("error", "/roads/0/width", 2), ("error", "/flows/0/from", 3)]
    assert job.diagnostics[1].hint.startswith("known here: a:start") and job.message.endswith("(and 1 more)")
    assert [path.name for path in tmp_path.iterdir()] == ["layout.json"]
    assert check_layout(throng.binary, str(layout))[1] == job.diagnostics
    job = BakeJob(throng.binary, str(EXAMPLES / "circle.json"), "/proc/no/bake")
    job.start()
    assert job.wait(30.0) == "failed" and "/proc/no" in job.message and "throng:" not in job.message
    job = BakeJob(str(tmp_path / "absent"), str(layout), str(tmp_path / "bake"))
    job.start()
    assert job.state == "failed" and "does not run" in job.message


def test_a_job_whose_program_is_killed_says_so(throng, tmp_path):
    job = BakeJob(throng.binary, str(EXAMPLES / "circle.json"), str(tmp_path / "bake"), ["--set", "simulation.duration=3000"])
    job.start()
    wait_for(job, lambda: job.frame > 2)
    job._process.kill()
    assert job.wait(30.0) == "failed" and "signal 9" in job.message and list(tmp_path.iterdir()) == []


def test_diagnostics_are_read_from_what_the_program_says():
    text = ("lay out.json:4:20: error: /roads/0/width: 0 is out of range: expected at least 0.5\n  \"width\": 0\n           ^\n  hint: write 3\n"
            "lay out.json:9:1: warning: /flows/0/to/choose/main street: nobody: goes there\nlay out.json: error: a layout begins with {\"throng\": 1}\n")
    first, second, third = parse_diagnostics(text)
    assert first == ("error", "/roads/0/width", "0 is out of range: expected at least 0.5", "write 3", 4, 20)
    assert second[:3] == ("warning", "/flows/0/to/choose/main street", "nobody: goes there") and third[:3] == ("error", "", 'a layout begins with {"throng": 1}')


def program(path, says, code=0):
    path.write_text(f"#!/bin/sh\nprintf '%s\\n' '{says}'\nexit {code}\n")
    path.chmod(0o755)
    return str(path)


def test_the_program_is_found_and_its_version_checked(throng, tmp_path, monkeypatch):
    monkeypatch.delenv("THRONG_BINARY", raising=False)
    assert check_version(throng.binary).count(".") == 2
    with pytest.raises(ExecutableError, match="version 9.4.0, this add-on needs 0.1"):
        check_version(program(tmp_path / "newer", "throng 9.4.0"))
    with pytest.raises(ExecutableError, match="is not Throng"):
        check_version(program(tmp_path / "other", "ls (GNU coreutils) 9.1"))
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(ExecutableError, match="not on the PATH.*Preferences"):
        find_executable()
    assert find_executable(throng.binary) == throng.binary
    program(tmp_path / "throng", "throng 0.1.7")
    assert find_executable() == str(tmp_path / "throng") and check_version(find_executable()) == "0.1.7"
    with pytest.raises(ExecutableError, match="is a folder"):
        find_executable(str(tmp_path))
    monkeypatch.setenv("THRONG_BINARY", str(tmp_path / "newer"))
    assert find_executable() == str(tmp_path / "newer")


def test_the_simulations_settings_are_the_schemas():
    schema = json.loads((ROOT / "authoring" / "layout" / "throng-layout.schema.json").read_text())
    settings = schema["properties"]["simulation"]["properties"]
    rows = {row[0].key: row for row in fields.SIMULATION}
    assert rows.keys() == settings.keys()
    for key, entry in settings.items():
        codec, _, least, most, _ = rows[key]
        assert codec.default == entry["default"], key
        if "enum" in entry:
            assert isinstance(codec, Choice) and list(codec.words) == entry["enum"]
        elif entry["type"] == "boolean":
            assert isinstance(codec, Flag)
        else:
            assert isinstance(codec, Whole) == (entry["type"] == "integer")
            assert least == entry.get("minimum", entry.get("exclusiveMinimum")) and most == min(entry["maximum"], 2**31 - 1), key
    assert set(fields.BARS) == set(schema["definitions"]["expect"]["properties"]) - {"line"}


def test_numbers_keep_their_digits():
    for value in (0.1, 1.0 / 3.0, 123456.789, 1e-7, -0.3, 16777216.0, 3.0):
        assert single(short(single(value))) == single(value)
    assert short(single(0.3)) == 0.3 and short(3.0) == 3 and isinstance(short(3.0), int)
    raw = [[448262.123456, 5411932.678901], [448272.1, 5411933.2], [448282.3, 5411934.9]]
    origin = (448272.0, 5411933.0)
    shown = [tuple(single(p - o) for p, o in zip(point, origin)) for point in raw]
    assert keep_points(shown, raw, origin) == raw
    shown[1] = (shown[1][0] + 1.0, shown[1][1])
    assert keep_points(shown, raw, origin) == [raw[0], [448273.1, 5411933.2], raw[2]]
    assert keep_points(shown[:1] + shown[2:], raw, origin) == [raw[0], raw[2]]
    assert keep_points(shown[:1] + [(0.0, 5.0), (1.0, 5.0)] + shown[2:], raw, origin) == [raw[0], [448272, 5411938], [448273, 5411938], raw[2]]


def test_bezier_curves_keep_to_their_tolerance():
    a, b, c, d = (0.0, 0.0), (0.0, 10.0), (10.0, 10.0), (10.0, 0.0)
    point = lambda t: tuple((1 - t) ** 3 * a[i] + 3 * (1 - t) ** 2 * t * b[i] + 3 * (1 - t) * t * t * c[i] + t**3 * d[i] for i in (0, 1))
    sizes = []
    for tolerance in (0.5, 0.02, 0.001):
        line = [a] + curves.flatten(a, b, c, d, tolerance)
        worst = max(min(curves._distance_to_chord(point(t / 500), p, q) for p, q in zip(line, line[1:])) for t in range(501))
        assert worst <= tolerance and line[-1] == d
        sizes.append(len(line))
    assert sizes[0] < sizes[1] < sizes[2] < 200
    assert curves.flatten(a, (1.0, 0.0), (2.0, 0.0), (3.0, 0.0), 0.01) == [(3.0, 0.0)], "a straight one needs no points between"


def test_footprints_of_meshes():
    square = [(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (0.0, 4.0)]
    box = square + square
    faces = [[3, 2, 1, 0], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]]
    corners = lambda outlines: [sorted(outline) for outline in outlines]
    assert corners(curves.footprint(box, faces, [-1, 1, 0, 0, 0, 0])) == [sorted(square)]
    assert corners(curves.footprint(square, [[0, 1, 2, 3]], [1])) == [sorted(square)], "a plane that looks up"
    assert corners(curves.footprint(square, [], [])) == [sorted(square)], "no faces: the hull"
    grid = [(float(x), float(y)) for y in range(5) for x in range(5)]
    cells = [[5 * y + x, 5 * y + x + 1, 5 * y + x + 6, 5 * y + x + 5] for y in range(4) for x in range(4)]
    assert corners(curves.footprint(grid, cells, [1] * 16)) == [sorted(square)], "points on straight edges go"
    courtyard = [cell for i, cell in enumerate(cells) if i not in (5, 6, 9, 10)]
    assert corners(curves.footprint(grid, courtyard, [1] * 12)) == [sorted(square)], "a hole is no wall of its own"
    apart = [cells[0], cells[15]]
    assert len(curves.footprint(grid, apart, [1, 1])) == 2
    assert curves.footprint([(0.0, 0.0), (1.0, 1.0)], [], []) == []
