# SPDX-License-Identifier: Apache-2.0
"""Scenes of other programs as layouts, each with a report of what could not be taken over."""
