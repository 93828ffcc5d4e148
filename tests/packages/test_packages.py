# SPDX-License-Identifier: Apache-2.0
"""What is installed, and what is packed: it is all there, and works where it has been moved to."""
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import zipfile

import pytest

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
COMPILED_IN = ["libcli11-dev.txt", "nlohmann-json3-dev.txt"]


def run(*words, **options):
    return subprocess.run([str(word) for word in words], check=True, capture_output=True, text=True, **options).stdout


@pytest.fixture(scope="module")
def build(throng):
    folder = pathlib.Path(throng.binary).resolve().parent
    if not (folder / "CPackConfig.cmake").exists() or not shutil.which("cmake"):
        pytest.skip(f"{folder} is no build folder")
    if "SANITIZE:BOOL=ON" in (folder / "CMakeCache.txt").read_text():
        pytest.skip("what is built with sanitizers is not for others")
    return folder


@pytest.fixture(scope="module")
def installed(build, tmp_path_factory):
    """Where all of it lies after it was moved."""
    folder = tmp_path_factory.mktemp("installs")
    run("cmake", "--install", build, "--prefix", folder / "first", "--strip")
    (folder / "first").rename(folder / "moved to")
    return folder / "moved to"


def completed(installed, *words):
    """What bash offers after these words."""
    script = installed / "share/bash-completion/completions/throng"
    quoted = " ".join(f"'{word}'" for word in ("throng", *words))
    return run("bash", "-c", f"source '{script}'; COMP_WORDS=({quoted}); COMP_CWORD={len(words)}; _throng; "
                             'echo "${COMPREPLY[@]}"').split()


def bakes(program, examples, folder):
    run(program, "bake", examples / "intersection.json", "-o", folder,
        "-q", "--no-gltf", "--set", "simulation.duration=0.2")
    return json.loads((folder / "bake.json").read_text())["frames"]


def test_what_is_installed_works_where_it_was_moved_to(installed, throng, tmp_path):
    assert run(installed / "bin/throng", "--version") == throng("--version").stdout
    assert bakes(installed / "bin/throng", installed / "share/throng/examples", tmp_path / "bake") == 5
    schemas = {json.loads(path.read_text())["$id"] for path in (installed / "share/throng/schemas").iterdir()}
    assert {f"https://throng.example/schema/{kind}-1.json" for kind in
            ("layout", "family", "overrides", "bake", "measure", "result", "batch")} == schemas
    with zipfile.ZipFile(installed / "share/throng/throng-blender.zip") as addon:
        assert "throng/__init__.py" in addon.namelist()
    documents = installed / "share/doc/throng"
    assert "Apache License" in (documents / "copyright").read_text() and (documents / "layout.md").exists()
    if pathlib.Path("/usr/share/doc/libcli11-dev/copyright").exists():
        assert all((documents / "licences" / name).stat().st_size > 500 for name in COMPILED_IN)


def test_shells_complete_commands_options_and_words(installed):
    assert completed(installed, "ba") == ["bake", "batch"]
    assert completed(installed, "bake", "x.json", "--no-g") == ["--no-gltf"]
    assert completed(installed, "batch", "query", "x", "--wh") == ["--where"]
    assert completed(installed, "batch", "x", "--executor", "") == ["local", "slurm"]
    assert completed(installed, "bake", "") == [], "bash looks for files then"
    zsh = (installed / "share/zsh/vendor-completions/_throng").read_text()
    assert zsh.startswith("#compdef throng\n") and "'--resume:Go on from" in zsh
    if shutil.which("zsh"):
        run("zsh", "-n", installed / "share/zsh/vendor-completions/_throng")
    fish = (installed / "share/fish/vendor_completions.d/throng.fish").read_text()
    assert "-n '__fish_seen_subcommand_from batch; and __fish_seen_subcommand_from query' -l where" in fish


def test_the_manual_page_tells_of_every_command_and_option(installed, throng):
    page = (installed / "share/man/man1/throng.1").read_text().replace("\\-", "-")
    commands = re.findall(r"^  (\w+)  ", throng("--help").stdout.split("Subcommands:")[1], re.MULTILINE)
    assert len(commands) > 15
    for name in commands:
        part = page.split(f".SS throng {name}\n")[1].split(".SS ")[0]
        for option in re.findall(r"(?<=[ ,])--[a-z-]+", throng(name, "--help").stdout.split("Subcommands:")[0]):
            assert option in part, f"{name} {option}"
    if shutil.which("groff"):
        told = subprocess.run(["groff", "-man", "-Tutf8", "-ww", installed / "share/man/man1/throng.1"],
                              capture_output=True, text=True, check=True)
        assert told.stderr == "" and "The layout file (- for standard input)" in told.stdout


def test_the_debian_package_is_whole_and_names_what_it_needs(build, tmp_path):
    if not shutil.which("dpkg-shlibdeps") or not shutil.which("cpack"):
        pytest.skip("no tools for Debian packages here")
    run("cpack", "--config", build / "CPackConfig.cmake", "-G", "DEB", "-B", tmp_path, cwd=build)
    package, = tmp_path.glob("throng_*.deb")
    needs = run("dpkg-deb", "-f", package, "Depends")
    assert all(name in needs for name in ("libc6", "libegl1", "libopengl0", "libepoxy0", "libcairo2", "libopenexr"))
    run("dpkg-deb", "-x", package, tmp_path / "root")
    usr = tmp_path / "root/usr"
    assert bakes(usr / "bin/throng", usr / "share/throng/examples", tmp_path / "bake") == 5
    assert (usr / "share/man/man1/throng.1").exists()


def test_the_debian_package_works_in_a_bare_system(build, tmp_path):
    """Installed by apt where there is nothing, used as an ordinary user, and removed: minutes, and 300 MB to fetch."""
    if not os.environ.get("THRONG_TRY_PACKAGE"):
        pytest.skip("fetches 300 MB and takes some minutes: asked for with THRONG_TRY_PACKAGE=1")
    if os.geteuid() != 0 or not shutil.which("mmdebstrap") or not shutil.which("dpkg-shlibdeps"):
        pytest.skip("needs root, mmdebstrap and dpkg-dev")
    run("cpack", "--config", build / "CPackConfig.cmake", "-G", "DEB", "-B", tmp_path, cwd=build)
    package, = tmp_path.glob("throng_*.deb")
    told = run(ROOT / "scripts/try_package", package)
    assert "step: all is well" in told and "left: nothing" in told


def test_a_wheel_carries_the_program(throng, tmp_path):
    """What is put into wheels, from a copy of the sources; with it, nobody has to say where the program is."""
    pytest.importorskip("setuptools", reason="setuptools is not installed")
    for folder in ("python", "blender_addon"):
        shutil.copytree(ROOT / folder, tmp_path / folder, symlinks=True, ignore=shutil.ignore_patterns("__pycache__"))
    program = pathlib.Path(throng.binary).resolve()
    make = [sys.executable, "setup.py", "-q", "build_py", "-d", str(tmp_path / "built")]

    def made(value, **options):
        return subprocess.run(make, cwd=tmp_path / "python", capture_output=True, text=True,
                              env={**os.environ, "THRONG_PROGRAM": value}, **options)

    refused = made("throng")
    assert refused.returncode != 0 and "expected the whole path of a program, found 'throng'" in refused.stderr
    made(str(program), check=True)
    inside = tmp_path / "built/throng_io/bin/throng"
    assert inside.read_bytes() == program.read_bytes()
    clean = {name: value for name, value in os.environ.items() if name not in ("THRONG_BINARY", "PYTHONPATH")}
    found = subprocess.run([sys.executable, "-c", "import throng_io.bakes.program as p; print(p.find_program())"],
                           cwd=tmp_path / "built", env=clean, capture_output=True, text=True, check=True).stdout.strip()
    assert pathlib.Path(found).samefile(inside)
    assert run(found, "--version") == throng("--version").stdout


def test_builds_are_named_after_their_checkout_and_only_theirs(tmp_path):
    if not shutil.which("cmake") or not shutil.which("git"):
        pytest.skip("no cmake, or no git, here")
    source, inner = tmp_path / "build_name.cpp", tmp_path / "checkout" / "unpacked"
    inner.mkdir(parents=True)

    def name(root):
        run("cmake", f"-DOUTPUT={source}", f"-DROOT={root}", "-P", ROOT / "cmake/BuildName.cmake")
        return re.search(r'return "(.*)"', source.read_text())[1]

    def git(*words):
        run("git", "-C", tmp_path / "checkout", "-c", "user.name=a", "-c", "user.email=a@b", *words)

    assert name(tmp_path) == "unknown"
    git("init", "-q")
    (tmp_path / "checkout/file").write_text("1")
    git("add", "file")
    git("commit", "-qm", "first")
    commit = name(tmp_path / "checkout")
    assert re.fullmatch("[0-9a-f]{12}", commit)
    written = source.stat().st_mtime_ns
    assert name(tmp_path / "checkout") == commit and source.stat().st_mtime_ns == written, "nothing to compile again"
    (tmp_path / "checkout/file").write_text("2")
    assert name(tmp_path / "checkout") == f"{commit}-dirty"
    assert name(inner) == "unknown", "that is somebody else's checkout"
