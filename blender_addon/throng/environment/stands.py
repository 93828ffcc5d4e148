# SPDX-License-Identifier: Apache-2.0
"""Stands of those who have seats: a step for each row, and the seats."""
from ..cast import seat_mouths, seat_rows
from . import materials
from .shapes import Shape

_COLOURS = ((0.035, 0.085, 0.20), (0.045, 0.11, 0.26))


def stand_names(geometry):
    """Of the walls that nobody sees: outlines of stands, which keep others out."""
    return {f"{block.get('id', '')} stand" for block in geometry.get("seats", ())}


def build_stands(geometry):
    """An object for each block of seats."""
    return [_build(block) for block in geometry.get("seats", ())]


def _build(block):
    shape = Shape(f"Throng stand {block.get('id', '')}")
    stone = materials.mottled("stand", (0.24, 0.235, 0.225), (0.33, 0.325, 0.31), 1.6)
    shells = [materials.plain(f"seat {number}", colour, 0.45) for number, colour in enumerate(_COLOURS)]
    slabs = seat_mouths.has_passages(block)  # people walk under them
    for row in block["rows"]:
        height = float(row["height"])
        bottom = height - float(block["rise"]) - seat_mouths.SLAB if slabs else 0.0
        _step(shape, *seat_rows.step_of(block, row), height, stone, bottom)
        for number, (place, way) in enumerate(seat_rows.seats_of(block, row)):
            add_seat(shape, place, way, height, seat_rows.SIDE * float(block["width"]), shells[number % len(shells)])
    for aisle in block.get("aisles", ()):
        if slabs:
            _mouth(shape, block, aisle, stone)
        else:
            _steps(shape, block, aisle, stone)
    return shape.to_object()


def _mouth(shape, block, aisle, stone):
    """Flights of steps, an opening and the passage behind it."""
    inner = materials.plain("passage", (0.16, 0.155, 0.15), 0.8)
    mouth = seat_mouths.Mouth(block, aisle)
    for face in seat_mouths.flights_of(mouth, aisle) + seat_mouths.walls_of(mouth):
        shape.face(face, stone)
    for face in seat_mouths.passage_of(mouth):
        shape.face(face, inner)


def _steps(shape, block, aisle, stone):
    """Steps of an aisle, two to a row."""
    for front, back, height in seat_rows.treads_of(block, aisle):
        if height > seat_rows.HAIR:
            _step(shape, front, back, height, stone)


def _step(shape, front, back, height, stone, bottom=0.0):
    """From the ground up, or a slab."""
    for (a, b), (c, d) in zip(zip(front, front[1:]), zip(back, back[1:])):
        shape.face([(*a, height), (*c, height), (*d, height), (*b, height)], stone)
        if height - bottom > seat_rows.HAIR:
            shape.face([(*b, bottom), (*a, bottom), (*a, height), (*b, height)], stone)
            shape.face([(*c, bottom), (*d, bottom), (*d, height), (*c, height)], stone)
        if bottom != 0.0:
            shape.face([(*a, bottom), (*b, bottom), (*d, bottom), (*c, bottom)], stone)
    if height - bottom > seat_rows.HAIR:
        shape.face([(*front[0], bottom), (*back[0], bottom), (*back[0], height), (*front[0], height)], stone)
        shape.face([(*back[-1], bottom), (*front[-1], bottom), (*front[-1], height), (*back[-1], height)], stone)


def add_seat(shape, place, along, height, half, shell):
    for face in seat_rows.seat_faces(place, along, height, half):
        shape.face(face, shell)
