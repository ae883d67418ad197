#!/usr/bin/env python3
"""Checks certificates of closed orbits: python3 orbit.py FILE.json ...

The field is read from the text of the case: scalar variables, rational formulas, no level. All that
docs/closed-orbits.md asks of the numbers is computed here, in intervals of integers over 2^192.
Exit code 0 if every file passes, 1 otherwise. Python 3.11 or later, standard library only.
"""

import functools
import re
import sys
from fractions import Fraction

from check import (CASE, INDEX, KEYS, TEXT, TEXT_OR_NONE, Reader, Refused, Series, Unread, case_of,
                   check_case, digest_of, load, named, only, require, shaped, spelled)

BITS = 192
ONE = 1 << BITS
ROUNDS = 100


# --- intervals (low, high) of integers, in units of 2^-192 -------------------------------------------

@functools.lru_cache(1 << 16)
def exact(value):
    """Interval of a fraction or a float."""
    value = Fraction(value) * ONE
    low = value.numerator // value.denominator
    return low, low if low == value else low + 1


ZERO = (0, 0)


def add(a, b):
    return a[0] + b[0], a[1] + b[1]


def sub(a, b):
    return a[0] - b[1], a[1] - b[0]


def ends(a, b):
    """Least and greatest product, in units of 2^-384."""
    (p, q), (r, s) = a, b
    if p >= 0:
        return (p if r >= 0 else q) * r, (q if s >= 0 else p) * s
    if q <= 0:
        return p * s if s >= 0 else q * s, p * r if r <= 0 else q * r
    products = p * r, p * s, q * r, q * s
    return min(products), max(products)


def mul(a, b):
    low, high = ends(a, b)
    return low >> BITS, -(-high >> BITS)


def inverse(a):
    require(a[0] > 0 or a[1] < 0, "a denominator may be 0")
    return ONE * ONE // a[1], -(ONE * ONE // -a[0])


def size(a):
    """Bound of |a|, as an integer."""
    return max(abs(a[0]), abs(a[1]))


def up(a, b):
    """Bound of a product of bounds."""
    return -(-(a * b) >> BITS)


def middle(a):
    return (a[0] + a[1]) / 2 / ONE


def around(mid, radius):
    """Interval of all numbers within a radius of a float."""
    return exact(mid)[0] - exact(radius)[1], exact(mid)[1] + exact(radius)[1]


# --- the equations from the text of the case -----------------------------------------------------------

class Motion:
    """Rates of the state, of parameters s, of n vectors by n + len(s), and of the integral of div v.

    Inputs are these variables; each step is a sum, difference, product, reciprocal, or constant."""

    def __init__(self, case, varied):
        if case.get("system", "field") != "field":
            raise Unread("the case is no field")
        only(case, KEYS, "the case")
        state, formulas = named(case["state"], "state"), named(case.get("let", {}), "let")
        self.names = list(state)
        if not all(isinstance(one, str) and ".." in one and "(" not in one for one in state.values()):
            raise Unread("a variable is no scalar")
        parameters, centres = named(case.get("parameters", {}), "parameters"), {}
        if len({*state, *formulas, *parameters}) < len(state) + len(formulas) + len(parameters):
            raise Unread("a name of the case has two meanings")
        formulas = {name: str(formula) for name, formula in formulas.items()}
        for name, value in parameters.items():
            if type(value) not in (str, int) or ".." in str(value):
                raise Unread("a parameter is no number")
            formulas[name] = centres[name] = str(value)
        for name in varied:
            if not DECIMAL.fullmatch(centres.get(name, "")):
                raise Unread(f"the parameter {name} varies about no decimal")
        n, q = len(self.names), len(varied)
        self.n, self.q, self.size = n, q, n + q + n * (n + q) + 1
        self.program, busy, rates = {}, set(), {}

        def step(*one):
            return self.program.setdefault(one, len(self.program))

        zero, unit = step("constant", Fraction(0)), step("constant", Fraction(1))
        inputs = [step("input", k) for k in range(self.size)]

        def number(value):
            return Series(self.program, step("constant", value), zero)

        def value_of(name):
            if name in self.names:
                return Series(self.program, inputs[self.names.index(name)], rates.get(name, zero))
            require(name in formulas and name not in busy, f"the name {name} is not known")
            if name in varied:
                s = n + list(varied).index(name)
                variable = Series(self.program, inputs[s], rates.get(s, zero))
                return number(Fraction(centres[name])) + number(varied[name]) * variable
            busy.add(name)
            value = Reader(formulas[name], number, value_of).whole()
            busy.remove(name)
            return value

        if not all(name.endswith(("'", "′")) and isinstance(rate, str)
                   for name, rate in case["field"].items()):
            raise Unread("a rate is no scalar")
        field = named({name[:-1]: rate for name, rate in case["field"].items()}, "field")
        if set(field) != set(self.names) or len(field) < len(case["field"]):
            raise Unread("the rates are not those of the variables")

        def derivative(along):
            rates.clear()
            rates.update(along)
            return [Reader(field[name], number, value_of).whole() for name in self.names]

        self.rates = [one.value for one in derivative({})] + [zero] * q
        for vector in range(n + q):
            first = n + q + n * vector
            along = {name: inputs[first + k] for k, name in enumerate(self.names)}
            if vector >= n:
                along[vector] = unit
            self.rates += [one.rate for one in derivative(along)]
        divergence = zero
        for k, name in enumerate(self.names):
            divergence = step("sum", divergence, derivative({name: unit})[k].rate)
        self.rates.append(divergence)
        self.steps = list(self.program)
        # The state and the parameters alone: what the ends of points, and of parts of a period, take.
        self.plain = needed(self.steps, self.rates[:n + q])
        self.constants = {name: formulas[name] for name in parameters}

    def number(self, text, busy=()):
        """Value of a formula in the parameters, as they are in the case."""
        def one(name):
            if name not in self.constants or name in busy:
                raise Unread(f"the start contains {name}")
            return self.number(self.constants[name], (*busy, name))

        return Reader(text, Fraction, one).whole()

    def step(self, start, h, order, rho):
        """Encloses the variables after the time h, by tails in the norm of radius rho."""
        return self.run(self.steps, self.rates, start, h, order, rho)

    def state_after(self, start, h, order, rho):
        """Encloses the state after the time h."""
        steps, rates = self.plain
        return self.run(steps, rates, start[:len(rates)], h, order, rho)[:self.n]

    def run(self, steps, rates, start, h, order, rho):
        series = [[] for _ in steps]
        state = [[value] for value in start]
        for k in range(order):
            for place, (kind, *args) in enumerate(steps):
                series[place].append(coefficient(kind, args, series, state, k, place))
            for row, rate in zip(state, rates):
                row.append(mul(series[rate][k], exact(Fraction(1, k + 1))))
        rests = self.remainders(steps, rates, series, state, h, order, rho)
        ends = []
        for row, rest in zip(state, rests):
            total = ZERO
            for value in reversed(row):
                total = add(mul(total, h), value)
            ends.append((total[0] - rest, total[1] + rest))
        return ends

    def remainders(self, steps, rates, series, state, h, order, rho):
        radius = exact(rho)[1]
        require(size(h) < radius, "a step is longer than the radius of its tails")
        powers = [ONE]
        for _ in range(order):
            powers.append(up(powers[-1], radius))
        terms = [[up(size(a), p) for a, p in zip(row, powers)] for row in series]
        sums = [[sum(row[k:]) for k in range(order + 1)] for row in terms]
        last = [up(size(row[order]), powers[order]) for row in state]

        def cross(a, b):
            return sum(up(terms[a][k], sums[b][order - k]) for k in range(1, order))

        pairs = {}
        for place, (kind, *args) in enumerate(steps):
            if kind == "product":
                pairs[place] = cross(*args)
            elif kind == "reciprocal":
                pairs[place] = cross(args[0], place)
        tails = [value * 3 // 2 + 1 for value in last]
        ratio = -(-size(h) * ONE // radius)
        most = ONE + max(up(size(a), p) for row in state for a, p in zip(row, powers))
        for _ in range(ROUNDS):
            bounds = []
            for place, (kind, *args) in enumerate(steps):
                own = [bounds[a] for a in args] if kind not in ("constant", "input") else []
                norms = [sums[a][0] for a in args] if own else []
                if kind == "input":
                    bounds.append(tails[args[0]])
                elif kind == "constant":
                    bounds.append(0)
                elif kind == "product":
                    mixed = up(norms[0], own[1]) + up(norms[1], own[0]) + up(own[0], own[1])
                    bounds.append(pairs[place] + mixed)
                elif kind == "reciprocal":
                    norm = sums[place][0]
                    defect = pairs[place] + up(norm, own[0])
                    require(defect < ONE, "the tail of a denominator is too large")
                    bounds.append(-(-up(defect, norm) * ONE // (ONE - defect)))
                else:
                    bounds.append(sum(own))
            moved = [-(-up(radius, bounds[rate]) // (order + 1)) for rate in rates]
            new = [a + b for a, b in zip(last, moved)]
            if all(a <= b for a, b in zip(new, tails)):
                power = ONE
                for _ in range(order + 1):
                    power = up(power, ratio)
                return [up(bound, power) + 1 for bound in moved]
            tails = [max(b, a * 11 // 10 + 1) for a, b in zip(new, tails)]
            require(max(tails) < most, "the tails grow without bound")
        raise Refused("no tail is mapped to itself")

    def start(self, state, is_wide):
        """All variables at the begin of a segment."""
        unit = [exact(int(i == j)) for i in range(self.n + self.q) for j in range(self.n)]
        return list(state) + [(-ONE, ONE) if is_wide else ZERO] * self.q + unit + [ZERO]

    def column(self, end, index):
        first = self.n + self.q + self.n * index
        return end[first:first + self.n]

    def field(self, state, is_wide):
        steps, rates = self.plain
        values, inputs = [], [[value] for value in self.start(state, is_wide)]
        for kind, *args in steps:
            values.append([])
            values[-1].append(coefficient(kind, args, values, inputs, 0, len(values) - 1))
        return [values[rate][0] for rate in rates[:self.n]]


def needed(steps, rates):
    """The steps that some rates depend on, and the places of the rates among them."""
    kept = set(rates)
    for place in reversed(range(len(steps))):
        kind, *args = steps[place]
        if place in kept and kind not in ("constant", "input"):
            kept.update(args)
    places = {old: new for new, old in enumerate(sorted(kept))}

    def moved(kind, *args):
        return (kind, *args) if kind in ("constant", "input") else (kind, *map(places.get, args))

    return [moved(*steps[old]) for old in sorted(kept)], [places[rate] for rate in rates]


def coefficient(kind, args, series, state, k, place):
    """The coefficient of order k of a step."""
    if kind == "constant":
        return exact(args[0]) if k == 0 else ZERO
    if kind == "input":
        return state[args[0]][k]
    a = series[args[0]]
    if kind == "negative":
        return -a[k][1], -a[k][0]
    if kind == "reciprocal":
        own = series[place]
        if k == 0:
            return inverse(a[0])
        total = ZERO
        for i in range(1, k + 1):
            total = add(total, mul(a[i], own[k - i]))
        return sub(ZERO, mul(own[0], total))
    b = series[args[1]]
    if kind == "sum":
        return add(a[k], b[k])
    if kind == "difference":
        return sub(a[k], b[k])
    low = high = 0
    for x, y in zip(a, b[k::-1]):
        part = ends(x, y)
        low, high = low + part[0], high + part[1]
    return low >> BITS, -(-high >> BITS)


# --- Krawczyk's test -------------------------------------------------------------------------------------

def approximate_inverse(columns, count):
    """Inverse in floats by Gauss and Jordan; nothing is assumed about it."""
    rows = [[0.0] * count + [float(i == j) for j in range(count)] for i in range(count)]
    for j, column in enumerate(columns):
        for i, value in column.items():
            rows[i][j] = middle(value)
    for j in range(count):
        pivot = max(range(j, count), key=lambda i: abs(rows[i][j]))
        rows[j], rows[pivot] = rows[pivot], rows[j]
        require(rows[j][j] != 0, "the equations are singular")
        by = 1 / rows[j][j]
        rows[j][j:] = own = [x * by for x in rows[j][j:]]
        for i in range(count):
            factor = rows[i][j]
            if i != j and factor:
                rows[i][j:] = [x - factor * y for x, y in zip(rows[i][j:], own)]
    return [row[count:] for row in rows]


def prove(motion, proof):
    """Encloses start, period and the integral of the divergence, or raises Refused."""
    n, m, order = motion.n, len(proof["nodes"]), proof["order"]
    number = float.fromhex  # exact: `shaped` lets no more than 53 bits pass
    nodes = [[number(x) for x in node] for node in proof["nodes"]]
    shares, tails = [[number(x) for x in proof[key]] for key in ("shares", "tails")]
    radii, period = [number(x) for x in proof["radii"]], number(proof["period"])
    for key in ("functions", "values"):
        if proof[key]:
            raise Unread(f"proof.{key}: functions are conserved")
    require(m > 0, "proof.nodes is empty")
    for index, node in enumerate(nodes):
        require(len(node) == n, f"proof.nodes[{index}] has not {n} components")
    for key, count in (("shares", m), ("tails", m), ("radii", n * m + 1)):
        require(len(proof[key]) == count, f"proof.{key} has not {count} numbers")
    require(2 <= order <= 60, "proof.order is out of range")
    for key, numbers in (("shares", shares), ("tails", tails), ("radii", radii), ("period", [period])):
        require(min(numbers) > 0, f"proof.{key} is not positive")
    require(radii[-1] < period, "proof.radii: the period may be 0")
    count = n * m + 1
    turn = around(period, radii[-1])
    residual, shifts, columns = [], [[] for _ in range(motion.q)], [{} for _ in range(count)]
    volume, total = ZERO, ZERO
    for i in range(m):
        following, share = (i + 1) % m, exact(shares[i])
        point = [exact(x) for x in nodes[i]]
        h = mul(share, exact(period))
        end = motion.state_after(motion.start(point, False), h, order, tails[i])
        residual += [sub(x, exact(y)) for x, y in zip(end, nodes[following])]
        if motion.q:
            moved = motion.step(motion.start(point, True), h, order, tails[i])
            for k in range(motion.q):
                shifts[k] += motion.column(moved, n + k)
        box = [around(x, r) for x, r in zip(nodes[i], radii[n * i:])]
        end = motion.step(motion.start(box, True), mul(share, turn), order, tails[i])
        for j in range(n):
            for k, slope in enumerate(motion.column(end, j)):
                own = columns[n * i + j]
                own[n * i + k] = add(own.get(n * i + k, ZERO), slope)
        for k, rate in enumerate(motion.field(end[:n], True)):
            other = columns[n * following + k]
            other[n * i + k] = sub(other.get(n * i + k, ZERO), exact(1))
            columns[-1][n * i + k] = mul(share, rate)
        volume, total = add(volume, end[-1]), add(total, share)
    residual.append(ZERO)
    for k, rate in enumerate(motion.field([exact(x) for x in nodes[0]], False)):
        columns[k][count - 1] = exact(middle(rate))
    near = approximate_inverse(columns, count)
    vectors = [residual] + [shift + [ZERO] for shift in shifts]
    images = []
    for i, row in enumerate(near):
        row = [exact(c) for c in row]
        image = 0
        for vector in vectors:
            parts = [mul(c, x) for c, x in zip(row, vector)]
            image += size((sum(p[0] for p in parts), sum(p[1] for p in parts)))
        for j, column in enumerate(columns):
            entry = exact(int(i == j))
            for place, slope in column.items():
                entry = sub(entry, mul(row[place], slope))
            image += up(size(entry), exact(radii[j])[1])
        require(image < exact(radii[i])[0], f"proof.radii[{i}]: the box is not mapped into itself")
        images.append(image)
    middles = [exact(x) for node in nodes for x in node] + [exact(period)]
    found = [(x[0] - r, x[1] + r) for x, r in zip(middles, images)]
    boxes = [found[n * i:n * i + n] for i in range(m)]
    slopes = [columns[k][count - 1] for k in range(n)]

    def is_least():
        return least(motion, boxes, shares, found[-1], tails, order, slopes)

    return boxes[0], mul(total, found[-1]), volume, is_least


# --- least periods ------------------------------------------------------------------------------------------

WINDOWS, BEGINS, MOST_PARTS = 8, 3, 20000


def least(motion, boxes, shares, turn, tails, order, slopes):
    """Whether it is proved that no part of the period is one: docs/closed-orbits.md, least periods."""
    shares = [Fraction(share) for share in shares]
    whole, window, early = sum(shares), shares[0], 0

    def after(i, low, high):
        time = mul((exact(low)[0], exact(high)[1]), turn)
        return motion.state_after(motion.start(boxes[i], True), time, order, tails[i])

    def rises(k):
        field = motion.field(after(0, k * window, (k + 1) * window), True)
        return sum(mul(a, b)[0] for a, b in zip(slopes, field)) > 0

    for _ in range(BEGINS):
        window /= WINDOWS
        early = next((k for k in range(WINDOWS) if not rises(k)), WINDOWS) * window
        if early:
            break
    if not early or whole / early > MOST_PARTS:
        return False
    for part in range(2, int(whole / early) + 1):
        if any(part % d == 0 for d in range(2, part)):
            continue
        i, rest = 0, whole / part
        while i + 1 < len(shares) and rest > shares[i]:
            i, rest = i + 1, rest - shares[i]
        state = after(i, rest, rest)
        if not any(x[1] < y[0] or y[1] < x[0] for x, y in zip(state, boxes[0])):
            return False
    return True


# --- the certificate ----------------------------------------------------------------------------------------

DECIMAL = re.compile(r"-?[0-9]+(\.[0-9]+)?([eE][-+]?[0-9]{1,3})?")
HEXADECIMAL = re.compile(r"-?0x(1\.[0-9a-f]{13}p[-+][0-9]{1,4}|0\.[0-9a-f]{13}p(-1022|\+0))")
NUMBER = (lambda x: isinstance(x, str) and HEXADECIMAL.fullmatch(x)
          and (x.lstrip("-")[2] == "0" or -1022 <= int(x[x.index("p") + 1:]) <= 1023),
          "is not a number in hexadecimal")
BALL = (lambda x: isinstance(x, list) and len(x) == 2 and all(map(NUMBER[0], x)), "is not a ball")
BALL_OR_NONE = (lambda x: x is None or BALL[0](x), "is not a ball")
CERTIFICATE = {
    "format": TEXT,
    "digest": TEXT,
    "statement": {
        "case": CASE, "settings": [TEXT],
        "claim": {"name": TEXT, "kind": TEXT, "formula": TEXT_OR_NONE, "where": TEXT,
                  "verdict": TEXT},
        "orbit": {"start": [BALL], "period": BALL, "volume": BALL, "multipliers": BALL_OR_NONE,
                  "least": (lambda x: isinstance(x, bool), "is neither true nor false")}},
    "proof": {"order": INDEX, "functions": [INDEX], "values": [NUMBER], "nodes": [[NUMBER]],
              "shares": [NUMBER], "period": NUMBER, "radii": [NUMBER], "tails": [NUMBER]}}
OF_CLAIM = {"name", "source", "expect", "note", "closed-orbit", "state", "period", "divergence",
            "stability", "density", "parameters"}
NEAR = Fraction(1, 100)  # distance from the start within which an orbit is the claimed one


def inside(found, stated, what):
    mid, radius = [Fraction(float.fromhex(x)) * ONE for x in stated]
    require(mid - radius <= found[0] and found[1] <= mid + radius,
            f"statement.orbit.{what} does not contain what the proof encloses")


def texts(table, place):
    """A table of texts; numbers are read as they are written."""
    if not isinstance(table, dict) or not all(type(one) in (str, int) for one in table.values()):
        raise Unread(f"{place} is no table of formulas")
    return {name: str(one) for name, one in table.items()}


def in_words(own, state, halves, names):
    """The formula of a claim and its place, as liouville states them."""
    start = ", ".join(f"{names(name)} = {text.strip()}" for name, text in state.items())
    kind = f"{own['stability']}, " if "stability" in own else ""
    least = "least " if "period" in own else ""
    volume = {"negative": ", volume shrinks", "positive": ", volume grows",
              "nonzero": ", volume changes", None: ""}[own.get("divergence")]
    density = ", no density" if "density" in own else ""
    varied = ", ".join(f"{spelled(name)} ± {half}" for name, half in halves.items())
    varied = f", for {varied}" if varied else ""
    orbit = f"{kind}closed orbit of {least}period {own['closed-orbit']}"
    return f"{orbit} near {start}{volume}{density}{varied}", f"from {start}"


def read_claim(case, claim):
    """The claim in the case, its start, and the distances of its parameters."""
    found = [one for one in case.get("claim", []) if one.get("name") == claim["name"]]
    require(len(found) == 1 and "closed-orbit" in found[0],
            "statement.claim.name is not that of a closed orbit in the case")
    own = found[0]
    only(own, OF_CLAIM, "the claim")
    for key, words in (("period", {"least"}), ("density", {"none"}),
                       ("divergence", {"negative", "positive", "nonzero"}),
                       ("stability", {"sink", "source"})):
        if key in own and own[key] not in words:
            raise Unread(f"the claim's {key} is beyond this reader")
    state, halves = texts(own.get("state"), "state"), {}
    for name, text in texts(own.get("parameters", {}), "parameters").items():
        centre, sign, half = text.partition("±")
        if centre.strip() or not sign or not DECIMAL.fullmatch(half.strip()):
            raise Unread(f"the distance of {name} is beyond this reader")
        halves[name] = half.strip()
        require(Fraction(half.strip()) > 0, f"the range of {name} is empty")
    stated = claim["formula"], claim["where"]
    require(stated in [in_words(own, state, halves, names) for names in (spelled, str)],
            "statement.claim.formula or .where is not that of the case")
    named(halves, "parameters")
    return own, named(state, "state"), {spelled(k): Fraction(half) for k, half in halves.items()}


def check_claim(own, motion, state, start, period, volume, stated):
    """Refuses the claim where the enclosures do not show it."""
    if not set(state) <= set(motion.names):
        raise Unread("the start has a name that is no variable")
    claimed = [motion.number(state.get(name, "0")) for name in motion.names]
    gaps = [Fraction(x[0] + x[1], 2 * ONE) - y for x, y in zip(start, claimed)]
    require(sum(g * g for g in gaps) <= NEAR**2 * sum(y * y for y in claimed),
            "the orbit does not begin near the state of the claim")
    require("period" not in own or stated.get("least"), "statement.orbit.least: the claim needs it")
    digits = str(own["closed-orbit"])
    if not re.fullmatch(r"[0-9]+\.[0-9]+", digits):
        raise Unread("the period of the claim is no decimal")
    unit = Fraction(1, 10 ** len(digits.partition(".")[2]))
    gap = max(abs(Fraction(x, ONE) - Fraction(digits)) for x in period)
    require(gap <= min(unit, NEAR * Fraction(digits)), "the period is not the one claimed")
    sign = (volume[0] > 0) - (volume[1] < 0)
    wanted = {"negative": [-1], "positive": [1], "nonzero": [-1, 1], None: [-1, 0, 1]}
    require(sign in wanted[own.get("divergence")], "volumes change otherwise than claimed")
    require("density" not in own or sign, "volumes may be kept, and the claim excludes a density")
    if "stability" in own:
        if motion.n != 2:
            raise Unread("more than one multiplier is beyond this script")
        require({"sink": -1, "source": 1}[own["stability"]] == sign, "the orbit is of another kind")


def check(certificate):
    """Raises Refused or Unread, or returns the claim in words."""
    try:
        require(isinstance(certificate, dict)
                and certificate.get("format") == "liouville motion certificate 1",
                "format is unknown")
        shaped(certificate, CERTIFICATE)
        statement, proof = certificate["statement"], certificate["proof"]
        require(certificate["digest"] == digest_of({"statement": statement, "proof": proof}),
                "the digest does not fit")
        check_case(statement)
        claim, stated = statement["claim"], statement["orbit"]
        require(claim["kind"] == "closed-orbit", "statement.claim.kind is no closed orbit")
        if statement["settings"]:
            raise Unread("the case is changed by --set")
        if stated["multipliers"] is not None:
            raise Unread("statement.orbit.multipliers are beyond this script")
        case = case_of(statement["case"]["text"])
        own, state, varied = read_claim(case, claim)
        motion = Motion(case, varied)
        require(len(stated["start"]) == motion.n,
                f"statement.orbit.start has not {motion.n} components")
        start, period, volume, is_least = prove(motion, proof)
        for k, (found, ball) in enumerate(zip(start, stated["start"])):
            inside(found, ball, f"start[{k}]")
        inside(period, stated["period"], "period")
        inside(volume, stated["volume"], "volume")
        require(not stated.get("least") or is_least(), "statement.orbit.least is not proved")
        check_claim(own, motion, state, start, period, volume, stated)
        word = "least period" if stated.get("least") else "period"
        return f"{word} {middle(period):.12f}, volume {middle(volume):.12f}"
    except (LookupError, TypeError, ValueError, AttributeError, ArithmeticError) as error:
        raise Refused(f"the certificate is malformed: {error!r}") from error


OTHERS = {
    "liouville certificate 1": "`python3 docs/certificates/check.py`",
    "liouville horseshoe certificate 1": "`liouville verify`",
}


def main(files):
    refused = others = 0
    for name in files:
        try:
            with open(name, encoding="utf-8") as file:
                certificate = load(file)
            if isinstance(certificate, dict) and certificate.get("format") in OTHERS:
                checker = OTHERS[certificate["format"]]
                print(f"other   {name}: no closed orbit; {checker} checks it", flush=True)
                others += 1
                continue
            print(f"proved  {name}: {check(certificate)}", flush=True)
        except (Refused, Unread, OSError, ValueError, RecursionError) as problem:
            refused += 1
            print(f"REFUSED {name}: {problem}", flush=True)
    count = len(files) - others
    noun = "certificate" if count == 1 else "certificates"
    print(f"{count} {noun}: {count - refused} proved, {refused} refused")
    return 1 if refused or not count else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
