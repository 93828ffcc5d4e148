# SPDX-License-Identifier: Apache-2.0
"""Everything that commands write, on disks that fill, fail, go away or are shared: afterwards it is there whole, or not
at all, and whoever waits for it hears of that."""
import errno
import os
import shutil
import subprocess
import sys

import pytest

from conftest import ROOT
from test_bakes import SMALL, write

UNFINISHED = (".new-", ".unfinished-", ".tmp-", ".partial")  # what is left under such a name is nobody's result
EXPORT = [sys.executable, ROOT / "scripts" / "export_batch.py"]
# What each writer is called with; the output comes last.
WRITERS = {"page.html": ["report", "BAKE", "-o"], "picture.png": ["preview", "BAKE", "-o"],
           "film.mp4": ["preview", "BAKE", "--width", "240", "-o"], "layout.json": ["generate", "crossing", "-o"],
           "table.csv": ["batch", "query", "BATCH", "-o"], "table.parquet": ["EXPORT", "BATCH"],
           "plots": ["measure", "BAKE", "--plots"],
           "bake": ["apply", "BAKE", "--overrides", "OVERRIDES", "-q", "-o"]}
FAULTS = [("create", 1, errno.EROFS), ("write", 1, errno.ENOSPC), ("write", 2, errno.EIO), ("sync", 1, errno.EIO),
          ("rename", 1, errno.ENOSPC), ("gone", 2, errno.ESTALE)]
IN_PIECES = ("film.mp4", "bake")  # others are written at once
REPLACED = ("page.html", "picture.png", "film.mp4", "table.csv", "table.parquet")


@pytest.fixture(scope="module")
def sources(throng, once):
    """A bake and a batch for all who only read them."""
    def make(folder):
        base = {**SMALL, "simulation": {"duration": 0.5}}
        family = {"throng_family": 1, "name": "two", "base": base, "bake": {"gltf": False},
                  "axes": [{"name": "seed", "set": "/simulation/seed", "range": [1, 2]}]}
        throng("bake", write(folder / "layout.json", base), "-o", folder / "bake", "--no-gltf", "-q")
        throng("batch", write(folder / "family.json", family), "-o", folder / "batch", "-q")
        write(folder / "overrides.json", {"throng_overrides": 1, "overrides": []})

    return once("writers", make)


@pytest.fixture
def command(throng, sources):
    """The words of the command that writes a file of this name into a folder."""
    def words(name, folder):
        if name.endswith(".mp4") and not shutil.which("ffmpeg"):
            pytest.skip("ffmpeg is not installed")
        if name.endswith(".parquet"):
            pytest.importorskip("pyarrow")
        known = {"BAKE": [sources / "bake"], "BATCH": [sources / "batch"], "OVERRIDES": [sources / "overrides.json"],
                 "EXPORT": EXPORT}
        given = [each for word in WRITERS[name] for each in known.get(word, [word])]
        return [*map(str, [*([] if "EXPORT" in WRITERS[name] else [throng.binary]), *given, folder / name])]

    return words


def content_of(path):
    """Of a file or a folder; None where there is nothing. What a manifest says of time is left out."""
    if not path.exists():
        return None
    if path.is_file():
        return path.read_bytes()
    return {each.relative_to(path).as_posix(): each.read_bytes() for each in sorted(path.rglob("*"))
            if each.is_file() and each.name != "bake.json"}


def leftovers_of(folder):
    return [path.name for path in folder.rglob("*") if path.is_file() and
            not any(mark in path.relative_to(folder).as_posix() for mark in UNFINISHED)]


def run_with(faults, words, folder, **environment):
    return subprocess.run(words, capture_output=True, text=True, env={
        **os.environ, "LD_PRELOAD": str(faults), "THRONG_FAULT_UNDER": str(folder),
        **{name: str(value) for name, value in environment.items()}})


@pytest.mark.parametrize("name, kind, at, reason", [(name, *fault) for name in WRITERS for fault in FAULTS
                                                    if fault[:2] != ("write", 2) or name in IN_PIECES])
def test_what_cannot_be_written_is_told_and_is_not_there(faults, command, tmp_path, name, kind, at, reason):
    words = command(name, tmp_path)
    failed = run_with(faults, words, tmp_path, THRONG_FAULT=f"{kind}:{at}:{reason}")
    assert failed.returncode == (1 if "export_batch" in words[1] else 5), failed.stderr
    assert os.strerror(reason) in failed.stderr and str(tmp_path) in failed.stderr
    assert "Traceback" not in failed.stderr and "terminate" not in failed.stderr
    assert leftovers_of(tmp_path) == [], failed.stderr


@pytest.mark.parametrize("name", REPLACED)
@pytest.mark.parametrize("kind", ["write", "sync", "rename"])
def test_what_cannot_be_replaced_stays_as_it_was(faults, command, tmp_path, name, kind):
    (tmp_path / name).write_text("of yesterday")
    assert run_with(faults, command(name, tmp_path), tmp_path, THRONG_FAULT=f"{kind}:1:5").returncode in (1, 5)
    assert (tmp_path / name).read_text() == "of yesterday"


@pytest.mark.parametrize("name", WRITERS)
def test_killed_at_any_change_it_leaves_all_or_nothing(faults, command, tmp_path, name):
    (tmp_path / "whole").mkdir()
    whole = run_with(faults, command(name, tmp_path / "whole"), tmp_path / "whole",
                     THRONG_FAULT_COUNT=tmp_path / "counts")
    assert whole.returncode == 0, whole.stderr
    expected = content_of(tmp_path / "whole" / name)
    changes = int((tmp_path / "counts").read_text().split()[0])
    assert changes >= 1 and expected
    ends = []
    for at in sorted({1, 2, *range(1, changes + 1, max(1, changes // 6)), changes - 1, changes} - {0}):
        folder = tmp_path / str(at)
        folder.mkdir()
        killed = run_with(faults, command(name, folder), folder, THRONG_FAULT=f"kill:{at}")
        found = content_of(folder / name)
        if name == "plots":  # several pictures, each of them whole
            assert all(expected[key] == value for key, value in (found or {}).items() if ".new-" not in key)
        else:
            assert found in (None, expected), at
        ends.append(killed.returncode)
    assert -9 in ends or name == "film.mp4" and 5 in ends, ends


@pytest.mark.parametrize("name", WRITERS)
def test_two_who_write_the_same_leave_one_of_them_whole(command, tmp_path, name):
    both = [subprocess.Popen(command(name, tmp_path), stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
            for _ in range(2)]
    told = [process.communicate(timeout=60)[1] for process in both]
    codes = sorted(process.returncode for process in both)
    assert codes in ([0, 0], [0, 5]), told
    assert codes == [0, 0] or name in ("layout.json", "bake"), told
    (tmp_path / "alone").mkdir()
    subprocess.run(command(name, tmp_path / "alone"), check=True, stdout=subprocess.DEVNULL)
    assert content_of(tmp_path / name) == content_of(tmp_path / "alone" / name)
    assert sorted(path.name for path in tmp_path.iterdir()) == sorted([name, "alone"])


@pytest.mark.parametrize("name", WRITERS)
def test_no_writer_needs_room_for_temporary_files_elsewhere(command, tmp_path, name):
    nowhere = {**os.environ, "TMPDIR": "/nowhere", "HOME": "/proc", "XDG_CACHE_HOME": "/proc"}
    subprocess.run(command(name, tmp_path), check=True, stdout=subprocess.DEVNULL, env=nowhere)
    assert content_of(tmp_path / name)


@pytest.mark.parametrize("words", [["schema"], ["measure", "BAKE"], ["measure", "BAKE", "--json"], ["info", "BAKE"],
                                   ["verify", "BAKE", "--json", "-q"], ["generate", "crossing"], ["devices"],
                                   ["batch", "query", "BATCH", "--csv"], ["check", "LAYOUT", "--json"], ["--help"],
                                   ["check", "ABSENT", "--json"]], ids=" ".join)
def test_what_cannot_be_printed_is_an_error(throng, sources, words):
    known = {"BAKE": "bake", "BATCH": "batch", "LAYOUT": "layout.json", "ABSENT": "absent"}
    words = [sources / known[word] if word in known else word for word in words]
    with open("/dev/full", "w") as full:
        failed = subprocess.run([throng.binary, *map(str, words)], stdout=full, stderr=subprocess.PIPE, text=True)
    if "absent" in str(words):
        assert failed.returncode == 3 and "absent" in failed.stderr, "the first mistake is told"
    else:
        assert failed.returncode == 5 and len(failed.stderr.splitlines()) == 1, failed.stderr
        assert "standard output" in failed.stderr and os.strerror(errno.ENOSPC) in failed.stderr


@pytest.mark.parametrize("words", [["report", "BAKE", "-o", "OUT.html"], ["preview", "BAKE", "-o", "OUT.png"],
                                   ["preview", "BAKE", "-o", "OUT.mp4"], ["measure", "BAKE"], ["verify", "BAKE"],
                                   ["apply", "BAKE", "--overrides", "OVERRIDES", "-q", "-o", "OUT"]], ids=" ".join)
@pytest.mark.parametrize("at", [1, 2, 5, 9])
def test_a_bake_that_goes_away_while_it_is_read_is_told(throng, faults, sources, tmp_path, words, at):
    known = {"BAKE": sources / "bake", "OVERRIDES": sources / "overrides.json"}
    words = [str(known.get(word, word)).replace("OUT", str(tmp_path / "out")) for word in words]
    failed = run_with(faults, [throng.binary, *words], sources / "bake", THRONG_FAULT=f"read:{at}:{errno.EIO}")
    assert failed.returncode == 3 and os.strerror(errno.EIO) in failed.stderr, failed.stderr
    assert str(sources / "bake") in failed.stderr and list(tmp_path.iterdir()) == []


REAL_DISK = 'mount -t tmpfs -o "$1" disk "$2" && shift 2 && "$@"; code=$?; ls -A "$DISK" >&3; exit $code'


@pytest.mark.parametrize("room", ["none", "half", "read-only"])
@pytest.mark.parametrize("name", ["page.html", "film.mp4", "bake"])
def test_real_disks_that_are_full_or_read_only(command, tmp_path, name, room):
    (tmp_path / "disk").mkdir()
    subprocess.run(command(name, tmp_path), check=True, stdout=subprocess.DEVNULL)
    whole = sum(path.stat().st_size for path in [tmp_path / name, *tmp_path.glob("bake/**/*")] if path.is_file())
    options = {"none": "size=4k", "half": f"size={whole // 8192 * 4}k", "read-only": "ro"}[room]
    assert whole > 2 * 4096, "more than the smallest disk has"
    run = lambda *words: subprocess.run(
        ["sh", "-c", '"$@" 3>&1 >/dev/null', "sh", "unshare", "-rm", "sh", "-c", REAL_DISK, "sh", options,
         str(tmp_path / "disk"), *words], text=True, capture_output=True, env={**os.environ, "DISK": tmp_path / "disk"})
    if not shutil.which("unshare") or run("true").returncode != 0:
        pytest.skip("no file systems can be mounted here")
    failed = run(*command(name, tmp_path / "disk"))
    reason = os.strerror(errno.EROFS if room == "read-only" else errno.ENOSPC)
    assert failed.returncode == 5 and reason in failed.stderr, failed.stderr
    assert failed.stdout == "", "nothing is left on the disk"


@pytest.mark.parametrize("fault", ["kill:4", "kill:25", "kill:40", f"write:5:{errno.ENOSPC}", f"sync:1:{errno.EIO}",
                                   f"gone:60:{errno.ESTALE}"])
def test_a_batch_whose_workers_are_killed_or_find_no_room_goes_on_to_the_same_bytes(throng, faults, sources,
                                                                                   tmp_path, fault):
    words = [throng.binary, "batch", sources / "family.json", "-o", tmp_path / "out", "-q", "--workers", "1"]
    failed = run_with(faults, words, tmp_path / "out" / "bakes", THRONG_FAULT=fault)
    assert failed.returncode != 0 and "Traceback" not in failed.stderr, failed.stderr
    told = throng("batch", "query", tmp_path / "out", "--failed", "--json", expect=None)
    assert told.returncode != 0 or any(reason in told.stdout for reason in (
        "was killed by signal 9", os.strerror(errno.ENOSPC), os.strerror(errno.EIO), os.strerror(errno.ESTALE)))
    throng(*words[1:])
    assert "2 of 2 bakes are whole" in throng("verify", tmp_path / "out", "-q").stdout
    for bake in (sources / "batch" / "bakes").iterdir():
        assert content_of(tmp_path / "out" / "bakes" / bake.name) == content_of(bake)
    assert sorted(path.name for path in (tmp_path / "out" / "bakes").iterdir()) == \
        sorted(path.name for path in (sources / "batch" / "bakes").iterdir())
