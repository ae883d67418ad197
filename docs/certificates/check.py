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


# --- the form of a certificate ----------------------------------------------------------------------

def load(file):
    """Reads JSON with whole numbers alone, in which no key is there twice."""
    def table(pairs):
        keys = [key for key, _ in pairs]
        twice = next((key for key in keys if keys.count(key) > 1), None)
        require(twice is None, f"the key `{twice}` is there twice")
        return dict(pairs)

    def number(text):
        raise Refused(f"the number {text[:30]} is not whole")

    return json.load(file, object_pairs_hook=table, parse_float=number, parse_constant=number)


def is_number(text):
    return isinstance(text, str) and re.fullmatch(r"-?[0-9]+(/0*[1-9][0-9]*)?", text)


def is_index(value):
    return type(value) is int and value >= 0


TEXT = (lambda value: isinstance(value, str), "is not a text")
TEXT_OR_NONE = (lambda value: value is None or isinstance(value, str), "is not a text")
INDEX = (is_index, "is not a number from 0")
PLACES = [INDEX]
STEP = (lambda value: isinstance(value, list) and value, "is not a step")
FIXED = (lambda value: isinstance(value, list) and len(value) == 2 and is_index(value[0])
         and isinstance(value[1], str) and re.fullmatch(r"-?[0-9]+([./][0-9]+)?", value[1]),
         "is not a draw with its value")
CASE = {"path": TEXT, "sha256": TEXT, "text": TEXT}
PROGRAM = {"inputs": INDEX, "fixed": [FIXED], "steps": [STEP], "parameters": {None: PLACES},
           "state": {None: PLACES},
           "zero": {"residual": PLACES, "level": PLACES, "level rates": PLACES,
                    "quadratures": PLACES}}
OPTIONAL = {"level", "level rates", "quadratures", "least"}
CERTIFICATE = {
    "format": TEXT,
    "statement": {"case": CASE, "settings": [TEXT], "programs": [PROGRAM],
                  "claim": {"name": TEXT, "kind": TEXT, "formula": TEXT_OR_NONE, "where": TEXT,
                            "expect": TEXT, "verdict": TEXT}},
    "evidence": {"digest": TEXT, "primes": [INDEX], "points": INDEX, "degrees": [INDEX],
                 "heights": [INDEX], "error_log2": (lambda n: type(n) is int, "is not whole")}}


def shaped(value, form, place=""):
    """Refuses what has not exactly this form: a table of keys (`None`: any), a list, or a leaf."""
    at = place or "the certificate"
    if isinstance(form, dict):
        require(isinstance(value, dict), f"{at} is not a table")
        for key in value:
            require(key in form or None in form, f"{at} has the unknown key `{key}`")
        for key in form:
            is_there = key is None or key in value or key in OPTIONAL
            require(is_there, f"{at} has no key `{key}`")
        for key, one in value.items():
            shaped(one, form.get(key, form.get(None)), f"{place}.{key}".lstrip("."))
    elif isinstance(form, list):
        require(isinstance(value, list), f"{at} is not a list")
        for index, one in enumerate(value):
            shaped(one, form[0], f"{place}[{index}]")
    else:
        require(form[0](value), f"{at} {form[1]}")


def same(stated, found, place):
    """Requires that what is stated is what was found, key by key."""
    for key, value in found.items():
        require(stated[key] == value, f"{place}.{key} is not what the statement leads to")


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

def read_program(program, at="program"):
    """Steps with exact numbers; every argument is an earlier step."""
    steps, inputs = [], program["inputs"]
    require(inputs <= 10**6, f"{at}.inputs is too large")
    for draw, _ in program["fixed"]:
        require(draw < inputs, f"{at}.fixed names an input that does not exist")
    for place, (name, *rest) in enumerate(program["steps"]):
        here = f"{at}.steps[{place}]"
        require(isinstance(name, str) and len(rest) == ARITY.get(name), f"{here} is not a step")
        if name == "constant":
            require(is_number(rest[0]), f"{here} has a constant that is not a number")
            rest = [Fraction(rest[0])]
        elif name == "input":
            require(is_index(rest[0]) and rest[0] < inputs, f"{here}: the input does not exist")
        else:
            arguments = rest[:1] if name == "power" else rest
            require(all(is_index(a) and a < place for a in arguments),
                    f"{here} uses a step that does not come before it")
            require(name != "power" or type(rest[1]) is int and abs(rest[1]) <= 2**31,
                    f"{here} has an exponent that is not whole, or too large")
        steps.append((name, *rest))
    for part in ("parameters", "state", "zero"):
        for key, places in program[part].items():
            require(all(place < len(steps) for place in places),
                    f"{at}.{part}.{key} names a step that does not exist")
    require(program["zero"]["residual"], f"{at}.zero.residual is empty")
    zero = [place for places in program["zero"].values() for place in places]
    return steps, zero


def times(x, y, p):
    """Product in F_p(i), i² = -1."""
    if not x[1] and not y[1]:
        return x[0] * y[0] % p, 0
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


def check_roots(steps, inputs, primes, numbers, at):
    """Requires that the radicands contain no roots, and that the roots are independent modulo p.

    At a point each radicand is a square or none. If the vectors of these bits over some points, and
    the vector of -1, which is no square anywhere, are linearly independent over two elements, no
    product of radicands is a square, and the roots are independent (Kummer).
    """
    has_root = []
    for place, (name, a, *b) in enumerate(steps):
        used = [] if name in ("constant", "input") else [a] if name == "power" else [a, *b]
        require(name != "root" or not has_root[a], f"{at}.steps[{place}]: a root contains another")
        has_root.append(name == "root" or any(has_root[step] for step in used))
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
            require(row, f"{at}: the roots are not seen to be independent")
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
            elif x == y:
                bound = (max(d, e), max(h, i) + 1, x)
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


def vanishes(steps, zero, inputs, primes, numbers, at):
    """Whether all values are 0 at POINTS points for each prime; their number."""
    accepted = 0
    for p in primes:
        left = POINTS
        for _ in range(DRAWS):
            point = [next(numbers) % p for _ in range(inputs)]
            values = evaluate(steps, point, p, numbers)
            if values is not None:
                other = next((place for place in zero if values[place] != (0, 0)), None)
                require(other is None, f"{at}.steps[{other}] is not 0 at a point")
                left -= 1
                accepted += 1
            if left == 0:
                break
        require(left == 0, f"{at} has no value at almost all points: a denominator is 0")
    return accepted


def evidence_of(statement):
    """What a certificate has to state: derived from its statement alone."""
    digest = digest_of(statement)
    primes, degrees, heights, errors, points = primes_of(digest), [], [], [], 0
    require(statement["programs"], "statement.programs is empty")
    for number, program in enumerate(statement["programs"]):
        at = f"statement.programs[{number}]"
        steps, zero = read_program(program, at)
        require(statement["claim"]["where"] == "everywhere" or program["zero"].get("level"),
                f"{at}.zero.level is missing: the claim is made on a level")
        degree, height = bounds(steps, zero)
        degrees.append(degree)
        heights.append(height)
        errors.append(error_log2(degree, height))
        characters = stream(digest, f"characters {number}")
        check_roots(steps, program["inputs"], primes, characters, at)
        numbers = stream(digest, f"points {number}")
        points += vanishes(steps, zero, program["inputs"], primes, numbers, at)
    error = max(errors) + math.ceil(math.log2(len(errors)))
    require(error <= TARGET, f"the error is bounded by 2^{error} only")
    return {"digest": digest, "primes": primes, "points": points, "degrees": degrees,
            "heights": heights, "error_log2": error}


def check_case(statement):
    text, claim = statement["case"]["text"], statement["claim"]
    require(hashlib.sha256(text.encode()).hexdigest() == statement["case"]["sha256"],
            "statement.case.text has another digest")
    require(claim["verdict"] == "proved", "statement.claim.verdict is no proof")


def check(certificate):
    """Raises Refused, or returns what `from_text` does."""
    try:
        require(isinstance(certificate, dict)
                and certificate.get("format") == "liouville certificate 1", "format is unknown")
        shaped(certificate, CERTIFICATE)
        statement, evidence = certificate["statement"], certificate["evidence"]
        check_case(statement)
        require(statement["claim"]["expect"] in ("holds", "fails", "open"),
                "statement.claim.expect is unknown")
        require(evidence["digest"] == digest_of(statement), "the statement has another digest")
        same(evidence, evidence_of(statement), "evidence")
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
TOKEN = re.compile(r"\s*(?:([0-9]+(?:\.[0-9]+)?)|([^\W\d_²³⁴⁵⁶⁷⁸⁹]+[0-9]*)|(.))", re.S)
SIGNS = {"−": "-", "·": "*"}
RAISED = dict(zip("²³⁴⁵⁶⁷⁸⁹", range(2, 10)))


def spelled(name):
    """The name in the form in which formulas have it."""
    letters = name.rstrip("0123456789")
    return GREEK.get(letters, letters) + name[len(letters):]


def named(table, place):
    """A table of the case by its names as they are spelled, none of which is there twice."""
    if not isinstance(table, dict):
        raise Unread(f"{place} is no table")
    found = {spelled(name): value for name, value in table.items()}
    if len(found) < len(table):
        raise Unread(f"{place} has a name twice, in two spellings")
    return found


def case_of(text):
    """The case as exact text: a decimal is not rounded to a float."""
    try:
        import tomllib
    except ImportError:
        raise Unread("Python before 3.11 reads no TOML") from None
    try:
        return tomllib.loads(text, parse_float=str)
    except tomllib.TOMLDecodeError as error:
        raise Refused(f"statement.case.text is no TOML: {error}") from error


def only(table, keys, place):
    """Leaves a case unread that says more than this reader knows."""
    for key in table:
        if key not in keys:
            raise Unread(f"{place} has the key `{key}`, which is beyond this reader")


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
            return self.name(spelled(name))
        if sign == "(":
            value = self.sum()
            if self.next_sign() == ")":
                self.tokens.pop(0)
                return value
        raise Unread("a formula is beyond this reader")


# Forms in which the certificate states claims, without spaces.
STATED = {"integral": "{}", "density": "{}", "identity": "{}={}", "rate": "({})'={}",
          "invariant-relation": "{}=0"}


SECOND = {"rate": "equals", "invariant-relation": "cofactor"}
KEYS = {"title", "source", "system", "note", "parameters", "state", "field", "claim", "let",
        "check-weights"}
CLAIM_KEYS = {"name", "source", "where", "expect", "cell", "note"}


def parts(kind, entry):
    """Two formulas of a claim in a case; 0 where it has one."""
    if kind == "identity":
        left, equals, right = entry[kind].partition("=")
        return left, right if equals else "0"
    second = SECOND.get(kind)
    return entry[kind], entry.get(second, "0") if second else "0"


def stated(kind, entry):
    texts = parts(kind, entry) if isinstance(entry.get(kind), str) else ()
    if not texts or not all(isinstance(text, str) for text in texts):
        return None
    return "".join(STATED[kind].format(*texts).split())


def divides_by_inputs(steps, last):
    """Whether a value contains the reciprocal of one that is not constant."""
    varies, divides = [], []
    for name, a, *b in steps:
        used = [] if name in ("constant", "input") else [a, *b]
        varies.append(name == "input" or any(varies[step] for step in used))
        divides.append(name == "reciprocal" and varies[a] or any(divides[step] for step in used))
    return divides[last]


def derived(statement):
    """A program for the residual from the text of the case, for rational scalar fields everywhere."""
    case, claim = case_of(statement["case"]["text"]), statement["claim"]
    if statement["settings"] or "field" not in case or case.get("system", "field") != "field":
        raise Unread("the case is no field, or is changed by --set")
    only(case, KEYS | {"variables", "poisson", "table", "level", "one-sided"}, "the case")
    if claim["where"] != "everywhere":
        require("level" in case, "statement.claim.where is on a level, and the case has none")
        raise Unread("the claim is made on a level")
    kind = claim["kind"]
    if kind not in STATED:
        raise Unread("the kind of the claim is beyond this reader")
    all_claims = case.get("claim", [])
    unnamed = re.sub(r" \([0-9]+\)$", "", claim["name"]) == claim["formula"]
    like = [one for one in all_claims if one.get("name", unnamed) in (claim["name"], True)]
    own = [one for one in like if stated(kind, one) == "".join((claim["formula"] or "").split())]
    require(own or not any(kind in one for one in like),
            "statement.claim.formula is not that of the case")
    if not own:
        raise Unread("the claim is not found by its name")
    only(own[0], CLAIM_KEYS | {kind, SECOND.get(kind)}, "the claim")
    if own[0].get("where") == "level only":
        raise Unread("the claim is made on a level only")
    require(own[0].get("expect", "holds") == claim["expect"],
            "statement.claim.expect is not that of the case")
    first, second = parts(kind, own[0])
    program = {}

    def step(*one):
        return program.setdefault(one, len(program))

    zero = step("constant", Fraction(0))
    inputs, busy, rates = {}, set(), {}
    state, formulas = named(case["state"], "state"), named(case.get("let", {}), "let")
    parameters = named(case.get("parameters", {}), "parameters")
    if len({*state, *formulas, *parameters}) < len(state) + len(formulas) + len(parameters):
        raise Unread("a name of the case has two meanings")

    def number(value):
        return Series(program, step("constant", value), zero)

    for name, value in [*state.items(), *parameters.items()]:
        if isinstance(value, str) and ".." in value and "(" not in value:
            inputs[name] = len(inputs)
        elif name in state or type(value) not in (str, int):
            raise Unread("a variable is no scalar")
        else:
            formulas[name] = str(value)

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
        if not name.endswith(("'", "′")) or not isinstance(rate, str) or spelled(name[:-1]) in field:
            raise Unread("a rate is no scalar, or is there twice")
        field[spelled(name[:-1])] = rate
    if set(field) != set(state):
        raise Unread("the rates are not those of the variables")

    def read(text, along):
        rates.clear()
        rates.update(along)
        return Reader(text, number, value_of).whole()

    velocity = {name: read(field[name], {}).value for name in state}
    value, other = read(first, velocity), read(second, velocity)
    if kind == "invariant-relation" and divides_by_inputs(list(program), other.value):
        raise Unread("the cofactor has a denominator, which may vanish where the relation holds")
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
    digest, at = digest_of(statement), "the residual from statement.case.text"
    vanishes(steps, [residual], inputs, primes_of(digest), stream(digest, "text"), at)
    error = error_log2(*bounds(steps, [residual]))
    require(error <= TARGET, f"{at} has an error bounded by 2^{error} only")
    return True, ""


OF_MOTIONS = ("liouville motion certificate 1", "liouville horseshoe certificate 1")


def main(files):
    counts = {"text": 0, "program": 0, "REFUSED": 0}
    others = 0
    for name in files:
        try:
            with open(name, encoding="utf-8") as file:
                certificate = load(file)
            if isinstance(certificate, dict) and certificate.get("format") in OF_MOTIONS:
                print(f"{'other':<8} {name}: a claim about a motion, which `liouville verify` checks")
                others += 1
                continue
            is_text, reason = check(certificate)
            word, reason = ("text", "") if is_text else ("program", f": {reason}")
        except (Refused, OSError, ValueError, RecursionError) as problem:
            word, reason = "REFUSED", f": {problem}"
        counts[word] += 1
        print(f"{word:<8} {name}{reason}")
    count = len(files) - others
    noun = "certificate" if count == 1 else "certificates"
    print(f"{count} {noun}: {counts['text']} passed from the text of the case, "
          f"{counts['program']} passed for the program, {counts['REFUSED']} refused")
    return 1 if counts["REFUSED"] or not count else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
