//! States that count: what a claim does not use says nothing of them.

use liouville::case::Case;
use liouville::verdict::{Options, Verdict, judge};

/// Verdicts on the claims of a file.
fn verdicts(text: &str) -> Vec<Verdict> {
    let case = Case::parse(text, &[]).unwrap_or_else(|error| panic!("{error}\n{text}"));
    let report = judge(&case, &Options::default()).unwrap_or_else(|error| panic!("{error}"));
    report.claims.into_iter().map(|claim| claim.verdict).collect()
}

/// Verdicts on claims that fail for a < 0, beside K of the given formula, in a file with this system.
fn beside(k: &str, system: &str, claims: &[&str]) -> Vec<Verdict> {
    let (head, tables) = system.split_once("[state]").unwrap_or(("", system));
    let claims: String = claims.iter().map(|own| format!("[[claim]]\n{own}\n")).collect();
    let state = if head.is_empty() && !system.contains("[state]") { "" } else { "[state]" };
    verdicts(&format!(
        "title = 't'\ncheck-weights = false\n[parameters]\na = '-1..1'\nK = '{k}'\n{head}{state}{tables}{claims}"
    ))
}

const CIRCLE: &str = "[state]\nx = '-2..2'\ny = '-5..5'\n[field]\n\"x'\" = '-y'\n\"y'\" = 'x'\n[level]\n\
    equations = ['x^2 + y^2 = 1']\n[level.chart]\ninputs = { u = '-3..3' }\nx = 'cos(u)'\n";

#[test]
fn parameters_that_a_chart_does_not_use_leave_all_states() {
    let claims = ["identity = 'a = abs(a)'", "integral = 'a*x^2 - abs(a)*x^2'"];
    let plain = beside("sqrt(a)", &format!("{CIRCLE}y = 'sin(u)'\n"), &claims);
    assert_eq!(plain, [Verdict::Refuted; 2]);
    let used = beside("sqrt(a)", &format!("{CIRCLE}y = 'sin(u) + 0*K'\n"), &claims);
    assert_eq!(used, [Verdict::Proved; 2], "the chart has no value for a < 0");
    let of_entry = |y: &str| beside("vec(sqrt(a), 1)", &format!("{CIRCLE}y = '{y}'\n"), &claims);
    for unused in ["K[2]*sin(u)", "sin(K[2]*u)", "sin(u)^K[2]"] {
        assert_eq!(of_entry(unused), [Verdict::Refuted; 2], "{unused}");
    }
    for used in ["sin(u) + 0*K[1]", "sin(u + 0*u*K[1])", "sin(u) + 0*(K, K)*u"] {
        assert_eq!(of_entry(used), [Verdict::Proved; 2], "{used}");
    }
}

#[test]
fn equations_outside_the_place_of_a_claim_leave_all_states() {
    let system = "[state]\nx = '-2..2'\ny = '-5..5'\nz = '-5..5'\n[field]\n\"x'\" = '1'\n\"y'\" = '0'\n\
        \"z'\" = '0'\n[level]\nequations = ['y = 1', 'z = 1 + 0*K']\n";
    let claims = [
        "identity = 'a = abs(a)'\nwhere = 'everywhere'",
        "integral = '(a - abs(a))*x'\nwhere = 'y = 1'",
        "identity = 'a = abs(a)'",
    ];
    let found = beside("sqrt(a)", system, &claims);
    assert_eq!(found, [Verdict::Refuted, Verdict::Refuted, Verdict::Proved]);
}

#[test]
fn entries_of_parameters_that_are_not_used_leave_all_states() {
    let with = |rate: &str| format!("[state]\nx = '-2..2'\n[field]\n\"x'\" = '{rate}'\n");
    let claims = ["identity = 'a = abs(a)'", "integral = 'a*x - abs(a)*x'"];
    for rate in ["1", "K[2]"] {
        assert_eq!(
            beside("vec(sqrt(a), 1, 2)", &with(rate), &claims),
            [Verdict::Refuted; 2],
            "{rate}"
        );
    }
    let used = beside("vec(sqrt(a), 1, 2)", &with("1 + 0*K[1]"), &claims);
    assert_eq!(used, [Verdict::Proved; 2], "the field has no value for a < 0");
}

#[test]
fn built_in_systems_use_their_own_parameters_alone() {
    let ball = |mass: &str, system: &str| {
        verdicts(&format!(
            "title = 't'\ncheck-weights = false\nsystem = '{system}'\n[parameters]\na = '-1..1'\nK = 'sqrt(a)'\n\
             m = '{mass}'\nR = '1..3'\nI = [1, 2, 3]\n[body]\nshape = 'ball'\n[[claim]]\n\
             identity = 'a = abs(a)'\n"
        ))
    };
    for system in ["rubber-plane", "rolling-plane"] {
        assert_eq!(ball("1", system), [Verdict::Refuted], "{system}");
        assert_eq!(ball("1 + 0*K", system), [Verdict::Proved], "{system}: no mass for a < 0");
    }
}

#[test]
fn time_without_a_bracket_has_the_rate_1_in_hamiltonian_form() {
    let text = |rate: &str, claims: &str| {
        format!(
            "title = 't'\ncheck-weights = false\n[state]\nx = '-2..2'\ny = '-2..2'\n[field]\n\"x'\" = 'y'\n\
             \"y'\" = '{rate}'\n[poisson]\n\"x,y\" = '1'\n{claims}"
        )
    };
    let driven = "[[claim]]\nhamiltonian = '(x^2 + y^2)/2 - x*cos(t)'\n[[claim]]\n\
        hamiltonian = '(x^2 + y^2)/2 + x*cos(t)'\n";
    let found = verdicts(&text("-x + cos(t)", driven));
    assert_eq!(found, [Verdict::Proved, Verdict::Refuted]);
    let still = "[[claim]]\nhamiltonian = '(x^2 + y^2)/2 + 0*t'\n[[claim]]\nhamiltonian = 'x^2/2 + y^2 + 0*t'\n";
    assert_eq!(verdicts(&text("-x", still)), [Verdict::Proved, Verdict::Refuted]);
    let faster = text("-x", "[[claim]]\nhamiltonian = '(x^2 + y^2)/2'\n")
        .replace("y = '-2..2'", "y = '-2..2'\nt = '0..1'")
        .replace("\"x'\"", "\"t'\" = '2'\n\"x'\"");
    assert_eq!(verdicts(&faster), [Verdict::Refuted], "t' = 2");
}

#[test]
fn a_component_of_time_is_a_use_of_time() {
    let system =
        "title = 't'\ncheck-weights = false\n[state]\nx = '-2..2'\n[field]\n\"x'\" = 'x'\n";
    let claims = "[[claim]]\nform = { t = '1' }\n[[claim]]\nsymmetry-field = { x = 'x', t = '1' }\n\
        [[claim]]\nfixed-point = {}\n";
    assert_eq!(verdicts(&format!("{system}{claims}")), [Verdict::Proved; 3]);
    // Cartan's form dx∧dy + dH∧dt.
    let turning = "title = 't'\ncheck-weights = false\n[state]\nx = '-2..2'\ny = '-2..2'\n[field]\n\
        \"x'\" = 'y'\n\"y'\" = '-x'\n";
    let form = |first: &str| {
        format!("[[claim]]\nform = {{ 'x,y' = '1', 'x,t' = '{first}', 'y,t' = 'y' }}\n")
    };
    let text = format!("{turning}{}{}[[claim]]\nfixed-point = {{}}\n", form("x"), form("-x"));
    assert_eq!(verdicts(&text), [Verdict::Proved, Verdict::Refuted, Verdict::Proved]);
    let wrong = Case::parse(&format!("{system}[[claim]]\nform = {{ s = '1' }}\n"), &[]);
    assert!(wrong.expect_err("no variable s").to_string().contains("`s` is not a state variable"));
}

#[test]
fn reasons_name_the_listed_parameters_that_a_claim_uses() {
    let text = "title = 't'\ncheck-weights = false\n[parameters]\na = '1..2'\ns = 'one of -1, 1'\nr = 'one of 1, 2'\n\
        [state]\nq = 'vector(3, -1..1)'\np = 'vector(3, -1..1)'\n[field]\n\"q'\" = 'p'\n\"p'\" = '-a*r*q'\n\
        [[claim]]\nindependent = ['|q × p|', '(p,p)', '(q,q)', 'r*(q,p)']\nexpect = 'fails'\n";
    let case = Case::parse(text, &[]).expect("a case");
    let report = judge(&case, &Options::default()).expect("judged");
    let claim = &report.claims[0];
    assert_eq!(claim.verdict, Verdict::Refuted);
    let reason = format!("{:?}", claim.evidence.reason);
    assert!(reason.contains("r = 1") && !reason.contains("s ="), "{reason}");
}
