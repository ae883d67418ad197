"""Verdicts on the claims of a case."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

from ._table import Table, html

_COLOURS = {
    "proved": "color:#1a7f37",
    "confirmed": "color:#1a7f37",
    "refuted": "color:#cf222e",
    "undecided": "color:#9a6700",
}


@dataclass(frozen=True)
class Claim:
    """A claim with its verdict; `bool()` tells whether the verdict is as expected."""

    entry: dict[str, Any]
    """All that is known, as in docs/json.md."""

    @property
    def name(self) -> str:
        """Name of the claim in its case."""
        return self.entry["name"]

    @property
    def kind(self) -> str:
        """Key of the statement: `integral`, `density`, …"""
        return self.entry["kind"]

    @property
    def formula(self) -> str | None:
        """Formula of the claim, if it has one."""
        return self.entry.get("formula")

    @property
    def verdict(self) -> str:
        """`proved`, `confirmed`, `refuted` or `undecided`."""
        return self.entry["verdict"]

    @property
    def expect(self) -> str:
        """`holds`, `fails` or `open`."""
        return self.entry["expect"]

    @property
    def agrees(self) -> bool:
        """Whether the verdict is as expected."""
        return self.entry["agrees"]

    @property
    def where(self) -> str:
        """Place at which it is claimed."""
        return self.entry["where"]

    @property
    def evidence(self) -> dict[str, Any]:
        """Grounds of the verdict."""
        return self.entry["evidence"]

    @property
    def rung(self) -> str:
        """Method that settled the claim, such as `prime field` or `ball`."""
        return self.evidence.get("method") or ""

    @property
    def error_log2(self) -> float | None:
        """Logarithm to base 2 of the probability that the proof is wrong."""
        return self.evidence.get("error_log2")

    @property
    def witness(self) -> dict[str, Any] | None:
        """State at which the claim fails, in exact numbers, if a state refuted it."""
        return self.evidence.get("witness")

    @property
    def reason(self) -> str | None:
        """Reason why the claim is undecided, or another remark on the verdict."""
        return self.evidence.get("reason")

    def __bool__(self) -> bool:
        return self.agrees

    def __repr__(self) -> str:
        formula = f" {self.formula}" if self.formula else ""
        return f"<{self.kind} {self.name}:{formula} {self.verdict}>"


class Report(Table[Claim]):
    """Verdicts on all claims; `bool()` tells whether all of them are as expected."""

    def __init__(self, run: dict[str, Any]):
        self.run = run
        """The run as `liouville check --json` prints it."""

    @property
    def _case(self) -> dict[str, Any]:
        return self.run["cases"][0]

    @property
    def title(self) -> str:
        """Title of the case."""
        return self._case["title"]

    @property
    def version(self) -> str:
        """Version of liouville that judged."""
        return self.run["version"]

    @property
    def digest(self) -> str:
        """SHA-256 of the text of the case."""
        return self._case["digest"]

    @property
    def warnings(self) -> list[str]:
        """Warnings and remarks about the case."""
        return self._case.get("warnings", []) + self._case.get("remarks", [])

    @property
    def mutants(self) -> dict[str, Any] | None:
        """Verdicts on mutants of the claims, if they were asked for."""
        return self._case.get("mutants")

    @cached_property
    def claims(self) -> list[Claim]:
        """All claims with their verdicts."""
        return [Claim(entry) for entry in self._case["claims"]]

    def _records(self) -> list[Claim]:
        return self.claims

    def __getitem__(self, place):
        if isinstance(place, str):
            for claim in self.claims:
                if claim.name == place:
                    return claim
            raise KeyError(place)
        return self.claims[place]

    def __bool__(self) -> bool:
        survived = (self.mutants or {}).get("survived", [])
        return all(self.claims) and not survived

    def to_dicts(self) -> list[dict[str, Any]]:
        """One row a claim."""
        return [
            {
                "name": claim.name,
                "kind": claim.kind,
                "formula": claim.formula,
                "where": claim.where,
                "expect": claim.expect,
                "verdict": claim.verdict,
                "agrees": claim.agrees,
                "rung": claim.rung,
                "error_log2": claim.error_log2,
                "reason": claim.reason,
            }
            for claim in self.claims
        ]

    def __repr__(self) -> str:
        lines = [f"{self.title}: {len(self)} claims"]
        lines += [f"  {claim.verdict:9}  {claim.name}" for claim in self.claims]
        return "\n".join(lines)

    def _repr_html_(self) -> str:
        keys = ("name", "kind", "formula", "rung", "verdict")
        rows = [{key: row[key] for key in keys} for row in self.to_dicts()]
        return html(self.title, rows, lambda row: _COLOURS[row["verdict"]])
