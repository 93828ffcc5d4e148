# SPDX-License-Identifier: Apache-2.0
"""Lifts between grounds of a terrain: beside a deck, and through one."""
import numpy
import pytest

from test_terrain_links import DECK, UNDER, Baked, Mesh, box, layout

AT, THROUGH = (-1.05, 3.0), (5.0, 2.0)  # before the deck's edge; within the deck


def lift(mesh, at, doors, **more):
    return {"id": "lift", "type": "lift", "levels": ["street", "deck"], "at": mesh.turned(*at), "size": [2, 2],
            "doors": doors + numpy.degrees(mesh.turn).item(), "door_width": 1.2, "capacity": 6, **more}


CASES = {"beside the deck": (AT, 180, {"opposite": ["deck"]}), "through the deck": (THROUGH, 180, {})}


@pytest.mark.parametrize("degrees", [0, 30])
@pytest.mark.parametrize("name", CASES)
def test_people_ride_between_the_street_and_a_deck(throng, tmp_path, name, degrees):
    """Sixteen up and eight down in a cabin of six; floors of the cabin are as high as the ground before its doors."""
    at, doors, more = CASES[name]
    mesh = Mesh(degrees, slope=0.02).parapets()
    flows = [{"id": "up", "from": "west", "to": "top", "count": 16, "end": 8, "people": {"radius": 0.24}},
             {"id": "down", "from": "top", "to": "west", "count": 8, "end": 8, "people": {"radius": 0.24}}, UNDER]
    given = layout(mesh, [lift(mesh, at, doors, **more)], flows)
    given["simulation"].update(duration=200, seed=2)
    baked = Baked(throng, tmp_path, mesh, given)
    assert (baked.figures["arrived"], baked.figures["wall_crossings"]) == (34, 0)
    # Two may wedge each other in the doors for a few frames.
    assert baked.figures["deepest_overlap_percent"] < 5 and baked.figures["overlapping_percent"] < 0.01
    low = 0.02 * (at[0] - 1)
    [made] = baked.manifest["lifts"]["list"]
    assert [stop["height"] for stop in made["stops"]] == pytest.approx([low, DECK], abs=0.01)
    x, y = baked.x - at[0], baked.y - at[1]
    inside = baked.there & (abs(x) < 0.95) & (abs(y) < 0.95) & (baked.places[..., 2] > low - 0.1)
    track = numpy.load(baked.folder / "lifts.npy")[:, 0]
    height, aboard = track[:, 0], track[:, 2]
    assert aboard.max() == 6 and height.min() == pytest.approx(low, abs=0.01)
    assert height.max() == pytest.approx(DECK, abs=0.01)
    frames, rows = numpy.nonzero(inside)
    assert abs(baked.places[frames, rows, 2] - height[frames]).max() < 0.06
    assert baked.fastest() < 0.15


def fenced(mesh, way, given):
    given["walls"] = [{"id": "fence", "level": "street", "points": [[-2.4, 1], [-2.4, 5]]}]


def walled(mesh, way, given):
    mesh.face((-2.2, 0, -1), (-2.2, 6, -1), (-2.2, 6, 5), (-2.2, 0, 5))


@pytest.mark.parametrize("change, message", [
    (lambda mesh, way, given: way.update(at=[-8, 3]),
     "the doors of lift `lift` open onto no ground of level `deck` at [-7.00, 3.00]"),
    (lambda mesh, way, given: way.pop("opposite"),
     "the doors of lift `lift` open onto no ground of level `deck` at [-2.05, 3.00]"),
    (fenced, "the doors of lift `lift` open into wall `fence` at level `street`"),
    (walled, "lift `lift` is in a wall of the terrain at [-2.20,"),
    (lambda mesh, way, given: way.update(size=[0.8, 2], door_width=0.6), "has room for 5 of"),
])
def test_mistakes_are_told(throng, tmp_path, change, message):
    mesh = Mesh().parapets()
    way = lift(mesh, AT, 180, opposite=["deck"])
    given = layout(mesh, [way], [{"id": "up", "from": "west", "to": "top", "count": 3, "end": 2}])
    change(mesh, way, given)
    path = mesh.write(tmp_path, given)
    told = throng("check", path, expect=3)
    errors = [line for line in told.stderr.splitlines() if ": error: " in line]
    assert message in errors[0] and errors[0].startswith(f"{path}:1:")


def test_stops_as_near_as_that_have_no_headroom(throng, tmp_path):
    mesh = Mesh()
    mesh.box(0, 8, 10, 14, 2.1, 2.3)
    way = lift(mesh, (-1.05, 11), 180, opposite=["low"], levels=["street", "low"])
    given = layout(mesh, [way], [{"id": "in", "from": "west", "to": "under", "count": 1, "end": 1}])
    given["levels"].append({"id": "low", "at": [5, 11, 2.3]})
    told = throng("check", mesh.write(tmp_path, given), expect=3)
    assert "2.30 m apart before the doors of lift `lift`: its stops are 2.45 m or more" in told.stderr
