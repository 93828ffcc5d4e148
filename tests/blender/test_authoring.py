# SPDX-License-Identifier: Apache-2.0
"""Layouts drawn in a real Blender: lossless files, changes that appear and nothing else, bakes from the panel,
errors at what caused them."""
import json
import math
import random

import pytest

from conftest import EXAMPLES, ROOT
from results import ADDON, HERE, result_of

EVERYTHING = HERE / "layouts" / "everything.json"
LEVELS = ROOT / "tests" / "authoring" / "layouts" / "levels.json"  # which are kept as they are
UTM = (448262.123, 5411932.678)


def differences(a, b, pointer=""):
    """JSON pointers of what differs; {} where a key or an item is there in one of them only."""
    if isinstance(a, dict) and isinstance(b, dict):
        both = {p for key in a.keys() & b.keys() for p in differences(a[key], b[key], f"{pointer}/{key}")}
        return both | {f"{pointer}/{key}" for key in a.keys() ^ b.keys()}
    if isinstance(a, list) and isinstance(b, list):
        longer = {f"{pointer}/{i}" for i in range(min(len(a), len(b)), max(len(a), len(b)))}
        return {p for i, (x, y) in enumerate(zip(a, b)) for p in differences(x, y, f"{pointer}/{i}")} | longer
    return set() if a == b and isinstance(a, bool) == isinstance(b, bool) else {pointer}


def moved(layout, x, y):
    """The layout elsewhere in the world."""
    points = {"centreline", "polygon", "points", "line", "centre", "origin", "facing", "position", "mirror", "anywhere",
              "front", "from", "path", "floor"}

    def there(point):
        return [point[0] + x, point[1] + y]

    def walk(value, key=""):
        if key in points and isinstance(value, list):
            return there(value) if isinstance(value[0], (int, float)) else [there(point) for point in value]
        if key == "ways":
            return [[[time, place[0] + x, place[1] + y] for time, *place in way] for way in value]
        if key == "goal" and isinstance(value, list):
            return there(value)
        if isinstance(value, dict):
            return {k: walk(v, k) for k, v in value.items()}
        return [walk(v) for v in value] if isinstance(value, list) else value

    return walk(layout)


def layouts():
    return [path for folder in (EXAMPLES, ROOT / "scenarios") for path in sorted(folder.glob("*.json"))
            if "throng" in json.loads(path.read_text())]


def others_with_seats():
    """Layouts with seats from elsewhere, some of which are called as others are."""
    folders = (ROOT / "scenarios" / "large", ROOT / "docs" / "examples", ROOT / "tests" / "authoring" / "layouts",
               HERE / "layouts")
    return [path for folder in folders for path in sorted(folder.glob("*.json"))
            if "seats" in json.loads(path.read_text(encoding="utf-8"))]


def test_every_layout_goes_through_blender_unchanged(blender, throng, tmp_path):
    (tmp_path / "in").mkdir()
    (tmp_path / "out").mkdir()
    everything = json.loads(EVERYTHING.read_text(encoding="utf-8"))
    (tmp_path / "in" / "far.json").write_text(json.dumps(moved(everything, *UTM)))
    wave = [[0.1 * i, math.sin(0.01 * i) * 3.0] for i in range(10000)]
    draw = random.Random(5)
    people = [{"position": [draw.uniform(0, 90), draw.uniform(5, 80)],
               "goal": [draw.uniform(0, 90), draw.uniform(5, 80)]} for _ in range(1000)]
    bulk = {"throng": 1, "walls": [{"points": wave}],
            "formations": [{"id": "list", "type": "agents", "agents": people}]}
    (tmp_path / "in" / "bulk.json").write_text(json.dumps(bulk))
    (tmp_path / "in" / "bare.json").write_text('{"throng": 1, "walls": [], "expect": {}, "simulation": {}}')
    for path in others_with_seats():
        (tmp_path / "in" / f"{path.parent.name}-{path.name}").write_bytes(path.read_bytes())
    stands = json.loads((HERE / "layouts" / "stands.json").read_text(encoding="utf-8"))
    (tmp_path / "in" / "far-stands.json").write_text(json.dumps(moved(stands, *UTM)))
    paths = layouts() + [EVERYTHING, LEVELS] + sorted((tmp_path / "in").glob("*.json"))
    assert len(paths) > 45 and sum("seats" in json.loads(path.read_text(encoding="utf-8")) for path in paths) > 11
    times = result_of(blender(HERE / "check_round_trip.py", ADDON, tmp_path / "out", *paths))
    for path in paths:
        before, after = (json.loads(each.read_text(encoding="utf-8")) for each in (path, tmp_path / "out" / path.name))
        assert differences(before, after) == set(), path
    into, out, objects = times["bulk.json"]
    assert into < 3.0 and out < 3.0 and objects == 2, "10,000 points and 1,000 people take fractions of a second"
    # What is equal is as valid as it was; these few also show that the text is one that the program reads.
    throng("check", *(tmp_path / "out" / f"{name}.json" for name in ("station", "intersection", "everything", "far")))


EDITS = {
    "nothing": set(),
    "move_wall": {f"/walls/2/points/{i}/0" for i in range(4)},
    "turn_wall": {f"/walls/2/points/{i}/{j}" for i in range(4) for j in range(2)},
    "move_one_point": {"/walls/2/points/1/0"},
    "insert_a_point": {"/roads/2/centreline/1/0", "/roads/2/centreline/2"},
    "change_patch": {"/patches/0/cost", "/patches/0/pace", "/patches/0/size", "/patches/0/until"},
    "move_patch": {f"/patches/2/polygon/{i}/0" for i in range(3)},
    "change_width": {"/roads/2/width"},
    "add_flow": {"/flows/3"},
    "rename_area": {"/areas/1/id", "/flows/0/to", "/flows/1/via/2/choose/hall", "/flows/1/via/2/choose/foyer",
                    "/flows/1/via/3/at", "/flows/1/via/4/at", "/flows/1/to/choose/hall", "/flows/1/to/choose/foyer",
                    "/flows/2/to/nearest/0", "/formations/4/goal/nearest/0", "/events/3/go_to/choose/hall",
                    "/events/3/go_to/choose/foyer", "/events/4/go_to",
                    "/formations/5/agents/3/goal/choose/hall", "/formations/5/agents/3/goal/choose/foyer"},
    "rename_flow": {"/flows/1/id", "/events/2/flow"},
    "people": {"/flows/2/people/profile"},
    "wheelchairs": {"/flows/2/people/body"},
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
    "change_motion": {"/motion/headway/enabled", "/motion/passing_side", "/motion/planted_feet/slip"},
    "delete_wall": None,
    "duplicate_wall": None,
    "close_wall": {"/walls/3/closed", "/walls/3/points/2"},
    "change_bar": {"/expect/flow/max"},
    "change_given": {"/given/0/start", "/given/0/offset/1", "/given/0/people/look"},
    "give_a_file": {"/given/0/ways", "/given/0/file", "/given/0/fps"},
    "add_given": {"/given/1"},
}


@pytest.fixture(scope="module")
def edited(blender, throng, tmp_path_factory):
    """(the layout before, {edit: the layout after it})."""
    folder = tmp_path_factory.mktemp("edited")
    after = result_of(blender(HERE / "check_authoring_edits.py", ADDON, EVERYTHING, folder))
    throng("check", *(folder / f"{name}.json" for name in ("move_wall", "add_flow", "rename_area", "duplicate_wall")))
    return json.loads(EVERYTHING.read_text(encoding="utf-8")), after


def test_changes_appear_in_the_layout_and_only_there(edited):
    before, after = edited
    assert after.keys() == EDITS.keys()
    for name, expected in EDITS.items():
        if expected is not None:
            assert differences(before, after[name]) == expected, name


def test_roads_and_walls_are_where_they_were_put(edited):
    before, after = edited
    house = before["walls"][2]["points"]
    assert after["move_wall"]["walls"][2]["points"] == [[x + 2.5, y] for x, y in house]
    assert after["move_one_point"]["walls"][2]["points"][1] == [6.5, 20]
    turned = [[12.5 - (y - 14.0), 14.0 + (x - 12.5)] for x, y in house]  # about its middle
    assert [math.dist(a, b) < 1e-5 for a, b in zip(after["turn_wall"]["walls"][2]["points"], turned)] == [True] * 4
    assert after["close_wall"]["walls"][3]["closed"] is True
    assert after["insert_a_point"]["roads"][2]["centreline"] == [[0, 30], [30, 30], [60, 30]]
    assert after["change_width"]["roads"][2]["width"] == 4.3


def test_walls_are_taken_out_and_copied(edited):
    walls, after = edited[0]["walls"], edited[1]
    assert after["delete_wall"]["walls"] == walls[:2] + walls[3:]
    copies = after["duplicate_wall"]["walls"]
    assert copies[:3] == walls[:3] and copies[4:] == walls[3:]
    assert copies[3] == {**walls[2], "id": "house.001", "points": [[x + 100, y] for x, y in walls[2]["points"]]}


def test_flows_and_events_are_as_they_were_set(edited):
    before, after = edited
    assert after["add_flow"]["flows"][3] == {"id": "Flow 4", "from": "square", "to": "hall", "count": 7}
    assert after["rename_area"]["flows"][0]["to"] == "foyer" and after["rename_flow"]["events"][2]["flow"] == "way"
    assert after["stop_longer"]["flows"][1]["via"][4]["wait"] == 5.5
    assert after["amount"]["flows"][1]["count"] == 12 and "rate" not in after["amount"]["flows"][1]
    assert after["reorder_stops"]["flows"][1]["via"][:2] == before["flows"][1]["via"][1::-1]
    assert after["wheelchairs"]["flows"][2]["people"]["body"] == "wheelchair"
    assert after["mean_speed"]["flows"][0]["people"]["speed"]["log_normal"] == [0.3, 0.1]


def test_formations_are_as_they_were_set(edited):
    before, after = edited
    assert after["scale_ring"]["formations"][0]["radius"] == pytest.approx(2 * 5.123456789, abs=1e-5)
    assert after["turn_block"]["formations"][1]["rotation"] == pytest.approx(45.0, abs=1e-4)
    assert after["move_a_person"]["formations"][5]["agents"][1]["position"] == [-99.5, 2]
    assert after["remove_a_person"]["formations"][5]["agents"] == before["formations"][5]["agents"][1:]


def test_what_cannot_be_imported_is_refused_and_nothing_changes(blender, tmp_path):
    bad = {"syntax": "{", "family": '{"throng_family": 1}',
           "points": '{"throng": 1, "roads": [{"id": "a", "centreline": [[0, 0], "x"]}]}',
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
    words = {"syntax": "is not JSON", "family": "family", "points": "/roads/0/centreline: expected at least 2 points",
             "type": "/formations/0/type", "list": "/walls: expected a list",
             "twice": "there is a layout in this scene already", "folder": "cannot be written"}
    assert found.keys() == words.keys()
    for name, text in words.items():
        assert text in found[name] and "Traceback" not in found[name], name
