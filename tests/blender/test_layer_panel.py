# SPDX-License-Identifier: Apache-2.0
"""Layers in a real Blender: added from the scene, written, applied by `throng apply`, compared, and applied again."""
import json

import numpy
import pytest

from results import ADDON, HERE, result_of

STREET = {"throng": 1, "name": "street", "simulation": {"duration": 4, "seed": 7},
          "roads": [{"id": "road", "centreline": [[0, 0], [24, 0]], "width": 6}],
          "flows": [{"id": "f", "from": "road:start", "to": "road:end", "count": 12, "end": 2}],
          "formations": [{"id": "ring", "type": "circle", "centre": [10, 12], "radius": 4, "count": 5}]}


@pytest.fixture(scope="module")
def found(blender, throng, tmp_path_factory):
    """What check_layers.py has seen, and the folder that it worked in."""
    folder = tmp_path_factory.mktemp("layers")
    (folder / "street.json").write_text(json.dumps(STREET))
    throng("bake", folder / "street.json", "-o", folder / "street", "-q", "--no-gltf", "--gaze")
    return result_of(blender(HERE / "check_layers.py", ADDON, folder,
                             environment={"THRONG_BINARY": throng.binary})), folder


def test_mistakes_are_told_and_add_nothing(found):
    found = found[0]
    assert "Nobody is picked" in found["nobody"] and "select the mesh or the curve" in found["no_region"]
    assert "has no camera" in found["no_camera"] and "Names is empty" in found["no_name"]
    assert "Apply Layers first" in found["nothing"]


def test_selectors_come_from_the_scene_in_the_world_of_the_bake(found):
    selectors = found[0]["selectors"]
    assert selectors["near"] == {"near": {"point": [5.0, 1.0], "within": 2.0, "frames": [40, 40]}}
    corners = selectors["region"]["region"]["polygon"]
    assert sorted(corners) == [[2.0, -1.0], [2.0, 2.0], [6.0, -1.0], [6.0, 2.0]] and len(corners) == 4
    steps = numpy.abs(numpy.diff(corners + corners[:1], axis=0)).sum(axis=1)
    assert sorted(steps) == [3, 3, 4, 4], "round the region, not across"
    view = selectors["seen"]["seen"]["views"][0]
    assert view["matrix"] == [1, 0, 0, 10, 0, 1, 0, 0, 0, 0, 1, 10, 0, 0, 0, 1]
    assert view["size"] == pytest.approx([36 / 50, 18 / 50], abs=1e-5) and view["frame"] == 40
    views = selectors["moving"]["seen"]["views"]
    assert [view["frame"] for view in views] == [0, 24, 48] and views[2]["matrix"][3] == pytest.approx(15.0)
    assert views[1]["matrix"][3] == pytest.approx(12.5, abs=0.3) and found[0]["frame"] == 41
    people = selectors["picked"]["not"]["people"]
    assert [person["id"] for person in people] == [3, 16] and set(people[0]) == {"id", "group", "spawn"} \
        and selectors["picked"]["share"] == {"of": 0.5, "seed": 4}


def test_what_is_done_is_written_and_applied(found):
    found, folder = found
    assert found["done"] == [
        ["more", {"duplicate": {"copies": 2, "by": [20, 0, 0]}}], ["hide rows [0, 2]", {"hide": True}],
        ["move copies more", {"move": {"by": [0, 5, 0], "turn": 90}}],
        ["bend", {"bend": {"points": [{"frame": 60, "by": [0, 0.5]}]}}], ["off", {"hide": True}]]
    document = found["file"]
    assert [each["name"] for each in document["layers"]] == [name for name, _ in found["done"]]
    assert document["layers"][-1]["enabled"] is False and [each["id"] for each in document["overrides"]] == [6]
    lines, remarks = found["reports"]
    assert any("layer `more`: 5 people: duplicate (10 copies)" in line for line in lines) and not remarks
    hidden, shown, bake, vertices, same_cast, is_source, problems = found["crowds"]
    assert (hidden, shown, bake, vertices) == (True, False, "street.layered", 27) and same_cast and is_source
    assert problems == [] and found["hidden"] == 0
    places = {int(row): place for row, place in found["shown"].items()}
    assert not {0, 1, 2, 6} & set(places) and {5, 12, 17, 22} <= set(places)
    before = numpy.load(folder / "street" / "streams" / "pos.npy")[..., :2].astype(float)
    entry, (dx, dy) = before[0, 12], before[60, 12] - before[0, 12]
    for copy, away in ((17, 20), (22, 40)):  # each is turned about where it enters
        assert places[copy] == pytest.approx([entry[0] + away - dy, entry[1] + 5 + dx], abs=2e-3)
    before = before[60]
    assert places[5] == pytest.approx([before[5, 0], before[5, 1] + 0.5], abs=2e-3)
    without = found["compared"]
    assert without[:2] == [False, True] and {0, 1, 2} <= set(without[2])
    assert 6 not in without[2] and max(without[2]) < 17


def test_layers_are_changed_and_applied_again_in_the_same_crowd(found):
    found = found[0]
    assert found["order"][:2] == ["hide rows [0, 2]", "more"]
    same, crowds, rows = found["again"]
    assert same and crowds == 2 and not {0, 1, 2, 3, 6} & set(rows) and 26 in rows


def test_mistakes_in_layers_are_told_at_their_layer(found):
    message, index = found[0]["wrong_key"]
    assert "no key `mvoe`" in message and "did you mean `move`?" in message and index == 2
    assert "is not JSON" in found[0]["no_json"]


def test_what_others_have_written_is_kept(found):
    found = found[0]
    assert found["reloaded"] == found["order"] and "somebody else has changed the layers" in found["others"]
    assert found["theirs"] == found["order"][:1] and found["kept"] == [[6, 8], 1]


def test_layers_go_along_to_another_bake(found):
    found = found[0]
    assert found["retake"] == ["retake.overrides.json", found["theirs"]]
    assert "Apply Layers first" in found["gone"][0] and found["gone"][1] is False, "the crowd itself is to be seen"
