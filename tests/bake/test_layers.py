# SPDX-License-Identifier: Apache-2.0
"""Layers of overrides: whoever a selector means is changed by `throng apply`, in this take and in others."""
import csv
import json
import sys

import jsonschema
import numpy
import pytest

from conftest import ROOT

sys.path.insert(0, str(ROOT / "blender_addon"))
from throng.overrides import override_file  # noqa: E402
from throng.people import casting  # noqa: E402

STREET = {"throng": 1, "name": "street", "simulation": {"duration": 4, "seed": 7},
          "roads": [{"id": "road", "centreline": [[0, 0], [24, 0]], "width": 6},
                    {"id": "far", "centreline": [[0, -18], [24, -18]], "width": 6}],
          "walls": [{"id": "kerb", "points": [[0, 4], [24, 4]]}],
          "flows": [{"id": "f", "from": "road:start", "to": "road:end", "count": 30, "end": 3,
                     "people": {"groups": "leisure", "profile": {"adult": 0.7, "child": 0.3}}}],
          "formations": [{"id": "ring", "type": "circle", "centre": [10, 12], "radius": 4, "count": 7}]}


def streams(bake, names=("pos", "dir", "state")):
    return {name: numpy.load(bake / "streams" / f"{name}.npy").astype(float) for name in names}


def table(bake):
    with open(bake / "agents.csv", newline="") as file:
        return list(csv.DictReader(file))


def layer(who, do, name="layer", **more):
    return {"name": name, "who": who, "do": do, **more}


def write(path, *layers):
    path.write_text(json.dumps({"throng_overrides": 1, "overrides": [], "layers": layers}, indent=1))
    return path


@pytest.fixture(scope="module")
def street(throng, once):
    def make(folder):
        (folder / "street.json").write_text(json.dumps(STREET))
        throng("bake", folder / "street.json", "-o", folder / "street", "-q", "--no-gltf", "--feet", "--gaze")

    return once("layers", make)


@pytest.fixture
def rows_of(throng, street, tmp_path):
    """Whom a selector means."""
    def ask(who, bake=street / "street"):
        write(tmp_path / "asked.json", layer(who, {"hide": True}))
        told = json.loads(throng("apply", bake, "--overrides", tmp_path / "asked.json", "--dry-run", "--json").stdout)
        return told[-1]["rows"]

    return ask


def rows_where(bake, **wanted):
    return [row for row, person in enumerate(table(bake)) if all(person[key] == value for key, value in wanted.items())]


@pytest.mark.quick
def test_selectors_mean_whom_the_table_and_the_streams_say(rows_of, street):
    bake = street / "street"
    assert rows_of({"group": "ring"}) == rows_where(bake, group="ring") == list(range(30, 37))
    children = rows_where(bake, profile="child")
    assert rows_of({"profile": "child"}) == children and 0 < len(children) < 30
    parties = [person["party"] for person in table(bake)]
    pairs = [row for row, party in enumerate(parties) if parties.count(party) == 2]
    assert rows_of({"party": [2, 2]}) == pairs and pairs
    assert rows_of({"with": {"rows": [pairs[0]] * 2}}) == [
        row for row in range(37) if parties[row] == parties[pairs[0]]]
    made = streams(bake)
    there = made["state"][..., 0] > 0.5
    near = numpy.hypot(made["pos"][..., 0] - 3, made["pos"][..., 1]) <= 1.5
    assert rows_of({"near": {"point": [3, 0], "within": 1.5, "frames": [20, 60]}}) == sorted(
        numpy.nonzero((near & there)[20:61].any(axis=0))[0])
    at_kerb = (numpy.abs(made["pos"][..., 1] - 4) <= 2.1) & there
    assert rows_of({"near": {"wall": "kerb", "within": 2}, "group": "f"}) == sorted(
        numpy.nonzero(at_kerb[:, :30].any(axis=0))[0])


@pytest.mark.quick
def test_a_share_means_the_same_people_in_another_take(throng, rows_of, street, tmp_path):
    half = rows_of({"share": {"of": 0.5, "seed": 4}})
    assert 8 < len(half) < 28
    document = json.loads(json.dumps(STREET))
    document["formations"].insert(0, {"id": "before", "type": "circle", "centre": [40, 12], "radius": 4, "count": 9})
    document["flows"].insert(0, {**document["flows"][0], "id": "other", "count": 5,
                                 "from": "far:start", "to": "far:end"})
    (tmp_path / "take2.json").write_text(json.dumps(document))
    throng("bake", tmp_path / "take2.json", "-o", tmp_path / "take2", "-q", "--no-gltf", "--set", "simulation.seed=9")
    numbers = lambda bake, rows: sorted(
        (group, row - rows_where(bake, group=group)[0]) for group in ("f", "ring")
        for row in rows if table(bake)[row]["group"] == group)
    again = rows_of({"share": {"of": 0.5, "seed": 4}, "group": ["f", "ring"]}, tmp_path / "take2")
    assert numbers(tmp_path / "take2", again) == numbers(street / "street", half) and again != half


@pytest.mark.quick
def test_what_is_written_and_what_is_told(throng, street, tmp_path, manifest_of):
    path = write(tmp_path / "l.json",
                 layer({"group": "ring"}, {"tint": "#a01020", "duplicate": {"copies": 2, "by": [20, 0, 0]}}, "more"),
                 layer({"copies": "more", "share": {"of": 0.5}}, {"hide": {"frames": [0, 10]}}, "some"),
                 layer({"profile": "elderly"}, {"hide": True}, "nobody"),
                 layer({"everybody": True}, {"hide": True}, "off", enabled=False))
    arguments = ("apply", street / "street", "--overrides", path, "-o", tmp_path / "out", "-q")
    told = throng(*arguments)
    assert "layer `more`: 7 people: tint, duplicate (14 copies)" in told.stdout \
        and "layer `off` is not enabled" in told.stdout
    assert f"{path}:" in told.stderr and "the layer `nobody`: there is no profile `elderly`" in told.stderr
    assert "verified" in throng("info", tmp_path / "out", "--verify").stdout
    manifest, made = manifest_of(tmp_path / "out"), streams(tmp_path / "out")
    assert manifest["agents"] == 51 == len(table(tmp_path / "out")) == made["pos"].shape[1]
    applied = manifest["applied"]["layers"]
    assert [(each["layer"], each["people"], each["copies"]) for each in applied] == [
        ("more", 7, 14), ("some", applied[1]["people"], 0), ("nobody", 0, 0), ("off", 0, 0)]
    before = streams(street / "street")
    assert (made["pos"][:, :37] == before["pos"]).all()
    assert numpy.allclose(made["pos"][:, 37:44] - before["pos"][:, 30:37], [20, 0, 0], atol=1e-5)
    assert numpy.allclose(made["pos"][:, 44:] - before["pos"][:, 30:37], [40, 0, 0], atol=1e-5)
    hidden = (made["state"][:11, 37:, 0] == 0).all(axis=0)
    assert hidden.sum() == applied[1]["people"] and 0 < hidden.sum() < 14
    assert (made["state"][11:, 37:, 0] > 0.5).all()
    measured = json.loads(throng("measure", tmp_path / "out", "--json").stdout)
    assert measured["agents"] == 51
    assert "1 of 4 layers mean nobody" in throng(*arguments, "--force", "--strict", expect=3).stderr
    throng(*arguments[:5], tmp_path / "twin", "-q")
    for name in ("pos", "dir", "state", "gaze"):
        assert (tmp_path / "twin" / "streams" / f"{name}.npy").read_bytes() == (
            tmp_path / "out" / "streams" / f"{name}.npy").read_bytes(), "the same bytes again"


@pytest.mark.quick
def test_who_is_changed_keeps_its_body_unless_it_is_swapped(throng, street, tmp_path):
    """Of casts that are shaped from bodies: somebody tinted, bent or copied is no other person."""
    path = write(tmp_path / "l.json", layer({"rows": [0, 3]}, {"tint": "#a01020", "duplicate": {}}, "a"),
                 layer({"rows": [4, 5]}, {"hide": True}, "b"), layer({"rows": [6, 7]}, {"character": 3}, "c"))
    throng("apply", street / "street", "--overrides", path, "-o", tmp_path / "out", "-q")
    before, after = casting.read_walkers(street / "street"), casting.read_walkers(tmp_path / "out")
    assert [row for row, walker in enumerate(after) if walker.chosen] == [6, 7]
    roles = casting.roles_for(before, 24)
    one, other = casting.choose(before, roles, 24), casting.choose(after, roles, 24)
    assert one[:6] == other[:6] and len(other) == 41


@pytest.mark.quick
def test_copies_of_those_who_walk_together_walk_together(throng, street, tmp_path):
    path = write(tmp_path / "l.json", layer({"party": [2, 2]}, {"duplicate": {"copies": 2, "by": [0, 9, 0]}}))
    throng("apply", street / "street", "--overrides", path, "-o", tmp_path / "out", "-q")
    people = table(tmp_path / "out")
    copies = people[37:]
    assert len(copies) >= 8 and {person["party"] for person in copies} == {person["id"] for person in copies[::2]}
    assert all(one["party"] == other["party"] == one["id"] for one, other in zip(copies[::2], copies[1::2]))


@pytest.mark.quick
def test_packed_bakes_take_layers_too(throng, street, tmp_path):
    throng("convert", street / "street", "-o", tmp_path / "packed", "--streams", "packed", "-q")
    path = write(tmp_path / "l.json", layer({"group": "ring"}, {"duplicate": {"by": [20, 0, 0]}}))
    throng("apply", tmp_path / "packed", "--overrides", path, "-o", tmp_path / "out", "-q")
    throng("convert", tmp_path / "out", "-o", tmp_path / "plain", "--streams", "npy", "-q")
    made, before = streams(tmp_path / "plain"), streams(street / "street")
    assert made["pos"].shape[1] == 44
    assert numpy.allclose(made["pos"][:, 37:] - before["pos"][:, 30:37], [20, 0, 0], atol=1e-4)


LAYERS = [(layer({"everybody": True}, {"hide": True}), True), (layer({}, {"hide": True}), False),
          (layer({"everybody": False}, {"hide": True}), False), (layer({"group": []}, {"hide": True}), False),
          (layer({"group": ["a", "b"]}, {"hide": {"frames": [1, 2]}}), True),
          (layer({"rows": [0]}, {"hide": True}), False), (layer({"rows": [0, 3]}, {"hide": {}}), False),
          (layer({"share": {"of": 2}}, {"hide": True}), False), (layer({"share": {}}, {"hide": True}), False),
          (layer({"region": {"polygon": [[0, 0], [1, 0]]}}, {"hide": True}), False),
          (layer({"not": {"or": [{"rows": [0, 1]}]}}, {"hide": True}), True),
          (layer({"or": []}, {"hide": True}), False),
          (layer({"near": {"point": [0, 0]}}, {"hide": True}), False),
          (layer({"rows": [0, 1]}, {"move": {"about": [0, 1], "turn": 4}}), True),
          (layer({"rows": [0, 1]}, {"move": {"about": [0, 1, 2]}}), False), (layer({"rows": [0, 1]}, {}), True),
          (layer({"rows": [0, 1]}, {"clip": {"activity": "runs"}}), False),
          (layer({"rows": [0, 1]}, {"clip": {"activity": "stands"}}, note="x"), True),
          (layer({"rows": [0, 1]}, {"duplicate": {}}), True),
          (layer({"rows": [0, 1]}, {"duplicate": {"copies": 0}}), False),
          (layer({"rows": [0, 1]}, {"bend": {"points": []}}), False),
          (layer({"rows": [0, 1]}, {"bend": {"points": [{"frame": 3, "by": [0, 1]}], "falloff": 0}}), False),
          (layer({"rows": [0, 1]}, {"hide": True}, enabled=1), False),
          (layer({"rows": [0, 1]}, {"hide": True}, ""), False),
          ({"name": "a", "who": {"rows": [0, 1]}}, False), (layer({"rows": [0, 1]}, {"hide": True}, extra=1), False)]


def test_the_schema_and_the_reader_agree(throng, street, tmp_path):
    schema = json.loads(throng("schema", "--overrides").stdout)
    jsonschema.Draft7Validator.check_schema(schema)
    wrong = []
    for document, valid in LAYERS:
        path = write(tmp_path / "l.json", document)
        by_schema = jsonschema.Draft7Validator(schema).is_valid(json.loads(path.read_text()))
        by_cli = throng("apply", street / "street", "--overrides", path, "--dry-run", expect=None).returncode == 0
        if (by_schema, by_cli) != (valid,) * 2:
            wrong.append((document, valid, by_schema, by_cli))
    assert not wrong


def test_the_add_on_keeps_the_layers_of_a_file(tmp_path):
    path = write(tmp_path / "l.json", layer({"rows": [0, 1]}, {"hide": True}))
    entry = {"id": 3, "group": "f", "spawn": {"frame": 7, "position": [1, 2, 0]}, "hide": True}
    override_file.write(str(path), [entry])
    document = json.loads(path.read_text())
    assert document["overrides"] == [entry] and document["layers"] == [layer({"rows": [0, 1]}, {"hide": True})]
    override_file.write(str(path), [])
    assert json.loads(path.read_text())["layers"] == document["layers"]


def slides_of(bake, row, first, last):
    """How far the feet of somebody go in the world in each frame while they and their clip's are on the ground, m: of a
    clip whose planted foot goes backwards as fast as its stride goes forwards."""
    strides = json.loads((bake / "bake.json").read_text())["strides"]
    got = {name: values[:, row] for name, values in streams(
        bake, ("pos", "dir", "state", "left_foot", "right_foot", "carriage")).items()}
    gait = numpy.round((got["state"][:, 0] % 1) * 16).astype(int)
    stride, heading = numpy.array(strides)[gait], got["dir"][:, 0] + 1j * got["dir"][:, 1]
    place, slides = got["pos"][:, 0] + 1j * got["pos"][:, 1], []
    blends = numpy.abs((got["state"][:, 0] % 1) * 16 - gait) > 1e-4  # between two strides, of which this knows one
    for side, (name, beside, shift) in enumerate((("left_foot", 0.06, 0.5), ("right_foot", -0.06, 0.0))):
        own = (got["state"][:, 2] + shift) % 1.0
        stands = (own < 0.62 - 0.09 * (stride / 1.446 - 1)) & (got[name][:, 2] % 1 < 1e-6) & ~blends
        foot = place + heading * (got["carriage"][:, 0] * (0.28 - own) * stride + got[name][:, 0]
                                  + 1j * (beside + got[name][:, 1]))
        planted = stands[1:] & stands[:-1] & (own[1:] > own[:-1]) & (gait[1:] == gait[:-1])
        slides += list(numpy.abs(numpy.diff(foot))[first:last][planted[first:last]])
    return numpy.array(slides)


def test_feet_of_those_whose_way_is_bent_stay_planted(throng, street, tmp_path):
    rows = [row for row, person in enumerate(table(street / "street")[:30]) if int(person["spawn_frame"] or 999) < 15]
    who = {"rows": [rows[0], rows[-1]], "group": "f"}
    path = write(tmp_path / "l.json", layer(who, {"bend": {"points": [{"frame": 60, "by": [0, 0.6]}]}}, "bend"))
    told = throng("apply", street / "street", "--overrides", path, "-o", tmp_path / "out", "-q")
    assert "m/s^2" not in told.stderr and "bend" in table(tmp_path / "out")[rows[0]]["overrides"]
    before, after = streams(street / "street"), streams(tmp_path / "out")
    off = after["pos"][:, rows] - before["pos"][:, rows]
    assert numpy.allclose(off[60], [0, 0.6, 0], atol=1e-5)
    seconds = numpy.sqrt(10 / numpy.sqrt(3) * 0.6)
    assert (off[: int(60 - 24 * seconds)] == 0).all()
    added = numpy.linalg.norm(numpy.diff(off, n=2, axis=0), axis=2) * 24 ** 2
    assert 0.8 < added[:60].max() <= 1.0 + 0.02, "m/s^2; a little more where single precision rounds"
    bent = numpy.concatenate([slides_of(tmp_path / "out", row, 20, 95) for row in rows])
    straight = numpy.concatenate([slides_of(street / "street", row, 20, 95) for row in rows])
    naive = tmp_path / "naive"
    throng("convert", tmp_path / "out", "-o", naive, "--streams", "npy", "-q")
    for name in ("left_foot", "right_foot", "carriage", "state"):  # the feet of before under the bent way
        (naive / "streams" / f"{name}.npy").write_bytes((street / "street" / "streams" / f"{name}.npy").read_bytes())
    kept = numpy.concatenate([slides_of(naive, row, 20, 95) for row in rows])
    share = lambda slides: (slides > 0.01).mean()
    assert len(bent) > 250 and share(bent) < share(straight) + 0.01 and share(kept) > 10 * max(share(bent), 0.005)


def test_clips_and_looks_in_real_streams(throng, street, tmp_path):
    path = write(tmp_path / "l.json",
                 layer({"group": "f"}, {"clip": {"activity": "looks", "frames": [50, 60]},
                                        "look_at": {"point": [12, 60, 1.6], "frames": [40, 80], "ease": 8}}))
    throng("apply", street / "street", "--overrides", path, "-o", tmp_path / "out", "-q")
    names = ("pos", "dir", "state", "gaze")
    before, after = streams(street / "street", names), streams(tmp_path / "out", names)
    there = before["state"][..., 0] > 0.5
    there[:, 30:] = False
    inside = there & (numpy.arange(len(there)) >= 50)[:, None] & (numpy.arange(len(there)) <= 60)[:, None]
    assert (before["state"][inside][:, 0] % 1 > 0).any(), "their gaits"
    assert (numpy.floor(after["state"][inside][:, 0]) == 3).all()
    assert (after["state"][..., 0] % 1 == before["state"][..., 0] % 1).all()
    assert (after["state"][~inside] == before["state"][~inside]).all()
    held = inside  # eight frames after the look has begun, eight before it ends
    way = numpy.array([12, 60]) - before["pos"][held][:, :2]
    yaw = numpy.angle((way[:, 0] + 1j * way[:, 1]) / (before["dir"][held][:, 0] + 1j * before["dir"][held][:, 1]))
    most = numpy.radians(70)
    assert numpy.abs(after["gaze"][held][:, 0] - yaw.clip(-most, most)).max() < 1e-4
    outside = (numpy.arange(len(there)) < 40) | (numpy.arange(len(there)) > 80)
    assert (after["gaze"][outside] == before["gaze"][outside]).all()
    assert numpy.abs(numpy.diff(after["gaze"][38:84, :, 0] - before["gaze"][38:84, :, 0], axis=0))[:, there[38:84].all(
        axis=0)].max() < 0.6, "heads do not jump"


def test_overlaps_that_changes_make_are_told(throng, street, tmp_path, manifest_of):
    before = streams(street / "street")
    there = before["state"][60, :, 0] > 0.5
    one, other = numpy.nonzero(there)[0][:2]
    by = (before["pos"][60, other] - before["pos"][60, one])[:2]
    path = write(tmp_path / "l.json", layer({"rows": [int(one)] * 2}, {"bend": {
        "points": [{"frame": 60, "by": [float(by[0]), float(by[1])]}], "falloff": 40, "most_acceleration": 20}}))
    told = throng("apply", street / "street", "--overrides", path, "-o", tmp_path / "out", "-q").stdout
    overlaps = manifest_of(tmp_path / "out")["applied"]["overlaps"]
    depths = [float(person["depth"]) for person in table(street / "street")]
    found = [each for each in overlaps["deepest"] if each["rows"] == sorted((int(one), int(other)))]
    assert found and found[0]["depth"] == pytest.approx(0.5 * (depths[one] + depths[other]), abs=0.02)
    assert found[0]["frames"][0] <= 60 <= found[0]["frames"][1] and f"{min(one, other)} and {max(one, other)}: " in told
