# SPDX-License-Identifier: Apache-2.0
"""The forms in which streams lie on the disk, as arrays."""
from __future__ import annotations

import pathlib
import struct

import numpy

from ..base.errors import BakeError

_PC2 = struct.Struct("<12siiffi")


def _npy(path: pathlib.Path, shape: tuple[int, int, int]) -> numpy.ndarray:
    # What is empty cannot be mapped.
    return numpy.load(path, mmap_mode="r" if shape[0] and shape[1] else None, allow_pickle=False)


def _pc2(path: pathlib.Path, shape: tuple[int, int, int]) -> numpy.ndarray:
    with open(path, "rb") as file:
        head = file.read(_PC2.size)
    if len(head) < _PC2.size:
        raise ValueError("it is too short to be a point cache")
    magic, version, people, _, _, frames = _PC2.unpack(head)
    if magic != b"POINTCACHE2\0" or version != 1:
        raise ValueError("it is no point cache of version 1")
    if (frames, people) != shape[:2]:
        raise ValueError(f"it holds {frames} frames of {people} people, expected {shape[0]} of {shape[1]}")
    if path.stat().st_size != _PC2.size + 4 * numpy.prod(shape, dtype=object):
        raise ValueError("it is not as long as its header says")
    if not shape[0] or not shape[1]:
        return numpy.empty(shape, numpy.float32)
    return numpy.memmap(path, "<f4", "r", _PC2.size, shape)


#: In the order in which they are preferred.
_READERS = {"npy": _npy, "pc2": _pc2}


def form_of(told: dict) -> str | None:
    """Which of a stream's forms is read: the member of bake.json that names its file."""
    return next((form for form in _READERS if isinstance(told.get(form), str)), None)


def open_stream(path: pathlib.Path, form: str, shape: tuple[int, int, int]) -> numpy.ndarray:
    """The whole stream, read-only, frames x people x 3. Raises BakeError."""
    try:
        array = _READERS[form](path, shape)
    except (OSError, ValueError) as error:
        raise BakeError(f"{path} cannot be read: {error}", "`throng verify` says what is damaged") from error
    if array.shape != shape or array.dtype != numpy.float32:
        raise BakeError(f"{path} is {array.shape} of {array.dtype}, expected {shape} of float32",
                        "`throng verify` says what is damaged")
    return array
