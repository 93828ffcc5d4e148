# SPDX-License-Identifier: Apache-2.0
"""Places, destinations, stops and events: values that speak of other things of the layout. Pure Python.

A world stands between names and objects. On import it has find(text) -> (object, end) or None, wall(text),
member(text), block(text), point(raw) and line(raw), which make objects; on export place(object, end) -> text,
name(object), point_of(object, raw) and line_of(object, raw).
"""
import json

from . import fields
from .codecs import Codec, Number, Text, put_all, take_all
from .values import MISSING, are_points, is_number, is_point, short, single

_WEIGHT = Number("weight", 1.0)


def raw_of(group):
    """What the layout said about a thing, if it came from one."""
    return json.loads(group.raw) if group.raw else MISSING


def keep_raw(group, raw):
    group.raw = json.dumps(raw, separators=(",", ":"))


def put_place(ref, text, world):
    found = world.find(text) if isinstance(text, str) else None
    ref.target, ref.end = found or (None, "start")
    ref.text = text if isinstance(text, str) and not found else ""


def place_of(ref, world):
    return world.place(ref.target, ref.end) if ref.target else ref.text


def put_block(block, text, world):
    block.target = world.block(text)
    block.name = "" if block.target else text


def put_member(member, raw, world):
    """Formations and blocks of seats are objects; flows and given people have names."""
    member.target = world.member(raw) if isinstance(raw, str) else None
    member.name = raw if isinstance(raw, str) and member.target is None else ""


def name_of(member, world):
    return world.name(member.target) if member.target else member.name


def names_of_blocks(blocks, raw, world):
    """As the layout tells them: one of them without a list, where it was not in one before."""
    names = [name_of(block, world) for block in blocks]
    return names[0] if len(names) == 1 and not isinstance(raw, list) else names


class Destination(Codec):
    """One place, the nearest of several, or one of several by weight; of a goal also a seat."""

    def put(self, group, raw, world):
        part = getattr(group, self.attribute)
        part.places.clear()
        raw = raw if isinstance(raw, (str, dict)) else ""
        nearest, choose = (raw.get("nearest"), raw.get("choose")) if isinstance(raw, dict) else (None, None)
        if hasattr(part, "seats"):
            part.seats.clear()
            if isinstance(raw, dict) and "seats" in raw:
                self._put_seats(part, raw["seats"], world)
                return
        if isinstance(nearest, list):
            part.mode = "NEAREST"
            for text in nearest:
                put_place(part.places.add(), text, world)
        elif isinstance(choose, dict):
            part.mode = "CHOOSE"
            for text, weight in choose.items():
                ref = part.places.add()
                put_place(ref, text, world)
                ref.weight = _WEIGHT.shown(weight)
        else:
            part.mode = "PLACE"
            put_place(part.place, raw, world)

    @staticmethod
    def _put_seats(part, raw, world):
        part.mode = "SEATS"
        for text in raw if isinstance(raw, list) else [raw]:
            put_block(part.seats.add(), text if isinstance(text, str) else "", world)

    def take(self, group, raw, world):
        part = getattr(group, self.attribute)
        if part.mode == "SEATS":
            return {"seats": names_of_blocks(part.seats, raw.get("seats") if isinstance(raw, dict) else MISSING, world)}
        if part.mode == "PLACE":
            text = place_of(part.place, world)
            return raw if text == "" and raw is not MISSING and not isinstance(raw, str) else text
        if part.mode == "NEAREST":
            return {"nearest": [place_of(ref, world) for ref in part.places]}
        old = raw.get("choose") if isinstance(raw, dict) else None
        old = old if isinstance(old, dict) else {}
        return {"choose": {text: _WEIGHT.take(ref, old.get(text, 1.0)) for ref in part.places
                           for text in (place_of(ref, world),)}}


class Target(Codec):
    """A point or a line, which is an object in Blender."""

    def __init__(self, key, kind, attribute=None):
        super().__init__(key, attribute)
        self.kind = kind

    def _fits(self, raw):
        return is_point(raw) if self.kind == "POINT" else are_points(raw, 2)

    def put(self, group, raw, world):
        make = world.point if self.kind == "POINT" else world.line
        setattr(group, self.attribute, make(raw) if self._fits(raw) else None)

    def take(self, group, raw, world):
        target = getattr(group, self.attribute)
        if target is None:
            return MISSING if self._fits(raw) else raw
        position = world.point_of if self.kind == "POINT" else world.line_of
        return position(target, raw if self._fits(raw) else None)


STOP = fields.STOP + (Target("facing", "POINT"), Target("line", "LINE"))
_AT = Destination("at")


class Stops(Codec):
    """A flow's list of places on the way."""

    def put(self, group, raw, world):
        stops = getattr(group, self.attribute)
        stops.clear()
        for each in raw if isinstance(raw, list) else []:
            stop = stops.add()
            keep_raw(stop, each)
            detailed = isinstance(each, dict) and "at" in each
            _AT.put(stop, each["at"] if detailed else each, world)
            put_all(STOP, stop, each if detailed else {}, world)

    def take(self, group, raw, world):
        stops = [self._stop(stop, world) for stop in getattr(group, self.attribute)]
        return raw if not stops and not isinstance(raw, list) else stops

    @staticmethod
    def _stop(stop, world):
        raw = raw_of(stop)
        detailed = isinstance(raw, dict) and "at" in raw
        result = take_all((_AT,) + STOP, stop, raw if detailed else {} if raw is MISSING else {"at": raw}, world)
        return result if detailed or len(result) > 1 else result["at"]


class Place(Codec):
    def put(self, group, raw, world):
        put_place(getattr(group, self.attribute), raw, world)

    def take(self, group, raw, world):
        text = place_of(getattr(group, self.attribute), world)
        return raw if text == "" and raw is not MISSING and not isinstance(raw, str) else text


class Amount(Codec):
    """So many people in all, or so many a second; gaps and moments that a layout tells are kept."""

    codecs = {"COUNT": fields.Whole("count", 100, required=True), "RATE": Number("rate", 1.0, required=True)}

    def __init__(self):
        super().__init__("count")

    @staticmethod
    def shown(raw):
        if "count" not in raw and ("gaps" in raw or "times" in raw):
            return "KEPT"
        return "RATE" if is_number(raw.get("rate")) and "count" not in raw else "COUNT"

    def put_both(self, group, raw):
        group.amount = self.shown(raw)
        put_all(self.codecs.values(), group, raw)

    def take_both(self, group, raw, result):
        amount = group.amount
        if amount == "KEPT" and self.shown(raw) != "KEPT":
            amount = "COUNT"  # there is nothing to keep
        if amount != self.shown(raw):
            for key in ("count", "rate", "gaps", "times"):
                result.pop(key, None)
        if amount != "KEPT":
            codec = self.codecs[amount]
            result[codec.key] = codec.take(group, raw.get(codec.key, MISSING))


AMOUNT = Amount()
BEHAVIOUR = Text("behaviour")
FLOW = (Place("from", "source"), Stops("via"), Destination("to"), BEHAVIOUR) + fields.FLOW


def put_flow(flow, raw, world):
    keep_raw(flow, raw)
    flow.name = raw["id"] if isinstance(raw.get("id"), str) else ""
    put_all(FLOW, flow, raw, world)
    AMOUNT.put_both(flow, raw)


def take_flow(flow, world):
    raw = raw_of(flow)
    raw = {} if raw is MISSING else raw
    result = {"id": flow.name, **take_all(FLOW, flow, {key: value for key, value in raw.items() if key != "id"}, world)}
    AMOUNT.take_both(flow, raw, result)
    if not flow.name and not isinstance(raw.get("id"), str):
        del result["id"]
        result.update({"id": raw["id"]} if "id" in raw else {})
    if result.get("from") == "" and "alight" in result:
        del result["from"]
    return without_goal(in_place_of(result, raw, ("to", "via")), "to")


def in_place_of(entry, raw, goals):
    """A flow's or formation's object, without the goals that it had before it got a behaviour."""
    if "behaviour" not in entry or "behaviour" in raw:
        return entry
    return {key: value for key, value in entry.items() if key not in goals}


def without_goal(entry, key):
    """A behaviour, or what people get on, stands in place of where they go, if that has not been chosen."""
    told = "behaviour" in entry or "board" in entry
    return {name: value for name, value in entry.items() if name != key or value != "" or not told}


_GO_TO = Destination("go_to", "destination")
_EVENT_KINDS = {"open": ("open",), "close": ("close",), "go_to": ("go_to", "who", "arrival"), "flow": ("flow", "rate")}
_EVENT_AT = Number("at", 0.0, "time", required=True)
_EVENT_RATE = Number("rate", 1.0, required=True)
_EVENT_ARRIVAL = fields.Choice("arrival", ("leave", "stay"), "leave")


def _event_kind(raw):
    return next((kind for kind in _EVENT_KINDS if kind in raw), "open")


def put_event(event, raw, world):
    keep_raw(event, raw)
    event.kind = _event_kind(raw)
    _EVENT_AT.put(event, raw.get("at", MISSING))
    name = raw.get(event.kind) if event.kind in ("open", "close") else None
    event.wall = world.wall(name) if isinstance(name, str) else None
    event.text = name if isinstance(name, str) and event.wall is None else ""
    _GO_TO.put(event, raw.get("go_to", MISSING), world)
    event.flow = raw["flow"] if isinstance(raw.get("flow"), str) else ""
    _EVENT_RATE.put(event, raw.get("rate", MISSING))
    _EVENT_ARRIVAL.put(event, raw.get("arrival", MISSING))
    event.who.clear()
    for text in raw["who"] if isinstance(raw.get("who"), list) else []:
        put_member(event.who.add(), text, world)


def take_event(event, world):
    raw = raw_of(event)
    raw = {} if raw is MISSING else raw
    result = dict(raw)
    if event.kind != _event_kind(raw):
        for keys in _EVENT_KINDS.values():
            for key in keys:
                result.pop(key, None)
    values = {"at": _EVENT_AT.take(event, raw.get("at", MISSING))}
    if event.kind in ("open", "close"):
        values[event.kind] = world.name(event.wall) if event.wall else event.text
    elif event.kind == "flow":
        values["flow"], values["rate"] = event.flow, _EVENT_RATE.take(event, raw.get("rate", MISSING))
    else:
        values["go_to"] = _GO_TO.take(event, raw.get("go_to", MISSING), world)
        values["arrival"] = _EVENT_ARRIVAL.take(event, raw.get("arrival", MISSING))
        values["who"] = [name_of(each, world) for each in event.who]
        if not values["who"] and "who" not in raw:
            values["who"] = MISSING
    for key, value in values.items():
        if value is MISSING:
            result.pop(key, None)
        else:
            result[key] = value
    return result


_LINE = Target("line", "LINE", "expect_line")


def put_expect(scene, raw, world):
    """`expect`: a list of bars, and the line where people are counted."""
    scene.bars.clear()
    raw = raw if isinstance(raw, dict) else {}
    for key, value in raw.items():
        if key in fields.BARS and isinstance(value, dict):
            bar = scene.bars.add()
            bar.figure = key
            put_all(fields.BAR, bar, value)
    _LINE.put(scene, raw.get("line", MISSING), world)


def take_expect(scene, raw, world):
    old = raw if isinstance(raw, dict) else {}
    result = {key: value for key, value in old.items() if key not in fields.BARS or not isinstance(value, dict)}
    for bar in scene.bars:
        before = old.get(bar.figure)
        result[bar.figure] = take_all(fields.BAR, bar, before if isinstance(before, dict) else {})
    line = _LINE.take(scene, old.get("line", MISSING), world)
    result.pop("line", None)
    if line is not MISSING:
        result["line"] = line
    return raw if result == old else result


_OFFSET = "offset"


def put_goal(formation, raw, world):
    """A grid's goal: a destination, an offset, a line to mirror at, or a box between two corners."""
    formation.goal_kind = "PLACE"
    formation.goal_line = None
    kind = next((key for key in (_OFFSET, "mirror", "anywhere") if isinstance(raw, dict) and key in raw), None)
    if kind == _OFFSET and is_point(raw[kind]):
        formation.goal_kind, formation.goal_offset = "OFFSET", raw[kind]
    elif kind in ("mirror", "anywhere") and are_points(raw[kind], 2):
        formation.goal_kind, formation.goal_line = kind.upper(), world.line(raw[kind])
    Destination("goal").put(formation, raw if kind is None else "", world)


def take_goal(formation, raw, world):
    kind = formation.goal_kind
    if kind == "PLACE":
        return Destination("goal").take(formation, raw, world)
    if kind == "OFFSET":
        old = raw.get(_OFFSET) if isinstance(raw, dict) else None
        now = tuple(formation.goal_offset)
        same = is_point(old) and tuple(single(part) for part in old) == now
        return raw if same else {_OFFSET: [short(part) for part in now]}
    key = kind.lower()
    old = raw.get(key) if isinstance(raw, dict) else None
    return {key: world.line_of(formation.goal_line, old if are_points(old, 2) else None) if formation.goal_line else []}
