//! The command `liouville motion exponents`.

use std::path::PathBuf;

use crate::parts::{Form, Identity, Job, json_line, json_unit};
use crate::report::exponents::{self, MotionRow};
use crate::report::sha256;
use clap::Args;
use liouville::number::rational::Rational;
use liouville::part::Part;
use liouville::verdict;
use liouville_flow::{Begin, FlowError, Launches, Spectrum, Start};
use serde::{Deserialize, Serialize};

use super::eval::Opened;
use super::motion::{MotionArgs, SectionPlaneArgs, Threads, check_time, parse_float};
use super::orbit::parse_iterates;
use super::output::{Ending, Output};
use super::share::{Share, Target, carry_out};
use super::starts::{GivenStart, Starts, misfit};
use super::watching::watched;
use super::{CommandOutput, Progress, map_exponents, write};

#[derive(Clone, Debug, Args)]
pub struct ExponentsArgs {
    #[command(flatten)]
    pub subject: MotionArgs,
    #[command(flatten)]
    pub plane: SectionPlaneArgs,
    /// Time of each motion, 2000 by default; negative: backwards. Transients last long: after a
    /// short time a regular motion may look chaotic
    #[arg(long, allow_hyphen_values = true, value_parser = parse_float)]
    pub time: Option<f64>,
    /// Number of iterates of a map, 10000 by default
    #[arg(long, value_name = "N", value_parser = parse_iterates)]
    pub iterates: Option<u64>,
    #[command(flatten)]
    pub starts: Starts,
    /// Start by exact numbers instead: --state 'ω=[3/7,0,-1/2] γ=[2/7,3/7,6/7]'
    #[arg(long, value_name = "STATE", conflicts_with_all = ["start", "starts"])]
    pub state: Option<String>,
    /// Measure all exponents, one for each dimension of the level, forwards in time
    #[arg(long)]
    pub spectrum: bool,
    /// Integrate in one direction of time only: half the time, but a coarser classification
    #[arg(long)]
    pub one_way: bool,
    /// Write the motions to this file as JSON; with --part the folder of the parts
    #[arg(long, value_name = "FILE")]
    pub out: Option<PathBuf>,
    #[command(flatten)]
    pub share: Share,
    #[command(flatten)]
    pub threads: Threads,
}

pub fn run(options: &ExponentsArgs) -> Result<CommandOutput, String> {
    if options.subject.reads_map()? {
        return watched(options.subject.limits, None, || map_exponents::answer(options));
    }
    if options.iterates.is_some() {
        return Err("error: --iterates: the case is not a map, and its motions have a time\n\
                    help: give --time"
            .to_string());
    }
    let job = || ExponentsJob::new(options.clone(), options.subject.opened()?);
    if options.share.part.is_some() {
        return carry_out(&job()?, &options.share, options.target());
    }
    watched(options.subject.limits, Some(&options.share.remedy()), || {
        let job = job()?;
        let units = job.compute(Part::WHOLE, options.threads.count())?;
        let is_stopped = units.iter().any(|unit| unit.problem() == Some(&FlowError::Stopped));
        Ok((job.report(units)?.text, is_stopped))
    })
}

impl ExponentsArgs {
    /// Time of each motion.
    fn time(&self) -> f64 {
        const TIME: f64 = 2000.0;
        self.time.unwrap_or(TIME)
    }

    /// Whether the command reports what was reached when it is stopped.
    pub fn is_watched(&self) -> bool {
        self.share.part.is_none()
    }

    /// File of all motions.
    pub fn output(&self) -> Result<Option<Output>, String> {
        let inputs = [self.subject.case.as_path()].into_iter().chain(self.starts.inputs());
        let inputs: Vec<_> = inputs.collect();
        match (&self.out, self.share.part) {
            (Some(path), None) => Output::new(path, Ending::TABLES, &inputs).map(Some),
            _ => Ok(None),
        }
    }

    fn target(&self) -> Target<'_> {
        Target { out: self.out.as_deref(), threads: self.threads.count() }
    }
}

/// A motion with its exponents.
#[derive(Debug, Serialize, Deserialize)]
pub enum Unit {
    /// Largest exponents, in one direction of time or in both.
    Largest(Box<MotionRow>),
    /// All exponents.
    Spectrum {
        /// Name of the start.
        start: String,
        /// Exponents.
        found: Result<Spectrum, FlowError>,
    },
}

impl Unit {
    /// Reason why the motion has no exponents.
    fn problem(&self) -> Option<&FlowError> {
        match self {
            Unit::Largest(row) => row.forward.as_ref().err(),
            Unit::Spectrum { found, .. } => found.as_ref().err(),
        }
    }
}

/// Exponents of motions of a case.
#[derive(Debug)]
pub struct ExponentsJob {
    options: ExponentsArgs,
    opened: Opened,
    out: Option<Output>,
}

impl ExponentsJob {
    pub(in crate::commands) fn new(options: ExponentsArgs, opened: Opened) -> Result<Self, String> {
        check_time(options.time())?;
        if opened.case.model.system.has_arbitrary_function() {
            return Err(options.subject.told(&FlowError::Arbitrary));
        }
        let out = options.output()?;
        Ok(Self { options, opened, out })
    }

    /// Title of the case.
    pub fn title(&self) -> &str {
        &self.opened.case.title
    }

    /// Starts as they are given, with their names; `None` for one that is drawn.
    fn given(&self) -> Result<Vec<(String, Option<GivenStart>)>, String> {
        let (options, case) = (&self.options, &self.opened.case);
        let mut given = options.starts.read(case)?;
        if given.is_empty() && options.state.is_none() {
            for at in case.section.iter().flat_map(|plan| &plan.starts) {
                let [Some(l), Some(z)] = at.map(Rational::from_f64) else {
                    return Err("error: a start of [section] is not finite".to_string());
                };
                let name = format!("({}, {})", at[0], at[1]);
                given.push((name, GivenStart::Values(vec![l, z])));
            }
        }
        if !given.is_empty() {
            return Ok(given.into_iter().map(|(name, given)| (name, Some(given))).collect());
        }
        let state = options.state.as_deref().map(|text| verdict::read_state(case, text));
        let state = state.transpose().map_err(|error| format!("error: --state: {error}"))?;
        Ok(vec![("state".to_string(), state.map(GivenStart::State))])
    }

    /// Start of a motion, or the reason why there is none.
    fn start(&self, given: Option<&GivenStart>) -> Result<Result<Start, FlowError>, String> {
        let Self { options, opened: Opened { case, .. }, .. } = self;
        let seed = options.subject.seed;
        let fixed = match given {
            Some(GivenStart::Values(_)) => Vec::new(),
            _ => options.plane.fixed(case)?,
        };
        let launches = Launches { case, fixed: &fixed, pad: None, seed, index: 0 };
        let values = match given {
            None => return Ok(launches.start(&Begin::Drawn(0))),
            Some(GivenStart::State(state)) => {
                return Ok(launches.start(&Begin::State(state.clone())));
            }
            Some(GivenStart::Values(values)) => values,
        };
        let [l, z] = &values[..] else {
            return Err(misfit(case, values.len(), None));
        };
        if !liouville_flow::has_andoyer_section(&case.model) {
            return Err(misfit(case, values.len(), None));
        }
        let (g0, energy) = options.plane.of(case)?;
        let at = [l.to_f64().0, z.to_f64().0];
        let found = liouville_flow::section_starts(case, &g0, &energy, &[at], seed);
        let mut found = found.map_err(|error| options.subject.told(&error))?;
        Ok(found.pop().unwrap_or(Err(FlowError::NoStart)))
    }

    /// Measures all exponents.
    fn spectra(
        &self,
        names: Vec<String>,
        starts: &[Result<Start, FlowError>],
        threads: usize,
    ) -> Result<Vec<Unit>, String> {
        let bar = Progress::of(starts.len() as u64, "motions");
        let (model, time) = (&self.opened.case.model, self.options.time());
        let found = liouville_flow::spectra(model, starts, time, threads, &|share| bar.add(share));
        bar.finish();
        let found = found.map_err(|error| self.options.subject.told(&error))?;
        let named = names.into_iter().zip(found);
        Ok(named.map(|(start, found)| Unit::Spectrum { start, found }).collect())
    }
}

impl Job for ExponentsJob {
    type Unit = Unit;

    fn identity(&self) -> Result<Identity, String> {
        let ExponentsArgs { subject, plane, spectrum, one_way, share, .. } = &self.options;
        let time = self.options.time();
        let given = self.given()?;
        let starts = sha256(&format!("{given:?}"));
        let request = format!(
            "time {time:?} spectrum {spectrum} one way {one_way} {plane:?} starts sha256:{starts}"
        );
        Ok(subject.identity("exponents", &self.opened.text, (given.len() as u64, request), share))
    }

    fn form(&self) -> Form {
        Form::Json
    }

    fn compute(&self, part: Part, threads: usize) -> Result<Vec<Unit>, String> {
        let given = self.given()?;
        let own = part.of(&given);
        if own.is_empty() {
            return Ok(Vec::new());
        }
        liouville_flow::two_sided(&self.opened.case)
            .map_err(|error| self.options.subject.told(&error))?;
        let starts = own.iter().map(|(_, given)| self.start(given.as_ref()));
        let starts = starts.collect::<Result<Vec<_>, String>>()?;
        let names: Vec<String> = own.iter().map(|(name, _)| name.clone()).collect();
        if self.options.spectrum {
            return self.spectra(names, &starts, threads);
        }
        let told = |error: FlowError| self.options.subject.told(&error);
        let (case, seed) = (&self.opened.case, self.options.subject.seed);
        let parameters = liouville_flow::fixed_parameters(case, seed, 0).map_err(told)?;
        let (time, one_way) = (self.options.time(), self.options.one_way);
        let ways = if one_way { 1 } else { 2 };
        let bar = Progress::of((ways * starts.len()) as u64, "motions");
        let motions =
            liouville_flow::Variational::all(&case.model, &parameters, &starts).map_err(told)?;
        let follow = |time| motions.all_exponents(time, threads, &|share| bar.add(share));
        let forward = follow(time);
        let backward = (!one_way).then(|| follow(-time));
        bar.finish();
        Ok(exponents::rows(names, forward, backward)
            .into_iter()
            .map(Box::new)
            .map(Unit::Largest)
            .collect())
    }

    fn line(&self, _: u64, unit: &Unit) -> Result<String, String> {
        json_line(unit)
    }

    fn unit(&self, line: &str) -> Result<Unit, String> {
        json_unit(line)
    }

    fn report(&self, units: Vec<Unit>) -> Result<CommandOutput, String> {
        // Single motions may fail, but not all.
        if let Some(first) = units.first().and_then(Unit::problem)
            && units.iter().all(|unit| unit.problem().is_some())
        {
            return Err(self.options.subject.told(first));
        }
        let (text, json) = self.written(units)?;
        if let Some(out) = &self.out {
            write(&out.path, "--out", &json)?;
        }
        Ok(CommandOutput { text: if self.options.subject.json { json } else { text }, code: 0 })
    }
}

impl ExponentsJob {
    /// Report as text, and as JSON.
    pub fn written(&self, units: Vec<Unit>) -> Result<(String, String), String> {
        let title = self.title();
        let (mut rows, mut names, mut spectra) = (Vec::new(), Vec::new(), Vec::new());
        for unit in units {
            match unit {
                Unit::Largest(row) => rows.push(*row),
                Unit::Spectrum { start, found } => {
                    names.push(start);
                    spectra.push(found);
                }
            }
        }
        let (text, json) = match self.options.spectrum {
            true => (
                exponents::spectra_text(title, &names, &spectra),
                exponents::spectra_json(title, &names, &spectra),
            ),
            false => (exponents::text(title, &rows), exponents::json(title, &rows)),
        };
        Ok((text, json.map_err(|error| format!("error: {error}"))? + "\n"))
    }
}
