# SPDX-License-Identifier: Apache-2.0
"""People of the cast as meshes on joints, and how a bake moves them, for whatever is written with skeletons."""
