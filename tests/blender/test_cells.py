# SPDX-License-Identifier: Apache-2.0
"""Diagram images on the ground in a real Blender, pixel by pixel."""
import json

import numpy
import OpenEXR
import pytest

from results import ADDON, HERE, result_of
from sample_bake import SMALL_CAST, write_bake

SCRIPT = HERE / "check_cells.py"
LAYOUT = {"throng": 1, "name": "square", "simulation": {"duration": 1.5, "fps": 24},
          "roads": [{"id": "main", "centreline": [[-12, 0], [12, 0]], "width": 6}],
          "areas": [{"id": "plaza", "polygon": [[-8, 4], [8, 4], [8, 9], [-8, 9]]},
                    {"id": "goal", "polygon": [[9, -9], [11, -9], [11, -7], [9, -7]]}],
          "formations": [{"id": "some", "type": "grid", "origin": [-9, -2], "rows": 3, "columns": 8, "spacing": 2.0,
                          "jitter": 0.2, "goal": "goal"},
                         {"id": "more", "type": "grid", "origin": [-5, 5], "rows": 2, "columns": 5, "spacing": 2.0,
                          "jitter": 0.2, "goal": "goal"}]}


def picture(path):
    with OpenEXR.File(str(path)) as file:
        return numpy.asarray(file.channels()["RGB"].pixels, dtype=float)


def cells(bake, manifest, frame, shape):
    """Which pixels of a picture of the bounds from above are within a cell and which are without, by the bake's own
    image; neither near an edge."""
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
        return [inside[numpy.clip((line + dy).round().astype(int), 0, inside.shape[0] - 1),
                       numpy.clip((column + dx).round().astype(int), 0, inside.shape[1] - 1)]
                for dy in range(-reach, reach + 1) for dx in range(-reach, reach + 1)]

    return numpy.all(around(1), axis=0), ~numpy.any(around(2), axis=0)


class Square:
    """The square's bake, what check_cells.py has seen of it, and the pictures that it has rendered."""

    def __init__(self, blender, throng, folder):
        self.folder, self.bake = folder, folder / "bake"
        (folder / "square.json").write_text(json.dumps(LAYOUT))
        throng("bake", folder / "square.json", "-o", self.bake, "-q", "--no-gltf", "--diagrams", "5")
        self.manifest = json.loads((self.bake / "bake.json").read_text())
        self.result = result_of(blender(SCRIPT, ADDON, self.bake, folder))
        blender(SCRIPT, folder, blend=folder / "overlay.blend")  # as on a farm: the add-on is not there
        self.bare, self.mask = self.picture("bare"), self.picture("mask")

    def picture(self, name):
        return picture(self.folder / f"{name}.exr")

    def cells(self, frame):
        """Which pixels of a picture are within a cell, and which without."""
        return cells(self.bake, self.manifest, frame, self.bare.shape[:2])

    def darker(self, name):
        """What is left of the light of the bare ground; dark ground still reflects the sky."""
        return self.picture(name).mean(axis=2) / self.bare.mean(axis=2)


@pytest.fixture(scope="module")
def square(blender, throng, tmp_path_factory):
    return Square(blender, throng, tmp_path_factory.mktemp("cells"))


def test_a_mask_darkens_the_ground_within_cells(square):
    within, without = square.cells(21)  # frame 25 shows the image of frame 21
    assert within.sum() > 100 and without.sum() > 2000
    ratio = square.darker("mask")
    assert numpy.median(ratio[within]) < 0.5 and ratio[within].max() < 0.8 and ratio[without].min() > 0.9


@pytest.mark.parametrize("name, like", [("mask-again", "mask"), ("mask-later", "mask"), ("mask-back", "mask"),
                                        ("mask-anew", "mask"), ("mask-found", "mask"), ("mask-lost", "bare"),
                                        ("none", "bare")])
def test_a_mask_is_always_the_same_or_gone(square, name, like):
    """Put there twice, or with its crowd; gone where a bake has no images, or when it is taken away."""
    assert numpy.abs(square.picture(name) - square.picture(like)).max() < 1e-4


def test_a_mask_goes_with_the_bake_that_is_played(square):
    retake, (within, _) = square.darker("mask-of-retake"), square.cells(1)
    assert numpy.median(retake[within]) < 0.5 and numpy.abs(retake - square.darker("mask")).max() > 0.3


def test_an_overlay_stays_until_the_next_image(square):
    shown = {frame: square.picture(f"overlay.{frame}") for frame in (25, 26, 30)}
    assert numpy.abs(shown[26] - shown[30]).max() < 1e-4 and numpy.abs(shown[25] - shown[26]).max() > 0.1
    for frame, image in ((25, 21), (26, 26)):
        within, without = square.cells(image)
        chroma = 1.0 - shown[frame].min(axis=2) / shown[frame].max(axis=2)  # streets are grey, cells are not
        assert (chroma[without] < 0.3).mean() > 0.999 and (chroma[within] > 0.5).mean() > 0.98


def test_nodes_and_images_go_with_the_cells_unless_somebody_else_uses_them(square):
    result = square.result
    assert result["with overlay"] == result["objects"] + 1 and result["with mask"] == result["objects"]
    assert result["removed by hand"] and (result["left"], result["kept"]) == ([], True)
    assert "is missing" in result["missing"]


def test_a_bake_without_images_says_how_to_get_them(blender, tmp_path):
    write_bake(tmp_path / "bake", **SMALL_CAST)
    script = tmp_path / "no_images.py"
    script.write_text(f"""
import bpy, sys
sys.path.insert(0, {str(ADDON)!r})
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
