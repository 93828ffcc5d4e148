# SPDX-License-Identifier: Apache-2.0
"""The shape of somebody's body: age, sex, ancestry, weight, muscle, height, shoulders and a face of one's own."""
import itertools
import json
from dataclasses import dataclass

import numpy

ANCESTRIES = ("african", "asian", "caucasian")
_FOLDERS = {"racegenderage": "macrodetails/", "genderagemuscleweight": "macrodetails/universal-",
            "genderagemuscleweightproportions": "macrodetails/proportions/",
            "genderagemuscleweightheight": "macrodetails/height/",
            "genderagemuscleweightcupsizefirmness": "breast/"}
_OPPOSITES = (("decr", "incr"), ("down", "up"), ("in", "out"), ("backward", "forward"), ("concave", "convex"),
              ("compress", "uncompress"))
_FACE = ("head", "nose", "eyes", "mouth", "chin", "cheek", "forehead", "ears", "eyebrows")
_LEFT_OUT = ("age", "septum", "trans-in", "trans-out", "head-trans", "mouth-trans", "up-down")
_HEADS = ("oval", "round", "square", "rectangular", "diamond", "triangular", "invertedtriangular")
_UNEVEN = ("brown-1", "cheek-1", "eye-1", "jaw-1", "mouth-1", "nose-1")
YOUNGEST, OLDEST = 6.0, 85.0


@dataclass(frozen=True)
class Body:
    """What a body is like. Numbers without a unit go from 0 to 1 and are 0.5 on average."""
    years: float
    male: float                    # 0 a woman, 1 a man
    height: float                  # m, from the ground to the crown, barefoot
    ancestry: tuple = (0.0, 0.0, 1.0)  # shares of ANCESTRIES
    weight: float = 0.5
    muscle: float = 0.5
    proportions: float = 0.65
    shoulders: float = 0.0         # breadth: -1 narrow, 1 broad
    seed: int = 0                  # of the face
    character: float = 0.42        # how far the face is from the average
    smile: float = 0.0
    details: tuple = ()           # more targets: ((name, share), ...)


def age_of(years):
    """On the scale of the macro targets: 1 year is 0, 25 are a half, 90 are 1."""
    return (years - 1.0) / 48.0 if years < 25.0 else 0.5 + (years - 25.0) / 130.0


def macro_targets(rules, values, ancestry):
    """{target: weight}. A factor lies between two names that share it; a target counts by the product of the shares of
    the names in its own name; names that are empty count for nothing."""
    shares = {}
    for factor, rule in rules["macrotargets"].items():
        value = values.get(factor, 0.5)
        for part in rule["parts"]:
            if part["lowest"] < value < part["highest"]:
                along = (value - part["lowest"]) / (part["highest"] - part["lowest"])
                shares[factor] = [(name, share) for name, share in ((part["low"], 1.0 - along), (part["high"], along))
                                  if name and share > 0.01]
    shares["race"] = [(name, share) for name, share in zip(ANCESTRIES, ancestry) if share > 0.0]
    weights = {}
    for combination, factors in rules["combinations"].items():
        for choice in itertools.product(*(shares.get(factor, []) for factor in factors)):
            weight = float(numpy.prod([share for _, share in choice]))
            if weight > 0.004:
                name = _FOLDERS[combination] + "-".join(name for name, _ in choice)
                weights[name] = weights.get(name, 0.0) + weight
    return weights


def _values(body, height):
    return {"age": age_of(body.years), "gender": body.male, "muscle": body.muscle, "weight": body.weight,
            "proportions": body.proportions, "height": height, "cupsize": 0.5, "firmness": 0.6}


def _opposite(name, known):
    """The target that does the contrary, for those that name the lesser one of two."""
    for low, high in _OPPOSITES:
        if name.endswith("-" + low) and name[:-len(low)] + high in known:
            return name[:-len(low)] + high
    return None


def _of_faces(name):
    folder, _, leaf = name.partition("/")
    return folder in _FACE and not leaf.startswith("r-") and not any(part in leaf for part in _LEFT_OUT)


def face_targets(names, body):
    """{target: weight} of a face of one's own: `names` are all targets there are."""
    draw = numpy.random.default_rng(body.seed)
    known, weights = set(names), {}
    for name in sorted(filter(_of_faces, names)):
        other = _opposite(name, known)
        if not other:
            continue
        value = float(numpy.clip(draw.normal(0.0, 0.42), -1.0, 1.0)) * body.character
        if name.startswith("eyes/"):
            value *= 0.5
        one = other if value > 0.0 else name
        weights[one] = weights[one.replace("/l-", "/r-")] = abs(value)
    weights[f"head/head-{draw.choice(_HEADS)}"] = 0.6 * draw.random()
    for part in _UNEVEN:
        weights[f"asym/asym-{part}-{draw.choice(['l', 'r'])}"] = 0.25 * draw.random()
    for side, number in itertools.product("lr", (1, 2, 3)):  # or people stare
        weights[f"eyes/{side}-eye-height{number}-decr"] = 0.30
    if body.smile:
        weights["mouth/mouth-angles-up"] = weights.get("mouth/mouth-angles-up", 0.0) + 0.8 * body.smile
    return weights


def height_of(bodies, shape):
    """From the ground to the crown, m."""
    return shape[bodies.vertices_of("body"), 2].max() - bodies.joint(shape, "ground")[2]


def shape_of(bodies, body):
    """The base mesh in somebody's shape, all groups of it; the soles are on z = 0."""
    rules, names = json.loads(bodies.rules), bodies.target_names()
    middle = bodies.vertices.copy()
    for weights in (macro_targets(rules, _values(body, 0.5), body.ancestry), face_targets(names, body),
                    dict(body.details), waist_targets(body), {_shoulders(body): abs(body.shoulders)}):
        for name, weight in weights.items():
            bodies.move(middle, name, weight)
    shape = _as_tall(bodies, body, rules, middle)
    shape *= body.height / height_of(bodies, shape)  # what is left
    shape[:, 2] -= bodies.joint(shape, "ground")[2]
    return shape


def waist_targets(body):
    """{target: weight} of bellies and hips: the macro targets for weight make athletes that are a little wider."""
    more = body.weight - 0.5
    soft = max(0.0, more) * (1.0 + 0.5 * body.male + 0.01 * max(0.0, body.years - 35.0))
    circumference = 0.18 + 1.7 * more
    return {f"torso/measure-waist-circ-{'incr' if circumference > 0.0 else 'decr'}": min(abs(circumference), 1.2),
            f"torso/measure-hips-circ-{'incr' if more > 0.0 else 'decr'}": abs(more),
            "stomach/stomach-tone-decr": min(1.3 * soft, 1.0), "stomach/stomach-pregnant-incr": min(0.3 * soft, 0.35),
            "neck/neck-double-incr": min(1.2 * soft, 0.8)}


def _shoulders(body):
    return f"torso/measure-shoulder-dist-{'incr' if body.shoulders > 0.0 else 'decr'}"


def _as_tall(bodies, body, rules, middle):
    """With as much of the targets of small or of tall people as the height asks for."""
    taller = height_of(bodies, middle) < body.height
    extreme = middle.copy()
    for name, weight in macro_targets(rules, _values(body, 1.0 if taller else 0.0), body.ancestry).items():
        if "/height/" in name:
            bodies.move(extreme, name, weight)
    low, high = height_of(bodies, middle), height_of(bodies, extreme)
    share = 0.0 if abs(high - low) < 1e-6 else float(numpy.clip((body.height - low) / (high - low), 0.0, 1.0))
    return middle + share * (extreme - middle)
