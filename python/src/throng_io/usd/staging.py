# SPDX-License-Identifier: Apache-2.0
"""A camera that looks at the crowd, a sun and a sky: a stage of its own shows something."""
from __future__ import annotations

import math

import numpy
import shapely

from ..base.geometry import wall_shape

LENS, WIDE, HIGH = 0.36, 0.36, 0.2025   # tenths of a metre, as the schema has them: a picture of 16 to 9
MOMENT = 0.4                            # of the shot: where people are then
HEIGHTS = (24.0, 32.0, 45.0, 60.0, 85.0)  # degrees, of the camera over the crowd: the first from which it is seen
WAYS = 16                               # round it
SAMPLES = 24                            # of what is between
NEAREST, FURTHEST = 6.0, 60.0           # m, of those who have to be in the picture, from their middle
SUN, SKY = 0.8, 0.6                     # intensities


def add_staging(stage) -> None:
    """@param stage crowd.Stage"""
    _add_camera(stage)
    gf, lux = stage.gf, stage.lux
    stage.geom.Scope.Define(stage.stage, "/World/Lights")
    sun = lux.DistantLight.Define(stage.stage, "/World/Lights/sun")
    sun.CreateIntensityAttr(SUN)
    sun.CreateAngleAttr(0.53)
    sun.CreateColorAttr(gf.Vec3f(1.0, 0.95, 0.87))
    stage.geom.Xformable(sun.GetPrim()).AddRotateXYZOp().Set(gf.Vec3f(38.0, 12.0, 35.0))
    sky = lux.DomeLight.Define(stage.stage, "/World/Lights/sky")
    sky.CreateIntensityAttr(SKY)
    sky.CreateColorAttr(gf.Vec3f(0.62, 0.74, 0.92))


def _add_camera(stage) -> None:
    middle, reach = _where(stage.bake)
    distance = reach / math.tan(math.atan(0.5 * HIGH / LENS)) * 0.8
    way = _clear_way(stage.bake, middle, distance)
    camera = stage.geom.Camera.Define(stage.stage, "/World/Camera")
    camera.CreateFocalLengthAttr(LENS)
    camera.CreateHorizontalApertureAttr(WIDE)
    camera.CreateVerticalApertureAttr(HIGH)
    camera.CreateClippingRangeAttr(stage.gf.Vec2f(0.1, 2000.0))
    camera.CreateFocusDistanceAttr(distance)
    camera.CreateShutterOpenAttr(-0.25)
    camera.CreateShutterCloseAttr(0.25)
    matrix = stage.gf.Matrix4d().SetLookAt(stage.gf.Vec3d(*(middle + way * distance).tolist()),
                                           stage.gf.Vec3d(*middle.tolist()), stage.gf.Vec3d(0, 0, 1)).GetInverse()
    stage.geom.Xformable(camera.GetPrim()).AddTransformOp().Set(matrix)


def _clear_way(bake, middle: numpy.ndarray, distance: float) -> numpy.ndarray:
    """From the crowd to the camera: no wall is between."""
    walls = [(wall_shape(wall), wall.get("ground", (0.0, 0.0))[1] + wall.get("height", 3.0))
             for wall in bake.about["geometry"]["walls"]]
    for up in map(math.radians, HEIGHTS):
        for turn in range(WAYS):
            around = 2.0 * math.pi * (turn + 10.5) / WAYS  # from the south-west on
            way = numpy.array([math.cos(around) * math.cos(up), math.sin(around) * math.cos(up), math.sin(up)])
            line = bake.origin + middle + numpy.linspace(0.1, 1.1, SAMPLES)[:, None] * distance * way
            if not any((shapely.contains_xy(shape, line[:, 0], line[:, 1]) & (line[:, 2] < high + 0.5)).any()
                       for shape, high in walls):
                return way
    return way


def _where(bake) -> tuple[numpy.ndarray, float]:
    """(the middle of those who are there, how far most of them are from it)."""
    frame = int(MOMENT * (bake.frames - 1))
    places = numpy.array(bake.pos[frame][bake.there(frame)], dtype=float)
    if not len(places):
        return numpy.array([0.0, 0.0, 1.0]), NEAREST
    middle = numpy.median(places, axis=0)
    away = numpy.linalg.norm(places[:, :2] - middle[:2], axis=1)
    return middle + [0.0, 0.0, 1.0], float(numpy.clip(numpy.quantile(away, 0.6), NEAREST, FURTHEST))
