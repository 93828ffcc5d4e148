# SPDX-License-Identifier: Apache-2.0
"""throng_io.Bake: what it shows is what the files hold, and other programs' readers find the same."""
import csv
import json
import pathlib
import shutil
import sqlite3

import numpy
import pytest
import shapely

import throng_io
from throng_io import cli

LAYOUT = {"throng": 1, "simulation": {"duration": 12, "seed": 5},
          "roads": [{"id": "road", "centreline": [[1000000, 2000000], [1000012, 2000000]], "width": 6}],
          "areas": [{"id": "kiosk front", "polygon": [[1000004, 2000001], [1000006, 2000001], [1000006, 2000002]]}],
          "walls": [{"id": "pillar", "closed": True,
                     "points": [[1000005, 1999999], [1000006, 1999999], [1000006, 2000000], [1000005, 2000000]]},
                    {"points": [[1000000, 2000003], [1000012, 2000003]], "thickness": 0.4}],
          "flows": [{"id": "=east", "from": "road:start", "to": "road:end", "count": 8, "end": 2},
                    {"id": "west", "from": "road:end", "to": "road:start", "count": 5, "end": 2}]}


@pytest.fixture(scope="module")
def street(throng, once):
    def make(folder):
        throng_io.bake(LAYOUT, folder / "bake", program=throng.binary)

    return throng_io.Bake(once("python-street", make) / "bake")


def test_streams_are_views_of_the_files(street):
    for name in ("pos", "dir", "state"):
        view = street.stream(name)
        assert isinstance(view, numpy.memmap) and not view.flags.writeable
        assert numpy.array_equal(view, numpy.load(street.folder / "streams" / f"{name}.npy"))
        assert numpy.shares_memory(view, street.stream(name))
    assert numpy.shares_memory(street.component("speed"), street.dir)
    assert numpy.array_equal(street.component("state.phase"), street.state[:, :, 2])
    with pytest.raises(throng_io.BakeError, match="pos, dir, state"):
        street.stream("density")
    with pytest.raises(throng_io.BakeError, match="breath"):
        street.component("breath")


def test_people_and_groups_are_those_of_the_table(street):
    with open(street.folder / "agents.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    assert [str(name) for name in street.people["group"]] == [row["group"].lstrip("'") for row in rows]
    assert numpy.allclose(street.people["radius"], [float(row["radius"]) for row in rows])
    assert {name: len(rows) for name, rows in street.groups.items()} == {"=east": 8, "west": 5}
    assert street.account["agents"] == street.agents == 13
    table = street.table()
    assert list(table["group"]) == list(street.people["group"]) and table.index.name == "id"


def test_states_have_names_and_frames_have_times(street):
    first = int(street.people["spawn_frame"][0])
    assert not street.there()[:first, 0].any() and street.there()[first, 0]
    assert (street.doing("walking") | street.doing("away")).all() and street.doing("walking").any()
    assert street.times[1] == pytest.approx(1 / 24) and street.frame_at(2.0) == 48
    assert street.frame_at(1e6) == street.frames - 1


def test_the_ground_is_geometry_in_the_world(street):
    assert street.walls["pillar"].area == pytest.approx(1.0)
    assert street.walls["wall1"].area == pytest.approx(12 * 0.4 + numpy.pi * 0.04, rel=0.01)
    assert street.roads["road"].area == pytest.approx(72)
    assert street.areas["kiosk front"].area == pytest.approx(1.0)
    ground = street.walkable()
    places = street.world()[street.there()]
    assert places[:, 0].min() > 999990 and shapely.contains_xy(ground, places[:, 0], places[:, 1]).all()
    assert ground.is_valid and not ground.intersects(street.walls["pillar"].buffer(-1e-6))


def test_pedpy_takes_it(street):
    pedpy = pytest.importorskip("pedpy", reason="PedPy is not installed")
    people, ground = street.to_pedpy(every=3)
    assert people.frame_rate == 8.0 and pedpy.is_trajectory_valid(traj_data=people, walkable_area=ground)
    frame = people.data[people.data.frame == 20]
    assert numpy.allclose(frame[["x", "y"]], street.world(60)[frame.id][:, :2], atol=1e-9)
    assert sorted(frame.id) == list(numpy.nonzero(street.there(60))[0])


def test_pedpys_own_reader_finds_the_same_in_jupedsims_format(street, tmp_path):
    pedpy = pytest.importorskip("pedpy", reason="PedPy is not installed")
    assert cli.main(["export", str(street.folder), "-o", str(tmp_path / "a.sqlite"), "--every", "3"]) == 0
    people, ground = street.to_pedpy(every=3)
    read = pedpy.load_trajectory_from_jupedsim_sqlite(trajectory_file=tmp_path / "a.sqlite")
    assert read.frame_rate == people.frame_rate
    keys = ["frame", "id", "x", "y"]
    assert numpy.array_equal(read.data[keys].to_numpy(), people.data[keys].to_numpy())
    area = pedpy.load_walkable_area_from_jupedsim_sqlite(trajectory_file=tmp_path / "a.sqlite")
    assert area.polygon.symmetric_difference(ground.polygon).area < 1e-6
    frames, = sqlite3.connect(tmp_path / "a.sqlite").execute("SELECT count(*) FROM frame_data").fetchone()
    assert frames == len(range(0, street.frames, 3))


def test_csv_has_everybody_and_no_formulas(street, tmp_path):
    street.to_csv(tmp_path / "a.csv", every=2)
    with open(tmp_path / "a.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    there = street.there(slice(None, None, 2))
    assert len(rows) == there.sum()
    assert {row["group"] for row in rows} == {"'=east", "west"}
    row = rows[len(rows) // 2]
    place = street.world(2 * int(row["frame"]))[int(row["id"])]
    assert [float(row[axis]) for axis in "xyz"] == pytest.approx(place, abs=1e-4)
    with pytest.raises(throng_io.ThrongError, match="1 or more"):
        street.to_csv(tmp_path / "b.csv", every=0)
    assert [path.name for path in tmp_path.iterdir()] == ["a.csv"]


def test_the_people_as_a_data_frame(street):
    table = street.to_pandas(every=4)
    assert len(table) == street.there(slice(None, None, 4)).sum()
    assert table.groupby("group").id.nunique().to_dict() == {"=east": 8, "west": 5}


def damaged(street, folder, change):
    copy = folder / "bake"
    shutil.copytree(street.folder, copy)
    change(copy)
    with pytest.raises(throng_io.BakeError) as told:
        bake = throng_io.Bake(copy)
        bake.people, bake.pos
    return str(told.value)


def manifest_with(**values):
    def change(bake):
        path = bake / "bake.json"
        path.write_text(json.dumps({**json.loads(path.read_text()), **values}))

    return change


def cut(name, bytes_left):
    def change(bake):
        (bake / name).write_bytes((bake / name).read_bytes()[:bytes_left])

    return change


@pytest.mark.parametrize("change, told", [
    (lambda bake: (bake / "bake.json").unlink(), "bake.json is not there"),
    (cut("bake.json", 100), "cannot be read"),
    (manifest_with(version=2), "version 2 is not known"),
    (manifest_with(fps="many"), "/fps"),
    (manifest_with(table="../../secret.csv"), "outside the bake"),
    (manifest_with(agents=14), "expected 14"),
    (cut("streams/pos.npy", 5000), "cannot be read"),
    (cut("agents.csv", 200), "expected 20 values"),
    (lambda bake: (bake / "agents.csv").write_bytes(b"id\n\xff\n"), "cannot be read"),
], ids=["none", "cut", "version", "fps", "outside", "agents", "stream", "table", "bytes"])
def test_what_is_no_bake_is_told(street, tmp_path, change, told):
    assert told in damaged(street, tmp_path, change)


def test_the_command_tells_mistakes_in_one_sentence(street, tmp_path, capsys):
    assert cli.main(["export", str(tmp_path), "-o", str(tmp_path / "a.csv")]) == 3
    assert "bake.json is not there" in capsys.readouterr().err
    assert cli.main(["export", str(street.folder), "-o", str(tmp_path / "a.xls")]) == 3
    assert ".csv or .sqlite" in capsys.readouterr().err
    assert cli.main(["export", str(street.folder), "-o", str(tmp_path / "no" / "a.csv")]) == 3
    assert "cannot be written" in capsys.readouterr().err
    assert list(pathlib.Path(tmp_path).iterdir()) == []
