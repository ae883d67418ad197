"""Motions as arrays."""

import json

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import liouville as lv

BODY = "figures/fig-8"
FLOW = """
title = "Lorenz"
[state]
x = "-2..2"
y = "-2..2"
z = "20..24"
[field]
"x'" = "10*(y − x)"
"y'" = "28*x − y − x*z"
"z'" = "x*y − 8/3*z"
"""


def test_orbits_are_those_of_the_command(tmp_path, command):
    path = tmp_path / "orbit.csv"
    start = [3.4, 0.3]
    command("motion", "orbit", BODY, "--start", "3.4,0.3", "--time", "20", "--every", "0.5",
            "--columns", "t, γ, energy", "--out", str(path))  # fmt: skip
    told = np.genfromtxt(path, delimiter=",", skip_header=1)
    orbit = lv.read(BODY).orbit(start, time=20, every=0.5, columns=["t", "γ", "energy"])
    assert orbit.columns == ["t", "γ1", "γ2", "γ3", "energy"]
    assert np.array_equal(orbit.data, told), "bit for bit"
    assert orbit["γ"].shape == (41, 3) and orbit.t[-1] == 20
    assert list(orbit.to_pandas().columns) == orbit.columns
    assert orbit.to_arrow().num_rows == len(orbit)
    assert max(orbit.drift.values()) < 1e-12


def test_the_field_in_scipy():
    case = lv.read(FLOW)
    start = [1.0, 2.0, 21.0]
    orbit = case.orbit(start, time=3, every=0.25)
    found = solve_ivp(
        case.field, (0, 3), start, method="DOP853", t_eval=orbit.t, rtol=1e-13, atol=1e-13
    )
    assert np.allclose(found.y.T, orbit.states, rtol=0, atol=1e-9)
    many = np.random.default_rng(1).normal(size=(3, 21))
    together = case.field(0, many)
    assert np.array_equal(together, np.stack([case.field(0, x) for x in many.T]).T)
    x, y, z = many
    assert np.allclose(together, [10 * (y - x), 28 * x - y - x * z, x * y - 8 / 3 * z], atol=1e-13)
    vectorised = solve_ivp(case.field, (0, 1), start, method="Radau", vectorized=True)
    assert vectorised.success
    with pytest.raises(ValueError, match="3 components"):
        case.field(0, [1, 2])


def test_formulas_of_the_state():
    case = lv.read(BODY)
    orbit = case.orbit([3.4, 0.3], time=5, every=1, columns=["t", "ω", "γ", "energy"])
    energy, length = case.function("energy", "(γ,γ)")(orbit.states)
    assert np.allclose(energy, orbit["energy"], rtol=1e-14) and np.allclose(length, 1)
    assert case.function("ω × γ")(orbit.states).shape == (6, 3)
    assert isinstance(case.function("|γ|")(orbit.states[0]), float)
    with pytest.raises(lv.FormulaError) as caught:
        case.function("energy + nothing")
    assert caught.value.column == 10


def test_free_parameters_are_drawn_alike():
    case = lv.read("plane/unbalanced-ball")
    values = case.parameter_values()
    assert set(values) == {name for name, origin in case.parameters.items() if origin == "drawn"}
    fixed = lv.parse("plane/unbalanced-ball", values)
    start = dict.fromkeys(case.state, 0.25) | {"γ3": 0.5}
    start = [start[name] for name in case.state]
    assert np.allclose(case.field(0, start), fixed.field(0, start), rtol=1e-14)


def test_sections_are_those_of_the_command(tmp_path, command):
    path = tmp_path / "section.csv"
    command("motion", "section", BODY, "--start", "3.4,0.3", "--start", "pi/2,0.1",
            "--crossings", "20", "--out", str(path))  # fmt: skip
    told = np.genfromtxt(path, delimiter=",", skip_header=1)
    section = lv.read(BODY).section(starts=[[3.4, 0.3], [np.pi / 2, 0.1]], crossings=20)
    assert section.dtype.names == ("start", "direction", "t", "l", "L/G")
    own = np.stack([section[name] for name in section.dtype.names], axis=1)
    assert np.array_equal(own, told), "bit for bit"
    assert section.axes == ["l", "L/G"]
    command("motion", "section", BODY, "--section", "γ3 = 0", "--axes", "γ1, ω3",
            "--orbits", "3", "--crossings", "20", "--out", str(path))  # fmt: skip
    told = np.genfromtxt(path, delimiter=",", skip_header=1)
    section = lv.read(BODY).section("γ3 = 0", axes="γ1, ω3", orbits=3, crossings=20)
    own = np.stack([section[name] for name in section.dtype.names], axis=1)
    assert np.array_equal(own, told), "bit for bit"
    assert isinstance(section, np.ndarray) and len(section.to_pandas()) == len(section)


def test_charts_are_those_of_the_command(command):
    axes = ["c1=0..2", "c2=0..2"]
    told = json.loads(
        command("motion", "chart", BODY, "--x", axes[0], "--y", axes[1], "--size", "4x3",
                "--time", "20", "--json")
    )  # fmt: skip
    chart = lv.read(BODY).chart(axes[0], ("c2", 0, 2), size=(4, 3), time=20)
    assert chart.names == ("c1", "c2") and chart.exponent.shape == (3, 4)
    assert chart.x.tolist() == [0.25, 0.75, 1.25, 1.75]
    for row, others in enumerate(told["rows"]):
        for column, (name, *numbers) in enumerate(others):
            if not numbers:
                assert chart.character[row, column] < 0
                continue
            assert lv.CLASSES[chart.character[row, column]] == name
            assert numbers == [chart.exponent[row, column], chart.divergence[row, column]]
    assert len(chart.to_pandas()) == 12
    with pytest.raises(lv.FormulaError, match="nothing"):
        lv.read(BODY).chart("nothing=0..1", "c1=0..1")


def test_exponents():
    case = lv.read(FLOW)
    spectra = case.exponents([[1, 2, 21], {"x": 1, "y": 2, "z": 22}], time=40, spectrum=True)
    for motion in spectra:
        values = [one["mean"] for one in motion["exponents"]]
        assert abs(sum(values) + 10 + 1 + 8 / 3) < 1e-6, "the divergence of the field"
    found = case.exponents([1, 2, 21], time=100, both_ways=False)
    assert len(found) == 1 and found.to_dicts()[0]["exponent"] > 0.5
    assert len(found.to_pandas()) == 1


def test_motions_that_end():
    blow_up = lv.read("title = 'a'\n[state]\nx = '1..2'\n[field]\n\"x'\" = 'x²'\n")
    with pytest.raises(lv.MotionError) as caught:
        blow_up.orbit([1], time=2)
    assert "t = 1" in str(caught.value) or "t = 0.99" in str(caught.value)
    early, whole = blow_up.orbits([[1], [-1]], time=2, every=0.5)
    assert early.problem and early.t.tolist() == [0, 0.5] and whole.problem is None
    with pytest.raises(ValueError, match="state has x"):
        blow_up.orbit([1, 2])
    with pytest.raises(ValueError, match="finite"):
        blow_up.orbit([float("nan")])
