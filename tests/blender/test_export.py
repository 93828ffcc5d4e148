# SPDX-License-Identifier: Apache-2.0
"""Blender's exporters and crowds: what leaves people out says so."""
import re

import pytest

from results import ADDON, HERE, result_of
from sample_bake import SMALL_CAST, write_bake

SMALLEST = 800  # vertices of anybody's body are more


@pytest.fixture(scope="module")
def exported(blender, tmp_path_factory):
    """(what came back of each export, what was said during each, how many people there are)."""
    folder = tmp_path_factory.mktemp("export")
    _, _, state = write_bake(folder / "bake", agents=9, **SMALL_CAST)
    output = blender(HERE / "check_export.py", ADDON, folder / "bake", folder)
    said = {(realised == "True", name): text for realised, name, text in
            re.findall(r"^EXPORT (\w+) (\S+)\n(.*?)^END", output, re.M | re.S)}
    return result_of(output), said, int((state[19, :, 0] > 0.5).sum())


@pytest.mark.parametrize("name", ["people.usdc", "people.abc"])
def test_usd_and_alembic_have_bodies_of_realised_people_only(exported, name):
    found, _, people = exported
    if name not in found:
        pytest.skip("this Blender is built without it")
    without, realised = found[name]
    assert without == 0 and realised > SMALLEST * people


def test_gltf_says_who_is_not_in_it_and_that_people_stand_still(exported):
    found, said, _ = exported
    for name in ("plain.gltf", "applied.gltf", "instances.gltf"):
        for realised, vertices in zip((False, True), found.get(name, ())):
            words = said[realised, name]
            assert ("are not in this glTF" in words) == (vertices == 0), (name, realised)
            assert ("stand still in this glTF, as in frame " in words) == (vertices > SMALLEST), (name, realised)
    assert found["plain.gltf"] == [0, 0] and found["applied.gltf"][0] == 0 < found["applied.gltf"][1]
    assert found.get("instances.gltf", [1])[0] > 0


def test_the_dialogues_of_exporters_say_it_and_the_hook_of_usd(exported):
    found, _, people = exported
    instances, realised = found["hook"]  # exports call it where Blender has the Python modules of USD
    assert "Throng sample crowd have no bodies in this USD: Realize for Export" in instances and realised == ""
    assert found["dialogue registered"] and found["again"] == people
    assert found["dialogues"] == [["WM_OT_usd_export", "WM_OT_alembic_export", "EXPORT_SCENE_OT_fbx",
                                   "EXPORT_SCENE_OT_gltf"], []]
