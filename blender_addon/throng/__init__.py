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

try:
    import bpy  # noqa: F401
except ImportError:  # what needs no Blender is of use without it, too
    _PARTS = ()
else:
    from .authoring import (
        bake_operator, behaviour_panel, given_panel, operators as authoring_operators, overlay, panels, preferences,
        properties, seat_drawing, seat_panel)
    from .characters import operators as characters_operators
    from .layers import operators as layers_operators
    from .live import operators as live_operators, panel as live_panel
    from .motions import operators as motions_operators
    from .overrides import operators as overrides_operators
    from .tools import cells, close, export, export_operators, ground, levels, near, operators, staging
    from .tools.export import glTF2_pre_export_callback  # noqa: F401, Blender's glTF exporter looks for it here

    # What registers classes of its own, in order: panels appear in it.
    _PARTS = (preferences, operators, staging, cells, levels, near, close, ground, properties, authoring_operators,
              bake_operator, overlay, seat_drawing, panels, seat_panel, behaviour_panel, given_panel, live_operators,
              live_panel, characters_operators, motions_operators, overrides_operators, layers_operators,
              export_operators, export)


def register():
    for part in _PARTS:
        part.register()


def unregister():
    for part in reversed(_PARTS):
        part.unregister()
