# SPDX-License-Identifier: Apache-2.0
"""Reads files that nobody has looked at: of a sensible size, without entities, numbers that are numbers."""
from __future__ import annotations

import json
import math
import pathlib
from typing import Any

from ..base.errors import ImportFailed, need

LARGEST = 256 << 20  # bytes


def read_bytes(path: pathlib.Path) -> bytes:
    try:
        if not path.is_file():
            raise ImportFailed("expected a file" if path.exists() else "there is no such file", str(path))
        if path.stat().st_size > LARGEST:
            raise ImportFailed(f"larger than {LARGEST >> 20} MiB", str(path), hint="cut out the part that you need")
        return path.read_bytes()
    except OSError as error:
        raise ImportFailed(f"cannot be read: {error.strerror}", str(path)) from error


def read_text(path: pathlib.Path) -> str:
    try:
        return read_bytes(path).decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise ImportFailed("expected text in UTF-8", str(path)) from error


def read_json(path: pathlib.Path) -> Any:
    def refuse(word: str) -> None:
        raise ImportFailed(f"{word} is no number", str(path))

    try:
        return json.loads(read_text(path), parse_constant=refuse)
    except json.JSONDecodeError as error:
        raise ImportFailed(f"no JSON: {error.msg}", str(path), error.lineno) from error
    except RecursionError as error:
        raise ImportFailed("nested too deeply", str(path)) from error


def read_xml(path: pathlib.Path, root: str | tuple[str, ...] | None = None):
    """The root of a document. One with entities of its own is refused: they can be of any size."""
    etree = need("lxml.etree", "import")
    parser = etree.XMLParser(resolve_entities=False, no_network=True, load_dtd=False, huge_tree=False,
                             remove_comments=True, remove_pis=True)
    try:
        found = etree.fromstring(read_bytes(path), parser)
    except etree.XMLSyntaxError as error:
        if "entity amplification" in str(error.msg):
            raise ImportFailed("has entities of its own, which are not read", str(path)) from error
        raise ImportFailed(f"no XML: {error.msg}", str(path), error.lineno or 0) from error
    document = found.getroottree().docinfo
    if document.internalDTD is not None and any(True for _ in document.internalDTD.iterentities()):
        raise ImportFailed("has entities of its own, which are not read", str(path))
    if root and tag(found) not in ((root,) if isinstance(root, str) else root):
        raise ImportFailed(f"expected <{root if isinstance(root, str) else root[0]}>, found <{tag(found)}>",
                           str(path), found.sourceline)
    return found


def tag(element) -> str:
    """Its name without the namespace."""
    return element.tag.rpartition("}")[2] if isinstance(element.tag, str) else ""


def children(element, *names: str) -> list:
    return [child for child in element if tag(child) in names]


def child(element, name: str):
    return next(iter(children(element, name)), None)


def number(value: Any, what: str, file: str, line: int = 0) -> float:
    try:
        found = float(value)
    except (TypeError, ValueError):
        found = math.nan
    if not math.isfinite(found):
        raise ImportFailed(f"{what}: expected a number, found {str(value)[:40]!r}", file, line)
    return found


class Reader:
    """Numbers of one XML file, whose mistakes have their line."""

    def __init__(self, path: pathlib.Path):
        self.path, self.file = path, str(path)

    def attribute(self, element, name: str, default: float | None = None) -> float:
        value = element.get(name)
        if value is None and default is not None:
            return default
        return number(value, f"{tag(element)} {name}", self.file, element.sourceline)

    def text(self, element, name: str, default: float | None = None) -> float:
        found = child(element, name)
        if found is None and default is not None:
            return default
        value = None if found is None else (found.text or "").strip()
        return number(value, f"{tag(element)} {name}", self.file, element.sourceline)

    def beside(self, name: str | None, element) -> pathlib.Path:
        """A file that this one names, from its own folder."""
        if not name:
            raise ImportFailed(f"{tag(element)} names no file", self.file, element.sourceline)
        return self.path.parent / name.replace("\\", "/")
