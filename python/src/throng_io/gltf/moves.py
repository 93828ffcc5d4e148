# SPDX-License-Identifier: Apache-2.0
"""Motions of nodes in a glTF file: samples, and channels that take them to nodes."""
from __future__ import annotations

import numpy

from ..skinned.motions import Joints
from . import axes
from .document import Document

STILL = 2e-5      # m: joints that move less beside those above stay where they are at rest
FULL16 = 32767


class Moves:
    """One animation."""

    def __init__(self, document: Document, quantize: bool = False):
        self.to, self.quantize = document, quantize
        self.channels: list[dict] = []
        self.samplers: list[dict] = []

    def times(self, seconds: numpy.ndarray) -> int:
        return self.to.numbers([seconds.astype(numpy.float32).reshape(-1, 1)], bounds=True)[0]

    def move(self, node: int, path: str, times: int, values: int, interpolation: str | None = None) -> None:
        """@param times, values accessors"""
        told = {"input": times, "output": values}
        self.samplers.append({**told, "interpolation": interpolation} if interpolation else told)
        self.channels.append({"sampler": len(self.samplers) - 1, "target": {"node": node, "path": path}})

    def joints(self, nodes: list[int], places: numpy.ndarray, times: int, joints: Joints) -> None:
        """@param places J x 3, of joints at rest beside those above them"""
        turns = self.turns([axes.own_turns(joints.rotations[:, joint]) for joint in range(len(nodes))])
        for node, values in zip(nodes, turns):
            self.move(node, "rotation", times, values)
        moving = numpy.nonzero(numpy.abs(joints.translations - places).max(axis=(0, 2)) > STILL)[0].tolist()
        if moving:
            moves = self.places([axes.own(joints.translations[:, joint]) for joint in moving])
            for joint, values in zip(moving, moves):
                self.move(nodes[joint], "translation", times, values)

    def turns(self, several: list[numpy.ndarray]) -> list[int]:
        if self.quantize:
            return self.to.numbers([numpy.rint(each * FULL16).astype(numpy.int16) for each in several], True)
        return self.to.numbers([each.astype(numpy.float32) for each in several])

    def places(self, several: list[numpy.ndarray]) -> list[int]:
        return self.to.numbers([each.astype(numpy.float32) for each in several])

    def write(self, name: str, extras: dict | None = None) -> None:
        if self.channels:
            self.to.add("animations", name=name, channels=self.channels, samplers=self.samplers, extras=extras)


def beside_those_above(places: numpy.ndarray, parents: list[int]) -> numpy.ndarray:
    """J x 3 of joints at rest."""
    return places - numpy.array([places[parent] if parent >= 0 else numpy.zeros(3) for parent in parents])
