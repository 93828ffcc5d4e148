# SPDX-License-Identifier: Apache-2.0
"""The schema that editors use and the reader that bakes have to agree."""
import copy
import json

import jsonschema
import pytest

from conftest import EXAMPLES

BASE = {"throng": 1, "simulation": {}, "roads": [{"id": "r", "centreline": [[0, 0], [30, 0]], "width": 8}],
        "walls": [{"points": [[5, 20], [9, 20]]}],
        "flows": [{"id": "f", "from": "r:start", "to": "r:end", "count": 3, "people": {}}],
        "formations": [{"id": "c", "type": "circle", "centre": [0, 40], "radius": 6, "count": 3},
                       {"id": "g", "type": "grid", "origin": [0, 60], "rows": 2, "columns": 2,
                        "goal": {"offset": [5, 0]}},
                       {"id": "a", "type": "agents", "agents": [{"position": [0, 80], "goal": [5, 80]}]}]}


@pytest.fixture(scope="module")
def schema(throng):
    return json.loads(throng("schema").stdout)


def test_the_schema_is_a_schema_and_documents_everything(schema):
    jsonschema.Draft7Validator.check_schema(schema)

    def walk(node, path):
        for name, child in node.get("properties", {}).items():
            if "$ref" not in child and "oneOf" not in child and "const" not in child and name not in ("type",):
                assert child.get("description"), f"{path}/{name} has no description"
            walk(child, f"{path}/{name}")

    walk(schema, "")
    for name, definition in schema["definitions"].items():
        walk(definition, name)


@pytest.mark.parametrize("path", sorted(path for path in EXAMPLES.glob("*.json")
                                        if not path.name.startswith("family-")), ids=lambda path: path.stem)
@pytest.mark.quick
def test_the_examples_are_valid(schema, path):
    jsonschema.validate(json.loads(path.read_text()), schema)


@pytest.mark.parametrize("change", [
    lambda layout: layout.update(thronk=1), lambda layout: layout.pop("throng"),
    lambda layout: layout["roads"][0].update(widht=2),
    lambda layout: layout["flows"][0].update(rate=1.0), lambda layout: layout["formations"][0].pop("radius"),
    lambda layout: layout["walls"][0].update(points=[[0, 0]]),
    lambda layout: layout["flows"][0].update(arrival="vanish"),
    lambda layout: layout["simulation"].update(seed=1.5),
    lambda layout: layout["flows"][0]["people"].update(speed={"uniform": [1]}),
    lambda layout: layout.update(events=[{"at": 1}]),
    lambda layout: layout.update(events=[{"at": 1, "open": "a", "close": "a"}]),
    lambda layout: layout["flows"][0]["people"].update(groups=[1, 1, 1, 1, 1]),
    lambda layout: layout["flows"][0].update(to={"choose": {}}),
    lambda layout: layout["flows"][0].update(to={"nearest": []}),
    lambda layout: layout["flows"][0].update(via=[{"at": layout["flows"][0]["to"], "activity": "dance"}]),
    lambda layout: layout["flows"][0].update(via=[{"wait": 3}]),
    lambda layout: layout["flows"][0]["people"].update(reaction={"log_normal": [1]})])
def test_both_refuse_what_is_wrong(schema, throng, tmp_path, change):
    layout = copy.deepcopy(BASE)
    jsonschema.validate(layout, schema)
    change(layout)
    assert list(jsonschema.Draft7Validator(schema).iter_errors(layout))
    path = tmp_path / "layout.json"
    path.write_text(json.dumps(layout))
    throng("check", path, expect=3)
