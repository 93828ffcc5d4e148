# SPDX-License-Identifier: Apache-2.0
"""The ground of a bake with levels, as a mesh that says of each corner where it is in the diagram's plane.

Charts - floors, links, parts of a terrain - lie side by side in that plane, so one image texture shows all of them,
each storey with its own cells. Faces that look up are those of the chart that has them: which one that is says the
place and height of their middle. On a terrain, faces are cut until they are small: a chart's part of the plane shows
those beyond its seams, too, for several metres, so nothing is seen of where they change.
"""
import numpy

import bpy

from ..blender.meshes import fill_with_triangles
from ..setting.plane import inside

AT = "throng_cells_at"  # of corners: where they are in the image, from 0 to 1
_UP = 0.2               # of a normal, from which on one stands on a face
_STEP = 0.06            # m: a floor's faces are as high as the floor
_TREAD = 0.45           # m: a link's faces are as near to its slope
_LOOSE = 0.3            # m: a ground's faces may lie so far beyond its lowest and highest place
_LONGEST = 2.5          # m: the edges of a terrain's faces, seen from above


def build(ground, diagrams, manifest, lift):
    """A mesh over the terrain's, of all that belongs to a storey: frames of lifts and the like do not.
    @param ground the terrain's object; @param lift m: how far above it"""
    corners = _triangles(ground.data)
    if manifest["terrain"].get("surface") == "grounds":
        corners = _cut(corners)
    parts = diagrams["storeys"]["parts"]
    chart = _charts_of(corners, parts, manifest)
    known = chart >= 0
    corners, chart = corners[known], chart[known]
    size = numpy.array([diagrams["width"], diagrams["height"]]) / diagrams["pixels_per_metre"]
    shift = numpy.array([part["shift"] for part in parts])[chart]
    at = (corners[..., :2] + shift[:, None, :] - numpy.array(diagrams["min"])) / size
    return _mesh(corners + (0.0, 0.0, lift), at)


def _triangles(mesh):
    """Of the faces that look up: triangles x corners x (x, y, z)."""
    mesh.calc_loop_triangles()
    places = numpy.empty(len(mesh.vertices) * 3)
    mesh.vertices.foreach_get("co", places)
    numbers = numpy.empty(len(mesh.loop_triangles) * 3, dtype=numpy.int32)
    mesh.loop_triangles.foreach_get("vertices", numbers)
    corners = places.reshape(-1, 3)[numbers].reshape(-1, 3, 3)
    normals = numpy.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    return corners[normals[:, 2] > _UP * numpy.linalg.norm(normals, axis=1)]


def _cut(corners):
    """Halves triangles at their longest edge, seen from above, until it is short."""
    done = []
    while len(corners):
        edges = numpy.linalg.norm(numpy.roll(corners, -1, axis=1)[..., :2] - corners[..., :2], axis=2)
        long = edges.max(axis=1) > _LONGEST
        done.append(corners[~long])
        first = edges[long].argmax(axis=1)
        a, b, c = (corners[long][numpy.arange(len(first)), (first + step) % 3] for step in range(3))
        middle = 0.5 * (a + b)
        corners = numpy.concatenate([numpy.stack([a, middle, c], axis=1), numpy.stack([middle, b, c], axis=1)])
    return numpy.concatenate(done) if done else corners


def _charts_of(corners, parts, manifest):
    """The number of each triangle's part; -1: none."""
    levels = {level["id"]: level for level in manifest.get("levels", [])}
    links = {link["id"]: link for link in manifest.get("links", [])}
    middles = corners.mean(axis=1)
    chart = numpy.full(len(corners), -1)
    # Links first: their lowest treads are as high as the floor.
    order = sorted(range(len(parts)), key=lambda number: (parts[number]["kind"] != "link", number))
    for number in order:
        part = parts[number]
        own = (_on_link(middles, part, links[part["name"]]) if part["kind"] == "link" and part["name"] in links
               else _on_level(middles, part, levels.get(part["level"])) if part["kind"] in ("level", "ground")
               else numpy.zeros(len(corners), dtype=bool))
        chart[own & (chart < 0)] = number
    return chart


def _on_link(middles, part, link):
    path = numpy.array(link["path"], dtype=float)
    lengths = numpy.linalg.norm(numpy.diff(path, axis=0), axis=1)
    levels_of = (part["lowest"], part["highest"])
    own = numpy.zeros(len(middles), dtype=bool)
    for begin, end, length in zip(path, path[1:], lengths):
        along = (end - begin) / length
        offset = middles[:, :2] - begin
        forward, aside = offset @ along, offset @ numpy.array([-along[1], along[0]])
        own |= ((forward > -1e-3) & (forward < length + 1e-3) & (numpy.abs(aside) < 0.5 * link["width"] + 0.2)
                & (middles[:, 2] > levels_of[0] - _TREAD) & (middles[:, 2] < levels_of[1] + _TREAD))
    return own


def _on_level(middles, part, level):
    """@param level None: a ground of a terrain that no level names, known by its heights only"""
    loose = _STEP if part["kind"] == "level" else _LOOSE
    own = (middles[:, 2] > part["lowest"] - loose) & (middles[:, 2] < part["highest"] + loose)
    if level is None:
        return own
    floor = [tuple(point) for point in level["floor"]]
    own[own] = [inside(floor, tuple(place)) for place in middles[own, :2]]
    return own


def _mesh(corners, at):
    mesh = bpy.data.meshes.new("Throng cells")
    count = 3 * len(corners)
    fill_with_triangles(mesh, corners.reshape(-1, 3), numpy.arange(count))
    vectors = numpy.concatenate([at.reshape(-1, 2), numpy.zeros((count, 1))], axis=1)
    mesh.attributes.new(AT, "FLOAT_VECTOR", "POINT").data.foreach_set("vector", vectors.ravel())
    mesh.update()
    return mesh
