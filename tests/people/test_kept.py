# SPDX-License-Identifier: Apache-2.0
"""What was worked out of people once is kept, and only that of the same people, library and code."""
import os
import sys

import numpy
import pytest

from conftest import ROOT

sys.path.insert(0, str(ROOT / "blender_addon"))
from throng.cast import kept  # noqa: E402

ARRAYS = {"points": numpy.arange(12.0).reshape(4, 3), "names": numpy.array(["skin", "hair brown"])}


@pytest.fixture
def asked(tmp_path, monkeypatch):
    """(how often something was made, what asks for it)"""
    monkeypatch.setenv(kept.VARIABLE, str(tmp_path / "cache"))
    library = tmp_path / "bodies.npz"
    library.write_bytes(b"one library")
    made = []

    def ask(what="a man"):
        found = kept.kept(what, lambda: made.append(what) or dict(ARRAYS), library)
        assert all(numpy.array_equal(found[name], ARRAYS[name]) for name in ARRAYS) and len(found) == len(ARRAYS)
        return found
    ask.library, ask.folder = library, tmp_path / "cache" / "people"
    return made, ask


def test_what_was_made_once_is_there_the_next_time(asked):
    made, ask = asked
    ask()
    ask()
    ask("a woman")
    ask("a woman")
    assert made == ["a man", "a woman"] and len(list(ask.folder.iterdir())) == 2


def test_another_library_or_other_code_makes_anew(asked, monkeypatch):
    made, ask = asked
    ask()
    ask.library.write_bytes(b"two library")
    os.utime(ask.library, ns=(1, 1))
    ask()
    assert len(made) == 2
    monkeypatch.setattr(kept, "_code", lambda: b"other code")
    ask()
    assert len(made) == 3


@pytest.mark.parametrize("broken", [b"", b"PK\3\4 but no more", None], ids=["empty", "no archive", "cut off"])
def test_what_is_broken_is_made_anew_and_is_whole_after_that(asked, broken):
    made, ask = asked
    ask()
    file, = ask.folder.iterdir()
    file.write_bytes(file.read_bytes()[:-100] if broken is None else broken)
    ask()
    ask()
    assert len(made) == 2


def test_nothing_is_kept_where_that_is_asked_for_or_cannot_be(asked, tmp_path, monkeypatch):
    made, ask = asked
    monkeypatch.setenv(kept.VARIABLE, "")
    ask()
    ask()
    (tmp_path / "file").write_text("in the way")
    monkeypatch.setenv(kept.VARIABLE, str(tmp_path / "file"))
    ask()
    ask()
    assert len(made) == 4 and not ask.folder.exists()


def test_what_nobody_has_asked_for_goes_when_there_is_too_much(asked, monkeypatch):
    made, ask = asked
    ask("old")
    old, = ask.folder.iterdir()
    monkeypatch.setattr(kept, "MOST", int(2.5 * old.stat().st_size))
    os.utime(old, (1, 1))
    ask("new")
    ask("old")  # is asked for again, so the other one is the older now
    new, = set(ask.folder.iterdir()) - {old}
    os.utime(new, (2, 2))
    ask("newer")
    assert old.exists() and not new.exists() and len(list(ask.folder.iterdir())) == 2
