# SPDX-License-Identifier: Apache-2.0
"""The add-on as it is installed: as a zip, and as an extension."""
import subprocess
import sys

import pytest

from conftest import ROOT
from results import ADDON


def test_the_zip_installs(blender, tmp_path):
    archive = tmp_path / "throng.zip"
    subprocess.run([sys.executable, str(ROOT / "scripts" / "build_addon.py"), str(archive)], check=True)
    script = tmp_path / "install.py"
    script.write_text("""
import bpy, sys
bpy.ops.preferences.addon_install(filepath=sys.argv[-1])
bpy.ops.preferences.addon_enable(module='throng')
assert hasattr(bpy.types, 'IMPORT_SCENE_OT_throng')
""")
    blender(script, archive, environment={"BLENDER_USER_SCRIPTS": str(tmp_path / "scripts"),
                                          "BLENDER_USER_CONFIG": str(tmp_path / "config")})


def test_the_extension_builds_and_is_valid(tmp_path):
    """With the tool of the current Blender's own distribution."""
    python = ROOT / "build" / "bpy" / "bin" / "python"
    tools = sorted(python.parent.parent.glob(
        "lib/python*/site-packages/bpy/*/scripts/addons_core/bl_pkg/cli/blender_ext.py"))
    if not tools:
        pytest.skip("the Python module bpy is not installed (scripts/test does)")
    run = lambda *words: subprocess.run([python, tools[-1], *words], capture_output=True, text=True)
    built = run("build", "--source-dir", ADDON / "throng", "--output-dir", tmp_path)
    assert built.returncode == 0, built.stdout + built.stderr
    packed = next(tmp_path.glob("throng-*.zip"))
    checked = run("validate", packed)
    assert checked.returncode == 0 and "Success" in checked.stdout, checked.stdout + checked.stderr
