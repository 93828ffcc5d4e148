# SPDX-License-Identifier: Apache-2.0
"""Diagram images on the ground in a real Blender, pixel by pixel."""
import json
import pathlib

import numpy
import pytest

from conftest import ROOT

SCRIPT = pathlib.Path(__file__).parent / "check_cells.py"
LAYOUT = {"throng": 1, "name": "square", "simulation": {"duration": 1.5, "fps": 24},
          "roads": [{"id": "main", "centreline": [[-12, 0], [12, 0]], "width": 6}],
          "areas": [{"id": "plaza", "polygon": [[-8, 4], [8, 4], [8, 9], [-8, 9]]}, {"id": "goal", "polygon": [[9, -9], [11, -9], [11, -7], [9, -7]]}],
          "formations": [{"id": "some", "type": "grid", "origin": [-9, -2], "rows": 3, "columns": 8, "spacing": 2.0, "jitter": 0.2, "goal": "goal"},
                         {"id": "more", "type": "grid", "origin": [-5, 5], "rows": 2, "columns": 5, "spacing": 2.0, "jitter": 0.2, "goal": "goal"}]}


def picture(path):
    OpenEXR = pytest.importorskip("OpenEXR")
    with OpenEXR.File(str(path)) as file:
        return numpy.asarray(file.channels()["RGB"].pixels, dtype=float)


def cells(bake, manifest, frame, shape):
    """Which pixels of a picture of the bounds from above are within a cell and which are without, by the bake's own image; neither near an edge."""
    OpenEXR = pytest.importorskip("OpenEXR")
    with OpenEXR.File(str(bake / "diagrams" / f"diagram.{frame:04d}.exr"), separate_channels=True) as file:
        inside = file.channels()["kind"].pixels == 1
    low, high = (numpy.array(manifest["bounds"][key]) for key in ("min", "max"))
    at, scale = numpy.array(manifest["diagrams"]["min"]), manifest["diagrams"]["pixels_per_metre"]
    lines, columns = numpy.indices(shape)
    x = low[0] + (columns + 0.5) / shape[1] * (high[0] - low[0])
    y = high[1] - (lines + 0.5) / shape[0] * (high[1] - low[1])
    column = (x - at[0]) * scale - 0.5
    line = inside.shape[0] - (y - at[1]) * scale - 0.5

    def around(reach):
        return [inside[numpy.clip((line + dy).round().astype(int), 0, inside.shape[0] - 1), numpy.clip((column + dx).round().astype(int), 0, inside.shape[1] - 1)]
                for dy in range(-reach, reach + 1) for dx in range(-reach, reach + 1)]

    return numpy.all(around(1), axis=0), ~numpy.any(around(2), axis=0)


def test_cells_lie_on_the_ground_where_people_are_and_stay_until_the_next_image(blender, throng, tmp_path, manifest_of):
    bake = tmp_path / "bake"
    (tmp_path / "square.json").write_text(json.dumps(LAYOUT))
    throng("bake", tmp_path / "square.json", "-o", bake, "-q", "--no-gltf", "--diagrams", "5")
    manifest = manifest_of(bake)
    output = blender(SCRIPT, ROOT / "blender_addon", bake, tmp_path)
    result = json.loads(next(line for line in output.splitlines() if line.startswith("RESULT "))[7:])
    assert result["with overlay"] == result["objects"] + 1 and result["with mask"] == result["objects"]
    assert "is missing" in result["missing"]
    blender(SCRIPT, tmp_path, blend=tmp_path / "overlay.blend")  # as on a farm: the add-on is not there

    bare, mask = picture(tmp_path / "bare.exr"), picture(tmp_path / "mask.exr")
    assert numpy.abs(picture(tmp_path / "mask-again.exr") - mask).max() < 1e-4 and numpy.abs(picture(tmp_path / "none.exr") - bare).max() < 1e-4
    within, without = cells(bake, manifest, 21, bare.shape[:2])  # frame 25 shows the image of frame 21
    assert within.sum() > 100 and without.sum() > 2000
    ratio = mask.mean(axis=2) / bare.mean(axis=2)  # dark ground still reflects the sky
    assert numpy.median(ratio[within]) < 0.5 and ratio[within].max() < 0.8 and ratio[without].min() > 0.9

    assert result["removed by hand"]
    assert (result["left"], result["kept"]) == ([], True), "nodes and images go with the cells, unless somebody else uses them"
    for name in ("mask-later", "mask-back", "mask-anew", "mask-found"):
        assert numpy.abs(picture(tmp_path / f"{name}.exr") - mask).max() < 1e-4, name
    retake = picture(tmp_path / "mask-of-retake.exr").mean(axis=2) / bare.mean(axis=2)
    first_within, _ = cells(bake, manifest, 1, bare.shape[:2])
    assert numpy.median(retake[first_within]) < 0.5 and numpy.abs(retake - ratio).max() > 0.3
    assert numpy.abs(picture(tmp_path / "mask-lost.exr") - bare).max() < 1e-4, "a bake without images takes the cells away"

    shown = {frame: picture(tmp_path / f"overlay.{frame}.exr") for frame in (25, 26, 30)}
    assert numpy.abs(shown[26] - shown[30]).max() < 1e-4 and numpy.abs(shown[25] - shown[26]).max() > 0.1
    for frame, image in ((25, 21), (26, 26)):
        within, without = cells(bake, manifest, image, bare.shape[:2])
        chroma = 1.0 - shown[frame].min(axis=2) / shown[frame].max(axis=2)  # streets are grey, cells are not
        assert (chroma[without] < 0.3).mean() > 0.999 and (chroma[within] > 0.5).mean() > 0.98


def test_a_bake_without_images_says_how_to_get_them(blender, tmp_path):
    from test_import import write_bake

    write_bake(tmp_path / "bake")
    script = tmp_path / "no_images.py"
    script.write_text(f"""
import bpy, sys
sys.path.insert(0, {str(ROOT / "blender_addon")!r})
import throng
bpy.ops.wm.read_factory_settings(use_empty=True)
throng.register()
bpy.ops.import_scene.throng(filepath={str(tmp_path / "bake" / "bake.json")!r})
before = len(bpy.data.materials)
try:
    bpy.ops.throng.cells(kind='mask')
    raise SystemExit('accepted')
except RuntimeError as error:
    assert 'bake it with --diagrams' in str(error), error
assert len(bpy.data.materials) == before
""")
    blender(script)
