# SPDX-License-Identifier: Apache-2.0
"""What of authoring needs no Blender: the table of settings, numbers and their digits, curves, footprints."""
import json

from conftest import ROOT
import results  # noqa: F401  it puts the add-on on the path
from throng.authoring import curves, fields
from throng.authoring.codecs import Choice, Flag, Whole
from throng.authoring.values import keep_points, short, single


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
            assert least == entry.get("minimum", entry.get("exclusiveMinimum")), key
            assert most == min(entry["maximum"], 2**31 - 1), key
    assert set(fields.BARS) == set(schema["definitions"]["expect"]["properties"]) - {"line"}


def test_every_number_of_every_rule_of_motion_has_a_property():
    schema = json.loads((ROOT / "authoring" / "layout" / "throng-layout.schema.json").read_text())
    rules = schema["properties"]["motion"]["properties"]
    assert {name: [row[0].key for row in rows] for name, _, _, rows in fields.MOTION} == \
        {name: list(rule["properties"]) for name, rule in rules.items()}
    about = {row[0].key: row[4] for name, _, _, rows in fields.MOTION if name == "drive" for row in rows}
    assert about["relaxation"] == "Time constant, s"


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
    more = shown[:1] + [(0.0, 5.0), (1.0, 5.0)] + shown[2:]
    assert keep_points(more, raw, origin) == [raw[0], [448272, 5411938], [448273, 5411938], raw[2]]


def test_bezier_curves_keep_to_their_tolerance():
    a, b, c, d = (0.0, 0.0), (0.0, 10.0), (10.0, 10.0), (10.0, 0.0)
    point = lambda t: tuple((1 - t) ** 3 * a[i] + 3 * (1 - t) ** 2 * t * b[i] + 3 * (1 - t) * t * t * c[i] + t**3 * d[i]
                            for i in (0, 1))
    sizes = []
    for tolerance in (0.5, 0.02, 0.001):
        line = [a] + curves.flatten(a, b, c, d, tolerance)
        worst = max(min(curves._distance_to_chord(point(t / 500), p, q) for p, q in zip(line, line[1:]))
                    for t in range(501))
        assert worst <= tolerance and line[-1] == d
        sizes.append(len(line))
    assert sizes[0] < sizes[1] < sizes[2] < 200
    straight = curves.flatten(a, (1.0, 0.0), (2.0, 0.0), (3.0, 0.0), 0.01)
    assert straight == [(3.0, 0.0)], "a straight one needs no points between"


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
