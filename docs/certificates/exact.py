#!/usr/bin/env python3
"""Checks certificates over the rational numbers: python3 exact.py [--seconds N] FILE.json ...

The program of a certificate is computed in the field Q(x)[t_1, ..., t_k] of its inputs x and of its
square roots, without random numbers, and its values must be 0 there. Needs python-flint 0.7 or later.
A file that takes longer than N seconds (5 by default) is left alone, and says so.
Exit code 1 if a file is refused, 0 otherwise.
"""

import sys
import time

import check
from check import Refused, require

import flint

MOST_TERMS = 200_000  # of a product: more take too long, and flint cannot be stopped


class TooLong(Exception):
    """A computation that was given up."""


class Field:
    """Q(x)[t]: fractions N/D of polynomials, in which t_j^2 is replaced by a polynomial of x."""

    def __init__(self, inputs, roots, seconds):
        names = [f"t{k}" for k in range(roots)] + [f"x{k}" for k in range(inputs)]
        # In this order t_j^2 comes before all that replaces it.
        self.context = flint.fmpz_mpoly_ctx.get(tuple(names) or ("x0",), "lex")
        variables = self.context.gens()
        self.roots, self.inputs = variables[:roots], variables[roots:]
        self.squares = []  # t_j^2 - A_j
        self.one = self.context.constant(1)
        self.deadline = time.monotonic() + seconds

    def times(self, a, b):
        if len(a) * len(b) > MOST_TERMS or time.monotonic() > self.deadline:
            raise TooLong
        return a * b

    def reduced(self, a):
        for square in self.squares:
            a = divmod(a, square)[1]
        return a

    def fraction(self, numerator, denominator):
        numerator, denominator = self.reduced(numerator), self.reduced(denominator)
        if time.monotonic() > self.deadline:
            raise TooLong
        if numerator.is_zero():
            return numerator, self.one
        shared = numerator.gcd(denominator)
        if not shared.is_one():
            numerator, denominator = divmod(numerator, shared)[0], divmod(denominator, shared)[0]
        return numerator, denominator

    def constant(self, number):
        make = self.context.constant
        return make(number.numerator), make(number.denominator)

    def product(self, a, b):
        return self.fraction(self.times(a[0], b[0]), self.times(a[1], b[1]))

    def sum(self, a, b):
        shared = a[1].gcd(b[1])
        own, other = divmod(a[1], shared)[0], divmod(b[1], shared)[0]
        numerator = self.times(a[0], other) + self.times(b[0], own)
        return self.fraction(numerator, self.times(a[1], other))

    def reciprocal(self, a, place):
        # A normal form that is not empty is not 0, since the roots are independent.
        require(not a[0].is_zero(), f"{place} divides by 0")
        return a[1], a[0]

    def power(self, a, exponent, place):
        base = self.reciprocal(a, place) if exponent < 0 else a
        value = self.one, self.one
        for bit in bin(abs(exponent))[2:]:
            value = self.product(value, value)
            value = self.product(value, base) if bit == "1" else value
        return value

    def root(self, a):
        """The root t/b of a/b, with t^2 = a b."""
        t = self.roots[len(self.squares)]
        self.squares.append(t * t - self.times(a[0], a[1]))
        return t, a[1]


def require_independent(radicands, at):
    """Requires that no product of different radicands is a square, up to a constant.

    Each is a constant times powers of irreducible polynomials, of which none divides another. The
    product is a square if all exponents are even: the vectors of their parities must be linearly
    independent over two elements. A constant under a root would be none of them.
    """
    irreducible, basis = {}, []
    for radicand in radicands:
        row = 0
        for factor, exponent in radicand.factor()[1]:
            bit = irreducible.setdefault(str(factor), len(irreducible))
            row ^= (exponent % 2) << bit
        for other in basis:
            row = min(row, row ^ other)
        require(row, f"{at}: the roots are not independent")
        basis.append(row)


def vanish(program, at, seconds):
    """Raises Refused unless the values of a program are 0 identically."""
    steps, zero = check.read_program(program, at)
    roots = sum(name == "root" for name, *_ in steps)
    field = Field(program["inputs"], roots, seconds)
    values, radicands, has_root = [], [], []
    for place, (name, a, *b) in enumerate(steps):
        here = f"{at}.steps[{place}]"
        used = [] if name in ("constant", "input") else [a] if name == "power" else [a, *b]
        has_root.append(name == "root" or any(has_root[step] for step in used))
        if name == "constant":
            value = field.constant(a)
        elif name == "input":
            value = field.inputs[a], field.one
        elif name == "negative":
            value = -values[a][0], values[a][1]
        elif name == "sum":
            value = field.sum(values[a], values[b[0]])
        elif name == "difference":
            numerator, denominator = values[b[0]]
            value = field.sum(values[a], (-numerator, denominator))
        elif name == "product":
            value = field.product(values[a], values[b[0]])
        elif name == "reciprocal":
            value = field.reciprocal(values[a], here)
        elif name == "power":
            value = field.power(values[a], b[0], here)
        else:
            require(not has_root[a], f"{here}: a root contains another")
            require(not values[a][0].is_zero(), f"{here} is the root of 0")
            value = field.root(values[a])
            radicands.append(values[a][0] * values[a][1])
        values.append(value)
    require_independent(radicands, at)
    for place in zero:
        require(values[place][0].is_zero(), f"{at}.steps[{place}] is not 0")


def exact(certificate, seconds):
    """Raises Refused, or TooLong."""
    require(isinstance(certificate, dict)
            and certificate.get("format") == "liouville certificate 1", "format is unknown")
    check.shaped(certificate, check.CERTIFICATE)
    statement = certificate["statement"]
    check.check_case(statement)
    require(statement["programs"], "statement.programs is empty")
    for number, program in enumerate(statement["programs"]):
        vanish(program, f"statement.programs[{number}]", seconds)


def main(arguments):
    seconds = 5.0
    if arguments[:1] == ["--seconds"]:
        seconds, arguments = float(arguments[1]), arguments[2:]
    counts = {"exact": 0, "too long": 0, "REFUSED": 0}
    for path in arguments:
        reason = ""
        try:
            with open(path, encoding="utf-8") as file:
                exact(check.load(file), seconds)
            word = "exact"
        except TooLong:
            word = "too long"
        except (Refused, ValueError) as error:
            word, reason = "REFUSED", f": {error}"
        counts[word] += 1
        print(f"{word} {path}{reason}")
    print(f"{sum(counts.values())} certificates: {counts['exact']} zero over the rational numbers, "
          f"{counts['too long']} given up, {counts['REFUSED']} refused")
    return 1 if counts["REFUSED"] else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
