# SPDX-License-Identifier: Apache-2.0
"""Layouts with levels: charts side by side in the simulation's plane, and seams that nobody notices."""
import csv
import json
import signal
import subprocess
import time

import numpy
import pytest


def box(x0, y0, x1, y1):
    return [[x0, y0], [x1, y0], [x1, y1], [x0, y1]]


# A square of 24 m cut at different lines, and uncut, with corners where the cuts end: railings then consist of the same
# pieces.
STRAIGHT = {"west": box(-12, -12, 1.3, 12), "east": box(1.3, -12, 12, 12)}
OBLIQUE = {"below": [[-12, -12], [12, -12], [12, 7.1], [-12, -5.3]],
           "above": [[12, 7.1], [12, 12], [-12, 12], [-12, -5.3]]}
MEETING = {"west": box(-12, -12, 0.6, 12), "south": box(0.6, -12, 12, 1.7), "north": box(0.6, 1.7, 12, 12)}
CUTS = {"straight": STRAIGHT, "oblique": OBLIQUE, "three meet": MEETING}
WHOLE = {"straight": [[-12, -12], [1.3, -12], [12, -12], [12, 12], [1.3, 12], [-12, 12]],
         "oblique": [[-12, -12], [12, -12], [12, 7.1], [12, 12], [-12, 12], [-12, -5.3]],
         "three meet": [[-12, -12], [0.6, -12], [12, -12], [12, 1.7], [12, 12], [0.6, 12], [-12, 12]]}


def within(polygon, point):
    inside = False
    for (ax, ay), (bx, by) in zip(polygon, polygon[1:] + polygon[:1]):
        if (ay > point[1]) != (by > point[1]) and point[0] < ax + (bx - ax) * (point[1] - ay) / (by - ay):
            inside = not inside
    return inside


def level_at(floors, point):
    return next(name for name, polygon in floors.items() if within(polygon, point))


def crossing(floors, duration):
    """Four streams that meet in the middle, and a pillar beside the seams."""
    gates = {"w": box(-11.5, -2, -10.5, 2), "e": box(10.5, -2, 11.5, 2), "s": box(-2, -11.5, 0.3, -10.5),
             "n": box(-2, 10.5, 0.3, 11.5)}
    areas = [{"id": name, "polygon": polygon, "level": level_at(floors, polygon[0])} for name, polygon in gates.items()]
    flows = [{"id": f"{a}{b}", "from": a, "to": b, "count": 40, "end": 12, "people": {"radius": 0.22}}
             for a, b in ("we", "ew", "sn", "ns")]
    pillar = [[-4, 3], [-3, 3], [-3, 4], [-4, 4]]
    return {"throng": 1, "simulation": {"duration": duration, "smoothing": 0, "avoid_congestion": False},
            "levels": [{"id": name, "floor": polygon} for name, polygon in floors.items()],
            "walls": [{"id": "pillar", "closed": True, "points": pillar, "level": level_at(floors, pillar[0])}],
            "areas": areas, "flows": flows}


def corridor(floors, duration):
    """Two streams between walls that end, cut or not, where seams may be."""
    layout = crossing(floors, duration)
    for y in (-2.5, 2.5):
        ends = [-9, *sorted({seam(y) for seam in SEAMS}), 9]
        layout["walls"] += [{"id": f"{y} {a}", "points": [[a, y], [b, y]],
                             "level": level_at(floors, (0.5 * (a + b), y))} for a, b in zip(ends, ends[1:])]
    layout["flows"] = layout["flows"][:2]
    return layout


# Where the cuts are, from a line's y to its x.
SEAMS = (lambda y: 1.3, lambda y: 0.6, lambda y: round(-12 + 24 * (y + 5.3) / 12.4, 6))


def at_random(floors, duration):
    """People all over the place, each to an area at one of the sides."""
    random = numpy.random.default_rng(4)
    points = [point for point in random.uniform(-9, 9, (400, 2)) if not within(box(-4.5, 2.5, -2.5, 4.5), point)]
    kept = []
    for point in points:
        if all(numpy.hypot(*(point - other)) > 0.6 for other in kept):
            kept.append(point)
    layout = crossing(floors, duration)
    layout["flows"] = []
    # Who is drawn follows from the group: the same groups in all of them, one a quarter of a metre wide.
    layout["formations"] = [
        {"id": f"p{i}", "type": "grid", "origin": [round(float(x), 3), round(float(y), 3)], "rows": 1, "columns": 1,
         "goal": "wesn"[i % 4], "arrival": "leave", "level": level_at(floors, (x, y))} for i, (x, y) in enumerate(kept)]
    return layout


SCENES = {"crossing": crossing, "corridor": corridor, "random": at_random}


def bake(throng, folder, layout, *options):
    (folder / "layout.json").write_text(json.dumps(layout))
    throng("bake", folder / "layout.json", "-o", folder / "bake", "-q", "--no-gltf", *options)
    return folder / "bake"


def stream(folder, name):
    return numpy.load(folder / "streams" / f"{name}.npy")


def measured(throng, folder):
    return json.loads(throng("measure", folder, "--json").stdout)


@pytest.mark.parametrize("scene", SCENES)
@pytest.mark.parametrize("cut", CUTS)
def test_nobody_notices_a_seam(throng, once, tmp_path, scene, cut):
    """Everybody within a millimetre of where they are on uncut ground for 4.5 s; by the end, the same have arrived and
    nobody was in anybody or went through a wall at a seam."""
    uncut = {"whole": WHOLE[cut]}
    whole = once(f"uncut {scene} {cut}", lambda folder: bake(throng, folder, SCENES[scene](uncut, 60))) / "bake"
    parts = bake(throng, tmp_path, SCENES[scene](CUTS[cut], 60))
    until = 108 + 1
    there = stream(whole, "state")[:until, :, 0] > 0
    assert (there == (stream(parts, "state")[:until, :, 0] > 0)).all()
    apart = numpy.linalg.norm(stream(whole, "pos")[:until, :, :2] - stream(parts, "pos")[:until, :, :2], axis=2)
    assert apart[there].max() < 1e-3
    assert there.sum() > 1000
    before, after = measured(throng, whole), measured(throng, parts)
    assert after["arrived"] == before["arrived"] == after["agents"]
    assert after["wall_crossings"] == 0
    assert after["deepest_overlap_percent"] <= max(2.0, 1.5 * before["deepest_overlap_percent"])


def test_wishes_are_everybodys_own_beside_seams(throng, tmp_path):
    """People beside seams have images, more of them than there are people: wishes are those of people."""
    wishes = []
    for name, floors in (("whole", {"whole": WHOLE["three meet"]}), ("parts", MEETING)):
        (tmp_path / name).mkdir()
        folder = bake(throng, tmp_path / name, at_random(floors, 3), "--wish")
        wishes.append(stream(folder, "wish")[:72])
    assert abs(wishes[0] - wishes[1]).max() < 1e-3
    assert numpy.linalg.norm(wishes[0][..., :2], axis=2).max() > 1


STAIRS = {
    "throng": 1, "simulation": {"duration": 30},
    "levels": [{"id": "ground", "floor": box(-14, -5, 14, 5)},
               {"id": "upper", "height": 3.4, "floor": box(-3, -5, 14, 5)}],
    "links": [{"id": "stairs", "from": "ground", "to": "upper", "path": [[-9, 2], [-3, 2]], "width": 2.4}],
    "areas": [{"id": "door", "polygon": box(-13, -4, -12, 4)}, {"id": "below", "polygon": box(12, -4, 13, 4)},
              {"id": "above", "level": "upper", "polygon": box(12, -4, 13, 4)},
              {"id": "under the stairs", "polygon": box(-4.6, 1.2, -3.4, 2.8)}],
}


def test_people_walk_above_each_other(throng, tmp_path):
    """On the gallery and under it at once: in the same places of the plan, in nobody's way, and nobody in between."""
    flows = [{"id": a + b, "from": a, "to": b, "count": 25, "end": 12}
             for a, b in (("door", "above"), ("above", "door"), ("door", "below"), ("below", "door"))]
    flows.append({"id": "hidden", "from": "below", "to": "under the stairs", "count": 2, "end": 1, "arrival": "stay"})
    folder = bake(throng, tmp_path, {**STAIRS, "flows": flows, "simulation": {"duration": 90}})
    figures = measured(throng, folder)
    assert figures["arrived"] == 102 and figures["wall_crossings"] == 0
    assert figures["deepest_overlap_percent"] < 2
    places, there = stream(folder, "pos"), stream(folder, "state")[..., 0] > 0
    heights = places[..., 2]
    off_floors = numpy.minimum(abs(heights), abs(heights - 3.4))
    beside = there & (abs(places[..., 1] - 2) > 1.4)
    # Whoever turns round the foot of the stairs takes half a riser along for half a step: up to 0.095 m (seeds 1 to 4).
    at_foot = (places[..., 0] > -9.6) & (places[..., 0] < -7.6)
    assert off_floors[beside & ~at_foot].max() < 0.05 and off_floors[beside].max() < 0.1
    under_stairs = there & (places[..., 0] > -4.9) & (places[..., 0] < -3.2) & (abs(places[..., 1] - 2) < 1.2)
    between = (heights > 0.05) & (heights < 1.5)
    assert (under_stairs & (heights < 0.05)).sum() > 20 and not (under_stairs & between).any()
    above = sum(
        (numpy.linalg.norm(up[:, None, :2] - down[None, :, :2], axis=2) < 0.4).any()
        for up, down in ((frame[alive & (frame[:, 2] > 3.3)], frame[alive & (frame[:, 2] < 0.1)])
                         for frame, alive in zip(places, there)) if len(up) and len(down))
    assert above > 50  # frames in which somebody is right above somebody else
    steps = numpy.linalg.norm(numpy.diff(places, axis=0), axis=2)[there[1:] & there[:-1]]
    assert steps.max() < 0.2  # m a frame: nobody jumps


@pytest.mark.parametrize("start, to, pace", [("door", "above", 0.61), ("above", "door", 0.694)])
def test_stairs_are_climbed_as_weidmann_measured(throng, tmp_path, start, to, pace):
    """Weidmann (1993): 0.610 m/s up and 0.694 m/s down, in plan, of people who walk at 1.34 m/s on the flat."""
    flow = {"id": "one", "from": start, "to": to, "count": 1, "end": 1,
            "people": {"speed": 1.34, "radius": 0.25}}
    folder = bake(throng, tmp_path, {**STAIRS, "flows": [flow]})
    x = stream(folder, "pos")[:, 0, 0][stream(folder, "state")[:, 0, 0] > 0]
    on_stairs = (x > -8) & (x < -4)
    assert abs(numpy.diff(x)[on_stairs[1:]]).mean() * 24 == pytest.approx(pace, rel=0.05)


@pytest.mark.slow
@pytest.mark.parametrize("start, to, most", [("hall", "gallery", 0.88), ("gallery", "hall", 1.1)])
def test_stairs_that_are_pressed_upon_take_no_more_than_imo_allows(throng, tmp_path, start, to, most):
    """IMO MSC.1/Circ.1533: specific flows of 0.88 persons/(s m) up and 1.1 down at most, as the mean of three crowds, of
    which single ones differ; without the rule of climbing 1.6. Three in five of that many come through, or stairs would
    jam."""
    flows = [specific_flow(throng, tmp_path, start, to, seed) for seed in (1, 2, 3)]
    assert 0.6 * most < min(flows) and numpy.mean(flows) < 1.05 * most and max(flows) < 1.2 * most, flows


def specific_flow(throng, tmp_path, start, to, seed):
    layout = {
        "throng": 1, "simulation": {"duration": 75, "seed": seed},
        "levels": [{"id": "below", "floor": box(-22, -6, 0, 6)},
                   {"id": "upper", "height": 4, "floor": box(0, -6, 14, 6)}],
        "links": [{"id": "link", "type": "stairs", "from": "below", "to": "upper", "path": [[-8, 0], [0, 0]],
                   "width": 2}],
        "areas": [{"id": "hall", "polygon": box(-21, -5, -13, 5)},
                  {"id": "gallery", "level": "upper", "polygon": box(6, -5, 13, 5)}],
        "flows": [{"id": "all", "from": start, "to": to, "count": 160, "end": 32}]}
    folder = tmp_path / f"{start}-{seed}"
    folder.mkdir()
    figures = measured(throng, bake(throng, folder, layout))
    assert figures["deepest_overlap_percent"] < 2 and figures["wall_crossings"] == 0
    return figures["links"][0]["specific_flow"]


@pytest.mark.parametrize("cut", [False, True])
def test_a_jam_beyond_a_seam_is_avoided(throng, tmp_path, cut):
    """A hall with two doors in its middle wall, the nearer one full of people who stand, beside a seam or not."""
    floors = {"west": box(-12, -12, -1, 12), "east": box(-1, -12, 12, 12)} if cut else {"all": box(-12, -12, 12, 12)}
    walls = [[[0, -12], [0, -1]], [[0, 1], [0, 4]], [[0, 6], [0, 12]]]
    layout = {
        "throng": 1, "simulation": {"duration": 25},
        "levels": [{"id": name, "floor": floor} for name, floor in floors.items()],
        "walls": [{"points": points, "level": level_at(floors, points[0])} for points in walls],
        "areas": [{"id": "beyond", "polygon": box(9, -2, 11, 2), "level": level_at(floors, (10, 0))}],
        "formations": [
            {"id": "walker", "type": "grid", "origin": [-10, 0], "rows": 1, "columns": 1, "goal": "beyond",
             "level": level_at(floors, (-10, 0)), "people": {"speed": 1.3, "radius": 0.25}},
            {"id": "waiting", "type": "grid", "origin": [-0.9, -0.65], "rows": 3, "columns": 6, "spacing": 0.6,
             "level": level_at(floors, (-0.9, 0)), "goal": {"offset": [0, 0]}, "people": {"radius": 0.25}}]}
    way = stream(bake(throng, tmp_path, layout), "pos")[:, 0, :2]
    assert way[numpy.argmin(abs(way[:, 0]))][1] == pytest.approx(5.0, abs=1.1)


def test_a_bake_on_levels_that_was_stopped_goes_on_to_the_same_bytes(throng, tmp_path):
    flows = [{"id": "up", "from": "door", "to": "above", "count": 30, "end": 10},
             {"id": "down", "from": "above", "to": "door", "count": 30, "end": 10}]
    (tmp_path / "layout.json").write_text(json.dumps({**STAIRS, "flows": flows}))
    throng("bake", tmp_path / "layout.json", "-o", tmp_path / "whole", "-q", "--no-gltf")
    stopped = subprocess.Popen([throng.binary, "bake", str(tmp_path / "layout.json"), "-o", str(tmp_path / "parts"),
                                "-q", "--no-gltf", "--checkpoint", "0.0001"])
    unfinished = tmp_path / "parts.unfinished"
    while stopped.poll() is None and len(list(unfinished.glob("checkpoint.[ab]"))) < 2:
        time.sleep(0.005)
    stopped.send_signal(signal.SIGTERM)
    stopped.communicate()
    throng("bake", tmp_path / "layout.json", "-o", tmp_path / "parts", "-q", "--no-gltf", "--resume")
    assert (stream(tmp_path / "whole", "pos") == stream(tmp_path / "parts", "pos")).all()


def test_who_has_waited_on_a_level_goes_on(throng, tmp_path):
    stop = {"at": "above", "wait": 3}
    flows = [{"id": "and back", "from": "door", "to": "below", "via": [stop], "count": 8, "end": 4}]
    figures = measured(throng, bake(throng, tmp_path, {**STAIRS, "flows": flows, "simulation": {"duration": 150}}))
    assert (figures["arrived"], figures["stuck"]) == (8, 0)


def test_previews_show_one_level_or_all(throng, tmp_path):
    flows = [{"id": "up", "from": "door", "to": "above", "count": 3, "end": 1}]
    folder = bake(throng, tmp_path, {**STAIRS, "flows": flows, "simulation": {"duration": 2}})
    pictures = {}
    for name, *options in (("ground", "--level", "ground"), ("upper", "--level", "upper"), ("all",)):
        throng("preview", folder, "-o", tmp_path / f"{name}.png", *options)
        pictures[name] = (tmp_path / f"{name}.png").read_bytes()
    assert len(set(pictures.values())) == 3
    failed = throng("preview", folder, "-o", tmp_path / "x.png", "--level", "cellar", expect=None)
    assert failed.returncode != 0 and "has no level `cellar`: there are `ground`, `upper`" in failed.stderr
    assert not (tmp_path / "x.png").exists()


def test_the_table_of_people_and_the_manifest_are_in_home_coordinates(throng, tmp_path):
    flows = [{"id": "up", "from": "door", "to": "above", "count": 3, "end": 1}]
    folder = bake(throng, tmp_path, {**STAIRS, "flows": flows})
    manifest = json.loads((folder / "bake.json").read_text())
    assert manifest["bounds"] == {"min": [-17, -8], "max": [17, 8]}
    assert manifest["levels"] == [{"id": level["id"], "height": level.get("height", 0), "floor": level["floor"]}
                                  for level in STAIRS["levels"]]
    assert [area["level"] for area in manifest["geometry"]["areas"]] == ["ground", "ground", "upper", "ground"]
    assert {wall["id"].rpartition(":")[0] for wall in manifest["geometry"]["walls"]} == {
        "railing:ground", "railing:upper", "railing:stairs"}
    with open(folder / "agents.csv", newline="") as file:
        for row in csv.DictReader(file):
            assert 12 <= float(row["goal_x"]) <= 13


def test_nobody_climbs_out_of_the_opening_over_a_flight_of_stairs(throng, tmp_path):
    """A landing over the ground, 0.4 m higher than people need: the ground goes on below the end of the first flight,
    less than a cell of the fields behind the railing."""
    layout = {"throng": 1, "simulation": {"duration": 30},
              "levels": [{"id": "ground", "floor": box(-32, -22, 40, 22)},
                         {"id": "landing", "height": 2.6, "floor": box(-20, -2, -17, 2)},
                         {"id": "deck", "height": 5.2, "floor": box(-13, -2, -6, 2)}],
              "links": [{"id": "low", "from": "ground", "to": "landing", "path": [[-24, 0], [-20, 0]], "width": 3},
                        {"id": "high", "from": "landing", "to": "deck", "path": [[-17, 0], [-13, 0]], "width": 3}],
              "areas": [{"id": "west", "polygon": box(-29, -3, -27, 3)},
                        {"id": "end", "level": "deck", "polygon": box(-8, -1.5, -6.5, 1.5)}],
              "flows": [{"id": "up", "from": "west", "to": "end", "count": 3, "end": 1}]}
    figures = measured(throng, bake(throng, tmp_path, layout))
    assert (figures["arrived"], figures["stuck"]) == (3, 0)


def test_people_go_over_and_under_a_bridge(throng, bakes):
    """All of examples/bridge.json arrive; at one moment people are above others on stairs, a ramp, a deck and a lift."""
    folder = bakes("bridge")
    figures = measured(throng, folder)
    assert (figures["arrived"], figures["stuck"], figures["wall_crossings"]) == (figures["agents"], 0, 0)
    there = stream(folder, "state")[..., 0] > 0
    places = stream(folder, "pos")
    under = there & (places[..., 2] < 0.1) & (numpy.abs(places[..., 1]) < 2) & (numpy.abs(places[..., 0]) < 8)
    over = there & (places[..., 2] > 5.1) & (numpy.abs(places[..., 0]) < 8)
    assert (under.sum(axis=1) * (over.sum(axis=1) > 4)).max() > 4
    assert numpy.load(folder / "lifts.npy")[:, 0, 2].max() >= 2
    assert {link["id"] for link in figures["links"] if link["forward"] + link["back"] > 0} == {
        link["id"] for link in json.loads((folder / "bake.json").read_text())["links"]}
