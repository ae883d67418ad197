//! Jobs that may be done in parts, read from the arguments of the command with a case at hand.

use std::path::Path;

use clap::FromArgMatches;
use liouville::part::Part;

use super::bodies::BodiesArgs;
use super::eval::{self, Opened};
use super::explore::motion::MotionArgs;
use super::explore::report::ReportArgs;
use super::explore::share::Share;
use super::explore::{self, MotionCommand};
use super::{Arguments, CheckArgs, Command, CommandOutput, in_our_words};
use crate::parts::{Form, Header, Identity, Job, PartFile, Set};

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

/// Does the same with a job of any kind.
macro_rules! of_any {
    ($own:expr, $job:ident => $body:expr) => {
        match $own {
            AnyJob::Bodies($job) => $body,
            AnyJob::Chart($job) => $body,
            AnyJob::Exponents($job) => $body,
            AnyJob::Section($job) => $body,
            AnyJob::Sweep($job) => $body,
        }
    };
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
    /// Puts the case in place of the file, with all arguments of the command.
    fn put(&self, subject: &mut MotionArgs, share: &mut Share, arguments: &[String]) {
        subject.case = self.name.into();
        subject.settings = self.settings.to_vec();
        share.arguments = arguments.to_vec();
    }

    /// Puts the table in place of the file of bodies, with all arguments of the command.
    fn put_table(&self, bodies: &mut BodiesArgs, share: &mut Share, arguments: &[String]) {
        bodies.text = self.table.map(str::to_string);
        share.arguments = arguments.to_vec();
    }

    /// The case, read from its text.
    fn opened(&self) -> Result<Opened, String> {
        eval::read_text(Path::new(self.name), self.text, self.settings)
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
        let command = match parsed(arguments)? {
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
                given.put(&mut options.subject, &mut options.share, arguments);
                options.out = out.map(Path::to_path_buf);
                return Ok(Self::Sweep(Box::new(SweepJob::new(options, given.opened()?)?)));
            }
            explore::ExploreCommand::Motion { command }
            | explore::ExploreCommand::Former(explore::FormerCommand::Motion(command)) => *command,
            _ => return Err(no_job(arguments)),
        };
        let out = out.map(Path::to_path_buf);
        match motion {
            MotionCommand::Chart(mut options) => {
                given.put(&mut options.subject, &mut options.share, arguments);
                options.ink.out = out;
                let opened = options.subject.read(given.text)?;
                Ok(Self::Chart(Box::new(ChartJob::new(options, opened)?)))
            }
            MotionCommand::Exponents(mut options) => {
                given.put(&mut options.subject, &mut options.share, arguments);
                options.starts.text = given.table.map(str::to_string);
                options.out = out;
                let opened = options.subject.read(given.text)?;
                Ok(Self::Exponents(Box::new(ExponentsJob::new(options, opened)?)))
            }
            MotionCommand::Section(mut options) => {
                given.put(&mut options.subject, &mut options.share, arguments);
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
        given.put_table(&mut options.bodies, &mut options.share, arguments);
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
        given.put_table(&mut options.bodies, &mut options.share, arguments);
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
        of_any!(self, job => job.identity())
    }

    /// Form of the files of parts.
    pub fn form(&self) -> Form {
        of_any!(self, job => job.form())
    }

    /// Computes a part as a file.
    pub fn file(&self, part: Part, threads: usize) -> Result<PartFile, String> {
        of_any!(self, job => job.file(part, threads))
    }

    /// Reports the units of all parts, and writes the file of the whole job.
    pub fn report(&self, set: &Set) -> Result<CommandOutput, String> {
        of_any!(self, job => job.report(job.units(set)?))
    }
}

/// Reads the arguments of a command, without the name of the program.
pub(super) fn parsed(arguments: &[String]) -> Result<Command, String> {
    let mut command = Arguments::described().no_binary_name(true).args_override_self(true);
    let matches = command
        .try_get_matches_from_mut(arguments)
        .and_then(|matches| Arguments::from_arg_matches(&matches));
    matches.map(|arguments| arguments.command).map_err(|error| in_our_words(&error.to_string()))
}

fn no_job(arguments: &[String]) -> String {
    let words = arguments.join(" ");
    format!("error: `liouville {words}` cannot be split into parts")
}
