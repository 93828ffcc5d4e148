# SPDX-License-Identifier: Apache-2.0
"""Throng for Blender: imports crowds baked by `throng bake`. Playback is native: no Python runs at render time."""

bl_info = {
    "name": "Throng",
    "description": "Import crowds baked by Throng; they play back and render without the add-on",
    "author": "The Throng developers",
    "version": (0, 1, 0),
    "blender": (3, 4, 0),
    "location": "File > Import > Throng bake (bake.json)",
    "category": "Import-Export",
}


def _parts():
    """The modules that register classes of their own, in order."""
    from . import authoring, cells, ground, levels, operators, overrides, preferences, staging
    from .characters import operators as characters

    return (preferences, operators, staging, cells, levels, ground, authoring, characters, overrides)


def register():
    for part in _parts():
        part.register()


def unregister():
    for part in reversed(_parts()):
        part.unregister()
