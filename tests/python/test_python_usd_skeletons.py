# SPDX-License-Identifier: Apache-2.0
"""Crowds with skeletons, read back by USD's own library: whom instances share, how people are bent, where, and when."""
import os
import shutil
import subprocess
import sys
import textwrap

import numpy
import pytest

import throng_io
from conftest import ROOT, blender_module
from posed_people import expected, frames_of, off
from usd_people import PROXIES, joints_of, people_of, skeleton_of
from throng_io import cli
from throng_io.cast import BEATS, POSES, Repertoire, gait
from throng_io.skinned import members, motions

Usd = pytest.importorskip("pxr.Usd", reason="usd-core is not installed")
UsdGeom = pytest.importorskip("pxr.UsdGeom")
UsdSkel = pytest.importorskip("pxr.UsdSkel")

LAYOUT = {"throng": 1, "simulation": {"duration": 4, "seed": 2},
          "roads": [{"id": "road", "centreline": [[3000, 5000], [3016, 5000]], "width": 6}],
          "flows": [{"id": "east", "from": "road:start", "to": "road:end", "count": 5, "end": 2},
                    {"id": "west", "from": "road:end", "to": "road:start", "count": 3, "end": 2}]}
MOST = 3


@pytest.fixture(scope="module")
def crowd(throng, once, bodies):
    """The bake, its stage, and that with copies."""
    def make(folder):
        throng_io.bake(LAYOUT, folder / "bake", program=throng.binary, options=["--feet"])
        with pytest.MonkeyPatch.context() as patch:
            patch.setenv("THRONG_BODIES", str(bodies))
            for name, more in (("crowd", []), ("copies", ["--copies"])):
                assert cli.main(["export-usd", str(folder / "bake"), "-o", str(folder / f"{name}.usdc"), "--skeletons",
                                 "--most", str(MOST), *more]) == 0

    folder = once("python-usd-skeletons", make)
    return throng_io.Bake(folder / "bake"), *(Usd.Stage.Open(str(folder / f"{name}.usdc"))
                                              for name in ("crowd", "copies"))


def skinned(prim, time):
    """{part: points in the world} of a person, by USD's library."""
    root, binding, query = skeleton_of(prim)
    bends, found = query.ComputeSkinningTransforms(time), {}
    place = numpy.array(UsdGeom.XformCache(time).GetLocalToWorldTransform(root.GetPrim()))
    for target in binding.GetSkinningTargets():
        points = UsdGeom.Mesh(target.GetPrim()).GetPointsAttr().Get()
        assert target.ComputeSkinnedPoints(bends, points, time)
        found[target.GetPrim().GetName()] = numpy.array(points, float) @ place[:3, :3] + place[3, :3]
    return found


def test_people_are_bent_as_the_cast_is(crowd, bodies, monkeypatch):
    bake, *stages = crowd
    monkeypatch.setenv("THRONG_BODIES", str(bodies))
    library = members.bodies_of_library()
    for stage, most in zip(stages, (MOST, 1)):
        for row, prim in list(people_of(stage).items())[:most]:
            for frame in frames_of(bake, row):
                parts = skinned(prim, frame + 1)
                assert set(parts) == {"dressed", "tinted"}
                whole = expected(bake, row, frame, library)
                assert max(off(part[::9], whole) for part in parts.values()) < 1e-4
                assert sum(map(len, parts.values())) == len(whole)
                both = numpy.concatenate(list(parts.values()))
                assert numpy.abs(both.min(axis=0) - whole.min(axis=0)).max() < 1e-4
                assert numpy.abs(both.max(axis=0) - whole.max(axis=0)).max() < 1e-4


def test_everybody_is_where_they_are_and_when(crowd):
    bake, stage, _ = crowd
    assert len(people_of(stage)) == MOST
    for row, prim in people_of(stage).items():
        there = bake.there()[:, row]
        for frame in range(bake.frames):
            shown = UsdGeom.Imageable(prim).ComputeVisibility(frame + 1) == "inherited"
            assert shown == there[frame]
            if shown:
                place = UsdGeom.XformCache(frame + 1).GetLocalToWorldTransform(prim)
                assert numpy.abs(numpy.array(place.ExtractTranslation()) - bake.world(frame, row)).max() < 1e-4
                assert numpy.abs(numpy.array(place)[0, :2] - bake.dir[frame, row, :2]).max() < 1e-4


def test_members_are_shared_and_have_levels(crowd):
    bake, stage, _ = crowd
    _, member_of = members.cast_of(bake)
    people = people_of(stage)
    assert len(stage.GetPrototypes()) == len({member_of[row] for row in people})
    figure = people[0].GetChild("figure")
    assert figure.IsInstance()
    levels, sizes = figure.GetVariantSets().GetVariantSet("levelOfDetail"), []
    assert levels.GetVariantSelection() == "near"
    assert set(levels.GetVariantNames()) == {"near", "middle", "far"}
    session = Usd.EditContext(stage, stage.GetSessionLayer())
    with session:
        for name in members.LEVELS:
            levels.SetVariantSelection(name)
            sizes.append(sum(map(len, skinned(people[0], bake.frames // 2).values())))
        levels.ClearVariantSelection()
    assert sizes[0] > 1.3 * sizes[1] > 2 * sizes[2] > 200


def test_who_somebody_is_can_be_changed(crowd):
    """Another variant of `member`: another mesh, with the same motion, still an instance that is shared."""
    bake, stage, _ = crowd
    people, row, time = people_of(stage), 0, bake.frames // 2
    figure = people[row].GetChild("figure")
    choice = figure.GetVariantSets().GetVariantSet("member")
    _, member_of = members.cast_of(bake)
    own = f"member{member_of[row]:02d}"
    other = next(f"member{member_of[each]:02d}" for each in people if member_of[each] != member_of[row])
    assert choice.GetVariantSelection() == own and {own, other} <= set(choice.GetVariantNames())
    before, joints, shared = skinned(people[row], time), joints_of(people[row], [time]), len(stage.GetPrototypes())
    with Usd.EditContext(stage, stage.GetSessionLayer()):
        choice.SetVariantSelection(other)
        after, still = skinned(people[row], time), joints_of(people[row], [time])
        assert figure.IsInstance() and len(stage.GetPrototypes()) == shared - 1  # the other one has it, too
        figure.GetVariantSets().GetVariantSet("levelOfDetail").SetVariantSelection("far")
        assert sum(map(len, skinned(people[row], time).values())) < sum(map(len, after.values())) / 3
        figure.GetVariantSets().GetVariantSet("levelOfDetail").ClearVariantSelection()
        choice.ClearVariantSelection()
    assert {name: len(part) for name, part in before.items()} != {name: len(part) for name, part in after.items()}
    for name in set(joints) & set(still):
        assert numpy.abs(joints[name] - still[name]).max() < 1e-6  # the same motion
    points = numpy.concatenate(list(after.values()))
    assert -0.1 < points[:, 2].min() < 0.1 and 1.2 < points[:, 2].max() < 2.1
    assert numpy.linalg.norm(points[:, :2].mean(axis=0) - bake.world(time, row)[:2]) < 0.3
    assert skinned(people[row], time)["dressed"] == pytest.approx(before["dressed"])


def test_a_layer_above_changes_people_as_the_page_says(crowd, tmp_path):
    """Another person in a red top, still an instance; nobody else is touched."""
    bake, stage, _ = crowd
    row, (_, member_of) = 0, members.cast_of(bake)
    other = next(f"member{member_of[each]:02d}" for each in people_of(stage) if member_of[each] != member_of[row])
    page = (ROOT / "docs/python.md").read_text("utf-8")
    layer = textwrap.dedent(page[page.index("    #usda 1.0"):page.index("There is no variant set of tints")])
    for told, here in (("street.usdc", stage.GetRootLayer().realPath), ("person00012", f"person{row:05d}"),
                       ("member24", other)):
        assert layer.count(told) == 1
        layer = layer.replace(told, here)
    (tmp_path / "shot.usda").write_text(layer)
    shot = Usd.Stage.Open(str(tmp_path / "shot.usda"))

    def seen(of, each):
        figure = of.GetPrimAtPath(f"/World/Crowd/person{each:05d}/figure")
        assert figure.IsInstance()
        tint = UsdGeom.PrimvarsAPI(figure.GetChild("tinted")).FindPrimvarWithInheritance("displayColor").Get()
        return figure.GetVariantSets().GetVariantSelection("member"), tuple(tint[0])

    assert seen(shot, row) == (other, pytest.approx((0.55, 0.02, 0.02)))
    for each in people_of(stage):
        assert each == row or seen(shot, each) == seen(stage, each)


def test_four_weights_names_and_tints(crowd):
    bake, stage, copies = crowd
    for row, prim in people_of(stage).items():
        figure = prim.GetChild("figure")
        primvars = UsdGeom.PrimvarsAPI(figure)
        assert primvars.GetPrimvar("personId").Get() == row
        assert primvars.GetPrimvar("crypto_object").Get() == f"{bake.name}/{row:05d}"
        tint = primvars.GetPrimvar("displayColor").Get()[0]
        tinted = figure.GetChild("tinted")
        assert UsdGeom.PrimvarsAPI(tinted).FindPrimvarWithInheritance("displayColor").Get()[0] == tint
        own = UsdGeom.PrimvarsAPI(people_of(copies)[row].GetChild("figure").GetChild("tinted"))
        assert own.GetPrimvar("displayColor").Get()[0] == tint
        joints = UsdSkel.Skeleton(figure.GetChild("skeleton")).GetJointsAttr().Get()
        assert {"pelvis/spine_01/spine_02/spine_03/neck_01/head", "pelvis/thigh_l/calf_l/foot_l/ball_l"} < set(joints)
        mesh = UsdGeom.Mesh(figure.GetChild("dressed"))
        binding, points = UsdSkel.BindingAPI(mesh.GetPrim()), len(mesh.GetPointsAttr().Get())
        assert binding.GetJointIndicesPrimvar().GetElementSize() == 4
        assert len(binding.GetJointIndicesAttr().Get()) == 4 * points
        weights = numpy.array(binding.GetJointWeightsAttr().Get()).reshape(-1, 4)
        assert numpy.abs(weights.sum(axis=1) - 1).max() < 1e-6


def test_boxes_hold_who_is_in_them(crowd):
    bake, stage, _ = crowd
    low, high = UsdGeom.ModelAPI(stage.GetPrimAtPath("/World/Crowd")).GetExtentsHint()
    for row, prim in people_of(stage).items():
        for frame in frames_of(bake, row):
            boxes = UsdGeom.BBoxCache(frame + 1, [UsdGeom.Tokens.default_])
            box = boxes.ComputeWorldBound(prim).ComputeAlignedRange()
            points = numpy.concatenate(list(skinned(prim, frame + 1).values()))
            assert (points >= numpy.array(box.GetMin()) - 1e-4).all()
            assert (points <= numpy.array(box.GetMax()) + 1e-4).all()
            assert (numpy.array(box.GetSize()) < 3.0).all()
            points = points - bake.origin
            assert (points >= numpy.array(low)).all() and (points <= numpy.array(high)).all()


def test_usds_validators_find_nothing(crowd):
    try:
        from_library = pytest.importorskip("pxr.UsdValidation", reason="this USD has no validators")
        validators = from_library.ValidationRegistry().GetOrLoadAllValidators()
        found = [error.GetMessage() for stage in crowd[1:]
                 for error in from_library.ValidationContext(validators).Validate(stage)]
    except AttributeError:
        pytest.skip("this USD's validators are of another form")
    assert len(validators) > 10 and found == []


def test_without_a_library_nothing_is_written(crowd, tmp_path, monkeypatch, capsys):
    bake, output = str(crowd[0].folder), tmp_path / "crowd.usdc"
    monkeypatch.delenv("THRONG_BODIES", raising=False)
    for named, told in ((None, "library of bodies"), (str(tmp_path / "none.npz"), "cannot be read"),
                        (str(ROOT / "README.md"), "README.md")):
        if named:
            monkeypatch.setenv("THRONG_BODIES", named)
        assert cli.main(["export-usd", bake, "-o", str(output), "--skeletons"]) == 3
        assert told in capsys.readouterr().err
    assert cli.main(["export-usd", bake, "-o", str(output), "--most", "3"]) == 3
    assert "add --skeletons" in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == []


# ---- how poses are chosen and blended: by numbers, without a library

REPERTOIRE = Repertoire((0.7, 1.4))
FLAT = numpy.concatenate([numpy.tile(numpy.eye(3), (REPERTOIRE.count, 1, 1, 1)),
                          numpy.arange(REPERTOIRE.count * 3.0).reshape(-1, 1, 3, 1) // 3], axis=-1)  # number as place


def pose_at(state, phase=0.0, walking=1.0, row=0, time=0.0):
    track = motions.Track(row, numpy.array([time]), numpy.array([[state, 0.0, phase]]), numpy.array([0.0]),
                          numpy.array([[walking, 0.0, 0.0]]))
    return motions.matrices_of(FLAT, REPERTOIRE, track)[0, 0, 0, 3]


def test_walks_go_from_pose_to_pose():
    assert pose_at(1.0, 5 / POSES + 1e-9) == pytest.approx(5)
    assert pose_at(1.0, 5.25 / POSES) == pytest.approx(5.25)
    assert pose_at(1.0, 23.5 / POSES) == pytest.approx(0.5 * 23)  # the cycle closes
    assert pose_at(1 + 1 / 16, 5.25 / POSES) == pytest.approx(POSES + 5.25, abs=1e-3)
    # half of the gait before is left
    assert pose_at(1 + (1 + 0.5 / 32) / 16, 5.25 / POSES) == pytest.approx(0.5 * POSES + 5.25, abs=0.1)
    assert pose_at(1.0, 0.0, walking=0.5) == pytest.approx(0.5 * 2 * POSES, abs=1)


def test_who_stands_changes_from_beat_to_beat():
    first = 2 * POSES
    assert pose_at(3.0, walking=0.0) == pytest.approx(first)
    assert pose_at(2.0, walking=0.0, row=2, time=-2 * 0.618034 * 80) == pytest.approx(first + 2 * BEATS)  # talks
    assert pose_at(3.0, walking=0.0, row=2, time=-2 * 0.618034 * 80) == pytest.approx(first)  # shifts the weight
    assert pose_at(3.0, walking=0.0, time=80 / BEATS * 1.6) == pytest.approx(first + 1)
    assert pose_at(3.0, walking=0.0, time=80 / BEATS * 1.835) == pytest.approx(first + 1.5)
    assert len(gait.STANDING_CLIPS) == 4


def test_speeds_tell_where_no_stream_does():
    track = motions.Track(0, numpy.zeros(3), numpy.tile([1.0, 0, 3 / POSES + 1e-9], (3, 1)),
                          numpy.array([0.02, 0.19, 0.5]), None)
    places = motions.matrices_of(FLAT, REPERTOIRE, track)[:, 0, 0, 3]
    assert places == pytest.approx([2 * POSES, POSES + 1.5, 3])


def test_joints_beside_those_above_give_the_same_again():
    draw = numpy.random.default_rng(3)
    turns = numpy.linalg.qr(draw.normal(size=(40, 3, 3, 3)))[0]
    turns *= numpy.sign(numpy.linalg.det(turns))[..., None, None]
    turns[0, 0], turns[0, 1], turns[0, 2] = numpy.diag([1, -1, -1]), numpy.diag([-1, 1, -1]), numpy.diag([-1, -1, 1])
    matrices = numpy.concatenate([turns, draw.normal(size=(40, 3, 3, 1))], axis=-1)
    places, parents = draw.normal(size=(3, 3)), [-1, 0, 1]
    joints = motions.joints_of(matrices, places, parents)
    x, y, z, w = numpy.moveaxis(joints.rotations, -1, 0)
    local = numpy.stack([1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w),
                         2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w),
                         2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)], -1).reshape(40, 3, 3, 3)
    turn, place = numpy.tile(numpy.eye(3), (40, 1, 1)), numpy.zeros((40, 3))
    for joint in range(3):
        place = place + numpy.einsum("fab,fb->fa", turn, joints.translations[:, joint])
        turn = turn @ local[:, joint]
        assert numpy.abs(turn - turns[:, joint]).max() < 1e-9
        assert numpy.abs(place - (turns[:, joint] @ places[joint] + matrices[:, joint, :, 3])).max() < 1e-9
    assert (numpy.einsum("fjk,fjk->fj", joints.rotations[1:], joints.rotations[:-1]) >= 0).all()


def test_shared_modules_are_the_add_ons_own():
    """Links, to files that need no Blender."""
    package = ROOT / "python" / "src" / "throng_io"
    links = [path for folder in ("people", "cast") for path in sorted((package / folder).glob("*.py"))]
    assert len(links) > 20
    for path in links:
        assert os.path.islink(path) and "import bpy" not in path.read_text()
        assert path.resolve() == ROOT / "blender_addon" / "throng" / path.parent.name / path.name


def test_packages_hold_files_and_no_links(tmp_path):
    """Source packages, and what wheels are made of."""
    pytest.importorskip("setuptools", reason="setuptools is not installed")
    for folder in ("python", "blender_addon"):
        shutil.copytree(ROOT / folder, tmp_path / folder, symlinks=True, ignore=shutil.ignore_patterns("__pycache__"))
    script = ("import setuptools\nsetuptools.setup(script_args=['sdist', '-q', '-d', '../source', "
              "'build_py', '-q', '-d', '../built'])")
    subprocess.run([sys.executable, "-c", script], cwd=tmp_path / "python", check=True, capture_output=True)
    source, = (tmp_path / "source").iterdir()
    shutil.unpack_archive(source, tmp_path / "source")
    unpacked, = (each for each in (tmp_path / "source").iterdir() if each.is_dir())
    for package in (unpacked / "src" / "throng_io", tmp_path / "built" / "throng_io"):
        for name in ("people/person.py", "people/rig.py", "cast/gait.py"):
            assert not (package / name).is_symlink()
            assert (package / name).read_bytes() == (ROOT / "blender_addon" / "throng" / name).read_bytes()
        assert not (package / "people" / "materials.py").exists()


def test_blenders_picture_of_it_is_that_of_the_bake(throng, tmp_path, bodies, monkeypatch):
    """Whom a camera sees in Blender, pixel by pixel: the bake as the add-on shows it, and what USD's import makes."""
    layout = {"throng": 1, "simulation": {"duration": 6, "seed": 2},
              "roads": [{"id": "road", "centreline": [[0, 0], [16, 0]], "width": 6}],
              "flows": [{"id": "east", "from": "road:start", "to": "road:end", "count": 5, "end": 2},
                        {"id": "west", "from": "road:end", "to": "road:start", "count": 3, "end": 2}]}
    throng_io.bake(layout, tmp_path / "bake", program=throng.binary, options=["--feet"])
    monkeypatch.setenv("THRONG_BODIES", str(bodies))
    usd, command, seen = tmp_path / "crowd.usdc", blender_module(), []
    assert cli.main(["export-usd", str(tmp_path / "bake"), "-o", str(usd), "--skeletons", "--copies", "--bare"]) == 0
    script, addon = ROOT / "tests" / "python" / "picture_of_crowd.py", ROOT / "blender_addon"
    for kind, path in (("native", tmp_path / "bake" / "bake.json"), ("usd", usd)):
        arguments = [str(each) for each in (addon, kind, path, 100, tmp_path / f"{kind}.png")]
        process = subprocess.run(command(script, arguments, None, True), capture_output=True, text=True)
        assert process.returncode == 0, process.stderr[-4000:]
        line = next(each for each in process.stdout.splitlines() if each.startswith("RESULT "))
        seen.append(numpy.array(list(line.removeprefix("RESULT "))) == "1")
    native, imported = seen
    assert native.mean() > 0.02
    assert (native & imported).sum() > 0.99 * (native | imported).sum()
