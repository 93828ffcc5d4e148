# SPDX-License-Identifier: Apache-2.0
"""Small helpers over Blender itself, whose interface changes from version to version. They know nothing of crowds."""
