"""Closed orbits, branches, diagrams, rotation numbers."""

import json
import signal
import threading
import time

import numpy as np
import pytest

import liouville as lv

CYCLE = "classical/flows/van-der-pol-cycle"
HENON = "classical/planar/henon-heiles-hamiltonian"


def told(command, *arguments):
    return json.loads(command("motion", *arguments, "--json"))


def test_closed_orbits_are_those_of_the_command(command):
    asked = told(command, "periodic", CYCLE, "--start", "2,0", "--section", "p = 0")
    orbits = lv.read(CYCLE).periodic([2, 0], "p = 0")
    assert orbits.outcome == asked and len(orbits) == 1
    assert orbits.to_pandas()["kind"].tolist() == ["sink"]
    assert orbits.to_arrow().num_rows == 1
    assert orbits.states.shape == (1, 2) and orbits.periods[0] > 6
    assert [len(one) for one in orbits.multipliers] == [1]
    timed = lv.periodic(CYCLE, {"x": 2, "p": 0}, time=orbits.periods[0])
    assert np.isclose(timed.periods[0], orbits.periods[0])
    asked = told(command, "periodic", "figures/fig-5", "--start", "1.5707963267948966,0")
    assert lv.periodic("figures/fig-5", [[np.pi / 2, 0]]).outcome == asked


def test_symmetric_orbits_are_those_of_the_command(command):
    words = ["--symmetric", "L=0,l=0", "--points", "40", "--period", "2"]
    asked = told(command, "periodic", "figures/fig-A2", *words)
    found = lv.read("figures/fig-A2").periodic(symmetric=["L=0", "l=0"], points=40, period=2)
    assert found.outcome == asked and len(found) > 0


def test_branches_are_those_of_the_command(command):
    words = ["--start", "2,0", "--section", "p = 0", "--parameter", "μ", "--from", "0.1"]
    asked = told(command, "continue", CYCLE, *words, "--to", "1", "--count", "5")
    branch = lv.read(CYCLE).branch([2, 0], "μ", "p = 0", range=(0.1, 1), count=5)
    assert branch.outcome == asked and branch.name == "μ"
    assert np.all((0.1 <= branch.values) & (branch.values <= 1))
    assert np.array_equal(branch["x"], [one["at"][0] for one in branch])
    assert branch.bifurcations == [] and len(branch.ends) == 2
    assert list(branch.to_pandas().columns) == ["μ", "x", "period", "kind", "bifurcation"]
    with pytest.raises(KeyError, match="nothing"):
        branch["nothing"]


def test_diagrams_are_those_of_the_command(command):
    words = ["--count", "4", "--crossings", "5", "--skip", "3"]
    asked = told(command, "diagram", "figures/fig-8", "--over", "a_g=5..15", *words)
    wanted = {"count": 4, "crossings": 5, "skip": 3}
    diagram = lv.read("figures/fig-8").diagram(("a_g", 5, 15), **wanted)
    assert diagram.outcome == asked and diagram.name == "a_g"
    assert diagram.crossings.dtype.names == ("a_g", "start", "l", "L/G")
    assert sorted(set(diagram.crossings["a_g"])) == [6.25, 8.75, 11.25, 13.75]
    assert diagram.problems == [] and len(diagram.to_pandas()) == len(diagram.crossings) == 20
    case = lv.read(HENON, ε="1/2")
    words = ["--set", "ε=1/2", "--section", "x = 0", "--axes", "y", "--start", "0,0.1,0.4,0"]
    asked = told(command, "diagram", HENON, *words, "--over", "energy=0.05..0.1", "--count", "2")
    found = case.diagram("energy=0.05..0.1", "x = 0", axes="y", starts=[0, 0.1, 0.4, 0], count=2)
    # a list of states is a file of starts, whose lines have other names
    for mine, other in zip(found, asked["values"], strict=True):
        pairs = zip(mine["orbits"], other["orbits"], strict=True)
        assert all(one["crossings"] == two["crossings"] for one, two in pairs)


def test_rotation_numbers_are_those_of_the_command(command):
    words = ["--from", "3.2,0", "--to", "4.4,0", "--centre", "3.14,0", "--count", "3"]
    asked = told(command, "rotation", "figures/fig-A2", *words, "--crossings", "200")
    case = lv.read("figures/fig-A2")
    line = case.rotation((3.2, 0), (4.4, 0), centre=(3.14, 0), count=3, crossings=200)
    assert line.outcome == asked and line.axes == ["l", "L/G"]
    assert line.starts.shape == (3, 2) and line.numbers.shape == line.errors.shape == (3,)
    assert len(line.resonances) == len(line.to_pandas()) == 3
    text = lv.rotation(case, "3.2,0", "4.4,0", centre="3.14,0", count=3, crossings=200)
    assert text.outcome == asked


def test_basins_are_those_of_the_command(command):
    words = ["--x", "x=-2..2", "--y", "p=-2..2", "--size", "6x4", "--time", "120"]
    asked = told(command, "basins", CYCLE, *words, "--set", "μ=1")
    case = lv.read(CYCLE, μ=1)
    found = case.basins("x=-2..2", ("p", -2, 2), size=(6, 4), time=120)
    assert found.outcome == asked and found.names == ("x", "p")
    assert found.basin.shape == (4, 6) and (found.basin == 1).all(), "the cycle attracts all"
    assert found.x.shape == (6,) and found.y.shape == (4,) and abs(found.x.sum()) < 1e-12
    assert [one["kind"] for one in found] == ["cycle or torus"] and found.states.shape == (1, 2)
    assert lv.basins(case, "x=-2..2", "p=-2..2", size=(6, 4), time=120).outcome == asked
    with pytest.raises(lv.MotionError, match="component of the state"):
        case.basins("x=0..1", "q=0..1")


def test_mistakes_about_closed_orbits():
    case = lv.read(CYCLE)
    with pytest.raises(lv.MotionError) as caught:
        case.periodic([2, 0])
    assert "period" in caught.value.message and "surface=" in caught.value.help
    assert "--" not in str(caught.value) and "\n |" not in str(caught.value)
    with pytest.raises(lv.MotionError, match="nothing"):
        case.periodic([2, 0], "nothing = 0")
    with pytest.raises(lv.MotionError):
        case.branch([2, 0], "nothing", "p = 0")
    with pytest.raises(lv.MotionError):
        case.diagram("μ=1..2")
    with pytest.raises(ValueError, match="drawn"):
        case.branch(None, "μ", "p = 0")


def test_an_interrupt_ends_a_branch():
    signal.signal(signal.SIGINT, signal.default_int_handler)
    case = lv.read("figures/fig-8")
    timer = threading.Timer(0.7, signal.raise_signal, (signal.SIGINT,))
    started = time.monotonic()
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        case.diagram("a_g=5..15", count=2000, crossings=1000)
    assert time.monotonic() - started < 5
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler
