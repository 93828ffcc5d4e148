# SPDX-License-Identifier: Apache-2.0
"""Seats as the artist edits them: a curve is the first row of a block, or an arc of numbers; and shows, which audiences
do in them."""
import bpy
from bpy.props import (BoolProperty, CollectionProperty, EnumProperty, FloatProperty, IntProperty, PointerProperty,
                       StringProperty)

from . import display
from .codecs import UNSET
from .common_properties import ThrongBlock, ThrongDestination, ThrongDistribution, is_kind
from .fields import limits
from .people_properties import ThrongPeople
from .schema import LAYOUT, description_of, words_of

_MOUTHS = {"front": "Before the first row", "back": "Behind the last row, by a passage to its foot",
           "row": "Through an opening in the stand, and a passage under the rows behind it"}


def _about(name, key):
    return description_of(LAYOUT.entry(name, key))


def _words(name, key, about=()):
    return [(word, word.capitalize(), dict(about).get(word, "")) for word in words_of(LAYOUT.entry(name, key))]


def _refresh(group, _context):
    display.refresh(group.id_data)


def _leaves(seats, _context):
    """Who leaves does so at a time."""
    if seats.use_leave and seats.leave_at.kind == UNSET:
        seats.leave_at.kind, seats.leave_at.a = "NUMBER", 60.0
    display.refresh(seats.id_data)


def _number(make, key, label, owner="seat_block", **ours):
    return make(name=label, **limits(owner, key, **ours), description=_about(owner, key), update=_refresh)


class ThrongMouths(bpy.types.PropertyGroup):
    at: EnumProperty(name="Aisles Go Out", items=_words("seat_block.mouths", "at", _MOUTHS), default="front",
                     update=_refresh)
    row: _number(IntProperty, "row", "Row", "seat_block.mouths")
    use_passage: BoolProperty(name="Passage", update=_refresh, description="Otherwise to just behind the block")
    passage: _number(FloatProperty, "passage", "Passage", "seat_block.mouths", subtype="DISTANCE")
    level: PointerProperty(type=bpy.types.Object, name="Foot", poll=is_kind("LEVEL"), update=_refresh,
                           description="The level on which the foot of the passage is; by default the block's")


class ThrongSeats(bpy.types.PropertyGroup):
    shape: EnumProperty(name="First Row", update=_refresh,
                        items=[("LINE", "Curve", "The curve's points: people look to its left"),
                               ("ARC", "Arc", "Part of a circle round the object's origin, at which people look")])
    radius: _number(FloatProperty, "radius", "Radius", "seat_block.arc", subtype="DISTANCE")
    begins: _number(FloatProperty, "from", "From", "seat_block.arc", soft_min=-360.0, soft_max=360.0)
    ends: _number(FloatProperty, "to", "To", "seat_block.arc", soft_min=-360.0, soft_max=720.0)
    rows: _number(IntProperty, "rows", "Rows")
    pitch: _number(FloatProperty, "pitch", "Pitch", subtype="DISTANCE")
    width: _number(FloatProperty, "width", "Seat Width", subtype="DISTANCE")
    rise: _number(FloatProperty, "rise", "Rise", subtype="DISTANCE")
    height: _number(FloatProperty, "height", "Height", subtype="DISTANCE")
    aisles: _number(IntProperty, "aisles", "Aisles")
    aisle_width: _number(FloatProperty, "aisle_width", "Aisle Width", subtype="DISTANCE")
    mouths: PointerProperty(type=ThrongMouths)
    on_terrain: BoolProperty(name="On Terrain", description=_about("seat_block", "on_terrain"))
    facing: PointerProperty(type=bpy.types.Object, name="Facing", poll=is_kind("POINT"),
                            description=_about("seat_block", "facing"))
    occupancy: FloatProperty(name="Occupancy", **limits("seat_block", "occupancy"), subtype="FACTOR",
                             description=_about("seat_block", "occupancy"))
    people: PointerProperty(type=ThrongPeople)
    use_leave: BoolProperty(name="Leave", update=_leaves, description=_about("seat_block", "leave"))
    leave_at: PointerProperty(type=ThrongDistribution, name="At", description=_about("seat_block.leave", "at"))
    leave_to: PointerProperty(type=ThrongDestination, name="To")


class ThrongShow(bpy.types.PropertyGroup):
    """Something that an audience does."""

    raw: StringProperty(options={"HIDDEN"})
    time: PointerProperty(type=ThrongDistribution, name="At", description=_about("show", "at"))
    do: EnumProperty(name="Do", items=_words("show", "do"), description=_about("show", "do"))
    who: CollectionProperty(type=ThrongBlock)
    share: FloatProperty(name="Share", **limits("show", "share"), subtype="FACTOR", description=_about("show", "share"))
    lasts: PointerProperty(type=ThrongDistribution, name="For", description=_about("show", "for"))
    reaction: PointerProperty(type=ThrongDistribution, name="Reaction", description=_about("show", "reaction"))
    speed: FloatProperty(name="Speed", **limits("show", "speed"), description=_about("show", "speed"))
    width: FloatProperty(name="Width", **limits("show", "width"), description=_about("show", "width"))
    origin: PointerProperty(type=bpy.types.Object, name="From", poll=is_kind("POINT"),
                            description=_about("show", "from"))
    laps: IntProperty(name="Laps", **limits("show", "laps"), description=_about("show", "laps"))


CLASSES = (ThrongMouths, ThrongSeats, ThrongShow)
