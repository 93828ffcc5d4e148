# SPDX-License-Identifier: Apache-2.0
"""The add-on as it is installed: as a zip, and as an extension."""
import subprocess
import sys
import zipfile

import pytest

from conftest import ROOT


@pytest.fixture
def archive(tmp_path):
    packed = tmp_path / "throng.zip"
    subprocess.run([sys.executable, str(ROOT / "scripts" / "build_addon.py"), str(packed)], check=True)
    return packed


def test_the_zip_installs(blender, archive, tmp_path):
    script = tmp_path / "install.py"
    script.write_text("""
import bpy, sys
bpy.ops.preferences.addon_install(filepath=sys.argv[-1])
bpy.ops.preferences.addon_enable(module='throng')
assert hasattr(bpy.types, 'IMPORT_SCENE_OT_throng')
""")
    blender(script, archive, environment={"BLENDER_USER_SCRIPTS": str(tmp_path / "scripts"),
                                          "BLENDER_USER_CONFIG": str(tmp_path / "config")})


def test_the_zip_is_an_extension(archive, tmp_path):
    """By the tool of the current Blender's own distribution; what it builds from the zip's folder is one, too."""
    python = ROOT / "build" / "bpy" / "bin" / "python"
    tools = sorted(python.parent.parent.glob(
        "lib/python*/site-packages/bpy/*/scripts/addons_core/bl_pkg/cli/blender_ext.py"))
    if not tools:
        pytest.skip("the Python module bpy is not installed (scripts/test does)")

    def run(*words):
        done = subprocess.run([python, tools[-1], *words], capture_output=True, text=True)
        assert done.returncode == 0 and "rror" not in done.stdout, done.stdout + done.stderr
        return done.stdout

    assert "Success" in run("validate", archive)
    with zipfile.ZipFile(archive) as packed:
        packed.extractall(tmp_path)
    run("build", "--source-dir", tmp_path / "throng", "--output-dir", tmp_path)
    built = next(tmp_path.glob("throng-*.zip"))
    assert "Success" in run("validate", built)
    with zipfile.ZipFile(built) as extension:
        assert "authoring/throng-layout.schema.json" in extension.namelist()
