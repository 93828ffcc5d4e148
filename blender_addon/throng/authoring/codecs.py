# SPDX-License-Identifier: Apache-2.0
"""How values of a layout become properties and properties become values. Pure Python: a group is anything with
attributes.

A codec puts a value (or MISSING) into a group, and takes it out again, given the value that was put in. A property that
still shows what that value looks like gives the value itself, with all its digits, or its absence; so a layout that
went through Blender differs only where somebody changed something, and what has no property of its own survives.
"""
from .schema import LAYOUT, words_of
from .values import MISSING, is_number, keep_digits, short, single, whole

UNSET = "UNSET"


class Codec:
    """A key whose value is one property. `shown` is what the property holds for a value, `written` the way back."""

    required = False

    def __init__(self, key, attribute=None):
        self.key, self.attribute = key, attribute or key

    def put(self, group, raw, _world=None):
        setattr(group, self.attribute, self.shown(raw))

    def present(self, group):
        return getattr(group, self.attribute)

    def take(self, group, raw, _world=None):
        value = self.present(group)
        if value == self.shown(raw) and not (self.required and raw is MISSING):
            return raw
        return keep_digits(self.written(value), raw)

    def written(self, value):
        return value


class Text(Codec):
    """A name; none is no key."""

    def shown(self, raw):
        return raw if isinstance(raw, str) else ""

    def written(self, value):
        return value or MISSING


class Number(Codec):
    def __init__(self, key, default, attribute=None, required=False):
        super().__init__(key, attribute)
        self.default, self.required = default, required

    def shown(self, raw):
        return single(raw if is_number(raw) else self.default)

    def written(self, value):
        return short(value)


class Whole(Number):
    def shown(self, raw):
        return whole(raw if is_number(raw) else self.default)

    def written(self, value):
        return value


class Optional(Codec):
    """A number that need not be there: a switch `use_...` and the number."""

    def __init__(self, number):
        super().__init__(number.key, number.attribute)
        self.number, self.switch = number, f"use_{number.attribute}"

    def shown(self, raw):
        return self.number.shown(raw) if is_number(raw) else None

    def present(self, group):
        return getattr(group, self.attribute) if getattr(group, self.switch) else None

    def put(self, group, raw, _world=None):
        setattr(group, self.switch, is_number(raw))
        setattr(group, self.attribute, self.number.shown(raw))

    def written(self, value):
        return MISSING if value is None else self.number.written(value)


class Flag(Codec):
    def __init__(self, key, default=False, attribute=None):
        super().__init__(key, attribute)
        self.default = default

    def shown(self, raw):
        return raw if isinstance(raw, bool) else self.default


class Choice(Codec):
    """One of some words; without a default, it may also be unset."""

    def __init__(self, key, words, default=UNSET, attribute=None, required=False):
        super().__init__(key, attribute)
        self.words, self.default, self.required = words, default, required

    def shown(self, raw):
        return raw if isinstance(raw, str) and raw in self.words else self.default

    def written(self, value):
        return MISSING if value == UNSET else value


class Distribution(Codec):
    """A number, or a distribution: a group with kind, a, b, and least and most that need not be there."""

    KINDS = ("NUMBER", "uniform", "normal", "log_normal")

    def shown(self, raw):
        if is_number(raw):
            return ("NUMBER", single(raw), 0.0, None, None)
        if isinstance(raw, dict):
            for kind in self.KINDS[1:]:
                pair = raw.get(kind)
                if isinstance(pair, list) and len(pair) == 2 and all(is_number(part) for part in pair):
                    ends = [single(raw[end]) if is_number(raw.get(end)) else None for end in ("min", "max")]
                    return (kind, single(pair[0]), single(pair[1]), *ends)
        return (UNSET, 0.0, 0.0, None, None)

    def put(self, group, raw, _world=None):
        part = getattr(group, self.attribute)
        part.kind, part.a, part.b, least, most = self.shown(raw)
        part.use_least, part.least = least is not None, least or 0.0
        part.use_most, part.most = most is not None, most or 0.0

    def present(self, group):
        part = getattr(group, self.attribute)
        if part.kind == UNSET:
            return self.shown(MISSING)
        if part.kind == "NUMBER":
            return ("NUMBER", part.a, 0.0, None, None)
        ends = (part.least if part.use_least else None, part.most if part.use_most else None)
        return (part.kind, part.a, part.b, *(ends if part.kind != "uniform" else (None, None)))

    def written(self, value):
        kind, a, b, least, most = value
        if kind == UNSET:
            return MISSING
        if kind == "NUMBER":
            return short(a)
        result = {kind: [short(a), short(b)]}
        result.update({end: short(part) for end, part in (("min", least), ("max", most)) if part is not None})
        return result


PROFILES = words_of(LAYOUT.entry("people", "profile"))
LOOKS = words_of(LAYOUT.entry("people", "look"))
MIX = "MIX"


class _WordOrWeights(Codec):
    """A word (an enum), or weights of several kinds for MIX. `weights_of` tells the weights in a value; None: it has
    none."""

    words = ()

    def __init__(self, key, weights):
        super().__init__(key)
        self.weights = weights

    def shown(self, raw):
        if isinstance(raw, str) and raw in self.words:
            return raw
        weights = self.weights_of(raw)
        return UNSET if weights is None else tuple(single(weight) for weight in weights)

    def put(self, group, raw, _world=None):
        value = self.shown(raw)
        setattr(group, self.attribute, value if isinstance(value, str) else MIX)
        setattr(group, self.weights, value if isinstance(value, tuple) else (1.0, 0.0, 0.0, 0.0))

    def present(self, group):
        word = getattr(group, self.attribute)
        return tuple(getattr(group, self.weights)) if word == MIX else word

    def written(self, value):
        if isinstance(value, tuple):
            return self.mixed(value)
        return MISSING if value == UNSET else value


class Profile(_WordOrWeights):
    """A kind of people, or several by weight."""

    words = PROFILES

    def weights_of(self, raw):
        if isinstance(raw, dict) and raw and all(key in PROFILES and is_number(value) for key, value in raw.items()):
            return [raw.get(word, 0.0) for word in PROFILES]
        return None

    def mixed(self, weights):
        return {word: short(weight) for word, weight in zip(PROFILES, weights) if weight > 0.0}


_BODY = LAYOUT.entry("people", "body")
BODIES = words_of(_BODY)


class Body(Choice):
    """A body that has a name; unset where the layout has its breadth and depth, which stay as they are."""

    def __init__(self, key):
        super().__init__(key, BODIES, _BODY["default"])

    def shown(self, raw):
        return UNSET if isinstance(raw, dict) else super().shown(raw)


GROUPS = words_of(LAYOUT.entry("people", "groups"))


class Groups(_WordOrWeights):
    """Who walks together: a word, or weights of one to four."""

    words = GROUPS

    def weights_of(self, raw):
        if isinstance(raw, list) and 1 <= len(raw) <= 4 and all(is_number(part) for part in raw):
            return (raw + [0.0] * 4)[:4]
        return None

    def mixed(self, weights):
        return [short(weight) for weight in weights]


class Nested(Codec):
    """An object of its own keys."""

    def __init__(self, key, codecs, attribute=None):
        super().__init__(key, attribute)
        self.codecs = codecs

    def put(self, group, raw, world=None):
        put_all(self.codecs, getattr(group, self.attribute), raw if isinstance(raw, dict) else {}, world)

    def take(self, group, raw, world=None):
        inner = raw if isinstance(raw, dict) else {}
        value = take_all(self.codecs, getattr(group, self.attribute), inner, world)
        return raw if value == inner else value


def put_all(codecs, group, raw, world=None):
    for codec in codecs:
        codec.put(group, raw.get(codec.key, MISSING), world)


def take_all(codecs, group, raw, world=None):
    """The object: what `raw` has, with what the properties say."""
    result = dict(raw)
    for codec in codecs:
        value = codec.take(group, raw.get(codec.key, MISSING), world)
        if value is MISSING:
            result.pop(codec.key, None)
        else:
            result[codec.key] = value
    return result
