# SPDX-License-Identifier: Apache-2.0
"""What is in files besides people who walk: seats and those in them, vehicles with wheels and doors, floors and lifts,
and heads that look."""
import json
import subprocess

import numpy
import pytest

import throng_io
from conftest import ROOT, blender_module, khronos_issues
from glb_reader import Glb, z_up
from posed_people import expected, off
from throng_io import cli
from throng_io.cast import sitting
from throng_io.skinned import carried, chosen, members, motions
from throng_io.usd.figures import seated_poses

Usd = pytest.importorskip("pxr.Usd", reason="usd-core is not installed")
UsdGeom = pytest.importorskip("pxr.UsdGeom")
UsdSkel = pytest.importorskip("pxr.UsdSkel")

SOME = (0, 40, 77, 110, 143)  # frames


def box(x0, y0, x1, y1):
    return [[x0, y0], [x1, y0], [x1, y1], [x0, y1]]


SEATS = {"throng": 1, "simulation": {"duration": 6, "seed": 2},
         "areas": [{"id": "west", "polygon": box(-9, -3, -6, 3)}, {"id": "east", "polygon": box(6, -3, 9, 3)}],
         "flows": [{"id": "on", "from": "west", "to": "east", "count": 2, "end": 1}],
         "seats": [{"id": "south", "front": [[-3, -5], [3, -5]], "rows": 2, "rise": 0.4, "height": 0.8}],
         "shows": [{"at": 1, "do": "clap", "for": 1.5}, {"at": 3, "do": "cheer", "who": ["south"], "for": 2}]}
# Far from the world's origin: places are told from one nearby.
TRAM = {"throng": 1, "simulation": {"duration": 20, "avoid_congestion": False, "seed": 3},
        "areas": [{"id": "platform", "polygon": box(4983, -5.5, 5017, -1.3)},
                  {"id": "corner", "polygon": box(4980, -9, 4983, -5.5)}],
        "lanes": [{"id": "rails", "points": [[4930, 0], [5070, 0]], "speed": 11, "stops": [
            {"id": "market", "at": [5014, 0], "platform": "platform", "dwell": [10, 40]}]}],
        "vehicles": [{"id": "4", "lane": "rails", "kind": "tram", "times": [0]}],
        "flows": [{"id": "on", "from": "platform", "board": "market", "count": 2, "end": 6}]}
HOUSE = {"throng": 1, "simulation": {"duration": 24, "seed": 1},
         "levels": [{"id": name, "height": height, "floor": box(-8, -6, 8, 6)} for name, height in
                    (("ground", 0.0), ("upper", 4.0))],
         "links": [{"id": "lift", "type": "lift", "levels": ["ground", "upper"], "at": [0, 4.5], "size": [2, 2],
                    "doors": -90, "door_width": 1.2, "capacity": 8}],
         "areas": [{"id": f"{name}-{side}", "level": name, "polygon": box(x, -4, x + 2, 2)}
                   for name in ("ground", "upper") for side, x in (("west", -3.5), ("east", 1.5))],
         "flows": [{"id": "up", "from": "ground-west", "to": "upper-east", "count": 3, "end": 2},
                   {"id": "along", "from": "upper-west", "to": "upper-east", "count": 2, "end": 2}]}


@pytest.fixture(scope="module")
def made(throng, once, bodies):
    """(name of a layout) gives its bake and the folder of what is written of it."""
    def of(name):
        layout, options, more = {"seats": (SEATS, ["--attention", "--feet"], ["--most", "4", "--near", "0", "-5"]),
                                 "tram": (TRAM, [], ["--most", "1"]), "house": (HOUSE, [], ["--most", "1"])}[name]

        def make(folder):
            throng_io.bake(layout, folder / "bake", program=throng.binary, gltf=True, options=options)
            with pytest.MonkeyPatch.context() as patch:
                patch.setenv("THRONG_BODIES", str(bodies))
                run = lambda command, file, *given: cli.main(
                    [command, str(folder / "bake"), "-o", str(folder / file), *given])
                assert run("export-usd", "crowd.usdc") == 0
                assert run("export-gltf", "skinned.glb", *more) == 0
                if name == "seats":
                    assert run("export-usd", "skinned.usdc", "--skeletons", *more) == 0
                    assert run("export-kit", "kit", *more) == 0
                    assert run("export-vat", "vat", *more, "--members", "1", "--texture", "png") == 0

        folder = once(f"python-places-{name}", make)
        return throng_io.Bake(folder / "bake"), folder
    return of


def stage_of(folder, name="crowd.usdc"):
    return Usd.Stage.Open(str(folder / name))


def matrix(stage, path, frame):
    """4 x 4 of a prim to the bake's own places, rows first."""
    found = UsdGeom.XformCache(frame + 1).ComputeRelativeTransform(
        stage.GetPrimAtPath(path), stage.GetPrimAtPath("/World"))[0]
    return numpy.array(found)


def shown(stage, path, frame):
    return UsdGeom.Imageable(stage.GetPrimAtPath(path)).ComputeVisibility(frame + 1) == "inherited"


def points_of(stage, path):
    return numpy.array(UsdGeom.Mesh(stage.GetPrimAtPath(path)).GetPointsAttr().Get())


# ---- files are what they should be

@pytest.mark.parametrize("name", ["seats", "tram", "house"])
def test_validators_find_nothing(made, name):
    bake, folder = made(name)
    for path in (bake.folder / "crowd.glb", folder / "skinned.glb"):
        issues = khronos_issues(path)
        assert issues["numErrors"] == issues["numWarnings"] == 0, issues["messages"][:3]
    from_library = pytest.importorskip("pxr.UsdValidation", reason="this USD has no validators")
    try:
        validators = from_library.ValidationRegistry().GetOrLoadAllValidators()
        for file in sorted(folder.glob("*.usdc")):
            found = from_library.ValidationContext(validators).Validate(stage_of(folder, file.name))
            assert [error.GetMessage() for error in found] == []
    except AttributeError:
        pytest.skip("this USD's validators are of another form")


# ---- vehicles

def door_places(bake, frame):
    """Of the tram's leaves on its right, as docs/bake.md tells them: how far along it their middles are."""
    doors, what = bake.about["doors"]["list"][0], bake.about["vehicles"]["list"][0]
    open_ = numpy.load(bake.folder / "doors.npy")[frame, 0, 1]
    return sorted(0.5 * what["length"] - at + way * doors["width"] * (0.25 + 0.48 * open_)
                  for at in doors["at"] for way in (-1, 1))


def test_trams_go_roll_and_open_their_doors_in_usd(made):
    bake, folder = made("tram")
    stage, track = stage_of(folder), numpy.load(bake.folder / "vehicles.npy")[:, 0]
    open_, tram = numpy.load(bake.folder / "doors.npy")[:, 0, 1], "/World/Vehicles/tram0000"
    assert open_.max() == 1.0 and numpy.abs(bake.origin).max() > 1000
    leaves = [prim.GetName() for prim in stage.GetPrimAtPath(tram).GetChildren() if "right_door" in prim.GetName()
              and "doorway" not in prim.GetName()]
    assert len(leaves) == 8
    for frame in range(0, bake.frames, 7):
        there = track[frame, 6] != 0
        assert shown(stage, tram, frame) == there
        if not there:
            continue
        place = matrix(stage, tram, frame)
        assert numpy.abs(place[3, :3] - track[frame, :3]).max() < 1e-4
        assert numpy.abs(place[0, :2] - [numpy.cos(track[frame, 3]), numpy.sin(track[frame, 3])]).max() < 1e-4
        along = sorted((matrix(stage, f"{tram}/{leaf}", frame) @ numpy.linalg.inv(place))[3, 0] for leaf in leaves)
        assert numpy.abs(numpy.array(along) - door_places(bake, frame)).max() < 1e-4
        wheel = (matrix(stage, f"{tram}/axle0", frame) @ numpy.linalg.inv(place))[:3, :3]
        rolled = track[frame, 5] / bake.about["vehicles"]["list"][0]["wheel"]
        top = numpy.array([0.0, 0.0, 1.0]) @ wheel  # goes forward first
        assert numpy.abs(top - [numpy.sin(rolled), 0.0, numpy.cos(rolled)]).max() < 1e-3
    assert points_of(stage, f"{tram}/axle0")[:, 2].min() == pytest.approx(
        -bake.about["vehicles"]["list"][0]["wheel"], abs=1e-6)


def test_and_in_skinned_gltf(made):
    bake, folder = made("tram")
    glb, track = Glb(folder / "skinned.glb"), numpy.load(bake.folder / "vehicles.npy")[:, 0]
    names = [number for name, number in glb.named.items() if "right_door" in name and "doorway" not in name]
    assert len(names) == 8
    for frame in range(0, bake.frames, 31):
        pose = glb.sampled(glb.animation("crowd"), frame / bake.fps)
        place = glb.place_of(glb.named["tram0000"], pose)
        if track[frame, 6] == 0:
            assert not place[:3, :3].any()
            continue
        assert numpy.abs(z_up(place[None, :3, 3])[0] - track[frame, :3]).max() < 1e-4
        along = sorted((numpy.linalg.inv(place) @ glb.place_of(leaf, pose))[0, 3] for leaf in names)
        assert numpy.abs(numpy.array(along) - door_places(bake, frame)).max() < 1e-4


# ---- floors and lifts

def test_floors_are_there_and_cabins_where_they_are(made):
    bake, folder = made("house")
    stage, track = stage_of(folder), numpy.load(bake.folder / "lifts.npy")[:, 0]
    assert track[:, 0].min() == 0.0 and track[:, 0].max() > 0.5
    heights = points_of(stage, "/World/Ground/terrain")[:, 2]
    assert {0.0, 4.0} <= set(numpy.round(heights, 3).tolist())
    lift, = bake.about["lifts"]["list"]
    for frame in range(0, bake.frames, 11):
        place = matrix(stage, "/World/Lifts/lift", frame)
        assert numpy.abs(place[3, :3] - [*lift["at"], track[frame, 0]]).max() < 1e-4
        for stop in (0, 1):
            here = track[frame, 3] == stop and abs(track[frame, 0] - 4.0 * stop) < 0.01
            leaf = matrix(stage, f"/World/Lifts/lift_stop_{stop}/left_leaf", frame)
            broad = numpy.linalg.norm(leaf[1, :3])
            assert broad == pytest.approx(1.0 - 0.92 * (track[frame, 1] if here else 0.0), abs=1e-4)
            assert leaf[3, 2] == pytest.approx(4.0 * stop)
            assert leaf[3, 1] == pytest.approx(lift["at"][1] - 1.0)  # doors look to -y


def test_lifts_in_crowd_glb(made):
    bake, _ = made("house")
    glb, track = Glb(bake.folder / "crowd.glb"), numpy.load(bake.folder / "lifts.npy")[:, 0]
    leaves = [number for number, node in enumerate(glb.told["nodes"]) if node["name"] == "lift door"]
    assert len(leaves) == 4
    for frame in range(0, bake.frames, 11):
        pose = glb.sampled(glb.animation("crowd"), frame / bake.fps)
        assert z_up(glb.place_of(glb.named["lift lift"], pose)[None, :3, 3])[0] == pytest.approx(
            [0, 4.5, track[frame, 0]], abs=1e-4)
        open_ = [track[frame, 1] if track[frame, 3] == stop and abs(track[frame, 0] - 4.0 * stop) < 0.01 else 0.0
                 for stop in (0, 0, 1, 1)]
        away = [abs(glb.place_of(leaf, pose)[0, 3]) for leaf in leaves]
        assert away == pytest.approx([1.2 * (0.25 + 0.46 * each) for each in open_], abs=1e-4)


# ---- seats

def seated(bake):
    return numpy.nonzero(bake.state[0, :, 0] > 4.5)[0]


def test_simple_figures_sit_on_their_seats(made):
    bake, folder = made("seats")
    stage = stage_of(folder)
    crowd = UsdGeom.PointInstancer(stage.GetPrimAtPath("/World/Crowd"))
    targets = [path.name.partition("_")[2] for path in crowd.GetPrototypesRel().GetTargets()]
    assert {name for name, _ in seated_poses(sitting.AUDIENCE)} <= set(targets)
    seats = points_of(stage, "/World/Stands/seats0")
    done = set()
    for frame in SOME:
        poses = numpy.array(crowd.GetProtoIndicesAttr().Get(frame + 1))
        for row in seated(bake):
            clip, share = sitting.place_at(bake.state[frame, row, 0], bake.state[frame, row, 2])
            name = sitting.CLIPS[clip].name
            assert targets[poses[row]].startswith(name)
            done.add(name)
            if name == "sit":  # thighs on the seat, feet on the step
                mesh = dict(seated_poses(sitting.AUDIENCE))[targets[poses[row]]]
                place = bake.pos[frame, row]
                near = seats[numpy.linalg.norm(seats[:, :2] - place[:2], axis=1) < 0.45]
                assert near[:, 2].min() - place[2] == pytest.approx(sitting.SEAT - 0.04, abs=1e-3)
                hips = mesh.points[(numpy.abs(mesh.points[:, 0] + 0.2) < 0.1) & (mesh.points[:, 2] < 0.6)]
                assert hips[:, 2].min() == pytest.approx(sitting.SEAT, abs=0.03)
                assert mesh.points[:, 2].min() == 0.0 and 1.2 < mesh.points[:, 2].max() < 1.4
    assert {"sit", "clap", "cheer"} <= done


def test_people_sit_as_the_cast_does(made, bodies, monkeypatch):
    bake, folder = made("seats")
    monkeypatch.setenv("THRONG_BODIES", str(bodies))
    library, glb = members.bodies_of_library(), Glb(folder / "skinned.glb")
    rows = {node["extras"]["row"]: number for number, node in enumerate(glb.told["nodes"])
            if "row" in node.get("extras", {})}
    row = next(row for row in rows if row in seated(bake))
    for frame in SOME:
        pose = glb.sampled(glb.animation("crowd"), frame / bake.fps)
        points = z_up(glb.skinned(glb.named[f"person {row:05d} body"], pose))
        assert off(points[::7], expected(bake, row, frame, library) - bake.origin) < 1e-4
        tall = points[:, 2].max() - bake.pos[frame, row, 2]
        assert (tall < 1.5) if bake.state[frame, row, 0] < 8 else (tall > 1.3)


def test_kits_and_textures_have_what_is_done_in_seats(made):
    bake, folder = made("seats")
    for name in ("kit", "vat"):
        told = json.loads((folder / name / "crowd.json").read_text())
        clips = [clip["name"] for clip in told["clips"]]
        assert clips[-6:] == [clip.name for clip in sitting.CLIPS[:sitting.AUDIENCE]]
        records = numpy.fromfile(folder / name / "crowd.bin", numpy.uint8)
        records = records.reshape(told["frames"], len(told["people"]), 24)
        for place, somebody in enumerate(told["people"]):
            if somebody["row"] not in seated(bake):
                continue
            for frame in SOME:
                state = bake.state[frame, somebody["row"]]
                clip, _ = sitting.place_at(state[0], state[2])
                assert clips[records[frame, place, 22]] == sitting.CLIPS[clip].name
                assert records[frame, place, 21] == 0  # of 255 walks
                phase = records[frame, place, 16:18].copy().view("<u2")[0] / 65536
                assert abs((phase - state[2] + 0.5) % 1.0 - 0.5) < 1e-4


def test_crowd_glb_has_stands_and_people_are_lower_while_they_sit(made):
    bake, _ = made("seats")
    glb = Glb(bake.folder / "crowd.glb")
    assert {"stand south", "seats south"} <= set(glb.named)
    for frame in SOME:
        pose = glb.sampled(glb.animation("crowd"), frame / bake.fps)
        for row in seated(bake):
            high = pose[glb.named[f"person {row}"], "scale"][1]
            activity = int(bake.state[frame, row, 0])
            place = glb.place_of(glb.named[f"person {row}"], pose)
            assert numpy.abs(z_up(place[None, :3, 3])[0] - bake.pos[frame, row]).max() < 1e-5
            ahead = z_up(place[None, :3, 0])[0][:2] / numpy.linalg.norm(place[:3, 0])
            assert numpy.abs(ahead - bake.dir[frame, row, :2]).max() < 1e-5
            assert high == pytest.approx(0.76 if activity in (5, 6, 7) else 1.0, abs=1e-6) or activity == 8


@pytest.mark.parametrize("name, things", [("seats", {"stand south", "seats south"}), ("house", {"lift lift"})])
def test_they_stay_where_overrides_are_applied(made, throng, tmp_path, name, things):
    bake, _ = made(name)
    (tmp_path / "none.json").write_text('{"throng_overrides": 1, "overrides": []}')
    throng("apply", bake.folder, "--overrides", tmp_path / "none.json", "-o", tmp_path / "final", "-q", "--gltf", "yes")
    before, after = (Glb(folder / "crowd.glb") for folder in (bake.folder, tmp_path / "final"))
    assert things <= set(after.named) and set(before.named) == set(after.named)
    for frame in (0, 77, 140):
        poses = [each.sampled(each.animation("crowd"), frame / bake.fps) for each in (before, after)]
        for thing in things | {"person 0"}:
            places = [each.place_of(each.named[thing], pose) for each, pose in zip((before, after), poses)]
            assert numpy.abs(places[0] - places[1]).max() < 1e-6


# ---- heads

def test_heads_look_where_the_bake_says(made, bodies, monkeypatch):
    """From where the body faces a head is turned by weight (yaw + twist), and by weight pitch up (docs/bake.md)."""
    bake, _ = made("seats")
    monkeypatch.setenv("THRONG_BODIES", str(bodies))
    roles, number_of = members.cast_of(bake)
    repertoire, looked = members.repertoire_of(bake), 0.0
    for row in range(2):  # they walk
        member = members.make_member(members.bodies_of_library(), roles[number_of[row]], repertoire)
        head = [path.rpartition("/")[2] for path in member.joints].index("head")
        frames = numpy.arange(30, 144, 9)
        streams = {name: each[:, 0] for name, each in chosen.streams_of(bake, frames, [row]).items()}
        streams["attention"] = numpy.tile([0.9, 0.3, 0.8], (len(frames), 1))  # a clear look
        streams["carriage"][:, 1:] = (0.25, 0.08)
        streams = {name: each for name, each in streams.items() if not name.endswith("_foot")}  # which hips follow
        track = motions.track_of(row, frames + 1, streams)
        turns = carried.bent(member, repertoire, track)[:, head, :, :3]
        before = motions.matrices_of(member.poses, repertoire, track)[:, head, :, :3]
        ahead = numpy.einsum("fij,fkj,k->fi", turns, before, [1.0, 0.0, 0.0])
        yaw, pitch = numpy.arctan2(ahead[:, 1], ahead[:, 0]), numpy.arcsin(ahead[:, 2])
        assert numpy.abs(yaw - 0.8 * (0.9 + 0.25)).max() < 0.05
        assert numpy.abs(pitch - 0.8 * 0.3).max() < 0.05
        looked = max(looked, float(yaw.max()))
        hips = (carried.bent(member, repertoire, track) - motions.matrices_of(member.poses, repertoire, track))[:, 0]
        assert numpy.abs(hips).max() < 1e-9  # these stay
    assert looked > 0.8


# ---- in Blender

@pytest.fixture
def opened():
    """(file, frames of the bake) gives what a current Blender makes of it."""
    command = blender_module()

    def run(path, frames):
        script = ROOT / "tests" / "blender" / "check_usd.py"
        given = command(script, [str(path), *(str(frame + 1) for frame in frames)], None, True)
        process = subprocess.run(given, capture_output=True, text=True)
        assert process.returncode == 0, process.stderr[-2000:]
        return json.loads(next(line for line in process.stdout.splitlines() if line.startswith("RESULT "))[7:])
    return run


@pytest.mark.parametrize("name", ["seats", "tram", "house"])
def test_blender_has_everything_where_it_is(made, opened, name):
    bake, folder = made(name)
    frames = [20, 100, 140, 410][:3 if name == "seats" else 4]
    for frame, shot in zip(frames, opened(folder / "crowd.usdc", frames)):
        there = bake.there(frame)
        people = numpy.array(shot["people"]).reshape(-1, 3)
        wanted = bake.world(frame)[there]
        assert len(people) == len(wanted)
        near = 6e-4 if name == "tram" else 1e-4  # m: 5 km away, numbers of Blender are that far apart
        for person in people:
            assert numpy.linalg.norm(wanted - person, axis=1).min() < near
        places = {key.rpartition("/")[2]: place for key, (place, _) in shot["things"].items()}
        if name == "tram":
            track = numpy.load(bake.folder / "vehicles.npy")[frame, 0]
            assert numpy.abs(places["tram0000"] - (bake.origin + track[:3])).max() < near
        if name == "house":
            height = numpy.load(bake.folder / "lifts.npy")[frame, 0, 0]
            assert numpy.abs(numpy.array(places["cabin"]) - [0, 4.5, height]).max() < 1e-4
            assert {"terrain", "cabin", "left_leaf", "right_leaf"} <= set(places)
        if name == "seats":
            assert {"stand0", "seats0"} <= set(places)
