# SPDX-License-Identifier: Apache-2.0
"""Families, batches and databases from anybody: nothing outside a batch is written or removed, and questions end."""
import json
import os
import shutil
import sqlite3

import pytest

from test_batch import BASE, family, rows

QUICK = {**BASE, "simulation": {"duration": 0.05}}


def everything(folder):
    return sorted(str(path.relative_to(folder)) for path in folder.rglob("*"))


@pytest.fixture(scope="module")
def batch(throng, once):
    def make(folder):
        throng("batch", family(folder, base=QUICK), "-o", folder / "out", "-q")

    return once("untrusted-batch", make) / "out"


@pytest.fixture
def own(batch, tmp_path):
    shutil.copytree(batch, tmp_path / "out")
    return tmp_path / "out"


# ---- what is removed and written

def test_prune_removes_results_of_scenarios_and_nothing_else(throng, own, tmp_path):
    names = ["..json", "...json", "....json", "notes.json", "0123456789abcdeg.json", ".json"]
    for name in names:
        (own / "results" / name).write_text("{}")
    (own / "results" / "0123456789abcdef.json").write_text("{}")
    (own / "bakes" / "0123456789abcdef").mkdir()
    before = everything(own)
    told = throng("batch", family(tmp_path, base=QUICK), "-o", own, "--prune").stdout
    assert "removed 1 result" in told
    assert set(before) - set(everything(own)) == {"results/0123456789abcdef.json", "bakes/0123456789abcdef"}


@pytest.mark.parametrize("name", [".", "..", "../x", "/tmp/throng-escaped", "a/b", "a\x1b[31mb", "a\nb", "\x9b"])
def test_a_name_from_a_file_never_leads_out_of_the_folder(throng, tmp_path, name):
    home = tmp_path / "home"
    home.mkdir()
    family(home, name=name, base=QUICK)
    (home / "layout.json").write_text(json.dumps({**QUICK, "name": name}))
    before = everything(tmp_path)
    for command in ("batch", "family.json"), ("bake", "layout.json"):
        said = throng(*command, "-q", cwd=home, expect=3).stderr
        assert "no name for a folder" in said and "\x1b" not in said and "\x9b" not in said
    assert everything(tmp_path) == before and not os.path.exists("/tmp/throng-escaped")


def test_a_base_that_never_ends_is_not_read(throng, tmp_path):
    said = throng("batch", family(tmp_path, base="/dev/zero"), "-o", tmp_path / "out", expect=3).stderr
    assert "not a regular file" in said and "family.json:" in said


def change(batch, *statements):
    with sqlite3.connect(batch / "results.sqlite") as database:
        for statement in statements:
            database.execute(statement)
    database.close()


@pytest.mark.parametrize("identity", ["../escaped", "/tmp/throng-escaped", "", "..", "0123456789abcdeF"])
def test_reports_are_only_made_for_scenarios(throng, own, tmp_path, identity):
    change(own, f"UPDATE scenarios SET id = '{identity}' WHERE number = 1",
           f"UPDATE parameters SET id = '{identity}' WHERE rate = 1 AND seed = 1")
    before = everything(tmp_path)
    assert "`id`" in throng("report", own, "--each", expect=3).stderr
    assert [path for path in everything(tmp_path) if path not in before] in ([], ["out/reports"])
    assert not os.path.exists("/tmp/throng-escaped.html")


@pytest.mark.parametrize("statements, said", [
    (["ALTER TABLE scenarios DROP COLUMN bake"], "no column `bake`"),
    (["DROP VIEW results", "CREATE VIEW results AS SELECT id, number, bake FROM scenarios"], "fewer columns"),
    (["DROP TABLE batch"], "no such table"),
])
def test_databases_of_another_form_are_told(throng, own, statements, said):
    if "DROP COLUMN" in statements[0]:
        view = rows(own, "SELECT sql FROM sqlite_master WHERE name = 'results'")[0]["sql"]
        statements = ["DROP VIEW results", *statements, view]
    change(own, *statements)
    assert said in throng("report", own, "-o", own / "r.html", expect=3).stderr
    assert not list(own.glob("r.html*"))


# ---- questions

def test_a_query_changes_and_writes_nothing(throng, own, tmp_path):
    copy = tmp_path / "copy.sqlite"
    for sql in (f"VACUUM INTO '{copy}'", f"ATTACH '{copy}' AS other", "DELETE FROM scenarios", "PRAGMA user_version = 3",
                "CREATE TABLE more (id)", "SELECT load_extension('x')"):
        assert throng("batch", "query", own, "--sql", sql, expect=3).stderr
    assert not copy.exists() and len(rows(own)) == 6


@pytest.mark.parametrize("where", ["1=1) UNION SELECT sql, 2, 3 FROM sqlite_master --", "1) OR (1", "1=1 /*", "'", "1; 2"])
def test_a_condition_stays_within_its_brackets(throng, own, where):
    assert "--where" in throng("batch", "query", own, "--columns", "id, 2, 3", "--where", where, expect=2).stderr


def test_a_condition_may_have_brackets_quotes_and_comments_of_its_own(throng, own):
    where = "(rate > 1 AND status <> ')') OR \"rate\" = 1 -- all :)"
    assert throng("batch", "query", own, "--where", where, "--csv").stdout.count("\n") == 7


@pytest.mark.parametrize("sql", [
    "SELECT zeroblob(2000000000)",
    "SELECT hex(zeroblob(9000000)) FROM scenarios a, scenarios b, scenarios c",
    "WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n) SELECT i, printf('%.1000c', 'x') FROM n",
])
def test_answers_have_an_end_in_memory(throng, own, sql, confined):
    assert confined("batch", "query", own, "--sql", sql, megabytes=600, expect=3).stderr


def test_answers_have_an_end_in_time(throng, own, confined):
    endless = "WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n) SELECT max(i) FROM n"
    assert "takes more than" in confined("batch", "query", own, "--sql", endless, seconds=15, expect=3).stderr


def test_an_axis_of_the_name_of_a_figure_can_be_asked_about(throng, tmp_path):
    axes = [{"name": "agents", "set": "/flows/0/rate", "values": [1, 2]},
            {"name": "ID", "set": "/simulation/seed", "values": [3]}]
    throng("batch", family(tmp_path, axes=axes, base=QUICK), "-o", tmp_path / "out", "-q")
    told = throng("batch", "query", tmp_path / "out", "--where", "\"parameter agents\" > 1", "--csv").stdout
    assert told.splitlines()[0].startswith("number,id,status,parameter agents,parameter ID,agents") and told.count("\n") == 2


def test_no_control_characters_of_a_database_reach_the_terminal(throng, own):
    change(own, "UPDATE scenarios SET status = 'a' || char(27) || '[31m' || char(155) || char(10) || 'b'")
    told = throng("batch", "query", own).stdout
    assert "\\x1b[31m" in told and "\x1b" not in told and "\x9b" not in told
