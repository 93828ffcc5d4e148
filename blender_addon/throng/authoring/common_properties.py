# SPDX-License-Identifier: Apache-2.0
"""Parts of what the artist edits that several things have: names, distributions, places, and who is meant."""
import bpy
from bpy.props import (BoolProperty, CollectionProperty, EnumProperty, FloatProperty, PointerProperty,
                       StringProperty)

from . import display
from .codecs import UNSET


def words_items(words, unset=None):
    items = [(word, word.replace("_", " ").capitalize(), "") for word in words]
    return ([(UNSET, unset, "The layout says nothing about it")] if unset else []) + items


def is_place(_group, thing):
    return thing.throng_layout.kind in ("ROAD", "AREA")


def is_kind(kind):
    return lambda _group, thing: thing.throng_layout.kind == kind


def _named(thing, _context):
    others = thing.siblings()
    if others is not None and thing.known:
        taken = {each.name for each in others if each != thing}
        if not thing.name or thing.name in taken:
            thing.name = _free(thing.name, taken) if thing.name else thing.known
            return
    if thing.known and thing.known != thing.name:
        thing.renamed(thing.known)
    thing.known = thing.name


def _free(name, taken):
    return next(each for each in (f"{name}.{number:03d}" for number in range(1, 1000)) if each not in taken)


class Named:
    """What others speak of by name: when it gets another one, they follow. `known` is what it was called before."""

    name: StringProperty(name="Name", update=_named)
    known: StringProperty(options={"HIDDEN"})

    def siblings(self):
        """Those of whose names each is another one, and none is empty; None: any name will do, and `throng check` says
        what is wrong with it."""
        return None

    def renamed(self, before):
        raise NotImplementedError


_OF_PEOPLE = {"FORMATION": "formation", "SEATS": "seats"}


def groups_in(scene):
    """[(name, what it is)] of everybody whom a layout can speak of together."""
    layout = scene.throng_layout
    return [*((flow.name, "flow") for flow in layout.flows), *((given.name, "given people") for given in layout.given),
            *((thing.name, _OF_PEOPLE[thing.throng_layout.kind]) for thing in scene.objects
              if thing.throng_layout.kind in _OF_PEOPLE)]


def offered(names, text):
    """What a field offers for what has been typed: names that have it in them, those that begin with it first."""
    typed = text.lower()
    found = {name: what for name, what in names if name and typed in name.lower()}
    return sorted(found.items(), key=lambda each: (not each[0].lower().startswith(typed), each[0]))


def _groups(member, _context, text):
    return offered(groups_in(member.id_data), text)


def _are_people(_group, thing):
    return thing.throng_layout.kind in _OF_PEOPLE


_ENDS = [("start", "Start", "Where the road's curve begins"), ("end", "End", "Where it ends")]


class ThrongDistribution(bpy.types.PropertyGroup):
    kind: EnumProperty(name="Kind",
                       items=[(UNSET, "Default", "As Throng has it"), ("NUMBER", "Number", "The same for all"),
                              ("uniform", "Uniform", "From a to b"), ("normal", "Normal", "Mean a, deviation b"),
                              ("log_normal", "Log-normal", "Mean a and deviation b of the logarithm")])
    a: FloatProperty(name="A")
    b: FloatProperty(name="B")
    use_least: BoolProperty(name="At Least")
    least: FloatProperty(name="At Least")
    use_most: BoolProperty(name="At Most")
    most: FloatProperty(name="At Most")


class ThrongPlace(bpy.types.PropertyGroup):
    target: PointerProperty(type=bpy.types.Object, name="Place", poll=is_place, description="A road or an area")
    end: EnumProperty(name="End", items=_ENDS, description="Which end of the road")
    text: StringProperty(name="By Name", description="A place that is no object of this scene")
    weight: FloatProperty(name="Weight", default=1.0, soft_min=0.0)


_MODES = [("PLACE", "Place", "One place"), ("NEAREST", "Nearest", "Whichever is nearest, jams considered"),
          ("CHOOSE", "Choose", "One of these, by weight")]


class ThrongDestination(bpy.types.PropertyGroup):
    mode: EnumProperty(name="To", items=_MODES)
    place: PointerProperty(type=ThrongPlace)
    places: CollectionProperty(type=ThrongPlace)


class ThrongBlock(bpy.types.PropertyGroup):
    """A block of seats; by its name one that is no object of this scene."""

    target: PointerProperty(type=bpy.types.Object, name="Seats", poll=is_kind("SEATS"))


class ThrongGoal(bpy.types.PropertyGroup):
    """Where people go in the end: a destination, or a seat."""

    mode: EnumProperty(name="To", items=[*_MODES, ("SEATS", "Seats", "A free seat of their own in these blocks")])
    place: PointerProperty(type=ThrongPlace)
    places: CollectionProperty(type=ThrongPlace)
    seats: CollectionProperty(type=ThrongBlock)


def _chosen(member, _context):
    """Formations and seats are objects, which may be given other names."""
    found = bpy.data.objects.get(member.name) if member.target is None and not display.is_quiet() else None
    if found is None or not _are_people(member, found) or found.name not in member.id_data.objects:
        return
    layout = member.id_data.throng_layout
    if not any(each.name == member.name for each in (*layout.flows, *layout.given)):
        member.target, member.name = found, ""


class ThrongMember(bpy.types.PropertyGroup):
    """People of the layout: an object, or the name of a flow or of given people."""

    name: StringProperty(name="People", search=_groups, update=_chosen,
                         description="A flow, given people, a formation or a block of seats")
    target: PointerProperty(type=bpy.types.Object, name="People", poll=_are_people,
                            description="A formation or a block of seats")


CLASSES = (ThrongDistribution, ThrongPlace, ThrongDestination, ThrongBlock, ThrongGoal, ThrongMember)
