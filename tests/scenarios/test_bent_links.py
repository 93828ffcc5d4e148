# SPDX-License-Identifier: Apache-2.0
"""Stairs, ramps and escalators with corners: flights with landings between them, on which people turn."""
import json
import math

import numpy
import pytest

HALF, QUARTER, ALONG = ([[0, 0], [4, 0], [4, 1.5], [0, 1.5]], [[0, 0], [3.4, 0], [3.4, 3.4]],
                        [[0, 0], [3, 0], [6.4, 0]])


def turned(points, degrees, at=(0.0, 0.0)):
    cosine, sine = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return [[at[0] + cosine * x - sine * y, at[1] + sine * x + cosine * y] for x, y in points]


def house(path, upper, degrees=0.0, at=(0.0, 0.0), height=3.4, duration=75, **link):
    """A hall below, a gallery above where the link ends, and people who go up and down."""
    below = turned([[-9, -6], [8, -6], [8, 9], [-9, 9]], degrees, at)
    x0, y0, x1, y1 = upper
    corners = [[x0, y0], [x1, y0], [x1, y1], [x0, y1]]
    middle = [0.5 * (x0 + x1), 0.5 * (y0 + y1)]
    goal = [[middle[0] - 1.5, middle[1] - 1.2], [middle[0] + 1.5, middle[1] - 1.2],
            [middle[0] + 1.5, middle[1] + 1.2], [middle[0] - 1.5, middle[1] + 1.2]]
    start = turned([[-7, -4]], degrees, at)[0]
    return {"throng": 1, "simulation": {"duration": duration, "smoothing": 0},
            "levels": [{"id": "hall", "floor": below}, {"id": "gallery", "height": height,
                                                        "floor": turned(corners, degrees, at)}],
            "links": [{"id": "stairs", "from": "hall", "to": "gallery", "path": turned(path, degrees, at), "width": 1.2,
                       **link}],
            "areas": [{"id": "up there", "level": "gallery", "polygon": turned(goal, degrees, at)},
                      {"id": "down here", "polygon": turned([[-8, -5], [-3, -5], [-3, -2], [-8, -2]], degrees, at)}],
            "formations": [
                {"id": "up", "type": "grid", "origin": start, "rotation": degrees, "rows": 3, "columns": 4,
                 "spacing": 1.0, "goal": "up there", "arrival": "leave"},
                {"id": "down", "type": "grid", "level": "gallery", "rotation": degrees, "rows": 2, "columns": 2,
                 "origin": turned([[middle[0] - 0.5, middle[1] - 0.5]], degrees, at)[0], "spacing": 1.0,
                 "goal": "down here", "start": 25}]}


GALLERY = {"half": (HALF, (-8, 0.8, 0, 8.5)), "quarter": (QUARTER, (-4, 3.4, 7, 8.5)),
           "along": (ALONG, (6.4, -5, 14, 5))}


def checked(throng, tmp_path, layout, expect=3):
    path = tmp_path / "layout.json"
    path.write_text(json.dumps(layout))
    return throng("check", path, expect=expect)


def baked(throng, tmp_path, layout, *options):
    path = tmp_path / "layout.json"
    path.write_text(json.dumps(layout))
    throng("bake", path, "-o", tmp_path / "bake", "-q", *options)
    bake = tmp_path / "bake"
    streams = {name: numpy.load(bake / "streams" / f"{name}.npy") for name in ("pos", "state")}
    return json.loads((bake / "bake.json").read_text()), streams["pos"], streams["state"][..., 0] > 0.5


@pytest.mark.parametrize("degrees, at", [(0.0, (0.0, 0.0)), (33.0, (0.0, 0.0)), (-118.0, (500_000.0, 4_000_000.0))])
@pytest.mark.parametrize("name", GALLERY)
def test_everybody_gets_up_and_down(throng, tmp_path, name, degrees, at):
    path, upper = GALLERY[name]
    manifest, pos, there = baked(throng, tmp_path, house(path, upper, degrees, at), "--no-gltf")
    landing = next(level for level in manifest["levels"] if level.get("landing"))
    assert [level["id"] for level in manifest["levels"]][:2] == ["hall", "gallery"]
    assert len(manifest["links"]) == 2 and landing["id"] == "stairs, landing 1"
    # 20 risers of 0.17 m: a landing is level with one of them.
    assert landing["height"] / 0.17 == pytest.approx(round(landing["height"] / 0.17), abs=1e-9)
    last = pos[-1]
    assert (numpy.abs(last[:12, 2] - 3.4) < 0.03).sum() == 12, last[:12, 2]
    assert (numpy.abs(last[12:, 2]) < 0.03).sum() == 4, last[12:, 2]
    figures = json.loads(throng("measure", tmp_path / "bake", "--json").stdout)
    assert figures["wall_crossings"] == 0 and figures["deepest_overlap_percent"] < 3.0
    # Whoever is pushed back over the line is counted there and back.
    assert [link["forward"] - link["back"] for link in figures["links"]] == [12 - 4] * 2
    # Nobody jumps, and everybody comes over the landing.
    step = numpy.linalg.norm(numpy.diff(pos, axis=0), axis=2)[there[1:] & there[:-1]]
    assert step.max() < 0.25
    assert ((numpy.abs(pos[..., 2] - landing["height"]) < 0.05) & there).any(axis=0).all()


def test_a_half_turn_has_the_landing_that_stairwells_have(throng, tmp_path):
    """Known: flights of 3.4 m, railings of 0.1 m, a landing 1.25 m deep over both flights."""
    manifest, _, _ = baked(throng, tmp_path, house(HALF, GALLERY["half"][1], duration=1), "--no-gltf")
    landing = manifest["levels"][2]
    low, high = (numpy.array(landing["floor"]) + manifest["origin"][:2]).min(axis=0), (
        numpy.array(landing["floor"]) + manifest["origin"][:2]).max(axis=0)
    assert len(landing["floor"]) == 4
    assert low == pytest.approx([3.35, -0.65], abs=1e-9) and high == pytest.approx([4.65, 2.15], abs=1e-9)
    assert landing["height"] == pytest.approx(1.7)
    paths = [numpy.array(link["path"]) + manifest["origin"][:2] for link in manifest["links"]]
    assert paths[0] == pytest.approx(numpy.array([[0, 0], [3.35, 0]])) and paths[1] == pytest.approx(
        numpy.array([[3.35, 1.5], [0, 1.5]]))


def test_feet_stand_on_treads(throng, tmp_path):
    """Each planted foot is as high as a tread, the landing or a floor."""
    layout = house(HALF, GALLERY["half"][1], duration=30)
    manifest, pos, there = baked(throng, tmp_path, layout, "--no-gltf", "--feet")
    ground = numpy.load(tmp_path / "bake" / "streams" / "ground.npy")
    on_flight = there & (pos[..., 2] > 0.2) & (pos[..., 2] < 3.2) & (numpy.abs(pos[..., 2] - 1.7) > 0.2)
    assert on_flight.sum() > 500 and numpy.abs(ground[on_flight][:, :2]).max() > 0.3


def test_a_ramp_and_an_escalator_turn_too(throng, tmp_path):
    ramp = house([[0, 0], [8, 0], [8, 4], [2, 4]], (-6, 2, 2, 9), height=2.4, type="ramp", duration=1)
    manifest, _, _ = baked(throng, tmp_path, ramp, "--no-gltf")
    assert len(manifest["links"]) == 3 and {link["type"] for link in manifest["links"]} == {"ramp"}
    lengths = [numpy.linalg.norm(numpy.diff(link["path"], axis=0)) for link in manifest["links"]]
    heights = [0.0, *(level["height"] for level in manifest["levels"][2:]), 2.4]
    assert numpy.diff(heights) / lengths == pytest.approx([2.4 / sum(lengths)] * 3)
    moving = house(HALF, GALLERY["half"][1], height=2.4, type="escalator", width=1.0)
    moving["formations"].pop()
    manifest, pos, _ = baked(throng, tmp_path, moving, "--no-gltf", "--force")
    assert (numpy.abs(pos[-1][:, 2] - 2.4) < 1e-3).all()


@pytest.mark.parametrize("path, said", [
    ([[0, 0], [4, 0], [0, 0.5]], "turns by 173 degrees at [4.00, 0.00], 130 at most"),
    ([[0, 0], [4, 0], [4, 1.0], [0, 1.0]], "lie in one place"),
    ([[0, 0], [1.0, 0], [1.0, 5]], "0.35 m left for the flight"),
    ([[0, 0], [2, 0], [2.02, 0], [4, 0]], "two points of its path are in one place, at [2.00, 0.00]"),
    ([[0, 0], [1.8, 0], [1.8, 1.5], [0.4, 1.5]], "climb at most 120 %"),
])
def test_what_cannot_be_built_is_told_in_one_sentence(throng, tmp_path, path, said):
    error = checked(throng, tmp_path, house(path, GALLERY["half"][1])).stderr
    assert said in error and "layout.json:1:" in error and "hint: " in error, error
    assert error.count(": error: ") == 1, error


def test_links_with_corners_belong_to_floors_only_where_they_end(throng, tmp_path):
    layout = house(HALF, (-8, 2.6, 0, 8.5))
    error = checked(throng, tmp_path, layout).stderr
    assert "does not reach the floor of level `gallery` at [0.00, 1.50]" in error
    layout = house(HALF, GALLERY["half"][1])
    layout["levels"].append({"id": "stairs, landing 1", "height": 9, "floor": [[20, 20], [22, 20], [22, 22]]})
    assert "stairs, landing 1" in checked(throng, tmp_path, layout).stderr


def test_sheets_of_levels_show_who_is_on_a_landing(throng, tmp_path):
    baked(throng, tmp_path, house(HALF, GALLERY["half"][1], duration=20), "--no-gltf")
    for level in ("hall", "gallery"):
        throng("preview", tmp_path / "bake", "-o", tmp_path / f"{level}.png", "--level", level, "--frame", "300")
    error = throng("preview", tmp_path / "bake", "-o", tmp_path / "no.png", "--level", "stairs, landing 1", expect=3)
    assert "there are `hall`, `gallery`" in error.stderr
