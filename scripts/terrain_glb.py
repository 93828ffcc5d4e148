# SPDX-License-Identifier: Apache-2.0
"""Writes the terrains of examples: meshes of triangles as a .glb, no larger than need be."""
import json
import struct


def as_stored(number):
    return struct.unpack("<f", struct.pack("<f", number))[0]


def write(path, generator, parts):
    """@param parts (name, [(x, y, z) with z up], [corners, three a triangle]) of each mesh"""
    binary, views, accessors, meshes, nodes = b"", [], [], [], []
    for name, points, corners in parts:
        up = [(x, z, -y) for x, y, z in points]  # glTF: y up
        vertices, indices = b"".join(struct.pack("<3f", *p) for p in up), struct.pack(f"<{len(corners)}H", *corners)
        for data, target in ((vertices, 34962), (indices, 34963)):
            views.append({"buffer": 0, "byteOffset": len(binary), "byteLength": len(data), "target": target})
            binary += data + b"\0" * (-len(data) % 4)
        low, high = ([as_stored(bound(p[k] for p in up)) for k in range(3)] for bound in (min, max))
        accessors += [{"bufferView": len(views) - 2, "componentType": 5126, "count": len(up), "type": "VEC3",
                       "min": low, "max": high},
                      {"bufferView": len(views) - 1, "componentType": 5123, "count": len(corners), "type": "SCALAR"}]
        primitive = {"attributes": {"POSITION": len(accessors) - 2}, "indices": len(accessors) - 1}
        meshes.append({"name": name, "primitives": [primitive]})
        nodes.append({"name": name, "mesh": len(meshes) - 1})
    text = json.dumps({"asset": {"version": "2.0", "generator": generator}, "scene": 0,
                       "scenes": [{"nodes": list(range(len(nodes)))}], "nodes": nodes, "meshes": meshes,
                       "accessors": accessors, "bufferViews": views,
                       "buffers": [{"byteLength": len(binary)}]}).encode()
    text += b" " * (-len(text) % 4)
    head = struct.pack("<4sII", b"glTF", 2, 28 + len(text) + len(binary))
    chunks = struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(binary), b"BIN\0") + binary
    path.write_bytes(head + chunks)
