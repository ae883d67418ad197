"""Jobs in parts: the same bits by any number of parts and workers, also where some are lost."""

import os
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import numpy as np
import pytest

import liouville as lv

BODY = "figures/fig-8"
PLANE = {"x": "c1=0..1.6", "y": ("c2", 0, 2), "size": (16, 10), "time": 20, "start": (1.6, -0.3)}
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
[[claim]]
name = "divergence"
divergence = "−41/3"
"""


def same(one: lv.Chart, other: lv.Chart) -> bool:
    """Whether two charts are equal bit for bit."""
    fields = ("x", "y", "character", "exponent", "error", "divergence")
    arrays = all(getattr(one, k).tobytes() == getattr(other, k).tobytes() for k in fields)
    return arrays and one.names == other.names and one.problems == other.problems


def parts(folder: Path) -> list[Path]:
    return sorted(path for path in folder.glob("*-of-*") if not path.name.startswith("."))


def wait_for(parts_of: Path, count: int, seconds: float = 120) -> int:
    """Waits until a folder has this number of parts; returns how many it has."""
    end = time.monotonic() + seconds
    while len(parts(parts_of)) < count and time.monotonic() < end:
        time.sleep(0.01)
    return len(parts(parts_of))


@pytest.fixture(scope="module")
def whole() -> lv.Chart:
    return lv.chart(BODY, **PLANE)


def test_charts_in_parts_are_those_of_one_run(tmp_path, whole, command):
    assert same(lv.chart(BODY, **PLANE, parts=7, threads=2), whole)
    assert same(lv.chart(BODY, **PLANE, out=tmp_path / "parts"), whole), "20 parts of 8 motions"
    files = parts(tmp_path / "parts")
    assert len(files) == 20
    times = [path.stat().st_mtime_ns for path in files]
    files[3].unlink()
    files[4].write_text(files[4].read_text(encoding="utf-8")[:-1], encoding="utf-8")
    assert same(lv.chart(BODY, **PLANE, out=tmp_path / "parts"), whole)
    again = [path.stat().st_mtime_ns for path in files]
    assert [k for k in range(20) if times[k] != again[k]] == [3, 4], "the others are kept"
    # The command merges what Python has computed.
    arguments = ["--x", "c1=0..1.6", "--y", "c2=0..2", "--size", "16x10", "--time", "20",
                 "--start", "1.6,-0.3"]  # fmt: skip
    command("motion", "chart", BODY, *arguments, "--out", str(tmp_path / "whole.csv"))
    command("merge", str(tmp_path / "parts"), "--out", str(tmp_path / "merged.csv"))
    assert (tmp_path / "merged.csv").read_bytes() == (tmp_path / "whole.csv").read_bytes()


def test_other_files_under_the_name_of_a_part_do_not_count(tmp_path, whole):
    chart = {"parts": 4, "out": tmp_path}
    assert same(lv.chart(BODY, **PLANE, **chart), whole)
    files = parts(tmp_path)
    texts = [path.read_bytes() for path in files]
    files[0].write_bytes(texts[1])
    files[2].write_bytes(b"\xff\xfe")
    lv.chart(BODY, **(PLANE | {"time": 10}), parts=4, out=tmp_path / "others")
    files[3].write_bytes(parts(tmp_path / "others")[3].read_bytes())
    assert same(lv.chart(BODY, **PLANE, **chart), whole)
    assert [path.read_bytes() for path in files] == texts
    files[0].unlink()
    files[0].mkdir()
    with pytest.raises(OSError, match="directory"):
        lv.chart(BODY, **PLANE, **chart)


def test_sections_and_exponents_in_parts():
    case = lv.parse(FLOW)
    starts = [[1, 2, 20], [1, 1, 21], [-1, 2, 22], [2, 2, 22], [0.1, 2, 22]]
    own = case.section("z = 27", starts=starts, crossings=20)
    assert own.tobytes() == case.section("z = 27", starts=starts, crossings=20, parts=3).tobytes()
    drawn = case.section("z = 27", orbits=5, crossings=20)
    assert drawn.tobytes() == case.section("z = 27", orbits=5, crossings=20, parts=2).tobytes()
    body = lv.read(BODY)
    own = body.section(orbits=9, crossings=10)
    assert own.tobytes() == body.section(orbits=9, crossings=10, parts=4).tobytes()
    for options in ({"time": 20, "both_ways": False}, {"time": 10, "spectrum": True}):
        one = case.exponents(starts, **options)
        assert one.outcome == case.exponents(starts, **options, parts=2).outcome, "all digits"
    fixed = lv.read("classical/planar/henon-heiles-hamiltonian", ε="1/2")
    named = [dict.fromkeys(fixed.state, 0.1)]
    one = fixed.exponents(named, time=10)
    assert one.outcome == fixed.exponents(named, time=10, parts=1).outcome
    starts = [[3.4, 0.3], [1, 1.5], [3.3, 0.2]]
    one = body.exponents(starts, time=10)
    assert "problem" in one[1] and one.outcome == body.exponents(starts, time=10, parts=3).outcome
    with pytest.raises(ValueError, match="drawn"):
        case.exponents(parts=2)
    with pytest.raises(ValueError, match="starts or orbits"):
        case.section("z = 27", starts=starts, orbits=3, parts=2)


def test_sweeps():
    found = lv.sweep(lv.parse(FLOW), states=100_000)
    assert found[0]["defined"] == 100_000 and found[0]["largest"] < 1e-12
    assert found.outcome == lv.sweep(lv.parse(FLOW), states=100_000, parts=7).outcome
    assert len(found.to_pandas()) == 1
    with pytest.raises(ValueError, match="like `nothing`"):
        lv.sweep(lv.parse(FLOW), "nothing")


@pytest.fixture
def cluster():
    distributed = pytest.importorskip("distributed")
    with distributed.LocalCluster(
        n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None
    ) as cluster:
        yield cluster


def test_a_cluster_without_a_shared_folder(cluster, whole):
    from distributed import Client

    with Client(cluster) as client:
        assert same(lv.chart(BODY, **PLANE, client=client, parts=10), whole)
        case = lv.parse(FLOW)
        starts = np.array([[1, 2, 20], [1, 1, 21], [-1, 2, 22]])
        options = {"time": 20, "both_ways": False}
        own = case.exponents(starts, **options, client=client, parts=3)
        assert own.outcome == case.exponents(starts, **options).outcome
        states = case.sweep(states=100_000, client=client, parts=4)
        assert states.outcome == case.sweep(states=100_000).outcome


def test_tasks_refer_to_the_case_and_do_not_hold_it(cluster, whole, monkeypatch):
    from distributed import Client, Future

    from liouville.parts import Recipe

    with Client(cluster) as client:
        given = []
        submit = client.submit

        def record(function, *arguments, **options):
            given.append(arguments)
            return submit(function, *arguments, **options)

        monkeypatch.setattr(client, "submit", record)
        assert same(lv.chart(BODY, **PLANE, client=client, parts=10), whole)
    holding = [one for one in given if any(isinstance(own, Recipe) for own in one)]
    referring = [one for one in given if any(isinstance(own, Future) for own in one)]
    assert (len(holding), len(referring)) == (1, 10)


LONG = PLANE | {"time": 400}
"""Motions so long that a worker is lost before all parts are done."""


def test_a_worker_is_lost(cluster, tmp_path):
    from distributed import Client

    with Client(cluster) as client:
        pids = client.run(os.getpid)
        killed = []

        def kill() -> None:
            done = wait_for(tmp_path, 3)
            pid = next(iter(pids.values()))
            os.kill(pid, signal.SIGKILL)
            killed.append((pid, done, len(parts(tmp_path))))

        killer = threading.Thread(target=kill)
        killer.start()
        chart = lv.chart(BODY, **LONG, client=client, parts=40, out=tmp_path)
        killer.join()
        left = client.run(os.getpid).values()
    ((pid, done, after),) = killed
    assert 3 <= done <= after < 40, "a worker was lost on the way"
    assert pid not in left
    assert len(parts(tmp_path)) == 40
    assert same(chart, lv.chart(BODY, **LONG))


RUN = """
import sys
import liouville as lv
from distributed import Client, LocalCluster

if __name__ == "__main__":
    with LocalCluster(2, threads_per_worker=1, dashboard_address=None) as cluster:
        with Client(cluster) as client:
            plane = {plane}
            lv.chart("{body}", **plane, client=client, parts=40, out=sys.argv[1])
"""


def test_a_worker_the_client_and_the_scheduler_are_lost(whole, tmp_path):
    pytest.importorskip("distributed")
    script, folder = tmp_path / "run.py", tmp_path / "parts"
    script.write_text(RUN.format(plane=PLANE, body=BODY), encoding="utf-8")
    folder.mkdir()

    def start() -> subprocess.Popen:
        return subprocess.Popen(
            [sys.executable, str(script), str(folder)],
            stderr=subprocess.DEVNULL,
            start_new_session=True,
        )

    def end(run: subprocess.Popen) -> None:
        """Ends what is left of a run: workers outlive their scheduler for some time."""
        try:
            os.killpg(run.pid, signal.SIGKILL)
        except ProcessLookupError:
            pass
        run.wait()

    first = start()
    try:
        assert wait_for(folder, 3) >= 3
        os.kill(workers(first.pid)[0], signal.SIGKILL)
        done = wait_for(folder, 6)
        # The scheduler runs in the process of the client.
        first.kill()
        first.wait()
    finally:
        end(first)
    kept = {path: path.stat().st_mtime_ns for path in parts(folder)}
    assert 6 <= done <= len(kept) < 40, "killed on the way"
    second = start()
    try:
        assert second.wait(timeout=240) == 0
    finally:
        end(second)
    assert len(parts(folder)) == 40
    assert all(path.stat().st_mtime_ns == time for path, time in kept.items()), (
        "what is there is kept"
    )
    assert same(lv.chart(BODY, **PLANE, parts=40, out=folder), whole)


def workers(pid: int) -> list[int]:
    """Processes of the workers that a client has started."""
    import psutil

    children = psutil.Process(pid).children(recursive=True)
    return [own.pid for own in children if any("spawn_main" in word for word in own.cmdline())]
