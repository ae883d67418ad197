"""Motions as arrays: orbits, sections, charts, exponents."""

from __future__ import annotations

import json
import warnings
from dataclasses import dataclass
from typing import Any

import numpy as np

from ._table import Table, html
from .errors import MotionError, MotionWarning

Problem = tuple[int, str, str]


def array(data: bytearray, width: int) -> np.ndarray:
    """Rows of numbers from bytes."""
    return np.frombuffer(data, dtype=float).reshape(-1, width)


class Orbit:
    """A motion, with samples at equal intervals of time."""

    def __init__(
        self,
        names: list[str],
        state: list[str],
        data: bytearray,
        told: str | None,
        problem: Problem | None,
    ):
        self.columns = names
        """Names of the columns."""
        self.data = array(data, len(names))
        """Samples, one in a row."""
        self.summary: dict[str, Any] = json.loads(told) if told else {}
        """The motion as `liouville motion orbit --json` prints it; empty if it ended early."""
        self.problem = MotionError(*problem[1:]) if problem else None
        """Reason why the motion ended early or did not start."""
        self._state = state

    def __getitem__(self, name: str) -> np.ndarray:
        """A column by its name, or all components of a vector by the name of it."""
        if name in self.columns:
            return self.data[:, self.columns.index(name)]
        places = [k for k, own in enumerate(self.columns) if _is_component(own, name)]
        if not places:
            raise KeyError(f"{name}; the columns are {', '.join(self.columns)}")
        return self.data[:, places]

    @property
    def t(self) -> np.ndarray:
        """Times of the samples."""
        return self["t"]

    @property
    def states(self) -> np.ndarray:
        """States of the samples, one in a row."""
        return np.stack([self[name] for name in self._state], axis=1)

    @property
    def drift(self) -> dict[str, float]:
        """Largest drift of each quantity that should stay constant."""
        followed = self.summary.get("followed", [])
        return {one["name"]: one["drift"] for one in followed if one["role"] != "decoy"}

    @property
    def events(self) -> list[dict[str, Any]]:
        """Events at a one-sided constraint."""
        return self.summary.get("events", [])

    def __len__(self) -> int:
        return len(self.data)

    def to_pandas(self):
        """Samples as a `pandas.DataFrame`."""
        import pandas

        return pandas.DataFrame(self.data, columns=self.columns)

    def to_arrow(self):
        """Samples as a `pyarrow.Table`."""
        import pyarrow

        columns = [pyarrow.array(self.data[:, k]) for k in range(len(self.columns))]
        return pyarrow.table(columns, names=self.columns)

    def __repr__(self) -> str:
        end = f"; {self.problem.message}" if self.problem else ""
        return f"<Orbit: {len(self)} samples of {', '.join(self.columns)}{end}>"


def _is_component(column: str, name: str) -> bool:
    rest = column[len(name) :] if column.startswith(name) else ""
    return bool(rest) and rest.strip("[]").replace(",", "").isdigit()


class Section(np.ndarray):
    """Crossings as an array with named fields: `start`, `direction`, `t`, and the axes."""

    problems: list[Problem]
    """Motions that ended early or did not start: number, message, remedy."""

    @classmethod
    def of(cls, data: tuple[list[str], bytearray], problems: list[Problem]) -> Section:
        """Crossings from bytes."""
        names, raw = data
        rows = array(raw, len(names))
        if not len(rows) and problems:
            raise MotionError(*problems[0][1:])
        fields = [(name, np.int64 if name in ("start", "direction") else float) for name in names]
        section = np.empty(len(rows), dtype=fields).view(cls)
        for place, name in enumerate(names):
            section[name] = rows[:, place]
        section.problems = problems
        if problems:
            number, message, _ = problems[0]
            text = f"{len(problems)} motions ended early; that of start {number}: {message}"
            warnings.warn(text, MotionWarning, stacklevel=3)
        return section

    def __array_finalize__(self, other):
        self.problems = getattr(other, "problems", [])

    @property
    def axes(self) -> list[str]:
        """Names of the axes."""
        return list(self.dtype.names or ())[3:]

    def to_pandas(self):
        """Crossings as a `pandas.DataFrame`."""
        import pandas

        return pandas.DataFrame(np.asarray(self))


CLASSES = (
    "regular",
    "unstable rest",
    "escape",
    "conservative chaos",
    "dissipative chaos",
    "strange repeller",
    "strange attractor",
)
"""Classes of motions by their number in a chart; −1 is no state, −2 a singularity."""


@dataclass(frozen=True)
class Chart:
    """A plane of motions; arrays have a row for each value of `y`, the least first."""

    names: tuple[str, str]
    """Names of the two axes."""
    x: np.ndarray
    """Values along the horizontal axis."""
    y: np.ndarray
    """Values along the vertical axis."""
    character: np.ndarray
    """Classes as places in `liouville.CLASSES`; −1 where no motion starts, −2 for a singularity."""
    exponent: np.ndarray
    """Largest Lyapunov exponents."""
    error: np.ndarray
    """Standard errors of the exponents."""
    divergence: np.ndarray
    """Mean divergences."""
    problems: list[Problem]
    """Motions that ended early or did not start, by their number row by row."""

    @classmethod
    def of(cls, axes, data: bytearray, problems: list[Problem]) -> Chart:
        """A chart from bytes."""
        (x_name, x), (y_name, y) = axes
        x, y = np.frombuffer(x), np.frombuffer(y)
        cells = array(data, 4).reshape(len(y), len(x), 4)
        if problems and len(problems) == len(x) * len(y):
            raise MotionError(*problems[0][1:])
        character = cells[:, :, 0].astype(np.int8)
        exponent, error, divergence = (np.ascontiguousarray(cells[:, :, k]) for k in (1, 2, 3))
        names = (x_name, y_name)
        return cls(names, x, y, character, exponent, error, divergence, problems)

    def to_dicts(self) -> list[dict[str, Any]]:
        """One row a motion."""
        first, second = self.names
        return [
            {
                first: float(x),
                second: float(y),
                "class": {-1: "no state", -2: "singular"}.get(
                    int(self.character[j, i]), CLASSES[max(0, int(self.character[j, i]))]
                ),
                "exponent": float(self.exponent[j, i]),
                "error": float(self.error[j, i]),
                "divergence": float(self.divergence[j, i]),
            }
            for j, y in enumerate(self.y)
            for i, x in enumerate(self.x)
        ]

    def to_pandas(self):
        """One row a motion, as a `pandas.DataFrame`."""
        import pandas

        return pandas.DataFrame(self.to_dicts())


class _Motions(Table[dict]):
    """Motions as dictionaries."""

    def __init__(self, outcome: dict[str, Any]):
        self.outcome = outcome

    def _records(self) -> list[dict[str, Any]]:
        return self.outcome["motions"]

    def _repr_html_(self) -> str:
        return html(self.outcome["title"], self.to_dicts())

    def __repr__(self) -> str:
        lines = [self.outcome["title"]]
        lines += ["  " + ", ".join(f"{k} {v}" for k, v in row.items()) for row in self.to_dicts()]
        return "\n".join(lines)


class Exponents(_Motions):
    """Largest exponents of motions, each a dictionary as `liouville motion exponents --json`."""

    def to_dicts(self) -> list[dict[str, Any]]:
        """One row a motion."""

        def mean(row: dict, key: str, part: str = "mean"):
            return row.get(key, {}).get(part)

        return [
            {
                "start": row["start"],
                "class": row["class"],
                "exponent": mean(row, "largest"),
                "error": mean(row, "largest", "error"),
                "divergence": mean(row, "divergence"),
                "problem": row.get("problem"),
            }
            for row in self
        ]


class Spectra(_Motions):
    """Spectra of motions, each a dictionary as `liouville motion exponents --spectrum --json`."""

    def to_dicts(self) -> list[dict[str, Any]]:
        """One row a motion."""
        return [
            {
                "start": row["start"],
                "exponents": [one["mean"] for one in row.get("exponents", [])],
                "divergence": row.get("divergence", {}).get("mean"),
                "kaplan_yorke": row.get("kaplan_yorke"),
                "problem": row.get("problem"),
            }
            for row in self
        ]
