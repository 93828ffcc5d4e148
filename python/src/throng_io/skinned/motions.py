# SPDX-License-Identifier: Apache-2.0
"""How somebody's joints move in the course of a bake: poses chosen and blended as the add-on bends people near the
camera (blender_addon/throng/crowd/near.py), as numbers."""
from __future__ import annotations

import dataclasses

import numpy

from ..cast import BEATS, POSES, Repertoire, gait, sitting
from .ground import Ground
from .legs import Footing, Stances, footing_of

STANDS_BELOW = 0.03                    # m/s, where no stream tells how much of a walk is in a pose
WALKS_FROM = 0.35
FRAMES_A_ROUND = 80.0                  # of a standing clip
STAYS_UNTIL = 0.67                     # share of a beat; in the rest of it people change to the next
STANDS_WHERE = 0.3                     # share of a walk: as `throng bake --feet` has it
LIFTED = 0.002                         # m
GATHERS = 2                            # the activity of those who stand about

Array = numpy.ndarray


@dataclasses.dataclass(frozen=True)
class Track:
    """What a bake says of one person in some frames (F)."""
    row: int
    times: Array               # F: time codes
    state: Array               # F x 3
    speed: Array               # F, m/s
    carriage: Array | None = None   # F x 3: of that stream, where the bake has it
    attention: Array | None = None  # likewise
    footing: Footing | None = None  # of feet that are held, and ground that slopes

    @property
    def walking(self) -> Array | None:
        return None if self.carriage is None else self.carriage[:, 0]


@dataclasses.dataclass(frozen=True)
class Joints:
    """Of F frames, beside the joints above."""
    rotations: Array           # F x J x 4: x, y, z, w
    translations: Array        # F x J x 3, m


def track_of(row: int, times: Array, streams: dict[str, Array], size: float = 1.0,
             ground: Ground | None = None) -> Track:
    """@param streams of this person in these frames; @param size how much larger somebody is than others; @param ground
    under the feet"""
    return Track(row, times, streams["state"], streams["dir"][:, 2], streams.get("carriage"), streams.get("attention"),
                 footing_of(streams, size, ground))


def smooth(value: Array, low: float, high: float) -> Array:
    share = numpy.clip((value - low) / (high - low), 0.0, 1.0)
    return share * share * (3.0 - 2.0 * share)


def matrices_of(poses: Array, repertoire: Repertoire, track: Track) -> Array:
    """F x J x 3 x 4: where joints take what hangs on them. @param poses P x J x 3 x 4"""
    walk = _walk(poses, repertoire, track.state)
    return _upright(_mix(_rest(poses, repertoire, track), walk, walking_of(track)))


def walking_of(track: Track) -> Array:
    """F: how much of a walk is in the poses, 0 to 1."""
    return smooth(track.speed, STANDS_BELOW, WALKS_FROM) if track.walking is None else track.walking


def _mix(one: Array, other: Array, share: Array) -> Array:
    return one + (other - one) * share[:, None, None, None]


@dataclasses.dataclass(frozen=True)
class Walks:
    """In which gaits somebody walks, in F frames."""
    gait: Array                # F: of a repertoire's
    before: Array              # F: what it was before
    left: Array                # F: how much of that is left, 0 to 1


def walks_of(repertoire: Repertoire, state: Array) -> Walks:
    """docs/bake.md: `state`"""
    told = (state[:, 0] % 1.0) * 16.0
    number = numpy.rint(told)
    rest = numpy.maximum((told - number) * 32.0 + 1e-3, 0.0)
    gait, before = (numpy.clip(each - repertoire.first, 0, len(repertoire.strides) - 1).astype(int)
                    for each in (number, numpy.floor(rest)))
    return Walks(gait, before, smooth(rest % 1.0, 0.0, 1.0))


def stances_of(repertoire: Repertoire, track: Track) -> Stances:
    """Of who walks as the gait has them; of who stands both feet are down but for those that make a step. Who has a
    seat has none."""
    walks = walks_of(repertoire, track.state)
    gaits = [gait.gait_of(stride) for stride in repertoire.strides]
    first, flat_from, flat_until, stance = (numpy.array([getattr(each, name) for each in gaits])[walks.gait, None]
                                            for name in ("down", "flat_from", "flat_until", "stance"))
    since = (track.state[:, 2:] + [0.5, 0.0] - first) % 1.0
    stands = (walking_of(track) < STANDS_WHERE)[:, None]
    lifted = numpy.zeros(since.shape, bool) if track.footing is None else track.footing.moves[..., 2] > LIFTED
    lifted |= (track.state[:, 0] > sitting.FIRST - 0.5)[:, None]
    return Stances(((since >= flat_from) & (since < flat_until) | stands) & ~lifted,
                   ((since < stance) | stands) & ~lifted)


def _walk(poses: Array, repertoire: Repertoire, state: Array) -> Array:
    """Between two poses of the gait, and what is left of the gait before."""
    walks = walks_of(repertoire, state)
    place = (state[:, 2] % 1.0) * POSES
    pose = numpy.minimum(numpy.floor(place), POSES - 1).astype(int)
    here, there = (_mix(poses[POSES * walks.gait + each], poses[POSES * walks.before + each], walks.left)
                   for each in (pose, (pose + 1) % POSES))
    return _mix(here, there, place - pose)


def stands_of(row: int, times: Array, state: Array) -> tuple[Array, Array]:
    """(which standing clip, where in its round, 0 to 1) of F frames: those who gather talk or look at their phones,
    others shift their weight."""
    kinds = numpy.where(numpy.floor(state[:, 0]) == GATHERS, len(gait.STANDING_CLIPS), 2)
    return row % 4 % kinds, (row * 0.618034 + times / FRAMES_A_ROUND) % 1.0


def _stand(poses: Array, repertoire: Repertoire, track: Track) -> Array:
    """Between two beats of a clip."""
    clip, place = stands_of(track.row, track.times, track.state)
    place = place * BEATS
    beat = numpy.minimum(numpy.floor(place), BEATS - 1).astype(int)
    first = repertoire.walking() + BEATS * clip
    return _mix(poses[first + beat], poses[first + (beat + 1) % BEATS], smooth(place - beat, STAYS_UNTIL, 1.0))


def seats_of(state: Array) -> tuple[Array, Array, Array, Array]:
    """(whether somebody has a seat, two poses behind the standing ones, how far from the one to the other) in F frames
    (docs/bake.md)."""
    has = state[:, 0] > sitting.FIRST - 0.5
    clip = numpy.clip(numpy.floor(state[:, 0]) - sitting.FIRST, 0, len(sitting.CLIPS) - 1).astype(int)
    first, count, returns = (numpy.array(each)[clip] for each in (
        [sitting.poses_in(number) for number in range(len(sitting.CLIPS))],
        [each.poses for each in sitting.CLIPS], [each.there_and_back for each in sitting.CLIPS]))
    phase = state[:, 2] % 1.0
    place = numpy.where(returns, (1.0 - numpy.abs(2.0 * phase - 1.0)) * (count - 1), phase * count)
    pose = numpy.minimum(numpy.floor(place), count - 1 - returns).astype(int)
    return has, first + pose, first + (pose + 1) % count, place - pose


def _rest(poses: Array, repertoire: Repertoire, track: Track) -> Array:
    """Of who does not walk, in a seat or not."""
    stands = _stand(poses, repertoire, track)
    if not repertoire.clips:
        return stands
    has, here, there, share = seats_of(track.state)
    first = repertoire.upright()
    sits = _mix(poses[first + here], poses[first + there], share)
    return numpy.where(has[:, None, None, None], sits, stands)


def _upright(matrices: Array) -> Array:
    """With turns that are turns: blends of them shear."""
    x = matrices[..., 0]
    x = x / numpy.linalg.norm(x, axis=-1, keepdims=True)
    y = matrices[..., 1]
    y = y - x * (x * y).sum(axis=-1, keepdims=True)
    y = y / numpy.linalg.norm(y, axis=-1, keepdims=True)
    return numpy.stack([x, y, numpy.cross(x, y), matrices[..., 3]], axis=-1)


def joints_of(matrices: Array, places: Array, parents: list[int]) -> Joints:
    """Joints beside those above them. @param matrices F x J x 3 x 4; @param places J x 3, of joints at rest"""
    turns = matrices[..., :3]
    moved = numpy.einsum("fjab,jb->fja", turns, places) + matrices[..., 3]
    local, from_above = turns.copy(), moved.copy()
    for joint, parent in enumerate(parents):
        if parent >= 0:
            back = numpy.swapaxes(turns[:, parent], -1, -2)
            local[:, joint] = back @ turns[:, joint]
            from_above[:, joint] = numpy.einsum("fab,fb->fa", back, moved[:, joint] - moved[:, parent])
    return Joints(_continuous(quaternions(local)), from_above)


def quaternions(turns: Array) -> Array:
    """(..., 4): x, y, z, w of turns (..., 3, 3), by the largest of the four, which is far from 0."""
    a, b, c = (turns[..., axis, axis] for axis in range(3))
    squares = numpy.stack([1.0 + a - b - c, 1.0 - a + b - c, 1.0 - a - b + c, 1.0 + a + b + c], axis=-1)
    x, y, z = (turns[..., one, other] - turns[..., other, one] for one, other in ((2, 1), (0, 2), (1, 0)))
    xy, xz, yz = (turns[..., one, other] + turns[..., other, one] for one, other in ((0, 1), (0, 2), (1, 2)))
    choices = numpy.stack([numpy.stack(each, axis=-1) for each in (
        (squares[..., 0], xy, xz, x), (xy, squares[..., 1], yz, y), (xz, yz, squares[..., 2], z),
        (x, y, z, squares[..., 3]))], axis=-2)
    largest = squares.argmax(axis=-1)[..., None, None]
    found = numpy.take_along_axis(choices, largest, axis=-2)[..., 0, :]
    return found / numpy.linalg.norm(found, axis=-1, keepdims=True)


def _continuous(turns: Array) -> Array:
    """Of the two quaternions that are the same turn, the one near that of the frame before: so that what is between
    frames is, too."""
    flips = numpy.where((turns[1:] * turns[:-1]).sum(axis=-1) < 0.0, -1.0, 1.0)
    signs = numpy.concatenate([numpy.ones_like(turns[:1, ..., 0]), numpy.cumprod(flips, axis=0)])
    return turns * signs[..., None]
