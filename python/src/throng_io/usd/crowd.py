# SPDX-License-Identifier: Apache-2.0
"""A bake as a USD stage: a point instancer whose prototypes are poses, walls, and ground."""
from __future__ import annotations

import contextlib
import os
import pathlib
import string

import numpy

from ..bakes.bake import Bake
from ..bakes.surroundings import GREY, things_of
from ..base.errors import ThrongError, need
from ..base.whole_files import whole_file, whole_folder
from ..skinned.members import bodies_of_library, repertoire_of
from ..skinned.motions import seats_of
from .clips import folder_of, write_clips
from .figures import PHASES, Mesh, figure, seated_poses
from .moving import MovingThings
from .skeletons import SkeletonCrowd, Skeletons
from .staging import add_staging

SUFFIXES = (".usd", ".usda", ".usdc")
WALKING = 1
USUAL_RADIUS = 0.25           # m, of figures as they are made
SIZES = (0.6, 1.15)           # of bodies that are smaller or larger
SKINS = ((0.62, 0.42, 0.31), (0.45, 0.27, 0.18), (0.23, 0.13, 0.08), (0.72, 0.52, 0.41))
TROUSERS = ((0.05, 0.06, 0.1), (0.12, 0.11, 0.1), (0.16, 0.13, 0.09), (0.07, 0.08, 0.09))
SHOES = (0.03, 0.03, 0.03)
TOPS = ((0.42, 0.09, 0.07), (0.07, 0.16, 0.36), (0.1, 0.26, 0.16), (0.55, 0.44, 0.2), (0.5, 0.5, 0.48),
        (0.05, 0.05, 0.06), (0.3, 0.16, 0.34), (0.22, 0.36, 0.42))
MOST_COSTUMES = 64


def export_usd(bake: Bake, path: str | os.PathLike, every: int = 1, skeletons: Skeletons | None = None,
               bare: bool = False, chunk: int | None = None) -> None:
    """All frames, or every N-th, at the time codes of the shot: frame i of the bake is time code i + 1.

    @param skeletons whose; without, people are a point instancer's simple figures
    @param bare without the ground, walls, camera and lights
    @param chunk so many frames in a file of their own each; without, all are in one
    """
    if pathlib.Path(path).suffix.lower() not in SUFFIXES:
        raise ThrongError(f"{os.fspath(path)}: expected a name that ends in {', '.join(SUFFIXES)}")
    if every < 1:
        raise ThrongError(f"every: expected 1 or more, found {every}")
    if skeletons:
        skeletons.check()
        bodies_of_library()
    need("pxr", "usd")
    if chunk is not None and (skeletons or chunk < 1):
        raise ThrongError("chunk: expected 1 or more frames, of a crowd without skeletons")
    with whole_file(path) as beside:
        stage = Stage(bake, str(beside), every, skeletons, bare, chunk)
        with whole_folder(folder_of(path)) if chunk else contextlib.nullcontext() as clips:
            stage.write(clips)


class Stage:
    def __init__(self, bake: Bake, path: str, every: int, skeletons: Skeletons | None, bare: bool,
                 chunk: int | None):
        self.usd, self.geom, self.shade, self.skel, self.lux, self.sdf, self.gf, self.vt = (
            need(f"pxr.{name}", "usd")
            for name in ("Usd", "UsdGeom", "UsdShade", "UsdSkel", "UsdLux", "Sdf", "Gf", "Vt"))
        self.bake, self.every, self.skeletons, self.bare, self.chunk = bake, every, skeletons, bare, chunk
        self.stage = self.usd.Stage.CreateNew(path)

    def write(self, clips: pathlib.Path | None) -> None:
        """@param clips the folder of what people do, where that is in files of its own"""
        bake, stage, geom = self.bake, self.stage, self.geom
        geom.SetStageUpAxis(stage, geom.Tokens.z)
        geom.SetStageMetersPerUnit(stage, 1.0)
        stage.SetTimeCodesPerSecond(bake.fps)
        stage.SetFramesPerSecond(bake.fps)
        stage.SetStartTimeCode(1)
        stage.SetEndTimeCode(bake.frames)
        stage.GetRootLayer().comment = f"{bake.name}: {bake.agents} people, by Throng"
        world = geom.Xform.Define(stage, "/World")
        stage.SetDefaultPrim(world.GetPrim())
        self.usd.ModelAPI(world.GetPrim()).SetKind("component")
        world.AddTranslateOp().Set(self.gf.Vec3d(*bake.origin.tolist()))
        self.material = self.painted()
        if not self.bare:
            self.surroundings()
            add_staging(self)
        MovingThings(self).write()
        if self.skeletons:
            SkeletonCrowd(self, self.skeletons).write()
        else:
            self.crowd(clips)
        stage.GetRootLayer().Save()

    def painted(self):
        """A material that shows the colours that things, and people, have of their own."""
        scope = "/World/Looks"
        self.geom.Scope.Define(self.stage, scope)
        material = self.shade.Material.Define(self.stage, f"{scope}/painted")
        reader = self.shade.Shader.Define(self.stage, f"{scope}/painted/tint")
        reader.CreateIdAttr("UsdPrimvarReader_float3")
        reader.CreateInput("varname", self.sdf.ValueTypeNames.String).Set("displayColor")
        reader.CreateInput("fallback", self.sdf.ValueTypeNames.Float3).Set(self.gf.Vec3f(*GREY["walls"]))
        colour = reader.CreateOutput("result", self.sdf.ValueTypeNames.Float3)
        surface = self.shade.Shader.Define(self.stage, f"{scope}/painted/surface")
        surface.CreateIdAttr("UsdPreviewSurface")
        surface.CreateInput("diffuseColor", self.sdf.ValueTypeNames.Color3f).ConnectToSource(colour)
        surface.CreateInput("roughness", self.sdf.ValueTypeNames.Float).Set(0.8)
        material.CreateSurfaceOutput().ConnectToSource(
            surface.CreateOutput("surface", self.sdf.ValueTypeNames.Token))
        return material

    # ---- what stands still

    def surroundings(self) -> None:
        for thing in things_of(self.bake):
            self.mesh(f"/World/{thing.place}", thing.points, thing.faces, thing.colour, thing.name)

    def mesh(self, path: str, points: numpy.ndarray, faces: list[list[int]], colour, name: str | None = None) -> None:
        self.geom.Scope.Define(self.stage, path.rpartition("/")[0])
        mesh = self.geom.Mesh.Define(self.stage, path)
        self.shaped(mesh, points, [len(face) for face in faces], [corner for face in faces for corner in face])
        mesh.CreateDisplayColorPrimvar(self.geom.Tokens.constant).Set([self.gf.Vec3f(*colour)])
        if name:
            mesh.GetPrim().SetDisplayName(str(name))

    def shaped(self, mesh, points: numpy.ndarray, counts, corners) -> None:
        mesh.CreateSubdivisionSchemeAttr(self.geom.Tokens.none)
        mesh.CreatePointsAttr(self.vectors(points))
        mesh.CreateFaceVertexCountsAttr(self.vt.IntArray.FromNumpy(numpy.asarray(counts, dtype=numpy.int32)))
        mesh.CreateFaceVertexIndicesAttr(self.vt.IntArray.FromNumpy(numpy.asarray(corners, dtype=numpy.int32)))
        mesh.CreateExtentAttr(self.vectors(numpy.array([points.min(axis=0), points.max(axis=0)])))
        self.shade.MaterialBindingAPI.Apply(mesh.GetPrim()).Bind(self.material)

    def vectors(self, values: numpy.ndarray):
        return self.vt.Vec3fArray.FromNumpy(numpy.ascontiguousarray(values, dtype=numpy.float32))

    # ---- people

    def crowd(self, clips: pathlib.Path | None) -> None:
        crowd = self.geom.PointInstancer.Define(self.stage, "/World/Crowd")
        self.gaits = [int(gait) for gait in self.bake.about.get("gaits", [])] or [0]
        strides = self.bake.about.get("strides") or [1.4]
        poses = [("standing", figure(None))]
        for gait in self.gaits:
            poses += [(f"stride{gait}_pose{pose}", figure(pose / PHASES, strides[min(gait, len(strides) - 1)]))
                      for pose in range(PHASES)]
        self.upright = len(poses)
        poses += seated_poses(repertoire_of(self.bake).clips)
        self.geom.Scope.Define(self.stage, "/World/Crowd/Prototypes")
        self.stage.CreateClassPrim("/World/Crowd/Poses")
        for name, mesh in poses:
            self.pose(name, mesh)
        self.poses_of_one = len(poses)
        self.tops, self.costume = costumes(self.bake.people)
        for number, top in enumerate(self.tops):
            for name, _ in poses:
                crowd.GetPrototypesRel().AddTarget(self.prototype(number, top, name))
        self.low = numpy.min([mesh.points.min(axis=0) for _, mesh in poses], axis=0)
        self.high = numpy.max([mesh.points.max(axis=0) for _, mesh in poses], axis=0)
        self.looks(crowd)
        if clips:
            write_clips(self, crowd, clips, clips.name)
        else:
            self.samples(crowd, range(0, self.bake.frames, self.every))

    def pose(self, name: str, made: Mesh) -> None:
        """The shape of all prototypes that are in this pose."""
        self.stage.CreateClassPrim(f"/World/Crowd/Poses/{name}").SetTypeName("Mesh")
        mesh = self.geom.Mesh(self.stage.GetPrimAtPath(f"/World/Crowd/Poses/{name}"))
        self.shaped(mesh, made.points, numpy.full(len(made.faces), 3), made.faces.ravel())
        mesh.CreateNormalsAttr(self.vectors(made.normals))
        mesh.SetNormalsInterpolation(self.geom.Tokens.vertex)
        colours = mesh.CreateDisplayColorPrimvar(self.geom.Tokens.uniform)
        colours.SetIndices(self.vt.IntArray.FromNumpy(made.parts.astype(numpy.int32)))

    def prototype(self, number: int, top: numpy.ndarray, pose: str):
        """A pose in a costume."""
        prim = self.stage.DefinePrim(f"/World/Crowd/Prototypes/costume{number}_{pose}")
        prim.GetReferences().AddInternalReference(f"/World/Crowd/Poses/{pose}")
        colours = [SKINS[number % len(SKINS)], TROUSERS[number // 2 % len(TROUSERS)], top, SHOES]
        self.geom.Mesh(prim).GetDisplayColorPrimvar().Set(self.vectors(numpy.array(colours)))
        return prim.GetPath()

    def looks(self, crowd) -> None:
        """What of a person does not change: its row, colour and size."""
        people, rows = self.bake.people, numpy.arange(self.bake.agents)
        crowd.CreateIdsAttr(self.vt.Int64Array.FromNumpy(rows.astype(numpy.int64)))
        primvars, types = self.geom.PrimvarsAPI(crowd.GetPrim()), self.sdf.ValueTypeNames
        primvars.CreatePrimvar("tint", types.Color3fArray, self.geom.Tokens.vertex).Set(
            self.vectors(self.tops[self.costume]))
        primvars.CreatePrimvar("personId", types.IntArray, self.geom.Tokens.vertex).Set(
            self.vt.IntArray.FromNumpy(rows.astype(numpy.int32)))
        primvars.CreatePrimvar("crypto_object", types.StringArray, self.geom.Tokens.vertex).Set(
            self.vt.StringArray([f"{self.bake.name}/{row:05d}" for row in rows]))
        self.sizes = numpy.clip(people["radius"] / USUAL_RADIUS, *SIZES)
        if "scale" in people.dtype.names:
            self.sizes = numpy.where(numpy.isfinite(people["scale"]), self.sizes * people["scale"], self.sizes)
        crowd.CreateScalesAttr(self.vectors(numpy.repeat(self.sizes[:, None], 3, axis=1)))

    def samples(self, crowd, frames) -> None:
        """What people do in some frames."""
        attributes = {name: getattr(crowd, f"Create{name}Attr")() for name in (
            "ProtoIndices", "Positions", "Orientations", "Velocities", "AngularVelocities", "InvisibleIds", "Extent")}
        seconds, last = self.every / self.bake.fps, self.bake.frames - 1
        for frame in frames:
            time, after = frame + 1, min(frame + self.every, last)
            here, there = self.bake.pos[frame], self.bake.there(frame)
            heading, later = (numpy.arctan2(*self.bake.dir[each][:, 1::-1].T) for each in (frame, after))
            turn = numpy.degrees((later - heading + numpy.pi) % (2 * numpy.pi) - numpy.pi) / seconds
            speed = (self.bake.pos[after] - here) / seconds
            attributes["ProtoIndices"].Set(self.vt.IntArray.FromNumpy(self.poses(frame)), time)
            attributes["Positions"].Set(self.vectors(here), time)
            attributes["Velocities"].Set(self.vectors(numpy.where(there[:, None], speed, 0.0)), time)
            attributes["AngularVelocities"].Set(self.vectors(
                numpy.column_stack([0 * turn, 0 * turn, numpy.where(there, turn, 0.0)])), time)
            attributes["Orientations"].Set(self.turned(heading), time)
            attributes["InvisibleIds"].Set(self.vt.Int64Array.FromNumpy(numpy.nonzero(~there)[0].astype(numpy.int64)),
                                           time)
            attributes["Extent"].Set(self.extent(here[there], self.sizes[there]), time)

    def poses(self, frame: int) -> numpy.ndarray:
        """The prototype of everybody: who walks has the pose of its phase, in the gait of its stride; who has a seat
        that of what it does."""
        state = self.bake.state[frame]
        activity = numpy.floor(state[:, 0] + 1e-4)
        gait = numpy.rint(16 * (state[:, 0] - activity)).astype(int)
        place = numpy.abs(gait[:, None] - numpy.array(self.gaits)).argmin(axis=1)
        pose = numpy.floor((state[:, 2] % 1.0) * PHASES + 0.5).astype(int) % PHASES
        walks = (activity == WALKING) & (self.bake.dir[frame][:, 2] > 0.1)
        shown = numpy.where(walks, 1 + PHASES * place + pose, 0)
        if self.poses_of_one > self.upright:
            has, here, there, share = seats_of(state)
            shown = numpy.where(has, self.upright + numpy.where(share < 0.5, here, there), shown)
        return (self.poses_of_one * self.costume + shown).astype(numpy.int32)

    def turned(self, heading: numpy.ndarray):
        """Quaternions about z, of half precision as the schema has them: w comes last in memory."""
        quaternions = numpy.zeros((len(heading), 4), dtype=numpy.float16)
        quaternions[:, 2], quaternions[:, 3] = numpy.sin(0.5 * heading), numpy.cos(0.5 * heading)
        return self.vt.QuathArray.FromNumpy(quaternions)

    def extent(self, places: numpy.ndarray, sizes: numpy.ndarray):
        """A box round everybody who is there, however they are turned."""
        if not len(places):
            return self.vectors(numpy.zeros((2, 3)))
        reach = numpy.abs([self.low[:2], self.high[:2]]).max() * numpy.sqrt(2) * sizes.max()
        up = float(self.high[2] * sizes.max())
        return self.vectors(numpy.array([places.min(axis=0) - [reach, reach, 0],
                                         places.max(axis=0) + [reach, reach, up]]))


def costumes(people: numpy.ndarray) -> tuple[numpy.ndarray, numpy.ndarray]:
    """The colours of all tops, and which everybody wears: those that overrides give, and else one by the row."""
    tops = [tuple(top) for top in TOPS]
    worn = (numpy.arange(len(people)) * 0.61803398875 % 1.0 * len(TOPS)).astype(int)
    for row, text in enumerate(people["tint"] if "tint" in people.dtype.names else []):
        digits = text.removeprefix("#")
        if len(digits) != 6 or not all(each in string.hexdigits for each in digits):
            continue
        # Written as screens show them; USD's colours are linear (IEC 61966-2-1).
        shown = numpy.array([int(digits[place:place + 2], 16) / 255 for place in (0, 2, 4)])
        top = tuple(numpy.where(shown <= 0.04045, shown / 12.92, ((shown + 0.055) / 1.055) ** 2.4).tolist())
        if top not in tops and len(tops) < MOST_COSTUMES:
            tops.append(top)
        worn[row] = tops.index(top) if top in tops else _nearest(tops, top)
    return numpy.array(tops), worn


def _nearest(colours: list[tuple[float, ...]], wanted: tuple[float, ...]) -> int:
    return int(((numpy.array(colours) - wanted) ** 2).sum(axis=1).argmin())
