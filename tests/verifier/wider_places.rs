//! Places wider than that of a claim: what it presupposes on its level may fail away from it.

use liouville::case::Case;
use liouville::verdict::{Options, Verdict, judge};

/// Places at which Jacobi's identity of {u,v} = u²v s, {u,w} = −1 is proved on x = z/4, for u = y·f.
fn places(f: &str, s: &str) -> Vec<String> {
    let text = format!(
        "title = 't'\n[state]\nx = '-1..1'\ny = '-1..1'\nz = '1..2'\n[field]\n\"x'\" = '0'\n\"y'\" = '0'\n\"z'\" = '0'\n\
         [level]\nequations = ['x = z/4']\n[variables]\nu = 'y*({f})'\nv = 'x'\nw = 'z'\n\
         [poisson]\n'u,v' = 'u²*v*({s})'\n'u,w' = '-1'\n[[claim]]\njacobi-identity = 'holds'\n"
    );
    let case = Case::parse(&text, &[]).unwrap_or_else(|error| panic!("{error}\n{text}"));
    let report =
        judge(&case, &Options::default()).unwrap_or_else(|error| panic!("{error}\n{text}"));
    let claim = &report.claims[0];
    assert_eq!(claim.verdict, Verdict::Proved, "{f}: {:?}", claim.evidence);
    claim.evidence.holds.iter().map(ToString::to_string).collect()
}

#[test]
fn variables_that_vary_on_a_level_may_obey_a_relation_elsewhere() {
    // u is 0 for x < 0, where the Jacobiator is not 0 off u = 0.
    for f in ["x + abs(x)", "atan(x) + atan(1/x) + π/2"] {
        let found = places(f, "abs(v) - v");
        assert!(!found.iter().any(|place| place.contains("all")), "{f}: {found:?}");
    }
    for f in ["x + 2", "exp(x)"] {
        let found = places(f, "0");
        assert!(found.iter().any(|place| place.contains("all")), "{f}: {found:?}");
    }
}

#[test]
fn maps_that_can_be_inverted_on_a_level_may_not_be_elsewhere() {
    // y → 0 for z < 1/2.
    let places = |factor: &str| {
        let text = format!(
            "title = 't'\n[state]\nx = '-1..1'\ny = '-1..1'\nz = '-2..2'\n[field]\n\"x'\" = '1'\n\"y'\" = '0'\n\
             \"z'\" = '0'\n[level]\nequations = ['z = 1']\n[[claim]]\nsymmetry = {{ y = 'y*({factor})' }}\n"
        );
        let case = Case::parse(&text, &[]).expect("a case");
        let report = judge(&case, &Options::default()).expect("a report");
        assert_eq!(report.claims[0].verdict, Verdict::Proved);
        report.claims[0].evidence.holds.iter().map(ToString::to_string).collect::<Vec<_>>()
    };
    for factor in ["√((z - 1/2)²) + z - 1/2", "exp(ln(z²)/2) + z", "acos(cos(z)) + z"] {
        assert_eq!(places(factor), ["level"], "{factor}");
    }
    assert_eq!(places("exp(z)"), ["everywhere"]);
}

#[test]
fn an_equation_of_which_an_entry_follows_from_others_is_no_place_by_itself() {
    let verdict = |level: &str, claim: &str, place: &str| {
        let text = format!(
            "title = 't'\n[state]\nx = '-2..2'\ny = '-2..2'\nz = '-2..2'\n[field]\n\"x'\" = 'y'\n\"y'\" = '0'\n\
             \"z'\" = '0'\n[level]\nequations = [{level}]\n[[claim]]\n{claim}\nwhere = '{place}'\n"
        );
        let case = Case::parse(&text, &[]).map_err(|error| error.to_string())?;
        let report = judge(&case, &Options::default()).map_err(|error| error.to_string())?;
        Ok::<Verdict, String>(report.claims[0].verdict)
    };
    // z = 0 is left out of y² + z² = 0, of which y = 0 alone would be left.
    for (level, place) in [
        ("'z = 0', 'y² + z² = 0'", "y² + z² = 0"),
        ("'z = 0', '[y, z] = [0, 0]'", "[y, z] = [0, 0]"),
    ] {
        for claim in ["identity = 'z = 0'", "independent = ['x', 'z']"] {
            let found = verdict(level, claim, place);
            assert!(
                found.as_ref().is_err_and(|own| own.contains("not a place")),
                "{claim}: {found:?}"
            );
        }
        assert_eq!(verdict(level, "identity = 'z = 0'", "z = 0"), Ok(Verdict::Proved));
    }
    let other = "'y² + z² = 0', 'x = z'";
    assert_eq!(verdict(other, "identity = 'z = 0'", "y² + z² = 0"), Ok(Verdict::Proved));
}
