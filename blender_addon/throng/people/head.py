# SPDX-License-Identifier: Apache-2.0
"""Skin, eyes, lashes, teeth and glasses."""
from dataclasses import replace

import numpy

from . import levels, regions
from .cloth import covered
from .parts import Part, clipped, joined, smoothed


def bound_to(bodies, bone, count):
    """Weights of points that hang on one bone."""
    weights = numpy.zeros((count, len(bodies.bones)))
    weights[:, bodies.bone[bone]] = 1.0
    return weights


def loose(bodies, points, faces, bone, material, flat=None):
    """A part that comes from nowhere on the base mesh."""
    places = numpy.zeros((len(points), 5))
    places[:, regions.ARM] = -1.0
    return Part(numpy.asarray(faces), numpy.asarray(points), bound_to(bodies, bone, len(points)), places, material,
                flat=flat)


def skin(bodies, shape, level, garments):
    """The body, without what clothes hide."""
    triangles = levels.triangles_of(bodies, "body", level)
    numbers, faces = numpy.unique(triangles, return_inverse=True)
    part = Part(faces.reshape(-1, 3), shape[numbers], bodies.weights[numbers], regions.places_of(bodies)[numbers])
    for garment in garments:
        part = clipped(part, covered(part.places, garment, 0.035))
    return part


def head_of(bodies, shape, level):
    """The skin of the head alone, whatever is worn, for what grows on it or covers it."""
    triangles = levels.triangles_of(bodies, "body", level)
    head = bodies.weights[:, bodies.bone["head"]] > 0.4
    numbers, faces = numpy.unique(triangles[head[triangles].all(axis=1)], return_inverse=True)
    return Part(faces.reshape(-1, 3), shape[numbers], bodies.weights[numbers], regions.places_of(bodies)[numbers])


def eyes(bodies, shape, level, brown):
    rings = levels.DETAILS[level].eyes
    kind = "eyes brown" if brown else "eyes"
    return [_eye(bodies, shape[bodies.vertices_of(f"helper-{side}-eye")], rings, kind) for side in "lr" if rings]


def _eye(bodies, points, rings, kind):
    """The front of a ball; `flat` says how far from the middle of the pupil, 1 at a right angle."""
    low, high = points.min(axis=0), points.max(axis=0)
    middle, radius = 0.5 * (low + high), 0.25 * (high - low)[1:].sum()
    spokes = 6 + 2 * rings
    made, flat, faces = [middle + (radius * 1.04, 0.0, 0.0)], [(0.0, 0.0)], []
    for ring in range(1, rings + 1):
        away = 0.58 * numpy.pi * ring / rings
        bulge = 1.0 + 0.04 * max(0.0, 1.0 - away / 0.55)
        for spoke in range(spokes):
            around = 2.0 * numpy.pi * spoke / spokes
            side = numpy.sin(away) * numpy.array([numpy.cos(around), numpy.sin(around)])
            made.append(middle + radius * bulge * numpy.array([numpy.cos(away), *side]))
            flat.append(away / (0.5 * numpy.pi) * side / max(numpy.sin(away), 1e-9))
    for spoke in range(spokes):
        after = (spoke + 1) % spokes
        faces.append((0, 1 + spoke, 1 + after))
        for ring in range(rings - 1):
            a, b = 1 + ring * spokes, 1 + (ring + 1) * spokes
            faces += [(a + spoke, b + spoke, b + after), (a + spoke, b + after, a + after)]
    return loose(bodies, numpy.array(made), faces, "head", kind, numpy.array(flat))


def _of_group(bodies, shape, group, material):
    numbers, faces = numpy.unique(bodies.triangles(group), return_inverse=True)
    return Part(faces.reshape(-1, 3), shape[numbers], bodies.weights[numbers], regions.places_of(bodies)[numbers],
                material)


def lashes(bodies, shape, level):
    if level >= 0:
        return []
    return [_of_group(bodies, shape, f"helper-{side}-eyelashes-{number}", "lashes") for side in "lr"
            for number in (1, 2)]


def teeth(bodies, shape, level):
    """Where mouths open (faces.py), and the library has them: those that were made before it did have none."""
    if level >= 0:
        return []
    return [_of_group(bodies, shape, group, "teeth") for group in ("helper-upper-teeth", "helper-lower-teeth")
            if group in bodies.groups]


def tube(points, radius, sides=5, closed=False):
    """(points, faces) of a round tube along a line."""
    points = numpy.asarray(points, float)
    along = numpy.gradient(points, axis=0)
    if closed:
        along = numpy.roll(points, -1, axis=0) - numpy.roll(points, 1, axis=0)
    along /= numpy.linalg.norm(along, axis=1, keepdims=True) + 1e-12
    across = numpy.cross(along, (0.31, 0.17, 0.93))
    across /= numpy.linalg.norm(across, axis=1, keepdims=True) + 1e-12
    other = numpy.cross(along, across)
    angles = 2.0 * numpy.pi * numpy.arange(sides) / sides
    made = (points[:, None] + radius * (numpy.cos(angles)[None, :, None] * across[:, None]
                                        + numpy.sin(angles)[None, :, None] * other[:, None])).reshape(-1, 3)
    faces, count = [], len(points)
    for one in range(count if closed else count - 1):
        a, b = one * sides, (one + 1) % count * sides
        for side in range(sides):
            after = (side + 1) % sides
            faces += [(a + side, b + side, b + after), (a + side, b + after, a + after)]
    return made, numpy.array(faces)


def glasses(bodies, shape, level, scale, round_ones):
    """Rims, a bridge, and temples that reach the ears."""
    if level > 0:
        return []
    around, sides = (28, 6) if level == levels.NEAR else (18, 5) if level < 0 else (10, 3)
    eyes_at = [0.5 * (points.max(axis=0) + points.min(axis=0)) for points in
               (shape[bodies.vertices_of(f"helper-{side}-eye")] for side in "lr")]
    front = max(point[0] for point in eyes_at) + 0.026 * scale
    angles = 2.0 * numpy.pi * numpy.arange(around) / around
    power = 1.0 if round_ones else 0.7
    bent = lambda wave, half: numpy.sign(wave) * numpy.abs(wave) ** power * half * scale
    curve = numpy.stack([bent(numpy.cos(angles), 0.0255), bent(numpy.sin(angles), 0.0205)], axis=1)
    base = regions.places_of(bodies)
    aside = numpy.abs(base[:, 1])
    temples = (aside > 0.060) & (aside < 0.0705) & (numpy.abs(base[:, 2] - 0.735) < 0.02) & (base[:, 4] > 0.5)
    wide = float(numpy.abs(shape[temples, 1]).max())
    behind = float(numpy.median(shape[temples, 0]))
    found = []
    for eye in eyes_at:
        side = numpy.sign(eye[1])
        centre = numpy.array([front, eye[1] + side * 0.001, eye[2] - 0.004 * scale])
        rim = numpy.stack([centre[0] - 0.35 * numpy.abs(curve[:, 0] * (numpy.sign(curve[:, 0]) == side)),
                           centre[1] + curve[:, 0], centre[2] + curve[:, 1]], axis=1)
        found.append(tube(rim, 0.0016 * scale, sides, closed=True))
        hinge = (centre[0] - 0.010 * scale, centre[1] + side * 0.0255 * scale, centre[2] + 0.008 * scale)
        ear = (behind, side * (wide + 0.002), centre[2] + 0.010 * scale)
        found.append(tube([hinge, (hinge[0] - 0.015, side * max(abs(hinge[1]), wide), hinge[2]), ear], 0.0014 * scale,
                          sides))
    inner = 0.5 * (eyes_at[0] + eyes_at[1])
    found.append(tube([(front, side * (abs(eyes_at[0][1]) - 0.0245 * scale), inner[2]) for side in (-1, 0, 1)],
                      0.0016 * scale, sides))
    return [joined([loose(bodies, points, faces, "head", "extra frame") for points, faces in found])]


HAT_LINES = {  # by the angle from straight ahead: height on the base mesh
    "beanie": ((0, 90, 180), (0.796, 0.772, 0.715)), "cap": ((0, 90, 180), (0.796, 0.778, 0.735)),
    "headscarf": ((0, 35, 60, 78, 100, 180), (0.806, 0.790, 0.700, 0.612, 0.560, 0.530))}


def hat(bodies, shape, level, kind, scale):
    """A beanie, a cap or a headscarf, from the scalp."""
    piece = head_of(bodies, shape, min(level, 1)) if kind != "headscarf" else _scarf_skin(bodies, shape, min(level, 1))
    angle = regions.angle_of(piece.places)
    field = piece.places[:, regions.Z] - numpy.interp(angle, *HAT_LINES[kind])
    piece = clipped(replace(piece, tags=numpy.zeros(len(piece.points), int)), field, 1)
    points = piece.points + 0.014 * scale * piece.normals
    points = smoothed(points, piece.faces, 14 if kind == "headscarf" else 8)
    middle = points.mean(axis=0)
    points = middle + (points - middle) * {"beanie": (1.11, 1.13, 1.08), "cap": (1.12, 1.13, 1.10),
                                           "headscarf": (1.13, 1.15, 1.07)}[kind]
    high = numpy.clip((points[:, 2] - middle[2]) / (0.1 * scale), 0.0, 1.0)
    if kind == "beanie":
        points = points + high[:, None] * numpy.array([-0.012, 0.0, 0.022]) * scale
    found = [replace(piece.moved(points), material="extra knit" if kind == "beanie" else "extra cotton")]
    if kind == "cap":
        found.append(_brim(bodies, points, scale))
    return found


def _scarf_skin(bodies, shape, level):
    triangles = levels.triangles_of(bodies, "body", level)
    upper = (bodies.weights[:, [bodies.bone["head"], bodies.bone["neck_01"]]].sum(axis=1) > 0.3)
    numbers, faces = numpy.unique(triangles[upper[triangles].all(axis=1)], return_inverse=True)
    return Part(faces.reshape(-1, 3), shape[numbers], bodies.weights[numbers], regions.places_of(bodies)[numbers])


def _brim(bodies, points, scale):
    front = points[:, 0].max()
    edge = points[points[:, 0] > front - 0.02 * scale][:, 2].min()
    across = numpy.linspace(-1.0, 1.0, 9)
    rows = [numpy.stack([front - 0.006 - reach_back * across ** 2, across * half,
                         edge + 0.006 - drop - sag * across ** 2], axis=1)
            for reach_back, half, drop, sag in ((0.070, 0.074, 0.0, 0.008), (0.078, 0.074, 0.004, 0.014),
                                                (0.090, 0.070, 0.014, 0.020))]
    rows[1][:, 0] += 0.036
    rows[2][:, 0] += 0.070
    made = numpy.concatenate(rows) * (1.0, scale, 1.0)
    corners = [row * 9 + k for row in range(2) for k in range(8)]
    faces = [each for a in corners for each in ((a, a + 1, a + 10), (a, a + 10, a + 9))]
    return loose(bodies, made, faces, "head", "extra cotton")
