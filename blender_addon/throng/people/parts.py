# SPDX-License-Identifier: Apache-2.0
"""Pieces of people: triangles whose vertices carry where they are, what they hang on, and where they come from on the
base mesh. They are cut by fields, smoothed, and joined."""
from dataclasses import dataclass, replace

import numpy


@dataclass
class Part:
    faces: numpy.ndarray     # (F, 3)
    points: numpy.ndarray    # (V, 3) m, in the rest pose
    weights: numpy.ndarray   # (V, B) of bones
    places: numpy.ndarray    # (V, 5) on the base mesh: x, y, z, how far along the arm (or -1), share of the head
    material: str = "skin"
    tags: numpy.ndarray = None   # (V,) which cut made a vertex; 0 none
    flat: numpy.ndarray = None   # (V, 2) where a picture goes on it: eyes, strands

    def __post_init__(self):
        if self.tags is None:
            self.tags = numpy.zeros(len(self.points), int)
        if self.flat is None:
            self.flat = numpy.zeros((len(self.points), 2))

    def columns(self):
        return numpy.concatenate([self.points, self.places, self.flat, self.weights], axis=1)

    def of_columns(self, columns, faces, tags):
        return replace(self, faces=faces, points=columns[:, :3], places=columns[:, 3:8], flat=columns[:, 8:10],
                       weights=columns[:, 10:], tags=tags)

    def kept(self, faces):
        """With those faces alone, and no loose vertices."""
        used, numbers = numpy.unique(faces, return_inverse=True)
        return self.of_columns(self.columns()[used], numbers.reshape(-1, 3), self.tags[used])

    def moved(self, points):
        return replace(self, points=points)

    @property
    def normals(self):
        return normals_of(self.points, self.faces)


def normals_of(points, faces):
    a, b, c = (points[faces[:, corner]] for corner in range(3))
    flat = numpy.cross(b - a, c - a)
    normals = numpy.zeros_like(points)
    for corner in range(3):
        for axis in range(3):
            normals[:, axis] += numpy.bincount(faces[:, corner], flat[:, axis], len(points))
    return normals / numpy.maximum(numpy.linalg.norm(normals, axis=1, keepdims=True), 1e-12)


def directed_edges(faces):
    return numpy.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])


def pairs_of(pairs, **returns):
    """(pairs, of each the smaller number first and none twice; what numpy.unique returns beside): as one number each
    they sort in a tenth of the time."""
    pairs = numpy.sort(pairs, axis=1)
    most = int(pairs.max(initial=0)) + 1
    numbers, *others = numpy.unique(pairs[:, 0].astype(numpy.int64) * most + pairs[:, 1], **returns)
    return (numpy.stack(numpy.divmod(numbers, most), axis=1), *others)


def edges_of(faces):
    """(edges, in how many faces each is)"""
    return pairs_of(directed_edges(faces), return_counts=True)


def border_of(faces):
    """Directed edges that only one face has."""
    edges = directed_edges(faces)
    _, number, count = pairs_of(edges, return_inverse=True, return_counts=True)
    return edges[count[number.ravel()] == 1]


def smoothed(points, faces, rounds, share=0.5, fixed=None):
    """Every vertex goes towards the middle of its neighbours; those of a border, of their neighbours on the border."""
    edges, count = edges_of(faces)
    border = numpy.zeros(len(points), bool)
    border[edges[count == 1]] = True
    one = numpy.concatenate([edges[:, 0], edges[:, 1]])
    other = numpy.concatenate([edges[:, 1], edges[:, 0]])
    along = numpy.concatenate([count == 1] * 2)
    use = ~border[one] | along
    one, other = one[use], other[use]
    many = numpy.bincount(one, minlength=len(points))
    moves = many > 0
    if fixed is not None:
        moves &= ~fixed
    for _ in range(rounds):
        middle = numpy.stack([numpy.bincount(one, points[other, axis], len(points)) for axis in range(3)], axis=1)
        middle /= numpy.maximum(many, 1)[:, None]
        points = numpy.where(moves[:, None], points + share * (middle - points), points)
    return points


def evened(values, border, numbers, rounds=12):
    """Values of the points of a border (`numbers`, sorted), each the more like those of its neighbours along it."""
    one, other = numpy.searchsorted(numbers, border).T
    many = 1.0 + numpy.bincount(one, minlength=len(numbers)) + numpy.bincount(other, minlength=len(numbers))
    for _ in range(rounds):
        beside = values.copy()
        numpy.add.at(beside, one, values[other])
        numpy.add.at(beside, other, values[one])
        values = beside / many[:, None]
    return values


def clipped(part, field, tag=0):
    """What of a part is where a field is positive; new vertices are on its zero, and carry the tag."""
    field = numpy.where(numpy.abs(field) < 1e-9, 1e-9, field)
    inside = field > 0.0
    if inside.all():
        return part
    count = inside[part.faces].sum(axis=1)
    whole = part.faces[count == 3]
    # turned so that the corner which is alone on its side comes first
    faces, cut = [whole], []
    for alone in (1, 2):
        some = part.faces[count == alone]
        lonely = inside[some] if alone == 1 else ~inside[some]
        turn = numpy.argmax(lonely, axis=1)
        rows = numpy.arange(len(some))[:, None]
        cut.append(some[rows, (turn[:, None] + numpy.arange(3)) % 3])
    crossing = numpy.concatenate([cut[0][:, [0, 1]], cut[0][:, [0, 2]], cut[1][:, [0, 1]], cut[1][:, [0, 2]]])
    edges, number = pairs_of(crossing, return_inverse=True)
    number = number.ravel() + len(part.points)
    a, b = len(cut[0]), len(cut[1])
    one_b, one_c = number[:a], number[a:2 * a]
    two_b, two_c = number[2 * a:2 * a + b], number[2 * a + b:]
    faces.append(numpy.stack([cut[0][:, 0], one_b, one_c], axis=1))
    faces.append(numpy.stack([two_b, cut[1][:, 1], cut[1][:, 2]], axis=1))
    faces.append(numpy.stack([two_b, cut[1][:, 2], two_c], axis=1))
    share = (field[edges[:, 0]] / (field[edges[:, 0]] - field[edges[:, 1]]))[:, None]
    columns = part.columns()
    new = columns[edges[:, 0]] * (1.0 - share) + columns[edges[:, 1]] * share
    everything = part.of_columns(numpy.concatenate([columns, new]), part.faces,
                                 numpy.concatenate([part.tags, numpy.full(len(new), tag)]))
    return everything.kept(numpy.concatenate(faces))


def cut_out(part, fields):
    """What of a part is inside of several fields, one cut after the other."""
    piece = replace(part, tags=numpy.zeros(len(part.points), int))
    for field in fields:
        if len(piece.faces):
            piece = clipped(piece, field(piece.places), 1)
    return piece


def laid_on(part, fields, lift, material):
    """What of a part is inside of fields, once more on top of it, with edges: pockets, belts, straps."""
    piece = cut_out(part, fields)
    if not len(piece.faces):
        return []
    piece = piece.moved(smoothed(piece.points, piece.faces, 6, 0.5, piece.tags == 0))
    piece = replace(piece.moved(piece.points + smooth_normals(piece) * lift), material=material)
    return [folded(piece, 1.2 * lift)]


def lines_on(part, field, least=8):
    """Where a field is zero on a part, as parts without faces, their points in order along it: (part, whether its ends
    meet) of each line that has some length."""
    cut = clipped(replace(part, tags=numpy.zeros(len(part.points), int)), field, 1)
    border = border_of(cut.faces) if len(cut.faces) else numpy.zeros((0, 2), int)
    after = {int(a): int(b) for a, b in border[(cut.tags[border] == 1).all(axis=1)]}
    starts, found = [a for a in after if a not in set(after.values())], []
    while after:
        at = next((a for a in starts if a in after), next(iter(after)))
        chain = [at]
        while at in after:
            at = after.pop(at)
            chain.append(at)
        closed = chain[0] == chain[-1]
        if len(chain) >= least:
            chain = chain[:-1] if closed else chain
            columns = numpy.concatenate([cut.columns(), smooth_normals(cut)], axis=1)[chain]
            found.append((cut.of_columns(columns[:, :-3], cut.faces[:0], cut.tags[chain]), columns[:, -3:], closed))
    return found


# Across a strap (share of half its width, height): flat, with two edges that light shows in the finest.
_PLAIN = ((-1.0, -0.9), (-0.95, 0.95), (0.95, 0.95), (1.0, -0.9))
_FINE = ((-1.0, -0.9), (-1.0, 0.55), (-0.93, 0.95), (-0.80, 1.0),
            (0.80, 1.0), (0.93, 0.95), (1.0, 0.55), (1.0, -0.9))


def strap_on(part, field, wide, lift, material, fine=False, rounds=30):
    """A strap of even width along the lines where a field is zero. @param fine with round edges"""
    found = []
    for line, normals, closed in lines_on(part, field):
        points, faces = line.points, []
        for each in range(rounds):
            before, after = (numpy.roll(points, 1, axis=0), numpy.roll(points, -1, axis=0))
            middle = 0.5 * (before + after)
            if not closed:
                middle[0], middle[-1] = points[0], points[-1]
            points = 0.5 * (points + middle)
            normals = 0.5 * normals + 0.25 * (numpy.roll(normals, 1, axis=0) + numpy.roll(normals, -1, axis=0)) \
                if closed else normals
        normals /= numpy.linalg.norm(normals, axis=1, keepdims=True) + 1e-12
        along = numpy.roll(points, -1, axis=0) - numpy.roll(points, 1, axis=0) if closed else \
            numpy.gradient(points, axis=0)
        aside = numpy.cross(normals, along)
        aside /= numpy.linalg.norm(aside, axis=1, keepdims=True) + 1e-12
        rows = [points + aside * (0.5 * wide * share) + normals * (lift * height)
                for share, height in (_FINE if fine else _PLAIN)]
        count, across = len(points), len(rows)
        columns = numpy.tile(line.columns(), (across, 1))
        columns[:, :3] = numpy.concatenate(rows)
        a = numpy.arange(count if closed else count - 1)
        b = (a + 1) % count
        for row in range(across - 1):
            one, two = row * count, (row + 1) * count
            faces += [numpy.stack([one + a, one + b, two + b], axis=1),
                      numpy.stack([one + a, two + b, two + a], axis=1)]
        found.append(replace(line.of_columns(columns, numpy.concatenate(faces), numpy.zeros(len(columns), int)),
                             material=material))
    return found


def smooth_normals(part):
    """Without the folds of cloth."""
    normals = smoothed(part.normals, part.faces, 3)
    return normals / (numpy.linalg.norm(normals, axis=1, keepdims=True) + 1e-9)


def subdivided(part, share=0.35):
    """Every triangle in four, a little smoothed."""
    edges, number = pairs_of(directed_edges(part.faces), return_inverse=True)
    number = number.ravel().reshape(3, -1) + len(part.points)
    columns = part.columns()
    ab, bc, ca = number
    a, b, c = part.faces.T
    faces = numpy.concatenate([numpy.stack(each, axis=1) for each in ((a, ab, ca), (ab, b, bc), (ca, bc, c),
                                                                      (ab, bc, ca))])
    tags = numpy.where(part.tags[edges[:, 0]] == part.tags[edges[:, 1]], part.tags[edges[:, 0]], 0)
    finer = part.of_columns(numpy.concatenate([columns, columns[edges].mean(axis=1)]), faces,
                            numpy.concatenate([part.tags, tags]))
    return finer.moved(smoothed(finer.points, finer.faces, 1, share))


def scattered(piece, draw, count):
    """Points all over a part, by area: (points, normals, weights, places)."""
    a, b, c = (piece.points[piece.faces[:, corner]] for corner in range(3))
    area = numpy.linalg.norm(numpy.cross(b - a, c - a), axis=1)
    chosen = draw.choice(len(piece.faces), count, p=area / area.sum())
    share = draw.dirichlet((1.0, 1.0, 1.0), count)
    mix = lambda values: (values[piece.faces[chosen]] * share[..., None]).sum(axis=1)
    normals = mix(piece.normals)
    return (mix(piece.points), normals / numpy.linalg.norm(normals, axis=1, keepdims=True), mix(piece.weights),
            mix(piece.places))


def joined(parts):
    """One part of several; the first one's material."""
    parts = [part for part in parts if len(part.faces)]
    first = numpy.cumsum([0, *[len(part.points) for part in parts]])
    return replace(parts[0], faces=numpy.concatenate([part.faces + start for part, start in zip(parts, first)]),
                   **{name: numpy.concatenate([getattr(part, name) for part in parts])
                      for name in ("points", "weights", "places", "tags", "flat")})


def folded(part, depth, tags=None):
    """The borders (of those cuts, or all) turned inwards, so that cloth has a visible thickness."""
    border = border_of(part.faces)
    if tags is not None:
        border = border[numpy.isin(part.tags[border], tags).all(axis=1)]
    if not len(border):
        return part
    return grown(part, border, lambda points, normals: [points - depth * normals])


def grown(part, border, rings):
    """A part with strips along a border: `rings` says where each next row of points is, from the points of the border
    and the normals there."""
    ends = numpy.unique(border)
    numbers = numpy.full(len(part.points), -1)
    numbers[ends] = numpy.arange(len(ends))
    columns, faces, tags = [part.columns()], [part.faces], [part.tags]
    a, b = border.T
    base = len(part.points)
    for row in rings(part.points[ends], part.normals[ends]):
        new = part.columns()[ends]
        new[:, :3] = row
        columns.append(new)
        tags.append(part.tags[ends])
        next_a, next_b = numbers[border[:, 0]] + base, numbers[border[:, 1]] + base
        faces += [numpy.stack([b, a, next_a], axis=1), numpy.stack([b, next_a, next_b], axis=1)]
        a, b = next_a, next_b
        base += len(ends)
    return part.of_columns(numpy.concatenate(columns), numpy.concatenate(faces), numpy.concatenate(tags))
