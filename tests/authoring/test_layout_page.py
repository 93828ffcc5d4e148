# SPDX-License-Identifier: Apache-2.0
"""docs/layout.md says all that the schema says, and its examples are layouts."""
import importlib.machinery
import importlib.util
import json
import re

import jsonschema
import pytest

from conftest import ROOT

SCHEMA = json.loads((ROOT / "authoring" / "layout" / "throng-layout.schema.json").read_text("utf-8"))
PAGE = (ROOT / "docs" / "layout.md").read_text("utf-8")
EXAMPLES = sorted((ROOT / "docs" / "examples").glob("*.json"))
MOST_BYTES = 60_000

pytestmark = pytest.mark.quick


def script(name):
    """A script of ours as a module."""
    loader = importlib.machinery.SourceFileLoader(name, str(ROOT / "scripts" / name))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader(name, loader))
    loader.exec_module(module)
    return module


def tables_of(page):
    """The keys in each table's first column."""
    tables = re.findall(r"(?:^\|.*\n)+", page, re.MULTILINE)
    return [set(re.findall(r"^\| \[?`([^`]+)`", table, re.MULTILINE)) for table in tables]


def objects_of(node, place="layout"):
    """(place, keys) of every object that a schema describes."""
    if isinstance(node, dict):
        if isinstance(node.get("properties"), dict) and not place.endswith("/if"):
            yield place, set(node["properties"])
        for key, child in node.items():
            yield from objects_of(child, f"{place}/{key}")
    elif isinstance(node, list):
        for child in node:
            yield from objects_of(child, place)


def missing_keys(schema, page):
    tables = tables_of(page)
    return [(place, keys) for place, keys in objects_of(schema) if not any(keys <= table for table in tables)]


def test_every_key_is_on_the_page():
    assert len(list(objects_of(SCHEMA))) > 30
    assert missing_keys(SCHEMA, PAGE) == []


def test_a_key_that_is_not_on_the_page_is_missed():
    changed = json.loads(json.dumps(SCHEMA))
    changed["definitions"]["formation"]["properties"]["agents"]["items"]["properties"]["mood"] = {"type": "string"}
    ((place, keys),) = missing_keys(changed, PAGE)
    assert "agents" in place and "mood" in keys


def test_the_page_is_what_the_schema_and_the_examples_say():
    assert script("layout_reference.py").made(PAGE, SCHEMA) == PAGE, "run scripts/layout_reference.py"


RULES = {
    "type": "object", "description": "How people move.", "properties": {
        "drive": {"type": "object", "title": "Drive on", "description": "Towards the goal.", "properties": {
            "enabled": {"type": "boolean", "default": True, "description": "Whether it acts."},
            "time_constant": {"type": "number", "minimum": 0.1, "maximum": 5, "default": 0.5, "x-unit": "s",
                              "x-source": "Helbing and Molnar 1995", "description": "How soon, s."}}},
        "swerve": {"$ref": "#/definitions/swerve"}}}
SWERVE = {"type": "object", "title": "Swerve", "description": "Past oncoming people.", "properties": {
    "enabled": {"type": "boolean", "default": True, "description": "Whether it acts."}}}


def with_motion():
    changed = json.loads(json.dumps(SCHEMA))
    changed["properties"]["motion"] = RULES
    changed["definitions"]["swerve"] = SWERVE
    return changed


def test_rules_of_motion_get_a_table_each():
    schema = with_motion()
    page = script("layout_reference.py").made(PAGE, schema)
    assert missing_keys(schema, page) == []
    assert "| `time_constant` | number | `0.5` | 0.1 to 5 | s | How soon. | Helbing and Molnar 1995 |" in page
    assert "| [`drive`](#drive-on) | object |" in page
    assert "### Drive on\n\n`drive`: Towards the goal.\n\n| key |" in page
    assert "### Swerve\n\n`swerve`: Past oncoming people.\n\n| key |" in page


@pytest.mark.parametrize("name", SCHEMA["definitions"]["people"]["properties"]["profile"]["oneOf"][0]["enum"])
def test_profiles_are_described_as_they_are(name):
    """Editors show descriptions, and nothing else."""
    people = SCHEMA["definitions"]["people"]["properties"]
    entry = people["profile"]["oneOf"][1]["properties"][name]
    rule = {**SCHEMA["definitions"]["people"], "definitions": SCHEMA["definitions"]}
    jsonschema.Draft7Validator(rule).validate(entry["x-people"])
    speed, radius = (entry["x-people"].get(key, people[key]["default"]) for key in ("speed", "radius"))
    mean, deviation = speed["normal"]
    least, most = radius["uniform"]
    assert f"Speed {mean:g} +- {deviation:g} m/s" in entry["description"]
    assert f"body radius {least:g} to {most:g} m" in entry["description"]


def test_the_examples_are_layouts_without_a_mistake(throng):
    answers = json.loads(throng("check", "--json", *EXAMPLES).stdout)
    assert len(answers) > 12
    for path, answer in zip(EXAMPLES, answers):
        jsonschema.validate(json.loads(path.read_text("utf-8")), SCHEMA)
        assert answer["valid"] and answer["diagnostics"] == [] and answer["agents"] > 0, path.name


def test_each_example_is_on_the_page_with_its_pictures():
    drawing = script("layout_pictures")
    assert {path.stem for path in EXAMPLES} == set(drawing.PICTURES)
    expected = {file for name in drawing.PICTURES for file in drawing.files_of(name).values()}
    assert expected == set(drawing.FOLDER.iterdir())
    for path in EXAMPLES:
        assert f"<!-- example: {path.stem} -->" in PAGE
    for file in expected:
        assert f"(images/layout/{file.name})" in PAGE
        assert file.stat().st_size <= MOST_BYTES
