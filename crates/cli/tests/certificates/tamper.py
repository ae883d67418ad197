"""Tampers with certificates, and counts those that the checker refuses.

Usage: tamper.py FOLDER_OF_CHECKER FOLDER_OF_CERTIFICATES. A certificate is changed as it is, and
changed with its evidence made anew, as by one who knows the format. A change of a program may leave
a true statement; it is known to be false if exact numbers show a value that is not 0.
"""

import copy
import glob
import hashlib
import json
import random
import sys
from fractions import Fraction

sys.path.insert(0, sys.argv[1])
import check as checker  # noqa: E402

LARGEST = 400  # steps
random.seed(7)


def refuses(certificate):
    try:
        checker.check(certificate)
        return False
    except checker.Refused:
        return True


def sealed(statement):
    """A certificate with evidence that fits the statement in all but the values at points."""
    digest, degrees, heights, errors = checker.digest_of(statement), [], [], []
    for program in statement["programs"]:
        steps, zero = checker.read_program(program)
        degree, height = checker.bounds(steps, zero)
        degrees.append(degree)
        heights.append(height)
        errors.append(checker.error_log2(degree, height))
    count = len(errors)
    error = max(errors) + (count - 1).bit_length()
    evidence = {"digest": digest, "primes": checker.primes_of(digest), "points": 8 * count,
                "degrees": degrees, "heights": heights, "error_log2": error}
    return {"format": "liouville certificate 1", "statement": statement, "evidence": evidence}


def is_false(steps, zero, inputs):
    """Whether some value is not 0 at a rational point, in exact arithmetic without roots."""
    if any(name == "root" for name, *_ in steps):
        return False
    for _ in range(3):
        point = [Fraction(random.randint(-9, 9), random.randint(1, 5)) for _ in range(inputs)]
        values = []
        try:
            for name, a, *b in steps:
                values.append({
                    "constant": lambda: a, "input": lambda: point[a],
                    "negative": lambda: -values[a], "reciprocal": lambda: 1 / values[a],
                    "sum": lambda: values[a] + values[b[0]],
                    "difference": lambda: values[a] - values[b[0]],
                    "product": lambda: values[a] * values[b[0]],
                    "power": lambda: values[a] ** b[0]}[name]())
        except ZeroDivisionError:
            continue
        if any(values[place] != 0 for place in zero):
            return True
    return False


def as_they_are(certificate):
    """Changes of single values, with the evidence left as it is or changed alone."""
    def change(path, new):
        other = copy.deepcopy(certificate)
        at = other
        for key in path[:-1]:
            at = at[key]
        old = at[path[-1]]
        at[path[-1]] = new(old) if callable(new) else new
        return other

    claim, case = ("statement", "claim"), ("statement", "case")
    program = ("statement", "programs", 0)
    yield "verdict", change((*claim, "verdict"), "refuted")
    yield "claim", change((*claim, "name"), lambda name: name + " 2")
    yield "claim", change((*claim, "formula"), lambda formula: f"2*({formula})")
    yield "claim", change((*claim, "where"), "elsewhere")
    yield "claim", change((*claim, "kind"), "another")
    yield "case", change((*case, "text"), lambda text: text + "\n")
    yield "case", change((*case, "sha256"), "0" * 64)
    yield "case", change((*case, "path"), "another.toml")
    yield "format", change(("format",), "liouville certificate 2")
    yield "settings", change(("statement", "settings"), ["m=1"])
    yield "inputs", change((*program, "inputs"), lambda count: count + 1)
    yield "zero", change((*program, "zero"), {"residual": []})
    yield "zero", change((*program, "zero"), {})
    yield "programs", change(("statement", "programs"), [])
    yield "degree", change(("evidence", "degrees", 0), lambda degree: degree - 1)
    yield "degree", change(("evidence", "degrees", 0), lambda degree: degree + 1)
    yield "height", change(("evidence", "heights", 0), lambda height: height - 1)
    yield "error", change(("evidence", "error_log2"), lambda error: error - 1)
    yield "points", change(("evidence", "points"), lambda points: points + 8)
    yield "primes", change(("evidence", "primes", 0), (1 << 61) - 1)
    yield "primes", change(("evidence", "primes"), lambda primes: primes[:3])
    yield "digest", change(("evidence", "digest"), "f" * 64)
    steps = certificate["statement"]["programs"][0]["steps"]
    for place in random.sample(range(len(steps)), min(4, len(steps))):
        yield "step", change((*program, "steps", place), ["constant", "12345/7"])


SWAPPED = {"sum": "difference", "difference": "sum", "product": "sum"}


def made_anew(certificate):
    """False statements, with the evidence that belongs to them; None for one that may be true."""
    def other(edit):
        statement = copy.deepcopy(certificate["statement"])
        edit(statement)
        return sealed(statement)

    def add_to_residual(*step):
        def edit(statement):
            program = statement["programs"][0]
            last = len(program["steps"])
            place = program["zero"]["residual"][0]
            program["steps"] += [list(step), ["sum", place, last]]
            program["zero"]["residual"][0] = last + 1
        return edit

    yield "residual", other(add_to_residual("constant", "1")), True
    yield "residual", other(add_to_residual("constant", "1/1000000007")), True
    yield "verdict", other(lambda s: s["claim"].update(verdict="confirmed")), True
    if certificate["statement"]["programs"][0]["inputs"]:
        yield "residual", other(add_to_residual("input", 0)), True
    steps = certificate["statement"]["programs"][0]["steps"]
    for place in random.sample(range(len(steps)), min(6, len(steps))):
        name, *rest = steps[place]
        if name == "constant":
            new = ["constant", str(Fraction(rest[0]) + 1)]
        elif name == "input":
            new = ["constant", "3"]
        elif name in SWAPPED:
            new = [SWAPPED[name], *rest]
        else:
            continue
        changed = other(lambda s: s["programs"][0]["steps"].__setitem__(place, new))
        program = changed["statement"]["programs"][0]
        yield "step", changed, is_false(*checker.read_program(program), program["inputs"])
    if checker.from_text(certificate["statement"])[0]:
        def another_claim(statement):
            # The file says it too, so that only its own derivatives show the difference.
            old, case = statement["claim"]["formula"], statement["case"]
            variable = next(iter(statement["programs"][0]["state"]))
            new = f"({old})*(1 + {variable}) + {variable}*{variable}"
            head, mark, claims = case["text"].partition("[[claim]]")
            case["text"] = head + mark + claims.replace(f'"{old}"', f'"{new}"')
            case["sha256"] = hashlib.sha256(case["text"].encode()).hexdigest()
            statement["claim"]["formula"] = new

        if certificate["statement"]["claim"]["kind"] in ("integral", "density"):
            changed = other(another_claim)
            derived, residual, inputs = checker.derived(changed["statement"])
            known = is_false(derived, [residual], inputs)
            yield "formula of the case and the claim", changed, known
        yield "formula", other(lambda s: s["claim"].update(formula="1 + 1 + 1")), True


def main():
    files = sorted(glob.glob(sys.argv[2] + "/*.json"))[::3]
    tampered, open_, passed = {}, 0, []
    used = 0
    for name in files:
        with open(name, encoding="utf-8") as file:
            certificate = json.load(file)
        if sum(len(p["steps"]) for p in certificate["statement"]["programs"]) > LARGEST:
            continue
        used += 1
        for what, other in as_they_are(certificate):
            tampered[what] = tampered.get(what, 0) + 1
            if not refuses(other):
                passed.append(f"{name}: {what} as it is")
        for what, other, known_false in made_anew(certificate):
            if not known_false:
                open_ += 1
                continue
            key = what + ", evidence made anew"
            tampered[key] = tampered.get(key, 0) + 1
            if not refuses(other):
                passed.append(f"{name}: {key}")
    for what, count in sorted(tampered.items()):
        print(f"{count:6} {what}")
    print("\n".join(passed))
    print(f"{open_} changes may leave a true statement, and are not counted")
    print(f"{used} certificates, {sum(tampered.values())} tampered, {len(passed)} not refused")
    return 1 if passed else 0


if __name__ == "__main__":
    sys.exit(main())
