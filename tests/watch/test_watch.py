# SPDX-License-Identifier: Apache-2.0
"""`throng watch LAYOUT`: what is seen is what would be baked, at once when the layout changes; mistakes are told."""
import copy
import http.client
import json
import signal
import socket
import subprocess
import time

import numpy
import pytest

from conftest import EXAMPLES
from watching import LAYOUT, check_vehicles, state_of, until, watching, write

# Where in the world single-precision numbers are half a metre apart.
FAR = {**copy.deepcopy(LAYOUT), "walls": [],
       "areas": [{"id": area["id"], "polygon": [[x + 448262.125, y + 5411932.5] for x, y in area["polygon"]]}
                 for area in LAYOUT["areas"]]}


@pytest.fixture
def layout(tmp_path):
    path = tmp_path / "layout.json"
    write(path, LAYOUT)
    return path


def ask(port, path="/", method="GET", host=None):
    connection = http.client.HTTPConnection("127.0.0.1", port, timeout=30)
    connection.request(method, path, headers={"Host": host} if host else {})
    answer = connection.getresponse()
    return answer.status, answer.read().decode(), dict(answer.getheaders())


@pytest.mark.parametrize("name", ["crossing paths", "far", "station-levels", "zebra", "stadium-wave"])
def test_moments_are_those_of_a_bake(throng, tmp_path, name):
    path, settings = EXAMPLES / f"{name}.json", ["--set", "simulation.duration=4"]
    if name in ("crossing paths", "far"):
        path, settings = tmp_path / "layout.json", []
        write(path, FAR if name == "far" else LAYOUT)
    throng("bake", path, "-o", tmp_path / "bake", "-q", "--no-gltf", *settings)
    places = numpy.load(tmp_path / "bake" / "streams" / "pos.npy")
    there = numpy.load(tmp_path / "bake" / "streams" / "state.npy")[:, :, 0] > 0.5
    about = json.loads((tmp_path / "bake" / "bake.json").read_text())
    with watching(throng, path, *settings) as job:
        until(lambda: state_of(job) == "complete", job)
        crowd = job.crowd
        assert crowd.frames == [*range(0, len(places) - 1, 3), len(places) - 1] and crowd.count == places.shape[1]
        assert crowd.about["origin"] == about["origin"][:2]
        half = 0.5001 * crowd.about["quantum"]
        for i, frame in enumerate(crowd.frames):
            found, rows = crowd.at(frame)
            assert rows.tolist() == numpy.nonzero(there[frame])[0].tolist(), frame
            assert numpy.abs(found[:, :2] - places[frame, rows, :2]).max(initial=0.0) <= half + 1e-5, frame
            if name == "station-levels":  # heights are those of whole floors
                on_floor = crowd._storeys[i][rows] <= len(crowd.about["geometry"]["levels"])
                assert numpy.abs(found[on_floor, 2] - places[frame, rows, 2][on_floor]).max(initial=0.0) < 0.4
        assert there.sum() > 500
    if name == "zebra":
        check_vehicles(crowd, numpy.load(tmp_path / "bake" / "vehicles.npy"))


def test_a_change_is_seen_at_once(throng, tmp_path):
    """2 s on a machine that does nothing else (docs/how-to/live.md has what was measured); here, others work, too."""
    path = tmp_path / "market.json"
    market = json.loads((EXAMPLES / "market.json").read_text())
    write(path, market)
    with watching(throng, path) as job:
        until(lambda: job.crowd and len(job.crowd.frames) > 50, job)
        first, before = job.crowd, job.listener.crowds
        market["walls"][0]["points"] = [[x + 1.0, y] for x, y in market["walls"][0]["points"]]
        write(path, market)
        begin = time.monotonic()
        until(lambda: job.listener.crowds > before and len(job.crowd.frames) > 10, job)
        seconds = time.monotonic() - begin
        print(f"a changed market after {seconds:.2f} s")
        assert seconds < 30.0
        assert job.crowd is not first and job.crowd.frames[0] == 0
        walls = job.crowd.about["geometry"]["walls"]
        assert walls[0]["points"][:2] != first.about["geometry"]["walls"][0]["points"][:2]
    assert [each.name for each in tmp_path.iterdir()] == ["market.json"], "nothing is written"


def test_mistakes_are_told_and_the_crowd_before_them_stays(throng, tmp_path):
    path = tmp_path / "layout.json"
    write(path, '{"throng": 1,\n "walls": [{"points": [[0, 0], [5, 0]], "thick": 0.2}]}')
    with watching(throng, path) as job:
        until(lambda: state_of(job) == "mistaken", job)
        assert job.crowd is None
        mistake, = job.told["diagnostics"]
        assert (mistake["line"], mistake["pointer"]) == (2, "/walls/0/thick") and "thickness" in mistake["hint"]
        assert f"{path}:2:" in job.told["texts"][0]
        write(path, LAYOUT)
        until(lambda: state_of(job) == "complete", job)
        kept = job.crowd
        write(path, json.dumps(LAYOUT, indent=1).replace('"east"', '"eastt"', 1))
        until(lambda: state_of(job) == "mistaken", job)
        assert job.crowd is kept and job.told["diagnostics"][0]["severity"] == "error"
        assert job.told["diagnostics"][0]["hint"]
        path.unlink()
        until(lambda: "layout.json" in " ".join(job.told["texts"]) and not job.told["diagnostics"], job)
        write(path, LAYOUT)
        until(lambda: state_of(job) == "complete" and job.crowd is not kept, job)
    assert any("eastt" in line for line in job._errors), "the terminal says so, too"


def test_what_the_layout_names_is_watched_as_well(throng, tmp_path):
    for name in ("hill.json", "hill.glb"):
        source = EXAMPLES / name
        if not source.exists():
            pytest.skip("there is no hill")
        (tmp_path / name).write_bytes(source.read_bytes())
    with watching(throng, tmp_path / "hill.json", "--set", "simulation.warmup=0") as job:
        until(lambda: state_of(job) == "complete", job)
        (tmp_path / "hill.glb").write_bytes(b"no terrain")
        until(lambda: state_of(job) == "mistaken", job)
        assert job.told["diagnostics"][0]["pointer"] == "/terrain/file"


def test_memory_has_an_end(throng, tmp_path):
    with watching(throng, EXAMPLES / "circle.json", "--memory", "1", "--moments", "24") as job:
        until(lambda: state_of(job) == "full", job)
        crowd = job.crowd
        assert 0 < len(crowd.frames) * (12 + 5 * crowd.count) <= 1 << 20 < (len(crowd.frames) + 1) * (12 + 5 * 256)


@pytest.mark.parametrize("how", [signal.SIGINT, signal.SIGTERM])
def test_it_ends_when_it_is_told_to(throng, layout, how):
    process = subprocess.Popen([throng.binary, "watch", layout, "--json", "--set", "simulation.duration=3000"],
                               stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    port = json.loads(process.stdout.readline())["port"]
    visitor = http.client.HTTPConnection("127.0.0.1", port, timeout=30)
    visitor.request("GET", "/crowd")
    visitor.getresponse().read(8)
    begin = time.monotonic()
    process.send_signal(how)
    _, errors = process.communicate(timeout=60)
    assert process.returncode == 0 and "Traceback" not in errors and time.monotonic() - begin < 20.0


def test_only_this_machine_is_answered_and_only_what_there_is(throng, layout):
    with watching(throng, layout) as job:
        port = job.listener._port
        status, page, headers = ask(port)
        assert status == 200 and "layout.json" in page and headers["X-Content-Type-Options"] == "nosniff"
        assert ask(port, host=f"localhost:{port}")[0] == 200
        for host in ("evil.example", f"evil.example:{port}", "127.0.0.1", f"127.0.0.1:{port + 1}"):
            assert ask(port, host=host)[:2] == (403, ""), host
        assert ask(port, method="POST")[0] == 405
        for path in ("/layout.json", "/../layout.json", "/..%2f..%2fetc/passwd", "//etc/passwd", str(layout)):
            assert ask(port, path)[0] == 404, path
        with pytest.raises(OSError):
            socket.create_connection(("127.0.0.2", port), timeout=5)
        taken = throng("watch", layout, "--port", port, expect=5)
        assert f"port {port}" in taken.stderr and len(taken.stderr.strip().splitlines()) == 1
        with watching(throng, layout) as other:
            until(lambda: state_of(other) == "complete", other)


def test_what_is_not_there_is_one_error(throng, tmp_path):
    for path in (tmp_path / "absent.json", tmp_path / "absent", tmp_path):
        failed = throng("watch", path, expect=3)
        assert len(failed.stderr.strip().splitlines()) == 1 and failed.stdout == ""
    throng("watch", EXAMPLES / "circle.json", "--port", "70000", expect=2)
