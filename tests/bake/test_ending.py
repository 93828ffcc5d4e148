# SPDX-License-Identifier: Apache-2.0
"""Bakes that end once everybody has left (simulation.ends_when_empty)."""
import json
import signal
import subprocess

import numpy
import pytest

from processor_time import HANGS, let_work

ROOM = {"throng": 1, "simulation": {"duration": 60, "ends_when_empty": True},
        "roads": [{"id": "road", "centreline": [[0, 0], [20, 0]], "width": 6}],
        "flows": [{"id": "f", "from": "road:start", "to": "road:end", "count": 30, "end": 8}]}
STREAMS = ("pos", "dir", "state")


def bake_of(throng, folder, layout, name="bake", *options):
    (folder / f"{name}.json").write_text(json.dumps(layout))
    throng("bake", folder / f"{name}.json", "-o", folder / name, "-q", *options)
    return folder / name


def there(bake):
    """By frame, whether anybody is."""
    return (numpy.load(bake / "streams" / "state.npy")[:, :, 0] > 0.5).any(axis=1)


def manifest(bake):
    return json.loads((bake / "bake.json").read_text())


def files_of(bake):
    return {str(path.relative_to(bake)): path.read_bytes() for path in sorted(bake.rglob("*"))
            if path.is_file() and path.name != "bake.json"}


@pytest.mark.quick
def test_it_has_a_second_without_anybody_and_is_the_same_until_then(throng, tmp_path):
    short = bake_of(throng, tmp_path, ROOM)
    whole = bake_of(throng, tmp_path, ROOM, "whole", "--set", "simulation.ends_when_empty=false")
    told = manifest(short)
    last = int(numpy.nonzero(there(whole))[0].max())
    assert told["frames"] == last + 1 + 25 and told["complete"] and manifest(whole)["frames"] == 1440
    assert told["timing"]["steps"] == 2 * (told["frames"] - 1)
    for name in STREAMS:
        ended, ended_later = (numpy.load(bake / "streams" / f"{name}.npy") for bake in (short, whole))
        assert len(ended) == told["frames"] and numpy.array_equal(ended, ended_later[:len(ended)])
    assert (short / "agents.csv").read_bytes() == (whole / "agents.csv").read_bytes()
    throng("verify", short)
    measured = [json.loads(throng("measure", bake, "--json").stdout) for bake in (short, whole)]
    assert measured[0]["seconds"] == measured[1]["seconds"] and measured[0]["arrived"] == 30
    assert measured[0]["duration"] == pytest.approx(told["frames"] / 24, abs=1e-3)
    throng("bake", tmp_path / "bake.json", "-o", tmp_path / "again", "-q")
    assert files_of(tmp_path / "again") == files_of(short), "however late it is seen that nobody is left"


def test_it_goes_on_while_somebody_stays_or_is_to_come(throng, tmp_path):
    staying = {**ROOM, "simulation": {**ROOM["simulation"], "duration": 30},
               "areas": [{"id": "corner", "polygon": [[5, 4], [9, 4], [9, 8], [5, 8]]}],
               "formations": [{"id": "one", "type": "grid", "origin": [1, 6], "rows": 1, "columns": 1,
                               "goal": {"offset": [6, 0]}, "arrival": "stay"}]}
    assert manifest(bake_of(throng, tmp_path, staying, "staying"))["frames"] == 720
    late = {**ROOM, "flows": [*ROOM["flows"], {"id": "late", "from": "road:start", "to": "road:end", "count": 1,
                                               "start": 40, "end": 41}]}
    seen = there(bake_of(throng, tmp_path, late, "late"))
    assert not seen[35 * 24:40 * 24].any() and seen[42 * 24] and len(seen) == numpy.nonzero(seen)[0].max() + 26 < 1440


def test_who_came_and_went_before_the_first_frame_is_not_waited_for(throng, tmp_path):
    warm = {**ROOM, "simulation": {**ROOM["simulation"], "warmup": 30},
            "flows": [{"id": "f", "from": "road:start", "to": "road:end", "rate": 1, "end": 6}]}
    bake = bake_of(throng, tmp_path, warm)
    arrived = numpy.loadtxt(bake / "agents.csv", delimiter=",", skiprows=1, dtype=str)
    seen = numpy.load(bake / "streams" / "state.npy")[:, :, 0] > 0.5
    assert 0 < seen.any(axis=0).sum() < len(arrived), "some were there, and some before"
    assert manifest(bake)["frames"] == numpy.nonzero(seen.any(axis=1))[0].max() + 26 < 1440


def test_one_that_was_stopped_again_and_again_ends_as_the_same_bytes(throng, tmp_path):
    crowd = {**ROOM, "flows": [{**ROOM["flows"][0], "count": 200, "end": 20}]}
    options = ("-q", "--diagrams", "6")
    expected = files_of(bake_of(throng, tmp_path, crowd, "whole", *options))
    for stops in range(100):
        process = subprocess.Popen([throng.binary, "bake", tmp_path / "whole.json", "-o", tmp_path / "bake", *options,
                                    "--resume"], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
        if let_work(process, 0.2):
            process.send_signal(signal.SIGTERM)
        process.wait(timeout=HANGS)
        if process.returncode == 0:
            break
        assert process.returncode == 85, process.stderr.read()
    assert files_of(tmp_path / "bake") == expected
    assert stops >= 3
