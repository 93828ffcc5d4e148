# SPDX-License-Identifier: Apache-2.0
"""Reads .glb files, and poses what is in them, by the specification alone."""
import json
import pathlib
import struct

import numpy

TYPES = {5120: numpy.int8, 5121: numpy.uint8, 5122: numpy.int16, 5123: numpy.uint16, 5125: numpy.uint32,
         5126: numpy.float32}
WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}


class Glb:
    def __init__(self, path):
        data = pathlib.Path(path).read_bytes()
        magic, version, length, text = struct.unpack_from("<4sIII", data)
        assert (magic, version, length) == (b"glTF", 2, len(data))
        self.told = json.loads(data[20:20 + text])
        self.binary = data[20 + text + 8:]
        nodes = self.told["nodes"]
        self.parent = {child: number for number, node in enumerate(nodes) for child in node.get("children", [])}
        self.named = {node["name"]: number for number, node in enumerate(nodes)}

    def accessor(self, number):
        told = self.told["accessors"][number]
        view = self.told["bufferViews"][told["bufferView"]]
        kind, width = numpy.dtype(TYPES[told["componentType"]]), WIDTHS[told["type"]]
        place = view.get("byteOffset", 0) + told.get("byteOffset", 0)
        stride = view.get("byteStride", width * kind.itemsize)
        found = numpy.ndarray((told["count"], width), kind, self.binary, place, (stride, kind.itemsize))
        if told.get("normalized"):
            return numpy.maximum(found / float(numpy.iinfo(kind).max), -1.0)
        return found.astype(float) if kind == numpy.float32 else found.astype(int)

    def animation(self, name):
        return next(each for each in self.told["animations"] if each["name"] == name)

    def sampled(self, animation, seconds):
        """{(node, path): value}: turns between keys by their chord, which is near enough for keys so close."""
        found = {}
        for channel in animation["channels"]:
            told = animation["samplers"][channel["sampler"]]
            times, values = self.accessor(told["input"])[:, 0], self.accessor(told["output"])
            place = numpy.clip(numpy.searchsorted(times, seconds + 1e-5, "right") - 1, 0, len(times) - 1)
            after = min(place + 1, len(times) - 1)
            gap = times[after] - times[place]
            share = 0.0 if told.get("interpolation") == "STEP" or gap == 0 else \
                float(numpy.clip((seconds - times[place]) / gap, 0, 1))
            path = channel["target"]["path"]
            found[channel["target"]["node"], path] = mixed(values[place], values[after], share, path)
        return found

    def place_of(self, node, pose):
        """4 x 4 to the world."""
        told = self.told["nodes"][node]
        move, turn, size = (numpy.array(pose.get((node, path), told.get(path, usual)), float) for path, usual in (
            ("translation", [0, 0, 0]), ("rotation", [0, 0, 0, 1]), ("scale", [1, 1, 1])))
        own = numpy.eye(4)
        own[:3, :3], own[:3, 3] = turned(turn) * size, move
        return self.place_of(self.parent[node], pose) @ own if node in self.parent else own

    def skinned(self, node, pose):
        """Points of a node's mesh in the world, of all its primitives."""
        told = self.told["nodes"][node]
        skin = self.told["skins"][told["skin"]]
        binds = self.accessor(skin["inverseBindMatrices"]).reshape(-1, 4, 4).swapaxes(1, 2)
        bends = numpy.array([self.place_of(joint, pose) for joint in skin["joints"]]) @ binds
        found = []
        for primitive in self.told["meshes"][told["mesh"]]["primitives"]:
            points, joints, weights = (self.accessor(primitive["attributes"][name])
                                       for name in ("POSITION", "JOINTS_0", "WEIGHTS_0"))
            whole = numpy.concatenate([points, numpy.ones((len(points), 1))], axis=1)
            found.append(numpy.einsum("vk,vkij,vj->vi", weights, bends[joints], whole)[:, :3])
        return numpy.concatenate(found)


def mixed(one, other, share, path="translation"):
    if path == "rotation":
        found = one + (other * numpy.sign(one @ other or 1.0) - one) * share
        return found / numpy.linalg.norm(found)
    return one + (other - one) * share


def turned(turn):
    x, y, z, w = turn
    return numpy.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])


def z_up(points):
    """In the world's axes, of points in a file's."""
    return numpy.stack([points[:, 0], -points[:, 2], points[:, 1]], axis=1)
