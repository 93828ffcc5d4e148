# SPDX-License-Identifier: Apache-2.0
"""What clothes are made of: colours, prints, seams and buttons, and the relief of weaves, stitches and creases. The
attribute `pattern` tells where a place of the cloth is on somebody who stands and is 1.74 m tall, in metres."""
from dataclasses import dataclass
from functools import cached_property

from . import palettes

_PICKS = {"top": (0, 1.0), "bottom": (1, 1.0), "shirt": (0, 5.0), "shoes": (1, 9.0), "extra": (0, 11.0)}
_ROUGH = {"leather": 0.42, "silk": 0.50, "padded": 0.55, "shell": 0.62, "team": 0.6, "sole": 0.7, "frame": 0.25,
          "pack": 0.75, "phone": 0.12, "paper": 0.6}
_SHEEN = {"knit": 0.5, "wool": 0.4, "fleece": 0.6, "jersey": 0.25, "pique": 0.2}
_HARD = ("frame", "sole", "phone", "paper")
# How deep creases are, beside the deepest.
_CREASED = {"leather": 0.6, "silk": 0.8, "cotton": 1.0, "denim": 0.9, "shell": 0.9, "jersey": 0.75, "pique": 0.6,
            "wool": 0.45, "fleece": 0.5, "knit": 0.35, "padded": 0.8, "team": 0.8, "pack": 0.5}
_STITCH = 0.0075, 0.0062     # m, of knitwear: across, upwards
_BUTTONS = {  # m: from one to the next, from which height to which, half as wide as that
    "cotton": (0.085, 0.70, 1.60, 0.0055), "wool": (0.115, 0.78, 1.24, 0.0095), "pique": (0.060, 1.30, 1.60, 0.0050)}
_PLACKET = 0.0165            # m, half of a front where it is buttoned
_SEAM = 0.0011               # m, half of a seam
_THREAD = (0.34, 0.175, 0.055)


@dataclass
class Cloth:
    """A material that is being made."""
    shade: object
    pattern: object
    slot: str
    fabric: str
    base: object   # its plain colour

    @cached_property
    def place(self):
        """Ahead, to the left, and up."""
        return self.shade.split(self.pattern)

    @cached_property
    def around(self):
        """Across what one looks at, from before as from aside."""
        ahead, left, _ = self.place
        return self.shade.math("MULTIPLY_ADD", ahead, 0.6, left)

    def wave(self, value, often):
        return self.shade.math("SINE", self.shade.math("MULTIPLY", value, often))

    def above(self, value, least):
        return self.shade.math("GREATER_THAN", value, least)

    def both(self, *shares):
        found = shares[0]
        for share in shares[1:]:
            found = self.shade.math("MULTIPLY", found, share)
        return found

    def near(self, value, middle, half):
        """1 where a value is that close to another."""
        away = self.shade.math("ABSOLUTE", self.shade.math("SUBTRACT", value, middle))
        return self.shade.math("LESS_THAN", away, half)

    def times(self, colour, factors):
        return self.shade.mix(colour, factors, 1.0, "MULTIPLY")


def cloth(shade, tint, pattern, kind, look, _bodies):
    slot, fabric = kind.split()
    number, rounds = _PICKS[slot]
    made = Cloth(shade, pattern, slot, fabric, shade.palette(tint[number], rounds, _colours(slot, fabric, look)))
    worn = shade.noise(pattern, 7.0, 3.0)
    colour = shade.mix(made.times(made.base, (0.80, 0.80, 0.82)), made.base, worn)
    if slot == "top":
        colour = _printed(made, colour, tint, palettes.club(look))
    stitch = _stitches(made) if fabric == "knit" else None
    colour = _threads(made, colour, stitch)
    if slot in ("top", "shirt") and fabric in _BUTTONS:
        colour = _buttoned(made, colour)
    if slot == "bottom" and fabric == "denim":
        colour = _sewn(made, colour)
    shade.set(colour, "Base Color")
    shade.set(_ROUGH.get(fabric, 0.85), "Roughness")
    shade.set(0.45 if fabric in ("leather", "frame", "phone") else 0.2, "Specular", "Specular IOR Level")
    shade.set(_SHEEN.get(fabric, 0.15), "Sheen", "Sheen Weight")
    shade.set(_relief(made, stitch), "Normal")


def _colours(slot, fabric, look):
    if slot == "top":
        return {"denim": palettes.DENIMS, "leather": palettes.LEATHERS}.get(fabric) or palettes.tops(look)
    if slot == "bottom":
        return palettes.DENIMS if fabric == "denim" else palettes.BOTTOMS.get(look, palettes.BOTTOM)
    if slot == "shirt":
        return palettes.SHIRTS
    if slot == "shoes":
        return palettes.SOLES if fabric == "sole" else palettes.SHOES[fabric]
    return palettes.extras(look, fabric)


# --- colours

def _printed(made, colour, tint, club):
    """Some have stripes, checks or flowers: those whose tint says so. @param club two colours, or None"""
    shade, up = made.shade, made.place[2]
    picks = shade.math("FRACT", shade.math("MULTIPLY", tint[0], 37.0))
    light = shade.mix(made.base, (0.75, 0.73, 0.68), 0.7)
    if made.fabric == "cotton":
        return _checked(made, colour, picks, light)
    if made.fabric in ("jersey", "knit", "team"):
        bands = made.above(made.wave(up, 60.0 if made.fabric == "team" else 120.0), 0.3)
        other = light
        if made.fabric == "team":
            other = shade.mix(club[0], club[1], shade.math("LESS_THAN", tint[0], 0.75)) if club else \
                made.times(made.base, (0.28, 0.28, 0.30))
        return shade.mix(colour, other, made.both(bands, shade.math("LESS_THAN", picks, 0.30)))
    if made.fabric == "silk":
        flowers = made.above(shade.noise(made.pattern, 42.0, 1.0), 0.60)
        return shade.mix(colour, light, made.both(flowers, shade.math("LESS_THAN", picks, 0.45)))
    return colour


def _checked(made, colour, picks, light):
    """Shirts: tartans, whose bands darken each other and which thin lines cross, and fine stripes."""
    shade, up = made.shade, made.place[2]
    tartan = shade.math("LESS_THAN", picks, 0.42)
    dark = made.times(made.base, (0.24, 0.24, 0.27))
    for along in (made.around, up):
        bands = made.above(made.wave(along, 78.0), 0.25)
        colour = shade.mix(colour, dark, made.both(bands, tartan, 0.5))
    for along in (made.around, up):
        lines = made.above(made.wave(shade.math("ADD", along, 0.02), 78.0), 0.965)
        colour = shade.mix(colour, light, made.both(lines, tartan, 0.75))
    stripes = made.both(made.above(made.wave(made.around, 520.0), 0.4), made.above(picks, 0.82))
    return shade.mix(colour, made.times(made.base, (0.45, 0.48, 0.58)), stripes)


def _threads(made, colour, stitch):
    """Of what threads of several shades, or threads beside gaps, make from near."""
    shade, pattern, base = made.shade, made.pattern, made.base
    if stitch is not None:
        return shade.mix(made.times(colour, (0.52, 0.52, 0.54)), made.times(colour, (1.12, 1.12, 1.10)), stitch)
    if made.fabric == "denim":
        fade = shade.math("MAXIMUM", shade.math("SUBTRACT", shade.noise(pattern, 5.0), 0.45), 0.0)
        twill = shade.noise(pattern, 900.0)
        return shade.mix(colour, made.times(base, (2.3, 2.1, 1.8)),
                         shade.math("ADD", shade.math("MULTIPLY", fade, 1.8), shade.math("MULTIPLY", twill, 0.25)))
    if made.fabric == "wool":
        return shade.mix(colour, made.times(base, (1.7, 1.7, 1.7)),
                         shade.math("MULTIPLY", shade.noise(pattern, 700.0, 3.0), 0.45))
    if made.fabric in ("jersey", "fleece", "cotton", "pique", "shell"):
        return shade.mix(made.times(colour, (0.82, 0.82, 0.83)), made.times(colour, (1.12, 1.12, 1.12)),
                         shade.noise(pattern, 620.0, 2.0))
    return colour


def _buttoned(made, colour):
    """A front that laps over, with a seam at its edge and buttons along its middle."""
    shade, (ahead, left, up) = made.shade, made.place
    every, low, high, half = _BUTTONS[made.fabric]
    front = made.both(made.above(ahead, 0.03), made.above(up, low), shade.math("LESS_THAN", up, high))
    edges = made.near(left, _PLACKET, _SEAM)
    if made.fabric != "wool":
        edges = shade.math("MAXIMUM", edges, made.both(made.near(left, -_PLACKET, _SEAM), 0.4))
    colour = shade.mix(colour, made.times(colour, (0.34, 0.34, 0.36)), made.both(front, edges))
    level = shade.math("SUBTRACT", shade.math("PINGPONG", up, 0.5 * every), 0.25 * every)
    away = shade.math("SQRT", shade.math("ADD", made.both(left, left), made.both(level, level)))
    button = made.both(front, shade.math("LESS_THAN", away, half))
    return shade.mix(colour, shade.mix(made.times(made.base, (0.4, 0.4, 0.4)), (0.30, 0.27, 0.23), 0.5), button)


def _sewn(made, colour):
    """Jeans: a seam along each side of a leg, between two rows of thread, and one down the front."""
    shade, (ahead, left, up) = made.shade, made.place
    fly = made.both(made.above(ahead, 0.02), made.near(left, 0.012, 0.5 * _SEAM), made.above(up, 0.86))
    side = made.near(ahead, -0.012, _SEAM)
    rows = shade.math("SUBTRACT", made.near(ahead, -0.012, 0.0055), made.near(ahead, -0.012, 0.0040))
    colour = shade.mix(colour, made.times(made.base, (0.42, 0.42, 0.45)), side)
    return shade.mix(colour, _THREAD, shade.math("MULTIPLY", shade.math("MAXIMUM", rows, fly), 0.7))


# --- relief

def _stitches(made):
    """Height of knitwear, 0 to 1: columns of stitches that lean to both sides of a column's middle."""
    shade, up, (wide, tall) = made.shade, made.place[2], _STITCH
    across = shade.math("MULTIPLY", 2.0 / wide, shade.math("PINGPONG", made.around, 0.5 * wide))
    row = made.wave(shade.math("MULTIPLY_ADD", across, 0.45 * tall, up), 6.2832 / tall)
    column = shade.math("SUBTRACT", 1.0, shade.math("POWER", across, 3.0))
    return shade.math("MULTIPLY", column, shade.math("MULTIPLY_ADD", row, 0.34, 0.62))


def _relief(made, stitch):
    shade, pattern, fabric, up = made.shade, made.pattern, made.fabric, made.place[2]
    if fabric in _HARD:
        return shade.bump(shade.noise(pattern, 200.0), 0.05, 0.001)
    if fabric == "knit":
        fine = shade.bump(stitch, 0.75, 0.0022)
    elif fabric == "padded":
        fine = shade.bump(shade.math("ABSOLUTE", made.wave(up, 42.0)), 0.9, 0.020)
    elif fabric == "leather":
        fine = shade.bump(shade.noise(pattern, 330.0, 3.0), 0.30, 0.001)
    else:
        fine = shade.bump(shade.noise(pattern, 520.0, 1.0), 0.16, 0.0008)
    amount = _CREASED.get(fabric, 0.5) * (0.6 if made.slot == "bottom" else 1.0)
    return shade.bump(_creases(made, 17.0, 2.5), 0.20 * amount, 0.005,
                      shade.bump(_drawn(made), 0.75 * amount, 0.012, fine))


def _drawn(made):
    """Folds as pull and weight draw them: rows of ridges that rise to the sides, in patches."""
    shade, (ahead, left, up) = made.shade, made.place
    aside = shade.math("ABSOLUTE", left)
    wander = shade.noise(made.pattern, 5.0, 2.0)
    phase = shade.math("MULTIPLY_ADD", wander, 14.0, shade.math("ADD", shade.math("MULTIPLY", up, 62.0), shade.math(
        "MULTIPLY_ADD", aside, 46.0, shade.math("MULTIPLY", ahead, 20.0))))
    ridge = shade.math("POWER", shade.math("MULTIPLY_ADD", shade.math("SINE", phase), 0.5, 0.5), 2.0)
    patch = shade.math("MULTIPLY_ADD", shade.noise(made.pattern, 4.0, 1.0, (1.3, 1.3, 1.0)), 3.2, -1.1)
    return shade.math("MULTIPLY", ridge, shade.math("MINIMUM", shade.math("MAXIMUM", patch, 0.0), 1.0))


def _creases(made, often, sharp):
    """Where a noise goes through its middle: lines that wander."""
    shade = made.shade
    away = shade.math("ABSOLUTE", shade.math("MULTIPLY_ADD", shade.noise(made.pattern, often, 1.0), 2.0, -1.0))
    return shade.math("POWER", shade.math("SUBTRACT", 1.0, away), sharp)
