# SPDX-License-Identifier: Apache-2.0
"""The forms in which streams lie on the disk, as arrays."""
from __future__ import annotations

import contextlib
import pathlib
import struct

import numpy

from ..base.errors import BakeError
from .packed import PackedStream

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


def _packed(path: pathlib.Path, shape: tuple[int, int, int]) -> numpy.ndarray:
    stream = PackedStream(path)
    return stream.whole() if stream.shape == shape else numpy.broadcast_to(numpy.float32(0), stream.shape)


#: In the order in which they are preferred.
_READERS = {"npy": _npy, "pc2": _pc2, "packed": _packed}


def form_of(told: dict) -> str | None:
    """Which of a stream's forms is read: the member of bake.json that names its file."""
    return next((form for form in _READERS if isinstance(told.get(form), str)), None)


@contextlib.contextmanager
def _told(path: pathlib.Path):
    """What is wrong with a file, as an error of this package."""
    try:
        yield
    except (OSError, ValueError) as error:
        raise BakeError(f"{path} cannot be read: {error}", "`throng verify` says what is damaged") from error


def open_stream(path: pathlib.Path, form: str, shape: tuple[int, int, int]) -> numpy.ndarray:
    """The whole stream, read-only, frames x people x 3. Raises BakeError."""
    with _told(path):
        array = _READERS[form](path, shape)
    if array.shape != shape or array.dtype != numpy.float32:
        raise BakeError(f"{path} is {array.shape} of {array.dtype}, expected {shape} of float32",
                        "`throng verify` says what is damaged")
    return array


class Frames:
    """Some frames of a stream at a time, of those that are unpacked only the blocks that have them."""

    def __init__(self, path: pathlib.Path, form: str, shape: tuple[int, int, int]):
        self._path, self._shape, self._array, self._packed = path, shape, None, None
        if form != "packed":
            self._array = open_stream(path, form, shape)
            return
        with _told(path):
            self._packed = PackedStream(path)
        if self._packed.shape != shape:
            raise BakeError(f"{path} is {self._packed.shape}, expected {shape}",
                            "`throng verify` says what is damaged")

    def read(self, first: int, last: int) -> numpy.ndarray:
        """Frames [first, last)."""
        first, last, _ = slice(first, last).indices(self._shape[0])
        if self._packed is None:
            return numpy.array(self._array[first:last])
        with _told(self._path):
            return self._packed.read(first, last)
