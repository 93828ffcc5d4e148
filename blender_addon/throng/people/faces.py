# SPDX-License-Identifier: Apache-2.0
"""How faces move: lids that close, mouths that open and smile, eyes that turn. Of every vertex, how far each of these
takes it, in the rest pose; how much of it there is at a moment is up to whoever shows it (crowd/faces.py)."""
from dataclasses import replace

import numpy

from .regions import places_of
from .shape import ANCESTRIES, shape_of

# {what moves: the library's units of expressions that do it}
EXPRESSIONS = {"lids": ("eye-left-closure", "eye-right-closure"), "mouth": ("mouth-open",),
               "smile": ("mouth-corner-puller",)}
BALL = "ball"     # of vertices of eyes: where they are from the middle of the ball
_REACH = 0.012    # m on the base mesh: what grows so near a place moves as it does
_STILL = 2e-5     # m
_OVER = 0.0004    # m, that upper lids go over the edge of lower ones


def moves_of(bodies, body, shape):
    """{expression: (V, 3) how far all of it takes the vertices of the library, m}; @param shape of the body"""
    found = {}
    for name, units in EXPRESSIONS.items():
        targets = tuple((f"expression/units/{ancestry}/{unit}", share) for unit in units
                        for ancestry, share in zip(ANCESTRIES, body.ancestry) if share > 0.0)
        found[name] = shape_of(bodies, replace(body, details=body.details + targets)) - shape
    found["lids"] = found["lids"] * _closing(bodies, shape, found["lids"])
    return found


def _closing(bodies, shape, lids):
    """How much of the library's closed lids closes these eyes, which are open further or less."""
    body = bodies.vertices_of("body")
    body = body[shape[body, 1] > 0.0]
    edge = body[lids[body, 2].argmin()]
    below = body[(numpy.abs(shape[body, 1] - shape[edge, 1]) < 0.003) & (shape[body, 0] > shape[edge, 0] - 0.004)
                 & (shape[body, 2] < shape[edge, 2] - 0.001) & ~lids[body].any(axis=1)]
    return min(1.0, (shape[edge, 2] - shape[below, 2].max() + _OVER) / -lids[edge, 2])


def on_parts(bodies, body, shape, parts):
    """{expression or BALL: (V, 3)} of the vertices of all parts."""
    moves = moves_of(bodies, body, shape)
    moving = numpy.any([(numpy.abs(each) > _STILL).any(axis=1) for each in moves.values()], axis=0)
    places = places_of(bodies)[:, :3]
    low, high = places[moving].min(axis=0) - _REACH, places[moving].max(axis=0) + _REACH
    around = _within(places, low, high)
    found = []
    for part in parts:
        made = {name: numpy.zeros((len(part.points), 3)) for name in (*moves, BALL)}
        if part.material.startswith("eyes"):
            made[BALL] = part.points - _middle_of(part.points)
        inside = _within(part.places[:, :3], low, high)
        nearest, away = _nearest(part.places[inside, :3], places[around])
        close = away < _REACH
        for name, offsets in moves.items():
            made[name][inside[close]] = offsets[around[nearest[close]]]
        found.append(made)
    return {name: numpy.concatenate([made[name] for made in found]) for name in (*moves, BALL)}


def _within(places, low, high):
    return numpy.flatnonzero(((places >= low) & (places <= high)).all(axis=1))


def _nearest(places, others):
    """(which of the others is nearest, how far away it is)"""
    if not len(places):
        return numpy.zeros(0, int), numpy.zeros(0)
    squares = (others ** 2).sum(axis=1) - 2.0 * places @ others.T
    nearest = squares.argmin(axis=1)
    return nearest, numpy.linalg.norm(places - others[nearest], axis=1)


def _middle_of(points):
    """Of the ball whose front they are: its sides say how large it is."""
    low, high = points.min(axis=0), points.max(axis=0)
    middle = 0.5 * (low + high)
    middle[0] = high[0] - 0.5 * (high - low)[1:].mean()
    return middle
