# SPDX-License-Identifier: Apache-2.0
"""Overrides: changes to single people of a crowd, as a layer over the bake that a bake made again keeps."""
