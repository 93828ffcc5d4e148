# SPDX-License-Identifier: Apache-2.0
"""Names from layouts and families do nothing where they end up: pages, tables, databases, terminals, job scripts."""
import csv
import json
import sqlite3
import subprocess

import pytest

NAMES = ["=HYPERLINK(\"http://x\")", "+1+cmd", "-2+3", "@SUM(A1)", "'=A1", "</script><script>alert(1)</script>",
         "x\"); DROP TABLE scenarios; --", "\x1b[31mred", "a,b\n=c", "{{Param.Output}} $(touch p) `touch p`"]
HOSTILE = "x'\ntouch injected\n#SBATCH --uid=0 {{Param.Output}} $(touch injected) </script>\u2028"


def layout(ids):
    return {"throng": 1, "name": "hostile", "simulation": {"duration": 0.5},
            "formations": [{"id": name, "type": "grid", "origin": [3 * i, 0], "rows": 1, "columns": 1,
                            "goal": {"offset": [0, 20]}} for i, name in enumerate(ids)]}


@pytest.fixture
def bake(throng, tmp_path):
    (tmp_path / "layout.json").write_text(json.dumps(layout(NAMES)))
    throng("bake", tmp_path / "layout.json", "-o", tmp_path / "bake", "-q", "--no-gltf")
    return tmp_path / "bake"


def test_tables_hold_no_formulas_and_give_the_names_back(throng, bake):
    with open(bake / "agents.csv", newline="") as file:
        groups = [line["group"] for line in csv.DictReader(file)]
    assert len(groups) == len(NAMES)
    for name, written in zip(NAMES, groups):
        assert written[0] not in "=+-@\t\r"
        assert written == ("'" + name if name.lstrip("'")[0] in "=+-@" else name)
    # Read back, they are what they were.
    (bake.parent / "o.json").write_text(json.dumps({"throng_overrides": 1, "overrides": []}))
    throng("measure", bake)
    throng("report", bake, "-o", bake.parent / "r.html")
    data = (bake.parent / "r.html").read_text().split('id="data">')[1].split("</script>")[0]
    assert json.loads(data)["groups"] == NAMES


def test_pages_run_nothing_but_their_own_scripts(throng, bake):
    throng("report", bake, "-o", bake.parent / "r.html")
    page = (bake.parent / "r.html").read_text()
    assert "alert(1)</script>" not in page
    policy = page.split('http-equiv="Content-Security-Policy" content="')[1].split('"')[0]
    parts = page.count("<script>") + page.count("<style>")
    assert "default-src 'none'" in policy and policy.count("'sha256-") == parts == 7
    assert "unsafe-inline" not in policy.split("script-src")[1].split(";")[0] and "unsafe-eval" not in policy


def test_terminals_see_no_control_characters(throng, bake):
    for command in ["info"], ["measure"], ["info", "--verify"]:
        told = throng(*command, bake)
        assert "\x1b" not in told.stdout + told.stderr


@pytest.fixture
def family(tmp_path):
    base = {"throng": 1, "simulation": {"duration": 0.5}, "areas": [
        {"id": "a", "polygon": [[0, 0], [4, 0], [4, 4], [0, 4]]}, {"id": "b", "polygon": [[9, 0], [12, 0], [12, 4], [9, 4]]}],
        "flows": [{"id": "f", "from": "a", "to": "b", "count": 2}]}
    path = tmp_path / "family.json"
    path.write_text(json.dumps({"throng_family": 1, "name": HOSTILE, "base": base, "axes": [
        {"name": "x\"); DROP TABLE scenarios; --", "set": "/simulation/seed", "values": [1]},
        {"name": "=cmd", "set": "/name", "values": ["=1+1", "</script><script>alert(1)</script>"]}]}))
    return path


def test_databases_and_their_tables_hold_names_as_they_are(throng, family, tmp_path):
    throng("batch", family, "-o", tmp_path / "out", "-q", "--workers", "1")
    with sqlite3.connect(tmp_path / "out" / "results.sqlite") as database:
        assert database.execute("SELECT count(*) FROM scenarios").fetchone() == (2,)
    told = throng("batch", "query", tmp_path / "out", "--columns", "\"=cmd\"", "--csv").stdout
    assert told.splitlines() == ["'=cmd", "'=1+1", "</script><script>alert(1)</script>"]
    throng("report", tmp_path / "out")
    assert "alert(1)</script>" not in (tmp_path / "out" / "report.html").read_text()


def test_names_of_families_are_no_folders_and_no_lines_of_job_scripts(throng, family, tmp_path):
    assert "no name for a folder" in throng("batch", family, "--dry-run", expect=3, cwd=tmp_path).stderr
    for manager in "openjd", "flamenco":
        job = throng("batch", family, "-o", tmp_path / "out", "--emit", manager).stdout
        for piece in "touch injected\n", "{{Param.Output}} $", "$(touch", "\u2028", "#SBATCH":
            assert piece not in job, manager
    assert not (tmp_path / "injected").exists()


def test_slurm_scripts_run_nothing_of_a_name(throng, family, tmp_path):
    tools = tmp_path / "tools"
    tools.mkdir()
    for name, text in ("sbatch", "echo 7"), ("squeue", "true"), ("scancel", "true"):
        (tools / name).write_text(f"#!/bin/sh\n{text}\n")
        (tools / name).chmod(0o755)
    throng("batch", family, "-o", tmp_path / "out", "--executor", "slurm", "--no-wait", "-q", expect=None,
           env={"PATH": f"{tools}:/usr/bin:/bin"}, cwd=tmp_path)
    script = (tmp_path / "out" / "slurm" / "job.sh").read_text()
    lines = script.splitlines()
    assert [line for line in lines if not line.startswith("#")] == [lines[-1]] and lines[-1].startswith("exec ")
    assert sum(line.startswith("#SBATCH --job-name=") for line in lines) == 1 and "--uid" not in "".join(
        line for line in lines if not line.startswith("#SBATCH --job-name="))
    subprocess.run(["sh", "-n", tmp_path / "out" / "slurm" / "job.sh"], check=True)
