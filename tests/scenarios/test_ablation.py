# SPDX-License-Identifier: Apache-2.0
"""Every rule of motion can be switched off, and does something."""
import importlib.util
import json
import os
import pathlib
import subprocess
import sys

import pytest
from test_belts import hall, up

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "scripts" / "ablate.py"
FIGURES = ("arrived", "seconds", "deepest_overlap_percent", "acceleration_p99", "backward_percent", "way")
# Where rules are looked at, one place after the other until each has been seen at work, and for how many seconds. The
# first shows all but a dozen.
PLACES = {"trap-narrow-door": 6, "trap-head-on": 10, "imo-4": 25, "company": 20, "bidirectional": 8, "hill": 10,
          "station": 40}


def ablate_module():
    spec = importlib.util.spec_from_file_location("ablate", SCRIPT)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def ablate(folder, *words):
    return subprocess.run([sys.executable, SCRIPT, os.environ["THRONG_BINARY"], "-o", folder, *words], check=True,
                          capture_output=True, text=True)


def seen_at_work(folder, scenario, seconds, names):
    """Those whose switch changes any figure there."""
    ablate(folder, "--scenario", scenario, "--set", f"simulation.duration={seconds}", "--only", "all", *names)
    rows = [json.loads(line) for line in (folder / "results.jsonl").read_text().splitlines()]
    assert sorted(row["name"] for row in rows) == sorted(["all", *names])
    figures = {row["name"]: [row[figure] for figure in FIGURES] for row in rows}
    return {name for name in names if figures[name] != figures["all"]}


def door_for_bodies(folder):
    """A door of half a metre before people who are no discs."""
    layout = json.loads((SCRIPT.parents[1] / "scenarios" / "trap-narrow-door.json").read_text())
    people = layout["formations"][0]["people"]
    del people["radius"], layout["$schema"]
    (folder / "bodies.json").write_text(json.dumps(layout))
    return str(folder / "bodies.json")


def escalator(folder):
    """Twelve people who ride, most of them at rest."""
    layout = hall([{"id": "escalator", "type": "escalator", "from": "ground", "to": "upper", "path": [[-9, 0], [-2, 0]],
                    "walking": 0.2}], up(12, 10), duration=30)
    (folder / "escalator.json").write_text(json.dumps(layout))
    return str(folder / "escalator.json")


def stairs(folder):
    """Sixty people who want to go up at once."""
    layout = hall([{"id": "link", "type": "stairs", "from": "ground", "to": "upper", "path": [[-9, 0], [-2, 0]],
                    "width": 1.5}], up(60, 10), duration=30)
    (folder / "stairs.json").write_text(json.dumps(layout))
    return str(folder / "stairs.json")


@pytest.mark.slow
def test_every_switch_of_a_rule_changes_what_people_do_somewhere(tmp_path):
    module = ablate_module()
    left = set(module.variants()) - {"all"}
    others = {door_for_bodies(tmp_path): 10, escalator(tmp_path): 30, stairs(tmp_path): 30}
    for scenario, seconds in {**PLACES, **others}.items():
        names = sorted(left & set(module.chosen(module.layout_of(scenario), [])))
        if names:
            left -= seen_at_work(tmp_path / f"at {pathlib.Path(scenario).stem}", scenario, seconds, names)
    assert left == set()


@pytest.mark.parametrize("people, looked_at", [({}, True), ({"body": "adult"}, True), ({"body": "disc"}, False),
                                               ({"radius": 0.3}, False)])
def test_rules_of_bodies_are_looked_at_where_there_are_any(tmp_path, people, looked_at):
    module = ablate_module()
    file = tmp_path / "layout.json"
    file.write_text(json.dumps({"flows": [{"people": {"radius": 0.2}}, {"people": people}]}))
    assert module.FOR_BODIES & set(module.chosen(file, [])) == (module.FOR_BODIES if looked_at else set())


def test_nothing_is_measured_twice(tmp_path):
    words = ["--scenario", "trap-head-on", "--seed", "1", "2", "--set", "simulation.duration=5", "--only", "all",
             "cushion"]
    first = ablate(tmp_path, *words)
    assert first.stderr.count("...") == 4
    again = ablate(tmp_path, *words)
    assert again.stdout == first.stdout == (tmp_path / "tables.md").read_text()
    assert not again.stderr


def test_tables_have_rules_downwards_and_scenarios_across_and_name_what_changes_nothing():
    module = ablate_module()

    def row(scenario, variant, **known):
        usual = {"agents": 100, "arrived": 100, "seconds": 80.6, "deepest_overlap_percent": 0.5,
                 "overlapping_percent": 0.0, "acceleration_p99": 2.5, "backward_percent": 0.88}
        return {"scenario": scenario, "seed": "own", "variant": variant, **usual, **known}

    told = module.tables([
        row("door", "all rules"),
        row("door", "without: Patience", arrived=94),
        row("door", "without: Nothing"),
        row("stream", "all rules", overlapping_percent=0.1481, deepest_overlap_percent=6.44),
        row("stream", "without: Patience", backward_percent=0.123),
        row("stream", "without: Nothing", overlapping_percent=0.1481, deepest_overlap_percent=6.44),
        row("stream", "without: Headway", seconds=49)])
    tables = [part.splitlines() for part in told.split("\n\n")]
    assert tables[1] == ["|  | door | stream |", "| --- | --- | --- |", "| all rules | 81 s | 81 s |",
                         "| without: Patience | 94 of 100 | 81 s |", "| without: Headway |  | 49 s |"]
    assert tables[3][2:4] == ["| all rules | 0.88 | 0.88 |", "| without: Patience | 0.88 | 0.12 |"]
    assert tables[5][2] == "| all rules | 0.5 | 6.4 (0.148) |"
    assert tables[7][2] == "| all rules | 2.5 | 2.5 |"
    assert told.endswith("The same figures as with all rules: without: Nothing.")


def test_tables_of_several_seeds_have_a_column_for_each():
    module = ablate_module()
    rows = [{"scenario": "door", "seed": seed, "variant": "all rules", "agents": 1, "arrived": 1, "seconds": seed,
             "deepest_overlap_percent": 0, "overlapping_percent": 0, "acceleration_p99": 0, "backward_percent": 0}
            for seed in (3, 5)]
    assert "|  | door, seed 3 | door, seed 5 |\n| --- | --- | --- |\n| all rules | 3 s | 5 s |" in module.tables(rows)
