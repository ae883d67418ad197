#!/usr/bin/env python3
"""Writes certificates as goals of a proof assistant: python3 goals.py coq|lean FILE.json ...

Each program without roots becomes a theorem about real numbers: for all values of its inputs at which
no denominator is 0, its values are 0. Prints one file; programs with roots, and those of more than
20000 operations when they are written out, are left out, and named on standard error.
"""

import re
import sys

import check

MOST_OPERATIONS = 20_000

COQ = """Require Import Reals Field Nsatz.
Open Scope R_scope.

(* Hypotheses about products become such about their factors. *)
Ltac factors :=
  repeat match goal with
  | H : ?a * ?b <> 0 |- _ =>
      assert (a <> 0) by (let E := fresh in intro E; apply H; rewrite E; ring);
      assert (b <> 0) by (let E := fresh in intro E; apply H; rewrite E; ring);
      clear H
  end.

(* Denominators that are left are products of those of the hypotheses, as they are or cleared. *)
Ltac nonzero :=
  repeat split; repeat (apply Rmult_integral_contrapositive_currified);
  try assumption; try (apply not_0_IZR; discriminate);
  match goal with
  | H : ?d <> 0 |- ?e <> 0 =>
      let E := fresh in intro E; apply H;
      solve [ replace d with e by ring; exact E
            | replace d with (- e) by ring; rewrite E; ring
            | timeout 3 (field_simplify_eq; [ nsatz | repeat split; assumption ])
            | timeout 3 nsatz ]
  end.
"""

LEAN = """import Mathlib.Tactic
"""


class LeftOut(Exception):
    """The reason why a program is no goal."""


def letters(text):
    """A name of ASCII letters, digits and underscores."""
    small = ("alpha beta gamma delta epsilon zeta eta theta iota kappa lambda_ mu nu xi omicron pi_ "
             "rho sigma tau upsilon phi chi psi omega").split()
    greek = dict(zip("αβγδεζηθικλμνξοπρστυφχψω", small))
    greek.update(zip("ΑΒΓΔΕΖΗΘΙΚΛΜΝΞΟΠΡΣΤΥΦΧΨΩ", (name.capitalize() for name in small)))
    text = "".join(greek.get(letter, letter) for letter in text).replace("'", "_dot")
    return re.sub(r"\W", "_", text, flags=re.ASCII)


def names_of(program, steps):
    """A name for each input: that of a parameter or a component of the state, where it is one."""
    names = [f"x{k}" for k in range(program["inputs"])]
    for part in ("parameters", "state"):
        for name, places in program[part].items():
            for k, place in enumerate(places):
                if steps[place][0] == "input":
                    index = f"_{k + 1}" if len(places) > 1 else ""
                    names[steps[place][1]] = f"{letters(name)}{index}_"
    return [name if names.count(name) == 1 else f"x{k}" for k, name in enumerate(names)]


def written(steps, names, number):
    """Texts of all steps and their numbers of operations, and the denominators."""
    texts, sizes, denominators = [], [], []
    for name, a, *b in steps:
        if name == "root":
            raise LeftOut("it has roots")
        size = 1 + sum(sizes[step] for step in ([] if name in ("constant", "input") else
                                                 [a] if name == "power" else [a, *b]))
        if size > MOST_OPERATIONS:
            raise LeftOut("it is too long")
        if name == "constant":
            text = number(a)
        elif name == "input":
            text = names[a]
        elif name == "negative":
            text = f"(- {texts[a]})"
        elif name == "reciprocal":
            denominators.append(texts[a])
            text = f"(1 / {texts[a]})"
        elif name == "power":
            if b[0] < 0:
                denominators.append(texts[a])
            text = f"{texts[a]}^{abs(b[0])}"
            text = f"(1 / {text})" if b[0] < 0 else f"({text})"
        else:
            sign = {"sum": "+", "difference": "-", "product": "*"}[name]
            text = f"({texts[a]} {sign} {texts[b[0]]})"
        texts.append(text)
        sizes.append(size)
    return texts, list(dict.fromkeys(denominators))


def coq_number(value):
    text = f"({value.numerator})" if value < 0 else str(value.numerator)
    return text if value.denominator == 1 else f"({text} / {value.denominator})"


def lean_number(value):
    return f"(({value.numerator} : ℝ) / {value.denominator})"


def coq(name, inputs, denominators, values):
    bound = f"forall {' '.join(inputs)} : R, " if inputs else ""
    given = "".join(f"\n  {one} <> 0 ->" for one in denominators)
    claims = " /\\\n  ".join(f"{value} = 0" for value in values)
    return (f"Theorem {name} : {bound}{given}\n  {claims}.\n"
            f"Proof. intros; factors; repeat split; field; nonzero. Qed.\n")


def lean(name, inputs, denominators, values):
    bound = f" ({' '.join(inputs)} : ℝ)" if inputs else ""
    given = "".join(f"\n    (h{k} : {one} ≠ 0)" for k, one in enumerate(denominators))
    claims = " ∧\n    ".join(f"{value} = 0" for value in values)
    return (f"theorem {name}{bound}{given} :\n    {claims} := by\n"
            f"  refine ⟨{', '.join(['?_'] * len(values))}⟩ <;> field_simp <;> ring\n"
            if len(values) > 1 else
            f"theorem {name}{bound}{given} :\n    {claims} := by\n  field_simp\n  ring\n")


def goals(certificate, to, taken):
    """Goals of a certificate, each with its heading."""
    check.shaped(certificate, check.CERTIFICATE)
    statement = certificate["statement"]
    claim = statement["claim"]
    title = letters(f"{statement['case']['path'].rsplit('.', 1)[0]}_{claim['name']}").strip("_")
    comment = f"{statement['case']['path']}: {claim['kind']} {claim['formula'] or claim['name']}"
    for number, program in enumerate(statement["programs"]):
        steps, zero = check.read_program(program)
        names = names_of(program, steps)
        texts, denominators = written(steps, names, coq_number if to == "coq" else lean_number)
        name = re.sub(r"^(\d|_)", r"case_\1", f"{title}_{number}" if number else title)
        while name in taken:
            name += "_"
        taken.add(name)
        used = [one for one in names if any(one in text for text in texts)]
        values = [texts[place] for place in dict.fromkeys(zero) if texts[place] != "0"]
        if not values:
            raise LeftOut("its values are 0 as they are written")
        comment = comment.replace("(*", "( *").replace("*)", "* )").replace("-/", "- /")
        head = f"(* {comment} *)\n" if to == "coq" else f"/- {comment} -/\n"
        yield head + {"coq": coq, "lean": lean}[to](name, used, denominators, values)


def main(arguments):
    if len(arguments) < 2 or arguments[0] not in ("coq", "lean"):
        print(__doc__, file=sys.stderr)
        return 2
    to, paths = arguments[0], arguments[1:]
    print(COQ if to == "coq" else LEAN)
    taken, count = set(), 0
    for path in paths:
        try:
            with open(path, encoding="utf-8") as file:
                found = list(goals(check.load(file), to, taken))
        except (LeftOut, check.Refused, ValueError) as reason:
            print(f"left out {path}: {reason}", file=sys.stderr)
            continue
        count += len(found)
        print("\n".join(found))
    print(f"{count} goals", file=sys.stderr)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
