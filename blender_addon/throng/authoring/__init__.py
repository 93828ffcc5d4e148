# SPDX-License-Identifier: Apache-2.0
"""Authoring: roads, walls, areas, flows and formations are drawn in Blender, baked by `throng`, and come back as a crowd."""


def _parts():
    from . import bake_operator, operators, overlay, panels, properties

    return (properties, operators, bake_operator, overlay, panels)


def register():
    for part in _parts():
        part.register()


def unregister():
    for part in reversed(_parts()):
        part.unregister()
