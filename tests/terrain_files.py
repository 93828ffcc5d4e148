# SPDX-License-Identifier: Apache-2.0
"""Terrains made by tests: glTF files of known heights."""
import json
import struct


def glb(positions, triangles, node=None, nodes=None):
    """The bytes of a .glb with one mesh. Positions are (x, y, z) with z up; the file gets (x, z, -y)."""
    points = b"".join(struct.pack("<3f", x, z, -y) for x, y, z in positions)
    corners = b"".join(struct.pack("<3I", *triangle) for triangle in triangles)
    document = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
                "nodes": nodes or [{"mesh": 0, **(node or {})}],
                "meshes": [{"name": "ground", "primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
                "accessors": [{"bufferView": 0, "componentType": 5126, "count": len(positions), "type": "VEC3",
                               "min": [min(p[0] for p in positions), min(p[2] for p in positions),
                                       min(-p[1] for p in positions)],
                               "max": [max(p[0] for p in positions), max(p[2] for p in positions),
                                       max(-p[1] for p in positions)]},
                              {"bufferView": 1, "componentType": 5125, "count": 3 * len(triangles), "type": "SCALAR"}],
                "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": len(points)},
                                {"buffer": 0, "byteOffset": len(points), "byteLength": len(corners)}],
                "buffers": [{"byteLength": len(points) + len(corners)}]}
    return pack(document, points + corners)


def pack(document, binary):
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    return struct.pack("<4sII", b"glTF", 2, 28 + len(text) + len(binary)) + \
        struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(binary), b"BIN\0") + binary


def surface(height, low, high, cell):
    """Positions and triangles of a surface z = height(x, y)."""
    columns, rows = (round((b - a) / cell) + 1 for a, b in zip(low, high))
    positions = [(low[0] + i * cell, low[1] + j * cell, height(low[0] + i * cell, low[1] + j * cell))
                 for j in range(rows) for i in range(columns)]
    triangles = []
    for j in range(rows - 1):
        for i in range(columns - 1):
            a = j * columns + i
            triangles += [(a, a + 1, a + columns + 1), (a, a + columns + 1, a + columns)]
    return positions, triangles


def stairs(count, tread, rise, landing, half_width, flat=False):
    """Up along +x from x = 0: a landing before it (at height 0), `count` treads each `rise` above the one before, and a
    landing at the top. Risers are upright faces."""
    positions, triangles = [], []

    def quad(a, b, c, d):
        first = len(positions)
        positions.extend((a, b, c, d))
        triangles.extend([(first, first + 1, first + 2), (first, first + 2, first + 3)])

    edges = [-landing] + [i * tread for i in range(count + 1)] + [count * tread + landing]
    heights = [0.0] + [(i + 1) * rise for i in range(count)] + [count * rise]
    for x0, x1, z in zip(edges, edges[1:], heights):
        quad((x0, -half_width, z), (x1, -half_width, z), (x1, half_width, z), (x0, half_width, z))
    for x, low, high in zip(edges[1:], heights, heights[1:]):
        if high > low:
            quad((x, -half_width, low), (x, half_width, low), (x, half_width, high), (x, -half_width, high))
    return positions, triangles


def stair_height(x, count, tread, rise):
    """The tread's height at x."""
    return 0.0 if x < 0.0 else min(int(x / tread) + 1, count) * rise
