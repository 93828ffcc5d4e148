# SPDX-License-Identifier: Apache-2.0
"""Two storeys that are drawn in a real Blender from nothing, baked from the panel, and played."""
import json

import pytest

from results import ADDON, HERE, result_of


@pytest.fixture(scope="module")
def drawn(blender, throng, tmp_path_factory):
    """What check_drawn_levels.py has seen."""
    folder = tmp_path_factory.mktemp("drawn levels")
    return result_of(blender(HERE / "check_drawn_levels.py", ADDON, folder,
                             environment={"THRONG_BINARY": throng.binary}))


def test_what_is_drawn_is_the_layout(drawn):
    layout = drawn["layout"]
    low, high = layout["levels"]
    assert low == {"id": "Level", "floor": [[-12, -8], [12, -8], [12, 8], [-12, 8]]}
    assert high == {"id": "Level.001", "floor": [[-12, 8], [12, 8], [12, 16], [-12, 16]], "height": 3.4}
    link, = layout["links"]
    assert (link["from"], link["to"], link["width"]) == ("Level", "Level.001", 1.6) and "type" not in link
    assert len(link["path"]) == 4 and not {"speed", "walking", "stand"} & link.keys()
    assert "level" not in layout["formations"][0]
    assert layout["areas"][0]["level"] == layout["walls"][0]["level"] == "Level.001"


def test_parts_are_drawn_at_the_height_of_their_level(drawn):
    assert drawn["drawn at"] == pytest.approx([0.0, 3.4, 3.4, 3.4], abs=1e-6)
    assert drawn["stairs"] == pytest.approx([0.0, 3.4], abs=0.05)


def test_mistakes_are_shown_at_what_caused_them(drawn):
    assert "joins two levels" in drawn["too few"] and drawn["check"] == ""
    words, active = drawn["narrow"]
    assert words.startswith("Stairs width: 0.2 is out of range") and active == "Stairs"
    words, targets = drawn["low"]
    assert "climbs 1.00 m" in words and targets == ["Stairs"]


def test_people_walk_up_and_are_seen_there(drawn):
    assert drawn["people"] == 20
    assert [place[2] for place in drawn["first"]] == pytest.approx([0.0] * 20, abs=1e-3)
    up = [place for place in drawn["last"] if abs(place[2] - 3.4) < 1e-3]
    assert len(up) >= 15, drawn["last"]
    on_landing = [z for z in drawn["middle"] if abs(z - 1.7) < 0.03]
    assert len(on_landing) >= 5, sorted(drawn["middle"])
    low, high = drawn["ground"]
    assert low < 0.0 and high == pytest.approx(3.4 + 0.085, abs=0.01)  # half a riser of the cheeks of stairs


def test_what_is_renamed_is_renamed_everywhere(drawn):
    renamed = drawn["renamed"]
    assert renamed["levels"][1]["id"] == renamed["links"][0]["to"] == renamed["areas"][0]["level"] == "gallery"
    assert drawn["again"] and drawn["heights"]["Area"] == drawn["heights"]["gallery"] == 3.4
    assert json.dumps(renamed).count("Level.001") == 0
    seats, = renamed["seats"]
    assert seats["level"] == "gallery" and seats["mouths"] == {"at": "back", "level": "Level"}
    lowest, floor = drawn["stand"]
    assert floor - 0.4 <= lowest < floor + 0.5, "its foundation is in the floor"


def test_what_was_on_a_level_that_is_deleted_is_not_on_it(drawn):
    assert drawn["after"]
