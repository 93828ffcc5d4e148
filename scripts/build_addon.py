#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Packs the Blender add-on, with the layout's schema, as a zip that installs in Blender 3.4 and later.
Usage: build_addon.py [throng-blender.zip] [--bodies FILE.npz]
--bodies: with that library of bodies (scripts/body_library.py), so that crowds are people shaped from it"""
import argparse
import os
import pathlib
import sys
import zipfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
SOURCE = ROOT / "blender_addon"
SCHEMA = ROOT / "authoring" / "layout" / "throng-layout.schema.json"  # whose limits and defaults the fields have
THE_SAME_TIME = (2026, 1, 1, 0, 0, 0)  # the same zip from the same files


def files():
    """{name in the zip: file}"""
    code = [path for path in (SOURCE / "throng").rglob("*") if path.suffix in (".py", ".toml")]
    named = {path.relative_to(SOURCE).as_posix(): path for path in code}
    return {**named, f"throng/authoring/{SCHEMA.name}": SCHEMA}


def files_of_bodies(library):
    """{name in the zip: content} of a library of bodies, its licence beside it."""
    expected = "expected a library that scripts/body_library.py has made"
    try:
        with zipfile.ZipFile(library) as arrays:
            licence = arrays.read("licence.npy")
            arrays.getinfo("target_offsets.npy")
    except OSError as error:
        sys.exit(f"build_addon.py: {library} cannot be read ({error.strerror}): {expected}")
    except (zipfile.BadZipFile, KeyError):
        sys.exit(f"build_addon.py: {library} holds no bodies: {expected}")
    text = licence[10 + int.from_bytes(licence[8:10], "little"):].decode("utf-32-le")  # after the header of an .npy
    return {"throng/people/bodies.npz": library.read_bytes(), "throng/people/LICENSE-bodies.md": text.encode()}


def pack(target, contents):
    """Whole or not at all."""
    part = target.with_name(target.name + ".part")
    try:
        with zipfile.ZipFile(part, "w", zipfile.ZIP_DEFLATED) as archive:
            for name, content in sorted(contents.items()):
                entry = zipfile.ZipInfo(name, THE_SAME_TIME)
                entry.external_attr = 0o644 << 16
                archive.writestr(entry, content, zipfile.ZIP_DEFLATED)
        os.replace(part, target)
    except OSError as error:
        part.unlink(missing_ok=True)
        sys.exit(f"build_addon.py: {target} cannot be written: {error.strerror}")


def main():
    parser = argparse.ArgumentParser(prog="build_addon.py", description="Packs the Blender add-on.")
    parser.add_argument("target", nargs="?", default="throng-blender.zip", type=pathlib.Path)
    parser.add_argument("--bodies", metavar="FILE.npz", type=pathlib.Path, help="a library of bodies to pack with it")
    options = parser.parse_args()
    bodies = files_of_bodies(options.bodies) if options.bodies else {}
    pack(options.target, {**{name: path.read_bytes() for name, path in files().items()}, **bodies})
    print(options.target)


main()
