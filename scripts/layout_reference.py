#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Brings docs/layout.md up to date: the tables of keys, made from the schema, and the example layouts with their
pictures. What stands around them is written by hand. Usage: layout_reference.py [--check]"""
import json
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
PAGE = ROOT / "docs" / "layout.md"
SCHEMA = ROOT / "authoring" / "layout" / "throng-layout.schema.json"
# Where the page speaks of a definition, and what one of them is called.
SECTIONS = {"point": ("point", "places-and-points"), "destination": ("destination", "destinations"),
            "seat_goal": ("seat", "destinations"),
            "stop": ("stop", "stops"), "people": ("people", "people"), "bar": ("bar", "expectations"),
            "expect": ("bars", "expectations"), "terrain": ("terrain", "terrain"), "level": ("level", "levels"),
            "link": ("link", "links"), "road": ("road", "roads"),
            "area": ("area", "areas"), "wall": ("wall", "walls"), "flow": ("flow", "flows"),
            "formation": ("formation", "formations"), "event": ("event", "events"),
            "seat_block": ("block of seats", "seats"), "show": ("show", "shows"),
            "attraction": ("attraction", "attractions"), "patch": ("patch", "patches"),
            "given": ("group of given people", "given-people"),
            "crossing": ("crossing", "crossings"), "lane": ("lane", "lanes"), "lane_stop": ("stop of a lane", "lanes"),
            "signal": ("signal", "signals"), "phase": ("phase", "signals"),
            "vehicle_flow": ("flow of vehicles", "vehicles"), "doors": ("door", "vehicles"),
            "at_platform": ("platform", "flows"),
            "behaviour": ("behaviour", "behaviours"), "behaviour_state": ("state", "behaviours"),
            "transition": ("condition", "behaviours")}
LINKED_KEYS = ("simulation", "motion")  # of the layout itself, which are no definitions
COLUMNS = ("key", "type", "default", "limits", "unit", "meaning")
SOURCE = "source"  # a column more where a table has any


class Reference:
    """What the schema says, as Markdown."""

    def __init__(self, schema):
        self.schema = schema

    def followed(self, rule):
        if "$ref" not in rule:
            return rule
        target = self.schema["definitions"][rule["$ref"].rpartition("/")[2]]
        return {**target, **{key: value for key, value in rule.items() if key != "$ref"}}

    def named(self, name):
        return self.schema if name == "layout" else self.schema["definitions"].get(name) or self.followed(
            self.schema["properties"][name])

    def objects(self, rule):
        """Every object that a value may be; those with a place of their own on the page left out."""
        if "properties" in rule:
            return [rule]
        return [found for part in rule.get("oneOf", ()) if "$ref" not in part for found in self.objects(part)]

    # Cells

    def type_of(self, rule):
        if (name := rule.get("$ref", "").rpartition("/")[2]) in SECTIONS:
            word, anchor = SECTIONS[name]
            return f"[{word}](#{anchor})"
        rule = self.followed(rule)
        if is_distribution(rule):
            return "number or [distribution](#distributions)"
        if "oneOf" in rule:
            return " or ".join(dict.fromkeys(self.type_of(part) for part in rule["oneOf"]))
        if "const" in rule or "enum" in rule:
            return "word" if isinstance(rule.get("const", ""), str) else "number"
        if rule["type"] == "array":
            return self.type_of_list(rule)
        return {"integer": "whole number", "boolean": "true or false", "string": "text"}.get(rule["type"], rule["type"])

    def type_of_list(self, rule):
        items = rule["items"]
        if isinstance(items, list):
            return "list of numbers"
        if "$ref" in items:
            word, anchor = SECTIONS[items["$ref"].rpartition("/")[2]]
            return f"list of [{plural(word)}](#{anchor})"
        return f"list of {self.type_of(items)}s"

    def limits_of(self, rule):
        if is_distribution(rule):
            return range_of(rule["oneOf"][0])
        if "oneOf" in rule:
            return "; ".join(filter(None, map(self.limits_of, rule["oneOf"])))
        if "const" in rule:
            return f"`{rule['const']}`"
        if "enum" in rule:
            return ", ".join(f"`{word}`" for word in rule["enum"])
        if rule.get("type") == "array":
            return ", ".join(filter(None, (count_of(rule), self.limits_of_items(rule["items"]))))
        others = rule.get("additionalProperties")
        if isinstance(others, dict):
            return self.limits_of_items(others)
        return range_of(rule)

    def limits_of_items(self, items):
        limits = "" if isinstance(items, list) or "$ref" in items else range_of(items)
        return f"each {limits}" if limits else ""

    def default_of(self, owner, key, rule):
        if "default" in rule:
            return f"`{json.dumps(rule['default'], ensure_ascii=False)}`"
        if key in owner.get("required", ()):
            return "required"
        cases = [condition_of(case) for case in owner.get("allOf", ()) if key in case["then"]["required"]]
        return "required: " + ", ".join(cases) if cases else choice_of(owner, key)

    def row(self, owner, key, rule):
        described = self.followed(rule)
        anchor = anchor_of(described)
        if owner is self.schema and key in LINKED_KEYS:
            anchor = key
        link = f"[`{key}`](#{anchor})" if anchor else f"`{key}`"
        unit = rule.get("x-unit", "")
        return {"key": link, "type": self.type_of(rule), "default": self.default_of(owner, key, rule),
                "limits": self.limits_of(rule), "unit": unit, "meaning": without_unit(described["description"], unit),
                SOURCE: rule.get("x-source", "")}

    # Tables

    def table(self, owner):
        rows = [self.row(owner, key, rule) for key, rule in owner["properties"].items()]
        columns = COLUMNS + ((SOURCE,) if any(row[SOURCE] for row in rows) else ())
        return markdown_table(columns, rows)

    def inner_tables(self, owner):
        """Of objects that stand only under one key of an object."""
        for key, rule in owner["properties"].items():
            if "$ref" in rule or is_distribution(rule) or key in LINKED_KEYS:
                continue
            in_list = isinstance(rule.get("items"), dict) and "$ref" not in rule["items"]
            for part in self.objects(rule["items"] if in_list else rule):
                if any("x-people" in entry for entry in part["properties"].values()):
                    yield self.profiles(key, part)
                    continue
                what = f"Each of `{key}`" if in_list else f"`{key}`, as an object"
                about = part.get("description", "")
                yield "\n\n".join(filter(None, (f"{what}: {about[:1].lower()}{about[1:]}" if about else f"{what}:",
                                               self.table(part))))
                if in_list:
                    yield from self.inner_tables(part)

    def profiles(self, key, part):
        """What makes each kind of people, in the words of a layout."""
        people = self.named("people")["properties"]
        told = [name for name in people if any(name in entry["x-people"] for entry in part["properties"].values())]
        rows = [{"key": f"`{name}`", "weight": range_of(entry), SOURCE: entry["x-source"],
                 **{each: in_words(entry["x-people"].get(each, people[each]["default"]), people[each].get("x-unit"))
                    for each in told}} for name, entry in part["properties"].items()]
        return f"`{key}`: one of these words, or an object of several with their weights.\n\n" + \
            markdown_table(("key", "weight", *told, SOURCE), rows)

    def block(self, name):
        """All that the page's reference says of one of the layout's objects."""
        if name == "distribution":
            return self.distributions()
        if name == "motion":
            return self.rules_of_motion()
        owner = self.named(name)
        parts = [owner] if "properties" in owner else self.objects(owner)
        tables = []
        for part in parts:
            about = part.get("description", "") if part is not owner else ""
            tables += filter(None, (about, self.table(part), *self.inner_tables(part)))
        return "\n\n".join(tables)

    def distributions(self):
        speed = self.named("people")["properties"]["speed"]
        rows = {}
        for part in self.objects(speed):
            for key, rule in part["properties"].items():
                rows.setdefault(key, rule)
        keys = [{"key": f"`{key}`", "type": self.type_of(rule), "meaning": rule["description"]}
                for key, rule in rows.items()]
        return markdown_table(("key", "type", "meaning"), keys)

    def rules_of_motion(self):
        """A section for each of them."""
        motion = self.named("motion")
        parts = [self.table(motion)]
        for name, rule in motion["properties"].items():
            rule = self.followed(rule)
            parts += [f"### {rule['title']}", f"`{name}`: {rule['description']}", self.table(rule)]
        return "\n\n".join(parts)


def choice_of(owner, key):
    """What a default's cell says of a key that is one of several of which there is exactly one."""
    of_each = ([part["required"] for part in owner.get(each, ())] for each in ("oneOf", "anyOf"))
    choices = next((found for found in of_each if any(key in keys for keys in found)), [])
    if any(key in also for _, *also in choices):
        return "required with " + ", ".join(f"`{first}`" for first, *also in choices if key in also)
    if key not in (first for first, *_ in choices):
        return ""
    return "one of " + ", ".join(f"`{first}`" for first, *_ in choices)


def condition_of(case):
    """The word that a rule's `if` asks for."""
    (rule,) = case["if"]["properties"].values()
    return rule["const"]


def anchor_of(rule):
    """Of the section that an object with a title has."""
    return re.sub(r"[^\w -]", "", rule.get("title", "").lower()).replace(" ", "-")


def plural(word):
    first, _, rest = word.partition(" ")
    return f"{first}s {rest}".rstrip()


def is_distribution(rule):
    return any("uniform" in part.get("properties", {}) for part in rule.get("oneOf", ()))


def number(value):
    return str(int(value)) if value == int(value) else repr(value)


def range_of(rule):
    if "maximum" not in rule:
        return ""
    least = number(rule["minimum"]) if "minimum" in rule else f"above {number(rule['exclusiveMinimum'])},"
    return f"{least} to {number(rule['maximum'])}"


def count_of(rule):
    least, most = rule.get("minItems"), rule.get("maxItems")
    if least is None or least == most:
        return "" if least is None else f"exactly {least}"
    return f"at least {least}" if most is None else f"{least} to {most}"


def without_unit(description, unit):
    """The unit has a column of its own."""
    return re.sub(rf", {re.escape(unit)}(?=[.;:,)]|$)", "", description, count=1) if unit else description


def in_words(distribution, unit):
    """A distribution as a table's cell."""
    unit = f" {unit}" if unit else ""
    if not isinstance(distribution, dict):
        return f"{number(distribution)}{unit}"
    kind, (first, second) = next((kind, distribution[kind]) for kind in ("uniform", "normal", "log_normal")
                                 if kind in distribution)
    if kind == "uniform":
        return f"{number(first)} to {number(second)}{unit}"
    ends = "".join(f", {word} {number(distribution[end])}{unit}"
                   for end, word in (("min", "at least"), ("max", "at most")) if end in distribution)
    of = " of the logarithm" if kind == "log_normal" else unit
    return f"{number(first)} +- {number(second)}{of}{ends}"


def markdown_table(columns, rows):
    def line(cells):
        return "| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |"

    return "\n".join([line(columns), line("---" for _ in columns),
                      *(line(row[name] for name in columns) for row in rows)])


def example(name):
    """A layout as it stands in docs/examples, and what its bake looks like."""
    path = PAGE.parent / "examples" / f"{name}.json"
    text = path.read_text("utf-8")
    title = json.loads(text)["name"]
    shown = [f"    {line}".rstrip() for line in text.rstrip().split("\n")]
    pictures = sorted((PAGE.parent / "images" / "layout").glob(f"{name}.png")) or sorted(
        (PAGE.parent / "images" / "layout").glob(f"{name}-[0-9]*.png"))
    drawn = [f"![{title}](images/layout/{picture.name})" for picture in pictures]
    return "\n".join([f"[`docs/examples/{name}.json`](examples/{name}.json):", "", *shown, "", *drawn])


def made(page, schema):
    """The page with everything between its markers made anew."""
    reference = Reference(schema)

    def block(found):
        kind, name = found["kind"], found["name"]
        text = reference.block(name) if kind == "reference" else example(name)
        return f"<!-- {kind}: {name} -->\n" + (f"\n{text}\n\n" if text else "") + "<!-- end -->"

    return re.sub(r"<!-- (?P<kind>reference|example): (?P<name>[\w-]+) -->\n.*?<!-- end -->", block, page,
                  flags=re.DOTALL)


def main():
    page = PAGE.read_text("utf-8")
    current = made(page, json.loads(SCHEMA.read_text("utf-8")))
    if "--check" in sys.argv:
        if page != current:
            sys.exit("docs/layout.md is not what the schema and the examples say: run scripts/layout_reference.py")
        return
    PAGE.write_text(current, "utf-8")


if __name__ == "__main__":
    main()
