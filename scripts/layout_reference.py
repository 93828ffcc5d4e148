#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes docs/layout.md from the schema. Usage: layout_reference.py [--check]"""
import json
import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
INTRO = """# Layouts

A layout is a JSON file for `throng bake`: metres, seconds, degrees counter-clockwise from +x. World coordinates may be
as large as UTM's. Point your editor at the schema (`"$schema"`, or `throng schema`) and it completes and checks while
you type; `throng check` says everything that is wrong in one go. This page is made from the schema by
`scripts/layout_reference.py`.

    {
      "throng": 1,
      "simulation": {"duration": 20, "seed": 7},
      "roads": [{"id": "street", "centreline": [[-30, 0], [30, 0]], "width": 8}],
      "walls": [{"points": [[-5, 1], [5, 1]], "thickness": 0.3}],
      "flows": [{"id": "commuters", "from": "street:start", "to": "street:end", "count": 120}]
    }

A **place** is an area's id, or a road's id with `:start` or `:end`. A **distribution** is a number,
`{"uniform": [least, most]}` or `{"normal": [mean, deviation], "min": ..., "max": ...}`, or `log_normal` with the mean
and deviation of the logarithm. With a warm-up, flows that start at 0 start at its beginning.

**Ground that is not flat.** `"terrain": {"file": "hill.glb"}` names a mesh in the layout's coordinates (`offset` moves
it: UTM-sized sites have terrains near their own origin). People stand on its faces that look up, and walk as fast as
slopes let them: on slopes by Tobler's hiking function (1993) relative to flat ground, exp(-3.5 (|s + 0.05| - 0.05)), so
10 % up takes 42 % longer and 5 % down is fastest; on stairs, which are known by their flat treads, by Weidmann (1993):
0.610 m/s up and 0.694 m/s down in plan for who walks 1.34 m/s on flat ground. Speeds and ways are in plan. Roads,
areas, and people and goals of formations have to lie over the terrain (up to a metre beyond its edge is let pass, and
smaller holes are filled from beside them): anything else is an error, because people would walk on air. Faces above
each other, holes, and ground steeper than 45 degrees are told of: the crowd has one storey, and cliffs are climbed
slowly rather than avoided. Routes are the shortest in plan. The terrain's own edges are no walls.

![examples/hill.json: steps up a steep bank, a slope beside them](images/hill.png)
"""
SECTIONS = [("simulation", "Simulation"), ("road", "Roads"), ("area", "Areas"), ("wall", "Walls"),
            ("terrain", "Terrain"), ("flow", "Flows"), ("formation", "Formations"), ("destination", "Destinations"),
            ("stop", "Stops (in a flow's `via`)"), ("event", "Events"), ("people", "People (in flows and formations)"),
            ("expect", "Expectations")]


def kind_of(rule):
    if "$ref" in rule:
        return rule["$ref"].rsplit("/", 1)[1]
    if "enum" in rule:
        return ", ".join(f"`{value}`" for value in rule["enum"])
    if "oneOf" in rule and "enum" in rule["oneOf"][0]:
        return f"word or {rule['oneOf'][1]['type']}"
    if "oneOf" in rule:
        return "number or distribution" if rule["oneOf"][0].get("type") == "number" else "place or object"
    if rule.get("type") == "array":
        return f"array of {kind_of(rule['items'])}" if isinstance(rule.get("items"), dict) else "array"
    return rule.get("type", "")


def range_of(rule):
    if "oneOf" in rule and rule["oneOf"][0].get("type") == "number":
        rule = rule["oneOf"][0]
    least, above, most = rule.get("minimum"), rule.get("exclusiveMinimum"), rule.get("maximum")
    parts = [f"> {above:g}"] if above is not None else [f">= {least:g}"] if least is not None else []
    return " and ".join(parts + ([f"<= {most:.16g}"] if most is not None else []))


def table(definition):
    if "properties" not in definition:  # one of several: those that are objects
        objects = [rule for rule in definition["oneOf"] if "properties" in rule]
        return "\n\n".join(f"{rule['description']}\n\n{table(rule)}" for rule in objects)
    lines = ["| key | type | range | default | meaning |", "| --- | --- | --- | --- | --- |"]
    for name, rule in definition["properties"].items():
        missing = "required" if name in definition.get("required", []) else ""
        default = f"`{json.dumps(rule['default'])}`" if "default" in rule else missing
        meaning = rule.get("description", "See People." if rule.get("$ref", "").endswith("people") else "[x, y], m.")
        lines.append(f"| `{name}` | {kind_of(rule)} | {range_of(rule)} | {default} | {meaning} |")
    return "\n".join(lines)


def page():
    schema = json.loads((ROOT / "authoring/layout/throng-layout.schema.json").read_text())
    parts = [INTRO]
    for key, title in SECTIONS:
        definition = schema["properties"]["simulation"] if key == "simulation" else schema["definitions"][key]
        parts.append(f"## {title}\n\n{definition['description']}\n\n{table(definition)}\n")
    return "\n".join(parts)


def main():
    target = ROOT / "docs/layout.md"
    if "--check" in sys.argv:
        if target.read_text() != page():
            sys.exit("docs/layout.md is not what the schema says: run scripts/layout_reference.py")
        return
    target.write_text(page())


main()
