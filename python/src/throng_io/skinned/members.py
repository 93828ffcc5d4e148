# SPDX-License-Identifier: Apache-2.0
"""Who is in a crowd's cast: the add-on's people as numbers, meshes that hang on joints. Metres; at rest they look along
+x and stand on z = 0.

The modules of the folders `people` and `cast` are the add-on's own (links in the repository, files in wheels): those
that need no Blender.
"""
from __future__ import annotations

import dataclasses

import numpy

from ..bakes.bake import Bake
from ..base.errors import ThrongError
from ..cast import Repertoire, poses_of_build, sitting, skinning
from ..people import casting, library, palettes, parts, person, roster
from ..people.holding import BAGS

MOST_MEMBERS = 64              # as many as the add-on makes of a crowd
LEVELS = ("near", "middle", "far")
_SOME_POSES = 7                # of so many, one tells which bones go with others
_FEW_POSES = 19                # and one is looked at for where vertices hang best
MARGIN = 0.02                  # m, of boxes: turns between poses are made turns again, which bends a little more
_STICK = "Root"                # the bone that a stick or a bag in the hand is on
_PICKS = {"bottom": 1.0, "shirt": 5.0, "shoes": 9.0, "extra": 11.0, "skin": 3.0, "hair": 7.0, "grey": 7.0, "eyes": 13.0}
_LASHES = (0.012, 0.010, 0.009)
_STEP = 0.618034               # of a palette, from one member to the next


@dataclasses.dataclass(frozen=True)
class Part:
    """A mesh at rest."""
    points: numpy.ndarray      # V x 3
    normals: numpy.ndarray     # V x 3
    faces: numpy.ndarray       # F x 3
    joints: numpy.ndarray      # V x 4: numbers of joints
    weights: numpy.ndarray     # V x 4: their shares, which add up to 1
    colours: numpy.ndarray     # C x 3; none where everybody's own tint is shown
    colour_of: numpy.ndarray   # F


@dataclasses.dataclass(frozen=True)
class Member:
    """Somebody of the cast."""
    role: roster.Role
    joints: list[str]          # paths: "pelvis/spine_01"
    parents: list[int]         # -1 for those without
    places: numpy.ndarray      # J x 3, of joints at rest, which are not turned there
    poses: numpy.ndarray       # P x J x 3 x 4: where each pose takes what hangs on a joint, in the order of Repertoire
    levels: list[dict[str, Part]]  # of LEVELS: "dressed", and "tinted", which shows the tint
    box: numpy.ndarray         # 2 x 3, round all poses


def repertoire_of(bake: Bake) -> Repertoire:
    strides = [float(stride) for stride in bake.about.get("strides") or [1.446]]
    gaits = bake.about.get("gaits") or range(len(strides))
    poses = "all" if bake.about.get("poses") else "audience" if bake.about["geometry"].get("seats") else ""
    return Repertoire.of(strides, (min(gaits), min(max(gaits), len(strides) - 1)), sitting.clips_for(poses))


def bodies_of_library() -> library.Bodies:
    path = library.library_path()
    if path is None:
        raise ThrongError("people with skeletons are shaped from a library of bodies, and none is here",
                          f"scripts/body_library.py makes one: set {library.VARIABLE} to its path")
    try:
        return library.load(path)
    except library.LibraryError as error:
        raise ThrongError(str(error)) from error


def cast_of(bake: Bake, most: int = MOST_MEMBERS) -> tuple[list[roster.Role], list[int]]:
    """(whom the members are drawn as, which of them everybody is): as the add-on casts them."""
    walkers = casting.read_walkers(bake.folder) or [casting.Walker()] * bake.agents
    roles = casting.roles_for(walkers, min(most, max(1, bake.agents)))
    chosen = casting.choose(walkers, roles, max(1, int(bake.about.get("variations", 1))))
    return roles, [walker.variation % len(roles) if walker.chosen else number
                   for walker, number in zip(walkers, chosen)]


def make_member(bodies: library.Bodies, role: roster.Role, repertoire: Repertoire) -> Member:
    maker = person.Maker(bodies, role.person())
    rig = maker.rig
    everything = rig.all_matrices(poses_of_build(rig.build, repertoire))
    leaders = skinning.leaders_of(bodies.parents, everything[::_SOME_POSES], rig.leading())
    used = numpy.unique(leaders[0]).tolist()
    hung = [(model, *skinning.hinged(model.points, model.weights, leaders[0], everything[::_FEW_POSES]))
            for model in (maker.model(level) for level in range(len(LEVELS)))]
    if not (rig.stick or rig.holds in BAGS):  # nothing hangs on the stick's bone
        hung = [(model, points, numpy.delete(weights, used.index(bodies.bone[_STICK]), axis=1))
                for model, points, weights in hung]
        used.remove(bodies.bone[_STICK])
    parents = [_parent_of(bodies, number, used) for number in used]
    poses = everything[:, used]
    return Member(role, _paths(["stick" if bodies.bones[number] == _STICK else bodies.bones[number]
                                for number in used], parents),
                  parents, numpy.array([rig.heads[bodies.bones[number]] for number in used]), poses,
                  [_parts_of(role, *each) for each in hung], _box(hung[0][1], hung[0][2], poses))


def _parent_of(bodies: library.Bodies, number: int, used: list[int]) -> int:
    """Of a bone the next one above it that is used; a stick carries nobody."""
    above = bodies.parents[number] if bodies.bones[number] != _STICK else -1
    while above >= 0 and (above not in used or above == number):
        if bodies.bones[above] == _STICK:
            return -1
        above = bodies.parents[above]
    return -1 if above < 0 or bodies.bones[above] == _STICK else used.index(above)


def _paths(names: list[str], parents: list[int]) -> list[str]:
    paths: list[str] = []
    for name, parent in zip(names, parents):
        paths.append(f"{paths[parent]}/{name}" if parent >= 0 else name)
    return paths


def _parts_of(role: roster.Role, model: person.Model, points: numpy.ndarray, weights: numpy.ndarray) -> dict[str, Part]:
    """What shows the tint: tops, or where somebody has none, shirts."""
    slots = [material.split()[0] for material in model.materials]
    worn = "top" if "top" in slots else "shirt"
    shows = numpy.array([slot == worn for slot in slots])[model.material_of]
    colours = numpy.array([_colour_of(material, role) for material in model.materials])
    normals = parts.normals_of(points, model.faces)
    return {"dressed": _part(points, normals, weights, model.faces[~shows], colours, model.material_of[~shows]),
            "tinted": _part(points, normals, weights, model.faces[shows], colours[:0], model.material_of[shows])}


def _part(points, normals, weights, faces, colours, colour_of) -> Part:
    there, place = numpy.unique(faces, return_inverse=True)
    order = numpy.argsort(-weights[there], axis=1, kind="stable")[:, :skinning.MOST]
    shares = numpy.take_along_axis(weights[there], order, axis=1)
    return Part(points[there], normals[there], place.reshape(-1, 3), numpy.where(shares > 0.0, order, 0),
                shares / shares.sum(axis=1, keepdims=True), colours, colour_of)


def _colour_of(material: str, role: roster.Role) -> tuple[float, float, float]:
    """One of the add-on's colours for what a part is made of, another for each member."""
    slot, *rest = material.split()
    if slot == "lashes":
        return _LASHES
    share = (role.number + 0.5) * _STEP * _PICKS.get(slot, 1.0) % 1.0
    if slot == "skin":
        choice = palettes.SKINS[rest[0]]
    elif slot in ("hair", "grey"):
        choice = palettes.HAIR[rest[0] if rest else slot]
    else:
        choice = _cloths(slot, rest[0] if rest else "", role.look)
    return choice[int(share * len(choice))]


def _cloths(slot: str, fabric: str, look: str) -> tuple:
    if slot == "eyes":
        return palettes.BROWN_EYES if fabric == "brown" else palettes.EYES
    if slot in ("top", "bottom") and fabric == "denim":
        return palettes.DENIMS
    if slot == "top":
        return palettes.tops(look)
    if slot == "bottom":
        return palettes.BOTTOMS.get(look, palettes.BOTTOM)
    if slot == "shirt":
        return palettes.SHIRTS
    if slot == "shoes":
        return palettes.SOLES if fabric == "sole" else palettes.SHOES[fabric]
    return palettes.extras(look, fabric)


def _box(points: numpy.ndarray, weights: numpy.ndarray, poses: numpy.ndarray) -> numpy.ndarray:
    """Round somebody in all poses and between them: a point is between the places that its joints take it to, and each
    joint takes it to somewhere in what it makes of the box round all that hangs on it."""
    low, high = numpy.full(3, numpy.inf), numpy.full(3, -numpy.inf)
    for joint in numpy.nonzero((weights > 0.0).any(axis=0))[0]:
        hung = points[weights[:, joint] > 0.0]
        ends = numpy.array([hung.min(axis=0), hung.max(axis=0)])
        corners = numpy.array([ends[pick, range(3)] for pick in numpy.ndindex(2, 2, 2)])
        moved = numpy.einsum("pij,cj->pci", poses[:, joint, :, :3], corners) + poses[:, joint, None, :, 3]
        low, high = numpy.minimum(low, moved.min(axis=(0, 1))), numpy.maximum(high, moved.max(axis=(0, 1)))
    return numpy.array([low - MARGIN, high + MARGIN])
