# SPDX-License-Identifier: Apache-2.0
"""Seats on a slope whose heights are known: people go up to them and sit there, and are on the ground elsewhere."""
import json
import subprocess
import sys

import numpy
import pytest

import terrain_files

ROWS, PITCH = 4, 0.9
FOOT = 0.7  # m, before the block


def plane(x, y):
    """20 % up to the east, 10 % to the north."""
    return 5.0 + 0.2 * x + 0.1 * y


def layout(**block):
    return {
        "throng": 1, "simulation": {"duration": 60, "fps": 12, "seed": 4},
        "terrain": {"file": "slope.glb", "surface": "highest"},
        "areas": [{"id": "gate", "polygon": [[-14, 8], [-10, 8], [-10, 12], [-14, 12]]}],
        "seats": [{"id": "a", "front": [[6, 0], [-6, 0]], "rows": ROWS, "pitch": PITCH, "aisles": 1, **block}],
        "flows": [{"id": "guests", "from": "gate", "to": {"seats": "a"}, "count": 9, "end": 10}]}


@pytest.fixture(scope="module", params=[{"on_terrain": True, "occupancy": 0.3}, {"height": 5, "rise": 0.2}],
                ids=["on the slope", "level"])
def sitting(request, throng, tmp_path_factory):
    """(block, bake's folder, streams)"""
    folder = tmp_path_factory.mktemp("slope")
    (folder / "slope.glb").write_bytes(terrain_files.glb(*terrain_files.surface(plane, (-30, -30), (30, 30), 4.0)))
    block = {"occupancy": 0.1, **request.param}
    (folder / "layout.json").write_text(json.dumps(layout(**block)))
    throng("bake", folder / "layout.json", "-o", folder / "bake", "-q")
    load = lambda name: numpy.load(folder / "bake" / "streams" / f"{name}.npy").astype(float)
    return block, folder / "bake", {name: load(name) for name in ("pos", "state", "ground")}


def floor_of(block, row, x):
    """The rows look south and are behind each other to the north, so that their back edges are on the higher ground."""
    if "on_terrain" not in block:
        return block["height"] + row * block["rise"]
    return plane(x, row * PITCH + 0.5 * PITCH)


def test_everybody_sits_on_the_floor_of_a_row(sitting, manifest_of):
    block, bake, streams = sitting
    manifest = manifest_of(bake)
    origin, last = manifest["origin"], streams["pos"][-1]
    seated = (streams["state"][-1, :, 0] // 1) % 64
    assert len(last) > 12 and (seated >= 5).all(), "all of them, those who came, too"
    for x, y, z in last + origin:
        row = round(y / PITCH)
        assert abs(y - row * PITCH) < 0.02 and 0 <= row < ROWS
        assert z == pytest.approx(floor_of(block, row, x), abs=6e-3), "who has come is 2 cm before the end of its way"


def test_who_comes_is_on_the_ground_and_then_on_the_steps(sitting, manifest_of):
    block, bake, streams = sitting
    there = streams["state"][:, :, 0] > 0.5
    x, y, z = (streams["pos"] + manifest_of(bake)["origin"]).transpose(2, 0, 1)
    outside = there & (y > -0.5) & (numpy.abs(x) > 7.5)
    assert outside.sum() > 50
    assert numpy.abs(z - plane(x, y))[outside].max() < 0.02
    change = numpy.abs(numpy.diff(z, axis=0))[there[1:] & there[:-1]]
    assert change.max() < 0.08, "nobody jumps: at 0.8 m/s and 80 % these are 5 cm a frame"
    over = (z - plane(x, y))[there]
    lowest = -0.05 if "on_terrain" in block else -1.5
    assert lowest < over.min() and over.max() < 1.5


def test_the_stand_is_told_with_its_heights(sitting, manifest_of):
    block, bake, _ = sitting
    manifest = manifest_of(bake)
    told, (ox, oy, _) = manifest["geometry"]["seats"][0], manifest["origin"]
    assert told["ground"] == pytest.approx(plane(-6.0, -0.5 * PITCH), abs=1e-3)
    assert [("heights" in row) for row in told["rows"]] == ["on_terrain" in block] * (2 * ROWS)
    for number, row in enumerate(told["rows"]):
        for (x, _), height in zip(row["line"], row.get("heights", [row["height"]] * len(row["line"]))):
            assert height == pytest.approx(floor_of(block, number // 2, x + ox), abs=1e-3)
    (aisle,) = told["aisles"]
    assert len(aisle["heights"]) == len(aisle["line"]) == ROWS + 1
    foot = aisle["line"][0]
    assert aisle["heights"][0] == pytest.approx(plane(foot[0] + ox, foot[1] + oy), abs=1e-3)
    assert foot[1] + oy == pytest.approx(-0.5 * PITCH - FOOT, abs=1e-6)


def test_it_is_read_and_written_again(sitting, throng, tmp_path):
    _, bake, _ = sitting
    throng("info", bake)
    glb = json.loads(subprocess.run([sys.executable, "-c", """
import json, struct, sys
data = open(sys.argv[1], 'rb').read()
print(data[20:20 + struct.unpack_from('<I', data, 12)[0]].decode())
""", str(bake / "crowd.glb")], capture_output=True, text=True, check=True).stdout)
    assert {"stand a", "seats a"} <= {node.get("name") for node in glb["nodes"]}


@pytest.mark.parametrize("block, words, hint", [
    ({"on_terrain": True, "front": [[20, 0], [40, 0]]}, "there is no ground of the terrain under row 1",
     "move the block"),
    ({"on_terrain": True, "front": [[30.2, 0], [20, 0]]}, "there is no ground of the terrain under an end of row 1",
     "move the block"),
    ({"height": 9}, "aisle 1, from the ground to its first row, climbs 4.", '"on_terrain": true'),
    ({"height": 5, "mouths": {"at": "back", "passage": 9}}, "by passages: these are for flat ground", "`mouths`"),
])
def test_what_cannot_be_is_told_with_its_line(throng, tmp_path, block, words, hint):
    (tmp_path / "slope.glb").write_bytes(terrain_files.glb(*terrain_files.surface(plane, (-30, -30), (30, 30), 4.0)))
    (tmp_path / "layout.json").write_text(json.dumps(layout(**{"occupancy": 0.1, **block}), indent=1))
    said = throng("check", tmp_path / "layout.json", expect=3).stderr
    assert words in said and hint in said and "/seats/0" in said
