# SPDX-License-Identifier: Apache-2.0
"""Long shots: what people do in files of their own, some frames in each (value clips). Only some of them are open while
the stage is written, and while it is played."""
from __future__ import annotations

import pathlib

CROWD = "/World/Crowd"
MANIFEST = "manifest.usda"


def folder_of(path: str | pathlib.Path) -> pathlib.Path:
    """Where the clips of a stage are: beside it."""
    path = pathlib.Path(path)
    return path.with_name(f"{path.stem}.clips")


def write_clips(stage, crowd, folder: pathlib.Path, name: str) -> None:
    """@param stage crowd.Stage; @param crowd its point instancer; @param folder to write into, whose name will be
    `name`"""
    every = list(range(0, stage.bake.frames, stage.every))
    step = max(1, stage.chunk // stage.every)
    starts, paths = list(range(0, len(every), step)), []
    for number, first in enumerate(starts, 1):
        paths.append(f"{number:04d}.usdc")
        # The next one's first frame ends each, so that what is between them is, too.
        _write(stage, folder / paths[-1], every[first:first + step + 1])
    _write(stage, folder / MANIFEST, [])
    with stage.sdf.ChangeBlock():
        crowd.GetPrim().SetMetadata("clips", {"default": {
            "assetPaths": stage.sdf.AssetPathArray([stage.sdf.AssetPath(f"./{name}/{path}") for path in paths]),
            "primPath": CROWD,
            "manifestAssetPath": stage.sdf.AssetPath(f"./{name}/{MANIFEST}"),
            "active": stage.vt.Vec2dArray([stage.gf.Vec2d(every[first] + 1, number)
                                           for number, first in enumerate(starts)]),
            "times": stage.vt.Vec2dArray([stage.gf.Vec2d(frame + 1, frame + 1) for frame in (every[0], every[-1])])}})


def _write(stage, path: pathlib.Path, frames: list[int]) -> None:
    made = stage.usd.Stage.CreateNew(str(path))
    stage.samples(stage.geom.PointInstancer.Define(made, CROWD), frames)
    if frames:
        made.SetStartTimeCode(frames[0] + 1)
        made.SetEndTimeCode(frames[-1] + 1)
    made.SetTimeCodesPerSecond(stage.bake.fps)
    made.GetRootLayer().Save()
