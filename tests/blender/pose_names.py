# SPDX-License-Identifier: Apache-2.0
"""Which pose of the cast an instance is, told by its vertices alone. Runs inside Blender, also without the add-on."""
import importlib.util
import pathlib

import numpy


def pose_name(member, pose, level=0):
    return f"m{member:02d}_p{pose:03d}" + (f"_l{level}" if level else "")


def _points(mesh):
    flat = numpy.empty(3 * len(mesh.vertices), numpy.float32)
    mesh.vertices.foreach_get("co", flat)
    return flat


def _nodes():
    """The add-on's helpers over modifiers' inputs, which versions keep elsewhere; they need nothing else of it."""
    path = pathlib.Path(__file__).resolve().parents[2] / "blender_addon/throng/blender/nodes.py"
    described = importlib.util.spec_from_file_location("helpers_over_nodes", path)
    module = importlib.util.module_from_spec(described)
    described.loader.exec_module(module)
    return module


class Names:
    """Of all figures in the file, as they are when this is made."""

    def __init__(self):
        import bpy  # pose_name() is for tests without a Blender, too

        self.names, self.boned = {}, []
        for figure in bpy.data.objects:
            if "throng_sources" in figure:
                self._add_boned(figure)
            elif "throng_member" in figure:
                sheet = _points(_nodes().get_input(figure.modifiers["throng poses"], "Sheet").data)
                for pose, points in enumerate(sheet.reshape(-1, 3 * len(figure.data.vertices))):
                    name = pose_name(figure["throng_member"], pose, figure["throng_level"])
                    self.names.setdefault(points.tobytes(), []).append(name)

    def _add_boned(self, figure):
        """One whose poses nodes work out: as the add-on works them out without any, which is the same but for rounding.
        """
        from throng.cast import sheets

        poses = sheets.points_of(figure)
        names = [pose_name(figure["throng_member"], pose, figure["throng_level"]) for pose in range(len(poses))]
        self.boned.append((poses.reshape(len(poses), -1), names))

    def of(self, mesh):
        """The names of all poses that look like this one, | between them: who stands is twice the same in a round."""
        points = _points(mesh)
        found = self.names.get(points.tobytes())
        for poses, names in self.boned if not found else ():
            if poses.shape[1] == len(points) and numpy.abs(poses[0] - points).max() < 2.0:
                found = [name for pose, name in zip(poses, names) if numpy.abs(pose - points).max() < 1e-5] or found
        first = mesh.vertices[0].co[:]
        assert found, f"{mesh.name}: {len(mesh.vertices)} vertices, no figure's pose; the first at {first}"
        return "|".join(found)
