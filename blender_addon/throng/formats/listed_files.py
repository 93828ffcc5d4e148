# SPDX-License-Identifier: Apache-2.0
"""Compares a bake's files with the list in its bake.json, as `throng verify` does."""
import os
import re
import stat

from .xxh3 import hash_of

_MANIFEST = "bake.json"


def file_problems(bake, told=()):
    """(path in the bake, sentence) of each file that is not as it was written.

    told: paths of which something has been said already."""
    listed = bake.manifest.get("files")
    if not isinstance(listed, list) or not all(_is_entry(entry) for entry in listed):
        yield _MANIFEST, "bake.json lists no checksums: nothing can be said of what is in the files. Bake again"
        return
    for entry in listed:
        if entry["path"] not in told:
            problem = _problem_of(os.path.join(bake.folder, *entry["path"].split("/")), entry)
            if problem:
                yield entry["path"], f"{entry['path']} {problem}"
    for path in sorted(_found(bake.folder) - {entry["path"] for entry in listed} - {_MANIFEST}):
        if not re.match(r"checkpoint\.[^/]*$", path):  # of a bake that was killed as it ended
            yield path, f"{path} is not in the list of bake.json"


def _is_entry(entry):
    """Whether it names a file inside the bake."""
    return isinstance(entry, dict) and isinstance(entry.get("path"), str) and isinstance(entry.get("bytes"), int) \
        and isinstance(entry.get("xxh3"), str) and not os.path.isabs(entry["path"]) \
        and ".." not in re.split(r"[/\\]", entry["path"])


def _problem_of(path, entry):
    try:
        facts = os.stat(path)
        if not stat.S_ISREG(facts.st_mode):
            return "is no regular file"
        if facts.st_size != entry["bytes"]:
            return f"has {facts.st_size} of {entry['bytes']} bytes: copy or bake it again"
        if hash_of(path) != entry["xxh3"]:
            return "has been changed or damaged: its checksum is not the one in bake.json. Copy or bake it again"
    except FileNotFoundError:
        return "is missing: copy the whole bake folder"
    except OSError as error:
        return f"cannot be read: {error.strerror}"
    return None


def _found(folder):
    """Paths of all files below a folder; links to folders count as files."""
    return {os.path.relpath(os.path.join(where, name), folder).replace(os.sep, "/")
            for where, folders, files in os.walk(folder)
            for name in files + [name for name in folders if os.path.islink(os.path.join(where, name))]}
