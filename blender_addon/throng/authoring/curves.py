# SPDX-License-Identifier: Apache-2.0
"""Outlines and Bezier curves as points. Pure Python."""
import math


def _distance_to_chord(p, a, b):
    dx, dy = b[0] - a[0], b[1] - a[1]
    size = dx * dx + dy * dy
    t = 0.0 if size == 0.0 else max(0.0, min(1.0, ((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / size))
    return math.hypot(p[0] - a[0] - t * dx, p[1] - a[1] - t * dy)


def _middle(p, q):
    return (0.5 * (p[0] + q[0]), 0.5 * (p[1] + q[1]))


def flatten(a, b, c, d, tolerance, depth=12):
    """Points on a cubic from a to d, without a: no further off than the tolerance. Its control points bound it."""
    if depth == 0 or max(_distance_to_chord(b, a, d), _distance_to_chord(c, a, d)) <= tolerance:
        return [d]
    ab, bc, cd = _middle(a, b), _middle(b, c), _middle(c, d)
    abc, bcd = _middle(ab, bc), _middle(bc, cd)
    centre = _middle(abc, bcd)
    return flatten(a, ab, abc, centre, tolerance, depth - 1) + flatten(centre, bcd, cd, d, tolerance, depth - 1)


def area(outline):
    """Twice the signed area: positive counter-clockwise."""
    return sum(a[0] * b[1] - b[0] * a[1] for a, b in zip(outline, outline[1:] + outline[:1]))


def without_straight(outline):
    """The outline without points that lie on the line between their neighbours."""
    result = []
    count = len(outline)
    for i, point in enumerate(outline):
        before, after = result[-1] if result else outline[i - 1], outline[(i + 1) % count]
        if _distance_to_chord(point, before, after) > 1e-5:
            result.append(point)
    return result


def _turns_left(a, b, c):
    return (b[0] - a[0]) * (c[1] - a[1]) > (b[1] - a[1]) * (c[0] - a[0])


def hull(points):
    """The convex hull, counter-clockwise."""
    points = sorted(set(points))
    if len(points) < 3:
        return points

    def half(points):
        chain = []
        for p in points:
            while len(chain) > 1 and not _turns_left(chain[-2], chain[-1], p):
                chain.pop()
            chain.append(p)
        return chain[:-1]

    return half(points) + half(points[::-1])


def footprint(positions, faces, normals_z):
    """Outlines of a mesh seen from above: of the faces that look down (a solid's floor), else of those that look up,
    else the hull of its points.

    Holes are left out: what is inside an outline is solid. Faces are lists of indices into positions, which are (x, y).
    """
    for sign in (-1.0, 1.0):
        chosen = [face for face, z in zip(faces, normals_z) if sign * z > 1e-4]
        loops = [without_straight([positions[i] for i in loop]) for loop in _boundaries(chosen)]
        outlines = [loop for loop in loops if len(loop) > 2 and sign * area(loop) > 1e-9]
        if outlines:
            return [loop if sign > 0 else loop[::-1] for loop in outlines]
    outline = hull(positions)
    return [outline] if len(outline) > 2 else []


def _boundaries(faces):
    """Loops of the edges that only one of the faces has, in the faces' own direction."""
    edges = {(a, b) for face in faces for a, b in zip(face, face[1:] + face[:1])}
    following = {}
    for a, b in edges:
        if (b, a) not in edges:
            following.setdefault(a, []).append(b)
    loops = []
    for start in sorted(following):
        while following.get(start):
            loop = [start]
            at = following[start].pop()
            while at != start and following.get(at):
                loop.append(at)
                at = following[at].pop()
            if at == start:
                loops.append(loop)
    return loops
