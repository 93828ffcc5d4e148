# SPDX-License-Identifier: Apache-2.0
"""Authoring: roads, walls, areas, flows and formations are drawn in Blender, baked by `throng`,
and return as a crowd."""
