//! Claims in a file of which another claim uses `t`: each is judged as in a file of its own.

use liouville::case::Case;
use liouville::claim::Claim;
use liouville::verdict::{CaseReport, Options, Verdict, judge};

const DAMPED: &str = "title = \"t\"\ncheck-weights = false\n[parameters]\nc = \"1/2..1\"\n[state]\n\
    x = \"-2..2\"\nv = \"-2..2\"\n[field]\n\"x'\" = \"v\"\n\"v'\" = \"-sin(x) - c*v\"\n";
const SQUARE: &str =
    "title = \"t\"\ncheck-weights = false\n[state]\nx = \"-2..2\"\n[field]\n\"x'\" = \"x²\"\n";

fn report(text: &str) -> CaseReport {
    let case = Case::parse(text, &[]).unwrap_or_else(|error| panic!("{error}\n{text}"));
    liouville_search::judge(&case, &Options::default()).unwrap_or_else(|error| panic!("{error}"))
}

/// Verdicts on claims of a file, and on the same claims between two that use `t`.
fn both(system: &str, with_time: &str, claims: &[&str]) -> [Vec<(String, Verdict)>; 2] {
    let table = |claim: &&str| format!("[[claim]]\nexpect = \"open\"\n{claim}\n");
    let plain: String = claims.iter().map(table).collect();
    let timed = table(&with_time);
    let named = format!("[[claim]]\nname = \"of t\"\nexpect = \"open\"\n{with_time}\n");
    let verdicts = |report: CaseReport| -> Vec<(String, Verdict)> {
        report.claims.into_iter().map(|claim| (claim.name, claim.verdict)).collect()
    };
    let alone = verdicts(report(&format!("{system}{plain}")));
    let beside = verdicts(report(&format!("{system}{timed}{plain}{named}")));
    assert_eq!(beside.len(), claims.len() + 2, "every claim is judged");
    let users = beside.iter().filter(|(name, _)| !alone.iter().any(|(other, _)| other == name));
    let users: Vec<Verdict> = users.map(|(_, verdict)| *verdict).collect();
    assert_eq!(users, [Verdict::Proved; 2], "the claims that use t");
    let names: Vec<&String> = alone.iter().map(|(name, _)| name).collect();
    let others = beside.into_iter().filter(|(name, _)| names.contains(&name)).collect();
    [alone, others]
}

#[test]
fn no_claim_depends_on_another_that_uses_t() {
    let claims = [
        "fixed-point = {}",
        "fixed-point = { x = \"1\" }",
        "name = \"spectrum\"\nfixed-point = {}\nspectrum = [\"-c\", \"0\"]",
        "name = \"linear part\"\nfixed-point = {}\ncharacteristic-polynomial = [\"c\", \"1\"]",
        "no-density-near = {}",
        "no-density = { degree = 2 }",
        "no-integral = { degree = 2 }",
        "lyapunov = \"v^2/2 - cos(x)\"",
        "independent = [\"x\", \"v\"]",
        "symmetry-field = { x = \"v\", v = \"-sin(x) - c*v\" }",
        "integral = \"v\"",
    ];
    let [alone, beside] = both(DAMPED, "density = \"exp(c*t)\"", &claims);
    assert_eq!(alone, beside);
    let proved = alone.iter().filter(|(_, verdict)| *verdict == Verdict::Proved).count();
    assert_eq!(proved, 7, "{alone:?}");
    let claims = ["symmetry-field = { x = \"x\" }\nweight = \"1\"", "no-density-near = {}"];
    let [alone, beside] = both(SQUARE, "integral = \"t + 1/x\"", &claims);
    assert_eq!(alone, beside);
    assert_eq!(alone[0].1, Verdict::Proved, "[x ∂x, x² ∂x] = x² ∂x");
}

#[test]
fn reports_keep_the_order_and_the_names_of_the_file() {
    let timed = "[[claim]]\nsymmetry-field = { x = \"x\", t = \"-t\" }\nweight = \"1\"\n";
    let plain = "[[claim]]\nsymmetry-field = { x = \"x\" }\nweight = \"1\"\n";
    let found = report(&format!("{SQUARE}{timed}{plain}{timed}[[claim]]\nfixed-point = {{}}\n"));
    let names: Vec<&str> = found.claims.iter().map(|claim| claim.name.as_str()).collect();
    assert_eq!(names, ["x = x, t = -t", "x = x", "x = x, t = -t (2)", "fixed-point"]);
    assert!(found.claims.iter().all(|claim| claim.verdict == Verdict::Proved), "{names:?}");
}

#[test]
fn abbreviations_that_use_t_leave_other_claims_alone() {
    let names = "[let]\ng = \"exp(c*t)\"\nh = \"2*g\"\n";
    let rest = "[[claim]]\nfixed-point = {}\n[[claim]]\nno-density-near = {}\n";
    for used in ["", "[[claim]]\ndensity = \"h\"\n"] {
        let found = report(&format!("{DAMPED}{names}{rest}{used}"));
        assert_eq!(found.claims.len(), 2 + usize::from(!used.is_empty()));
        assert!(found.claims.iter().all(|claim| claim.verdict == Verdict::Proved), "{used}");
    }
    let error = Case::parse(&format!("{DAMPED}{names}[[claim]]\nintegral = \"h + z\"\n"), &[]);
    assert!(error.expect_err("z is unknown").to_string().contains("`z`"));
}

#[test]
fn mistakes_are_those_of_every_claim() {
    let timed = "[[claim]]\nintegral = \"t + 1/x + z\"\n";
    let plain = "[[claim]]\nfixed-point = { y = \"0\" }\n[[claim]]\nintegral = \"t + 1/x\"\n";
    let error = Case::parse(&format!("{SQUARE}{timed}{plain}"), &[]).expect_err("two mistakes");
    let text = error.to_string();
    assert!(text.contains("`z`") && text.contains("`y`"), "{text}");
}

#[test]
fn a_field_that_uses_t_never_rests() {
    let driven = SQUARE.replace("x²", "x² + sin(t)");
    let error = Case::parse(&format!("{driven}[[claim]]\nfixed-point = {{}}\n"), &[]);
    assert!(error.expect_err("nothing rests").to_string().contains("nothing rests"));
}

#[test]
fn claims_as_values_are_judged_without_t_too() {
    let case = Case::parse(
        &format!("{SQUARE}[[claim]]\nintegral = \"t + 1/x\"\n[[claim]]\nfixed-point = {{}}\n"),
        &[],
    )
    .expect("a case");
    let integral = case.formula("t + 1/x").expect("a formula with t");
    let claims =
        [Claim::integral(integral), Claim::density(case.formula("x^(-2)").expect("a formula"))];
    let asked = case.with_claims(&claims).expect("claims of the case");
    let found = judge(&asked, &Options::default()).expect("judged");
    assert_eq!(found.claims.len(), 2);
    assert!(found.claims.iter().all(|claim| claim.verdict == Verdict::Proved));
}

#[test]
fn names_that_are_added_and_changes_of_the_system_leave_no_claim_out() {
    let text =
        format!("{SQUARE}[[claim]]\nintegral = \"t + 1/x\"\n[[claim]]\nfixed-point = {{}}\n");
    let mut case = Case::parse(&text, &[]).expect("a case");
    for formula in ["x^2", "t*x"] {
        let formula = case.formula(formula).expect("a formula");
        case.define(&format!("f{}", case.model.abbreviations.len()), &formula).expect("a name");
    }
    let found = judge(&case, &Options::default()).expect("judged");
    let kinds: Vec<&str> = found.claims.iter().map(|claim| claim.kind).collect();
    assert_eq!(kinds, ["integral", "fixed-point"]);
    case.model.abbreviations.clear();
    assert!(case.time_parts().is_none(), "another system than that of the file");
}
