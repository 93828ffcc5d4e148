# SPDX-License-Identifier: Apache-2.0
"""Which bone of a skeleton is what of a body: by name, in the ways that the usual programs name them, else by where it
is. No Blender here."""
from dataclasses import dataclass, field

import numpy

from ..characters import anatomy
from ..characters.roles import words_of
from . import MotionError
from .takes import tips_of

# Of each part the words that say it, joined; the first that some bone has is taken: a shoulder with a side is where the
# arm begins, as Biovision has it, unless some bone is called arm. Thighs and shins are told by the feet that they lead
# to.
_WORDS = {
    "foot": "ankle foot", "toe": "toebase toe toes ball",
    "upper arm": "upperarm uparm humerus shldr shldrbend arm shoulder",
    "forearm": "forearm lowerarm lowarm forearmbend radius elbow", "hand": "wrist hand",
    "head": "head",
}
_SIDES = {"left": "L", "l": "L", "lt": "L", "right": "R", "r": "R", "rt": "R"}
# Say nothing of which bone it is: programs' own marks.
_MARKS = set("mixamorig def org bip biped j c cc base bone bones joint jnt rig valve character armature "
             "skeleton".split())
# Bones that only help.
_HELPERS = set("twist roll ik fk pole target ctrl control mch tweak helper corrective dummy sec nub end heel parent "
               "vis wgt pivot socket".split())
BESIDE = 0.05  # of the height, from the middle: what is nearer to it is no arm
_LEVEL = 0.35  # of its length: a foot that points further down at rest does not tell where it looks


@dataclass(frozen=True)
class Leg:
    """Indices of bones."""
    thigh: int
    shin: int
    foot: int


@dataclass(frozen=True)
class Arm:
    upper: int
    fore: int
    hand: int


@dataclass
class Match:
    legs: tuple    # right, left
    arms: tuple    # right, left; None where there is none
    trunk: tuple   # from the pelvis to the chest
    neck: tuple    # between chest and head
    head: object   # or None
    forward: numpy.ndarray  # (3, 3): forward, left and up at rest, as columns
    notes: list = field(default_factory=list)


def part_of(name):
    """(the side, or "", and the other words of a bone's name, joined); None for bones that only help."""
    words = [word for word in words_of(name.rsplit(":", 1)[-1]) if word not in _MARKS]
    if _HELPERS & set(words):
        return None
    known = {each for words_ in _WORDS.values() for each in words_.split()}
    side, rest = "", []
    for word in words:
        start = next((each for each in ("left", "right", "l", "r")
                      if word.startswith(each) and word[len(each):] in known and word not in known), "")
        if word in _SIDES or start:
            side = _SIDES[start or word]
            word = word[len(start):] if start else ""
        rest.append(word)
    return side, "".join(rest)


class Bones:
    """A skeleton at rest, asked by name."""

    def __init__(self, take):
        self.names, self.parents = take.names, take.parents
        self.heads = take.rest[:, :3, 3]
        self.points, self.main = tips_of(take)
        self.tall = float(numpy.ptp(self.points[:, 2]))
        self.by_part = {}
        for bone, name in enumerate(take.names):
            part = part_of(name)
            if part:
                self.by_part.setdefault(part, bone)

    def named(self, what, side=""):
        return next((self.by_part[side, word] for word in _WORDS[what].split() if (side, word) in self.by_part), None)

    def chain(self, bone):
        """From the root to a bone."""
        found = []
        while bone >= 0:
            found.append(bone)
            bone = self.parents[bone]
        return found[::-1]

    def shared(self, bones):
        """The chain that leads to all of these."""
        chains, found = [self.chain(bone) for bone in bones], []
        for level in zip(*chains):
            if len(set(level)) > 1:
                break
            found.append(level[0])
        return found

    def children(self, bone):
        return [each for each, parent in enumerate(self.parents) if parent == bone]


def feet_by_name(names):
    """(right, left) feet, or None."""
    feet = {}
    for word in _WORDS["foot"].split():
        for bone, name in enumerate(names):
            part = part_of(name)
            if part and part[0] and part[1] == word:
                feet.setdefault(part[0], bone)
    return (feet["R"], feet["L"]) if len(feet) == 2 else None


def high_by_name(names):
    """What is above the feet at rest, or None."""
    return next((bone for bone, name in enumerate(names) if (part_of(name) or ("", ""))[1] == "head"), None)


def match(take, feet=()):
    """The Match of a take whose z is up. @param feet the names of both feet's bones, where they are known. Raises
    MotionError, or CharacterError."""
    bones, notes = Bones(take), []
    legs, by_name = _legs(bones, feet, notes)
    forward = _forward(bones, legs, by_name)
    if (bones.heads[legs[0].foot] - bones.heads[legs[1].foot]) @ forward[:, 1] > 0.0:
        legs.reverse()
    to_pelvis = bones.shared([leg.thigh for leg in legs])
    if not to_pelvis:
        raise MotionError(f"{take.name}: its legs hang on no bone in common: a pelvis is needed")
    arms = _arms(bones, to_pelvis[-1], forward, notes)
    head = bones.named("head")
    if head is None or to_pelvis[-1] not in bones.chain(head):
        notes.append("no head is found: it goes with the chest")
        return Match(tuple(legs), arms, _trunk(bones, to_pelvis, arms, None), (), None, forward, notes)
    trunk = _trunk(bones, to_pelvis, arms, head)
    neck = tuple(bone for bone in bones.chain(bones.parents[head]) if bone not in bones.chain(trunk[-1]))
    return Match(tuple(legs), arms, trunk, neck, head, forward, notes)


def _legs(bones, feet, notes):
    """([Leg], (right, left) feet by name, or None)"""
    by_name = feet_by_name(bones.names)
    if not feet and by_name:
        feet = [bones.names[bone] for bone in by_name]
    if not by_name:
        notes.append("no bones are named left and right foot: legs are told by where they are")
    found = anatomy.find_legs(bones.names, bones.parents, bones.heads, bones.points, bones.main, feet)
    if any(leg.knee is None for leg in found):
        raise MotionError("its legs have no knees: between thigh and foot there should be a bone")
    return [Leg(leg.hip, leg.knee, leg.foot) for leg in found], by_name


def _trunk(bones, to_pelvis, arms, head):
    """From the pelvis to the bone that carries what is above."""
    tops = [arm.upper for arm in arms if arm] + ([head] if head is not None else [])
    chest = bones.shared([bones.parents[top] for top in tops]) if tops else to_pelvis
    return tuple(chest[len(to_pelvis) - 1:] if len(chest) >= len(to_pelvis) else to_pelvis[-1:])


def _toes(bones, foot):
    """From the ankle to the furthest end of a foot."""
    below = [each for each, bone in enumerate(bones.main) if foot in bones.chain(bone)]
    ways = bones.points[below] - bones.heads[foot]
    return ways[numpy.linalg.norm(ways, axis=1).argmax()]


def toe_direction(bones, foot):
    """(x, y) of where a foot looks at rest, or None where it does not tell: its length is that of the foot."""
    way = _toes(bones, foot)
    flat = float(numpy.linalg.norm(way[:2]))
    return way[:2] if flat > _LEVEL * float(numpy.linalg.norm(way)) and flat > 0.02 * bones.tall else None


def _forward(bones, legs, by_name):
    """(3, 3) as Match has it: by the names of left and right, else by the toes."""
    up = numpy.array([0.0, 0.0, 1.0])
    hips = [bones.heads[leg.thigh] for leg in legs]
    ankles = [bones.heads[leg.foot] for leg in legs]
    aside = numpy.array([*(hips[1] - hips[0])[:2], 0.0])
    if numpy.linalg.norm(aside) < 1e-6 * bones.tall:
        aside = numpy.array([*(ankles[1] - ankles[0])[:2], 0.0])
    if numpy.linalg.norm(aside) < 1e-6 * bones.tall:
        raise MotionError("both legs are in one place at rest: it cannot be told which is the left one")
    aside /= numpy.linalg.norm(aside)
    ahead = numpy.cross(aside, up)
    toes = [toe_direction(bones, leg.foot) for leg in legs]
    toes = sum((way for way in toes if way is not None), numpy.zeros(2))
    if by_name:
        wrong = by_name[0] != legs[0].foot  # legs[0] was taken for the right one
    elif numpy.linalg.norm(toes) > 0.0:
        wrong = toes @ ahead[:2] < 0.0
    else:
        raise MotionError("it cannot be told which way the skeleton looks: no bones are named left and right, and the "
                          "feet point nowhere at rest")
    if wrong:
        aside, ahead = -aside, -ahead
    return numpy.stack([ahead, aside, up], axis=1)


def _arms(bones, pelvis, forward, notes):
    """(right, left)"""
    found = [_arm_by_name(bones, side) for side in "RL"]
    if all(found):
        return tuple(found)
    for sign, index in ((-1.0, 0), (1.0, 1)):
        found[index] = found[index] or _arm_by_place(bones, pelvis, sign * forward[:, 1])
    missing = [side for side, arm in zip(("right", "left"), found) if not arm]
    if missing:
        notes.append(f"no {' and no '.join(missing)} arm is found: there the cast's own swing")
    else:
        notes.append("arms are told by where they are")
    return tuple(found)


def _arm_by_name(bones, side):
    parts = [bones.named(what, side) for what in ("upper arm", "forearm", "hand")]
    if None in parts:
        return None
    upper, fore, hand = parts
    chain = bones.chain(hand)
    return Arm(upper, fore, hand) if fore in chain and upper in bones.chain(bones.parents[fore]) else None


def _arm_by_place(bones, pelvis, aside):
    """The last three joints of what reaches furthest aside above the pelvis, before it forks into fingers."""
    out = lambda bone: float((bones.heads[bone] - bones.heads[pelvis]) @ aside) / bones.tall
    above = [bone for bone in range(len(bones.names))
             if bones.heads[bone][2] > bones.heads[pelvis][2] - 0.1 * bones.tall and pelvis in bones.chain(bone)]
    chain = bones.chain(max(above, key=out))
    chain = [bone for bone in chain[chain.index(pelvis) + 1:] if out(bone) > BESIDE]
    hand = next((place for place, bone in enumerate(chain) if len(bones.children(bone)) > 1), len(chain) - 1)
    return Arm(*chain[hand - 2:hand + 1]) if hand >= 2 else None


def lines_of(take, found):
    """Which bone is what, in words."""
    name = lambda bone: take.names[bone]
    said = [f"{side} leg: " + " > ".join(name(bone) for bone in (leg.thigh, leg.shin, leg.foot))
            for side, leg in zip(("right", "left"), found.legs)]
    said += [f"{side} arm: " + " > ".join(name(bone) for bone in (arm.upper, arm.fore, arm.hand))
             for side, arm in zip(("right", "left"), found.arms) if arm]
    said.append("trunk: " + " > ".join(map(name, found.trunk)))
    if found.head is not None:
        said.append("head: " + " > ".join(map(name, (*found.neck, found.head))))
    return ["; ".join(said)]
