# SPDX-License-Identifier: Apache-2.0
"""Layouts that are wrong in one place each, made from the schema: numbers just inside and just outside of their limits,
words that are none, keys that nobody knows. They all grow from one layout that has every kind of object."""
import copy
import json
import pathlib
from typing import NamedTuple

EVERY_OBJECT = pathlib.Path(__file__).parent / "layouts" / "every_object.json"
LEVELS = EVERY_OBJECT.with_name("levels.json")  # whose floors and links are none where there is a terrain
SEATS = EVERY_OBJECT.with_name("seats.json")  # which are none where there is a terrain
UNKNOWN_KEY = "zzz"


class Case(NamedTuple):
    kind: str       # number, word, flag or key
    place: tuple    # keys and indices that lead to what is tried
    put_at: tuple   # where the value goes: the place, or what is around it
    value: object
    allowed: bool   # by the schema
    rule: dict      # of what is put in
    tried: tuple    # the same wherever the same is tried
    number: dict = None  # the rule of the one number that is tried

    @property
    def pointer(self):
        return "/" + "/".join(map(str, self.place))

    def layout(self, base):
        return replaced(base, self.put_at, self.value)


def replaced(value, place, new):
    """The value with something else in one place."""
    if not place:
        return new
    result = copy.copy(value)
    result[place[0]] = replaced(result.get(place[0]) if isinstance(result, dict) else result[place[0]], place[1:], new)
    return result


class Rules:
    """What a schema says, with references followed."""

    def __init__(self, schema):
        self.schema = schema

    def parts(self, rule):
        """What a value may be: each of several things, or the one."""
        while "$ref" in rule:
            rule = self.schema["definitions"][rule["$ref"].rpartition("/")[2]]
        if "oneOf" in rule and "properties" not in rule:
            return [found for part in rule["oneOf"] for found in self.parts(part)]
        return [rule]

    def keys(self, rule):
        """{key: rule} of all objects that a value may be."""
        return {key: entry for part in reversed(self.parts(rule)) for key, entry in part.get("properties", {}).items()}

    def items(self, part):
        """One rule for each item of the shortest array."""
        items = part.get("items", [])
        return items if isinstance(items, list) else [items] * part.get("minItems", 1)

    def plainest(self, rule):
        """A value that is allowed."""
        part = self.parts(rule)[0]
        if "enum" in part:
            return part["enum"][0]
        if part["type"] == "array":
            return [self.plainest(item) for item in self.items(part)]
        if part["type"] == "object":
            return self.plainest_object(part)
        if part["type"] in ("number", "integer"):
            return max(least_of(part), min(part["maximum"], 1))
        return {"boolean": True, "string": "hall"}[part["type"]]

    def plainest_object(self, part):
        if isinstance(part.get("additionalProperties"), dict):
            return {"hall": self.plainest(part["additionalProperties"])}
        keys = part.get("required", list(part["properties"])[:part.get("minProperties", 0)])
        return {key: self.plainest(part["properties"][key]) for key in keys}

    def samples(self, rule):
        """Values that are allowed: whatever number the value may hold is in one of them."""
        for part in self.parts(rule):
            yield (plain := self.plainest(part))
            for key, entry in part.get("properties", {}).items():
                if key not in plain:
                    yield {**plain, key: self.plainest(entry)}

    def numbers(self, rule, value, place=()):
        """(place, rule) of every number in a value."""
        for part in self.parts(rule):
            if part.get("type") in ("number", "integer") and isinstance(value, (int, float)):
                yield place, part
            elif part.get("type") == "array" and isinstance(value, list):
                for index, item in enumerate(self.items(part)[:len(value)]):
                    yield from self.numbers(item, value[index], place + (index,))
            elif part.get("type") == "object" and isinstance(value, dict):
                known = {**dict.fromkeys(value, part["additionalProperties"] or None), **part.get("properties", {})}
                if all(known[key] for key in value):
                    for key in value:
                        yield from self.numbers(known[key], value[key], place + (key,))

    def may_be_empty(self, rule):
        return all(part.get("type") == "object" and not part.get("required") and not part.get("minProperties")
                   for part in self.parts(rule))

    def fill(self, rule, value, filled=None):
        """Puts in every kind of object that may be empty and is not there, once."""
        filled = set() if filled is None else filled
        for _, inside, entry in self.members(rule, value):
            if inside is None and self.may_be_empty(entry) and id(entry) not in filled:
                filled.add(id(entry))
                value[next(key for key, each in self.keys(rule).items() if each is entry)] = inside = {}
            if isinstance(inside, (dict, list)):
                self.fill(entry, inside, filled)
        return value

    def members(self, rule, value):
        """(key or index, value or None, rule) of what may stand inside a value."""
        if isinstance(value, dict):
            keys = self.keys(rule)
            others = next((part["additionalProperties"] for part in self.parts(rule)
                           if isinstance(part.get("additionalProperties"), dict)), None)
            return [*((key, value.get(key), entry) for key, entry in keys.items()),
                    *((key, inside, others) for key, inside in value.items() if others and key not in keys)]
        lists = [part for part in self.parts(rule) if part.get("type") == "array" and "items" in part]
        rules = self.items(lists[0]) if lists else []
        return [(index, item, rules[min(index, len(rules) - 1)]) for index, item in enumerate(value if rules else ())]

    def objects(self, rule, value, place=()):
        """(place, {key: rule}) of every object in a value."""
        if isinstance(value, dict) and self.keys(rule):
            yield place, self.keys(rule)
        for key, inside, entry in self.members(rule, value):
            if isinstance(inside, (dict, list)):
                yield from self.objects(entry, inside, place + (key,))


def least_of(rule):
    return rule.get("minimum", rule.get("exclusiveMinimum"))


def probes(rule):
    """(value, whether it is allowed) at both limits and just beyond, and for whole numbers between two of them."""
    least, most, exclusive = least_of(rule), rule["maximum"], "exclusiveMinimum" in rule
    whole = rule["type"] == "integer"
    below, above = (1, 1) if whole else (1e-3 * max(1.0, abs(least)), 1e-3 * max(1.0, abs(most)))
    yield from ((least, not exclusive), (least - below, False), (most, True), (most + above, False))
    if exclusive:
        yield min(0.5 * below, most), True
    if whole:
        yield least + 0.5, False


def cases_of_key(rules, place, key, entry):
    words = next((part["enum"] for part in rules.parts(entry) if "enum" in part), ())
    for word in (*words, *(word + "x" for word in words[:1])):
        yield Case("word", place, place, word, word in words, entry, (key, word))
    if any(part.get("type") == "boolean" for part in rules.parts(entry)):
        yield from (Case("flag", place, place, value, value is True, entry, (key, value)) for value in (True, "true"))
    for value in rules.samples(entry):
        for inside, rule in rules.numbers(entry, value):
            for number, allowed in probes(rule):
                yield Case("number", place + inside, place, replaced(value, inside, number), allowed, entry,
                           (inside[-1:] or key, id(rule), number), rule)


def base_of(schema):
    """The layout from which all cases grow."""
    levels = json.loads(LEVELS.read_text("utf-8"))
    every_object = json.loads(EVERY_OBJECT.read_text("utf-8"))
    seats = json.loads(SEATS.read_text("utf-8"))  # that people walk to
    more = {key: every_object[key] + seats[key] for key in ("behaviours", "flows", "formations", "seats")}
    return Rules(schema).fill(schema, {**every_object, **more, **{key: levels[key] for key in ("levels", "links")}})


def cases_of(schema):
    rules = Rules(schema)
    objects = list(rules.objects(schema, base_of(schema)))
    around = {place[:length] for place, _ in objects for length in range(len(place) + 1)}
    for place, keys in objects:
        yield Case("key", place + (UNKNOWN_KEY,), place + (UNKNOWN_KEY,), 1, False, {"not": {}}, ())
        for key, entry in keys.items():
            if place + (key,) not in around and "const" not in entry:
                yield from cases_of_key(rules, place + (key,), key, entry)
