"""Exceptions of liouville."""

from __future__ import annotations

from typing import NamedTuple


class Mistake(NamedTuple):
    """A mistake at a place of a text."""

    message: str
    help: str | None
    line: int | None
    column: int | None
    text: str
    """Message with an excerpt and carets, for a terminal."""


class LiouvilleError(Exception):
    """Any error that is about a case, a formula, a motion or a search."""


class CaseError(LiouvilleError, ValueError):
    """Mistakes in a case, each at its place; `str()` shows all of them with carets."""

    def __init__(self, mistakes: list[tuple[str, str | None, int | None, int | None, str]]):
        self.mistakes = [Mistake(*one) for one in mistakes]
        super().__init__("\n\n".join(one.text for one in self.mistakes))

    def __reduce__(self):
        return type(self), ([tuple(one) for one in self.mistakes],)

    @property
    def message(self) -> str:
        """Message about the first mistake."""
        return self.mistakes[0].message

    @property
    def help(self) -> str | None:
        """Correction of the first mistake."""
        return self.mistakes[0].help

    @property
    def line(self) -> int | None:
        """Line of the first mistake, from 1; `None` if it concerns the whole text."""
        return self.mistakes[0].line

    @property
    def column(self) -> int | None:
        """Column of the first mistake in characters, from 1."""
        return self.mistakes[0].column


class FormulaError(CaseError):
    """A mistake in a formula that was given as an argument."""


class _Helped(LiouvilleError, RuntimeError):
    def __init__(self, message: str, help: str):
        super().__init__(message, help)
        self.message = message
        self.help = help

    def __str__(self) -> str:
        return f"{self.message}\nhelp: {self.help}" if self.help else self.message


class MotionError(_Helped):
    """A motion that cannot be followed."""


class SearchError(_Helped):
    """A search that is impossible."""


class MotionWarning(UserWarning):
    """Some of several motions ended early, or did not start."""
