#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes examples/hillside.glb: a hollow with a level floor in a hill that falls to the west.

Usage: make_hillside.py
"""
import math
import pathlib

import terrain_glb

ROOT = pathlib.Path(__file__).resolve().parent.parent
CELL = 1.0             # m
HALF = 34.0            # m
FLOOR, SLOPE = 9.0, 0.3  # m, the floor's radius; rise over run behind it


def height(x, y):
    away = max(0.0, math.hypot(x, y) - FLOOR)
    bank = SLOPE * away * away / (away + 2.0)  # it begins gently
    side = min(1.0, away / 6.0)                # the floor is level
    return bank + side * (0.05 * x + 0.22 * math.sin(0.45 * x + 0.6) * math.sin(0.38 * y))


def main():
    count = round(2.0 * HALF / CELL) + 1
    places = [(-HALF + i * CELL, -HALF + j * CELL) for j in range(count) for i in range(count)]
    corners = []
    for j in range(count - 1):
        for i in range(count - 1):
            a = j * count + i
            corners += [a, a + 1, a + count + 1, a, a + count + 1, a + count]
    terrain_glb.write(ROOT / "examples" / "hillside.glb", "scripts/make_hillside.py",
                      [("hillside", [(x, y, height(x, y)) for x, y in places], corners)])


if __name__ == "__main__":
    main()
