#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes docs/passes.md from what `throng devices --passes` says. Usage: passes_page.py THRONG [--check]"""
import json
import os
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
INTRO = """# What a step reads and writes

A [step](method.md) is a list of passes, and a pass is one or more programs that run one after the other on the
device. Every program says in the C++ which blocks and samplers it reads and which blocks it writes
(`gl::Declaration`); it is held against its shader when it is made, and a program that touches anything else, or
writes what it says it only reads, does not start. This page is made from that by `scripts/passes_page.py`: `throng
devices --passes` prints the same for any layout.

Here: {people} people who enter a street little by little, some of them waiting in a line, round a wall; the diagram
by the method `binned`. Rows stand in the order in which the device is asked. A buffer stands with the bytes of one
element and with what it has an element for: `bodies` 32/person. **Read** and **written** are bytes per person and
launch: the elements of the person's own row or slot, whole and once. What a program looks at of others, and buffers
with elements for anything but people (and sites: people and wall tiles), are not in them. A row without a program is
a transfer that the driver does. Layouts with [behaviours](how-to/behaviours.md) have one pass more, after the cells,
and those with [lifts](how-to/storeys.md#lifts), [platforms](how-to/traffic.md#get-on-and-off) or [ground where people
take another room](how-to/ground.md#ground-where-people-take-more-room), too; those with
[seats that people walk to](how-to/audiences.md#people-who-come-and-go) have one before them: `throng devices --passes
examples/market.json` prints it.
"""


def table_of(program):
    with tempfile.TemporaryDirectory() as empty:  # no calibration of this machine
        told = subprocess.run([program, "devices", "--passes", "--json"], capture_output=True, text=True, check=True,
                              env={**os.environ, "XDG_CACHE_HOME": empty})
    return json.loads(told.stdout)


def named(buffers):
    def label(buffer):
        return f"{buffer['buffer']} {buffer['element_bytes']}" + (f"/{buffer['per']}" if buffer["per"] else "")

    return ", ".join(map(label, buffers)) or "-"


def cells_of(row):
    name = row["what"].removeprefix("shaders/")
    return (f"`{name}`" if row["declared"] else name, f"{row['launches']:.4g}", row["bytes_read_per_person"],
            row["bytes_written_per_person"], named(row["reads"]), named(row["writes"]))


def section(entry):
    if not entry["rows"]:
        return f"## {entry['pass']}\n\nNothing to do here.\n"
    lines = ["| program | launches | read | written | reads | writes |", "| --- | ---: | ---: | ---: | --- | --- |"]
    lines += ["| " + " | ".join(map(str, cells_of(row))) + " |" for row in entry["rows"]]
    return f"## {entry['pass']}\n\n" + "\n".join(lines) + "\n"


def total(passes):
    rows = [row for entry in passes for row in entry["rows"]]
    launches = sum(row["launches"] for row in rows)
    read, written = (sum(row["launches"] * row[f"bytes_{what}_per_person"] for row in rows)
                     for what in ("read", "written"))
    return (f"In all {launches:.4g} programs and transfers a step, {read:.0f} bytes read and {written:.0f} written "
            "for each person.\n")


def is_of_people(buffer):
    return buffer["per"] in ("person", "site")


def kept(passes):
    """Per buffer with an element for each person: its bytes, and the passes that touch it, in their order."""
    found = {}
    for entry in passes:
        for row in entry["rows"]:
            for buffer in filter(is_of_people, row["reads"] + row["writes"]):
                size, touching = found.setdefault(buffer["buffer"], (buffer["element_bytes"], []))
                if entry["pass"] not in touching:
                    touching.append(entry["pass"])
    return sorted(found.items(), key=lambda item: -item[1][0])


def memory(passes):
    buffers = kept(passes)
    lines = ["| buffer | bytes a person | passes that touch it |", "| --- | ---: | --- |"]
    lines += [f"| {name} | {size} | {', '.join(touching)} |" for name, (size, touching) in buffers]
    together = sum(size for _, (size, _) in buffers)
    return ("## What a person takes\n\nBuffers with an element for each person (who has a body; of discs fewer), "
            f"{together} bytes together. Besides, a person has 48\nbytes for each stage of its way, 36 for each of the "
            "frames that are on their way to the disk\n(three, or two of 16,384 people and more), and its part of the "
            "ground: 8 bytes a cell, 4 to 16 a pixel of the diagram.\n`throng check` tells what a layout takes in "
            "all.\n\n"
            + "\n".join(lines) + "\n")


def page(document):
    passes = document["passes"]
    return "\n".join([INTRO.format(people=document["people"]), total(passes), memory(passes), *map(section, passes)])


def main():
    target = ROOT / "docs/passes.md"
    text = page(table_of(sys.argv[1]))
    if "--check" not in sys.argv:
        target.write_text(text)
    elif target.read_text() != text:
        sys.exit("docs/passes.md is not what the passes declare: run scripts/passes_page.py")


main()
