# SPDX-License-Identifier: Apache-2.0
"""What the layout's schema says of its keys: limits, defaults, words and what they mean. Pure Python.

The add-on's zip carries a copy of the schema; in the source tree it is the one that the program reads, too.
"""
import json
import pathlib

FILE = "throng-layout.schema.json"
_HERE = pathlib.Path(__file__).resolve().parent
_LARGEST_INT = 2**31 - 1  # of Blender's properties


def _read():
    copy = _HERE / FILE
    return json.loads((copy if copy.exists() else _HERE.parents[2] / "authoring" / "layout" / FILE).read_text("utf-8"))


class Schema:
    """Entries of a schema: what it says of one key, with references followed."""

    def __init__(self, document):
        self.document = document

    def followed(self, entry):
        if "$ref" not in entry:
            return entry
        target = self.document["definitions"][entry["$ref"].rpartition("/")[2]]
        return {**target, **{key: value for key, value in entry.items() if key != "$ref"}}

    def named(self, name):
        """One of the layout's objects: a definition, what a key of the layout itself is, or, behind a point, an object
        in one of them."""
        if "." in name:
            return self.entry(*name.split("."))
        definition = self.document.get("definitions", {}).get(name)
        return definition or self.followed(self.document["properties"][name])

    def entries(self, owner):
        """{key: entry} of an object; of one that may be several things, the keys of all of them."""
        entries = {}
        for part in owner.get("oneOf", ()):
            entries.update(self.entries(self.followed(part)))
        entries.update(owner.get("properties", {}))
        return entries

    def entry(self, name, key):
        """What it says of a key of one of the layout's objects."""
        return self.followed(self.entries(self.named(name))[key])


def words_of(entry):
    """The words that a value may be; of a value that may be several things, those of whichever is a word."""
    return next((tuple(part["enum"]) for part in (entry, *entry.get("oneOf", ())) if "enum" in part), ())


def limits_of(entry):
    """(least, most) of a number, as Blender's properties hold them; None where there is none."""
    least, most = entry.get("minimum", entry.get("exclusiveMinimum")), entry.get("maximum")
    if entry.get("type") != "integer":
        return tuple(None if limit is None else float(limit) for limit in (least, most))
    return tuple(None if limit is None else max(-_LARGEST_INT, min(_LARGEST_INT, limit)) for limit in (least, most))


def is_distribution(entry):
    return any("uniform" in part.get("properties", {}) for part in entry.get("oneOf", ()))


def description_of(entry):
    """As Blender's tooltips have it: without a point at its end."""
    return entry.get("description", "").removesuffix(".")


def unit_of(entry):
    """Of a number; empty where it has none."""
    unit = entry.get("x-unit", "")
    return "" if unit == "1" else unit


LAYOUT = Schema(_read())
