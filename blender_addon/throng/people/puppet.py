# SPDX-License-Identifier: Apache-2.0
"""People shaped from bodies on the simple skeleton of heroes (overrides/skeleton.py): each of its bones takes what
hangs on several of the library's."""
import numpy

from ..cast import gait
from . import levels, members
from .rig import skinned

# bone of the hero: (the library's that leads, those that go with it, the joint where it ends)
_LED = {"hips": ("pelvis", ("Root", "pelvis"), "spine_01"), "spine": ("spine_03", ("spine", "clavicle"), "neck_01"),
        "head": ("head", ("neck", "head"), None)}
for _side in "RL":
    _s = _side.lower()
    for _name, _lead, _with, _end in (
            ("upper_arm", "upperarm", ("upperarm",), "lowerarm"),
            ("forearm", "lowerarm", ("lowerarm", "hand", "index", "middle", "ring", "pinky", "thumb"), "hand"),
            ("thigh", "thigh", ("thigh",), "calf"), ("shank", "calf", ("calf",), "foot"),
            ("foot", "foot", ("foot", "ball"), "ball")):
        _LED[f"{_name}.{_side}"] = (f"{_lead}_{_s}", _with, f"{_end}_{_s}")


class Puppet:
    """A member of a cast as a hero."""

    def __init__(self, role):
        self.maker = members.maker_of(role)
        self.rig, self.look = self.maker.rig, self.maker.person.look
        self.build = self.rig.build
        self.rest = gait.idle_pose(self.build)
        self.model = self.maker.model(levels.NEAR)

    def bones(self, pose, bone):
        """{name: bone} in a pose; `bone` makes one of a head, a tail and what is beside it."""
        return self.bones_at(self.rig.matrices(pose), bone)

    def bones_at(self, matrices, bone):
        """The same where the library's bones are known."""
        found = {}
        place = lambda lead, point: matrices[self.rig.bodies.bone[lead]] @ numpy.append(point, 1.0)
        for name, (lead, _, end) in _LED.items():
            tail = self.rig.tails[lead] if end is None else self.rig.heads[end]
            start = self.rig.heads["spine_01"] if name == "spine" else self.rig.heads[lead]
            # a bone turns as the one that leads it does: its sides are carried along from the rest
            beside = matrices[self.rig.bodies.bone[lead]][:, :3] @ self._beside(name, lead)
            found[name] = bone(tuple(place("spine_01" if name == "spine" else lead, start)), tuple(place(lead, tail)),
                               tuple(beside))
        return found

    def _beside(self, name, lead):
        """To the left in the rest pose of heroes, as the library's rest pose has it."""
        rest = self.rig.matrices(self.rest)[self.rig.bodies.bone[lead]][:, :3]
        return rest.T @ numpy.array([0.0, 1.0, 0.0])

    def vertices(self, moves=0.0):
        """In the rest pose. @param moves (V, 3) m before that, of the model's points"""
        return skinned(self.model.points + moves, self.model.weights, self.rig.matrices(self.rest)[None])[0]

    def weights(self, names):
        """(V, bones) in the order of the names."""
        found = numpy.zeros((len(self.model.points), len(names)))
        for number, bone in enumerate(self.rig.bodies.bones):
            leader = "forearm.R" if bone == "Root" else _leader(bone)  # what hangs on it is in the hand
            found[:, names.index(leader)] += self.model.weights[:, number]
        return found


def _leader(bone):
    """The hero's bone that one of the library's goes with."""
    side = {"_l": ".L", "_r": ".R"}.get(bone[-2:], "")
    return next(name for name, (_, led, _) in _LED.items()
                if bone.startswith(led) and (name.endswith(side) or "." not in name))
