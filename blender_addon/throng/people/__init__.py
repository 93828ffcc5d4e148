# SPDX-License-Identifier: Apache-2.0
"""People shaped from a library of bodies (scripts/body_library.py): body, clothes, hair, and how they walk.

All geometry is numpy and needs no Blender, apart from materials.py and figures.py; the Python package shares it, by
links in python/src/throng_io. Metres, x forward, y to the left, z up. The library's base mesh is the map of everything:
what is cut out of bodies and clothes is told by places on it, so that one rule fits everybody.
"""
