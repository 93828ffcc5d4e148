# SPDX-License-Identifier: Apache-2.0
"""Seats drawn in a real Blender: what is seen is what a bake builds, what was changed is in the layout and nothing
else, mistakes are told at the block, and an audience that is drawn from nothing is baked."""
import json

import pytest

from conftest import EXAMPLES, ROOT
from results import ADDON, HERE, result_of
from test_authoring import differences
from throng.authoring import seat_plan

STANDS = HERE / "layouts" / "stands.json"
SHORT = ("--set", "simulation.duration=0.1", "--set", "simulation.warmup=0")
OTHERS = (EXAMPLES / "stadium-stands.json", EXAMPLES / "stadium-wave.json", EXAMPLES / "taking-seats.json",
          ROOT / "docs" / "examples" / "walked-seats.json", ROOT / "docs" / "examples" / "seats.json")
ARC = "/seats/1/arc"
EDITS = {
    "nothing": set(),
    "move": {f"/seats/0/front/{i}/0" for i in range(3)},
    "move_a_point": {"/seats/0/front/2/1"},
    "turn_arc": {f"{ARC}/from", f"{ARC}/to"},
    "scale_arc": {f"{ARC}/radius"},
    "mirror_arc": {f"{ARC}/from", f"{ARC}/to"},
    "rename": {"/seats/0/id", "/seats/6/id", "/flows/0/to/seats", "/flows/1/to/seats/0",
               "/formations/0/goal/seats/0", "/behaviours/0/states/see/sit/0",
               "/behaviours/0/states/see/until/0/near", "/shows/0/who/0", "/shows/1/who/0"},
    "numbers": {f"/seats/4/{key}" for key in ("rows", "pitch", "width", "rise", "height", "aisles", "aisle_width",
                                              "occupancy")},
    "mouths_to_the_front": {f"/seats/1/mouths/{key}" for key in ("at", "passage")},
    "mouths_to_the_back": {f"/seats/0/mouths/{key}" for key in ("at", "row")},
    "mouths_on_a_row": {"/seats/6/mouths"},
    "nobody_leaves": {"/seats/0/leave"},
    "somebody_leaves": {"/seats/6/leave"},
    "other_people": {"/seats/0/people/profile"},
    "into_an_arc": {"/seats/3/arc", "/seats/3/front"},
    "into_a_line": {"/seats/2/arc", "/seats/2/front"},
    "look_there": {"/seats/6/facing"},
    "clap_in_stead_of_a_wave": {f"/shows/1/{key}" for key in ("do", "from", "speed", "width", "laps")},
    "add_a_show": {"/shows/4"},
    "go_to_other_seats": {"/flows/0/to/seats"},
    "flee_from_others": {"/behaviours/0/states/run/flee"},
    "rename_who_is_fled_from": {"/behaviours/0/states/run/flee", "/flows/0/id"},
    "near_others_by_name": {"/behaviours/0/states/see/until/0/near", "/formations/0/id"},
    "delete": None,
}


@pytest.fixture(scope="module")
def drawn(blender, throng, tmp_path_factory):
    """What check_drawn_seats.py has seen; the program takes whatever was changed."""
    folder = tmp_path_factory.mktemp("drawn-seats")
    found = result_of(blender(HERE / "check_drawn_seats.py", ADDON, STANDS, folder, *OTHERS,
                              environment={"THRONG_BINARY": throng.binary}))
    throng("check", *(folder / f"{edit}.json" for edit in EDITS if edit != "delete"))
    return found


@pytest.fixture(scope="module")
def built(throng, tmp_path_factory, manifest_of):
    """{layout: its blocks of seats, as a bake tells them}"""
    folder = tmp_path_factory.mktemp("built-seats")
    found = {}
    for path in (STANDS, *OTHERS):
        throng("bake", path, "-o", folder / path.stem, "-q", "--no-gltf", *SHORT)
        manifest = manifest_of(folder / path.stem)
        found[path.name] = (manifest["geometry"]["seats"], manifest["origin"])
    return found


def numbers_of(value):
    if isinstance(value, dict):
        return [each for key in sorted(value) if key != "id" for each in numbers_of(value[key])]
    return [each for part in value for each in numbers_of(part)] if isinstance(value, (list, tuple)) else [value]


def shifted(value, origin, key=""):
    """Lines of points, which a bake tells from its origin."""
    if isinstance(value, dict):
        return {name: shifted(part, origin, name) for name, part in value.items()}
    if key == "line":
        return [[x + origin[0], y + origin[1]] for x, y in value]
    return [shifted(part, origin, key if key != "line" else "") for part in value] if isinstance(value, list) else value


def test_what_is_drawn_is_what_is_built(drawn, built):
    """Rows, aisles, flights and passages, to what single floats are off."""
    count = 0
    for name, (blocks, origin) in built.items():
        assert len(drawn["plans"][name]) == len(blocks) > 0
        for (plan, _, _), block in zip(drawn["plans"][name], blocks):
            there = shifted(block, origin)
            assert [len(plan[key]) for key in ("rows", "aisles")] == [len(block.get(key, ())) for key in
                                                                      ("rows", "aisles")], (name, block["id"])
            assert numbers_of(plan) == pytest.approx(numbers_of({**there, "aisles": there.get("aisles", [])}),
                                                     abs=2e-4), (name, block["id"])
            count += 1
    assert count == 21


def test_the_panel_tells_how_many_seats_there_are(drawn):
    """Counted by hand where rows are straight: 5 rows of 16 m, less 1.2 m of an aisle, are 5 x 2 x 14 seats of half a
    metre; those of examples/stadium-stands.json are its people, as all seats are taken."""
    counts = [count for _, count, _ in drawn["plans"]["stands.json"]]
    assert counts[3] == 1 and counts[6] == 140 and counts[7] == 64
    assert counts[2] == int(2.0 * 180 * 2.0 * 20 * 0.0087265 / 0.63)  # chords of a degree
    assert sum(count for _, count, _ in drawn["plans"]["stadium-stands.json"]) == 8196


def test_changes_are_in_the_layout_and_nothing_else(drawn):
    before = json.loads(STANDS.read_text(encoding="utf-8"))
    assert drawn["edits"].keys() == EDITS.keys()
    for name, expected in EDITS.items():
        if expected is not None:
            assert differences(before, drawn["edits"][name]) == expected, name
    assert [each["id"] for each in drawn["edits"]["delete"]["seats"]] == \
        [each["id"] for each in before["seats"] if each["id"] != "one"]


def test_blocks_are_where_they_were_put(drawn):
    after = {name: layout["seats"] for name, layout in drawn["edits"].items()}
    assert [after["turn_arc"][1]["arc"][key] for key in ("from", "to")] == [-50, 93]
    assert [after["mirror_arc"][1]["arc"][key] for key in ("from", "to")] == [117, 260]
    assert after["scale_arc"][1]["arc"]["radius"] == pytest.approx(2 * 17.123456789, abs=1e-5)
    assert after["into_an_arc"][3]["arc"] == {"centre": [0.25, 30], "radius": 7.5, "from": 0, "to": 45}
    assert after["into_a_line"][2]["front"] == [[120, 0], [123, 0]]
    assert after["look_there"][6]["facing"] == [3.5, 70]


def test_blocks_are_as_they_were_set(drawn):
    after = {name: layout["seats"] for name, layout in drawn["edits"].items()}
    assert {key: after["numbers"][4][key] for key in ("rows", "pitch", "aisles", "occupancy")} == \
        {"rows": 4, "pitch": 0.85, "aisles": 1, "occupancy": 0.6}
    assert after["mouths_to_the_back"][0]["mouths"] == {"at": "back", "passage": 5.123456789, "level": "concourse"}
    assert after["mouths_on_a_row"][6]["mouths"] == {"at": "row", "row": 2, "level": "pitch"}
    assert after["somebody_leaves"][6]["leave"] == {"at": 60, "to": "gate"}


def test_those_who_speak_of_blocks_follow_their_names(drawn):
    layout = drawn["edits"]["rename"]
    assert [flow["to"] for flow in layout["flows"][:2]] == [{"seats": "stalls"}, {"seats": ["stalls"]}]
    assert layout["behaviours"][0]["states"]["see"]["sit"] == ["stalls", "ends"]
    assert layout["shows"][0]["who"] == ["stand", "bow"]
    assert drawn["edits"]["go_to_other_seats"]["flows"][0]["to"] == {"seats": ["goal", "ends"]}
    assert drawn["edits"]["flee_from_others"]["behaviours"][0]["states"]["run"]["flee"] == "more"
    assert drawn["edits"]["near_others_by_name"]["behaviours"][0]["states"]["see"]["until"][0]["near"] == "pupils"
    assert drawn["edits"]["rename_who_is_fled_from"]["behaviours"][0]["states"]["run"]["flee"] == "crowd"


def test_shows_are_as_they_were_set(drawn):
    shows = drawn["edits"]["add_a_show"]["shows"]
    assert shows[4] == {"at": 3.5, "do": "wave", "who": ["bow", "goal"], "share": 0.75}
    assert drawn["edits"]["clap_in_stead_of_a_wave"]["shows"][1] == {
        "at": 7.123456789, "do": "clap", "who": ["south", "one"]}


def near(box, expected):
    return [value for pair in box for value in pair] == pytest.approx([value for pair in expected for value in pair],
                                                                      abs=1e-4)


def test_the_drawing_follows_numbers_places_and_points(drawn):
    """One seat on [0, 0.5] at y = 30: its row is 0.4 m deep on either side and has a ledge of 0.12 m before its feet,
    its back leans back to 0.44 m and is 0.78 m high."""
    seen = drawn["seen"]
    assert near(seen["one"], [[0, 0.5], [29.56, 30.52], [0, 0.78]])
    assert near(seen["moved"], [[49.48, 50.44], [29.75, 30.25], [0, 0.78]]), "a quarter turn about its middle"
    assert near(seen["higher"], [[0, 0.5], [27.96, 30.52], [0, 3.78]]), "two more rows, half a metre each, from 2 m on"
    assert near(seen["longer"][0], [[-0.5, 1.0], [27.96, 30.52], [0, 3.78]]) and seen["longer"][1] == 9
    assert near(seen["in edit mode"][:1], [[0, 5.5]])
    assert near(seen["copied"], [[0, 3.78], [0, 2.78]]), "a copy is another block"
    assert seen["arc"] == pytest.approx(17.123456789, abs=1e-5) and seen["unmarked"]


WRONG = {
    "no seats chosen": ("choose to which seats people go", "/flows/0/to", ""),
    "rows": ("0 is out of range: expected at least 1 and at most 200", "/seats/0/rows", "Seats"),
    "pitch": ("0.2 is out of range: expected at least 0.5 and at most 10", "/seats/0/pitch", "Seats"),
    "width": ("20 is out of range: expected at least 0.35 and at most 10", "/seats/0/width", "Seats"),
    "aisles": ("61 is out of range: expected at least 0 and at most 60", "/seats/0/aisles", "Seats"),
    "occupancy": ("1.5 is out of range: expected at least 0 and at most 1", "/seats/0/occupancy", "Seats"),
    "height": ("2000 is out of range: expected at least -1000 and at most 1000", "/seats/0/height", "Seats"),
    "no such row": ("block `Seats` has 4 rows: its aisles cannot come out on row 9", "/seats/0/mouths/row", "Seats"),
    "steep passage": ("the passages of block `Seats` climb 5.30 m over 2.50 m: they climb at most 80 %",
                      "/seats/0/mouths", "Seats"),
    "nowhere to go": ("choose where people go", "/seats/0/leave/to", "Seats"),
    "no arc": ("the arc goes from 60 to 60 degrees: counter-clockwise, at most a whole round", "/seats/1/arc/to",
               "Seats.001"),
    "cyclic": ("Seats: the first row of seats is one open curve; separate its splines, or make it an arc", "", "Seats"),
    "bends sharply": ("block `Seats`: rows so far behind a first row that bends so sharply cross themselves",
                      "/seats/0", "Seats"),
}


def test_mistakes_are_told_at_the_block(drawn):
    assert {name: (message, pointer, target) for name, (_, message, _, pointer, target) in drawn["wrong"].items()} \
        == WRONG
    assert drawn["wrong"]["steep passage"][2] == 'write "passage": 6.7 or more, or take another row'
    assert drawn["told"] == ["rows so far behind a first row that bends so sharply cross themselves", 0], \
        "the panel says the same at once, and nothing is drawn"


def test_an_audience_is_drawn_from_nothing(drawn):
    layout = drawn["drawn"]
    assert layout["seats"] == [
        {"id": "Seats", "front": [[-6, 0], [6, 0]], "rows": 4, "pitch": 0.9, "rise": 0.3, "aisles": 1,
         "occupancy": 0.5},
        {"id": "Seats.001", "arc": {"centre": [0, 8], "radius": 9, "from": 60, "to": 120}, "rows": 2, "rise": 0.5}]
    assert layout["flows"] == [{"id": "Flow 1", "from": "Area", "to": {"seats": "Seats"}, "count": 6}]
    assert layout["shows"] == [{"at": 0.5, "do": "cheer"}]


def test_its_bake_comes_back_as_a_crowd_in_the_stands_that_were_drawn(drawn):
    bake = drawn["bake"]
    assert bake["crowds"] == 1 and bake["verify"] == [] and bake["walls"] == []
    # 4 x 2 x 10 seats beside an aisle, half of them taken; 18 + 20 of the arc; and 6 who walk
    assert bake["people"] == 40 + 38 + 6
    boxes = list(bake["stands"].values())
    assert len(boxes) == 2
    for before, after in zip(drawn["seen"]["before"], boxes):
        assert near(before, after)


def test_drawn_seats_are_undone_saved_and_opened(drawn):
    assert drawn["undone"] == 2 and drawn["again"] and drawn["gone"]
    assert drawn["seen"]["again"] == drawn["seen"]["before"]
    assert near(drawn["seen"]["grown"][1:], [[-4.05, 0.57], [0, 1.98]])


def test_numbers_that_make_no_sense_are_drawn_as_some_that_do():
    block = seat_plan.Block([(0.0, 0.0), (0.0, 0.0), (10.0, 0.0)], rows=-5, pitch=0.0, width=0.0, aisles=-2,
                            aisle_width=-1.0, mouths="row", mouth_row=0)
    (plan, count) = seat_plan.plan_of(block)
    assert len(plan["rows"]) == 1 and count == 100 and plan["aisles"] == []
    assert seat_plan.plan_of(seat_plan.Block([(1.0, 1.0), (1.0, 1.0)])) is None
