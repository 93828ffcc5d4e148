# SPDX-License-Identifier: Apache-2.0
"""Members of a crowd's cast who are shaped from a library of bodies, in the form that all members of casts have
(cast/__init__.py), and who of a bake's people appears as which of them."""
import csv
import os
from functools import lru_cache

import numpy

from ..cast import BEATS, POSES, gait, skinning
from ..cast.library import BLURS_UNTIL, shaped
from ..cast.bones import Boned
from . import figures, library, roster
from .person import Maker

LOOK = "casual"
MEMBERS = 64      # of a cast: women and men of all ages, some children among them
FINE = 4096.0     # steps a metre: what is finer is not seen, and files are a third as large without it
CHILD_UNTIL = 0.205  # m: people of a smaller radius are children
_SOME = 7         # of so many poses one tells which bones move
_KEPT = 2         # people who stay in memory: all their levels are made one after the other


def found():
    """Whether there is a library of bodies."""
    return library.library_path() is not None


def bodies():
    """The library. Raises library.LibraryError."""
    path = library.library_path()
    if path is None:
        raise library.LibraryError("these people were shaped from a library of bodies that is not here: set "
                                   f"{library.VARIABLE} to it, or install the add-on that has it")
    return library.load(path)


@lru_cache(maxsize=256)
def person_of(number, look=LOOK):
    return roster.draw_person(look, number)


@lru_cache(maxsize=_KEPT)
def maker_of(number, look=LOOK):
    return Maker(bodies(), person_of(number, look))


def poses_of(build, repertoire):
    """All poses of level 0, in order."""
    gaits = [gait.gait_of(stride) for stride in repertoire.strides]
    return ([gait.walk_pose(index / POSES, build, each) for each in gaits for index in range(POSES)]
            + [gait.standing_pose(clip, beat / BEATS, build) for clip in gait.STANDING_CLIPS for beat in range(BEATS)])


@lru_cache(maxsize=_KEPT)
def _leaders(number, look, repertoire):
    """Which bones go with which (skinning.leaders_of): a few poses tell."""
    rig = maker_of(number, look).rig
    some = numpy.stack([rig.matrices(pose) for pose in poses_of(rig.build, repertoire)[::_SOME]])
    return skinning.leaders_of(bodies().parents, some)


def matrices_of(number, look, repertoire):
    """(P, B, 3, 4) of the bones that lead, in all poses of level 0."""
    rig, (leaders, _) = maker_of(number, look).rig, _leaders(number, look, repertoire)
    used = numpy.unique(leaders)
    return numpy.stack([rig.matrices(pose)[used] for pose in poses_of(rig.build, repertoire)])


def boned_of(number, level, repertoire, look=LOOK):
    """A member at a level, for cast.sheets."""
    model, leaders = maker_of(number, look).model(level), _leaders(number, look, repertoire)
    points, weights = skinning.hinged(model.points, model.weights, *leaders)
    points = (numpy.rint(points * FINE) / FINE + 0.0).astype(numpy.float32)  # no zero is negative
    cycles = tuple((POSES, gait.gait_of(stride).seconds / POSES) for stride in repertoire.strides)
    mesh = figures.mesh_of("throng figure", model, points, look, bodies())
    return Boned(mesh, weights, lambda: matrices_of(number, look, repertoire), tuple(repertoire.sources(level)),
                 cycles if level <= BLURS_UNTIL else ())


def choose(people, count, drawn):
    """Which member each of a bake's people appears as: children as children, the broad as broad ones.

    @param people [(radius, variation)]; @param count how many members there are; @param drawn how many variations
    """
    folk = sorted(range(count), key=lambda number: (breadth_of(person_of(number)), number))
    # by breadth; how broad somebody is among the members should be how broad it is among the people
    fitting = {child: [number for number in folk if person_of(number).child == child] or folk
               for child in (True, False)}
    chosen = []
    for row, (radius, variation) in enumerate(people):
        fits = fitting[radius < CHILD_UNTIL]
        low, high = (0.15, 0.20) if radius < CHILD_UNTIL else (0.22, 0.28)
        share = min(max((radius - low) / (high - low), 0.0), 0.999)
        spread = ((variation + 0.618034 * row) % drawn) / drawn - 0.5  # not all of one radius are one person
        wanted = min(max(share * len(fits) + 0.5 * len(fits) * spread, 0.0), len(fits) - 1.0)
        chosen.append(fits[int(wanted)])
    return chosen


def breadth_of(who):
    """How broad a person's shoulders are beside others, as a number to sort by."""
    return who.body.height * (0.20 + 0.02 * who.body.male) + 0.012 * who.body.shoulders + 0.04 * who.body.weight


def read_people(folder):
    """[(radius, variation)] of a bake's people, or None where its table cannot be read; None in the place of those
    whose look somebody has chosen (`throng apply`)."""
    try:
        with open(os.path.join(folder, "agents.csv"), newline="", encoding="utf-8") as table:
            return [None if line.get("overrides") else (float(line["radius"]), int(line["variation"]))
                    for line in csv.DictReader(table)]
    except (OSError, KeyError, ValueError, TypeError):
        return None


# the cast's own library calls these for members whose cast has a look
shaped.make, shaped.check = boned_of, bodies
