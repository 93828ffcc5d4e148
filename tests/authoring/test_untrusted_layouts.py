# SPDX-License-Identifier: Apache-2.0
"""Layouts and terrains from anybody: below a megabyte, whatever they say is read in at most 512 MiB and ten seconds of a
processor, and told where it makes no sense."""
import json
import math
import pathlib
import sys

import pytest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
import terrain_files  # noqa: E402

HALL = {"throng": 1, "simulation": {"duration": 1},
        "areas": [{"id": "west", "polygon": [[0, 0], [2, 0], [2, 4], [0, 4]]},
                  {"id": "east", "polygon": [[20, 0], [22, 0], [22, 4], [20, 4]]}],
        "flows": [{"id": "f", "from": "west", "to": "east", "count": 20}]}


@pytest.fixture
def check(confined, tmp_path):
    """Checks a layout: its text, or what is changed of a hall. Returns what is said."""

    def run(content, expect):
        text = content if isinstance(content, str) else json.dumps({**HALL, **content}, separators=(",", ":"))
        assert len(text) < 1_100_000
        (tmp_path / "layout.json").write_text(text)
        finished = confined("check", "layout.json", cwd=tmp_path, megabytes=512, expect=expect)
        assert len(finished.stderr) < 500_000
        return finished.stderr + finished.stdout

    return run


def comb(teeth, width=20.0, height=30.0, slant=0.0):
    """An outline with so many teeth, each of four points."""
    points = []
    for i in range(teeth):
        x = width * i / teeth
        step = width / teeth
        points += [[x, 0.5], [x + slant, height], [x + slant + 0.5 * step, height], [x + 0.5 * step, 0.5]]
    return points + [[width, 0.0], [0.0, 0.0]]


def zigzag(points, width=40.0, height=30.0):
    return [[round(width * i / points, 4), -5.0 if i % 2 else height] for i in range(points)]


@pytest.mark.parametrize("text, said", [
    ('{"' + "k" * 400_000 + '":[' + "1," * 200_000 + "1]}", "has no key"),
    ('{"' + '":{"'.join("k" * 8000 for _ in range(50)) + '":[' + "1," * 200_000 + "1]" + "}" * 50, "has no key"),
    ('{"a":[' + "[]," * 300_000 + "1]}", "has no key"),
    ("[" * 400_000, "nested"),
    ('{"a":' * 100_000, "nested"),
    ("{" + ",".join(f'"k{i}":1' for i in range(90_000)) + "}", "keys"),
    (json.dumps({**HALL, "x" * 900_000: 1}), "has no key"),
    (json.dumps({**HALL, "areas": [{"id": f"a{i}"} for i in range(60_000)]}), "more than the"),
    (json.dumps({**HALL, "areas": [{"id": f"a{i}", "what": 1} for i in range(4_000)]}), "more of the kind"),
    (json.dumps({**HALL, "flows": [{"id": f"f{i}", "from": "wets" + "s" * 150, "to": "eats"} for i in range(1900)],
                 "areas": [{"id": f"a{i}" + "b" * 190, "polygon": [[0, 0], [1, 0], [0, 1]]} for i in range(2500)]}),
     "no place"),
    ('{"throng":1,"name":"' + "n" * 900_000 + '"}', "longer than"),
], ids=("long key", "long keys in each other", "many arrays", "arrays", "objects", "many keys", "misspelt key", "many areas",
        "many mistakes", "many misspelt places", "long name"))
def test_texts_of_any_form_are_told(check, text, said):
    assert said in check(text, 3)


def test_more_values_than_fit_are_not_read(confined, tmp_path):
    (tmp_path / "layout.json").write_text('{"a":[' + "1," * 3_000_000 + "1]}")
    assert "1000000 values" in confined("check", "layout.json", cwd=tmp_path, megabytes=512, expect=3).stderr


@pytest.mark.parametrize("changes, said", [
    ({"walls": [{"points": [[-9e7, 30], [9e7, 30]]}]}, "/walls/0: with this, the layout is"),
    ({"walls": [{"points": [[-1e308, 30], [1e308, 30]]}]}, "out of range"),
    ({"walls": [{"points": [[0, y], [95000, y]]} for y in range(10, 40)]}, "longer than"),
    ({"roads": [{"id": "r", "centreline": [[0, 0], [0, 2e5]]}]}, "/roads/0: with this"),
    ({"formations": [{"id": "far", "type": "agents", "agents": [{"position": [8e7, 0], "goal": [0, 0]}]}]},
     "/formations/0: with this"),
    ({"formations": [{"id": "far", "type": "grid", "origin": [0, 0], "rows": 1, "columns": 4000000, "count": 100,
                      "spacing": 1e6, "goal": {"offset": [1e8, 1e8]}}]}, "/formations/0: with this"),
    ({"formations": [{"id": "f", "type": "circle", "centre": [0, 0], "radius": 1e6, "count": 10}]}, "/formations/0"),
    ({"walls": [{"points": zigzag(60_000)}]}, "at most 10000 points"),
    ({"areas": HALL["areas"] + [{"id": "comb", "polygon": comb(10_000)}]}, "at most 2000 points"),
    ({"flows": [{"id": "f", "from": "west", "to": "east", "count": 20, "via": [
        {"at": "west", "wait": 1, "activity": "queue", "line": [[-9e7, 1], [9e7, 3]]}]}]}, "with this"),
    ({"flows": [{"id": "f", "from": "west", "to": "east", "count": 3000000, "via": ["west", "east"] * 20}]}, "stops and changes"),
], ids=("endless wall", "ends of double", "long walls", "long road", "far person", "far grid", "far circle", "wall of points",
        "comb", "endless queue", "plans"))
def test_layouts_too_large_to_simulate_are_told_at_what_makes_them_so(check, changes, said):
    told = check(changes, 3)
    assert said in told and "layout.json:" in told


@pytest.mark.parametrize("changes", [
    {"areas": HALL["areas"] + [{"id": f"comb{i}", "polygon": comb(490, slant=i % 3)} for i in range(20)]},
    {"walls": [{"points": [[x, y + i] for x, y in zigzag(9_900)], "thickness": 0.01} for i in range(2)],
     "flows": [{"id": "f", "from": "west", "to": "west", "via": ["east"], "rate": 1}]},
    {"walls": [{"points": [[30 + i % 300 * 0.1, i // 300 * 0.1], [30.05 + i % 300 * 0.1, i // 300 * 0.1]]}
               for i in range(15_000)]},
    {"walls": [{"points": [[30 + i % 90, i // 90], [30.5 + i % 90, i // 90], [30 + i % 90, i // 90 + 0.5]], "closed": True}
               for i in range(8_000)]},
    {"roads": [{"id": f"r{i}", "centreline": zigzag(9_000), "one_way": bool(i % 2)} for i in range(4)]},
    {"walls": [{"points": [[-10, -10], [-10, 90000]]}]},
], ids=("combs", "zigzag walls", "many walls", "many solids", "zigzag roads", "long and thin"))
def test_layouts_of_very_many_points_are_checked_in_time(check, changes):
    said = check(changes, None)
    assert said


def test_no_control_characters_of_a_layout_reach_the_terminal(throng, tmp_path):
    text = '{"throng": 1, "\\u001b[31m\\u009b\\u202e": 1, "name": "a\\nb\\u0007", "\x9b": 2, "areas": "\x7f"}'
    (tmp_path / "layout\x1b[1m.json").write_text(text)
    for words in ((), ("--json",)):
        finished = throng("check", *words, "layout\x1b[1m.json", cwd=tmp_path, expect=3)
        assert "\x1b" not in finished.stderr and "\x9b" not in finished.stderr and "\x7f" not in finished.stderr
    (tmp_path / "bytes.json").write_bytes(b'{"throng": 1, "\xff\xfe": 1}')
    assert "bytes.json" in throng("check", "bytes.json", cwd=tmp_path, expect=3).stderr


# ---- terrains

def gltf(**changes):
    positions, triangles = terrain_files.surface(lambda x, y: 0.0, (-30, -30), (60, 60), 30)
    data = terrain_files.glb(positions, triangles)
    length = int.from_bytes(data[12:16], "little")
    document = json.loads(data[20:20 + length])
    document.update(changes)
    return terrain_files.pack(document, data[28 + length:])


@pytest.mark.parametrize("changes, expect, said", [
    ({}, 0, "ok"),
    ({"scenes": [{"nodes": [0] * 400_000}]}, 3, "lists node 0 twice"),
    ({"meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}] * 19_000}]}, 3, "layers"),
    ({"meshes": [{"primitives": [{"attributes": {}}] * 55_000}]}, 3, "primitives"),
    ({"meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}] * 10_000}],
      "nodes": [{"mesh": 0, "children": list(range(1, 20_000))}] + [{"mesh": 0}] * 19_999}, 3, "over and over"),
    ({"nodes": [{"mesh": 0, "children": [i + 1]} for i in range(20_000)] + [{"mesh": 0}]}, 3, "layers"),
    ({"nodes": [{"children": [i + 1]} for i in range(30_000)] + [{"mesh": 0}]}, 0, "ok"),
], ids=("as it is", "a node a million times", "many primitives", "too many primitives", "many instances", "many layers", "deep"))
def test_terrains_are_read_in_little_memory_and_time(check, tmp_path, changes, expect, said):
    (tmp_path / "ground.glb").write_bytes(gltf(**changes))
    assert said in check({"terrain": {"file": "ground.glb"}}, expect)


def test_terrains_a_thousand_kilometres_wide_are_read(check, tmp_path):
    positions, triangles = terrain_files.surface(lambda x, y: 0.01 * math.sin(x), (-500_000, -500_000),
                                                 (500_000, 500_000), 50_000)
    (tmp_path / "ground.glb").write_bytes(terrain_files.glb(positions, triangles))
    assert "ok" in check({"terrain": {"file": "ground.glb"}}, 0)
    assert "ok" in check({"terrain": {"file": "ground.glb"},
                          "walls": [{"points": [[-10, -10], [-10, 90_000]]}]}, 0)
