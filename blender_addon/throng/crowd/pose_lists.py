# SPDX-License-Identifier: Apache-2.0
"""All poses of several figures as the instances of one object, which is worked out once. An instancer that joined the
figures itself would go over every pose of theirs in every frame, 8,704 of a cast of 64."""
import bpy

from ..blender.nodes import Maths, drop_object, new_tree, objects_read

_OF = "throng_poses_of"  # of an object in the cast: the names of its figures
_GEOMETRY = [("Geometry", "NodeSocketGeometry")]


def list_of(cast, figures):
    """The object whose instances are the poses of these figures, one figure's behind the other's."""
    names = [figure.name for figure in figures]
    for thing in cast.objects:
        # of members who were made anew there are others of the same name
        if list(thing.get(_OF, ())) == names and objects_read(thing.modifiers[0].node_group) == set(figures):
            return thing
    name = f"{names[0]} to {names[-1]} poses"
    made = bpy.data.objects.new(name, bpy.data.meshes.new(name))
    made.modifiers.new("throng pose list", "NODES").node_group = _joining(name, figures)
    made[_OF] = names
    cast.objects.link(made)
    return made


def drop_unused(cast):
    """Throws away the lists that no instancer shows."""
    for thing in [each for each in cast.objects if _OF in each and each.users == 1]:  # the cast itself is one
        drop_object(thing)


def _joining(name, figures):
    tree, _, outputs = new_tree(name, _GEOMETRY, _GEOMETRY)
    maths = Maths(tree)
    maths.link(maths.joined(figures), outputs.inputs[0])
    return tree
