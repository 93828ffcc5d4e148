# SPDX-License-Identifier: Apache-2.0
"""Files that are written whole or not at all."""
import contextlib
import os


def write_whole(path, content):
    """Replaces a file: it has its old content or the new one, never something in between. @throws OSError"""
    fresh = f"{path}.new-{os.getpid()}"
    try:
        with open(fresh, "wb") as file:
            file.write(content)
            file.flush()
            os.fsync(file.fileno())
        os.replace(fresh, path)
    except OSError:
        with contextlib.suppress(OSError):
            os.unlink(fresh)
        raise
