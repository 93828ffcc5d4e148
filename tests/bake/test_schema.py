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


def numbers(schema):
    """Every number with limits: where it goes in BASE, and its schema."""
    places = {"simulation": ("simulation",), "road": ("roads", 0), "wall": ("walls", 0), "flow": ("flows", 0),
              "people": ("flows", 0, "people")}
    for definition, place in places.items():
        source = schema["properties"]["simulation"] if definition == "simulation" else schema["definitions"][definition]
        for name, rule in source["properties"].items():
            if rule.get("type") in ("number", "integer") and name not in ("count", "rate"):
                yield place + (name,), rule


@pytest.mark.quick
def test_the_readers_limits_are_the_schemas(schema, throng, tmp_path):
    cases = []
    for place, rule in numbers(schema):
        step = 1 if rule["type"] == "integer" else 1e-3
        least, most = rule.get("minimum", rule.get("exclusiveMinimum")), rule.get("maximum")
        for value in (least, least - step, most, most + max(step, most * 1e-3 if most else 0)):
            layout = copy.deepcopy(BASE)
            node = layout
            for key in place[:-1]:
                node = node[key]
            node[place[-1]] = int(value) if rule["type"] == "integer" else value
            path = tmp_path / f"{len(cases)}.json"
            path.write_text(json.dumps(layout))
            cases.append((path, "/" + "/".join(map(str, place)), value,
                          jsonschema.Draft7Validator(schema).is_valid(layout)))
    assert len(cases) > 60
    answers = json.loads(throng("check", *[path for path, *_ in cases], "--json", expect=None).stdout)
    for (path, pointer, value, accepted), answer in zip(cases, answers, strict=True):
        assert answer["file"] == str(path)
        complaint = [entry for entry in answer["diagnostics"] if entry["pointer"] == pointer
                     and "range" in entry["message"]]
        assert bool(complaint) == (not accepted), \
            f"{pointer} = {value}: schema {'accepts' if accepted else 'refuses'}, reader says {complaint}"


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


def test_the_reference_page_is_the_schemas():
    import subprocess
    import sys

    from conftest import ROOT

    subprocess.run([sys.executable, str(ROOT / "scripts" / "layout_reference.py"), "--check"], check=True)
