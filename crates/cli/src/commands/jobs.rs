//! Jobs that may be done in parts, read from the arguments of the command with a case at hand.

use std::path::Path;

use clap::FromArgMatches;
use liouville::part::Part;

use super::explore::motion::Opened;
use super::explore::report::ReportArgs;
use super::explore::{self, MotionCommand};
use super::{Arguments, CheckArgs, Command, CommandOutput, eval};
use crate::parts::{Header, Identity, Job, PartFile, Set};

pub use super::bodies::BodiesJob;
pub use super::explore::chart::{Cell, ChartJob};
pub use super::explore::exponents::{ExponentsJob, Unit as ExponentsUnit};
pub use super::explore::section::{SectionJob, Unit as SectionUnit};
pub use super::explore::sweep::SweepJob;

/// A job that may be done in parts.
#[derive(Debug)]
pub enum AnyJob {
    /// Table of bodies.
    Bodies(Box<BodiesJob>),
    /// Plane of motions.
    Chart(Box<ChartJob>),
    /// Exponents of motions.
    Exponents(Box<ExponentsJob>),
    /// Crossings of a section.
    Section(Box<SectionJob>),
    /// Residuals at many states.
    Sweep(Box<SweepJob>),
}

/// Case at hand: its name, its text, and the values given by `--set`.
#[derive(Clone, Copy, Debug)]
pub struct Given<'g> {
    /// Name, for messages.
    pub name: &'g str,
    /// Text.
    pub text: &'g str,
    /// Values of parameters, `NAME=VALUE`.
    pub settings: &'g [String],
    /// Text of the file of `--starts` or `--settings`, if it is at hand.
    pub table: Option<&'g str>,
}

impl Given<'_> {
    /// The case, read from its text.
    fn opened(&self) -> Result<Opened, String> {
        let case = eval::read_text(Path::new(self.name), self.text, self.settings)?;
        Ok(Opened { case, text: self.text.to_string() })
    }
}

impl AnyJob {
    /// Reads a job from the arguments of its command, with a case in place of the file. Results of
    /// the whole job go to `out`; of a job of which parts are computed, that is `None`.
    pub fn read(
        arguments: &[String],
        given: Given<'_>,
        out: Option<&Path>,
    ) -> Result<Self, String> {
        let mut command = Arguments::described().no_binary_name(true).args_override_self(true);
        let matches = command
            .try_get_matches_from_mut(arguments)
            .and_then(|matches| Arguments::from_arg_matches(&matches));
        let parsed = matches.map_err(|error| error.to_string())?;
        let command = match parsed.command {
            Command::Explore(command) => command,
            Command::Check(options) if options.bodies.settings.is_some() => {
                return Self::check(options, arguments, given, out);
            }
            _ => return Err(no_job(arguments)),
        };
        let motion = match *command {
            explore::ExploreCommand::Report(options) if options.bodies.settings.is_some() => {
                return Self::survey(options, arguments, given, out);
            }
            explore::ExploreCommand::Sweep(mut options) => {
                set(&mut options.subject, given);
                options.share.arguments = arguments.to_vec();
                options.out = out.map(Path::to_path_buf);
                let opened = options.subject.opened_any(given.text)?;
                return Ok(Self::Sweep(Box::new(SweepJob::new(options, opened)?)));
            }
            explore::ExploreCommand::Motion { command }
            | explore::ExploreCommand::Former(explore::FormerCommand::Motion(command)) => *command,
            _ => return Err(no_job(arguments)),
        };
        let out = out.map(Path::to_path_buf);
        match motion {
            MotionCommand::Chart(mut options) => {
                set(&mut options.subject, given);
                options.share.arguments = arguments.to_vec();
                options.ink.out = out;
                let opened = options.subject.read(given.text)?;
                Ok(Self::Chart(Box::new(ChartJob::new(options, opened)?)))
            }
            MotionCommand::Exponents(mut options) => {
                set(&mut options.subject, given);
                options.share.arguments = arguments.to_vec();
                options.starts.text = given.table.map(str::to_string);
                options.out = out;
                let opened = options.subject.read(given.text)?;
                Ok(Self::Exponents(Box::new(ExponentsJob::new(options, opened)?)))
            }
            MotionCommand::Section(mut options) => {
                set(&mut options.subject, given);
                options.share.arguments = arguments.to_vec();
                options.starts.text = given.table.map(str::to_string);
                options.ink.out = out;
                let opened = options.subject.read(given.text)?;
                Ok(Self::Section(Box::new(SectionJob::new(options, opened)?)))
            }
            _ => Err(no_job(arguments)),
        }
    }

    /// Verdicts on a table of bodies.
    fn check(
        mut options: CheckArgs,
        arguments: &[String],
        given: Given<'_>,
        out: Option<&Path>,
    ) -> Result<Self, String> {
        options.paths = vec![given.name.into()];
        options.settings = given.settings.to_vec();
        options.share.arguments = arguments.to_vec();
        options.bodies.text = given.table.map(str::to_string);
        options.out = out.map(Path::to_path_buf);
        Ok(Self::Bodies(Box::new(BodiesJob::of_check(&options, given.opened()?)?)))
    }

    /// Invariants of a table of bodies.
    fn survey(
        mut options: ReportArgs,
        arguments: &[String],
        given: Given<'_>,
        out: Option<&Path>,
    ) -> Result<Self, String> {
        options.case = given.name.into();
        options.settings = given.settings.to_vec();
        options.share.arguments = arguments.to_vec();
        options.bodies.text = given.table.map(str::to_string);
        options.out = out.map(Path::to_path_buf);
        Ok(Self::Bodies(Box::new(BodiesJob::of_report(&options, given.opened()?)?)))
    }

    /// Reads the job of a part.
    pub fn of(header: &Header, out: Option<&Path>) -> Result<Self, String> {
        let Header { arguments, name, case, settings, .. } = header;
        Self::read(arguments, Given { name, text: case, settings, table: None }, out)
    }

    /// Identity of the job.
    pub fn identity(&self) -> Result<Identity, String> {
        match self {
            Self::Bodies(job) => job.identity(),
            Self::Chart(job) => job.identity(),
            Self::Exponents(job) => job.identity(),
            Self::Section(job) => job.identity(),
            Self::Sweep(job) => job.identity(),
        }
    }

    /// Name of the file of a part.
    pub fn file_name(&self, part: Part) -> Result<String, String> {
        let form = match self {
            Self::Bodies(job) => job.form(),
            Self::Chart(job) => job.form(),
            Self::Exponents(job) => job.form(),
            Self::Section(job) => job.form(),
            Self::Sweep(job) => job.form(),
        };
        Ok(self.identity()?.file_name(part, form.ending()))
    }

    /// Computes a part as a file.
    pub fn file(&self, part: Part, threads: usize) -> Result<PartFile, String> {
        match self {
            Self::Bodies(job) => job.file(part, threads),
            Self::Chart(job) => job.file(part, threads),
            Self::Exponents(job) => job.file(part, threads),
            Self::Section(job) => job.file(part, threads),
            Self::Sweep(job) => job.file(part, threads),
        }
    }

    /// Reports the units of all parts, and writes the file of the whole job.
    pub fn report(&self, set: &Set) -> Result<CommandOutput, String> {
        match self {
            Self::Bodies(job) => job.report(job.units(set)?),
            Self::Chart(job) => job.report(job.units(set)?),
            Self::Exponents(job) => job.report(job.units(set)?),
            Self::Section(job) => job.report(job.units(set)?),
            Self::Sweep(job) => job.report(job.units(set)?),
        }
    }
}

/// Puts the case at hand in place of the file.
fn set(subject: &mut explore::motion::MotionArgs, given: Given<'_>) {
    subject.case = given.name.into();
    subject.settings = given.settings.to_vec();
}

fn no_job(arguments: &[String]) -> String {
    let words = arguments.join(" ");
    format!("error: `liouville {words}` is no job that may be done in parts")
}
