# SPDX-License-Identifier: Apache-2.0
"""Heads in bakes: the streams `attention` and `gaze`, and what `throng measure` says of them, beside NumPy's sums."""
import csv
import json

import numpy
import pytest

from conftest import ROOT

LAYOUT = ROOT / "examples" / "busker.json"
FPS, SECONDS = 24, 24
MOST = numpy.radians((70.0, 35.0))
BANG = 18.0


def bake_of(throng, folder, *options, layout=LAYOUT):
    throng("bake", layout, "-o", folder, "-q", "--no-gltf", "--set", f"simulation.duration={SECONDS}", *options)
    return folder


def streams_of(folder):
    return {path.stem: numpy.load(path) for path in (folder / "streams").glob("*.npy")}


@pytest.fixture(scope="module")
def bake(throng, tmp_path_factory):
    return bake_of(throng, tmp_path_factory.mktemp("heads") / "busker", "--feet", "--gaze", "--attention")


@pytest.fixture(scope="module")
def streams(bake):
    return streams_of(bake)


@pytest.fixture(scope="module")
def people(bake):
    with (bake / "agents.csv").open(encoding="utf-8") as file:
        return list(csv.DictReader(file))


def rows_of(people, group):
    return [row for row, person in enumerate(people) if person["group"] == group]


def there(streams):
    return streams["state"][..., 0] > 0.5


def turns_of(streams):
    """(frames, people, 2): how heads are on the chest, to the left and up, rad."""
    yaw, pitch, weight = numpy.moveaxis(streams["attention"].astype(float), 2, 0)
    ahead = -streams["carriage"][..., 1].astype(float) if "carriage" in streams else 0.0
    return numpy.stack([weight * yaw + (1.0 - weight) * ahead, weight * pitch], 2)


def rates_of(streams):
    """deg/s, of all who are there in two frames."""
    both = there(streams)[1:] & there(streams)[:-1]
    return numpy.degrees(numpy.linalg.norm(numpy.diff(turns_of(streams), axis=0), axis=2) * FPS)[both]


def test_heads_keep_within_what_necks_can(streams):
    told = streams["attention"]
    assert (numpy.abs(told[..., :2]) <= MOST + 1e-5).all()
    assert told[..., 2].min() >= 0.0 and told[..., 2].max() <= 1.0
    assert (told[~there(streams)] == 0.0).all()
    assert numpy.percentile(rates_of(streams), 99) < 200.0
    assert numpy.degrees(numpy.abs(turns_of(streams)[..., 0]).max()) > 45.0, "somebody looks well aside"


def test_gazes_are_the_same_heads_from_the_heading(streams):
    yaw, pitch, weight = numpy.moveaxis(streams["attention"].astype(float), 2, 0)
    twist = streams["carriage"][..., 1].astype(float)
    assert streams["gaze"][..., 0] == pytest.approx(weight * (yaw + twist), abs=1e-5)
    assert streams["gaze"][..., 1] == pytest.approx(weight * pitch, abs=1e-5)


def test_friends_face_each_other(streams, people):
    friends = rows_of(people, "friends")
    pos, heads = streams["pos"].astype(float), streams["gaze"].astype(float)
    facing = numpy.arctan2(*numpy.moveaxis(streams["dir"][..., 1::-1].astype(float), 2, 0))
    off = []
    standing = (streams["dir"][:, friends, 2] < 0.05).all(axis=1) & there(streams)[:, friends].all(axis=1)
    assert standing.sum() > 5 * FPS
    for row in friends:
        at = heads[:, row, 2].astype(int) - 1
        for frame in numpy.flatnonzero(standing & numpy.isin(at, friends)):
            held = at[max(0, frame - FPS):frame + 1]
            if (held != at[frame]).any():
                continue  # it is on its way there
            way = pos[frame, at[frame], :2] - pos[frame, row, :2]
            wanted = numpy.arctan2(way[1], way[0]) - facing[frame, row]
            wanted = (wanted + numpy.pi) % (2 * numpy.pi) - numpy.pi
            if abs(wanted) < MOST[0]:
                off.append(abs(wanted - heads[frame, row, 0]))
    assert len(off) > 50
    assert numpy.degrees(numpy.percentile(off, 95)) < 10.0
    shared = numpy.isin(heads[standing][:, friends, 2].astype(int) - 1, friends).mean()
    assert 0.5 < shared < 0.97


def test_a_bang_turns_everybody_in_reach_within_the_time_of_a_reaction(streams):
    at = streams["gaze"][..., 2]
    first, last = round((BANG + 0.1) * FPS), round((BANG + 0.6) * FPS)
    looked = at == -3
    assert not looked[:first].any()
    present = there(streams)[first:last + 1].all(axis=0)
    assert present.sum() > 8
    assert looked[last, present].all()
    assert not looked[round((BANG + 5.0) * FPS):].any()


CORNER = {"throng": 1, "simulation": {"duration": 26, "seed": 2},
          "areas": [{"id": "a", "polygon": [[-9, -2], [-8, -2], [-8, -1], [-9, -1]]},
                    {"id": "b", "polygon": [[1, 8], [2, 8], [2, 9], [1, 9]]}],
          "walls": [{"id": "house", "closed": True, "points": [[-9, 0], [0, 0], [0, 9], [-9, 9]]}],
          "flows": [{"id": "round", "from": "a", "to": "b", "count": 6, "end": 14}]}


def test_heads_go_round_a_corner_first(throng, tmp_path):
    """The lag at which the turning of heads (in the plane) is most like that of bodies, over all who go round it."""
    layout = tmp_path / "corner.json"
    layout.write_text(json.dumps(CORNER), "utf-8")
    streams = streams_of(bake_of(throng, tmp_path / "corner", "--gaze", "--attention", layout=layout))
    facing = numpy.unwrap(numpy.arctan2(*numpy.moveaxis(streams["dir"][..., 1::-1].astype(float), 2, 0)), axis=0)
    head, minds = facing + streams["gaze"][..., 0], streams["gaze"][..., 2] == -1
    lags, likeness, around = numpy.arange(-12, 13), numpy.zeros(25), 0
    for row in range(facing.shape[1]):
        turning, own = numpy.gradient(facing[:, row]), numpy.gradient(head[:, row])
        middle = int(numpy.abs(turning).argmax())
        frames = numpy.arange(max(12, middle - 24), min(middle + 24, len(facing) - 13))
        frames = frames[minds[frames, row] & there(streams)[frames - 12, row] & there(streams)[frames + 12, row]]
        around += len(frames) > 30
        likeness += [own[frames] @ turning[frames + lag] for lag in lags]
    assert around >= 3, "people go round it, and look where they go"
    assert 0.05 < lags[likeness.argmax()] / FPS < 0.5


def test_measures_are_those_of_numpy(throng, bake, streams, people):
    told = json.loads(throng("measure", bake, "--json").stdout)
    rates = rates_of(streams)
    assert told["head_rate"]["p99"] == pytest.approx(numpy.percentile(rates, 99), abs=1.0)
    assert told["head_rate"]["worst"] == pytest.approx(rates.max(), rel=1e-3)
    party = numpy.array([int(person["party"]) for person in people])
    at = streams["gaze"][..., 2].astype(int)
    of_own = party[numpy.clip(at - 1, 0, None)] == party[None]
    kinds = {"way": at == -1, "things": at < -1, "nothing": at == 0, "company": (at > 0) & of_own,
             "people": (at > 0) & ~of_own}
    for name, is_it in kinds.items():
        assert told["looks_at"][name] == pytest.approx(100.0 * is_it[there(streams)].mean(), abs=0.01), name
    assert all(share > 0.5 for share in told["looks_at"].values())


def test_a_bar_on_heads_is_held_and_missed(throng, tmp_path):
    for most, code in ((200, 0), (5, 1)):
        folder = bake_of(throng, tmp_path / str(most), "--attention", "--set",
                         f'expect={{"head_rate_p99": {{"max": {most}}}}}', "--set", "simulation.duration=6")
        told = throng("measure", folder, expect=code)
        assert ("head_rate_p99" in told.stdout + told.stderr) == (code == 1)


def test_nothing_else_changes(throng, bake, streams, tmp_path):
    plain = streams_of(bake_of(throng, tmp_path / "plain", "--feet"))
    assert set(streams) - set(plain) == {"attention", "gaze"}
    for name, values in plain.items():
        assert values.tobytes() == streams[name].tobytes(), name
    alone = streams_of(bake_of(throng, tmp_path / "alone", "--feet", "--attention"))
    assert alone["attention"].tobytes() == streams["attention"].tobytes()
