"""Functions of the state in floating point."""

from __future__ import annotations

import math

import numpy as np

from . import _liouville as native


class Function:
    """A function of the state in floating point, for single states and for arrays of them."""

    def __init__(self, native_function: native.Function, dimension: int):
        self._native = native_function
        self._dimension = dimension
        self._shapes = [tuple(shape) for shape in native_function.shapes]

    def _rows(self, states: np.ndarray) -> np.ndarray:
        count = sum(math.prod(shape) for shape in self._shapes)
        values = self._native(np.ascontiguousarray(states, dtype=float).tobytes())
        return np.frombuffer(values).reshape(-1, count)

    def __call__(self, states):
        """Values at a state (n,), or at the rows of an array (…, n).

        One formula gives its value, several give a tuple. Undefined values are NaN.
        """
        states = np.asarray(states, dtype=float)
        if states.shape[-1:] != (self._dimension,):
            raise ValueError(f"a state has {self._dimension} components, not {states.shape}")
        rows = self._rows(states.reshape(-1, self._dimension))
        parts, begin = [], 0
        for shape in self._shapes:
            end = begin + math.prod(shape)
            value = rows[:, begin:end].reshape(states.shape[:-1] + shape)
            parts.append(value if value.ndim else float(value))
            begin = end
        return parts[0] if len(parts) == 1 else tuple(parts)


class Field(Function):
    """The field of a case as a function f(t, x), as `scipy.integrate.solve_ivp` wants it."""

    def __call__(self, t, x):
        """Rates at a state (n,), or at the columns of an array (n, k); `t` is not used."""
        x = np.asarray(x, dtype=float)
        if x.ndim == 1:
            return super().__call__(x)
        return super().__call__(x.T).T
