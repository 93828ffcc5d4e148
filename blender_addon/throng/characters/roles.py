# SPDX-License-Identifier: Apache-2.0
"""What a clip is for, by its name. Pure Python: no Blender here.

Names are taken apart into words ("Walking_A", "rig|walk-cycle", "SitChairIdle"), a word says what is done, and
other words say that it is something else after all: nobody in a street walks with a raised axe because a clip
is called "2H_Melee_Walk".
"""
import re

ROLES = ("walk", "run", "idle", "talk", "phone", "cheer", "sit", "look")
WALK, RUN, IDLE, TALK, PHONE, CHEER, SIT, LOOK = ROLES

_WORDS = {
    WALK: "walk walking walks walkcycle stroll strolling march marching locomotion gehen marche",
    RUN: "run running runs runcycle jog jogging sprint sprinting",
    IDLE: "idle idling stand standing rest resting breathe breathing wait waiting",
    TALK: "talk talking speak speaking conversation chat chatting discuss arguing gesture gesturing explain",
    PHONE: "phone phoning telephone call calling texting cellphone mobile",
    CHEER: "cheer cheering clap clapping applaud applause wave waving celebrate celebration victory",
    SIT: "sit sitting seated sits",
    LOOK: "look looking inspect watch watching observe search",
}
_ROLE_OF = {word: role for role, words in _WORDS.items() for word in words.split()}
# A clip that has one of these is no everyday one, whatever else it says.
_NEVER = set("back backward backwards strafe strafing left right turn turning jump jumping fall falling death die "
             "dying dead attack melee ranged aim aiming shoot shooting reload sword bow crouch crouching crawl swim "
             "climb injured zombie drunk combat fight block blocking dodge hit lie lying down up standup pose tpose "
             "roll carry carrying sneak stairs stop start begin end".split())
# A clip of these is as good as another, but where there is a plain one, that is taken.
_SPECIAL = set("chair floor bench unarmed female male girl boy old sad happy angry tired crazy funny "
               "short long alternative alt".split())
SLOW = set("slow slowly casual lazy relaxed".split())
FAST = set("fast brisk quick hurry power".split())


def words_of(name):
    """The words of a clip's name, in small letters."""
    name = name.rsplit("|", 1)[-1] if name.rsplit("|", 1)[-1].strip() else name
    name = re.sub(r"(?<=[a-z])(?=[A-Z])|(?<=[A-Z])(?=[A-Z][a-z])", " ", name)
    words = [word for word in re.split(r"[^A-Za-z]+", name) if word]
    return [word.lower() for word in words]


def role_of(name):
    """(role, how many words speak against it), or (None, 0) when the name says nothing. Fewer is better."""
    words = words_of(name)
    roles = [_ROLE_OF[word] for word in words if word in _ROLE_OF]
    if not roles:
        return None, 0
    # "Sit_Chair_Idle" sits, "Idle_Look_Around" looks, "Standing_Talking" talks: idling is the least of all.
    role = next((each for each in (SIT, PHONE, TALK, CHEER, LOOK, RUN, WALK) if each in roles), IDLE)
    if any(word in _NEVER for word in words) or (role in (WALK, RUN) and SIT in roles):
        return None, 0
    return role, sum(word in _SPECIAL for word in words) + (len(set(roles)) - 1)


def clips_by_role(names):
    """{role: [names, the plainest first]} of those whose name says what they are."""
    found = {}
    for place, name in enumerate(names):
        role, against = role_of(name)
        if role:
            found.setdefault(role, []).append((against, len(words_of(name)), place, name))
    return {role: [entry[-1] for entry in sorted(entries)] for role, entries in found.items()}


def is_plain(name):
    """Whether nothing in a clip's name says that it is a special one."""
    return role_of(name)[1] == 0


def says_otherwise(name):
    """Whether the name rules out that this is an everyday clip (so that motion alone must not make it one)."""
    return any(word in _NEVER for word in words_of(name)) or role_of(name)[0] is not None
