# SPDX-License-Identifier: Apache-2.0
"""A character as a member of a cast: which clip is what, which pose is which, and the meshes."""
from dataclasses import dataclass, field

import bpy
import numpy

from ..cast import BEATS, POSES
from ..cast.gait import STANDING_CLIPS
from ..cast.library import BLURS_UNTIL, walking_velocities
from ..cast.sheets import MOST_POINTS, Posed
from . import CharacterError, anatomy, clips, feet, motion, posing, roles
from .rig import Stage, rig_of

# What stands in where a character has no such clip.
_STANDING = {"idle": (roles.IDLE,), "shift": (roles.IDLE,), "talk": (roles.TALK, roles.IDLE),
             "phone": (roles.PHONE, roles.IDLE), "look": (roles.LOOK, roles.IDLE), "cheer": (roles.CHEER, roles.IDLE),
             "sit": (roles.SIT, roles.IDLE)}


@dataclass
class Report:
    """What was found and chosen, for whoever added the character."""
    name: str
    height: float
    scale: float
    heading: float
    gaits: list = field(default_factory=list)     # {stride, clip, natural, planted, slide: metres a step}
    standing: dict = field(default_factory=dict)  # the cast's clip: the character's
    held: list = field(default_factory=list)
    notes: list = field(default_factory=list)
    triangles: list = field(default_factory=list)  # of each level of detail

    def lines(self):
        found = [f"{self.name}: {self.height:.2f} m (scaled by {self.scale:.3g}), looks {self.heading:.0f} degrees "
                 f"from x, {' / '.join(str(count) for count in self.triangles)} triangles"]
        for gait in self.gaits:
            found.append(f"stride {gait['stride']:.2f} m: {gait['clip']} (its own: {gait['natural']:.2f} m), planted "
                         f"{100.0 * gait['planted']:.0f} %, slides {100.0 * gait['slide']:.1f} cm a step")
        found.append("stands: " + ", ".join(f"{ours} = {theirs}" for ours, theirs in self.standing.items()))
        if self.held:
            found.append("left out, because hands hold it: " + ", ".join(self.held))
        return found + self.notes


@dataclass
class Character:
    name: str
    levels: list  # of each level of detail, the Posed
    report: Report


def make(armature, repertoire, name, options):
    """Poses a character for all that a cast can do. Raises CharacterError; what it made until then is removed."""
    rig = rig_of(armature, options.leave_out, options.keep)
    with Stage(rig) as stage:
        reader = clips.Reader(stage, options)
        chosen, said = clips.choose(reader, rig.clips)
        cycles = clips.walks(reader, chosen, said)
        body = reader.body()
        report = Report(name, reader.height, reader.scale, reader.heading, held=rig.held, notes=reader.notes)
        plans = [motion.plan(_nearest(cycles, stride), body, stride) for stride in repertoire.strides]
        bones = [motion.pose_of(plan, body, index / POSES) for plan in plans for index in range(POSES)]
        bones += _standing(reader, chosen, cycles, body, report)
        bones += [bones[repertoire.walking()]] * (repertoire.poses() - repertoire.upright())  # nobody's own clips sit
        puppet = posing.Puppet(rig, stage, reader.placement)
        try:
            levels = _levels(puppet, reader, bones, repertoire, report, plans)
        finally:
            puppet.remove()
    return Character(name, levels, report)


def _nearest(cycles, stride):
    return min(cycles, key=lambda cycle: abs(numpy.log(stride / cycle.stride)))


def _standing(reader, chosen, cycles, body, report):
    """The bones of all standing poses. A cast's second way to stand is a second clip, or half a round later."""
    found = []
    for clip in STANDING_CLIPS:
        role = next((role for role in _STANDING.get(clip, (roles.IDLE,)) if chosen.get(role)), None)
        if role is None:
            found += [motion.standing_from_walk(cycles[0], body)] * BEATS
            report.standing[clip] = f"the mean of {cycles[0].name}"
            continue
        other = clip == "shift" and len(chosen[role]) > 1 and (
            roles.is_plain(chosen[role][1].name) or roles.IDLE in (reader.options.roles or {}))
        taken = chosen[role][1 if other else 0]
        poses = list(reader.standing(taken, BEATS))
        if clip == "shift" and not other:
            poses = poses[BEATS // 2:] + poses[:BEATS // 2]
        found += poses
        report.standing[clip] = taken.name
    return found


def _points(puppet, bones, repertoire):
    """For each level {number of a pose: where its vertices are}, of the poses that it has."""
    points = [{} for _ in posing.LEVELS]
    for index, pose in enumerate(bones):
        puppet.pose(pose)
        for level, posed in enumerate(points):
            if index in repertoire.sources(level):
                posed[index] = puppet.points(level)
                _check_size(len(posed[index]), repertoire.poses(level))
    return points


def _levels(puppet, reader, bones, repertoire, report, plans):
    points, made = _points(puppet, bones, repertoire), []
    try:
        for level, posed in enumerate(points):
            template = puppet.template(level, f"{report.name} {level}")
            made.append(Posed(template,
                              numpy.array([posed[source] for source in repertoire.sources(level)], numpy.float32)))
            _finish(made[level], level, repertoire)
            report.triangles.append(len(template.loop_triangles))
        for index, plan in enumerate(plans):
            _report_gait(report, reader, plan, numpy.array([points[0][index * POSES + pose] for pose in range(POSES)]))
    except BaseException:
        bpy.data.batch_remove([posed.mesh for posed in made])
        raise
    return made


def _finish(made, level, repertoire):
    """The velocities of a level that blurs, and the template's vertices where they are in the last pose."""
    if len(made.mesh.vertices) != made.points.shape[1]:
        raise CharacterError("the meshes lose or gain vertices when they are joined: apply their modifiers first")
    if level <= BLURS_UNTIL:
        made.velocities = walking_velocities(made.points, repertoire)
    made.mesh.vertices.foreach_set("co", made.points[-1].ravel())
    made.mesh.update()
    made.mesh.calc_loop_triangles()


def _report_gait(report, reader, plan, posed):
    """@param posed where the vertices are in the poses of the gait"""
    slide = max(feet.slide(posed[:, sole], plan.stride) for sole in _soles(reader, posed))
    report.gaits.append({"stride": plan.stride, "clip": plan.cycle.name, "natural": plan.cycle.stride,
                         "planted": plan.share, "slide": slide})
    notes = [f"{plan.cycle.name}: {note}" for note in plan.cycle.notes]
    report.notes += [note for note in notes if note not in report.notes]


def _check_size(vertices, poses):
    if poses * vertices > MOST_POINTS:
        raise CharacterError(f"{vertices} vertices are too many: a cast of {poses} poses takes up to "
                             f"{MOST_POINTS // poses}; decimate its meshes first")


def _soles(reader, posed):
    """Which vertices of the pose meshes are of each foot: what its bones move; where modifiers have made other
    vertices, what comes near the ground on its side."""
    if posed.shape[1] == len(reader.main):
        return [numpy.isin(reader.main, anatomy.below(leg.foot, reader.stage.parents)) for leg in reader.legs]
    near, left = posed[..., 2].min(axis=0) < 0.05, posed[..., 1].mean(axis=0) > 0.0
    return [near & ~left, near & left]
