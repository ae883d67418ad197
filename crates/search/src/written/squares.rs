//! Sums of squares of differences and sums, such as (x1 − x2)² + (y1 − y2)².

use liouville::number::rational::Rational;
use liouville::proof::Polynomial;

/// Writes a polynomial as a sum of squares (u ± v)² and u², where it is one and some have two terms.
pub fn sum(own: &Polynomial, name: &dyn Fn(u32) -> String) -> Option<String> {
    let one = Rational::from(1);
    let mut squares: Vec<u32> = Vec::new();
    let mut products: Vec<([u32; 2], bool)> = Vec::new();
    for (value, exponents) in own.terms() {
        match exponents {
            [(token, 2)] if *value == one => squares.push(*token),
            [(first, 1), (second, 1)] if value.abs() == Rational::from(2) => {
                products.push(([*first, *second], value.is_negative()));
            }
            _ => return None,
        }
    }
    let mut texts = Vec::new();
    products.sort_unstable();
    for ([first, second], is_negative) in &products {
        for token in [first, second] {
            let place = squares.iter().position(|own| own == token)?;
            squares.remove(place);
        }
        let sign = if *is_negative { "−" } else { "+" };
        texts.push(format!("({} {sign} {})²", name(*first), name(*second)));
    }
    texts.extend(squares.into_iter().map(|token| format!("{}²", name(token))));
    (!products.is_empty()).then(|| texts.join(" + "))
}

/// Whether a polynomial is a sum of such squares, and so never negative.
pub fn is_sum(own: &Polynomial) -> bool {
    sum(own, &|_| String::new()).is_some()
}
