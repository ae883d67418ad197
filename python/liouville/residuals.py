"""Sweeps: the largest residual of claims at very many states."""

from __future__ import annotations

from typing import Any

from ._table import Table, html


class Sweep(Table[dict]):
    """Claims, each a dictionary as `liouville sweep --json` prints it."""

    def __init__(self, outcome: dict[str, Any]):
        self.outcome = outcome

    def _records(self) -> list[dict[str, Any]]:
        return self.outcome["claims"]

    def to_dicts(self) -> list[dict[str, Any]]:
        """One row a claim."""
        names = ("claim", "states", "defined", "largest", "index", "reason")
        return [{name: row[name] for name in names} for row in self]

    def _repr_html_(self) -> str:
        return html(self.outcome["title"], self.to_dicts())

    def __repr__(self) -> str:
        lines = [f"{self.outcome['title']}, {self.outcome['states']} states"]
        for row in self:
            told = row["reason"] or f"at most {row['largest']} at state {row['index']}"
            lines.append(f"  {row['claim']}: {told}")
        return "\n".join(lines)
