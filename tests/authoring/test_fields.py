# SPDX-License-Identifier: Apache-2.0
"""What the add-on's fields take from the layout's schema."""
import json
import subprocess
import sys
import zipfile

import pytest

from conftest import ROOT

from test_layout_page import SCHEMA, with_motion

sys.path.insert(0, str(ROOT / "blender_addon"))
from throng.authoring import codecs, fields, schema  # noqa: E402

COPY = "throng/authoring/throng-layout.schema.json"

pytestmark = pytest.mark.quick


def test_every_setting_of_the_simulation_has_a_row():
    settings = SCHEMA["properties"]["simulation"]["properties"]
    assert {codec.key for codec, *_ in fields.SIMULATION} == set(settings)
    for codec, label, least, most, description in fields.SIMULATION:
        entry = settings[codec.key]
        assert codec.default == entry["default"] and label[0].isupper()
        assert description == entry["description"].removesuffix(".")
        if "maximum" in entry:
            assert least == entry.get("minimum", entry.get("exclusiveMinimum"))
            assert most == min(entry["maximum"], 2**31 - 1)


def test_every_default_of_a_layouts_objects_is_its_codecs():
    groups = {"people": fields.PEOPLE, "road": fields.ROAD, "wall": fields.OPEN_WALL, "flow": fields.FLOW,
              "stop": fields.STOP, "formation": [codec for part in fields.FORMATION.values() for codec in part]}
    compared = 0
    for name, members in groups.items():
        for codec in members:
            entry = schema.LAYOUT.entry(name, codec.key)
            if "default" in entry and hasattr(codec, "default"):
                assert codec.default == entry["default"], (name, codec.key)
                compared += 1
    assert compared > 12


def test_rules_of_motion_come_as_groups_of_rows():
    assert fields.motion_of(schema.Schema({**SCHEMA, "properties": {}})) == ()
    drive, swerve = fields.motion_of(schema.Schema(with_motion()))
    name, label, description, rows = drive
    assert (name, label, description) == ("drive", "Drive on", "Towards the goal")
    (enabled, *_), (constant, label, least, most, _) = rows
    assert isinstance(enabled, codecs.Flag) and enabled.default is True
    assert (constant.key, constant.default, label, least, most) == ("time_constant", 0.5, "Time Constant", 0.1, 5.0)
    assert swerve[0] == "swerve" and len(swerve[3]) == 1


def test_the_zip_carries_the_schema(tmp_path):
    archive = tmp_path / "throng.zip"
    subprocess.run([sys.executable, str(ROOT / "scripts" / "build_addon.py"), str(archive)], check=True)
    with zipfile.ZipFile(archive) as packed:
        assert json.loads(packed.read(COPY)) == SCHEMA
        packed.extractall(tmp_path)
    shown = "from throng.authoring import fields, schema; print(schema.FILE, len(fields.SIMULATION)); import sys; " \
            "assert 'bpy' not in sys.modules"
    told = subprocess.run([sys.executable, "-c", shown], cwd=tmp_path, capture_output=True, text=True, check=True)
    assert told.stdout.split()[1] == str(len(fields.SIMULATION))
