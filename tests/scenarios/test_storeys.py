# SPDX-License-Identifier: Apache-2.0
"""Layouts with levels: charts side by side in the simulation's plane, and seams that nobody notices."""
import csv
import json

import numpy
import pytest


def box(x0, y0, x1, y1):
    return [[x0, y0], [x1, y0], [x1, y1], [x0, y1]]


# A square of 24 m cut at different lines, and uncut, with corners where the cuts end: railings then consist of the same
# pieces.
STRAIGHT = {"west": box(-12, -12, 1.3, 12), "east": box(1.3, -12, 12, 12)}
OBLIQUE = {"below": [[-12, -12], [12, -12], [12, 7.1], [-12, -5.3]], "above": [[12, 7.1], [12, 12], [-12, 12], [-12, -5.3]]}
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
        layout["walls"] += [{"id": f"{y} {a}", "level": level_at(floors, (0.5 * (a + b), y)), "points": [[a, y], [b, y]]}
                            for a, b in zip(ends, ends[1:])]
    layout["flows"] = layout["flows"][:2]
    return layout


# Where the cuts are, from a line's y to its x.
SEAMS = (lambda y: 1.3, lambda y: 0.6, lambda y: round(-12 + 24 * (y + 5.3) / 12.4, 6))


def at_random(floors, duration):
    """People all over the place, each to an area at one of the sides."""
    random = numpy.random.default_rng(4)
    points = [p for p in random.uniform(-9, 9, (400, 2)) if not within([[-4.5, 2.5], [-2.5, 2.5], [-2.5, 4.5], [-4.5, 4.5]], p)]
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
    """Everybody within a millimetre of where they are on uncut ground for 5 s; by the end, the same have arrived and
    nobody was in anybody or went through a wall at a seam."""
    uncut = {"whole": WHOLE[cut]}
    whole = once(f"uncut {scene} {cut}", lambda folder: bake(throng, folder, SCENES[scene](uncut, 60))) / "bake"
    parts = bake(throng, tmp_path, SCENES[scene](CUTS[cut], 60))
    until = 5 * 24 + 1
    there = stream(whole, "state")[:until, :, 0] > 0
    assert (there == (stream(parts, "state")[:until, :, 0] > 0)).all()
    apart = numpy.linalg.norm(stream(whole, "pos")[:until, :, :2] - stream(parts, "pos")[:until, :, :2], axis=2)
    assert apart[there].max() < 1e-3
    assert there.sum() > 1000
    before, after = measured(throng, whole), measured(throng, parts)
    assert after["arrived"] == before["arrived"] == after["agents"]
    assert after["wall_crossings"] == 0
    assert after["deepest_overlap_percent"] <= max(2.0, 1.5 * before["deepest_overlap_percent"])
