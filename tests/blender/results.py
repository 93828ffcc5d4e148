# SPDX-License-Identifier: Apache-2.0
"""What tests have in common that run scripts in a Blender: where things are, and what a script has found."""
import json
import pathlib
import sys

from conftest import ROOT

HERE = pathlib.Path(__file__).parent
ADDON = ROOT / "blender_addon"
sys.path.insert(0, str(ADDON))  # what of it needs no Blender can be imported here, too


def result_of(output):
    """What a script has said in its line RESULT."""
    return json.loads(next(line for line in output.splitlines() if line.startswith("RESULT "))[7:])
