# SPDX-License-Identifier: Apache-2.0
"""People who walk to seats, let others pass, and leave; and what people do with their hands where they stand."""
import json
import signal
import subprocess

import numpy
import pytest

import written_bakes

WALKS, STANDS, SITS, CLAPS, RISES, SETTLES = 1, 2, 5, 7, 8, 11
RAISES, APPLAUDS, JUBILATES, SWAYS, WAVES = 12, 13, 14, 15, 16
GATE = {"id": "gate", "polygon": [[-12, 6], [-8, 6], [-8, 10], [-12, 10]]}
FRONT = 1.2    # m: the ground before the block
BESIDE = 0.48  # m: so near nobody comes to the seat of who sits; others pass 0.4 m before it


def stand(**more):
    """60 seats: three rows, two aisles."""
    return {"id": "south", "front": [[-6.31, 0], [6.31, 0]], "rows": 3, "rise": 0.3, "pitch": 0.9, "aisles": 2, **more}


def layout(duration, seats, **more):
    return {"throng": 1, "simulation": {"duration": duration, "seed": 3}, "areas": [GATE], "seats": seats, **more}


def guests(count, **more):
    return {"id": "guests", "from": "gate", "count": count, "end": 20, "people": {"groups": [0.3, 0.4, 0.2, 0.1]},
            **more}


class Bake(written_bakes.Bake):
    def __init__(self, path):
        super().__init__(path)
        self.doing = numpy.floor(self.state[..., 0]).astype(int)

    def seats(self):
        """Of the only block, as the manifest has it."""
        block, found = self.manifest["geometry"]["seats"][0], []
        for row in block["rows"]:
            (x, y), (u, v) = row["line"]
            count = int(numpy.hypot(u - x, v - y) / block["width"] + 1e-6)
            spare = 0.5 * (numpy.hypot(u - x, v - y) - count * block["width"])
            found += [(x + spare + (i + 0.5) * block["width"], y, row["height"]) for i in range(count)]
        return numpy.array(found)

    def is_out(self, frame):
        """On the ground before the block."""
        return (self.doing[frame] > 0) & (self.pos[frame, :, 1] > FRONT)


@pytest.fixture(scope="module")
def bake(throng, tmp_path_factory):
    made = written_bakes.baker(throng, tmp_path_factory.mktemp("walked-seats"), "--streams", "npy")
    return lambda *given: Bake(made(*given))


@pytest.fixture(scope="module")
def coming(bake):
    return bake("coming", layout(110, [stand(occupancy=0)], flows=[guests(60, to={"seats": "south"})]))


@pytest.fixture(scope="module")
def leaving(bake):
    return bake("leaving", layout(75, [stand(leave={"at": {"uniform": [2, 6]}, "to": "gate"})]))


def test_sixty_people_take_sixty_seats(coming):
    assert (coming.doing[-1] == SITS).all()
    assert all(row["outcome"] == "arrived" for row in coming.rows)
    away = numpy.linalg.norm(coming.pos[-1][:, None] - coming.seats()[None], axis=2)
    assert len(coming.seats()) == 60 and away.min(axis=1).max() < 0.01
    assert len(set(away.argmin(axis=1))) == 60, "each seat once"
    assert numpy.abs(coming.dir[-1, :, :2] - [0, 1]).max() < 1e-3, "they look ahead"


def test_who_walks_together_sits_side_by_side(coming):
    parties = {}
    for row, entry in zip(range(60), coming.rows):
        parties.setdefault(entry["party"], []).append(coming.pos[-1, row])
    together = [numpy.array(party) for party in parties.values() if len(party) > 1]
    assert len(together) > 10
    beside = 0
    for party in together:
        party = party[party[:, 0].argsort()]
        beside += numpy.ptp(party[:, 1]) < 0.01 and numpy.abs(numpy.diff(party[:, 0]) - 0.5).max() < 0.01
    assert beside >= len(together) - 1, "all seats are taken, so one party may find no more room"


@pytest.mark.parametrize("bakes", ["coming", "leaving"])
def test_people_pass_in_front_of_who_stands(bakes, request):
    """Nobody comes near a seat in which somebody sits; and somebody does stand up for others."""
    of = request.getfixturevalue(bakes)
    for frame in range(0, len(of.pos), 3):
        sits = of.doing[frame] == SITS
        walks = (of.doing[frame] == WALKS) & ~of.is_out(frame)
        if sits.any() and walks.any():
            away = numpy.linalg.norm(of.pos[frame][walks][:, None] - of.pos[frame][sits][None], axis=2)
            assert away.min() > BESIDE, frame
    if bakes == "coming":
        sat = numpy.array([(of.doing[:-1, row] == SITS) & (of.doing[1:, row] == SETTLES) for row in range(60)])
        assert sat.any(axis=1).sum() > 10


@pytest.mark.parametrize("bakes", ["coming", "leaving"])
def test_nobody_jumps_and_phases_only_grow(bakes, request):
    of = request.getfixturevalue(bakes)
    there = (of.doing[1:] > 0) & (of.doing[:-1] > 0)
    moved = numpy.linalg.norm(numpy.diff(of.pos, axis=0), axis=2)
    assert moved[there].max() < 2.6 / 24
    in_seat = there & (of.doing[1:] >= SITS) & (of.doing[:-1] >= SITS)
    assert moved[in_seat].max() < 0.4 / 24, "who sits down does not slide"
    grown = numpy.diff(of.state[..., 2], axis=0)
    assert grown[there].min() >= -1e-4 and grown[there].max() < 1.01


def test_nobody_overtakes_or_walks_into_anybody_in_aisles(leaving):
    nearest = 9.0
    for frame in range(0, len(leaving.pos), 3):
        walks = (leaving.doing[frame] == WALKS) & (leaving.pos[frame, :, 1] < 1) & (leaving.dir[frame, :, 2] > 0.1)
        places = leaving.pos[frame][walks]
        if len(places) > 1:
            away = numpy.linalg.norm(places[:, None] - places[None], axis=2)
            nearest = min(nearest, away[numpy.triu_indices(len(places), 1)].min())
    assert nearest > 0.3


def test_a_block_is_left_through_the_rows_and_aisles(leaving):
    assert leaving.doing[-1].max() == 0 or not (leaving.doing[-1] >= SITS).any()
    assert (leaving.pos[-1, :, 1] > FRONT).all()
    assert {row["outcome"] for row in leaving.rows} <= {"arrived", "walking"}
    radius = numpy.array([float(row["radius"]) for row in leaving.rows])
    for frame in range(0, len(leaving.pos), 6):
        out = numpy.nonzero(leaving.is_out(frame))[0]
        if len(out) < 2:
            continue
        places = leaving.pos[frame, out, :2]
        gaps = numpy.linalg.norm(places[:, None] - places[None], axis=2) - 0.9 * (radius[out][:, None] + radius[out])
        assert gaps[numpy.triu_indices(len(out), 1)].min() > 0, frame


def test_heights_are_those_of_the_rows(leaving):
    sits = leaving.doing[0] == SITS
    assert sits.all()
    rows = numpy.rint(-leaving.pos[0, :, 1] / 0.9)
    assert numpy.allclose(leaving.pos[0, :, 2], 0.3 * rows, atol=1e-4)
    assert numpy.abs(leaving.pos[-1, :, 2]).max() < 0.02


@pytest.mark.parametrize("bakes", ["coming", "leaving"])
def test_measure_takes_who_is_led_for_what_it_is(throng, bakes, request):
    """Outlines of stands are no walls to them, and who waits in a row is not stuck."""
    of = request.getfixturevalue(bakes)
    told = json.loads(throng("measure", of.path, "--json").stdout)
    assert told["wall_crossings"] == 0 and told["stuck"] == 0
    assert told.get("seated", 0) == (60 if bakes == "coming" else 0)
    assert told["overlapping_percent"] < 1.0


def test_who_came_takes_part_in_shows(bake):
    """And nobody else in the same flow, who is still on its way."""
    of = bake("show", layout(60, [stand(occupancy=0.2)], flows=[guests(10, to={"seats": "south"}, end=1)],
                             shows=[{"at": 45, "do": "clap", "for": 6}, {"at": 54, "do": "wave", "reaction": 0}]))
    clapped = (of.doing[45 * 24:52 * 24] == CLAPS).any(axis=0)
    sat = of.doing[45 * 24] == SITS
    assert sat.sum() >= 18 and (clapped == sat).mean() > 0.9
    rose = of.doing[54 * 24:58 * 24] == RISES
    first = numpy.argmax(rose, axis=0)[rose.any(axis=0)]
    assert rose.any(axis=0).sum() >= 15 and numpy.ptp(first) > 10, "one after the other"


def test_it_goes_on_from_a_checkpoint_to_the_same_bytes(throng, tmp_path):
    path = tmp_path / "layout.json"
    path.write_text(json.dumps(layout(14, [stand(occupancy=0.5, leave={"at": 3, "to": "gate"})],
                                      flows=[guests(10, to={"seats": "south"}, end=2)])), "utf-8")
    throng("bake", path, "-o", tmp_path / "whole", "--no-gltf", "-q", "--streams", "npy")
    words = [throng.binary, "bake", str(path), "-o", str(tmp_path / "parts"), "--no-gltf", "--streams", "npy", "--json",
             "--checkpoint", "0.01"]
    process = subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    while '"frame": ' not in process.stderr.readline():
        assert process.poll() is None
    process.send_signal(signal.SIGTERM)
    process.communicate()
    assert process.returncode != 0, "stopped on its way"
    throng(*words[1:], "--resume")
    whole, parts = Bake(tmp_path / "whole"), Bake(tmp_path / "parts")
    for name in ("pos", "dir", "state"):
        assert numpy.array_equal(getattr(whole, name), getattr(parts, name)), name


@pytest.fixture(scope="module")
def hands(bake):
    """Four who clap, cheer, wave and sway one after the other, and walk off."""
    states = {"clap": {"stay": True, "do": "clap", "for": {"uniform": [3, 4]}, "then": "cheer"},
              "cheer": {"stay": True, "do": "cheer", "for": 3, "then": "wave"},
              "wave": {"gather": "gate", "do": "wave", "for": 3, "then": "sing"},
              "sing": {"stay": True, "do": "sing", "until": [{"at": 22, "then": "leave"}]},
              "leave": {"walk_to": "gate"}}
    return bake("hands", layout(24, [], behaviours=[{"id": "b", "start": "clap", "states": states}],
                                formations=[{"id": "four", "type": "grid", "origin": [-4, 6], "rows": 2, "columns": 2,
                                             "spacing": 1, "behaviour": "b"}]))


def test_hands_are_raised_before_and_let_down_after(hands):
    for row in range(4):
        doing, phases = hands.doing[:, row], hands.state[:, row, 2]
        shown = [int(doing[0])] + [int(code) for before, code in zip(doing, doing[1:]) if code != before]
        shown = [code for code in shown if code not in (0, WALKS, STANDS)]
        assert shown[:7] == [RAISES, APPLAUDS, RAISES, JUBILATES, RAISES, RAISES, WAVES]
        assert shown[7:10] == [RAISES, SWAYS, RAISES]
        changes = numpy.nonzero(numpy.diff(doing))[0]
        for at in changes:
            if doing[at] >= APPLAUDS:  # it ends at a whole cycle, or upright in the middle
                cycle = 0.5 if doing[at] == SWAYS else 1.0
                assert min(phases[at] % cycle, cycle - phases[at] % cycle) < 0.2
        raised = doing >= RAISES
        assert hands.dir[raised, row, 2].max() < 0.36, "nobody walks with its hands up"


def test_claps_come_four_times_a_second(hands):
    for row in range(4):
        claps = numpy.nonzero(hands.doing[:, row] == APPLAUDS)[0]
        rate = (hands.state[claps[-10], row, 2] - hands.state[claps[0], row, 2]) / (claps[-10] - claps[0]) * 24
        assert 3.3 < rate < 4.7


def test_check_tells_what_is_wrong(throng, tmp_path):
    def told(given):
        path = tmp_path / "wrong.json"
        path.write_text(json.dumps(given), "utf-8")
        return throng("check", path, expect=3).stderr

    full = layout(10, [stand(occupancy=0)], flows=[guests(70, to={"seats": "south"})])
    assert "`guests`: 70 people are to sit, and 60 of these seats are free" in told(full)
    both = layout(10, [stand(occupancy=0)], flows=[guests(1, to={"seats": "south"}, board={"line": "none"})])
    assert "people who `board` go nowhere else: `to` has no meaning" in told(both) and "no key `to`" not in told(both)
    twice = layout(10, [stand(occupancy=0), stand(id="other", occupancy=1)],
                   flows=[guests(70, to={"seats": ["south", "other", "south"]})])
    assert "70 people are to sit, and 60 of these seats are free" in told(twice), "seats count once"
    there = layout(10, [stand(occupancy=1)], flows=[guests(1, to={"seats": "south"})])
    assert "`guests`: 1 people are to sit, and 0 of these seats are free" in told(there)
    assert "there is no block of seats `north`" in told(
        layout(10, [stand()], flows=[guests(1, to={"seats": "north"})]))
    state = {"gather": "gate", "do": "sit", "for_good": True}
    there = layout(10, [stand()], flows=[guests(1, behaviour="b")],
                   behaviours=[{"id": "b", "start": "a", "states": {"a": state}}])
    assert "there is nothing to sit on here" in told(there)
    there["behaviours"][0]["states"]["a"] = {"sit": "south", "do": "wave", "for_good": True}
    assert "who sits does not wave" in told(there)
    floors = layout(10, [stand(occupancy=0)], flows=[guests(1, to={"seats": "south"})], levels=[
        {"id": "ground", "floor": [[-20, 3], [20, 3], [20, 20], [-20, 20]]}])
    assert "beside the floor of level `ground`" in told(floors)
    ring = {"id": "south", "arc": {"centre": [0, 0], "radius": 20, "from": 0, "to": 360}, "occupancy": 0}
    assert "nobody gets into block `south`: it goes all round" in told(
        layout(10, [ring], flows=[guests(1, to={"seats": "south"})]))
    walled = layout(10, [stand(occupancy=0)], flows=[guests(1, to={"seats": "south"})],
                    walls=[{"points": [[-30, 3], [30, 3], [30, -30], [-30, -30], [-30, 3]]}])
    assert "nobody can walk from `gate` to `south, aisle 1`" in told(walled)
