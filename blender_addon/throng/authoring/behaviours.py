# SPDX-License-Identifier: Apache-2.0
"""Behaviours: what people do, state by state, and what ends it. Pure Python; for the world between names and objects
see places.py."""
from . import fields
from .codecs import Codec, Distribution, Optional, Text, put_all, take_all
from .places import (
    Destination, Place, Target, keep_raw, name_of, names_of_blocks, place_of, put_block, put_member, put_place, raw_of)
from .schema import LAYOUT
from .values import MISSING, is_number, is_point

DOES = tuple(part["required"][0] for part in LAYOUT.named("behaviour_state")["oneOf"])
CONDITIONS = tuple(key for key in LAYOUT.entries(LAYOUT.named("transition")) if key not in ("within", "of", "then"))
# Conditions by what they speak of.
TIMES, GATES, LIGHTS, PLACES = ("after", "at"), ("open", "closed"), ("green", "red"), ("near", "empty", "all_here")
NUMBERS = {"near": "within", "crowded": "crowded", "chance": "chance"}  # conditions with a number, and its key


class _Fixed(Codec):
    """A key that says no more than that it is there."""

    def put(self, group, raw, _world=None):
        pass

    def take(self, group, raw, _world=None):
        return True if raw is MISSING else raw


class _Places(Codec):
    """Several places."""

    def put(self, group, raw, world):
        group.to.places.clear()
        for text in raw if isinstance(raw, list) else []:
            put_place(group.to.places.add(), text, world)

    def take(self, group, raw, world):
        now = [place_of(ref, world) for ref in group.to.places]
        return raw if not now and raw is not MISSING and not isinstance(raw, list) else now


class _Danger(Codec):
    """A place, a point, or people."""

    point = Target("flee", "POINT", "danger")

    def put(self, group, raw, world):
        is_name = isinstance(raw, str) and not world.find(raw)
        put_place(group.place, "" if is_name or is_point(raw) else raw, world)
        put_member(group.followed, raw if is_name else "", world)
        self.point.put(group, raw, world)

    def take(self, group, raw, world):
        if group.danger:
            return self.point.take(group, raw, world)
        text = place_of(group.place, world) or name_of(group.followed, world)
        return raw if text == "" and not isinstance(raw, str) and raw is not MISSING and not is_point(raw) else text


class _Followed(Codec):
    """People."""

    def put(self, group, raw, world):
        put_member(group.followed, raw, world)

    def take(self, group, raw, world):
        text = name_of(group.followed, world)
        return raw if text == "" and raw is not MISSING and not isinstance(raw, str) else text


class _Seats(Codec):
    """Blocks of seats."""

    def put(self, group, raw, world):
        group.seats.clear()
        for text in raw if isinstance(raw, list) else [raw]:
            if isinstance(text, str):
                put_block(group.seats.add(), text, world)

    def take(self, group, raw, world):
        names = names_of_blocks(group.seats, raw, world)
        kept = not names and raw is not MISSING and not isinstance(raw, (str, list))
        return raw if kept else names or ""


class _Some(Codec):
    """A whole number, or two: at least, at most."""

    @staticmethod
    def shown(raw):
        if isinstance(raw, list) and len(raw) == 2 and all(is_number(part) for part in raw):
            return int(raw[0]), int(raw[1])
        return (int(raw), int(raw)) if is_number(raw) else None

    def put(self, group, raw, _world=None):
        group.use_count = self.shown(raw) is not None
        group.least, group.most = self.shown(raw) or (1, 1)

    def present(self, group):
        return (group.least, group.most) if group.use_count else None

    def written(self, value):
        if value is None:
            return MISSING
        return value[0] if value[0] == value[1] else list(value)


def _of_state(key, attribute=None):
    return fields.codec_of(key, LAYOUT.entry("behaviour_state", key), attribute=attribute)


_STANDS = (Distribution("for", "lasts"), _of_state("do", "pose"), Target("facing", "POINT"))
_THEN, _PACE, _GOOD = Text("then"), _of_state("pace"), _of_state("for_good")
# What each activity is told by; the first is where.
KEYS = {
    "walk_to": (Destination("walk_to", "to"), _PACE, _THEN),
    "stay": (_Fixed("stay"), *_STANDS, _GOOD, _THEN),
    "wander": (Place("wander", "place"), _PACE),
    "visit": (_Places("visit"), _Some("count"), *_STANDS, _PACE, _THEN),
    "gather": (Destination("gather", "to"), *_STANDS, _PACE, _GOOD, _THEN),
    "flee": (_Danger("flee"), _of_state("beyond"), _PACE, _THEN),
    "follow": (_Followed("follow"), _of_state("distance"), Optional(fields.Whole("person", 0)), _PACE),
    "queue": (Place("queue", "place"), Target("line", "LINE"), _of_state("spacing"), _STANDS[0], _STANDS[2], _PACE,
              _THEN),
    "sit": (_Seats("sit"), *_STANDS[:2], _PACE, _GOOD, _THEN),
}


def _does(raw):
    return next((key for key in DOES if key in raw), "stay")


def _put_state(state, name, raw, world):
    raw = raw if isinstance(raw, dict) else {}
    keep_raw(state, raw)
    state.name, state.does = name, _does(raw)
    for does in DOES:  # whatever it does, what it has in common with others is shown
        put_all((codec for codec in KEYS[does] if does == state.does or codec.key != does), state, raw, world)
    state.until.clear()
    for each in raw["until"] if isinstance(raw.get("until"), list) else []:
        _put_rule(state.until.add(), each, world)


def _take_state(state, world):
    raw = raw_of(state)
    raw = {} if raw is MISSING else raw
    codecs = KEYS[state.does]
    if state.does != _does(raw):
        own = {codec.key for codec in codecs} | {"until"}
        raw = {key: value for key, value in raw.items() if key in own}
    result = take_all(codecs, state, raw, world)
    rules = [_take_rule(rule, world) for rule in state.until]
    if rules or raw.get("until") == []:
        result["until"] = rules
    elif isinstance(raw.get("until"), list):
        del result["until"]
    return result


def _put_rule(rule, raw, world):
    raw = raw if isinstance(raw, dict) else {}
    keep_raw(rule, raw)
    _THEN.put(rule, raw.get("then", MISSING))
    rule.conditions.clear()
    for key in CONDITIONS:
        if key in raw:
            _put_condition(rule.conditions.add(), key, raw, world)


def _put_condition(condition, kind, raw, world):
    condition.kind = kind
    condition.who.clear()
    value = raw[kind]
    text = value if isinstance(value, str) else ""
    if kind in TIMES:
        Distribution("time").put(condition, value)
    elif kind in NUMBERS:
        _number(kind).put(condition, raw.get(NUMBERS[kind], MISSING))
    if kind in GATES:
        condition.wall = world.wall(text)
        condition.place.text = "" if condition.wall else text
    elif kind in LIGHTS:
        condition.place.text = text
    elif kind in PLACES:
        _put_where(condition, kind, value, raw, world)


def _put_where(condition, kind, value, raw, world):
    is_place = kind != "near" or not isinstance(value, str) or world.find(value)
    put_place(condition.place, value if is_place else "", world)
    people = [] if is_place else [value]
    if kind == "empty":
        people = raw.get("of", [])
    for text in people if isinstance(people, list) else [people]:
        put_member(condition.who.add(), text, world)


def _number(kind):
    """A number whose key is another one than the condition's, and which is always there unless it has a default."""
    entry = LAYOUT.entry("transition", NUMBERS[kind])
    beginning = entry.get("minimum", entry.get("default", 0.1))
    return fields.codec_of(NUMBERS[kind], entry, beginning, "number", required=kind == NUMBERS[kind])


def _take_rule(rule, world):
    raw = raw_of(rule)
    raw = {} if raw is MISSING else raw
    kinds = {condition.kind for condition in rule.conditions}
    gone = {key for key in CONDITIONS if key in raw and key not in kinds}
    gone |= {extra for kind, extra in (("near", "within"), ("empty", "of")) if kind not in kinds}
    result = {key: value for key, value in raw.items() if key not in gone}
    for condition in rule.conditions:
        result.update(_taken(condition, raw, world))
    result.pop("then", None)
    then = _THEN.take(rule, raw.get("then", MISSING))
    return {key: value for key, value in {**result, "then": then}.items() if value is not MISSING}


def _taken(condition, raw, world):
    """The keys of a condition, MISSING for those that go."""
    kind = condition.kind
    old, result = raw.get(kind, MISSING), {}
    if kind in TIMES:
        now = Distribution("time").take(condition, old)
        result[kind] = 0 if now is MISSING else now
    elif kind == "arrived":
        result[kind] = True if old is MISSING else old
    elif kind in GATES or kind in LIGHTS:
        text = world.name(condition.wall) if condition.wall and kind in GATES else condition.place.text
        result[kind] = text if text or isinstance(old, str) or old is MISSING else old
    elif kind in PLACES:
        result = _taken_place(condition, raw, world)
    if kind in NUMBERS:
        key = NUMBERS[kind]
        result[key] = _number(kind).take(condition, raw.get(key, MISSING))
    return result


def _taken_place(condition, raw, world):
    who = [name_of(member, world) for member in condition.who]
    if condition.kind == "near" and who and not condition.place.target:
        return {"near": who[0]}
    result = {condition.kind: place_of(condition.place, world)}
    if condition.kind == "empty":
        result["of"] = _people(who, raw.get("of", MISSING))
    return result


def _people(names, raw):
    if not names:
        return raw if raw == [] else MISSING
    return names[0] if len(names) == 1 and not isinstance(raw, list) else names


def put_behaviour(behaviour, raw, world):
    keep_raw(behaviour, raw)
    behaviour.name = raw["id"] if isinstance(raw.get("id"), str) else ""
    behaviour.start = raw["start"] if isinstance(raw.get("start"), str) else ""
    behaviour.states.clear()
    states = raw["states"] if isinstance(raw.get("states"), dict) else {}
    for name, state in states.items():
        _put_state(behaviour.states.add(), name, state, world)


def take_behaviour(behaviour, world):
    raw = raw_of(behaviour)
    raw = {} if raw is MISSING else raw
    result = {"id": behaviour.name, **raw}
    if behaviour.name or isinstance(raw.get("id"), str):
        result["id"] = behaviour.name
    elif "id" not in raw:
        del result["id"]
    if behaviour.start or "start" not in raw or isinstance(raw["start"], str):
        result["start"] = behaviour.start
    if len(behaviour.states) or "states" not in raw or isinstance(raw["states"], dict):
        result["states"] = {state.name: _take_state(state, world) for state in behaviour.states}
    return result
