# SPDX-License-Identifier: Apache-2.0
"""What changes a scene and its crowds: import, re-load, how crowds and ground are shown, shots,
light, the film look."""
