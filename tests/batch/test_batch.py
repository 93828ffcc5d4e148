# SPDX-License-Identifier: Apache-2.0
"""Families, generators, and batches on one machine."""
import csv
import json
import os
import pathlib
import random
import re
import signal
import sqlite3
import subprocess
import sys
import time

import jsonschema
import numpy
import pytest

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "tests"))
import terrain_files  # noqa: E402
from processor_time import HANGS  # noqa: E402

EXAMPLES = ROOT / "examples"

BASE = {
    "throng": 1,
    "simulation": {"duration": 2, "seed": 1},
    "areas": [{"id": "west", "polygon": [[0, 0], [2, 0], [2, 4], [0, 4]]},
              {"id": "east", "polygon": [[10, 0], [12, 0], [12, 4], [10, 4]]}],
    "walls": [{"id": "south", "points": [[-1, -0.5], [13, -0.5]]}],
    "flows": [{"id": "walkers", "from": "west", "to": "east", "rate": 2}],
}


def family(folder, **changes):
    content = {"throng_family": 1, "name": "small", "base": BASE,
               "axes": [{"name": "rate", "set": "/flows/0/rate", "values": [1, 2, 4]},
                        {"name": "seed", "set": "/simulation/seed", "range": [1, 2]}]}
    content.update(changes)
    path = folder / "family.json"
    path.write_text(json.dumps({key: value for key, value in content.items() if value is not None}))
    return path


def rows(folder, sql="SELECT * FROM results ORDER BY number"):
    connection = sqlite3.connect(f"file:{folder / 'results.sqlite'}?mode=ro", uri=True)
    connection.row_factory = sqlite3.Row
    return [dict(row) for row in connection.execute(sql)]


# ---- families

@pytest.mark.parametrize("path", sorted(EXAMPLES.glob("family-*.json")), ids=lambda path: path.name)
def test_the_examples_fit_the_schema_and_can_be_planned(throng, path, tmp_path):
    schema = json.loads(throng("schema", "--family").stdout)
    jsonschema.Draft7Validator.check_schema(schema)
    jsonschema.validate(json.loads(path.read_text()), schema)
    told = throng("batch", path, "-o", tmp_path / "out", "--dry-run").stdout
    assert re.search(r"to bake: \d+ with \d+ worker", told) and "space: at most" in told and "time: at most" in told
    assert not (tmp_path / "out").exists()


@pytest.mark.quick
def test_a_grid_has_every_combination_once(throng, tmp_path):
    throng("batch", family(tmp_path), "-o", tmp_path / "out", "-q")
    found = rows(tmp_path / "out")
    assert [(row["rate"], row["seed"]) for row in found] == [(1, 1), (1, 2), (2, 1), (2, 2), (4, 1), (4, 2)]
    assert all(row["status"] == "ok" for row in found)
    for row in found:
        layout = json.loads((tmp_path / "out" / row["bake"] / "layout.json").read_text())
        assert layout["flows"][0]["rate"] == row["rate"] and layout["simulation"]["seed"] == row["seed"]
        throng("info", tmp_path / "out" / row["bake"], "--verify")


def drawn(throng, tmp_path, sampling, count, axes):
    plan = family(tmp_path, sampling=sampling, count=count, axes=axes, base={**BASE, "simulation": {"duration": 0.05}},
                  bake={"keep": False})
    throng("batch", plan, "-o", tmp_path / sampling, "-q")
    return rows(tmp_path / sampling)


def test_a_latin_hypercube_covers_each_axis_evenly(throng, tmp_path):
    axes = [{"name": "rate", "set": "/flows/0/rate", "uniform": [1, 3]},
            {"name": "width", "set": "/walls/0/thickness", "normal": [0.3, 0.1], "min": 0.1, "max": 0.6},
            {"name": "seed", "set": "/simulation/seed", "uniform": [0, 49], "whole": True}]
    found = drawn(throng, tmp_path, "latin", 50, axes)
    assert sorted(int((row["rate"] - 1) / 2 * 50) for row in found) == list(range(50))
    assert sorted(row["seed"] for row in found) == list(range(50))
    widths = numpy.array([row["width"] for row in found])
    assert 0.1 <= widths.min() and widths.max() <= 0.6 and abs(widths.mean() - 0.3) < 0.01 \
        and 0.08 < widths.std() < 0.11


def test_weights_decide_how_often_a_value_is_drawn(throng, tmp_path):
    axes = [{"name": "profile", "set": "/flows/0/people", "values": [{"profile": "adult"}, {"profile": "child"}],
             "weights": [3, 1]},
            {"name": "seed", "set": "/simulation/seed", "uniform": [0, 1000000], "whole": True}]
    found = drawn(throng, tmp_path, "latin", 80, axes)
    assert sum("adult" in row["profile"] for row in found) == 60
    assert len({row["seed"] for row in found}) > 75


def test_axes_go_by_ids_by_formulas_and_by_cases(throng, tmp_path):
    axes = [{"name": "rate", "set": "/flows/by-id/walkers/rate", "values": [1, 2]},
            {"name": "duration", "set": "/simulation/duration", "formula": "max(0.1, rate / 10)"},
            {"name": "yard", "cases": {"open": {"/walls/by-id/south/points": [[-1, -9], [13, -9]]},
                                       "shut": {"/walls/by-id/south/height": 5, "/simulation/seed": 4}}}]
    throng("batch", family(tmp_path, axes=axes), "-o", tmp_path / "out", "-q")
    found = rows(tmp_path / "out")
    assert [(row["rate"], row["parameter duration"], row["yard"]) for row in found] == \
        [(1, 0.1, "open"), (1, 0.1, "shut"), (2, 0.2, "open"), (2, 0.2, "shut")]
    for row in found:
        layout = json.loads((tmp_path / "out" / row["bake"] / "layout.json").read_text())
        is_open = row["yard"] == "open"
        assert layout["flows"][0]["rate"] == row["rate"] and layout["simulation"]["duration"] == row["rate"] / 10
        assert layout["simulation"]["seed"] == (1 if is_open else 4) and ("height" in layout["walls"][0]) != is_open
        assert layout["walls"][0]["points"][0][1] == (-9 if is_open else -0.5)


def test_scenarios_are_named_by_their_parameters_whatever_the_order_of_axes(throng, tmp_path):
    (tmp_path / "a").mkdir()
    (tmp_path / "b").mkdir()
    axes = json.loads(family(tmp_path).read_text())["axes"]
    throng("batch", family(tmp_path / "a"), "-o", tmp_path / "a" / "out", "-q")
    throng("batch", family(tmp_path / "b", axes=axes[::-1]), "-o", tmp_path / "b" / "out", "-q")
    by_id = [{row["id"]: (row["rate"], row["seed"]) for row in rows(tmp_path / name / "out")} for name in "ab"]
    assert by_id[0] == by_id[1]


WRONG = [
    ({"axes": None}, "needs `axes`"),
    ({"base": None}, "either a `base` layout or a `generate` block"),
    ({"base": "nowhere.json"}, "cannot be read"),
    ({"axes": [{"set": "/flows/0/rate", "uniform": [1, 2]}]}, "a grid takes every value"),
    ({"axes": [{"set": "/flows/0/rate", "values": [1], "range": [1, 2]}]}, "this one has several"),
    ({"axes": [{"set": "flows.0.rate", "values": [1]}]}, "expected a JSON pointer"),
    ({"axes": [{"set": "/flows/3/rate", "values": [1]}]}, "scenario 1 (flows.3.rate 1)"),
    ({"axes": [{"set": "/flows/0/rate", "values": [1, -1]}]}, "/flows/0/rate"),
    ({"axes": [{"set": "/flows/0/rat", "values": [1]}]}, "did you mean `rate`?"),
    ({"axes": [{"parameter": "arms", "values": [3]}]}, "this family has a base layout"),
    ({"base": None, "generate": {"kind": "crossing", "arms": 3.5}, "axes": [{"parameter": "seed", "values": [3]}]},
     "whole number"),
    ({"base": None, "generate": {"kind": "crossing"}, "axes": [{"parameter": "legs", "values": [3]}]},
     "there is no parameter `legs`"),
    ({"sampling": "latin"}, "how many scenarios"),
    ({"axes": [{"set": "/simulation/seed", "range": [1, 10000000]}]}, "a family can have at most 1000000 scenarios"),
    ({"axes": [{"set": "/simulation/seed", "range": [1, 2, 0]}]}, "in steps above zero"),
    ({"axes": [{"set": "/simulation/seed", "range": [2, 1]}]}, "from the smaller number to the larger one"),
    ({"axes": [{"set": "/simulation/seed", "range": [1, 2000]}, {"set": "/flows/0/rate", "range": [1, 2000]}]},
     "too many"),
    ({"axes": [{"set": "/walls/by-id/north/height", "values": [3]}]}, "has the id `north`; there are `south`"),
    ({"axes": [{"name": "a", "set": "/flows/0/rate", "values": [0]},
               {"name": "b", "set": "/simulation/seed", "formula": "1 / a"}]}, "`b` has no value where it is a 0: 1 is"),
    ({"axes": [{"name": "a", "set": "/flows/0/rate", "formula": "2 * b"}]}, "there is no axis `b`"),
    ({"axis": []}, "did you mean `axes`?"),
]


@pytest.mark.parametrize("changes, message", WRONG, ids=lambda value: value[:24] if isinstance(value, str) else "")
def test_mistakes_are_told_before_anything_is_done(throng, tmp_path, changes, message):
    process = throng("batch", family(tmp_path, **changes), "-o", tmp_path / "out", expect=3)
    assert message in process.stderr
    assert not (tmp_path / "out").exists()


# ---- generators

def generators(throng):
    found = {}
    for line in throng("generate", "--list").stdout.splitlines():
        if not line.startswith(" "):
            name = line.split(":")[0]
            found[name] = {}
        else:
            parameter, standard, least, _, most = line.split()[:5]
            found[name][parameter] = (float(standard), float(least), float(most))
    return found


@pytest.mark.parametrize("kind", ["crossing", "corridor", "streets", "marathon", "plaza", "stadium", "station",
                                  "office"])
@pytest.mark.slow
def test_whatever_is_generated_is_valid(throng, kind, tmp_path):
    chance = random.Random(kind)
    whole = {"arms", "pillars", "columns", "rows", "exits", "people", "seed", "stands", "platforms",
             "escalators", "floors", "rooms", "waves"}
    parameters = generators(throng)[kind]
    schema = jsonschema.Draft7Validator(json.loads(throng("schema").stdout))
    for attempt in range(12):
        settings = []
        for name, (standard, least, most) in parameters.items():
            if name in ("duration", "warmup") or (chance.random() < 0.3 and attempt > 1):
                continue
            # The ends of the ranges first, then anything between, as people would choose.
            top = min(most, max(8 * standard, 10)) if attempt > 1 else min(most, 40 * max(standard, 1))
            value = least if attempt == 0 else top if attempt == 1 else chance.uniform(least, top)
            settings += ["--set", f"{name}={int(value) if name in whole else round(value, 3)}"]
        path = tmp_path / f"{attempt}.json"
        throng("generate", kind, *settings, "-o", path)
        schema.validate(json.loads(path.read_text()))
        process = throng("check", path, expect=None)
        assert process.returncode == 0, f"{settings}: {process.stderr}"


@pytest.mark.slow
def test_generated_people_get_where_they_want_to(throng, tmp_path):
    plan = tmp_path / "family.json"
    for kind, settings in {"crossing": {"arms": 5, "irregularity": 1, "length": 12, "width": 4},
                           "plaza": {"size": 14, "pillars": 10},
                           "corridor": {"length": 14, "pillars": 4},
                           "streets": {"columns": 1, "rows": 1, "block": 10, "width": 4},
                           "marathon": {"people": 234, "columns": 1, "block": 10, "width": 6, "waves": 3,
                                        "interval": 2},
                           "stadium": {"radius": 12, "stand": 5, "people": 60},
                           "stands": {"kind": "stadium", "stands": 3, "radius": 15, "stand": 8, "people": 60},
                           "station": {"people": 60, "time": 5, "duration": 120},
                           "office": {"people": 10, "rooms": 2, "duration": 100}}.items():
        plan.write_text(json.dumps({"throng_family": 1, "generate": {"kind": kind, "duration": 60, **settings},
                                    "axes": [{"parameter": "seed", "range": [1, 2]}], "bake": {"keep": False}}))
        throng("batch", plan, "-o", tmp_path / kind, "-q")
        for row in rows(tmp_path / kind):
            least = 1.0 if kind in ("marathon", "stands", "station", "office") else 0.3
            assert row["arrived"] >= least * row["agents"] and row["wall_crossings"] == 0, (kind, row)
            assert row["stuck"] <= 0.05 * row["agents"], (kind, row)


# ---- running

def test_run_again_and_nothing_is_done_twice(throng, tmp_path):
    plan = family(tmp_path)
    throng("batch", plan, "-o", tmp_path / "out", "-q")
    before = {path: path.stat().st_mtime_ns for path in (tmp_path / "out").rglob("*") if path.is_file()
              and path.name != "results.sqlite"}
    told = throng("batch", plan, "-o", tmp_path / "out").stdout
    assert "6 are done" in told and "0 baked" in told
    after = {path: path.stat().st_mtime_ns for path in (tmp_path / "out").rglob("*") if path.is_file()
             and path.name != "results.sqlite"}
    assert before == after


def test_again_bakes_everything_anew(throng, tmp_path):
    plan = family(tmp_path)
    throng("batch", plan, "-o", tmp_path / "out", "-q")
    bakes = sorted((tmp_path / "out" / "bakes").glob("*/bake.json"))
    before = {path: path.stat().st_mtime_ns for path in bakes}
    assert "6 baked" in throng("batch", plan, "-o", tmp_path / "out", "--again").stdout
    assert len(bakes) == 6 and all(path.stat().st_mtime_ns > before[path] for path in bakes)
    assert all(row["steps"] > 0 and row["simulate_seconds"] > 0 for row in rows(tmp_path / "out"))


def test_what_a_changed_family_wants_written_is_written(throng, tmp_path):
    throng("batch", family(tmp_path), "-o", tmp_path / "out", "-q")
    assert list((tmp_path / "out" / "bakes").glob("*/crowd.glb")) == []
    throng("batch", family(tmp_path, bake={"gltf": True}), "-o", tmp_path / "out", "-q")
    assert len(list((tmp_path / "out" / "bakes").glob("*/crowd.glb"))) == 6


def test_a_bake_that_is_there_without_its_result_is_measured_not_baked(throng, tmp_path):
    plan = family(tmp_path)
    throng("batch", plan, "-o", tmp_path / "out", "-q")
    row = rows(tmp_path / "out")[2]
    bake = tmp_path / "out" / row["bake"] / "bake.json"
    made = bake.stat().st_mtime_ns
    (tmp_path / "out" / "results" / f"{row['id']}.json").unlink()
    throng("batch", plan, "-o", tmp_path / "out", "-q")
    again = rows(tmp_path / "out")[2]
    assert bake.stat().st_mtime_ns == made
    assert again["steps"] == row["steps"] and again["simulate_seconds"] > 0 and again["arrived"] == row["arrived"]


def test_a_changed_terrain_makes_results_out_of_date(throng, tmp_path):
    plain = terrain_files.surface(lambda x, y: 0.0, (-2.0, -2.0), (14.0, 6.0), 2.0)
    (tmp_path / "ground.glb").write_bytes(terrain_files.glb(*plain))
    (tmp_path / "base.json").write_text(json.dumps({**BASE, "terrain": {"file": "ground.glb"}}))
    plan = family(tmp_path, base="base.json")
    throng("batch", plan, "-o", tmp_path / "out", "-q")
    assert "to bake: 0" in throng("batch", plan, "-o", tmp_path / "out", "--dry-run").stdout
    slope = terrain_files.surface(lambda x, y: 0.1 * x, (-2.0, -2.0), (14.0, 6.0), 2.0)
    (tmp_path / "ground.glb").write_bytes(terrain_files.glb(*slope))
    told = throng("batch", plan, "-o", tmp_path / "out", "--dry-run").stdout
    assert "6 are out of date" in told and "to bake: 6" in told


def test_ways_of_a_file_are_found_and_make_results_out_of_date_when_they_change(throng, tmp_path):
    ways = tmp_path / "seen.csv"
    ways.write_text("id,time,x,y\n0,0,0,1\n0,1,1,1\n0,2,2,1\n")
    given = [{"id": "seen", "file": "seen.csv"}, {"id": "told", "ways": [[[0, 0, 3], [2, 2, 3]]]}]
    (tmp_path / "base.json").write_text(json.dumps({**BASE, "given": given}))
    plan = family(tmp_path, base="base.json")
    throng("batch", plan, "-o", tmp_path / "out", "-q")
    assert "to bake: 0" in throng("batch", plan, "-o", tmp_path / "out", "--dry-run").stdout
    ways.write_text("id,time,x,y\n0,0,0,1\n0,1,1,1\n0,2,2,2\n")
    assert "6 are out of date" in throng("batch", plan, "-o", tmp_path / "out", "--dry-run").stdout


def test_files_that_axes_name_start_from_the_familys_folder(throng, tmp_path):
    for name, far in (("near.csv", 2), ("far.csv", 4)):
        (tmp_path / name).write_text(f"id,time,x,y\n0,0,0,1\n0,2,{far},1\n")
    (tmp_path / "bases").mkdir()
    (tmp_path / "bases" / "base.json").write_text(json.dumps({**BASE, "given": [{"id": "seen", "file": "none.csv"}]}))
    (tmp_path / "bases" / "none.csv").write_text("id,time,x,y\n0,0,0,1\n0,2,0,1\n")
    plan = family(tmp_path, base="bases/base.json",
                  axes=[{"name": "seen", "set": "/given/by-id/seen/file", "values": ["near.csv", "far.csv"]}])
    throng("batch", plan, "-o", tmp_path / "out", "-q")
    assert sorted(row["seen"] for row in rows(tmp_path / "out")) == ["far.csv", "near.csv"]
    layouts = [json.loads(path.read_text()) for path in (tmp_path / "out" / "bakes").glob("*/layout.json")]
    assert {each["given"][0]["file"] for each in layouts} == {str(tmp_path / name) for name in ("near.csv", "far.csv")}
    (tmp_path / "far.csv").write_text("id,time,x,y\n0,0,0,1\n0,2,5,1\n")
    assert "to bake: 1 " in throng("batch", plan, "-o", tmp_path / "out", "--dry-run").stdout


def test_files_are_found_where_an_axis_sets_all_that_names_them(throng, tmp_path):
    (tmp_path / "seen.csv").write_text("id,time,x,y\n0,0,0,1\n0,2,2,1\n")
    axes = [{"name": "who", "cases": {"nobody": {}, "one": {"/given": [{"id": "seen", "file": "seen.csv"}]}}}]
    throng("batch", family(tmp_path, base=BASE, axes=axes), "-o", tmp_path / "out", "-q")
    assert {row["status"] for row in rows(tmp_path / "out")} == {"ok"}


def test_a_changed_family_says_what_it_invalidates(throng, tmp_path):
    throng("batch", family(tmp_path), "-o", tmp_path / "out", "-q")
    changed = family(tmp_path, base={**BASE, "simulation": {"duration": 3, "seed": 1}},
                     axes=[{"name": "rate", "set": "/flows/0/rate", "values": [1, 2, 3]},
                           {"name": "seed", "set": "/simulation/seed", "range": [1, 2]}])
    told = throng("batch", changed, "-o", tmp_path / "out", "--dry-run").stdout
    assert "4 are out of date" in told and "2 results belong to no scenario" in told and "to bake: 6" in told
    throng("batch", changed, "-o", tmp_path / "out", "-q", "--prune")
    assert len(list((tmp_path / "out" / "results").iterdir())) == 6 == len(list((tmp_path / "out" / "bakes").iterdir()))
    assert {row["duration"] for row in rows(tmp_path / "out")} == {3.0}


@pytest.mark.quick
def test_failures_keep_their_reason_and_never_stop_the_rest(throng, tmp_path):
    # With the second wall, nobody can get from west to east: a layout that is valid to read and cannot be baked.
    shut = [{"id": "south", "points": [[-1, -0.5], [13, -0.5]]},
            {"id": "ring", "points": [[-1, -1], [3, -1], [3, 5], [-1, 5], [-1, -1]]}]
    plan = family(tmp_path, axes=[{"name": "walls", "set": "/walls", "values": [BASE["walls"], shut]},
                                  {"name": "seed", "set": "/simulation/seed", "range": [1, 3]}])
    process = throng("batch", plan, "-o", tmp_path / "out", expect=1)
    assert "3 failed" in process.stdout
    found = rows(tmp_path / "out")
    assert [row["status"] for row in found] == ["ok"] * 3 + ["failed"] * 3
    for row in found[3:]:
        assert "nobody can walk from `west` to `east`" in row["reason"]
        log = (tmp_path / "out" / row["log"]).read_text()
        assert row["reason"] in log and '"ring"' in log
    told = throng("batch", "query", tmp_path / "out", "--failed").stdout
    assert told.count("logs/") == 3
    # Tried again, and done with once they can be.
    again = throng("batch", plan, "-o", tmp_path / "out", expect=1).stdout
    assert "3 failed before and are tried again" in again


def processes_of(parent):
    found = subprocess.run(["ps", "--ppid", str(parent), "-o", "pid="], capture_output=True, text=True).stdout.split()
    return [int(word) for word in found]


LONGER = {**BASE, "simulation": {"duration": 60, "seed": 1}}


@pytest.mark.slow
def test_ctrl_c_stops_at_once_and_leaves_each_bake_complete_or_absent(throng, tmp_path):
    plan = family(tmp_path, base=LONGER, axes=[{"set": "/simulation/seed", "range": [1, 10]}])
    process = subprocess.Popen([throng.binary, "batch", str(plan), "-o", str(tmp_path / "out"), "--workers", "2"],
                               stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, start_new_session=True)
    while len(list((tmp_path / "out" / "results").glob("*.json"))) < 3:
        assert process.poll() is None
        time.sleep(0.02)
    before = len(list((tmp_path / "out" / "results").glob("*.json")))
    os.killpg(process.pid, signal.SIGINT)
    process.communicate(timeout=HANGS)
    assert process.returncode == 130
    done = rows(tmp_path / "out", "SELECT * FROM scenarios WHERE status = 'ok'")
    assert 3 <= len(done) <= before + 2, "at most those that were under way came to their ends"
    assert sorted(path.name for path in (tmp_path / "out" / "bakes").iterdir()) == sorted(row["id"] for row in done)
    for row in done:
        throng("info", tmp_path / "out" / row["bake"], "--verify")
    throng("batch", plan, "-o", tmp_path / "out", "-q")
    assert len(rows(tmp_path / "out", "SELECT * FROM scenarios WHERE status = 'ok'")) == 10


def test_killed_workers_are_replaced_and_the_batch_ends_complete(throng, tmp_path):
    plan = family(tmp_path, base=LONGER, axes=[{"set": "/simulation/seed", "range": [1, 12]}])
    process = subprocess.Popen([throng.binary, "batch", str(plan), "-o", str(tmp_path / "out"), "--workers", "2", "-q"])
    killed = []
    while len(killed) < 4:
        assert process.poll() is None
        time.sleep(0.4)
        for worker in [worker for worker in processes_of(process.pid) if worker not in killed][:1]:
            os.kill(worker, signal.SIGKILL)
            killed.append(worker)
    assert process.wait(timeout=HANGS) in (0, 1)
    found = rows(tmp_path / "out", "SELECT * FROM scenarios")
    assert all(row["status"] == "ok" or "killed by signal 9" in row["reason"] for row in found)
    # Four kills: whoever was killed twice has failed.
    assert len(found) == 12 and sum(row["status"] == "ok" for row in found) >= 10
    done = {row["id"] for row in found if row["status"] == "ok"}
    baked = {path.name for path in (tmp_path / "out" / "bakes").iterdir() if not path.name.endswith(".unfinished")}
    assert done <= baked <= {row["id"] for row in found}
    for name in baked - done:  # killed between the bake and its result: the next run has only to measure it
        throng("info", tmp_path / "out" / "bakes" / name, "--verify")
    throng("batch", plan, "-o", tmp_path / "out", "-q")
    assert {row["status"] for row in rows(tmp_path / "out")} == {"ok"}


def test_sigkill_of_the_whole_batch_loses_only_what_was_under_way(throng, tmp_path):
    plan = family(tmp_path, base=LONGER, axes=[{"set": "/simulation/seed", "range": [1, 8]}])
    process = subprocess.Popen([throng.binary, "batch", str(plan), "-o", str(tmp_path / "out"), "--workers", "2", "-q"])
    while len(list((tmp_path / "out" / "results").glob("*.json"))) < 4:
        assert process.poll() is None
        time.sleep(0.02)
    process.kill()
    process.wait()
    time.sleep(1)  # its workers hear of it and end
    done = len(list((tmp_path / "out" / "results").glob("*.json")))
    told = throng("batch", plan, "-o", tmp_path / "out").stdout
    assert f"{done} are done" in told
    assert len(rows(tmp_path / "out", "SELECT * FROM scenarios WHERE status = 'ok'")) == 8


def test_parts_of_a_batch_make_the_whole(throng, tmp_path):
    plan = family(tmp_path)
    for part in range(3):
        throng("batch", plan, "-o", tmp_path / "out", "--shard", f"{part}/3", "-q")
        assert len(list((tmp_path / "out" / "results").iterdir())) == 2 * (part + 1)
    throng("batch", plan, "-o", tmp_path / "out", "--collect", "-q")
    assert len(rows(tmp_path / "out", "SELECT * FROM scenarios WHERE status = 'ok'")) == 6
    assert "I/N" in throng("batch", plan, "-o", tmp_path / "out", "--shard", "3/3", expect=2).stderr


def test_nothing_is_begun_that_would_not_end_in_time(throng, tmp_path):
    axis = lambda count: [{"set": "/simulation/seed", "range": [1, count]}]
    started = time.monotonic()
    throng("batch", family(tmp_path, base=LONGER, axes=axis(1)), "-o", tmp_path / "one", "-q")
    one = time.monotonic() - started
    limit = max(6.0, 4.0 * one)  # some, on busy machines too
    started = time.monotonic()
    throng("batch", family(tmp_path, base=LONGER, axes=axis(200)), "-o", tmp_path / "out", "-q", "--time-limit",
           f"{limit / 60.0:.4f}", expect=85)
    took = time.monotonic() - started
    done = rows(tmp_path / "out", "SELECT * FROM scenarios WHERE status = 'ok'")
    assert 0 < len(done) < 200
    assert took < limit + 2.0 * one + 6.0, "what was begun, and the start"


def test_a_folder_of_something_else_is_left_alone(throng, tmp_path):
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / "letter.txt").write_text("dear")
    assert "is no batch" in throng("batch", family(tmp_path), "-o", tmp_path / "out", expect=5).stderr
    assert [path.name for path in (tmp_path / "out").iterdir()] == ["letter.txt"]


def test_bakes_need_not_be_kept(throng, tmp_path):
    throng("batch", family(tmp_path, bake={"keep": False}), "-o", tmp_path / "out", "-q")
    assert list((tmp_path / "out" / "bakes").iterdir()) == []
    assert all(row["status"] == "ok" and row["bake"] is None and row["agents"] > 0 for row in rows(tmp_path / "out"))
    assert "6 are done" in throng("batch", family(tmp_path, bake={"keep": False}), "-o", tmp_path / "out").stdout


def test_a_batch_bakes_the_same_bytes_as_a_bake(throng, tmp_path):
    throng("batch", family(tmp_path), "-o", tmp_path / "out", "-q")
    row = rows(tmp_path / "out")[3]
    layout = tmp_path / "out" / row["bake"] / "layout.json"
    throng("bake", layout, "-o", tmp_path / "single", "-q", "--no-gltf")
    for stream in ("pos", "dir", "state"):
        assert (tmp_path / "single" / "streams" / f"{stream}.npy").read_bytes() == \
            (tmp_path / "out" / row["bake"] / "streams" / f"{stream}.npy").read_bytes()


# ---- asking

def test_the_database_says_what_measure_says(throng, tmp_path):
    throng("batch", family(tmp_path), "-o", tmp_path / "out", "-q")
    for row in rows(tmp_path / "out"):
        measured = json.loads(throng("measure", tmp_path / "out" / row["bake"], "--json").stdout)
        for column in ("agents", "arrived", "stuck", "mean_speed", "deepest_overlap_percent", "lane_order"):
            assert row[column] == pytest.approx(measured[column]), column
        assert row["heading_rate_p99"] == measured["heading_rate"]["p99"]
        assert row["total_seconds"] > row["simulate_seconds"] > 0 and row["version"] and row["device"]


def test_queries_as_table_csv_and_json(throng, tmp_path):
    throng("batch", family(tmp_path), "-o", tmp_path / "out", "-q")
    ask = lambda *words, **options: throng("batch", "query", tmp_path / "out", *words, **options).stdout
    assert ask("--where", "rate > 1", "--limit", "3").count("\n") == 4
    assert [row["rate"] for row in json.loads(ask("--sort", "rate", "--descending", "--json"))][:2] == [4, 4]
    ask("--columns", "*", "-o", tmp_path / "all.csv")
    with open(tmp_path / "all.csv", newline="") as file:
        table = list(csv.DictReader(file))
    assert [int(row["rate"]) for row in table] == [1, 1, 2, 2, 4, 4] and table[0]["device"]
    assert ask("--sql", "SELECT avg(arrived) AS mean FROM scenarios", "--csv").startswith("mean\n")
    mistake = lambda *words: throng("batch", "query", tmp_path / "out", *words, expect=2).stderr
    assert "there is no column `rats`" in mistake("--where", "rats > 1")
    assert "did you mean `arrived`?" in mistake("--where", "arived > 1") and "--where" in mistake("--where", "arived > 1")
    assert "ends where something is missing" in mistake("--where", "arrived >")
    assert "--sort" in mistake("--sort", "nothing") and "--columns" in mistake("--columns", "id, nothing")
    throng("batch", "query", tmp_path / "out", "--sql", "DROP TABLE scenarios", expect=3)
    assert len(rows(tmp_path / "out")) == 6


def test_a_parameter_of_the_name_of_a_figure_stays_apart_from_it(throng, tmp_path):
    plan = family(tmp_path, axes=[{"name": "agents", "set": "/flows/0/rate", "values": [1, 2]}])
    throng("batch", plan, "-o", tmp_path / "out", "-q")
    assert [row["parameter agents"] for row in rows(tmp_path / "out")] == [1, 2]


def test_parquet_and_arrow_hold_the_same_table(throng, tmp_path):
    pyarrow = pytest.importorskip("pyarrow", reason="pyarrow is not installed")
    import pyarrow.feather
    import pyarrow.parquet
    throng("batch", family(tmp_path), "-o", tmp_path / "out", "-q")
    for name in ("all.parquet", "all.arrow"):
        subprocess.run([sys.executable, ROOT / "scripts" / "export_batch.py", tmp_path / "out", tmp_path / name],
                       check=True)
    expected = rows(tmp_path / "out")
    for table in (pyarrow.parquet.read_table(tmp_path / "all.parquet"),
                  pyarrow.feather.read_table(tmp_path / "all.arrow")):
        assert table.to_pylist() == expected


# ---- other farms

def test_open_job_descriptions_are_valid(throng, tmp_path):
    model = pytest.importorskip("openjd.model", reason="openjd-model is not installed")
    text = throng("batch", family(tmp_path), "-o", tmp_path / "out", "--emit", "openjd", "--tasks", "4").stdout
    template = model.decode_job_template(template=json.loads(text))
    job = model.create_job(job_template=template, job_parameter_values={
        "Throng": model.ParameterValue(type=model.ParameterValueType.STRING, value=throng.binary),
        "Family": model.ParameterValue(type=model.ParameterValueType.STRING, value=str(tmp_path / "family.json")),
        "Output": model.ParameterValue(type=model.ParameterValueType.STRING, value=str(tmp_path / "out"))})
    assert [step.name for step in job.steps] == ["Bake", "Gather"]
    assert len(list(model.StepParameterSpaceIterator(space=job.steps[0].parameterSpace))) == 4


def test_flamenco_job_types_compile(throng, tmp_path):
    script = throng("batch", family(tmp_path), "-o", tmp_path / "out", "--emit", "flamenco", "--tasks", "3").stdout
    harness = """
    const author = {Task: (name, type) => ({name, type, commands: [], dependencies: [],
                        addCommand(c) { this.commands.push(c); },
                        addDependency(t) { this.dependencies.push(t.name); }}),
                    Command: (name, parameters) => ({name, parameters})};
    """ + script + """
    const settings = Object.fromEntries(JOB_TYPE.settings.map(s => [s.key, s.default]));
    const tasks = [];
    compileJob({settings, addTask(t) { tasks.push(t); }});
    console.log(JSON.stringify(tasks));
    """
    (tmp_path / "job.js").write_text(harness)
    subprocess.run(["node", "--check", tmp_path / "job.js"], check=True)
    tasks = json.loads(subprocess.run(["node", tmp_path / "job.js"], check=True, capture_output=True, text=True).stdout)
    assert [task["name"] for task in tasks] == ["bake-0", "bake-1", "bake-2", "gather"]
    assert tasks[3]["dependencies"] == ["bake-0", "bake-1", "bake-2"]
    # What the tasks say can be run as it is.
    for task in tasks:
        throng(*task["commands"][0]["parameters"]["args"])
    assert len(rows(tmp_path / "out", "SELECT * FROM scenarios WHERE status = 'ok'")) == 6
