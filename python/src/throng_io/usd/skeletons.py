# SPDX-License-Identifier: Apache-2.0
"""People of a stage with skeletons: the cast's members once, with their meshes, and everybody as an instance of one,
with a motion of one's own. What is bound on an instance's root holds for all that is in it, so members are shared."""
from __future__ import annotations

import dataclasses
import math

import numpy

from ..skinned import chosen
from ..skinned.carried import bent, box_of
from ..skinned.members import LEVELS, Member, Part
from ..skinned.motions import joints_of, track_of
from ..skinned.shot import Shot, Wanted
from .moving import SMALL

CROWD = "/World/Crowd"
LEVEL_SET = "levelOfDetail"
MEMBER_SET = "member"
ANYBODY, WITH_STICK = f"{CROWD}/Members/anybody", f"{CROWD}/Members/anybody_with_stick"


@dataclasses.dataclass(frozen=True)
class Skeletons:
    """Who is written."""
    most: int | None = None                     # so many people at most
    near: tuple[float, float] | None = None     # of these those who come nearest to a place of the world
    instances: bool = True                      # or copies, which programs bend that leave instances at rest

    def check(self) -> None:
        chosen.check(self.most, self.near)


class SkeletonCrowd:
    """Written into a stage (crowd.Stage)."""

    def __init__(self, stage, wanted: Skeletons):
        self.to, self.bake, self.every = stage, stage.bake, stage.every
        self.sdf, self.geom, self.usd, self.gf, self.vt = stage.sdf, stage.geom, stage.usd, stage.gf, stage.vt
        self.skel, self.stage, self.instances = stage.skel, stage.stage, wanted.instances
        self.layer = self.stage.GetRootLayer()
        shot = Shot(self.bake, Wanted(wanted.most, wanted.near, self.every))
        self.shot, self.frames, self.there, self.rows = shot, shot.frames, shot.there, shot.rows
        self.repertoire, self.member_of, self.sizes = shot.repertoire, shot.member_of, shot.sizes

    def write(self) -> None:
        crowd = self.geom.Xform.Define(self.stage, CROWD)
        self.usd.ModelAPI(self.stage.GetPrimAtPath("/World")).SetKind("assembly")
        self.usd.ModelAPI(crowd.GetPrim()).SetKind("group")
        members = {}
        for number in sorted({self.member_of[row] for row in self.rows}):
            members[number] = self.shot.member(number)
            self._member(number, members[number])
        self._choices(members)
        self._box(crowd, members.values())
        streams = self.shot.streams(self.rows)
        with self.sdf.ChangeBlock():
            for place, row in enumerate(self.rows):
                number = self.member_of[row]
                self._person(row, number, members[number], {name: each[:, place] for name, each in streams.items()})

    # ---- members

    def _member(self, number: int, member: Member) -> None:
        path = f"{CROWD}/Members/{_name(number)}"
        self.stage.CreateClassPrim(f"{CROWD}/Members")
        root = self.stage.CreateClassPrim(path)
        root.SetTypeName("SkelRoot")
        root.SetMetadata("comment", f"{member.role.look}, {member.role.profile or 'anybody'}")
        self.geom.Boundable(root).CreateExtentAttr(self.to.vectors(box_of(member, self.bake.streams)))
        skeleton = self.skel.Skeleton.Define(self.stage, f"{path}/skeleton")
        skeleton.CreateJointsAttr(member.joints)
        skeleton.CreateBindTransformsAttr(self._placed(member.places))
        skeleton.CreateRestTransformsAttr(self._placed(numpy.array([
            place - (member.places[parent] if parent >= 0 else 0.0)
            for place, parent in zip(member.places, member.parents)])))
        self.skel.BindingAPI.Apply(skeleton.GetPrim())
        binding = self.skel.BindingAPI.Apply(root)
        binding.CreateSkeletonRel().SetTargets([skeleton.GetPath()])
        levels = root.GetVariantSets().AddVariantSet(LEVEL_SET)
        for name, parts in zip(LEVELS, member.levels):
            levels.AddVariant(name)
            levels.SetVariantSelection(name)
            with levels.GetVariantEditContext():
                for part, mesh in parts.items():
                    self._mesh(f"{path}/{part}", mesh)
        levels.SetVariantSelection(LEVELS[0])

    def _choices(self, members: dict[int, Member]) -> None:
        """Who one can be: a variant for each member with the same joints, so that everybody's motion fits all."""
        for path in (ANYBODY, WITH_STICK):
            able = [number for number, member in members.items() if _choice_of(member) == path]
            if not able:
                continue
            root = self.stage.CreateClassPrim(path)
            root.SetTypeName("SkelRoot")
            choices = root.GetVariantSets().AddVariantSet(MEMBER_SET)
            for number in able:
                choices.AddVariant(_name(number))
                choices.SetVariantSelection(_name(number))
                with choices.GetVariantEditContext():
                    root.GetReferences().AddInternalReference(f"{CROWD}/Members/{_name(number)}")
            choices.SetVariantSelection(_name(able[0]))

    def _placed(self, places: numpy.ndarray):
        whole = numpy.tile(numpy.eye(4), (len(places), 1, 1))
        whole[:, 3, :3] = places
        return self.vt.Matrix4dArray.FromNumpy(whole)

    def _mesh(self, path: str, part: Part) -> None:
        if not len(part.faces):
            return
        mesh = self.geom.Mesh.Define(self.stage, path)
        self.to.shaped(mesh, part.points, numpy.full(len(part.faces), 3), part.faces.ravel())
        mesh.CreateNormalsAttr(self.to.vectors(part.normals))
        mesh.SetNormalsInterpolation(self.geom.Tokens.vertex)
        mesh.CreateDoubleSidedAttr(True)
        if len(part.colours):
            colours = mesh.CreateDisplayColorPrimvar(self.geom.Tokens.uniform)
            colours.Set(self.to.vectors(part.colours))
            colours.SetIndices(self.vt.IntArray.FromNumpy(part.colour_of.astype(numpy.int32)))
        binding = self.skel.BindingAPI.Apply(mesh.GetPrim())
        binding.CreateGeomBindTransformAttr(self.gf.Matrix4d(1.0))
        binding.CreateJointIndicesPrimvar(False, part.joints.shape[1]).Set(
            self.vt.IntArray.FromNumpy(part.joints.astype(numpy.int32).ravel()))
        binding.CreateJointWeightsPrimvar(False, part.weights.shape[1]).Set(
            self.vt.FloatArray.FromNumpy(part.weights.astype(numpy.float32).ravel()))

    def _box(self, crowd, members) -> None:
        """Round everybody in the whole shot, however they are turned."""
        places = self.bake.pos[self.frames][:, self.rows][self.there[:, self.rows]]
        if not len(places):
            return
        boxes = numpy.abs([box_of(member, self.bake.streams) for member in members])
        largest = float(self.sizes[self.rows].max())
        reach, up = largest * boxes[..., :2].max() * math.sqrt(2), largest * boxes[..., 2].max()
        self.geom.ModelAPI.Apply(crowd.GetPrim()).SetExtentsHint(self.to.vectors(numpy.array(
            [places.min(axis=0) - [reach, reach, 0.1], places.max(axis=0) + [reach, reach, up]])))

    # ---- people

    def _person(self, row: int, number: int, member: Member, streams: dict[str, numpy.ndarray]) -> None:
        """Xform, moved and turned; in it `figure`, an instance of the member, and `motion`."""
        there = self.there[:, row]
        codes = self.frames + 1
        path = f"{CROWD}/person{row:05d}"
        prim = self._prim(path, "Xform")
        prim.SetInfo("kind", "component")
        self._moved(path, row, codes[there], {name: each[there] for name, each in streams.items()})
        if not there.all():
            self._visibility(path, codes, there)
        self._figure(f"{path}/figure", row, number, member)
        self._motion(f"{path}/motion", row, member, codes[there],
                     {name: each[there] for name, each in streams.items()})

    def _prim(self, path: str, kind: str):
        prim = self.sdf.CreatePrimInLayer(self.layer, path)
        prim.specifier, prim.typeName = self.sdf.SpecifierDef, kind
        return prim

    def _attribute(self, path: str, name: str, kind, value=None, uniform: bool = False):
        """The attribute's path."""
        variability = self.sdf.VariabilityUniform if uniform else self.sdf.VariabilityVarying
        made = self.sdf.AttributeSpec(self.layer.GetPrimAtPath(path), name, kind, variability)
        if value is not None:
            made.default = value
        return made.path

    def _moved(self, path: str, row: int, codes, streams) -> None:
        types = self.sdf.ValueTypeNames
        heading = numpy.degrees(numpy.unwrap(numpy.arctan2(streams["dir"][:, 1], streams["dir"][:, 0])))
        goes = self._attribute(path, "xformOp:translate", types.Double3)
        turns = self._attribute(path, "xformOp:rotateZ", types.Double)
        for code, place, turn in zip(codes.tolist(), streams["pos"].tolist(), heading.tolist()):
            self.layer.SetTimeSample(goes, code, self.gf.Vec3d(*place))
            self.layer.SetTimeSample(turns, code, turn)
        order, size = ["xformOp:translate", "xformOp:rotateZ"], float(self.sizes[row])
        comes_and_goes = not self.there[:, row].all()
        if size != 1.0 or comes_and_goes:
            scale = self._attribute(path, "xformOp:scale", types.Float3, self.gf.Vec3f(size))
            order.append("xformOp:scale")
        if comes_and_goes:
            self._shrinks(scale, self.frames + 1, self.there[:, row], size)
        self._attribute(path, "xformOpOrder", types.TokenArray, self.vt.TokenArray(order), True)

    def _shrinks(self, scale, codes, there, size: float) -> None:
        """Samples on both sides of each change, as what is between two is blended."""
        changes = numpy.nonzero(there[1:] != there[:-1])[0]
        for place in sorted({0, *changes.tolist(), *(changes + 1).tolist()}):
            self.layer.SetTimeSample(scale, int(codes[place]), self.gf.Vec3f(size if there[place] else SMALL * size))

    def _visibility(self, path: str, codes, there) -> None:
        shown = self._attribute(path, "visibility", self.sdf.ValueTypeNames.Token)
        for place, code in enumerate(codes.tolist()):
            if place == 0 or there[place] != there[place - 1]:
                self.layer.SetTimeSample(shown, code, "inherited" if there[place] else "invisible")

    def _figure(self, path: str, row: int, number: int, member: Member) -> None:
        prim, types = self._prim(path, "SkelRoot"), self.sdf.ValueTypeNames
        if self.instances:
            prim.instanceable = True
        prim.referenceList.Prepend(self.sdf.Reference("", _choice_of(member)))
        prim.variantSelections[MEMBER_SET] = _name(number)
        prim.SetInfo("apiSchemas", self.sdf.TokenListOp.Create(prependedItems=["SkelBindingAPI"]))
        motion = self.sdf.RelationshipSpec(prim, "skel:animationSource", False)
        motion.targetPathList.explicitItems = [self.sdf.Path(path).GetParentPath().AppendChild("motion")]
        tint = self.vt.Vec3fArray([self.gf.Vec3f(*self.shot.tint(row))])
        self._primvar(path, "displayColor", types.Color3fArray, tint)
        self._primvar(path, "personId", types.Int, row)
        self._primvar(path, "crypto_object", types.String, f"{self.bake.name}/{row:05d}")
        if not self.instances:  # nor do such programs know what is inherited
            self.sdf.CreatePrimInLayer(self.layer, f"{path}/tinted")
            self._primvar(f"{path}/tinted", "displayColor", types.Color3fArray, tint)

    def _primvar(self, path: str, name: str, kind, value) -> None:
        attribute = self._attribute(path, f"primvars:{name}", kind, value)
        self.layer.GetAttributeAtPath(attribute).SetInfo("interpolation", self.geom.Tokens.constant)

    def _motion(self, path: str, row: int, member: Member, codes, streams) -> None:
        types = self.sdf.ValueTypeNames
        self._prim(path, "SkelAnimation")
        track = track_of(row, codes, streams, float(self.sizes[row]), self.shot.ground)
        matrices = bent(member, self.repertoire, track)
        joints = joints_of(matrices, member.places, member.parents)
        self._attribute(path, "joints", types.TokenArray, self.vt.TokenArray(member.joints), True)
        self._attribute(path, "scales", types.Half3Array, self.vt.Vec3hArray(len(member.joints), self.gf.Vec3h(1.0)))
        turned = self._attribute(path, "rotations", types.QuatfArray)
        moved = self._attribute(path, "translations", types.Float3Array)
        rotations = numpy.ascontiguousarray(joints.rotations, dtype=numpy.float32)
        for code, turns, moves in zip(codes.tolist(), rotations, joints.translations):
            self.layer.SetTimeSample(turned, code, self.vt.QuatfArray.FromNumpy(turns))
            self.layer.SetTimeSample(moved, code, self.to.vectors(moves))


def _name(number: int) -> str:
    return f"member{number:02d}"


def _choice_of(member: Member) -> str:
    return WITH_STICK if "stick" in member.joints else ANYBODY
