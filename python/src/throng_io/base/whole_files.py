# SPDX-License-Identifier: Apache-2.0
"""Files and folders that are there when they are complete."""
from __future__ import annotations

import contextlib
import os
import pathlib
import shutil
import tempfile
from collections.abc import Iterator

from .errors import ThrongError


@contextlib.contextmanager
def whole_file(path: str | os.PathLike) -> Iterator[pathlib.Path]:
    """A name to write to: what is written appears under `path` when it is complete, or not at all."""
    target = pathlib.Path(path)
    try:
        folder = tempfile.mkdtemp(prefix=f".{target.name}.", dir=target.parent)
    except OSError as error:
        raise ThrongError(f"{target} cannot be written: {error.strerror}") from error
    beside = pathlib.Path(folder) / target.name
    try:
        yield beside
        os.replace(beside, target)
    except OSError as error:
        raise ThrongError(f"{target} cannot be written: {error.strerror or error}") from error
    finally:
        beside.unlink(missing_ok=True)
        os.rmdir(folder)


@contextlib.contextmanager
def whole_folder(path: str | os.PathLike) -> Iterator[pathlib.Path]:
    """A folder to write into, which appears under `path` when it is complete, or not at all. One that holds something
    is not replaced."""
    target = pathlib.Path(path)
    try:
        if target.exists() and (not target.is_dir() or any(target.iterdir())):
            raise ThrongError(f"{target} is there already", "name a folder that is not, or an empty one")
        folder = pathlib.Path(tempfile.mkdtemp(prefix=f".{target.name}.", dir=target.parent))
    except OSError as error:
        raise ThrongError(f"{target} cannot be written: {error.strerror}") from error
    beside = folder / target.name
    try:
        beside.mkdir()
        yield beside
        os.replace(beside, target)
    except OSError as error:
        raise ThrongError(f"{target} cannot be written: {error.strerror or error}") from error
    finally:
        shutil.rmtree(folder, ignore_errors=True)
