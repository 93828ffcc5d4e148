# SPDX-License-Identifier: Apache-2.0
"""Shots and lights of a crowd in a real Blender."""
import json
import pathlib

from conftest import ROOT

ADDON = ROOT / "blender_addon"


def test_shots_show_the_crowd_and_nights_have_lamps_beside_the_roads(blender, bakes, manifest_of):
    bake = bakes("intersection")
    output = blender(pathlib.Path(__file__).parent / "check_staging.py", ADDON, bake)
    result = json.loads(next(line for line in output.splitlines() if line.startswith("RESULT "))[7:])
    shots = result["shots"]
    assert shots["wide"]["seen"] == shots["wide"]["people"] > 200, "everybody"
    assert shots["street"]["height"] < 2.1 and shots["street"]["seen"] > 20 and shots["street"]["nearest"] > 0.5
    assert shots["crane"]["height"] > 4.0 and shots["crane"]["seen"] > 50
    assert {shot["cameras"] for shot in shots.values()} == {1}
    day, = result["lights"]["day"]
    assert day["clamp"] > 1.0 > result["lights"]["night"][0]["clamp"] and day["heads_light"] == [], "fireflies are clamped at night only"
    assert result["lights"]["night"][0]["heads_light"] == [False]
    assert day["kinds"] == ["SUN"] and day["world"] == "Throng sky"
    roads = manifest_of(bake)["geometry"]["roads"]
    first, again = result["lights"]["night"]
    assert first == again and first["world"] == "Throng night" and first["kinds"].count("POINT") >= 4
    for x, y in first["lamps"]:
        gaps = []
        for road in roads:
            for (ax, ay, *_), (bx, by, *_) in zip(road["centreline"], road["centreline"][1:]):
                length = ((bx - ax) ** 2 + (by - ay) ** 2) ** 0.5
                along = ((x - ax) * (bx - ax) + (y - ay) * (by - ay)) / length
                if 0.0 <= along <= length:
                    gaps.append(abs((x - ax) * (by - ay) - (y - ay) * (bx - ax)) / length - 0.5 * road["width"])
        assert 0.0 <= min(gaps) < 1.0, (x, y)


def test_low_walls_round_much_ground_are_the_rim_of_a_lawn_and_a_pitch_has_lines_that_fit(blender, throng, tmp_path):
    throng("generate", "stadium", "--set", "people=12", "--set", "radius=62", "--set", "duration=1", "-o", tmp_path / "stadium.json")
    throng("bake", tmp_path / "stadium.json", "-o", tmp_path / "bake", "-q", "--no-gltf")
    script = tmp_path / "lawn.py"
    script.write_text(f"""
import math, sys
sys.path.insert(0, {str(ADDON)!r})
import bpy, throng
bpy.ops.wm.read_factory_settings(use_empty=True)
throng.register()
bpy.ops.import_scene.throng(filepath={str(tmp_path / "bake" / "bake.json")!r})
pitch = bpy.data.objects['Throng wall pitch'].data
parts = {{}}
for polygon in pitch.polygons:
    parts.setdefault(pitch.materials[polygon.material_index].name, []).append(polygon)
grass, = parts['throng grass']
assert 0.97 * math.pi * 62 ** 2 < grass.area < math.pi * 62 ** 2 and grass.normal.z > 0.99 and grass.center.z < 0.5
corners = [pitch.vertices[i].co for polygon in parts['throng line'] for i in polygon.vertices]
assert max(corner.z for corner in corners) < 0.5 and 59.0 < max(corner.xy.length for corner in corners) < 61.6
assert max(v.co.z for v in pitch.vertices) == 1.0
""")
    blender(script)
