# SPDX-License-Identifier: Apache-2.0
"""Diagram images of layouts with levels: a part a chart, whose pixels are where the people on that storey are."""
import json
import os
import shutil
import signal
import subprocess
import time

import numpy
import pytest

import throng_io
from conftest import EXAMPLES
from processor_time import HANGS
from test_bakes import write

NOBODY = 0xFFFFFFFF
FAR = numpy.array([500_000.0, 4_000_000.0])  # as sites in UTM coordinates are


def two_floors(away=(0.0, 0.0), **simulation):
    """A stair from a floor up to one that lies over it, a lift beside it, and people on all of them."""
    x, y = away

    def at(*points):
        return [[x + a, y + b] for a, b in points]

    return {"throng": 1, "simulation": {"duration": 8, "smoothing": 0, **simulation},
            "levels": [{"id": "low", "floor": at((0, 0), (24, 0), (24, 12), (14, 12), (14, 7), (0, 7))},
                       {"id": "high", "height": 3.2, "floor": at((0, 8), (13, 8), (13, 14), (0, 14))}],
            "links": [{"id": "stairs", "from": "low", "to": "high", "path": at((20, 10), (13, 10)), "width": 2.4},
                      {"id": "cabin", "type": "lift", "levels": ["low", "high"], "at": at((10.5, 7))[0],
                       "size": [1.6, 1.8], "doors": -90, "opposite": ["high"]}],
            "areas": [{"id": "below", "polygon": at((1, 1), (12, 1), (12, 6), (1, 6))},
                      {"id": "above", "level": "high", "polygon": at((1, 9), (6, 9), (6, 13), (1, 13))}],
            "formations": [{"id": "up", "type": "grid", "origin": at((20.9, 6.5))[0], "rows": 4, "columns": 3,
                            "spacing": 1.1, "goal": "above"},
                           {"id": "down", "type": "grid", "origin": at((7, 9))[0], "rows": 4, "columns": 4,
                            "spacing": 1.1, "level": "high", "goal": "below"}]}


def baked(throng, folder, layout, *options):
    path = layout if isinstance(layout, os.PathLike) else write(folder / "layout.json", layout)
    throng("bake", path, "-o", folder / "bake", "-q", "--no-gltf", "--diagrams", "24", *options)
    return throng_io.Bake(folder / "bake")


def parts_of(bake, frame):
    return {name: bake.diagram(frame, name) for name in bake.storeys}


def middles(diagram, rows, columns):
    return diagram.place_of(numpy.stack([columns, rows], axis=-1) + 0.5)


def check_owners(bake, frame, tile=0.6):
    """Each pixel is as far from its owner as `distance` says, in the world, and its owner stands at its height.
    Returns how many pixels each person has in all parts."""
    people, owned = bake.world(frame), numpy.zeros(bake.agents, dtype=int)
    for name, diagram in parts_of(bake, frame).items():
        pixels = diagram.channels
        rows, columns = numpy.nonzero(pixels["kind"] == 1)
        owner = people[pixels["id"][rows, columns]]
        away = numpy.hypot(*(middles(diagram, rows, columns) - owner[:, :2]).T)
        # Places are single precision, in the plane and relative to the bake's origin.
        assert numpy.abs(away - pixels["distance"][rows, columns]).max(initial=0.0) < 2e-4, name
        assert away.max(initial=0.0) <= tile + 1e-3
        numpy.add.at(owned, pixels["id"][rows, columns], 1)
        assert not pixels["ground"].any() or diagram.lowest - 0.3 < pixels["height"][pixels["ground"] == 1].min()
        assert pixels["height"].max() < diagram.highest + 0.3
    return owned


def between_stops(parts, name, z):
    """Whether a height is within the shaft of the lift whose part this is (`LIFT at LEVEL`)."""
    stops = [part.lowest for other, part in parts.items()
             if part.kind == "lift" and other.rpartition(" at ")[0] == name.rpartition(" at ")[0]]
    return min(stops) - 0.05 < z < max(stops) + 0.05


def check_people(bake, frame):
    """Who stands on a storey owns the pixel that it stands on in its part, and nothing there in those above it."""
    parts, found = parts_of(bake, frame), set()
    rows = numpy.nonzero(bake.there(frame))[0]
    for row in rows:
        x, y, z = bake.world(frame)[row]
        mine = []
        for name, diagram in parts.items():
            column, line = numpy.floor(diagram.pixel_of((x, y))).astype(int)
            pixels = diagram.channels
            height, width = pixels["id"].shape
            if not (0 <= column < width and 0 <= line < height) or not pixels["ground"][line, column]:
                continue
            near = abs(pixels["height"][line, column] - z) < 0.45 and (diagram.kind != "lift" or
                                                                       abs(diagram.lowest - z) < 0.05)
            owner = pixels["id"][line, column] if pixels["kind"][line, column] == 1 else NOBODY
            if diagram.kind == "lift" and not near and owner == row:
                assert between_stops(parts, name, z), f"row {row} at {z:.2f} m is in {name}"
                found.add(int(row))  # on its way: who rides is in the cabin as it will stand at its next stop
            elif near:
                mine.append((name, owner))
            else:
                assert owner != row, f"row {row} at {z:.2f} m is on {name}, too"
        if any(owner == row for _, owner in mine):
            found.add(int(row))
    # But for who stands on a seam, on whose pixel two charts meet.
    assert len(rows) - len(found) <= max(2, 0.03 * len(rows)), (sorted(set(rows) - found), len(rows))


@pytest.mark.parametrize("away, pixels", [((0.0, 0.0), 0), (FAR, 0), ((0.3, -0.7), 3.7), ((0.0, 0.0), 16)])
def test_each_part_shows_its_own_storey_where_it_is_in_the_world(throng, tmp_path, away, pixels):
    """Also far from the origin, and where pixels do not fit the charts' lattice."""
    options = {"pixels_per_metre": pixels} if pixels else {}
    bake = baked(throng, tmp_path, two_floors(tuple(away), **options), "--density", "--second")
    assert bake.storeys == ["low", "high", "stairs", "cabin at low", "cabin at high"]
    scale = bake.about["diagrams"]["pixels_per_metre"]
    climbed = 0
    for frame in range(0, 192, 24):
        owned = check_owners(bake, frame)
        check_people(bake, frame)
        climbed += int((parts_of(bake, frame)["stairs"].channels["kind"] == 1).any())
        there = bake.there(frame)
        area = bake.component("density.area")[frame]
        # In all parts together, each pixel is there once: where charts' pixels do not fit, nearly so.
        if 4.0 * scale % 1.0 == 0.0:
            assert numpy.allclose(owned[there] / scale**2, area[there], atol=1.01 / scale**2)
        else:
            assert abs(owned[there].sum() / scale**2 / area[there].sum() - 1.0) < 0.02
    assert climbed >= 4


@pytest.mark.parametrize("name", ["bridge", "bridge-terrain"])
def test_people_above_people_are_in_parts_of_their_own(throng, tmp_path, name):
    bake = baked(throng, tmp_path, EXAMPLES / f"{name}.json", "--set", "simulation.duration=20", "--set",
                 "simulation.smoothing=0")
    kinds = {diagram.kind for diagram in parts_of(bake, 456).values()}
    assert kinds == ({"ground"} if name == "bridge-terrain" else {"level", "link", "lift"})
    assert len(bake.storeys) > 1
    for frame in (0, 240, 456):
        check_owners(bake, frame)
        check_people(bake, frame)
    assert throng("verify", bake.folder).returncode == 0


def test_headers_have_a_transform_that_other_programs_know(throng, tmp_path):
    OpenEXR = pytest.importorskip("OpenEXR")
    bake = baked(throng, tmp_path, two_floors())
    with OpenEXR.File(str(bake.folder / "diagrams" / "storeys.0025.exr"), separate_channels=True) as file:
        headers = [dict(part.header) for part in file.parts]
    display = headers[0]["displayWindow"]
    size = display[1] - display[0] + 1
    # Programs that make room for the first part's pixels find all others within.
    assert (headers[0]["dataWindow"][0] == 0).all() and (headers[0]["dataWindow"][1] == display[1]).all()
    for header, told in zip(headers, bake.about["diagrams"]["storeys"]["parts"]):
        assert header["name"] == told["name"] and header["throng:level"] == told["level"]
        assert (header["dataWindow"][0] >= 0).all() and (header["dataWindow"][1] <= display[1]).all()
        assert float(header["throng:lowest"][0]) == told["lowest"]
        assert float(header["throng:metresPerPixel"][0]) * float(header["throng:pixelsPerMetre"][0]) == 1.0
        for place in ((3.0, 4.0), (20.25, -1.5)):
            pixel = numpy.array([*place, 1.0]) @ header["throng:worldToPixel"].reshape(3, 3)
            device = numpy.array([*place, 7.0, 1.0], dtype=numpy.float32) @ header["worldToNDC"].reshape(4, 4)
            assert numpy.allclose(device[:2] * size, pixel[:2], atol=1e-3)
    assert [h["throng:kind"] for h in headers] == ["level", "level", "link", "lift", "lift"]


def test_flat_layouts_have_one_image_a_frame(throng, tmp_path):
    bake = baked(throng, tmp_path, EXAMPLES / "circle.json", "--set", "simulation.duration=2")
    assert sorted(path.name for path in (bake.folder / "diagrams").iterdir()) == [
        "diagram.0001.exr", "diagram.0025.exr"]
    assert bake.storeys == [] and "storeys" not in bake.about["diagrams"]
    assert bake.diagram(24).channels["id"].shape == (bake.about["diagrams"]["height"],
                                                     bake.about["diagrams"]["width"])
    with pytest.raises(throng_io.BakeError, match="no levels"):
        bake.diagram(24, "deck")
    with pytest.raises(throng_io.BakeError, match="no diagram image of frame 7"):
        bake.diagram(7)


def test_damage_is_told(throng, tmp_path):
    bake = baked(throng, tmp_path, two_floors(duration=2))
    with pytest.raises(throng_io.BakeError, match="there are low, high, stairs"):
        bake.diagram(24, "middle")
    image = bake.folder / "diagrams" / "storeys.0025.exr"
    content = image.read_bytes()
    image.write_bytes(content[:200])
    with pytest.raises(throng_io.BakeError, match="cannot be read as a diagram image"):
        bake.diagram(24, "low")
    assert "diagrams/storeys.0025.exr" in throng("verify", bake.folder, expect=3).stderr
    image.write_bytes(content)
    shutil.rmtree(bake.folder / "diagrams")
    with pytest.raises(throng_io.BakeError, match="cannot be read as a diagram image"):
        bake.diagram(24)


def test_a_bake_that_goes_on_has_the_same_images(throng, tmp_path):
    layout = write(tmp_path / "layout.json", two_floors(duration=20))
    options = ["-q", "--no-gltf", "--diagrams", "6"]
    throng("bake", layout, "-o", tmp_path / "whole", *options)
    bake = subprocess.Popen([throng.binary, "bake", layout, "-o", tmp_path / "parts", *options, "--checkpoint",
                             "0.0002"], stderr=subprocess.PIPE, text=True)
    while not (tmp_path / "parts.unfinished" / "diagrams" / "storeys.0013.exr").exists():
        assert bake.poll() is None
        time.sleep(0.005)
    bake.send_signal(signal.SIGTERM)
    said = bake.communicate(timeout=HANGS)[1]
    assert bake.returncode == 85, said
    throng("bake", layout, "-o", tmp_path / "parts", *options, "--resume")
    whole, parts = (json.loads((tmp_path / name / "bake.json").read_text())["files"] for name in ("whole", "parts"))
    assert whole == parts and sum("storeys" in each["path"] for each in whole) == 80
