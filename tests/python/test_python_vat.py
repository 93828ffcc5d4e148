# SPDX-License-Identifier: Apache-2.0
"""Vertex animation textures: pixels, read by OpenEXR's library, are the cast's points in each key of each clip."""
import io
import json
import struct
import sys
import zlib

import numpy
import pytest

import throng_io
from conftest import ROOT, chromium
from glb_reader import Glb
from posed_people import model_of, off
from three_page import MODULES, call, need_three, page_of, textures_page
from throng_io import cli
from throng_io.gltf import textures
from throng_io.gltf.vat import Layout
from throng_io.people import person
from throng_io.skinned import clips, members

LAYOUT = {"throng": 1, "simulation": {"duration": 2, "seed": 2},
          "roads": [{"id": "road", "centreline": [[0, 0], [16, 0]], "width": 6}],
          "flows": [{"id": "east", "from": "road:start", "to": "road:end", "count": 2, "end": 1}]}
OWN = [1, 2, 0]  # x, y, z in files of somebody's own
ALLOWED = {"float": 1e-4, "half": 6e-4, "png": 1e-4}  # m


@pytest.fixture(scope="module")
def written(throng, once, bodies):
    """(the bake, {kind of texture: folder})"""
    pytest.importorskip("OpenEXR", reason="OpenEXR is not installed")

    def make(folder):
        throng_io.bake(LAYOUT, folder / "bake", program=throng.binary)
        with pytest.MonkeyPatch.context() as patch:
            patch.setenv("THRONG_BODIES", str(bodies))
            for kind in ALLOWED:
                assert cli.main(["export-vat", str(folder / "bake"), "-o", str(folder / kind), "--members", "1",
                                 "--texture", kind, *([] if kind == "float" else ["--no-ground"])]) == 0
            assert cli.main(["export-gltf", str(folder / "bake"), "-o", str(folder / "glb.glb"), "--members", "1",
                             "--level", "far", "--no-ground"]) == 0

    folder = once("python-vat", make)
    return throng_io.Bake(folder / "bake"), {kind: folder / kind for kind in ALLOWED} | {"glb": folder / "glb.glb"}


def pixels_of(path, low=0.0, high=1.0):
    """Rows x columns x 3."""
    if path.suffix == ".exr":
        library = pytest.importorskip("OpenEXR")
        with library.File(str(path), separate_channels=True) as file:
            return numpy.stack([file.channels()[name].pixels for name in "RGB"], axis=-1).astype(float)
    data, place, packed = path.read_bytes(), 8, b""
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    while place < len(data):
        length, name = struct.unpack_from(">I4s", data, place)
        inside = data[place + 8:place + 8 + length]
        assert zlib.crc32(name + inside) == struct.unpack_from(">I", data, place + 8 + length)[0]
        if name == b"IHDR":
            columns, rows, bits, colours = struct.unpack_from(">IIBB", inside)
            assert (bits, colours) == (16, 2)
        packed += inside if name == b"IDAT" else b""
        place += 12 + length
    lines = numpy.frombuffer(zlib.decompress(packed), numpy.uint8).reshape(rows, 1 + 6 * columns)
    assert not lines[:, 0].any()
    shares = lines[:, 1:].copy().view(">u2").reshape(rows, columns, 3) / 65535.0
    return low + shares * (numpy.array(high) - low)


@pytest.mark.parametrize("kind", ALLOWED)
def test_pixels_are_points_of_the_cast(written, bodies, monkeypatch, kind):
    bake, folders = written
    monkeypatch.setenv("THRONG_BODIES", str(bodies))
    told = json.loads((folders[kind] / "crowd.json").read_text())
    member, = told["textures"]["members"].values()
    rest, weights, joints = model_of(bake, 0, members.bodies_of_library(), level=2)
    repertoire = members.repertoire_of(bake)
    every = {clip.name: clip for clip in clips.clips_of(repertoire, bake.fps)}
    assert set(every) == set(member["clips"]) == {clip["name"] for clip in told["clips"]}
    for clip in told["clips"]:
        files = member["clips"][clip["name"]]
        places = pixels_of(folders[kind] / files["position"], member["low"], member["high"])
        looks = pixels_of(folders[kind] / files["normal"], -1.0, numpy.ones(3))
        assert places.shape == looks.shape == (clip["keys"] * member["rows"], member["width"], 3)
        assert numpy.abs(numpy.linalg.norm(looks, axis=2) - 1).max() < 2e-3
        wanted = person.skinned(rest, weights, clips.poses_of_clip(every[clip["name"]], joints.poses, repertoire))
        for key in (0, clip["keys"] // 2, clip["keys"] - 1):
            assert off(places[key], wanted[key][:, OWN]) < ALLOWED[kind]
            assert numpy.abs(places[key].max(axis=0) - wanted[key][:, OWN].max(axis=0)).max() < ALLOWED[kind]


def test_meshes_tell_where_their_points_are(written):
    """At rest, vertices of the mesh are those of the texture: triangles have the sides that they have in a stand."""
    _, folders = written
    told = json.loads((folders["float"] / "crowd.json").read_text())
    (number, member), = told["textures"]["members"].items()
    glb = Glb(folders["float"] / told["members"][0]["file"])
    primitive, = glb.told["meshes"][0]["primitives"]
    places, points = (glb.accessor(primitive["attributes"][name]) for name in ("TEXCOORD_1", "POSITION"))
    assert number == "0" and len(points) == member["vertices"] == member["width"]
    column, row = (places * [member["width"], member["rows"]]).astype(int).T
    stand = pixels_of(folders["float"] / member["clips"]["idle"]["position"])[row, column]
    faces = glb.accessor(primitive["indices"]).reshape(-1, 3)
    sides = [numpy.linalg.norm(each[faces[:, 0]] - each[faces[:, 1]], axis=1) for each in (points, stand)]
    assert numpy.median(numpy.abs(sides[0] - sides[1])) < 0.005
    assert told["surroundings"] == "surroundings.glb" and not (folders["half"] / "surroundings.glb").exists()
    assert {"ground", "road"} <= set(Glb(folders["float"] / "surroundings.glb").named)
    colours = glb.accessor(primitive["attributes"]["COLOR_0"])
    assert set(colours[:, 3]) == {0.0, 1.0} and 0.1 < (colours[:, 3] == 0).mean() < 0.5


SHADE = """([source, texels, width, height, rows, keys, places, somebody]) => {
    const gl = document.createElement("canvas").getContext("webgl2"), program = gl.createProgram();
    const shader = (kind, text) => {
        const made = gl.createShader(kind);
        gl.shaderSource(made, text);
        gl.compileShader(made);
        if (!gl.getShaderParameter(made, gl.COMPILE_STATUS)) throw gl.getShaderInfoLog(made);
        gl.attachShader(program, made);
    };
    shader(gl.VERTEX_SHADER, source);
    shader(gl.FRAGMENT_SHADER, "#version 300 es\\nprecision highp float; out vec4 o; void main() {o = vec4(1.0);}");
    gl.transformFeedbackVaryings(program, ["gl_Position", "shown", "normal"], gl.INTERLEAVED_ATTRIBS);
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw gl.getProgramInfoLog(program);
    gl.useProgram(program);
    texels.forEach((values, unit) => {
        gl.activeTexture(gl.TEXTURE0 + unit);
        gl.bindTexture(gl.TEXTURE_2D, gl.createTexture());
        gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGB32F, width, height, 0, gl.RGB, gl.FLOAT, new Float32Array(values));
        for (const name of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER])
            gl.texParameteri(gl.TEXTURE_2D, name, gl.NEAREST);
    });
    const at = name => gl.getUniformLocation(program, name), input = name => gl.getAttribLocation(program, name);
    gl.uniform1i(at("positions"), 0);
    gl.uniform1i(at("normals"), 1);
    gl.uniform2i(at("shape"), width, rows);
    gl.uniform1i(at("keys"), keys);
    gl.uniformMatrix4fv(at("view_projection"), false, [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]);
    gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
    gl.bufferData(gl.ARRAY_BUFFER, new Float32Array(places), gl.STATIC_DRAW);
    gl.enableVertexAttribArray(input("texcoord_1"));
    gl.vertexAttribPointer(input("texcoord_1"), 2, gl.FLOAT, false, 0, 0);
    for (const [name, value] of Object.entries(somebody)) gl.vertexAttrib4f(input(name), ...value);
    const count = places.length / 2, out = gl.createBuffer(), found = new Float32Array(10 * count);
    gl.bindBufferBase(gl.TRANSFORM_FEEDBACK_BUFFER, 0, out);
    gl.bufferData(gl.TRANSFORM_FEEDBACK_BUFFER, found.byteLength, gl.STATIC_READ);
    gl.enable(gl.RASTERIZER_DISCARD);
    gl.beginTransformFeedback(gl.POINTS);
    gl.drawArrays(gl.POINTS, 0, count);
    gl.endTransformFeedback();
    gl.getBufferSubData(gl.TRANSFORM_FEEDBACK_BUFFER, 0, found);
    return Array.from(found);
}"""


def test_the_shader_of_the_docs_bends_people(written):
    """Between two keys, turned a quarter: who looked along +z looks along +x."""
    playwright = pytest.importorskip("playwright.sync_api", reason="playwright is not installed")
    if not chromium():
        pytest.skip("no Chromium here")
    page_of_docs = (ROOT / "docs" / "how-to" / "engines.md").read_text()
    lines = page_of_docs[page_of_docs.index("    #version 300 es"):].split("\n\n")[0].split("\n")
    folder = written[1]["float"]
    told = json.loads((folder / "crowd.json").read_text())
    member, = told["textures"]["members"].values()
    textures_of = [pixels_of(folder / member["clips"]["walk3"][kind]) for kind in ("position", "normal")]
    keys, width, place = 24, member["width"], [3.0, 0.5, -2.0]
    somebody = {"color_0": [0.1, 0.2, 0.3, 0.0], "place_heading": [*place, numpy.pi / 2],
                "top_phase": [0.5, 0.25, 0.75, 23.25 / keys]}
    with playwright.sync_playwright() as player:
        browser = player.chromium.launch(executable_path=chromium(), args=[
            "--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"])
        found = browser.new_page().evaluate(SHADE, [
            "\n".join(line[4:] for line in lines), [each.ravel().tolist() for each in textures_of], width,
            len(textures_of[0]), member["rows"], keys, Layout(member["vertices"]).places().ravel().tolist(), somebody])
        browser.close()
    found = numpy.array(found).reshape(-1, 10)
    own, looks = (0.75 * each[23] + 0.25 * each[0] for each in textures_of)
    assert numpy.abs(found[:, :3] - (own[:, [2, 1, 0]] * [1, 1, -1] + place)).max() < 1e-4
    assert (found[:, 4:7] == [0.5, 0.25, 0.75]).all()
    looks = looks / numpy.linalg.norm(looks, axis=1, keepdims=True)
    assert numpy.abs(found[:, 7:] - looks[:, [2, 1, 0]] * [1, 1, -1]).max() < 1e-4


def test_the_page_of_the_docs_shows_what_skeletons_do(written):
    """docs/examples/textures in a browser beside the same people as glTF with skeletons, which three.js bends itself:
    in pictures they cover the same pixels, and normals have them lit alike."""
    need_three(MODULES)
    playwright = pytest.importorskip("playwright.sync_api", reason="playwright is not installed")
    image = pytest.importorskip("PIL.Image", reason="Pillow is not installed")
    bake, folders = written
    shot = lambda page: numpy.array(image.open(io.BytesIO(page.screenshot())).convert("RGB"), float)  # noqa: E731
    frame = 36
    x, y, _ = bake.pos[frame, 0].tolist()
    view = [[x, 1.2, 3.4 - y], [x, 0.9, -y]]
    assert bake.there()[frame, 0] and bake.dir[frame, 0, 2] > 0.5  # walks
    with page_of(playwright, {"crowd": folders["glb"]}, MODULES) as page:
        call(page, "load", "crowd")
        call(page, "look", *view)
        call(page, "at", frame / bake.fps)
        call(page, "draw")
        assert page.wrong == []
        wanted = shot(page)
    with textures_page(playwright, folders["half"], MODULES) as page:
        page.evaluate("([from, to]) => window.crowd.look(from, to)", view)
        found = []
        for each in (frame, frame + 1, frame + 6):
            page.evaluate("seconds => window.crowd.draw(seconds)", each / bake.fps)
            found.append(shot(page))
        assert page.wrong == []
    shown = [numpy.abs(each - each[0, 0]).max(axis=2) > 12 for each in (wanted, *found)]
    assert 0.04 < shown[0].mean() < 0.5
    differ = (shown[0] != shown[1]).sum() / shown[0].sum()
    both = shown[0] & shown[1]
    off_by = numpy.abs(wanted - found[0]).max(axis=2)[both]
    assert differ < 0.02 and numpy.median(off_by) < 3 and (off_by > 30).mean() < 0.05, (differ, off_by)
    changes = [(each != shown[1]).sum() / shown[0].sum() for each in shown[2:]]
    assert 0.05 < changes[0] < 0.6 and changes[0] < 0.5 * changes[1], changes  # moves, without jumps


def test_wide_meshes_take_several_rows():
    layout = Layout(5000)
    assert (layout.width, layout.rows) == (4096, 2)
    values = numpy.arange(3 * 5000 * 3.0).reshape(3, 5000, 3)
    picture = layout.picture(values)
    assert picture.shape == (6, 4096, 3)
    column, row = (layout.places() * [4096, 2]).astype(int).T
    for key in range(3):
        assert (picture[2 * key + row, column] == values[key]).all()


def test_what_is_wrong_is_told(written, tmp_path, bodies, monkeypatch, capsys):
    bake = str(written[0].folder)
    monkeypatch.setenv("THRONG_BODIES", str(bodies))
    assert cli.main(["export-vat", bake, "-o", str(tmp_path / "vat"), "--seconds", "7", "8"]) == 3
    assert "the bake ends at" in capsys.readouterr().err
    monkeypatch.setitem(sys.modules, "OpenEXR", None)
    assert cli.main(["export-vat", bake, "-o", str(tmp_path / "vat")]) == 3
    assert 'OpenEXR is not installed\n  hint: python3 -m pip install "throng-io[textures]"' in capsys.readouterr().err
    monkeypatch.delenv("THRONG_BODIES")
    assert cli.main(["export-vat", bake, "-o", str(tmp_path / "vat"), "--texture", "png"]) == 3
    assert "library of bodies" in capsys.readouterr().err
    with pytest.raises(throng_io.ThrongError, match="expected one of float, half, png"):
        textures.check("jpeg")
    assert list(tmp_path.iterdir()) == []
