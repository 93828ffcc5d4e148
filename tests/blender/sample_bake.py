# SPDX-License-Identifier: Apache-2.0
"""Writes a small synthetic bake whose every value is known, without the command line."""
import json
import pathlib
import struct
import sys

import numpy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent.parent / "blender_addon"))
from throng.formats.xxh3 import hash_of  # noqa: E402

STRIDES = [0.7, 1.0, 1.4, 1.8]
SMALL_CAST = {"variations": 2, "gaits": (1,)}  # a crowd of these comes in a tenth of the time: 64 figures are not built


def write_bake(folder, agents=63, frames=40, fps=24.0, seed=7, variations=8, gaits=range(len(STRIDES))):
    """People on arcs, in some gaits; some enter late, some leave early, some stand. Returns (pos, dir, state)."""
    random = numpy.random.default_rng(seed)
    time = numpy.arange(frames)[:, None] / fps
    speed = numpy.where(numpy.arange(agents) % 7 == 3, 0.0, random.uniform(0.8, 1.7, agents))
    heading = random.uniform(-3.1, 3.1, agents) + random.uniform(-0.5, 0.5, agents) * time
    step = speed / fps
    start = random.uniform(-15.0, 15.0, (2, agents))
    pos = numpy.zeros((frames, agents, 3), "<f4")
    pos[..., 0] = start[0] + numpy.cumsum(numpy.cos(heading) * step, axis=0)
    pos[..., 1] = start[1] + numpy.cumsum(numpy.sin(heading) * step, axis=0)
    direction = numpy.stack([numpy.cos(heading), numpy.sin(heading), numpy.broadcast_to(speed, heading.shape)],
                            axis=2).astype("<f4")
    state = numpy.ones((frames, agents, 3), "<f4")
    gait = numpy.array(gaits)[numpy.arange(agents) % len(gaits)]
    state[..., 0] += gait / 16.0
    state[:, speed == 0.0, 0] += 1.0  # stands
    state[..., 1] = numpy.arange(agents) % variations
    state[..., 2] = random.uniform(0.0, 1.0, agents) + numpy.arange(frames)[:, None] * step / numpy.array(STRIDES)[gait]
    for row in range(agents):
        first = 10 if row % 9 == 4 else 0
        last = 25 if row % 9 == 6 else frames - 1
        state[:first, row, 0] = state[last + 1:, row, 0] = 0.0
        for stream in (pos, direction):
            stream[:first, row] = stream[first, row]
            stream[last + 1:, row] = stream[last, row]
        state[:first, row, 2], state[last + 1:, row, 2] = state[first, row, 2], state[last, row, 2]
    (folder / "streams").mkdir(parents=True)
    for name, stream in (("pos", pos), ("dir", direction), ("state", state)):
        numpy.save(folder / "streams" / f"{name}.npy", stream)
        with open(folder / "streams" / f"{name}.pc2", "wb") as file:
            file.write(struct.pack("<12siiffi", b"POINTCACHE2\0", 1, agents, 1.0, 1.0, frames) + stream.tobytes())
    manifest = {
        "format": "throng bake", "version": 1, "name": "sample", "complete": True, "fps": fps, "frames": frames,
        "frame_start": 1, "agents": agents, "variations": variations, "strides": STRIDES, "gaits": sorted(gaits),
        "origin": [0.0, 0.0, 0.0], "bounds": {"min": [-20.0, -20.0], "max": [20.0, 20.0]},
        "streams": {name: {"npy": f"streams/{name}.npy", "pc2": f"streams/{name}.pc2"}
                    for name in ("pos", "dir", "state")},
        "geometry": {"walls": [{"id": "house", "points": [[10, 10], [18, 10], [18, 18], [10, 18]], "closed": True,
                                "thickness": 0.2, "height": 9.0},
                               {"id": "rail", "points": [[-9, 9], [-4, 9]], "closed": False, "thickness": 0.2,
                                "height": 1.0},
                               {"id": "gate", "points": [[-4, 9], [-2, 9]], "closed": False, "thickness": 0.1,
                                "height": 1.0, "gate": {"open_at_start": False, "toggles": [0.5, 1.2]}}],
                     "roads": [{"id": "a", "centreline": [[-20, 0], [20, 0]], "width": 8.0, "one_way": False},
                               {"id": "b", "centreline": [[0, -20], [0, 20]], "width": 8.0, "one_way": False}],
                     "areas": [{"id": "plaza", "polygon": [[-18, -18], [-8, -18], [-8, -8], [-18, -8]]}]}}
    manifest["files"] = [{"path": path.relative_to(folder).as_posix(), "bytes": path.stat().st_size,
                          "xxh3": hash_of(path)} for path in sorted(folder.rglob("*.*"))]
    (folder / "bake.json").write_text(json.dumps(manifest))
    return pos, direction, state
