# SPDX-License-Identifier: Apache-2.0
"""Changes of several people, Blenders or crowds to one file of overrides: each goes onto what the file says by then.
Pure Python.

What is compared are cells, {(person, key): value}: two may change the same person, if they change different things.
"""
import contextlib
import os
import time

from .override_file import OverrideError, person_of, read, write

_WHO = ("id", "group", "spawn")
_PATIENCE = 5.0  # s: a file is written within milliseconds


def cells(entries):
    return {(person_of(entry), key): value for entry in entries for key, value in entry.items() if key not in _WHO}


def changed(before, after):
    """The cells, as (person, key), in which two lists of entries differ."""
    one, two = cells(before), cells(after)
    return {at for at in {*one, *two} if one.get(at) != two.get(at)}


def _words(places):
    by_person = {}
    for (row, group, _), key in sorted(places, key=str):
        by_person.setdefault(f"person {row} of `{group}`", []).append(key)
    return ", ".join(f"{person} ({', '.join(keys)})" for person, keys in by_person.items())


def taken_over(base, theirs):
    """What others have changed in a file since it said `base`, in words; empty where nothing is changed."""
    return _words(changed(base, theirs))


def _clashes(base, mine, theirs):
    """Cells that were changed here and elsewhere, and not to the same. Who is taken back here as a whole, or is another
    in this take, clashes with whatever was changed about that person."""
    was, now, there = cells(base), cells(mine), cells(theirs)
    gone = {person_of(entry) for entry in base} - {person_of(entry) for entry in mine}
    elsewhere = {at for at in changed(base, theirs) if there.get(at) is not None or at[0] not in gone}
    return {at for at in elsewhere if at[0] in gone or now.get(at) not in (was.get(at), there.get(at))}


def only(base, mine, places):
    """`base` with those cells as `mine` has them, and all others as they were."""
    return _with_changes(base, mine, changed(base, mine) & places)


def _with_changes(entries, mine, places):
    """Entries with the cells at some places as in `mine`; who has none left goes, who is new comes last."""
    touched = {person for person, _ in places}
    values = {at: value for at, value in cells(mine).items() if at in places}
    who = {person_of(entry): {key: entry[key] for key in _WHO} for entry in mine}
    result = {}
    for entry in entries:
        person = person_of(entry)
        result[person] = {key: value for key, value in entry.items() if (person, key) not in places}
        result[person].update(who.get(person, {}))
    for (person, key), value in values.items():
        result.setdefault(person, dict(who[person]))[key] = value
    return [entry for person, entry in result.items() if person not in touched or set(entry) - {*_WHO, "note"}]


def merge(base, mine, theirs, path):
    """What was changed from `base` to `mine`, put onto `theirs`. Raises OverrideError where both changed the same."""
    if theirs == base:
        return mine
    clashes = _clashes(base, mine, theirs)
    if clashes:
        raise OverrideError(f"{path}: {_words(clashes)} has been changed by somebody else since this crowd last read "
                            "the file, so nothing is written: Re-load Overrides shows what they did, then change it "
                            "again")
    edits = changed(base, mine)
    merged = _with_changes(theirs, mine, edits)
    ours = {value for (person, key), value in cells(mine).items() if key == "hero" and (person, key) in edits}
    heroes = [entry["hero"] for entry in merged if "hero" in entry]
    twice = sorted(name for name in ours if heroes.count(name) > 1)
    if twice:
        raise OverrideError(f"{path}: there is a hero `{twice[0]}` already, whom somebody else has made since: take "
                            "another name")
    return merged


@contextlib.contextmanager
def exclusive(path):
    """Nobody else changes a file meanwhile who goes about it by this, too, on whatever machine."""
    lock, patience = f"{path}.lock", time.monotonic() + _PATIENCE
    while True:
        try:
            os.close(os.open(lock, os.O_CREAT | os.O_EXCL | os.O_WRONLY))
            break
        except FileExistsError:
            if time.monotonic() > patience:
                raise OverrideError(f"{path} is being written by another Blender, so nothing is changed: try again, or "
                                    f"remove {lock} if there is no other") from None
            time.sleep(0.01)
        except OSError as error:
            raise OverrideError(f"{path} cannot be written: {error.strerror}") from None
    try:
        yield
    finally:
        with contextlib.suppress(OSError):
            os.unlink(lock)


def merge_into(path, base, mine, check=None):
    """Merges changes into a file, which may not be there yet; returns (what it said, what it says).

    @param check called with both where somebody else has changed it, before anything is written; it may raise
    """
    with exclusive(path):
        theirs = read(path) if os.path.exists(path) else base
        merged = merge(base, mine, theirs, path)
        if check and theirs != base:
            check(theirs, merged)
        if merged != theirs or merged and not os.path.exists(path):
            write(path, merged)
    return theirs, merged
