# SPDX-License-Identifier: Apache-2.0
"""The rules of motion are things: a file and a row of the schema's table each."""
import json
import pathlib
import re

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
SCHEMA = json.loads((ROOT / "authoring/layout/throng-layout.schema.json").read_text())
RULES = SCHEMA["properties"]["motion"]["properties"]
# Rules that have no file of their own: what they are about is one line of a pass, or a folder.
ELSEWHERE = {"room_of_the_standing": "shaders/motion/room.glsl", "arriving": "shaders/motion/plans.glsl",
             "contact": "shaders/motion/contact.comp", "contact_momentum": "sim/passes.cpp",
             "entering": "shaders/motion/spawn_propose.comp", "routes_round_jams": "shaders/routes/detour_relax.comp"}


def sources(*folders):
    return {path: path.read_text() for folder in folders for path in (ROOT / folder).rglob("*")
            if path.suffix in (".comp", ".glsl", ".cpp", ".h")}


def file_of(rule):
    return ROOT / ELSEWHERE.get(rule, f"shaders/motion/{rule}.glsl")


def test_every_rule_is_a_file():
    assert [rule for rule in RULES if not file_of(rule).exists()] == []


def test_no_file_of_a_rule_needs_a_long_look():
    assert [rule for rule in RULES if file_of(rule).suffix == ".glsl" and
            len(file_of(rule).read_text().splitlines()) > 100] == []


def test_every_number_says_what_it_is():
    for rule, row in RULES.items():
        assert row["title"] and row["description"] and row["x-source"]
        for name, parameter in row["properties"].items():
            assert parameter["description"] and parameter["x-source"] and "default" in parameter, (rule, name)
            if parameter["type"] == "number":
                assert parameter["x-unit"], (rule, name)
                assert parameter["minimum"] <= parameter["default"] <= parameter["maximum"], (rule, name)


def test_every_number_is_used_and_none_is_used_that_is_not_in_the_table():
    shaders = "\n".join(sources("shaders").values())
    program = "\n".join(text for path, text in sources("sim", "authoring").items())
    for rule, row in RULES.items():
        for name in row["properties"]:
            constant = f"{rule}_{name}".upper()
            by_name = rf'"{rule}"' if name == "enabled" else rf'"{rule}", "{name}"'
            assert re.search(rf"\b{constant}\b", shaders) or re.search(by_name, program), constant
    known = {f"{rule}_{name}".upper() for rule, row in RULES.items() for name in row["properties"]}
    begun = "|".join(sorted((rule.upper() for rule in RULES), key=len, reverse=True))
    used = set(re.findall(rf"\b((?:{begun})_[A-Z_]+)\b", re.sub(r"//.*", "", shaders)))
    declared = set(re.findall(r"(?:const \w+|#define) ([A-Z_]+)", shaders))
    assert used - known - declared == set()


def test_rules_have_no_numbers_of_their_own():
    """Everything that shapes motion has a name, a unit and a source. What is left: halves, signs, epsilons, pi."""
    plain = re.compile(r"(?<![\w.])(\d+\.\d+(?:e-?\d+)?)(?![\w.])")
    harmless = {"0.0", "0.5", "1.0", "2.0", "3.14159265358979", "1.5707963", "1.34", "10.0", "0.098174770", "1.001"}
    found = {}
    for path, text in sources("shaders/motion").items():
        code = re.sub(r"//.*", "", text)
        odd = [number for number in plain.findall(code) if number not in harmless and "e" not in number]
        if odd:
            found[path.name] = odd
    assert found == {"waiting_for_company.glsl": ["0.3"]}  # told there: two directions that cancel each other
