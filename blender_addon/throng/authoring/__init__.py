# SPDX-License-Identifier: Apache-2.0
"""Authoring: roads, walls, areas, flows and formations are drawn in Blender, baked by `throng`, and come back as a crowd."""


def _parts():
    from . import operators, properties

    return (properties, operators)


def register():
    for part in _parts():
        part.register()


def unregister():
    for part in reversed(_parts()):
        part.unregister()
