# SPDX-License-Identifier: Apache-2.0
"""Pictures of three numbers a pixel: OpenEXR of 32 or 16 bits, or PNG of 16 bits."""
from __future__ import annotations

import pathlib
import struct
import zlib

import numpy

from ..base.errors import ThrongError, need

KINDS = {"float": ".exr", "half": ".exr", "png": ".png"}
ALL16 = 65535


def check(kind: str) -> None:
    if kind not in KINDS:
        raise ThrongError(f"texture: expected one of {', '.join(KINDS)}, found {kind!r}")
    if KINDS[kind] == ".exr":
        need("OpenEXR", "textures")


def write(path: pathlib.Path, values: numpy.ndarray, kind: str, low: numpy.ndarray, high: numpy.ndarray) -> None:
    """@param values rows x columns x 3; @param low, high what the numbers of a PNG are between"""
    if kind == "png":
        share = (values - low) / (high - low)
        path.write_bytes(png(numpy.rint(share.clip(0.0, 1.0) * ALL16).astype(">u2")))
        return
    library = need("OpenEXR", "textures")
    pixels = values.astype(numpy.float16 if kind == "half" else numpy.float32)
    header = {"compression": library.ZIP_COMPRESSION, "type": library.scanlineimage}
    channels = {name: numpy.ascontiguousarray(pixels[..., place]) for place, name in enumerate("RGB")}
    with library.File(header, channels) as file:
        file.write(str(path))


def png(pixels: numpy.ndarray) -> bytes:
    """Of rows x columns x 3 numbers of 16 bits, big end first (ISO/IEC 15948)."""
    rows, columns = pixels.shape[:2]
    lines = numpy.zeros((rows, 1 + columns * 6), dtype=numpy.uint8)
    lines[:, 1:] = numpy.ascontiguousarray(pixels).view(numpy.uint8).reshape(rows, -1)
    return b"\x89PNG\r\n\x1a\n" + b"".join([
        _chunk(b"IHDR", struct.pack(">IIBBBBB", columns, rows, 16, 2, 0, 0, 0)),
        _chunk(b"IDAT", zlib.compress(lines.tobytes(), 6)), _chunk(b"IEND", b"")])


def _chunk(name: bytes, data: bytes) -> bytes:
    return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))
