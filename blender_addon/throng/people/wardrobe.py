# SPDX-License-Identifier: Apache-2.0
"""What there is to wear, and what goes together in each look."""
from dataclasses import replace

from .cloth import TUCKED_FROM, Garment

TROUSERS = Garment("legs", "bottom cotton", off=0.009, loose=0.09, hem=-0.778, width=1.02)
JEANS = replace(TROUSERS, material="bottom denim", width=0.86, loose=0.06, off=0.008, pockets=("back",))
SLIM = replace(JEANS, width=0.66, loose=0.03, off=0.006, hem=-0.745, folds=0.7)
LEGGINGS = replace(TROUSERS, material="bottom jersey", width=0.40, loose=0.0, off=0.004, hem=-0.74, folds=0.3)
SUIT_TROUSERS = replace(TROUSERS, material="bottom wool", width=0.96, folds=0.7)
CARGO = replace(TROUSERS, width=1.15, loose=0.14, off=0.012, pockets=("thigh",))
JOGGERS = replace(TROUSERS, material="bottom fleece", width=0.92, loose=0.14, off=0.012, hem=-0.735, folds=1.3)
SHORTS = replace(TROUSERS, width=1.0, loose=0.24, hem=-0.335)
SPORT_SHORTS = replace(SHORTS, material="bottom jersey", hem=-0.245, loose=0.30)
SKIRT = Garment("skirt", "bottom cotton", off=0.012, hem=-0.36, waist=0.165, flare=0.10, pleats=0.02)
LONG_SKIRT = replace(SKIRT, hem=-0.60, flare=0.16, pleats=0.05)
PENCIL = replace(SKIRT, material="bottom wool", hem=-0.36, flare=0.0, pleats=0.0, off=0.010)
MINI = replace(SKIRT, material="bottom denim", hem=-0.17, flare=0.12, pleats=0.0)

TEE = Garment("top", "top jersey", off=0.010, loose=0.17, sleeve=0.37, hem=0.005, neck=(1.06, 1.04), collar="crew")
TANK = replace(TEE, sleeve=0.035, off=0.007, loose=0.08, neck=(1.20, 1.25), collar="")
POLO = replace(TEE, sleeve=0.39, collar="shirt", neck=(1.0, 1.0), vee=0.515, material="top pique")
SHIRT = Garment("top", "top cotton", off=0.010, loose=0.14, hem=-0.015, collar="shirt", vee=0.525, pockets=("chest",))
SHORT_SHIRT = replace(SHIRT, sleeve=0.42, loose=0.20)
BLOUSE = replace(SHIRT, loose=0.10, hem=0.02, vee=0.480, pockets=(), material="top silk")
TUCKED = replace(SHIRT, material="shirt cotton", hem=0.12, off=0.007, loose=0.10, vee=0.535, pockets=())
UNDER = replace(TEE, material="shirt jersey", hem=0.10, off=0.006, loose=0.05, sleeve=0.30)
JUMPER = Garment("top", "top knit", off=0.015, loose=0.17, hem=0.01, collar="crew")
ROLL = replace(JUMPER, collar="roll", loose=0.13)
HOODIE = Garment("top", "top fleece", off=0.018, loose=0.20, hem=0.0, collar="hood", pockets=("kangaroo",), folds=1.3)
BLAZER = Garment("top", "top wool", off=0.018, loose=0.11, hem=-0.065, collar="coat", vee=0.235, lapels=0.058,
                 pockets=("chest", "hip"), folds=0.7)
LEATHER = Garment("top", "top leather", off=0.018, loose=0.12, hem=0.055, collar="shirt", gap=(0.045, 0.062),
                  folds=0.6)
DENIM = replace(LEATHER, folds=1.0, material="top denim", hem=0.045, pockets=("chest",), loose=0.14)
CARDIGAN = replace(LEATHER, folds=1.0, material="top knit", hem=-0.03, collar="crew", gap=(0.035, 0.050), loose=0.12)
BOMBER = replace(LEATHER, folds=1.0, material="top padded", off=0.024, loose=0.20, hem=0.065, collar="stand",
                 gap=(0.030, 0.040))
TRACK = replace(BOMBER, material="top jersey", off=0.015, gap=(0.008, 0.034))
PUFFER = Garment("top", "top padded", off=0.036, loose=0.26, hem=-0.02, collar="stand", smooth=8, folds=1.6)
PARKA = Garment("top", "top shell", off=0.030, loose=0.20, hem=-0.12, collar="hood", pockets=("hip",), folds=1.3)
COAT = Garment("top", "top wool", off=0.024, loose=0.13, hem=0.122, collar="coat", vee=0.345, lapels=0.065, folds=0.7,
               pockets=("chest",), belt="top wool")
COAT_SKIRT = Garment("skirt", "top wool", off=0.021, hem=-0.34, waist=0.170, flare=0.08, pleats=0.006)
BELTED = replace(COAT, belt="extra leather")
DRESS = Garment("top", "top silk", off=0.008, loose=0.07, sleeve=0.28, hem=0.130, neck=(1.18, 1.25), belt="top silk")
DRESS_SKIRT = Garment("skirt", "top silk", off=0.008, hem=-0.34, waist=0.165, flare=0.18, pleats=0.045)
JERSEY = replace(TEE, material="top team", loose=0.20, vee=0.545)
SNEAKERS = Garment("shoes", "shoes canvas", hem=-0.752)
SHOES = Garment("shoes", "shoes leather", hem=-0.758)
BOOTS = Garment("shoes", "shoes leather", hem=-0.655, smooth=2)

BELT = "extra leather"
_SHORTENED, _THIN = 0.10, 0.010  # height on the base mesh of what is tucked in; m, from the body


def _belted(bottom):
    return replace(bottom, belt=BELT)


# (bottom, tops from the inside out, shoes) of men and boys, and of women and girls
LOOKS = {
    "summer": (
        ((SHORTS, (TEE,), SNEAKERS), (JEANS, (POLO,), SNEAKERS), (SHORTS, (SHORT_SHIRT,), SNEAKERS),
         (_belted(TROUSERS), (POLO,), SHOES), (CARGO, (TEE,), SNEAKERS), (SPORT_SHORTS, (TANK,), SNEAKERS)),
        ((DRESS_SKIRT, (DRESS,), SHOES), (SHORTS, (TANK,), SNEAKERS), (SLIM, (TEE,), SNEAKERS), (SKIRT, (TEE,), SHOES),
         (LONG_SKIRT, (TANK,), SHOES), (MINI, (BLOUSE,), SNEAKERS))),
    "winter": (
        ((JEANS, (PUFFER,), BOOTS), (TROUSERS, (UNDER, COAT_SKIRT, COAT), SHOES), (CARGO, (PARKA,), BOOTS),
         (JEANS, (JUMPER,), BOOTS), (SUIT_TROUSERS, (UNDER, COAT_SKIRT, COAT), SHOES), (JEANS, (HOODIE,), SNEAKERS)),
        ((SLIM, (PUFFER,), BOOTS), (LEGGINGS, (UNDER, COAT_SKIRT, BELTED), BOOTS), (SLIM, (PARKA,), BOOTS),
         (SKIRT, (ROLL,), BOOTS), (JEANS, (UNDER, COAT_SKIRT, COAT), BOOTS), (SLIM, (ROLL,), BOOTS))),
    "business": (
        ((_belted(SUIT_TROUSERS), (TUCKED, BLAZER), SHOES), (_belted(SUIT_TROUSERS), (TUCKED,), SHOES),
         (SUIT_TROUSERS, (UNDER, COAT_SKIRT, COAT), SHOES), (_belted(TROUSERS), (TUCKED, BLAZER), SHOES),
         (_belted(SUIT_TROUSERS), (TUCKED, BLAZER), SHOES), (_belted(TROUSERS), (SHIRT,), SHOES)),
        ((PENCIL, (BLOUSE,), SHOES), (SUIT_TROUSERS, (TUCKED, BLAZER), SHOES), (PENCIL, (UNDER, BLAZER), SHOES),
         (DRESS_SKIRT, (DRESS,), SHOES), (SLIM, (BLOUSE,), SHOES),
         (SUIT_TROUSERS, (UNDER, COAT_SKIRT, BELTED), SHOES))),
    "sport": (
        ((SPORT_SHORTS, (TEE,), SNEAKERS), (JOGGERS, (UNDER, TRACK), SNEAKERS), (JOGGERS, (HOODIE,), SNEAKERS),
         (SPORT_SHORTS, (TANK,), SNEAKERS), (JOGGERS, (TEE,), SNEAKERS), (SPORT_SHORTS, (HOODIE,), SNEAKERS)),
        ((LEGGINGS, (TANK,), SNEAKERS), (LEGGINGS, (HOODIE,), SNEAKERS), (JOGGERS, (TEE,), SNEAKERS),
         (LEGGINGS, (TEE,), SNEAKERS), (SPORT_SHORTS, (TANK,), SNEAKERS), (JOGGERS, (UNDER, TRACK), SNEAKERS))),
    "fans": (
        ((JEANS, (JERSEY,), SNEAKERS), (SHORTS, (JERSEY,), SNEAKERS), (JEANS, (HOODIE,), SNEAKERS),
         (CARGO, (JERSEY,), SNEAKERS), (JEANS, (UNDER, TRACK), SNEAKERS), (TROUSERS, (JERSEY,), SNEAKERS)),
        ((SLIM, (JERSEY,), SNEAKERS), (SHORTS, (JERSEY,), SNEAKERS), (JEANS, (HOODIE,), SNEAKERS),
         (LEGGINGS, (JERSEY,), SNEAKERS), (SLIM, (UNDER, TRACK), SNEAKERS), (JEANS, (JERSEY,), SNEAKERS))),
    "casual": (
        ((JEANS, (UNDER, LEATHER), BOOTS), (TROUSERS, (SHIRT,), SHOES), (JEANS, (HOODIE,), SNEAKERS),
         (JEANS, (UNDER, DENIM), SNEAKERS), (TROUSERS, (JUMPER,), SHOES), (CARGO, (UNDER, BOMBER), SNEAKERS),
         (_belted(JEANS), (TEE,), SNEAKERS), (TROUSERS, (TUCKED, CARDIGAN), SHOES)),
        ((SLIM, (JUMPER,), SNEAKERS), (SKIRT, (BLOUSE,), SHOES), (JEANS, (UNDER, LEATHER), BOOTS),
         (DRESS_SKIRT, (DRESS,), SHOES), (SLIM, (UNDER, CARDIGAN), SHOES),
         (LEGGINGS, (UNDER, COAT_SKIRT, BELTED), BOOTS),
         (JEANS, (TEE,), SNEAKERS), (LONG_SKIRT, (ROLL,), BOOTS))),
}


def _tucked_in(top, bottom):
    """The top as it is worn with that, if below it: shirts with a short hem, and thin tops in skirts; or None."""
    if top.kind != "top" or top.material == bottom.material:
        return None
    if bottom.kind == "skirt" and top.off <= _THIN:
        return replace(top, hem=max(top.hem, _SHORTENED))
    return top if top.hem > TUCKED_FROM and top.material.startswith("shirt") else None


def order(bottom, tops, shoes):
    """From the inside out. What is tucked in goes below trousers and skirts, what hangs over them goes above."""
    worn = [(top, _tucked_in(top, bottom)) for top in tops]
    inside, outside = [tucked for _, tucked in worn if tucked], [top for top, tucked in worn if not tucked]
    if bottom.kind == "legs" and bottom.hem < -0.7:  # over the shoes, but boots over trousers
        legs = [bottom, shoes] if shoes.hem > -0.7 else [shoes, bottom]
    else:
        legs = [shoes, bottom]
    return (*inside, *legs, *outside)
