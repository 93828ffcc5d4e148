# SPDX-License-Identifier: Apache-2.0
"""A scene that is drawn in a real Blender, baked from the panel, mended, and baked again."""
import json

import pytest

from results import ADDON, HERE, result_of

X, Y = 448262.123, 5411932.678  # where in the world the layout lies that is imported
FAR = {"throng": 1, "simulation": {"duration": 2, "warmup": 8},
       "roads": [{"id": "far road", "centreline": [[X - 15, Y], [X + 15.25, Y]], "width": 4}],
       "flows": [{"id": "f", "from": "far road:start", "to": "far road:end", "count": 12}]}


@pytest.fixture(scope="module")
def drawn(blender, throng, tmp_path_factory):
    """What check_drawing.py has seen."""
    folder = tmp_path_factory.mktemp("drawn")
    (folder / "far.json").write_text(json.dumps(FAR))
    return result_of(blender(HERE / "check_drawing.py", ADDON, folder, environment={"THRONG_BINARY": throng.binary}))


def test_what_is_drawn_is_the_layout(drawn):
    layout = drawn["layout"]
    assert [road["width"] for road in layout["roads"]] == [8, 6] and layout["roads"][1]["one_way"] is True
    straight, curved = (road["centreline"] for road in layout["roads"])
    assert straight == [[-20, 0], [20, 0]]
    assert len(curved) > 8 and max(y for _, y in curved) == pytest.approx(20.0)
    walls = {wall["id"]: wall for wall in layout["walls"]}
    assert walls["Wall"] == {"id": "Wall", "thickness": 0.4, "height": 2.5, "points": [[-5, -6], [5, -6]]}
    kiosk = walls["Kiosk"]
    assert kiosk["closed"] and kiosk["height"] == 4 and len(kiosk["points"]) == 6, "an L of boxes has six corners"
    assert layout["flows"] == [{"id": "Flow 1", "from": "Road:start", "to": "Road:end", "count": 20},
                               {"id": "Flow 2", "from": "Area", "to": "Road:start", "count": 10}]
    assert drawn["twice"] and drawn["again"], "the same scene gives the same file, also after saving and opening"


def test_what_is_added_is_undone(drawn):
    assert drawn["undone"] == {"add_road": True, "add_wall": True, "add_area": True, "add_formation": True,
                               "add_flow": True}


@pytest.mark.parametrize("name, size, off", [("road", [40.0, 8.0, 0.0], 0.05), ("wall", [10.0, 0.4, 2.5], 1e-3),
                                             ("solid", [6.0, 4.0, 9.0], 1e-3), ("wider", [40.0, 11.0, 0.0], 0.05)])
def test_the_drawing_is_as_large_as_its_properties_say(drawn, name, size, off):
    assert drawn["boxes"][name] == pytest.approx(size, abs=off)


def test_a_bake_comes_back_as_a_crowd_and_again_in_its_place(drawn):
    first = drawn["first"]
    assert first["people"] == 42 and first["crowds"] == 1 and first["bake"] == ["shot"]
    assert first["streets"] and first["kiosk"] == 0, "the user's own mesh is not built a second time"
    assert drawn["second"] == {"people": 47, "crowds": 1, "same": True, "width": pytest.approx(6.0, abs=0.1)}


def test_errors_are_shown_at_what_caused_them(drawn):
    errors, words = drawn["errors"], drawn["words"]
    assert drawn["unsaved"] == "save the .blend first: bakes are written beside it (or choose another folder)"
    assert errors["width"] == ["Road", "/roads/0/width", "Road"]
    assert words["width"].startswith("Road width: 0 is out of range")
    assert errors["wall"][0] == "Wall"
    assert errors["flow"][0] == 1 and words["flow"] == "Flow 2 to: choose where people go"
    assert errors["nurbs"][0] == "Area" and "NURBS" in words["nurbs"]
    assert "does not exist" in words["program"] and "--version" in words["other"]
    assert drawn["kept"] == [47, True], "a bake that fails leaves the crowd and the bake before alone"


def test_nothing_is_left_of_a_cancelled_bake(drawn):
    assert drawn["cancelled"] == ["cancelled", True, 47, []]


def test_a_layout_far_away_is_worked_on_near_the_origin(drawn):
    road, built, origin, crowds = drawn["far"]
    assert built == pytest.approx(0.248, abs=1e-3) and road == pytest.approx(0.248, abs=6e-3)
    assert origin == [448262, 5411932] and crowds == 2
    count, aside, first, last = drawn["far people"]
    assert count >= 8 and aside < 3.0 and -16.0 < first < last < 17.0, "people walk on the road that was imported"


def test_nothing_is_registered_when_the_add_on_is_gone(drawn):
    assert "THRONG_OT_bake" not in drawn["types"]
