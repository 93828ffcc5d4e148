# SPDX-License-Identifier: Apache-2.0
"""Crowds in a scene: which there are, what they say, and the modifiers and nodes that play them."""
