# SPDX-License-Identifier: Apache-2.0
"""What all Python tests share: the binary, bakes of the examples (each made once), and where other tools are."""
import json
import os
import pathlib
import shutil
import subprocess

import pytest

ROOT = pathlib.Path(__file__).resolve().parent.parent
EXAMPLES = ROOT / "examples"


@pytest.fixture(scope="session")
def throng():
    """Runs the command line: throng("bake", ...) returns the finished process."""
    binary = os.environ.get("THRONG_BINARY", str(ROOT / "build" / "release" / "throng"))
    if not os.path.exists(binary):
        pytest.skip(f"{binary} is not built")

    def run(*arguments, expect=0, **options):
        process = subprocess.run([binary, *map(str, arguments)], capture_output=True, text=True, **options)
        if expect is not None:
            assert process.returncode == expect, process.stderr + process.stdout
        return process

    run.binary = binary
    return run


@pytest.fixture(scope="session")
def bakes(throng, tmp_path_factory):
    """bakes("intersection") is the folder of that example's bake."""
    folder = tmp_path_factory.mktemp("bakes")
    made = {}

    def bake(name):
        if name not in made:
            extra = ["--diagrams", "480"] if name == "intersection" else ["--no-gltf"]
            throng("bake", EXAMPLES / f"{name}.json", "-o", folder / name, "-q", *extra)
            made[name] = folder / name
        return made[name]

    return bake


def blender_program():
    """Debian's Blender."""
    program = shutil.which("blender")
    if not program:
        pytest.skip("Blender is not installed")

    def command(script, arguments, blend, factory):
        return [program, "-b"] + (["--factory-startup"] if factory else []) + ([str(blend)] if blend else []) + \
            ["--python-exit-code", "1", "-P", str(script), "--", *arguments]

    return command


def blender_module(folder="bpy"):
    """A current Blender as a Python module, in a Python of its own."""
    python = ROOT / "build" / folder / "bin" / "python"
    if not os.path.exists(python):
        pytest.skip(f"the Python module bpy is not installed in build/{folder} (scripts/test does)")

    def command(script, arguments, blend, factory):
        return [str(python), str(ROOT / "tests" / "blender" / "run_in_bpy.py"), str(blend or ""), str(script), *arguments]

    return command


def blender_module_lts():
    """The last Blender 4 with long-term support, in the same way."""
    return blender_module("bpy-lts")


@pytest.fixture(scope="session", params=[blender_program, blender_module_lts, blender_module], ids=["blender", "lts", "bpy"])
def blender(request):
    """Runs a Python script in a Blender, in an empty scene: in Debian's, in the last 4.x, and in a current one."""
    command = request.param()

    def run(script, *arguments, blend=None, factory=True, environment=None):
        process = subprocess.run(command(script, [str(argument) for argument in arguments], blend, factory), capture_output=True, text=True,
                                 env={**os.environ, **(environment or {})})
        assert process.returncode == 0, process.stdout[-4000:] + process.stderr[-4000:]
        return process.stdout

    return run


@pytest.fixture(scope="session")
def manifest_of():
    return lambda bake: json.loads((pathlib.Path(bake) / "bake.json").read_text())


def pytest_collection_modifyitems(items):
    """The longest first, so that no processor is idle at the end."""
    first = ("scenarios", "slurm", "batch", "blender")
    place = {name: i for i, name in enumerate(first)}
    items.sort(key=lambda item: place.get(pathlib.Path(item.fspath).parent.name, len(first)))
