#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes docs/commands/, a page for each command, from what the program says of itself.

Usage: command_reference.py THRONG [--check]
"""

import pathlib
import re
import subprocess
import sys
import textwrap

ROOT = pathlib.Path(__file__).resolve().parent.parent
FOLDER = ROOT / "docs" / "commands"
COLUMN = 30  # where meanings begin
SECTION = re.compile(r"^(Positionals|Options|Subcommands):$")
# Where else to read about a command, from docs/commands/.
BESIDE = {
    "convert": ["../bake.md#forms|the forms of streams"],
    "apply": ["../how-to/change-people.md|how to change single people", "../overrides.md|the file of overrides",
              "../layers.md|layers of changes"],
    "bake": [
        "../layout.md|layouts",
        "../bake.md|what a bake holds",
        "../how-to/resume.md|how to go on with a bake that was stopped",
    ],
    "batch": ["../batch.md|families and batches", "../how-to/cluster.md|how to bake a batch on a cluster"],
    "batch query": ["../batch.md#the-database|the database's tables"],
    "bench diagrams": ["../benchmarks/llvmpipe/diagrams.md|what came of it on llvmpipe"],
    "bench proximity": ["../benchmarks/llvmpipe/proximity.md|what came of it on llvmpipe"],
    "bench step": ["../benchmarks/step.md|the time of a step"],
    "calibrate": ["../diagram.md#which-is-fastest|which way to build the diagram is fastest"],
    "check": ["../layout.md|layouts"],
    "compare": ["../measure.md#beside-people|what is compared"],
    "generate": ["../batch.md#generators|the kinds"],
    "info": ["../bake.md|what a bake holds"],
    "measure": [
        "../measure.md|what is measured",
        "../follow.md|following somebody",
        "../how-to/bars.md|how to hold a bake to bars",
    ],
    "report": ["../report.md|what the pages show"],
    "scenarios": ["../motion-validation.md|what came of them"],
    "verify": ["../bake.md#checksums|the checksums of a bake", "../how-to/render-on-a-farm.md|rendering on a farm"],
    "completions": ["../how-to/install.md|how to install it"],
    "manual": ["../how-to/install.md|how to install it"],
    "schema": ["../how-to/editors.md|how editors use them", "../layout.md|layouts", "../batch.md|families",
               "../overrides.md|overrides"],
}


def said(program, words):
    return subprocess.run([program, *words, "--help"], check=True, stdout=subprocess.PIPE, text=True).stdout


def parsed(text):
    """What the help holds: "about", "usage", "end" (what follows), and by section pairs of name and meaning."""
    lines = text.rstrip().splitlines()
    usage = next(i for i, line in enumerate(lines) if line.startswith("Usage: "))
    found = {
        "about": " ".join(lines[:usage]),
        "usage": lines[usage][len("Usage: ") :],
        "Positionals": [],
        "Options": [],
        "Subcommands": [],
    }
    section, end = None, []
    for line in lines[usage + 1 :]:
        heading = SECTION.match(line)
        if heading:
            section = found[heading.group(1)]
        elif section is not None and line.startswith(
            " " * COLUMN
        ):  # the meaning of a long option is on a line of its own
            section[-1] = (section[-1][0], f"{section[-1][1]} {line.strip()}".strip())
        elif section is not None and line.startswith("  "):
            wide = line[COLUMN - 1 : COLUMN] == " "
            section.append((line[:COLUMN].strip(), line[COLUMN:].strip()) if wide else (line.strip(), ""))
        elif line:
            section = None
            end.append(line)
        elif section is None:
            end.append(line)
    found["end"] = "\n".join(end).strip()
    return found


def cell(text):
    return text.replace("|", "\\|").replace("<", "&lt;")


def option_row(spelled, meaning):
    """`-o,--output TEXT=bench` in three columns: how it is written, what it takes, what it is otherwise."""
    names, _, rest = spelled.partition(" ")
    names = re.sub(r"\{\w+\}", "", names)
    relation = re.search(r"(Needs|Excludes): (.+)$", rest)
    rest = rest[: relation.start()].strip() if relation else rest
    required, several = "REQUIRED" in rest, "..." in rest
    rest = rest.replace("REQUIRED", "").replace("...", "").strip()
    takes, _, otherwise = rest.partition("=")
    takes = (
        re.sub(r":(INT|FLOAT) in ", " in ", takes)
        .replace(":NONNEGATIVE", " >= 0")
        .replace(":DIR", ", a folder")
        .replace("UINT", "INT")
    )
    kinds = {"TEXT": "text", "INT": "whole number", "FLOAT": "number"}
    takes = re.sub(r"^(TEXT|INT|FLOAT)", lambda match: kinds[match.group(1)], takes)
    choice = re.match(r"text:\{(.+)\}$", takes)
    takes = (
        " or ".join(f"`{word}`" for word in choice.group(1).split(","))
        if choice
        else takes + (", several" if several else "")
    )
    if relation:
        meaning += f" ({relation.group(1).lower()} `{relation.group(2)}`)"
    otherwise = "required" if required else f"`{otherwise}`" if otherwise else ""
    return f"| {', '.join(f'`{name}`' for name in names.split(','))} | {cell(takes)} | {otherwise} | {cell(meaning)} |"


def options_table(rows):
    return "\n".join(["| | takes | unless told | |", "| --- | --- | --- | --- |"] + [option_row(*row) for row in rows])


def ending(text):
    """Paragraphs as they are, examples and lists as code."""
    parts = []
    for block in re.split(r"\n\s*\n", text):
        title = re.match(r"Examples?:\n", block)
        if title:
            parts.append(
                f"## {title.group(0).strip()[:-1]}\n\n{textwrap.indent(textwrap.dedent(block[title.end():]), '    ')}"
            )
        elif block:
            parts.append(textwrap.fill(" ".join(block.split()), 120))
    return "\n\n".join(parts)


def page(words, found, common_end):
    name = " ".join(words)
    parts = [f"# throng {name}", found["about"] + ".", "    " + found["usage"]]
    for title in ("Positionals", "Options"):
        rows = [row for row in found[title] if not row[0].startswith("-h,")]
        if rows:
            parts.append(f"## {'Arguments' if title == 'Positionals' else title}\n\n{options_table(rows)}")
    if found["Subcommands"]:
        rows = [
            f"| [`{name} {sub}`]({'-'.join([*words, sub])}.md) | {cell(meaning)} |"
            for sub, meaning in found["Subcommands"]
        ]
        parts.append("## Commands of its own\n\n| | |\n| --- | --- |\n" + "\n".join(rows))
    if found["end"] != common_end:
        parts.append(ending(found["end"]))
    links = [
        f"[{text}]({target})"
        for target, text in (link.split("|") for link in [*BESIDE.get(name, []), "../cli.md|all commands"])
    ]
    parts.append(
        "\n".join(textwrap.wrap(f"See also: {', '.join(links)}.", 120, break_long_words=False, break_on_hyphens=False))
    )
    return "\n\n".join(part for part in parts if part) + "\n"


def pages(program):
    """{file name: text} of all commands, whatever their depth."""
    whole = parsed(said(program, []))
    found, left = {}, [[name] for name, _ in whole["Subcommands"]]
    while left:
        words = left.pop()
        command = parsed(said(program, words))
        found["-".join(words) + ".md"] = page(words, command, whole["end"])
        left += [[*words, name] for name, _ in command["Subcommands"]]
    return found


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    made = pages(sys.argv[1])
    there = {path.name: path.read_text() for path in FOLDER.glob("*.md")}
    if "--check" in sys.argv:
        if made != there:
            wrong = sorted(name for name in made.keys() | there.keys() if made.get(name) != there.get(name))
            sys.exit(
                f"docs/commands is not what the program says ({', '.join(wrong)}): run scripts/command_reference.py"
            )
        return
    FOLDER.mkdir(exist_ok=True)
    for name in there.keys() - made.keys():
        (FOLDER / name).unlink()
    for name, text in made.items():
        (FOLDER / name).write_text(text)


if __name__ == "__main__":
    main()
