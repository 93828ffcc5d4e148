# SPDX-License-Identifier: Apache-2.0
"""Where takes come from in Blender: files, and armatures with actions."""
import os
from contextlib import contextmanager
from dataclasses import replace

import numpy

from ..characters import files, roles
from ..characters.rig import Rig, Stage, clips_of
from . import MotionError, bvh, takes
from .takes import Take

ENDINGS = (".bvh", ".glb", ".gltf")
WALKS = (roles.WALK, roles.RUN)
KINDS = (*WALKS, roles.IDLE, roles.TALK, roles.PHONE)


class Source:
    """Clips by name, each read when it is asked for."""

    def __init__(self, name, reads, z_up):
        self.name, self.reads, self.z_up = name, reads, z_up

    def take(self, clip):
        return replace(self.reads[clip](), name=clip)

    def chosen(self, wanted=""):
        """[(clip's name, what it is for, by its name, or "")] of those to take: what the user says; the plainest of
        each kind that names tell of; the only one; or all, to be asked by what they do."""
        names = list(self.reads)
        if wanted:
            if wanted not in self.reads:
                raise MotionError(f"{self.name} has no clip {wanted}: there are {', '.join(sorted(names)[:12])}")
            return [(wanted, roles.role_of(wanted)[0] or "")]
        by_role = {role: found[0] for role, found in roles.clips_by_role(names).items() if role in KINDS}
        if by_role:
            return [(name, role) for role, name in by_role.items()]
        return [(name, "") for name in names]


@contextmanager
def of_file(context, path):
    """The Source of a file; what the file brings into the scene is gone afterwards."""
    ending = os.path.splitext(path)[1].lower()
    if ending not in ENDINGS:
        raise MotionError(f"{os.path.basename(path)} is no file of motion: choose one of {', '.join(ENDINGS)}")
    if ending == ".bvh":
        take = bvh.read(path)
        yield Source(os.path.basename(path), {take.name: lambda: take}, False)
        return
    with files.imported(context, path) as armature:
        yield of_armature(context, armature, os.path.splitext(os.path.basename(path))[0])


def of_armature(context, armature, name=""):
    """The Source of an armature in the scene."""
    name, clips = name or armature.name, clips_of(armature)
    if not clips:
        raise MotionError(f"{name} has no clips: an action on its bones is needed")
    rate = context.scene.render.fps / context.scene.render.fps_base
    reads = {clip.name: lambda clip=clip: _take(armature, clip, rate) for clip in clips}
    if len(reads) == 1:
        reads = {_named(name, clip): read for clip, read in reads.items()}
    return Source(name, reads, True)


def _named(name, clip):
    """A clip's name, where it says what it is for; else that of what it comes from."""
    return clip if roles.role_of(clip)[0] else name


def _take(armature, clip, rate):
    first, last = clip.range
    frames = numpy.arange(first, min(last, first + takes.LONGEST * rate) + 0.5)
    with Stage(Rig(armature, [], [clip])) as stage:
        world = numpy.array(armature.matrix_world)
        tails = numpy.array([[*bone.tail_local, 1.0] for bone in stage.bones]) @ world.T
        return Take(clip.name, tuple(stage.names), tuple(stage.parents), stage.rest_pose(), tails[:, :3],
                    stage.sample(clip, frames), rate)
