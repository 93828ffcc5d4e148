# SPDX-License-Identifier: Apache-2.0
"""Bakes in the background, as the add-on starts them: progress, cancelling, failures, and the program that is run."""
import time

import pytest

from conftest import EXAMPLES
from processor_time import HANGS
import results  # noqa: F401  it puts the add-on on the path
from throng.authoring.bake_job import BakeJob, check_layout, parse_diagnostics
from throng.authoring.executable import ExecutableError, check_version, find_executable


def wait_for(job, condition, seconds=HANGS):
    end = time.monotonic() + seconds
    while not condition() and time.monotonic() < end:
        job.poll()
        time.sleep(0.01)
    assert condition(), (job.state, job.message)


def test_a_job_bakes_and_tells_how_far_it_is(throng, tmp_path):
    job = BakeJob(throng.binary, str(EXAMPLES / "circle.json"), str(tmp_path / "bake"),
                  ["--set", "simulation.duration=6", "--no-gltf"])
    assert job.poll() == "new"
    job.start()
    seen = []
    wait_for(job, lambda: seen.append(job.frame) or job.state != "running")
    assert job.state == "done" and job.percent == 100.0 and seen == sorted(seen)
    assert job.frames == 144 and job.people == job.result["agents"] == 256 and job.diagnostics == []
    assert [path.name for path in tmp_path.iterdir()] == ["bake"]


@pytest.mark.parametrize("when", ["at once", "under way"])
def test_a_cancelled_job_leaves_what_was_there_before_and_nothing_else(throng, tmp_path, when):
    (tmp_path / "bake.partial").mkdir()  # of somebody who stopped a bake by hand
    (tmp_path / "bake.partial" / "bake.json").write_text("{}")
    job = BakeJob(throng.binary, str(EXAMPLES / "circle.json"), str(tmp_path / "bake"),
                  ["--set", "simulation.duration=3000"])
    job.start()
    if when == "under way":
        wait_for(job, lambda: job.frame > 20)
    job.cancel()
    assert job.wait(HANGS) == "cancelled" and job.message == "the bake was cancelled"
    left = {path.name for path in tmp_path.iterdir()}
    assert left <= {"bake.partial"} and (when == "under way" or left == {"bake.partial"})
    job.cancel()
    assert job.poll() == "cancelled"


def test_a_job_that_fails_says_why(throng, tmp_path):
    layout = tmp_path / "layout.json"
    layout.write_text('{"throng": 1,\n "roads": [{"id": "a", "centreline": [[0, 0], [9, 0]], "width": 0}],\n '
                      '"flows": [{"id": "f", "from": "b", "to": "a:end", "count": 1}]}')
    job = BakeJob(throng.binary, str(layout), str(tmp_path / "bake"))
    job.start()
    assert job.wait(HANGS) == "failed" and job.code == 3
    said = [(entry.severity, entry.pointer, entry.line) for entry in job.diagnostics]
    assert said == [("error", "/roads/0/width", 2), ("error", "/flows/0/from", 3)]
    assert job.diagnostics[1].hint.startswith("known here: a:start") and job.message.endswith("(and 1 more)")
    assert [path.name for path in tmp_path.iterdir()] == ["layout.json"]
    assert check_layout(throng.binary, str(layout))[1] == job.diagnostics
    job = BakeJob(throng.binary, str(EXAMPLES / "circle.json"), "/proc/no/bake")
    job.start()
    assert job.wait(HANGS) == "failed" and "/proc/no" in job.message and "throng:" not in job.message
    job = BakeJob(str(tmp_path / "absent"), str(layout), str(tmp_path / "bake"))
    job.start()
    assert job.state == "failed" and "does not run" in job.message


def test_a_job_whose_program_is_killed_says_so(throng, tmp_path):
    job = BakeJob(throng.binary, str(EXAMPLES / "circle.json"), str(tmp_path / "bake"),
                  ["--set", "simulation.duration=3000"])
    job.start()
    wait_for(job, lambda: job.frame > 2)
    job._process.kill()
    assert job.wait(HANGS) == "failed" and "signal 9" in job.message and list(tmp_path.iterdir()) == []


def test_diagnostics_are_read_from_what_the_program_says():
    text = ("lay out.json:4:20: error: /roads/0/width: 0 is out of range: expected at least 0.5\n"
            "  \"width\": 0\n           ^\n  hint: write 3\n"
            "lay out.json:9:1: warning: /flows/0/to/choose/main street: nobody: goes there\n"
            "lay out.json: error: a layout begins with {\"throng\": 1}\n")
    first, second, third = parse_diagnostics(text)
    assert first == ("error", "/roads/0/width", "0 is out of range: expected at least 0.5", "write 3", 4, 20)
    assert second[:3] == ("warning", "/flows/0/to/choose/main street", "nobody: goes there")
    assert third[:3] == ("error", "", 'a layout begins with {"throng": 1}')


def program(path, says, code=0):
    path.write_text(f"#!/bin/sh\nprintf '%s\\n' '{says}'\nexit {code}\n")
    path.chmod(0o755)
    return str(path)


def test_the_program_is_found_and_its_version_checked(throng, tmp_path, monkeypatch):
    monkeypatch.delenv("THRONG_BINARY", raising=False)
    assert check_version(throng.binary).count(".") == 2
    with pytest.raises(ExecutableError, match="version 9.4.0, this add-on needs 0.1"):
        check_version(program(tmp_path / "newer", "throng 9.4.0"))
    with pytest.raises(ExecutableError, match="is not Throng"):
        check_version(program(tmp_path / "other", "ls (GNU coreutils) 9.1"))
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(ExecutableError, match="not on the PATH.*Preferences"):
        find_executable()
    assert find_executable(throng.binary) == throng.binary
    program(tmp_path / "throng", "throng 0.1.7")
    assert find_executable() == str(tmp_path / "throng") and check_version(find_executable()) == "0.1.7"
    with pytest.raises(ExecutableError, match="is a folder"):
        find_executable(str(tmp_path))
    monkeypatch.setenv("THRONG_BINARY", str(tmp_path / "newer"))
    assert find_executable() == str(tmp_path / "newer")
