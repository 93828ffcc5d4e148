# SPDX-License-Identifier: Apache-2.0
"""Where the points of a bake's people are, by the add-on's own modules: what files with skeletons give again."""
import types

import numpy

from throng_io.cast import poses_of_build, skinning
from throng_io.people import person
from throng_io.skinned import carried as carried_
from throng_io.skinned import chosen, members, motions


def frames_of(bake, row):
    there = numpy.nonzero(bake.there()[:, row])[0]
    return there[[0, len(there) // 3, len(there) // 2, -1]].tolist()


def model_of(bake, number, bodies, level=0):
    """(points at rest, weights, joints as carried.bent() takes them) of a member."""
    roles, _ = members.cast_of(bake)
    maker, repertoire = person.Maker(bodies, roles[number].person()), members.repertoire_of(bake)
    model = maker.model(level)
    every = maker.rig.all_matrices(poses_of_build(maker.rig.build, repertoire))
    leaders = skinning.leaders_of(bodies.parents, every[::7], maker.rig.leading())
    rest, weights = skinning.hinged(model.points, model.weights, leaders[0], every[::19])
    used = numpy.unique(leaders[0])
    names = ["stick" if bodies.bones[bone] == "Root" else bodies.bones[bone] for bone in used]
    return rest, weights, types.SimpleNamespace(
        joints=names, places=numpy.array([maker.rig.heads[bodies.bones[bone]] for bone in used]), poses=every[:, used])


def in_the_world(bake, row, frame, points):
    cosine, sine = bake.dir[frame, row, :2]
    turned = points @ numpy.array([[cosine, sine, 0], [-sine, cosine, 0], [0, 0, 1]])
    return turned + bake.world(frame, row)


def expected(bake, row, frame, bodies, carried=True):
    """Points of the add-on's person, in the world: bent as one is near the camera. @param carried with a trunk that
    turns and a head that looks"""
    _, member_of = members.cast_of(bake)
    rest, weights, joints = model_of(bake, member_of[row], bodies)
    streams = {name: each[:, 0] for name, each in chosen.streams_of(bake, numpy.array([frame]), [row]).items()}
    track, repertoire = motions.track_of(row, numpy.array([frame + 1]), streams), members.repertoire_of(bake)
    bent = carried_.bent(joints, repertoire, track) if carried else motions.matrices_of(joints.poses, repertoire, track)
    return in_the_world(bake, row, frame, person.skinned(rest, weights, bent[:1])[0])


def off(found, wanted):
    """How far the farthest of these points is from the nearest of those, m."""
    return numpy.linalg.norm(wanted[None] - found[:, None], axis=2).min(axis=1).max()
