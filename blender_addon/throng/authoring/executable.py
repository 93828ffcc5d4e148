# SPDX-License-Identifier: Apache-2.0
"""Where the program `throng` is, and whether it fits this add-on. Pure Python."""
import os
import re
import shutil
import subprocess

VERSION = (0, 1)  # the program's, as far as it has to agree
ENVIRONMENT = "THRONG_BINARY"


class ExecutableError(Exception):
    """The program cannot be used; the message says why and what to do."""


def find_executable(chosen=""):
    """The program's path: chosen in the preferences, or of the environment, or on the PATH. Raises ExecutableError."""
    wanted = chosen or os.environ.get(ENVIRONMENT) or "throng"
    path = shutil.which(os.path.expanduser(wanted))
    if path:
        return path
    if chosen or os.environ.get(ENVIRONMENT):
        reason = "is a folder: choose the program in it" if os.path.isdir(wanted) else \
            "is no program that can be run" if os.path.exists(wanted) else "does not exist"
        raise ExecutableError(f"{wanted} {reason} (Edit > Preferences > Add-ons > Throng > Program)")
    raise ExecutableError("the program `throng` is not on the PATH: install it, or choose it in Edit > Preferences > "
                          "Add-ons > Throng > Program")


def check_version(path):
    """The program's version as text. Raises ExecutableError when it does not fit."""
    try:
        done = subprocess.run([path, "--version"], capture_output=True, text=True, timeout=30, check=False)
    except (OSError, subprocess.TimeoutExpired) as error:
        raise ExecutableError(f"{path} does not run: {error}") from None
    found = re.fullmatch(r"throng (\d+)\.(\d+)\.(\d+)\S*(?:, build \S+)?\s*", done.stdout)
    if not found:
        raise ExecutableError(f"{path} is not Throng: `--version` says {(done.stdout or done.stderr).strip()[:80]!r}")
    if tuple(int(part) for part in found.groups()[:2]) != VERSION:
        raise ExecutableError(f"{path} is version {'.'.join(found.groups())}, this add-on needs "
                              f"{VERSION[0]}.{VERSION[1]}: install both from one release")
    return ".".join(found.groups())
