# SPDX-License-Identifier: Apache-2.0
"""Houses of three kinds: plastered ones that people live in, brick ones over shops, offices of concrete and glass."""
from . import facing, materials
from .facades import Facade, awning_of, bays
from .roofs import flat_roof, steep_roof

STOREY = 3.5        # m
GROUND_FLOOR = 4.3  # m
BAY = 2.7           # m from window to window


def _trim():
    return materials.mottled("trim", (0.44, 0.42, 0.38), (0.55, 0.53, 0.48), 1.5)


def _dark_frame():
    return materials.plain("window frame", (0.06, 0.058, 0.055), 0.5)


def storeys(height):
    """Where the floors above the ground floor are."""
    return [GROUND_FLOOR + i * STOREY for i in range(max(0, int((height - 0.3 - GROUND_FLOOR) / STOREY)))]


def build_house(shape, outline, height, kind, number, blind=()):
    """A house over an outline, counter-clockwise.

    @param kind one of setting.houses.KINDS
    @param blind numbers of sides that have no windows, as other houses stand there
    """
    side_of, wall, roof = _KINDS[kind]
    face, trim = wall(number), _trim()
    for index, (a, b) in enumerate(zip(outline, outline[1:] + outline[:1])):
        side = Facade(shape, a, b, number % 1000 + 37 * index)
        if index in blind or bays(side.size, BAY)[0] < 1:
            side.quad((0.0, side.size), (0.0, height), 0.0, face)
        else:
            side_of(side, height, face, trim, number)
    roof(shape, outline, height, (face, trim), number, blind)


def _course(side, low, high, out, material, bottom=True):
    """A ledge all along; it goes round corners."""
    side.box((-out, side.size + out), (low, high), (0.0, out), material, bottom)


def _cornice(side, height, trim, reach):
    """Steps that lean out, with blocks below."""
    _course(side, height - 0.55, height - 0.38, 0.30 * reach, trim)
    _course(side, height - 0.20, height - 0.06, 0.75 * reach, trim)
    _course(side, height - 0.06, height + 0.08, reach, trim)
    count = int(side.size / 0.54)
    for i in range(count):
        u = (i + 0.5) * side.size / count
        side.box((u - 0.09, u + 0.09), (height - 0.38, height - 0.20), (0.0, 0.66 * reach), trim)


def _ends(side, height, margin, material, low=0.0):
    """The wall beside the outer bays."""
    for u in ((0.0, margin), (side.size - margin, side.size)):
        side.quad(u, (low, height), 0.0, material)


def _residence(side, height, plaster, trim, number):
    """Single windows with surrounds and sills, a ground floor of ashlar, a door in the middle."""
    (count, margin), stone = bays(side.size, BAY), facing.ashlar(number)
    frame = materials.plain("white frame", (0.55, 0.54, 0.51), 0.5)
    floors, entrance = storeys(height), count // 2
    _ends(side, GROUND_FLOOR, margin, stone)
    _ends(side, height, margin, plaster, GROUND_FLOOR)
    for bay in range(count):
        left = margin + bay * BAY
        u, middle = (left, left + BAY), left + 0.5 * BAY
        if bay == entrance:
            opening = ((middle - 0.8, middle + 0.8), (0.0, 3.2))
            side.hole((u, (0.0, GROUND_FLOOR)), opening, 0.35, stone, stone)
            side.door(middle, 1.6, 3.2, -0.35, side.number, trim)
            side.box((middle - 1.1, middle + 1.1), (3.3, 3.48), (0.0, 0.45), trim, True)
        else:
            _window(side, u, (0.0, GROUND_FLOOR), (1.15, 3.25), stone, frame, trim, (bay, 0))
        for storey, floor in enumerate(floors):
            _window(side, u, (floor, floor + STOREY), (floor + 0.75, floor + 2.75), plaster, frame, trim,
                    (bay, storey + 1))
            if storey == 0 and abs(bay - entrance) < 2:
                _balcony(side, (left + 0.35, left + BAY - 0.35), floor + 0.55)
    top = floors[-1] + STOREY if floors else GROUND_FLOOR
    side.quad((margin, side.size - margin), (top, height), 0.0, plaster)
    _course(side, 0.0, 0.50, 0.06, trim, False)
    _course(side, GROUND_FLOOR - 0.20, GROUND_FLOOR + 0.08, 0.16, trim)
    _cornice(side, height, trim, 0.42)
    side.downpipe(0.35, height - 0.5)


def _window(side, u, z, opening, wall, frame, trim, room):
    """A window with a raised surround, a sill, and a head."""
    inner = (u[0] + 0.70, u[1] - 0.70)
    side.hole((u, z), (inner, opening), 0.16, wall, trim)
    side.sashes(inner, opening, -0.16, frame, ((2, opening[1] - 0.62), (2, opening[1] - 0.06)),
                ("flat", room, (u[0], z[0])))
    for strip in ((inner[0] - 0.14, inner[0]), (inner[1], inner[1] + 0.14)):
        side.box(strip, opening, (0.0, 0.035), trim)
    side.box((inner[0] - 0.22, inner[1] + 0.22), (opening[1], opening[1] + 0.20), (0.0, 0.09), trim, True)
    side.box((inner[0] - 0.18, inner[1] + 0.18), (opening[0] - 0.12, opening[0]), (-0.16, 0.13), trim, True)


def _balcony(side, u, low):
    """A slab with a railing of bars."""
    iron = materials.plain("railing", (0.02, 0.021, 0.023), 0.45)
    side.box(u, (low - 0.14, low), (0.0, 0.75), _trim(), True)
    side.box(u, (low + 0.95, low + 1.0), (0.69, 0.73), iron, True)
    count = int((u[1] - u[0]) / 0.14)
    for i in range(count + 1):
        at = u[0] + (u[1] - u[0] - 0.02) * i / count
        side.quad((at, at + 0.02), (low, low + 0.95), 0.71, iron)
    for end in u:
        side.shape.face([side.at(end, 0.0, low + 0.95), side.at(end, 0.71, low + 0.95), side.at(end, 0.71, low + 1.0),
                         side.at(end, 0.0, low + 1.0)], iron)


def _shops(side, height, bricks, trim, number):
    """Shop windows with signs and awnings below, sashes under stone lintels above."""
    (count, margin), floors = bays(side.size, BAY), storeys(height)
    frame = materials.plain("white frame", (0.55, 0.54, 0.51), 0.5)
    _ends(side, height, margin, bricks)
    bay = 0
    while bay < count:
        left, alone = margin + bay * BAY, bay + 1 == count or (bay + number) % 5 == 4
        if alone:
            _house_door(side, left, bricks, trim, side.number + bay)
        else:
            _shop(side, left, trim, side.number + bay)
        bay += 1 if alone else 2
    for bay in range(count):
        left = margin + bay * BAY
        for storey, floor in enumerate(floors):
            u, opening = (left, left + BAY), (floor + 0.80, floor + 2.70)
            inner = (left + 0.68, left + BAY - 0.68)
            side.hole((u, (floor, floor + STOREY)), (inner, opening), 0.14, bricks, bricks)
            side.sashes(inner, opening, -0.14, frame, ((1, 0.5 * sum(opening)), (2, opening[1] - 0.06)),
                        ("flat", (bay, storey + 1), (left, floor)))
            side.box((inner[0] - 0.2, inner[1] + 0.2), (opening[1], opening[1] + 0.28), (0.0, 0.025), trim, True)
            side.box((inner[0] - 0.1, inner[1] + 0.1), (opening[0] - 0.11, opening[0]), (-0.14, 0.09), trim, True)
    top = floors[-1] + STOREY if floors else GROUND_FLOOR
    side.quad((margin, side.size - margin), (top, height), 0.0, bricks)
    _course(side, GROUND_FLOOR - 0.06, GROUND_FLOOR + 0.12, 0.20, trim)
    for floor in floors[1:]:
        _course(side, floor + 0.05, floor + 0.20, 0.04, trim, False)
    _cornice(side, height, trim, 0.34)
    side.downpipe(side.size - 0.35, height - 0.5)


def _house_door(side, left, wall, trim, number):
    middle = left + 0.5 * BAY
    side.hole(((left, left + BAY), (0.0, GROUND_FLOOR)), ((middle - 0.75, middle + 0.75), (0.0, 3.1)), 0.4, wall, trim)
    side.door(middle, 1.5, 3.1, -0.4, number, trim)
    for strip in ((middle - 0.95, middle - 0.75), (middle + 0.75, middle + 0.95)):
        side.box(strip, (0.0, 3.1), (0.0, 0.06), trim)
    side.box((middle - 1.05, middle + 1.05), (3.1, 3.4), (0.0, 0.14), trim, True)


def _shop(side, left, trim, number):
    """Two bays: a window each side of a door that lies back, a sign above; an awning over most."""
    right, middle, cloth = left + 2.0 * BAY, left + BAY, awning_of(number)
    wood, room = materials.plain(f"shopfront {number % 3}", ((0.020, 0.024, 0.028), (0.050, 0.020, 0.016),
                                                             (0.016, 0.034, 0.028))[number % 3], 0.4), ("shop",)
    corner, high = ((number, 0), (left, 0.0)), 3.28
    for u in ((left, left + 0.22), (right - 0.22, right)):
        side.box(u, (0.0, GROUND_FLOOR - 0.75), (0.0, 0.09), wood)
    side.box((left, right), (GROUND_FLOOR - 0.80, GROUND_FLOOR - 0.06), (0.0, 0.12), cloth, True)
    side.box((left, right), (high + 0.05, GROUND_FLOOR - 0.80), (0.0, 0.07), wood, True)
    for u in ((left + 0.22, middle - 0.65), (middle + 0.65, right - 0.22)):
        side.box(u, (0.0, 0.50), (-0.30, 0.04), wood)
        side.quad(u, (0.50, high + 0.05), -0.012, wood)
        side.pane((u[0] + 0.06, u[1] - 0.06), (0.56, 2.62), 0.0, *room, *corner)
        side.pane((u[0] + 0.06, u[1] - 0.06), (2.69, high), 0.0, *room, *corner)
    for u, out in ((middle - 0.65, 1.0), (middle + 0.65, -1.0)):
        side.shape.face([side.at(u, 0.0, 0.0), side.at(u + 0.15 * out, -0.85, 0.0),
                         side.at(u + 0.15 * out, -0.85, high + 0.05), side.at(u, 0.0, high + 0.05)], wood)
    side.shape.face([side.at(middle + s, out, high + 0.05) for s, out in ((-0.65, 0.0), (0.65, 0.0), (0.5, -0.85),
                                                                       (-0.5, -0.85))], trim)
    side.quad((middle - 0.5, middle + 0.5), (0.0, high + 0.05), -0.85, wood)
    side.pane((middle - 0.40, middle + 0.40), (0.22, 2.20), -0.838, *room, *corner)
    side.pane((middle - 0.40, middle + 0.40), (2.32, high - 0.08), -0.838, *room, *corner)
    side.quad((middle + 0.30, middle + 0.33), (0.95, 1.35), -0.80, materials.plain("brass", (0.45, 0.30, 0.10), 0.3))
    if number % 4:
        side.awning((left + 0.12, right - 0.12), GROUND_FLOOR - 0.82, number)


_OFFICE = 2.0 * BAY  # m: an office's width


def _office(side, height, concrete, trim, number):
    """Ribbons of windows between spandrels, a glass ground floor behind columns."""
    (count, margin), floors = bays(side.size, _OFFICE, 0.3), storeys(height)
    metal = materials.plain("mullion", (0.085, 0.090, 0.095), 0.35)
    if not count:
        side.quad((0.0, side.size), (0.0, height), 0.0, concrete)
        return
    _ends(side, height, margin, concrete)
    u = (margin, side.size - margin)
    _lobby(side, u, count, concrete, metal)
    for storey, floor in enumerate(floors):
        opening = (floor + 0.90, floor + 3.05)
        side.hole((u, (floor, floor + STOREY)), (u, opening), 0.22, concrete, concrete)
        side.quad(u, opening, -0.22, metal)
        for i in range(4 * count):
            left = u[0] + i * 0.25 * _OFFICE
            side.pane((left + 0.03, left + 0.25 * _OFFICE - 0.03), (opening[0] + 0.05, opening[1] - 0.05), -0.20,
                      "office", (i // 4, storey + 1), (u[0] + (i // 4) * _OFFICE, floor))
            if i:
                side.box((left - 0.03, left + 0.03), opening, (-0.20, -0.08), metal)
        side.box(u, (opening[0] - 0.04, opening[0]), (-0.20, 0.06), metal, True)
    top = floors[-1] + STOREY if floors else GROUND_FLOOR
    side.quad(u, (top, height), 0.0, concrete)
    _course(side, GROUND_FLOOR - 0.30, GROUND_FLOOR, 0.30, concrete)
    for i in range(count + 1):
        at = margin + i * _OFFICE
        side.box((at - 0.16, at + 0.16), (GROUND_FLOOR, height), (0.0, 0.16), concrete)


def _lobby(side, u, count, concrete, metal):
    """Glass from floor to ceiling that lies back behind columns, with doors under a canopy in the middle."""
    back, high, entrance = 0.9, GROUND_FLOOR - 0.55, count // 2
    side.hole((u, (0.0, GROUND_FLOOR)), (u, (0.0, high)), back, concrete, concrete)
    side.quad(u, (0.0, high), -back, metal)
    for i in range(count):
        left = u[0] + i * _OFFICE
        room = ("shop", (i, 0), (left, 0.0))
        edges = [left + _OFFICE * share for share in (0.0, 0.25, 0.5, 0.75, 1.0)]
        for start, end in zip(edges, edges[1:]):
            side.pane((start + 0.03, end - 0.03), (0.12, 2.45), -back + 0.015, *room)
            side.pane((start + 0.03, end - 0.03), (2.53, high - 0.05), -back + 0.015, *room)
        side.box((left - 0.22, left + 0.22), (0.0, high), (-0.46, 0.0), concrete)
        if i == entrance:
            side.box((left + 1.2, left + _OFFICE - 1.2), (2.75, 2.93), (-back, 1.1), metal, True)
            for at in (edges[2] - 0.12, edges[2] + 0.09):
                side.box((at, at + 0.03), (0.8, 1.7), (-back + 0.02, -back + 0.09), metal)
    side.box((u[1] - 0.22, u[1] + 0.22), (0.0, high), (-0.46, 0.0), concrete)


_KINDS = {"residence": (_residence, facing.plaster, steep_roof), "shops": (_shops, facing.bricks, flat_roof),
          "office": (_office, facing.concrete, flat_roof)}
