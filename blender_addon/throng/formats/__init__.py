# SPDX-License-Identifier: Apache-2.0
"""What a bake on disk holds, checked. Pure Python: no Blender, no numpy."""
import json
import os
import struct

STREAMS = ("pos", "dir", "state")
FEET = ("left_foot", "right_foot")
POSE = (*FEET, "carriage", "gaze", "attention")  # that bakes are asked for
UNDER_WAY = "under-way.json"        # beside the streams of a bake that is not one yet
_PC2 = struct.Struct("<12siiffi")
_PC2_MAGIC = b"POINTCACHE2\0"


class BakeError(Exception):
    """A bake cannot be used; the message says why and what to do."""


class NoPointCaches(BakeError):
    """A bake's streams are whole, but in forms that Blender does not play."""


class Bake:
    """A bake's manifest, and where its streams are."""

    def __init__(self, manifest, folder):
        self.manifest = manifest
        self.folder = folder
        self.name = manifest.get("name") or os.path.basename(folder)
        self.agents = _whole(manifest, "agents")
        self.frames = _whole(manifest, "frames")
        self.fps = float(manifest.get("fps", 24.0))
        self.strides = _strides(manifest)
        self.gaits = _gaits(manifest, len(self.strides))
        self.variations = max(1, int(manifest.get("variations", 1)))
        geometry = manifest.get("geometry")
        has_seats = bool(isinstance(geometry, dict) and geometry.get("seats"))
        # What people do in seats and with their hands: nothing, what audiences do there, or all of it.
        self.poses = "all" if manifest.get("poses") else "audience" if has_seats else ""
        self.complete = bool(manifest.get("complete", False))
        self.origin = tuple(float(value) for value in manifest.get("origin", (0.0, 0.0, 0.0)))

    @property
    def streams(self):
        """Those of every bake, `ground` where it has a terrain, and those of POSE that it was asked for."""
        told = self.manifest.get("streams")
        told = told if isinstance(told, dict) else {}
        # Where it is told how heads turn, nobody has to guess it from where people look.
        asked = tuple(stream for stream in POSE if stream in told and not (stream == "gaze" and "attention" in told))
        return STREAMS + (("ground",) if self.manifest.get("terrain") else ()) + asked

    @property
    def terrain_path(self):
        """The terrain's mesh, or None where the ground is flat."""
        terrain = self.manifest.get("terrain")
        if not terrain:
            return None
        name = terrain.get("file") if isinstance(terrain, dict) else None
        if not isinstance(name, str) or os.path.basename(name) != name or not name:
            raise BakeError("bake.json: `terrain` names no file of the bake's folder: bake again")
        return os.path.join(self.folder, name)

    def stream_path(self, stream):
        """Of its point cache, which is what Blender plays."""
        try:
            told = self.manifest["streams"][stream]
            relative = told.get("pc2")
        except (KeyError, TypeError, AttributeError):
            raise BakeError(f"bake.json names no files for the stream `{stream}`: bake again") from None
        if relative is None:
            raise NoPointCaches(f"this bake has no point caches, which Blender plays: `throng convert {self.folder} "
                                "-o NEW --streams pc2` makes a bake that has them")
        return os.path.join(self.folder, *relative.split("/"))


def _strides(manifest):
    strides = manifest.get("strides")
    if not isinstance(strides, list) or not 1 <= len(strides) <= 16 or not all(
            isinstance(stride, (int, float)) and 0.1 < stride < 10.0 for stride in strides):
        raise BakeError("bake.json: `strides` should be the gaits' stride lengths in metres, "
                        f"found {strides!r}: bake again")
    return tuple(float(stride) for stride in strides)


def _gaits(manifest, count):
    """(first, last) of those that somebody walks with; all, where the manifest is older than the list."""
    gaits = manifest.get("gaits") or range(count)
    if not isinstance(gaits, (list, range)) or not all(isinstance(gait, int) and 0 <= gait < count for gait in gaits):
        raise BakeError(f"bake.json: `gaits` should list numbers of `strides`, from 0 to {count - 1}, "
                        f"found {gaits!r}: bake again")
    return min(gaits), max(gaits)


def _whole(manifest, key):
    value = manifest.get(key)
    if not isinstance(value, int) or isinstance(value, bool) or value < 0:
        raise BakeError(f"bake.json: `{key}` should be a whole number, found {value!r}")
    return value


def check_pc2(path, points, samples):
    """Compares a PC2 file's header and size with what the manifest says."""
    name = os.path.basename(path)
    try:
        size = os.path.getsize(path)
        with open(path, "rb") as file:
            header = file.read(_PC2.size)
    except OSError as error:
        raise BakeError(f"the stream {name} cannot be read: {error.strerror}. Copy the whole bake "
                        "folder, not only bake.json") from None
    if len(header) < _PC2.size:
        raise BakeError(f"{name} is not a point cache: it has only {size} bytes")
    magic, version, file_points, _, _, file_samples = _PC2.unpack(header)
    if magic != _PC2_MAGIC or version != 1:
        raise BakeError(f"{name} is not a PC2 point cache of version 1")
    if file_points != points or file_samples != samples:
        raise BakeError(f"{name} holds {file_samples} frames of {file_points} people, bake.json says {samples} of "
                        f"{points}: the files are of different bakes")
    expected = _PC2.size + 12 * points * samples
    if size != expected:
        raise BakeError(f"{name} is truncated: {size} of {expected} bytes. Copy or bake it again")


def read_manifest(path):
    """The content of a bake.json (or of the folder that holds it). Raises BakeError."""
    if os.path.isdir(path):
        path = os.path.join(path, "bake.json")
    beside = os.path.join(os.path.dirname(path), UNDER_WAY)
    if os.path.exists(beside) and (os.path.basename(path) == UNDER_WAY or not os.path.exists(path)):
        raise BakeError("this bake is under way: File > Import > Throng bake under way shows it as far as it has come")
    try:
        with open(path, encoding="utf-8") as file:
            manifest = json.load(file)
    except OSError as error:
        raise BakeError(f"{path} cannot be read: {error.strerror}") from None
    except ValueError as error:
        raise BakeError(f"{path} is not JSON: {error}") from None
    if not isinstance(manifest, dict) or manifest.get("format") != "throng bake":
        raise BakeError(f"{os.path.basename(path)} is not the manifest of a Throng bake: choose the file "
                        "bake.json in the bake's folder")
    if manifest.get("version") != 1:
        raise BakeError(f"this bake has format version {manifest.get('version')}, the add-on reads "
                        "version 1: update the add-on")
    return manifest


def load_bake(path):
    """Reads bake.json (or the folder that holds it) and checks its streams. Raises BakeError."""
    manifest = read_manifest(path)
    folder = path if os.path.isdir(path) else os.path.dirname(path)
    bake = Bake(manifest, os.path.abspath(folder))
    if bake.agents == 0 or bake.frames == 0:
        raise BakeError("there is nobody in this bake")
    for stream in bake.streams:
        check_pc2(bake.stream_path(stream), bake.agents, bake.frames)
    return bake
