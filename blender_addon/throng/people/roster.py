# SPDX-License-Identifier: Apache-2.0
"""Who there is: people drawn at random, each the same whenever their look and number are."""
from dataclasses import dataclass, replace

import numpy

from ..cast.gait import Manner
from . import holding, wardrobe
from .shape import Body

LOOKS = tuple(wardrobe.LOOKS)
# By a layout's profile: the youngest and the oldest, years.
AGES = {"child": (6.0, 13.5), "adult": (19.0, 64.0), "elderly": (67.0, 84.0), "runner": (18.0, 54.0)}
OLD = 65.0   # years: from here on people stoop
_STEP = 0.618034  # of a turn, from one number to the next: ages of neighbours are far apart
# In any stretch of the cast there are young and old, women and men.
_YEARS = (34, 27, 52, 41, 22, 33, 67, 29, 38, 9, 73, 46, 25, 58, 31, 36, 19, 44, 12, 62, 28, 48, 35, 24)
_MALE = (1, 0, 1, 0, 1, 0, 1, 1, 0, 0, 0, 1, 0, 1, 1, 0, 1, 0, 1, 0, 0, 1, 1, 0)
_CHILDREN = ((6, 8, 10, 12, 14, 16, 18), (1.16, 1.28, 1.385, 1.495, 1.60, 1.67, 1.70))  # years, m
_SKINS = {"caucasian": ("pale", "fair", "fair", "olive"), "asian": ("east", "east", "tan"),
          "african": ("brown", "dark", "brown")}
# what the right hands of how many hold
_HELD = {"": ((holding.PHONE, 0.09), (holding.CALL, 0.06), (holding.CARRIER, 0.09)),
         "business": ((holding.PHONE, 0.09), (holding.CALL, 0.10), (holding.CASE, 0.28)),
         "fans": ((holding.PHONE, 0.06), (holding.CALL, 0.03)), "sport": ()}
_MEN_HAIR = ("short", "side", "crop", "quiff", "short", "curtains", "curls", "side")
_WOMEN_HAIR = ("long", "bob", "tail", "waves", "knot", "fringed bob", "long", "waves")


@dataclass(frozen=True)
class Role:
    """Whom a member of a cast is drawn as."""
    number: int
    look: str = "casual"  # of fans perhaps with their two colours: "fans #a01020 #ffffff"
    profile: str = ""     # as layouts name it; "" whoever has the number

    @classmethod
    def of(cls, text):
        number, profile, look = text.split(" ", 2)
        return cls(int(number), look, profile.strip("-"))

    def __str__(self):
        return f"{self.number} {self.profile or '-'} {self.look}"

    def person(self):
        look = "sport" if self.profile == "runner" and self.look == "casual" else self.look
        return draw_person(look, self.number, _years(self.profile, self.number), runs=self.profile == "runner")


def _years(profile, number):
    if profile not in AGES:
        return None
    youngest, oldest = AGES[profile]
    return youngest + (oldest - youngest) * ((number + 0.5) * _STEP % 1.0)


@dataclass(frozen=True)
class Person:
    body: Body
    look: str
    garments: tuple     # from the inside out
    skin: str           # tone
    hair: str           # style, "" for none
    hair_colour: str
    beard: str = ""     # full, chin, stubble
    glasses: str = ""   # round, square
    bag: str = ""       # rucksack, satchel, shopper
    hat: str = ""       # beanie, cap, headscarf
    stoop: float = 0.0  # rad, that the back bends forward
    stick: bool = False  # walks with one
    holds: str = ""     # one of holding.THINGS
    limp: float = 0.0   # how much the left leg is spared, 0 to 1
    manner: Manner = Manner()

    @property
    def child(self):
        return self.body.years < 15


def draw_person(look, number, years=None, male=None, height=None, shoulders=None, runs=False):
    """The person of a number in a look. What is given is taken; the rest is drawn."""
    word = look.split(" ", 1)[0]
    if word not in wardrobe.LOOKS:
        raise ValueError(f"there is no look {look!r}: expected one of {', '.join(LOOKS)}")
    draw = numpy.random.default_rng([LOOKS.index(word), number])
    years = float(_YEARS[number % len(_YEARS)] + draw.integers(-2, 3) if years is None else years)
    years = float(numpy.clip(years, 6.0, 85.0))
    male = float(_MALE[number % len(_MALE)]) if male is None else float(male)
    ancestry, race = _ancestry(draw)
    body = Body(years, male, height or _height(draw, years, male), ancestry,
                weight=float(numpy.clip(draw.normal(0.50 + 0.08 * (years > 45), 0.13), 0.25, 0.92)),
                muscle=float(numpy.clip(draw.normal(0.52 - 0.12 * (years > 60), 0.12), 0.2, 0.85)),
                proportions=float(draw.uniform(0.40, 0.72)),
                shoulders=float(draw.normal(0.0, 0.3)) if shoulders is None else shoulders,
                seed=int(draw.integers(1 << 30)), smile=float(draw.random() * 0.6))
    outfits = wardrobe.LOOKS[word][0 if male > 0.5 else 1]
    bottom, tops, shoes = outfits[int(number // 2 + draw.integers(2)) % len(outfits)]
    hair, colour = _hair(draw, years, male, race)
    hat = _hat(draw, word, years, male)
    if hat:
        hair = "crop" if male > 0.5 or hat == "headscarf" else hair if hair in ("long", "waves", "bob", "tail") else ""
    if hat == "headscarf":
        hair = ""
    found = Person(body, look, wardrobe.order(bottom, tops, shoes),
                   str(draw.choice(_SKINS[race])), hair, colour, _beard(draw, years, male),
                   "" if draw.random() > (0.2 if years < 55 else 0.5) else str(draw.choice(["round", "square"])),
                   "" if runs else _bag(draw, word, years, male), hat, *_frailty(number, years))
    return _with_hands_full(replace(found, manner=_manner(body, number)), word, number, runs)


def _manner(body, number):
    """How somebody moves: children freely, the old with less of everything."""
    draw = numpy.random.default_rng([83, number])
    near = lambda mean, spread: float(numpy.clip(draw.normal(mean, spread), mean - 2.0 * spread, mean + 2.0 * spread))
    age = numpy.interp(body.years, (6.0, 14.0, 45.0, 85.0), (1.15, 1.0, 1.0, 0.72))
    arms, apart = age * near(1.0, 0.24), near(0.0, 0.09)
    return Manner(swing=(arms * (1.0 - apart), arms * (1.0 + apart)), elbow=near(0.07, 0.07),
                  yaw=near(1.0 + 0.15 * (body.male < 0.5), 0.18), sway=near(1.0, 0.22), lean=near(0.0, 0.018),
                  nod=near(0.02, 0.045), toes=near(0.09, 0.035), rests_on=float(draw.choice([-1.0, 1.0])))


def _with_hands_full(who, look, number, runs):
    """The same with what the right hand holds, if anything, and a limp, if they have one."""
    if runs or who.stick:
        return who
    draw = numpy.random.default_rng([89, LOOKS.index(look), number])
    old = who.body.years >= OLD
    limp = float(draw.uniform(0.5, 1.0)) if draw.random() < (0.12 if old else 0.025) else 0.0
    often = dict(_HELD.get(look, _HELD[""])) if who.body.years >= 13.0 else {}
    if old:
        often = {thing: share if thing in holding.BAGS else 0.3 * share for thing, share in often.items()}
    if who.bag in ("satchel", "shopper"):  # which hang where the right hand is
        often = {thing: share for thing, share in often.items() if thing not in holding.BAGS}
    shares = (*often.values(), 1.0 - sum(often.values()))
    return replace(who, holds=str(draw.choice([*often, ""], p=shares)), limp=limp)


def _frailty(number, years):
    """How far somebody stoops, and whether with a stick."""
    if years < OLD:
        return 0.0, False
    draw = numpy.random.default_rng([97, number])
    stoop = float(numpy.clip(draw.normal(0.06 + 0.009 * (years - OLD), 0.05), 0.03, 0.30))
    return stoop, bool(draw.random() < 0.25 + 0.02 * (years - OLD))


def _ancestry(draw):
    names = ("african", "asian", "caucasian")
    first = int(draw.choice(3, p=(0.24, 0.26, 0.50)))
    shares = [0.0, 0.0, 0.0]
    shares[first] = 1.0
    if draw.random() < 0.25:
        other = (first + int(draw.integers(1, 3))) % 3
        shares[first], shares[other] = 0.7, 0.3
    return tuple(shares), names[first]


def _height(draw, years, male):
    if years < 18:
        return float(numpy.interp(years, *_CHILDREN) + draw.normal(0.0, 0.035))
    mean, spread = (1.775, 0.065) if male > 0.5 else (1.645, 0.060)
    return float(numpy.clip(draw.normal(mean - 0.001 * max(0.0, years - 50.0), spread), mean - 0.15, mean + 0.16))


def _hair(draw, years, male, race):
    colours = {"african": ("black", "black", "dark"), "asian": ("black", "black", "dark"),
               "caucasian": ("dark", "brown", "brown", "blond", "red")}[race]
    colour = str(draw.choice(colours))
    if years > 48 and draw.random() < min(0.9, (years - 42.0) / 30.0):
        colour = "grey"
    if male > 0.5:
        if race == "african":
            return str(draw.choice(["crop", "crop", "curls", "afro"])), colour
        if years > 45 and draw.random() < 0.4:
            return str(draw.choice(["ring", "ring", ""])), colour
        return str(draw.choice(_MEN_HAIR)), colour
    if race == "african":
        return str(draw.choice(["afro", "curls", "knot", "tail", "waves"])), colour
    if years > 60:
        return str(draw.choice(["bob", "fringed bob", "knot", "curls"])), colour
    return str(draw.choice(_WOMEN_HAIR)), colour


def _hat(draw, look, years, male):
    chance = {"winter": 0.35, "fans": 0.30, "sport": 0.2, "summer": 0.2, "casual": 0.10}.get(look, 0.0)
    if draw.random() < chance:
        return "beanie" if look == "winter" else "cap"
    if male < 0.5 and years > 16 and look != "sport" and draw.random() < 0.07:
        return "headscarf"
    return ""


def _beard(draw, years, male):
    if male < 0.5 or years < 19:
        return ""
    return str(draw.choice(["", "", "stubble", "stubble", "full", "chin"]))


def _bag(draw, look, years, male):
    if draw.random() > (0.45 if look != "sport" else 0.15):
        return ""
    if years < 20 or look in ("sport", "summer"):
        return "rucksack"
    return str(draw.choice(["rucksack", "satchel"] if male > 0.5 else ["satchel", "shopper", "rucksack"]))
