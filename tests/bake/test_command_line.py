# SPDX-License-Identifier: Apache-2.0
"""What a new user meets: suggestions, endings of names, families, and JSON from every command."""
import json

import pytest

from conftest import EXAMPLES


def write(path, text):
    path.write_text(text if isinstance(text, str) else json.dumps(text))
    return path


def grid(goal):
    return {"throng": 1, "simulation": {"duration": 3},
            "formations": [{"id": "f", "type": "grid", "origin": [0, 0], "rows": 2, "columns": 2, **goal}]}


@pytest.mark.parametrize("goal, meant", [({"gaol": {"offset": [9, 0]}}, "goal"), ({"goal": {"ofset": [9, 0]}}, "offset"),
                                         ({"goal": {"nerest": ["a"]}}, "nearest"), ({"goal": {"chose": {}}}, "choose"),
                                         ({"goal": {"miror": [[0, 0], [0, 1]]}}, "mirror")])
def test_a_misspelt_goal_is_one_mistake_with_what_was_meant(throng, tmp_path, goal, meant):
    told = throng("check", write(tmp_path / "l.json", grid(goal)), "--json", expect=3).stdout
    [entry] = json.loads(told)[0]["diagnostics"]
    assert entry["hint"] == f"did you mean `{meant}`?" and "has no key" in entry["message"]


def test_previews_are_what_their_names_say(throng, bakes, tmp_path):
    for name in ("p.jpg", "p", "p.PNG.txt"):
        told = throng("preview", bakes("circle"), "-o", tmp_path / name, expect=2)
        assert ".png" in told.stderr and ".mp4" in told.stderr and not (tmp_path / name).exists()
    throng("preview", bakes("circle"), "--mp4", "-o", tmp_path / "p.png", expect=2)


def test_families_are_checked(throng, tmp_path):
    [told] = json.loads(throng("check", EXAMPLES / "family-crossing.json", "--json").stdout)
    assert told["valid"] and (told["scenarios"], told["layouts_read"], told["scenes_built"]) == (27, 27, 4)
    assert "27 scenarios" in throng("check", EXAMPLES / "family-crossing.json").stdout
    write(tmp_path / "base.json", grid({"goal": {"offset": [9, 0]}}))
    family = {"throng_family": 1, "base": "base.json", "axes": [{"set": "/formations/0/rows", "values": [2, -1]}]}
    told = throng("check", write(tmp_path / "family.json", family), "--json", expect=3).stdout
    assert not json.loads(told)[0]["valid"] and "scenario 2" in json.loads(told)[0]["diagnostics"][0]["message"]


def test_a_range_of_very_many_values_says_so(throng, tmp_path):
    family = {"throng_family": 1, "base": grid({"goal": {"offset": [9, 0]}}),
              "axes": [{"set": "/simulation/seed", "range": [1, 100000000]}]}
    told = throng("batch", write(tmp_path / "family.json", family), "--dry-run", expect=3).stderr
    assert "100000000 values" in told and "at most" in told


def test_every_command_answers_errors_with_json(throng, tmp_path):
    absent = tmp_path / "absent"
    for words in (["check", absent], ["bake", absent], ["info", absent], ["measure", absent], ["preview", absent],
                  ["report", absent], ["apply", absent, "--dry-run"], ["batch", absent], ["batch", "query", absent],
                  ["generate", "nothing"], ["scenarios", "--run", "nothing"], ["schema", "--wrong"], ["nothing"],
                  ["devices", "--wrong"], ["calibrate", "--wrong"], ["bench", "diagrams", "--wrong"]):
        told = throng(*words, "--json", expect=None)
        error = json.loads(told.stdout)["error"]
        assert error["code"] == told.returncode != 0 and error["message"], words
        assert isinstance(error["hint"], str) and isinstance(error["diagnostics"], list)
    wrong = write(tmp_path / "wrong.json", grid({"gaol": 1}))
    error = json.loads(throng("bake", wrong, "--json", expect=3).stdout)["error"]
    assert error["diagnostics"][0].keys() == {"severity", "file", "line", "column", "pointer", "message", "hint"}


def test_what_is_no_error_is_json_too(throng, bakes, tmp_path):
    for words in (["preview", bakes("circle"), "-o", tmp_path / "p.png", "--width", "300"],
                  ["report", bakes("circle"), "-o", tmp_path / "r.html"], ["generate", "--list"], ["schema"],
                  ["generate", "crossing", "-o", tmp_path / "c.json"], ["generate", "crossing"],
                  ["scenarios", "--list"], ["info", bakes("circle")]):
        assert json.loads(throng(*words, "--json").stdout), words


def test_what_a_bake_takes_on_the_disk_is_known_before(throng, bakes, tmp_path):
    [told] = json.loads(throng("check", bakes("circle") / "layout.json", "--json").stdout)
    streams = list((bakes("circle") / "streams").iterdir())
    assert 1 << 16 < told["device_bytes"] < 1 << 30
    assert told["stream_bytes"] == sum(file.stat().st_size for file in streams) > 0
    assert "its streams will take" in throng("check", bakes("circle") / "layout.json").stdout


def test_a_bake_that_the_disk_cannot_hold_does_not_begin(throng, tmp_path):
    layout = write(tmp_path / "l.json", {
        "throng": 1, "simulation": {"duration": 86400, "fps": 60},
        "formations": [{"id": "f", "type": "grid", "origin": [0, 0], "rows": 200, "columns": 200,
                        "goal": {"offset": [9, 0]}}]})
    told = throng("bake", layout, "-o", tmp_path / "bake", expect=5).stderr
    assert "the disk has room for" in told and "--streams packed" in told
    assert sorted(path.name for path in tmp_path.iterdir()) == ["l.json"]
