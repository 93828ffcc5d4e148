# SPDX-License-Identifier: Apache-2.0
"""Where panels are."""


class InSidebar:
    """In the 3D view's sidebar, tab Throng."""

    bl_space_type, bl_region_type, bl_category = "VIEW_3D", "UI", "Throng"


class Below(InSidebar):
    """Folded away below the panel Throng."""

    bl_parent_id = "VIEW3D_PT_throng"
    bl_options = {"DEFAULT_CLOSED"}
