# SPDX-License-Identifier: Apache-2.0
"""Files that are there when they are complete."""
from __future__ import annotations

import contextlib
import os
import pathlib
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
