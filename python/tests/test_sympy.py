"""Cases from SymPy, and formulas as expressions."""

import pytest
import sympy as sp
from sympy.physics import mechanics as me

import liouville as lv

x, y, u, v = sp.symbols("x y u v", real=True)
mu = sp.Symbol("mu", positive=True)
r = sp.sqrt(x**2 + y**2)
KEPLER = {x: u, y: v, u: -mu * x / r**3, v: -mu * y / r**3}
ENERGY = (u**2 + v**2) / 2 - mu / r
MOMENT = x * v - y * u
RUNGE_LENZ = [v * MOMENT - mu * x / r, -u * MOMENT - mu * y / r]


def test_kepler():
    integrals = {"energy": ENERGY, "L": MOMENT, "Runge–Lenz": sp.Matrix(RUNGE_LENZ)}
    twin = ENERGY + sp.Rational(1, 10**12) * x
    case = lv.from_sympy(
        KEPLER, integrals=integrals | {"twin": twin}, densities=[1], fails=["twin"], title="Kepler"
    )
    report = lv.check(case)
    assert report, repr(report)
    verdicts = {claim.name: claim.verdict for claim in report}
    proved = dict.fromkeys(integrals, "proved")
    assert verdicts == proved | {"density 1": "proved", "twin": "refuted"}
    assert case.parameters == {"μ": "drawn"}
    fixed = lv.from_sympy(KEPLER, integrals=ENERGY, parameters={mu: sp.Rational(3, 2)})
    assert fixed.parameters == {"μ": "fixed"} and lv.check(fixed)


def test_expressions_return():
    case = lv.from_sympy(KEPLER, integrals={"energy": ENERGY, "A": RUNGE_LENZ})
    assert sp.simplify(case.to_sympy("energy") - ENERGY) == 0
    assert [sp.simplify(a - b) for a, b in zip(case.to_sympy("A"), RUNGE_LENZ, strict=True)] == [
        0,
        0,
    ]
    field = case.to_sympy()
    assert list(field) == list(KEPLER)
    assert all(sp.simplify(field[key] - KEPLER[key]) == 0 for key in KEPLER)


def test_what_a_search_finds_is_an_expression():
    a, b = sp.symbols("a b", real=True)
    found = lv.from_sympy({a: b, b: -a}).search()
    (integral,) = found.integrals
    formula = integral.to_sympy()
    assert formula.free_symbols == {a, b}
    assert sp.simplify(formula.diff(a) * b - formula.diff(b) * a) == 0


def test_every_function_is_written():
    functions = [sp.sqrt, sp.exp, sp.log, sp.sin, sp.cos, sp.tan, sp.asin, sp.acos, sp.atan,
                 sp.sinh, sp.cosh, sp.tanh, sp.asinh, sp.atanh, sp.Abs, sp.sign, sp.cot, sp.sec]  # fmt: skip
    point = sp.Rational(2, 5)
    formulas = [f(x) for f in functions] + [
        x ** sp.Rational(2, 3), -x / 3, 2 ** -x, sp.Float("0.1") * x, sp.pi * x, sp.E**x,
        sp.Max(x, y), sp.Min(x, 2), sp.atan2(x, y + 3), (x - 1) * (-(x + 2)) / (y - 3), -(x**2),
    ]  # fmt: skip
    case = lv.from_sympy({x: sum(formulas), y: 0}, ranges={x: (0.1, 0.9), y: (0.1, 0.9)})
    expected = float(sum(formulas).subs({x: point, y: sp.Rational(3, 5)}))
    assert abs(case.field(0, [0.4, 0.6])[0] - expected) < 1e-13 * abs(expected)
    for formula in (sp.gamma(x), sp.Heaviside(x), sp.Piecewise((x, x > 0), (0, True)), sp.I * x):
        with pytest.raises(ValueError, match="function|formula"):
            lv.from_sympy({x: formula})


def test_kane_method_of_the_sleigh():
    """Chaplygin's sleigh: energy is an integral, 1/ω the density of a measure."""
    px, py, phi, speed, omega = me.dynamicsymbols("px py phi speed omega")
    m, inertia, a = sp.symbols("m I_s a", positive=True)
    frame, body = me.ReferenceFrame("N"), me.ReferenceFrame("B")
    body.orient_axis(frame, frame.z, phi)
    body.set_ang_vel(frame, omega * frame.z)
    blade = me.Point("P")
    blade.set_vel(frame, speed * body.x)
    centre = blade.locatenew("C", a * body.x)
    centre.v2pt_theory(blade, frame, body)
    sleigh = me.RigidBody("S", centre, body, m, (me.inertia(body, 0, 0, inertia), centre))
    kinematics = [
        px.diff() - speed * sp.cos(phi), py.diff() - speed * sp.sin(phi), phi.diff() - omega,
    ]  # fmt: skip
    kane = me.KanesMethod(frame, [px, py, phi], [speed, omega], kinematics)
    kane.kanes_equations([sleigh], [])
    energy = m * (speed**2 + a**2 * omega**2) / 2 + inertia * omega**2 / 2
    case = lv.from_sympy(
        kane,
        integrals={"energy": energy, "wrong": energy + m * a * omega},
        densities={"1/ω": 1 / omega, "1": 1},
        fails=["wrong", "1"],
        ranges={omega: (0.1, 2)},
    )
    report = lv.check(case)
    assert report, repr(report)
    assert [claim.verdict for claim in report] == ["proved", "refuted", "proved", "refuted"]


def test_lagrange_method_of_the_pendulum():
    q = me.dynamicsymbols("q")
    m, g, length = sp.symbols("m g l", positive=True)
    lagrangian = m * length**2 * q.diff() ** 2 / 2 + m * g * length * sp.cos(q)
    method = me.LagrangesMethod(lagrangian, [q])
    method.form_lagranges_equations()
    energy = q.diff() * lagrangian.diff(q.diff()) - lagrangian
    case = lv.from_sympy(method, integrals={"energy": energy})
    assert case.state == ["q", "v_q"]
    assert lv.check(case)["energy"].verdict == "proved"
    short = lv.from_lagrangian(lagrangian, [q], integrals={"energy": energy})
    assert short.text == case.text


def test_explicit_time_and_strange_names():
    t = me.dynamicsymbols._t
    q = me.dynamicsymbols("q")
    k = sp.Symbol("k_{1}")
    case = lv.from_sympy({q: k * t}, integrals={"F": q - k * t**2 / 2})
    assert case.state == ["q", "t"] and lv.check(case)["F"].verdict == "proved"
    assert k in case.to_sympy("F").free_symbols
    other = me.dynamicsymbols("p")
    with pytest.raises(ValueError, match="no rate"):
        lv.from_sympy({q: other})
    with pytest.raises(ValueError, match="in no formula"):
        lv.from_sympy({x: y, y: x}, parameters={mu: 1})
    with pytest.raises(ValueError, match="names no claim"):
        lv.from_sympy({x: y, y: x}, fails=["F"])
    with pytest.raises(TypeError, match="mapping"):
        lv.from_sympy(3)
