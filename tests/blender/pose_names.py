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

        self.names = {}
        for figure in bpy.data.objects:
            if "throng_member" in figure:
                sheet = _points(_nodes().get_input(figure.modifiers["throng poses"], "Sheet").data)
                for pose, points in enumerate(sheet.reshape(-1, 3 * len(figure.data.vertices))):
                    name = pose_name(figure["throng_member"], pose, figure["throng_level"])
                    self.names.setdefault(points.tobytes(), []).append(name)

    def of(self, mesh):
        """The names of all poses that look like this one, | between them: who stands is twice the same in a round."""
        found = self.names.get(_points(mesh).tobytes())
        first = mesh.vertices[0].co[:]
        assert found, f"{mesh.name}: {len(mesh.vertices)} vertices, no figure's pose; the first at {first}"
        return "|".join(found)
