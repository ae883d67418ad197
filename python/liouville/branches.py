"""Closed orbits, their branches, diagrams, rotation numbers and basins, as tables and arrays."""

from __future__ import annotations

from typing import Any, overload

import numpy as np

from ._table import Table, html


class _Answer(Table[dict]):
    """An answer of a command about motions, with a table of its records."""

    _key = "points"

    def __init__(self, outcome: dict[str, Any]):
        self.outcome = outcome
        """The answer as the command prints it with `--json`."""

    @property
    def title(self) -> str:
        """Title of the case."""
        return self.outcome["title"]

    def _records(self) -> list[dict[str, Any]]:
        return self.outcome[self._key]

    def _column(self, name: str) -> np.ndarray:
        """A number of each record; NaN where it is not known."""
        values = [one[name] for one in self]
        return np.array([np.nan if value is None else value for value in values], dtype=float)

    def _repr_html_(self) -> str:
        return html(self.title, self.to_dicts())

    def __repr__(self) -> str:
        return f"<{type(self).__name__} of {self.title}: {len(self)}>"


def _multipliers(record: dict[str, Any]) -> np.ndarray:
    return np.array([complex(one["re"], one["im"]) for one in record["multipliers"]], dtype=complex)


class ClosedOrbits(_Answer):
    """Closed orbits, each a dictionary as of `liouville motion periodic --json`."""

    @property
    def states(self) -> np.ndarray:
        """A state of each orbit, one in a row."""
        return np.array([one["state"] for one in self])

    @property
    def periods(self) -> np.ndarray:
        """Periods in time."""
        return self._column("time")

    @property
    def multipliers(self) -> list[np.ndarray]:
        """Multipliers of each orbit, besides those that are always 1."""
        return [_multipliers(one) for one in self]

    def to_dicts(self) -> list[dict[str, Any]]:
        """One row an orbit."""
        return [
            {
                "period": one["period"],
                "kind": one["kind"],
                "time": one["time"],
                "error": one["time_error"],
                "state": one["state"],
                "moduli": [value["modulus"] for value in one["multipliers"]],
            }
            for one in self
        ]


class Branch(_Answer):
    """A branch of closed orbits, each a dictionary as of `liouville motion continue --json`."""

    @property
    def name(self) -> str:
        """Name of what varies."""
        return self.outcome["parameter"]

    @property
    def values(self) -> np.ndarray:
        """Its values, one of each point, in the order of the branch."""
        return self._column("value")

    @property
    def periods(self) -> np.ndarray:
        """Periods in time."""
        return self._column("time")

    @property
    def axes(self) -> list[str]:
        """Names of the reported quantities."""
        return self.outcome["axes"]

    @overload
    def __getitem__(self, place: int) -> dict[str, Any]: ...
    @overload
    def __getitem__(self, place: slice) -> list[dict[str, Any]]: ...
    @overload
    def __getitem__(self, place: str) -> np.ndarray: ...
    def __getitem__(self, place):
        """A point by its number, or a reported quantity of all points by its name."""
        if not isinstance(place, str):
            return super().__getitem__(place)
        if place not in self.axes:
            raise KeyError(f"{place}; the quantities are {', '.join(self.axes)}")
        return np.array([one["at"][self.axes.index(place)] for one in self])

    @property
    def multipliers(self) -> list[np.ndarray]:
        """Multipliers of each point."""
        return [_multipliers(one) for one in self]

    @property
    def bifurcations(self) -> list[dict[str, Any]]:
        """The points that are bifurcations."""
        return [one for one in self if one["bifurcation"] is not None]

    @property
    def ends(self) -> list[str]:
        """Why the branch ends, first and last: `range`, `count`, `closed`, `lost` and others."""
        return self.outcome["ends"]

    def to_dicts(self) -> list[dict[str, Any]]:
        """One row a point."""
        return [
            {
                self.name: one["value"],
                **dict(zip(self.axes, one["at"], strict=True)),
                "period": one["time"],
                "kind": one["kind"],
                "bifurcation": one["bifurcation"],
            }
            for one in self
        ]


class Diagram(_Answer):
    """A bifurcation diagram; its records are those of `liouville motion diagram --json`."""

    _key = "values"

    @property
    def name(self) -> str:
        """Name of what varies."""
        return self.outcome["over"]

    @property
    def axes(self) -> list[str]:
        """Names of the values at crossings."""
        return self.outcome["axes"]

    @property
    def crossings(self) -> np.ndarray:
        """All crossings as an array with fields: what varies, `start` (a number), and the axes."""
        rows = [
            (column["value"], number, *at)
            for column in self
            for number, orbit in enumerate(column["orbits"])
            for at in orbit["crossings"]
        ]
        fields: list[tuple[str, type]] = [(self.name, float), ("start", np.int64)]
        return np.array(rows, dtype=fields + [(name, float) for name in self.axes])

    @property
    def problems(self) -> list[tuple[float, int, str]]:
        """Motions that ended early or did not start: value, number of the start, message."""
        return [
            (column["value"], number, orbit["problem"])
            for column in self
            for number, orbit in enumerate(column["orbits"])
            if orbit["problem"] is not None
        ]

    def to_dicts(self) -> list[dict[str, Any]]:
        """One row a crossing."""
        names = self.crossings.dtype.names or ()
        return [dict(zip(names, row.tolist(), strict=True)) for row in self.crossings]


class Rotation(_Answer):
    """Rotation numbers, each a dictionary as of `liouville motion rotation --json`."""

    _key = "motions"

    @property
    def axes(self) -> list[str]:
        """Names of the values of a start."""
        return self.outcome["axes"]

    @property
    def starts(self) -> np.ndarray:
        """Starts, one in a row."""
        return np.array([one["start"] for one in self])

    @property
    def numbers(self) -> np.ndarray:
        """Rotation numbers, from 0 up to 1; NaN where there is none."""
        return self._column("rotation")

    @property
    def errors(self) -> np.ndarray:
        """Errors of the rotation numbers; NaN where there is none."""
        return self._column("error")

    @property
    def resonances(self) -> list[tuple[int, int] | None]:
        """The fraction (p, q) that each rotation number is, if it is one."""
        return [None if one["fraction"] is None else tuple(one["fraction"]) for one in self]

    def to_dicts(self) -> list[dict[str, Any]]:
        """One row a motion."""
        return [
            {
                **dict(zip(self.axes, one["start"], strict=True)),
                "rotation": one["rotation"],
                "error": one["error"],
                "fraction": None if one["fraction"] is None else "{}/{}".format(*one["fraction"]),
                "crossings": one["crossings"],
                "problem": one["problem"],
            }
            for one in self
        ]


class Basins(_Answer):
    """Attractors, each a dictionary as of `liouville motion basins --json`, with their basins."""

    _key = "attractors"

    @property
    def names(self) -> tuple[str, str]:
        """Names of the axes, across and upwards."""
        return self.outcome["x"]["name"], self.outcome["y"]["name"]

    @property
    def x(self) -> np.ndarray:
        """Starts across."""
        return _middles(self.outcome["x"])

    @property
    def y(self) -> np.ndarray:
        """Starts upwards."""
        return _middles(self.outcome["y"])

    @property
    def basin(self) -> np.ndarray:
        """Number of the attractor of each motion, from 1 on, row by row from below; 0 without one."""
        return np.array(
            [[end if isinstance(end, int) else 0 for end in row] for row in self.outcome["rows"]]
        )

    @property
    def states(self) -> np.ndarray:
        """A state on each attractor, one in a row."""
        return np.array([one["state"] for one in self])

    def to_dicts(self) -> list[dict[str, Any]]:
        """One row an attractor."""
        return [
            {"attractor": number + 1, **{key: one[key] for key in ("kind", "count", "exponent")}}
            for number, one in enumerate(self)
        ]


def _middles(axis: dict[str, Any]) -> np.ndarray:
    """Middles of the parts of an axis."""
    shares = (np.arange(axis["count"]) + 0.5) / axis["count"]
    return axis["from"] + (axis["to"] - axis["from"]) * shares
