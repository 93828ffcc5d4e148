# SPDX-License-Identifier: Apache-2.0
"""Stands of those who have seats: a step for each row, and the seats."""
from ..cast import seat_rows
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
    for row in block["rows"]:
        height = float(row["height"])
        _step(shape, *seat_rows.step_of(block, row), height, stone)
        for number, (place, way) in enumerate(seat_rows.seats_of(block, row)):
            add_seat(shape, place, way, height, seat_rows.SIDE * float(block["width"]), shells[number % len(shells)])
    for aisle in block.get("aisles", ()):
        _steps(shape, block, aisle, stone)
    return shape.to_object()


def _steps(shape, block, aisle, stone):
    """Steps of an aisle, two to a row."""
    for front, back, height in seat_rows.treads_of(block, aisle):
        if height > seat_rows.HAIR:
            _step(shape, front, back, height, stone)


def _step(shape, front, back, height, stone):
    """From the ground up."""
    for (a, b), (c, d) in zip(zip(front, front[1:]), zip(back, back[1:])):
        shape.face([(*a, height), (*c, height), (*d, height), (*b, height)], stone)
        if height > seat_rows.HAIR:
            shape.face([(*b, 0.0), (*a, 0.0), (*a, height), (*b, height)], stone)
            shape.face([(*c, 0.0), (*d, 0.0), (*d, height), (*c, height)], stone)
    if height > seat_rows.HAIR:
        shape.face([(*front[0], 0.0), (*back[0], 0.0), (*back[0], height), (*front[0], height)], stone)
        shape.face([(*back[-1], 0.0), (*front[-1], 0.0), (*front[-1], height), (*back[-1], height)], stone)


def add_seat(shape, place, along, height, half, shell):
    for face in seat_rows.seat_faces(place, along, height, half):
        shape.face(face, shell)
