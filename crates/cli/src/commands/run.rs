//! The command line: arguments in, exit code out.

use std::ffi::OsString;
use std::panic::{AssertUnwindSafe, catch_unwind};

use anstream::ColorChoice;

use super::explore::share::Share;
use super::{Arguments, Command, CommandOutput, LimitArgs, STOPPED, finish};

/// Runs the program with these arguments, the first of which is its name, and returns its exit
/// code. Help and wrong arguments end the process.
pub fn run(arguments: impl IntoIterator<Item = OsString>) -> u8 {
    let arguments: Vec<OsString> = arguments.into_iter().collect();
    let read = Arguments::read(arguments.clone());
    ColorChoice::from(read.color).write_global();
    let mut command = read.command;
    let own = arguments.get(1..).unwrap_or_default();
    let mut remedy = "allow more, or ask for less".to_string();
    if let Some(share) = share(&mut command) {
        share.keep(own);
        remedy = share.remedy();
    }
    let limits = limits(&command);
    if let Err(problem) = limits.check() {
        return finish(Err(problem));
    }
    match limits.run(move || whole(&command)) {
        Ok(answer) => finish(answer),
        Err(stop) => {
            anstream::eprintln!("error: not finished: {stop}\nhelp: {remedy}");
            STOPPED
        }
    }
}

/// Part of a job that may be done in parts.
fn share(command: &mut Command) -> Option<&mut Share> {
    match command {
        Command::Check(options) if options.bodies.settings.is_some() => Some(&mut options.share),
        Command::Explore(command) => command.share(),
        _ => None,
    }
}

/// Limits of a command that has nothing to show before its end.
fn limits(command: &Command) -> LimitArgs {
    match command {
        Command::Check(options) if options.bodies.settings.is_some() => options.limits,
        Command::Eval(options) => options.limits,
        Command::Verify(options) => options.limits,
        Command::Explore(command) => command.limits(),
        _ => LimitArgs::default(),
    }
}

/// Runs a command; a fault of the program becomes a message.
fn whole(command: &Command) -> Result<CommandOutput, String> {
    catch_unwind(AssertUnwindSafe(|| carry_out(command))).unwrap_or_else(|_| {
        Err("error: the program failed\n\
             help: this is a fault of the program: please report it with the case and the command"
            .to_string())
    })
}

fn carry_out(command: &Command) -> Result<CommandOutput, String> {
    match command {
        Command::Check(options) => super::check::run(options),
        Command::Eval(options) => super::eval::run(options),
        Command::Verify(options) => super::verify::run(options),
        Command::Merge(options) => super::merge::run(options),
        Command::Table(options) => super::table::run(options),
        Command::Explore(command) => command.run(),
        Command::New(options) => super::new::run(options),
        Command::Export(options) => super::export::run(options),
        Command::Names(options) => super::names::run(options),
        Command::Explain(options) => super::explain::run(options),
        Command::Cases(options) => super::cases::run(options),
        Command::Schema => super::schema::run(),
        Command::Completions(options) => super::completions::completions(options),
        Command::Man(options) => super::completions::man(options),
    }
}
