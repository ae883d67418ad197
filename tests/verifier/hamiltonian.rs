//! Systems given by Hamilton's equations: the field follows from a function and a bracket.

use Verdict::{Proved, Refuted};
use liouville::case::Case;
use liouville::verdict::{JudgeError, Options, Verdict, judge};

/// Judges claims after `head`, each with its required verdict.
#[track_caller]
fn check(head: &str, expected: &[(Verdict, &str)]) {
    let stated: String =
        expected.iter().map(|(_, claim)| format!("[[claim]]\n{claim}\n")).collect();
    let text = format!("{head}\n{stated}");
    let case = Case::parse(&text, &[]).unwrap_or_else(|error| panic!("{error}\n{text}"));
    let report = judge(&case, &Options::default()).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(report.claims.len(), expected.len(), "all are judged");
    for (claim, (verdict, text)) in report.claims.iter().zip(expected) {
        assert_eq!(claim.verdict, *verdict, "{text}\n{:#?}", claim.evidence);
    }
}

const KEPLER: &str = "title = 'Kepler'\n[parameters]\nk = '0.5..2'\n[state]\nq = 'vector(0.5..2)'\np = 'vector(-1..1)'\n\
    [let]\nL = 'q × p'\nU = '−k/|q|'\n[hamiltonian]\nfunction = '(p,p)/2 + U'\npairs = [['q', 'p']]";

#[test]
fn canonical_equations_have_their_sign() {
    check(
        KEPLER,
        &[
            (Proved, "identity = \"q' = p\""),
            (Proved, "identity = \"p' = −k*q/|q|³\""),
            (Refuted, "identity = \"q' = −p\""),
            (Refuted, "identity = \"p' = k*q/|q|³\""),
            (Proved, "integral = 'energy'"),
            (Proved, "identity = 'energy = (p,p)/2 − k/|q|'"),
            (Proved, "integral = 'p × L − k*q/|q|'"),
            (Refuted, "integral = 'p × L + k*q/|q|'"),
            (Proved, "density = '1'"),
            (Refuted, "density = '(q,q)'"),
        ],
    );
}

#[test]
fn the_bracket_of_the_system_is_that_of_claims() {
    check(
        KEPLER,
        &[
            (Proved, "hamiltonian = '(p,p)/2 + U'"),
            (Refuted, "hamiltonian = '−(p,p)/2 − U'"),
            (Proved, "jacobi-identity = 'holds'"),
            (Proved, "bracket = ['L1', 'L2']\nequals = 'L3'"),
            (Refuted, "bracket = ['L2', 'L1']\nequals = 'L3'"),
            (Refuted, "casimir = '(L,L)'"),
        ],
    );
}

#[test]
fn blocks_and_pairs_stand_together() {
    let head = |bracket: &str| {
        format!(
            "title = 'charge'\n[parameters]\nB = 'vector(-1..1)'\n[state]\nr = 'vector(-1..1)'\np = 'vector(-1..1)'\n\
             a = '-1..1'\nb = '-1..1'\n[hamiltonian]\nfunction = '(p,p)/2 + a²*b³'\n\
             pairs = [['r', 'p'], ['a', 'b']]\nbracket = {{ {bracket} }}"
        )
    };
    check(
        &head("'p,p' = '−hat(B)'"),
        &[
            (Proved, "identity = \"p' = p × B\""),
            (Refuted, "identity = \"p' = B × p\""),
            (Proved, "identity = \"a' = 3*a²*b²\""),
            (Proved, "identity = \"b' = −2*a*b³\""),
            (Proved, "integral = '(p,B)'"),
            (Refuted, "integral = '(p,[1,0,0])'"),
        ],
    );
    let case = |bracket| Case::parse(&head(bracket), &[]).expect("a case");
    let judged = judge(&case("'p,p' = 'B⊗B'"), &Options::default());
    assert!(matches!(judged, Err(JudgeError::NotSkew(_))), "a symmetric matrix is no bracket");
}

#[test]
fn a_structure_may_stand_beside_the_function() {
    let head = |structure: &str| {
        format!(
            "title = 'top'\n[parameters]\na = '0.5..2'\n[state]\nM = 'vector(-2..2)'\nγ = 'vector(-1..1)'\n\
             [hamiltonian]\nfunction = 'M²/2 + a*M3² + γ1'\n{structure}"
        )
        .replace("\nγ", "\n\"γ\"")
    };
    for structure in ["structure = 'e(3)'", "bracket = { structure = 'e(3)' }"] {
        check(
            &head(structure),
            &[
                (Proved, "identity = \"γ' = γ × (M + 2*a*[0, 0, M3])\""),
                (Refuted, "identity = \"γ' = (M + 2*a*[0, 0, M3]) × γ\""),
                (Proved, "casimir = '(M,γ)'"),
            ],
        );
    }
    let read = Case::parse(&head("structure = 'e(4)'"), &[]);
    assert!(read.is_err_and(|error| error.to_string().contains("is not a bracket of these")));
}

#[test]
fn tops_are_given_by_a_bracket_alone() {
    let head = "title = 'top'\n[parameters]\nI = 'inertia(0.5..5)'\nc = 'vector(-1..1)'\n[state]\nM = 'vector(-2..2)'\n\
        'γ' = 'vector(-1..1)'\n[level]\nequations = ['(γ,γ) = 1']\n[hamiltonian]\n\
        function = '(M,I⁻¹*M)/2 + (c,γ)'\nbracket = { structure = 'e(3)' }";
    check(
        head,
        &[
            (Proved, "identity = \"M' = M × I⁻¹*M + γ × c\""),
            (Refuted, "identity = \"M' = M × I⁻¹*M − γ × c\""),
            (Proved, "identity = \"γ' = γ × I⁻¹*M\""),
            (Proved, "integral = '(M,γ)'"),
            (Proved, "casimir = '(M,γ)'"),
            (Refuted, "casimir = '(M,M)'"),
        ],
    );
}

#[test]
fn time_goes_on() {
    let head = "title = 'forced'\n[state]\nq = '-1..1'\np = '-1..1'\n[hamiltonian]\nfunction = 'p²/2 + q*t²'\npairs = [['q', 'p']]";
    check(
        head,
        &[
            (Proved, "rate = 't'\nequals = '1'"),
            (Proved, "rate = 'p'\nequals = '−t²'"),
            (Proved, "rate = 'energy'\nequals = '2*q*t'"),
            (Refuted, "integral = 'energy'"),
            (Proved, "integral = 'p + t³/3'"),
            (Refuted, "integral = 'p − t³/3'"),
        ],
    );
}

#[test]
fn wrong_systems_are_refused() {
    let cases = [
        ("pairs = [['q', 'p']]", "has no `function`", "add function"),
        ("function = 'p'\npairs = [['q', 'x']]", "`x` is not a state variable", "pairs = [["),
        ("function = 'p'\npairs = [['q', 'q']]", "paired with itself", "two state variables"),
        ("function = 'p'\npairs = [['q', 'v']]", "a scalar is paired with a vector", "of one kind"),
        ("function = 'p'\npairs = ['q', 'p']", "this is not a pair", "pairs = [["),
        ("function = 'p'\npairs = 'q'", "is a list of pairs", "pairs = [["),
        ("function = 'p'\npairs = [['q', 'p'], ['p', 'q']]", "given already", "pairs = [["),
        ("function = 'p'\npairs = [['q', 'p']]", "`v` has no bracket", "\"v,v\" = "),
        ("function = \"q'\"\npairs = [['q', 'p']]", "q'", ""),
        ("function = 'v'\npairs = [['q', 'p']]", "vector", ""),
        ("function = 'p'\nbracket = { 'q,x' = '1' }", "not a pair of the bracket's variables", ""),
        ("function = 'p'\npars = [['q', 'p']]", "pars", "pairs"),
        (
            "function = 'p'\npairs = [['q', 'p'], ['v', 'v']]\n[poisson]\n'q,x' = '1'",
            "paired with itself",
            "two state variables",
        ),
        ("function = 'p'\n[field]\n\"q'\" = 'p'", "both give the rates", "remove one"),
    ];
    for (section, message, help) in cases {
        let text = format!(
            "title = 'x'\n[state]\nq = '-1..1'\np = '-1..1'\nv = 'vector(-1..1)'\n[hamiltonian]\n{section}\n"
        );
        let error = Case::parse(&text, &[]).expect_err(section);
        let told: Vec<(String, String)> = error
            .mistakes()
            .iter()
            .map(|mistake| (mistake.message(), mistake.help().unwrap_or_default()))
            .collect();
        let is_told = told.iter().any(|(m, h)| m.contains(message) && h.contains(help));
        assert!(is_told, "{section}: {told:?}, not {message}; {help}");
        assert!(error.mistakes().iter().all(|mistake| mistake.line.is_some()), "{section}");
    }
}

#[test]
fn a_built_in_system_has_no_function_of_its_own() {
    let text = "title = 'x'\nsystem = 'rubber-plane'\n[parameters]\nm = 1\nR = 1\nI = [1, 2, 3]\n[body]\n\
                shape = 'ball'\n[hamiltonian]\nfunction = '1'\n";
    let error = Case::parse(text, &[]).expect_err("it has equations of motion");
    let told = |mistake: &liouville::case::Mistake| {
        mistake.line.is_some() && mistake.message().contains("gives a vector field")
    };
    assert!(error.mistakes().iter().any(told), "{error}");
}
