# SPDX-License-Identifier: Apache-2.0
"""What stands on pavements: benches, bins, bollards."""
import math

from . import materials
from .shapes import Shape


def _metal():
    return materials.plain("street metal", (0.025, 0.027, 0.028), 0.45)


def _round(radius, count=12):
    return [(radius * math.cos(math.tau * i / count), radius * math.sin(math.tau * i / count)) for i in range(count)]


def build_bench():
    """1.7 m along x; people who sit look towards -y."""
    shape, metal = Shape("Throng bench"), _metal()
    wood = materials.mottled("bench wood", (0.10, 0.055, 0.028), (0.19, 0.115, 0.062), 5.0, 0.65, 60.0)
    for x in (-0.65, 0.65):
        shape.strip((x, -0.24), (x, 0.22), 0.03, 0.0, 0.06, metal)
        shape.strip((x, -0.20), (x, -0.14), 0.03, 0.0, 0.42, metal)
        shape.strip((x, 0.14), (x, 0.20), 0.03, 0.0, 0.82, metal)
        shape.strip((x, -0.22), (x, 0.20), 0.03, 0.39, 0.42, metal)
    for y in (-0.20, -0.10, 0.0, 0.10):
        shape.strip((-0.85, y), (0.85, y), 0.042, 0.42, 0.455, wood)
    for z in (0.55, 0.68, 0.80):
        shape.strip((-0.85, 0.125), (0.85, 0.125), 0.015, z, z + 0.10, wood)
    return shape.to_mesh()


def build_bin():
    shape = Shape("Throng bin")
    green = materials.plain("bin", (0.018, 0.045, 0.032), 0.5)
    shape.prism(_round(0.20), 0.0, 0.06, _metal())
    shape.prism(_round(0.23), 0.06, 0.80, green)
    shape.prism(_round(0.25), 0.80, 0.86, _metal())
    shape.prism(_round(0.19), 0.86, 0.94, materials.plain("bin mouth", (0.006, 0.006, 0.006), 0.9))
    shape.prism(_round(0.25), 0.94, 1.00, _metal())
    return shape.to_mesh()


def build_bollard():
    shape, metal = Shape("Throng bollard"), _metal()
    shape.prism(_round(0.10), 0.0, 0.10, metal)
    shape.prism(_round(0.065), 0.10, 0.88, metal)
    shape.prism(_round(0.067), 0.72, 0.79, materials.plain("bollard band", (0.55, 0.55, 0.53), 0.4))
    shape.prism(_round(0.085), 0.88, 0.97, metal)
    return shape.to_mesh()
