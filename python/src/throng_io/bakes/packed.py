# SPDX-License-Identifier: Apache-2.0
"""The form `packed` of a stream (docs/bake.md), read block by block."""
from __future__ import annotations

import collections
import pathlib
import struct
import tempfile

import numpy

from ..base.errors import need

_MAGIC, _END = b"THRONGP1", b"THRONGPE"
_TAIL = struct.Struct("<QQQ8s")
_HEAD = struct.Struct("<6I")
_COMPONENT = struct.Struct("<dII")
_COMPONENTS = 3
_MOST_CELLS, _MOST_FRAMES = 1 << 18, 256  # of a block
_IN_MEMORY = 256 << 20  # bytes of a stream that is unpacked as a whole; what is larger goes to a temporary file
_FIRST, _ZERO = 1, 2    # what people hold before they enter


class PackedStream:
    """A stream in a packed file: frames x people x 3. Raises ValueError where the file is none."""

    def __init__(self, path: pathlib.Path):
        self._decompressor = need("zstandard", "packed").ZstdDecompressor()
        self._path = path
        with open(path, "rb") as file:
            size = file.seek(0, 2)
            file.seek(0)
            if file.read(len(_MAGIC)) != _MAGIC:
                raise ValueError("it is no packed stream")
            if size < len(_MAGIC) + _HEAD.size + _COMPONENTS * _COMPONENT.size + _TAIL.size:
                raise ValueError("it is too short to be a packed stream")
            file.seek(size - _TAIL.size)
            begin, length, checksum, end = _TAIL.unpack(file.read(_TAIL.size))
            if end != _END or begin + length + _TAIL.size != size or begin < len(_MAGIC):
                raise ValueError("it has no end: truncated, or not completely written")
            file.seek(begin)
            directory = file.read(length)
        if need("xxhash", "packed").xxh3_64_intdigest(directory) != checksum:
            raise ValueError("its directory is damaged: the checksum is another one")
        self._read_directory(directory, begin)
        self._kept: collections.OrderedDict[int, numpy.ndarray] = collections.OrderedDict()

    @property
    def shape(self) -> tuple[int, int, int]:
        return self.frames, self.people, _COMPONENTS

    def _read_directory(self, content: bytes, end: int) -> None:
        head = _HEAD.size + _COMPONENTS * _COMPONENT.size
        if len(content) < head:
            raise ValueError("its directory is too short")
        version, self.frames, self.people, self._frames, self._people, components = _HEAD.unpack_from(content)
        if version != 1 or components != _COMPONENTS:
            raise ValueError(f"its version {version} is not known here")
        if not 0 < self._frames * self._people <= _MOST_CELLS or self._frames > _MOST_FRAMES:
            raise ValueError("it has blocks of a size that there is not")
        told = [_COMPONENT.unpack_from(content, _HEAD.size + i * _COMPONENT.size) for i in range(_COMPONENTS)]
        self._steps, self._before = [step for step, _, _ in told], [before for _, before, _ in told]
        self._groups = -(-self.people // self._people)
        blocks = -(-self.frames // self._frames) * self._groups
        if head + 4 * (blocks + self.people) > len(content):
            raise ValueError(f"its directory has no room for {self.frames} frames of {self.people} people")
        sizes = numpy.frombuffer(content, "<u4", blocks, head).astype(numpy.int64)
        self._offsets = numpy.concatenate([[len(_MAGIC)], len(_MAGIC) + numpy.cumsum(sizes)])
        if self._offsets[-1] != end:
            raise ValueError("its blocks do not end where its directory begins")
        self._first = numpy.frombuffer(content, "<u4", self.people, head + 4 * blocks)
        late = numpy.nonzero(self._first)[0]
        if head + 4 * (blocks + self.people) + 12 * len(late) != len(content):
            raise ValueError("it does not tell how everybody enters")
        self._entries = numpy.zeros((self.people, _COMPONENTS), numpy.int32)
        self._entries[late] = numpy.frombuffer(content, "<i4", 3 * len(late), len(content) - 12 * len(late)) \
            .reshape(-1, _COMPONENTS)

    def read(self, first: int, last: int) -> numpy.ndarray:
        """Frames [first, last), float32."""
        frames = numpy.empty((max(last - first, 0), self.people, _COMPONENTS), numpy.float32)
        for number in range(first // self._frames, -(-last // self._frames) if last > first else 0):
            start, block = number * self._frames, self._block_row(number)
            begin, end = max(first, start), min(last, start + len(block))
            frames[begin - first:end - first] = block[begin - start:end - start]
        return frames

    def _block_row(self, number: int) -> numpy.ndarray:
        """All people in the frames of one block; the last two are kept."""
        if number in self._kept:
            self._kept.move_to_end(number)
            return self._kept[number]
        start = number * self._frames
        values = numpy.empty((min(self._frames, self.frames - start), self.people, _COMPONENTS), numpy.float32)
        for group in range(self._groups):
            people = slice(group * self._people, min((group + 1) * self._people, self.people))
            values[:, people] = self._decoded(number * self._groups + group, start, people)
        values.flags.writeable = False
        self._kept[number] = values
        while len(self._kept) > 2:
            self._kept.popitem(last=False)
        return values

    def _decoded(self, index: int, start: int, people: slice) -> numpy.ndarray:
        shape = people.stop - people.start, min(self._frames, self.frames - start)
        content = self._decompressed(index, 2 * _COMPONENTS + 12 * shape[0] * shape[1])
        values = numpy.empty((shape[1], shape[0], _COMPONENTS), numpy.float32)
        at = 2 * _COMPONENTS
        for i in range(_COMPONENTS):
            order, planes = content[2 * i], content[2 * i + 1]
            if order > 2 or planes > 4 or at + planes * shape[0] * shape[1] > len(content):
                raise ValueError(f"block {index} is damaged")
            steps = _numbers(content, at, planes, shape)
            at += planes * shape[0] * shape[1]
            # What is told is what each number is off from what those before it let expect.
            if order == 2:
                steps[:, 1:] = numpy.cumsum(steps[:, 1:], axis=1, dtype=numpy.uint32)
            if order >= 1:
                steps = numpy.cumsum(steps, axis=1, dtype=numpy.uint32)
            steps = steps.view(numpy.int32)
            early = numpy.arange(start, start + shape[1]) < self._first[people][:, None]
            if self._before[i] == _FIRST:
                steps = numpy.where(early, self._entries[people, i][:, None], steps)
            if self._before[i] == _ZERO:
                steps = numpy.where(early, 0, steps)
            values[:, :, i] = (steps * self._steps[i]).T
        if at != len(content):
            raise ValueError(f"block {index} is damaged")
        return values

    def _decompressed(self, index: int, most: int) -> bytes:
        zstandard = need("zstandard", "packed")
        begin, end = int(self._offsets[index]), int(self._offsets[index + 1])
        with open(self._path, "rb") as file:
            file.seek(begin)
            packed = file.read(end - begin)
        try:
            # Looked at first: it says how much memory to take.
            if not 0 <= zstandard.frame_content_size(packed) <= most:
                raise ValueError(f"block {index} is not of the size that it should be")
            return self._decompressor.decompress(packed)
        except zstandard.ZstdError as error:
            raise ValueError(f"block {index} is damaged: {error}") from error

    def whole(self) -> numpy.ndarray:
        """All frames, read-only: in memory, or in a temporary file where they are many."""
        large = 4 * numpy.prod(self.shape, dtype=object) > _IN_MEMORY
        array = numpy.memmap(tempfile.TemporaryFile(), "<f4", "w+", shape=self.shape) if large else \
            numpy.empty(self.shape, numpy.float32)
        for first in range(0, self.frames, self._frames):
            last = min(first + self._frames, self.frames)
            array[first:last] = self.read(first, last)
        array.flags.writeable = False
        return array


def _numbers(content: bytes, at: int, planes: int, shape: tuple[int, int]) -> numpy.ndarray:
    """Whole numbers of both signs from their bytes, the lowest of all first."""
    cells = shape[0] * shape[1]
    numbers = numpy.zeros(cells, numpy.uint32)
    for plane in range(planes):
        numbers |= numpy.frombuffer(content, numpy.uint8, cells, at + plane * cells).astype(numpy.uint32) << (8 * plane)
    return ((numbers >> 1) ^ (0 - (numbers & 1)).astype(numpy.uint32)).reshape(shape)
