# SPDX-License-Identifier: Apache-2.0
"""Which bone moves which vertex. Pure maths on numpy arrays: no Blender here."""
from dataclasses import dataclass

import numpy


@dataclass
class Skin:
    """Which bone moves which vertex, for measuring: rest positions in the armature's space, and four weights each."""
    rest: numpy.ndarray     # (V, 3)
    bones: numpy.ndarray    # (V, 4) int
    weights: numpy.ndarray  # (V, 4)


def skinned(skin, chosen, matrices, rest):
    """(..., len(chosen), 3): where those vertices are for bone matrices (..., B, 4, 4)."""
    moves = matrices @ numpy.linalg.inv(rest)
    points = numpy.concatenate([skin.rest[chosen], numpy.ones((len(chosen), 1))], axis=1)
    total = numpy.zeros(matrices.shape[:-3] + (len(chosen), 4))
    for slot in range(skin.bones.shape[1]):
        moved = numpy.einsum("...vij,vj->...vi", moves[..., skin.bones[chosen, slot], :, :], points)
        total += skin.weights[chosen, slot][:, None] * moved
    return total[..., :3] / numpy.maximum(1e-9, skin.weights[chosen].sum(axis=1))[:, None]
