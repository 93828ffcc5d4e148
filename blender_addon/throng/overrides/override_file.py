# SPDX-License-Identifier: Apache-2.0
"""Files of overrides (`NAME.overrides.json` beside the bake `NAME`): reading, checking, writing. Pure Python, as
`throng apply` reads them."""
import json
import math
import os
import re
from dataclasses import dataclass

from ..formats import BakeError
from ..formats.whole_files import write_whole

VERSION = 1
_COLOUR = re.compile(r"#[0-9a-fA-F]{6}")
_PLACE = (-1e8, 1e8)
_ROW = (0, 4294967294)


class OverrideError(BakeError):
    """A file of overrides cannot be used; the message says where and why."""


@dataclass(frozen=True)
class Change:
    """What is changed about one person, as authoring/overrides/overrides.h has it. Degrees, metres, frames."""
    hide: bool = False
    character: int = None
    tint: object = None      # three numbers, or "#rrggbb"
    scale: float = None
    move: tuple = (0.0, 0.0, 0.0)
    turn: float = 0.0
    delay: float = 0.0
    speed: float = 1.0
    hero: str = ""

    @property
    def hides(self):
        return self.hide or bool(self.hero)

    @property
    def moves(self):
        return tuple(self.move) != (0.0, 0.0, 0.0) or self.turn != 0.0

    @property
    def retimes(self):
        return self.delay != 0.0 or self.speed != 1.0

    def words(self):
        """What is changed, in words."""
        given = (("hide", self.hide), ("character", self.character is not None), ("tint", self.tint is not None),
                 ("scale", self.scale is not None), ("move", self.moves), ("retime", self.retimes), ("hero", self.hero))
        return [word for word, there in given if there]


def change_of(entry):
    move, retime = entry.get("move", {}), entry.get("retime", {})
    tint, character = entry.get("tint"), entry.get("character")
    return Change(hide=entry.get("hide", False), character=None if character is None else int(character),
                  tint=tuple(tint) if isinstance(tint, (list, tuple)) else tint, scale=entry.get("scale"),
                  move=tuple(float(v) for v in move.get("by", (0.0, 0.0, 0.0))), turn=float(move.get("turn", 0.0)),
                  delay=float(retime.get("offset", 0.0)), speed=float(retime.get("speed", 1.0)),
                  hero=entry.get("hero", ""))


def path_beside(folder):
    """Where a bake's overrides are: beside it, as a bake made again replaces its folder."""
    return os.path.abspath(folder).rstrip(os.sep) + ".overrides.json"


class _Checker:
    """Walks through the values of one file; the first mistake ends it."""

    def __init__(self, path):
        self.path = path

    def fail(self, pointer, message):
        raise OverrideError(f"{self.path}: {pointer or 'the file'}: {message}")

    def members(self, value, pointer, required, optional=()):
        if not isinstance(value, dict):
            self.fail(pointer, f"expected an object, found {value!r}")
        for key in required:
            if key not in value:
                self.fail(pointer, f"needs `{key}`")
        for key in value:
            if key not in required and key not in optional:
                self.fail(f"{pointer}/{key}", "is not a key of overrides: one of " + ", ".join((*required, *optional)))
        return value

    def number(self, value, pointer, least, most):
        is_number = isinstance(value, (int, float)) and not isinstance(value, bool) and math.isfinite(value)
        if not is_number or not least <= value <= most:
            self.fail(pointer, f"expected a number from {least:g} to {most:g}, found {value!r}")

    def whole(self, value, pointer, least, most):
        self.number(value, pointer, least, most)
        if value != int(value):
            self.fail(pointer, f"expected a whole number, found {value!r}")

    def three(self, value, pointer, least, most):
        if not isinstance(value, (list, tuple)) or len(value) != 3:
            self.fail(pointer, f"expected three numbers, found {value!r}")
        for index, each in enumerate(value):
            self.number(each, f"{pointer}/{index}", least, most)

    def text(self, value, pointer, empty=False):
        if not isinstance(value, str) or not (value or empty):
            self.fail(pointer, f"expected a text, found {value!r}")

    def entry(self, entry, at):
        self.members(entry, at, ("id", "group", "spawn"),
                     ("hide", "character", "tint", "scale", "move", "retime", "hero", "note"))
        self.whole(entry["id"], f"{at}/id", *_ROW)
        self.text(entry["group"], f"{at}/group")
        spawn = self.members(entry["spawn"], f"{at}/spawn", ("frame", "position"))
        self.whole(spawn["frame"], f"{at}/spawn/frame", *_ROW)
        self.three(spawn["position"], f"{at}/spawn/position", *_PLACE)
        if not isinstance(entry.get("hide", False), bool):
            self.fail(f"{at}/hide", "expected true or false")
        if "character" in entry:
            self.whole(entry["character"], f"{at}/character", 0, 65535)
        if "scale" in entry:
            self.number(entry["scale"], f"{at}/scale", 0.1, 10.0)
        tint = entry.get("tint", "#000000")
        if not isinstance(tint, str):
            self.three(tint, f"{at}/tint", 0.0, 1.0)
        elif not _COLOUR.fullmatch(tint):
            self.fail(f"{at}/tint", f'expected a colour such as "#a01020" or three numbers from 0 to 1, found {tint!r}')
        move = self.members(entry.get("move", {}), f"{at}/move", (), ("by", "turn"))
        self.three(move.get("by", (0, 0, 0)), f"{at}/move/by", *_PLACE)
        self.number(move.get("turn", 0), f"{at}/move/turn", -360.0, 360.0)
        retime = self.members(entry.get("retime", {}), f"{at}/retime", (), ("offset", "speed"))
        self.number(retime.get("offset", 0), f"{at}/retime/offset", -1e6, 1e6)
        self.number(retime.get("speed", 1), f"{at}/retime/speed", 0.05, 20.0)
        if "hero" in entry:
            self.text(entry["hero"], f"{at}/hero")
        if "note" in entry:
            self.text(entry["note"], f"{at}/note", empty=True)


def person_of(entry):
    """Whom an entry was made for. Entries of different takes may be of people with the same id."""
    return entry["id"], entry["group"], entry["spawn"]["frame"]


def check_layers(layers, path):
    """What all layers have. What selects and what is done is for `throng apply` to judge, which knows how."""
    checker, seen = _Checker(path), {}
    if not isinstance(layers, list):
        checker.fail("/layers", f"expected a list, found {layers!r}")
    for index, layer in enumerate(layers):
        at = f"/layers/{index}"
        checker.members(layer, at, ("name", "who", "do"), ("enabled", "note"))
        checker.text(layer["name"], f"{at}/name")
        if not isinstance(layer.get("enabled", True), bool):
            checker.fail(f"{at}/enabled", "expected true or false")
        for key in ("who", "do"):
            if not isinstance(layer[key], dict):
                checker.fail(f"{at}/{key}", f"expected an object, found {layer[key]!r}")
        first = seen.setdefault(layer["name"], index)
        if first != index:
            checker.fail(f"{at}/name", f"there is a layer `{layer['name']}` already, /layers/{first}")
    return layers


def check(document, path):
    """The entries of a document; raises OverrideError."""
    checker = _Checker(path)
    checker.members(document, "", ("throng_overrides", "overrides"), ("$schema", "layers"))
    if document["throng_overrides"] != VERSION:
        checker.fail("/throng_overrides",
                     f"this add-on reads version {VERSION}, found {document['throng_overrides']!r}")
    entries = document["overrides"]
    if not isinstance(entries, list):
        checker.fail("/overrides", f"expected a list, found {entries!r}")
    seen = {}
    for index, entry in enumerate(entries):
        checker.entry(entry, f"/overrides/{index}")
        entry["id"], entry["spawn"]["frame"] = int(entry["id"]), int(entry["spawn"]["frame"])  # JSON knows 3.0, too
        first = seen.setdefault(person_of(entry), index)
        if first != index:
            checker.fail(f"/overrides/{index}/id",
                         f"person {entry['id']} has an override already, /overrides/{first}: put both into one")
    return entries


def _document(path):
    try:
        with open(path, encoding="utf-8") as file:
            return json.load(file)
    except OSError as error:
        raise OverrideError(f"{path} cannot be read: {error.strerror}") from None
    except json.JSONDecodeError as error:
        raise OverrideError(f"{path}:{error.lineno}:{error.colno}: not JSON: {error.msg}") from None
    except (ValueError, RecursionError) as error:
        raise OverrideError(f"{path} is not JSON: {error}") from None


def read(path):
    """The entries of a file."""
    return check(_document(path), path)


def read_layers(path):
    """The layers of a file, as `throng apply` reads them; none where there is no file."""
    if not os.path.exists(path):
        return []
    document = _document(path)
    check(document, path)
    return check_layers(document.get("layers", []), path)


def read_beside(folder):
    """The entries beside a bake; None where there is no file."""
    path = path_beside(folder)
    return read(path) if os.path.exists(path) else None


def _lines(key, items):
    lines = ",\n".join("  " + json.dumps(item, ensure_ascii=False) for item in items)
    return f' "{key}": [\n{lines}\n ]' if items else f' "{key}": []'


def text_of(entries, layers=()):
    """One line a person and a layer, so that files can be compared and merged."""
    lists = [_lines("overrides", entries)] + ([_lines("layers", layers)] if layers else [])
    return f'{{\n "throng_overrides": {VERSION},\n' + ",\n".join(lists) + "\n}\n"


def write(path, entries, layers=None):
    """Replaces a file: it has its old content or the new one, never something in between. Layers stay as they are in
    the file where none are given."""
    check({"throng_overrides": VERSION, "overrides": entries}, path)
    kept = read_layers(path) if layers is None else check_layers(layers, path)
    try:
        write_whole(path, text_of(entries, kept).encode())
    except OSError as error:
        raise OverrideError(f"{path} cannot be written: {error.strerror}") from None
