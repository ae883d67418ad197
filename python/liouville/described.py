"""Descriptions of a case: its title, its text, its names."""

from __future__ import annotations

from . import _liouville as native


class Described:
    """Title, text and names of a case."""

    _native: native.Case
    _settings: dict[str, str]

    @property
    def title(self) -> str:
        """Title of the case."""
        return self._native.title

    @property
    def name(self) -> str:
        """Path of the file, or another name for messages."""
        return self._native.name

    @property
    def text(self) -> str:
        """Text of the case, as in a file."""
        return self._native.text

    @property
    def system(self) -> str:
        """Kind of the system, such as `field` or `rubber-plane`."""
        return self._native.system

    @property
    def source(self) -> str:
        """Publication that the case is taken from."""
        return self._native.source

    @property
    def digest(self) -> str:
        """SHA-256 of the text."""
        return self._native.digest

    @property
    def remarks(self) -> list[str]:
        """Warnings, and remarks on what may be a slip."""
        return self._native.remarks

    @property
    def state(self) -> list[str]:
        """Names of the components of the state."""
        return self._native.state

    @property
    def parameters(self) -> dict[str, str]:
        """Names of the parameters: `fixed`, `drawn` for every state, or `computed` from others."""
        return dict(self._native.parameters)

    @property
    def claims(self) -> dict[str, str | None]:
        """Names of the claims, with their formulas."""
        return {name: formula for name, _, formula in self._native.claims}
