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
    columns: tuple     # names of the attributes that turn with a bone: x, y and z
    changes: tuple     # and of those that say how fast they change, which only pictures that blur ask for
    blurs: object      # whether this is one, a socket
    joints: object     # geometry: points of all members' joints at rest
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
        rest = maths.math("MULTIPLY_ADD", maths.attribute(WHO, "INT"), float(JOINTS), number)
        rest = bones.sample(maths, self.joints, place(maths), rest)
        total = bones.sample(maths, self.points, place(maths), bone)
        for name, along in zip(self.columns, parts(maths, rest)):
            column = bones.sample(maths, self.points, maths.attribute(name, "FLOAT_VECTOR"), bone)
            total = vector(maths, "ADD", total, scaled(maths, column, along))
        return total

    def turned(self, maths, points, turn, centre, shift):
        """`points` with their columns turned, and their places, about `centre`, and then shifted. @param turn (vector,
        place to turn about) is the vector turned"""
        points = self._turned_columns(maths, points, self.columns, turn)
        points = maths.where(self.blurs, self._turned_columns(maths, points, self.changes, turn), points)
        put = maths.node("GeometryNodeSetPosition")
        maths.link(points, put.inputs["Geometry"])
        maths.link(vector(maths, "ADD", turn(place(maths), centre), shift), put.inputs["Position"])
        return put.outputs[0]

    @staticmethod
    def _turned_columns(maths, points, columns, turn):
        for name in columns:
            points = maths.store(points, name, turn(maths.attribute(name, "FLOAT_VECTOR"), None), "FLOAT_VECTOR")
        return points
