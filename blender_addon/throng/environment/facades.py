# SPDX-License-Identifier: Apache-2.0
"""What facades are put together from: openings with reveals, sashes, shop windows, doors, ledges. Everything is in a
facade's own frame: u along it, `out` in front of it, z up, in metres."""
from . import materials, rooms
from .shapes import direction

DOORS = [(0.055, 0.012, 0.010), (0.010, 0.035, 0.026), (0.012, 0.020, 0.050), (0.085, 0.048, 0.024)]
AWNINGS = [(0.20, 0.030, 0.030), (0.030, 0.085, 0.065), (0.040, 0.060, 0.130), (0.32, 0.25, 0.13)]


def awning_of(number):
    return materials.plain(f"awning {number % len(AWNINGS)}", AWNINGS[number % len(AWNINGS)], 0.8)


class Facade:
    """One side of a house, from `a` to `b` with the house on the left."""

    def __init__(self, shape, a, b, number):
        self.shape, self.a, self.number = shape, a, number
        self.along, self.size = direction(a, b)
        self.outward = (self.along[1], -self.along[0])
        self.first_room = number % 400  # rooms round a corner are others

    def at(self, u, out, z):
        return (self.a[0] + self.along[0] * u + self.outward[0] * out,
                self.a[1] + self.along[1] * u + self.outward[1] * out, z)

    def quad(self, u, z, out, material, places=None):
        """A rectangle that looks outwards, from (u[0], z[0]) to (u[1], z[1])."""
        self.shape.face([self.at(u[0], out, z[0]), self.at(u[1], out, z[0]), self.at(u[1], out, z[1]),
                         self.at(u[0], out, z[1])], material, places)

    def box(self, u, z, out, material, bottom=False):
        """A box without a back, `out` from and to. Without a bottom, unless it is seen from below."""
        (u0, u1), (z0, z1), (near, far) = u, z, out
        self.quad(u, z, far, material)
        for faces in ([(u0, near, z0), (u0, far, z0), (u0, far, z1), (u0, near, z1)],
                      [(u1, far, z0), (u1, near, z0), (u1, near, z1), (u1, far, z1)],
                      [(u0, far, z1), (u1, far, z1), (u1, near, z1), (u0, near, z1)],
                      [(u0, near, z0), (u1, near, z0), (u1, far, z0), (u0, far, z0)])[:4 if bottom else 3]:
            self.shape.face([self.at(*corner) for corner in faces], material)

    def hole(self, cell, opening, depth, wall, reveal):
        """A piece of wall with an opening. @param cell, opening ((u, u), (z, z))"""
        (u, z), (inner_u, inner_z) = cell, opening
        for piece in ((u, (z[0], inner_z[0])), (u, (inner_z[1], z[1])), ((u[0], inner_u[0]), inner_z),
                      ((inner_u[1], u[1]), inner_z)):
            if piece[0][1] - piece[0][0] > 1e-4 and piece[1][1] - piece[1][0] > 1e-4:
                self.quad(*piece, 0.0, wall)
        corners = [(inner_u[0], inner_z[0]), (inner_u[1], inner_z[0]), (inner_u[1], inner_z[1]),
                   (inner_u[0], inner_z[1])]
        for (ua, za), (ub, zb) in zip(corners, corners[1:] + corners[:1]):
            self.shape.face([self.at(ua, 0.0, za), self.at(ub, 0.0, zb), self.at(ub, -depth, zb),
                             self.at(ua, -depth, za)], reveal)

    def pane(self, u, z, out, kind, room, corner):
        """Glass with a room behind. @param room (column, storey); corner (u, z) of the room's lower left corner"""
        form = rooms.FORMS[kind]
        shift = ((self.first_room + room[0]) * form.width - corner[0], room[1] * form.height - corner[1])
        self.quad(u, z, out, rooms.pane(kind),
                  [(p + shift[0], q + shift[1]) for p, q in ((u[0], z[0]), (u[1], z[0]), (u[1], z[1]), (u[0], z[1]))])

    def sashes(self, u, z, out, frame, panes, room):
        """A frame, and panes in it side by side: a row for each of `panes`, from below, as (count, up to which z).
        @param room arguments of pane() after `out`"""
        self.quad(u, z, out, frame)
        low = z[0] + 0.06
        for count, high in panes:
            width = (u[1] - u[0] - 0.06 * (count + 1)) / count
            for i in range(count):
                start = u[0] + 0.06 + i * (width + 0.06)
                self.pane((start, start + width), (low, high - 0.03), out + 0.012, *room)
            low = high + 0.03

    def door(self, middle, width, high, out, number, surround):
        """Two leaves with panels and handles, a light above, a step; it stands in an opening from 0 to `high`."""
        which = number % len(DOORS)
        leaf = materials.plain(f"door {which}", DOORS[which], 0.35)
        inset = materials.plain(f"door panel {which}", tuple(0.55 * c for c in DOORS[which]), 0.45)
        brass = materials.plain("brass", (0.45, 0.30, 0.10), 0.3)
        half, top = 0.5 * width, high - 0.62

        def quad(shift, size, low, until, front, material):
            self.quad((middle + shift - 0.5 * size, middle + shift + 0.5 * size), (low, until), out + front, material)

        quad(0.0, width, 0.0, high, 0.0, materials.plain("window frame", (0.06, 0.058, 0.055), 0.5))
        quad(0.0, width - 0.14, top + 0.06, high - 0.08, 0.006, materials.glass())
        for side in (-1.0, 1.0):
            quad(side * 0.5 * half, half - 0.05, 0.12, top, 0.012, leaf)
            for low, until in ((0.30, 0.94), (1.10, top - 0.18)):
                quad(side * 0.5 * half, half - 0.26, low, until, 0.018, inset)
            quad(side * 0.06, 0.03, 1.00, 1.16, 0.055, brass)
        self.box((middle - half - 0.2, middle + half + 0.2), (0.0, 0.13), (0.0, 0.30), surround)

    def awning(self, u, high, number, reach=1.1, drop=0.62):
        """Cloth on a slope, with a valance and closed ends."""
        cloth, (u0, u1), low = awning_of(number), u, high - drop
        self.shape.face([self.at(u0, 0.06, high), self.at(u0, reach, low), self.at(u1, reach, low),
                         self.at(u1, 0.06, high)], cloth)
        self.quad(u, (low - 0.2, low), reach, cloth)
        for end in u:
            self.shape.face([self.at(end, 0.06, high), self.at(end, 0.06, low), self.at(end, reach, low)], cloth)

    def downpipe(self, u, high):
        metal = materials.plain("downpipe", (0.11, 0.11, 0.105), 0.45)
        self.box((u - 0.05, u + 0.05), (0.15, high), (0.04, 0.14), metal)
        for z in (0.5, 0.35 * high, 0.7 * high):
            self.box((u - 0.075, u + 0.075), (z, z + 0.05), (0.0, 0.155), metal)
        self.box((u - 0.14, u + 0.14), (high - 0.3, high), (0.0, 0.24), metal)


def bays(size, bay, margin=0.6):
    """(count, where the first begins) of bays along a facade, in its middle."""
    count = max(0, int((size - 2.0 * margin) / bay))
    return count, 0.5 * (size - count * bay)
