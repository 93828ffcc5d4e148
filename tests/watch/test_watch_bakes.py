# SPDX-License-Identifier: Apache-2.0
"""`throng watch BAKE`: a bake under way is seen as far as it has come, and is none the worse for it."""
import hashlib
import json
import signal
import subprocess

import numpy
import pytest

from watching import LAYOUT, check_vehicles, state_of, until, watching, write

LONG = {**LAYOUT, "simulation": {"duration": 90, "seed": 4},
        "lanes": [{"id": "street", "points": [[-60, -30], [60, -30]]}],
        "vehicles": [{"id": "cars", "lane": "street", "times": [0, 4, 40, 80]}]}


def bake_of(throng, folder, *options):
    write(folder / "layout.json", LONG)
    return subprocess.Popen([throng.binary, "bake", folder / "layout.json", "-o", folder / "bake", "-q", "--no-gltf",
                             *options], stderr=subprocess.PIPE, text=True)


def under_way(baking, folder):
    """Waits until there is something of it to see."""
    def has_begun():
        assert baking.poll() is None, baking.stderr.read()
        return list(folder.glob("bake.*/under-way.json"))
    until(has_begun)


@pytest.mark.parametrize("options", [[], ["--checkpoint", "0"], ["--streams", "packed"], ["--streams", "pc2"]],
                         ids=["npy", "no checkpoints", "packed", "pc2"])
def test_a_bake_under_way_is_seen_as_far_as_it_has_come(throng, tmp_path, options):
    baking = bake_of(throng, tmp_path, *options)
    under_way(baking, tmp_path)
    baking.send_signal(signal.SIGSTOP)  # so that it is under way for as long as this test likes
    try:
        with watching(throng, tmp_path / "bake") as job:
            until(lambda: state_of(job) == "baking", job)
            first, expected = job.crowd, job.crowd.about["frames"]
            assert expected == 2160 and job.told["frame"] < expected and len(first.frames) < 721
            baking.send_signal(signal.SIGCONT)
            until(lambda: len(first.frames) > 3 or job.crowd is not first, job)
            until(lambda: state_of(job) == "baked", job)
            assert baking.wait(60) == 0
            crowd = job.crowd
            assert len(crowd.frames) == 721 and crowd.frames[-1] == expected - 1
    finally:
        baking.send_signal(signal.SIGCONT)
        baking.wait(120)
    assert not list(tmp_path.rglob("under-way.json")), "it goes when the bake is there"
    throng("verify", tmp_path / "bake")
    if not options:
        check(crowd, first, tmp_path / "bake")
        again = bake_of(throng, tmp_path, "--force")
        digest = lambda: hashlib.sha256((tmp_path / "bake" / "streams" / "pos.npy").read_bytes()).hexdigest()
        watched = digest()
        assert again.wait(120) == 0 and digest() == watched


def check(crowd, first, bake):
    places = numpy.load(bake / "streams" / "pos.npy")
    there = numpy.load(bake / "streams" / "state.npy")[:, :, 0] > 0.5
    assert first.about["group"] == crowd.about["group"] and first.about["radii"] == crowd.about["radii"]
    for seen in (first, crowd):
        for frame in seen.frames[::40]:
            found, rows = seen.at(frame)
            assert rows.tolist() == numpy.nonzero(there[frame])[0].tolist()
            # Who walks past the scene's end is seen at its edge.
            least, most = numpy.array(crowd.about["minimum"]), 65535 * crowd.about["quantum"]
            baked = numpy.clip(places[frame, rows, :2], least, least + most)
            assert numpy.abs(found[:, :2] - baked).max(initial=0.0) < 0.51 * crowd.about["quantum"]
    vehicles = numpy.load(bake / "vehicles.npy")
    for seen in (first, crowd):
        check_vehicles(seen, vehicles)
        assert (vehicles[seen.frames, :, 6] > 0).any(), "there are some to see"


def test_a_bake_that_is_stopped_stays_in_view(throng, tmp_path):
    # Longer than the test needs and no longer: room on the disk for all of it is asked for at its beginning.
    baking = bake_of(throng, tmp_path, "--streams", "npy", "--set", "simulation.duration=900")
    under_way(baking, tmp_path)
    with watching(throng, tmp_path / "bake") as job:
        until(lambda: state_of(job) == "baking" and len(job.crowd.frames) > 5, job)
        seen = job.crowd
        baking.send_signal(signal.SIGINT)
        assert baking.wait(60) == 130
        until(lambda: state_of(job) == "gone", job)
        assert job.crowd is seen and len(seen.frames) > 5
    with watching(throng, tmp_path / "bake.partial") as job:
        until(lambda: state_of(job) == "partial", job)
        about = json.loads((tmp_path / "bake.partial" / "bake.json").read_text())
        assert job.crowd.frames[-1] == about["frames"] - 1


def test_a_checkpoint_is_gone_on_from_as_ever(throng, tmp_path):
    baking = bake_of(throng, tmp_path, "--checkpoint", "0.001")
    places = tmp_path / "bake.unfinished" / "streams" / "pos.npy"
    until(lambda: places.exists() and places.stat().st_size > 100_000)
    baking.send_signal(signal.SIGTERM)
    assert baking.wait(60) in (85, 0), "it may have been quicker"
    with watching(throng, tmp_path / "bake") as job:
        until(lambda: state_of(job) in ("baking", "baked"), job)
        again = bake_of(throng, tmp_path, "--checkpoint", "0.001", "--resume")
        assert again.wait(120) == 0
        until(lambda: state_of(job) == "baked", job)
    throng("verify", tmp_path / "bake")


def test_a_bake_that_was_killed_is_begun_anew(throng, tmp_path):
    """What it leaves, its vehicles too, is known to be a bake's."""
    baking = bake_of(throng, tmp_path)
    under_way(baking, tmp_path)
    until(lambda: list(tmp_path.glob("bake.*/vehicles.npy")))
    baking.kill()
    baking.wait(60)
    assert not (tmp_path / "bake").exists()
    throng("bake", tmp_path / "layout.json", "-o", tmp_path / "bake", "-q", "--no-gltf", "--force",
           "--set", "simulation.duration=2")
    throng("verify", tmp_path / "bake")
    assert not list(tmp_path.glob("bake.*"))
