//! Details of verdicts besides true and false: place, novelty, sign, and reasons for silence.

mod progress;
mod steady;

use liouville::case::Case;
use liouville::claim::PlaceName;
use liouville::verdict::{
    ClaimReport, DensitySign, Independence, JudgeError, Options, Trust, Verdict, judge,
};

fn claims(text: &str) -> Vec<ClaimReport> {
    let case = Case::parse(text, &[]).unwrap_or_else(|error| panic!("{error}\n{text}"));
    judge(&case, &Options::default()).expect("it can be judged").claims
}

const BALL: &str = r#"
title = "balanced ball"
system = "rubber-plane"
[parameters]
m = "0.5..2"
R = "1..3"
I = "inertia(0.5..5)"
[body]
shape = "ball"
"#;

/// Writes the oscillator x'' = -x, with the level set described by the text.
fn oscillator(rest: &str) -> String {
    format!(
        "title = 'oscillator'\n[state]\nx = '-2..2'\ny = '-2..2'\n[field]\n\"x'\" = 'y'\n\"y'\" = '−x'\n{rest}"
    )
}

#[test]
fn trivial_and_general_integrals_are_told_apart() {
    let text = format!(
        "{BALL}[[claim]]\nintegral = '(γ,γ)'\n[[claim]]\nintegral = 'energy²'\n\
         [[claim]]\nintegral = '|J*ω × γ|²'\n[[claim]]\nintegral = '|J*ω × γ|² + energy'\n"
    );
    let found: Vec<_> = claims(&text).iter().map(|claim| claim.evidence.independence).collect();
    let expected = [
        Independence::Constant,
        Independence::General,
        Independence::Independent,
        Independence::Independent,
    ];
    assert_eq!(found, expected.map(Some));
}

#[test]
fn the_place_where_a_claim_holds_is_found() {
    let text = format!(
        "{BALL}[[claim]]\nintegral = '(γ,γ)'\n[[claim]]\nintegral = 'energy'\n\
         [[claim]]\nintegral = '(J*ω × γ)² + (ω,γ)*ω1'\n[[claim]]\nintegral = 'energy'\n\
         where = 'everywhere'\nexpect = 'fails'\n[[claim]]\nintegral = 'energy'\nwhere = '(ω,γ) = 0'\n"
    );
    let found = claims(&text);
    assert_eq!(found[0].evidence.holds, [PlaceName::Everywhere]);
    assert_eq!(
        found[1].evidence.holds,
        [PlaceName::Equations("(ω,γ) = 0".to_string())],
        "any |γ|, but no spinning"
    );
    assert_eq!(
        found[2].evidence.holds,
        [PlaceName::Equations("(ω,γ) = 0".to_string())],
        "a multiple of (ω,γ) does no harm there"
    );
    assert!(found.iter().all(|claim| claim.agrees), "all five come out as expected");
}

#[test]
fn level_only_is_checked_off_the_level() {
    let text = format!("{BALL}[[claim]]\nintegral = '|J*ω × γ|²'\nwhere = 'level only'\n");
    let claim = &claims(&text)[0];
    assert_eq!(claim.verdict, Verdict::Proved);
    assert!(!claim.agrees, "it holds elsewhere too: {:?}", claim.evidence.holds);
}

#[test]
fn a_density_that_changes_sign_is_no_positive_measure() {
    let found = claims(&oscillator(
        "[[claim]]\ndensity = '1'\n[[claim]]\ndensity = 'x² + y²'\n\
         [[claim]]\ndensity = 'x² + y² − 2'\n[[claim]]\ndensity = '−(x² + y²)'\n",
    ));
    assert!(found.iter().all(|claim| claim.verdict != Verdict::Refuted), "all are invariant");
    let signs: Vec<_> = found.iter().map(|claim| claim.evidence.sign).collect();
    let expected =
        [DensitySign::Positive, DensitySign::Positive, DensitySign::Changes, DensitySign::Negative];
    assert_eq!(signs, expected.map(Some));
}

#[test]
fn a_density_on_a_level_takes_account_of_how_the_level_is_approached() {
    // x' = x(1 - x²): x = 1 attracts, and ρ dy on it is invariant for y' = 0, whatever div v is.
    let text = |density: &str, place: &str| {
        format!(
            "title = 'cycle'\n[state]\nx = '0.2..2'\ny = '-1..1'\n[field]\n\"x'\" = 'x*(1 − x²)'\n\
             \"y'\" = 'x*0'\n[level]\nequations = ['x = 1']\n[[claim]]\ndensity = '{density}'\n\
             where = '{place}'\n"
        )
    };
    let on_level = &claims(&text("1 + y²", "level"))[0];
    assert_ne!(on_level.verdict, Verdict::Refuted, "div v = -2 there is the rate of approach");
    let volume = on_level.evidence.volume.as_deref();
    assert_eq!(volume, Some("σ with dx = d(x = 1)∧σ"), "and the volume is named");
    assert_eq!(claims(&text("1 + y²", "everywhere"))[0].verdict, Verdict::Refuted);
}

#[test]
fn charts_solved_and_given_agree() {
    let level = "[level]\nequations = ['(M,γ) = 1', '(γ,γ) = 1']\n";
    let solved = "[level]\nequations = ['(M,γ) = 1']\n";
    let given = format!(
        "{level}[level.chart]\ninputs = {{ u = '-2..2', v = '-2..2', a = 'vector(-2..2)' }}\n\
         \"γ\" = 'vec(2*u, 2*v, 1 − u² − v²)/(1 + u² + v²)'\nM = 'a + (1 − (a,γ))*γ'\n"
    );
    for (level, verdict, method, holds) in [
        (level, Verdict::Proved, "prime field", "(M,γ) = 1"),
        (&given, Verdict::Proved, "prime field", "(M,γ) = 1"),
        (solved, Verdict::Proved, "prime field", "level"),
    ] {
        let text = format!(
            "title = 'Euler–Poisson'\n[parameters]\nI = 'inertia(0.5..5)'\n[state]\nM = 'vector(-2..2)'\n\
             \"γ\" = 'vector(-1..1)'\n[field]\n\"M'\" = 'M × I⁻¹*M'\n\"γ'\" = 'γ × I⁻¹*M'\n{level}\
             [[claim]]\nintegral = '(M,M) + ((M,γ) − 1)*M1'\n[[claim]]\nintegral = 'M1'\nexpect = 'fails'\n\
             [[claim]]\ndensity = '1'\n"
        );
        let found = claims(&text);
        let verdicts: Vec<_> = found.iter().map(|claim| claim.verdict).collect();
        assert_eq!(verdicts[..2], [verdict, Verdict::Refuted], "{level}");
        assert_ne!(verdicts[2], Verdict::Refuted, "{level}");
        assert_eq!(found[0].evidence.method.name(), method, "{level}");
        assert_eq!(
            found[0].evidence.holds.iter().map(ToString::to_string).collect::<Vec<_>>(),
            [holds],
            "M1 spoils it elsewhere: {level}"
        );
    }
}

#[test]
fn what_holds_everywhere_is_proved_on_a_level_that_nothing_solves() {
    let text = "title = 'top'\n[parameters]\na = '1..2'\nb = '2..3'\nc = '3..4'\n[state]\np = '-2..2'\n\
                q = '-2..2'\nr = '-2..2'\nz = '0.1..2'\nw = '0.1..2'\n[field]\n\"p'\" = '(b − c)/a*q*r'\n\
                \"q'\" = '(c − a)/b*r*p'\n\"r'\" = '(a − b)/c*p*q'\n\"z'\" = '0'\n\"w'\" = '0'\n\
                [level]\nequations = ['z^5 + w^5 + z*w = 1']\n\
                [[claim]]\nintegral = 'a*p² + b*q² + c*r²'\n\
                [[claim]]\nintegral = 'a*p² + b*q² + c*r² + (z^5 + w^5 + z*w − 1)*p'\n\
                [[claim]]\nidentity = 'z^5 + w^5 + z*w = 1'\n\
                [[claim]]\nintegral = 'a*p² + b*q² − c*r²'\n";
    let found = claims(text);
    let verdicts: Vec<_> = found.iter().map(|claim| claim.verdict).collect();
    // What holds on the level alone rests on states that were found numerically, unless it is a combination of the
    // equations.
    use Verdict::{Confirmed, Proved, Refuted};
    assert_eq!(verdicts, [Proved, Confirmed, Proved, Refuted]);
    assert_eq!(found[0].evidence.method.name(), "prime field");
    assert!(found[0].evidence.proof.is_some(), "with its error bound");
    assert_eq!(found[0].evidence.holds, [PlaceName::Everywhere]);
    assert!(found[1].evidence.proof.is_none(), "nothing is proved at numerical states");
}

#[test]
fn a_slice_of_a_root_s_domain_is_not_taken_for_its_closure() {
    // On the sheet x = 0 the root has a value for z < 0, too, and y|z| = −yz there.
    let text = "title = 'slice'\n[state]\nx = '-2..2'\ny = '-2..2'\nz = '-1..4'\nw = '-1..1'\n[field]\n\
                \"x'\" = '0'\n\"y'\" = '0'\n\"z'\" = '0'\n\"w'\" = '0'\n[level]\n\
                equations = ['(x^5 + x*exp(w))*(x^3 − exp(w)) = 0']\n\
                [[claim]]\nidentity = 'y*abs(z) + ROOT = y*z + ROOT'\n";
    for root in ["√(z*x²)", "(z*x²)^(1/3)"] {
        let found = claims(&text.replace("ROOT", root));
        assert_ne!(found[0].verdict, Verdict::Proved, "{root}");
    }
}

#[test]
fn a_part_of_a_parametrised_level_is_sampled_on_that_part() {
    let text = "title = 'x'\n[state]\nx = '-2..2'\ny = '-2..2'\nz = '-2..2'\n[field]\n\"x'\" = 'y'\n\
                \"y'\" = '−x'\n\"z'\" = '(x² + y² − 1)*x'\n[level]\nequations = ['x² + y² = 1', 'z = 0']\n\
                [level.chart]\ninputs = { t = '-2..2' }\nx = '2*t/(1 + t²)'\ny = '(1 − t²)/(1 + t²)'\nz = '0*t'\n\
                [[claim]]\nintegral = 'z'\nwhere = 'x² + y² = 1'\n";
    let claim = &claims(text)[0];
    assert_eq!(claim.verdict, Verdict::Proved, "z is constant on the cylinder, for every z");
}

#[test]
fn an_integrand_of_two_variables_has_no_integral() {
    let found = claims(&oscillator(
        "[[claim]]\nintegral = 'y² + 2*∫(x, x)'\n[[claim]]\nintegral = 'y² + 2*∫(x + y, x)'\nexpect = 'open'\n",
    ));
    assert_eq!(found[0].verdict, Verdict::Proved, "y²/2 + ∫x dx is the energy");
    assert_eq!(found[1].verdict, Verdict::Undecided);
    let reason = found[1].evidence.reason.as_deref().unwrap_or_default();
    assert!(reason.contains("not a function of its variable"), "{reason}");
    let hidden = claims(&oscillator(
        "[let]\nQ = '∫(x + y, x)'\nP = '2*Q'\n[[claim]]\nintegral = 'y² + P'\nexpect = 'open'\n",
    ));
    assert_eq!(hidden[0].verdict, Verdict::Undecided, "an abbreviation hides nothing");
}

#[test]
fn rounding_that_hides_a_residual_is_admitted() {
    // 10⁵⁰ (y - y) in a form that no simplification cancels: the error bound exceeds L_v x = y.
    let huge = "10^50*((x + y)² − x² − 2*x*y − y²)";
    let text =
        oscillator(&format!("[[claim]]\nintegral = '(x² + y²)*(1 + {huge})'\nexpect = 'open'\n"));
    let case = Case::parse(&text, &[]).expect("a case");
    let options = Options { trust: Trust::Float, ..Options::default() };
    let found = judge(&case, &options).expect("it can be judged").claims;
    assert_eq!(found[0].verdict, Verdict::Undecided);
    assert_eq!(claims(&text)[0].verdict, Verdict::Proved, "a prime field has no rounding");
    let reason = found[0].evidence.reason.as_deref().unwrap_or_default();
    assert!(reason.contains("rounding hides"), "{reason}");
}

#[test]
fn what_the_criterion_does_not_exclude_stays_open() {
    let text = |extra: &str| {
        format!(
            "title = 'x'\nsystem = 'rubber-plane'\n[parameters]\nm = 1\nR = 2\nc = [0.3, 0.2, 0.1]\nI = [1, 2, 2.5]\n\
             S = [0.1, 0.2, 0.3]\n[body]\nshape = 'ball'\n{extra}[[claim]]\nanalytic-density = 'exists'\n\
             expect = 'open'\n[[claim]]\nposition-density = 'exists'\nexpect = 'fails'\n"
        )
    };
    assert_eq!(claims(&text(""))[0].verdict, Verdict::Refuted, "free: no analytic density at all");
    for forced in ["gyrostat = 'S'\n", "potential = 'm*γ3'\n", "moment = '[0,0,m] × γ'\n"] {
        let found = claims(&text(forced));
        assert_eq!(found[0].verdict, Verdict::Undecided, "only ρ(γ) is excluded");
        assert_eq!(found[1].verdict, Verdict::Refuted, "and that it is");
    }
}

/// With spin, C₁ ≠ 0 at a rest excludes densities with forces too; C₁ = 0 at every rest does not.
#[test]
fn a_rest_of_a_spinning_body_excludes_analytic_densities() {
    let text = |body: &str| {
        format!(
            "title = 'x'\nsystem = 'rolling-plane'\n[parameters]\nm = 1\nR = 2\nB = [4, 1, 0.64]\n\
             d = '-0.1..0.1'\nI = '[[0.4, d, 0], [d, 1.1, 0], [0, 0, 1.3]]'\nS = [0, 0, 1]\n\
             T = [0.1, 0, 1]\nc = '[x, 0, y]'\nx = '0.1..0.2'\ny = '-0.1..0.1'\n[body]\n{body}\
             [[claim]]\nanalytic-density = 'exists'\nexpect = 'open'\n\
             [[claim]]\nposition-density = 'exists'\nexpect = 'fails'\n"
        )
    };
    let ellipsoid = "support = '√(γ,B*γ)'\n";
    let ball = "shape = 'ball'\n";
    let weight = "potential = 'm*h'\n";
    for (body, expected) in [
        (ellipsoid.to_string(), Verdict::Refuted),
        (format!("{ellipsoid}{weight}"), Verdict::Refuted),
        (format!("{ellipsoid}{weight}gyrostat = 'S'\n"), Verdict::Refuted),
        // S is not along a rest
        (format!("{ellipsoid}{weight}gyrostat = 'T'\n"), Verdict::Undecided),
        // the rests under a weight are ±c/|c|, where C₁ is 0
        (format!("{ball}{weight}"), Verdict::Undecided),
        // without a weight S/|S| is a rest
        (format!("{ball}gyrostat = 'T'\n"), Verdict::Refuted),
        (format!("{ellipsoid}moment = '[0, 0, 1]'\n"), Verdict::Undecided),
        (format!("{ellipsoid}moment = '[γ1, 0, 0] × γ'\n"), Verdict::Refuted),
    ] {
        let found = claims(&text(&body));
        assert_eq!(found[0].verdict, expected, "{body}");
        let told = found[0].evidence.remark.is_some();
        let is_free = body == ellipsoid;
        assert_eq!(told, expected == Verdict::Refuted && !is_free, "{body}: its rest is named");
        assert_eq!(found[1].verdict, Verdict::Refuted, "{body}");
    }
}

#[test]
fn undefined_claims_are_undecided() {
    let found = claims(&oscillator(
        "[[claim]]\nintegral = '√(−1 − x²)'\nexpect = 'open'\n[[claim]]\nintegral = 'x/(y − y)'\nexpect = 'open'\n",
    ));
    for claim in found {
        assert_eq!(claim.verdict, Verdict::Undecided, "{}", claim.name);
    }
}

#[test]
fn a_level_that_is_left_or_empty_is_an_error() {
    let judged = |level: &str| {
        let text = oscillator(&format!("[level]\nequations = ['{level}']\n"));
        judge(&Case::parse(&text, &[]).expect("a case"), &Options::default())
    };
    assert!(matches!(judged("x = 1"), Err(JudgeError::NotInvariant { .. })), "x' = y there");
    assert!(matches!(judged("x² + y² = −1"), Err(JudgeError::Unreachable(_))), "nobody is there");
    assert!(judged("x² + y² = 1").is_ok(), "the circle is kept");
}

#[test]
fn every_name_of_the_guide_is_known() {
    let text = "title = 'names'\nsystem = 'rubber-sphere'\ncheck-weights = false\n[parameters]\nm = 1\n\
                k = 0.2\nR = 2\nc = [0.1, 0, 0.3]\nI = [1, 2, 2.5]\n[body]\nshape = 'ball'\npotential = 'm*h'\n";
    let names = [
        "(r,γ)",
        "(r',γ)",
        "(ṙ,γ)",
        "h",
        "trace(Ĩ)",
        "trace(∂r)",
        "energy",
        "(ω',γ)",
        "(γ',γ)",
        "λ0",
        "trace(J)",
        "trace(𝒥)",
        "U",
        "trace(Γ)",
        "D_T",
        "κ",
        "trace(Itilde)",
        "(omega,gamma)",
    ];
    for name in names {
        let text = format!("{text}[[claim]]\nintegral = \"{name}\"\nexpect = 'open'\n");
        claims(&text);
    }
    let text = "title = 'names'\nsystem = 'rubber-plane'\ncheck-weights = false\n[parameters]\nm = 1\n\
                I = 'axisymmetric(1..2)'\n[body]\nprofile = 'arbitrary'\n";
    for name in ["z", "p", "p'", "f1", "f2", "f1'", "f2'", "g1", "g1'", "g2"] {
        claims(&format!("{text}[[claim]]\nintegral = \"{name}\"\nexpect = 'open'\n"));
    }
}

#[test]
fn a_claim_without_a_name_shows_both_sides() {
    let found = claims(&oscillator(
        "[[claim]]\nidentity = 'x*x − x² = 0'\n[[claim]]\nrate = 'x'\nequals = 'y'\n\
         [[claim]]\nlimit = 'x*e'\nequals = '0'\nparameter = 'e'\n[parameters]\ne = '1..2'\n",
    ));
    let names: Vec<&str> = found.iter().map(|claim| claim.name.as_str()).collect();
    assert_eq!(names, ["x*x − x² = 0", "(x)' = y", "x*e → 0"]);
}

#[test]
fn a_cofactor_has_a_value_where_its_function_is_zero() {
    let found = claims(&oscillator(
        "[[claim]]\ninvariant-relation = 'x'\ncofactor = 'y/x'\n\
         [[claim]]\ninvariant-relation = 'x² + y²'\ncofactor = '0*x'\n\
         [[claim]]\ninvariant-relation = '(x² + y²)*(x − 1)'\ncofactor = 'y/(x − 1)'\n\
         [[claim]]\ninvariant-relation = '(x² + y²)*(x − 3)²/(x − 3)²'\ncofactor = 'x*(x² − x²)/(x − 1)'\n",
    ));
    let verdicts: Vec<Verdict> = found.iter().map(|claim| claim.verdict).collect();
    let expected = [Verdict::Undecided, Verdict::Proved, Verdict::Undecided, Verdict::Proved];
    assert_eq!(verdicts, expected, "x' = y on x = 0");
    let reason = found[0].evidence.reason.as_deref().unwrap_or_default();
    assert!(reason.contains("has a value where F = 0"), "{reason}");
    let remark = found[3].evidence.remark.as_deref().unwrap_or_default();
    assert!(remark.contains("divides by `(x − 1)`"), "{remark}");
}
