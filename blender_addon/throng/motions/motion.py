# SPDX-License-Identifier: Apache-2.0
"""What is left of a clip when its skeleton is taken away: it suits everybody. No Blender here.

Frame: x forward, y left, z up. Turns of trunk, head and feet are from standing upright with the feet ahead; limbs are
the directions of their parts, with the axis that knee or elbow bends about; the hips' way is in lengths of the leg.
"""
import base64
import json
import zlib
from dataclasses import dataclass

import numpy

TRUNK = ("pelvis", "spine_01", "spine_02", "spine_03", "neck_01", "head")
WALKS, STANDS = "walks", "stands"
_ARRAYS = ("trunk", "legs", "feet", "arms", "hips")


@dataclass
class Motion:
    """Of N moments: a cycle, evenly, or beats of a stand. Right comes before left."""
    name: str
    kind: str              # WALKS or STANDS
    trunk: numpy.ndarray   # (N, len(TRUNK), 3, 3)
    legs: numpy.ndarray    # (N, 2, 3, 3): directions of thigh and shin, and the knee's axis, as rows
    feet: numpy.ndarray    # (N, 2, 3, 3)
    arms: numpy.ndarray    # (N, 2, 3, 3): upper arm, forearm, elbow's axis; zeros where the skeleton has none
    hips: numpy.ndarray    # (N, 3), lengths of the leg, from where they are on average
    stride: float = 0.0    # m, of the cycle, as the clip's own skeleton takes it
    leg: float = 0.0       # m, of that skeleton
    stance: tuple = ()     # of both feet (when it comes down, how long it stays), shares of the cycle

    def has_arm(self, side):
        return bool(numpy.abs(self.arms[:, side]).max() > 0.0)

    def text(self):
        """As .blend files keep it."""
        head = {name: getattr(self, name) for name in ("name", "kind", "stride", "leg", "stance")}
        flat = numpy.concatenate([getattr(self, name).ravel() for name in _ARRAYS]).astype("<f4")
        head["data"] = base64.b64encode(zlib.compress(flat.tobytes(), 9)).decode("ascii")
        return json.dumps(head)

    @classmethod
    def of(cls, text):
        head = json.loads(text)
        flat = numpy.frombuffer(zlib.decompress(base64.b64decode(head.pop("data"))), "<f4").astype(float)
        shapes = ((len(TRUNK), 3, 3), (2, 3, 3), (2, 3, 3), (2, 3, 3), (3,))
        sizes = [int(numpy.prod(shape)) for shape in shapes]
        count, arrays, start = len(flat) // sum(sizes), {}, 0
        for name, shape, size in zip(_ARRAYS, shapes, sizes):
            arrays[name] = flat[start:start + count * size].reshape(count, *shape)
            start += count * size
        head["stance"] = tuple(map(tuple, head["stance"]))
        return cls(**head, **arrays)
