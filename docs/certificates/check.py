#!/usr/bin/env python3
"""Checks certificates of `liouville check --certificate DIR`: python3 check.py FILE.json ...

The program of a certificate is evaluated at random points modulo random primes. Digest, primes,
points, degrees and the bound on the error are derived here again; docs/certificates.md has the law.
Exit code 0 if every file passes, 1 otherwise. Python 3.8 or later, standard library only.
"""

import hashlib
import json
import math
import re
import sys
from fractions import Fraction

PRIMES, POINTS, DRAWS, TARGET = 4, 2, 64, -100
POOL = 53  # log2 of a lower bound on the number of primes p = 3 mod 4 between 2^60 and 2^61
ARITY = {"constant": 1, "input": 1, "negative": 1, "reciprocal": 1, "sum": 2, "difference": 2,
         "product": 2, "power": 2, "root": 1}
SPARE = 24  # points beyond those that the independence of roots takes


class Refused(Exception):
    """The reason why a certificate proves nothing."""


def require(condition, reason):
    if not condition:
        raise Refused(reason)


# --- what the digest decides ----------------------------------------------------------------------

def digest_of(statement):
    text = json.dumps(statement, sort_keys=True, separators=(",", ":"), ensure_ascii=False)
    return hashlib.sha256(text.encode()).hexdigest()


def stream(digest, label):
    """Random integers below 2^256: SHA-256 of the digest, a label and a counter."""
    count = 0
    while True:
        block = hashlib.sha256(f"{digest}:{label}:{count}".encode()).digest()
        yield int.from_bytes(block, "big")
        count += 1


def is_prime(n):
    """Miller and Rabin's test; these bases decide all n below 3.3e24."""
    bases = (2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37, 41)
    if any(n % b == 0 for b in bases):
        return n in bases
    d, s = n - 1, 0
    while d % 2 == 0:
        d, s = d // 2, s + 1
    for b in bases:
        x = pow(b, d, n)
        if x not in (1, n - 1) and all((x := x * x % n) != n - 1 for _ in range(s - 1)):
            return False
    return True


def primes_of(digest):
    found = []
    for number in stream(digest, "primes"):
        candidate = 1 << 60 | number % (1 << 60) | 3
        if is_prime(candidate):
            found.append(candidate)
        if len(found) == PRIMES:
            return found


# --- programs ---------------------------------------------------------------------------------------

def read_program(program):
    """Steps with exact numbers; every argument is an earlier step."""
    steps, inputs = [], program["inputs"]
    require(type(inputs) is int and 0 <= inputs <= 10**6, "the number of inputs is none")
    for place, (name, *rest) in enumerate(program["steps"]):
        require(len(rest) == ARITY.get(name), f"step {place} is none")
        if name == "constant":
            require(re.fullmatch(r"-?\d+(/\d+)?", rest[0], re.ASCII), "a constant is no number")
            rest = [Fraction(rest[0])]
        elif name == "input":
            require(type(rest[0]) is int and 0 <= rest[0] < inputs, "an input does not exist")
        else:
            arguments = rest[:1] if name == "power" else rest
            require(all(type(a) is int and 0 <= a < place for a in arguments),
                    f"step {place} uses what comes later")
            require(name != "power" or type(rest[1]) is int, "an exponent is no integer")
        steps.append((name, *rest))
    zero = [place for places in program["zero"].values() for place in places]
    require(program["zero"].get("residual"), "there is no residual")
    require(all(type(a) is int and 0 <= a < len(steps) for a in zero), "a value does not exist")
    return steps, zero


def times(x, y, p):
    """Product in F_p(i), i² = -1."""
    return (x[0] * y[0] - x[1] * y[1]) % p, (x[0] * y[1] + x[1] * y[0]) % p


def evaluate(steps, point, p, signs):
    """Values in F_p(i) as pairs; None if a denominator or a radicand is 0."""
    v = []
    for name, a, *b in steps:
        if name == "constant":
            if a.denominator % p == 0:
                return None
            v.append((a.numerator * pow(a.denominator, -1, p) % p, 0))
        elif name == "input":
            v.append((point[a], 0))
        elif name == "negative":
            v.append((-v[a][0] % p, -v[a][1] % p))
        elif name == "sum":
            v.append(((v[a][0] + v[b[0]][0]) % p, (v[a][1] + v[b[0]][1]) % p))
        elif name == "difference":
            v.append(((v[a][0] - v[b[0]][0]) % p, (v[a][1] - v[b[0]][1]) % p))
        elif name == "product":
            v.append(times(v[a], v[b[0]], p))
        elif name == "root":
            radicand = v[a][0]  # without roots in it, so that the other half is 0
            if radicand == 0:
                return None
            is_square = pow(radicand, (p - 1) // 2, p) == 1
            root = pow(radicand if is_square else -radicand, (p + 1) // 4, p)
            root = -root % p if next(signs) % 2 else root
            v.append((root, 0) if is_square else (0, root))
        else:
            exponent, base = -1 if name == "reciprocal" else b[0], v[a]
            if exponent < 0:
                norm = (base[0] * base[0] + base[1] * base[1]) % p
                if norm == 0:
                    return None
                inverse = pow(norm, -1, p)
                base = base[0] * inverse % p, -base[1] * inverse % p
            value = (1, 0)
            for bit in bin(abs(exponent))[2:]:
                value = times(value, value, p)
                value = times(value, base, p) if bit == "1" else value
            v.append(value)
    return v


def check_roots(steps, inputs, primes, numbers):
    """Requires that the radicands contain no roots, and that the roots are independent modulo p.

    At a point each radicand is a square or none. If the vectors of these bits over some points, and
    the vector of -1, which is no square anywhere, are linearly independent over two elements, no
    product of radicands is a square, and the roots are independent (Kummer).
    """
    has_root = []
    for name, a, *b in steps:
        used = [] if name in ("constant", "input") else [a] if name == "power" else [a, *b]
        require(name != "root" or not has_root[a], "a root contains another")
        has_root.append(name == "root" or any(has_root[place] for place in used))
    radicands = [step[1] for step in steps if step[0] == "root"]
    if not radicands:
        return
    plain = [step if not has else ("constant", Fraction(0)) for step, has in zip(steps, has_root)]
    for p in primes:
        rows, count = [0] * len(radicands), 0
        for _ in range(DRAWS + 2 * len(radicands)):
            point = [next(numbers) % p for _ in range(inputs)]
            values = evaluate(plain[:max(radicands) + 1], point, p, iter(()))
            found = [values[place][0] for place in radicands] if values else [0]
            if 0 in found:
                continue
            for k, value in enumerate(found):
                rows[k] |= (pow(value, (p - 1) // 2, p) != 1) << count
            count += 1
            if count == len(radicands) + SPARE:
                break
        basis = []
        for row in rows + [(1 << count) - 1]:
            for other in basis:
                row = min(row, row ^ other)
            require(row, "the roots are not seen to be independent")
            basis.append(row)


def bounds(steps, zero):
    """Bounds on degree and height (bits of the coefficients) of the numerators that must vanish.

    A value is a numerator (degree, height) times powers of factors, each with degree and height: a
    reciprocal, a power or a root makes the numerator of its argument a factor; a product adds
    exponents; a sum takes the least exponent of each factor, and moves the rest into the numerators.
    """
    factors, own, all_bounds = [], {}, []

    def weight(powers):
        return [sum(e * factors[f][k] for f, e in powers.items()) for k in (0, 1)]

    for place, (name, a, *b) in enumerate(steps):
        if name == "constant":
            powers = {}
            if a.denominator > 1:
                factors.append((0, a.denominator.bit_length()))
                powers[len(factors) - 1] = -1
            bound = (0, abs(a.numerator).bit_length(), powers)
        elif name == "input":
            bound = (1, 0, {})
        elif name == "negative":
            bound = all_bounds[a]
        elif name in ("reciprocal", "power", "root"):
            exponent = {"reciprocal": -1, "root": Fraction(1, 2)}.get(name) or b[0]
            degree, height, powers = all_bounds[a]
            if a not in own:
                own[a] = len(factors)
                factors.append((degree, height))
            powers = {f: e * exponent for f, e in powers.items()}
            powers[own[a]] = powers.get(own[a], 0) + exponent
            bound = (0, 0, {f: e for f, e in powers.items() if e})
        else:
            (d, h, x), (e, i, y) = all_bounds[a], all_bounds[b[0]]
            names = set(x) | set(y)
            if name == "product":
                powers = {f: x.get(f, 0) + y.get(f, 0) for f in names}
                bound = (d + e, h + i, {f: n for f, n in powers.items() if n})
            else:
                powers = {f: min(x.get(f, 0), y.get(f, 0)) for f in names}
                (kd, kh), (xd, xh), (yd, yh) = weight(powers), weight(x), weight(y)
                bound = (max(d + xd, e + yd) - kd, max(h + xh, i + yh) - kh + 1,
                         {f: n for f, n in powers.items() if n})
        all_bounds.append(bound)
    degree = height = 0
    for place in zero:
        d, h, powers = all_bounds[place]
        # A factor with a positive exponent belongs to the numerator.
        more = weight({f: e for f, e in powers.items() if e > 0})
        degree, height = max(degree, d + more[0]), max(height, h + more[1])
    return math.ceil(degree), math.ceil(height)


def error_log2(degree, height):
    """Log2 of Theorem 1: (H/(60 N) + (M n/2^60)^T)^K."""
    prime = (max(height, 1) + 1) / 60 / 2**POOL
    points = (DRAWS * degree / 2**60) ** POINTS
    return math.ceil(PRIMES * math.log2(prime + points))


def vanishes(steps, zero, inputs, primes, numbers):
    """Whether all values are 0 at POINTS points for each prime; their number."""
    accepted = 0
    for p in primes:
        left = POINTS
        for _ in range(DRAWS):
            point = [next(numbers) % p for _ in range(inputs)]
            values = evaluate(steps, point, p, numbers)
            if values is not None:
                is_zero = all(values[place] == (0, 0) for place in zero)
                require(is_zero, "a value is not 0 at a point")
                left -= 1
                accepted += 1
            if left == 0:
                break
        require(left == 0, "a denominator is 0 at almost all points")
    return accepted


def evidence_of(statement):
    """What a certificate has to state: derived from its statement alone."""
    digest = digest_of(statement)
    primes, degrees, heights, errors, points = primes_of(digest), [], [], [], 0
    require(statement["programs"], "there is no program")
    for number, program in enumerate(statement["programs"]):
        steps, zero = read_program(program)
        degree, height = bounds(steps, zero)
        degrees.append(degree)
        heights.append(height)
        errors.append(error_log2(degree, height))
        characters = stream(digest, f"characters {number}")
        check_roots(steps, program["inputs"], primes, characters)
        numbers = stream(digest, f"points {number}")
        points += vanishes(steps, zero, program["inputs"], primes, numbers)
    error = max(errors) + math.ceil(math.log2(len(errors)))
    require(error <= TARGET, f"the error is bounded by 2^{error} only")
    return {"digest": digest, "primes": primes, "points": points, "degrees": degrees,
            "heights": heights, "error_log2": error}


def check(certificate):
    """Raises Refused, or returns what `from_text` does."""
    try:
        require(set(certificate) == {"format", "statement", "evidence"}, "the parts are wrong")
        require(certificate["format"] == "liouville certificate 1", "the format is unknown")
        statement, evidence = certificate["statement"], certificate["evidence"]
        text, claim = statement["case"]["text"], statement["claim"]
        require(hashlib.sha256(text.encode()).hexdigest() == statement["case"]["sha256"],
                "the text of the case has another digest")
        require(claim["verdict"] == "proved", "nothing else than a proof is certified")
        require(evidence.get("digest") == digest_of(statement), "the statement has another digest")
        require(evidence == evidence_of(statement), "the evidence is not that of the statement")
        return from_text(statement)
    except (LookupError, TypeError, ValueError, AttributeError, ArithmeticError) as error:
        raise Refused(f"the certificate is malformed: {error!r}") from error


# --- the residual from the text of the case ---------------------------------------------------------

class Unread(Exception):
    """The reason why a residual was not derived from the text of the case."""


class Series:
    """a + b e with e² = 0, as steps of a program of its own."""

    def __init__(self, program, value, rate):
        self.program, self.value, self.rate = program, value, rate

    def step(self, *step):
        return self.program.setdefault(step, len(self.program))

    def with_(self, value, rate):
        return Series(self.program, value, rate)

    def __add__(self, o):
        return self.with_(self.step("sum", self.value, o.value), self.step("sum", self.rate, o.rate))

    def __sub__(self, o):
        return self + -o

    def __neg__(self):
        return self.with_(self.step("negative", self.value), self.step("negative", self.rate))

    def __mul__(self, o):
        mixed = self.step("product", self.value, o.rate), self.step("product", self.rate, o.value)
        return self.with_(self.step("product", self.value, o.value), self.step("sum", *mixed))

    def __truediv__(self, o):
        inverse = self.step("reciprocal", o.value)
        square = self.step("product", inverse, inverse)
        slope = self.step("negative", self.step("product", o.rate, square))
        return self * self.with_(inverse, slope)


GREEK = dict(zip("alpha beta gamma delta epsilon zeta eta theta iota kappa lambda mu nu xi pi rho "
                 "sigma tau phi chi psi omega".split(), "αβγδεζηθικλμνξπρστφχψω"))
TOKEN = re.compile(r"\s*(?:(\d+(?:\.\d+)?)|([^\W\d_²³⁴⁵⁶⁷⁸⁹]+\d*)|(.))", re.S)
SIGNS = {"−": "-", "·": "*"}
RAISED = dict(zip("²³⁴⁵⁶⁷⁸⁹", range(2, 10)))


class Reader:
    """Formulas of numbers, names, + - * / ^ and brackets; anything else is left unread."""

    def __init__(self, text, number, name):
        self.tokens = [token for token in TOKEN.findall(text.strip())]
        self.number, self.name = number, name

    def next_sign(self):
        sign = self.tokens[0][2] if self.tokens else ""
        return SIGNS.get(sign, sign)

    def whole(self):
        value = self.sum()
        if self.tokens:
            raise Unread("a formula has other signs than + - * / ^ ( )")
        return value

    def sum(self):
        value = self.product()
        while self.next_sign() in ("+", "-"):
            sign = self.next_sign()
            self.tokens.pop(0)
            value = value + self.product() if sign == "+" else value - self.product()
        return value

    def product(self):
        if self.next_sign() == "-":
            self.tokens.pop(0)
            return -self.product()
        value = self.power()
        while self.next_sign() in ("*", "/"):
            sign = self.next_sign()
            self.tokens.pop(0)
            value = value * self.power() if sign == "*" else value / self.power()
        return value

    def power(self):
        base = self.atom()
        count = RAISED.get(self.next_sign())
        if count:
            self.tokens.pop(0)
        elif self.next_sign() == "^":
            if len(self.tokens) < 2 or not self.tokens[1][0].isdecimal():
                raise Unread("an exponent is no integer as it is written")
            count = int(self.tokens[1][0])
            del self.tokens[:2]
        if self.next_sign() == "^" or self.next_sign() in RAISED or (count or 1) not in range(1, 33):
            raise Unread("a power is beyond this reader")
        value = base
        for _ in range((count or 1) - 1):
            value = value * base
        return value

    def atom(self):
        number, name, sign = self.tokens.pop(0) if self.tokens else ("", "", "")
        if number:
            return self.number(Fraction(number))
        if name:
            letters = name.rstrip("0123456789")
            return self.name(GREEK.get(letters, letters) + name[len(letters):])
        if sign == "(":
            value = self.sum()
            if self.next_sign() == ")":
                self.tokens.pop(0)
                return value
        raise Unread("a formula is beyond this reader")


# Forms in which the certificate states claims, without spaces.
STATED = {"integral": "{}", "density": "{}", "identity": "{}={}", "rate": "({})'={}",
          "invariant-relation": "{}=0"}


def parts(kind, entry):
    """Two formulas of a claim in a case; 0 where it has one."""
    if kind == "identity":
        left, equals, right = entry[kind].partition("=")
        return left, right if equals else "0"
    second = {"rate": "equals", "invariant-relation": "cofactor"}.get(kind)
    return entry[kind], entry.get(second, "0") if second else "0"


def stated(kind, entry):
    texts = parts(kind, entry) if isinstance(entry.get(kind), str) else ()
    if not texts or not all(isinstance(text, str) for text in texts):
        return None
    return "".join(STATED[kind].format(*texts).split())


def derived(statement):
    """A program for the residual from the text of the case, for rational scalar fields everywhere."""
    try:
        import tomllib
    except ImportError:
        raise Unread("Python before 3.11 reads no TOML") from None
    case, claim = tomllib.loads(statement["case"]["text"]), statement["claim"]
    if statement["settings"] or "field" not in case or case.get("system", "field") != "field":
        raise Unread("the case is no field, or is changed by --set")
    if set(case) - {"title", "source", "system", "note", "notes", "parameters", "state", "field",
                    "claim", "variables", "poisson", "let", "table", "level", "one-sided",
                    "check-weights"}:
        raise Unread("the case has tables beyond this reader")
    if "level" in case and claim["where"] != "everywhere":
        raise Unread("the claim is made on a level")
    kind = claim["kind"]
    if kind not in STATED:
        raise Unread("the kind of the claim is beyond this reader")
    named = [one for one in case["claim"] if one.get("name", claim["name"]) == claim["name"]]
    own = [one for one in named if stated(kind, one) == "".join(claim["formula"].split())]
    require(own or not any(kind in one for one in named), "the case has no such claim")
    if not own:
        raise Unread("the claim is not found by its name")
    require(own[0].get("expect", "holds") == claim["expect"], "the case expects something else")
    first, second = parts(kind, own[0])
    program = {}

    def step(*one):
        return program.setdefault(one, len(program))

    zero = step("constant", Fraction(0))
    inputs, formulas, busy, rates = {}, dict(case.get("let", {})), set(), {}

    def number(value):
        return Series(program, step("constant", value), zero)

    def spelled(name):
        letters = name.rstrip("0123456789")
        return GREEK.get(letters, letters) + name[len(letters):]

    formulas = {spelled(name): formula for name, formula in formulas.items()}
    state = [spelled(name) for name in case["state"]]
    for name, value in list(case["state"].items()) + list(case.get("parameters", {}).items()):
        is_range = isinstance(value, str) and ".." in value and "(" not in value
        if is_range:
            inputs[spelled(name)] = len(inputs)
        elif spelled(name) in state or isinstance(value, (list, dict, bool)):
            raise Unread("a variable is no scalar")
        else:
            formulas[spelled(name)] = str(value)

    def value_of(name):
        if name in inputs:
            return Series(program, step("input", inputs[name]), rates.get(name, zero))
        if name not in formulas or name in busy or not isinstance(formulas[name], str):
            raise Unread(f"the name {name} is beyond this reader")
        busy.add(name)
        value = Reader(formulas[name], number, value_of).whole()
        busy.remove(name)
        return value

    field = {}
    for name, rate in case["field"].items():
        if not name.endswith(("'", "′")) or not isinstance(rate, str):
            raise Unread("a rate is no scalar")
        field[spelled(name[:-1])] = rate
    if set(field) != set(state):
        raise Unread("the rates are not those of the variables")

    def read(text, along):
        rates.clear()
        rates.update(along)
        return Reader(text, number, value_of).whole()

    velocity = {name: read(field[name], {}).value for name in state}
    value, other = read(first, velocity), read(second, velocity)
    residual = value.rate
    if kind == "identity":
        residual = step("difference", value.value, other.value)
    elif kind == "density":
        one = step("constant", Fraction(1))
        for name in state:
            slope = step("product", value.value, read(field[name], {name: one}).rate)
            residual = step("sum", residual, slope)
    elif kind == "rate":
        residual = step("difference", residual, other.value)
    elif kind == "invariant-relation":
        residual = step("difference", residual, (value * other).value)
    return list(program), residual, len(inputs)


def from_text(statement):
    """Whether the claim was proved from the text of the case too, and the reason if it was not."""
    try:
        steps, residual, inputs = derived(statement)
    except Unread as reason:
        return False, str(reason)
    digest = digest_of(statement)
    vanishes(steps, [residual], inputs, primes_of(digest), stream(digest, "text"))
    error = error_log2(*bounds(steps, [residual]))
    require(error <= TARGET, f"the error from the text is bounded by 2^{error} only")
    return True, ""


def main(files):
    counts = {"text": 0, "program": 0, "REFUSED": 0}
    for name in files:
        try:
            with open(name, encoding="utf-8") as file:
                is_text, reason = check(json.load(file))
            told, reason = ("text", "") if is_text else ("program", f": {reason}")
        except (Refused, OSError, ValueError, RecursionError) as problem:
            told, reason = "REFUSED", f": {problem}"
        counts[told] += 1
        print(f"{told:<8} {name}{reason}")
    print(f"{len(files)} certificates: {counts['text']} passed from the text of the case, "
          f"{counts['program']} passed for the program, {counts['REFUSED']} refused")
    return 1 if counts["REFUSED"] or not files else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
