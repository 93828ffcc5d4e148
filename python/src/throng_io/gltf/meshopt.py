# SPDX-License-Identifier: Apache-2.0
"""EXT_meshopt_compression, by the library meshoptimizer."""
from __future__ import annotations

import numpy

from ..base.errors import ThrongError, need

EXTENSION = "EXT_meshopt_compression"
FIRST_BYTES = {"ATTRIBUTES": 0xA0, "TRIANGLES": 0xE1}  # of the versions that the extension has


def check() -> None:
    need("meshoptimizer", "meshopt")


def encode(data: bytes, width: int, mode: str) -> bytes:
    """@param width of an element, bytes"""
    encoder = need("meshoptimizer.encoder", "meshopt")
    if mode == "TRIANGLES":
        indices = numpy.frombuffer(data, dtype=numpy.uint16 if width == 2 else numpy.uint32).astype(numpy.uint32)
        packed = encoder.encode_index_buffer(indices, len(indices), int(indices.max(initial=0)) + 1)
    else:
        elements = numpy.frombuffer(data, dtype=numpy.uint8).reshape(-1, width)
        packed = encoder.encode_vertex_buffer(elements, len(elements), width)
    if packed[0] != FIRST_BYTES[mode]:
        raise ThrongError("this version of meshoptimizer writes a form that EXT_meshopt_compression does not have",
                          'python3 -m pip install "throng-io[meshopt]" brings one that fits')
    return packed
