//! Functions in involution, and the hypotheses of Liouville's theorem: each claim that holds has a twin
//! that fails.

use Verdict::{Proved, Refuted, Undecided};
use liouville::case::Case;
use liouville::verdict::{Options, Verdict, judge};

/// Judges claims after `head`, each with its required verdict.
#[track_caller]
fn check(head: &str, expected: &[(Verdict, &str)]) {
    let stated: String =
        expected.iter().map(|(_, claim)| format!("[[claim]]\n{claim}\n")).collect();
    let text = format!("{head}\n{stated}");
    let case = Case::parse(&text, &[]).unwrap_or_else(|error| panic!("{error}\n{text}"));
    let report = judge(&case, &Options::default()).unwrap_or_else(|error| panic!("{error}"));
    for (claim, (verdict, text)) in report.claims.iter().zip(expected) {
        assert_eq!(claim.verdict, *verdict, "{text}\n{:#?}", claim.evidence);
    }
}

/// The message and the remedy for a claim after `head`.
#[track_caller]
fn mistake(head: &str, claim: &str) -> String {
    let text = format!("{head}\n[[claim]]\n{claim}\n");
    let error = Case::parse(&text, &[]).expect_err("a mistake");
    let help = error.mistakes().iter().filter_map(|own| own.help());
    format!("{error}\n{}", help.collect::<Vec<_>>().join("\n"))
}

const LAGRANGE: &str = "title = 'top'\nsystem = 'nonholonomic'\n[parameters]\nA = '0.5..2'\nC = '0.5..2'\nm = '0.5..2'\n\
    [state]\n'θ' = '0.5..2.5'\n'φ' = '-3..3'\n'ψ' = '-3..3'\n\"θ'\" = '-2..2'\n\"φ'\" = '-2..2'\n\"ψ'\" = '-2..2'\n\
    [lagrangian]\nkinetic = \"(A*(θ'² + φ'²*sin(θ)²) + C*(ψ' + φ'*cos(θ))²)/2\"\npotential = 'm*cos(θ)'\n\
    [let]\np = \"C*(ψ' + φ'*cos(θ))\"\nj = \"A*φ'*sin(θ)² + C*(ψ' + φ'*cos(θ))*cos(θ)\"";

#[test]
fn momenta_of_a_lagrangian_are_canonical() {
    check(
        LAGRANGE,
        &[
            (Proved, "involution = ['energy', 'p', 'j']\ntheorem = 'Liouville'"),
            // The momentum of θ is A θ'; {θ, Aθ'} = 1, and {φ, j} = 1.
            (Refuted, "involution = ['θ', \"θ'\"]"),
            (Proved, "involution = ['φ', 'p', \"θ'\"]"),
            (Refuted, "involution = ['φ', 'j']"),
            // A velocity is no momentum: φ' depends on θ at constant momenta.
            (Refuted, "involution = [\"φ'\", \"θ'\"]"),
            (Proved, "involution = [\"φ'\", 'p', 'j']"),
            // In involution, and none is the energy.
            (Refuted, "involution = ['θ', 'p', 'j']\ntheorem = 'Liouville'"),
            (Undecided, "involution = ['energy', 'p', 'p² + p']\ntheorem = 'Liouville'"),
        ],
    );
}

#[test]
fn gyroscopic_terms_enter_the_bracket() {
    // p₁ = x' − B y/2, p₂ = y' + B x/2: {x', y'} = B, in the sign of p' = p × B.
    let head = "title = 'charge'\nsystem = 'nonholonomic'\n[parameters]\nB = '0.5..2'\n[state]\nx = '-1..1'\ny = '-1..1'\n\
        \"x'\" = '-1..1'\n\"y'\" = '-1..1'\n[lagrangian]\nkinetic = \"(x'² + y'²)/2 + B*(x*y' − y*x')/2\"";
    check(
        head,
        &[
            (
                Proved,
                "involution = ['energy', \"x*y' − y*x' + B*(x² + y²)/2\"]\ntheorem = 'Liouville'",
            ),
            (Refuted, "involution = ['energy', \"x*y' − y*x' − B*(x² + y²)/2\"]"),
            (Proved, "involution = [\"x' − B*y\", \"x'\"]"),
            (Refuted, "involution = [\"x' + B*y\", \"y'\"]"),
            (Proved, "involution = [\"x' − B*y\", \"y'\"]"),
            (Refuted, "involution = [\"x' − B*y\", \"y' + B*x\"]"),
        ],
    );
}

const KEPLER: &str = "title = 'Kepler'\n[parameters]\nk = '0.5..2'\n[state]\nq = 'vector(0.5..2)'\np = 'vector(-1..1)'\n\
    [let]\nL = 'q × p'\n[hamiltonian]\nfunction = '(p,p)/2 − k/|q|'\npairs = [['q', 'p']]";

#[test]
fn a_hamiltonian_has_its_own_bracket() {
    check(
        KEPLER,
        &[
            (Proved, "involution = ['energy', 'L3', '(L,L)']\ntheorem = 'Liouville'"),
            (Refuted, "involution = ['energy', 'L3', 'L1']"),
            (Refuted, "involution = ['energy', 'L']\ntheorem = 'Liouville'"),
            (Proved, "involution = ['L1', 'p1² + p2² + p3²']"),
        ],
    );
    let told = mistake(KEPLER, "involution = ['energy', 'L3']\ntheorem = 'Liouville'");
    assert!(told.contains("cannot hold with 2 functions on a space of dimension 6"), "{told}");
    assert!(told.contains("list 3 functions"), "{told}");
    let told = mistake(KEPLER, "involution = ['energy', 'L']\ntheorem = 'Jacobi'");
    assert!(told.contains("theorem = \"Liouville\""), "{told}");
    assert!(mistake(KEPLER, "involution = ['energy']").contains("between 2 and"));
}

/// Euler's top with Casimir function (M,M), on a level of it or not.
fn top(level: &str) -> String {
    format!(
        "title = 'top'\n[parameters]\na = '0.5..2'\nb = '2..3'\nc = '1'\n[state]\nM = 'vector(-1..1)'\n\
         [hamiltonian]\nfunction = '(a*M1² + b*M2² + 4*M3²)/2'\nstructure = 'so(3)'\n{level}"
    )
}

#[test]
fn casimir_functions_count() {
    check(
        &top(""),
        &[
            (Proved, "involution = ['energy', '(M,M)']\ntheorem = 'Liouville'"),
            (Refuted, "involution = ['M1', 'M2']"),
        ],
    );
    check(
        &top("[level]\nequations = ['(M,M) = c']"),
        &[(Proved, "involution = ['energy']\ntheorem = 'Liouville'")],
    );
    // A level of the energy is not one of Casimir functions.
    check(
        &top("[level]\nequations = ['a*M1² + b*M2² + 4*M3² = c']"),
        &[(Refuted, "involution = ['(M,M)']\ntheorem = 'Liouville'")],
    );
}

/// A chain as a field, with its bracket.
fn chain(field: &str) -> String {
    format!(
        "title = 'chain'\n[state]\nx = '-1..1'\ny = '-1..1'\np = '-1..1'\nr = '-1..1'\n[field]\n{field}\n\
         [variables]\nx = 'x'\np = 'p'\ny = 'y'\nr = 'r'\n[poisson]\n'x,p' = '1'\n'y,r' = '1'\n"
    )
}

#[test]
fn a_field_must_keep_its_bracket() {
    let functions = "involution = ['x² + p²', 'y² + r²']\ntheorem = 'Liouville'";
    let rates = "\"x'\" = 'p'\n\"p'\" = '−x'\n\"y'\" = 'r'\n\"r'\" = '−y'";
    check(&chain(rates), &[(Proved, functions), (Refuted, "involution = ['x', 'p']")]);
    // The same orbits with another time: a field on the same tori that does not keep the bracket.
    let rates = "\"x'\" = '(1 + x²)*p'\n\"p'\" = '−(1 + x²)*x'\n\"y'\" = 'r'\n\"r'\" = '−y'";
    check(&chain(rates), &[(Refuted, functions), (Proved, "involution = ['x² + p²', 'y² + r²']")]);
}

#[test]
fn new_variables_carry_the_bracket_to_the_state() {
    // M = Iω with the bracket of so(3): {ω₁,ω₂} = −a I₃ω₃/(I₁I₂) in the sign of M' = M × ω.
    let head = "title = 'top'\n[parameters]\na = '1..2'\nb = '2..3'\n[state]\n'ω' = 'vector(-1..1)'\n[let]\nI = 'diag(1, a, b)'\n\
        [field]\n\"ω'\" = 'inverse(I)*(I*ω × ω)'\n[variables]\nM = 'I*ω'\n[poisson]\nstructure = 'so(3)'\n";
    check(
        head,
        &[
            (Proved, "involution = ['(ω,I*ω)', '(I*ω,I*ω)']\ntheorem = 'Liouville'"),
            (Refuted, "involution = ['(ω,I*ω)', '(ω,ω)']"),
            (Refuted, "involution = ['ω1', 'ω2']"),
        ],
    );
}

#[test]
fn systems_without_a_bracket_are_refused() {
    let head = "title = 'sleigh'\nsystem = 'nonholonomic'\n[state]\nx = '-1..1'\ny = '-1..1'\n\"x'\" = '-1..1'\n\"y'\" = '-1..1'\n\
        [lagrangian]\nkinetic = \"(x'² + y'²)/2\"\nconstraints = [\"x' = x*y'\"]";
    let told = mistake(head, "involution = [\"x'\", \"y'\"]");
    assert!(told.contains("without constraints, forces"), "{told}");
    let head =
        "title = 'field'\n[state]\nx = '-1..1'\ny = '-1..1'\n[field]\n\"x'\" = 'y'\n\"y'\" = '−x'";
    assert!(mistake(head, "involution = ['x', 'y']").contains("[poisson]"));
    let driven = "title = 'driven'\n[state]\nx = '-1..1'\np = '-1..1'\nt = '-1..1'\n[hamiltonian]\n\
        function = 'p²/2 + x*sin(t)'\npairs = [['x', 'p']]";
    let told = mistake(driven, "involution = ['p − cos(t)', 'p − cos(t)']\ntheorem = 'Liouville'");
    assert!(told.contains("without `t`"), "{told}");
}

#[test]
fn hypotheses_hold_where_all_formulas_have_values() {
    let plane = |bracket: &str| {
        format!(
            "title = 'plane'\n[state]\nq = '1..2'\np = '-1..1'\n[field]\n\"q'\" = 'p'\n\"p'\" = '-q'\n\
             [poisson]\n'q,p' = '{bracket}'"
        )
    };
    let both = [
        "involution = ['p² + q²']\ntheorem = 'Liouville'",
        "involution = ['p² + q²', '(p² + q²)²']",
    ];
    check(&plane("exp(log(q))/q"), &both.map(|claim| (Proved, claim)));
    // For q > 0 the bracket has a value at no state.
    check(&plane("exp(log(-q))/(-q)"), &both.map(|claim| (Undecided, claim)));
}

#[test]
fn functions_may_depend_on_no_open_constant() {
    let head = "title = 'two oscillators'\n[state]\nq = '-1..1'\np = '-1..1'\nx = '-1..1'\ny = '-1..1'\n[hamiltonian]\n\
                function = '(p² + q²)/2 + x² + y²'\npairs = [['q', 'p'], ['x', 'y']]";
    let with = |second: &str| format!("involution = ['energy', '{second}']\ntheorem = 'Liouville'");
    let (number, open) = (with("2*(x² + y²)"), with("∫(0,x)*(x² + y²)"));
    // For the constant 0 the second function is 0.
    check(head, &[(Proved, &number), (Undecided, &open)]);
}

#[test]
fn ranks_are_asked_on_parts_without_known_states() {
    let head = |other: &str| {
        format!(
            "title = 'two parts'\n[state]\nq = '-1..1'\np = '-1..1'\nx = '-1..1'\ny = '-1..1'\nz = '-1..1'\nw = '-1..1'\n\
             [field]\n\"q'\" = 'p'\n\"p'\" = '-q'\n\"x'\" = '0'\n\"y'\" = '0'\n\"z'\" = '0'\n\"w'\" = '0'\n\
             [poisson]\n'q,p' = '1'\n[level]\nequations = ['x*(y - {other}) = 0']"
        )
    };
    let claim = "involution = ['q² + p²', 'y', 'z', 'w']\ntheorem = 'Liouville'";
    // On the second part y depends on z. The first draws find no state of it.
    for other in ["z^5 - z + 1/3", "10^30*(z^5 + z - 1/3)", "exp(100*(z^5 + z + 2))"] {
        check(&head(other), &[(Undecided, claim)]);
    }
}

#[test]
fn the_dimension_of_tori_is_that_of_the_place() {
    let text = "title = 'top'\n[state]\nM = 'vector(-1..1)'\ng = 'vector(-1..1)'\n[hamiltonian]\n\
                function = '(M,M)/2 + M3² + g3'\nbracket = { structure = 'e(3)' }\n[level]\nequations = ['(g,g) = 1']\n\
                [[claim]]\ninvolution = ['energy', 'M3', '(M,g)', '(g,g)']\ntheorem = 'Liouville'\nwhere = 'everywhere'\n\
                [[claim]]\ninvolution = ['energy', 'M3', '(M,g)']\ntheorem = 'Liouville'\n";
    let case = Case::parse(text, &[]).unwrap_or_else(|error| panic!("{error}"));
    let report = judge(&case, &Options::default()).unwrap_or_else(|error| panic!("{error}"));
    for claim in &report.claims {
        assert_eq!(claim.verdict, Proved, "{:?}", claim.evidence);
        let remark = claim.evidence.remark.as_deref().unwrap_or_default();
        assert!(remark.contains("torus of dimension 2"), "{remark}");
    }
}

#[test]
fn lagrangians_need_as_many_functions_wherever_the_claim_is_made() {
    let text = |potential: &str, claim: &str, place: &str| {
        format!(
            "title = 'two degrees of freedom'\n[state]\nx = '-1..1'\ny = '-1..1'\n\"x'\" = '-1..1'\n\"y'\" = '-1..1'\n\
             [lagrangian]\nkinetic = \"(x'^2 + y'^2)/2\"\npotential = '{potential}'\n\
             [[claim]]\ninvolution = [{claim}]\ntheorem = 'Liouville'\n{place}"
        )
    };
    let chaotic = "(x² + y²)/2 + x²*y - y³/3";
    for place in ["", "where = 'everywhere'", "where = 'level'"] {
        let error = Case::parse(&text(chaotic, "'energy'", place), &[]).expect_err("one function");
        assert!(error.to_string().contains("cannot hold with 1 function"), "{place}: {error}");
        let case = text("x² + 3*y^4", "'energy', \"x'^2/2 + x²\"", place);
        let case = Case::parse(&case, &[]).unwrap_or_else(|error| panic!("{place}: {error}"));
        let report = judge(&case, &Options::default()).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(report.claims[0].verdict, Proved, "{place}: {:?}", report.claims[0].evidence);
    }
}

#[test]
fn the_momenta_of_a_lagrangian_need_no_new_variables() {
    let head = format!("{LAGRANGE}\n[variables]\nu = 'j'\nv = 'θ'\n[poisson]\n'u,v' = '1'\n");
    check(
        &head,
        &[
            (Proved, "involution = ['energy', 'p', 'j']\ntheorem = 'Liouville'"),
            (Refuted, "involution = ['energy', 'φ']"),
        ],
    );
    let named = mistake(&head, "involution = ['energy', 'p', 'j']\npoisson = 'poisson'");
    assert!(named.contains("components of new variables") || named.contains("poisson"), "{named}");
}

#[test]
fn numbers_such_as_pi_stand_in_no_way() {
    let head = |factor: &str| {
        format!(
            "title = 'x'\n[state]\nx = '-1..1'\ny = '-1..1'\np = '-1..1'\nq = '-1..1'\n[hamiltonian]\n\
             function = '(p² + q² + x² + y²)*{factor}'\npairs = [['x', 'p'], ['y', 'q']]\n"
        )
    };
    for factor in ["1/(4*π)", "ln(2)*√(2)", "atan(1/3)"] {
        check(
            &head(factor),
            &[
                (Proved, "involution = ['energy', 'x*q − y*p']\ntheorem = 'Liouville'"),
                (Proved, "involution = ['energy', 'p² + x²']\ntheorem = 'Liouville'"),
                (Refuted, "involution = ['energy', 'p*x']"),
            ],
        );
    }
}
