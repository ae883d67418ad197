//! Coefficients that vanish modulo a prime that seed 1 drew whatever the statement was.

use super::relations::THIRD;
use super::{Verdict, field, only};

#[test]
fn a_leading_coefficient_that_vanishes_modulo_a_prime_hides_no_integral() {
    // The numbers are primes that were drawn with seed 1 whatever the statement was: z is an
    // integral of degree 1 that is no polynomial in the known one.
    for prime in ["1786240337854321847", "1633856596546501343", "1504571051129808743"] {
        let report = only(&format!(
            "title = 't'\n[state]\nx = '-2..2'\ny = '-2..2'\nz = '-2..2'\n[field]\n\"x'\" = 'y'\n\
             \"y'\" = 'x^2 + z'\n\"z'\" = '0'\n[[claim]]\nname = 'F'\n\
             integral = 'z + {prime}*z^2'\n[[claim]]\nno-integral = {{ degree = 1 }}\n"
        ));
        assert_ne!(report.verdict, Verdict::Proved, "{prime}: {:?}", report.evidence);
    }
}

#[test]
fn a_factor_with_the_primes_of_a_seed_is_not_lost() {
    // Modulo these numbers, which seed 1 drew whatever the field was, 1 + p x is a constant.
    for prime in ["1786240337854321847", "1633856596546501343", "1504571051129808743"] {
        let rates = [
            format!("(1 + {prime}*x)*(y + 2)"),
            "x*z + y^2 - 3".to_string(),
            "x*y - z^2 + x".to_string(),
        ];
        let report = only(&field(rates, THIRD));
        assert_ne!(report.verdict, Verdict::Proved, "{prime}: {:?}", report.evidence);
    }
}
