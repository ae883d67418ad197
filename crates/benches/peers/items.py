"""Compares the work items of `liouville measure bench` with heyoka's compiled functions, in one run.

    python3 -m venv /tmp/peers && /tmp/peers/bin/pip install -r requirements.txt
    /tmp/peers/bin/python items.py ../../../target/release/liouville [another liouville ...]

heyoka gets AVX-512, fast mathematics, the best of several batch sizes, and each item in several
forms: as a textbook has it, with the derivatives by heyoka, and by formulas found with pencil and
paper. The programs run in turn, round after round, on one thread; times are processor time. Before
that both compute each item, and neighbours of those whose values are zero, at the same states.
"""

import argparse
import json
import os
import statistics
import subprocess
import tempfile
import time

import heyoka as hk
import numpy as np

from rubber import (
    INERTIA, INERTIA_MB_MU, criterion, criterion_by_hand, criterion_of_formula, liouville,
    liouville_by_hand, second_integral, second_integral_by_hand)

BATCHES = (4, 8, 16, 32)
CLOSE = 1e-12
NEIGHBOURS = """title = 'neighbours of the work items'
system = 'rubber-plane'
check-weights = false
[parameters]
m = 1.3
{parameters}
[body]
shape = '{shape}'
[[claim]]
{claim}
expect = 'open'
"""


def forms(item, neighbour=False):
    """Forms of an item as heyoka's expressions, by name."""
    omega, gamma = hk.make_vars("w1", "w2", "w3"), hk.make_vars("y1", "y2", "y3")
    factor = 3 if neighbour else 2
    if item == "W1":
        return {
            "textbook": second_integral(omega, gamma, factor, gradient),
            "by hand": second_integral_by_hand(omega, gamma, factor),
        }
    if item == "W2":
        inertia = INERTIA if neighbour else INERTIA_MB_MU
        return {
            "textbook": liouville(omega, gamma, inertia, gradient),
            "by hand": liouville_by_hand(omega, gamma, inertia),
        }
    return {
        "textbook": criterion(omega, gamma, INERTIA, gradient),
        "rotation of a formula": criterion_of_formula(gamma, INERTIA, gradient),
        "by hand": criterion_by_hand(gamma, INERTIA),
    }


def gradient(values, variables):
    """Derivatives of some values by some variables, as rows."""
    tensors = hk.diff_tensors(values, list(variables))
    return [list(tensors.jacobian[k]) for k in range(len(values))]


def compiled(form, batch):
    names = hk.make_vars("w1", "w2", "w3", "y1", "y2", "y3")
    return hk.cfunc([form], list(names), force_avx512=True, fast_math=True, batch_size=batch)


def bench(program, *arguments):
    run = subprocess.run(
        [program, "measure", "bench", "--engines", "--json", *arguments],
        stdout=subprocess.PIPE, check=True)
    return json.loads(run.stdout)


def values(program, states, *paths):
    """States, results and scales of each item."""
    found = {}
    report = bench(program, "--values", "--rounds", "1", "--states", str(states), *paths)
    for entry in report["values"]:
        found.setdefault(entry["item"], []).append(
            entry["state"] + [entry["value"], entry["scale"]])
    return {name: np.array(rows).T for name, rows in found.items()}


def neighbours(folder):
    """Files of cases like W1 and W2, whose residuals are not zero, as that of W3."""
    inertia = "I = [2.6, 1.2, 1.8]\n"
    cases = {
        "W1": ("R = 3\nc = [0.7, -0.4, 1.1]\n", "ball",
               "integral = '|Ĩ*ω × γ|² − 3*m*R*(γ,c)*(Ĩ*ω,ω)'"),
        "W2": ("B = [1, 2, 3.5]\n", "ellipsoid", "density = '(γ,adj(Ĩ)*γ)'"),
    }
    for name, (parameters, shape, claim) in cases.items():
        path = os.path.join(folder, name + ".toml")
        with open(path, "w", encoding="utf-8") as file:
            file.write(NEIGHBOURS.format(
                parameters=parameters + inertia, shape=shape, claim=claim))
        yield name, path


def check(program, functions):
    """Fails unless both compute the same values."""
    with tempfile.TemporaryDirectory() as folder:
        for name, path in neighbours(folder):
            data = values(program, 1024, path)[path]
            for form, expression in forms(name, neighbour=True).items():
                compare(name + "'s neighbour", form, compiled(expression, 8), data)
            size = np.abs(data[-2]).max()
            print(f"{name}'s neighbour: the same values at 1024 states, the largest is {size:.2g}")
    own = values(program, 1024)
    for (name, form, _), function in functions.items():
        compare(name, form, function, own[name])
    return own


def compare(name, form, function, data):
    found = function(np.ascontiguousarray(data[:-2]))[0]
    error = np.abs(found - data[-2]) / data[-1]
    if not error.max() <= CLOSE:
        raise SystemExit(f"{name}, {form}: values differ by {error.max():.1e} of the scale")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("programs", nargs="+")
    parser.add_argument("--states", type=int, default=16384)
    parser.add_argument("--rounds", type=int, default=15)
    given = parser.parse_args()
    hk.set_nthreads(1)
    functions = {(name, form, batch): compiled(expression, batch)
                 for name in ("W1", "W2", "W3")
                 for form, expression in forms(name).items() for batch in BATCHES}
    own = check(given.programs[0], functions)
    states = {name: np.ascontiguousarray(np.tile(data[:-2], given.states // 1024 + 1)
                                         [:, :given.states]) for name, data in own.items()}
    out = np.empty((1, given.states))
    times = {}
    note = lambda item, who, ns: times.setdefault(item, {}).setdefault(who, []).append(ns)
    for _ in range(given.rounds):
        for program in given.programs:
            report = bench(program, "--states", str(given.states), "--rounds", "9")
            for row in report["rows"]:
                who = (program, row["method"] + ", " + row["domain"])
                note(row["item"], who, row["ns_per_state"])
                note(row["item"], who + ("least",), row["least_ns_per_state"])
        for (name, form, batch), function in functions.items():
            spent = []
            for _ in range(9):
                begun = time.process_time_ns()
                function(states[name], outputs=out)
                spent.append((time.process_time_ns() - begun) / given.states)
            note(name, ("heyoka", form, batch), statistics.median(spent))
            note(name, ("heyoka", form, batch, "least"), min(spent))
    for name, found in times.items():
        show(name, found)


def show(name, found):
    median = {who: statistics.median(all_times) for who, all_times in found.items()}
    peers = [who for who in found if who[0] == "heyoka" and who[-1] != "least"]
    best = min(peers, key=median.get)
    print(f"\n{name}: ns a state, median of rounds and least; ratio to heyoka at its best")
    tuned = {min((p for p in peers if p[1] == form), key=median.get)
             for form in {p[1] for p in peers}}
    for who in found:
        if who[-1] == "least" or (who[0] == "heyoka" and who not in tuned):
            continue
        label = f"heyoka, {who[1]}, batch of {who[2]}" if who[0] == "heyoka" else " ".join(who)
        least = min(found[who + ("least",)])
        print(f"{median[who]:9.2f} {least:9.2f} {median[who] / median[best]:7.3f}  {label}")


if __name__ == "__main__":
    main()
