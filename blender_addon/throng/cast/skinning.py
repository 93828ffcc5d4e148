# SPDX-License-Identifier: Apache-2.0
"""Meshes that hang on bones, as numbers. No Blender here.

They hang on as few bones as their poses tell apart: fingers never move beside the hand, nor shoulder blades beside the
chest, so they need no place in what files keep of every pose.
"""
import numpy

MOST = 4          # bones that a vertex hangs on
SHARES = 4096.0   # steps of a share: what is finer is not seen, and files are smaller without it
_STILL = 1e-7     # how much a bone may move beside another one and still go with it


def _whole(matrices):
    """(..., 4, 4) of (..., 3, 4)."""
    last = numpy.broadcast_to((0.0, 0.0, 0.0, 1.0), (*matrices.shape[:-2], 1, 4))
    return numpy.concatenate([matrices, last], axis=-2)


def leaders_of(parents, matrices, leading=()):
    """(for each bone the one that it goes with, what takes it from its own rest to that one's).

    @param parents of each bone, who comes before it; @param matrices (P, B, 3, 4) in all poses; @param leading bones
    that go with none, even if they never move beside another one
    """
    whole = _whole(matrices)
    leaders, turns = [], []
    for bone, parent in enumerate(parents):
        leader, turn = bone, numpy.eye(4)
        if 0 <= parent < bone and bone not in leading:
            beside = numpy.linalg.inv(whole[:, leaders[parent]]) @ whole[:, bone]
            if numpy.abs(beside - beside[0]).max() < _STILL:
                leader, turn = leaders[parent], beside[0]
        leaders.append(leader)
        turns.append(turn)
    return numpy.array(leaders), numpy.stack(turns)


def hinged(points, weights, leaders, matrices):
    """(points at rest, weights) of a mesh on those bones alone that lead: of (V, 3) and (V, all bones).

    Points are where they come nearest to what all bones make of them, in some poses: what hangs on a collarbone and on
    an arm, say, has no one place at rest that would do in all.
    @param matrices (P, B, 3, 4) of all bones in these poses
    """
    used, column = numpy.unique(leaders, return_inverse=True)
    few = numpy.zeros((len(points), len(used)))
    for bone, place in enumerate(column):
        few[:, place] += weights[:, bone]
    few = strongest(few)
    whole = numpy.concatenate([points, numpy.ones((len(points), 1))], axis=1)
    shares = weights / weights.sum(axis=1, keepdims=True)
    wanted = numpy.einsum("vpij,vj->vpi", numpy.tensordot(shares, matrices, (1, 1)), whole)
    led = numpy.tensordot(few, matrices[:, used], (1, 1))  # V, P, 3, 4
    turned = led[..., :3]
    square = numpy.einsum("vpij,vpik->vjk", turned, turned)
    side = numpy.einsum("vpij,vpi->vj", turned, wanted - led[..., 3])
    return numpy.linalg.solve(square, side[..., None])[..., 0], few


def strongest(weights):
    """The MOST largest weights of every vertex, which add up to 1."""
    kept, order = numpy.zeros_like(weights), numpy.argsort(-weights, axis=1, kind="stable")[:, :MOST]
    numpy.put_along_axis(kept, order, numpy.take_along_axis(weights, order, axis=1), axis=1)
    return kept / kept.sum(axis=1, keepdims=True)


def hangs_of(weights):
    """(V, MOST) of weights (V, B)."""
    order = numpy.argsort(-weights, axis=1, kind="stable")[:, :MOST]
    shares = numpy.rint(numpy.take_along_axis(weights, order, axis=1) * SHARES).clip(0.0, SHARES - 1.0) / SHARES
    shares[:, 0] = 0.0  # is what the others leave
    hangs = numpy.zeros((len(weights), MOST))
    hangs[:, :order.shape[1]] = numpy.where((shares > 0.0) | (numpy.arange(order.shape[1]) == 0), order + shares, 0.0)
    return hangs


def turns_of(matrices):
    """(..., 3): rotation vectors of turns (..., 3, 3)."""
    trace = numpy.trace(matrices, axis1=-2, axis2=-1)
    angle = numpy.arccos(numpy.clip(0.5 * (trace - 1.0), -1.0, 1.0))
    axis = numpy.stack([matrices[..., 2, 1] - matrices[..., 1, 2], matrices[..., 0, 2] - matrices[..., 2, 0],
                        matrices[..., 1, 0] - matrices[..., 0, 1]], axis=-1)
    length = numpy.linalg.norm(axis, axis=-1)
    assert (angle < 3.1).all(), "bones turn by less than half a round"
    return axis * numpy.where(length > 1e-9, angle / numpy.maximum(length, 1e-12), 0.5)[..., None]


def within_half_a_round(matrices):
    """Turns (B, 3, 3) as near to those as turns_of can tell: whatever would be half a round is a little less."""
    found = matrices.copy()
    for number, matrix in enumerate(matrices):
        if numpy.trace(matrix) < -0.995:  # about 176 degrees
            nudges = [matrices_of(sign * 0.07 * axis, numpy.zeros(3))[:, :3] @ matrix
                      for axis in numpy.eye(3) for sign in (-1.0, 1.0)]
            found[number] = max(nudges, key=numpy.trace)
    return found


def matrices_of(turns, moves):
    """(..., 3, 4): the contrary."""
    angle = numpy.linalg.norm(turns, axis=-1)[..., None, None]
    x, y, z = numpy.moveaxis(turns / numpy.maximum(angle[..., 0], 1e-12), -1, 0)
    none = 0.0 * x
    cross = numpy.stack([numpy.stack([none, -z, y], -1), numpy.stack([z, none, -x], -1),
                         numpy.stack([-y, x, none], -1)], -2)
    turned = numpy.eye(3) + numpy.sin(angle) * cross + (1.0 - numpy.cos(angle)) * cross @ cross
    return numpy.concatenate([turned, moves[..., None]], axis=-1)
