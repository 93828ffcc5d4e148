# SPDX-License-Identifier: Apache-2.0
"""What tests of `throng watch` have in common."""
import contextlib
import json
import sys
import time

import numpy

from conftest import ROOT

sys.path.insert(0, str(ROOT / "blender_addon"))  # its reader of what comes needs no Blender
from throng.live.job import WatchJob  # noqa: E402

HANGS = 120.0  # s: longer than anything here takes on the slowest machine

# Two groups that cross, one of which comes little by little; a wall between them and what they cannot see.
LAYOUT = {
    "throng": 1,
    "name": "crossing paths",
    "simulation": {"duration": 6, "warmup": 1, "seed": 4},
    "areas": [{"id": "west", "polygon": [[0, 0], [3, 0], [3, 6], [0, 6]]},
              {"id": "east", "polygon": [[17, 0], [20, 0], [20, 6], [17, 6]]}],
    "walls": [{"id": "pillar", "closed": True, "points": [[9, 2], [11, 2], [11, 4], [9, 4]]}],
    "flows": [{"id": "forth", "from": "west", "to": "east", "count": 12},
              {"id": "back", "from": "east", "to": "west", "rate": 2}],
}


def until(condition, job=None, seconds=HANGS):
    """Waits for it, and returns what it is."""
    end = time.monotonic() + seconds
    while not (found := condition()):
        assert job is None or job.is_running(), job.message
        assert time.monotonic() < end, (job and job.told, condition)
        time.sleep(0.01)
    return found


def state_of(job):
    return job.told.get("state")


@contextlib.contextmanager
def watching(throng, path, *options):
    """A `throng watch` that listens."""
    job = WatchJob(throng.binary, path, options)
    job.start()
    try:
        until(lambda: job.listener, job)
        yield job
    finally:
        job.stop()


def write(path, layout):
    """As an editor does: all of it in the place of what was there."""
    fresh = path.with_name(path.name + ".new")
    fresh.write_text(layout if isinstance(layout, str) else json.dumps(layout, indent=1))
    fresh.replace(path)


def check_vehicles(crowd, vehicles):
    """The rest of each moment: x, y, heading and state of each vehicle, 16 bits each."""
    ground, count = crowd.about["ground"], len(crowd.about["vehicles"])
    assert count == vehicles.shape[1] > 0
    for frame, content in zip(crowd.frames, crowd.contents):
        told = numpy.frombuffer(content, "<u2", 4 * count, 4 + 5 * crowd.count).reshape(count, 4)
        there = vehicles[frame, :, 6] > 0
        assert (told[:, 3] == vehicles[frame, :, 6]).all()
        found = told[there, :2] * ground["quantum"] + ground["minimum"]
        assert numpy.abs(found - vehicles[frame, there, :2]).max(initial=0.0) < 0.51 * ground["quantum"] + 1e-4
        turn = told[there, 2] / 65536 * 2 * numpy.pi - vehicles[frame, there, 3]
        assert numpy.abs(numpy.sin(turn / 2)).max(initial=0.0) < 1e-4
