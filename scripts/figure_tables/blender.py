# SPDX-License-Identifier: Apache-2.0
"""How long importing a bake takes in each Blender that is here, and a change of frame."""

import json
import shutil
import subprocess
import sys

from pages import table
from runs import ROOT, output_of

sys.path.insert(0, str(ROOT / "tests" / "blender"))
SCRIPT = ROOT / "scripts" / "figure_tables" / "in_blender.py"
STADIUM = {"people": 16384, "radius": 62, "stand": 34, "exits": 16, "exit_width": 8, "rise": 3, "duration": 10}
ROUNDS = 3


def blenders():
    """Commands that run a script, by name: the installed Blender, and the modules that scripts/test installs."""
    found = {}
    if shutil.which("blender"):
        found["blender"] = ["blender", "-b", "--factory-startup", "--python-exit-code", "1", "-P", SCRIPT, "--"]
    for folder in ("bpy-lts", "bpy"):
        python = ROOT / "build" / folder / "bin" / "python"
        if python.exists():
            found[folder] = [python, ROOT / "tests" / "blender" / "run_in_bpy.py", "", SCRIPT]
    return found


def stadium(runs, folder):
    numbers = {**STADIUM, "people": 256, "duration": 2} if runs.quick else STADIUM
    words = [word for name, value in numbers.items() for word in ("--set", f"{name}={value}")]
    output_of(runs.program, "generate", "stadium", *words, "-o", folder / "stadium.json")
    output_of(runs.program, "bake", folder / "stadium.json", "-o", folder / "stadium", "--no-gltf", "-q")


def synthetic(people):
    def write(runs, folder):
        import sample_bake

        sample_bake.write_bake(folder / "synthetic", agents=people // 64 if runs.quick else people, frames=60)

    return write


CROWDS = {
    "a stadium": (stadium, "stadium", False),
    "the same, levels of detail by camera": (stadium, "stadium", True),
    "synthetic, 16,384": (synthetic(16384), "synthetic", False),
    "synthetic, 65,536": (synthetic(65536), "synthetic", False),
}


def timed(runs, title, command):
    """In one Blender: importing once, and the range of several runs for a change of frame."""
    make, name, levels = CROWDS[title]
    folder = runs.scratch("blender")
    make(runs, folder)
    found = []
    for _ in range(1 if runs.quick else ROUNDS):
        words = [
            *command,
            ROOT / "blender_addon",
            folder / name,
            folder / "saved.blend",
            "levels" if levels else "plain",
        ]
        done = subprocess.run(
            [str(word) for word in words], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False
        )
        results = [line for line in done.stdout.splitlines() if line.startswith("RESULT ")]
        if done.returncode or not results:
            raise SystemExit(f"{' '.join(map(str, words))} ended with {done.returncode}:\n{done.stdout[-2000:]}")
        found.append(json.loads(results[-1][len("RESULT ") :]))
    shutil.rmtree(folder)
    return found


def milliseconds(values):
    least, most = f"{1000 * min(values):.1f}", f"{1000 * max(values):.1f}"
    return f"{least} ms" if least == most else f"{least}-{most} ms"


def blender(runs):
    rows, here = [], blenders()
    addon = sorted((ROOT / "blender_addon").rglob("*.py"))
    for title in CROWDS:
        for name, command in here.items():
            found = runs.known(
                f"{title}, {name}",
                lambda title=title, command=command: timed(runs, title, command),
                "blender",
                title,
                name,
                runs.quick,
                SCRIPT,
                *addon,
            )
            last = found[-1]
            rows.append(
                [
                    title,
                    f"{last['people']:,}",
                    last["version"],
                    f"{max(each['import'] for each in found):.1f} s",
                    milliseconds([each["frame"] for each in found]),
                    milliseconds([each["median"] for each in found]),
                    f"{last['bytes'] / 1e6:.0f} MB",
                ]
            )
    if not here:
        raise SystemExit("there is no Blender here")
    return table(
        ["crowd", "people drawn", "Blender", "import", "change of frame: fastest", "median", ".blend, compressed"], rows
    )
