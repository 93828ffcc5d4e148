# SPDX-License-Identifier: Apache-2.0
"""Which vertices of a mesh to merge into which neighbours, in what order, to make it coarser and coarser.

Vertices are only merged, never moved, and the least change first, by the distance to the planes that met there (the
quadrics of Garland and Heckbert 1997). What comes out is an order, so one reckoning serves all levels of detail and all
shapes of one mesh, and no level has a crack: a merged mesh is as closed as the full one.
"""
import heapq
import math

FLIPS = 0.25      # the least cosine between a triangle's normals before and after
BOUNDARY = 30.0   # how much more an edge of an open mesh weighs than a face


def _sub(a, b):
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]


def _cross(a, b):
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def _dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def _plane(normal, point, weight):
    """The ten numbers of a plane's quadric."""
    x, y, z = normal
    d = -_dot(normal, point)
    return [weight * value for value in (x * x, x * y, x * z, x * d, y * y, y * z, y * d, z * z, z * d, d * d)]


def _error(q, p):
    x, y, z = p
    return (q[0] * x * x + q[4] * y * y + q[7] * z * z + q[9]
            + 2.0 * (q[1] * x * y + q[2] * x * z + q[3] * x + q[5] * y * z + q[6] * y + q[8] * z))


class _Mesh:
    def __init__(self, points, triangles, weights):
        self.points, self.weights = points, weights
        self.triangles = [list(each) for each in triangles]
        self.faces = {}      # of each vertex
        for number, corners in enumerate(self.triangles):
            for vertex in corners:
                self.faces.setdefault(vertex, set()).add(number)
        self.quadrics = {vertex: [0.0] * 10 for vertex in self.faces}
        for corners in self.triangles:
            self._add_face(corners)
        self.borders = set()
        for (a, b), faces in self._edges().items():
            if len(faces) == 1:
                self.borders.update((a, b))
                self._add_border(a, b, faces[0])

    def _edges(self):
        edges = {}
        for number, (a, b, c) in enumerate(self.triangles):
            for edge in ((a, b), (b, c), (c, a)):
                edges.setdefault((min(edge), max(edge)), []).append(number)
        return edges

    def normal(self, corners):
        """Twice as long as the triangle is large."""
        a, b, c = (self.points[vertex] for vertex in corners)
        return _cross(_sub(b, a), _sub(c, a))

    def _add(self, vertex, plane):
        self.quadrics[vertex] = [one + other for one, other in zip(self.quadrics[vertex], plane)]

    def _add_face(self, corners):
        normal = self.normal(corners)
        size = math.sqrt(_dot(normal, normal))
        if size > 0.0:
            plane = _plane([value / size for value in normal], self.points[corners[0]], 0.5 * size)
            for vertex in corners:
                self._add(vertex, plane)

    def _add_border(self, a, b, face):
        """A plane along an open edge, upright on the face: the edge should stay where it is."""
        along = _sub(self.points[b], self.points[a])
        across = _cross(along, self.normal(self.triangles[face]))
        size = math.sqrt(_dot(across, across))
        if size > 0.0:
            plane = _plane([value / size for value in across], self.points[a], BOUNDARY * _dot(along, along))
            self._add(a, plane)
            self._add(b, plane)

    def neighbours(self, vertex):
        found = set()
        for face in self.faces[vertex]:
            found.update(self.triangles[face])
        found.discard(vertex)
        return found

    def cost(self, gone, kept):
        both = [one + other for one, other in zip(self.quadrics[gone], self.quadrics[kept])]
        length = math.dist(self.points[gone], self.points[kept])
        # where all is flat, short edges go first
        return self.weights[gone] * (_error(both, self.points[kept]) + 1e-5 * length ** 4)

    def may_merge(self, gone, kept):
        shared = self.faces[gone] & self.faces[kept]
        common = self.neighbours(gone) & self.neighbours(kept)
        if not shared or len(common) != len(shared):
            return False  # what touches in one place only would be glued together
        if gone in self.borders and (kept not in self.borders or len(shared) != 1):
            return False
        for face in self.faces[gone] - shared:
            before = self.normal(self.triangles[face])
            after = self.normal([kept if vertex == gone else vertex for vertex in self.triangles[face]])
            if _dot(before, after) < FLIPS * math.sqrt(_dot(before, before) * _dot(after, after)) + 1e-18:
                return False
        return True

    def merge(self, gone, kept):
        for face in self.faces.pop(gone):
            corners = self.triangles[face]
            if kept in corners:
                for vertex in corners:
                    if vertex != gone:
                        self.faces[vertex].discard(face)
            else:
                corners[corners.index(gone)] = kept
                self.faces[kept].add(face)
        self._add(kept, self.quadrics.pop(gone))


def merge_order(points, triangles, weights, until):
    """[(vertex, the neighbour that it is merged into)], the least change first, until so many vertices are left.

    @param weights how much each vertex' own change counts
    """
    mesh = _Mesh([tuple(point) for point in points], triangles, weights)
    heap = [(mesh.cost(a, b), a, b) for vertex in mesh.faces for a, b in ((vertex, n) for n in mesh.neighbours(vertex))]
    heapq.heapify(heap)
    order = []
    while heap and len(mesh.faces) > until:
        cost, gone, kept = heapq.heappop(heap)
        if gone not in mesh.faces or kept not in mesh.faces or kept not in mesh.neighbours(gone):
            continue
        now = mesh.cost(gone, kept)
        if now > cost * 1.0001 + 1e-18:
            heapq.heappush(heap, (now, gone, kept))
            continue
        if not mesh.may_merge(gone, kept):
            continue
        mesh.merge(gone, kept)
        order.append((gone, kept))
        for other in mesh.neighbours(kept):
            heapq.heappush(heap, (mesh.cost(kept, other), kept, other))
            heapq.heappush(heap, (mesh.cost(other, kept), other, kept))
    return order
