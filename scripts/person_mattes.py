# SPDX-License-Identifier: Apache-2.0
"""Makes a Cryptomatte of people of what a plate's passes say of them: CryptoPerson, in which everybody is a name.

scripts/person_mattes.py PLATE.exr OUT.exr BAKE [BAKE...]

PLATE.exr is one frame, rendered with the film look Plate or Final; BAKE are the bakes of all crowds in it. Wants the
packages numpy and OpenEXR (PyPI). Prints how much of the crowd nobody could be found for; status 3: bad input.
"""
import argparse
import json
import os
import pathlib
import sys

import numpy
import OpenEXR

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "blender_addon" / "throng" / "formats"))
from person_codes import PASSES, person_name  # noqa: E402
from person_solver import solve  # noqa: E402

RANKS = 6  # people a pixel names at most


class BadInput(Exception):
    """Says what is wrong, and what to do."""


def murmur3(text):
    """MurmurHash3, 32 bits, of a name, with exponents that floats keep: what Cryptomatte calls its numbers."""
    data, value, mask = text.encode("utf-8"), 0, 0xffffffff
    blocks = [int.from_bytes(data[at:at + 4], "little") for at in range(0, len(data), 4)]
    for index, block in enumerate(blocks):
        block = block * 0xcc9e2d51 & mask
        block = (block << 15 | block >> 17) & mask
        value ^= block * 0x1b873593 & mask
        if 4 * index + 4 <= len(data):
            value = (value << 13 | value >> 19) & mask
            value = (value * 5 + 0xe6546b64) & mask
    value ^= len(data)
    for shift, factor in ((16, 0x85ebca6b), (13, 0xc2b2ae35)):
        value = (value ^ value >> shift) * factor & mask
    value ^= value >> 16
    return value ^ 1 << 23 if value >> 23 & 255 in (0, 255) else value


def people_of(bakes):
    """The names of everybody in some bakes, in order."""
    names = []
    for bake in bakes:
        path = bake if bake.endswith(".json") else os.path.join(bake, "bake.json")
        try:
            manifest = json.loads(pathlib.Path(path).read_text(encoding="utf-8"))
            agents, folder = int(manifest["agents"]), os.path.basename(os.path.dirname(os.path.abspath(path)))
        except (OSError, ValueError, KeyError, TypeError) as error:
            raise BadInput(f"{path}: not a bake ({error}): name a folder that `throng bake` has written") from None
        names += [person_name(manifest.get("name") or folder, row) for row in range(agents)]
    return names


def read_plate(path):
    """(header, {channel: pixels}, the prefix of the layer that has the passes, those passes as (H, W, 6))."""
    try:
        with OpenEXR.File(path, separate_channels=True) as file:
            header = dict(file.parts[0].header)
            channels = {name: each.pixels for part in file.parts for name, each in part.channels.items()}
    except (RuntimeError, OSError, ValueError) as error:
        raise BadInput(f"{path}: not an OpenEXR image ({error})") from None
    found = sorted(name for name in channels if name.endswith(f"{PASSES[0]}.R"))
    if not found:
        raise BadInput(f"{path}: has no pass {PASSES[0]}: render it as multilayer EXR after choosing the film look "
                       "Plate or Final")
    prefix = found[0][:-len(f"{PASSES[0]}.R")]
    values = numpy.stack([channels[f"{prefix}{name}.{plane}"] for name in PASSES for plane in "RGB"], axis=-1)
    return header, channels, prefix, values.astype(numpy.float64)


def matte_channels(prefix, found, shares, names):
    """Channels and header entries of the Cryptomatte. `found` and `shares` are (H, W, RANKS), -1 is nobody."""
    numbers = numpy.array([murmur3(name) for name in names], numpy.uint32)
    floats = numpy.where(found >= 0, numbers[numpy.maximum(found, 0)], 0).astype(numpy.uint32).view(numpy.float32)
    layer, channels = f"{prefix}CryptoPerson", {}
    for rank in range(RANKS):
        for plane, values in zip("RG" if rank % 2 == 0 else "BA", (floats, shares.astype(numpy.float32))):
            channels[f"{layer}{rank // 2:02d}.{plane}"] = numpy.ascontiguousarray(values[..., rank])
    there = [names[i] for i in numpy.unique(found[found >= 0])]
    key = f"cryptomatte/{murmur3(layer):08x}"[:len("cryptomatte/") + 7]
    manifest = json.dumps({name: f"{murmur3(name):08x}" for name in there}, separators=(",", ":"))
    return channels, {f"{key}/name": layer, f"{key}/hash": "MurmurHash3_32", f"{key}/conversion": "uint32_to_float32",
                      f"{key}/manifest": manifest}


def write_picture(path, header, channels):
    """Complete or not at all."""
    fresh = f"{path}.new-{os.getpid()}.exr"
    try:
        with OpenEXR.File(header, {name: OpenEXR.Channel(pixels) for name, pixels in channels.items()}) as file:
            file.write(fresh)
        os.replace(fresh, path)
    except (RuntimeError, OSError) as error:
        raise BadInput(f"{path}: cannot be written ({error})") from None
    finally:
        if os.path.exists(fresh):
            os.remove(fresh)


def main():
    parser = argparse.ArgumentParser(description="a Cryptomatte of people", usage="person_mattes.py PLATE OUT BAKE...")
    parser.add_argument("plate")
    parser.add_argument("out")
    parser.add_argument("bakes", nargs="+")
    options = parser.parse_args()
    try:
        names = people_of(options.bakes)
        header, channels, prefix, values = read_plate(options.plate)
        found, shares, lost = solve(values, names, RANKS)
        matte, entries = matte_channels(prefix, found, shares, names)
        for name in [each for each in channels if any(each.startswith(f"{prefix}{one}.") for one in PASSES)]:
            del channels[name]
        write_picture(options.out, {**header, **entries}, {**channels, **matte})
    except BadInput as error:
        print(f"error: {error}", file=sys.stderr)
        sys.exit(3)
    crowd = values[..., 0].sum()
    print(f"{options.out}: {len(numpy.unique(found[found >= 0]))} people; "
          f"{100.0 * lost / crowd if crowd else 0.0:.2f} % of the crowd's area is nobody's")


if __name__ == "__main__":
    main()
