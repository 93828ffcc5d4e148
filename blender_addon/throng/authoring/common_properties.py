# SPDX-License-Identifier: Apache-2.0
"""Parts of what the artist edits that several things have: distributions, places, and who is meant."""
import bpy
from bpy.props import (BoolProperty, CollectionProperty, EnumProperty, FloatProperty, PointerProperty,
                       StringProperty)

from .codecs import UNSET


def words_items(words, unset=None):
    items = [(word, word.replace("_", " ").capitalize(), "") for word in words]
    return ([(UNSET, unset, "The layout says nothing about it")] if unset else []) + items


def is_place(_group, thing):
    return thing.throng_layout.kind in ("ROAD", "AREA")


def is_kind(kind):
    return lambda _group, thing: thing.throng_layout.kind == kind


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


class ThrongDestination(bpy.types.PropertyGroup):
    mode: EnumProperty(name="To", items=[("PLACE", "Place", "One place"),
                                         ("NEAREST", "Nearest", "Whichever is nearest, jams considered"),
                                         ("CHOOSE", "Choose", "One of these, by weight")])
    place: PointerProperty(type=ThrongPlace)
    places: CollectionProperty(type=ThrongPlace)


class ThrongMember(bpy.types.PropertyGroup):
    target: PointerProperty(type=bpy.types.Object, name="Formation", poll=is_kind("FORMATION"))


CLASSES = (ThrongDistribution, ThrongPlace, ThrongDestination, ThrongMember)
