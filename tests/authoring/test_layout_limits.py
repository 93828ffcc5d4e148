# SPDX-License-Identifier: Apache-2.0
"""The program and the schema agree on every number, word, flag and key of a layout."""
import collections
import json

import jsonschema
import pytest

from conftest import ROOT

from layout_corpus import UNKNOWN_KEY, base_of, cases_of

SCHEMA = json.loads((ROOT / "authoring" / "layout" / "throng-layout.schema.json").read_text("utf-8"))
REFUSALS = {"number": ("out of range", "whole number"), "word": ("expected one of",), "flag": ("expected true or",),
            "key": ("has no key",)}
FILES_AT_ONCE = 400

pytestmark = pytest.mark.xdist_group("layouts that are wrong in one place")  # which are made and checked once


@pytest.fixture(scope="module")
def cases():
    return list(cases_of(SCHEMA))


@pytest.fixture(scope="module")
def answers(throng, cases, tmp_path_factory):
    """What the program says of each case: its diagnostics. A key that nobody knows ends it before anything is built."""
    folder = tmp_path_factory.mktemp("corpus")
    base = {**base_of(SCHEMA), UNKNOWN_KEY: 1}
    names = [f"{index}.json" for index in range(len(cases))]
    for name, case in zip(names, cases):
        (folder / name).write_text(json.dumps(case.layout(base)))
    (folder / "base.json").write_text(json.dumps(base))
    said = []
    for start in range(0, len(names) + 1, FILES_AT_ONCE):
        finished = throng("check", "--json", *[*names, "base.json"][start:start + FILES_AT_ONCE], cwd=folder, expect=3)
        said += [file["diagnostics"] for file in json.loads(finished.stdout)]
    assert [entry["pointer"] for entry in said.pop()] == ["/" + UNKNOWN_KEY], "nothing else is wrong with the base"
    return said


def concerns(case, diagnostic):
    """Whether it is about what was tried, or about something around it."""
    return diagnostic["pointer"] and (case.pointer + "/").startswith(diagnostic["pointer"] + "/")


def test_the_schema_says_of_the_values_what_the_cases_say(cases):
    validators = {}
    for case in cases:
        rule = validators.setdefault(id(case.rule), jsonschema.Draft7Validator(
            {"definitions": SCHEMA["definitions"], "allOf": [case.rule]}))
        assert rule.is_valid(case.value) == case.allowed, (case.pointer, case.value)


def numbers_of(node):
    """Every number that a schema speaks of, each one's rule."""
    if isinstance(node, dict) and node.get("type") in ("number", "integer"):
        yield node
    for child in node.values() if isinstance(node, dict) else node if isinstance(node, list) else ():
        yield from numbers_of(child)


def test_every_number_of_the_schema_is_tried(cases):
    tried = {id(case.number) for case in cases}
    assert [rule for rule in numbers_of(SCHEMA) if id(rule) not in tried] == []


def test_what_the_schema_refuses_is_refused_at_its_place(cases, answers):
    for case, said in zip(cases, answers):
        if not case.allowed:
            assert any(concerns(case, entry) for entry in said), f"{case.pointer} = {case.value} passes"


def test_what_the_schema_allows_is_in_range(cases, answers):
    known = collections.defaultdict(bool)  # whether any object of the kind has the key
    for case, said in zip(cases, answers):
        if not case.allowed:
            continue
        complaints = [entry["message"] for entry in said if concerns(case, entry)]
        refused = [text for text in complaints if any(words in text for words in REFUSALS[case.kind])]
        assert not refused, f"{case.pointer} = {case.value}: {refused}"
        known[case.tried] |= not any("has no key" in text for text in complaints)
    assert [tried for tried, is_known in known.items() if not is_known] == []
