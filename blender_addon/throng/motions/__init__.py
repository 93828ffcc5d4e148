# SPDX-License-Identifier: Apache-2.0
"""Motion of one's own: a clip of anybody's skeleton becomes a walk, or a way to stand, of the people in a cast.

A file or an armature becomes a Take (takes.py): joints and how they go. Its bones are matched with a body's
(matching.py), one cycle of it is found and made straight (cycles.py), and what is left is a Motion (motion.py), which
tells of no skeleton any more: directions of limbs, turns of the trunk, when feet are planted. That is put onto
somebody's bones (retarget.py), with feet that stay where they are by the mathematics of own characters, and written
over poses of their sheet (members.py). Blender is needed from sources.py and members.py on.
"""
from ..characters import CharacterError


class MotionError(CharacterError):
    """A clip cannot be used; the message says why and what to do."""
