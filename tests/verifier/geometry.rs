//! Claims of geometry: brackets of functions, commutators of fields, Lax pairs.

use liouville::case::Case;
use liouville::verdict::{ClaimReport, Options, Verdict, judge};

/// Judges the claims of a case.
#[track_caller]
fn claims(text: &str) -> Vec<ClaimReport> {
    let case = Case::parse(text, &[]).unwrap_or_else(|error| panic!("{error}\n{text}"));
    judge(&case, &Options::default()).unwrap_or_else(|error| panic!("{error}\n{text}")).claims
}

/// Judges claims after `head`, each with its required verdict.
#[track_caller]
fn check(head: &str, expected: &[(Verdict, &str)]) {
    let stated = expected.iter().map(|(_, claim)| format!("[[claim]]\n{claim}\n"));
    let found = claims(&format!("{head}\n{}", stated.collect::<String>()));
    assert_eq!(found.len(), expected.len(), "all are judged");
    for (claim, (verdict, text)) in found.iter().zip(expected) {
        assert_eq!(claim.verdict, *verdict, "{text}\n{:#?}", claim.evidence);
    }
}

/// Asserts that a file is refused, with this line, message and remedy.
#[track_caller]
fn refused(head: &str, claim: &str, message: &str, help: &str) {
    let error = Case::parse(&format!("{head}\n[[claim]]\n{claim}\n"), &[]).expect_err(claim);
    let line = head.lines().count() as u32 + 2;
    let told: Vec<(String, String)> = error
        .mistakes()
        .iter()
        .filter(|mistake| mistake.line.is_some_and(|found| found >= line))
        .map(|mistake| (mistake.message(), mistake.help().unwrap_or_default()))
        .collect();
    assert!(
        told.iter().any(|(m, h)| m.contains(message) && h.contains(help)),
        "{claim}: {told:?}, not {message}; {help}"
    );
}

use Verdict::{Proved, Refuted, Undecided};

const KEPLER: &str = "title = 'Kepler'\n[parameters]\nk = '0.5..2'\n[state]\nq = 'vector(0.5..2)'\np = 'vector(-1..1)'\n\
    [let]\nH = '(p,p)/2 − k/|q|'\nL = 'q × p'\nA = 'p × L − k*q/|q|'\n[field]\n\"q'\" = 'p'\n\"p'\" = '−k*q/|q|³'\n\
    [variables]\nq = 'q'\np = 'p'\n[poisson]\n'q,p' = 'E'";

#[test]
fn brackets_of_functions_have_their_sign() {
    check(
        KEPLER,
        &[
            (Proved, "bracket = ['H', 'L']"),
            (Proved, "bracket = ['A', 'H']"),
            (Proved, "bracket = ['q1', 'p1']\nequals = '1'"),
            (Refuted, "bracket = ['p1', 'q1']\nequals = '1'"),
            (Proved, "bracket = ['L1', 'L2']\nequals = 'L3'"),
            (Refuted, "bracket = ['L1', 'L2']\nequals = '−L3'"),
            (Refuted, "bracket = ['L1', 'L2']"),
            (Proved, "bracket = ['A1', 'A2']\nequals = '−2*H*L3'"),
            (Refuted, "bracket = ['A1', 'A2']\nequals = '2*H*L3'"),
            // {L_i, L_j} = ε_ijk L_k, the matrix of −hat(L)
            (Proved, "bracket = ['L', 'L']\nequals = '−hat(L)'"),
            (Refuted, "bracket = ['L', 'L']\nequals = 'hat(L)'"),
            (Proved, "bracket = ['L', 'A']\nequals = '−hat(A)'"),
            (Proved, "bracket = ['L', '(q,p)']"),
            (
                Proved,
                "bracket = ['L', '(q,[0,0,1])']\nequals = '[q2, −q1, 0] × [0, 0, 0] − [q2, −q1, 0]'",
            ),
        ],
    );
}

#[test]
fn a_bracket_takes_the_place_of_its_claim() {
    let head = "title = 'x'\n[parameters]\nx = '0.5..2'\n[state]\nM = 'vector(-2..2)'\n'γ' = 'vector(-1..1)'\n[field]\n\
        \"M'\" = 'M × [M1, M2, 4*M3] + γ × [x, 0, 0]'\n\"γ'\" = 'γ × [M1, M2, 4*M3]'\n\
        [let]\nH = '(M1² + M2² + 4*M3²)/2 + x*γ1'\nF = 'M3*(M1² + M2²) − x*M1*γ3'\n\
        [level]\nequations = ['(γ,γ) = 1', '(M,γ) = 0']\n[variables]\nM = 'M'\n'γ' = 'γ'\n[poisson]\nstructure = 'e(3)'";
    check(
        head,
        &[
            (Proved, "bracket = ['F', 'H']"),
            (Refuted, "bracket = ['F', 'H']\nwhere = 'everywhere'"),
            (Proved, "bracket = ['F', 'H']\nequals = '−x*M2*(M,γ)'\nwhere = 'everywhere'"),
            (Refuted, "bracket = ['H', 'F']\nequals = '−x*M2*(M,γ)'\nwhere = 'everywhere'"),
        ],
    );
}

#[test]
fn a_bracket_needs_a_skew_tensor_and_free_variables() {
    let head = |block: &str, images: &str| {
        format!(
            "title = 'x'\n[state]\nx = '1..2'\ny = '1..2'\n[field]\n\"x'\" = 'y'\n\"y'\" = '−x'\n\
                 [variables]\n{images}\n[poisson]\n{block}"
        )
    };
    let plane = "v = '[x, y]'";
    check(
        &head("'v,v' = '[[0, 1], [−1, 0]]'", plane),
        &[(Proved, "bracket = ['v1', 'v2']\nequals = '1'")],
    );
    check(
        &head("'v,v' = '[[0, 1], [1, 0]]'", plane),
        &[(Refuted, "bracket = ['v1', 'v2']\nequals = '1'")],
    );
    let related = "X = 'x'\nY = 'x'\nZ = 'y'";
    check(
        &head("'X,Z' = '1'\n'Y,Z' = 'X'", related),
        &[
            (Undecided, "bracket = ['X', 'Z']\nequals = '1 + X − Y'"),
            (Proved, "bracket = ['X', 'Z']\nequals = '1'"),
        ],
    );
}

#[test]
fn wrong_brackets_are_refused() {
    let three = "bracket = ['H', 'L', 'A']";
    refused(KEPLER, three, "3 are given", "[\"F\", \"G\"]");
    refused(KEPLER, "bracket = ['H']", "1 are given", "[\"F\", \"G\"]");
    refused(KEPLER, "bracket = ['hat(L)', 'H']", "of a matrix and a scalar", "scalars or vectors");
    refused(KEPLER, "bracket = ['L', 'L']\nequals = 'L'", "`equals`", "");
    refused(KEPLER, "bracket = ['H', 'K']", "K", "");
    let bare = KEPLER.split("[poisson]").next().expect("a head");
    refused(bare, "bracket = ['H', 'L']", "needs a bracket", "[poisson]");
    let bare = KEPLER.split("[variables]").next().expect("a head");
    refused(bare, "bracket = ['H', 'L']", "the case has none", "[variables] for new variables");
}

const ROTOR: &str = "title = 'rotation'\n[parameters]\na = 'vector(-1..1)'\nb = 'vector(-1..1)'\n[state]\n\
    r = 'vector(-1..1)'\ns = '-1..1'\n[field]\n\"r'\" = 'a × r'\n\"s'\" = 's*(a,r)'";

#[test]
fn commutators_have_their_sign() {
    check(
        ROTOR,
        &[
            (
                Proved,
                "commutator = { of = { s = '1' }, with = { s = 's²' } }\nequals = { s = '2*s' }",
            ),
            (
                Refuted,
                "commutator = { of = { s = 's²' }, with = { s = '1' } }\nequals = { s = '2*s' }",
            ),
            (Refuted, "commutator = { of = { s = '1' }, with = { s = 's²' } }"),
            (
                Proved,
                "commutator = { of = { r = 'a × r' }, with = { r = 'b × r' } }\nequals = { r = '(b × a) × r' }",
            ),
            (
                Refuted,
                "commutator = { of = { r = 'a × r' }, with = { r = 'b × r' } }\nequals = { r = '(a × b) × r' }",
            ),
            (Proved, "commutator = { of = { r = 'a × r' }, with = { r = 'r' } }"),
            (
                Proved,
                "commutator = { of = { r = 'b' }, with = { r = \"r'\", s = \"s'\" } }\nequals = { r = 'a × b', s = 's*(a,b)' }",
            ),
            (
                Refuted,
                "commutator = { of = { r = 'b' }, with = { r = \"r'\", s = \"s'\" } }\nequals = { r = 'a × b' }",
            ),
        ],
    );
}

#[test]
fn commutators_agree_with_symmetry_fields() {
    let symmetry = |weight: &str| format!("symmetry-field = {{ s = '1' }}\nweight = '{weight}'");
    let head = "title = 'x'\n[state]\ns = '1..2'\n[field]\n\"s'\" = 's²'";
    check(
        head,
        &[
            (Proved, &symmetry("2/s")),
            (Refuted, &symmetry("−2/s")),
            (
                Proved,
                "commutator = { of = { s = '1' }, with = { s = \"s'\" } }\nequals = { s = '(2/s)*s\u{b2}' }",
            ),
        ],
    );
}

#[test]
fn an_integrand_is_looked_at_beside_the_level_too() {
    let head = |level: &str| {
        format!(
            "title = 'x'\n[state]\nx = '1..2'\ny = '1..2'\n[field]\n\"x'\" = '0'\n\"y'\" = '0'\n{level}"
        )
    };
    let claim = |integrand: &str, z: &str| {
        format!(
            "commutator = {{ of = {{ y = '1' }}, with = {{ x = '∫({integrand}, x)' }} }}\nequals = {{ x = '{z}' }}"
        )
    };
    let level = head("[level]\nequations = ['y = x']");
    check(&level, &[(Proved, &claim("x", "0")), (Undecided, &claim("y", "0"))]);
}

#[test]
fn wrong_commutators_are_refused() {
    let of = "of = { r = 'a' }";
    refused(ROTOR, &format!("commutator = {{ {of} }}"), "no field `with`", "of = {");
    refused(ROTOR, "commutator = { with = { r = 'a' } }", "no field `of`", "of = {");
    refused(ROTOR, &format!("commutator = {{ {of}, wiht = {{ s = '1' }} }}"), "wiht", "with");
    refused(
        ROTOR,
        &format!("commutator = {{ {of}, with = {{ q = '1' }} }}"),
        "`q` is not a state variable",
        "",
    );
    refused(
        ROTOR,
        &format!("commutator = {{ {of}, with = {{ s = 'a' }} }}"),
        "a scalar is compared with a vector",
        "",
    );
    refused(ROTOR, &format!("commutator = {{ {of}, with = 'a' }}"), "a table", "");
    refused(ROTOR, "commutator = 'a'", "a table", "");
}

const TOP: &str = "title = 'Euler'\n[parameters]\nJ = 'diag(0.5..2)'\nz = '0.5..2'\nI = 'tr(J)*E − J'\n[state]\n\
    M = 'vector(-2..2)'\n[let]\nw = 'I⁻¹*M'\n[field]\n\"M'\" = 'M × w'";

#[test]
fn lax_pairs_have_their_sign() {
    check(
        TOP,
        &[
            (Proved, "lax = { L = 'hat(M)', A = 'hat(w)' }"),
            (Refuted, "lax = { L = 'hat(M)', A = '−hat(w)' }"),
            (Refuted, "lax = { A = 'hat(M)', L = 'hat(w)' }"),
            (Proved, "lax = { L = 'hat(M) + z*J²', A = 'hat(w) + z*J' }"),
            (Refuted, "lax = { L = 'hat(M) + z*J²', A = 'hat(w) − z*J' }"),
        ],
    );
}

/// Toda's lattice of n particles with free ends, in Flaschka's variables.
fn toda(n: usize) -> String {
    let band = |below: &str| {
        format!(
            "matrix(i, 1..n, j, 1..n, if(i = j, D[i], if(j = i+1, a[i], if(i = j+1, {below}a[j], 0))))"
        )
    };
    format!(
        "title = 'Toda'\n[parameters]\nn = {n}\n[state]\na = 'vector(n−1, 0.5..2)'\nb = 'vector(n, -1..1)'\n[field]\n\
         \"a[i]'\" = 'a[i]*(b[i+1] − b[i])'\n\"b[i]', i = 2..n−1\" = '2*(a[i]² − a[i−1]²)'\n\
         \"b[1]'\" = '2*a[1]²'\n\"b[n]'\" = '−2*a[n−1]²'\n[let]\nL = '{}'\nB = '{}'",
        band("").replace("D[i]", "b[i]"),
        band("−").replace("D[i]", "0"),
    )
}

#[test]
fn lax_pairs_are_of_any_size() {
    for n in [2, 3, 5] {
        check(
            &toda(n),
            &[
                (Proved, "lax = { L = 'L', A = '−B' }"),
                (Refuted, "lax = { L = 'L', A = 'B' }"),
                (Refuted, "lax = { L = 'L', A = '−Bᵀ' }"),
                (Proved, "lax = { L = 'L^2', A = '−B' }"),
            ],
        );
    }
}

#[test]
fn wrong_lax_pairs_are_refused() {
    refused(TOP, "lax = { L = 'hat(M)' }", "both L and A", "A = ");
    refused(TOP, "lax = { L = 'hat(M)', B = 'hat(w)' }", "has no `B`", "A = ");
    refused(TOP, "lax = { L = 'M', A = 'hat(w)' }", "L is a vector of length 3", "square");
    refused(TOP, "lax = { L = 'hat(M)', A = 'E(2)' }", "A a matrix of size 2×2", "one size");
    refused(TOP, "lax = { L = 'zero(2,3)', A = 'zero(2,3)' }", "size 2×3", "square");
    refused(TOP, "lax = 'hat(M)'", "a table", "");
}
