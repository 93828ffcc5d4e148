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
    made = {"stone": materials.mottled("stand", (0.24, 0.235, 0.225), (0.33, 0.325, 0.31), 1.6)}
    for number, colour in enumerate(_COLOURS):
        made[number] = materials.plain(f"seat {number}", colour, 0.45)
    if seat_mouths.has_passages(block):
        made["passage"] = materials.plain("passage", (0.16, 0.155, 0.15), 0.8)
    for face, of in faces_of(block):
        shape.face(face, made[of])
    return shape.to_object()


def faces_of(block):
    """Everything that a block is built of, as (corners, "stone", "passage" or 0 and 1 of a row's seats in turns)."""
    yield from built_of(block)
    for row in block["rows"]:
        for number, (place, way, height) in enumerate(seat_rows.seats_of(block, row)):
            for face in seat_rows.seat_faces(place, way, height, seat_rows.SIDE * float(block["width"])):
                yield face, number % len(_COLOURS)


def built_of(block):
    """All of that but the seats."""
    slabs = seat_mouths.has_passages(block)  # people walk under them
    for row in block["rows"]:
        bottom = seat_rows.bottom_of(block, row, seat_mouths.SLAB if slabs else None)
        for face in seat_rows.step_faces(*seat_rows.step_of(block, row), seat_rows.heights_of(row), bottom):
            yield face, "stone"
    for aisle in block.get("aisles", ()):
        yield from _mouth(block, aisle) if slabs else _steps(block, aisle)


def _mouth(block, aisle):
    """Flights of steps, an opening and the passage behind it."""
    mouth = seat_mouths.Mouth(block, aisle)
    for face in seat_mouths.flights_of(mouth, aisle) + seat_mouths.walls_of(mouth):
        yield face, "stone"
    for face in seat_mouths.passage_of(mouth):
        yield face, "passage"


def _steps(block, aisle):
    """Steps of an aisle, two to a row."""
    bottom = seat_rows.bottom_of(block, block["rows"][0])
    for front, back, height in seat_rows.treads_of(block, aisle):
        if height - bottom > seat_rows.HAIR:
            for face in seat_rows.step_faces(front, back, height, bottom):
                yield face, "stone"
