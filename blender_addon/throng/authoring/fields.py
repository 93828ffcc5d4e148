# SPDX-License-Identifier: Apache-2.0
"""What a layout's objects hold, as codecs. Limits, defaults, words and what they mean are the schema's; labels, order
and what something new begins with, where the schema has no default, are ours. Pure Python."""
from . import schema
from .codecs import UNSET, Body, Choice, Distribution, Flag, Groups, Nested, Number, Optional, Profile, Whole

_LABELS = {"warmup": "Warm-up", "fps": "Frame Rate"}
_SMALL_WORDS = ("of", "per")
# The settings of the simulation that come first; the others follow in the schema's order.
_FIRST = ("duration", "warmup", "fps", "substeps", "seed", "avoid_congestion", "smoothing")
# What something new begins with where the schema has no default.
_BEGINNINGS = {
    "flow": {"count": 100, "rate": 1.0, "end": 60.0}, "event": {"at": 0.0, "rate": 1.0},
    "show": {"do": "clap"},
    "formation": {"radius": 10.0, "count": 64, "ring_spacing": 1.5, "along": 1.5, "rows": 8, "columns": 8},
    "seat_block.arc": {"radius": 15.0, "from": 0.0, "to": 90.0}, "seat_block.mouths": {"passage": 5.0},
    "patch": {"cost": 3.0, "until": 60.0}, "bar": {"min": 0.0, "max": 0.0}, "given": {"fps": 25.0},
}


def label_of(key):
    words = key.split("_")
    return _LABELS.get(key) or " ".join(word if word in _SMALL_WORDS else word.capitalize() for word in words)


def codec_of(key, entry, beginning=None, attribute=None, required=False):
    """How a key becomes a property."""
    if schema.is_distribution(entry):
        return Distribution(key, attribute)
    default = entry.get("default", beginning)
    if entry.get("type") == "boolean":
        return Flag(key, default, attribute)
    if "enum" in entry:
        return Choice(key, schema.words_of(entry), UNSET if default is None else default, attribute, required)
    if entry.get("type") == "integer":
        return Whole(key, default, attribute, required)
    return Number(key, float(default), attribute, required)


def row_of(key, entry):
    """(codec, label, least, most, what it is)"""
    return (codec_of(key, entry), label_of(key), *schema.limits_of(entry), schema.description_of(entry))


def row_of_rule(key, entry):
    """Numbers of rules have units of their own beside what they are."""
    *row, about = row_of(key, entry)
    return (*row, ", ".join(part for part in (about, schema.unit_of(entry)) if part))


def rows_of(owner, first=(), layout=schema.LAYOUT, row_of=row_of):
    """The rows of all keys of an object, some of them first."""
    entries = layout.entries(owner)
    return tuple(row_of(key, layout.followed(entries[key]))
                 for key in (*first, *(key for key in entries if key not in first)))


def motion_of(layout):
    """(rule, label, what it is, rows) for each rule of motion that the schema knows, each an object of its own."""
    if "motion" not in layout.document["properties"]:
        return ()
    rules = layout.entries(layout.named("motion"))
    followed = ((name, layout.followed(rule)) for name, rule in rules.items())
    return tuple((name, rule.get("title") or label_of(name), schema.description_of(rule),
                  rows_of(rule, layout=layout, row_of=row_of_rule)) for name, rule in followed)


def _codec(name, key, attribute=None, required=False):
    beginning = _BEGINNINGS.get(name, {}).get(key)
    return codec_of(key, schema.LAYOUT.entry(name, key), beginning, attribute, required)


def _codecs(name, *keys):
    return tuple(_codec(name, key) for key in keys)


def limits(name, key, **ours):
    """What a number's property in Blender is made with: where it begins, and how far it is dragged. What is given here
    goes before what the schema says."""
    least, most = schema.limits_of(schema.LAYOUT.entry(name, key))
    return {"default": _codec(name, key).default, "soft_min": least, "soft_max": most, **ours}


SIMULATION = rows_of(schema.LAYOUT.named("simulation"), _FIRST)
MOTION = motion_of(schema.LAYOUT)
# The two as keys of the layout.
SETTINGS = (Nested("simulation", [row[0] for row in SIMULATION]),
            Nested("motion", [Nested(name, [row[0] for row in rows]) for name, _, _, rows in MOTION]))

METHODS = schema.words_of(schema.LAYOUT.entry("simulation", "method"))

BARS = tuple(key for key, entry in schema.LAYOUT.entries(schema.LAYOUT.named("expect")).items() if "$ref" in entry)
BAR = (Optional(_codec("bar", "min", "least")), Optional(_codec("bar", "max", "most")))

PEOPLE = (*_codecs("people", "speed", "radius", "maximum_speed_factor", "headway"), Body("body"),
          Profile("profile", "profile_weights"), _codec("people", "reaction"), Groups("groups", "group_weights"),
          _codec("people", "look"))

LINK = _codecs("link", "type", "width", "speed", "walking", "stand")
LINK_TYPES = tuple(word for word in schema.words_of(schema.LAYOUT.entry("link", "type")) if word != "lift")
ROAD = _codecs("road", "width", "one_way")
OPEN_WALL = _codecs("wall", "thickness", "height")
CLOSED_WALL = _codecs("wall", "height")

PATCH = (Optional(_codec("patch", "cost")), _codec("patch", "pace"), _codec("patch", "size", "room"),
         _codec("patch", "from", "begins"),
         Optional(_codec("patch", "until", "ends")))

ARC = (_codec("seat_block.arc", "radius", required=True), _codec("seat_block.arc", "from", "begins", required=True),
       _codec("seat_block.arc", "to", "ends", required=True))
SEATS = (*_codecs("seat_block", "rows", "pitch", "width", "rise", "height", "aisles", "aisle_width", "on_terrain",
                  "occupancy"), Nested("people", PEOPLE))
_MOUTHS_AT = _codec("seat_block.mouths", "at")
_PASSAGE = Optional(_codec("seat_block.mouths", "passage"))
# What is told of where aisles go out.
MOUTHS = {"front": (_MOUTHS_AT,), "back": (_MOUTHS_AT, _PASSAGE),
          "row": (_MOUTHS_AT, _codec("seat_block.mouths", "row", required=True), _PASSAGE)}
LEAVE_AT = _codec("seat_block.leave", "at", "leave_at")

SHOW = (_codec("show", "at", "time"), _codec("show", "do", required=True))
SHOW_OF_ALL = _codecs("show", "share", "reaction")
SHOW_FOR = (_codec("show", "for", "lasts"),)
WAVE = _codecs("show", "speed", "width", "laps")

FLOW = (_codec("flow", "start"), Optional(_codec("flow", "end")), Nested("people", PEOPLE), _codec("flow", "arrival"))

GIVEN_FPS = Optional(_codec("given", "fps"))
GIVEN = (_codec("given", "start"), Nested("people", PEOPLE))

STOP = _codecs("stop", "wait", "activity", "spacing")

_STANDING = (*_codecs("formation", "start", "wait"), Nested("people", PEOPLE),
             *_codecs("formation", "arrival", "goal_tolerance"))
FORMATION = {
    "circle": (_codec("formation", "radius", required=True), _codec("formation", "count", required=True),
               Optional(_codec("formation", "ring_spacing")), Optional(_codec("formation", "along"))) + _STANDING,
    "grid": (_codec("formation", "rows", required=True), _codec("formation", "columns", required=True),
             Optional(_codec("formation", "count", "people_count")),
             *_codecs("formation", "spacing", "jitter")) + _STANDING,
    "agents": _STANDING,
}
