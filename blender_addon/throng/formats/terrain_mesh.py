# SPDX-License-Identifier: Apache-2.0
"""Reads the terrain of a bake (terrain.glb). Pure Python: no Blender, no numpy."""
import array
import json
import os
import struct

from . import BakeError


def read_mesh(path):
    """Positions (x, y, z, x, ...) and corners (three for each triangle) of the one mesh in a bake's terrain.glb, z up,
    from the bake's origin."""
    name = os.path.basename(path)
    try:
        with open(path, "rb") as file:
            data = file.read()
    except OSError as error:
        raise BakeError(f"{name} cannot be read: {error.strerror}. Copy the whole bake "
                        "folder, not only bake.json") from None
    try:
        magic, _, size, text_size, _ = struct.unpack_from("<4sIII4s", data)
        if magic != b"glTF" or size != len(data):
            raise ValueError
        document = json.loads(data[20:20 + text_size])
        binary = data[28 + text_size:]
        primitive = document["meshes"][0]["primitives"][0]
        found = []
        for accessor, code, width in ((primitive["attributes"]["POSITION"], "f", 3), (primitive["indices"], "I", 1)):
            accessor = document["accessors"][accessor]
            view = document["bufferViews"][accessor["bufferView"]]
            first, count = view.get("byteOffset", 0), accessor["count"] * width
            values = array.array(code)
            values.frombytes(binary[first:first + 4 * count])
            if len(values) != count:
                raise ValueError
            found.append(values)
        positions, corners = found
        if max(corners) >= len(positions) // 3:
            raise ValueError
    except (ValueError, KeyError, IndexError, TypeError, AttributeError, struct.error):
        raise BakeError(f"{name} is not the terrain of a Throng bake, or is truncated: copy or bake it again") from None
    up = array.array("f", positions)
    up[1::3], up[2::3] = array.array("f", (-z for z in positions[2::3])), positions[1::3]
    return up, corners
