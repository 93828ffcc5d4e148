# SPDX-License-Identifier: Apache-2.0
"""Throng's crowds in Python: bakes as NumPy arrays, the program as functions, and other programs' formats."""
from .bakes.bake import Activity, Bake
from .bakes.program import Batch, bake, batch, check, measure
from .base.errors import (BakeError, Diagnostic, ImportFailed, InvalidLayout, MissingExtra, ProgramError,
                          ThrongError)

__version__ = "0.1.0"
__all__ = ["Activity", "Bake", "BakeError", "Batch", "Diagnostic", "ImportFailed", "InvalidLayout", "MissingExtra",
           "ProgramError", "ThrongError", "bake", "batch", "check", "measure"]
