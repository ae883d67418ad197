//! Levels and powers that depend on listed values: no verdict contradicts that for one of the values.

use liouville::case::{Case, Setting};
use liouville::verdict::{CaseReport, Options, Verdict, judge};

fn report(text: &str, settings: &[Setting]) -> CaseReport {
    let case = Case::parse(text, settings).unwrap_or_else(|error| panic!("{error}\n{text}"));
    judge(&case, &Options::default()).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

fn file(parameters: &str, state: &str, rates: &str, level: &str, claims: &[&str]) -> String {
    let claims: String = claims.iter().map(|own| format!("[[claim]]\n{own}\n")).collect();
    format!(
        "title = 't'\ncheck-weights = false\n[parameters]\n{parameters}\n[state]\n{state}\n[field]\n{rates}\n{level}\n{claims}"
    )
}

fn verdicts(text: &str) -> Vec<Verdict> {
    report(text, &[]).claims.into_iter().map(|claim| claim.verdict).collect()
}

const PLANE: &str = "x = '-3..3'\ny = '-3..3'";
const STILL: &str = "\"x'\" = '0'\n\"y'\" = '0'";

#[test]
fn a_value_for_which_the_level_is_a_point_counts() {
    let claims = ["identity = 'x^2 + y^2 = 1'", "identity = 'x^2 + y^2 = p'"];
    let level = "[level]\nequations = ['x^2 + y^2 = p']";
    let turning = "\"x'\" = '-y'\n\"y'\" = 'x'";
    let found = report(&file("p = 'one of 1, 0'", PLANE, turning, level, &claims), &[]);
    assert_ne!(found.claims[0].verdict, Verdict::Proved, "0 = 1 for p = 0");
    let reason = format!("{:?}", found.claims[0].evidence.reason);
    assert!(reason.contains("for p = 0"), "{reason}");
    let found = verdicts(&file("p = 'one of 1, 2'", PLANE, turning, level, &claims));
    assert_eq!(found, [Verdict::Refuted, Verdict::Proved]);
    let third = "[[claim]]\nintegral = 'z'\n";
    let text = file(
        "p = 'one of 0, 1'",
        "x = '-3..3'\ny = '-3..3'\nz = '-3..3'",
        "\"x'\" = '-y'\n\"y'\" = 'x'\n\"z'\" = 'x^2 + y^2 - 1'",
        level,
        &[],
    );
    assert_ne!(verdicts(&format!("{text}{third}")), [Verdict::Proved], "z' = -1 for p = 0");
}

#[test]
fn a_value_is_left_out_only_if_nothing_is_said_for_any_of_another_list() {
    let level = "[level]\nequations = ['x^2 + y^2 = p']";
    let claims = ["identity = 'x^2 + y^2 + 0/(p + q) = 1'"];
    let found =
        verdicts(&file("p = 'one of 1, 0'\nq = 'one of 0, 1'", PLANE, STILL, level, &claims));
    assert_ne!(found, [Verdict::Proved], "0 = 1 for p = 0, q = 1");
    let claims = ["identity = 'x^2 + y^2 + 0/p = 1'"];
    let found =
        verdicts(&file("p = 'one of 1, 0'\nq = 'one of 0, 1'", PLANE, STILL, level, &claims));
    assert_eq!(found, [Verdict::Proved], "nothing is said for p = 0");
}

#[test]
fn a_listed_power_in_an_equation_counts_as_that_number() {
    let claims = ["identity = 'y = 0'"];
    for factor in ["x^a", "(x - 1)^a", "abs(x)^a", "x^(a - 1)"] {
        let level = format!("[level]\nequations = ['{factor}*y = 0']");
        let found = verdicts(&file("a = 'one of 2, 3'", PLANE, STILL, &level, &claims));
        assert_ne!(found, [Verdict::Proved], "{factor}");
    }
    let parameters = "a = 'one of 2, 3'\nb = '-1..1'\nN = 'b^a'";
    let level = "[level]\nequations = ['y = N']";
    let claims = ["identity = 'b = abs(b)'", "integral = 'x - b*x/abs(b)'", "identity = 'y = b^a'"];
    let found = verdicts(&file(parameters, PLANE, "\"x'\" = '1'\n\"y'\" = '0'", level, &claims));
    assert!(found[..2].iter().all(|one| *one != Verdict::Proved), "{found:?}: false for b < 0");
    let (parameters, level) =
        ("p = 'one of 1, 3'\nq = 'one of -1, 1'", "[level]\nequations = ['x*abs(y - q^p) = 0']");
    let claims = ["identity = 'q^p = 1'", "identity = 'q = 1'"];
    let found = verdicts(&file(parameters, PLANE, STILL, level, &claims));
    assert!(found.iter().all(|one| *one != Verdict::Proved), "{found:?}: q = -1");
}

#[test]
fn a_listed_power_of_a_parameter_is_seen_beside_any_level() {
    let claims = [
        "identity = 'b = abs(b) + 0*b^a'",
        "integral = '(b - abs(b))*x*b^a'",
        "lyapunov = 'x*(abs(b) - b)*abs(b)^a + 0*b^a'",
        "identity = 'b = abs(b) + 0*b^a'\nwhere = 'everywhere'",
    ];
    for level in ["[level]\nequations = ['y = 1']", "[level]\nequations = ['x*y = 0']"] {
        let parameters = "a = 'one of 2, 3'\nb = '-1..1'";
        let claims = &claims[..if level.contains("x*y") { 1 } else { 4 }];
        let rates = if level.contains("x*y") { STILL } else { "\"x'\" = '1'\n\"y'\" = '0'" };
        let found = verdicts(&file(parameters, PLANE, rates, level, claims));
        assert!(found.iter().all(|one| *one != Verdict::Proved), "{level}: {found:?}");
    }
}

/// Judges claims for all listed values, and for each, and compares.
#[test]
fn no_random_level_contradicts_its_values() {
    let factors = [
        "x^a",
        "x^2 + y^2 - p",
        "(x - p)*y",
        "p*x - y",
        "x^2 + p*y^2 - p",
        "y - q^a",
        "x - p*y^a",
        "abs(x - p) + abs(y)",
    ];
    let claims = [
        "x*y = 0",
        "x = p",
        "y = q^a",
        "x^2 + y^2 = 1",
        "p = 1",
        "q = abs(q)",
        "(x - 1)*(y - 1) = 0",
        "x = p*y^a",
    ];
    let (lists, texts) = (["a", "p", "q"], ["one of 2, 3", "one of 0, 1", "one of -1, 1"]);
    let (mut proved, mut contradicted) = (0, 0);
    for seed in 0..16usize {
        let (first, second) = (factors[seed % 8], factors[(seed * 5 + 3) % 8]);
        let equation = if seed < 8 { first.to_string() } else { format!("({first})*({second})") };
        let parameters: Vec<String> =
            lists.iter().zip(texts).map(|(name, list)| format!("{name} = '{list}'")).collect();
        let all: Vec<String> =
            claims.iter().map(|own| format!("identity = '{own}'\nexpect = 'open'")).collect();
        let all: Vec<&str> = all.iter().map(String::as_str).collect();
        let level = format!("[level]\nequations = ['{equation} = 0']");
        let text = file(&parameters.join("\n"), PLANE, STILL, &level, &all);
        let Ok(case) = Case::parse(&text, &[]) else { continue };
        let Ok(together) = judge(&case, &Options::default()) else { continue };
        for values in 0..8usize {
            let value = |k: usize| [["2", "3"], ["0", "1"], ["-1", "1"]][k][values >> k & 1];
            let settings: Vec<Setting> = (0..3)
                .map(|k| Setting { name: lists[k].to_string(), value: value(k).to_string() })
                .collect();
            let Ok(fixed) = Case::parse(&text, &settings) else { continue };
            let Ok(alone) = judge(&fixed, &Options::default()) else { continue };
            for (own, one) in together.claims.iter().zip(&alone.claims) {
                let holds = matches!(own.verdict, Verdict::Proved | Verdict::Confirmed);
                proved += usize::from(holds);
                contradicted += usize::from(one.verdict == Verdict::Refuted);
                assert!(
                    !(holds && one.verdict == Verdict::Refuted),
                    "{settings:?}: {}\n{text}",
                    own.name
                );
            }
        }
    }
    assert!(proved > 10 && contradicted > 100, "{proved} hold, {contradicted} are refuted");
}
