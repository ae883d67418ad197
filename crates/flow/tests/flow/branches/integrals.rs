//! Families of closed orbits of fields with claimed integrals.

use liouville_flow::{Coordinate, Fixed, FlowError};

use super::{Wish, follow, parse};

/// Duffing's oscillator as a field and as a Hamiltonian, whose periods fall with the energy.
fn oscillator(system: &str, claim: &str) -> liouville::case::Case {
    parse(&format!("title = 'a'\n[state]\nx = '-2..2'\ny = '-2..2'\n{system}\n{claim}"))
}

const FIELD: &str = "[field]\n\"x'\" = 'y'\n\"y'\" = '-x - x^3'";
const HAMILTONIAN: &str = "[hamiltonian]\nfunction = 'y^2/2 + x^2/2 + x^4/4'\npairs = [['x', 'y']]";
const CLAIMS: &str = "[[claim]]\nname = 'J'\nintegral = 'y^2 + x^2 + x^4/2'\n\
     [[claim]]\nname = 'K'\nintegral = 'y^2 + x^2'\nexpect = 'open'\n";

fn wish<'w>(varied: &'w str, range: [&'w str; 2]) -> Wish<'w> {
    Wish { surface: "x = 0", axes: "y", start: "x=0 y=1", varied, range }
}

#[test]
fn a_claimed_integral_is_held_and_varies_like_an_energy() {
    let field = oscillator(FIELD, CLAIMS);
    let found = follow(&field, &wish("J", ["1/2", "4"])).expect("a branch");
    let hamiltonian = oscillator(HAMILTONIAN, "");
    let expected = follow(&hamiltonian, &wish("energy", ["1/4", "2"])).expect("a branch");
    for (found, expected) in [
        (found.points.first(), expected.points.first()),
        (found.points.last(), expected.points.last()),
    ] {
        let (found, expected) = (found.expect("a point"), expected.expect("a point"));
        assert!((found.value - 2.0 * expected.value).abs() < 1e-13, "J = 2E: {found:?}");
        let gap = found.period.value - expected.period.value;
        assert!(gap.abs() < 1e-12, "{gap:e}");
        assert!(found.multipliers.is_empty(), "no multipliers besides 1: {found:?}");
    }
}

#[test]
fn an_orbit_of_a_family_without_a_proved_integral_is_degenerate() {
    let field = oscillator(FIELD, "");
    let found = follow(&field, &Wish { varied: "energy", ..wish("energy", ["1/4", "2"]) });
    assert!(matches!(found, Err(FlowError::Degenerate(_))), "{:?}", found.err());
}

#[test]
fn names_and_values_that_cannot_be_fixed_are_refused() {
    let field = oscillator(FIELD, CLAIMS);
    for (text, message) in [
        ("J", "`J` has no `=`"),
        ("J=x", "`J=x` has no number behind `=`"),
        ("H=1", "the case claims no scalar integral `H`"),
        ("K=1", "it is not proved that the motions keep `K`"),
        ("energy=1", "the case claims no scalar integral `energy`"),
    ] {
        let mistake = Fixed::read(&field, text).err().map(|mistake| mistake.message);
        assert_eq!(mistake.as_deref(), Some(message), "{text}");
    }
    assert!(Fixed::read(&field, "J = 3/2").is_ok());
    let mistake = Coordinate::of_branch(&field, "K").expect_err("K is not proved");
    assert_eq!(mistake.message, "it is not proved that the motions keep `K`");
    let mistake = Coordinate::of_branch(&field, "M").expect_err("there is no M");
    assert_eq!(
        (mistake.message.as_str(), mistake.help.as_str()),
        ("there is no `M` to vary", "vary J, or K")
    );
}
