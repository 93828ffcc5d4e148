# SPDX-License-Identifier: Apache-2.0
"""A glTF file in the making: what its JSON says, and the numbers in its one buffer (glTF 2.0, GLB)."""
from __future__ import annotations

import json
import os
import struct
from typing import Any

import numpy

from ..base.errors import ThrongError
from . import meshopt

MAGIC, GLTF_VERSION, JSON_CHUNK, BINARY_CHUNK = 0x46546C67, 2, 0x4E4F534A, 0x004E4942
TYPES = {1: "SCALAR", 2: "VEC2", 3: "VEC3", 4: "VEC4", 16: "MAT4"}
COMPONENTS = {"int8": 5120, "uint8": 5121, "int16": 5122, "uint16": 5123, "uint32": 5125, "float32": 5126}
VERTICES, INDICES = 34962, 34963  # what views are for
LARGEST_FILE = 2 ** 32 - 1        # bytes: a GLB tells its length in 32 bits


class Document:
    def __init__(self, compress: bool = False):
        self.compress = compress
        self.data = bytearray()
        self.unpacked = 0      # bytes, of what is compressed
        self.used: set[str] = set()
        self.required: set[str] = set()
        self.lists: dict[str, list[dict[str, Any]]] = {}
        self.roots: list[int] = []
        self.extras: dict[str, Any] = {}

    def add(self, kind: str, **values: Any) -> int:
        """The number of what is added to a list: "nodes", "meshes" ... What is None is left out."""
        told = self.lists.setdefault(kind, [])
        told.append({name: value for name, value in values.items() if value is not None})
        return len(told) - 1

    def root(self, **values: Any) -> int:
        """A node of the scene."""
        self.roots.append(self.add("nodes", **values))
        return self.roots[-1]

    def extension(self, name: str, required: bool = False) -> str:
        self.used.add(name)
        if required:
            self.required.add(name)
        return name

    # ---- numbers

    def vertices(self, values: numpy.ndarray, normalized: bool = False, bounds: bool = False) -> int:
        """An accessor to an attribute, V x N: what vertices have is aligned to four bytes."""
        width = values.shape[1] * values.itemsize
        stride = (width + 3) // 4 * 4
        rows = numpy.zeros((len(values), stride), dtype=numpy.uint8)
        rows[:, :width] = numpy.ascontiguousarray(values).view(numpy.uint8).reshape(len(values), width)
        view = self._view(rows.tobytes(), stride, "ATTRIBUTES", VERTICES, stride)
        return self._accessor(view, 0, values, normalized, bounds)

    def indices(self, faces: numpy.ndarray) -> int:
        values = faces.astype(numpy.uint16 if faces.max(initial=0) < 65535 else numpy.uint32).reshape(-1, 1)
        view = self._view(values.tobytes(), values.itemsize, "TRIANGLES", INDICES)
        return self._accessor(view, 0, values, False, False)

    def numbers(self, several: list[numpy.ndarray], normalized: bool = False, bounds: bool = False) -> list[int]:
        """Accessors to arrays of one kind that lie one behind the other: samples of animations, matrices."""
        width = several[0].shape[1] * several[0].itemsize
        view = self._view(b"".join(numpy.ascontiguousarray(each).tobytes() for each in several), width, "ATTRIBUTES")
        places = numpy.cumsum([0] + [each.nbytes for each in several]).tolist()
        return [self._accessor(view, place, each, normalized, bounds) for place, each in zip(places, several)]

    def _accessor(self, view: int, place: int, values: numpy.ndarray, normalized: bool, bounds: bool) -> int:
        return self.add("accessors", bufferView=view, byteOffset=place or None, count=len(values),
                        componentType=COMPONENTS[values.dtype.name], type=TYPES[values.shape[1]],
                        normalized=normalized or None, min=values.min(axis=0).tolist() if bounds else None,
                        max=values.max(axis=0).tolist() if bounds else None)

    def _view(self, data: bytes, width: int, mode: str, target: int | None = None, stride: int | None = None) -> int:
        """@param width of an element, bytes"""
        if not self.compress:
            return self.add("bufferViews", buffer=0, byteOffset=self._put(data), byteLength=len(data),
                            byteStride=stride, target=target)
        packed = meshopt.encode(data, width, mode)
        place = self._put(packed)
        beside = (self.unpacked + 3) // 4 * 4
        self.unpacked = beside + len(data)
        name = self.extension(meshopt.EXTENSION, required=True)
        return self.add("bufferViews", buffer=1, byteOffset=beside, byteLength=len(data), byteStride=stride,
                        target=target, extensions={name: {
                            "buffer": 0, "byteOffset": place, "byteLength": len(packed), "byteStride": width,
                            "count": len(data) // width, "mode": mode}})

    def _put(self, data: bytes) -> int:
        self.data += bytes(-len(self.data) % 4)
        place = len(self.data)
        self.data += data
        return place

    @property
    def size(self) -> int:
        """Bytes of the buffer until now."""
        return len(self.data)

    # ---- the file

    def told(self) -> dict[str, Any]:
        told: dict[str, Any] = {"asset": {"version": "2.0", "generator": "throng-io"}}
        if self.used:
            told["extensionsUsed"] = sorted(self.used)
        if self.required:
            told["extensionsRequired"] = sorted(self.required)
        told["scene"] = 0
        told["scenes"] = [{"nodes": self.roots} | ({"extras": self.extras} if self.extras else {})]
        told |= self.lists
        told["buffers"] = [{"byteLength": len(self.data)}]
        if self.compress:
            told["buffers"].append({"byteLength": self.unpacked, "extensions": {
                meshopt.EXTENSION: {"fallback": True}}})
        return told

    def write(self, path: str | os.PathLike) -> None:
        self.data += bytes(-len(self.data) % 4)
        text = json.dumps(self.told(), separators=(",", ":"), allow_nan=False).encode()
        text += b" " * (-len(text) % 4)
        length = 12 + 8 + len(text) + 8 + len(self.data)
        if length > LARGEST_FILE:
            raise ThrongError(f"{os.fspath(path)} would have {length} bytes, and a .glb ends at {LARGEST_FILE}",
                              "write fewer people, or frames")
        with open(path, "wb") as file:
            file.write(struct.pack("<IIIII", MAGIC, GLTF_VERSION, length, len(text), JSON_CHUNK))
            file.write(text)
            file.write(struct.pack("<II", len(self.data), BINARY_CHUNK))
            file.write(self.data)
