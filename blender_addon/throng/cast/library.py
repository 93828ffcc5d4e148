# SPDX-License-Identifier: Apache-2.0
"""Makes a cast's figures in Blender (see the package for what a cast is)."""
from functools import cache
from itertools import chain

import bpy
import numpy

from ..blender.meshes import fill
from . import LEVELS, POSES, VARIATIONS, limb_velocities, people, plan_of, poses_of
from .figure import build_figure
from .gait import gait_of
from .kept import kept
from .materials import cast_materials
from .sheets import Posed, drop_spare_attributes, make_figure, remove_figures, sheet_of

BLURS_UNTIL = 1  # the last level whose limbs blur: further away they move by less than a pixel or two


class _Shaped:
    """How people are made who are shaped from a library of bodies: the package `people` fills it in, which this one
    knows nothing of."""

    make = None   # (text of a role, level, repertoire): bones.Boned
    role = None   # (cast, member): that text
    check = None  # raises where the library is missing, before anything is changed
    move = None   # (cast, member, sheet, repertoire): gives somebody who is made anew the motions that the user
                  # brought, where the package `motions` is there


shaped = _Shaped()


def figures_of(cast):
    """{(level, member): figure}, whoever made them; also of levels that nobody shows now."""
    return {(thing["throng_level"], thing["throng_member"]): thing for thing in cast.objects
            if "throng_member" in thing}


def shown_figures(cast):
    """Those of figures_of() that the crowd shows."""
    return {(level, member): figure for (level, member), figure in sorted(figures_of(cast).items())
            if level < cast["throng_levels"]}


def add_figure(cast, level, member, name, posed, sheet=None):
    """@param sheet of the member at another level, where it keeps bones"""
    figure = make_figure(f"{name} level {level}" if level else name, posed, sheet)
    figure["throng_level"], figure["throng_member"] = level, member
    for thing in (figure, sheet_of(figure)):
        if thing.name not in cast.objects:
            cast.objects.link(thing)
    return figure


def build_cast(variations, repertoire, name="Throng cast", dress=None):
    """A cast of that many people at level 0. @param dress tells a cast who its people are, where they are shaped from a
    library of bodies"""
    cast = bpy.data.collections.new(name)
    cast["throng_variations"], cast["throng_levels"], cast["throng_shipped"] = variations, 1, variations
    if dress:
        dress(cast)
    cast.hide_viewport = cast.hide_render = True  # File > Append puts it into the scene
    materials = [] if dress else cast_materials(people.MATERIALS)
    for member in range(variations):
        add_person(cast, member, repertoire, materials)
    return cast


def add_person(cast, member, repertoire, materials, levels=None):
    """The shipped person of a number, at the levels that the cast shows unless told."""
    wanted = range(cast["throng_levels"]) if levels is None else levels
    if cast.get("throng_bodies"):
        role = shaped.role(cast, member)
        there = {level: figure for (level, number), figure in figures_of(cast).items() if number == member}
        for level in wanted:
            sheet = sheet_of(next(iter(there.values()))) if there else None
            there[level] = add_figure(cast, level, member, f"Throng person {member:02d}",
                                      shaped.make(role, level, repertoire), sheet)
            there[level]["throng_person"] = member
            if sheet is None and shaped.move:
                shaped.move(cast, member, sheet_of(there[level]), repertoire)
        return
    person = member % VARIATIONS
    bodies = cache(lambda: [build_figure(people.CAST[person], pose)
                            for pose in poses_of(people.CAST[person], repertoire)])
    for level in wanted:
        skin = kept(("figure", person, level, repertoire), lambda: _skin(bodies(), level, repertoire))
        posed = _posed(skin, level, repertoire, materials)
        figure = add_figure(cast, level, member, f"Throng person {member:02d}", posed)
        figure["throng_person"] = person


def add_levels(cast, repertoire):
    """Shows the coarser levels: makes those of the shipped people; who was brought along has them."""
    if cast["throng_levels"] == LEVELS:
        return
    if cast.get("throng_bodies"):
        shaped.check()
    cast["throng_levels"] = LEVELS
    for (level, member), figure in figures_of(cast).items():
        if "throng_person" not in figure:
            for thing in (figure, sheet_of(figure)):
                thing.update_tag()  # 3.4 does not find out by itself that what nobody saw is now seen
        elif level == 0:
            add_person(cast, member, repertoire, figure.data.materials, range(1, LEVELS))


def remove_levels(cast):
    """Shows the finest level alone, and throws the others of the shipped people away."""
    cast["throng_levels"] = 1
    remove_figures([figure for (level, _), figure in figures_of(cast).items()
                    if level > 0 and "throng_person" in figure])


def _skin(bodies, level, repertoire):
    """What all poses of somebody are at a level: "points" (P, V, 3), and of the faces the "corners", how many of them
    each has ("sizes"), and the "materials"."""
    plan = plan_of(bodies, repertoire, level)
    points = numpy.array([plan.vertices(bodies[index].rings) for index in repertoire.sources(level)], numpy.float32)
    return {"points": points, "corners": numpy.fromiter(chain.from_iterable(plan.faces), numpy.int32),
            "sizes": numpy.fromiter(map(len, plan.faces), numpy.int32),
            "materials": numpy.array(plan.materials, numpy.int32)}


def _posed(skin, level, repertoire, materials):
    points = skin["points"]
    velocities = walking_velocities(points, repertoire) if level <= BLURS_UNTIL else None
    return Posed(_template(skin, materials), points, velocities)


def _template(skin, materials):
    mesh = bpy.data.meshes.new("throng figure")
    fill(mesh, skin["points"][-1], skin["corners"], skin["sizes"])
    for material in materials:
        mesh.materials.append(material)
    mesh.polygons.foreach_set("material_index", skin["materials"])
    mesh.polygons.foreach_set("use_smooth", [True] * len(skin["sizes"]))
    mesh.update(calc_edges=True)
    drop_spare_attributes(mesh)
    return mesh


def walking_velocities(points, repertoire):
    """Limbs blur, too: how fast the parts of each walking pose move at its gait's natural speed, (W, V, 3) m/s.

    @param points (P, V, 3) of a level that blurs: these have all poses of a cycle
    """
    cycles = points[:repertoire.walking()].reshape(-1, POSES, *points.shape[1:])
    return numpy.concatenate([limb_velocities(numpy.roll(cycle, 1, axis=0), numpy.roll(cycle, -1, axis=0),
                                              2.0 * gait_of(stride).seconds / POSES)
                              for stride, cycle in zip(repertoire.strides, cycles)])
