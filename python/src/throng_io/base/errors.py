# SPDX-License-Identifier: Apache-2.0
"""What can go wrong, each with its place and a hint."""
from __future__ import annotations

import dataclasses
import importlib
import types


@dataclasses.dataclass(frozen=True)
class Diagnostic:
    """One mistake in a layout: where it is, what is wrong, and what would be right."""
    message: str
    file: str = ""
    line: int = 0
    column: int = 0
    pointer: str = ""
    hint: str = ""
    severity: str = "error"

    @classmethod
    def of(cls, told: dict) -> Diagnostic:
        """As the program tells it with --json."""
        known = {field.name for field in dataclasses.fields(cls)}
        return cls(**{key: value for key, value in told.items() if key in known})

    def __str__(self) -> str:
        place = ":".join(str(part) for part in (self.file, self.line, self.column) if part)
        text = ": ".join(part for part in (place, self.severity, self.pointer, self.message) if part)
        return f"{text}\n  hint: {self.hint}" if self.hint else text


class ThrongError(Exception):
    """Anything that this package complains about: one sentence, and a hint where there is one."""

    def __init__(self, message: str, hint: str = ""):
        super().__init__(message)
        self.message, self.hint = message, hint

    def __str__(self) -> str:
        return f"{self.message}\n  hint: {self.hint}" if self.hint else self.message


class MissingExtra(ThrongError, ImportError):
    """A library is not installed that only some of this package needs."""


class BakeError(ThrongError):
    """A folder that is no bake, or one whose files do not fit each other."""


class ImportFailed(ThrongError):
    """A scene of another program that cannot be read: `file`, and `line` where it is known."""

    def __init__(self, message: str, file: str = "", line: int = 0, hint: str = ""):
        place = ":".join(str(part) for part in (file, line) if part)
        super().__init__(f"{place}: {message}" if place else message, hint)
        self.file, self.line = file, line


class ProgramError(ThrongError):
    """The program throng ended with an error: its exit `code`, and every mistake of a layout in `diagnostics`."""

    def __init__(self, message: str, code: int, hint: str = "", diagnostics: list[Diagnostic] | None = None):
        super().__init__(message, hint)
        self.code, self.diagnostics = code, diagnostics or []

    def __str__(self) -> str:
        return "\n".join([super().__str__(), *map(str, self.diagnostics)])


class InvalidLayout(ProgramError):
    """Exit code 3: the layout, or another file given to the program, is not valid."""


def need(module: str, extra: str) -> types.ModuleType:
    """A module of a library that an extra of this package brings."""
    try:
        return importlib.import_module(module)
    except ModuleNotFoundError as error:
        library = module.partition(".")[0]
        if error.name is None or error.name.partition(".")[0] != library:
            raise
        raise MissingExtra(f"{library} is not installed",
                           f'python3 -m pip install "throng-io[{extra}]" brings it') from error
