# SPDX-License-Identifier: Apache-2.0
"""Layers of changes (docs/layers.md): written here, applied by `throng apply`, shown as a crowd of their own."""
