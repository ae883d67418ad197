//! The command `liouville explain`: the words of reports.

use clap::Args;

use super::CommandOutput;

#[derive(Debug, Args)]
pub struct Explain {
    /// Word of a report, such as confirmed, witness or "level set"; all words by default
    pub word: Vec<String>,
}

/// The page of concepts: paragraphs that begin with a word in bold.
const CONCEPTS: &str = include_str!("../../../../docs/concepts.md");

/// A word with its explanation.
struct Explanation {
    word: &'static str,
    text: String,
}

pub fn run(options: &Explain) -> Result<CommandOutput, String> {
    let entries = entries();
    let words = || entries.iter().map(|entry| entry.word).collect::<Vec<_>>();
    if options.word.is_empty() {
        let text = format!("{}\n", words().join("\n"));
        return Ok(CommandOutput { text, code: 0 });
    }
    let asked = options.word.join(" ").to_lowercase();
    let by_word: Vec<&Explanation> =
        entries.iter().filter(|entry| entry.word.to_lowercase() == asked).collect();
    let emphasised = format!("*{asked}*");
    let is_defined = |entry: &&Explanation| entry.text.to_lowercase().contains(&emphasised);
    let found = match (by_word.is_empty(), entries.iter().find(is_defined)) {
        (false, _) => by_word,
        (true, Some(entry)) => vec![entry],
        (true, None) => entries.iter().filter(|entry| has_word(&entry.text, &asked)).collect(),
    };
    if found.is_empty() {
        return Err(format!(
            "error: no glossary entry for `{asked}`\nhelp: entries: {}",
            words().join(", ")
        ));
    }
    let texts: Vec<String> = found.iter().map(|entry| plain(&entry.text)).collect();
    Ok(CommandOutput { text: texts.join("\n") + "\n", code: 0 })
}

/// Splits the page into its words and their explanations.
fn entries() -> Vec<Explanation> {
    let mut entries: Vec<Explanation> = Vec::new();
    for line in CONCEPTS.lines() {
        let word = line.strip_prefix("**").and_then(|rest| rest.split_once(".**"));
        match (word, entries.last_mut()) {
            (Some((word, rest)), _) => {
                let text = format!("{word}.{rest}\n");
                entries.push(Explanation { word, text });
            }
            (None, Some(_)) if line.starts_with("More: ") => break,
            (None, Some(entry)) if !line.starts_with("```") && !line.starts_with('#') => {
                entry.text.push_str(line);
                entry.text.push('\n');
            }
            _ => {}
        }
    }
    for entry in &mut entries {
        let end = entry.text.trim_end().len();
        entry.text.truncate(end);
        entry.text.push('\n');
    }
    entries
}

/// Removes the marks of Markdown.
fn plain(text: &str) -> String {
    let text = text.replace("**", "").replace('`', "");
    let (mut out, mut rest) = (String::new(), text.as_str());
    // An emphasised word is between stars; stars of products stay.
    while let Some((before, after)) = rest.split_once('*') {
        out.push_str(before);
        rest = match after.split_once('*') {
            Some((inner, behind)) if is_emphasised(inner) => {
                out.push_str(inner);
                behind
            }
            _ => {
                out.push('*');
                after
            }
        };
    }
    out + rest
}

fn is_emphasised(text: &str) -> bool {
    text.len() > 2 && text.chars().all(|c| c.is_alphanumeric() || c == ' ')
}

/// Whether a text contains a word or a phrase between other characters than letters.
fn has_word(text: &str, word: &str) -> bool {
    let text = text.to_lowercase();
    text.match_indices(word).any(|(start, _)| {
        let before = text[..start].chars().next_back();
        let after = text[start + word.len()..].chars().next();
        ![before, after].into_iter().flatten().any(char::is_alphanumeric)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn explained(word: &str) -> String {
        let word = word.split(' ').map(String::from).collect();
        run(&Explain { word }).map_or_else(|error| error, |answer| answer.text)
    }

    #[test]
    fn words_are_explained_by_the_page_of_concepts() {
        assert!(explained("witness").starts_with("Witness. The state"), "a term");
        assert!(explained("Level set").starts_with("Level set. The states"), "of two words");
        let verdict = explained("refuted");
        assert!(verdict.contains("- refuted: the residual is not zero"), "{verdict}");
        assert!(
            verdict.contains("- confirmed: zero") && verdict.contains("p*(4*cos(2*π/5) − √5 + 1)"),
            "{verdict}"
        );
        assert!(explained("flibber").contains("entries: Claim, Residual, Verdict"), "unknown");
        for entry in entries() {
            let text = plain(&entry.text);
            assert!(!text.contains("**") && !text.contains('`'), "{text}");
        }
    }
}
