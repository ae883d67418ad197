//! Errors of TOML syntax, with places and corrections.

use std::collections::BTreeSet;

use super::error::{Mistake, Problem};

/// Number of mistakes shown: one bracket that is not closed makes a mistake of every line below it.
const SHOWN: usize = 20;

/// Mistakes of a text that is not valid TOML, at most one for each line; the first ones, and the
/// number of the others.
pub fn mistakes(text: &str, errors: &[toml::de::Error]) -> Vec<Mistake> {
    let starts: Vec<usize> = text.match_indices('\n').map(|(at, _)| at + 1).collect();
    let mut lines = BTreeSet::new();
    // one slip makes several errors on its line
    let mut firsts = errors.iter().filter(|error| {
        let line = error.span().map(|span| starts.partition_point(|start| *start <= span.start));
        lines.insert(line)
    });
    let mut all: Vec<Mistake> = firsts.by_ref().take(SHOWN).map(|e| mistake(text, e)).collect();
    if let Some(next) = firsts.next() {
        let more = 1 + firsts.count();
        let lines = if more == 1 { "line is" } else { "lines are" };
        let message = format!("{more} more {lines} not valid TOML");
        let help = Some("mend the mistakes above: others follow from them".to_string());
        all.push(Mistake::new(next.span(), Problem::Toml { message, help }));
    }
    all
}

fn mistake(text: &str, error: &toml::de::Error) -> Mistake {
    let span = error.span();
    let help = match error.message() {
        "duplicate key" => Some("remove one of the two, or give it another name".to_string()),
        _ => span.as_ref().and_then(|span| help(text, span.start)),
    };
    let message = reworded(error.message(), help.as_deref());
    Mistake::new(span, Problem::Toml { message, help })
}

/// Suggested correction of the line at a place.
fn help(text: &str, place: usize) -> Option<String> {
    let before = text.get(..place)?;
    let start = before.rfind('\n').map_or(0, |at| at + 1);
    let line = text[start..].lines().next()?;
    let place = place - start;
    if let Some(table) = line.trim().strip_prefix('[') {
        let name = table.trim_matches(['[', ']', ' ']);
        let is_name = !name.is_empty() && !name.contains([',', '=', '"', '\'']);
        return is_name.then(|| match table.starts_with('[') {
            true => format!("write [[{name}]] on a line of its own"),
            false => format!("write [{name}] on a line of its own"),
        });
    }
    if line.contains(['“', '”', '„', '‘', '«', '»']) {
        return Some("write straight quotes: \"…\"".to_string());
    }
    let Some((key, value)) = parts(line) else {
        let is_foreign = line.trim_start().starts_with(['{', '<', '}']);
        return Some(match is_foreign {
            true => "a case file is TOML: `liouville new` writes one".to_string(),
            false => "write key = \"value\"".to_string(),
        });
    };
    let is_open = |quote: char| value.starts_with(quote) && value.matches(quote).count() == 1;
    if is_open('"') || is_open('\'') {
        return Some(format!("close the quotes: {key} = {value}{}", &value[..1]));
    }
    if let Some((whole, digits)) = value.split_once(',')
        && [whole, digits].iter().all(|part| part.parse::<u64>().is_ok())
    {
        return Some(format!("a decimal number has a point: {key} = {whole}.{digits}"));
    }
    let bare = |c: char| c.is_ascii_alphanumeric() || matches!(c, '-' | '_' | '.');
    let is_quoted = |text: &str| text.starts_with(['"', '\'']);
    let key_is_wrong = !is_quoted(key) && !key.chars().all(bare);
    let is_table = value.starts_with(['[', '{']);
    let is_plain = value.parse::<f64>().is_ok() || matches!(value, "true" | "false");
    let value_is_wrong = !is_quoted(value) && !is_table && !is_plain && !value.is_empty();
    if let Some(name) = key.strip_prefix('d').and_then(|rest| rest.strip_suffix("/dt")) {
        return Some(format!("a rate is written \"{name}'\" = \"…\""));
    }
    let quoted = |text: &str| format!("\"{}\"", text.trim().trim_matches('"'));
    match (key_is_wrong, value_is_wrong) {
        (true, false) if key.chars().all(|c| bare(c) || c.is_alphabetic()) => Some(
            "a key that is not ASCII is quoted: \"μ\" = …; or write the letter's name: mu = …"
                .to_string(),
        ),
        (true, false) => Some(format!("quote the key: {} = {value}", quoted(key))),
        (true, true) => Some(format!("quote both: {} = {}", quoted(key), quoted(value))),
        (false, true) => Some(format!("quote the value: {key} = {}", quoted(value))),
        (false, false) if value.is_empty() && place >= key.len() => {
            Some(format!("write a value: {key} = \"…\""))
        }
        (false, false) => None,
    }
}

/// Message of the TOML reader in the words of case files.
fn reworded(message: &str, help: Option<&str>) -> String {
    let quotes = help.is_some_and(|help| help.starts_with("quote"));
    let word = match message {
        "duplicate key" => "this key is given already in this table",
        _ if message.starts_with("string values must be quoted")
            && help.is_some_and(|help| help.starts_with("write a value")) =>
        {
            "this key has no value"
        }
        _ if message.starts_with("string values must be quoted")
            || message.starts_with("invalid fraction") && quotes =>
        {
            "this value needs quotes"
        }
        _ if message.starts_with("invalid unquoted key") => "this key needs quotes",
        _ if help.is_some_and(|help| help.starts_with("close the quotes")) => {
            "these quotes are not closed"
        }
        _ if help.is_some_and(|help| help.starts_with("a decimal number")) => {
            "a comma cannot stand in a number"
        }
        _ => message,
    };
    word.to_string()
}

/// Key and value of a line, without a comment.
fn parts(line: &str) -> Option<(&str, &str)> {
    let (mut quote, mut equals) = (None, None);
    let mut end = line.len();
    for (place, letter) in line.char_indices() {
        match (quote, letter) {
            (Some(open), _) if open == letter => quote = None,
            (Some(_), _) => {}
            // the prime of an unquoted key opens no string
            (None, '\'') if equals.is_none() && !line[..place].trim().is_empty() => {}
            (None, '"' | '\'') if equals.is_none() || line[..place].trim_end().ends_with('=') => {
                quote = Some(letter);
            }
            (None, '=') if equals.is_none() => equals = Some(place),
            (None, '#') => {
                end = place;
                break;
            }
            _ => {}
        }
    }
    let equals = equals?;
    Some((line[..equals].trim(), line[equals + 1..end].trim()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_bracket_that_is_not_closed_makes_few_mistakes() {
        let found = |text: &str| {
            let (_, errors) = toml::de::DeTable::parse_recoverable(text);
            mistakes(text, &errors)
        };
        let open = |lines: usize| format!("x = [1, 2\n{}", "y = 3\n".repeat(lines));
        assert_eq!(found(&open(SHOWN)).len(), SHOWN, "all of them");
        let many = found(&open(1000));
        assert_eq!(many.len(), SHOWN + 1, "the first, and the number of the others");
        let last = many.last().expect("some").problem.to_string();
        assert_eq!(last, format!("{} more lines are not valid TOML", 1000 - SHOWN));
    }

    #[test]
    fn slips_of_a_line_are_mended() {
        let mended = |line: &str| help(line, 0).unwrap_or_default();
        assert_eq!(mended("x' = \"y\""), "quote the key: \"x'\" = \"y\"");
        assert_eq!(mended("x' = y − x"), "quote both: \"x'\" = \"y − x\"");
        assert_eq!(mended("x = -2..2   # a range"), "quote the value: x = \"-2..2\"");
        assert_eq!(mended("integral = energy"), "quote the value: integral = \"energy\"");
        assert_eq!(mended("\"x'\" = y"), "quote the value: \"x'\" = \"y\"");
        assert_eq!(mended("a = \"x"), "close the quotes: a = \"x\"");
        assert_eq!(mended("m = 0,5"), "a decimal number has a point: m = 0.5");
        assert_eq!(mended("[[claim]"), "write [[claim]] on a line of its own");
        assert_eq!(mended("title = “Top”"), "write straight quotes: \"…\"");
        assert!(mended("μ = 1").contains("the letter's name"), "{}", mended("μ = 1"));
        assert_eq!(help("title = ", 8).as_deref(), Some("write a value: title = \"…\""));
        assert_eq!(help("x = [1, 2", 4), None, "nothing can be told");
    }
}
