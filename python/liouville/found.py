"""Invariants that a search found."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

from ._table import Table, html

if TYPE_CHECKING:
    from .case import Case


@dataclass(frozen=True)
class Found:
    """An invariant that was found, with its verdict."""

    case: Case
    entry: dict[str, Any]
    """All that is known, as in docs/json.md."""

    @property
    def kind(self) -> str:
        """`integral`, `density`, `symmetry-field`, `bracket`, …"""
        return self.entry["kind"]

    @property
    def formula(self) -> str:
        """Formula in the names of the case."""
        return self.entry["formula"]

    @property
    def abbreviations(self) -> dict[str, str]:
        """Names in the formula that the case does not have, with their formulas."""
        return dict(self.entry.get("let", []))

    @property
    def verdict(self) -> str:
        """`proved` or `confirmed`."""
        return self.entry["verdict"]

    @property
    def known(self) -> str | None:
        """Name of the claim of the case from which it follows."""
        return self.entry.get("known")

    @property
    def given(self) -> list[tuple[str, str]]:
        """Pairs of a word and a formula: the `value` of a parameter or the `condition` on several
        with which it is one, the potential or gyrostat that it needs, the cofactor of a Darboux
        polynomial, the rate of a function, the Hamiltonian and the Casimirs of a bracket."""
        return [(word, formula) for word, formula in self.entry.get("with", [])]

    def to_sympy(self, symbols: dict[str, Any] | None = None):
        """Formula as an expression of SymPy in the components of the state."""
        from .symbolic import to_sympy

        return to_sympy(self.case, self.formula, symbols, self.abbreviations)

    def __repr__(self) -> str:
        return f"<{self.kind} {self.formula}: {self.verdict}>"


class Search(Table[Found]):
    """The outcome of a search: invariants, and theorems of their absence."""

    def __init__(self, case: Case, outcome: dict[str, Any]):
        self.case = case
        self.outcome = outcome
        """The outcome as `liouville search --json` prints it."""

    @cached_property
    def found(self) -> list[Found]:
        """All invariants that were found."""
        return [Found(self.case, entry) for entry in self.outcome["found"]]

    def _records(self) -> list[Found]:
        return self.found

    @property
    def integrals(self) -> list[Found]:
        """The integrals among them."""
        return [found for found in self.found if found.kind == "integral"]

    @property
    def densities(self) -> list[Found]:
        """The invariant densities among them."""
        return [found for found in self.found if found.kind == "density"]

    @property
    def theorems(self) -> list[str]:
        """Theorems that there is nothing else of some form, with their hypotheses."""
        return [one["theorem"] for one in self.outcome["excluded"]]

    @property
    def conditions(self) -> list[dict[str, Any]]:
        """Equations for the parameters, each sufficient for what `of` names."""
        return self.outcome["conditions"]

    @property
    def unreached(self) -> list[str]:
        """Parts that a search did not reach in its time; empty after a complete one."""
        return self.outcome["unreached"]

    @property
    def remarks(self) -> list[str]:
        """Parts that could not be carried out, with reasons."""
        return self.outcome["remarks"]

    def to_dicts(self) -> list[dict[str, Any]]:
        """One row an invariant."""
        return [
            {
                "kind": found.kind,
                "formula": found.formula,
                "known": found.known,
                "verdict": found.verdict,
            }
            for found in self.found
        ]

    def __repr__(self) -> str:
        lines = [f"{self.case.title}: {len(self)} found"]
        lines += [f"  {found.kind} {found.verdict}: {found.formula}" for found in self.found]
        lines += [f"  theorem: {theorem}" for theorem in self.theorems]
        return "\n".join(lines)

    def _repr_html_(self) -> str:
        return html(f"{self.case.title}: {len(self)} found", self.to_dicts())
