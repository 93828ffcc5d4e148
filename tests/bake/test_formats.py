# SPDX-License-Identifier: Apache-2.0
"""The written files through other people's readers: Khronos' validator, Blender, OpenImageIO, OpenEXR."""
import json
import shutil
import subprocess

import numpy
import pytest

from conftest import ROOT, khronos_issues


def test_crowd_glb_has_no_errors_in_the_khronos_validator(bakes):
    issues = khronos_issues(bakes("intersection") / "crowd.glb")
    assert issues["numErrors"] == 0, issues["messages"][:5]
    assert issues["numWarnings"] == 0, issues["messages"][:5]


def test_crowd_glb_imports_in_blender_where_the_people_are(bakes, blender, tmp_path):
    """The station's: what Blender takes to read a file grows with the people in it."""
    script = tmp_path / "gltf.py"
    script.write_text("""
import bpy, json, sys
import numpy
numpy.bool = bool  # Blender 3.4's importer still uses the name
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.context.scene.render.fps = 24
bpy.ops.import_scene.gltf(filepath=sys.argv[-2])
found = []
for frame in json.loads(sys.argv[-1]):
    bpy.context.scene.frame_set(frame)  # glTF time 0 is Blender frame 0
    depsgraph = bpy.context.evaluated_depsgraph_get()
    objects = [o.evaluated_get(depsgraph) for o in bpy.data.objects if o.animation_data]
    found.append([[*o.matrix_world.translation, o.matrix_world.to_scale()[0]] for o in objects])
print('RESULT ' + json.dumps(found))
""")
    bake, frames = bakes("station"), [240, 720, 1200]
    output = blender(script, bake / "crowd.glb", json.dumps(frames))
    shots = json.loads(next(line for line in output.splitlines() if line.startswith("RESULT"))[7:])
    positions = numpy.load(bake / "streams" / "pos.npy", mmap_mode="r")
    states = numpy.load(bake / "streams" / "state.npy", mmap_mode="r")
    for frame, objects in zip(frames, shots, strict=True):
        expected = positions[frame][states[frame, :, 0] > 0.5][:, :2]
        found = numpy.array([[x, y] for x, y, _, scale in objects if scale > 0.5])
        assert len(expected) > 20 and abs(len(found) - len(expected)) <= 0.02 * len(expected)
        nearest = numpy.array([numpy.hypot(*(expected - point).T).min() for point in found])
        assert numpy.percentile(nearest, 99) < 0.02, "metres"


def test_diagram_ids_agree_with_the_positions(bakes):
    if not shutil.which("oiiotool"):
        pytest.skip("oiiotool is not installed")
    bake = bakes("intersection")
    images = sorted((bake / "diagrams").glob("diagram.*.exr"))
    assert [path.name for path in images][:2] == ["diagram.0001.exr", "diagram.0481.exr"]
    for path in images:
        stats = subprocess.run(["oiiotool", "--stats", str(path)], capture_output=True, text=True)
        assert stats.returncode == 0, stats.stderr
    text = subprocess.run(["oiiotool", "--info", "-v", str(images[1])], capture_output=True, text=True).stdout
    for word in ("id", "kind", "distance", "framesPerSecond", "throng"):
        assert word in text


def test_diagrams_read_by_the_openexr_library_show_who_stands_where(throng, tmp_path, manifest_of):
    OpenEXR = pytest.importorskip("OpenEXR")
    bake = tmp_path / "bake"
    # Images show what is simulated: here the streams do, too.
    throng("bake", ROOT / "examples" / "intersection.json", "-o", bake, "-q", "--no-gltf", "--diagrams", "240", "--set",
           "simulation.smoothing=0", "--set", "simulation.duration=21")
    manifest = manifest_of(bake)
    position = numpy.load(bake / "streams" / "pos.npy", mmap_mode="r")
    state = numpy.load(bake / "streams" / "state.npy", mmap_mode="r")
    seen = 0
    for frame in (240, 480):
        with OpenEXR.File(str(bake / "diagrams" / f"diagram.{frame + 1:04d}.exr"), separate_channels=True) as file:
            channels = {name: channel.pixels for name, channel in file.channels().items()}
        ids, kind, distance = channels["id"], channels["kind"], channels["distance"]
        assert ids.dtype == numpy.uint32 and kind.dtype == numpy.uint32 and distance.dtype == numpy.float32
        assert set(numpy.unique(kind)) <= {0, 1, 2} and (ids[kind == 0] == 0xFFFFFFFF).all() \
            and (distance[kind == 0] == -1).all()
        height = ids.shape[0]
        low, scale = numpy.array(manifest["diagrams"]["min"]), manifest["diagrams"]["pixels_per_metre"]
        # Every owned pixel: its distance is that of its centre from its owner, who is the nearest person alive.
        rows, columns = numpy.nonzero(kind == 1)
        centres = low + (numpy.stack([columns, height - 1 - rows], axis=1) + 0.5) / scale
        owners = ids[rows, columns]
        assert (state[frame, owners, 0] > 0.5).all()
        measured = numpy.hypot(*(centres - position[frame, owners, :2]).T)
        assert numpy.abs(measured - distance[rows, columns]).max() < 1e-3
        alive = position[frame, state[frame, :, 0] > 0.5, :2]
        for index in range(0, len(rows), 97):
            assert measured[index] <= numpy.hypot(*(alive - centres[index]).T).min() + 1e-3
            seen += 1
        assert (kind == 2).any()
    assert seen > 100
