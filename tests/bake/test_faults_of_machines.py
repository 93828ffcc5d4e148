# SPDX-License-Identifier: Apache-2.0
"""Disks, clocks, devices and neighbours that fail: afterwards a bake is complete, absent, or goes on to the same
bytes."""
import errno
import json
import os
import subprocess

import pytest

from conftest import ROOT
from processor_time import HANGS
from test_bakes import SMALL, write

LAYOUT = {**SMALL, "simulation": {"duration": 0.5}}
OPTIONS = ["-q", "--diagrams", "6", "--checkpoint", "1e-9"]


def content_of(bake):
    found = {path.relative_to(bake).as_posix(): path.read_bytes() for path in bake.rglob("*") if path.is_file()}
    manifest = json.loads(found.pop("bake.json"))
    del manifest["timing"], manifest["checksum"]
    return found, manifest


@pytest.fixture(scope="module")
def whole(throng, once, faults):
    """Layout, what comes of it, and how many changes of files and questions after the device that takes."""
    def make(folder):
        layout = write(folder / "layout.json", LAYOUT)
        run(throng, faults, layout, folder / "bake", 0, THRONG_FAULT_COUNT=folder / "counts")

    folder = once("fault-whole", make)
    counts = [int(word) for word in (folder / "counts").read_text().split()]
    return folder / "layout.json", content_of(folder / "bake"), counts[0]


def run(throng, faults, layout, output, expect, options=OPTIONS, **environment):
    return throng("bake", layout, "-o", output, *options, expect=expect,
                  env={**os.environ, "LD_PRELOAD": str(faults), "THRONG_FAULT_UNDER": str(output),
                       **{name: str(value) for name, value in environment.items()}})


def ends_well(throng, whole, output):
    """Complete, or absent and gone on with; to the same bytes."""
    layout, expected, _ = whole
    if output.exists():
        throng("verify", output, "-q")
        assert content_of(output) == expected or (output / "checkpoint.a").exists() \
            or (output / "checkpoint.b").exists()
    throng("bake", layout, "-o", output, *OPTIONS, "--resume")
    assert content_of(output) == expected
    assert [path.name for path in output.parent.iterdir()] == [output.name]


@pytest.mark.parametrize("part", range(8))
def test_killed_at_any_change_of_a_file_it_goes_on_to_the_same_bytes(throng, faults, whole, tmp_path, part):
    layout, _, changes = whole
    assert changes > 100
    # The end has the most kinds of changes in the fewest: bake.json, names, what is tidied.
    at = (1, 3, 40, changes // 2, changes - 60, changes - 12, changes - 5, changes - 1)[part]
    run(throng, faults, layout, tmp_path / "bake", -9, THRONG_FAULT=f"kill:{at}")
    ends_well(throng, whole, tmp_path / "bake")


@pytest.mark.parametrize("kind, at, reason", [
    ("mkdir", 1, errno.EROFS), ("create", 3, errno.ENOSPC), ("write", 1, errno.ENOSPC), ("write", 60, errno.ENOSPC),
    ("write", 90, errno.EIO), ("sync", 1, errno.EIO), ("sync", 40, errno.ESTALE), ("rename", 1, errno.EROFS),
    ("rename", 8, errno.ENOSPC), ("any", 200, errno.EROFS), ("gone", 1, errno.EIO), ("gone", 30, errno.ENODEV),
    ("gone", 150, errno.ESTALE), ("gone", -8, errno.ENOTCONN)])
def test_a_disk_that_fails_is_told_and_leaves_nothing_that_looks_whole(throng, faults, whole, tmp_path, kind, at,
                                                                      reason):
    at += whole[2] if at < 0 else 0  # where the bake is complete and gets its name
    failed = run(throng, faults, whole[0], tmp_path / "bake", 5, THRONG_FAULT=f"{kind}:{at}:{reason}")
    assert os.strerror(reason) in failed.stderr and str(tmp_path) in failed.stderr
    assert len(failed.stderr.splitlines()) == 1 and not (tmp_path / "bake").exists()
    ends_well(throng, whole, tmp_path / "bake")


def test_a_clock_that_jumps_changes_nothing(throng, faults, whole, tmp_path):
    changes = []
    for name, clock in (("steady", {}), ("jumps", {"THRONG_CLOCK": 1})):
        run(throng, faults, whole[0], tmp_path / name, 0, [*OPTIONS[:-1], "30"],
            THRONG_FAULT_COUNT=tmp_path / "count", **clock)
        assert content_of(tmp_path / name) == whole[1]
        changes.append((tmp_path / "count").read_text().split()[0])
    assert changes[0] == changes[1], "an hour on the clock is not half an hour of work: no checkpoint is due"


def test_without_any_room_for_temporary_files_it_bakes(throng, faults, whole, tmp_path):
    run(throng, faults, whole[0], tmp_path / "bake", 0, TMPDIR="/nowhere", HOME="/proc", XDG_CACHE_HOME="/proc")
    assert content_of(tmp_path / "bake") == whole[1]


def test_a_lost_device_keeps_the_last_checkpoint(throng, faults, whole, tmp_path):
    lost = run(throng, faults, whole[0], tmp_path / "bake", 85, THRONG_LOSE=20)
    assert "the GPU was reset" in lost.stderr and "--resume" in lost.stderr and not (tmp_path / "bake").exists()
    ends_well(throng, whole, tmp_path / "bake")


def test_a_device_lost_before_the_first_checkpoint_leaves_nothing(throng, faults, whole, tmp_path):
    lost = run(throng, faults, whole[0], tmp_path / "bake", 4, THRONG_LOSE=1)
    assert "the GPU was reset" in lost.stderr and list(tmp_path.iterdir()) == []


def test_two_processes_on_one_folder_make_one_bake(throng, whole, tmp_path):
    layout, expected, _ = whole
    words = [throng.binary, "bake", str(layout), "-o", str(tmp_path / "bake"), *OPTIONS, "--resume"]
    both = [subprocess.Popen(words, stderr=subprocess.PIPE, text=True) for _ in range(2)]
    told = [process.communicate(timeout=HANGS)[1] for process in both]
    codes = sorted(process.returncode for process in both)
    assert codes in ([0, 0], [0, 5]) and all(process.returncode == 0 or "another process" in said or "exists" in said
                                             for process, said in zip(both, told)), (codes, told)
    assert content_of(tmp_path / "bake") == expected


def test_two_batches_on_one_folder_make_one_batch(throng, tmp_path):
    family = write(tmp_path / "family.json", {"throng_family": 1, "name": "two", "base": LAYOUT, "bake": {"gltf": False},
                                              "axes": [{"name": "seed", "set": "/simulation/seed", "range": [1, 2]}]})
    words = [throng.binary, "batch", str(family), "-o", str(tmp_path / "out"), "-q", "--workers", "1"]
    both = [subprocess.Popen(words, stderr=subprocess.PIPE, text=True) for _ in range(2)]
    for process in both:
        process.communicate(timeout=HANGS)
    throng(*words[1:])
    assert "2 of 2 bakes are whole" in throng("verify", tmp_path / "out", "-q").stdout


def test_too_little_memory_is_told_in_one_line(throng):
    """However little, and whichever thread it is that runs out of it."""
    told = set()
    for most in range(60, 360, 20):  # MiB of addresses: 340 are enough, and with 60 no thread can be begun
        process = subprocess.run(["prlimit", f"--as={most << 20}", throng.binary, "check",
                                  ROOT / "scenarios" / "corridor.json"], capture_output=True, text=True, timeout=HANGS)
        assert process.returncode in (0, 3), (most, process)
        assert len(process.stderr.splitlines()) <= 1 and "terminate" not in process.stderr, (most, process)
        told.add(process.stderr)
    assert "throng: there is not enough memory for this\n" in told
