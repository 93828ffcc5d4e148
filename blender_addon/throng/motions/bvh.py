# SPDX-License-Identifier: Apache-2.0
"""Reads motion capture in Biovision's format (.bvh). No Blender here: its own importer is not there in all versions,
and takes files that are cut off, or hold no numbers, as they are.
"""
import math
import os

import numpy

from . import MotionError
from .takes import Take

MOST_BYTES, MOST_JOINTS, MOST_FRAMES = 256 << 20, 1000, 200_000
_AXES = {"x": 0, "y": 1, "z": 2}
_EXPECTED = "expected a .bvh file as motion capture programs write it"


class _Joint:
    def __init__(self, name, parent):
        self.name, self.parent = name, parent
        self.offset, self.end = None, None
        self.places, self.turns = [], []  # [(axis, column)] of the frames' numbers


class _Words:
    """The words of a file, and in which line each stands."""

    def __init__(self, name, lines):
        self.name = name
        self.all = [(word, number) for number, line in enumerate(lines, 1) for word in line.split()]
        self.at, self.last = 0, len(lines)

    def fail(self, what, line=None):
        line = line or (self.all[self.at - 1][1] if self.at else 1)
        raise MotionError(f"{self.name}, line {line}: {what}")

    def next(self, wanted):
        if self.at == len(self.all):
            self.fail(f"the file ends where {wanted} should come: it is truncated", self.last)
        self.at += 1
        return self.all[self.at - 1][0]

    def expect(self, word):
        found = self.next(word)
        if found.lower() != word.lower():
            self.fail(f"found {found[:40]!r} where {word} should come")

    def number(self, what):
        word = self.next(what)
        try:
            value = float(word)
        except ValueError:
            value = math.nan
        if not math.isfinite(value):
            self.fail(f"{what}: {word[:40]!r} is no number")
        return value

    def until_brace(self):
        """A name, which may have spaces."""
        found = []
        while (word := self.next("{")) != "{":
            found.append(word)
        return " ".join(found)


def read(path):
    """The Take of a file, in the file's own axes. Raises MotionError."""
    name = os.path.basename(path)
    try:
        if os.path.getsize(path) > MOST_BYTES:
            raise MotionError(f"{name} has {os.path.getsize(path) >> 20} MiB: clips of up to {MOST_BYTES >> 20} are "
                              "read")
        with open(path, encoding="utf-8", errors="replace") as file:
            lines = file.read().split("\n")
    except OSError as error:
        raise MotionError(f"{name} cannot be read: {error.strerror}") from None
    first = next((number for number, line in enumerate(lines) if line.strip().upper() == "MOTION"), len(lines))
    joints, columns = _hierarchy(_Words(name, lines[:first]))
    if first == len(lines):
        raise MotionError(f"{name}, line {len(lines)}: the file ends without the line MOTION: it is truncated")
    numbers, seconds = _motion(name, lines, first, columns)
    return _take(os.path.splitext(name)[0], joints, numbers, 1.0 / seconds)


def _hierarchy(words):
    """([_Joint], how many numbers a frame has)"""
    if not words.all or words.all[0][0].upper() != "HIERARCHY":
        words.fail(f"the file does not begin with HIERARCHY: {_EXPECTED}", 1)
    words.next("HIERARCHY")
    words.expect("ROOT")
    joints, columns = [_Joint(words.until_brace(), -1)], 0
    above = [0]  # of the joint that is being read, and of those above it
    while above:
        word = words.next("}").lower()
        if word == "offset":
            joints[above[-1]].offset = [words.number("OFFSET") for _ in range(3)]
        elif word == "channels":
            columns = _channels(words, joints[above[-1]], columns)
        elif word == "joint":
            joints.append(_Joint(words.until_brace(), above[-1]))
            above.append(len(joints) - 1)
        elif word == "end":
            _end_site(words, joints[above[-1]])
        elif word == "}":
            above.pop()
        else:
            words.fail(f"found {word[:40]!r} where OFFSET, CHANNELS, JOINT, End Site or }} should come")
        if len(joints) > MOST_JOINTS:
            words.fail(f"more than {MOST_JOINTS} joints: {_EXPECTED}")
    if words.at < len(words.all):
        words.fail(f"found {words.next('MOTION')[:40]!r} where MOTION should come: one skeleton a file is read")
    for joint in joints:
        if joint.offset is None:
            words.fail(f"the joint {joint.name} has no OFFSET")
    return joints, columns


def _channels(words, joint, columns):
    count = words.number("CHANNELS")
    if not 0 <= count <= 6 or count != int(count) or joint.places or joint.turns:
        words.fail(f"the joint {joint.name} has {count:g} channels, or has them twice: up to six are known")
    for column in range(columns, columns + int(count)):
        channel = words.next("a channel").lower()
        axis, kind = _AXES.get(channel[:1]), {"position": joint.places, "rotation": joint.turns}.get(channel[1:])
        if axis is None or kind is None:
            words.fail(f"{channel[:40]!r} is no channel: expected Xposition, Yrotation and so on")
        kind.append((axis, column))
    return columns + int(count)


def _end_site(words, joint):
    words.until_brace()
    words.expect("OFFSET")
    joint.end = [words.number("OFFSET") for _ in range(3)]
    words.expect("}")


def _of_line(name, lines, number, what):
    """What stands behind `what:` in a line."""
    while number < len(lines) and not lines[number].strip():
        number += 1
    label, _, value = (lines[number] if number < len(lines) else "").partition(":")
    if " ".join(label.lower().split()) != what.lower():
        raise MotionError(f"{name}, line {min(number + 1, len(lines))}: `{what}:` should come after MOTION")
    try:
        return float(value), number + 1
    except ValueError:
        raise MotionError(f"{name}, line {number + 1}: {what}: {value.strip()[:40]!r} is no number") from None


def _motion(name, lines, first, columns):
    """((N, columns) of the frames, seconds from one to the next)"""
    count, line = _of_line(name, lines, first + 1, "Frames")
    seconds, line = _of_line(name, lines, line, "Frame Time")
    if not 1 <= count <= MOST_FRAMES or count != int(count):
        raise MotionError(f"{name}, line {line - 1}: {count:g} frames: expected 1 to {MOST_FRAMES}")
    if not 1e-4 <= seconds <= 10.0:
        raise MotionError(f"{name}, line {line}: a frame time of {seconds:g} s: expected 0.0001 to 10")
    rows = []
    for number in range(line, len(lines)):
        words = lines[number].split()
        if words and len(rows) < count:
            rows.append(_frame(name, words, number + 1, columns, number == len(lines) - 1))
    if len(rows) < count:
        raise MotionError(f"{name}, line {len(lines)}: the file says {count:.0f} frames and holds {len(rows)}: it is "
                          "truncated")
    return numpy.array(rows), seconds


def _frame(name, words, number, columns, last):
    if len(words) != columns:
        cut = ": it is truncated" if last and len(words) < columns else ""
        raise MotionError(f"{name}, line {number}: a frame of {len(words)} numbers where the joints have {columns} "
                          f"channels{cut}")
    try:
        row = [float(word) for word in words]
    except ValueError:
        row = [math.nan]
    if not all(map(math.isfinite, row)):
        raise MotionError(f"{name}, line {number}: a frame with something that is no number")
    return row


def _turn(axis, degrees):
    """(N, 3, 3): turns about an axis."""
    s, c = numpy.sin(numpy.radians(degrees)), numpy.cos(numpy.radians(degrees))
    one, other = (axis + 1) % 3, (axis + 2) % 3
    found = numpy.zeros((len(degrees), 3, 3))
    found[:, axis, axis] = 1.0
    found[:, one, one] = found[:, other, other] = c
    found[:, other, one], found[:, one, other] = s, -s
    return found


def _take(name, joints, numbers, rate):
    rest = numpy.tile(numpy.eye(4), (len(joints), 1, 1))
    ends = numpy.full((len(joints), 3), numpy.nan)
    frames = numpy.tile(numpy.eye(4), (len(numbers), len(joints), 1, 1))
    for index, joint in enumerate(joints):
        own = frames[:, index]
        own[:, :3, 3] = joint.offset
        for axis, column in joint.places:
            own[:, axis, 3] = numbers[:, column]
        for axis, column in joint.turns:
            own[:, :3, :3] = own[:, :3, :3] @ _turn(axis, numbers[:, column])
        rest[index, :3, 3] = joint.offset
        if joint.parent >= 0:
            rest[index] = rest[joint.parent] @ rest[index]
            frames[:, index] = frames[:, joint.parent] @ own
        if joint.end is not None:
            ends[index] = rest[index, :3, 3] + joint.end
    names, parents = (tuple(getattr(joint, what) for joint in joints) for what in ("name", "parent"))
    return Take(name, names, parents, rest, ends, frames, rate)
