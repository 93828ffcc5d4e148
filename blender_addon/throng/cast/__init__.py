# SPDX-License-Identifier: Apache-2.0
"""The people that the add-on ships, and the order that they are kept in.

A cast is a collection that is not in the scene, of figures (sheets.py): one object for each member at each level of
detail, with the custom properties `throng_member`, its number as the bake has them (variations), and `throng_level` (0
is the finest). A figure brings an instance of each of its poses, in order: the gaits first, each a cycle from the right
heel's strike on, then the beats of the standing clips (Repertoire numbers them). The collection's `throng_variations`
says how many members there are, `throng_levels` how many levels the crowd shows. `throng_person` is there where the
add-on's own cast made a figure, `throng_character` where it was brought along. The collection's `throng_bodies` is the
look of people who are shaped from a library of bodies (people/members.py); without it they are made of lofts
(figure.py). Figures look along +x and stand on z = 0; all take the bake's strides.
"""
from dataclasses import dataclass

import numpy

from . import gait, people, sitting
from .mesh_builder import Plan

VARIATIONS = len(people.CAST)
LEVELS = 3
POSES = 24  # of each gait's cycle, at level 0
BEATS = 4   # of each standing clip's round
LEVEL_POSES = (POSES, POSES, 8)  # far away, fewer do
LEVEL_BEATS = (BEATS, BEATS, 1)


@dataclass(frozen=True)
class Repertoire:
    """What everybody in a cast can do, and which pose is where, at each level of detail."""
    strides: tuple  # m, of each gait that there is
    first: int = 0  # the number that the bake gives the first of them
    clips: int = 0  # how many of sitting.CLIPS there are: none where nobody sits, or does things with its hands

    @classmethod
    def of(cls, strides, gaits, clips=0):
        """@param strides of all gaits that the bake knows of; @param gaits the first and the last that the cast has"""
        first, last = gaits
        return cls(tuple(strides[first:last + 1]), first, int(clips))

    def walking(self, level=0):
        """How many poses walk; the standing ones come after, and those of who has a seat last."""
        return len(self.strides) * LEVEL_POSES[level]

    def upright(self, level=0):
        """How many walk or stand."""
        return self.walking(level) + len(gait.STANDING_CLIPS) * LEVEL_BEATS[level]

    def poses(self, level=0):
        return self.upright(level) + sitting.poses_in(self.clips) * LEVEL_BEATS[level] // BEATS

    @property
    def count(self):
        return self.poses(0)

    def walking_pose(self, gait_index, phase, level=0):
        """@param gait_index as the bake numbers them"""
        poses = LEVEL_POSES[level]
        return (gait_index - self.first) * poses + min(poses - 1, int((phase % 1.0) * poses))

    def standing_pose(self, clip, beat, level=0):
        """@param beat one of BEATS, whatever the level"""
        beats = LEVEL_BEATS[level]
        return self.walking(level) + gait.STANDING_CLIPS.index(clip) * beats + beat * beats // BEATS

    def sources(self, level):
        """For each pose of a level, the one of level 0 that it is: the middle one of those that it stands for."""
        share, beats = POSES // LEVEL_POSES[level], BEATS // LEVEL_BEATS[level]
        return (list(range(share // 2, self.walking(), share)) + list(range(self.walking(), self.poses(), beats)))


def poses_of(person, repertoire):
    """All poses of level 0, in order. Tall or small, everybody takes the bake's strides: feet must not slide."""
    return poses_of_build(people.build_of(person), repertoire)


def poses_of_build(build, repertoire):
    """The same of whoever is built so."""
    gaits = [gait.gait_of(stride) for stride in repertoire.strides]
    return ([gait.walk_pose(index / POSES, build, each) for each in gaits for index in range(POSES)]
            + [gait.standing_pose(clip, beat / BEATS, build) for clip in gait.STANDING_CLIPS for beat in range(BEATS)]
            + sitting.poses_of(build, repertoire.clips))


def plan_of(figures, repertoire, level):
    """The mesh of a person at a level of detail; what it leaves out is told from a stand and quarters of each gait."""
    samples = [figures[index].rings for index in (*range(0, repertoire.walking(), POSES // 4), repertoire.walking())]
    return Plan(figures[0].parts, samples, level)


def limb_velocities(before, after, seconds):
    """m/s of every vertex in the walker's own frame, from those of the poses before and after,
    so many seconds apart."""
    return (numpy.asarray(after) - numpy.asarray(before)) / seconds
