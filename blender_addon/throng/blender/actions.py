# SPDX-License-Identifier: Apache-2.0
"""Animation curves: actions have slots from Blender 4.4 on, and no curves of their own from 5.0 on."""


def curves_of(action):
    """All curves of an action, whatever they move."""
    if hasattr(action, "fcurves"):
        return list(action.fcurves)
    return [curve for layer in action.layers for strip in layer.strips for bag in strip.channelbags
            for curve in bag.fcurves]
