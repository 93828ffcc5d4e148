# SPDX-License-Identifier: Apache-2.0
"""Names that scenes have in them: of a crowd's modifiers, and of the attributes of its points. Saved files keep them,
so they stay as they are."""
from ..formats import STREAMS

CACHES = tuple(f"throng {stream}" for stream in STREAMS)
INSTANCERS = ("throng people", "throng people (viewport)")
CONFORM = "throng conform"  # the modifier that looks for the ground

NATURE = "throng_nature"
LEVEL = "throng_level"    # of detail, of each person; see tools/levels.py
FIGURE = "throng_figure"
BIGGER = "throng_bigger"  # how much larger than 1 somebody's scale is; nobody's where there is no such attribute
HIDDEN = "throng_hidden"  # 1 for those who are left out; see tools/culling.py
GROUND = "throng_ground"  # slopes along the heading and to the left of it, and the height; see footing.py
NEAR = "throng_near"      # from 1 on for those who are bent into their pose, more for those who are close; see near.py
COARSE = "throng_coarse"  # how coarse somebody is on the screen, 0 is as in final pictures; see near.py
ROW = "throng_row"        # on the vertices of those: which of the bake's people
WHO = "throng_who"        # of those: which member of the cast
BONE = "throng_bone"      # of a point for each of their bones: which one
SEATS = "throng_seats"      # of a cast: how many clips its figures have for who has a seat
