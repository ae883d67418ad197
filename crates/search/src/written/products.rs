//! Texts of numbers, and of products and quotients.

use liouville::formula::exponent_text;
use liouville::number::rational::Rational;
use num_bigint::BigInt;
use num_integer::Integer;

use super::super::orbit::parsed::{is_bracketed, is_modulus, is_name};

/// Largest number of decimals of a number.
const MOST_DECIMALS: u32 = 6;

/// A number as a factor.
pub fn assembled_number(number: &Rational) -> String {
    let own = assembled(&number.abs(), &[Vec::new(), Vec::new()]);
    if number.is_negative() { format!("−{own}") } else { own }
}

/// A positive number with decimals, where that is shorter than a fraction.
fn decimal(number: &Rational) -> Option<String> {
    let (above, below) = number.parts();
    for places in 1..=MOST_DECIMALS {
        let scale = BigInt::from(10).pow(places);
        if (&scale % &below) != BigInt::ZERO {
            continue;
        }
        let (whole, rest) = (&above * (&scale / &below)).div_rem(&scale);
        let text = format!("{whole}.{:0>width$}", rest.to_string(), width = places as usize);
        return (text.len() < format!("{above}/{below}").len()).then_some(text);
    }
    None
}

/// A positive number times a product over another.
pub fn assembled(number: &Rational, [above, below]: &[Vec<(String, u32)>; 2]) -> String {
    let (numerator, denominator) = number.parts();
    let one = BigInt::from(1);
    if denominator != one
        && let Some(decimal) = decimal(number)
    {
        let above: Vec<(String, u32)> =
            std::iter::once((decimal, 1)).chain(above.iter().cloned()).collect();
        return assembled(&Rational::from(1), &[above, below.clone()]);
    }
    let is_alone = |count: usize, below: bool| count == 1 && !below;
    let count = |own: &[(String, u32)], value: &BigInt| own.len() + usize::from(*value != one);
    let (upper, lower) = (count(above, &numerator), count(below, &denominator));
    let write = |own: &[(String, u32)], value: &BigInt, alone: bool| -> String {
        let mut texts = Vec::new();
        if *value != one {
            texts.push(value.to_string());
        }
        for (text, power) in own {
            texts.push(match power {
                1 if alone || !is_sum(text) => text.clone(),
                1 => format!("({text})"),
                power => {
                    let is_base =
                        is_name(text) || is_bracketed(text) || is_modulus(text) || is_entry(text);
                    let base = if is_base { text.clone() } else { format!("({text})") };
                    format!("{base}{}", exponent_text(i64::from(*power)))
                }
            });
        }
        texts.join("*")
    };
    let top = match upper {
        0 => "1".to_string(),
        _ => write(above, &numerator, is_alone(upper, lower > 0)),
    };
    match lower {
        0 => top,
        1 => format!("{top}/{}", write(below, &denominator, false)),
        _ => format!("{top}/({})", write(below, &denominator, false)),
    }
}

/// Whether a text has to stand in brackets as a factor.
pub fn is_sum(text: &str) -> bool {
    let mut depth = 0i32;
    let mut before = ' ';
    for letter in text.chars() {
        match letter {
            '(' | '[' => depth += 1,
            ')' | ']' => depth -= 1,
            '+' | '−' | '-' if depth == 0 && before != '^' => return true,
            _ => {}
        }
        before = letter;
    }
    false
}

/// Whether a text is an entry of a vector or matrix.
fn is_entry(text: &str) -> bool {
    let name = text.split_once('[').map(|(name, _)| name);
    name.is_some_and(is_name) && text.ends_with([']', '\''])
}
