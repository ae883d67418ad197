"""Forges certificates as one who knows the format, and shows what the checkers say to them.

Usage: forge.py FOLDER_OF_CHECKERS FOLDER_OF_CERTIFICATES [FILE_OF_AN_ORBIT]. Every digest is made
anew. A forgery is refused with its place, or, where the program of a certificate is sound and only
the text of the case is not what it seems, it does not pass as `text`.
"""

import copy
import functools
import glob
import hashlib
import io
import json
import sys

import tamper  # noqa: F401, puts the folder of the checkers on the path
import check as checker
import orbit

FAILED = []


def answer(check, certificate):
    """What a checker says of a certificate, which is JSON or a text."""
    text = certificate if isinstance(certificate, str) else json.dumps(certificate)
    try:
        return check(checker.load(io.StringIO(text)))
    except (checker.Refused, checker.Unread) as problem:
        return str(problem)
    except ValueError as problem:
        return f"not JSON: {problem}"


def expect(what, found, place):
    is_right = isinstance(found, str) and place in found
    print(f"{'as it should be' if is_right else 'WRONG'}: {what}: {found}")
    if not is_right:
        FAILED.append(what)


def with_(value, path, new):
    """A copy in which the value at a path is another; a list as the last key appends."""
    other = copy.deepcopy(value)
    at = other
    for key in path[:-1]:
        at = at[key]
    at[path[-1]] = new(at[path[-1]]) if callable(new) else new
    return other


# --- proofs by points ---------------------------------------------------------------------------------

def resealed(certificate):
    """The certificate with the evidence that its statement leads to, if there is any."""
    try:
        evidence = checker.evidence_of(certificate["statement"])
    except Exception:  # what is refused without evidence is refused with any
        evidence = dict(certificate["evidence"], digest=checker.digest_of(certificate["statement"]))
    return dict(certificate, evidence=evidence)


def malformed(good):
    claim, case, program = ("statement", "claim"), ("statement", "case"), ("statement", "programs", 0)
    for path in [(), ("statement",), claim, case, program, (*program, "zero"), ("evidence",)]:
        place = ".".join(str(key) for key in path).replace(".0", "[0]") or "the certificate"
        yield f"unknown key in {place}", (*path, "trust-me"), 1, place + " has the unknown key"
    for path in [(*claim, "where"), (*program, "fixed"), (*program, "zero", "residual"),
                 ("evidence", "primes")]:
        yield f"no {path[-1]}", path, KeyError, f"has no key `{path[-1]}`"
    yield "where", (*claim, "where"), "level", "zero.level is missing"
    yield "expect", (*claim, "expect"), "anything", "statement.claim.expect"
    yield "verdict", (*claim, "verdict"), True, "statement.claim.verdict is not a text"
    yield "inputs as a float", (*program, "inputs"), 2.0, "is not whole"
    yield "inputs as true", (*program, "inputs"), True, "inputs is not a number from 0"
    yield "inputs below 0", (*program, "inputs"), -1, "inputs is not a number from 0"
    yield "huge inputs", (*program, "inputs"), 10**9, "inputs is too large"
    yield "no steps", (*program, "steps"), [], "names a step that does not exist"
    yield "no residual", (*program, "zero", "residual"), [], "zero.residual is empty"
    yield "no programs", ("statement", "programs"), [], "statement.programs is empty"
    yield "programs as a table", ("statement", "programs"), {}, "statement.programs is not a list"
    yield "a state that is not there", (*program, "state", "x"), [10**6], "state.x names a step"
    for step, place in [(["constant", "1e3"], "not a number"), (["constant", "0.1"], "not a number"),
                        (["constant", 1], "not a number"), (["constant", "1/0"], "not a number"),
                        (["constant", "٣"], "not a number"), (["constant", "1_0"], "not a number"),
                        (["constant", "1" * 5000], "malformed"), ([], "is not a step"),
                        ("sum", "is not a step"), (["sum", 0], "is not a step"),
                        ([["sum"], 0, 0], "is not a step"), (["input", -1], "does not exist"),
                        (["power", 0, 0.5], "is not whole"), (["power", 0, True], "exponent"),
                        (["power", 0, 10**30], "exponent"), (["power", 0, -(10**30)], "exponent"),
                        (["power", 0, "2"], "exponent"), (["sum", 0, 10**6], "does not come before"),
                        (["sum", -1, 0], "does not come before"), (["modulus", 0], "is not a step")]:
        yield f"step {str(step)[:40]}", (*program, "steps"), lambda all_: [*all_, step], place
    for number in (float("nan"), float("inf"), 1e400):
        yield f"height {number}", ("evidence", "heights", 0), number, "is not whole"
    yield "a height as a text", ("evidence", "heights", 0), "1", "heights[0] is not a number"
    yield "points as true", ("evidence", "points"), True, "evidence.points is not a number"
    yield "few primes", ("evidence", "primes"), lambda primes: primes[:3], "evidence.primes"
    yield "no primes", ("evidence", "primes"), [], "evidence.primes"
    yield "one prime", ("evidence", "primes"), lambda primes: primes[:1] * 4, "evidence.primes"


def of_forms(good):
    for what, path, new, place in malformed(good):
        if new is KeyError:
            other = copy.deepcopy(good)
            at = other
            for key in path[:-1]:
                at = at[key]
            del at[path[-1]]
        elif path[-1] == "trust-me":
            other = copy.deepcopy(good)
            at = other
            for key in path[:-1]:
                at = at[key]
            at["trust-me"] = new
        else:
            other = with_(good, path, new)
        if path[0] == "statement" if path else False:
            other = resealed(other)
        if what == "unknown key in the certificate":
            other = dict(good, **{"trust-me": 1})
        expect(what, answer(checker.check, other), place)
    text = json.dumps(good)
    twice = text.replace('"verdict": "proved"', '"verdict": "refuted", "verdict": "proved"', 1)
    expect("a key twice", answer(checker.check, twice), "the key `verdict` is there twice")
    for value in ([], 1, None, {}):
        expect(f"{value!r}", answer(checker.check, value), "format is unknown")
    zero = len(good["statement"]["programs"][0]["steps"])
    divided = with_(good, ("statement", "programs", 0, "steps"), lambda all_: [
        *all_, ["constant", "0"], ["reciprocal", zero], ["product", zero, zero + 1]])
    divided["statement"]["programs"][0]["zero"]["residual"] = [zero + 2]
    expect("0 divided by a determinant that is 0", answer(checker.check, tamper.sealed(
        divided["statement"])), "statement.programs[0] has no value")


HEAD = '[state]\nx = "1..2"\ny = "1..2"\n[field]\n"x\'" = "y"\n"y\'" = "-x"\n'


def of_text(good, what, text, kind, formula, place, **claim):
    """A sound program, and a text of which the claim is said to be."""
    statement = copy.deepcopy(good["statement"])
    sha = hashlib.sha256(text.encode()).hexdigest()
    statement["case"] = {"path": "forged.toml", "text": text, "sha256": sha}
    statement["settings"] = []
    statement["claim"] = {"name": "F", "kind": kind, "formula": formula, "where": "everywhere",
                          "expect": "holds", "verdict": "proved", **claim}
    statement["programs"] = [{"inputs": 2, "fixed": [], "steps": [["constant", "0"]],
                              "parameters": {}, "state": {}, "zero": {"residual": [0]}}]
    found = answer(checker.check, tamper.sealed(statement))
    found = found if isinstance(found, str) else "text" if found[0] else f"program: {found[1]}"
    expect(what, found, place)


def of_texts(good):
    def one(what, own, place, head="", body="", more="", kind="integral", **claim):
        text = f'{head}{HEAD}{body}[[claim]]\nname = "F"\n{kind} = "{own}"\n{more}'
        of_text(good, what, text, kind, claim.pop("formula", own), place, **claim)

    nonzero, circle = "is not 0 at a point", "x² + y²"
    one("a true claim", circle, "text")
    one("a false claim", "x² + 2*y²", nonzero)
    near = "0.10000000000000000001"
    one("a decimal that floats round", f"({near} − 0.1)*x", nonzero)
    one("a parameter that floats round", "(m − 0.1)*x", nonzero, f"[parameters]\nm = {near}\n")
    one("a small parameter", "m*x", "program: ", "[parameters]\nm = 1e-400\n")
    one("a parameter that is a date", "(m − 2018)*x", "program: a variable is no scalar",
        "[parameters]\nm = 2020-01-01\n")
    one("a parameter that is infinite", "x/m", "program: ", "[parameters]\nm = inf\n")
    one("a name in two spellings", "omega*x", "program: parameters has a name twice",
        '[parameters]\nomega = 1\n"ω" = 0\n')
    one("a name of two kinds", "y*x − x*x", "program: a name of the case has two meanings",
        body='[let]\ny = "x"\n')
    one("two rates", circle, "program: a rate is no scalar, or is there twice",
        body='"y′" = "x"\n')
    one("a key of the claim", circle, "program: the claim has the key `at`", more='at = "x = 1"\n')
    one("a key of the case", circle, "program: the case has the key `units`", "units = 1\n")
    one("another formula", circle, "statement.claim.formula", formula="x*y")
    one("another place", circle, "zero.level is missing", where="level")
    one("another expectation", circle, "statement.claim.expect", expect="fails")
    one("another name", circle, "program: the claim is not found", name="G")
    one("1/0", "1/(x − x)", "a denominator is 0")
    one("a digit of another script", "x*٣", "program: a formula")
    one("a cofactor with a pole", "y", "program: the cofactor has a denominator",
        more='cofactor = "−x/y"\n', kind="invariant-relation",
        formula="y = 0")
    good_ = tamper.sealed(good["statement"])
    assert answer(checker.check, good_)[0] in (True, False), "the certificate itself"


# --- closed orbits --------------------------------------------------------------------------------------

def orbit_sealed(certificate):
    statement, proof = certificate["statement"], certificate["proof"]
    text = statement["case"]["text"]
    statement["case"]["sha256"] = hashlib.sha256(text.encode()).hexdigest()
    digest = checker.digest_of({"statement": statement, "proof": proof})
    return dict(certificate, digest=digest)


def remembered(prove):
    """`orbit.prove`, which is called once for each pair of a motion and a proof."""
    known = {}

    def proved(motion, proof):
        data = {name: value for name, value in vars(motion).items() if not callable(value)}
        key = repr((data, proof))
        if key not in known:
            start, period, volume, is_least = prove(motion, proof)
            known[key] = start, period, volume, functools.cache(is_least)
        return known[key]

    return proved


def of_orbits(good):
    orbit.prove = remembered(orbit.prove)
    formula, where = good["statement"]["claim"]["formula"], good["statement"]["claim"]["where"]

    def one(what, path, new, place):
        expect(what, answer(orbit.check, orbit_sealed(with_(good, path, new))), place)

    def of_case(what, old, new, place, formula=formula, where=where):
        other = copy.deepcopy(good)
        text = other["statement"]["case"]["text"]
        head, name, own = text.partition('"limit cycle"\n')
        assert old in head or old in own, old
        head, own = (head.replace(old, new), own) if old in head else (head, own.replace(old, new, 1))
        other["statement"]["case"]["text"] = head + name + own
        other["statement"]["claim"].update(formula=formula, where=where)
        expect(what, answer(orbit.check, orbit_sealed(other)), place)

    for path in [(), ("statement",), ("statement", "claim"), ("statement", "case"),
                 ("statement", "orbit"), ("proof",)]:
        other = copy.deepcopy(good)
        at = other
        for key in path:
            at = at[key]
        at["trust-me"] = 1
        place = ".".join(path) or "the certificate"
        expect(f"unknown key in {place}", answer(orbit.check, orbit_sealed(other)),
               f"{place} has the unknown key")
    twice = json.dumps(good).replace('"least": true', '"least": true, "least": false', 1)
    expect("a key twice", answer(orbit.check, twice), "the key `least` is there twice")
    claim, proof, stated = ("statement", "claim"), ("proof",), ("statement", "orbit")
    wrong = "statement.claim.formula or .where is not that of the case"
    one("another period in words", (*claim, "formula"), lambda t: t.replace("6.66", "7.66"), wrong)
    one("another place", (*claim, "where"), "from x = 3", wrong)
    one("another name", (*claim, "name"), "phase volume", "statement.claim.name")
    one("another kind", (*claim, "kind"), "horseshoe", "statement.claim.kind")
    one("multipliers", (*stated, "multipliers"), stated_ball(good), "multipliers are beyond")
    one("a wider volume, the other sign", (*stated, "volume", 0), lambda t: t.lstrip("-"),
        "statement.orbit.volume does not contain")
    one("a negative radius", (*stated, "period", 1), lambda t: "-" + t,
        "statement.orbit.period does not contain")
    one("least as 1", (*stated, "least"), 1, "least is neither true nor false")
    one("another start", (*stated, "start"), [], "statement.orbit.start has not 2 components")
    for text in ("nan", "inf", "1.5", "0x1.8p+1", "0x1.80000000000001p+1", "0x1.8000000000000p+1024",
                 "0x1.8000000000000p+99999999", "0x1p1", " 0x1.8000000000000p+1", "", 1, None):
        one(f"a number {text!r}", (*proof, "period"), text, "proof.period is not a number in hex")
    one("a number as a float", (*proof, "period"), 6.5, "is not whole")
    one("NaN", (*proof, "order"), float("nan"), "is not whole")
    one("a negative order", (*proof, "order"), -1, "proof.order is not a number from 0")
    one("an order too high", (*proof, "order"), 10**9, "proof.order is out of range")
    for key in ("nodes", "shares", "radii", "tails"):
        one(f"no {key}", (*proof, key), [], f"proof.{key}")
        one(f"fewer {key}", (*proof, key), lambda all_: all_[:-1], "proof.")
    one("a node of another size", (*proof, "nodes", 1), lambda all_: all_[:-1], "proof.nodes[1]")
    one("a radius as large as the period", (*proof, "radii", -1), good["proof"]["period"],
        "the period may be 0")
    one("a radius of 0", (*proof, "radii", 0), "0x0.0000000000000p+0", "proof.radii is not positive")
    one("a wider radius", (*proof, "radii", 0), "0x1.0000000000000p-1", "")
    one("functions", (*proof, "functions"), [0], "proof.functions")
    # The case says something else than the proof.
    of_case("a key of the claim", 'density      = "none"\n', 'density = "none"\nat = "t = 0"\n',
            "the claim has the key `at`")
    of_case("a start far away", 'x = "2.0086198608748"', 'x = "20"', "does not begin near",
            formula.replace("2.0086198608748", "20"), "from x = 20")
    of_case("a start of another variable", 'x = "2.0086198608748"', 'z = "2.0086198608748"',
            "no variable", formula.replace("x = ", "z = "), where.replace("x = ", "z = "))
    of_case("another stability", '"sink"', '"source"', "another kind",
            formula.replace("sink", "source"))
    of_case("another divergence", '"negative"', '"positive"', "volumes change otherwise",
            formula.replace("shrinks", "grows"))
    of_case("a last digit", "6.6632868593", "6.6632868594", "",
            formula.replace("6.6632868593", "6.6632868594"))
    of_case("a wrong digit", "6.6632868593", "6.6632868693", "the period is not the one claimed",
            formula.replace("6.6632868593", "6.6632868693"))
    varied = 'density      = "none"\nparameters = { "μ" = "5 ± 1e-9" }\n'
    of_case("parameters about another value", 'density      = "none"\n', varied,
            "the distance of μ is beyond", formula + ", for μ ± 1e-9")
    of_case("parameters too far", 'density      = "none"\n', varied.replace("5 ± 1e-9", "± 1e-3"),
            "proof.radii", formula + ", for μ ± 1e-3")
    of_case("a variable that is a vector", 'p = "-3..3"', 'p = "vector(-3..3)"', "no scalar")
    of_case("a parameter that is a date", '"μ" = 1\n', '"μ" = 2020-01-01\n', "no number")
    of_case("a name in two spellings", '"μ" = 1\n', '"μ" = 1\nmu = 2\n', "a name twice")
    of_case("another parameter", '"μ" = 1\n', '"μ" = 1.001\n', "proof.radii")


def stated_ball(certificate):
    return certificate["statement"]["orbit"]["period"]


def main():
    files = sorted(glob.glob(sys.argv[2] + "/*.json"))
    with open(files[0], encoding="utf-8") as file:
        good = checker.load(file)
    of_forms(good)
    of_texts(good)
    if len(sys.argv) > 3:
        with open(sys.argv[3], encoding="utf-8") as file:
            of_orbits(checker.load(file))
    print(f"{len(FAILED)} not as they should be: {', '.join(FAILED)}")
    return 1 if FAILED else 0


if __name__ == "__main__":
    sys.exit(main())
