# SPDX-License-Identifier: Apache-2.0
"""Motions of a cast: which there are, who moves so, and the poses that they are written over.

A cast keeps them in its property `throng_motions`, so that members who are made anew (a bake of other gaits, levels of
detail) get theirs again. What plays is in the sheets, as all poses are.
"""
import json
from dataclasses import dataclass

import numpy

from ..cast import BEATS, POSES, bones, gait, library
from ..cast.sheets import sheet_of
from ..characters import roles
from ..crowd.playback import cast_changed
from ..crowd.queries import cast_of, repertoire_of
from ..people import members as people
from . import MotionError, retarget
from .motion import WALKS, Motion

MOTIONS = "throng_motions"
# What a way to stand is taken for: an idle clip is a second way, too, half a round later.
_STANDS = {roles.IDLE: ("idle", "shift"), roles.TALK: ("talk",), roles.PHONE: ("phone",)}


@dataclass
class Entry:
    """A motion of a cast."""
    motion: Motion
    role: str          # one of sources.KINDS; all that walks or runs is "walk"
    members: tuple
    every: bool        # whether it is taken for all strides of its kind
    batch: int         # what is added later is shown
    lines: list        # of its report

    @property
    def name(self):
        return self.motion.name

    def text(self):
        return {"motion": self.motion.text(), "role": self.role, "members": list(self.members), "every": self.every,
                "batch": self.batch, "lines": self.lines}

    @classmethod
    def of(cls, found):
        return cls(Motion.of(found["motion"]), found["role"], tuple(found["members"]), found["every"], found["batch"],
                   found["lines"])


def entries_of(cast):
    return [Entry.of(each) for each in json.loads(cast.get(MOTIONS, "[]"))]


def _keep(cast, entries):
    if entries:
        cast[MOTIONS] = json.dumps([entry.text() for entry in entries])
    elif MOTIONS in cast:
        del cast[MOTIONS]


def said(cast):
    """[(name, lines)] of a cast's motions, without unpacking them."""
    return [(json.loads(each["motion"])["name"], each["lines"]) for each in json.loads(cast.get(MOTIONS, "[]"))]


def moves(cast, member):
    """Whether a member has a motion."""
    return any(member in each["members"] for each in json.loads(cast.get(MOTIONS, "[]")))


def movable(cast):
    """Numbers of the members who can be given motions: those who are shaped from bodies."""
    if not cast.get("throng_bodies"):
        return []
    return sorted(member for (level, member), figure in library.figures_of(cast).items()
                  if level == 0 and "throng_person" in figure and bones.has_bones(sheet_of(figure)))


def _figure(cast, member):
    return library.figures_of(cast)[0, member]


def _maker(cast, member):
    return people.maker_of(people.role_of(cast, member))


def with_sticks(cast, members):
    """Those of the members who walk with a stick: their arms have to be where it stands."""
    return [member for member in members if people.person_of(people.role_of(cast, member)).stick]


@dataclass
class Shown:
    """What a member shows of motions."""
    poses: dict   # {number of a pose of level 0: (B, 3, 4) of the sheet's bones}
    gaits: list   # [(entry, stride, share of the cycle that feet are planted, m that slides in a step)]


def _gaits_of(entries, repertoire):
    """{number of a gait in the repertoire: the entry that it shows}: the last that was added, of these the nearest."""
    found = {}
    for number, stride in enumerate(repertoire.strides):
        fitting = [entry for entry in entries if entry.motion.kind == WALKS
                   and number in retarget.fits(entry.motion, repertoire, entry.every)]
        near = lambda entry: (entry.batch, -abs(numpy.log(stride / entry.motion.stride)))
        if fitting:
            found[number] = max(fitting, key=near)
    return found


def stands_for(role):
    """The cast's clips that a motion to stand is taken for; of one that walks none."""
    return _STANDS.get(role, ())


def _stands_of(entries):
    """{clip of the cast: the entry that it shows}"""
    found = {}
    for entry in entries:
        for clip in stands_for(entry.role):
            found[clip] = entry
    return found


def shown_of(cast, member, entries, repertoire):
    """The Shown of a member."""
    entries = [entry for entry in entries if member in entry.members]
    wearer = retarget.Wearer.of(_maker(cast, member))
    used = people.leading(people.role_of(cast, member), repertoire)
    walks, shown = {}, Shown({}, [])
    put = lambda first, poses: shown.poses.update(
        {first + number: retarget.matrices(wearer, pose)[used] for number, pose in enumerate(poses)})
    for number, entry in _gaits_of(entries, repertoire).items():
        if id(entry) not in walks:
            walks[id(entry)] = retarget.walk(entry.motion, wearer)
        plan = walks[id(entry)].plan(repertoire.strides[number])
        poses = walks[id(entry)].poses(plan)
        put(number * POSES, poses)
        shown.gaits.append((entry, plan.stride, plan.share, retarget.slide(wearer, poses, plan.stride)))
    for clip, entry in _stands_of(entries).items():
        poses = retarget.stand(entry.motion, wearer, clip)
        if clip == "shift":
            poses = numpy.roll(poses, -(BEATS // 2), axis=0)
        put(repertoire.walking() + BEATS * gait.STANDING_CLIPS.index(clip), poses)
    return shown


def _write(cast, member, poses):
    sheet = sheet_of(_figure(cast, member))
    bones.put_poses(sheet, poses)
    for (_, number), figure in library.figures_of(cast).items():
        if number == member:
            figure.update_tag()


def add(crowd, entries, progress=lambda share: None):
    """Gives motions to a crowd's cast. Returns {member: Shown}; raises before anything is changed."""
    cast, repertoire = cast_of(crowd), repertoire_of(crowd)
    known = entries_of(cast)
    same = lambda one, other: (one.name, one.role, one.members) == (other.name, other.role, other.members)
    after = [entry for entry in known if not any(same(entry, each) for each in entries)] + list(entries)
    concerned, found = sorted({member for entry in entries for member in entry.members}), {}
    replaces = len(after) < len(known) + len(entries)  # and may be taken for fewer strides than before
    for number, member in enumerate(concerned):
        found[member] = shown_of(cast, member, after, repertoire)
        if replaces:
            found[member].poses = {**_own(cast, member, repertoire), **found[member].poses}
        progress((number + 1) / len(concerned))
    for member, shown in found.items():
        _write(cast, member, shown.poses)
    _keep(cast, after)
    cast_changed(crowd)
    return found


def next_batch(cast):
    return max((entry.batch for entry in entries_of(cast)), default=0) + 1


def remove(crowd, names=(), members=()):
    """Takes motions away, of those members or of all: they move as the cast does again. Returns the names of those that
    were taken from somebody."""
    cast, repertoire = cast_of(crowd), repertoire_of(crowd)
    kept, gone, concerned = [], [], set()
    for entry in entries_of(cast):
        leaving = set(entry.members) & set(members or entry.members) if not names or entry.name in names else set()
        concerned |= leaving
        gone += [entry.name] if leaving else []
        entry.members = tuple(member for member in entry.members if member not in leaving)
        if entry.members:
            kept.append(entry)
    if not gone:
        known = ", ".join(dict.fromkeys(name for name, _ in said(cast)))
        raise MotionError(f"nobody there moves so: the crowd's motions are {known}" if known else
                          "the crowd has no motions: all move as the cast does")
    anew = {member: _anew(cast, member, kept, repertoire) for member in sorted(concerned & set(movable(cast)))}
    for member, poses in anew.items():
        _write(cast, member, poses)
    _keep(cast, kept)
    cast_changed(crowd)
    return list(dict.fromkeys(gone))


def _own(cast, member, repertoire):
    """All poses of a member without motions."""
    return dict(enumerate(people.matrices_of(people.role_of(cast, member), repertoire)))


def _anew(cast, member, entries, repertoire):
    poses = _own(cast, member, repertoire)
    if any(member in entry.members for entry in entries):
        poses.update(shown_of(cast, member, entries, repertoire).poses)
    return poses


def _move(cast, member, sheet, repertoire):
    """Of somebody who has been made anew."""
    entries = entries_of(cast)
    if any(member in entry.members for entry in entries):
        bones.put_poses(sheet, shown_of(cast, member, entries, repertoire).poses)


library.shaped.move = _move  # the cast's own library calls it
