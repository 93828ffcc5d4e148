# SPDX-License-Identifier: Apache-2.0
"""What layers take from the scene, in the world of the bake: the cursor, outlines, the camera."""
from mathutils import Matrix, Vector

from ..formats import BakeError


def to_world(crowd, origin):
    """From the scene to the world of the bake, wherever the crowd has been put."""
    shift = tuple(origin) + (0.0,) * (3 - len(origin))
    return Matrix.Translation(shift) @ crowd.matrix_world.inverted()


def rounded(values, digits=4):
    return [round(float(value), digits) for value in values]


def bake_frame(crowd, scene_frame):
    """The bake's frame that a frame of the scene shows, or the nearest that it has."""
    return max(0, int(scene_frame - crowd.modifiers["throng pos"].frame_start))


def outline(thing, matrix):
    """The corners of a curve's first spline, or of the outer edge of a mesh, seen from above."""
    if thing is None or thing.type not in ("MESH", "CURVE"):
        raise BakeError("select the mesh or the curve that is the region, and make it the active object")
    points = _of_curve(thing) if thing.type == "CURVE" else _of_mesh(thing)
    if len(points) < 3:
        raise BakeError(f"{thing.name} has no outline of three corners or more")
    return [rounded((matrix @ thing.matrix_world @ Vector(point))[:2]) for point in points]


def _of_curve(thing):
    spline = thing.data.splines[0] if thing.data.splines else None
    if spline is None:
        return []
    return [point.co[:3] for point in (spline.bezier_points if spline.type == "BEZIER" else spline.points)]


def _of_mesh(thing):
    """Round the edges that have one face, or all edges where there are no faces."""
    mesh, faces = thing.data, {}
    for polygon in mesh.polygons:
        for key in polygon.edge_keys:
            faces[key] = faces.get(key, 0) + 1
    edges = [edge.key for edge in mesh.edges if faces.get(edge.key, 0) == (1 if faces else 0)]
    beside = {}
    for a, b in edges:
        beside.setdefault(a, []).append(b)
        beside.setdefault(b, []).append(a)
    if not beside:
        return []
    way, before = [min(beside)], None
    while True:
        following = next((each for each in beside[way[-1]] if each != before and each not in way[1:]), None)
        if following is None or following == way[0]:
            return [mesh.vertices[index].co for index in way]
        before = way[-1]
        way.append(following)


def view_of(scene, camera, matrix):
    """A camera as `throng apply` knows it: where it is now, and what it sees 1 m away."""
    corners = camera.data.view_frame(scene=scene)
    parallel = camera.data.type == "ORTHO"
    if camera.data.type == "PANO":
        raise BakeError("a panoramic camera sees everybody around it: there is no picture to select by")
    far = 1.0 if parallel else -corners[0].z
    across, up = ([corner[axis] / far for corner in corners] for axis in (0, 1))
    view = {"matrix": [value for row in matrix @ camera.matrix_world for value in rounded(row, 6)],
            "size": rounded((max(across) - min(across), max(up) - min(up)), 6)}
    shift = rounded((0.5 * (max(across) + min(across)), 0.5 * (max(up) + min(up))), 6)
    if any(shift):
        view["shift"] = shift
    if parallel:
        view["parallel"] = True
    return view


def views(scene, crowd, matrix, frames, step):
    """Views of the scene's camera over some frames of the bake: one where it stands still."""
    camera, now = scene.camera, scene.frame_current
    if camera is None:
        raise BakeError("the scene has no camera")
    start, found = int(crowd.modifiers["throng pos"].frame_start), []
    try:
        for frame in range(frames[0], frames[1] + 1, max(step, 1)):
            scene.frame_set(start + frame)
            view = view_of(scene, scene.camera, matrix)
            if not found or any(found[-1].get(key) != view.get(key) for key in ("matrix", "size", "shift")):
                found.append({"frame": frame, **view})
    finally:
        scene.frame_set(now)
    return found
