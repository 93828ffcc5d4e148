# SPDX-License-Identifier: Apache-2.0
"""Blocks of seats and what their audiences do, as properties. Pure Python; for the world between names and objects see
places.py."""
from . import fields, levels
from .codecs import Codec, Nested, put_all, take_all
from .places import Destination, Target, keep_raw, name_of, put_block, raw_of
from .values import MISSING



class _Foot(Codec):
    """A level, which is an object."""

    def put(self, group, raw, world):
        setattr(group, self.attribute, world.level(raw))

    def take(self, group, raw, world):
        return levels.level_of(getattr(group, self.attribute), raw, world)


_FOOT = _Foot("level")


class _Mouths(Nested):
    """Where aisles go out: what else is told depends on it."""

    def __init__(self):
        super().__init__("mouths", (*fields.MOUTHS["row"], _FOOT))

    def take(self, group, raw, world=None):
        part = getattr(group, self.attribute)
        if not group.aisles and not isinstance(raw, dict):
            return raw  # nobody goes out, and nobody is asked where
        inner = raw if isinstance(raw, dict) else {}
        codecs = (*fields.MOUTHS[part.at], _FOOT)
        if part.at != codecs[0].shown(inner.get("at", MISSING)):
            own = {codec.key for codec in codecs}
            inner = {key: value for key, value in inner.items() if key in own}
        value = take_all(codecs, part, inner, world)
        if not isinstance(raw, dict):
            return raw if not value else value
        return MISSING if not value and raw else value


class _Leave(Codec):
    """A switch, when, and where to."""

    codecs = (fields.LEAVE_AT, Destination("to", "leave_to"))

    def __init__(self):
        super().__init__("leave")

    def put(self, group, raw, world=None):
        group.use_leave = isinstance(raw, dict)
        put_all(self.codecs, group, raw if group.use_leave else {}, world)

    def take(self, group, raw, world=None):
        if not group.use_leave:
            return MISSING if isinstance(raw, dict) else raw
        return take_all(self.codecs, group, raw if isinstance(raw, dict) else {}, world)


SEATS = (*fields.SEATS, Target("facing", "POINT"), _Mouths(), _Leave())


class _Who(Codec):
    """Blocks of seats; none means all of them."""

    def __init__(self):
        super().__init__("who")

    def put(self, group, raw, world):
        group.who.clear()
        for text in raw if isinstance(raw, list) else []:
            put_block(group.who.add(), text if isinstance(text, str) else "", world)

    def take(self, group, raw, world):
        names = [name_of(block, world) for block in group.who]
        return names or (MISSING if isinstance(raw, list) and raw else raw)


_WHO, _FROM = _Who(), Target("from", "POINT", "origin")
_COMMON = (*fields.SHOW, _WHO, *fields.SHOW_OF_ALL)
_OF = {False: (*_COMMON, *fields.SHOW_FOR), True: (*_COMMON, *fields.WAVE, _FROM)}


def is_wave(does):
    return does == "wave"


def put_show(show, raw, world):
    keep_raw(show, raw)
    put_all((*_OF[False], *fields.WAVE, _FROM), show, raw, world)


def take_show(show, world):
    raw = raw_of(show)
    raw = {} if raw is MISSING else raw
    wave = is_wave(show.do)
    if wave != is_wave(raw.get("do")):
        foreign = {codec.key for codec in _OF[not wave]} - {codec.key for codec in _OF[wave]}
        raw = {key: value for key, value in raw.items() if key not in foreign}
    return take_all(_OF[wave], show, raw, world)
