# SPDX-License-Identifier: Apache-2.0
"""People whose ways are given, as properties: a file of trajectories, or ways that a layout tells point by point, which
are kept as they are. Pure Python."""
import os

from . import fields
from .codecs import Codec, Text, put_all, take_all
from .places import keep_raw, raw_of
from .values import MISSING, is_point, short, single


class Offset(Codec):
    def shown(self, raw):
        return tuple(single(part) for part in raw) if is_point(raw) else (0.0, 0.0)

    def present(self, group):
        return tuple(getattr(group, self.attribute))

    def written(self, value):
        return [short(part) for part in value] if any(value) else MISSING


FILE, FPS = Text("file"), fields.GIVEN_FPS
GIVEN = (Offset("offset"),) + fields.GIVEN


def put_given(given, raw, world):
    keep_raw(given, raw)
    given.name = raw["id"] if isinstance(raw.get("id"), str) else ""
    given.source = "WAYS" if "ways" in raw and "file" not in raw else "FILE"
    put_all((FILE, FPS, *GIVEN), given, raw, world)


def take_given(given, world):
    raw = raw_of(given)
    raw = {} if raw is MISSING else raw
    named = {} if not given.name and not isinstance(raw.get("id"), str) else {"id": given.name}
    result = take_all(GIVEN, given, {**named, **{key: value for key, value in raw.items() if key not in named}})
    if given.source == "FILE" and ("ways" not in raw or given.file):
        result = _of_a_file(given, result, world)
    return result


def _of_a_file(given, result, world):
    """Also where ways were told before."""
    before = result.get("file")
    result = take_all((FILE, FPS), given, result)
    if before is None:
        result.pop("ways", None)
    if result.get("file", before) != before:
        result["file"] = world.file(result["file"])
    return result


def from_folder(path, folder):
    """As a layout in this folder names it; what lies elsewhere by all of its path. A path that is not whole is one
    beside the layout already."""
    if folder and os.path.isabs(path):
        beside = os.path.relpath(path, folder)
        return path if beside.startswith(os.pardir) else beside
    return path
