# SPDX-License-Identifier: Apache-2.0
"""The live preview in a real Blender: the crowd of a layout while it is changed, and a bake under way."""
import json
import signal
import subprocess
import threading
import time

import pytest

from results import ADDON, HERE, result_of

LAYOUT = {"throng": 1, "simulation": {"duration": 60, "seed": 2},
          "areas": [{"id": "a", "polygon": [[0, 0], [3, 0], [3, 6], [0, 6]]},
                    {"id": "b", "polygon": [[17, 0], [20, 0], [20, 6], [17, 6]]}],
          "flows": [{"id": "f", "from": "a", "to": "b", "rate": 1}]}


@pytest.fixture
def baking(throng, tmp_path):
    """A bake that waits, once it has begun, until there is a file `go on`."""
    (tmp_path / "layout.json").write_text(json.dumps(LAYOUT))
    process = subprocess.Popen([throng.binary, "bake", tmp_path / "layout.json", "-o", tmp_path / "bake", "-q",
                                "--no-gltf"])
    until = lambda there: [time.sleep(0.01) for _ in iter(lambda: process.poll() is None and not there(), False)]
    pos = tmp_path / "bake.unfinished" / "streams" / "pos.npy"
    until(lambda: pos.exists() and pos.stat().st_size > 20000)
    process.send_signal(signal.SIGSTOP)

    def let_go():
        until((tmp_path / "go on").exists)
        process.send_signal(signal.SIGCONT)

    waiting = threading.Thread(target=let_go)
    waiting.start()
    yield tmp_path
    (tmp_path / "go on").touch()
    waiting.join()
    process.wait(120)


def test_the_crowd_follows_the_layout_and_a_bake(blender, throng, baking):
    seen = result_of(blender(HERE / "check_live.py", ADDON, baking, environment={"THRONG_BINARY": throng.binary}))
    assert seen["people"] == 20 and seen["status"] == "Simulated to its end" and seen["objects"] == 0
    aside, *counts = seen["places"]
    assert aside < 3.0 and counts[0] == counts[1] == counts[2] > 0 and seen["moved"] > 0.3
    assert seen["triangles"][0] and seen["triangles"][1] < 0.5
    assert seen["there"] == pytest.approx(100.0, abs=3.0) and 0.3 < seen["seconds"] < 60.0
    assert seen["mistake"] == [["/roads/0/width", "Road"]] and seen["selected"] and seen["kept"]
    assert seen["mended"] == 0
    assert seen["left"] == [False, True, False]
    assert "shows it as far as it has come" in seen["imported"]
    assert seen["baking"][0].startswith("Being baked: played as far as it has come") and seen["baking"][1] > 10
    assert seen["baked"] == ["A complete bake", 1439]
    assert seen["over"]
