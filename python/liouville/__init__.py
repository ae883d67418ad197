"""Decides which tensor invariants a mechanical system has: integrals, invariant measures.

>>> import liouville as lv
>>> bool(lv.check(lv.read("plane/balanced-ball")))
True
"""

from ._liouville import VERSION as __version__
from .bodies import Bodies, Body
from .branches import Basins, Branch, ClosedOrbits, Diagram, Rotation
from .case import Case
from .errors import (
    CaseError,
    FormulaError,
    LiouvilleError,
    Mistake,
    MotionError,
    MotionWarning,
    SearchError,
)
from .found import Found, Search
from .function import Field, Function
from .motion import CLASSES, Chart, Exponents, Orbit, Section, Spectra
from .reading import (
    basins,
    branch,
    catalogue,
    chart,
    check,
    diagram,
    exponents,
    parse,
    periodic,
    read,
    report,
    rotation,
    search,
    section,
    sweep,
)
from .residuals import Sweep
from .symbolic import from_lagrangian, from_sympy, to_sympy
from .verdicts import Claim, Report

__all__ = [
    "CLASSES",
    "Basins",
    "Bodies",
    "Body",
    "Branch",
    "Case",
    "CaseError",
    "Chart",
    "Claim",
    "ClosedOrbits",
    "Diagram",
    "Exponents",
    "Field",
    "FormulaError",
    "Found",
    "Function",
    "LiouvilleError",
    "Mistake",
    "MotionError",
    "MotionWarning",
    "Orbit",
    "Report",
    "Rotation",
    "Search",
    "SearchError",
    "Section",
    "Spectra",
    "Sweep",
    "__version__",
    "basins",
    "branch",
    "catalogue",
    "chart",
    "check",
    "diagram",
    "exponents",
    "from_lagrangian",
    "from_sympy",
    "parse",
    "periodic",
    "read",
    "report",
    "rotation",
    "search",
    "section",
    "sweep",
    "to_sympy",
]
