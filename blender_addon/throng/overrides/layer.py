# SPDX-License-Identifier: Apache-2.0
"""The overrides of a crowd in a scene: kept in the scene (so undo and saving have them) and, on each change, in
the file beside the bake.

`Object.throng_overrides` holds an item for each entry; its `text` is the entry as the file has it, the rest is
what matching it has found.
"""
import json
import os
from dataclasses import replace

import bpy

from ..crowd import own
from ..crowd.queries import bake_path, crowd_objects, is_crowd, why_fixed
from ..formats import BakeError, load_bake
from . import hero, native
from .matching import match, orphan_reason
from .merging import changed, merge_into, only, taken_over
from .override_file import Change, OverrideError, change_of, path_beside, person_of, read_beside
from .rows import Rows, Table


def entries_of(crowd):
    """The entries that the scene has, as dictionaries in the file's form."""
    return [json.loads(item.text) for item in crowd.throng_overrides]


def bake_of(crowd):
    return load_bake(bake_path(crowd))


def file_of(crowd):
    return path_beside(os.path.dirname(bake_path(crowd)))


def _look_of(base, change):
    """What `throng apply` has written into the bake, under what is changed here."""
    if base is None:
        return change
    return replace(change, tint=base.tint if change.tint is None else change.tint,
                   scale=base.scale if change.scale is None else change.scale)


class Matched:
    """Entries and whom they mean in a bake. Raises BakeError when the bake's files are not what they should be."""

    def __init__(self, bake, entries):
        self.bake, self.entries = bake, entries
        self.others = ""  # whom somebody else has changed meanwhile, see change()
        with Rows(bake) as rows:
            self.table = Table(bake, rows)
        self.matches = match(entries, self.table.people)
        self.changes = {found.row: change_of(entry) for entry, found in zip(entries, self.matches)
                        if found.kind != "orphaned"}

    @property
    def orphans(self):
        return [f"person {entry['id']} ({', '.join(change_of(entry).words())}): "
                f"{orphan_reason(entry, self.table.people)}" for entry, found in zip(self.entries, self.matches)
                if found.kind == "orphaned"]

    def looks(self):
        base = self.table.looks
        return {row: _look_of(base.get(row), self.changes.get(row, Change())) for row in {*base, *self.changes}}


def show(crowd, matched):
    """Plays the entries in the scene and makes the heroes that it lacks."""
    with Rows(matched.bake) as rows:
        native.play(crowd, rows, matched.table.people, matched.looks(),
                    native.folder_for(path_beside(matched.bake.folder)))
        standing = hero.heroes_of(crowd)
        for row, change in matched.changes.items():
            if change.hero and change.hero not in standing:
                hero.promote(crowd, matched.bake, rows, matched.table.people, row, matched.looks()[row])
    wanted = {change_of(entry).hero for entry in matched.entries}
    for name in set(hero.heroes_of(crowd)) - wanted:
        hero.demote(crowd, name)
    _list(crowd, matched)


def _list(crowd, matched):
    items = crowd.throng_overrides
    items.clear()
    for entry, found in zip(matched.entries, matched.matches):
        item = items.add()
        item.name = f"{entry['id']} {entry['group']}: {', '.join(change_of(entry).words())}"
        item.text, item.status = json.dumps(entry, ensure_ascii=False), found.kind
        item.row = -1 if found.row is None else found.row
        if found.kind == "nearest":
            item.detail = f"now {found.row}, {found.metres:.2f} m and {found.frames:+.0f} frames away"
        elif found.kind == "orphaned":
            item.detail = orphan_reason(entry, matched.table.people)
    crowd.throng_override_index = min(crowd.throng_override_index, max(0, len(items) - 1))


def crowds_at(path):
    """The crowds of the scene that have their overrides from a file, and that can be changed."""
    return [crowd for crowd in crowd_objects(bpy.context.scene) if not why_fixed(crowd) and file_of(crowd) == path]


class _Session:
    """What this session has done to files of overrides, so that undo takes back that, and nothing of others'."""

    def __init__(self):
        self.known = {}  # by path and crowd's name: the entries when scene and file were last brought together
        self.own = {}    # by path: the cells that this session has written

    def note(self, path, others, ours=frozenset()):
        """Scene and file are together; `others` are cells that somebody else has changed meanwhile."""
        self.own[path] = (self.own.get(path, set()) - others) | ours
        for crowd in crowds_at(path):
            self.known[path, crowd.name] = entries_of(crowd)


_session = _Session()


def _keeps_people(bake, path):
    """A check for merging: nobody's changes may go to somebody else by what comes in here."""
    def check(theirs, merged):
        before, after = ({person_of(entry): found.row for entry, found in zip(entries, Matched(bake, entries).matches)}
                         for entries in (theirs, merged))
        moved = sorted(person for person, row in before.items() if after.get(person, row) != row)
        if moved:
            raise OverrideError(f"{path}: person {moved[0][0]} of `{moved[0][1]}` has been changed by somebody else, "
                                "in another take: Re-load Overrides first")

    return check


def change(crowd, edit):
    """Changes the entries by `edit(entries, matched)`, which returns the new ones; then file and scene, with what
    others have changed in the file meanwhile (`others` of what is returned says it). All crowds of one bake show the
    same. Raises BakeError, nothing changed."""
    bake = bake_of(crowd)
    before = Matched(bake, entries_of(crowd))
    mine = edit([dict(entry) for entry in before.entries], before)
    path = path_beside(bake.folder)
    theirs, merged = merge_into(path, before.entries, mine, _keeps_people(bake, path))
    after = Matched(bake, merged)
    after.others = taken_over(before.entries, theirs)
    for each in crowds_at(path):
        show(each, after)
    _session.note(path, changed(before.entries, theirs), changed(theirs, merged))
    return after


def entry_for(matched, row):
    """A fresh entry for somebody, with nothing changed."""
    person = matched.table.people[row] if 0 <= row < len(matched.table.people) else None
    if person is None or person.frame is None:
        raise OverrideError(f"person {row} never enters this bake" if person
                            else f"there is no person {row} in this bake")
    return {"id": row, "group": person.group, "spawn": {"frame": person.frame, "position": list(person.place)}}


def set_for(crowd, rows, values):
    """Sets keys of some people's entries to the same, see set_each()."""
    return set_each(crowd, dict.fromkeys(rows, values))


def set_each(crowd, by_row):
    """Sets keys of some people's entries ({row: {key: value}}); a value of None takes the key away, and an entry
    without any goes."""
    def edit(entries, matched):
        index = {found.row: position for position, found in enumerate(matched.matches) if found.kind != "orphaned"}
        for row, values in by_row.items():
            if row not in index:
                index[row] = len(entries)
                entries.append(entry_for(matched, row))
            entry = entries[index[row]]
            fresh = entry_for(matched, row)  # who it is in this take
            if all(other is entry or person_of(other) != person_of(fresh) for other in entries):
                entry.update(fresh)
            for key, value in values.items():
                if value is None:
                    entry.pop(key, None)
                else:
                    entry[key] = value
        return [entry for entry in entries if set(entry) - {"id", "group", "spawn", "note"}]

    return change(crowd, edit)


def place_at(crowd, row, scene_frame, turn):
    """Where somebody stands in a frame, in the crowd's space, if it is turned so far and not moved."""
    matched = Matched(bake_of(crowd), entries_of(crowd))
    entry_for(matched, row)  # or it says who is missing
    frame = min(max(scene_frame - int(crowd.modifiers["throng pos"].frame_start), 0), matched.bake.frames - 1)
    now = matched.changes.get(row, Change())
    with Rows(matched.bake) as rows:
        return rows.changed(row, matched.table.people[row].frame, replace(now, move=(0.0, 0.0, 0.0), turn=turn),
                            frame).position


def variation_of(crowd, row):
    """Which member of the cast somebody appears as."""
    matched = Matched(bake_of(crowd), entries_of(crowd))
    entry_for(matched, row)
    change = matched.changes.get(row, Change())
    with Rows(matched.bake) as rows:
        drawn = int(rows.whole(row, 0).state[1])
    return own.member_of(crowd, row, drawn, False) if change.character is None else change.character


def remove(crowd, positions):
    """Takes away entries by their place in the crowd's list."""
    gone = set(positions)
    return change(crowd, lambda entries, _: [entry for index, entry in enumerate(entries) if index not in gone])


class Arrival:
    """Overrides on their way into the scene with a bake that is imported or re-loaded.

    Made before anything is changed (it raises BakeError), placed after.
    """

    def __init__(self, bake, crowd=None):
        beside = read_beside(bake.folder)
        self.path = path_beside(bake.folder)
        self.fresh = crowd is None
        shown = entries_of(crowd) if crowd else []
        self.entries = shown if beside is None else beside
        needed = self.entries or shown or "applied" in bake.manifest
        self.matched = Matched(bake, self.entries) if needed else None
        if self.entries and beside is None:  # approved work goes along with a bake in another place
            merge_into(self.path, [], self.entries)

    @property
    def orphans(self):
        return self.matched.orphans if self.matched else []

    def place(self, crowd):
        others = set() if self.fresh else changed(entries_of(crowd), self.entries)
        if self.matched:
            show(crowd, self.matched)
        _session.note(self.path, others)


def load(crowd):
    """Takes the file's entries instead of the scene's; returns the orphans."""
    arrival = Arrival(bake_of(crowd), crowd)
    for each in crowds_at(arrival.path):
        arrival.place(each)
    return arrival.orphans


def _write_undone(crowd):
    """Puts what undo or redo has changed in the scene into the file: of what this session has written there."""
    path = file_of(crowd)
    known, now = _session.known.get((path, crowd.name)), entries_of(crowd)
    if known is None or known == now or not os.path.exists(path):
        return
    theirs, merged = merge_into(path, known, only(known, now, _session.own.get(path, set())))
    _session.own[path] = _session.own.get(path, set()) | changed(theirs, merged)
    _session.known[path, crowd.name] = now


@bpy.app.handlers.persistent
def write_after_undo(*_):
    """Undo brings back the scene's entries; the file follows."""
    for crowd in [thing for thing in bpy.data.objects if is_crowd(thing) and not why_fixed(thing)]:
        try:
            _write_undone(crowd)
        except (BakeError, AttributeError) as error:
            print(f"Throng: overrides: {error}")


@bpy.app.handlers.persistent
def forget(*_):
    """Another .blend has been opened."""
    _session.__init__()
