#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Builds RVO2 as those who use it from C++ do (Release, OpenMP), and a program that steps it beside Throng.

The source is what the source package of pyrvo 0.4.3 carries; it is fetched from PyPI, checked, and kept in the folder.

Usage: rvo2_peer.py FOLDER   (prints the path of the program: bench/rvo2/rvo2_step.cpp)
"""
import hashlib
import io
import pathlib
import subprocess
import sys
import tarfile
import urllib.request

VERSION = "0.4.3"
SOURCE = ("https://files.pythonhosted.org/packages/3e/b3/301bf89da3220081469a71f16f454a86a14c2d642ec47d4ce829fda9a27b/"
          f"pyrvo-{VERSION}.tar.gz")
SHA256 = "17992088fd781400dd5bd3b8e579237cb1791099b0aa0cc1783a5c8ec597c0cf"
ROOT = pathlib.Path(__file__).resolve().parent.parent


def fetch(folder):
    """@returns where the library's source lies"""
    source = folder / f"pyrvo-{VERSION}" / "pyrvo" / "src"
    if not source.is_dir():
        with urllib.request.urlopen(SOURCE, timeout=60) as answer:
            package = answer.read()
        if hashlib.sha256(package).hexdigest() != SHA256:
            raise SystemExit(f"{SOURCE} is not the package that was expected (sha256 {SHA256})")
        with tarfile.open(fileobj=io.BytesIO(package)) as archive:
            inside = f"pyrvo-{VERSION}/pyrvo/src/"
            archive.extractall(folder, [each for each in archive if each.isfile() and each.name.startswith(inside)])
    return source


def build(folder):
    """@returns the program"""
    folder = pathlib.Path(folder).resolve()
    folder.mkdir(parents=True, exist_ok=True)
    source, made = fetch(folder), folder / "build"
    quiet = {"check": True, "stdout": sys.stderr}
    subprocess.run(["cmake", "-S", ROOT / "bench" / "rvo2", "-B", made, f"-DRVO2_SOURCE={source}"], **quiet)
    subprocess.run(["cmake", "--build", made, "-j2"], **quiet)
    return made / "rvo2_step"


if __name__ == "__main__":
    if len(sys.argv) != 2 or sys.argv[1].startswith("-"):
        raise SystemExit(__doc__)
    print(build(sys.argv[1]))
