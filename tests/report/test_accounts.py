# SPDX-License-Identifier: Apache-2.0
"""Whoever tells what became of people tells the same: account, table, measure, `expect`, database, pages, add-on."""
import collections
import csv
import json
import re

import pytest

from conftest import ROOT
from test_report import visit  # noqa: F401

AGENTS, WALKING, ARRIVED, STUCK, REFUSED = 19, 7, 8, 1, 4
SPAWNED = WALKING + ARRIVED


def square(x, y, size=3):
    return [[x, y], [x + size, y], [x + size, y + size], [x, y + size]]


# Eight arrive; one is shut in before a gate; one stands at a stop and three in a line until the end; one has just set
# off from a stop again; one has far to go; four would enter too late.
LAYOUT = {
    "throng": 1,
    "name": "every fate",
    "simulation": {"duration": 30, "seed": 4},
    "areas": [{"id": "west", "polygon": square(0, 0)}, {"id": "east", "polygon": square(15, 0)},
              {"id": "cell", "polygon": square(0.3, 20.3, 0.4)}, {"id": "beyond", "polygon": square(8, 20, 2)},
              {"id": "corner", "polygon": square(0, 40)}, {"id": "board", "polygon": square(6, 40)},
              {"id": "door", "polygon": square(0, 60)}, {"id": "desk", "polygon": square(10, 60)},
              {"id": "home", "polygon": square(30, 60)},
              {"id": "start", "polygon": square(0, 80)}, {"id": "far", "polygon": square(200, 80)},
              {"id": "seat", "polygon": square(0, 100, 1)}, {"id": "bench", "polygon": square(2, 100, 1)}],
    "walls": [{"id": "pen", "points": [[1, 20], [0, 20], [0, 21], [1, 21]]},
              {"id": "gate", "points": [[1, 20], [1, 21]]}],
    "flows": [{"id": "forth", "from": "west", "to": "east", "count": 8, "end": 5},
              {"id": "shut in", "from": "cell", "to": "beyond", "count": 1, "end": 1},
              {"id": "onlooker", "from": "corner", "to": "home", "count": 1, "end": 1,
               "via": [{"at": "board", "wait": 1000, "activity": "look", "facing": [7, 50]}]},
              {"id": "customers", "from": "door", "to": "home", "count": 3, "end": 3,
               "via": [{"at": "desk", "wait": 1000, "activity": "queue",
                        "line": [[12.5, 62], [12.5, 60.5], [10.5, 60.5]]}]},
              {"id": "stroller", "from": "seat", "to": "far", "count": 1, "end": 0.1, "people": {"speed": 0.3},
               "via": [{"at": "bench", "wait": 22.8}]},
              {"id": "pilgrim", "from": "start", "to": "far", "count": 1, "end": 1},
              {"id": "late", "from": "west", "to": "east", "count": 4, "start": 100, "end": 110}],
    "events": [{"at": 3600, "open": "gate"}],
    "expect": {name: {"min": (count - 0.01) / AGENTS, "max": (count + 0.01) / AGENTS}
               for name, count in (("arrived", ARRIVED), ("stuck", STUCK), ("refused", REFUSED))},
}


@pytest.fixture(scope="module")
def batch(throng, once):
    def make(folder):
        (folder / "layout.json").write_text(json.dumps(LAYOUT))
        (folder / "family.json").write_text(json.dumps({
            "throng_family": 1, "name": "fates", "base": "layout.json",
            "axes": [{"name": "seed", "set": "/simulation/seed", "values": [4]}]}))
        throng("batch", folder / "family.json", "-o", folder / "batch", "-q")
        row, = json.loads(throng("batch", "query", folder / "batch", "--columns", "*", "--json").stdout)
        throng("report", folder / "batch" / row["bake"], "-o", folder / "bake.html")
        throng("report", folder / "batch", "-o", folder / "batch.html")

    return once("accounts", make)


def test_every_teller_of_what_became_of_people_tells_the_same(throng, visit, batch, manifest_of):  # noqa: F811
    row, = json.loads(throng("batch", "query", batch / "batch", "--columns", "*", "--json").stdout)
    fates = {"agents": AGENTS, "walking": WALKING, "arrived": ARRIVED, "refused": REFUSED}
    bake = batch / "batch" / row["bake"]
    account = manifest_of(bake)["account"]
    assert {**fates, "spawned": SPAWNED}.items() <= account.items()
    assert sum(account["refused_reasons"].values()) == REFUSED
    with open(bake / "agents.csv", newline="") as file:
        told = collections.Counter(person["outcome"] for person in csv.DictReader(file))
    assert told == {"walking": WALKING, "arrived": ARRIVED, "refused": REFUSED}
    measured = json.loads(throng("measure", bake, "--json").stdout)
    assert {**fates, "stuck": STUCK}.items() <= measured.items()
    assert measured["missed"] == [], "what the layout expects is counted in the same way"
    assert {**fates, "stuck": STUCK}.items() <= row.items()

    page = visit(batch / "bake.html")
    figures = re.sub(r"\s+", " ", page.inner_text("#account"))
    for words in (f"people {AGENTS}", f"arrived {ARRIVED}", f"still walking {WALKING}", f"stuck {STUCK}",
                  f"refused {REFUSED}"):
        name, number = words.rsplit(" ", 1)
        assert re.search(rf"{name} {number}\b|\b{number} {name}", figures), (words, figures)
    assert "with stuck people" in visit(batch / "batch.html").inner_text("body")

    add_on = {}
    exec((ROOT / "blender_addon" / "throng" / "formats" / "outcomes.py").read_text(), add_on)
    assert add_on["account_text"](account) == \
        f"{AGENTS} people: {ARRIVED} arrived, {WALKING} walking, {REFUSED} refused"
