# SPDX-License-Identifier: Apache-2.0
"""Who is in the cast. Pure Python."""
from dataclasses import dataclass

from . import gait

SKIN, HAIR, TOP, BOTTOM, SHOES, EXTRA, GREY, EYES = range(8)
MATERIALS = ("skin", "hair", "top", "bottom", "shoes", "extra", "grey", "eyes")
STANDARD_HEIGHT = 1.74


@dataclass(frozen=True)
class Person:
    height: float       # m
    girth: float        # 1 = average
    shoulders: float    # m, between the shoulder joints
    hips: float         # 1 = average
    hair: str           # short, long, bun, tail, bald, cap, flat cap, headscarf
    top: str            # shirt, jacket, coat, hoodie, tee, dress
    bottom: str         # trousers, skirt, shorts
    extra: str          # "", bag, backpack, scarf, case, stick
    beard: bool = False
    grey: bool = False  # hair
    stoop: float = 0.0  # rad, that the back bends forward
    head: float = 1.0   # size beside that of an adult as tall


# As many as `throng bake` has variations (kVariations in authoring/scene/people.h).
CAST = (
    Person(1.78, 1.00, 0.37, 1.00, "short", "jacket", "trousers", ""),
    Person(1.66, 0.88, 0.32, 1.06, "long", "coat", "trousers", "bag"),
    Person(1.84, 1.10, 0.40, 0.98, "short", "tee", "trousers", "backpack"),
    Person(1.63, 0.94, 0.32, 1.10, "bun", "shirt", "skirt", ""),
    Person(1.73, 1.22, 0.39, 1.08, "bald", "shirt", "trousers", "", beard=True),
    Person(1.70, 0.90, 0.33, 1.02, "long", "jacket", "trousers", "scarf"),
    Person(1.76, 0.96, 0.37, 0.96, "cap", "hoodie", "shorts", "backpack"),
    Person(1.87, 1.00, 0.39, 0.96, "short", "coat", "trousers", "case", beard=True),
    Person(1.62, 1.02, 0.33, 1.10, "headscarf", "dress", "trousers", "bag"),
    Person(1.58, 1.10, 0.33, 1.16, "bun", "coat", "skirt", "bag", grey=True, stoop=0.06),
    Person(1.69, 1.04, 0.36, 1.02, "flat cap", "jacket", "trousers", "stick", beard=True, grey=True, stoop=0.22),
    Person(1.36, 0.90, 0.325, 0.98, "tail", "tee", "skirt", "backpack", head=1.17),
)


def build_of(person):
    return gait.Build().scaled(person.height / STANDARD_HEIGHT)
