"""Compares a single motion with heyoka: the unbalanced ball to t = 1000 from many starts, in turn.

    python3 -m venv /tmp/peers && /tmp/peers/bin/pip install -r requirements.txt
    /tmp/peers/bin/python orbit.py ../../../target/release/liouville [another liouville ...]

heyoka's compilation is left out; of liouville the whole process counts, with reading the case and
generating code. Times are processor time of one thread. Starts differ in speed, and so in steps: the
times of all starts are added up, of each the median and the least of its rounds. The drift of the energy and of F2 is the
largest of a thousand times, divided by the value at the start; to find it heyoka runs once more.
"""

import argparse
import json
import os
import resource
import statistics
import subprocess
import tempfile
import time

import heyoka as hk
import numpy as np

from rubber import CENTRE, INERTIA, MASS, RADIUS, ball, cross, dot, field, image, inertia_at

CASE = """title = 'unbalanced ball'
system = 'rubber-plane'
[parameters]
m = 1.3
R = 3
c = [0.7, -0.4, 1.1]
I = [2.6, 1.2, 1.8]
[body]
shape = 'ball'
[[claim]]
name = 'F2'
integral = '|Ĩ*ω × γ|² − 2*m*R*(γ,c)*(Ĩ*ω,ω)'
"""
NAMES = ("energy", "F2")
GRID = 1000


def integrals(state):
    omega, gamma = state[:3], state[3:]
    momentum = image(inertia_at(ball(gamma), INERTIA), omega)
    turned, energy = cross(momentum, gamma), dot(momentum, omega)
    second = dot(turned, turned) - 2 * MASS * RADIUS * dot(gamma, CENTRE) * energy
    return np.array([energy, second])


def equations():
    names = hk.make_vars("w1", "w2", "w3", "y1", "y2", "y3")
    return list(zip(names, field(names[:3], names[3:], "ball", INERTIA)))


def integrators():
    """Integrators of one orbit, by name."""
    build = lambda **options: hk.taylor_adaptive(equations(), [1.0] * 6, tol=1e-15, **options)
    return {
        "heyoka": build(),
        "heyoka, AVX-512": build(force_avx512=True),
        "heyoka, AVX-512, fast mathematics": build(force_avx512=True, fast_math=True),
        "heyoka, AVX-512, compensated sums": build(force_avx512=True, high_accuracy=True),
    }


def begin(integrator, start):
    integrator.time = 0.0
    integrator.state[:] = start


def heyoka(integrator, start, end):
    begin(integrator, start)
    begun = time.process_time()
    integrator.propagate_until(end)
    return time.process_time() - begun


def drift(integrator, start, end):
    begin(integrator, start)
    states = integrator.propagate_grid(np.linspace(0.0, end, GRID + 1))[-1]
    first = integrals(np.array(start))
    return [np.abs(value / one - 1).max() for value, one in zip(integrals(states.T), first)]


def liouville(program, path, index, end):
    """Processor time of an orbit, and its data."""
    own = lambda: sum(resource.getrusage(resource.RUSAGE_CHILDREN)[:2])
    begun = own()
    run = subprocess.run(
        [program, "motion", "orbit", path, "--json", "--time", repr(end), "--index", str(index)],
        stdout=subprocess.PIPE, check=True)
    return own() - begun, json.loads(run.stdout)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("programs", nargs="+")
    parser.add_argument("--starts", type=int, default=24)
    parser.add_argument("--time", type=float, default=1000.0)
    parser.add_argument("--rounds", type=int, default=5)
    given = parser.parse_args()
    peers, times, drifts = integrators(), {}, {}
    note = lambda who, index, value: times.setdefault(who, {}).setdefault(index, []).append(value)
    farthest = 0.0
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "ball.toml")
        with open(path, "w", encoding="utf-8") as file:
            file.write(CASE)
        for index in range(given.starts):
            # Both follow the same motion: they meet at t = 10, before rounding has grown.
            data = liouville(given.programs[0], path, index, 10.0)[1]
            start = [float(x) for part in data["start"].values() for x in part]
            end = [float(x) for part in data["end"].values() for x in part]
            for name, peer in peers.items():
                heyoka(peer, start, 10.0)
                farthest = max(farthest, np.abs(peer.state - end).max())
                drifts.setdefault(name, []).append(drift(peer, start, given.time))
            for program in given.programs:
                data = liouville(program, path, index, given.time)[1]
                found = {one["name"]: one["drift"] for one in data["followed"]}
                drifts.setdefault(program, []).append([found[name] for name in NAMES])
            for _ in range(given.rounds):
                for program in given.programs:
                    note(program, index, liouville(program, path, index, given.time)[0])
                for name, peer in peers.items():
                    note(name, index, heyoka(peer, start, given.time))
    if farthest > 1e-11:
        raise SystemExit(f"the motions are {farthest:.1e} apart at t = 10")
    print(f"{given.starts} starts to t = {given.time:g}; at t = 10 all within {farthest:.1e}")
    print("seconds for all, sum of medians and of the least; ratio to heyoka's best; worst drift")
    total = {name: [sum(map(how, rounds.values())) for how in (statistics.median, min)]
             for name, rounds in times.items()}
    best = min(total[name][0] for name in peers)
    for name, (median, least) in total.items():
        worst = np.max(drifts[name], axis=0)
        shown = ", ".join(f"{who} {value:.1e}" for who, value in zip(NAMES, worst))
        print(f"{median:8.3f} {least:8.3f} {median / best:7.3f}  {name}: {shown}")


if __name__ == "__main__":
    main()
