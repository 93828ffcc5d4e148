#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Packs the Blender add-on as a zip that installs in Blender 3.4 and later.

Usage: build_addon.py [throng-blender.zip]
"""
import pathlib
import sys
import zipfile

SOURCE = pathlib.Path(__file__).resolve().parent.parent / "blender_addon"


def main():
    target = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else "throng-blender.zip")
    with zipfile.ZipFile(target, "w", zipfile.ZIP_DEFLATED) as archive:
        for path in sorted((SOURCE / "throng").rglob("*")):
            if path.suffix in (".py", ".toml"):
                entry = zipfile.ZipInfo(str(path.relative_to(SOURCE)), (2026, 1, 1, 0, 0, 0))  # the same zip from the same files
                entry.external_attr = 0o644 << 16
                archive.writestr(entry, path.read_bytes(), zipfile.ZIP_DEFLATED)
    print(target)


main()
