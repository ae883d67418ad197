//! Tests of reconstruction and of the text of coefficients.

use super::numbers::fraction;
use super::*;
use liouville::case::Case;
use num_traits::One;

#[test]
fn large_fractions_come_from_several_primes() {
    let modulus: BigInt = (BigInt::one() << 127u32) - 1u32;
    let (above, below) = (BigInt::from(-123_456_789_012_345i64), BigInt::from(987_654_321_989i64));
    let inverse = below.modinv(&modulus).expect("prime to it");
    let residue = (&above * inverse).mod_floor(&modulus);
    assert_eq!(fraction(&residue, &modulus), Some((above, below)));
}

#[test]
fn coefficients_read_well() {
    let case = Case::parse(
        "title='t'\nsystem='field'\n[state]\na='1..2'\nb='1..2'\nx='1..2'\ny='1..2'\nz='1..2'\n\
         [field]\na='1'\nb='1'\nx='1'\ny='1'\nz='1'\n",
        &[],
    )
    .expect("a case");
    let f = |text: &str| case.formula(text).expect("a formula");
    let over = |text: &str, below: Option<&str>| Ratio { above: f(text), below: below.map(f) };
    let names = vec![f("a"), f("b")];
    let one = |a: [u32; 2], value: i64| (a.to_vec(), BigInt::from(value));
    let polynomials =
        vec![vec![one([1, 0], 2)], Vec::new(), vec![one([0, 0], -4), one([0, 2], -6)]];
    let coefficients = PrimitiveVector { names, polynomials }.reduced();
    let text = |functions: [Ratio; 3]| {
        let sum = coefficients.sum(&[0, 1, 2], &functions).expect("scalars");
        sum.expect("it is not empty").to_string()
    };
    let plain = [over("x", None), over("y", None), over("1", None)];
    assert_eq!(text(plain), "−a*x + (2 + 3*b²)");
    let ratios = [over("1", Some("x")), over("y", None), over("1", Some("z²"))];
    assert_eq!(text(ratios), "−a/x + (2 + 3*b²)/z²");
}
