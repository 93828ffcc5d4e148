# SPDX-License-Identifier: Apache-2.0
"""What pyproject.toml cannot say: wheels with the program inside, of the machine that they are made on.

    THRONG_PROGRAM=$PWD/build/release/throng python3 -m pip wheel --no-deps ./python
"""
import os
import pathlib
import shutil

from setuptools import setup
from setuptools.command.build_py import build_py

PROGRAM = os.environ.get("THRONG_PROGRAM")


class WithProgram(build_py):
    def run(self):
        super().run()
        if not PROGRAM:
            return
        if not os.path.isabs(PROGRAM) or not os.access(PROGRAM, os.X_OK):
            raise SystemExit(f"THRONG_PROGRAM: expected the whole path of a program, found {PROGRAM!r}")
        folder = pathlib.Path(self.build_lib, "throng_io", "bin")
        folder.mkdir(parents=True, exist_ok=True)
        shutil.copy(PROGRAM, folder / "throng")


def commands():
    if not PROGRAM:
        return {"build_py": WithProgram}
    try:
        from setuptools.command.bdist_wheel import bdist_wheel
    except ImportError:  # before setuptools 70.1
        try:
            from wheel.bdist_wheel import bdist_wheel
        except ImportError:  # nothing that makes wheels is here
            return {"build_py": WithProgram}

    class OfThisMachine(bdist_wheel):
        """For any Python, as nothing of it is compiled for one."""

        def finalize_options(self):
            super().finalize_options()
            self.root_is_pure = False

        def get_tag(self):
            return "py3", "none", super().get_tag()[2]

    return {"build_py": WithProgram, "bdist_wheel": OfThisMachine}


setup(cmdclass=commands())
