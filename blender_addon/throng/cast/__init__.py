# SPDX-License-Identifier: Apache-2.0
"""The people that the add-on ships: a collection of pose meshes, made when it is first needed."""
from dataclasses import dataclass

from . import gait, people

VARIATIONS = len(people.CAST)
POSES = 24  # of each gait's cycle
BEATS = 4   # of each standing clip's round


@dataclass(frozen=True)
class Repertoire:
    """What everybody in a cast can do, and which pose is where: first the gaits, each a cycle, then the standing clips."""
    strides: tuple  # m, of each gait

    @property
    def walking(self):
        return len(self.strides) * POSES

    @property
    def count(self):
        return self.walking + len(gait.STANDING_CLIPS) * BEATS

    def walking_pose(self, gait_index, phase):
        return gait_index * POSES + min(POSES - 1, int((phase % 1.0) * POSES))

    def standing_pose(self, clip, beat):
        return self.walking + gait.STANDING_CLIPS.index(clip) * BEATS + beat


def pose_name(variation, pose):
    return f"throng_v{variation:02d}_p{pose:03d}"


def poses_of(person, repertoire):
    """All poses in order. Tall or small, everybody takes the bake's strides: feet must not slide."""
    build = people.build_of(person)
    gaits = [gait.gait_of(stride) for stride in repertoire.strides]
    return ([gait.walk_pose(index / POSES, build, each) for each in gaits for index in range(POSES)]
            + [gait.standing_pose(clip, beat / BEATS, build) for clip in gait.STANDING_CLIPS for beat in range(BEATS)])


def limb_velocities(before, after, seconds):
    """m/s of every vertex in the walker's own frame, from the poses before and after; flat, for foreach_set."""
    return [(b - a) / seconds for start, end in zip(before.vertices, after.vertices) for a, b in zip(start, end)]


def _velocities(figures, repertoire):
    """Limbs blur, too: each walking pose knows how fast its parts move at the gait's natural speed."""
    for index, stride in enumerate(repertoire.strides):
        speed = (stride / 1.249) ** 2  # shaders/gait.glsl
        seconds = 2.0 * stride / (speed * POSES)
        cycle = figures[index * POSES:(index + 1) * POSES]
        for pose in range(POSES):
            yield index * POSES + pose, limb_velocities(cycle[pose - 1], cycle[(pose + 1) % POSES], seconds)


def build_cast(variations, repertoire, library_name="Throng cast"):
    """A collection whose children, sorted by name, are variation * repertoire.count + pose."""
    import bpy

    from .materials import cast_materials

    collection = bpy.data.collections.new(library_name)
    materials = cast_materials(people.MATERIALS)
    for variation in range(variations):
        person = people.CAST[variation % VARIATIONS]
        figures = [people.build_figure(person, pose) for pose in poses_of(person, repertoire)]
        # Cryptomatte by asset goes by the parent: a person keeps its matte whatever the pose.
        holder = bpy.data.objects.new(f"Throng person {variation:02d}", None)
        meshes = []
        for index, figure in enumerate(figures):
            mesh = bpy.data.meshes.new(pose_name(variation, index))
            mesh.from_pydata(figure.vertices, [], figure.faces)
            for material in materials:
                mesh.materials.append(material)
            mesh.polygons.foreach_set("material_index", figure.materials)
            mesh.polygons.foreach_set("use_smooth", [True] * len(figure.faces))
            mesh.update()
            meshes.append(mesh)
            thing = bpy.data.objects.new(mesh.name, mesh)
            thing.parent = holder
            collection.objects.link(thing)
        for index, velocities in _velocities(figures, repertoire):
            meshes[index].attributes.new("velocity", "FLOAT_VECTOR", "POINT").data.foreach_set("vector", velocities)
    return collection
