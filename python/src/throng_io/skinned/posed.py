# SPDX-License-Identifier: Apache-2.0
"""Meshes in poses."""
from __future__ import annotations

import numpy


def posed(points: numpy.ndarray, normals: numpy.ndarray, joints: numpy.ndarray, weights: numpy.ndarray,
          matrices: numpy.ndarray) -> tuple[numpy.ndarray, numpy.ndarray]:
    """(points, normals), F x V x 3 each: linear blends of four joints. @param matrices F x J x 3 x 4"""
    found, turned = [], []
    for pose in matrices:
        blend = numpy.einsum("vk,vkij->vij", weights, pose[joints])
        found.append(numpy.einsum("vij,vj->vi", blend[..., :3], points) + blend[..., 3])
        looks = numpy.einsum("vij,vj->vi", blend[..., :3], normals)
        turned.append(looks / numpy.maximum(numpy.linalg.norm(looks, axis=1, keepdims=True), 1e-12))
    return numpy.array(found), numpy.array(turned)
