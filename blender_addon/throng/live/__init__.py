# SPDX-License-Identifier: Apache-2.0
"""The crowd of a layout while one works on it, or of a bake under way: what `throng watch` tells, in the viewport."""
