# SPDX-License-Identifier: Apache-2.0
"""People in seats: where they are in a bake, and what they do there, when."""
import json
import math
import subprocess
import time

import numpy
import pytest

import written_bakes

SITS, READIES, CLAPS, RISES, CHEERS = 5, 6, 7, 8, 9
RADIUS, ROWS, PITCH = 30.0, 4, 0.8


def layout(shows=(), duration=8.0, walkers=True, fps=24):
    made = {"throng": 1, "simulation": {"duration": duration, "fps": fps},
            "seats": [{"id": "ring", "arc": {"centre": [0, 0], "radius": RADIUS, "from": 0, "to": 360}, "rows": ROWS,
                       "rise": 0.4, "height": 1.0, "occupancy": 0.9}],
            "shows": list(shows)}
    if walkers:
        made["formations"] = [{"id": "players", "type": "grid", "origin": [-8, -3], "rows": 4, "columns": 3,
                               "spacing": 2, "goal": {"offset": [10, 0]}}]
    return made


class Bake(written_bakes.Bake):
    def __init__(self, path):
        super().__init__(path)
        self.seated = numpy.array([row["group"] == "ring" for row in self.rows])

    @property
    def doing(self):
        return numpy.floor(self.state[:, self.seated, 0]).astype(int)


@pytest.fixture(scope="module")
def bake(throng, tmp_path_factory):
    made = written_bakes.baker(throng, tmp_path_factory.mktemp("audiences"))
    return lambda *given: Bake(made(*given))


@pytest.fixture(scope="module")
def clapping(bake):
    return bake("clapping", layout([{"at": 2, "do": "clap", "for": 2}, {"at": 2, "do": "cheer", "share": 0}]),
                "--feet", "--gaze")


def test_people_sit_where_their_seats_are(clapping):
    seats = clapping.pos[:, clapping.seated]
    assert numpy.array_equal(seats[0], seats[-1])
    radius = numpy.hypot(seats[0, :, 0], seats[0, :, 1])
    row = numpy.rint((radius - RADIUS) / PITCH)
    assert set(row) == set(range(ROWS)) and numpy.abs(radius - RADIUS - PITCH * row).max() < 0.01
    assert numpy.allclose(seats[0, :, 2], 1.0 + 0.4 * row, atol=1e-5)
    facing = clapping.dir[0, clapping.seated, :2]
    assert numpy.abs((facing * seats[0, :, :2]).sum(axis=1) + radius).max() < 1e-3, "they look at the middle"
    around = sum(math.floor(2 * math.pi * (RADIUS + PITCH * each) / 0.5) for each in range(ROWS))
    assert abs(clapping.seated.sum() / around - 0.9) < 0.02
    assert not clapping.dir[:, clapping.seated, 2].any()


def test_others_are_as_they_are_without_them(bake, clapping):
    quiet = bake("quiet", layout(), "--feet", "--gaze")
    assert numpy.array_equal(quiet.pos, clapping.pos) and numpy.array_equal(quiet.dir, clapping.dir)
    assert numpy.array_equal(quiet.state[:, ~quiet.seated], clapping.state[:, ~quiet.seated])
    assert (quiet.doing == SITS).all()
    assert quiet.seated.sum() + 12 == quiet.manifest["agents"]


def test_everybody_has_arrived(clapping):
    assert clapping.manifest["account"]["agents"] == len(clapping.rows) == clapping.manifest["account"]["spawned"]
    assert all(row["outcome"] == "arrived" and row["arrival_frame"] == "0" for row in clapping.rows[12:])


def test_applause_comes_and_goes(clapping):
    doing, fps = clapping.doing, 24
    share = lambda seconds, what: (doing[round(seconds * fps)] == what).mean()
    assert share(1.9, SITS) == 1.0 and share(7.9, SITS) == 1.0
    assert share(3.5, CLAPS) > 0.97 and 0.2 < share(2.35, READIES) < 0.9
    phases = clapping.state[:, clapping.seated, 2]
    changes = numpy.diff(phases, axis=0)
    assert changes.min() >= 0.0, "phases only grow"
    claps = (doing[1:] == CLAPS) & (doing[:-1] == CLAPS)
    assert abs(changes[claps].mean() * fps - 4.0) < 0.2


@pytest.mark.parametrize("speed", [12.0, 20.0])
def test_a_wave_runs_at_its_speed(bake, speed):
    made = bake(f"wave{speed:g}", layout([{"at": 1, "do": "wave", "from": [RADIUS, 0], "speed": speed}], 20,
                                        walkers=False))
    doing, places = made.doing, made.pos[0, made.seated]
    angle = numpy.arctan2(places[:, 1], places[:, 0]) % (2.0 * math.pi)
    up = numpy.where((doing == RISES).any(axis=0), (doing == RISES).argmax(axis=0), -1) / 24.0
    some = (up > 0.0) & (angle > 0.2) & (angle < 6.0)
    assert some.sum() > 500
    middle = RADIUS + 0.5 * (ROWS - 1) * PITCH
    slope = numpy.polyfit(up[some], angle[some] * middle, 1)[0]
    assert abs(slope / speed - 1.0) < 0.02
    # As wide as 15 seats: those who are more than half up.
    height = 1.0 - numpy.abs(2.0 * (made.state[:, made.seated, 2] % 1.0) - 1.0)
    frame = round((1.0 + 0.5 * 2.0 * math.pi * middle / speed) * 24)
    row = numpy.rint((numpy.hypot(places[:, 0], places[:, 1]) - RADIUS) / PITCH)
    standing = ((doing[frame] == RISES) & (height[frame] > 0.5) & ((row == 1) | (row == 2))).sum() / 2
    assert 9 < standing < 18


def test_measure_and_bars_know_who_has_a_seat(throng, clapping):
    told = json.loads(throng("measure", clapping.path, "--json").stdout)
    assert told["seated"] == clapping.seated.sum() and told["stuck"] == 0
    assert told["wall_crossings"] == 0 and told["deepest_overlap_percent"] < 5.0
    assert "seated" in throng("measure", clapping.path).stdout


def test_a_bake_that_goes_on_is_the_same(bake, throng, tmp_path):
    """What audiences do follows from the time alone, so a checkpoint needs to say nothing of it."""
    given = layout([{"at": 1, "do": "cheer", "for": 2}], 30)
    whole = bake("whole", given)
    (tmp_path / "layout.json").write_text(json.dumps(given))
    command = ["bake", tmp_path / "layout.json", "-o", tmp_path / "bake", "--no-gltf", "-q", "--checkpoint", "0.002"]
    process = subprocess.Popen([throng.binary, *map(str, command)], stdout=subprocess.DEVNULL)
    while not (tmp_path / "bake.unfinished" / "checkpoint.a").exists():
        assert process.poll() is None
        time.sleep(0.002)
    process.kill()
    process.wait()
    throng(*command, "--resume")
    for name in ("pos", "dir", "state"):
        files = [(folder / "streams" / f"{name}.npy").read_bytes() for folder in (whole.path, tmp_path / "bake")]
        assert files[0] == files[1]


def test_all_forms_and_readers_take_it(throng, clapping, tmp_path):
    throng("convert", clapping.path, "-o", tmp_path / "packed", "--streams", "packed")
    throng("info", tmp_path / "packed")
    throng("report", clapping.path, "-o", tmp_path / "page.html")
    assert (tmp_path / "page.html").exists()


def test_only_who_walks_can_be_followed(throng, clapping, tmp_path):
    told = json.loads(throng("measure", clapping.path, "--follow", 3, "--plots", tmp_path / "why", "--json").stdout)
    assert told["people"][0]["row"] == 3
    refused = throng("measure", clapping.path, "--follow", 100, "--plots", tmp_path / "why", expect=None)
    assert refused.returncode != 0 and "row 100 of clapping has a seat" in refused.stderr
