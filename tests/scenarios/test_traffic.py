# SPDX-License-Identifier: Apache-2.0
"""Signals that hold people and vehicles, and vehicles that run over nobody."""
import json

import numpy
import pytest

CYCLE, WALK = 22, 8  # s, of the signal here; people may go from the start of its cycle
COLUMNS = {name: i for i, name in enumerate(("x", "y", "z", "heading", "speed", "along", "state", "braking"))}


def box(x0, y0, x1, y1):
    return [[x0, y0], [x1, y0], [x1, y1], [x0, y1]]


def street(duration, signal=True, vehicles=(), count=30, **more):
    """People from the south who go north over a street of two lanes."""
    stops = (lambda x, y: [{"at": [x, y], "signal": "lights"}]) if signal else lambda x, y: []
    layout = {
        "throng": 1, "simulation": {"duration": duration, "avoid_congestion": False},
        "areas": [{"id": "south", "polygon": box(-8, -10, 8, -4)}, {"id": "north", "polygon": box(-8, 4, 8, 10)},
                  {"id": "from", "polygon": box(-8, -10, 8, -8)}, {"id": "to", "polygon": box(-8, 8, 8, 10)}],
        "crossings": [{"id": "zebra", "polygon": box(-2, -4, 2, 4)}],
        "lanes": [{"id": "east", "points": [[-80, -2], [80, -2]], "width": 4, "speed": 11, "stops": stops(-3.5, -2)},
                  {"id": "west", "points": [[80, 2], [-80, 2]], "width": 4, "speed": 11, "stops": stops(3.5, 2)}],
        "vehicles": list(vehicles),
        "flows": [{"id": "over", "from": "from", "to": "to", "count": count, "end": 20}], **more}
    if signal:
        layout["signals"] = [{"id": "lights", "phases": [
            {"name": "walk", "seconds": WALK, "green": ["zebra"]}, {"seconds": 4},
            {"name": "drive", "seconds": 8, "green": ["east", "west"]}, {"seconds": 2}]}]
    return layout


def bake(throng, folder, layout, *options, **more):
    folder.mkdir(exist_ok=True)
    (folder / "layout.json").write_text(json.dumps(layout))
    throng("bake", folder / "layout.json", "-o", folder / "bake", "-q", "--no-gltf", *options, **more)
    return folder / "bake"


def measured(throng, folder):
    return json.loads(throng("measure", folder, "--json").stdout)


def walked(folder):
    """Places, and who is there: frames by people."""
    there = numpy.load(folder / "streams" / "state.npy")[..., 0] > 0.5
    return numpy.load(folder / "streams" / "pos.npy"), there


def test_nobody_starts_over_on_red_and_everybody_gets_across(throng, tmp_path):
    folder = bake(throng, tmp_path / "held", street(100))
    places, there = walked(folder)
    on = there & (abs(places[..., 0]) < 2) & (abs(places[..., 1]) < 3.9)  # not on its very edge
    starts = numpy.argwhere(on[1:] & ~on[:-1] & there[:-1])
    assert len({person for _, person in starts}) == 30  # nobody went another way
    into = (starts[:, 0] + 1) / 24 % CYCLE
    # Motion is averaged over a quarter of a second to both sides.
    assert all((into < WALK + 0.3) | (into > CYCLE - 0.3)), sorted(into)
    waited = there & (places[..., 1] < -4) & (places[..., 1] > -6)
    assert waited.sum() > 24 * 30  # some did wait at the kerb
    assert measured(throng, folder)["arrived"] == 30


def test_without_a_signal_nobody_is_held(throng, tmp_path):
    folder = bake(throng, tmp_path / "free", street(60, signal=False))
    places, there = walked(folder)
    on = there & (abs(places[..., 0]) < 2) & (abs(places[..., 1]) < 4)
    starts = numpy.argwhere(on[1:] & ~on[:-1])[:, 0] / 24
    red = (starts % CYCLE > WALK + 0.3) & (starts % CYCLE < CYCLE - 0.3)
    assert red.sum() > 5


@pytest.mark.parametrize("signal", [True, False])
def test_vehicles_run_over_nobody_and_get_on(throng, tmp_path, signal):
    vehicles = [{"id": "east", "lane": "east", "rate": 0.25, "end": 40},
                {"id": "bus", "lane": "west", "kind": "bus", "times": [1, 30]},
                {"id": "bicycle", "lane": "west", "kind": "bicycle", "times": [10, 12, 14]}]
    folder = bake(throng, tmp_path / "driven", street(170, signal=signal, vehicles=vehicles))
    figures = measured(throng, folder)
    assert figures["run_over"] == 0 and figures["vehicle_clearance"] > 0.0
    assert figures["arrived"] == 30
    track = numpy.load(folder / "vehicles.npy")
    listed = json.loads((folder / "bake.json").read_text())["vehicles"]["list"]
    assert track.shape == (170 * 24, len(listed), 8) and len(listed) > 8
    there = track[..., COLUMNS["state"]] > 0
    assert there.any(axis=0).all()
    assert not there[-1].any()  # all of them have left
    stood = (track[..., COLUMNS["speed"]] < 0.1) & there
    assert stood.any()  # somebody had to wait
    # Where they are is what they drove.
    steps = numpy.diff(track[..., :2], axis=0)
    both = there[1:] & there[:-1]
    speed = 0.5 * (track[1:, :, COLUMNS["speed"]] + track[:-1, :, COLUMNS["speed"]])
    assert numpy.hypot(steps[..., 0], steps[..., 1])[both] * 24 == pytest.approx(speed[both], abs=0.2)


def test_no_vehicle_passes_its_line_on_red(throng, tmp_path):
    vehicles = [{"id": "east", "lane": "east", "rate": 0.4}]
    folder = bake(throng, tmp_path / "line", street(90, vehicles=vehicles, count=1))
    track = numpy.load(folder / "vehicles.npy")
    front, there = track[..., COLUMNS["along"]], track[..., COLUMNS["state"]] > 0
    line = 80 - 3.5
    passes = numpy.argwhere(there[:-1] & (front[:-1] <= line + 0.3) & (front[1:] > line + 0.3))[:, 0] / 24 % CYCLE
    assert len(passes) > 8
    # Green is from 12 to 20 s; who cannot stop any more goes on for a moment.
    assert all((passes > WALK + 4) & (passes < WALK + 12 + 2.0)), sorted(passes)


def test_a_bake_goes_on_to_the_same_bytes(throng, tmp_path):
    layout = street(12, vehicles=[{"id": "cars", "lane": "east", "rate": 0.5}])
    whole = bake(throng, tmp_path / "whole", layout)
    parts = bake(throng, tmp_path / "parts", layout, "--checkpoint", "0.001")
    for name in ("vehicles.npy", "streams/pos.npy"):
        assert (whole / name).read_bytes() == (parts / name).read_bytes()


def test_a_bus_stands_at_its_stop(throng, tmp_path):
    layout = street(50, signal=False, vehicles=[{"id": "bus", "lane": "east", "kind": "bus", "times": [0]}], count=0)
    layout["lanes"][0]["stops"] = [{"at": [30, -4], "seconds": 9}]
    folder = bake(throng, tmp_path / "stop", layout)
    track = numpy.load(folder / "vehicles.npy")[:, 0]
    stands = track[:, COLUMNS["state"]] == 2
    assert stands.sum() / 24 == pytest.approx(9, abs=0.1)
    assert track[stands, COLUMNS["x"]] + 6 == pytest.approx(30, abs=0.9)


@pytest.mark.parametrize("change, expected", [
    (lambda layout: layout["lanes"][0]["stops"][0].update(signal="light"), "there is no signal `light`"),
    (lambda layout: layout["signals"][0]["phases"][0].update(green=["zebr"]), "did you mean `zebra`?"),
    (lambda layout: layout["signals"][0]["phases"][2].update(green=["west"]), "would stand there for ever"),
    (lambda layout: layout["lanes"][0].update(stops=[]), "nothing holds its vehicles"),
    (lambda layout: layout["lanes"][0]["stops"][0].update(at=[0, 40]), "42.0 m from lane `east`"),
    (lambda layout: layout.update(vehicles=[{"id": "v", "lane": "north", "rate": 1}]), "there is no lane `north`"),
    (lambda layout: layout.update(vehicles=[{"id": "v", "lane": "east"}]), "exactly one of `rate`"),
    (lambda layout: layout.update(vehicles=[{"id": "v", "lane": "east", "kind": "lorry", "rate": 1}]),
     "expected one of car, bus, tram, bicycle"),
    (lambda layout: layout["simulation"].update(duration=2000)
     or layout.update(vehicles=[{"id": "v", "lane": "east", "rate": 1}]), "a bake holds 512"),
])
def test_mistakes_are_told_with_their_line(throng, tmp_path, change, expected):
    layout = street(10)
    change(layout)
    (tmp_path / "layout.json").write_text(json.dumps(layout, indent=1))
    told = throng("check", tmp_path / "layout.json", expect=3)
    assert expected in told.stderr + told.stdout
    assert "layout.json:" in told.stderr + told.stdout
