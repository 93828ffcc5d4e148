# SPDX-License-Identifier: Apache-2.0
"""Rotations, and a leg's inverse kinematics. Pure maths on numpy arrays: no Blender here."""
import numpy


def rotation_part(matrices):
    """The nearest rotations (..., 3, 3), and the scales (..., 3) of the axes."""
    axes = matrices[..., :3, :3]
    scales = numpy.linalg.norm(axes, axis=-2)
    u, _, v = numpy.linalg.svd(axes / numpy.maximum(scales, 1e-12)[..., None, :])
    return u @ v, scales


def straightened(matrices):
    """Matrices that were blended, as rotations again."""
    return rescaled(matrices, rotation_part(matrices)[1])


def rescaled(matrices, scales):
    """Matrices that were blended, as rotations again, and scaled: turns that are far apart blend to less."""
    result = matrices.copy()
    result[..., :3, :3] = rotation_part(matrices)[0] * scales[..., None, :]
    return result


def _unit(vector):
    return vector / max(1e-12, float(numpy.linalg.norm(vector)))


def _frame(along, normal):
    x = _unit(along)
    z = _unit(normal - x * float(normal @ x))
    return numpy.stack([x, numpy.cross(z, x), z], axis=1)


def turn_between(before, after):
    """The smallest rotation from one direction to another."""
    a, b = _unit(before), _unit(after)
    cross, cosine = numpy.cross(a, b), float(a @ b)
    if cosine < -0.9999:
        return numpy.diag([-1.0, -1.0, 1.0])
    k = numpy.array([[0.0, -cross[2], cross[1]], [cross[2], 0.0, -cross[0]], [-cross[1], cross[0], 0.0]])
    return numpy.eye(3) + k + k @ k / (1.0 + cosine)


def about(rotation, centre, to=None):
    """A 4 x 4 matrix that turns about a point, and takes the point along."""
    matrix = numpy.eye(4)
    matrix[:3, :3] = rotation
    matrix[:3, 3] = (centre if to is None else to) - rotation @ centre
    return matrix


def bend(hip, knee, ankle, target, sideways=numpy.array([0.0, 1.0, 0.0])):
    """How thigh and shin move so that the ankle comes to the target, the knee bent as it was, or
    forwards where it was straight.

    @return (4 x 4 of the thigh, 4 x 4 of the shin, where the ankle comes to: short of the target
    where the leg is too short)
    """
    thigh, shin = float(numpy.linalg.norm(knee - hip)), float(numpy.linalg.norm(ankle - knee))
    way = target - hip
    distance = float(numpy.clip(numpy.linalg.norm(way), abs(thigh - shin) * 1.001 + 1e-6, (thigh + shin) * 0.9995))
    normal = numpy.cross(knee - hip, ankle - knee)
    if numpy.linalg.norm(normal) < 0.05 * thigh * shin or normal @ sideways < 0.0:
        normal = sideways
    turned = turn_between(ankle - hip, way) @ normal
    u = _unit(way)
    turned = _unit(turned - u * float(turned @ u))
    along = (thigh ** 2 - shin ** 2 + distance ** 2) / (2.0 * distance)
    aside = numpy.sqrt(max(0.0, thigh ** 2 - along ** 2))
    bent = hip + u * along + numpy.cross(u, turned) * aside
    reached = hip + u * distance
    thigh_turn = _frame(bent - hip, turned) @ _frame(knee - hip, normal).T
    shin_turn = _frame(reached - bent, turned) @ _frame(ankle - knee, normal).T
    return about(thigh_turn, hip), about(shin_turn, knee, bent), reached
