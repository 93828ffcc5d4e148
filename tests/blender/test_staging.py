# SPDX-License-Identifier: Apache-2.0
"""Shots and lights of a crowd in a real Blender."""
import json

import numpy
import pytest

from results import ADDON, HERE, result_of
from throng.setting import street_ends
from throng.setting.sunlight import houses_of, sunny_share


@pytest.fixture(scope="module")
def staged(blender, bakes):
    """What check_staging.py has seen at the intersection."""
    return result_of(blender(HERE / "check_staging.py", ADDON, bakes("intersection")))


def test_shots_show_the_crowd(staged):
    shots = staged["shots"]
    assert shots["wide"]["seen"] == shots["wide"]["people"] > 200, "everybody"
    assert shots["street"]["height"] < 2.1 and shots["street"]["seen"] > 20 and shots["street"]["nearest"] > 0.5
    assert shots["crane"]["height"] > 4.0 and shots["crane"]["seen"] > 50
    assert {shot["cameras"] for shot in shots.values()} == {1}


def test_the_street_is_seen_where_people_near_by_are_in_the_sun(staged, bakes):
    geometry = json.loads((bakes("intersection") / "bake.json").read_text())["geometry"]
    suns = {"noon": (0.418, 0.326, 0.848), "late": (0.682, 0.533, 0.5)}  # 58 and 30 degrees up, both from 128
    for time, least in (("noon", 0.8), ("late", 0.6)):
        shot = staged["street by light"][time]
        assert sunny_share(houses_of(geometry), shot["place"], shot["looks"], suns[time]) >= least
        assert shot["looks"][0] * suns[time][0] + shot["looks"][1] * suns[time][1] < 0.45, "not against the sun"
        assert min(abs(axis) for axis in shot["place"]) < 5.6, "in a street, off its houses"


def test_a_tree_before_the_lens_is_hidden_until_it_is_not(staged):
    assert staged["tree hidden"] == [[True, True], [False, False], [False, False]]


DAYS = ("noon", "overcast", "late")


def test_days_have_a_sun_and_nights_the_same_lamps_again(staged):
    first, again = staged["lights"]["night"]
    for time in DAYS:
        day, = staged["lights"][time]
        assert day["clamp"] > 1.0 > first["clamp"] and day["heads_light"] == [], "fireflies are clamped at night only"
        assert day["kinds"] == ["SUN"] and day["world"] == f"Throng {time} sky"
    assert first["heads_light"] == [False] and first["world"] == "Throng night sky" and \
        first["kinds"].count("POINT") >= 4
    assert first == again


@pytest.mark.parametrize("time", DAYS)
def test_skies_of_the_day_have_clouds_and_are_not_blown_out(staged, time):
    sky = numpy.array(staged["sky"][time]).reshape(36, 64)[18:]
    assert 0.3 < sky.mean() < 0.85 and numpy.quantile(sky, 0.99) < 0.97
    assert numpy.ptp(numpy.quantile(sky, (0.05, 0.95), axis=1), axis=0).mean() > 0.05, "across, at one height"


def test_nights_are_dark(staged):
    assert numpy.mean(staged["sky"]["night"]) < 0.25 < numpy.mean(staged["sky"]["late"])


def test_wet_ground_is_darker_and_has_puddles(staged):
    dry, damp, wet = (numpy.array(staged["paving"][amount]) for amount in ("0.0", "0.5", "1.0"))
    assert numpy.median(wet) < 0.94 * numpy.median(damp) < 0.9 * numpy.median(dry)
    assert numpy.quantile(wet, 0.02) < 0.71 * numpy.quantile(dry, 0.02), "water is black from above"
    assert damp.std() < 1.5 * dry.std(), "and there is none yet"


def test_the_ground_reaches_the_horizon(staged):
    assert staged["reach"] > 6000.0 and staged["clip"] > 6000.0


def gaps_to(roads, x, y):
    """Metres from the edges of the roads that a place is beside; below zero on them."""
    for road in roads:
        for (ax, ay, *_), (bx, by, *_) in zip(road["centreline"], road["centreline"][1:]):
            length = ((bx - ax) ** 2 + (by - ay) ** 2) ** 0.5
            if 0.0 <= ((x - ax) * (bx - ax) + (y - ay) * (by - ay)) / length <= length:
                yield abs((x - ax) * (by - ay) - (y - ay) * (bx - ax)) / length - 0.5 * road["width"]


def test_lamps_stand_beside_the_roads(staged, bakes, manifest_of):
    geometry = manifest_of(bakes("intersection"))["geometry"]
    roads = geometry["roads"] + street_ends.beyond(geometry)[0]
    for x, y in staged["lights"]["night"][0]["lamps"]:
        assert 0.0 <= min(gaps_to(roads, x, y)) < 1.0, (x, y)


def test_low_walls_round_much_ground_are_the_rim_of_a_lawn_and_a_pitch_has_lines_that_fit(blender, throng, tmp_path):
    throng("generate", "stadium", "--set", "people=12", "--set", "radius=62", "--set", "duration=1", "-o",
           tmp_path / "stadium.json")
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
