# SPDX-License-Identifier: Apache-2.0
"""Bakes: read, made, and written for other programs."""
