# SPDX-License-Identifier: Apache-2.0
"""Where the things of a set are, and their shapes. Pure Python: no Blender, no numpy."""
