# SPDX-License-Identifier: Apache-2.0
"""What the bake and the add-on both have to know, in two languages: strides, and when feet are planted."""
import pathlib
import re
import sys

import pytest

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "blender_addon"))
from throng.cast import gait  # noqa: E402


def number(path, name):
    """The number that a constant has in a file."""
    text = (ROOT / path).read_text()
    found = re.search(rf"\b{name} = ([-\d.e]+)f?", text)
    assert found, f"{path} has no {name}"
    return float(found[1])


def test_from_where_people_walk():
    header, nodes = "recording/carriages.h", "blender_addon/throng/crowd/near.py"
    assert number(header, "kStandsBelow") == number(nodes, "STANDS_BELOW")
    assert number(header, "kWalksFrom") == number(nodes, "WALKS_FROM")
    package = "python/src/throng_io/skinned/motions.py"
    assert [number(package, name) for name in ("STANDS_BELOW", "WALKS_FROM")] == [
        number(nodes, name) for name in ("STANDS_BELOW", "WALKS_FROM")]
    assert number(package, "FRAMES_A_ROUND") == number("blender_addon/throng/crowd/poses.py", "FRAMES_A_ROUND")
    assert number("python/src/throng_io/skinned/members.py", "MOST_MEMBERS") == number(
        "blender_addon/throng/people/members.py", "MEMBERS")
    assert number("shaders/shared/walking.h", "STANDING_SPEED") == number("blender_addon/throng/crowd/poses.py",
                                                                          "STANDING_SPEED")


def test_strides_and_when_feet_are_planted():
    steps, gaits = "recording/footsteps.cpp", "recording/gaits.cpp"
    assert number("recording/gaits.h", "kNormalStride") == gait.NORMAL_STRIDE
    assert number(gaits, "kStrideAtOne") == gait.STRIDE_AT_ONE
    assert number(steps, "kRunningStride") == gait.RUNNING_STRIDE
    assert number("recording/gaits.h", "kUnderBody") == gait.UNDER_BODY
    for stride in (0.69, 1.446, 1.85):
        told = number(steps, "kDownFor") - number(steps, "kLessDown") * (stride / gait.NORMAL_STRIDE - 1.0)
        assert gait.gait_of(stride).stance == pytest.approx(told), stride
        assert gait.gait_of(stride).down == 0.0
    runs = gait.gait_of(2.37)
    assert (runs.down, runs.stance) == (number(steps, "kRunsDown"), number(steps, "kRunsFor"))
