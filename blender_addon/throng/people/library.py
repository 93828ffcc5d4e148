# SPDX-License-Identifier: Apache-2.0
"""Reads a library of bodies, as scripts/body_library.py has made it."""
import os
import pathlib
import zipfile
from functools import lru_cache

import numpy

FORMAT = 1
VARIABLE = "THRONG_BODIES"
PACKED = pathlib.Path(__file__).with_name("bodies.npz")
TENTHS = 1e-4  # m


class LibraryError(Exception):
    """A library that cannot be read, in a line."""


def library_path():
    """Where the library is: what the environment names, or what the add-on was packed with; None without one."""
    named = os.environ.get(VARIABLE)
    if named:
        return pathlib.Path(named)
    return PACKED if PACKED.is_file() else None


@lru_cache(maxsize=2)
def load(path):
    return Bodies(path)


class Bodies:
    """The base mesh, what moves it, and what it hangs on."""

    def __init__(self, path):
        expected = "expected a library that scripts/body_library.py has made"
        try:
            with numpy.load(path) as arrays:
                found = {name: arrays[name] for name in arrays.files}
            if int(found["format"]) != FORMAT:
                raise LibraryError(f"{path} has the format {int(found['format'])}, not {FORMAT}: make it anew with "
                                   "scripts/body_library.py")
            self._take(found)
        except OSError as error:
            raise LibraryError(f"{path} cannot be read ({error.strerror or error}): {expected}") from error
        except (KeyError, ValueError, zipfile.BadZipFile) as error:
            raise LibraryError(f"{path} holds no bodies: {expected}") from error

    def _take(self, found):
        self.vertices = found["vertices"].astype(float)
        self.faces, self.face_group = found["faces"].astype(int), found["face_group"]
        self.groups = {str(name): number for number, name in enumerate(found["groups"])}
        self.bones = [str(name) for name in found["bones"]]
        self.bone = {name: number for number, name in enumerate(self.bones)}
        self.parents = found["bone_parents"].astype(int)
        self.heads, self.tails = found["bone_heads"].astype(int), found["bone_tails"].astype(int)
        self._joint = {str(name): number for number, name in enumerate(found["joint_names"])}
        self._joint_first = found["joint_first"].astype(int)
        self._joint_vertices = found["joint_vertices"].astype(int)
        self.rules = str(found["rules"])
        self._target = {str(name): number for number, name in enumerate(found["target_names"])}
        self._target_first = found["target_first"].astype(int)
        self._gaps, self._offsets = found["target_gaps"], found["target_offsets"]
        self._merges = [found[name].astype(int) for name in ("merge_first", "merge_gone", "merge_into")]
        self.weights = numpy.zeros((len(self.vertices), len(self.bones)), numpy.float32)
        for column in range(found["weights"].shape[1]):
            numpy.add.at(self.weights, (numpy.arange(len(self.vertices)), found["weight_bones"][:, column]),
                         found["weights"][:, column].astype(numpy.float32))

    def quads(self, group):
        return self.faces[self.face_group == self.groups[group]]

    def triangles(self, group):
        quads = self.quads(group)
        return numpy.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])

    def vertices_of(self, group):
        return numpy.unique(self.quads(group))

    def merges(self, group):
        """(vertices, the neighbours that they are merged into), the first to go first."""
        first, gone, into = self._merges
        part = slice(first[self.groups[group]], first[self.groups[group] + 1])
        return gone[part], into[part]

    def joints(self, shape):
        """Where all joints are in a shape of the base mesh."""
        sums = numpy.add.reduceat(shape[self._joint_vertices], self._joint_first[:-1])
        return sums / numpy.diff(self._joint_first)[:, None]

    def joint(self, shape, name):
        number = self._joint[f"joint-{name}"]
        return shape[self._joint_vertices[self._joint_first[number]:self._joint_first[number + 1]]].mean(axis=0)

    def target_names(self):
        return list(self._target)

    @lru_cache(maxsize=512)
    def target(self, name):
        """(vertices, how each moves, m), or None where the library has no such target."""
        number = self._target.get(name)
        if number is None:
            return None
        part = slice(self._target_first[number], self._target_first[number + 1])
        return numpy.cumsum(self._gaps[part].astype(int)), self._offsets[:, part].T * TENTHS

    def move(self, shape, name, share):
        """Adds a share of a target to a shape; nothing where there is no such target."""
        found = self.target(name) if share else None
        if found:
            shape[found[0]] += share * found[1]
