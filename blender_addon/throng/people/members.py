# SPDX-License-Identifier: Apache-2.0
"""Members of a crowd's cast who are shaped from a library of bodies, in the form that all members of casts have
(cast/__init__.py)."""
from collections import Counter
from functools import lru_cache
from types import SimpleNamespace

import numpy

from ..cast import POSES, gait, poses_of_build, skinning
from ..cast.bones import Boned
from ..cast.kept import kept
from ..cast.library import BLURS_UNTIL, shaped
from . import figures, library
from .casting import person_of
from .person import Maker
from .roster import Role

ROLES = "throng_people"  # of a cast, a line each
MEMBERS = 64      # of a cast: women and men of all ages, some children among them
FINE = 4096.0     # steps a metre: what is finer is not seen, and files are a third as large without it
_MOVES = "moves "
_SOME = 7         # of so many poses one tells which bones move
_FEW = 19         # and one is looked at for where vertices hang best
_KEPT = 2         # people who stay in memory: all their levels are made one after the other
# the share of bones in how the trunk turns and leans: these do less than what is above them
_STILL = {"Root": 0.0, "pelvis": 0.0, "spine_01": 0.4, "spine_02": 0.75}


def found():
    """Whether there is a library of bodies."""
    return library.library_path() is not None


def bodies():
    """The library. Raises library.LibraryError."""
    path = library.library_path()
    if path is None:
        raise library.LibraryError("these people were shaped from a library of bodies that is not here: set "
                                   f"{library.VARIABLE} to it, or install the add-on that has it")
    return library.load(path)


@lru_cache(maxsize=_KEPT)
def maker_of(role):
    return Maker(bodies(), person_of(role))


@lru_cache(maxsize=_KEPT)
def _of_all_poses(role, repertoire):
    """(P, all bones, 3, 4)"""
    rig = maker_of(role).rig
    return rig.all_matrices(poses_of_build(rig.build, repertoire))


@lru_cache(maxsize=_KEPT)
def _leaders(role, repertoire):
    """Which bones go with which (skinning.leaders_of): a few poses tell."""
    return skinning.leaders_of(bodies().parents, _of_all_poses(role, repertoire)[::_SOME],
                               maker_of(role).rig.leading())


def leading(role, repertoire):
    """Numbers of the library's bones that lead: those that sheets have."""
    return numpy.unique(_leaders(role, repertoire)[0])


@lru_cache(maxsize=_KEPT)
def _bones(role, repertoire):
    """{"matrices", and "limbs", "joints", "trunk" as cast.bones.Boned has them in `limbs`}, of the bones that lead."""
    return kept(("bones", str(role), repertoire), lambda: {
        "matrices": _of_all_poses(role, repertoire)[:, leading(role, repertoire)],
        **dict(zip(("limbs", "joints", "trunk"), map(numpy.asarray, _limbs_of(role, repertoire))))},
        library.library_path())


def matrices_of(role, repertoire):
    """(P, B, 3, 4) of the bones that lead, in all poses of level 0."""
    return _bones(role, repertoire)["matrices"]


def of_all_bones(role, repertoire, led):
    """(bones of the library, 3, 4) of those that lead, (B, 3, 4): all others go with them."""
    leaders, turns = _leaders(role, repertoire)
    return led[numpy.searchsorted(leading(role, repertoire), leaders)] @ turns


def _limbs_of(role, repertoire):
    library_, rig = bodies(), maker_of(role).rig
    used = leading(role, repertoire).tolist()
    legs = [[f"{bone}_{side}" for bone in ("thigh", "calf", "foot", "ball")] for side in "lr"]
    neck = ["neck_01", "head"]
    return ([used.index(library_.bone[bone]) for bone in (*legs[0], *legs[1], *neck)],
            [rig.heads[bone] for bone in (*legs[0][:3], *legs[1][:3], *neck)],
            [0.0 if bone in (*legs[0], *legs[1]) else _STILL.get(bone, 1.0)
             for bone in (library_.bones[number] for number in used)])


def _at_rest(role, level, repertoire):
    """{"points", "faces", "pattern", "materials", "material_of" as person.Model has them, "hangs", and what moves in
    the face by the name behind _MOVES} of somebody at rest on the bones that lead."""
    model, leaders = maker_of(role).model(level), _leaders(role, repertoire)[0]
    poses = _of_all_poses(role, repertoire)[::_FEW]
    points, weights = skinning.hinged(model.points, model.weights, leaders, poses)
    points = (numpy.rint(points * FINE) / FINE + 0.0).astype(numpy.float32)  # no zero is negative
    return {"points": points, "faces": model.faces.astype(numpy.int32), "pattern": model.pattern,
            "materials": numpy.array(model.materials), "material_of": model.material_of.astype(numpy.int32),
            "hangs": skinning.hangs_of(weights).astype(numpy.float32),
            **{_MOVES + name: values.astype(numpy.float32) for name, values in model.moves.items()}}


def mesh_on_bones(role, level, repertoire):
    """(somebody's mesh at rest, (V, MOST) how its vertices hang on the bones that lead)"""
    arrays = kept(("mesh", str(role), level, repertoire), lambda: _at_rest(role, level, repertoire),
                  library.library_path())
    found = SimpleNamespace(**arrays)
    found.materials = found.materials.tolist()
    mesh = figures.mesh_of("throng figure", found, found.points, person_of(role).look, bodies())
    figures.add_moves(mesh, {name.removeprefix(_MOVES): values for name, values in arrays.items()
                             if name.startswith(_MOVES)})
    return mesh, found.hangs


def boned_of(text, level, repertoire):
    """A member at a level, for cast.sheets. @param text of its role"""
    role = Role.of(text)
    mesh, hangs = mesh_on_bones(role, level, repertoire)
    cycles = tuple((POSES, gait.gait_of(stride).seconds / POSES) for stride in repertoire.strides)
    told = _bones(role, repertoire)
    return Boned(mesh, hangs, told["matrices"].shape[1], lambda: told["matrices"], tuple(repertoire.sources(level)),
                 cycles if level <= BLURS_UNTIL else (), tuple(told[name] for name in ("limbs", "joints", "trunk")))


def write_roles(cast, roles):
    """Files keep them: levels and heroes are made later."""
    cast["throng_bodies"] = Counter(role.look for role in roles).most_common(1)[0][0]
    cast[ROLES] = "\n".join(map(str, roles))


def roles_of(cast):
    """Of the shipped members. Files of old have one look, and everybody by number."""
    text = cast.get(ROLES)
    if text:
        return [Role.of(line) for line in text.split("\n")]
    return [Role(number, cast["throng_bodies"]) for number in range(cast["throng_shipped"])]


def role_of(cast, member):
    return roles_of(cast)[member]


# the cast's own library calls these for members whose cast has a look
shaped.make, shaped.check, shaped.role = boned_of, bodies, lambda cast, member: str(role_of(cast, member))
