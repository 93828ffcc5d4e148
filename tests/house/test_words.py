# SPDX-License-Identifier: Apache-2.0
"""What became of people has one name each: base/outcomes.h, the docs and the add-on say the same."""
import pathlib
import re

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent


def words():
    text = (ROOT / "base" / "outcomes.h").read_text()
    found = dict(re.findall(r'FateWord\{\s*Fate::\w+, "(\w+)",\s*"([^"]*)"\}', text))
    assert len(found) == 7
    return found


def test_the_docs_have_the_words_of_the_code():
    account = (ROOT / "docs" / "bake.md").read_text().split("## The account")[1].split("\n## ")[0]
    assert dict(re.findall(r"^\| (\w+) \| (.+) \|$", account, re.M)) == {"word": "meaning", **words()}


def test_the_add_on_has_the_words_of_the_code():
    scope = {}
    exec((ROOT / "blender_addon" / "throng" / "formats" / "outcomes.py").read_text(), scope)
    assert {scope[word.upper()] for word in words()} == set(words())
    told = scope["account_text"]({"agents": 12, "walking": 3, "arrived": 8, "refused": 1})
    assert told == "12 people: 8 arrived, 3 walking, 1 refused"
