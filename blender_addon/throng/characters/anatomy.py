# SPDX-License-Identifier: Apache-2.0
"""Where a skeleton's legs are. Pure maths on numpy arrays: no Blender here.

The feet are what reaches the ground; a leg is the chain of bones from where both feet's chains part down to a foot.
"""
import itertools
from dataclasses import dataclass

import numpy

from . import CharacterError
from .roles import words_of

_FOOT_WORDS = set("foot ankle feet".split())


@dataclass(frozen=True)
class Leg:
    """Indices of bones; the knee is None where there is none to bend."""
    hip: int
    knee: object
    foot: int
    soles: numpy.ndarray  # vertices that may touch the ground


def _chain(bone, parents):
    """From the root to a bone."""
    chain = []
    while bone >= 0:
        chain.append(bone)
        bone = parents[bone]
    return chain[::-1]


def below(bone, parents):
    """A bone and all that hang on it."""
    return [each for each in range(len(parents)) if bone in _chain(each, parents)]


def _lowest(points, main, count):
    """(B,) the height of each bone's lowest vertex."""
    lowest = numpy.full(count, numpy.inf)
    numpy.minimum.at(lowest, main, points[:, 2])
    return lowest


def find_legs(names, parents, heads, points, main, feet=()):
    """Both legs.

    @param heads (B, 3), the bones' joints in a pose that stands; points (V, 3), the vertices; main (V,), the
    bone that moves each most
    @param feet the names of both feet's bones, where they are known
    """
    lowest = _lowest(points, main, len(names))
    ground, height = points[:, 2].min(), float(numpy.ptp(points[:, 2]))
    if height < 1e-6:
        raise CharacterError("the character has no height: its meshes are empty or flat in the rest pose")
    if feet:
        missing = [name for name in feet if name not in names]
        if missing or len(feet) != 2:
            raise CharacterError(f"the feet should be the names of two bones, found {', '.join(feet)}: there are "
                                 f"{', '.join(names[:12])} ...")
        ends = [names.index(name) for name in feet]
    else:
        ends = _feet_of(names, parents, lowest, ground + 0.06 * height, heads, height)
    chains = [_chain(end, parents) for end in ends]
    shared = sum(a == b for a, b in zip(*chains))
    legs = []
    for end, chain in zip(ends, chains):
        leg = chain[shared:]
        if not leg:
            raise CharacterError("one foot hangs on the other: name the bones of both feet")
        hip, knee = _joints(leg, heads)
        legs.append(Leg(hip, knee, end, _soles(points, main, below(end, parents))))
    return legs


def _is_foot(name):
    return bool(_FOOT_WORDS & set(words_of(name)))


def _foot_above(bone, names, parents, lowest, near, heads, height):
    """The foot that a bone near the ground belongs to.

    Without a name, it is the uppermost bone that reaches the ground and begins near it: a shin reaches down, too.
    """
    chain = _chain(bone, parents)
    named = [each for each in chain if _is_foot(names[each])]
    starts = [each for each in chain if lowest[each] < near and heads[each][2] < near + 0.05 * height]
    return (named or starts or [bone])[0]


def _unlikeness(a, b, names, parents, lowest, heads):
    """How little two bones are like a pair of feet: as high and as deep as each other, on the ground; those with a
    foot's name come first."""
    depths = len(_chain(a, parents)) - len(_chain(b, parents))
    unlike = abs(heads[a][2] - heads[b][2]) + 0.05 * abs(depths) + abs(lowest[a] - lowest[b])
    unlike += min(lowest[a], lowest[b])
    return unlike - (10.0 if _is_foot(names[a]) and _is_foot(names[b]) else 0.0)


def _feet_of(names, parents, lowest, near, heads, height):
    """The bones of the two feet: on different branches, near the ground, as high and as deep as each other."""
    branches = dict.fromkeys(_foot_above(bone, names, parents, lowest, near, heads, height)
                             for bone in range(len(names)) if lowest[bone] < near)
    unlike = {(a, b): _unlikeness(a, b, names, parents, lowest, heads) for a, b in itertools.combinations(branches, 2)
              if a not in _chain(b, parents) and b not in _chain(a, parents)}
    pairs = [pair for pair, much in unlike.items() if much < numpy.inf]  # bones that move nothing are no feet
    if not pairs:
        raise CharacterError("no two feet were found: no two bones on branches of their own move vertices near the "
                             "ground. Name the bones of both feet")
    return min(pairs, key=unlike.get)


def _joints(leg, heads):
    """(hip, knee) of a chain that ends in the foot."""
    ankle = heads[leg[-1]][2]
    while len(leg) > 3 and heads[leg[0]][2] - heads[leg[1]][2] < 0.15 * (heads[leg[0]][2] - ankle):
        leg = leg[1:]  # a bone of the pelvis's side
    middle = 0.5 * (heads[leg[0]][2] + ankle)
    knee = min(leg[1:-1], key=lambda bone: abs(heads[bone][2] - middle), default=None)
    return leg[0], knee


def corners_of(points):
    """Which of the points of a foot can be its lowest, however it is turned."""
    directions = [(numpy.cos(a) * c, numpy.sin(a) * c, -s) for a in numpy.arange(16) * numpy.pi / 8
                  for c, s in ((0.97, 0.24), (0.7, 0.7), (0.3, 0.95))]
    return sorted(set((points @ numpy.array(directions).T).argmax(axis=0).tolist()))


def _soles(points, main, bones):
    """The vertices of a foot that can be its lowest: the corners of each bone on its own."""
    chosen = set()
    for bone in bones:
        mine = numpy.nonzero(main == bone)[0]
        if len(mine):
            chosen.update(int(each) for each in mine[corners_of(points[mine])])
    if not chosen:
        raise CharacterError("no vertex follows the feet's bones: name the bones of both feet")
    return numpy.array(sorted(chosen))
