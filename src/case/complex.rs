//! Complex numbers in lists; `a ± b*i` is a pair of conjugate numbers.

use super::error::{Mistake, Problem};
use super::formulas::formula;
use super::section::SpannedStr;
use crate::claim::ComplexFormula;
use crate::formula::{Formula, Type};
use crate::mechanics::{Dependence, Vocabulary};

/// Signs between real and imaginary part.
const SIGNS: [&str; 2] = ["±", "+/-"];

/// Reads `a`, or `a ± b*i`, where a may be left out.
pub fn read(text: &SpannedStr, names: &Vocabulary) -> Result<ComplexFormula, Mistake> {
    let written = text.value.as_str();
    let sign = SIGNS.iter().find_map(|sign| Some((written.find(sign)?, sign.len())));
    let Some((place, length)) = sign else { return Ok((scalar(text, names)?, None)) };
    let behind = place + length;
    let (real, imaginary) = (written[..place].trim(), written[behind..].trim());
    let Some(factor) = factor_of_i(imaginary).filter(|factor| !is_sum(factor)) else {
        let message = "the term after ± is not a multiple of i".to_string();
        let remedy = "write a ± b*i for two conjugate numbers, and list two real ones separately"
            .to_string();
        let span = text.locate(behind..written.len());
        return Err(Mistake::at(span, Problem::Other { message, remedy }));
    };
    let part = |written: &str, range| {
        let written = if written.is_empty() { "0" } else { written };
        scalar(&SpannedStr::made(written.to_string(), text.locate(range)), names)
    };
    Ok((part(real, 0..place)?, Some(part(factor, behind..text.value.len())?)))
}

/// Reads the factor b of `b*i`, which is 1 for `i`.
fn factor_of_i(text: &str) -> Option<&str> {
    if text == "i" {
        return Some("1");
    }
    let times = ['*', '·'];
    let before = |text: &'_ str| text.trim_end().strip_suffix(times).map(|b| b.trim_end().len());
    let behind =
        |text: &'_ str| text.trim_start().strip_prefix(times).map(|b| b.trim_start().len());
    match (text.strip_suffix('i').and_then(before), text.strip_prefix('i').and_then(behind)) {
        (Some(length), _) => Some(&text[..length]),
        (None, Some(length)) => Some(&text[text.len() - length..]),
        (None, None) => None,
    }
}

/// Whether a text has a sign between two terms outside of brackets: `1 + 2*i` is not 3 i.
fn is_sum(text: &str) -> bool {
    let letters: Vec<char> = text.chars().filter(|letter| !letter.is_whitespace()).collect();
    let (mut depth, mut is_in_bars) = (0, false);
    letters.iter().enumerate().any(|(place, letter)| {
        match letter {
            '(' | '[' => depth += 1,
            ')' | ']' => depth -= 1,
            '|' => is_in_bars = !is_in_bars,
            _ => {}
        }
        // A sign of its own stands first, or behind another sign, as in 2*−3; 1e-3 is a number.
        let is_number =
            |before: &[char]| matches!(before, [.., d, 'e' | 'E'] if d.is_ascii_digit());
        let is_between = match letters[..place].last() {
            None => false,
            Some(before) => !"+-−*·/^".contains(*before) && !is_number(&letters[..place]),
        };
        "+-−±".contains(*letter) && depth == 0 && !is_in_bars && is_between
    })
}

fn scalar(text: &SpannedStr, names: &Vocabulary) -> Result<Formula, Mistake> {
    formula(text, names, "an entry", Some(Type::Scalar), Dependence::Phase)
}
