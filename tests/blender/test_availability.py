# SPDX-License-Identifier: Apache-2.0
"""Operators that are not available say why and what to do, whatever the scene has; linked crowds are crowds, too."""
import pytest

from results import ADDON, HERE, result_of
from sample_bake import SMALL_CAST, write_bake


@pytest.fixture(scope="module")
def seen(blender, tmp_path_factory):
    folder = tmp_path_factory.mktemp("available")
    write_bake(folder / "bakes" / "sample", **SMALL_CAST)
    return result_of(blender(HERE / "check_availability.py", ADDON, folder / "bakes" / "sample", folder))


def test_every_operator_that_is_not_available_says_what_to_do(seen):
    assert seen["operators"] > 30 and len(seen["nothing"]) > 15
    for said in (seen["nothing"], seen["one crowd"], seen["edit mode"], seen["two crowds"], seen["linked"]["said"]):
        for name, words in said.items():
            assert "failed" not in words and "context is incorrect" not in words, (name, words)
            assert len(words.partition("poll()")[2].split()) > 4, (name, words)
    assert "import a bake first" in seen["nothing"]["throng.hide_people"]
    assert "make the one active that is meant" in seen["two crowds"]["throng.hide_people"]
    assert "Leave edit mode" in seen["edit mode"]["throng.bake"]
    assert "throng.hide_people" not in seen["one crowd"]


def test_linked_crowds_are_verified_and_say_how_to_change_them(seen):
    linked = seen["linked"]
    assert linked["people"] > 50 and linked["verify"] == [] and linked["bake"] and linked["finished"]
    assert {"throng.hide_people", "throng.cull", "throng.shot", "throng.reload", "throng.levels"} <= set(linked["said"])
    for words in (linked["said"]["throng.hide_people"], linked["said"]["throng.cull"], linked["character"]):
        assert "is linked from" in words and "open that file to change it" in words
    assert "in a crowd is an instance of a collection" in seen["instanced"]


def test_crowds_of_ones_own_are_changed_beside_linked_ones(seen):
    assert seen["own"] == [50.0, 100.0, True] and "is linked from" in seen["selected"]
