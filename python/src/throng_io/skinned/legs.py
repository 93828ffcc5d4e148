# SPDX-License-Identifier: Apache-2.0
"""Legs that follow: feet are held where they came down, as the streams of a bake's feet say, and stand on ground that
slopes, on top of the poses. The foot goes where it has to and the knee bends the way it did, as much as is needed
(two-bone inverse kinematics); where a leg is too short for that, the whole body sinks. As the add-on has it
(blender_addon/throng/crowd/legs.py), as numbers, but that bodies are not sheared where ground slopes."""
from __future__ import annotations

import dataclasses

import numpy

from ..people.turns import cross, length, turn, turned
from .ground import Ground

FEET = ("left_foot", "right_foot")
GROUND = "ground"
TURN_STEPS = 512.0   # of a radian, in the streams
STRETCHED = 0.9995   # of its length is as long as a leg gets
SINKS = 0.15         # m, at most, on flat ground
SINKS_ON_SLOPES = 0.35
BENDS = 0.01         # m: how far knees are ahead of straight legs, for the direction in which these bend
REACH = 0.45         # m, that feet are moved at most
MOST_OFF = 0.2       # m, that ground under a foot is off the line that bodies follow; what is further off is not what
                     # somebody stands on, but below a stand's step
_X, _Z = numpy.array([1.0, 0.0, 0.0]), numpy.array([0.0, 0.0, 1.0])

Array = numpy.ndarray


@dataclasses.dataclass(frozen=True)
class Footing:
    """What a bake says of somebody's feet in F frames; as large as somebody is, who may be larger than others."""
    moves: Array               # F x 2 x 3: left and right; forward, left, up, m
    turns: Array               # F x 2, rad
    slopes: Array              # F x 2: of the line that bodies follow, along the heading and to the left
    places: Array              # F x 3, of the body
    headings: Array            # F x 2: cosine and sine
    size: float
    ground: Ground | None


def footing_of(streams: dict[str, Array], size: float = 1.0, ground_: Ground | None = None) -> Footing | None:
    """Of a person's streams; None where the bake has neither feet nor a terrain. @param ground_ where it is known"""
    feet = [streams.get(name) for name in FEET]
    ground = streams.get(GROUND)
    if feet[0] is None and ground is None:
        return None
    count = len(streams["state"])
    both = numpy.zeros((count, 2, 3)) if feet[0] is None else numpy.stack(feet, axis=1)
    steps = numpy.floor(both[..., 2])
    moves = numpy.stack([both[..., 0], both[..., 1], both[..., 2] - steps], axis=-1) / size
    return Footing(moves, steps / TURN_STEPS, numpy.zeros((count, 2)) if ground is None else ground[:, :2],
                   streams["pos"], streams["dir"][:, :2], size, None if ground is None else ground_)


@dataclasses.dataclass(frozen=True)
class Stances:
    """Of F frames and the left and the right foot, as the clips have them: on the ground with all of the sole, and at
    all."""
    flat: Array                # F x 2
    down: Array                # F x 2


@dataclasses.dataclass(frozen=True)
class Leg:
    """Of F frames: where its joints are, and where the ankle has to be."""
    hip: Array
    knee: Array
    ankle: Array
    ankle_to: Array

    @property
    def longest(self) -> Array:
        """A leg that the pose stretches further than that stays as it is."""
        whole = length(self.knee - self.hip) + length(self.ankle - self.knee)
        return numpy.maximum(STRETCHED * whole, length(self.ankle - self.hip))

    def sinks(self) -> Array:
        """How far down the hip has to go for the foot to get there."""
        x, y, z = numpy.moveaxis(self.ankle_to - self.hip, -1, 0)
        down = numpy.sqrt(numpy.maximum(self.longest ** 2 - x * x - y * y, 0.0))
        return numpy.maximum(-(z + down), 0.0)

    def reached(self, hip: Array) -> tuple[Array, Array]:
        """(knee, ankle): where they get to, of a hip that is there."""
        wanted = self.ankle_to - hip
        direction = _unit(wanted)
        far = numpy.minimum(length(wanted), self.longest)
        ahead = BENDS * _X + _across(self.knee - self.hip, _unit(self.ankle - self.hip))
        bends = _unit(_across(ahead, direction))
        thigh, calf = length(self.knee - self.hip), length(self.ankle - self.knee)
        along = (thigh ** 2 - calf ** 2 + far ** 2) / numpy.maximum(2.0 * far, 1e-6)
        out = numpy.sqrt(numpy.maximum(thigh ** 2 - along ** 2, 0.0))
        return hip + direction * along[:, None] + bends * out[:, None], hip + direction * far[:, None]


def held(matrices: Array, places: Array, names: list[str], footing: Footing, stances: Stances) -> Array:
    """F x J x 3 x 4. @param matrices where joints take what hangs on them; @param places J x 3, of joints at rest"""
    ankles = [_end(matrices, places, names, f"foot_{side}") + footing.moves[:, number]
              for number, side in enumerate("lr")]
    under = [_under(footing, ankle, stances.flat[:, number], stances.down[:, number])
             for number, ankle in enumerate(ankles)]
    legs = [_leg(matrices, places, names, side, *each) for side, *each in zip("lr", ankles, under)]
    steep = length(footing.slopes) > 1e-6
    sinks = numpy.minimum(numpy.maximum(*(leg.sinks() for leg in legs)), numpy.where(steep, SINKS_ON_SLOPES, SINKS))
    down = -sinks[:, None] * _Z
    found = matrices.copy()
    found[..., 3] += down[:, None]
    for number, (side, leg) in enumerate(zip("lr", legs)):
        knee, ankle = leg.reached(leg.hip + down)
        for name, turns, centre, to in (
                ("thigh", _from_to(leg.knee - leg.hip, knee - leg.hip - down), leg.hip, leg.hip + down),
                ("calf", _from_to(leg.ankle - leg.knee, ankle - knee), leg.knee, knee),
                *((name, _tilted(under[number].slopes, footing.turns[:, number]), leg.ankle, ankle)
                  for name in ("foot", "ball"))):
            joint = names.index(f"{name}_{side}")
            found[:, joint] = _placed(matrices[:, joint], turns, centre, to)
    return found


def _leg(matrices: Array, places: Array, names: list[str], side: str, ankle_to: Array, under: Under) -> Leg:
    """With soles on the ground: as feet are turned to a slope, ankles go up by as much as they would come nearer."""
    hip, knee, ankle = (_end(matrices, places, names, f"{name}_{side}") for name in ("thigh", "calf", "foot"))
    nearer = ankle_to[:, 2] * (numpy.sqrt(1.0 + (under.slopes ** 2).sum(axis=1)) - 1.0)
    return Leg(hip, knee, ankle, ankle_to + (under.rises + nearer)[:, None] * _Z)


def _end(matrices: Array, places: Array, names: list[str], name: str) -> Array:
    """F x 3: where a joint is."""
    joint = names.index(name)
    return turned(matrices[:, joint, :, :3], places[joint]) + matrices[:, joint, :, 3]


@dataclasses.dataclass(frozen=True)
class Under:
    """The ground under a foot in F frames, beside that of the pose."""
    rises: Array               # F, m
    slopes: Array              # F x 2


def _under(footing: Footing, ankle: Array, flat: Array, down: Array) -> Under:
    """Where no terrain is known, the line that bodies follow. Where one is, what it is below a sole that is flat, for
    as long as the foot is down; in the air it goes over from one such place to the next.

    @param ankle in the own frame, without what is told here
    """
    rises = (footing.slopes * ankle[:, :2]).sum(axis=1)
    if footing.ground is None:
        return Under(rises, footing.slopes)
    cosine, sine = footing.headings.T
    x, y = footing.size * ankle[:, :2].T
    there = footing.places + numpy.column_stack([x * cosine - y * sine, x * sine + y * cosine, footing.size * rises])
    heights, slopes = footing.ground.under(there)
    own = numpy.column_stack([slopes[:, 0] * cosine + slopes[:, 1] * sine,
                              slopes[:, 1] * cosine - slopes[:, 0] * sine])
    known, told = numpy.zeros(len(ankle), bool), numpy.zeros((len(ankle), 3))
    near = numpy.abs(heights - there[:, 2]) < MOST_OFF  # of NaN it is not
    for first, last in _runs(down):
        span = slice(first, last)
        sure = numpy.nonzero(flat[span] & near[span])[0] + first
        if len(sure):
            known[span] = True
            height = numpy.median(heights[sure])
            told[span, 0] = (height - footing.places[span, 2]) / footing.size - rises[span]
            told[span, 1:] = numpy.median(own[sure], axis=0)
    if not known.any():
        return Under(rises, footing.slopes)
    frames = numpy.arange(len(ankle))
    off, along, across = (numpy.interp(frames, frames[known], column[known]) for column in told.T)
    return Under(rises + off, numpy.column_stack([along, across]))


def _runs(mask: Array) -> list[tuple[int, int]]:
    """[(first, behind the last)] of frames in which something is so."""
    edges = numpy.nonzero(numpy.diff(mask.astype(int), prepend=0, append=0))[0].tolist()
    return list(zip(edges[::2], edges[1::2]))


def _tilted(slopes: Array, turns: Array) -> Array:
    """How a foot is turned: about the vertical, and then to the slope."""
    along, across = slopes.T
    axis = numpy.stack([across, -along, numpy.zeros_like(along)], axis=-1)
    return turn(axis, numpy.arctan(length(axis))) @ turn(_Z, turns)


def _placed(matrices: Array, turns: Array, centre: Array, to: Array) -> Array:
    """Turned about a place that goes to another one. @param matrices F x 3 x 4"""
    shift = turned(turns, matrices[..., 3] - centre) + to
    return numpy.concatenate([turns @ matrices[..., :3], shift[..., None]], axis=-1)


def _from_to(one: Array, other: Array) -> Array:
    """What turns vectors into the direction of others."""
    axis = cross(one, other)
    return turn(axis, numpy.arctan2(length(axis), (one * other).sum(axis=-1)))


def _unit(value: Array) -> Array:
    return value / numpy.maximum(length(value), 1e-12)[..., None]


def _across(value: Array, direction: Array) -> Array:
    return value - direction * (value * direction).sum(axis=-1, keepdims=True)
