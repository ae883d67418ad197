"""Closed orbits of a case: found, followed over a parameter, and what is around them."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping, Sequence
from typing import Any, Literal

import numpy as np

from . import _liouville as native
from . import _values
from .branches import Basins, Branch, ClosedOrbits, Diagram, Rotation
from .described import Described
from .parts import begun, worded

Start = str | Mapping[str, Any] | Sequence[Any] | np.ndarray
"""A state by names or in order, or a point (l, L/G) of a section."""

Direction = Literal["up", "down", "both"]
"""Crossings that count."""


class Followed(Described):
    """Closed orbits of a case."""

    def _asked(
        self, command: str, options: dict[str, Any], starts: Any = None, threads: int | None = None
    ) -> dict[str, Any]:
        """Answer of a command about motions."""
        words, table = begun([] if starts is None else _values.starts(starts))
        settings = [f"{name}={value}" for name, value in self._settings.items()]
        arguments = ["motion", command, self.name, *words, *worded(options)]
        return json.loads(native.answer(self._native, settings, arguments, table, threads))

    def periodic(
        self,
        starts: Start | Sequence[Start] | None = None,
        surface: str | None = None,
        *,
        period: int = 1,
        time: Any = None,
        direction: Direction | None = None,
        symmetric: str | Iterable[str] | None = None,
        points: int | None = None,
        g0: Any = None,
        energy: Any = None,
        seed: int = 1,
        threads: int | None = None,
    ) -> ClosedOrbits:
        """Closed orbits near starts, with their multipliers.

        A start is a point (l, L/G) of a rolling body, or a state with a `surface` whose crossings
        are counted by `period`, or with an approximate `time`. With `symmetric` all orbits that
        meet lines of fixed points of reversors (`"L=0, l=pi/2"`), with periods up to `period`.
        """
        lines = _values.listed(symmetric)
        wanted = {
            "section": surface,
            "period": None if period == 1 else int(period),
            "time": None if time is None else _values.exact(time),
            "direction": direction,
            "symmetric": None if lines is None else lines.replace(" ", ""),
            "points": points,
            "threads": threads,
        }
        where = _place(g0, energy, seed)
        return ClosedOrbits(self._asked("periodic", wanted | where, starts, threads))

    def branch(
        self,
        start: Start,
        parameter: str,
        surface: str | None = None,
        *,
        range: tuple[Any, Any] | None = None,
        period: int = 1,
        axes: str | Iterable[str] | None = None,
        direction: Direction | None = None,
        count: int = 200,
        step: float = 0.02,
        g0: Any = None,
        energy: Any = None,
        seed: int = 1,
        threads: int | None = None,
    ) -> Branch:
        """Follows a closed orbit while a parameter or the `energy` varies, through folds.

        `range` is by default that of the parameter in the case; `axes` are the quantities that are
        reported. The start is that of `periodic`.
        """
        ends = [None, None] if range is None else [_values.exact(one) for one in range]
        wanted = {
            "parameter": parameter,
            "section": surface,
            "from": ends[0],
            "to": ends[1],
            "period": int(period),
            "axes": _values.listed(axes),
            "direction": direction,
            "count": int(count),
            "step": float(step),
        }
        where = _place(g0, energy, seed)
        return Branch(self._asked("continue", wanted | where, [start], threads))

    def diagram(
        self,
        over: str | tuple[str, Any, Any],
        surface: str | None = None,
        *,
        axes: str | Iterable[str] | None = None,
        starts: Any = None,
        orbits: int | None = None,
        count: int = 200,
        crossings: int | None = None,
        skip: int | None = None,
        direction: Direction | None = None,
        backwards: bool = False,
        g0: Any = None,
        energy: Any = None,
        seed: int = 1,
        threads: int | None = None,
    ) -> Diagram:
        """Bifurcation diagram: crossings of a section over `"a_g=5..15"` or `("a_g", 5, 15)`."""
        wanted = {
            "over": _values.axis(over),
            "section": surface,
            "axes": _values.listed(axes),
            "orbits": orbits,
            "count": int(count),
            "crossings": crossings,
            "skip": skip,
            "direction": direction,
            "backwards": backwards,
            "threads": threads,
        }
        where = _place(g0, energy, seed)
        return Diagram(self._asked("diagram", wanted | where, starts, threads))

    def rotation(
        self,
        first: Start,
        last: Start,
        surface: str | None = None,
        *,
        axes: str | Iterable[str] | None = None,
        centre: tuple[Any, Any] | str | None = None,
        angle: str | None = None,
        count: int = 100,
        crossings: int | None = None,
        skip: int | None = None,
        direction: Direction | None = None,
        g0: Any = None,
        energy: Any = None,
        seed: int = 1,
        threads: int | None = None,
    ) -> Rotation:
        """Rotation numbers of the motions that start on a line, and their resonances.

        The angle is that about a point `centre` of the section, or a formula `angle`, or l of a
        rolling body.
        """
        about = centre if centre is None or isinstance(centre, str) else _word(centre)
        wanted = {
            "from": _word(first),
            "to": _word(last),
            "section": surface,
            "axes": _values.listed(axes),
            "centre": about,
            "angle": angle,
            "count": int(count),
            "crossings": crossings,
            "skip": skip,
            "direction": direction,
            "threads": threads,
        }
        return Rotation(self._asked("rotation", wanted | _place(g0, energy, seed), None, threads))

    def basins(
        self,
        x: str | tuple[str, Any, Any],
        y: str | tuple[str, Any, Any],
        start: Start | None = None,
        *,
        size: tuple[int, int] = (64, 40),
        time: float = 400,
        by: str | Iterable[str] | None = None,
        energy: Any = None,
        seed: int = 1,
        threads: int | None = None,
    ) -> Basins:
        """Basins of attraction over two components of the state, `"x=-2..2"` or `("x", -2, 2)`.

        `start` gives the other components; attractors are told apart by the formulas `by`.
        """
        wanted = {
            "x": _values.axis(x),
            "y": _values.axis(y),
            "start": None if start is None else _word(start),
            "size": f"{int(size[0])}x{int(size[1])}",
            "time": float(time),
            "by": _values.listed(by),
            "energy": None if energy is None else _values.exact(energy),
            "seed": seed,
            "threads": threads,
        }
        return Basins(self._asked("basins", wanted, None, threads))


def _place(g0: Any, energy: Any, seed: int) -> dict[str, Any]:
    """Options for the place of a section."""
    energy = None if energy is None else _values.exact(energy)
    return {"g0": None if g0 is None else str(g0), "energy": energy, "seed": seed}


def _word(start: Any) -> str:
    """A start as one argument."""
    given = _values.start(start)
    if given is None:
        raise TypeError("a start is wanted, not None")
    return given if isinstance(given, str) else ",".join(given)
