# SPDX-License-Identifier: Apache-2.0
"""People on ground that is not flat, in a real Blender: a bake's own terrain, and a mesh that only the scene has."""
import json
import math
import shutil

import numpy
import pytest
import terrain_files

from results import ADDON, HERE, result_of
from throng import formats
from throng.formats.terrain_mesh import read_mesh

FRAMES = [1, 40, 97, 150]


def ramp(x, _):
    """Flat, then 20 % up, then 25 % down, then flat."""
    return max(0.0, min(0.2 * (x + 10.0), 4.0 - 0.25 * (x - 10.0)))


@pytest.fixture(scope="module")
def two_bakes(throng, tmp_path_factory):
    """The same layout on a ramp and on flat ground."""
    folder = tmp_path_factory.mktemp("ground")
    (folder / "ramp.glb").write_bytes(terrain_files.glb(*terrain_files.surface(ramp, (-40, -20), (40, 20), 2.0)))
    layout = {"throng": 1, "simulation": {"duration": 8, "warmup": 50},
              "roads": [{"id": "way", "centreline": [[-25, 0], [25, 0]], "width": 8}],
              "walls": [{"id": "rail", "points": [[-12, 6], [0, 6]], "height": 1.0}],
              "flows": [{"id": "up", "from": "way:start", "to": "way:end", "rate": 1},
                        {"id": "down", "from": "way:end", "to": "way:start", "rate": 1}]}
    for name, terrain in (("flat", None), ("ramp", {"file": "ramp.glb", "offset": [0, 0, 7]})):
        (folder / f"{name}.json").write_text(json.dumps({**layout, **({"terrain": terrain} if terrain else {})}))
        throng("bake", folder / f"{name}.json", "-o", folder / "bakes" / name, "-q", "--no-gltf")
    return folder / "bakes"


@pytest.fixture(scope="module")
def stood(blender, two_bakes, tmp_path_factory):
    """(what check_ground.py has seen, the scene that it has saved)."""
    scene = tmp_path_factory.mktemp("conformed") / "conformed.blend"
    return result_of(blender(HERE / "check_ground.py", ADDON, two_bakes / "ramp", two_bakes / "flat",
                             json.dumps(FRAMES), scene)), scene


def streams_of(bake, *names):
    return [numpy.load(bake / "streams" / f"{name}.npy") for name in names]


def matrices(people):
    return {int(row): numpy.array(matrix) for row, matrix in people.items()}


def to_edges(x):
    """How far somebody is from where the ramp begins or ends, m."""
    return min(abs(x - edge) for edge in (-10.0, 10.0, 26.0))


def test_people_stand_on_the_ground_upright_with_their_feet_along_it(two_bakes, stood):
    pos, direction, state, ground = streams_of(two_bakes / "ramp", "pos", "dir", "state", "ground")
    slopes = []
    for frame, people in zip(FRAMES, stood[0]["baked"]):
        there = matrices(people)
        assert set(there) == set(numpy.nonzero(state[frame - 1, :, 0] > 0.5)[0]) and len(there) > 20
        for row, matrix in there.items():
            assert numpy.abs(matrix[:3, 3] - pos[frame - 1, row]).max() < 1e-4
            along, across, _ = ground[frame - 1, row]
            cosine, sine, _ = direction[frame - 1, row]
            expected = numpy.array([[cosine, -sine, 0.0], [sine, cosine, 0.0], [along, across, 1.0]])
            assert numpy.abs(matrix[:3, :3] - expected).max() < 2e-4, "sheared: upright, and along the slope"
            slopes.append(along)
    assert max(slopes) > 0.15 and min(slopes) < -0.15


def test_feet_are_on_the_very_ground(stood):
    """A foot 0.3 m ahead and one as far behind, away from the ramp's edges."""
    for people in stood[0]["baked"]:
        for matrix in matrices(people).values():
            for reach in (-0.3, 0.3):
                x, _, z, _ = matrix @ numpy.array([reach, 0.1, 0.0, 1.0])
                assert to_edges(x) <= 1.5 or abs(z - 7.0 - ramp(x, 0.0)) < 0.01


def test_a_bakes_terrain_is_imported_in_place_of_the_ground(stood):
    found = stood[0]
    assert found["flat"] == [], "flat bakes have no more modifiers than they need"
    corners = numpy.array(found["terrain"]["corners"])
    assert found["terrain"]["faces"] == 40 * 20 * 2 and max(abs(z - 7.0 - ramp(x, y)) for x, y, z in corners) < 1e-5
    road, (x, y, _) = numpy.array(found["terrain"]["road"]), numpy.abs(corners).T
    assert road[(x < 24) & (y < 3)].min() == 1.0 and road[y > 5].max() == 0.0
    assert not found["ground"] and found["camera"] > 9.0
    low, height = found["walls"]["Throng wall rail"]
    assert low == pytest.approx(7.0, abs=1e-3)
    assert height == pytest.approx(3.0, abs=0.02), "from the lowest ground to 1 m over the highest"
    assert found["problems"] == [] and found["starts"] == [4.0] and "has a terrain" in found["relinked"]


def check_conformed(bake, shots):
    """That people of the flat bake stand on the ramp, which is 2 m higher in the scene."""
    pos, direction = streams_of(bake, "pos", "dir")
    checked = 0
    for frame, people in zip(FRAMES, shots):
        for row, matrix in matrices(people).items():
            x, y, _ = pos[frame - 1, row]
            assert numpy.abs(matrix[:2, 3] - (x, y)).max() < 1e-4
            if to_edges(x) < 0.4:
                continue
            slope = (ramp(x + 0.1, 0.0) - ramp(x - 0.1, 0.0)) / 0.2
            cosine, sine, _ = direction[frame - 1, row]
            assert abs(matrix[2, 3] - 9.0 - ramp(x, y)) < 1e-3
            assert numpy.abs(matrix[2, :3] - (slope * cosine, -slope * sine, 1.0)).max() < 1e-3
            assert numpy.abs(matrix[:2, 2]).max() < 1e-4, "upright"
            checked += 1
    assert checked > 60


def test_flat_bakes_conform_to_a_mesh_also_on_a_farm(blender, two_bakes, stood, tmp_path):
    found, scene = stood
    assert "no such thing" in found["refused"]
    names = found["modifiers"]
    assert names.count("throng conform") == 1
    assert names.index("throng pos") < names.index("throng conform") < names.index("throng people")
    check_conformed(two_bakes / "flat", found["conformed"])
    for people in found["released"]:
        for matrix in people.values():
            assert abs(matrix[2][3]) < 1e-5 and max(map(abs, matrix[2][:2])) < 1e-6
    farm = tmp_path / "farm.py"
    farm.write_text("""
import bpy, json, sys
assert 'throng' not in sys.modules and not hasattr(bpy.types, 'IMPORT_SCENE_OT_throng')
crowd = next(thing for thing in bpy.context.scene.objects if 'throng pos' in thing.modifiers)
result = []
for frame in json.loads(sys.argv[-1]):
    bpy.context.scene.frame_set(frame)
    result.append({i.persistent_id[1]: [list(row) for row in i.matrix_world]
                   for i in bpy.context.evaluated_depsgraph_get().object_instances
                   if i.is_instance and i.parent and i.parent.original == crowd})
print('RESULT ' + json.dumps(result))
""")
    check_conformed(two_bakes / "flat", result_of(blender(farm, json.dumps(FRAMES), blend=scene)))


@pytest.mark.parametrize("damage, words", [
    (lambda path: path.unlink(), "cannot be read"),
    (lambda path: path.write_bytes(path.read_bytes()[:-8]), "truncated"),
    (lambda path: path.write_bytes(b"glTF"), "truncated"),
    (lambda path: path.write_bytes(path.read_bytes()[:-4] + b"\xff\xff\xff\x7f"), "truncated")])
def test_a_damaged_terrain_is_one_clear_error(two_bakes, tmp_path, damage, words):
    path = tmp_path / "terrain.glb"
    path.write_bytes((two_bakes / "ramp" / "terrain.glb").read_bytes())
    assert len(read_mesh(str(path))[1]) == 40 * 20 * 6
    damage(path)
    with pytest.raises(formats.BakeError, match=words):
        read_mesh(str(path))


def test_a_manifest_cannot_name_a_terrain_elsewhere(two_bakes):
    manifest = json.loads((two_bakes / "ramp" / "bake.json").read_text())
    manifest["terrain"]["file"] = "../terrain.glb"
    with pytest.raises(formats.BakeError, match="names no file"):
        formats.Bake(manifest, str(two_bakes / "ramp")).terrain_path
    assert math.isclose(manifest["terrain"]["highest"] - manifest["terrain"]["lowest"], 4.0)


def test_whoever_is_changed_stands_on_the_ground_anew_as_throng_apply_has_it(blender, throng, two_bakes, tmp_path):
    bake = tmp_path / "ramp"
    shutil.copytree(two_bakes / "ramp", bake)
    state = numpy.load(bake / "streams" / "state.npy")
    moved, retimed, hero = numpy.nonzero((state[[0, 40, 96], :, 0] > 0.5).all(axis=0))[0][:3]
    frames = [1, 41, 97]
    shots = result_of(blender(HERE / "check_moved.py", ADDON, bake, moved, retimed, hero, json.dumps(frames)))
    throng("apply", bake, "-o", tmp_path / "applied")
    pos, direction, state, ground = (numpy.load(tmp_path / "applied" / "streams" / f"{name}.npy")
                                     for name in ("pos", "dir", "state", "ground"))
    climbed = set()
    for frame, shot in zip(frames, shots):
        people = {int(row): numpy.array(matrix) for row, matrix in shot["people"].items()}
        assert hero not in people
        x, y, _ = pos[frame - 1, hero]
        assert numpy.abs(numpy.array(shot["hero"]) - (x, y, 7.0 + ramp(x, y))).max() < 0.03
        for row in (moved, retimed):
            x, y, z = pos[frame - 1, row]
            assert numpy.abs(people[row][:3, 3] - (x, y, z)).max() < 0.03, (row, frame)
            along, across, _ = ground[frame - 1, row]
            cosine, sine, _ = direction[frame - 1, row]
            if to_edges(x) > 0.5:
                assert numpy.abs(people[row][:3, :3]
                                 - [[cosine, -sine, 0.0], [sine, cosine, 0.0], [along, across, 1.0]]).max() < 0.03
            climbed.add(round(float(z) - 7.0 - ramp(x, y), 1))
        others = [row for row in people if row not in (moved, retimed)]
        assert len(others) > 20
        assert all(numpy.abs(people[row][:3, 3] - pos[frame - 1, row]).max() < 1e-4 for row in others)
    assert climbed == {0.0, 0.5}, "half a metre over the ground, and on it"
