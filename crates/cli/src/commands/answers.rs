//! Answers of commands about motions as JSON, with a case at hand instead of a file.

use super::explore::motion::MotionArgs;
use super::explore::{ExploreCommand, FormerCommand, MotionCommand, branch};
use super::jobs::{Given, parsed};
use super::{Command, CommandOutput};

/// Carries out a command about closed orbits, diagrams, rotation numbers or basins; returns what it
/// prints with `--json`.
///
/// # Errors
///
/// The message that the command prints, for wrong arguments, another command, and motions that
/// cannot be followed.
pub fn motion(arguments: &[String], given: Given<'_>) -> Result<String, String> {
    let Command::Explore(command) = parsed(arguments)? else { return Err(no_motion(arguments)) };
    let mut motion = match *command {
        ExploreCommand::Motion { command }
        | ExploreCommand::Former(FormerCommand::Motion(command)) => *command,
        _ => return Err(no_motion(arguments)),
    };
    let put = |subject: &mut MotionArgs| {
        subject.case = given.name.into();
        subject.text = Some(given.text.to_string());
        subject.settings = given.settings.to_vec();
        subject.json = true;
    };
    let table = || given.table.map(str::to_string);
    match &mut motion {
        MotionCommand::Periodic(options) => {
            put(&mut options.search.subject);
            options.search.starts.text = table();
        }
        MotionCommand::Continue(options) => {
            put(&mut options.search.subject);
            options.search.starts.text = table();
            // the signals belong to the caller
            return branch::answer(options).map(|(text, _)| text);
        }
        MotionCommand::Diagram(options) => {
            put(&mut options.subject);
            options.starts.text = table();
        }
        MotionCommand::Rotation(options) => put(&mut options.subject),
        MotionCommand::Basins(options) => put(&mut options.subject),
        _ => return Err(no_motion(arguments)),
    }
    motion.run().map(|CommandOutput { text, .. }| text)
}

fn no_motion(arguments: &[String]) -> String {
    format!("error: `liouville {}` has no answer of this kind", arguments.join(" "))
}
