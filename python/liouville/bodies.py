"""Tables of bodies: one case, with a row of parameter values for each body."""

from __future__ import annotations

import csv
import io
import numbers
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

from . import _values
from ._table import Table, html

BodyTable = str | Path | Iterable[Mapping[str, Any]] | Any
"""A path of a CSV file, dictionaries by the names of parameters, a DataFrame, an Arrow table."""
WANTED = "settings is a path, a DataFrame, or a list of dictionaries, one a body"

SHOWN = 100
"""Rows of a table in a notebook."""
COUNTS = ("proved", "confirmed", "refuted", "undecided")
LISTS = ("integrals", "densities", "fields", "reversors", "symmetries")
INVARIANTS = ("class", "measure", *LISTS)


@dataclass(frozen=True)
class Body:
    """A body with its verdicts; `bool()` tells whether all of them are as expected."""

    entry: dict[str, Any]
    """All that is known, as in docs/json.md."""

    @property
    def row(self) -> int:
        """Number of the row, from 1."""
        return self.entry["row"]

    @property
    def line(self) -> int:
        """Line of the table, from 1; of dictionaries and frames the names are line 1."""
        return self.entry["line"]

    @property
    def settings(self) -> dict[str, str]:
        """Values of the parameters, as they were written."""
        return self.entry["settings"]

    @property
    def verdicts(self) -> dict[str, str]:
        """Verdicts by the names of the claims; empty where the row is wrong."""
        return self.entry.get("verdicts", {})

    @property
    def invariants(self) -> dict[str, Any]:
        """Of `report`: class, measure, and the names of the invariants."""
        return {name: self.entry[name] for name in INVARIANTS if name in self.entry}

    @property
    def disagreements(self) -> list[str]:
        """Names of the claims whose verdicts are not as expected."""
        return self.entry.get("disagreements", [])

    @property
    def errors(self) -> list[dict[str, str]]:
        """Mistakes of the row, each with its `message` and its `help`."""
        return self.entry.get("errors", [])

    def __getitem__(self, claim: str) -> str:
        return self.verdicts[claim]

    def __bool__(self) -> bool:
        return not self.errors and not self.disagreements

    def __repr__(self) -> str:
        values = ", ".join(f"{name}={value}" for name, value in self.settings.items())
        told = self.errors[0]["message"] if self.errors else ", ".join(_counted(self.verdicts))
        return f"<Body {self.row}: {values}: {told}>"


class Bodies(Table[Body]):
    """Bodies in the order of the rows; `bool()` tells whether all verdicts are as expected."""

    def __init__(self, outcome: dict[str, Any]):
        self.outcome = outcome
        """The results as `liouville check` or `report --settings --json` prints them."""

    @property
    def title(self) -> str:
        """Title of the case."""
        return self.outcome["title"]

    @property
    def claims(self) -> list[str]:
        """Names of the claims."""
        return [claim["name"] for claim in self.outcome["claims"]]

    @property
    def summary(self) -> dict[str, int]:
        """Numbers of bodies, of verdicts, and of rows that are wrong (`errors`)."""
        return self.outcome["summary"]

    @cached_property
    def bodies(self) -> list[Body]:
        """All bodies."""
        return [Body(entry) for entry in self.outcome["bodies"]]

    def _records(self) -> list[Body]:
        return self.bodies

    def __bool__(self) -> bool:
        return all(self.bodies)

    def to_dicts(self) -> list[dict[str, Any]]:
        """One row a body, with the columns of `--settings --format csv`."""
        rows = []
        told = any(body.invariants for body in self.bodies)
        for body in self.bodies:
            found = list(body.verdicts.values())
            counts: dict[str, Any] = {word: found.count(word) for word in COUNTS}
            counts["disagreements"] = len(body.disagreements)
            if body.errors:
                counts = dict.fromkeys(counts)
            verdicts = {f"claim {name}": body.verdicts.get(name) for name in self.claims}
            error = body.errors[0]["message"] if body.errors else None
            place = {"row": body.row, "line": body.line}
            named = _texts(body.invariants) if told else {}
            rows.append(place | body.settings | counts | verdicts | named | {"error": error})
        return rows

    def __repr__(self) -> str:
        counts = self.summary
        told = [f"{counts[word]} {word}" for word in COUNTS if counts[word]]
        told.append(f"{counts['disagreements']} against expectation")
        if counts["errors"]:
            told.append(f"{counts['errors']} wrong rows")
        return f"{self.title}: {len(self)} bodies, {', '.join(told)}"

    def _repr_html_(self) -> str:
        rows = self.to_dicts()[:SHOWN]
        return html(repr(self), rows)


def _texts(invariants: Mapping[str, Any]) -> dict[str, str | None]:
    """Invariants as texts, with `;` between names."""
    lists = {name: "; ".join(invariants[name]) for name in LISTS if name in invariants}
    return dict.fromkeys(INVARIANTS) | dict(invariants) | lists


def _counted(verdicts: Mapping[str, str]) -> list[str]:
    found = list(verdicts.values())
    return [f"{found.count(word)} {word}" for word in COUNTS if word in found]


def written(table: BodyTable) -> tuple[str, str]:
    """Name and text of a table as CSV."""
    if isinstance(table, str) and "\n" in table:
        return "bodies.csv", table
    if isinstance(table, (str, Path)):
        return str(table), Path(table).read_text(encoding="utf-8")
    rows = _rows(table)
    if not all(isinstance(row, Mapping) for row in rows):
        raise TypeError(WANTED)
    names = list(dict.fromkeys(name for row in rows for name in row))
    out = io.StringIO()
    lines = csv.writer(out, lineterminator="\n")
    lines.writerow(names)
    lines.writerows([_cell(row.get(name)) for name in names] for row in rows)
    return "bodies.csv", out.getvalue() if names else ""


def _rows(table: Any) -> list[Any]:
    """Rows of a table: dictionaries, if it is one."""
    if isinstance(table, Mapping) or getattr(table, "ndim", 2) != 2:  # one body; a Series
        return [None]
    if hasattr(table, "to_dicts"):  # of polars, which has `to_dict` too, for columns
        return table.to_dicts()
    if hasattr(table, "to_pylist"):  # of Arrow
        return table.to_pylist()
    if hasattr(table, "to_dict"):  # of pandas
        return table.to_dict("records")
    return list(table) if isinstance(table, Iterable) else [None]


def _cell(value: Any) -> str:
    """A value as text; one that is missing or no number is a mistake of its row alone."""
    if value is None or type(value).__name__ in ("NAType", "NaTType"):
        return ""
    if isinstance(value, numbers.Number) and value != value:  # NaN of any type
        return ""
    try:
        return _values.setting(value)
    except ValueError:
        return str(value)
