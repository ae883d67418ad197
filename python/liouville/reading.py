"""Reading of cases, and what is done with them at once."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any, overload

from . import _liouville as native
from . import _values
from .bodies import Bodies, BodyTable
from .branches import Basins, Branch, ClosedOrbits, Diagram, Rotation
from .case import Case
from .found import Search
from .judged import Format
from .motion import Chart, Exponents, Section, Spectra
from .residuals import Sweep
from .verdicts import Report


def restored(text: str, name: str, settings: dict[str, str], symbols) -> Case:
    """A case that was pickled."""
    return Case(native.Case(text, name, list(settings.items())), settings, symbols)


def read(source: str | Path, /, **settings: Any) -> Case:
    """Reads a case: a path, a case of the catalogue such as `plane/balanced-ball`, or its text.

    Keywords give parameters values: `m="5/4"`, `I=[2, 2, 3]`. A text has a line break in it.
    """
    given = {name: _values.setting(value) for name, value in settings.items()}
    return parse(source, given)


def parse(
    source: str | Path,
    settings: Mapping[str, Any] | None = None,
    *,
    name: str = "case",
    symbols: dict[str, Any] | None = None,
) -> Case:
    """Reads a case as `read` does; settings by a mapping may have any names."""
    given = {key: _values.setting(value) for key, value in (settings or {}).items()}
    pairs = list(given.items())
    if _values.is_text(source):
        return Case(native.Case(str(source), name, pairs), given, symbols)
    return Case(native.Case.open(Path(source), pairs), given, symbols)


@overload
def check(case: Case | str | Path, *, settings: None = None, **options: Any) -> Report: ...
@overload
def check(case: Case | str | Path, *, settings: BodyTable, **options: Any) -> Bodies: ...
def check(case, **options):
    """Judges all claims of a case, for each row of a table with `settings`; see `Case.check`."""
    return _case(case).check(**options)


@overload
def report(
    case: Case | str | Path, format: Format | None = None, *, settings: None = None, **options: Any
) -> str: ...
@overload
def report(
    case: Case | str | Path, format: None = None, *, settings: BodyTable, **options: Any
) -> Bodies: ...
def report(case, format=None, **options):
    """Invariants of a case, for each row of a table with `settings`; see `Case.report`."""
    return _case(case).report(format, **options)


def search(case: Case | str | Path, **options: Any) -> Search:
    """Searches a case for invariants; see `Case.search`."""
    return _case(case).search(**options)


def chart(case: Case | str | Path, *axes: Any, **options: Any) -> Chart:
    """Classifies the motions of a plane; see `Case.chart`."""
    return _case(case).chart(*axes, **options)


def section(case: Case | str | Path, surface: str | None = None, **options: Any) -> Section:
    """Poincaré section of a case; see `Case.section`."""
    return _case(case).section(surface, **options)


def periodic(
    case: Case | str | Path, starts: Any = None, *section: Any, **options: Any
) -> ClosedOrbits:
    """Closed orbits near starts; see `Case.periodic`."""
    return _case(case).periodic(starts, *section, **options)


def branch(
    case: Case | str | Path, start: Any, parameter: str, *section: Any, **options: Any
) -> Branch:
    """Follows a closed orbit while a parameter varies; see `Case.branch`."""
    return _case(case).branch(start, parameter, *section, **options)


def diagram(case: Case | str | Path, over: Any, *section: Any, **options: Any) -> Diagram:
    """Bifurcation diagram; see `Case.diagram`."""
    return _case(case).diagram(over, *section, **options)


def rotation(
    case: Case | str | Path, first: Any, last: Any, *section: Any, **options: Any
) -> Rotation:
    """Rotation numbers along a line of starts; see `Case.rotation`."""
    return _case(case).rotation(first, last, *section, **options)


def basins(case: Case | str | Path, x: Any, y: Any, *start: Any, **options: Any) -> Basins:
    """Basins of attraction; see `Case.basins`."""
    return _case(case).basins(x, y, *start, **options)


def exponents(case: Case | str | Path, starts: Any = None, **options: Any) -> Exponents | Spectra:
    """Lyapunov exponents of motions; see `Case.exponents`."""
    return _case(case).exponents(starts, **options)


def sweep(case: Case | str | Path, *claims: str, **options: Any) -> Sweep:
    """Largest residual of claims at very many states; see `Case.sweep`."""
    return _case(case).sweep(*claims, **options)


def _case(case: Case | str | Path) -> Case:
    return case if isinstance(case, Case) else read(case)


def catalogue(pattern: str = "*") -> list[str]:
    """Names of the cases inside the package, such as `plane/balanced-ball`, for `read`."""
    from fnmatch import fnmatchcase

    return [name for name in native.catalogue() if fnmatchcase(name, pattern)]
