//! Surfaces that turn: in the fixed frame they have to be of revolution.

use liouville::case::Case;
use liouville::verdict::{Options, Verdict, judge};

fn read(surface: &str, rotation: &str) -> Result<Case, String> {
    let text = format!(
        "title = 't'\nsystem = 'ball-on-surface'\n[parameters]\nm = '1..2'\nR = '0.1..0.2'\n\"μ\" = '0.5..1'\n\
         \"Ω\" = '1..2'\n[body]\n{surface}\n{rotation}\n[[claim]]\nidentity = \"(γ,r') = 0\"\n"
    );
    Case::parse(&text, &[]).map_err(|error| error.to_string())
}

#[test]
fn a_surface_that_moves_is_refused() {
    let turned = "rotation = 'Ω'";
    for surface in [
        "surface = 'r3 − r1^2 − 2*r2^2'",
        "surface = 'r3 − (r1 − 1)^2 − r2^2'",
        "surface = 'arbitrary'",
        "support = 'sqrt(γ1^2 + 2*γ2^2 + 3*γ3^2)'",
        "support = 'arbitrary'",
    ] {
        let error = read(surface, turned).map(|_| ()).expect_err(surface);
        assert!(error.contains("of revolution"), "{surface}: {error}");
        for other in ["rotation = 'Ω'\nframe = 'rotating'", "rotation = '0'", ""] {
            let case = read(surface, other).unwrap_or_else(|error| panic!("{surface}: {error}"));
            let found = judge(&case, &Options::default()).expect("a report");
            assert_eq!(found.claims[0].verdict, Verdict::Proved, "{surface}, {other}");
        }
    }
    for surface in [
        "surface = 'r3 − r1^2 − r2^2'",
        "surface = 'sqrt(r1^2 + r2^2) − exp(r3)'",
        "profile = 'arbitrary'",
        "support = 'sqrt(γ1^2 + γ2^2 + 3*γ3^2)'",
    ] {
        assert!(read(surface, turned).is_ok(), "{surface}");
    }
}
