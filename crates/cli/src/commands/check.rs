//! The command `liouville check`.

use std::io::IsTerminal;

use liouville::case::Case;
use liouville::verdict::{CaseReport, JudgeError, Options};
use liouville_cli::report::terminal::{Detail, Style};
use liouville_cli::report::{diagnostic, json, records, terminal};

use super::eval::read_settings;
use super::files::Judge;
use super::{Answer, Check, CheckFormat, certificates, colour, files, width};

/// Judge of cases, including the claims of absence, and those about motion where requested.
fn judge(options: &Check) -> Judge {
    if options.motion { with_motions } else { liouville_search::judge }
}

fn with_motions(case: &Case, options: &Options) -> Result<CaseReport, JudgeError> {
    let mut report = liouville_search::judge(case, options)?;
    report.claims.extend(liouville_flow::observe::observe(case, options));
    report.motions_left = 0;
    Ok(report)
}

pub fn run(options: &Check) -> Result<Answer, String> {
    let is_meant = |name: &str, source: &str| {
        options.claims.is_empty()
            || options.claims.iter().any(|wanted| is_meant(name, source, wanted))
    };
    // Other claims may matter to those that are meant, but motions take minutes and do not.
    let prepare = |case: &mut Case| case.motions.retain(|own| is_meant(&own.name, &own.source));
    let mut run = files::judge(
        &options.paths,
        &read_settings(&options.settings)?,
        &prepare,
        &Options { mutants: options.mutants, ..options.sampling.options() },
        judge(options),
        options.sampling.threads,
    )?;
    if !options.claims.is_empty() {
        run.retain(|claim| is_meant(&claim.name, &claim.source));
        if run.claims().next().is_none() && run.summary().errors == 0 {
            let wanted = options.claims.join("` or `");
            return Err(format!("error: no claim has a name or source like `{wanted}`"));
        }
    }
    if let Some(folder) = &options.certificate {
        let told = certificates::write_all(folder, &run, options)?;
        anstream::eprintln!("{told}");
    }
    let format = if options.json { CheckFormat::Json } else { options.format };
    let text = match format {
        CheckFormat::Json => json::render(&run).map_err(|error| format!("error: {error}"))? + "\n",
        CheckFormat::Csv => records::csv(&run),
        CheckFormat::Junit => records::junit(&run),
        CheckFormat::Text => {
            let detail = match (options.verbose, options.quiet) {
                (true, _) => Detail::Evidence,
                (_, true) => Detail::Summary,
                _ if run.outcomes.len() == 1 || !options.claims.is_empty() => Detail::Claims,
                _ => Detail::Cases,
            };
            let colour = colour(std::io::stdout().is_terminal());
            terminal::render(&run, Style { detail, colour, width: width() })
        }
    };
    if format != CheckFormat::Text {
        for outcome in &run.outcomes {
            if let Err(failures) = &outcome.result {
                anstream::eprintln!("{}", diagnostic::rendered(failures));
            }
        }
    }
    Ok(Answer { text, code: run.exit_code() })
}

/// Whether the name or the source of a claim contains a text, or matches it if it has `*` or `?`.
pub(super) fn is_meant(name: &str, source: &str, wanted: &str) -> bool {
    let is_pattern = wanted.contains(['*', '?']);
    [name, source].into_iter().any(|text| match is_pattern {
        true => matches(wanted, text),
        false => text.contains(wanted),
    })
}

/// Whether a text matches a pattern, in which `*` stands for any characters and `?` for one.
fn matches(pattern: &str, text: &str) -> bool {
    let (pattern, text): (Vec<char>, Vec<char>) =
        (pattern.chars().collect(), text.chars().collect());
    // The ends of the text that the pattern so far can match.
    let mut ends = vec![false; text.len() + 1];
    ends[0] = true;
    for wanted in pattern {
        if wanted == '*' {
            let first = ends.iter().position(|end| *end).unwrap_or(ends.len());
            ends.iter_mut().skip(first).for_each(|end| *end = true);
        } else {
            for end in (1..ends.len()).rev() {
                ends[end] = ends[end - 1] && (wanted == '?' || wanted == text[end - 1]);
            }
            ends[0] = false;
        }
    }
    ends.last() == Some(&true)
}

#[cfg(test)]
mod tests {
    use super::matches;

    #[test]
    fn patterns_match_as_in_a_shell() {
        for (pattern, text) in [
            ("F2*", "F2 with I"),
            ("*I", "F2 with I"),
            ("F?", "F2"),
            ("*", ""),
            ("a*b*c", "aXbYbc"),
        ] {
            assert!(matches(pattern, text), "{pattern} {text}");
        }
        for (pattern, text) in
            [("F2*", "aF2"), ("F?", "F"), ("?", ""), ("a*b", "abc"), ("", "a"), ("F?", "F22")]
        {
            assert!(!matches(pattern, text), "{pattern} {text}");
        }
    }
}
