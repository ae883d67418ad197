//! Exponentials e^u and e^(−u) as cosh u and sinh u, where a file has such functions.

use liouville::number::rational::Rational;
use liouville::proof::{MOST_POLYNOMIAL_WORK, Polynomial};

use super::fraction::Fraction;
use super::reader::Reader;

/// The fraction in hyperbolic functions; `None` if it is none in these, or if the file has none.
pub fn turned(reader: &mut Reader<'_>, own: &Fraction) -> Option<Fraction> {
    if !reader.named.has_hyperbolic() {
        return None;
    }
    let mut tokens = own.above.variables();
    tokens.extend(own.below.variables());
    tokens.sort_unstable();
    tokens.dedup();
    let argument = |text: &str| Some(text.strip_prefix("exp(")?.strip_suffix(')')?.to_string());
    let mut open = Vec::new();
    for token in tokens {
        if let Some(argument) = argument(reader.tokens.text(token)) {
            open.push((token, argument));
        }
    }
    let mut found: Option<Fraction> = None;
    while let Some((token, argument)) = open.pop() {
        let mut partner = None;
        for (place, (_, other)) in open.iter().enumerate() {
            if reader.read(&format!("({argument}) + ({other})"))?.above.is_zero() {
                partner = Some(place);
                break;
            }
        }
        let partner = partner.map(|place| open.remove(place));
        let rank = |text: &str| (text.starts_with(['−', '-']), text.to_string());
        let (exponential, argument, inverse) = match partner {
            Some((other, text)) if rank(&text) < rank(&argument) => (other, text, Some(token)),
            Some((other, _)) => (token, argument, Some(other)),
            None => (token, argument, None),
        };
        let before = found.as_ref().unwrap_or(own).clone();
        if let Some(next) = turned_in(reader, &before, (exponential, inverse), &argument) {
            found = Some(next);
        }
    }
    found
}

/// The fraction in hyperbolic functions of one argument.
fn turned_in(
    reader: &mut Reader<'_>,
    own: &Fraction,
    (exponential, inverse): (u32, Option<u32>),
    argument: &str,
) -> Option<Fraction> {
    let (above, upper) = centred(&own.above, exponential, inverse)?;
    let (below, lower) = centred(&own.below, exponential, inverse)?;
    // Powers of e^u that are left over have no place in such functions.
    if upper != lower {
        return None;
    }
    let above = in_functions(reader, &above, argument)?;
    let below = in_functions(reader, &below, argument)?;
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
