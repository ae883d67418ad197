//! The command `liouville sweep`.

use std::path::PathBuf;

use clap::Args;
use liouville::case::{Case, PlacedClaim};
use liouville::formula::Type;
use liouville::part::Part;
use liouville::sweep::{Extremes, Peak, Sweep as States};
use liouville::verdict::NamedValue;
use serde::{Deserialize, Serialize};

use crate::parts::{Form, Identity, Job, json_line, json_unit};
use crate::report::sweep::{Found, SweepReport};

use super::Progress;
use super::eval::Opened;
use super::motion::{MotionArgs, Threads};
use super::output::{Ending, Output};
use super::share::{Share, Target, carry_out};
use super::{CommandOutput, check, eval, pool, write};

/// Largest number of states.
const MOST: f64 = 1e18;
/// Number of states between two advances of the bar.
const STRIDE: u64 = 1 << 26;

#[derive(Clone, Debug, Args)]
pub struct Sweep {
    #[command(flatten)]
    pub subject: MotionArgs,
    /// Sweep only claims whose name or source contains this text, or matches it if it has `*` or
    /// `?`
    #[arg(long = "claim", value_name = "TEXT")]
    pub claims: Vec<String>,
    /// Number of states, such as 1000000 or 1e9
    #[arg(long, value_name = "N", default_value = "1e6", value_parser = parse_states)]
    pub states: u64,
    /// Write the results to this file as JSON; with --part the folder of the parts
    #[arg(long, value_name = "FILE")]
    pub out: Option<PathBuf>,
    #[command(flatten)]
    pub share: Share,
    #[command(flatten)]
    pub threads: Threads,
}

/// Reads a number of states.
fn parse_states(text: &str) -> Result<u64, String> {
    let exact = text.parse().ok();
    let rounded =
        || text.parse::<f64>().ok().filter(|x| x.fract() == 0.0 && (1.0..=MOST).contains(x));
    let states = exact.or_else(|| rounded().map(|x| x as u64));
    states
        .filter(|n| (1..=MOST as u64).contains(n))
        .ok_or(format!("write a whole number from 1 to {MOST:e}"))
}

pub fn run(options: &Sweep) -> Result<CommandOutput, String> {
    let opened = eval::open_text(&options.subject.case, &options.subject.settings)?;
    let job = SweepJob::new(options.clone(), opened)?;
    let target = Target { out: options.out.as_deref(), threads: options.threads.count() };
    carry_out(&job, &options.share, target)
}

/// Result of a claim over a part of the states.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Unit {
    claim: String,
    states: u64,
    defined: u64,
    peak: Option<(u64, f64)>,
    /// Reason why the claim has no sweep.
    reason: Option<String>,
}

/// Sweep of claims of a case.
#[derive(Debug)]
pub struct SweepJob {
    options: Sweep,
    opened: Opened,
    /// Places of the claims in the case.
    claims: Vec<usize>,
    out: Option<Output>,
}

impl SweepJob {
    pub(in crate::commands) fn new(options: Sweep, opened: Opened) -> Result<Self, String> {
        let out = match (&options.out, options.share.part) {
            (Some(path), None) => {
                Some(Output::new(path, Ending::TABLES, &[&options.subject.case])?)
            }
            _ => None,
        };
        let claims = opened.case.claims.iter().enumerate().filter(|(_, claim)| {
            let mut wanted = options.claims.iter();
            options.claims.is_empty()
                || wanted.any(|wanted| check::is_meant(&claim.name, &claim.source, wanted))
        });
        let claims: Vec<usize> = claims.map(|(place, _)| place).collect();
        if claims.is_empty() {
            return Err(check::no_claim(&options.claims));
        }
        Ok(Self { options, opened, claims, out })
    }

    /// Returns a claim with the case in which it is judged.
    fn claim(&self, place: usize) -> (&Case, &PlacedClaim) {
        let claim = &self.opened.case.claims[place];
        let home = self.opened.case.home(&claim.name);
        (home, home.claim(&claim.name).unwrap_or(claim))
    }

    /// Sweeps one claim over the states of a part.
    fn sweep(&self, place: usize, part: Part, tick: &dyn Fn(u64)) -> Unit {
        let ((case, claim), seed) = (self.claim(place), self.options.subject.seed);
        let name = claim.name.clone();
        let range = part.range(self.options.states);
        let sweep = match States::new(case, claim, seed) {
            Ok(sweep) => sweep,
            Err(error) => {
                tick(range.end - range.start);
                let reason = Some(format!("{error}; {}", error.help()));
                return Unit { claim: name, states: 0, defined: 0, peak: None, reason };
            }
        };
        let mut found = Extremes::default();
        let mut next = range.start;
        while next < range.end {
            let end = next.saturating_add(STRIDE).min(range.end);
            found = found.and(sweep.run(next..end, f64::INFINITY));
            tick(end - next);
            next = end;
        }
        let peak = found.peak.map(|peak| (peak.index, peak.ratio));
        Unit { claim: name, states: found.states, defined: found.defined, peak, reason: None }
    }

    /// Combines the results of a claim over parts in order.
    fn combined(&self, place: usize, units: &[Unit]) -> Found {
        let (case, claim) = self.claim(place);
        let own = units.iter().filter(|unit| unit.claim == claim.name);
        let mut found = Extremes::default();
        let mut reason = None;
        for Unit { states, defined, peak, reason: why, .. } in own {
            let peak = peak.map(|(index, ratio)| Peak { index, ratio });
            found = found.and(Extremes { states: *states, defined: *defined, peak });
            reason = reason.or(why.clone());
        }
        let at = found.peak.and_then(|peak| {
            let sweep = States::new(case, claim, self.options.subject.seed).ok()?;
            let (parameters, state) = sweep.state(peak.index);
            let model = &case.model;
            let kinds = model.free_parameters().map(|own| own.kind);
            let parameters = parameters.into_iter().zip(kinds).map(written).collect();
            let kinds = model.state.iter().map(|own| own.kind);
            Some((parameters, state.into_iter().zip(kinds).map(written).collect()))
        });
        Found { claim: claim.name.clone(), found, at, reason }
    }
}

impl Job for SweepJob {
    type Unit = Unit;

    fn identity(&self) -> Result<Identity, String> {
        let names = self.claims.iter().map(|place| &self.opened.case.claims[*place].name);
        let request = format!("claims {:?}", names.collect::<Vec<_>>());
        let Sweep { subject, states, share, .. } = &self.options;
        Ok(subject.identity("sweep", &self.opened.text, (*states, request), share))
    }

    fn form(&self) -> Form {
        Form::Json
    }

    fn compute(&self, part: Part, threads: usize) -> Result<Vec<Unit>, String> {
        let range = part.range(self.options.states);
        let pool = pool(threads)?;
        let bar = Progress::of((range.end - range.start) * self.claims.len() as u64, "states");
        let tick = |count: u64| bar.add(count as f64);
        let units = pool
            .install(|| self.claims.iter().map(|place| self.sweep(*place, part, &tick)).collect());
        bar.finish();
        Ok(units)
    }

    fn line(&self, _: u64, unit: &Unit) -> Result<String, String> {
        json_line(unit)
    }

    fn unit(&self, line: &str) -> Result<Unit, String> {
        json_unit(line)
    }

    fn report(&self, units: Vec<Unit>) -> Result<CommandOutput, String> {
        let found: Vec<Found> =
            self.claims.iter().map(|place| self.combined(*place, &units)).collect();
        let Sweep { subject, states, .. } = &self.options;
        let report = SweepReport {
            title: &self.opened.case.title,
            path: &subject.case.display().to_string(),
            settings: &subject.settings,
            states: *states,
            seed: subject.seed,
            found: &found,
        };
        let json = report.json().map_err(|error| format!("error: {error}"))? + "\n";
        if let Some(out) = &self.out {
            write(&out.path, "--out", &json)?;
        }
        Ok(CommandOutput { text: if subject.json { json } else { report.text() }, code: 0 })
    }
}

/// Name and value as `--set` and `--state` read it.
fn written(((name, components), kind): (NamedValue, Type)) -> (String, String) {
    (name, kind.listed(&components, ["[", ",", "]"]))
}
