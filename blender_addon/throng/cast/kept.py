# SPDX-License-Identifier: Apache-2.0
"""What was worked out of somebody once is kept in the user's cache: to shape and dress 64 people takes some ten seconds
of every import, to make the add-on's own twelve two, and they are the same each time.

A file for each thing, named by a hash of all that it depends on: who it is, what they can do, the library of bodies if
they are shaped from one, and the code of the add-on. Nothing else is ever in it, so what cannot be read is made anew,
and whoever empties the folder loses nothing but time. What nobody has asked for in the longest time goes when there is
too much.
"""
import hashlib
import os
import pathlib
import sys
import zipfile
from contextlib import suppress
from functools import lru_cache

import numpy

VARIABLE = "THRONG_CACHE"  # a folder, or "" for none
MOST = 400 << 20           # bytes in it
_CODE = ("people", "cast")  # packages of the add-on that shape people


def folder():
    """Where things are kept, or None."""
    named = os.environ.get(VARIABLE)
    if named is not None:
        return pathlib.Path(named) / "people" if named else None
    if sys.platform == "win32":
        base = os.environ.get("LOCALAPPDATA")
    elif sys.platform == "darwin":
        base = os.path.expanduser("~/Library/Caches")
    else:
        base = os.environ.get("XDG_CACHE_HOME") or os.path.expanduser("~/.cache")
    return pathlib.Path(base) / "throng" / "people" if base and os.path.isabs(base) else None


@lru_cache(maxsize=1)
def _code():
    """A hash of the code that shapes people."""
    found = hashlib.sha256(numpy.__version__.encode())
    for package in _CODE:
        for path in sorted((pathlib.Path(__file__).parents[1] / package).glob("*.py")):
            found.update(path.name.encode() + b"\0" + path.read_bytes())
    return found.digest()


@lru_cache(maxsize=4)
def _hash_of(path, _size, _changed):
    return hashlib.sha256(pathlib.Path(path).read_bytes()).digest()


def _name(what, files):
    found = hashlib.sha256(_code())
    for file in files:
        status = os.stat(file)
        found.update(_hash_of(str(file), status.st_size, status.st_mtime_ns))
    found.update(repr(what).encode())
    return f"{found.hexdigest()[:40]}.npz"


def kept(what, make, *files):
    """{name: array} as make() has it. @param what all that it depends on, but for the files; where one of these is None
    make() says so"""
    where = folder() if all(files) else None
    try:
        path = where / _name(what, files) if where else None
        found = _read(path) if path else None
    except OSError:
        path = found = None
    if found is None:
        found = make()
        if path:
            _write(path, found)
    return found


def _read(path):
    """None where it is not there, or is broken."""
    try:
        with numpy.load(path, allow_pickle=False) as arrays:
            found = {name: arrays[name] for name in arrays.files}
        os.utime(path)
        return found
    except (OSError, ValueError, KeyError, EOFError, zipfile.BadZipFile):
        return None


def _write(path, arrays):
    """Whole or not at all; where nothing can be written, nothing is kept."""
    part = path.with_name(f"{path.stem}.{os.getpid()}.part")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        with open(part, "wb") as file:
            numpy.savez(file, **arrays)
        os.replace(part, path)
        _make_room(path.parent)
    except OSError:
        with suppress(OSError):
            part.unlink(missing_ok=True)


def _make_room(where):
    """Throws away what was asked for the longest time ago."""
    files = [(each.stat().st_mtime, each.stat().st_size, each) for each in where.glob("*.npz")]
    total = sum(size for _, size, _ in files)
    for _, size, path in sorted(files):
        if total <= MOST:
            return
        path.unlink(missing_ok=True)
        total -= size
