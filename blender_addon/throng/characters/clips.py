# SPDX-License-Identifier: Apache-2.0
"""Reads clips: which is the cycle, where the feet go, which way it walks. Works on a rig.Stage; the maths
is in feet and motion."""
from dataclasses import dataclass

import numpy

from . import CharacterError, anatomy, feet, motion, roles
from .skin import skinned

STANDS_ABOUT = (1.3, 2.1)  # m: characters of such a height keep it
HEIGHT = 1.75              # m, of others
HEADINGS = {"X": 0.0, "Y": 90.0, "-X": 180.0, "-Y": -90.0}


@dataclass
class Options:
    """What a user says; empty or zero is found automatically."""
    roles: dict = None     # {role: [(clip's name, stride in m or 0)]}
    leave_out: str = ""
    keep: str = ""
    height: float = 0.0    # m
    heading: str = "AUTO"  # or one of HEADINGS: the way that the character looks as it is in the file
    feet: tuple = ()       # names of both feet's bones


class Reader:
    """Everything that is found out about a character before it is posed."""

    def __init__(self, stage, options):
        self.stage, self.options = stage, options
        self.notes = []
        self.skin = stage.skin()
        self.main = self.skin.bones[numpy.arange(len(self.skin.bones)), self.skin.weights.argmax(axis=1)]
        rest = stage.rest_pose()
        points = skinned(self.skin, numpy.nonzero(self.skin.weights.sum(axis=1) > 0.0)[0], rest, stage.rest)
        main = self.main[self.skin.weights.sum(axis=1) > 0.0]
        all_points = numpy.zeros((len(self.main), 3))
        all_points[self.skin.weights.sum(axis=1) > 0.0] = points
        self.legs = anatomy.find_legs(stage.names, stage.parents, rest[:, :3, 3], points, main, options.feet)
        self._keep_soles(all_points)
        tall = float(numpy.ptp(points[:, 2]))
        self.height = options.height or (tall if STANDS_ABOUT[0] <= tall <= STANDS_ABOUT[1] else HEIGHT)
        self.scale = self.height / tall
        self.tolerance = 0.004 * self.height
        self.placement = numpy.diag([self.scale, self.scale, self.scale, 1.0])
        self.hips = [leg.hip for leg in self.legs]
        self._raw = {}

    def _keep_soles(self, points):
        """Soles as indices into the whole skin, not into what has weights."""
        with_weight = numpy.nonzero(self.skin.weights.sum(axis=1) > 0.0)[0]
        self.legs = [anatomy.Leg(leg.hip, leg.knee, leg.foot, with_weight[leg.soles]) for leg in self.legs]

    def body(self):
        offspring = []
        for leg in self.legs:
            foot = anatomy.below(leg.foot, self.stage.parents)
            knee = [] if leg.knee is None else anatomy.below(leg.knee, self.stage.parents)
            shin = [b for b in knee if b not in foot]
            thigh = [b for b in anatomy.below(leg.hip, self.stage.parents) if b not in foot and b not in shin]
            offspring.append((thigh, shin, foot))
        return motion.Body(self.stage.parents, self.legs, offspring, self.tolerance)

    def _sample(self, clip, start, length, count):
        """count + 1 samples over a length of frames; a clip that stops one frame short of its beginning is closed."""
        first, last = clip.range
        frames = start + length * numpy.arange(count + 1) / count
        bones = self.stage.sample(clip, numpy.minimum(frames, last))
        beyond = frames > last + 1e-6
        if beyond.any():
            ends = self.stage.sample(clip, [first])[0]
            final = self.stage.sample(clip, [last])[0]
            for index in numpy.nonzero(beyond)[0]:
                blend = min(1.0, frames[index] - last)
                bones[index] = (1.0 - blend) * final + blend * ends
        return self.placement @ bones

    def _shape(self, bones):
        """(N, D): where the joints that carry vertices are, from the hips."""
        hips = motion.joints(bones, self.hips).mean(axis=1, keepdims=True)
        return (motion.joints(bones, numpy.unique(self.main)) - hips).reshape(len(bones), -1)

    def cycle_bones(self, clip):
        """(bones (SAMPLES, B, 4, 4) of one cycle, frames of it, notes). Not yet turned into the heading."""
        if clip.name in self._raw:
            return self._raw[clip.name]
        count, notes = motion.SAMPLES, []
        first, last = clip.range
        length = last - first
        if length < 1.0:
            return None
        bones = self._sample(clip, first, length, count)
        shape = self._shape(bones)
        swing = numpy.sqrt(((shape - shape.mean(axis=0)) ** 2).mean())
        seam = numpy.sqrt(((shape[-1] - shape[0]) ** 2).mean())
        a_frame = numpy.sqrt(((shape[1:] - shape[:-1]) ** 2).mean()) * count / length
        start = first
        if swing > 1e-6 and seam > 0.12 * swing:
            if length >= 8 and seam < 1.6 * a_frame:
                length += 1.0  # its last frame is the one before its first
            else:
                start, length, seam = self._best_window(shape, first, length)
                if seam > 0.2 * swing:
                    notes.append(f"does not come round: a seam of {100.0 * seam:.1f} cm remains")
                else:
                    notes.append(f"comes round from frame {start:.0f} to {start + length:.0f} only")
            bones = self._sample(clip, start, length, count)
            shape = self._shape(bones)
        rounds = feet.cycles_in(shape[:-1])
        if rounds > 1:
            notes.append(f"holds {rounds} cycles")
            length /= rounds
            bones = self._sample(clip, start, length, count)
        still, way = motion.without_drift(bones, self.hips)
        if numpy.linalg.norm(way) > 0.05 * self.height:
            notes.append(f"goes {numpy.linalg.norm(way):.2f} m a cycle: taken out")
        self._raw[clip.name] = (still[:-1], length, notes)
        return self._raw[clip.name]

    def _best_window(self, shape, first, length):
        count = len(shape) - 1
        least, best = numpy.inf, (0, count)
        for i in range(0, count * 2 // 3):
            for j in range(i + count // 4, count):
                apart = shape[j] - shape[i], (shape[j + 1] - shape[j]) - (shape[i + 1] - shape[i])
                cost = numpy.sqrt((apart[0] ** 2).mean()) + 2.0 * numpy.sqrt((apart[1] ** 2).mean())
                if cost < least:
                    least, best = cost, (i, j)
        i, j = best
        seam = float(numpy.sqrt(((shape[j] - shape[i]) ** 2).mean()))
        return first + length * i / count, length * (j - i) / count, seam

    def soles(self, bones):
        """The points of both soles over bones (N, B, 4, 4)."""
        scaled_rest = self.stage.rest
        return [skinned(self.skin, leg.soles, bones, scaled_rest) for leg in self.legs]

    def find_heading(self, walking):
        """Degrees; by the user, by how the feet of walks push, or by where the toes are."""
        if self.options.heading != "AUTO":
            return HEADINGS[self.options.heading]
        pushed, sure = numpy.zeros(2), 0.0
        for clip in walking:
            read = self.cycle_bones(clip)
            if read is not None:
                way = feet.heading_of(self.soles(read[0]), self.tolerance)
                if numpy.linalg.norm(way) > 0.5:
                    pushed += way
                    sure += 1.0
        if sure == 0.0:
            rest = self.placement @ self.stage.rest_pose()
            toes = numpy.zeros(2)
            for leg, points in zip(self.legs, self.soles(rest[None])):
                toes += points[0, :, :2].mean(axis=0) - rest[leg.foot, :2, 3]
            pushed = toes
            self.notes.append("the heading is where the toes point: no clip's feet tell it")
        degrees = float(numpy.degrees(numpy.arctan2(pushed[1], pushed[0])))
        axis = round(degrees / 90.0) * 90.0
        return axis if abs(degrees - axis) < 25.0 else degrees

    def turn_to(self, degrees):
        """From now on x is forward; right leg first."""
        self.heading = (degrees + 180.0) % 360.0 - 180.0
        angle = numpy.radians(-degrees)
        turn = numpy.eye(4)
        turn[:2, :2] = [[numpy.cos(angle), -numpy.sin(angle)], [numpy.sin(angle), numpy.cos(angle)]]
        self.placement = turn @ self.placement
        self._raw = {name: read and (turn @ read[0], *read[1:]) for name, read in self._raw.items()}
        rest = self.placement @ self.stage.rest_pose()
        if rest[self.legs[0].foot, 1, 3] > rest[self.legs[1].foot, 1, 3]:
            self.legs.reverse()
            self.hips.reverse()

    def cycle(self, clip, stride=0.0):
        """A motion.Cycle, or a sentence that says why the clip is none."""
        read = self.cycle_bones(clip)
        if read is None:
            return "it has one frame only"
        bones, length, notes = read[0].copy(), read[1], list(read[2])
        bones = self._in_place(bones)
        soles = self.soles(bones)
        found = []
        for leg, points in zip(self.legs, soles):
            stance = feet.stance_of(points, self.tolerance)
            if stance is None or stance.stride < 0.1 * self.height:
                return "its feet do not push backwards on the ground: it does not walk forwards"
            if not 0.08 < stance.length < 0.9:
                return f"a foot is on the ground for {100.0 * stance.length:.0f} % of the cycle"
            if stride:
                stance = feet.Stance(stance.down, stance.length, stride)
            found.append(feet.foot_of(bones[:, leg.foot, :3, 3], points, stance, bones[:, leg.hip, :3, 3]))
        apart = (found[1].under - found[0].under) % 1.0
        if not 0.3 < apart < 0.7:
            return f"its feet are {apart:.2f} of a cycle apart, not half of one"
        return motion.Cycle(clip.name, bones, found, length, notes)

    def _in_place(self, bones):
        """Hips over the origin on average, soles on the ground."""
        bones[:, :, :2, 3] -= motion.joints(bones, self.hips).mean(axis=(0, 1))[:2]
        low = [points[..., 2].min(axis=1) for points in self.soles(bones)]
        bones[:, :, 2, 3] -= numpy.percentile(numpy.minimum(*low), 20.0)
        return bones

    def standing(self, clip, beats):
        """(beats, B, 4, 4): moments of a clip that stands, sits or cheers, its feet about the origin."""
        first, last = clip.range
        frames = first + (last - first) * numpy.arange(beats) / beats
        bones = self.placement @ self.stage.sample(clip, frames)
        bones[:, :, :2, 3] -= motion.joints(bones, [leg.foot for leg in self.legs]).mean(axis=(0, 1))[:2]
        bones[:, :, 2, 3] -= min(points[..., 2].min() for points in self.soles(bones))
        return bones

    def stands_still(self, clip):
        """Whether the feet hardly move and the hips are high: somebody stands."""
        first, last = clip.range
        if last - first < 4.0:
            return False
        bones = self.placement @ self.stage.sample(clip, numpy.linspace(first, last, 9))
        rest = self.placement @ self.stage.rest_pose()
        ankles, high = motion.joints(bones, [leg.foot for leg in self.legs]), []
        for pose in (bones, rest):
            high.append(motion.joints(pose, self.hips)[..., 2].mean()
                        - motion.joints(pose, [leg.foot for leg in self.legs])[..., 2].mean())
        upright = high[0] / max(1e-6, high[1])
        moves = bones[..., :3, 3] - bones[0, :, :3, 3]
        return bool(numpy.ptp(ankles, axis=0).max() < 0.03 * self.height and upright > 0.85
                    and numpy.abs(moves).max() > 1e-4 * self.height)


def _clip_named(name, role, by_name):
    if name in by_name:
        return by_name[name]
    near = [each for each in by_name if name.lower() in each.lower()] or by_name
    known = ", ".join(sorted(near)[:12])
    raise CharacterError(f"there is no clip {name} (asked for as {role}): there are "
                         f"{known}{' ...' if len(near) > 12 else ''}")


def _asked_for(asked, by_name):
    """({role: [clips]}, {clip's name: stride}) of what the user says."""
    chosen, strides = {}, {}
    for role, entries in asked.items():
        for name, stride in entries:
            chosen.setdefault(role, []).append(_clip_named(name, role, by_name))
            if stride:
                strides[name] = stride
    return chosen, strides


def choose(reader, clips):
    """({role: [clips]}, {clip's name: stride that the user said}): by the user, by name, by motion."""
    by_name = {clip.name: clip for clip in clips}
    chosen, strides = _asked_for(reader.options.roles or {}, by_name)
    for role, names in roles.clips_by_role(list(by_name)).items():
        chosen.setdefault(role, [by_name[name] for name in names])
    everyday = [clip for clip in clips if not roles.says_otherwise(clip.name)]
    if roles.WALK not in chosen and roles.RUN not in chosen:
        chosen[roles.WALK] = everyday
        reader.notes.append("no clip's name says that it walks: their feet were asked")
    if roles.IDLE not in chosen:
        still = [clip for clip in everyday if reader.stands_still(clip)]
        if still:
            chosen[roles.IDLE] = still
    return chosen, strides


def walks(reader, chosen, strides):
    """The cycles of all clips that walk or run. Raises CharacterError when there is none."""
    asked = list(dict.fromkeys(clip.name for clip in chosen.get(roles.WALK, []) + chosen.get(roles.RUN, [])))
    by_name = {clip.name: clip for clips in chosen.values() for clip in clips}
    asked = [by_name[name] for name in asked]
    reader.turn_to(reader.find_heading(asked))
    cycles, refused = [], []
    for clip in asked:
        found = reader.cycle(clip, strides.get(clip.name, 0.0))
        if isinstance(found, str):
            refused.append(f"{clip.name}: {found}")
        else:
            cycles.append(found)
    if not cycles:
        why = "; ".join(refused[:4]) or "no clip's name says that it walks"
        raise CharacterError(f"no clip walks ({why}). Name one: a walk on the spot or with root motion, "
                             "forwards, that comes round")
    reader.notes.extend(f"not used: {each}" for each in refused if len(chosen.get(roles.WALK, [])) < 8)
    return cycles
