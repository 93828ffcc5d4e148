# SPDX-License-Identifier: Apache-2.0
"""Crowds for engines: glTF with skeletons, kits of characters, and textures that bend people."""
