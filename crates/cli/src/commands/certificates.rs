//! The option `--certificate` of `liouville check`: one file for each proof by points, for each
//! closed orbit and each horseshoe that is proved.

use std::collections::BTreeSet;
use std::path::Path;

use crate::report::certificate::{CaseOrigin, Missing, certificate};
use crate::report::motion_certificate::{horseshoe_certificate, motion_certificate};
use crate::report::{FileOutcome, RunReport, counted};
use liouville::case::{Case, MotionClaim};
use liouville::claim::motion::MotionKind;
use liouville::verdict::{CaseReport, ClaimReport, Method, Verdict, statements};
use liouville_flow::observe;
use rayon::prelude::*;

use super::eval::read_settings;
use super::{CheckArgs, out, source};

/// Certificates of a case: name of the claim, and text or the reason why there is none.
type Made = Vec<(String, Result<String, Missing>)>;

/// Writes the certificates of all claims of a run; returns a summary.
pub fn write_all(folder: &Path, run: &RunReport, options: &CheckArgs) -> Result<String, String> {
    std::fs::create_dir_all(folder).map_err(|error| {
        format!(
            "error: cannot make the folder {}: {error}\nhelp: give --certificate a folder to write to",
            folder.display()
        )
    })?;
    let made: Vec<(&FileOutcome, Made)> = run
        .outcomes
        .par_iter()
        .map(|outcome| Ok((outcome, of_case(outcome, options)?)))
        .collect::<Result<_, String>>()?;
    let inputs: Vec<&Path> = run.outcomes.iter().map(|outcome| Path::new(&outcome.path)).collect();
    let inputs = out::ReadFiles::new(&inputs);
    let mut taken: BTreeSet<String> = BTreeSet::new();
    let mut written = 0;
    let mut missing: Vec<Missing> = Vec::new();
    for (outcome, made) in &made {
        for (claim, text) in made {
            match text {
                Ok(text) => {
                    let name = fresh(&mut taken, &outcome.path, claim);
                    let path = folder.join(format!("{name}.json"));
                    out::check_one(&path, "--certificate", &inputs)?;
                    out::write_one(&path, "--certificate", text)?;
                    written += 1;
                }
                Err(reason) => missing.push(*reason),
            }
        }
    }
    Ok(summary(folder, written, &missing))
}

/// Makes the certificates of the proofs of a case by points or by folding.
fn of_case(outcome: &FileOutcome, options: &CheckArgs) -> Result<Made, String> {
    let Ok(report) = &outcome.result else { return Ok(Vec::new()) };
    let path = Path::new(&outcome.path);
    if source::is_standard_input(path) {
        return Err("error: --certificate reads the case again, which standard input cannot do\n\
                    help: save the case in a file"
            .to_string());
    }
    let (text, case) = source::read(path, &read_settings(&options.settings)?);
    let Ok(case) = case else { return Ok(Vec::new()) };
    let origin = CaseOrigin { path: &outcome.path, text: &text, settings: &options.settings };
    match case.time_parts() {
        None => of_part(&case, report, &origin, options),
        Some(parts) => {
            let mut made = of_part(&parts.without_time, report, &origin, options)?;
            made.extend(of_part(&parts.with_time, report, &origin, options)?);
            Ok(made)
        }
    }
}

/// Makes the certificates of the claims that a case contains.
fn of_part(
    case: &Case,
    report: &CaseReport,
    origin: &CaseOrigin<'_>,
    options: &CheckArgs,
) -> Result<Made, String> {
    let by_name = |claim: &ClaimReport| {
        case.claims.iter().position(|own| own.name == claim.name && !own.kind.is_negated())
    };
    let is_by_points = |claim: &&ClaimReport| {
        claim.verdict == Verdict::Proved
            && matches!(claim.evidence.method, Method::PrimeField | Method::Folding)
    };
    let proved: Vec<(usize, &ClaimReport)> = report
        .claims
        .iter()
        .filter(is_by_points)
        .filter_map(|claim| Some((by_name(claim)?, claim)))
        .collect();
    let of_motion = of_motion(case, &report.claims, origin, options);
    if proved.is_empty() {
        return Ok(of_motion);
    }
    let claims: Vec<usize> = proved.iter().map(|(index, _)| *index).collect();
    let found = statements(case, &claims, options.sampling.seed)
        .map_err(|error| format!("error: {}: {error}", origin.path))?;
    Ok(proved
        .iter()
        .zip(&found)
        .map(|((_, claim), statement)| {
            let made = certificate(case, origin, claim, statement, options.sampling.seed);
            (claim.name.clone(), made.map(|json| format!("{json:#}\n")))
        })
        .chain(of_motion)
        .collect())
}

/// Makes the certificates of the closed orbits and horseshoes that are proved.
fn of_motion(
    case: &Case,
    claims: &[ClaimReport],
    origin: &CaseOrigin<'_>,
    options: &CheckArgs,
) -> Made {
    let is_proved = |claim: &&MotionClaim| {
        let mut reports = claims.iter();
        reports.any(|own| {
            own.name == claim.name
                && own.verdict == Verdict::Proved
                && own.evidence.method == Method::EnclosedOrbit
        })
    };
    let settings = options.sampling.options();
    let made = |claim: &MotionClaim| {
        let json = match &claim.kind {
            MotionKind::Horseshoe(_) => {
                let (report, found) = observe::proof_of_horseshoe(case, claim, &settings)?;
                horseshoe_certificate(claim, origin, &report, &found)
            }
            _ => {
                let (report, found) = observe::proof(case, claim, &settings)?;
                motion_certificate(claim, origin, &report, &found)
            }
        };
        Some((claim.name.clone(), Ok(format!("{json:#}\n"))))
    };
    case.motions.iter().filter(is_proved).filter_map(made).collect()
}

/// Name of a file that no other certificate of the run has.
fn fresh(taken: &mut BTreeSet<String>, path: &str, claim: &str) -> String {
    let path = path.trim_start_matches("./").trim_start_matches("cases/");
    let path = path.trim_end_matches(".toml");
    let plain = |text: &str| -> String {
        let letters = text.chars().map(|c| if c.is_alphanumeric() { c } else { '-' });
        let words: String = letters.collect();
        let words: Vec<&str> = words.split('-').filter(|word| !word.is_empty()).collect();
        words.join("-").chars().take(60).collect()
    };
    let name = format!("{}--{}", plain(path), plain(claim));
    let numbers = (1..).map(|count| match count {
        1 => name.clone(),
        _ => format!("{name}-{count}"),
    });
    let own = numbers.into_iter().find(|own| !taken.contains(own)).unwrap_or(name.clone());
    taken.insert(own.clone());
    own
}

fn summary(folder: &Path, written: usize, missing: &[Missing]) -> String {
    let count = |reason: Missing| missing.iter().filter(|own| **own == reason).count();
    let reasons = [
        (Missing::NotPlain, "with dependent roots, moduli or functions such as exp"),
        (Missing::NoProgram, "at states that no formula makes, or with too many listed values"),
        (Missing::NoBound, "whose bound is too weak, or without value for some listed values"),
    ];
    let mut text = format!("{} in {}", counted(written, "certificate"), folder.display());
    for (reason, words) in reasons {
        match count(reason) {
            0 => {}
            1 => text.push_str(&format!("; 1 proof {words} has none")),
            n => text.push_str(&format!("; {n} proofs {words} have none")),
        }
    }
    text
}
