"""Tables of bodies."""

import json

import numpy as np
import pandas
import pyarrow
import pytest

import liouville as lv

SPRING = """
title = "spring"
[parameters]
k = "0.5..2"
d = "0..1"
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
name = "circle"
integral = "v² + x²"
"""


def test_each_row_is_a_body(tmp_path, command):
    table = [{"k": 1, "d": 0.5}, {"k": "3/2", "d": 0}, {"k": None, "d": 1}, {"k": 2}]
    bodies = lv.check(SPRING, settings=table)
    assert not bodies and [bool(body) for body in bodies] == [True, False, False, False]
    assert bodies[0].verdicts == {"energy": "proved", "circle": "proved"}
    assert bodies[1]["circle"] == "refuted" == lv.check(lv.read(SPRING, k="3/2"))["circle"].verdict
    assert bodies[2].errors[0]["message"] == "`k` has no value" and bodies[2].line == 4
    assert bodies[3].errors[0]["message"] == "`d` has no value"
    frame = bodies.to_pandas()
    assert list(frame["claim circle"])[:2] == ["proved", "refuted"]
    assert frame["disagreements"].sum() == 1 and len(bodies.to_arrow()) == 4
    assert "2 wrong rows" in repr(bodies) and "<table" in bodies._repr_html_()
    case, path = tmp_path / "spring.toml", tmp_path / "bodies.csv"
    case.write_text(SPRING, encoding="utf-8")
    path.write_text("k,d\n1,0.5\n3/2,0\n,1\n2,\n", encoding="utf-8")
    told = json.loads(command("check", str(case), "--settings", str(path), "--json", code=2))
    assert lv.check(case, settings=path).outcome == told
    assert lv.check(case, settings=str(path), trust="float").summary["confirmed"] > 0
    whole = pandas.DataFrame({"k": [1, 1.5], "d": [0.5, 0]})
    assert lv.check(SPRING, settings=whole)[1]["circle"] == "refuted"
    with pytest.raises(ValueError, match="there is no parameter `q`"):
        lv.check(SPRING, settings=[{"q": 1}])
    with pytest.raises(ValueError, match="empty"):
        lv.check(SPRING, settings=[])
    with pytest.raises(ValueError, match="has a column"):
        lv.check(lv.read(SPRING, k=1), settings=[{"k": 1}])
    with pytest.raises(TypeError, match="one a body"):
        lv.check(SPRING, settings={"k": 1})
    with pytest.raises(ValueError, match="mutants"):
        lv.check(SPRING, settings=table, mutants=True)
    with pytest.raises(ValueError, match="give settings"):
        lv.check(SPRING, parts=2)


class Polars:
    """A frame with the methods of polars: `to_dict` is of columns."""

    def to_dict(self, *, as_series=True):
        return {"k": [1, 1.5], "d": [0, 0]}

    def to_dicts(self):
        return [{"k": 1, "d": 0}, {"k": 1.5, "d": 0}]


def test_tables_of_any_library():
    expected = [{"k": "1", "d": "0"}, {"k": "1.5", "d": "0"}]
    arrow = pyarrow.Table.from_pylist([{"k": 1.0, "d": 0}, {"k": 1.5, "d": 0}])
    assert [body.settings for body in lv.check(SPRING, settings=Polars())] == expected
    assert [body["circle"] for body in lv.check(SPRING, settings=arrow)] == ["proved", "refuted"]
    for wrong in (pandas.Series([1, 2]), 7, [1, 2], {"k": 1}):
        with pytest.raises(TypeError, match="one a body"):
            lv.check(SPRING, settings=wrong)


def test_values_that_are_no_numbers_are_mistakes_of_their_rows():
    nan, infinite = float("nan"), float("inf")
    values = [np.float32("nan"), np.float64("nan"), nan, pandas.NA, None]
    table = [{"k": k, "d": 0} for k in [*values, infinite, [1, nan], 1]]
    bodies = lv.check(SPRING, settings=table)
    assert [bool(body) for body in bodies] == [False] * 7 + [True]
    for body in bodies[:5]:
        assert body.errors[0]["message"] == "`k` has no value"
    frame = pandas.DataFrame({"k": np.array([1, np.nan], dtype=np.float32), "d": [0, 0]})
    assert [bool(body) for body in lv.check(SPRING, settings=frame)] == [True, False]


def test_reports_on_bodies(tmp_path, command):
    first = {"m": 1, "c": [0, 0, "1/3"], "I": [1, 1, 2]}
    table = [first, first | {"m": "x"}]
    case = "plane/unbalanced-ball"
    bodies = lv.report(case, settings=table)
    assert bodies[0].invariants["class"] and bodies[0].invariants["integrals"] is not None
    assert bodies[1].errors and not bodies[1].invariants
    frame = bodies.to_pandas()
    assert isinstance(frame["class"][0], str) and "densities" in frame and len(frame) == 2
    path = tmp_path / "bodies.csv"
    values = '"[0, 0, 1/3]","[1, 1, 2]"'
    path.write_text(f"m,c,I\n1,{values}\nx,{values}\n", encoding="utf-8")
    told = json.loads(command("report", case, "--settings", str(path), "--json", code=2))
    assert bodies.outcome == told
    assert lv.report(case, settings=table, parts=2).outcome == told
    with pytest.raises(ValueError, match="no format"):
        lv.report(case, "html", settings=table)
    with pytest.raises(ValueError, match="give settings"):
        lv.report(case, parts=2)
    assert "<html" in lv.report(case, "html")


def test_bodies_in_parts(tmp_path, command):
    table = [{"k": f"{k}/7", "d": 0} for k in range(1, 30)] + [{"k": "x", "d": 1}]
    whole = lv.check(SPRING, settings=table)
    assert whole.outcome == lv.check(SPRING, settings=table, parts=7, threads=1).outcome
    assert whole.outcome == lv.check(SPRING, settings=table, parts=4, out=tmp_path).outcome
    files = sorted(tmp_path.iterdir())
    assert len(files) == 4
    again = [path.stat().st_mtime_ns for path in files]
    files[1].unlink()
    assert whole.outcome == lv.check(SPRING, settings=table, parts=4, out=tmp_path).outcome
    assert [path.stat().st_mtime_ns for path in files[2:]] == again[2:], "the others are kept"
    told = json.loads(command("merge", str(tmp_path), "--", "--json", code=2))
    assert told == whole.outcome


def test_bodies_on_a_cluster():
    distributed = pytest.importorskip("distributed")
    table = [{"k": f"{k}/7", "d": 0} for k in range(1, 30)]
    with (
        distributed.LocalCluster(
            n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None
        ) as cluster,
        distributed.Client(cluster) as client,
    ):
        found = lv.check(SPRING, settings=table, client=client, parts=5)
    assert found.outcome == lv.check(SPRING, settings=table).outcome
