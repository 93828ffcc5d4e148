#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Packs the Blender add-on, with the layout's schema, as a zip that installs in Blender 3.4 and later.
Usage: build_addon.py [throng-blender.zip]"""
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


def main():
    target = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else "throng-blender.zip")
    with zipfile.ZipFile(target, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, path in sorted(files().items()):
            entry = zipfile.ZipInfo(name, THE_SAME_TIME)
            entry.external_attr = 0o644 << 16
            archive.writestr(entry, path.read_bytes(), zipfile.ZIP_DEFLATED)
    print(target)


main()
