# SPDX-License-Identifier: Apache-2.0
"""Diagram images: whose ground is whose, of all of the site or of one storey, with their places in the world."""
from __future__ import annotations

import dataclasses
import pathlib
from typing import Any

import numpy

from ..base.errors import BakeError, need


@dataclasses.dataclass(frozen=True)
class Diagram:
    """One image. Rows go down from the largest y."""
    name: str | None           # of the floor, link, lift or ground; None: of all, or of the plane of its storeys
    kind: str | None           # level, link, lift or ground
    level: str | None          # on which that is; of a link, that from which it leads
    lowest: float              # m, of its ground
    highest: float
    channels: dict[str, numpy.ndarray]
    world_to_pixel: numpy.ndarray  # row vectors (x, y, 1), in metres, to (column, row) of `channels`

    def pixel_of(self, places: numpy.ndarray) -> numpy.ndarray:
        """(column, row), in fractions of pixels, of places (x, y) in the world."""
        places = numpy.asarray(places, dtype=float)
        return places @ self.world_to_pixel[:2, :2] + self.world_to_pixel[2, :2]

    def place_of(self, pixels: numpy.ndarray) -> numpy.ndarray:
        """(x, y) in the world of (column, row); a pixel's middle is half a pixel beyond its number."""
        pixels = numpy.asarray(pixels, dtype=float)
        return (pixels - self.world_to_pixel[2, :2]) @ numpy.linalg.inv(self.world_to_pixel[:2, :2])


def read(about: dict[str, Any], folder: pathlib.Path, frame: int, storey: str | None) -> Diagram:
    """@param storey the name of a part; None: the image of the plane, which of a flat layout is all"""
    library = need("OpenEXR", "textures")
    diagrams = about.get("diagrams")
    if not diagrams:
        raise BakeError(f"{folder}: has no diagram images", "bake it with --diagrams")
    every, count = diagrams["every"], diagrams["count"]
    if frame % every != 0 or not 0 <= frame // every < count:
        raise BakeError(f"{folder}: has no diagram image of frame {frame}",
                        f"it has {count}, of every {every} frames from 0 on" if every > 1 else f"it has {count}")
    pattern = diagrams["pattern"] if storey is None else _storeys(diagrams, folder, storey)["pattern"]
    path = folder / pattern.replace("####", f"{frame + 1:04d}")
    try:
        with library.File(str(path), separate_channels=True) as file:
            part = file.parts[0] if storey is None else next(p for p in file.parts if p.header["name"] == storey)
            return _diagram(part, storey)
    except (OSError, RuntimeError, StopIteration, KeyError) as error:
        raise BakeError(f"{path}: cannot be read as a diagram image ({error})") from None


def names(about: dict[str, Any]) -> list[str]:
    return [part["name"] for part in ((about.get("diagrams") or {}).get("storeys") or {}).get("parts", [])]


def _storeys(diagrams: dict[str, Any], folder: pathlib.Path, storey: str) -> dict[str, Any]:
    known = [part["name"] for part in diagrams.get("storeys", {}).get("parts", [])]
    if storey not in known:
        raise BakeError(f"{folder}: no diagram image shows a storey {storey!r}",
                        f"there are {', '.join(known)}" if known else "the layout has no levels: leave `storey` out")
    return diagrams["storeys"]


def _diagram(part: Any, storey: str | None) -> Diagram:
    header = part.header
    to_pixel = numpy.array(header["throng:worldToPixel"], dtype=float).reshape(3, 3)
    to_pixel[2, :2] -= numpy.array(header["dataWindow"][0], dtype=float)
    channels = {name: channel.pixels for name, channel in part.channels.items()}
    if storey is None:
        return Diagram(None, None, None, 0.0, 0.0, channels, to_pixel)
    lowest, highest = (float(numpy.ravel(header[f"throng:{end}"])[0]) for end in ("lowest", "highest"))
    return Diagram(storey, header["throng:kind"], header["throng:level"], lowest, highest, channels, to_pixel)
