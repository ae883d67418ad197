//! Ranges in notations of other languages, each with the notation of case files.

use crate::number::rational::Rational;

/// Message and remedy for a text that means a range and is written in another form.
///
/// `1-3` is the number −2, and is left to the remarks on a case.
pub fn range(text: &str) -> Option<(String, String)> {
    let number = |text: &str| text.trim().parse::<Rational>().ok();
    if let Some((low, high)) = text.split_once("..") {
        let name = low.rsplit(['(', ',']).next().unwrap_or(low);
        if high.starts_with('.') && number(name).is_some() {
            let high = high.trim_start_matches('.');
            let message = "a range has two points between its ends".to_string();
            return Some((message, format!("write \"{low}..{high}\"")));
        }
        if text.contains('(') {
            return None;
        }
        if low.trim().is_empty() || high.trim().is_empty() {
            let message = "a range has two ends".to_string();
            return Some((message, "write \"0.5..2\"".to_string()));
        }
        let with_points = text.replace(',', ".");
        let (low, high) = with_points.split_once("..")?;
        let is_decimal = text.contains(',') && number(low).is_some() && number(high).is_some();
        return is_decimal.then(|| {
            let message = "a decimal number has a point, not a comma".to_string();
            (message, format!("write \"{with_points}\""))
        });
    }
    if let Some(remedy) = inequality(text) {
        return Some((format!("`{text}` is not a range"), remedy));
    }
    for sign in [" to ", ":", "–", "—", "…", "±"] {
        let Some((left, right)) = text.split_once(sign) else { continue };
        let (Some(a), Some(b)) = (number(left), number(right)) else { continue };
        let (low, high) = match sign {
            "±" => ((&a - &b).to_string(), (&a + &b).to_string()),
            _ => (left.trim().to_string(), right.trim().to_string()),
        };
        let message = format!("`{text}` is not a range");
        return Some((message, format!("write \"{low}..{high}\"")));
    }
    let (whole, digits) = text.split_once(',')?;
    let is_decimal = number(whole).is_some() && digits.chars().all(|c| c.is_ascii_digit());
    (is_decimal && !digits.is_empty()).then(|| {
        let message = "a decimal number has a point, not a comma".to_string();
        (message, format!("write {whole}.{digits}, or a list [{whole}, {digits}]"))
    })
}

/// Range for an inequality such as `0 < a < 1`; of one that is open, an example.
fn inequality(text: &str) -> Option<String> {
    let number = |text: &&str| text.parse::<Rational>().is_ok();
    if text == "positive" {
        return Some("write a range, such as \"0.5..2\"".to_string());
    }
    let is_sign = |c: char| matches!(c, '<' | '>' | '≤' | '≥');
    text.contains(is_sign).then_some(())?;
    let parts: Vec<&str> = text
        .split(|c: char| is_sign(c) || c == '=')
        .map(str::trim)
        .filter(|part| !part.is_empty())
        .collect();
    let is_falling = text.contains(['>', '≥']);
    let ends: Vec<&str> = parts.iter().copied().filter(number).collect();
    match (parts.as_slice(), ends.as_slice()) {
        ([_, _, _], [high, low]) if is_falling => Some(format!("write \"{low}..{high}\"")),
        ([_, _, _], [low, high]) => Some(format!("write \"{low}..{high}\"")),
        ([_] | [_, _], [_]) => Some("write a range with two ends, such as \"0.5..2\"".to_string()),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_of_other_languages_are_rewritten() {
        let written = |text: &str| range(text).map(|(_, remedy)| remedy);
        for text in ["1 to 3", "1:3", "1–3", "1…3"] {
            assert_eq!(written(text).as_deref(), Some("write \"1..3\""), "{text}");
        }
        assert_eq!(written("1...3").as_deref(), Some("write \"1..3\""));
        assert_eq!(written("1 ± 1/2").as_deref(), Some("write \"0.5..1.5\""));
        assert_eq!(written("0,5..2").as_deref(), Some("write \"0.5..2\""));
        assert_eq!(written("0,5").as_deref(), Some("write 0.5, or a list [0, 5]"));
        assert_eq!(written("1..").as_deref(), Some("write \"0.5..2\""));
        for text in ["0 < a < 1", "0<=a<=1", "1 > a > 0", "0 ≤ a ≤ 1"] {
            assert_eq!(written(text).as_deref(), Some("write \"0..1\""), "{text}");
        }
        for text in [">0", "a > 0", "0 < a", "positive"] {
            assert!(written(text).is_some_and(|help| help.contains("\"0.5..2\"")), "{text}");
        }
        for text in ["1..3", "1-3", "vector(5, -1..1)", "vec(1,2,3)", "m*R", "sum(i, 1..n, a[i])"] {
            assert_eq!(written(text), None, "{text}");
        }
    }
}
