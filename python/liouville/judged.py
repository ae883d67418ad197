"""Verdicts, searches and reports about a case."""

from __future__ import annotations

import json
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, cast, get_args, overload

from . import _liouville as native
from .bodies import Bodies, BodyTable
from .described import Described
from .found import Search
from .parts import Share
from .verdicts import Report

if TYPE_CHECKING:
    from .case import Case

Trust = Literal["best", "proof", "float"]
"""Evidence that a claim needs."""

Format = Literal["html", "markdown", "latex", "text", "json"]
"""Form of a report."""


class Judged(Described):
    """Judgements on a case."""

    @overload
    def check(
        self,
        *,
        settings: None = None,
        seed: int = 1,
        states: int = 256,
        trust: Trust = "best",
        mutants: bool = False,
        motion: bool = False,
        threads: int | None = None,
    ) -> Report: ...
    @overload
    def check(
        self,
        *,
        settings: BodyTable,
        seed: int = 1,
        states: int = 256,
        trust: Trust = "best",
        motion: bool = False,
        threads: int | None = None,
        client: Any = None,
        parts: int | None = None,
        out: str | Path | None = None,
    ) -> Bodies: ...
    def check(
        self,
        *,
        settings=None,
        seed=1,
        states=256,
        trust="best",
        mutants=False,
        motion=False,
        threads=None,
        client=None,
        parts=None,
        out=None,
    ):
        """Judges all claims; with `motion` those about motion too, which may take minutes.

        With `settings` each row of a table is a body of its own: a path of a CSV file, a
        DataFrame, or dictionaries, by the names of parameters. A wrong row leaves the others.
        `client`, `parts` and `out` are those of `chart`.
        """
        share = Share(client, parts, out, threads)
        if settings is not None:
            if mutants:
                raise ValueError("mutants are those of one body: leave out settings")
            options = {"seed": seed, "states": states, "motion": motion}
            wanted = options | {"trust": None if trust == "best" else trust}
            return Bodies(share.bodies(self, "check", settings, wanted))
        share.refuse()
        sampling = (seed, states, trust)
        return Report(json.loads(native.check(self._native, sampling, mutants, motion, threads)))

    def search(
        self,
        *,
        degree: int = 4,
        within: float | None = None,
        blind: bool = False,
        terms: Iterable[str] = (),
        conditions: str | bool = False,
        ansatz: int | None = None,
        potentials: bool = False,
        gyrostats: bool = False,
        poisson: str | bool = False,
        seconds: float = 60,
        megabytes: int = 500,
        seed: int = 1,
        threads: int | None = None,
    ) -> Search:
        """Searches for integrals, densities, brackets and symmetries, and proves the results.

        `within` ends the search after that many seconds with what was found. The other arguments
        are the options of `liouville search`.
        """

        def wanted(value: str | bool) -> str | None:
            return value if isinstance(value, str) else ("" if value else None)

        outcome = native.search(
            self._native,
            (degree, seed, blind),
            [str(term) for term in terms],
            wanted(conditions),
            ansatz,
            (potentials, gyrostats),
            wanted(poisson),
            (within, float(seconds), megabytes),
            threads,
        )
        return Search(cast("Case", self), json.loads(outcome))

    @overload
    def report(
        self,
        format: Format | None = None,
        *,
        settings: None = None,
        seed: int = 1,
        threads: int | None = None,
    ) -> str: ...
    @overload
    def report(
        self,
        format: None = None,
        *,
        settings: BodyTable,
        seed: int = 1,
        threads: int | None = None,
        client: Any = None,
        parts: int | None = None,
        out: str | Path | None = None,
    ) -> Bodies: ...
    def report(
        self,
        format=None,
        *,
        settings=None,
        seed=1,
        threads=None,
        client=None,
        parts=None,
        out=None,
    ):
        """All known invariants of the system, each with a proof, as one document; text by default.

        With `settings` each row of a table is a body of its own, as of `check`: its class, its
        measure, and the names of its invariants.
        """
        share = Share(client, parts, out, threads)
        if settings is not None:
            if format is not None:
                raise ValueError("a table of bodies has no format: leave it out")
            return Bodies(share.bodies(self, "report", settings, {"seed": seed}))
        share.refuse()
        format = "text" if format is None else format
        if format not in get_args(Format):
            raise ValueError('format is "html", "markdown", "latex", "text" or "json"')
        return native.report(self._native, format, seed, threads)

    def report_html(self, *, seed: int = 1, threads: int | None = None) -> str:
        """All known invariants of the system as one self-contained page."""
        return self.report("html", seed=seed, threads=threads)
