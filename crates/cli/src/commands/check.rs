//! The command `liouville check`.

use std::io::IsTerminal;
use std::path::Path;

use crate::report::terminal::{Detail, Style};
use crate::report::{VerdictTable, diagnostic, json, records, terminal};
use liouville::case::{Case, Column, PlacedClaim, is_labelled, labels, matches};
use liouville::verdict::{ClaimReport, Options};
use liouville_report::annotations;

use super::check_args::CATALOGUE_FOLDER;
use super::eval::read_settings;
use super::judging::{JudgingJob, judge};
use super::{CheckArgs, CheckFormat, CommandOutput, bodies, certificates, colour, watch, width};

/// Claims that were asked for, by name or source and by label.
#[derive(Clone, Debug)]
pub(super) struct RequestedClaims {
    claims: Vec<String>,
    sources: Vec<String>,
}

impl RequestedClaims {
    /// Claims that the options ask for.
    pub fn of(options: &CheckArgs) -> Self {
        Self { claims: options.claims.clone(), sources: options.sources.clone() }
    }

    fn is_everything(&self) -> bool {
        self.claims.is_empty() && self.sources.is_empty()
    }

    /// Whether a claim is meant, given the source and the column of its case.
    fn takes(&self, own: &RequestedClaim<'_>, case: &str, column: Option<&Column>) -> bool {
        let mut claims = self.claims.iter();
        let is_named = self.claims.is_empty()
            || claims.any(|wanted| wanted == own.kind || is_meant(own.name, own.source, wanted));
        // A label of the case is one of all its claims.
        let labels = [labels(own.source, column, own.cell), labels(case, None, None)].concat();
        let is_wanted = |wanted: &String| labels.iter().any(|label| is_labelled(label, wanted));
        is_named && (self.sources.is_empty() || self.sources.iter().any(is_wanted))
    }

    /// Whether a claim of a case is meant.
    pub fn takes_claim(&self, claim: &ClaimReport, case: &Case) -> bool {
        let cell = claim.cell.as_deref();
        let own =
            RequestedClaim { kind: claim.kind, name: &claim.name, source: &claim.source, cell };
        self.takes(&own, &case.source, case.column.as_ref())
    }

    /// Removes what need not be judged, and marks the claims that are meant: other claims of a case may
    /// matter to these, but motions take minutes and do not.
    pub fn prepare(&self, case: &mut Case) {
        let has_meant = |own: &Case| {
            let claims =
                own.claims.iter().map(|own| (own.kind.name(), &own.name, &own.source, &own.cell));
            let absences =
                own.absences.iter().map(|own| (own.kind.name(), &own.name, &own.source, &own.cell));
            claims.chain(absences).any(|(kind, name, source, cell)| {
                let claim = RequestedClaim { kind, name, source, cell: cell.as_deref() };
                self.takes(&claim, &own.source, own.column.as_ref())
            })
        };
        let has_none = !case.homes().any(has_meant);
        case.change_claims(&|own| {
            let (whole, column) = (own.source.clone(), own.column.clone());
            own.motions.retain(|own| {
                let (kind, name, source) = (own.kind.name(), &own.name, &own.source);
                let claim = RequestedClaim { kind, name, source, cell: None };
                self.takes(&claim, &whole, column.as_ref())
            });
            for claim in &mut own.claims {
                let PlacedClaim { kind, name, source, cell, .. } = &*claim;
                let kind = kind.name();
                let asked = RequestedClaim { kind, name, source, cell: cell.as_deref() };
                claim.is_wanted = self.takes(&asked, &whole, column.as_ref());
            }
            if has_none {
                own.claims.clear();
                own.absences.clear();
            }
        });
    }
}

/// A claim as it is asked for.
struct RequestedClaim<'c> {
    kind: &'c str,
    name: &'c str,
    source: &'c str,
    cell: Option<&'c str>,
}

impl CheckArgs {
    /// Whether no path is given, and there is no folder `cases` here.
    fn is_of_catalogue(&self) -> bool {
        let folder = Path::new(CATALOGUE_FOLDER);
        self.paths == [folder] && !self.json && !self.quiet && !folder.exists()
    }

    /// Message where no claim is meant.
    pub(super) fn no_claim(&self) -> String {
        no_claim(&[self.claims.as_slice(), &self.sources].concat())
    }
}

/// Message where no claim is one of those wanted; where none is named, the case has no claim.
pub(super) fn no_claim(wanted: &[String]) -> String {
    let all = wanted.join("` or `");
    match all.is_empty() {
        true => "error: the case has no claim\nhelp: add [[claim]]".to_string(),
        false => format!(
            "error: no claim has a name or source like `{all}`, and none is of this kind\n\
             help: `liouville check -v` shows the names"
        ),
    }
}

pub fn run(options: &CheckArgs) -> Result<CommandOutput, String> {
    if options.watch {
        return watch::run(options);
    }
    if options.bodies.settings.is_some() {
        return bodies::check(options);
    }
    bodies::refuse(&options.share, (options.format == CheckFormat::Jsonl).then_some("jsonl"))?;
    let wanted = RequestedClaims::of(options);
    let of_case = wanted.clone();
    let mut run = judge(JudgingJob {
        paths: options.paths.clone(),
        settings: read_settings(&options.settings)?,
        prepare: Box::new(move |case| of_case.prepare(case)),
        options: Options { mutants: options.mutants, ..options.sampling.options() },
        motions: options.motion,
        sizes: options.verbose,
        statements: options.format.is_table(),
        threads: options.sampling.threads,
        limits: options.limits,
    })?;
    let is_everything = wanted.is_everything();
    if is_everything && options.format == CheckFormat::Text && options.is_of_catalogue() {
        anstream::eprintln!(
            "no file is given: these are the cases of the catalogue inside the program"
        );
    }
    if !is_everything {
        run.retain(|heading, claim| {
            let own = RequestedClaim {
                kind: claim.kind,
                name: &claim.name,
                source: &claim.source,
                cell: claim.cell.as_deref(),
            };
            wanted.takes(&own, &heading.source, heading.column.as_ref())
        });
        if run.claims().next().is_none() && run.summary().errors == 0 {
            return Err(options.no_claim());
        }
    }
    if let Some(folder) = &options.certificate {
        let told = certificates::write_all(folder, &run, options)?;
        anstream::eprintln!("{told}");
    }
    let format = if options.json { CheckFormat::Json } else { options.format };
    let text = match format {
        CheckFormat::Json | CheckFormat::Jsonl => {
            json::render(&run).map_err(|error| format!("error: {error}"))? + "\n"
        }
        CheckFormat::Csv => records::csv(&run),
        CheckFormat::Github => annotations(&run, |path| std::fs::read_to_string(path).ok()),
        CheckFormat::Junit => records::junit(&run, |path| std::fs::read_to_string(path).ok()),
        CheckFormat::Latex => VerdictTable::of(&run).latex(),
        CheckFormat::Markdown => VerdictTable::of(&run).markdown(),
        CheckFormat::Html => VerdictTable::of(&run).html(),
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
    Ok(CommandOutput { text, code: run.exit_code() })
}

/// Whether the name or the source of a claim contains a text, or matches it if it has `*` or `?`.
pub(super) fn is_meant(name: &str, source: &str, wanted: &str) -> bool {
    let is_pattern = wanted.contains(['*', '?']);
    [name, source].into_iter().any(|text| match is_pattern {
        true => matches(wanted, text),
        false => text.contains(wanted),
    })
}
