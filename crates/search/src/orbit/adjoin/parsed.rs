//! Texts of formulas taken apart at signs that stand outside of brackets.

/// Whether a text is a call or a bracket as a whole.
pub fn is_bracketed(text: &str) -> bool {
    let is_letter = |c: char| c.is_alphabetic() || c == '√';
    let start = text.find('(').filter(|start| text[..*start].chars().all(is_letter));
    start.is_some_and(|start| closes(&text[start..]))
}

/// Whether a text is one name, such as x, γ3, q' or H_1: a power of it needs no brackets.
pub fn is_name(text: &str) -> bool {
    // A component has its index in brackets: q1[2].
    let (name, index) = match text.strip_suffix(']').and_then(|text| text.split_once('[')) {
        Some((name, index)) => (name, index),
        None => (text, ""),
    };
    let is_letter = |letter: char| {
        letter.is_alphanumeric() && !SUPERSCRIPTS.contains(letter) || matches!(letter, '_' | '\'')
    };
    name.chars().all(is_letter) && index.chars().all(|letter| letter.is_ascii_digit())
}

/// Digits of exponents.
const SUPERSCRIPTS: &str = "⁰¹²³⁴⁵⁶⁷⁸⁹";

/// Whether a text is a modulus as a whole.
pub fn is_modulus(text: &str) -> bool {
    text.starts_with('|') && closes(text)
}

/// The text without brackets around all of it.
pub fn unbracketed(text: &str) -> &str {
    let inner = text.strip_prefix('(').and_then(|text| text.strip_suffix(')'));
    inner.filter(|_| closes(text)).unwrap_or(text)
}

/// Splits off a whole exponent.
pub fn base_and_power(factor: &str) -> (&str, i64) {
    let base = factor.trim_end_matches(|letter| SUPERSCRIPTS.contains(letter));
    let value = |letter: char| SUPERSCRIPTS.chars().position(|own| own == letter);
    let digits = factor[base.len()..].chars().filter_map(value);
    let power =
        digits.fold(0i64, |power, digit| power.saturating_mul(10).saturating_add(digit as i64));
    if power > 0 {
        return (base, power);
    }
    let split = factor.rsplit_once('^').and_then(|(base, power)| Some((base, power.parse().ok()?)));
    split.unwrap_or((factor, 1))
}

/// Whether the first bracket is closed by the last letter only.
pub fn closes(text: &str) -> bool {
    let mut depth = Depth::default();
    let last = text.chars().count() - 1;
    for (place, letter) in text.chars().enumerate() {
        depth.pass(letter);
        if depth.open == 0 {
            return place == last;
        }
    }
    false
}

/// Number of open brackets and bars in a text that is passed letter by letter.
#[derive(Default)]
struct Depth {
    open: usize,
    /// Whether a value has ended before the next letter, so that a bar closes.
    is_after_value: bool,
}

impl Depth {
    fn pass(&mut self, letter: char) {
        match letter {
            '(' | '[' => self.open += 1,
            '|' if !self.is_after_value => self.open += 1,
            ')' | ']' | '|' => self.open = self.open.saturating_sub(1),
            _ => {}
        }
        let is_of_value = letter.is_alphanumeric() || matches!(letter, ')' | ']' | '\'' | '_');
        // A bar that opens follows no value, and one that closes follows one.
        if !matches!(letter, ' ' | '|') {
            self.is_after_value = is_of_value;
        }
    }
}

/// Text inside of brackets that enclose all of it.
pub fn inside(text: &str) -> Option<&str> {
    let own = text.strip_prefix('(')?.strip_suffix(')')?;
    closes(text).then_some(own)
}

/// Places outside of brackets at which a letter of a set stands.
fn places(text: &str, letters: &[char]) -> Vec<(usize, char)> {
    let mut depth = Depth::default();
    let mut found = Vec::new();
    for (place, letter) in text.char_indices() {
        depth.pass(letter);
        if depth.open == 0 && letters.contains(&letter) {
            found.push((place, letter));
        }
    }
    found
}

/// Writes a sum; the flag of a term says whether it is subtracted.
pub fn joined<S: AsRef<str>>(terms: impl IntoIterator<Item = (bool, S)>) -> String {
    let mut text = String::new();
    for (is_negative, term) in terms {
        text.push_str(match (is_negative, text.is_empty()) {
            (true, true) => "−",
            (true, false) => " − ",
            (false, true) => "",
            (false, false) => " + ",
        });
        text.push_str(term.as_ref());
    }
    text
}

/// Splits a sum at its signs; the flag says whether a term is subtracted.
pub fn terms(text: &str) -> Vec<(bool, &str)> {
    let mut all = Vec::new();
    let (mut start, mut is_negative) = (0, false);
    for (place, letter) in places(text, &['+', '−', '-']) {
        let before = text[start..place].trim();
        // The sign of an exponent belongs to it.
        if before.ends_with(['*', '/', '^']) {
            continue;
        }
        if !before.is_empty() {
            all.push((is_negative, before));
        }
        is_negative = letter != '+';
        start = place + letter.len_utf8();
    }
    all.push((is_negative, text[start..].trim()));
    all
}

/// Splits a product at its signs; the flag says whether a factor divides.
pub fn factors(text: &str) -> Vec<(bool, &str)> {
    let mut all = Vec::new();
    let (mut start, mut is_below) = (0, false);
    for (place, letter) in places(text, &['*', '/']) {
        all.push((is_below, text[start..place].trim()));
        (start, is_below) = (place + 1, letter == '/');
    }
    all.push((is_below, text[start..].trim()));
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn signs_inside_of_brackets_do_not_divide() {
        assert_eq!(
            terms("a − (b + c)*d − |x − y|"),
            [(false, "a"), (true, "(b + c)*d"), (true, "|x − y|")]
        );
        assert_eq!(terms("−x^−2"), [(true, "x^−2")], "the sign of an exponent");
        assert_eq!(factors("a*(b/c)/|x*y|"), [(false, "a"), (false, "(b/c)"), (true, "|x*y|")]);
        assert_eq!((base_and_power("x²"), base_and_power("f(x)^5")), (("x", 2), ("f(x)", 5)));
        assert_eq!(unbracketed("(a + b)*(c)"), "(a + b)*(c)");
        assert!(is_modulus("|x − |y||") && !is_modulus("|x| − |y|"));
        assert!(is_bracketed("√(x + y)") && !is_bracketed("exp(x)*exp(y)"));
    }
}
