# SPDX-License-Identifier: Apache-2.0
"""Geometry in the plane."""
import math


def along_of(a, b):
    """Unit vector and length from a to b."""
    dx, dy = b[0] - a[0], b[1] - a[1]
    size = math.hypot(dx, dy)
    return ((dx / size, dy / size) if size > 1e-9 else (1.0, 0.0)), size


def inside(polygon, point):
    hit = False
    for a, b in zip(polygon, polygon[1:] + polygon[:1]):
        if (a[1] > point[1]) != (b[1] > point[1]):
            hit ^= point[0] < (b[0] - a[0]) * (point[1] - a[1]) / (b[1] - a[1]) + a[0]
    return hit


def distance_to(a, b, point):
    """From a point to the stretch from a to b."""
    dx, dy = b[0] - a[0], b[1] - a[1]
    square = dx * dx + dy * dy
    t = 0.0 if square < 1e-12 else min(1.0, max(0.0, ((point[0] - a[0]) * dx + (point[1] - a[1]) * dy) / square))
    return math.hypot(point[0] - a[0] - t * dx, point[1] - a[1] - t * dy)


def area(ring):
    """Positive where a ring goes counter-clockwise."""
    return 0.5 * sum(a[0] * b[1] - b[0] * a[1] for a, b in zip(ring, ring[1:] + ring[:1]))
