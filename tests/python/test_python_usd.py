# SPDX-License-Identifier: Apache-2.0
"""Crowds as USD, read back by USD's own library: places, poses, colours, motion between frames, and its validators."""
import numpy
import pytest
import shapely

import throng_io
from throng_io import cli
from throng_io.bakes.surroundings import prism
from throng_io.usd.crowd import TOPS, costumes
from throng_io.usd.figures import HEIGHT, PHASES, TOP, figure

Usd = pytest.importorskip("pxr.Usd", reason="usd-core is not installed")
UsdGeom = pytest.importorskip("pxr.UsdGeom")

LAYOUT = {"throng": 1, "simulation": {"duration": 8, "seed": 2},
          "roads": [{"id": "road", "centreline": [[3000, 5000], [3016, 5000]], "width": 6}],
          "walls": [{"id": "ell", "closed": True, "height": 2.5,
                     "points": [[3006, 4998], [3010, 4998], [3010, 4999], [3007, 4999], [3007, 5001], [3006, 5001]]},
                    {"points": [[3000, 5004], [3016, 5004]], "thickness": 0.4}],
          "flows": [{"id": "east", "from": "road:start", "to": "road:end", "count": 9, "end": 3},
                    {"id": "west", "from": "road:end", "to": "road:start", "count": 6, "end": 3}]}


@pytest.fixture(scope="module")
def crowd(throng, once):
    """The bake and its stage."""
    def make(folder):
        throng_io.bake(LAYOUT, folder / "bake", program=throng.binary)
        assert cli.main(["export-usd", str(folder / "bake"), "-o", str(folder / "crowd.usdc")]) == 0

    folder = once("python-usd", make)
    return throng_io.Bake(folder / "bake"), Usd.Stage.Open(str(folder / "crowd.usdc"))


@pytest.fixture
def instancer(crowd):
    return UsdGeom.PointInstancer(crowd[1].GetPrimAtPath("/World/Crowd"))


def transforms(instancer, time, base=None):
    found = instancer.ComputeInstanceTransformsAtTime(time, time if base is None else base)
    return numpy.array(found).reshape(-1, 4, 4)


def test_the_stage_says_how_it_is_measured(crowd):
    bake, stage = crowd
    assert UsdGeom.GetStageUpAxis(stage) == "Z" and UsdGeom.GetStageMetersPerUnit(stage) == 1
    assert stage.GetTimeCodesPerSecond() == bake.fps
    assert (stage.GetStartTimeCode(), stage.GetEndTimeCode()) == (1, bake.frames)
    assert stage.GetDefaultPrim().GetPath() == "/World"


def test_everybody_is_where_they_are_in_the_world(crowd, instancer):
    bake, _ = crowd
    assert bake.origin[0] > 2000
    for frame in range(0, bake.frames, 7):
        there = bake.there(frame)
        places = transforms(instancer, frame + 1)[:, 3, :3]
        origin = UsdGeom.XformCache(frame + 1).GetLocalToWorldTransform(instancer.GetPrim()).ExtractTranslation()
        assert numpy.abs(places + numpy.array(origin) - bake.world(frame)[there]).max(initial=0) < 1e-4


def test_everybody_looks_and_is_posed_as_they_are(crowd, instancer):
    bake, stage = crowd
    names = [path.name for path in instancer.GetPrototypesRel().GetTargets()]
    assert len(names) == len(TOPS) * (1 + PHASES * len(bake.about["gaits"]))
    seen = set()
    for frame in range(0, bake.frames, 11):
        there = bake.there(frame)
        ahead = transforms(instancer, frame + 1)[:, 0, :2]
        ahead /= numpy.linalg.norm(ahead, axis=1)[:, None]
        assert numpy.abs(ahead - bake.dir[frame][there][:, :2]).max(initial=0) < 2e-3  # of half precision
        indices = numpy.array(instancer.GetProtoIndicesAttr().Get(frame + 1))
        for row in numpy.nonzero(there)[0]:
            activity, _, phase = bake.state[frame, row]
            if bake.dir[frame, row, 2] < 0.1:
                assert names[indices[row]].endswith("_standing")
                continue
            gait, pose = names[indices[row]].partition("_stride")[2].split("_pose")
            seen.add(int(pose))
            assert int(gait) == round(16 * (activity % 1))
            assert abs((phase - int(pose) / PHASES + 0.5) % 1 - 0.5) <= 0.5 / PHASES + 1e-5
    assert seen == set(range(PHASES))


def test_ids_tints_and_invisible_people(crowd, instancer):
    bake, _ = crowd
    assert list(instancer.GetIdsAttr().Get()) == list(range(bake.agents))
    primvars = UsdGeom.PrimvarsAPI(instancer.GetPrim())
    assert list(primvars.GetPrimvar("personId").Get()) == list(range(bake.agents))
    tints = numpy.array(primvars.GetPrimvar("tint").Get())
    assert tints.shape == (bake.agents, 3) and len({tuple(tint) for tint in tints.tolist()}) > 4
    paths = instancer.GetPrototypesRel().GetTargets()
    for row, prototype in enumerate(instancer.GetProtoIndicesAttr().Get(100)):
        mesh = UsdGeom.Mesh(crowd[1].GetPrimAtPath(paths[prototype]))
        colours, indices = mesh.GetDisplayColorPrimvar().Get(), mesh.GetDisplayColorPrimvar().GetIndices()
        assert numpy.allclose(colours[TOP], tints[row]) and len(indices) == len(mesh.GetFaceVertexCountsAttr().Get())
    for frame in (0, 60, bake.frames - 1):
        hidden = set(instancer.GetInvisibleIdsAttr().Get(frame + 1))
        assert hidden == set(numpy.nonzero(~bake.there(frame))[0].tolist())


def test_overrides_dress_people():
    people = numpy.zeros(70, dtype=[("tint", "U10")])
    people["tint"] = [f"#{row:02x}{2 * row:02x}80" for row in range(69)] + ["0.1 0.2 0.3"]
    tops, worn = costumes(people)
    assert len(tops) == 64 and len(set(worn[:56])) == 56
    assert tops[worn[3]] == pytest.approx([0.000911, 0.001821, 0.215861], abs=1e-5)
    assert worn[69] < len(TOPS)


def test_between_frames_people_move_on(crowd, instancer):
    """So that motion blur is right: places by velocities are the mean of both frames."""
    bake, _ = crowd
    frame = 70
    both = bake.there(frame)
    places = transforms(instancer, frame + 1.5)[:, 3, :3]
    assert numpy.abs(places - 0.5 * (bake.pos[frame] + bake.pos[frame + 1])[both]).max() < 1e-4
    velocities = numpy.array(instancer.GetVelocitiesAttr().Get(frame + 1))
    speed = numpy.hypot(*velocities[both, :2].T)
    assert numpy.abs(speed - bake.dir[frame][both][:, 2]).max() < 0.2 and speed.max() > 0.5


def test_extents_hold_everybody(crowd, instancer):
    for time in (40, 100, 150):
        whole = numpy.array(instancer.ComputeExtentAtTime(time, time))
        told = numpy.array(instancer.GetExtentAttr().Get(time))
        assert (told[0] <= whole[0] + 1e-4).all() and (told[1] >= whole[1] - 1e-4).all()
        assert (told[0] > whole[0] - 1.5).all() and (told[1] < whole[1] + 1.5).all()


def test_usds_validators_find_nothing(crowd):
    _, stage = crowd
    try:
        from_library = pytest.importorskip("pxr.UsdValidation", reason="this USD has no validators")
        validators = from_library.ValidationRegistry().GetOrLoadAllValidators()
        assert len(validators) > 10
        found = [error.GetMessage() for error in from_library.ValidationContext(validators).Validate(stage)]
    except AttributeError:
        pytest.skip("this USD's validators are of another form")
    assert found == []


def test_walls_stand_and_are_solid(crowd):
    bake, stage = crowd
    wall = UsdGeom.Mesh(stage.GetPrimAtPath("/World/Walls/wall0"))
    points = numpy.array(wall.GetPointsAttr().Get()) + bake.origin
    assert points[:, 2].min() == 0 and points[:, 2].max() == 2.5
    assert shapely.MultiPoint(points[:, :2]).hausdorff_distance(bake.walls["ell"]) < 1e-3
    corners, first, top = wall.GetFaceVertexIndicesAttr().Get(), 0, 0.0
    for count in wall.GetFaceVertexCountsAttr().Get():
        face = points[list(corners[first:first + count])]
        first += count
        if (face[:, 2] == 2.5).all():
            top += shapely.Polygon(face[:, :2]).area
    assert top == pytest.approx(bake.walls["ell"].area, rel=1e-4)
    assert stage.GetPrimAtPath("/World/Walls/wall0").GetDisplayName() == "ell"


def volume(points, faces):
    """Positive where faces look outwards."""
    a, b, c = (points[faces[:, corner]] for corner in range(3))
    return float((numpy.cross(a, b) * c).sum() / 6)


def test_figures_walk():
    """Feet reach the ground, the planted one goes back as fast as the body goes on, and faces look outwards."""
    stride = 1.4
    toes = []
    for pose in range(PHASES):
        mesh = figure(pose / PHASES, stride)
        assert mesh.points[:, 2].min() == pytest.approx(0, abs=1e-9)
        assert HEIGHT - 0.09 < mesh.points[:, 2].max() < HEIGHT + 0.01  # lower on the longest reach
        assert numpy.allclose(numpy.linalg.norm(mesh.normals, axis=1), 1)
        assert 0.05 < volume(mesh.points, mesh.faces) < 0.12  # m^3
        toes.append(mesh.points[(mesh.points[:, 1] > 0.02) & (mesh.points[:, 2] < 0.09), 0].mean())
    planted = numpy.diff(toes[1:7])
    assert (planted < 0).all() and planted.mean() == pytest.approx(-stride / PHASES, rel=0.2)
    standing = figure(None)
    assert standing.points[:, 2].min() == pytest.approx(0, abs=1e-9)


def test_prisms_have_holes():
    ring = shapely.box(0, 0, 4, 4).difference(shapely.box(1, 1, 3, 3))
    points, faces = prism(ring, 0.0, 2.0)
    top = sum(shapely.Polygon(points[face][:, :2]).area for face in faces if (points[face][:, 2] == 2).all())
    assert top == pytest.approx(12) and len(points) >= 16


def test_names_and_bakes_that_do_not_fit_are_told(crowd, tmp_path, capsys):
    bake, _ = crowd
    assert cli.main(["export-usd", str(bake.folder), "-o", str(tmp_path / "crowd.abc")]) == 3
    assert "ends in .usd, .usda, .usdc" in capsys.readouterr().err
    assert cli.main(["export-usd", str(tmp_path), "-o", str(tmp_path / "crowd.usdc")]) == 3
    assert list(tmp_path.iterdir()) == []


def test_fewer_frames_are_as_right(crowd, tmp_path):
    bake, _ = crowd
    assert cli.main(["export-usd", str(bake.folder), "-o", str(tmp_path / "crowd.usda"), "--every", "4"]) == 0
    stage = Usd.Stage.Open(str(tmp_path / "crowd.usda"))
    instancer = UsdGeom.PointInstancer(stage.GetPrimAtPath("/World/Crowd"))
    assert instancer.GetPositionsAttr().GetNumTimeSamples() == len(range(0, bake.frames, 4))
    both = bake.there(60)
    places = transforms(instancer, 63)[:, 3, :3]  # halfway from frame 60 to 64
    assert numpy.abs(places - 0.5 * (bake.pos[60] + bake.pos[64])[both]).max() < 1e-4


def test_long_shots_are_in_files_of_their_own(crowd, tmp_path, capsys):
    """Value clips: the same at every moment, also between two files."""
    bake, whole = crowd
    path = tmp_path / "long.usdc"
    assert cli.main(["export-usd", str(bake.folder), "-o", str(path), "--chunk", "50", "--every", "2"]) == 0
    names = {each.name for each in (tmp_path / "long.clips").iterdir()}
    assert names == {"manifest.usda", *(f"{number:04d}.usdc" for number in range(1, -(-bake.frames // 50) + 1))}
    assert cli.main(["export-usd", str(bake.folder), "-o", str(tmp_path / "one.usdc"), "--every", "2"]) == 0
    stages = [Usd.Stage.Open(str(tmp_path / name)) for name in ("long.usdc", "one.usdc")]
    first, second = (UsdGeom.PointInstancer(each.GetPrimAtPath("/World/Crowd")) for each in stages)
    for time in (41, 49, 50, 50.5, 51, 52, 99.25, 101, 150.7, bake.frames - 1):
        assert (transforms(first, time) == transforms(second, time)).all()
        assert list(first.GetProtoIndicesAttr().Get(time)) == list(second.GetProtoIndicesAttr().Get(time))
        assert list(first.GetInvisibleIdsAttr().Get(time)) == list(second.GetInvisibleIdsAttr().Get(time))
    assert len(transforms(first, 101)) > 3
    # what is there already is not replaced, and nothing of a second one is left
    assert cli.main(["export-usd", str(bake.folder), "-o", str(tmp_path / "long.usdc"), "--chunk", "50"]) == 3
    assert "is there already" in capsys.readouterr().err
    assert {each.name for each in tmp_path.iterdir()} == {"long.usdc", "long.clips", "one.usdc"}


def test_a_camera_sees_the_crowd_and_bare_stages_have_no_set(crowd, tmp_path):
    bake, stage = crowd
    camera = UsdGeom.Camera(stage.GetPrimAtPath("/World/Camera")).GetCamera(1)
    frame = int(0.4 * (bake.frames - 1))
    places = bake.world(frame)[bake.there(frame)]
    seen = [camera.frustum.Intersects(type(camera.frustum.GetPosition())(*place.tolist())) for place in places]
    assert sum(seen) > 0.6 * len(seen) and len(seen) > 3
    walls = [shapely.Polygon(shape.exterior) for shape in bake.walls.values()]
    assert not any(wall.contains(shapely.Point(*camera.frustum.GetPosition()[:2])) for wall in walls)
    assert camera.focalLength == pytest.approx(0.36)  # tenths of a metre: 36 mm
    lights = [prim.GetTypeName() for prim in stage.GetPrimAtPath("/World/Lights").GetChildren()]
    assert lights == ["DistantLight", "DomeLight"]
    names = UsdGeom.PrimvarsAPI(stage.GetPrimAtPath("/World/Crowd")).GetPrimvar("crypto_object").Get()
    assert list(names) == [f"{bake.name}/{row:05d}" for row in range(bake.agents)]
    assert cli.main(["export-usd", str(bake.folder), "-o", str(tmp_path / "bare.usda"), "--bare"]) == 0
    bare = Usd.Stage.Open(str(tmp_path / "bare.usda"))
    assert [prim.GetName() for prim in bare.GetPrimAtPath("/World").GetChildren()] == ["Looks", "Crowd"]
