# SPDX-License-Identifier: Apache-2.0
"""Bakes that are stopped, killed and gone on with end as the same bytes."""
import json
import os
import pathlib
import random
import signal
import struct
import subprocess
import time

import pytest

from processor_time import HANGS, let_work, taken_by

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent

# A bit of everything that a checkpoint has to remember: gates, queues, routes round jams, late arrivals, groups, heads.
LAYOUT = json.loads((ROOT / "examples" / "station.json").read_text())
LAYOUT["simulation"].update(duration=30, seed=11)
LAYOUT["attractions"] = [{"id": "bang", "at": LAYOUT["areas"][0]["polygon"][0], "from": 9, "reach": 60, "loud": True}]
# Ground that is slow and avoided for a time, and somebody who walks across the hall by a way that is given.
LAYOUT["patches"] = [{"id": "wet", "polygon": [[-4, -4], [4, -4], [4, 4], [-4, 4]], "cost": 6, "pace": 0.7, "from": 6,
                      "until": 20}]
LAYOUT["given"] = [{"id": "cleaner", "ways": [[[3, -8, -3], [12, 2, 0], [16, 2, 0], [27, 9, 4]]]}]
LAYOUT["simulation"]["walls_hide"] = True
# A tram stop beside it, too: doors, and who gets on and off.
LAYOUT["areas"] += [{"id": "stop", "polygon": [[0, 14], [30, 14], [30, 18], [0, 18]]},
                    {"id": "behind it", "polygon": [[0, 18], [30, 18], [30, 20], [0, 20]]}]
LAYOUT["lanes"] = [{"id": "rails", "points": [[-31, 12.7], [45, 12.7]], "speed": 11, "stops": [
    {"id": "tram", "at": [29, 12.7], "platform": "stop", "dwell": [6, 16]}]}]
LAYOUT["vehicles"] = [{"id": "4", "lane": "rails", "kind": "tram", "times": [0, 3]}]
LAYOUT["flows"] += [{"id": "on", "from": "stop", "board": "tram", "count": 12, "end": 5},
                    {"id": "off", "alight": "tram", "to": "behind it", "count": 6}]
OPTIONS = ["-q", "--density", "--attention", "--diagrams", "120", "--gltf-agents", "20"]


def files_of(bake):
    """All files but what the manifest says of time."""
    found = {}
    for path in sorted(bake.rglob("*")):
        if path.is_file():
            found[str(path.relative_to(bake))] = path.read_bytes()
    manifest = json.loads(found.pop("bake.json"))
    del manifest["timing"], manifest["checksum"]
    return found, manifest


@pytest.fixture(scope="module")
def whole(throng, once):
    def make(folder):
        (folder / "layout.json").write_text(json.dumps(LAYOUT))
        throng("bake", folder / "layout.json", "-o", folder / "bake", *OPTIONS)

    folder = once("whole", make)
    return folder / "layout.json", files_of(folder / "bake")


def start(throng, layout, output, *more, minutes="0.002"):
    return subprocess.Popen([throng.binary, "bake", str(layout), "-o", str(output), *OPTIONS, "--checkpoint", minutes,
                             *more],
                            stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)


def seconds_to_a_checkpoint(throng, layout, output):
    """How long a processor takes to start and to come to the first one."""
    process = start(throng, layout, output)
    while not (output.with_name(output.name + ".unfinished") / "checkpoint.a").exists():
        assert process.poll() is None
        time.sleep(0.002)
    seconds = taken_by(process)
    process.kill()
    process.wait()
    return seconds


@pytest.mark.slow
def test_killed_a_hundred_times_at_random_moments_a_bake_ends_as_the_same_bytes(throng, whole, tmp_path):
    """Moments of its own time on a processor, by how long that takes to start a bake: busy and slow machines come as
    far."""
    layout, expected = whole
    chance = random.Random(5)
    begin = seconds_to_a_checkpoint(throng, layout, tmp_path / "first")
    kills = 0
    bakes = 0
    while kills < 100:
        output = tmp_path / f"bake{bakes}"
        bakes += 1
        while True:
            process = start(throng, layout, output, "--resume")
            let_work(process, begin * chance.uniform(0.2, 2.5))
            process.kill()
            if process.wait() != -signal.SIGKILL:
                assert process.returncode == 0, process.stderr.read()
                break
            kills += 1
        assert files_of(output) == expected
        assert not output.with_name(output.name + ".unfinished").exists()
    print(f"{kills} kills, {bakes} bakes, {begin:.2f} s to a checkpoint")
    assert bakes < kills, "most runs were killed"


@pytest.mark.quick
def test_sigterm_leaves_a_checkpoint_and_85(throng, whole, tmp_path):
    layout, expected = whole
    process = start(throng, layout, tmp_path / "bake")
    while not (tmp_path / "bake.unfinished" / "checkpoint.a").exists():
        assert process.poll() is None
        time.sleep(0.01)
    process.send_signal(signal.SIGTERM)
    assert process.wait(timeout=HANGS) == 85
    assert "--resume" in process.stderr.read()
    assert not (tmp_path / "bake").exists()
    again = throng("bake", layout, "-o", tmp_path / "bake", *OPTIONS, expect=5)
    assert "--resume" in again.stderr
    other = throng("bake", layout, "-o", tmp_path / "bake", *OPTIONS, "--set", "simulation.seed=12", "--resume",
                   expect=5)
    assert "another layout" in other.stderr
    throng("bake", layout, "-o", tmp_path / "bake", *OPTIONS, "--resume")
    assert files_of(tmp_path / "bake") == expected


@pytest.mark.parametrize("damage", ["cut", "flipped", "empty"])
def test_a_torn_checkpoint_is_passed_over_for_the_one_before(throng, whole, tmp_path, damage):
    layout, expected = whole
    process = start(throng, layout, tmp_path / "bake")
    unfinished = tmp_path / "bake.unfinished"
    while not (unfinished / "checkpoint.b").exists():
        assert process.poll() is None
        time.sleep(0.01)
    process.kill()
    process.wait()
    newest = max((unfinished / name for name in ("checkpoint.a", "checkpoint.b")), key=os.path.getmtime)
    content = newest.read_bytes()
    newest.write_bytes({"cut": content[: len(content) // 2], "empty": b"",
                        "flipped": content[:-100] + bytes([content[-100] ^ 1]) + content[-99:]}[damage])
    throng("bake", layout, "-o", tmp_path / "bake", *OPTIONS, "--resume")
    assert files_of(tmp_path / "bake") == expected


@pytest.mark.parametrize("name", ["streams/pos.npy", "streams/state.pc2", "diagrams/diagram.0001.exr"])
def test_what_is_not_what_it_was_at_the_checkpoint_is_refused(throng, whole, tmp_path, name):
    layout, expected = whole
    process = start(throng, layout, tmp_path / "bake")
    unfinished = tmp_path / "bake.unfinished"
    while not (unfinished / "checkpoint.a").exists() or frames_at(unfinished / "checkpoint.a") < 50:
        assert process.poll() is None
        time.sleep(0.01)
    process.kill()
    process.wait()
    damaged = unfinished / name
    content = bytearray(damaged.read_bytes())
    row = 12 * 81
    at = -1 if name.startswith("diagrams") else 128 + 40 * row  # of those who are there by then
    for byte in range(at, 0 if at == -1 else at + row):
        content[byte] ^= 1
    damaged.write_bytes(content)
    told = throng("bake", layout, "-o", tmp_path / "bake", *OPTIONS, "--resume", expect=3)
    assert name in told.stderr and "--force" in told.stderr and not (tmp_path / "bake").exists()
    throng("bake", layout, "-o", tmp_path / "bake", *OPTIONS, "--resume", "--force")
    assert files_of(tmp_path / "bake") == expected


def frames_at(checkpoint):
    """How many frames had been written (io/checkpoint.cpp: a head of 24 bytes, the identity and its length, then
    this)."""
    content = checkpoint.read_bytes()
    return struct.unpack_from("<Q", content, 32 + struct.unpack_from("<Q", content, 24)[0])[0]


def test_killed_before_its_first_frame_is_written_a_bake_goes_on(throng, whole, tmp_path):
    """What is recorded is averaged over frames to come, so the first checkpoints come before the first frame."""
    layout, expected = whole
    checkpoint = tmp_path / "bake.unfinished" / "checkpoint.a"
    for _ in range(20):
        process = start(throng, layout, tmp_path / "bake", "--force", minutes="1e-9")
        while not checkpoint.exists():
            assert process.poll() is None
        process.kill()
        process.wait()
        if frames_at(checkpoint) == 0:
            break
        checkpoint.unlink()
    assert frames_at(checkpoint) == 0
    throng("bake", layout, "-o", tmp_path / "bake", *OPTIONS, "--resume")
    assert files_of(tmp_path / "bake") == expected


def test_both_checkpoints_torn_are_refused_and_force_starts_over(throng, whole, tmp_path):
    layout, expected = whole
    unfinished = tmp_path / "bake.unfinished"
    unfinished.mkdir()
    (unfinished / "checkpoint.a").write_bytes(b"THRONGC1 and then nothing")
    (unfinished / "checkpoint.b").write_bytes(b"")
    told = throng("bake", layout, "-o", tmp_path / "bake", *OPTIONS, "--resume", expect=3)
    assert "checkpoints are damaged" in told.stderr and "--force" in told.stderr
    assert (unfinished / "checkpoint.a").exists() and not (tmp_path / "bake").exists()
    throng("bake", layout, "-o", tmp_path / "bake", *OPTIONS, "--resume", "--force")
    assert files_of(tmp_path / "bake") == expected


def test_a_folder_of_that_name_with_other_things_in_it_is_left_alone(throng, whole, tmp_path):
    layout, _ = whole
    (tmp_path / "bake.unfinished").mkdir()
    (tmp_path / "bake.unfinished" / "thesis.txt").write_text("chapter 1")
    told = throng("bake", layout, "-o", tmp_path / "bake", *OPTIONS, expect=5)
    assert "thesis.txt" in told.stderr
    assert (tmp_path / "bake.unfinished" / "thesis.txt").read_text() == "chapter 1"


def test_two_processes_do_not_bake_into_one_folder(throng, whole, tmp_path):
    layout, _ = whole
    first = start(throng, layout, tmp_path / "bake")
    while not (tmp_path / "bake.unfinished" / "streams").exists():
        assert first.poll() is None
        time.sleep(0.005)
    second = throng("bake", layout, "-o", tmp_path / "bake", *OPTIONS, "--force", expect=5)
    assert "another process" in second.stderr
    assert first.wait(timeout=HANGS) == 0
