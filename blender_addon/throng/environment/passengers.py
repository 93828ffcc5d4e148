# SPDX-License-Identifier: Apache-2.0
"""People who stand in vehicles: as many as the bake says that there are aboard, where there is room to see them.

They are of the crowd's cast, but no rows of the bake: who has got on has left the scene there."""
import math

import bpy
import numpy

from ..cast import library
from ..cast.sheets import pose_mesh
from .keys import hide_but
from .vehicle_doors import FLOOR

PASSENGER = "throng_passenger"  # of objects: which one of its vehicle's it is
_MOST = 48                # in one vehicle
_ENDS, _DOORS = 1.4, 0.9  # m that are free at the ends, and to each side of a door's middle
_APART, _ASIDE = 0.72, (-0.42, 0.42)  # m along, and where two files stand across
_LEVEL = 1                # of detail: they are behind panes
_LOOKS = 12               # different people


def standing(cast, repertoire):
    """Meshes of people who stand, of a level of detail that is there."""
    figures = library.figures_of(cast)
    level = _LEVEL if any(each == _LEVEL for each, _ in figures) else 0
    found = []
    for member in range(cast["throng_variations"]):
        figure = figures.get((level, member))
        if figure is not None and len(found) < _LOOKS:
            clip = ("idle", "shift", "phone")[member % 3]
            mesh = pose_mesh(figure, repertoire.standing_pose(clip, member % 4, level))
            mesh.name = f"Throng passenger {member}"
            found.append(mesh)
    return found


def _spots(what, opening, number):
    """[(x, y, heading)] of those who stand in it, in the order in which they fill."""
    half = 0.5 * what["length"]
    draw = numpy.random.default_rng([number, 7])
    middles = [half - at for at in opening["at"]]
    places = []
    for y in _ASIDE:
        for x in numpy.arange(-half + _ENDS, half - _ENDS, _APART):
            x, aside = x + draw.uniform(-0.16, 0.16), y + draw.uniform(-0.16, 0.16)
            if all(abs(x - middle) > _DOORS for middle in middles):
                places.append((float(x), float(aside), math.copysign(0.5 * math.pi, y) + draw.uniform(-1.2, 1.2)))
    return [places[index] for index in draw.permutation(len(places))[:_MOST]]


def passengers_of(vehicle, what, opening, number, aboard, meshes, frame_start):
    """Objects. @param what, opening, number as vehicle_doors has them; @param aboard how many there are in each frame,
    0 while the vehicle is not there; @param meshes of standing()"""
    spots, draw, found = _spots(what, opening, number), numpy.random.default_rng([number, 8]), []
    for index, (x, y, heading) in enumerate(spots[:int(aboard.max(initial=0.0))]):
        thing = bpy.data.objects.new(f"{vehicle.name} passenger {index}", meshes[draw.integers(len(meshes))])
        thing.parent, thing.location, thing.rotation_euler = vehicle, (x, y, FLOOR), (0.0, 0.0, heading)
        thing["tint"], thing[PASSENGER] = draw.random(3).tolist(), index
        hide_but(thing, aboard > index, frame_start)
        found.append(thing)
    return found
