//! Exponentials e^u and e^(−u) as cosh u and sinh u, where a file has such functions.

use liouville::number::rational::Rational;
use liouville::proof::{MOST_POLYNOMIAL_WORK, Polynomial};

use super::fraction::Fraction;
use super::reader::Reader;

/// The fraction in hyperbolic functions of one argument; `None` if it is none, or if the file has none.
pub fn turned(reader: &mut Reader<'_>, own: &Fraction) -> Option<Fraction> {
    if !reader.named.has_hyperbolic() {
        return None;
    }
    let mut tokens = own.above.variables();
    tokens.extend(own.below.variables());
    tokens.sort_unstable();
    tokens.dedup();
    let argument = |text: &str| Some(text.strip_prefix("exp(")?.strip_suffix(')')?.to_string());
    let mut exponentials = Vec::new();
    for token in tokens {
        if let Some(argument) = argument(reader.tokens.text(token)) {
            exponentials.push((token, argument));
        }
    }
    let (first, inverse) = match exponentials.as_slice() {
        [one] => (one.clone(), None),
        [one, other] => {
            let sum = reader.read(&format!("({}) + ({})", one.1, other.1))?;
            if !sum.above.is_zero() {
                return None;
            }
            let is_negative = |text: &str| text.starts_with(['−', '-']);
            let (one, other) = if is_negative(&one.1) { (other, one) } else { (one, other) };
            (one.clone(), Some(other.0))
        }
        _ => return None,
    };
    let (exponential, argument) = first;
    let (above, upper) = centred(&own.above, exponential, inverse)?;
    let (below, lower) = centred(&own.below, exponential, inverse)?;
    // Powers of e^u that are left over have no place in such functions.
    if upper != lower {
        return None;
    }
    let above = in_functions(reader, &above, &argument)?;
    let below = in_functions(reader, &below, &argument)?;
    Fraction { above, below }.reduced()
}

/// Coefficients of e^(k u), with the exponent of e^u by which they are divided to have k from −n to n.
type Centred = (Vec<(i64, Polynomial)>, i64);

fn centred(own: &Polynomial, exponential: u32, inverse: Option<u32>) -> Option<Centred> {
    let mut all: Vec<(i64, Polynomial)> = Vec::new();
    let mut add = |power: i64, part: Polynomial| match all.iter_mut().find(|(k, _)| *k == power) {
        Some((_, sum)) => *sum = sum.plus(&part),
        None => all.push((power, part)),
    };
    for (power, part) in own.by_powers(exponential) {
        match inverse {
            None => add(i64::from(power), part),
            Some(inverse) => part
                .by_powers(inverse)
                .into_iter()
                .for_each(|(other, part)| add(i64::from(power) - i64::from(other), part)),
        }
    }
    all.retain(|(_, part)| !part.is_zero());
    let (least, most) = (all.iter().map(|own| own.0).min()?, all.iter().map(|own| own.0).max()?);
    if (least + most) % 2 != 0 {
        return None;
    }
    let middle = (least + most) / 2;
    all.iter_mut().for_each(|(power, _)| *power -= middle);
    Some((all, middle))
}

/// Σ c_k e^(k u) with cosh k u and sinh k u.
fn in_functions(
    reader: &mut Reader<'_>,
    own: &[(i64, Polynomial)],
    argument: &str,
) -> Option<Polynomial> {
    let coefficient = |power: i64| {
        own.iter().find(|(k, _)| *k == power).map(|(_, part)| part.clone()).unwrap_or_default()
    };
    let most = own.iter().map(|(power, _)| power.abs()).max()?;
    let mut sum = coefficient(0);
    for power in 1..=most {
        let (plus, minus) = (coefficient(power), coefficient(-power));
        let multiple = match power {
            1 => argument.to_string(),
            _ if argument.contains(' ') => format!("{power}*({argument})"),
            _ => format!("{power}*{argument}"),
        };
        let parts =
            [("cosh", plus.plus(&minus)), ("sinh", plus.plus(&minus.scaled(&Rational::from(-1))))];
        for (name, part) in parts {
            if part.is_zero() {
                continue;
            }
            let token = reader.tokens.of(&format!("{name}({multiple})"))?;
            sum =
                sum.plus(&part.times(&Polynomial::variable(token), &mut { MOST_POLYNOMIAL_WORK })?);
        }
    }
    Some(sum)
}
