# SPDX-License-Identifier: Apache-2.0
"""Several people, Blenders and crowds change one file of overrides: nothing is lost without a word."""
import json
import multiprocessing

import pytest

from results import ADDON, HERE, result_of  # noqa: F401
from throng.overrides import merging
from throng.overrides.override_file import OverrideError, read, write


def entry(row, frame=0, **change):
    return {"id": row, "group": "f", "spawn": {"frame": frame, "position": [float(row), 0.0, 0.0]}, **change}


@pytest.mark.parametrize("base, mine, theirs, merged", [
    ([], [entry(1, hide=True)], [entry(2, hide=True)], [entry(2, hide=True), entry(1, hide=True)]),
    ([entry(1, hide=True)], [], [entry(1, hide=True), entry(2, scale=1.1)], [entry(2, scale=1.1)]),
    ([entry(1, hide=True)], [entry(1, hide=True, scale=1.1)], [entry(1, hide=True, tint="#00ff00")],
     [entry(1, hide=True, tint="#00ff00", scale=1.1)]),
    ([entry(1, hide=True)], [entry(1, hide=True), entry(2, hide=True)], [], [entry(2, hide=True)]),
    ([entry(1, scale=1.1)], [entry(1, scale=1.2)], [entry(1, scale=1.2)], [entry(1, scale=1.2)]),
    ([entry(1, hide=True)], [], [], []),
    ([entry(1, hide=True)], [entry(1, 5, hide=True, scale=1.1)], [entry(1, hide=True), entry(3, hide=True)],
     [entry(3, hide=True), entry(1, 5, hide=True, scale=1.1)])])
def test_changes_of_both_are_there_in_the_end(base, mine, theirs, merged):
    assert merging.merge(base, mine, theirs, "file") == merged


@pytest.mark.parametrize("base, mine, theirs, words", [
    ([], [entry(1, scale=1.1)], [entry(1, scale=1.2)], r"person 1 of `f` \(scale\)"),
    ([entry(1, scale=1.1)], [entry(1, scale=1.2)], [], r"person 1 of `f` \(scale\)"),
    ([entry(1, hide=True)], [], [entry(1, hide=True, tint="#00ff00")], r"person 1 of `f` \(tint\)"),
    ([entry(1, hide=True)], [entry(1, 5, hide=True)], [entry(1, hide=True, scale=2.0)], r"person 1 of `f` \(scale\)"),
    ([], [entry(1, hero="Anna")], [entry(2, hero="Anna")], "hero `Anna` already")])
def test_changes_of_the_same_are_refused_with_a_sentence(tmp_path, base, mine, theirs, words):
    path = str(tmp_path / "bake.overrides.json")
    write(path, theirs)
    with pytest.raises(OverrideError, match=words):
        merging.merge_into(path, base, mine)
    assert read(path) == theirs and [each.name for each in tmp_path.iterdir()] == ["bake.overrides.json"]


def test_only_what_was_done_here_is_undone():
    known, undone = [entry(1, hide=True, scale=1.1), entry(2, hide=True)], [entry(1, hide=True)]
    ours = {((2, "f", 0), "hide")}
    assert merging.only(known, undone, ours) == [entry(1, hide=True, scale=1.1)]


def _hide_many(path, first, count):
    known = []
    for row in range(first, first + count):
        _, known = merging.merge_into(path, known, [*known, entry(row, hide=True)])


def test_blenders_that_write_at_the_same_time_lose_nothing(tmp_path):
    path, processes = str(tmp_path / "bake.overrides.json"), multiprocessing.get_context("spawn")
    workers = [processes.Process(target=_hide_many, args=(path, 100 * number, 25)) for number in range(4)]
    for worker in workers:
        worker.start()
    for worker in workers:
        worker.join()
    assert all(worker.exitcode == 0 for worker in workers)
    assert {each["id"] for each in read(path)} == {100 * a + b for a in range(4) for b in range(25)}
    assert [each.name for each in tmp_path.iterdir()] == ["bake.overrides.json"]


def test_a_lock_that_was_left_behind_is_told(tmp_path, monkeypatch):
    monkeypatch.setattr(merging, "_PATIENCE", 0.1)
    path = tmp_path / "bake.overrides.json"
    (tmp_path / "bake.overrides.json.lock").touch()
    with pytest.raises(OverrideError, match="another Blender.*try again, or remove .*lock"):
        merging.merge_into(str(path), [], [entry(1, hide=True)])
    assert not path.exists()


@pytest.fixture(scope="module")
def shared(blender, throng, tmp_path_factory):
    """What check_shared_overrides.py has seen."""
    folder = tmp_path_factory.mktemp("shared")
    layout = {"throng": 1, "name": "street", "simulation": {"duration": 4, "seed": 7},
              "roads": [{"id": "road", "centreline": [[0, 0], [24, 0]], "width": 6}],
              "flows": [{"id": "f", "from": "road:start", "to": "road:end", "count": 12, "end": 2}]}
    (folder / "street.json").write_text(json.dumps(layout))
    throng("bake", folder / "street.json", "-o", folder / "street", "-q", "--no-gltf")
    return result_of(blender(HERE / "check_shared_overrides.py", ADDON, folder))


def test_two_crowds_of_one_bake_share_its_overrides(shared):
    assert shared["two crowds"] == {"file": [1, 2], "shown": [[1, 2], [1, 2]], "left out": [True, True]}


def test_undo_takes_back_what_was_done_here_and_nothing_else(shared):
    assert shared["before undo"] == [1, 2, 3, 5], "5 is somebody else's"
    assert shared["undone"] == [1, 2, 5] and shared["redone"] == [1, 2, 3, 5]
    assert shared["undone reload"] == [1, 2, 3, 5, 7], "what somebody else has written stays there"
    assert shared["went on"] == [1, 2, 3, 5, 7, 8]


def test_another_file_that_is_opened_is_brought_up_to_date_by_the_next_change(shared):
    assert shared["opened"] == [[1, 2], [1, 2, 3, 5, 7, 8]] and shared["from there"] == [1, 2, 3, 4, 5, 7, 8]
