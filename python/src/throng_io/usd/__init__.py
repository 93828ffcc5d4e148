# SPDX-License-Identifier: Apache-2.0
"""Crowds as USD."""
