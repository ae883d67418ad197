//! The command `liouville check`.

use std::io::IsTerminal;

use liouville::case::{Case, Column, is_labelled, labels, matches};
use liouville::verdict::{CaseReport, JudgeError, Options};
use liouville_cli::report::terminal::{Detail, Style};
use liouville_cli::report::{diagnostic, json, records, terminal};

use super::eval::read_settings;
use super::files::Judge;
use super::{Answer, Check, CheckFormat, colour, files, width};

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
    let (claims, sources) = (&options.claims, &options.sources);
    let is_everything = claims.is_empty() && sources.is_empty();
    let is_meant = |name: &str, source: &str, column: Option<&Column>, cell: Option<&str>| {
        is_everything
            || claims.iter().any(|wanted| is_meant(name, source, wanted))
            || labels(source, column, cell)
                .iter()
                .any(|label| sources.iter().any(|wanted| is_labelled(label, wanted)))
    };
    // Other claims may matter to those that are meant, but motions take minutes and do not.
    let prepare = |case: &mut Case| {
        case.motions.retain(|own| is_meant(&own.name, &own.source, None, None));
    };
    let mut run = files::judge(
        &options.paths,
        &read_settings(&options.settings)?,
        &prepare,
        &Options { mutants: options.mutants, ..options.sampling.options() },
        judge(options),
        options.sampling.threads,
    )?;
    if !is_everything {
        run.retain(|column, claim| {
            is_meant(&claim.name, &claim.source, column, claim.cell.as_deref())
        });
        if run.claims().next().is_none() && run.summary().errors == 0 {
            let wanted = [claims.as_slice(), sources.as_slice()].concat().join("` or `");
            return Err(format!("error: no claim has a name or source like `{wanted}`"));
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
                _ if run.outcomes.len() == 1 || !is_everything => Detail::Claims,
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
