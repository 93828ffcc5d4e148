# SPDX-License-Identifier: Apache-2.0
"""Crowds as glTF: read by the specification, by the Khronos validator, and by three.js in a browser."""
import io
import json
import subprocess
import sys

import numpy
import pytest

import throng_io
from glb_reader import Glb, mixed, z_up
from posed_people import expected, frames_of, off
from three_page import MODULES, call, need_three, page_of
from throng_io import cli
from throng_io.base.errors import ThrongError
from throng_io.gltf import crowd as gltf_crowd
from throng_io.gltf import placements
from throng_io.skinned import members
from throng_io.skinned.shot import Wanted

LAYOUT = {"throng": 1, "simulation": {"duration": 4, "seed": 2},
          "walls": [{"id": "low", "points": [[3000, 5004], [3016, 5004]], "thickness": 0.4, "height": 1.0}],
          "roads": [{"id": "road", "centreline": [[3000, 5000], [3016, 5000]], "width": 6}],
          "flows": [{"id": "east", "from": "road:start", "to": "road:end", "count": 5, "end": 2},
                    {"id": "west", "from": "road:end", "to": "road:start", "count": 3, "end": 2}]}
MOST = 2
VALIDATE = """
const fs = require('fs'), validator = require(process.argv[1] + '/gltf-validator');
Promise.all(process.argv.slice(2).map(path => validator.validateBytes(new Uint8Array(fs.readFileSync(path)))))
    .then(reports => console.log(JSON.stringify(reports.map(report => report.issues))));
"""


@pytest.fixture(scope="module")
def files(throng, once, bodies):
    """(the bake, the folder of what is written of it)"""
    def make(folder):
        throng_io.bake(LAYOUT, folder / "bake", program=throng.binary, options=["--feet"])
        with pytest.MonkeyPatch.context() as patch:
            patch.setenv("THRONG_BODIES", str(bodies))
            for command, name, more in (
                    ("export-gltf", "crowd.glb", ["--most", MOST, "--level", "near", "--level", "far"]),
                    ("export-gltf", "short.glb", ["--most", MOST, "--quantize", "--others", "--seconds", 1.5, 3]),
                    ("export-kit", "kit", ["--most", MOST]),
                    ("export-kit", "short-kit", ["--most", 1, "--quantize", "--level", "middle"]),
                    ("export-vat", "vat", ["--most", 1, "--texture", "png"])):
                assert cli.main([command, str(folder / "bake"), "-o", str(folder / name), *map(str, more)]) == 0

    folder = once("python-gltf", make)
    return throng_io.Bake(folder / "bake"), folder


@pytest.fixture(scope="module")
def packed(files, once, bodies):
    pytest.importorskip("meshoptimizer", reason="meshoptimizer is not installed")

    def make(folder):
        with pytest.MonkeyPatch.context() as patch:
            patch.setenv("THRONG_BODIES", str(bodies))
            assert cli.main(["export-gltf", str(files[0].folder), "-o", str(folder / "packed.glb"), "--most", str(MOST),
                             "--quantize", "--compress", "--others", "--seconds", "1.5", "3"]) == 0

    return once("python-gltf-packed", make) / "packed.glb"


@pytest.fixture(scope="module")
def library(bodies):
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("THRONG_BODIES", str(bodies))
        return members.bodies_of_library()


def rows_of(glb):
    return {node["extras"]["row"]: number for number, node in enumerate(glb.told["nodes"])
            if node.get("name", "").startswith("person") and "row" in node.get("extras", {})}


def body_of(glb, row, level="_LOD0"):
    return glb.named[f"person {row:05d} body{level}"]


def test_people_are_bent_as_the_cast_is(files, library):
    bake, folder = files
    glb = Glb(folder / "crowd.glb")
    assert sorted(rows_of(glb)) == list(range(MOST))
    for row in rows_of(glb):
        for frame in frames_of(bake, row):
            pose = glb.sampled(glb.animation("crowd"), frame / bake.fps)
            found, whole = z_up(glb.skinned(body_of(glb, row), pose)), expected(bake, row, frame, library) - bake.origin
            assert off(found[::7], whole) < 1e-4
            assert numpy.abs(found.min(axis=0) - whole.min(axis=0)).max() < 1e-4
            assert numpy.abs(found.max(axis=0) - whole.max(axis=0)).max() < 1e-4


def test_short_numbers_are_near_enough(files, library):
    bake, folder = files
    glb = Glb(folder / "short.glb")
    for row in rows_of(glb):
        for frame in (36, 54, 72):
            if not bake.there()[frame, row]:
                continue
            pose = glb.sampled(glb.animation("crowd"), (frame - 36) / bake.fps)
            found = z_up(glb.skinned(body_of(glb, row, ""), pose))
            assert off(found[::7], expected(bake, row, frame, library) - bake.origin) < 3e-4
    whole, shorter = (len(Glb(folder / name).binary) for name in ("crowd.glb", "short.glb"))
    assert shorter < whole


def test_everybody_is_where_they_are_and_when(files):
    bake, folder = files
    glb = Glb(folder / "crowd.glb")
    for frame in range(bake.frames):
        pose = glb.sampled(glb.animation("crowd"), frame / bake.fps)
        for row, node in rows_of(glb).items():
            place = glb.place_of(node, pose)
            if not bake.there()[frame, row]:
                assert not place[:3, :3].any()
                continue
            assert numpy.abs(z_up(place[None, :3, 3])[0] - bake.pos[frame, row]).max() < 1e-4
            assert numpy.abs(z_up(place[None, :3, 2])[0, :2] - bake.dir[frame, row, :2]).max() < 1e-4  # looks along z


def test_meshes_are_shared_and_have_levels(files):
    bake, folder = files
    glb = Glb(folder / "crowd.glb")
    node = glb.told["nodes"][body_of(glb, 0)]
    coarser, = node["extensions"]["MSFT_lod"]["ids"]
    assert glb.told["nodes"][coarser]["name"].endswith("_LOD2") and glb.told["nodes"][coarser]["skin"] == node["skin"]
    assert coarser not in glb.told["scenes"][0]["nodes"]
    near, far = (len(glb.skinned(each, {})) for each in (body_of(glb, 0), coarser))
    assert near > 4 * far > 400
    whose = {row: glb.told["nodes"][root]["extras"]["member"] for row, root in rows_of(glb).items()}
    assert whose == {row: members.cast_of(bake)[1][row] for row in range(MOST)}


def test_others_stand_where_they_are_in_the_first_frame(files):
    bake, folder = files
    glb, frame = Glb(folder / "short.glb"), 36
    found = {}
    for node in glb.told["nodes"]:
        told = node.get("extensions", {}).get("EXT_mesh_gpu_instancing")
        if told:
            points = numpy.concatenate([glb.accessor(primitive["attributes"]["POSITION"]) for primitive in
                                        glb.told["meshes"][node["mesh"]]["primitives"]])
            moves, turns, sizes = (glb.accessor(told["attributes"][name]) for name in
                                   ("TRANSLATION", "ROTATION", "SCALE"))
            assert numpy.abs(turns[:, [0, 2]]).max() == 0
            for row, move, turn, size in zip(node["extras"]["rows"], moves, turns, sizes, strict=True):
                angle = 2 * numpy.arctan2(turn[1], turn[3])
                cosine, sine = numpy.cos(angle), numpy.sin(angle)
                found[row] = (points * size) @ numpy.array([[cosine, 0, -sine], [0, 1, 0], [sine, 0, cosine]]) + move
    assert set(found) == set(numpy.nonzero(bake.there()[frame])[0].tolist()) - set(range(MOST)) != set()
    for row, points in found.items():
        points = z_up(points) - bake.pos[frame, row]
        assert -0.1 < points[:, 2].min() < 0.05 and 1.0 < points[:, 2].max() < 2.1
        assert numpy.abs(points[:, :2]).max() < 1.0 and numpy.abs(points[:, :2].mean(axis=0)).max() < 0.25


def kit_pose(glb, record, clips):
    """As docs/how-to/engines.md tells to blend clips."""
    def clip(number, phase):
        return glb.sampled(glb.animation(clips[number]["name"]), phase / 65536 * clips[number]["seconds"])

    def blend(one, other, share):
        rest = lambda key: numpy.array(glb.told["nodes"][key[0]].get(key[1], [0, 0, 0]), float)  # noqa: E731
        return {key: mixed(one[key] if key in one else rest(key), other[key] if key in other else rest(key), share,
                           key[1]) for key in {*one, *other}}

    walk = blend(clip(record["walk"], record["phase"]), clip(record["before"], record["phase"]), record["left"] / 255)
    return blend(clip(record["stand"], record["stand_phase"]), walk, record["walking"] / 255)


def test_kits_give_people_again(files, library):
    bake, folder = files
    told = json.loads((folder / "kit" / "crowd.json").read_text())
    kind = numpy.dtype({"names": [field["name"] for field in told["records"]["fields"]],
                        "offsets": [field["offset"] for field in told["records"]["fields"]],
                        "formats": [(field["type"], (field["count"],)) if field["count"] > 1 else field["type"]
                                    for field in told["records"]["fields"]],
                        "itemsize": told["records"]["bytes"]})
    records = numpy.fromfile(folder / "kit" / "crowd.bin", kind).reshape(told["frames"], len(told["people"]))
    assert kind == placements.RECORD and told["frames"] == bake.frames
    assert (records["there"] == bake.there()[:, :MOST]).all()
    files_of = {each["member"]: each["file"] for each in told["members"]}
    for place, somebody in enumerate(told["people"]):
        glb, row = Glb(folder / "kit" / files_of[somebody["member"]]), somebody["row"]
        for frame in frames_of(bake, row):
            record = records[frame, place]
            points = z_up(glb.skinned(glb.named[f"member{somebody['member']:02d}_LOD0"],
                                      kit_pose(glb, record, told["clips"])))
            angle = record["heading"] / 65536 * 2 * numpy.pi
            points = points @ numpy.array([[numpy.cos(angle), numpy.sin(angle), 0],
                                           [-numpy.sin(angle), numpy.cos(angle), 0], [0, 0, 1]])
            points = points + z_up(record["place"][None].astype(float))
            whole = expected(bake, row, frame, library, False) - bake.origin
            assert off(points[::7], whole) < 0.006


def test_the_validator_finds_nothing(files, request):
    if not (MODULES / "gltf-validator").is_dir():
        pytest.skip("the npm package gltf-validator is not installed")
    _, folder = files
    paths = [folder / "crowd.glb", folder / "short.glb", *sorted(folder.glob("*/members/*.glb")),
             *(folder / "vat").glob("*.glb"), folder / "kit" / "surroundings.glb"]
    assert len(paths) == 2 + MOST + 4
    try:
        paths.append(request.getfixturevalue("packed"))
    except pytest.skip.Exception:
        pass
    result = subprocess.run(["node", "-e", VALIDATE, str(MODULES), *map(str, paths)], capture_output=True, text=True,
                            check=True)
    for path, issues in zip(paths, json.loads(result.stdout), strict=True):
        assert (issues["numErrors"], issues["numWarnings"]) == (0, 0), (path, issues["messages"][:5])


def test_they_walk_in_three_js(files, library):
    """Of people whom another engine shows, points are where they should be, and pictures show that they move."""
    need_three(MODULES)
    playwright = pytest.importorskip("playwright.sync_api", reason="playwright is not installed")
    image = pytest.importorskip("PIL.Image", reason="Pillow is not installed")
    bake, folder = files
    row, later = 0, frames_of(bake, 0)[2]
    place = bake.pos[later, row].tolist()
    with page_of(playwright, {"crowd": folder / "crowd.glb"}, MODULES) as page:
        assert call(page, "load", "crowd") == ["crowd"]
        call(page, "look", [place[0], 1.6, -place[1] + 3.5], [place[0], 0.9, -place[1]])
        pictures = []
        for frame in (later, later + 6):
            call(page, "at", frame / bake.fps)
            assert call(page, "draw") > 3000
            found = z_up(numpy.array(call(page, "points", f"person_{row:05d}_body_LOD0")))
            assert off(found[::7], expected(bake, row, frame, library) - bake.origin) < 1e-4
            pictures.append(numpy.array(image.open(io.BytesIO(page.screenshot())).convert("RGB"), int))
        assert page.wrong == []
    changed = numpy.abs(pictures[0] - pictures[1]).max(axis=2) > 40
    assert 0.002 < changed.mean() < 0.3


def test_packed_files_are_what_others_unpack(files, packed):
    """By three.js, whose decoder is not what packs them here."""
    need_three(MODULES)
    playwright = pytest.importorskip("playwright.sync_api", reason="playwright is not installed")
    _, folder = files
    glb, found = Glb(folder / "short.glb"), []
    assert packed.stat().st_size < 0.7 * (folder / "short.glb").stat().st_size
    with page_of(playwright, {"short": folder / "short.glb", "packed": packed}, MODULES) as page:
        for name in ("short", "packed"):
            call(page, "load", name)
            call(page, "at", 0.5)
            found.append([numpy.array(call(page, "points", f"person_{row:05d}_body")) for row in rows_of(glb)]
                         + [numpy.array(call(page, "instances"))])
        assert page.wrong == []
    assert all(len(one) and numpy.array_equal(one, other) for one, other in zip(*found, strict=True))


def test_what_is_wrong_is_told_in_one_line(files, tmp_path, bodies, monkeypatch, capsys):
    bake = str(files[0].folder)
    monkeypatch.setenv("THRONG_BODIES", str(bodies))
    (tmp_path / "full").mkdir()
    (tmp_path / "full" / "note").touch()
    there = sorted(tmp_path.rglob("*"))
    for command, output, more, told in (
            ("export-gltf", "crowd.gltf", [], "ends in .glb"),
            ("export-gltf", "crowd.glb", ["--seconds", "9", "12"], "the bake ends at"),
            ("export-gltf", "crowd.glb", ["--seconds", "3", "3"], "the first before the second"),
            ("export-gltf", "crowd.glb", ["--members", "65"], "members: expected 1 to 64"),
            ("export-kit", "full", [], "is there already"),
            ("export-kit", "no/kit", [], "cannot be written")):
        assert cli.main([command, bake, "-o", str(tmp_path / output), *more]) == 3
        assert told in capsys.readouterr().err
    monkeypatch.setitem(sys.modules, "meshoptimizer", None)
    assert cli.main(["export-gltf", bake, "-o", str(tmp_path / "crowd.glb"), "--compress"]) == 3
    assert ('meshoptimizer is not installed\n  hint: python3 -m pip install "throng-io[meshopt]"'
            in capsys.readouterr().err)
    monkeypatch.delenv("THRONG_BODIES")
    for command in ("export-gltf", "export-kit"):
        assert cli.main([command, bake, "-o", str(tmp_path / "crowd.glb")]) == 3
        assert "library of bodies" in capsys.readouterr().err
    with pytest.raises(ThrongError, match="level: expected one of near, middle, far"):
        gltf_crowd.export_gltf(throng_io.Bake(bake), tmp_path / "crowd.glb", form=gltf_crowd.Form(("nearest",)))
    assert sorted(tmp_path.rglob("*")) == there


def test_files_end_where_they_would_be_too_large(files, tmp_path, bodies, monkeypatch, capsys):
    monkeypatch.setenv("THRONG_BODIES", str(bodies))
    monkeypatch.setattr(gltf_crowd, "MOST_BYTES", 110_000)
    assert cli.main(["export-gltf", str(files[0].folder), "-o", str(tmp_path / "crowd.glb"), "--seconds", "2", "3",
                     "--members", "1", "--level", "far"]) == 0
    glb, told = Glb(tmp_path / "crowd.glb"), capsys.readouterr().err
    assert 1 <= len(rows_of(glb)) < 8 and "are left out: --most N takes more" in told
    assert (tmp_path / "crowd.glb").stat().st_size < 300_000
    gltf_crowd.export_gltf(files[0], tmp_path / "all.glb", Wanted(8, seconds=(2.0, 3.0), members=1),
                           gltf_crowd.Form(("far",)))
    assert len(rows_of(Glb(tmp_path / "all.glb"))) > len(rows_of(glb))
