# SPDX-License-Identifier: Apache-2.0
"""Whom the members of a cast are drawn as, so that they suit a bake's people, and who of these appears as which of
them."""
import csv
import os
import re
from collections import Counter, deque
from dataclasses import dataclass
from functools import lru_cache

from . import roster
from .roster import Role

LOOK, FANS = "casual", "fans"
CHILD_UNTIL = 0.205  # m: people of a smaller radius are children, where nothing is said of them
_COLOURS = re.compile("#[0-9a-fA-F]{6} #[0-9a-fA-F]{6}")


@lru_cache(maxsize=512)
def person_of(role):
    return role.person()


@dataclass(frozen=True)
class Walker:
    """What a bake says of one of its people."""
    radius: float = 0.25  # m
    variation: int = 0
    profile: str = ""     # as the layout names it
    look: str = LOOK
    chosen: bool = False  # by somebody, who appears as whom (`throng apply`)

    @property
    def kind(self):
        """(look, profile): what a member has to be to appear as. Where the layout says nothing, small ones are
        children."""
        return self.look, "child" if not self.profile and self.radius < CHILD_UNTIL else self.profile


def roles_for(walkers, count):
    """Whom so many members of a cast are drawn as: of each kind of people as large a share as of the bake's, but one at
    least, as far as the members go."""
    kinds = Counter(walker.kind for walker in walkers).most_common(count)
    people = sum(often for _, often in kinds)
    spare = count - len(kinds)
    shares = {kind: often * spare / people for kind, often in kinds}
    members = {kind: 1 + int(share) for kind, share in shares.items()}
    for kind in sorted(shares, key=lambda each: int(shares[each]) - shares[each])[:count - sum(members.values())]:
        members[kind] += 1
    return [role for (look, profile), many in members.items() for role in _of_kind(look, profile, many)]


def _of_kind(look, profile, many):
    """So many members of a kind; where the layout says nothing of it, they are grown up."""
    found, number = [], 0
    while len(found) < many:
        role = Role(number, look, profile)
        if profile or not person_of(role).child:
            found.append(role)
        number += 1
    return found


def choose(walkers, roles, drawn):
    """Which member each of a bake's people appears as: those of their look and profile as far as there are any,
    children as children, the broad as broad ones.

    @param roles of the members; @param drawn how many variations the bake draws among
    """
    folk = sorted(range(len(roles)), key=lambda number: (breadth_of(person_of(roles[number])), number))
    fitting, seen, chosen = {}, {}, []
    for row, walker in enumerate(walkers):
        if walker.kind not in fitting:
            fitting[walker.kind] = _fitting(walker.kind, roles, folk)
        fits = fitting[walker.kind]
        # how broad somebody is among the members should be how broad it is among the people
        low, high = (0.15, 0.20) if walker.kind[1] == "child" else (0.22, 0.28)
        share = min(max((walker.radius - low) / (high - low), 0.0), 0.999)
        spread = ((walker.variation + 0.618034 * row) % drawn) / drawn - 0.5  # not all of one radius are one person
        last = len(fits) - 0.5
        wanted = last - abs(last - abs((share + 0.5 * spread) * len(fits)))  # turned back at both ends: nobody crowds
        chosen.append(_nearest_unseen(fits, int(wanted), seen.setdefault(walker.kind, deque(maxlen=len(fits) // 4))))
    return chosen


def _nearest_unseen(fits, wanted, seen):
    """Who comes in together stays together: of such a handful no two are the same."""
    order = sorted(range(len(fits)), key=lambda place: abs(place - wanted))
    place = next(place for place in order if place not in seen)
    seen.append(place)
    return fits[place]


def _fitting(kind, roles, folk):
    """Members who may be somebody of a kind: the first of these that there are."""
    look, profile = kind
    old = profile == "elderly"
    age = lambda who: who.child == (profile == "child") and (who.body.years >= roster.OLD or not old)
    tests = (lambda role: (role.look, role.profile) == kind,
             lambda role: role.look == look and age(person_of(role)),
             lambda role: age(person_of(role)),
             lambda role: role.look == look and person_of(role).child == (profile == "child"),
             lambda role: person_of(role).child == (profile == "child"))
    for test in tests:
        found = [number for number in folk if test(roles[number])]
        if found:
            return found
    return folk


def breadth_of(who):
    """How broad a person's shoulders are beside others, as a number to sort by."""
    return who.body.height * (0.20 + 0.02 * who.body.male) + 0.012 * who.body.shoulders + 0.04 * who.body.weight


def read_walkers(folder):
    """[Walker] of a bake's people, or None where its table cannot be read."""
    try:
        with open(os.path.join(folder, "agents.csv"), newline="", encoding="utf-8") as table:
            return [Walker(float(line["radius"]), int(line["variation"]), _known(line.get("profile"), roster.AGES, ""),
                           _look(line), "character" in (line.get("overrides") or "").split())
                    for line in csv.DictReader(table)]
    except (OSError, KeyError, ValueError, TypeError):
        return None


def _known(word, words, otherwise):
    """Bakes of old say nothing, and those to come perhaps what is not known here."""
    return word if word in words else otherwise


def _look(line):
    look = _known(line.get("look"), roster.LOOKS, LOOK)
    colours = line.get("colours") or ""
    return f"{look} {colours}" if look == FANS and _COLOURS.fullmatch(colours) else look
