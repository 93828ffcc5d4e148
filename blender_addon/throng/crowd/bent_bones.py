# SPDX-License-Identifier: Apache-2.0
"""The bones of the people who are bent (near.py), as points: what legs.py, trunks.py and heads.py work on."""
from dataclasses import dataclass

from ..blender.vectors import index, parts, place, scaled, vector
from ..cast import bones
from .names import WHO

JOINTS = 8  # a member, as cast.bones.Boned has them


@dataclass
class BentBones:
    points: object     # geometry: a point for each bone, in the scene, one person's behind the other's
    columns: tuple     # names of the attributes that turn with a bone: x, y and z first
    sheet: object      # geometry: points of all members' bones in all poses, and then their joints at rest
    first_joint: int   # the first joint's number in it
    count: int         # bones a person
    limbs: list        # their numbers, as cast.bones.LIMBS has them
    trunk: object      # shares, as cast.bones.TRUNK has them; or None

    def person(self, maths):
        """At points of bones: whose it is, by number."""
        return maths.math("FLOOR", maths.math("DIVIDE", maths.math("ADD", index(maths), 0.5), float(self.count)))

    def joint(self, maths, person, bone, number):
        """Where somebody's joint is in the scene.

        At points with WHO. @param person by number; @param bone that the joint is the upper end of; @param number of
        the joint
        """
        bone = maths.math("ADD", maths.math("MULTIPLY", person, float(self.count)), bone)
        rest = maths.math("MULTIPLY_ADD", maths.attribute(WHO, "INT"), float(JOINTS),
                          maths.math("ADD", number, float(self.first_joint)))
        rest = bones.sample(maths, self.sheet, place(maths), rest)
        total = bones.sample(maths, self.points, place(maths), bone)
        for name, along in zip(self.columns[:3], parts(maths, rest)):
            column = bones.sample(maths, self.points, maths.attribute(name, "FLOAT_VECTOR"), bone)
            total = vector(maths, "ADD", total, scaled(maths, column, along))
        return total

    def turned(self, maths, points, turn, centre, shift):
        """`points` with their columns turned, and their places, about `centre`, and then shifted. @param turn (vector,
        place to turn about) is the vector turned"""
        for name in self.columns:
            points = maths.store(points, name, turn(maths.attribute(name, "FLOAT_VECTOR"), None), "FLOAT_VECTOR")
        put = maths.node("GeometryNodeSetPosition")
        maths.link(points, put.inputs["Geometry"])
        maths.link(vector(maths, "ADD", turn(place(maths), centre), shift), put.inputs["Position"])
        return put.outputs[0]
