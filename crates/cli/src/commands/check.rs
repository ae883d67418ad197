//! The command `liouville check`.

use std::io::IsTerminal;

use liouville::case::{Case, Column, is_labelled, labels, matches};
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
    let (claims, sources) = (&options.claims, &options.sources);
    let is_everything = claims.is_empty() && sources.is_empty();
    let is_named = |name: &str, source: &str| {
        claims.is_empty() || claims.iter().any(|wanted| is_meant(name, source, wanted))
    };
    // A label of the case is one of all its claims.
    let is_from = |own: &str, case: &str, cell: Option<&str>, column: Option<&Column>| {
        let labels = [labels(own, column, cell), labels(case, None, None)].concat();
        let is_wanted = |wanted: &String| labels.iter().any(|label| is_labelled(label, wanted));
        sources.is_empty() || sources.iter().any(is_wanted)
    };
    // Other claims of a case may matter to those that are meant, but motions take minutes and do not.
    let prepare = |case: &mut Case| {
        let (whole, column) = (case.source.clone(), case.column.clone());
        let is_own = |name: &str, source: &str, cell: Option<&str>| {
            is_named(name, source) && is_from(source, &whole, cell, column.as_ref())
        };
        case.motions.retain(|own| is_own(&own.name, &own.source, None));
        let mut claims = case.claims.iter().map(|own| (&own.name, &own.source, &own.cell));
        let mut absences = case.absences.iter().map(|own| (&own.name, &own.source, &own.cell));
        let is_meant = |(name, source, cell): (&String, &String, &Option<String>)| {
            is_own(name, source, cell.as_deref())
        };
        if !claims.any(is_meant) && !absences.any(is_meant) {
            case.claims.clear();
            case.absences.clear();
        }
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
        run.retain(|heading, claim| {
            let (cell, column) = (claim.cell.as_deref(), heading.column.as_ref());
            is_named(&claim.name, &claim.source)
                && is_from(&claim.source, &heading.source, cell, column)
        });
        if run.claims().next().is_none() && run.summary().errors == 0 {
            let wanted = [claims.as_slice(), sources.as_slice()].concat().join("` or `");
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
pub(super) fn is_meant(name: &str, source: &str, wanted: &str) -> bool {
    let is_pattern = wanted.contains(['*', '?']);
    [name, source].into_iter().any(|text| match is_pattern {
        true => matches(wanted, text),
        false => text.contains(wanted),
    })
}
