"""Cases: systems with claims about them, and what is done with them."""

from __future__ import annotations

import json
import math
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any, Literal

import numpy as np

from . import _liouville as native
from . import _values
from .followed import Followed
from .function import Field, Function
from .judged import Judged
from .motion import Chart, Exponents, Orbit, Section, Spectra
from .parts import Share
from .residuals import Sweep

Start = str | Mapping[str, Any] | Sequence[Any] | np.ndarray | None
"""A state by names or in order, a point (l, L/G) of a section, or `None` for one that is drawn."""

MOST_NUMBERS = 30_000_000
"""Limit on the numbers of an orbit."""


class Case(Judged, Followed):
    """A system with claims about it. Cases do not change, and may be shared by threads."""

    def __init__(self, handle: native.Case, settings: dict[str, str], symbols=None):
        self._native = handle
        self._settings = settings
        self.symbols: dict[str, Any] = symbols or {}
        """Symbols of SymPy by the names that they have in the case."""

    def __reduce__(self):
        from .reading import restored

        return restored, (self.text, self.name, self._settings, self.symbols)

    def __repr__(self) -> str:
        return f"<Case {self.title}: {self.system}, {len(self._native.claims)} claims>"

    @property
    def field(self) -> Field:
        """The field as a function of (t, x), with the parameters that motions have."""
        return self.field_at()

    def field_at(self, *, seed: int = 1, index: int = 0) -> Field:
        """The field with the free parameters drawn at an index of a seed."""
        function = native.function(self._native, None, seed, index)
        return Field(function, len(self.state))

    def function(self, *formulas: str, seed: int = 1, index: int = 0) -> Function:
        """Formulas, or claims by their names, as one function of the state."""
        if not formulas:
            raise TypeError("give at least one formula")
        function = native.function(self._native, list(formulas), seed, index)
        return Function(function, len(self.state))

    def parameter_values(self, *, seed: int = 1, index: int = 0) -> dict[str, Any]:
        """Exact values that the parameters without a value have in motions, as settings."""
        found = native.parameter_values(self._native, seed, index)
        return {name: _values.nested(shape, values) for name, shape, values in found}

    def orbit(self, start: Start = None, *, time: Any = 100, **options: Any) -> Orbit:
        """Follows the motion from a start for a time, backwards if it is negative.

        Takes the options of `orbits`. Raises `MotionError` if the motion runs into a singularity.
        """
        (found,) = self.orbits([start], time=time, **options)
        if found.problem is not None:
            raise found.problem
        return found

    def orbits(
        self,
        starts: Sequence[Start],
        *,
        time: Any = 100,
        every: Any = None,
        columns: str | Iterable[str] | None = None,
        precision: Literal["double", "double-double"] = "double",
        seed: int = 1,
        index: int = 0,
        threads: int | None = None,
    ) -> list[Orbit]:
        """Follows several motions, with samples at the times 0, `every`, 2 `every`, …

        `columns` are `t`, formulas of the case and names of its claims; by default the time and
        the state. A motion that ends early has its samples up to there, and a `problem`.
        """
        time_text = _values.exact(time)
        every = every if every is not None else _values.thousandth(time_text)
        every_text = _values.exact(every)
        step = _values.number(every_text)
        if not step > 0:
            raise ValueError("every is the time between samples, above 0")
        width = len(self.state) + 1
        if abs(_values.number(time_text)) / step * width * len(starts) > MOST_NUMBERS:
            raise ValueError("too many samples: give a longer `every` or a shorter `time`")
        if precision not in ("double", "double-double"):
            raise ValueError('precision is "double" or "double-double"')
        names, found = native.orbits(
            self._native,
            [_values.start(one) for one in starts],
            (time_text, every_text, _values.listed(columns)),
            precision == "double-double",
            (seed, index),
            threads,
        )
        return [Orbit(names, self.state, *one) for one in found]

    def section(
        self,
        surface: str | None = None,
        *,
        axes: str | Iterable[str] | None = None,
        starts: Any = None,
        orbits: int | None = None,
        crossings: int | None = None,
        skip: int | None = None,
        direction: Literal["up", "down", "both"] | None = None,
        backwards: bool = False,
        g0: Any = None,
        energy: Any = None,
        seed: int = 1,
        threads: int | None = None,
        client: Any = None,
        parts: int | None = None,
        out: str | Path | None = None,
    ) -> Section:
        """Poincaré section: by a surface such as `"x = 0"`, or g = g₀ of a rolling body.

        Returns an array with the named fields `start` (number of the motion), `direction` (1 or
        −1), `t`, and the axes. Motions that end early are warned of; see `Section.problems`.
        `client`, `parts` and `out` are those of `chart`.
        """
        given = [] if starts is None else _values.starts(starts)
        energy = None if energy is None else _values.exact(energy)
        course = (direction, backwards)
        if surface is None and axes is not None:
            raise TypeError("axes are those of a surface: give one")
        if surface is not None and g0 is not None:
            raise TypeError("g0 is the section of a rolling body: leave out the surface")
        if share := Share(client, parts, out, threads):
            if surface is not None and given and orbits:
                raise ValueError("give starts or orbits of a section in parts, not both")
            numbers = {"orbits": orbits, "crossings": crossings, "skip": skip}
            way = {"direction": direction, "backwards": backwards, "seed": seed}
            where = {"section": surface, "axes": _values.listed(axes), "g0": g0, "energy": energy}
            job, written = share.section(self, given, where | numbers | way)
            return Section.of(*job.section(written))
        if surface is None:
            place = (None if g0 is None else str(g0), energy, _values.points(given))
            chosen = (orbits, crossings, skip)
            found = native.section(self._native, place, chosen, course, seed, threads)
        else:
            drawn = orbits if orbits is not None else (0 if given else 12)
            counts = (500 if crossings is None else crossings, skip or 0)
            texts = (surface, _values.listed(axes))
            launch = (energy, given + [None] * drawn)
            found = native.surface(self._native, texts, launch, counts, course, seed, threads)
        return Section.of(*found)

    def chart(
        self,
        x: str | tuple[str, Any, Any],
        y: str | tuple[str, Any, Any],
        *,
        size: tuple[int, int] = (64, 40),
        time: float = 200,
        start: Start = None,
        g0: Any = None,
        energy: Any = None,
        seed: int = 1,
        threads: int | None = None,
        client: Any = None,
        parts: int | None = None,
        out: str | Path | None = None,
    ) -> Chart:
        """Classifies the motions of a plane, such as `x="c1=0..2"` or `x=("c1", 0, 2)`.

        `start` is a point (l, L/G) of the section, or a whole state by names.

        With a `distributed.Client` the workers of a Dask cluster compute it in many `parts`, and
        the result is the same bit for bit. Parts are kept as files in the folder `out`, and not
        computed again; what a lost worker has not finished is computed by another.
        """
        if not 0 < abs(time) < math.inf:
            raise ValueError("time is a number that is not 0")
        if min(size) < 1 or max(size) > 4000:
            raise ValueError("size is a pair of numbers from 1 to 4000")
        x, y = _values.axis(x), _values.axis(y)
        given = _values.start(start)
        state = given if isinstance(given, str) else None
        points = _values.points([] if given is None or state is not None else [given])
        place = (
            None if g0 is None else str(g0),
            None if energy is None else _values.exact(energy),
            points,
        )
        if share := Share(client, parts, out, threads):
            plane = {"x": x, "y": y, "size": f"{size[0]}x{size[1]}", "time": float(time)}
            begin = {"start": ",".join(points[0]) if points else None, "state": state}
            where = {"g0": place[0], "energy": place[1], "seed": seed}
            job, texts = share.run(self, ("motion", "chart"), plane | begin | where)
            return Chart.of(*job.chart(texts))
        found = native.chart(
            self._native, (x, y), list(size), float(time), place, state, seed, threads
        )
        return Chart.of(*found)

    def exponents(
        self,
        starts: Any = None,
        *,
        time: float = 2000,
        spectrum: bool = False,
        both_ways: bool = True,
        seed: int = 1,
        index: int = 0,
        threads: int | None = None,
        client: Any = None,
        parts: int | None = None,
        out: str | Path | None = None,
    ) -> Exponents | Spectra:
        """Largest Lyapunov exponents, mean divergence and class of motions, or whole spectra.

        `client`, `parts` and `out` are those of `chart`.
        """
        if not 0 < abs(time) < math.inf:
            raise ValueError("time is a number that is not 0")
        given = _values.starts(starts)
        names = [one if isinstance(one, str) else _values.named(one) for one in given]
        if share := Share(client, parts, out, threads):
            if index:
                raise ValueError("exponents in parts have the parameters of index 0")
            wanted = {"time": float(time), "spectrum": spectrum, "one_way": not both_ways}
            found = share.exponents(self, given, names, wanted | {"seed": seed})
            return Spectra(found) if spectrum else Exponents(found)
        found = json.loads(
            native.exponents(
                self._native,
                given,
                names,
                float(time),
                (spectrum, both_ways),
                (seed, index),
                threads,
            )
        )
        return Spectra(found) if spectrum else Exponents(found)

    def sweep(
        self,
        *claims: str,
        states: int = 1_000_000,
        seed: int = 1,
        threads: int | None = None,
        client: Any = None,
        parts: int | None = None,
        out: str | Path | None = None,
    ) -> Sweep:
        """Largest residual of claims, by default of all, over very many states in floating point.

        `client`, `parts` and `out` are those of `chart`.
        """
        share = Share(client, parts, out, threads)
        return Sweep(share.sweep(self, claims, {"states": int(states), "seed": seed, "json": True}))

    def to_sympy(self, formula: str | None = None, symbols: dict[str, Any] | None = None):
        """A formula, or a claim by its name, as an expression of SymPy; the field without one."""
        from .symbolic import to_sympy

        return to_sympy(self, formula, symbols)
