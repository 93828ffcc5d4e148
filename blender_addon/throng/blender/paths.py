# SPDX-License-Identifier: Apache-2.0
"""Paths as a .blend keeps them."""
import bpy


def stored_path(path, relative):
    if not relative or not bpy.data.filepath:
        return path
    try:
        return bpy.path.relpath(path)
    except ValueError:  # another drive on Windows
        return path
