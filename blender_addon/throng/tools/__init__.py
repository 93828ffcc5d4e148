# SPDX-License-Identifier: Apache-2.0
"""What changes a scene and its crowds: import, re-load, how crowds and their ground are shown, shots, light and the film look."""
