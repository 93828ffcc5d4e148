# SPDX-License-Identifier: Apache-2.0
"""Who people are, as the artist edits it."""
import bpy
from bpy.props import EnumProperty, FloatProperty, FloatVectorProperty, PointerProperty

from .codecs import BODIES, GROUPS, LOOKS, MIX, PROFILES, UNSET, Body
from .common_properties import ThrongDistribution, words_items
from .fields import limits


class ThrongPeople(bpy.types.PropertyGroup):
    speed: PointerProperty(type=ThrongDistribution, name="Speed", description="Preferred walking speed, m/s")
    radius: PointerProperty(type=ThrongDistribution, name="Radius",
                            description="Of people who are discs, in place of a body, m")
    body: EnumProperty(name="Body", default=Body("body").default,
                       items=words_items(BODIES) + [(UNSET, "Own", "As broad and as deep as the layout says")],
                       description="How broad and deep people are; discs are as wide as shoulders, or have a radius")
    reaction: PointerProperty(type=ThrongDistribution, name="Reaction",
                              description="How long people take to set off when an event sends them away, s")
    maximum_speed_factor: FloatProperty(name="Hurry", **limits("people", "maximum_speed_factor"),
                                        description="Highest speed as a multiple of the preferred one")
    headway: FloatProperty(name="Headway", **limits("people", "headway"),
                           description="Free way kept to those walked behind, s")
    profile: EnumProperty(name="Profile", items=words_items(PROFILES, "Default") + [(MIX, "Mix", "Several, by weight")])
    profile_weights: FloatVectorProperty(name="Weights", size=4, default=(1.0, 0.0, 0.0, 0.0), soft_min=0.0,
                                         description="Adults, children, elderly, runners")
    groups: EnumProperty(name="Groups", items=words_items(GROUPS, "Default")
                                        + [(MIX, "Weights", "Of those who walk alone, in twos, threes and fours")])
    group_weights: FloatVectorProperty(name="Weights", size=4, default=(1.0, 0.0, 0.0, 0.0), soft_min=0.0,
                                       description="Alone, twos, threes, fours")
    look: EnumProperty(name="Look", items=words_items(LOOKS), description="What they wear")


CLASSES = (ThrongPeople,)
