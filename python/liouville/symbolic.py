"""Cases from expressions of SymPy, and expressions from formulas."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from typing import Any

from . import _liouville as native
from . import _values
from .case import Case
from .reading import parse

STATE_RANGE = "-2..2"
PARAMETER_RANGE = "0.5..2"
POSITIVE_RANGE = "0.5..2"


def from_sympy(
    system: Any,
    /,
    *,
    integrals: Any = (),
    densities: Any = (),
    fails: Iterable[str] = (),
    parameters: Mapping[Any, Any] | None = None,
    ranges: Mapping[Any, tuple[Any, Any]] | None = None,
    title: str = "a field from SymPy",
) -> Case:
    """Makes a case of a field, or of what SymPy's Lagrange or Kane method gives.

    `system` is a mapping from the state's symbols to their rates, or a `LagrangesMethod` or a
    `KanesMethod` whose equations have been formed. Integrals and densities are expressions, or
    mappings from names to them; matrices are claimed component by component. Claims that are named
    in `fails` are expected to fail.

    Other symbols are parameters, for all values of which a claim is judged; `parameters` gives some
    of them values. Test states are drawn from `ranges`, such as `{x: (1, 3)}`: by default −2..2,
    and 0.5..2 for parameters and for symbols that are positive.
    """

    field, replaced = _field(system)
    names = _Names(field)
    printer = _printer(names)
    fixed = dict(parameters or {})
    spans = dict(ranges or {})
    claims = [
        (kind, name, _plain(formula, replaced))
        for kind, given in (("integral", integrals), ("density", densities))
        for name, formula in _named(kind, given)
    ]
    unknown = set(fails) - {name for _, name, _ in claims}
    if unknown:
        raise ValueError(f"fails names no claim: {', '.join(sorted(unknown))}")

    lines = [f"title = {_quoted(title)}", 'system = "field"']
    field_lines = [
        f"{_quoted(names[x] + chr(39))} = {_quoted(printer(f))}" for x, f in field.items()
    ]
    claim_lines: list[str] = []
    for kind, name, formula in claims:
        expect = ['expect = "fails"'] if name in fails else []
        text = printer(formula)
        claim_lines += [
            "",
            "[[claim]]",
            f"name = {_quoted(name)}",
            f"{kind} = {_quoted(text)}",
            *expect,
        ]

    def span(symbol: Any, usual: str) -> str:
        given = spans.pop(symbol, None)
        if given is None:
            return POSITIVE_RANGE if symbol.is_positive else usual
        return f"{_values.exact(given[0])}..{_values.exact(given[1])}"

    state_lines = [f"{_quoted(names[x])} = {_quoted(span(x, STATE_RANGE))}" for x in field]
    parameter_lines = []
    for symbol in names.parameters:
        value = fixed.pop(symbol, None)
        text = _values.exact(value) if value is not None else span(symbol, PARAMETER_RANGE)
        parameter_lines.append(f"{_quoted(names[symbol])} = {_quoted(text)}")
    spans.pop(names.time, None)
    for others, what in ((fixed, "parameters"), (spans, "ranges")):
        if others:
            shown = ", ".join(str(symbol) for symbol in others)
            raise ValueError(f"{what}: {shown} is in no formula")
    lines += ["", "[parameters]", *parameter_lines] if parameter_lines else []
    lines += ["", "[state]", *state_lines, "", "[field]", *field_lines, *claim_lines]
    known = {native.canonical(name) or name: symbol for symbol, name in names.items()}
    return parse("\n".join(lines) + "\n", name=title, symbols=known)


def from_lagrangian(lagrangian: Any, coordinates: Iterable[Any], /, **options: Any) -> Case:
    """Makes a case of a Lagrangian of coordinates that depend on time, such as `q(t)`.

    The options are those of `from_sympy`; claims may contain the velocities `q(t).diff()`.
    """
    from sympy.physics.mechanics import LagrangesMethod

    method = LagrangesMethod(lagrangian, list(coordinates))
    method.form_lagranges_equations()
    return from_sympy(method, **options)


def to_sympy(
    case: Case,
    formula: str | None = None,
    symbols: Mapping[str, Any] | None = None,
    abbreviations: Mapping[str, str] | None = None,
) -> Any:
    """A formula or a claim of a case as an expression in the components of state and parameters.

    Without a formula, a dictionary of the rates. Vectors become lists. `symbols` gives symbols for
    names; by default they are those that the case was made of, or new ones.
    """
    import sympy

    formulas = None if formula is None else [formula]
    pairs = list((abbreviations or {}).items())
    program = json.loads(native.program(case._native, formulas, pairs))
    known = {**case.symbols, **(symbols or {})}
    inputs = [known.get(name, sympy.Symbol(name, real=True)) for name in program["inputs"]]
    made: list[Any] = []
    for step in program["steps"]:
        made.append(_made(sympy, step, made, inputs) if step else None)
    (places,) = program["values"]
    values = [made[place] for place in places]
    if formula is None:
        count = len(case.state)
        first = len(program["inputs"]) - count
        return dict(zip(inputs[first:], values, strict=True))
    return values[0] if len(values) == 1 else values


def _made(sympy: Any, step: list[Any], made: list[Any], inputs: list[Any]) -> Any:
    """The value of a step."""
    name, *rest = step
    match name:
        case "constant":
            return sympy.Rational(rest[0])
        case "input":
            return inputs[rest[0]]
        case "power":
            return made[rest[0]] ** sympy.Rational(rest[1])
    values = [made[place] for place in rest]
    match name:
        case "neg":
            return -values[0]
        case "recip":
            return 1 / values[0]
        case "add":
            return values[0] + values[1]
        case "sub":
            return values[0] - values[1]
        case "mul":
            return values[0] * values[1]
        case "pow":
            return values[0] ** values[1]
    return getattr(sympy, "Abs" if name == "abs" else name)(values[0])


def _field(system: Any) -> tuple[dict[Any, Any], dict[Any, Any]]:
    """The rates of the state, and what derivatives in formulas mean."""
    import sympy

    if isinstance(system, Mapping):
        field = {sympy.sympify(x): sympy.sympify(rate) for x, rate in system.items()}
        replaced = {sympy.Derivative(x, t): rate for x, rate in field.items() for t in _times(x)}
        return {x: _plain(rate, replaced) for x, rate in field.items()}, replaced
    if not all(hasattr(system, name) for name in ("rhs", "q", "u")):
        raise TypeError("give a mapping from symbols to rates, a LagrangesMethod or a KanesMethod")
    coordinates, speeds = list(system.q), list(system.u)
    replaced = {}
    if any(isinstance(speed, sympy.Derivative) for speed in speeds):  # Lagrange's equations
        velocity = {
            speed: sympy.Symbol(f"v_{_text(q)}", real=True)
            for q, speed in zip(coordinates, speeds, strict=True)
        }
        rates = [rate.xreplace(velocity) for rate in system.rhs()]
        if len(rates) != 2 * len(coordinates):
            raise ValueError(
                "constraints with multipliers: write the Lagrangian in a case file, "
                "or give Kane's method"
            )
        state = coordinates + list(velocity.values())
        replaced.update(velocity)
    else:
        state, rates = coordinates + speeds, list(system.rhs())
    field = dict(zip(state, rates, strict=True))
    if any(symbol.has(sympy.Derivative) for symbol in field.values()):
        raise ValueError("derivatives are left in the rates: give kinematical equations for all")
    for x, rate in field.items():
        for t in _times(x):
            replaced.setdefault(sympy.Derivative(x, t), rate)
    return field, replaced


def _times(x: Any) -> list[Any]:
    """The time on which a dynamic symbol depends."""
    return list(x.args) if x.is_Function else []


def _plain(formula: Any, replaced: Mapping[Any, Any]) -> Any:
    """A formula without the derivatives of the state."""
    import sympy

    if isinstance(formula, (list, tuple)):
        formula = sympy.Matrix(formula)
    formula = sympy.sympify(formula)
    return formula.xreplace(replaced) if replaced else formula


def _named(kind: str, given: Any) -> list[tuple[str, Any]]:
    """Claims with their names."""
    if isinstance(given, Mapping):
        return [(str(name), formula) for name, formula in given.items()]
    if not isinstance(given, (list, tuple)):
        given = [given]
    return [(f"{kind} {place + 1}", formula) for place, formula in enumerate(given)]


def _text(symbol: Any) -> str:
    return symbol.func.__name__ if symbol.is_Function else str(symbol)


def _quoted(text: str) -> str:
    return json.dumps(text, ensure_ascii=False)


class _Names(dict):
    """Names of symbols in a case, made when first asked for."""

    def __init__(self, state: Iterable[Any]):
        super().__init__()
        self.parameters: list[Any] = []
        self.time: Any = None
        self._taken: set[str] = set()
        for symbol in state:
            if not (symbol.is_Symbol or symbol.is_Function):
                raise TypeError(f"{symbol} is not a symbol, and cannot be a variable of the state")
            self.time = (_times(symbol) or [self.time])[0]
            self._add(symbol)

    def _add(self, symbol: Any) -> str:
        text = _text(symbol)
        letters = "".join(c if c.isalnum() or c == "_" else "_" for c in text).strip("_")
        name = letters if letters[:1].isalpha() else f"x_{letters}"
        while name.isidentifier() is False or (native.canonical(name) or name) in self._taken:
            name += "_"
        self._taken.add(native.canonical(name) or name)
        self[symbol] = name
        return name

    def __missing__(self, symbol: Any) -> str:
        if symbol == self.time:
            return "t"
        if symbol.is_Function:
            raise ValueError(f"{symbol} depends on time, and has no rate")
        self.parameters.append(symbol)
        return self._add(symbol)


def _printer(names: _Names):
    """A function that writes expressions as formulas."""
    import sympy
    from sympy.printing.precedence import PRECEDENCE
    from sympy.printing.str import StrPrinter

    functions = {
        "Abs": "abs", "sqrt": "sqrt", "exp": "exp", "log": "log", "sin": "sin", "cos": "cos",
        "tan": "tan", "atan": "atan", "asin": "asin", "acos": "acos", "atan2": "atan2",
        "sinh": "sinh", "cosh": "cosh", "tanh": "tanh", "asinh": "asinh", "acosh": "acosh",
        "atanh": "atanh", "sign": "sign", "Min": "min", "Max": "max",
    }  # fmt: skip
    rewritten = {"cot": sympy.tan, "sec": sympy.cos, "csc": sympy.sin, "coth": sympy.tanh}

    class Printer(StrPrinter):
        def _print_Symbol(self, expr):
            return names[expr]

        def _print_Function(self, expr):
            name = type(expr).__name__
            if expr in names or isinstance(expr, sympy.core.function.AppliedUndef):
                return names[expr]
            if name in rewritten:
                return self.parenthesize(1 / rewritten[name](*expr.args), PRECEDENCE["Atom"])
            if name not in functions:
                raise ValueError(f"{name} is not a function of case files: write it by others")
            return f"{functions[name]}({', '.join(self._print(arg) for arg in expr.args)})"

        _print_Abs = _print_sign = _print_Min = _print_Max = _print_log = _print_Function

        def _print_exp(self, expr):
            return f"exp({self._print(expr.args[0])})"

        def _print_ExpBase(self, expr):
            return f"exp({self._print(expr.args[0])})"

        def _print_Exp1(self, expr):
            return "exp(1)"

        def _print_Pi(self, expr):
            return "π"

        def _print_Integer(self, expr):
            return str(expr.p)

        def _print_Rational(self, expr):
            return f"({expr.p}/{expr.q})"

        def _print_Float(self, expr):
            value = float(expr)
            if not float("-inf") < value < float("inf"):
                raise ValueError(f"{expr} is not a number of case files")
            return f"({sympy.Rational(str(expr))})"

        def _print_Pow(self, expr, rational=False):
            base, exponent = expr.as_base_exp()
            if exponent == sympy.Rational(1, 2):
                return f"sqrt({self._print(base)})"
            if exponent == -1:
                return f"(1/{self.parenthesize(base, PRECEDENCE['Atom'])})"
            below = self.parenthesize(base, PRECEDENCE["Atom"])
            return f"{below}^({self._print(exponent)})"

        def _print_Mul(self, expr):
            parts = [self.parenthesize(arg, PRECEDENCE["Mul"]) for arg in expr.args]
            return "*".join(f"({part})" if part.startswith("-") else part for part in parts)

        def _print_MatrixBase(self, expr):
            rows = [[self._print(entry) for entry in expr.row(k)] for k in range(expr.rows)]
            if 1 in expr.shape:
                return "[" + ", ".join(sum(rows, [])) + "]"
            return "[" + ", ".join("[" + ", ".join(row) + "]" for row in rows) + "]"

        _print_ImmutableDenseMatrix = _print_MutableDenseMatrix = _print_MatrixBase
        _print_ImmutableMatrix = _print_Matrix = _print_MatrixBase

        def _print_ImaginaryUnit(self, expr):
            return self.emptyPrinter(expr)

        _print_NaN = _print_Infinity = _print_NegativeInfinity = _print_ImaginaryUnit
        _print_ComplexInfinity = _print_Relational = _print_ImaginaryUnit

        def _print_Derivative(self, expr):
            raise ValueError(f"{expr} is not a rate of the state: give it one")

        def emptyPrinter(self, expr):
            raise ValueError(f"{type(expr).__name__} cannot be written as a formula: {expr}")

    return Printer({"order": "none"}).doprint
