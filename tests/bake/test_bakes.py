# SPDX-License-Identifier: Apache-2.0
"""Bakes of the examples, judged from the written files alone."""
import csv
import hashlib
import json
import os
import signal
import struct
import subprocess
import time
from collections import Counter

import numpy
import pytest

from conftest import EXAMPLES
from processor_time import HANGS

SMALL = {"throng": 1, "simulation": {"duration": 2},
         "roads": [{"id": "road", "centreline": [[0, 0], [20, 0]], "width": 6}],
         "walls": [{"points": [[8, -1], [12, 1]], "thickness": 0.2}],
         "flows": [{"id": "f", "from": "road:start", "to": "road:end", "count": 30}],
         "formations": [{"id": "ring", "type": "circle", "centre": [10, 12], "radius": 4, "count": 7}]}


def streams(bake):
    return {name: numpy.load(bake / "streams" / f"{name}.npy", mmap_mode="r") for name in ("pos", "dir", "state")}


def table(bake):
    with open(bake / "agents.csv", newline="") as file:
        return list(csv.DictReader(file))


def write(path, layout):
    path.write_text(json.dumps(layout))
    return path


class Bodies:
    """Everybody's outline in a bake: as thick round a segment across the chest as it is deep; of a disc a point."""

    def __init__(self, bake):
        self.data, rows = streams(bake), table(bake)
        sides = [[float(row[name]) if row.get("breadth") else 2.0 * float(row["radius"]) for name in
                  ("breadth", "depth")] for row in rows]
        breadth, depth = numpy.array(sides).T
        self.thickness, self.half = 0.5 * depth, 0.5 * (breadth - depth)
        chest = bake / "streams" / "chest.npy"
        self.twist = numpy.load(chest, mmap_mode="r")[..., 0] if chest.exists() else None

    def segments(self, frame, who):
        """The middles of these people's segments, and from there to their ends."""
        facing = numpy.array(self.data["dir"][frame, who, :2])
        angle = numpy.arctan2(facing[:, 1], facing[:, 0])
        if self.twist is not None:
            angle += self.twist[frame, who]
        across = numpy.stack([-numpy.sin(angle), numpy.cos(angle)], axis=1)
        return numpy.array(self.data["pos"][frame, who, :2]), across * self.half[who, None]


def from_segment(point, middle, arm):
    """How far points are from segments."""
    length = (arm * arm).sum(axis=-1)
    along = ((point - middle) * arm).sum(axis=-1) / numpy.maximum(length, 1e-12)
    return numpy.linalg.norm(point - middle - numpy.clip(along, -1.0, 1.0)[..., None] * arm, axis=-1)


def crossed(x, y):
    return x[..., 0] * y[..., 1] - x[..., 1] * y[..., 0]


def between_segments(middle, arm, other, its_arm):
    """How far segments are from others, each given by its middle and the way from there to one end; 0: they cross."""
    offset, turned = other - middle, crossed(arm, its_arm)
    with numpy.errstate(divide="ignore", invalid="ignore"):
        crosses = numpy.maximum(abs(crossed(offset, its_arm) / turned), abs(crossed(offset, arm) / turned)) <= 1.0
    ends = [from_segment(middle + arm, other, its_arm), from_segment(middle - arm, other, its_arm),
            from_segment(other + its_arm, middle, arm), from_segment(other - its_arm, middle, arm)]
    return numpy.where(crosses, 0.0, numpy.min(ends, axis=0))


def test_outlines_are_as_far_apart_as_they_are():
    """What the tests below ask of bodies, on known answers."""
    def far(*numbers):
        return float(between_segments(*(numpy.array(pair, dtype=float) for pair in numbers)))

    assert far((0, 0), (1, 0), (0, 3), (1, 0)) == 3  # side by side
    assert far((0, 0), (1, 0), (4, 0), (1, 0)) == 2  # one after the other
    assert far((0, 0), (1, 0), (0, 0), (0, 1)) == 0  # across each other
    assert far((0, 0), (1, 0), (3, 0), (0, 1)) == 2
    assert far((0, 0), (0, 0), (3, 4), (0, 0)) == 5  # discs
    assert far((0, 0), (1, 0), (4, 4), (0, 0)) == 5


def deepest_overlap(bake, stride=3):
    """Percent of the thickness of two, over all frames looked at; and the mean number of pairs deeper than 1 %."""
    bodies = Bodies(bake)
    furthest = 2.0 * float((bodies.thickness + bodies.half).max())
    worst, pairs, looked = 0.0, 0, 0
    for frame in range(0, len(bodies.data["pos"]), stride):
        alive = numpy.nonzero(bodies.data["state"][frame, :, 0] > 0.5)[0]
        order = alive[numpy.argsort(bodies.data["pos"][frame, alive, 0])]
        (middle, arm), size = bodies.segments(frame, order), bodies.thickness[order]
        looked += 1
        for step in range(1, len(order)):
            if (middle[step:, 0] - middle[:-step, 0]).min() > furthest:
                break
            apart = between_segments(middle[:-step], arm[:-step], middle[step:], arm[step:])
            depth = 1.0 - apart / (size[step:] + size[:-step])
            worst = max(worst, float(depth.max(initial=0.0)))
            pairs += int((depth > 0.01).sum())
    return 100.0 * worst, pairs / max(looked, 1)


def crossings(bake, manifest):
    """How often a straight line between two frames of one person crosses a wall's axis or outline; and the deepest body
    in one (m)."""
    bodies = Bodies(bake)
    data = bodies.data
    count, deepest = 0, -1.0
    for wall in manifest["geometry"]["walls"]:
        points = wall["points"] + (wall["points"][:1] if wall["closed"] else [])
        half = 0.0 if wall["closed"] else 0.5 * wall["thickness"]
        for a, b in zip(numpy.array(points[:-1]), numpy.array(points[1:])):
            axis = b - a
            for frame in range(1, len(data["pos"])):
                alive = (data["state"][frame, :, 0] > 0.5) & (data["state"][frame - 1, :, 0] > 0.5)
                p, q = data["pos"][frame - 1, alive, :2], data["pos"][frame, alive, :2]
                side = lambda x: axis[0] * (x[:, 1] - a[1]) - axis[1] * (x[:, 0] - a[0])
                before, after = side(p), side(q)
                changed = before * after < 0.0
                if changed.any():
                    share = before[changed] / (before[changed] - after[changed])
                    at = p[changed] + (q - p)[changed] * share[:, None]
                    along = (at - a) @ axis / (axis @ axis)
                    count += int(((along >= 0.0) & (along <= 1.0)).sum())
                if frame % 4 == 0 and len(q):
                    middle, arm = bodies.segments(frame, alive)
                    distance = between_segments(middle, arm, 0.5 * (a + b), 0.5 * axis)
                    deepest = max(deepest, float((bodies.thickness[alive] + half - distance).max()))
    return count, deepest


@pytest.mark.parametrize("name, arrived, people", [("circle", 0.99, 256), ("bidirectional", 0.95, 2048),
                                                   ("intersection", 0.95, 1024), ("station", 0.95, 88)])
@pytest.mark.slow
def test_the_examples_arrive_and_nobody_sinks_into_anybody(bakes, manifest_of, name, arrived, people):
    bake = bakes(name)
    account = manifest_of(bake)["account"]
    rows = table(bake)
    assert account["agents"] == len(rows) == people
    assert sum(row["outcome"] == "arrived" for row in rows) == account["arrived"] >= arrived * people
    assert account["walking"] + account["arrived"] + account["refused"] == people
    deepest, pairs = deepest_overlap(bake)
    print(f"{name}: {account['arrived']} of {people} arrived, deepest overlap {deepest:.2f} %, "
          f"{pairs:.3f} pairs a frame")
    assert deepest < 5.0


def test_the_accounts_arrivals_are_where_the_goal_is(bakes, manifest_of):
    bake = bakes("circle")
    last = streams(bake)["pos"][-1]
    for row, end in zip(table(bake), last):
        if row["outcome"] == "arrived":
            assert numpy.hypot(end[0] - float(row["goal_x"]), end[1] - float(row["goal_y"])) < 1.0


def test_nobody_passes_through_a_wall(bakes, manifest_of):
    count, deepest = crossings(bakes("intersection"), manifest_of(bakes("intersection")))
    assert count == 0
    assert deepest < 0.01, "metres"


def test_people_turn_smoothly_and_keep_to_their_speed(bakes):
    data = streams(bakes("intersection"))
    alive = data["state"][:, :, 0] > 0.5
    both = alive[1:] & alive[:-1]
    heading = numpy.arctan2(data["dir"][:, :, 1], data["dir"][:, :, 0])
    turn = numpy.abs((numpy.diff(heading, axis=0) + numpy.pi) % (2 * numpy.pi) - numpy.pi)[both] * 24.0
    assert numpy.degrees(numpy.percentile(turn, 99)) < 180.0
    step = numpy.hypot(*numpy.moveaxis(numpy.diff(data["pos"][:, :, :2], axis=0), 2, 0))[both] * 24.0
    assert numpy.percentile(step, 99) < 1.9 * 1.4 * 1.05
    phase = numpy.diff(data["state"][:, :, 2], axis=0)[both]
    assert phase.min() >= 0.0


def test_the_streams_have_the_promised_shape_in_both_formats(bakes, manifest_of):
    bake = bakes("intersection")
    manifest = manifest_of(bake)
    for name in ("pos", "dir", "state"):
        array = numpy.load(bake / "streams" / f"{name}.npy", mmap_mode="r")
        assert array.dtype == numpy.float32 and array.shape == (manifest["frames"], manifest["agents"], 3)
        assert numpy.isfinite(array).all()
        with open(bake / "streams" / f"{name}.pc2", "rb") as file:
            magic, version, points, start, rate, samples = struct.unpack("<12siiffi", file.read(32))
            assert (magic, version, points, start, rate, samples) == \
                (b"POINTCACHE2\0", 1, manifest["agents"], 1.0, 1.0, manifest["frames"])
            assert numpy.array_equal(numpy.fromfile(file, "<f4").reshape(array.shape), array)


def test_the_table_tells_profiles_and_looks(throng, tmp_path):
    people = {"profile": {"adult": 2, "child": 1, "elderly": 1}, "look": "fans", "colours": ["#a01020", "#ffffff"]}
    layout = {"throng": 1, "simulation": {"duration": 0.2}, "formations": [
        {"id": "club", "type": "circle", "centre": [0, 0], "radius": 30, "count": 60, "people": people},
        {"id": "ring", "type": "circle", "centre": [0, 0], "radius": 8, "count": 5}]}
    throng("bake", write(tmp_path / "lay.json", layout), "-o", tmp_path / "bake", "--no-gltf")
    rows = table(tmp_path / "bake")
    often = Counter((row["group"], row["profile"], row["look"], row["colours"]) for row in rows)
    club = [often.pop(("club", profile, "fans", "#a01020 #ffffff")) for profile in ("adult", "child", "elderly")]
    assert often == {("ring", "", "casual", ""): 5} and sum(club) == 60 and club[0] > 20 and min(club) > 7, club
    assert all((float(row["breadth"]) < 0.37) == (row["profile"] == "child") for row in rows)


def test_the_manifest_lists_the_gaits_that_occur(bakes, manifest_of):
    for name in ("intersection", "hill"):
        manifest = manifest_of(bakes(name))
        activity = streams(bakes(name))["state"][:, :, 0]
        walked = numpy.unique(numpy.round(numpy.mod(activity[activity > 0.5], 1.0) * 16.0))
        assert manifest["gaits"] == walked.astype(int).tolist() \
            and set(manifest["gaits"]) < set(range(len(manifest["strides"])))


def test_rows_hold_still_before_they_enter_and_after_they_leave(bakes):
    data = streams(bakes("intersection"))
    alive = data["state"][:, :, 0] > 0.5
    for row in range(0, alive.shape[1], 37):
        frames = numpy.nonzero(alive[:, row])[0]
        first, last = frames[0], frames[-1]
        assert (data["pos"][:first, row] == data["pos"][first, row]).all()
        left = data["pos"][min(last + 1, len(alive) - 1), row]
        assert numpy.abs(data["pos"][last + 1:, row] - left).max(initial=0.0) == 0.0


def digest(bake):
    return {name: hashlib.sha256((bake / "streams" / name).read_bytes()).hexdigest()
            for name in ("pos.npy", "dir.pc2", "state.npy")}


@pytest.mark.quick
def test_the_same_layout_and_seed_give_the_same_bytes(throng, tmp_path):
    layout = write(tmp_path / "small.json", SMALL)
    for name, seed in (("a", 1), ("b", 1), ("c", 2)):
        throng("bake", layout, "-o", tmp_path / name, "-q", "--no-gltf", "--set", f"simulation.seed={seed}")
    assert digest(tmp_path / "a") == digest(tmp_path / "b") != digest(tmp_path / "c")


def test_fields_solved_on_the_device_lead_the_same_ways(throng, tmp_path, manifest_of):
    detour = {"throng": 1, "simulation": {"duration": 30},
              "roads": [{"id": "one", "centreline": [[0, 12], [40, 12]], "width": 4, "one_way": True}],
              "walls": [{"points": [[20, -8], [20, 9]], "thickness": 0.3},
                        {"points": [[20, 9], [10, 9]], "thickness": 0.3}],
              "areas": [{"id": "goal", "polygon": [[30, -6], [34, -6], [34, -2], [30, -2]]}],
              "formations": [{"id": "some", "type": "grid", "origin": [12, -4], "rows": 3, "columns": 3,
                              "goal": "goal", "people": {"body": "disc"}}]}
    layout = write(tmp_path / "detour.json", detour)
    for where in ("cpu", "gpu", "auto"):
        throng("bake", layout, "-o", tmp_path / where, "-q", "--no-gltf", "--fields", where)
    cpu, gpu = (streams(tmp_path / where) for where in ("cpu", "gpu"))
    assert [manifest_of(tmp_path / where)["account"]["arrived"] for where in ("cpu", "gpu")] == [9, 9]
    assert numpy.abs(cpu["pos"][:48] - gpu["pos"][:48]).max() < 1e-3, \
        "the same ways up to rounding, which crowds make more of later"
    assert all(data["pos"][:, :, 1].min() < -7.5 for data in (cpu, gpu)), "round the end of the wall"
    # Other bits than the CPU's: who resumes with another choice begins anew.
    inputs = {where: manifest_of(tmp_path / where)["inputs"] for where in ("cpu", "gpu", "auto")}
    software = "llvmpipe" in manifest_of(tmp_path / "auto")["device"]["renderer"]
    assert inputs["cpu"] != inputs["gpu"] and inputs["auto"] == inputs["cpu" if software else "gpu"]


@pytest.mark.quick
def test_coordinates_of_utm_size_bake_as_exactly_as_small_ones(throng, tmp_path, manifest_of):
    moved = json.loads(json.dumps(SMALL))
    dx, dy = 395131, 5268347
    for item in moved["roads"]:
        item["centreline"] = [[x + dx, y + dy] for x, y in item["centreline"]]
    for item in moved["walls"]:
        item["points"] = [[x + dx, y + dy] for x, y in item["points"]]
    moved["formations"][0]["centre"] = [10 + dx, 12 + dy]
    for name, layout in (("near", SMALL), ("far", moved)):
        throng("bake", write(tmp_path / f"{name}.json", layout), "-o", tmp_path / name, "-q", "--no-gltf")
    near, far = streams(tmp_path / "near"), streams(tmp_path / "far")
    for name in ("dir", "state"):
        assert numpy.array_equal(near[name], far[name])
    origin = numpy.array(manifest_of(tmp_path / "far")["origin"])
    world = far["pos"].astype(float) + origin - (dx, dy, 0)
    assert numpy.abs(world - near["pos"]).max() < 1e-5
    assert abs(float(table(tmp_path / "far")[0]["goal_x"]) - float(table(tmp_path / "near")[0]["goal_x"]) - dx) < 1e-6


def test_a_bake_is_never_overwritten_without_force(throng, tmp_path):
    layout = write(tmp_path / "small.json", SMALL)
    throng("bake", layout, "-o", tmp_path / "out", "-q", "--no-gltf")
    refused = throng("bake", layout, "-o", tmp_path / "out", "-q", expect=5)
    assert "force" in refused.stderr
    throng("bake", layout, "-o", tmp_path / "out", "-q", "--no-gltf", "--force")
    assert [path.name for path in tmp_path.iterdir() if "tmp" in path.name] == []


# How much packed streams will take is not known before: they find out on the way.
@pytest.mark.parametrize("streams, said", [("npy,pc2", "the disk has room for"), ("packed", "No space left")])
def test_a_full_disk_is_a_clear_error_and_leaves_nothing(throng, tmp_path, streams, said):
    mount = tmp_path / "disk"
    mount.mkdir()
    if subprocess.run(["mount", "-t", "tmpfs", "-o", "size=32k", "none", str(mount)],
                      capture_output=True).returncode != 0:
        pytest.skip("no right to mount a small disk here")
    try:
        failed = throng("bake", write(tmp_path / "small.json", SMALL), "-o", mount / "out", "-q", "--streams", streams,
                        expect=5)
        assert said in failed.stderr
        assert list(mount.iterdir()) == []
    finally:
        subprocess.run(["umount", str(mount)], check=True)


def test_ctrl_c_keeps_what_there_is(throng, tmp_path, manifest_of):
    process = subprocess.Popen([throng.binary, "bake", str(EXAMPLES / "circle.json"), "-o", str(tmp_path / "out"),
                                "--no-gltf", "--json"],
                               stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    while '"frame": ' not in process.stderr.readline():
        assert process.poll() is None
    time.sleep(0.5)
    process.send_signal(signal.SIGINT)
    process.communicate(timeout=HANGS)
    assert process.returncode == 130
    assert not (tmp_path / "out").exists()
    manifest = manifest_of(tmp_path / "out.partial")
    assert manifest["complete"] is False and 0 < manifest["frames"] < 2400
    assert len(numpy.load(tmp_path / "out.partial" / "streams" / "pos.npy", mmap_mode="r")) == manifest["frames"]
    throng("info", tmp_path / "out.partial", "--verify")


@pytest.mark.quick
def test_what_is_set_by_hand_is_in_the_layout_of_the_bake(throng, tmp_path, manifest_of):
    path = write(tmp_path / "ring.json", {"throng": 1, "name": "ring", "simulation": {"duration": 1}, "formations": [
        {"id": "ring", "type": "circle", "centre": [0, 0], "radius": 4, "count": 6}]})
    changes = ["formations.by-id.ring.count=4", "simulation.seed=7", 'expect={"arrived": {"min": 1}}']
    options = ["-q", "--no-gltf", "--proximity", "grid"] + [word for text in changes for word in ("--set", text)]
    throng("bake", path, "-o", tmp_path / "set", *options)
    written = json.loads((tmp_path / "set" / "layout.json").read_text())
    assert written["formations"][0]["count"] == 4 and written["expect"] == {"arrived": {"min": 1}}
    assert written["simulation"] == {"duration": 1, "proximity": "grid", "seed": 7}
    about = manifest_of(tmp_path / "set")["layout"]
    assert about["source"]["file"] == "ring.json" and about["source"]["hash"] != about["hash"]
    assert about["overrides"] == ["simulation.proximity=grid"] + changes
    assert "baked from:   ring.json --set simulation.proximity=grid" in throng("info", tmp_path / "set").stdout
    throng("verify", tmp_path / "set")

    # The layout of the bake gives the same bake, and its bars are heeded: nobody arrives within a second.
    throng("bake", tmp_path / "set" / "layout.json", "-o", tmp_path / "again", "-q", "--no-gltf")
    assert digest(tmp_path / "set") == digest(tmp_path / "again")
    assert "arrived is 0" in throng("measure", tmp_path / "set", expect=1).stderr

    # What it was made from says whether it is complete already, and what others would be.
    told = throng("bake", path, "-o", tmp_path / "set", "--resume", *options[1:]).stdout
    assert "is complete already" in told
    told = throng("bake", path, "-o", tmp_path / "set", "--resume", "-q", expect=5).stderr
    assert "--force" in told


def test_info_says_what_is_wrong_with_a_damaged_bake(throng, tmp_path):
    throng("bake", write(tmp_path / "small.json", SMALL), "-o", tmp_path / "out", "-q", "--no-gltf")
    assert "verified" in throng("info", tmp_path / "out", "--verify").stdout
    stream = tmp_path / "out" / "streams" / "pos.pc2"
    os.truncate(stream, stream.stat().st_size - 5)
    assert "pos.pc2" in throng("info", tmp_path / "out", "--verify", expect=3).stderr


@pytest.mark.quick
def test_the_command_line_speaks_clearly(throng, tmp_path):
    assert "did you mean `bake`?" in throng("bkae", expect=2).stderr
    assert "--second requires --diagrams" in throng("bake", "x.json", "--second", expect=2).stderr
    assert "did you mean `--force`?" in throng("bake", "x.json", "--fource", expect=2).stderr
    wrong = write(tmp_path / "wrong.json", {"throng": 1,
                                            "roads": [{"id": "r", "centreline": [[0, 0], [5, 0]], "widht": 3}]})
    told = throng("check", wrong, expect=3)
    assert "wrong.json:1:" in told.stderr and "did you mean `width`?" in told.stderr
    assert json.loads(throng("check", wrong, "--json",
                             expect=3).stdout)[0]["diagnostics"][0]["pointer"] == "/roads/0/widht"
    assert "No such file" in throng("check", tmp_path / "absent.json", expect=3).stderr
    assert throng("bake", wrong, "-o", tmp_path / "nothing", expect=3).returncode == 3
    assert not (tmp_path / "nothing").exists()
    for command in ("bake", "check", "info", "preview", "schema", "devices", "calibrate", "bench", "measure",
                    "scenarios"):
        assert command in throng("--help").stdout
        assert "Example" in throng(command, "--help").stdout or command == "schema"


def test_a_machine_without_drivers_gets_one_clear_message(throng, tmp_path):
    empty = tmp_path / "no-drivers"
    empty.mkdir()
    environment = {**os.environ, "__EGL_VENDOR_LIBRARY_DIRS": str(empty), "__EGL_VENDOR_LIBRARY_FILENAMES": ""}
    failed = throng("devices", expect=4, env=environment)
    assert "apt-get install" in failed.stderr and "libgl1-mesa-dri" in failed.stderr
    assert throng("bake", EXAMPLES / "circle.json", "-o", tmp_path / "out", expect=4, env=environment).returncode == 4
    assert not (tmp_path / "out").exists()


def test_previews_are_drawn(throng, bakes, tmp_path):
    throng("preview", bakes("intersection"), "-o", tmp_path / "p.png", "--frame", "900", "--width", "700")
    content = (tmp_path / "p.png").read_bytes()
    assert content[:8] == b"\x89PNG\r\n\x1a\n" and struct.unpack(">I", content[16:20])[0] == 700
    assert "there is no frame" in throng("preview", bakes("intersection"), "-o", tmp_path / "q.png", "--frame", "99999",
                                         expect=3).stderr
    small = write(tmp_path / "small.json", SMALL)
    throng("bake", small, "-o", tmp_path / "small", "-q", "--no-gltf")
    throng("preview", tmp_path / "small", "-o", tmp_path / "film.mp4", "--width", "320")
    assert (tmp_path / "film.mp4").read_bytes()[4:8] == b"ftyp"


def test_frames_of_films_are_what_is_drawn_of_them_alone(throng, tmp_path):
    """What lies under people is drawn six times a second in films, and people in every frame."""
    bake = tmp_path / "small"
    throng("bake", write(tmp_path / "small.json", SMALL), "-o", bake, "-q", "--no-gltf")
    frames = (36, 39, 42, 43)  # the first is one for which all is drawn; a frame is 5 cm of a walker's way

    def pixels(picture):
        run = subprocess.run(["ffmpeg", "-loglevel", "error", "-i", picture, "-f", "rawvideo", "-pix_fmt", "gray", "-"],
                             check=True, capture_output=True)
        return numpy.frombuffer(run.stdout, numpy.uint8).astype(int)

    throng("preview", bake, "-o", tmp_path / "film.mp4", "--width", "900")
    chosen = "+".join(f"eq(n\\,{frame})" for frame in frames)
    subprocess.run(["ffmpeg", "-loglevel", "error", "-i", tmp_path / "film.mp4", "-vf", f"select={chosen}", "-vsync", "0",
                    tmp_path / "frame%d.png"], check=True)
    stills = []
    for frame in frames:
        throng("preview", bake, "-o", tmp_path / f"{frame}.png", "--frame", str(frame), "--width", "900")
        stills.append(pixels(tmp_path / f"{frame}.png"))
    apart = [[numpy.abs(pixels(tmp_path / f"frame{i + 1}.png") - still).mean() for still in stills]
             for i in range(len(frames))]
    for i in range(len(frames)):
        assert int(numpy.argmin(apart[i])) == i, apart
        # What is lost in coding is lost in all of them; the rest is little.
        assert apart[i][i] < min(1.5, apart[0][0] + 0.2), apart


def test_previews_show_bodies_as_they_are(throng, tmp_path):
    def picture(people):
        layout = write(tmp_path / "one.json", {"throng": 1, "simulation": {"duration": 1}, "formations": [
            {"id": "one", "type": "grid", "origin": [0, 0], "rows": 1, "columns": 1, "goal": {"offset": [9, 0]},
             "people": {"speed": 1.3, **people}}]})
        throng("bake", layout, "-o", tmp_path / "one", "-q", "--no-gltf", "--force")
        throng("preview", tmp_path / "one", "-o", tmp_path / "one.png", "--frame", "12", "--width", "900", "--trails",
               "0", "--no-density")
        return (tmp_path / "one.png").read_bytes()
    assert picture({"radius": 0.3}) == picture({"radius": 0.29}), "discs are drawn alike"
    assert picture({"body": {"breadth": 0.6, "depth": 0.3}}) != picture({"body": {"breadth": 0.6, "depth": 0.2}})


@pytest.mark.parametrize("kilometres", [1, 4, 16, 20])
def test_people_walk_at_their_speed_on_sites_however_wide(throng, tmp_path, kilometres):
    far = 1000.0 * kilometres
    layout = write(tmp_path / "far.json", {"throng": 1, "simulation": {"duration": 20}, "formations": [
        {"id": "two", "type": "agents", "agents": [{"position": [0, 0], "goal": [far, 0], "speed": 1.3},
                                                   {"position": [far, 5], "goal": [0, 5], "speed": 1.3}]}]})
    throng("bake", layout, "-o", tmp_path / "bake", "-q", "--no-gltf")
    data = streams(tmp_path / "bake")
    seconds = (len(data["pos"]) - 1) / 24.0
    # They start from standing: what that costs is known from a small site.
    near = write(tmp_path / "near.json", {"throng": 1, "simulation": {"duration": 20}, "formations": [
        {"id": "one", "type": "agents", "agents": [{"position": [0, 0], "goal": [50, 0], "speed": 1.3}]}]})
    throng("bake", near, "-o", tmp_path / "small", "-q", "--no-gltf")
    small = streams(tmp_path / "small")
    expected = small["pos"][-1, 0, 0] - small["pos"][0, 0, 0]
    assert expected > 1.3 * seconds - 1.0
    walked = numpy.abs(data["pos"][-1, :, 0] - data["pos"][0, :, 0])
    assert walked == pytest.approx([expected] * 2, rel=1e-3)
    # What is shown is the speed, and no rounding of places.
    assert data["dir"][120:, :, 2] == pytest.approx(numpy.full_like(data["dir"][120:, :, 2], 1.3), rel=1e-3)
