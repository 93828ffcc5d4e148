# SPDX-License-Identifier: Apache-2.0
"""What all Python tests share: the binary, bakes (each made once), and where other tools are."""
import json
import os
import pathlib
import resource
import shutil
import subprocess
import sys

import filelock
import pytest

ROOT = pathlib.Path(__file__).resolve().parent.parent
EXAMPLES = ROOT / "examples"
sys.path.insert(0, str(ROOT / "python" / "src"))  # the package throng_io, as it lies there
os.environ.setdefault("THRONG_CACHE", str(ROOT / "build" / "kept"))  # what is worked out of people, and not the user's


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


VALIDATE = """
const fs = require('fs'), path = require('path');
const validator = require(path.join(process.env.THRONG_NODE_MODULES, 'gltf-validator'));
validator.validateBytes(new Uint8Array(fs.readFileSync(process.argv[1])))
    .then(report => console.log(JSON.stringify(report.issues)));
"""


def khronos_issues(glb):
    """What Khronos' validator says of a file."""
    modules = os.environ.get("THRONG_NODE_MODULES", str(ROOT / "build" / "node" / "node_modules"))
    if not os.path.isdir(os.path.join(modules, "gltf-validator")):
        pytest.skip("the npm package gltf-validator is not installed")
    result = subprocess.run(["node", "-e", VALIDATE, str(glb)], capture_output=True, text=True,
                            env={**os.environ, "THRONG_NODE_MODULES": modules})
    return json.loads(result.stdout)


def chromium():
    """The browser's program, or None."""
    return shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")


@pytest.fixture(scope="module")
def browser():
    playwright = pytest.importorskip("playwright.sync_api", reason="playwright is not installed")
    if not chromium():
        pytest.skip("Chromium is not installed")
    with playwright.sync_playwright() as player:
        opened = player.chromium.launch(executable_path=chromium(), args=["--no-sandbox"])
        yield opened
        opened.close()


@pytest.fixture(scope="session")
def confined(throng):
    """Like throng(), but with an end to its memory and to its time on a processor: it has to end by itself."""

    def run(*arguments, megabytes=2000, seconds=10, expect=0, **options):
        def limit():
            resource.setrlimit(resource.RLIMIT_DATA, (megabytes << 20, megabytes << 20))
            resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds))

        finished = throng(*arguments, expect=expect, preexec_fn=limit, timeout=60 * seconds, **options)
        assert "not enough memory" not in finished.stderr
        return finished

    return run


@pytest.fixture(scope="session")
def once(tmp_path_factory):
    """once("street", make) is a folder that make(folder) has filled, once for all processes that tests run in. Tests
    only read it."""
    folder = tmp_path_factory.getbasetemp()
    if "PYTEST_XDIST_WORKER" in os.environ:
        folder = folder.parent  # which the processes share
    folder /= "shared"
    folder.mkdir(exist_ok=True)

    def folder_of(name, make):
        made = folder / f"{name}.made"
        with filelock.FileLock(folder / f"{name}.lock"):
            if not made.exists():
                shutil.rmtree(folder / name, ignore_errors=True)  # of one that failed
                (folder / name).mkdir()
                make(folder / name)
                made.touch()
        return folder / name

    return folder_of


@pytest.fixture(scope="session")
def bakes(throng, once):
    """bakes("intersection") is the folder of that example's bake."""

    def bake(name):
        extra = {"intersection": ["--diagrams", "480"], "station": []}.get(name, ["--no-gltf"])
        make = lambda folder: throng("bake", EXAMPLES / f"{name}.json", "-o", folder / name, "-q", *extra)
        return once(f"example-{name}", make) / name

    return bake


@pytest.fixture(scope="session")
def faults(once):
    """The library that makes machines fail (tests/bake/machine_faults.c)."""
    compiler = shutil.which("cc")
    if not compiler:
        pytest.skip("no C compiler here")
    source = ROOT / "tests" / "bake" / "machine_faults.c"
    make = lambda folder: subprocess.run([compiler, "-shared", "-fPIC", "-O1", "-Wall", "-o", folder / "faults.so",
                                          source, "-ldl"], check=True)
    return once("machine-faults", make) / "faults.so"


@pytest.fixture(scope="session")
def bodies():
    """The library of bodies: what THRONG_BODIES says, or what scripts/test has fetched."""
    library = pathlib.Path(os.environ.get("THRONG_BODIES") or ROOT / "build" / "bodies.npz")
    if not library.is_file():
        pytest.skip(f"there is no library of bodies: {library} (scripts/body_library.py makes it)")
    return library


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
        return [str(python), str(ROOT / "tests" / "blender" / "run_in_bpy.py"), str(blend or ""), str(script),
                *arguments]

    return command


def blender_module_lts():
    """The last Blender 4 with long-term support, in the same way."""
    return blender_module("bpy-lts")


@pytest.fixture(scope="session", params=[blender_program, blender_module_lts, blender_module],
                ids=["blender", "lts", "bpy"])
def blender(request):
    """Runs a Python script in a Blender, in an empty scene: in Debian's, in the last 4.x, and in a current one."""
    command = request.param()

    def run(script, *arguments, blend=None, factory=True, environment=None):
        process = subprocess.run(command(script, [str(argument) for argument in arguments], blend, factory),
                                 capture_output=True, text=True,
                                 env={**os.environ, **(environment or {})})
        assert process.returncode == 0, process.stdout[-4000:] + process.stderr[-4000:]
        return process.stdout

    return run


@pytest.fixture(scope="session")
def manifest_of():
    return lambda bake: json.loads((pathlib.Path(bake) / "bake.json").read_text())


def pytest_configure(config):
    config.addinivalue_line("markers", "slow: takes ten seconds or more of a processor, and begins before all others")
    config.addinivalue_line("markers", "quick: one of those that `scripts/test quick` passes")


def shares_a_fixture(item):
    """Whether other tests of its file look at the same, which a Blender or a process of ours makes for them all."""
    if "once" in item.fixturenames and "blender" not in item.fixturenames:
        return False  # all processes share it
    return any(found.scope == "module" for name in item.fixturenames
               for found in item._fixtureinfo.name2fixturedefs.get(name, ()))


@pytest.hookimpl(tryfirst=True)  # before the processes are told of the groups
def pytest_collection_modifyitems(items):
    """The longest first, so that no processor is idle at the end; what only one process can make stays in one."""
    first = ("slurm", "scenarios", "blender", "batch")
    place = {name: i for i, name in enumerate(first)}
    for item in items:
        if "slurm" in item.fixturenames:
            item.add_marker(pytest.mark.xdist_group("slurm"))
        elif shares_a_fixture(item):
            program = item.callspec.params["blender"].__name__ if "blender" in item.fixturenames else "Python"
            item.add_marker(pytest.mark.xdist_group(f"{item.path.name} in {program}"))
        if item.path.parent.name == "house":
            item.add_marker(pytest.mark.quick)
    items.sort(key=lambda item: (item.get_closest_marker("slow") is None, place.get(item.path.parent.name, len(first))))
