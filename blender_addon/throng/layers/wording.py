# SPDX-License-Identifier: Apache-2.0
"""Layers in the file's form: made of what a dialogue says, and told in a line. Pure Python."""
import json

SELECTORS = (("everybody", "Everybody", "All people of the crowd"),
             ("people", "Picked People", "Whoever is picked; found again in another take"),
             ("rows", "Rows", "From one row to another, in this bake"),
             ("group", "Flow or Formation", "By its id"),
             ("profile", "Profile", "By the profile of agents.csv"),
             ("look", "Look", "By the look of agents.csv"),
             ("party", "Company", "Who walks with so many, themselves among them"),
             ("region", "Region", "Who is over the mesh or within the curve that is selected"),
             ("seen", "In the Picture", "Whoever the scene's camera sees"),
             ("near", "Near the 3D Cursor", "Who comes so near"),
             ("copies", "Copies", "Those whom another layer has made"))
OPERATIONS = (("hide", "Hide", "They are not there"), ("move", "Move and Turn", "Whole ways are moved"),
              ("tint", "Tint", "The colour of the top garment"), ("character", "Swap Character", "Another variation"),
              ("scale", "Scale", "The whole figure"), ("retime", "Retime", "Later, earlier, slower, faster"),
              ("clip", "Clip", "What they do"), ("look_at", "Look at the 3D Cursor", "Heads turn there"),
              ("duplicate", "Duplicate", "Copies of each"),
              ("bend", "Bend", "Ways are bent: in this frame they are so far beside"),
              ("hero", "Promote to Hero", "Out of the crowd, to be animated by hand"))
ACTIVITIES = tuple((word, word.capitalize(), "") for word in ("walks", "stands", "looks", "queues"))


def with_share(who, share, seed):
    """So many of those whom a selector means."""
    return who if share >= 1.0 else {**who, "share": {"of": round(share, 6), "seed": seed}}


def _brief(value):
    if isinstance(value, str):
        return value
    if isinstance(value, list) and all(isinstance(each, str) for each in value):
        return ", ".join(value)
    text = json.dumps(value, ensure_ascii=False)
    return text if len(text) <= 24 else text[:21] + "..."


def selector_text(who):
    """Whom a selector means, in a few words."""
    words = []
    for key, value in who.items():
        if key in ("and", "or"):
            words.append("(" + f" {key} ".join(selector_text(each) for each in value) + ")")
        elif key in ("not", "with"):
            words.append(f"{key} {selector_text(value)}")
        elif key == "share":
            words.append(f"{100.0 * value['of']:g} %")
        elif key == "people":
            words.append(f"{len(value)} people")
        elif value is True or key in ("region", "seen", "near"):
            words.append(key)
        else:
            words.append(f"{key} {_brief(value)}")
    return ", ".join(words)


def operation_text(do):
    """What a layer does, in a few words."""
    return ", ".join(do)


def parsed(text, what):
    """An object in JSON, as somebody has typed it; raises ValueError with a sentence."""
    try:
        value = json.loads(text)
    except ValueError as error:
        raise ValueError(f"{what} is not JSON: {error}") from None
    if not isinstance(value, dict):
        raise ValueError(f"{what} has to be an object, such as {{\"hide\": true}}")
    return value
