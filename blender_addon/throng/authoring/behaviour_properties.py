# SPDX-License-Identifier: Apache-2.0
"""Behaviours as the artist edits them: states, what people do in each, and what ends it."""
import bpy
from bpy.props import (BoolProperty, CollectionProperty, EnumProperty, FloatProperty, IntProperty, PointerProperty,
                       StringProperty)

from . import behaviours
from .codecs import UNSET
from .common_properties import (
    Named, ThrongBlock, ThrongDestination, ThrongDistribution, ThrongMember, ThrongPlace, is_kind)
from .fields import limits
from .schema import LAYOUT, description_of, words_of

_NAMES = {
    "after": "After", "at": "At", "arrived": "In Place", "near": "Near", "crowded": "Crowded", "chance": "By Chance",
    "empty": "Empty", "all_here": "All Here", "open": "Gate Open", "closed": "Gate Closed",
    "green": "Signal Green", "red": "Signal Red",
}


def _items(owner, keys):
    return [(key, _NAMES.get(key) or key.replace("_", " ").title(), description_of(LAYOUT.entry(owner, key)))
            for key in keys]


def _once(condition, _context):
    """A rule has a key once: of another condition of its kind this one becomes the next kind that there is none of."""
    for behaviour in condition.id_data.throng_layout.behaviours:
        for rule in (rule for state in behaviour.states for rule in state.until):
            others = {each.kind for each in rule.conditions if each != condition}
            if condition.kind in others and any(each == condition for each in rule.conditions):
                condition.kind = next(kind for kind in behaviours.CONDITIONS if kind not in others)
                return


def _owner_of(state):
    for behaviour in state.id_data.throng_layout.behaviours:
        if any(each == state for each in behaviour.states):
            return behaviour
    return None


def group_named(layout, before, name):
    """Behaviours and events speak of flows and given people by name."""
    states = [state for behaviour in layout.behaviours for state in behaviour.states]
    conditions = [condition for state in states for rule in state.until for condition in rule.conditions]
    for member in (*(state.followed for state in states), *(each for condition in conditions for each in condition.who),
                   *(each for event in layout.events for each in event.who)):
        if member.target is None and member.name == before:
            member.name = name


class ThrongCondition(bpy.types.PropertyGroup):
    kind: EnumProperty(name="When", items=_items("transition", behaviours.CONDITIONS), update=_once)
    time: PointerProperty(type=ThrongDistribution, name="Time", description="s; from a distribution each draws its own")
    number: FloatProperty(name="Number", soft_min=0.0)
    place: PointerProperty(type=ThrongPlace)
    who: CollectionProperty(type=ThrongMember)
    wall: PointerProperty(type=bpy.types.Object, name="Wall", poll=is_kind("WALL"))


class ThrongRule(bpy.types.PropertyGroup):
    raw: StringProperty(options={"HIDDEN"})
    conditions: CollectionProperty(type=ThrongCondition)
    then: StringProperty(name="Then", description="The state that comes then")


class ThrongState(Named, bpy.types.PropertyGroup):
    raw: StringProperty(options={"HIDDEN"})
    does: EnumProperty(name="Does", items=_items("behaviour_state", behaviours.DOES), default="stay")
    to: PointerProperty(type=ThrongDestination, name="To")
    place: PointerProperty(type=ThrongPlace)
    danger: PointerProperty(type=bpy.types.Object, name="Point", poll=is_kind("POINT"),
                            description="What people get away from, where that is no place")
    followed: PointerProperty(type=ThrongMember)
    seats: CollectionProperty(type=ThrongBlock)
    use_person: BoolProperty(name="Person", description="One of them; otherwise whoever is nearest")
    person: IntProperty(name="Person", **limits("behaviour_state", "person", default=0))
    use_count: BoolProperty(name="How Many", description="Otherwise all of the places")
    least: IntProperty(name="At Least", default=1, soft_min=1, soft_max=32)
    most: IntProperty(name="At Most", default=1, soft_min=1, soft_max=32)
    lasts: PointerProperty(type=ThrongDistribution, name="For", description="How long, s; on visits, in each place")
    pose: EnumProperty(name="There", description="What people do where they have come to rest",
                       items=[(UNSET, "Default", "On visits they look, in seats they sit, otherwise they stand")]
                             + [(word, word.capitalize(), "")
                                for word in words_of(LAYOUT.entry("behaviour_state", "do"))])
    facing: PointerProperty(type=bpy.types.Object, name="Facing", poll=is_kind("POINT"),
                            description="What people look at; by default what the area faces")
    beyond: FloatProperty(name="Beyond", **limits("behaviour_state", "beyond"), subtype="DISTANCE",
                          description="So far away people are safe")
    distance: FloatProperty(name="Distance", **limits("behaviour_state", "distance"), subtype="DISTANCE",
                            description="So far behind")
    line: PointerProperty(type=bpy.types.Object, name="Line", poll=is_kind("LINE"),
                          description="Where people queue, from the front on")
    spacing: FloatProperty(name="Spacing", **limits("behaviour_state", "spacing"),
                           description="Metres from one to the next")
    pace: FloatProperty(name="Pace", **limits("behaviour_state", "pace"),
                        description="Of the speed that each of them prefers")
    for_good: BoolProperty(name="For Good", description="Who has come to rest stays to the end of the shot")
    then: StringProperty(name="Then", description="The state that comes when this one is done")
    until: CollectionProperty(type=ThrongRule)

    def siblings(self):
        behaviour = _owner_of(self)
        return behaviour.states if behaviour else ()

    def renamed(self, before):
        """What leads to a state speaks of it by name."""
        behaviour = _owner_of(self)
        if behaviour is None:
            return
        if behaviour.start == before:
            behaviour.start = self.name
        for each in behaviour.states:
            for led in (each, *each.until):
                if led.then == before:
                    led.then = self.name


class ThrongBehaviour(Named, bpy.types.PropertyGroup):
    raw: StringProperty(options={"HIDDEN"})
    start: StringProperty(name="Begins With", description="The state that people begin with")
    states: CollectionProperty(type=ThrongState)
    active_state: IntProperty()

    def renamed(self, before):
        """Flows and formations speak of behaviours by name."""
        scene = self.id_data
        people = [thing.throng_layout.formation for thing in scene.objects if thing.throng_layout.kind == "FORMATION"]
        for each in (*scene.throng_layout.flows, *people):
            if each.behaviour == before:
                each.behaviour = self.name


CLASSES = (ThrongCondition, ThrongRule, ThrongState, ThrongBehaviour)
