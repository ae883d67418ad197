//! Poles of densities, planted and found.

use liouville::case::Case;
use liouville::verdict::{ClaimReport, Flaw, Options, Verdict, judge};

/// Judges densities of a field of x, y.
fn densities(ranges: [&str; 2], rates: [&str; 2], densities: &[String]) -> Vec<ClaimReport> {
    let claims: String =
        densities.iter().map(|own| format!("[[claim]]\ndensity = '{own}'\n")).collect();
    let text = format!(
        "title = 't'\n[parameters]\nk = '1..2'\n[state]\nx = '{}'\ny = '{}'\n[field]\nx = '{}'\n\
         y = '{}'\n{claims}",
        ranges[0], ranges[1], rates[0], rates[1]
    );
    let case = Case::parse(&text, &[]).unwrap_or_else(|error| panic!("{error}\n{text}"));
    judge(&case, &Options::default()).unwrap_or_else(|error| panic!("{error}\n{text}")).claims
}

#[test]
fn planted_poles_are_found_and_no_others() {
    for [a, b] in [["0", "0"], ["1/2", "−1"], ["−1.3", "k/2"]] {
        let square = format!("((x − {a})² + (y − {b})²)");
        let rates = [format!("−(y − ({b}))"), format!("x − ({a})")];
        let rates = [rates[0].as_str(), rates[1].as_str()];
        let infinite = ["1/S", "S^(−3/2)", "1/(S − 1)²", "(S − 1)^(−4)", "(2 + S)/(S*(1 + S))"];
        // S^(−1/2) is infinite at a point, |S − 1|^(−1/2) on a circle: both can be integrated.
        let finite = [
            "S^(−1/2)",
            "((S − 1)²)^(−1/4)",
            "1/(S + 1/1000)",
            "1/√(1 + S)",
            "e^(−1/S)",
            "(S + 1)/(S + 2)",
            "e^(−S)",
            "S²",
        ];
        for (all, is_infinite) in [(&infinite[..], true), (&finite[..], false)] {
            let all: Vec<String> = all.iter().map(|own| own.replace('S', &square)).collect();
            for claim in densities(["-2..2", "-2..2"], rates, &all) {
                let (name, evidence) = (&claim.name, &claim.evidence);
                assert_eq!(claim.verdict, Verdict::Proved, "{name}");
                assert_eq!(evidence.has(Flaw::Infinite), is_infinite, "{name}: {evidence:?}");
                let remark = evidence.remark.as_deref().unwrap_or_default();
                assert_eq!(remark.contains("ρ is infinite"), is_infinite, "{name}: {remark}");
            }
        }
    }
}

#[test]
fn poles_outside_of_the_ranges_do_not_count() {
    let (rates, density) = (["x*(1 − x)", "−y"], ["(1 − x)^(−2)".to_string()]);
    for (range, is_infinite) in [("0.5..2", true), ("1.5..2", false), ("-1..0.75", false)] {
        let found = densities([range, "-2..2"], rates, &density);
        assert_eq!(found[0].evidence.has(Flaw::Infinite), is_infinite, "x in {range}");
    }
}

#[test]
fn where_the_field_is_infinite_its_domain_ends() {
    let densities_of = |rate: &str| {
        let found = densities(["-2..2", "-2..2"], ["0*x", rate], &["1/x²".to_string()]);
        assert_eq!(found[0].verdict, Verdict::Proved, "it does not depend on y");
        found[0].evidence.has(Flaw::Infinite)
    };
    assert!(!densities_of("1/x"), "no motion is at x = 0");
    assert!(densities_of("x"), "rests are");
}

/// Whether a density of a field of x, y, z is seen to be infinite.
fn is_infinite(parameters: &str, rates: [&str; 3], density: &str) -> bool {
    let text = format!(
        "title = 't'\n[parameters]\n{parameters}\n[state]\nx = '-2..2'\ny = '-2..2'\nz = '-2..2'\n\
         [field]\nx = '{}'\ny = '{}'\nz = '{}'\n[[claim]]\ndensity = '{density}'\n",
        rates[0], rates[1], rates[2]
    );
    let case = Case::parse(&text, &[]).unwrap_or_else(|error| panic!("{error}\n{text}"));
    let report =
        judge(&case, &Options::default()).unwrap_or_else(|error| panic!("{error}\n{text}"));
    assert_eq!(report.claims[0].verdict, Verdict::Proved, "{density}");
    report.claims[0].evidence.has(Flaw::Infinite)
}

#[test]
fn poles_at_points_and_lines_are_found_in_space() {
    // Each is of degree −3, so that it is a density, and none can be integrated about 0.
    for density in [
        "(x² + y² + z²)^(−3/2)",
        "(x² + x*y + 2*y² + 3*z²)^(−3/2)",
        "(x⁴ + y⁴ + z⁴)^(−3/4)",
        "((x + y)² + (y − z)²)^(−3/2)",
        "(x − y + z)^(−3)",
    ] {
        assert!(is_infinite("", ["−x", "−y", "−z"], density), "{density}");
    }
}

#[test]
fn poles_for_one_of_several_exponents_are_found() {
    let turn = ["y", "−x", "0*z"];
    let density = "(x² + y²)^(−b/2)";
    assert!(is_infinite("b = 'one of 0, 1, 3'", turn, density), "for b = 3");
    assert!(!is_infinite("b = 'one of 0, 1'", turn, density), "1/|x| can be integrated");
}

#[test]
fn poles_of_each_factor_are_sought() {
    // A sink at (1, 0): the density is infinite on x = 1, however its product is written.
    let all =
        ["1/(y*|x − 1|)", "1/|y*(x − 1)|", "1/(y*√((x − 1)²))", "1/y/|x − 1|"].map(String::from);
    for claim in densities(["-2..2", "0.5..2"], ["1 − x", "−y"], &all) {
        assert_eq!(claim.verdict, Verdict::Proved, "{}", claim.name);
        assert_eq!(claim.evidence.flaws, [Flaw::Infinite], "{}", claim.name);
    }
}
