"""Compares the section of figure 8 with heyoka: many orbits, one thread, in turn.

    python3 -m venv /tmp/peers && /tmp/peers/bin/pip install -r requirements.txt
    /tmp/peers/bin/python section.py ../../../target/release/liouville [another liouville ...]

heyoka follows eight orbits in a batch, to the times that the section found for the last crossing of
each, and detects the crossings as events, compiled for AVX-512 with fast mathematics. Its compilation
is left out, set-up of liouville is not.
All times are processor time of one thread.
"""

import argparse
import json
import math
import os
import resource
import statistics
import subprocess
import time

import heyoka as hk
import numpy as np

CASE = os.path.join(os.path.dirname(__file__), "../../../cases/figures/fig-8.toml")
I, C, R, G = (1.0, 2.0, 3.0), (1.0, 1.5, 0.5), 3.0, 9.8
BATCH = 8


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def inertia(r):
    square = dot(r, r)
    diagonal = [I[k] + square - r[k] * r[k] for k in range(3)]
    return [[diagonal[i] if i == j else -r[i] * r[j] for j in range(3)] for i in range(3)]


def adjugate(a):
    minor = lambda i, j, k, l: a[i][j] * a[k][l] - a[i][l] * a[k][j]
    upper = {(0, 0): minor(1, 1, 2, 2), (0, 1): minor(0, 2, 2, 1), (0, 2): minor(0, 1, 1, 2),
             (1, 1): minor(0, 0, 2, 2), (1, 2): minor(0, 2, 1, 0), (2, 2): minor(0, 0, 1, 1)}
    return [[upper[min(i, j), max(i, j)] for j in range(3)] for i in range(3)]


def field(omega, gamma):
    """The ball of figure 8: m = 1, r = c + R gamma."""
    r = [C[k] + R * gamma[k] for k in range(3)]
    turned = cross(gamma, omega)
    a = inertia(r)
    momentum = [dot(row, omega) for row in a]
    rates = [R * x for x in turned]
    parts = zip(cross(momentum, omega), cross(r, cross(omega, rates)), cross(gamma, r))
    torque = [x - y + G * z for x, y, z in parts]
    inverse = adjugate(a)
    apply = lambda v: [dot(row, v) for row in inverse]
    along = apply(gamma)
    factor = dot(torque, along) / dot(gamma, along)
    determinant = dot(a[0], inverse[0])
    rest = [torque[k] - factor * gamma[k] for k in range(3)]
    return [x / determinant for x in apply(rest)] + turned


def start(l, z, energy):
    """State over a point of the section g = pi, at an energy."""
    s = math.sqrt(1 - z * z)
    direction = [s * math.sin(l), s * math.cos(l), z]
    gamma = [-z * math.sin(l), -z * math.cos(l), s]
    r = [C[k] + R * gamma[k] for k in range(3)]
    kinetic = dot(direction, [dot(row, direction) for row in inertia(r)]) / 2
    length = math.sqrt((energy - G * (R + dot(C, gamma))) / kinetic)
    return [length * x for x in direction] + gamma


def integrator(counts):
    names = ["w1", "w2", "w3", "y1", "y2", "y3"]
    w1, w2, w3, y1, y2, y3 = hk.make_vars(*names)
    rates = field([w1, w2, w3], [y1, y2, y3])

    def met(ta, when, sign, lane):
        counts[lane] += 1

    event = hk.nt_event_batch(
        y2 * w1 - y1 * w2, callback=met, direction=hk.event_direction.positive)
    return hk.taylor_adaptive_batch(
        list(zip([w1, w2, w3, y1, y2, y3], rates)),
        np.ones((6, BATCH)),
        tol=1e-15,
        force_avx512=True,
        fast_math=True,
        nt_events=[event],
    )


def heyoka(ta, states, ends):
    """Processor time of all orbits, in batches in the order given."""
    begin = time.process_time()
    for first in range(0, len(states), BATCH):
        batch = range(first, min(first + BATCH, len(states)))
        ta.set_time([0.0] * BATCH)
        for lane in range(BATCH):
            ta.state[:, lane] = states[batch[lane % len(batch)]]
        ta.propagate_until([ends[batch[lane % len(batch)]] for lane in range(BATCH)])
    return time.process_time() - begin


def liouville(program, orbits, crossings):
    """Processor time of the section, and its data."""
    own = lambda: sum(resource.getrusage(resource.RUSAGE_CHILDREN)[:2])
    begin = own()
    run = subprocess.run(
        [program, "motion", "section", CASE, "--json", "--threads", "1", "--skip", "0",
         "--crossings", str(crossings), *orbits],
        stdout=subprocess.PIPE, check=True)
    return own() - begin, json.loads(run.stdout)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("programs", nargs="+")
    parser.add_argument("--orbits", type=int, default=200)
    parser.add_argument("--crossings", type=int, default=500)
    parser.add_argument("--rounds", type=int, default=5)
    given = parser.parse_args()
    golden = (3 - math.sqrt(5)) / 2
    starts = [(2 * math.pi * ((golden * (k + 0.5)) % 1), 1 - 2 * (k + 0.5) / given.orbits)
              for k in range(given.orbits)]
    orbits = [text for l, z in starts for text in ("--start", f"{l!r},{z!r}")]
    _, data = liouville(given.programs[0], orbits, given.crossings)
    found = data["orbits"]
    states = [start(*orbit["start"], float(data["energy"])) for orbit in found]
    ends = [orbit["crossings"][-1][2] for orbit in found]
    counts = [0] * BATCH
    ta = integrator(counts)
    heyoka(ta, states[:BATCH], [1.0] * BATCH)
    # The steps of a batch end with its longest orbit: the best order has equal ones together.
    order = sorted(range(len(ends)), key=ends.__getitem__)
    best = [states[k] for k in order], [ends[k] for k in order]
    times = {}
    note = lambda name, seconds: times.setdefault(name, []).append(seconds)
    for _ in range(given.rounds):
        for program in given.programs:
            note(program, liouville(program, orbits, given.crossings)[0])
        counts[:] = [0] * BATCH
        note("heyoka, batch of eight", heyoka(ta, states, ends))
        met = sum(counts)
        note("heyoka, orbits sorted by their ends", heyoka(ta, *best))
    print(f"{len(states)} orbits, {given.crossings} crossings; heyoka met {met}")
    reference = statistics.median(times["heyoka, batch of eight"])
    for name, all_times in times.items():
        median = statistics.median(all_times)
        print(f"{median:8.3f} s, least {min(all_times):.3f}, ratio {median / reference:.2f}  {name}")


if __name__ == "__main__":
    main()
