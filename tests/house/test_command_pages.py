# SPDX-License-Identifier: Apache-2.0
"""The pages of commands are what the program says of itself."""
import os
import pathlib
import subprocess
import sys

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "scripts" / "command_reference.py"


def test_the_pages_are_up_to_date():
    made = subprocess.run([sys.executable, SCRIPT, os.environ["THRONG_BINARY"], "--check"], capture_output=True,
                          text=True)
    assert made.returncode == 0, made.stderr
