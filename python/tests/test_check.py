"""Reading, judging, searching, reporting."""

import json
import os
import pickle
import signal
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from fractions import Fraction

import numpy as np
import pytest

import liouville as lv

OSCILLATOR = """
title = "oscillator"
[parameters]
k = "0.5..2"
[state]
x = "-2..2"
v = "-2..2"
[field]
"x'" = "v"
"v'" = "−k*x"
[[claim]]
name = "energy"
integral = "v² + k*x²"
[[claim]]
name = "wrong"
integral = "v² + x²"
"""


def test_a_rolling_body_of_the_catalogue():
    report = lv.check(lv.read("plane/balanced-ball"))
    assert report and len(report) == len(report.claims) > 3
    assert {claim.verdict for claim in report} == {"proved", "refuted"}
    proved = next(claim for claim in report if claim.verdict == "proved" and claim.error_log2)
    assert proved.rung == "prime field" and proved.error_log2 < -100
    assert report[proved.name] is proved
    refuted = next(claim for claim in report if claim.witness)
    assert "state" in refuted.witness


def test_verdicts_against_expectation():
    report = lv.check(OSCILLATOR)
    assert not report and report["energy"] and not report["wrong"]
    assert report["wrong"].verdict == "refuted"
    assert report.version == lv.__version__ and report.digest.startswith("sha256:")
    with pytest.raises(KeyError):
        report["other"]


def test_tables():
    report = lv.check(OSCILLATOR)
    frame = report.to_pandas()
    assert list(frame["verdict"]) == ["proved", "refuted"]
    assert report.to_arrow().column("name").to_pylist() == ["energy", "wrong"]
    page = report._repr_html_()
    assert "<table>" in page and "proved" in page
    assert "refuted" in repr(report)


def test_the_same_json_as_the_command(tmp_path, command):
    path = tmp_path / "oscillator.toml"
    path.write_text(OSCILLATOR, encoding="utf-8")
    told = json.loads(command("check", str(path), "--json", code=1))
    own = lv.check(path).run
    for run in (told, own):
        run["summary"].pop("seconds")
    assert own == told


@pytest.mark.parametrize("value", ["4", 4, 4.0, np.float64(4), np.int64(4), Fraction(8, 2)])
def test_settings(value):
    case = lv.read(OSCILLATOR, k=value)
    assert case.parameters == {"k": "fixed"}
    assert case.field(0, [1, 2]).tolist() == [2, -4]


def test_mistakes_have_places():
    text = OSCILLATOR.replace("−k*x", "−k*y").replace("v² + x²", "v² + 2x²")
    with pytest.raises(lv.CaseError) as caught:
        lv.read(text)
    error = caught.value
    assert [mistake.line for mistake in error.mistakes] == [10, 16]
    assert (error.line, error.column) == (10, 12)
    assert "^" in str(error) and "`y`" in error.message
    assert error.mistakes[1].help == "write `2*x²`"
    again = pickle.loads(pickle.dumps(error))
    assert str(again) == str(error) and again.mistakes == error.mistakes
    with pytest.raises(ValueError):
        lv.read("no/such/file.toml")
    with pytest.raises(lv.CaseError, match="q"):
        lv.read(OSCILLATOR, q=1)


def test_a_case_that_cannot_be_judged():
    text = "title = 'a'\n[state]\nx = '1..2'\n[field]\n\"x'\" = '1'\n[level]\n\"x\" = 1\n"
    with pytest.raises(lv.CaseError) as caught:
        lv.check(text)
    assert caught.value.help


def test_search_finds_the_integral():
    text = OSCILLATOR[: OSCILLATOR.index("[[claim]]")]
    found = lv.search(text)
    assert [one.verdict for one in found.integrals] == ["proved"]
    assert not found.unreached and "integral" in repr(found)
    assert found.to_pandas()["kind"].tolist().count("integral") == 1
    with pytest.raises(lv.SearchError, match="nothing"):
        lv.search(text, terms=["nothing"])


def test_search_takes_maps():
    found = lv.search(
        "title = 'Lyness'\n[state]\nx = '1..2'\ny = '1..2'\n[map]\nx = 'y'\ny = '(2 + y)/x'\n"
    )
    assert {one.kind: one.verdict for one in found} == {"density": "proved", "integral": "proved"}


def test_search_finds_conditions_on_several_parameters():
    text = (
        "title = 'a focus'\n[parameters]\na = '0.5..2'\nb = '0.5..2'\n"
        "[state]\nx = '1..2'\ny = '1..2'\n"
        "[field]\n\"x'\" = 'y'\n\"y'\" = '-x + (a - 2*b)*y'\n"
    )
    found = lv.search(text, conditions=True, degree=2)
    assert [one["equations"] for one in found.conditions] == [["a = 2*b"]]
    (darboux,) = [one for one in found if one.kind == "darboux-polynomial"]
    assert darboux.given == [("cofactor", "(a − 2*b)")]


def test_report_as_a_page():
    case = lv.read("plane/balanced-ball")
    page = case.report_html()
    assert page.startswith("<!DOCTYPE html>") or page.startswith("<!doctype html>")
    assert case.title in case.report("markdown")
    assert json.loads(case.report("json"))["digest"] == case.digest


def test_cases_are_pickled_by_their_text():
    case = lv.read(OSCILLATOR, k="3")
    again = pickle.loads(pickle.dumps(case))
    assert (again.text, again.parameters) == (case.text, case.parameters)
    assert again.check().run["cases"] == case.check().run["cases"]


def test_threads_share_a_case():
    case = lv.read("plane/balanced-ball")
    with ThreadPoolExecutor(4) as pool:
        runs = list(pool.map(lambda _: case.check().run["cases"], range(8)))
    assert all(run == runs[0] for run in runs)


@pytest.mark.skipif(not hasattr(os, "fork"), reason="no fork here")
@pytest.mark.filterwarnings("ignore::DeprecationWarning")
def test_a_forked_process_works():
    case = lv.read(OSCILLATOR)
    expected = case.check().run["cases"]
    child = os.fork()
    if child == 0:
        try:
            same = case.check().run["cases"] == expected and len(case.orbit(time=1)) > 0
            os._exit(0 if same else 1)
        finally:
            os._exit(2)
    for _ in range(300):
        ended, status = os.waitpid(child, os.WNOHANG)
        if ended:
            assert os.waitstatus_to_exitcode(status) == 0
            return
        time.sleep(0.1)
    os.kill(child, signal.SIGKILL)
    pytest.fail("the forked process hangs")


def threads_at_work():
    return len(os.listdir("/proc/self/task"))


@pytest.mark.skipif(not os.path.exists("/proc/self/task"), reason="no /proc here")
@pytest.mark.parametrize("long", ["orbit", "chart", "search"])
def test_an_interrupt_ends_long_calls(long):
    # A shell starts what runs in the background with interrupts ignored.
    signal.signal(signal.SIGINT, signal.default_int_handler)
    case = lv.read("figures/fig-8")
    before = threads_at_work()
    calls = {
        "orbit": lambda: case.orbit(time=10**7, every=1000),
        "chart": lambda: case.chart("c1=0..2", "c2=0..2", size=(200, 200), time=10**5),
        "search": lambda: case.search(degree=8, ansatz=20, seconds=10**4, megabytes=10**4),
    }
    timer = threading.Timer(0.7, os.kill, (os.getpid(), signal.SIGINT))
    started = time.monotonic()
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        calls[long]()
    assert time.monotonic() - started < 5
    for _ in range(200):
        if threads_at_work() <= before:
            return
        time.sleep(0.1)
    pytest.fail("the computation goes on")
