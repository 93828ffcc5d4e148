# SPDX-License-Identifier: Apache-2.0
"""A stream of discs that presses through a door not much wider than one gets out where people take turns; and how people
with bodies, who stride, get through doors."""
import json
import pathlib
import sys

import numpy
import pytest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "scripts"))
import body_flows  # noqa: E402

SQUEEZE = {
    "throng": 1,
    "simulation": {"duration": 75, "seed": 1},
    "areas": [{"id": "in", "polygon": [[-8, 0.1], [-6, 0.1], [-6, 1.7], [-8, 1.7]]},
              {"id": "out", "polygon": [[6, -1], [7, -1], [7, 2.8], [6, 2.8]]}],
    "walls": [{"points": [[4, 0.5], [4, 0], [-8.2, 0], [-8.2, 1.8], [4, 1.8], [4, 1.3]], "thickness": 0}],
    "flows": [{"id": "f", "from": "in", "to": "out", "count": 70, "end": 35, "people": {"body": "disc"}}],
}
DOOR = numpy.array([4.0, 0.9])
NEAR = 2.0  # m


@pytest.fixture(scope="module")
def squeeze(throng, once):
    """squeeze(taking turns?): positions, headings and who is there, by frame and person."""
    def run(takes_turns):
        def make(folder):
            (folder / "squeeze.json").write_text(json.dumps(SQUEEZE))
            throng("bake", folder / "squeeze.json", "-o", folder / "bake", "-q", "--no-gltf",
                   "--set", f"motion.nearest_first.enabled={json.dumps(takes_turns)}")

        streams = once(f"squeeze-{takes_turns}", make) / "bake" / "streams"
        there = numpy.load(streams / "state.npy")[..., 0] > 0.5
        return numpy.load(streams / "pos.npy")[..., :2], numpy.load(streams / "dir.npy")[..., :2], there

    return run


def out_of_the_door(positions):
    """How many have been beyond it."""
    return int((positions[..., 0] > DOOR[0]).any(axis=0).sum())


def test_who_takes_turns_gets_out_and_who_presses_jams(squeeze):
    assert out_of_the_door(squeeze(True)[0]) >= 66
    assert out_of_the_door(squeeze(False)[0]) < 60


def test_who_waits_before_a_door_looks_at_it(squeeze):
    """Of all moments of people there, in 5 % they look away (4.6 to 7.5 % with seeds 1 to 6)."""
    positions, headings, there = squeeze(True)
    to_door = DOOR - positions
    before = there & (numpy.linalg.norm(to_door, axis=-1) < NEAR) & (to_door[..., 0] > 0)
    away = ((headings * to_door).sum(axis=-1) < 0) & before
    assert away.sum() < 0.07 * before.sum()


CORRIDOR = body_flows.corridor_with_door(body_flows.PEOPLE["body"])  # of 1.8 m; the door of 0.7 m
CORRIDOR["simulation"].update(duration=140, seed=2)


@pytest.fixture(scope="module")
def moments_out(throng, once):
    """moments_out(setting): when each of them is first beyond the door, s, in order."""
    def run(name, *words):
        def make(folder):
            (folder / "corridor.json").write_text(json.dumps(CORRIDOR))
            throng("bake", folder / "corridor.json", "-o", folder / "bake", "-q", "--no-gltf", *words)

        beyond = numpy.load(once(name, make) / "bake" / "streams" / "pos.npy")[..., 0] > 0
        return numpy.sort(beyond.argmax(axis=0)[beyond.any(axis=0)]) / 24

    return run


def test_who_stands_at_a_jamb_goes_round_it(moments_out):
    """In the experiment all 148 were out, 1.6 a second; with seeds 1 to 4 it is 1.22 here, 1.16 at the least, and the
    longest that nobody comes out is 3.7 s. Who heeds jams even at a jamb walks into it (1.09; with this seed 1.06
    instead of 1.19)."""
    out = moments_out("corridor")
    assert len(out) == 148 and 147 / (out[-1] - out[0]) > 1.12
    assert numpy.diff(out).max() < 5
    stuck = moments_out("corridor heeding jams", "--set", "motion.routes_round_jams.stuck=1")
    assert len(stuck) < 145
