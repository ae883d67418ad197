//! The command `liouville check`.

use std::io::IsTerminal;

use liouville::case::Case;
use liouville::verdict::Options;
use liouville_cli::report::terminal::{Detail, Style};
use liouville_cli::report::{diagnostic, json, records, terminal};

use super::eval::read_settings;
use super::judging::{Work, judge};
use super::{Answer, Check, CheckFormat, colour, width};

pub fn run(options: &Check) -> Result<Answer, String> {
    let wanted = options.claims.clone();
    let is_wanted = move |name: &str, source: &str| {
        wanted.is_empty() || wanted.iter().any(|wanted| is_meant(name, source, wanted))
    };
    // Other claims may matter to those that are meant, but motions take minutes and do not.
    let of_motion = is_wanted.clone();
    let prepare =
        move |case: &mut Case| case.motions.retain(|own| of_motion(&own.name, &own.source));
    let mut run = judge(Work {
        paths: options.paths.clone(),
        settings: read_settings(&options.settings)?,
        prepare: Box::new(prepare),
        options: Options { mutants: options.mutants, ..options.sampling.options() },
        motions: options.motion,
        threads: options.sampling.threads,
        limits: options.limits,
    })?;
    if !options.claims.is_empty() {
        run.retain(|claim| is_wanted(&claim.name, &claim.source));
        if run.claims().next().is_none() && run.summary().errors == 0 {
            let wanted = options.claims.join("` or `");
            return Err(format!(
                "error: no claim has a name or source like `{wanted}`\n\
                 help: `liouville check -v` shows the names"
            ));
        }
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
fn is_meant(name: &str, source: &str, wanted: &str) -> bool {
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
