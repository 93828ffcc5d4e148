# SPDX-License-Identifier: Apache-2.0
"""What people have on their heads: hair, beards, caps, scarves. Pure Python."""
from dataclasses import dataclass

from .mesh_builder import ring
from .people import EXTRA

_OPEN = (False, False)


@dataclass(frozen=True)
class Head:
    """Where a figure's head is."""
    figure: object
    at: object  # at(x, y, z): a point beside the middle of the head, m for a head of standard size
    x: tuple    # forward
    y: tuple    # to the left
    s: float    # size beside the standard

    @property
    def mesh(self):
        return self.figure.mesh

    @property
    def hair(self):
        return self.figure.hair_material

    def level(self, z, rx, ry, back=0.0):
        """A ring round the head."""
        return ring(self.at(back, 0.0, z), self.x, self.y, rx * self.s, ry * self.s)

    def tilted(self, z, back, rx, ry, tilt):
        """One that is higher in front by `tilt`."""
        x, y, long, wide = self.x, self.y, rx * self.s, ry * self.s
        return (*self.at(back, 0.0, z), x[0] * long, x[1] * long, tilt * long, y[0] * wide, y[1] * wide, 0.0)


def add_hair(head):
    if head.figure.person.beard:
        _beard(head)
    _HAIR[head.figure.person.hair](head)


def _beard(head):
    rings = ((-0.128, 0.020, 0.020, 0.040), (-0.112, 0.056, 0.048, 0.030), (-0.080, 0.074, 0.062, 0.026),
             (-0.040, 0.070, 0.069, 0.016))
    head.mesh.loft([head.level(*each) for each in rings], head.hair, 12, caps=(True, False), until=1)


def _bald(head):
    """Hair round the back only."""
    rings = ((-0.05, 0.068, 0.072), (0.0, 0.080, 0.0795), (0.03, 0.079, 0.078))
    head.mesh.loft([head.level(*each) for each in rings], head.hair, 12, caps=_OPEN, until=1)


_CROWN = ((0.115, -0.006, 0.077, 0.062), (0.132, -0.008, 0.040, 0.034))


def _short(head, material=None, crown=_CROWN):
    """A cap of hair, or one over it: low at the nape, high at the brow, so rings are tilted backwards."""
    rings = ((-0.045, -0.030, 0.080, 0.079), (0.0, -0.016, 0.096, 0.083), (0.045, -0.007, 0.104, 0.085),
             (0.085, -0.004, 0.100, 0.080), *crown)
    head.mesh.loft([head.tilted(*each, 0.42 if each[0] < 0.06 else 0.147) for each in rings],
                   head.hair if material is None else material, 12)


def _below_cap(head):
    head.mesh.loft([head.level(-0.05, 0.076, 0.078, -0.03), head.level(0.02, 0.076, 0.078, -0.03)], head.hair, 12,
                   caps=(True, False), until=0)


def _cap(head):
    """With a peak."""
    _short(head, EXTRA)
    _below_cap(head)
    peak = ((0.10, 0.062, 0.05, 0.062), (0.125, 0.054, 0.055, 0.058))
    head.mesh.loft([head.level(z, rx, ry, x) for x, z, rx, ry in peak], EXTRA, 10)


def _flat_cap(head):
    """It falls forward over its peak, and covers the crown."""
    _short(head, crown=())
    _below_cap(head)
    rings = ((0.052, 0.024, 0.122, 0.092, -0.05), (0.066, 0.026, 0.138, 0.104, -0.08),
             (0.104, 0.004, 0.122, 0.098, -0.20), (0.134, -0.012, 0.070, 0.058, -0.20))
    head.mesh.loft([head.tilted(*each) for each in rings], EXTRA, 12)


def _long(head):
    _short(head)
    widths = (0.078, 0.086, 0.088, 0.084, 0.074, 0.05)
    rings = [head.level(0.02 - 0.062 * k, 0.062 - 0.004 * k, width, -0.045 - 0.012 * k)
             for k, width in enumerate(widths)]
    head.mesh.loft(rings, head.hair, 12)


def _bun(head):
    _short(head)
    head.mesh.ball(head.at(-0.115, 0, 0.055), (0.046 * head.s, 0.05 * head.s, 0.046 * head.s), head.hair, 8, 4)


def _tail(head):
    _short(head)
    profile = [(0, 0.020 * head.s), (0.15, 0.036 * head.s), (0.55, 0.034 * head.s), (1, 0.012 * head.s)]
    head.mesh.limb(head.at(-0.085, 0, 0.06), head.at(-0.165, 0, -0.14), profile, head.hair, 8, caps=(False, True))


def _headscarf(head):
    """Round the face, over hair and neck, down to the shoulders; the face looks out."""
    figure = head.figure
    rings = ((-0.150, -0.014, 0.086, 0.090, 0.0), (-0.112, -0.024, 0.078, 0.080, 0.30),
             (-0.060, -0.032, 0.080, 0.082, 0.50), (0.000, -0.024, 0.096, 0.086, 0.60),
             (0.050, -0.010, 0.106, 0.088, 0.50), (0.090, -0.006, 0.103, 0.083, 0.20),
             (0.120, -0.008, 0.080, 0.064, 0.10), (0.138, -0.010, 0.040, 0.034, 0.0))
    head.mesh.loft([head.tilted(*each) for each in rings], EXTRA, 12, caps=(False, True))
    shoulders = ((0.520, 0.084, 0.098, -0.008), (0.470, 0.120, 0.158, -0.004), (0.400, 0.142 * figure.g, 0.166, 0.004))
    neck = head.level(-0.118, 0.068, 0.072, 0.012)
    head.mesh.loft([neck, *(figure.trunk_ring(*each) for each in shoulders)], EXTRA, 12, 0.0, _OPEN)


_HAIR = {"short": _short, "long": _long, "bun": _bun, "tail": _tail, "bald": _bald, "cap": _cap, "flat cap": _flat_cap,
         "headscarf": _headscarf}
