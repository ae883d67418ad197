"""Values of Python in the exact notation of case files."""

from __future__ import annotations

import math
import numbers
from collections.abc import Iterable, Mapping
from fractions import Fraction
from pathlib import Path
from typing import Any


def exact(value: Any) -> str:
    """A number as text. A float is the decimal that Python prints: 0.1 is 1/10."""
    if isinstance(value, str):
        return value
    if isinstance(value, bool):
        raise TypeError("a number is wanted, not a truth value")
    if isinstance(value, numbers.Integral):
        return str(int(value))
    if isinstance(value, Fraction):
        return f"{value.numerator}/{value.denominator}"
    if getattr(value, "is_Rational", False):  # of SymPy
        return f"{value.p}/{value.q}" if value.q != 1 else str(value.p)
    number = float(value)
    if not math.isfinite(number):
        raise ValueError(f"{value} is not a finite number")
    return repr(number)


def setting(value: Any) -> str:
    """The value of a parameter: a number, or nested lists of them."""
    if isinstance(value, str):
        return value
    if hasattr(value, "tolist") and not getattr(value, "is_Rational", False):  # of NumPy and SymPy
        value = value.tolist()
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(setting(one) for one in value) + "]"
    return exact(value)


def start(value: Any) -> str | list[str] | None:
    """A start: a mapping by the names of the state, its components in order, or nothing."""
    if value is None or isinstance(value, str):
        return value
    if isinstance(value, Mapping):
        return " ".join(f"{name}={setting(one)}" for name, one in value.items())
    return [exact(one) for one in flat(value)]


def flat(value: Any) -> Iterable[Any]:
    """The components of nested lists or of an array."""
    for one in value:
        if isinstance(one, (list, tuple)) or getattr(one, "ndim", 0) > 0:
            yield from flat(one)
        else:
            yield one


def is_one_start(value: Any) -> bool:
    """Whether a value is a single start and not a list of them."""
    if value is None or isinstance(value, (str, Mapping)):
        return True

    def is_number(one: Any) -> bool:
        return "=" not in one if isinstance(one, str) else one is not None and not _length(one)

    return len(value) > 0 and all(is_number(one) for one in value)


def _length(value: Any) -> bool:
    """Whether a value has parts."""
    return hasattr(value, "__len__") and getattr(value, "ndim", 1) > 0


def starts(value: Any) -> list[str | list[str] | None]:
    """Starts of several motions."""
    every = [value] if is_one_start(value) else list(value)
    return [start(one) for one in every]


def listed(text: str | Iterable[str] | None) -> str | None:
    """Formulas as a list with commas."""
    if text is None or isinstance(text, str):
        return text
    return ", ".join(text)


def is_text(source: str | Path) -> bool:
    """Whether a source is the text of a case and not a path."""
    return isinstance(source, str) and "\n" in source


def named(start: list[str] | None) -> str:
    """Name of a start for reports."""
    return "drawn" if start is None else "(" + ", ".join(start) + ")"


def number(text: str) -> float:
    """A number by its text."""
    return float(Fraction(text))


def thousandth(time: str) -> Fraction:
    """A thousandth of a time, by its text."""
    return abs(Fraction(time)) / 1000 or Fraction(1, 1000)


def points(given: list[Any]) -> list[str | list[str]]:
    """Points of a section: starts, none of them drawn."""
    if None in given:
        raise ValueError("a start on the section is a pair (l, L/G)")
    return given


def axis(value: str | tuple[str, Any, Any]) -> str:
    """An axis of a chart: its text, or a name with two ends."""
    if isinstance(value, str):
        return value
    name, low, high = value
    return f"{name}={exact(low)}..{exact(high)}"


def nested(shape: list[int], values: list[str]) -> Any:
    """Values in lists of a shape of up to two dimensions."""
    if not shape:
        return values[0]
    if len(shape) == 1:
        return values
    columns = shape[1]
    return [values[k : k + columns] for k in range(0, len(values), columns)]
