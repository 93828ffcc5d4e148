# SPDX-License-Identifier: Apache-2.0
"""The poses in which people of a sample bake are to be seen."""
from pose_names import pose_name
import results  # noqa: F401  it puts the add-on on the path
from throng import cast

REPERTOIRE = cast.Repertoire((0.7, 1.0, 1.4, 1.8))


def expected_poses(state, direction, row, frame, level=0, repertoire=REPERTOIRE):
    """Names of the poses that somebody may have: those who stand have a beat of their own."""
    activity, variation, phase = state[row]
    if direction[row, 2] > 0.1:
        poses = [repertoire.walking_pose(round((activity % 1.0) * 16), phase, level)]
    else:
        pick = row % 4 if int(activity) == 2 else row % 2
        beat = (row * 0.618034 + frame / 80.0) % 1.0 * cast.BEATS
        beats = {int(beat), int(beat + 1e-3) % cast.BEATS, int(beat - 1e-3) % cast.BEATS}
        poses = [repertoire.standing_pose(cast.gait.STANDING_CLIPS[pick], b, level) for b in beats]
    return [pose_name(int(variation), pose, level) for pose in poses]


def is_expected(name, *arguments, **options):
    """Whether a name of pose_names.Names.of() is one of them."""
    return not set(name.split("|")).isdisjoint(expected_poses(*arguments, **options))
