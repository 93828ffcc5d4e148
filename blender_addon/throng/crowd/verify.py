# SPDX-License-Identifier: Apache-2.0
"""What is wrong with the bake that a crowd plays."""
import os

from ..formats import POSE, Bake, BakeError, NoPointCaches, check_pc2, read_manifest
from ..formats.listed_files import file_problems
from .queries import absolute, bake_path


def verify(crowd, scene):
    """What is wrong with a crowd's bake, in sentences; empty when all is well."""
    path = bake_path(crowd)
    try:
        bake = Bake(read_manifest(path), os.path.dirname(path))
    except BakeError as error:
        return [str(error)]
    by_stream = {stream: list(_stream_problems(crowd, bake, stream)) for stream in bake.streams}
    problems = [problem for found in by_stream.values() for problem in found]
    told = [bake.manifest["streams"][stream].get("pc2") for stream, found in by_stream.items() if found]
    problems += [sentence for _, sentence in file_problems(bake, told)]
    if len(crowd.data.vertices) != bake.agents:
        problems.append(f"the scene has {len(crowd.data.vertices)} people, the bake {bake.agents}: re-load mends it")
    if not bake.complete:
        problems.append("the bake was stopped before its last frame")
    fps = scene.render.fps / scene.render.fps_base
    if abs(fps - bake.fps) > 1e-3:
        problems.append(f"the scene plays {fps:g} frames a second, the bake has {bake.fps:g}: re-load mends it")
    return problems


def _stream_problems(crowd, bake, stream):
    """Of the file of one stream, and of where the scene looks for it."""
    if f"throng {stream}" not in crowd.modifiers:
        yield ("the bake tells of feet or heads what the crowd in the scene does not know: re-load mends it"
               if stream in POSE else "the bake has a terrain and the crowd in the scene has none: import it anew")
        return
    try:
        check_pc2(bake.stream_path(stream), bake.agents, bake.frames)
    except NoPointCaches as error:
        yield str(error)
        return
    except BakeError as error:
        yield str(error)
    stored = absolute(crowd, crowd.modifiers[f"throng {stream}"].filepath)
    if stored != os.path.normpath(bake.stream_path(stream)):
        yield f"the stream {stream} is played from {stored}, not from the bake's folder: re-load mends it"
