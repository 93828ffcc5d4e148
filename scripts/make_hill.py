#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes examples/hill.glb: a bank of five metres with steps up its steep end and a long slope up the other.

Usage: make_hill.py
"""
import math
import pathlib

import terrain_glb

ROOT = pathlib.Path(__file__).resolve().parent.parent
CELL = 1.25              # m
LOW, HIGH = (-42.5, -20.0), (42.5, 25.0)
RISE, TREAD, STEPS = 5.0 / 30, 0.4, 30
STAIRS_Y, HALF_WIDTH = -8.0, 3.0


def smoothstep(low, high, value):
    t = min(1.0, max(0.0, (value - low) / (high - low)))
    return t * t * (3.0 - 2.0 * t)


def height(x, y):
    """The bank is steep in the south and gentle in the north."""
    half = 6.0 + 20.0 * smoothstep(-3.0, 9.0, y)
    bank = 5.0 * min(1.0, max(0.0, (x + half) / (2.0 * half)))
    away = smoothstep(4.0, 9.0, abs(y - STAIRS_Y)) * smoothstep(4.0, 8.0, abs(y - 14.0))
    bumps = 0.5 * math.sin(0.31 * x + 0.8) * math.sin(0.27 * y) + 0.25 * math.sin(0.63 * x - 0.4 * y)
    under_the_steps = 0.3 if abs(y - STAIRS_Y) < HALF_WIDTH - 0.2 and -5.6 < x < 5.6 else 0.0
    return bank + away * bumps - under_the_steps


def bank():
    columns, rows = (round((b - a) / CELL) + 1 for a, b in zip(LOW, HIGH))
    points = [(LOW[0] + i * CELL, LOW[1] + j * CELL) for j in range(rows) for i in range(columns)]
    corners = []
    for j in range(rows - 1):
        for i in range(columns - 1):
            a = j * columns + i
            corners += [a, a + 1, a + columns + 1, a, a + columns + 1, a + columns]
    return [(x, y, height(x, y)) for x, y in points], corners


def steps():
    """Treads, risers, and cheeks at both sides."""
    points, corners = [], []

    def quad(*four):
        first = len(points)
        points.extend(four)
        corners.extend(first + k for k in (0, 1, 2, 0, 2, 3))

    south, north = STAIRS_Y - HALF_WIDTH, STAIRS_Y + HALF_WIDTH
    for i in range(STEPS):
        x, z = -6.0 + i * TREAD, (i + 1) * RISE
        quad((x, north, z - RISE), (x, south, z - RISE), (x, south, z), (x, north, z))
        quad((x, south, z), (x + TREAD, south, z), (x + TREAD, north, z), (x, north, z))
        for y, order in ((south, 1), (north, -1)):
            side = [(x, y, z - 1.2), (x + TREAD, y, z - 1.2), (x + TREAD, y, z), (x, y, z)]
            quad(*side[::order])
    return points, corners


def main():
    terrain_glb.write(ROOT / "examples" / "hill.glb", "scripts/make_hill.py", [("bank", *bank()), ("steps", *steps())])


main()
