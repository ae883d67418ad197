"""Compares exponents and charts of figure 8 with heyoka: one thread, in turn.

    python3 -m venv /tmp/peers && /tmp/peers/bin/pip install -r requirements.txt
    /tmp/peers/bin/python chaos.py ../../../target/release/liouville [another liouville ...]

Exponents: motions from many starts to one time, each with two tangent vectors and the integral of
div v, in f64. heyoka integrates the same 19 equations for eight motions in a batch, and is given fresh vectors of length 1 at intervals.
Chart: a plane of starts, each motion with one exponent and the mean divergence, to the accuracy of a
chart. heyoka has 13 equations for each motion, with one tangent vector, or, as liouville, a shadow
beside each motion that is brought back at intervals; its best counts.
It is compiled for AVX-512 with fast mathematics. Its compilation is left out, set-up of liouville is
not. All times are processor time of one thread.
"""

import argparse
import json
import math
import resource
import statistics
import subprocess
import time

import heyoka as hk
import numpy as np

from section import BATCH, CASE, field, start

INTERVAL = 10.0
DISTANCE = 1e-6
# Tolerance of a chart.
ROUGH = 1e-8
VARIABLES = ["w1", "w2", "w3", "y1", "y2", "y3"]


def run_liouville(program, command, options):
    """Processor time of a command, and its data."""
    own = lambda: sum(resource.getrusage(resource.RUSAGE_CHILDREN)[:2])
    begin = own()
    run = subprocess.run(
        [program, "motion", command, CASE, "--json", "--threads", "1", *options],
        stdout=subprocess.PIPE, check=True)
    return own() - begin, json.loads(run.stdout)


class Dual:
    """A value with its derivative, over expressions: shorter than what `hk.diff` makes."""

    def __init__(self, value, slope):
        self.value, self.slope = value, slope

    def __add__(self, other):
        other = lifted(other)
        return Dual(self.value + other.value, self.slope + other.slope)

    def __sub__(self, other):
        other = lifted(other)
        return Dual(self.value - other.value, self.slope - other.slope)

    def __rsub__(self, other):
        return lifted(other) - self

    def __neg__(self):
        return Dual(-self.value, -self.slope)

    def __mul__(self, other):
        other = lifted(other)
        slope = self.slope * other.value + self.value * other.slope
        return Dual(self.value * other.value, slope)

    def __truediv__(self, other):
        ratio = self.value / other.value
        return Dual(ratio, (self.slope - ratio * other.slope) / other.value)

    __radd__, __rmul__ = __add__, __mul__


def lifted(value):
    return value if isinstance(value, Dual) else Dual(value, 0.0)


def along(variables, vector):
    """Derivatives of the rates along a vector."""
    point = [Dual(x, t) for x, t in zip(variables, vector)]
    return [rate.slope for rate in field(point[:3], point[3:])]


def divergence(variables):
    unit = lambda axis: [1.0 if k == axis else 0.0 for k in range(6)]
    return sum(along(variables, unit(axis))[axis] for axis in range(3))


def integrator(vectors, tolerance):
    """A batch of motions with tangent vectors, and the integral of div v."""
    variables = list(hk.make_vars(*VARIABLES))
    rates = field(variables[:3], variables[3:])
    equations = list(zip(variables, rates))
    for number in range(vectors):
        vector = list(hk.make_vars(*(f"t{number}{k}" for k in range(6))))
        equations += zip(vector, along(variables, vector))
    # y' = y × w has no divergence.
    equations.append((hk.make_vars("volume"), divergence(variables)))
    return hk.taylor_adaptive_batch(
        equations, np.ones((len(equations), BATCH)), tol=tolerance, force_avx512=True,
        fast_math=True)


def tangents(state, count, rng):
    """Random vectors of length 1 tangent to |y| = 1."""
    normal = np.concatenate([np.zeros(3), state[3:]])
    found = []
    for _ in range(count):
        vector = rng.standard_normal(6)
        vector -= normal * np.dot(vector, normal) / np.dot(normal, normal)
        found.append(vector / np.linalg.norm(vector))
    return found


def in_batches(states):
    for first in range(0, len(states), BATCH):
        yield [states[min(first + lane, len(states) - 1)] for lane in range(BATCH)]


def with_vectors(ta, states, until, vectors):
    """Largest exponents, by the growth of the first vector; and processor time."""
    rng = np.random.default_rng(1)
    begin = time.process_time()
    exponents = []
    for batch in in_batches(states):
        for lane, state in enumerate(batch):
            own = [np.array(state), *tangents(np.array(state), vectors, rng), [0.0]]
            ta.state[:, lane] = np.concatenate(own)
        ta.set_time([0.0] * BATCH)
        growth = np.zeros(BATCH)
        for stop in np.arange(INTERVAL, until + INTERVAL / 2, INTERVAL):
            ta.propagate_until(float(stop))
            for vector in range(vectors):
                part = slice(6 * (vector + 1), 6 * (vector + 2))
                lengths = np.linalg.norm(ta.state[part], axis=0)
                ta.state[part] /= lengths
                growth += np.log(lengths) if vector == 0 else 0.0
        exponents += list(growth / until)
    return time.process_time() - begin, exponents[:len(states)]


def with_shadows(ta, states, until):
    """Exponents by the distance of a shadow; a batch has half as many motions."""
    rng = np.random.default_rng(1)
    begin = time.process_time()
    half, exponents = BATCH // 2, []
    for first in range(0, len(states), half):
        batch = [np.array(states[min(first + k, len(states) - 1)]) for k in range(half)]
        for lane, state in enumerate(batch):
            ta.state[:6, lane] = state
            ta.state[:6, half + lane] = state + DISTANCE * tangents(state, 1, rng)[0]
        ta.state[6] = 0.0
        ta.set_time([0.0] * BATCH)
        growth = np.zeros(half)
        for stop in np.arange(INTERVAL, until + INTERVAL / 2, INTERVAL):
            ta.propagate_until(float(stop))
            apart = ta.state[:6, half:] - ta.state[:6, :half]
            lengths = np.linalg.norm(apart, axis=0) / DISTANCE
            ta.state[:6, half:] = ta.state[:6, :half] + apart / lengths
            growth += np.log(lengths)
        exponents += list(growth / until)
    return time.process_time() - begin, exponents[:len(states)]


def contest(title, contestants, rounds):
    """Runs all in turn, and prints medians with the ratio to heyoka's best."""
    times = {name: [] for name in contestants}
    for _ in range(rounds):
        for name, run in contestants.items():
            times[name].append(run())
    medians = {name: statistics.median(own) for name, own in times.items()}
    reference = min(own for name, own in medians.items() if name.startswith("heyoka"))
    print(title)
    for name, own in times.items():
        print(f"{medians[name]:8.3f} s, least {min(own):.3f}, ratio {medians[name] / reference:.2f}"
              f"  {name}")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("programs", nargs="+")
    parser.add_argument("--motions", type=int, default=64)
    parser.add_argument("--time", type=float, default=2000.0)
    parser.add_argument("--size", type=int, default=24, help="a chart has SIZE x SIZE motions")
    parser.add_argument("--chart-time", type=float, default=200.0)
    parser.add_argument("--rounds", type=int, default=5)
    given = parser.parse_args()
    golden = (3 - math.sqrt(5)) / 2
    starts = [(2 * math.pi * ((golden * (k + 0.5)) % 1), 1 - 2 * (k + 0.5) / given.motions)
              for k in range(given.motions)]
    asked = [text for l, z in starts for text in ("--start", f"{l!r},{z!r}")]
    exponents = lambda program: run_liouville(
        program, "exponents", ["--one-way", "--time", str(given.time), *asked])
    energy = energy_of_case()
    states = [start(l, z, energy) for l, z in starts]
    _, data = exponents(given.programs[0])
    ours = [row["largest"]["mean"] for row in data["motions"]]
    ta = integrator(2, 1e-15)
    _, theirs = with_vectors(ta, states, given.time, 2)
    apart = statistics.median(abs(a - b) for a, b in zip(ours, theirs))
    contestants = {program: (lambda own=program: exponents(own)[0]) for program in given.programs}
    contestants["heyoka, tangent vectors, batch of eight"] = (
        lambda: with_vectors(ta, states, given.time, 2)[0])
    contest(f"{given.motions} exponents to t = {given.time}; median difference {apart:.4f}",
            contestants, given.rounds)
    chart(given, energy)


def chart(given, energy):
    count = given.size
    x = [0.1 + 6.0 * (k / (count - 1)) for k in range(count)]
    y = [-0.8 + 1.6 * (k / (count - 1)) for k in range(count)]
    states = [start(l, z, energy) for z in y for l in x]
    axes = ["--x", f"l={x[0]}..{x[-1]}", "--y", f"L/G={y[0]}..{y[-1]}",
            "--size", f"{count}x{count}", "--time", str(given.chart_time)]
    plane = lambda program: run_liouville(program, "chart", axes)[0]
    vectors, shadows = integrator(1, ROUGH), integrator(0, ROUGH)
    with_vectors(vectors, states[:BATCH], INTERVAL, 1)
    with_shadows(shadows, states[:BATCH], INTERVAL)
    contestants = {program: (lambda own=program: plane(own)) for program in given.programs}
    contestants["heyoka, a tangent vector, batch of eight"] = (
        lambda: with_vectors(vectors, states, given.chart_time, 1)[0])
    contestants["heyoka, a shadow, batch of eight"] = (
        lambda: with_shadows(shadows, states, given.chart_time)[0])
    contest(f"chart of {len(states)} motions to t = {given.chart_time}", contestants, given.rounds)


def energy_of_case():
    """Energy of the section of the case."""
    with open(CASE, encoding="utf-8") as file:
        section = file.read().split("[section]")[1]
    line = next(line for line in section.splitlines() if line.startswith("energy"))
    return float(line.split("=")[1].strip().strip('"'))


if __name__ == "__main__":
    main()
