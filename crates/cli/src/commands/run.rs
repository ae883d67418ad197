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
    let mut remedy = None;
    if let Some(share) = share(&mut command) {
        share.keep(own);
        remedy = Some(share.remedy());
    }
    let (limits, all) = (limits(&command), all_limits(&command));
    if let Err(problem) = limits.check() {
        return finish(Err(problem));
    }
    match limits.run(move || whole(&command)) {
        Ok(answer) => bounded(finish(answer), all),
        Err(stop) => {
            anstream::eprintln!("{}", stop.message(remedy.as_deref()));
            STOPPED
        }
    }
}

/// Exit code of a command that has ended, with a message if it took more memory than it was to.
fn bounded(code: u8, limits: LimitArgs) -> u8 {
    match limits.exceeded().filter(|_| code != STOPPED) {
        None => code,
        Some(message) => {
            anstream::eprintln!("{message}");
            if code == 0 { STOPPED } else { code }
        }
    }
}

/// Limits that a command was given.
fn all_limits(command: &Command) -> LimitArgs {
    match command {
        Command::Check(options) => options.limits,
        Command::Explore(command) => command.all_limits(),
        _ => limits(command),
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

#[cfg(test)]
mod tests {
    use super::*;

    /// Commands that read or write texts, and compute nothing.
    const INSTANT: [&str; 12] = [
        "merge",
        "new",
        "export",
        "names",
        "explain",
        "list",
        "show",
        "copy",
        "schema",
        "completions",
        "man",
        "help",
    ];

    /// The commands without commands of their own.
    fn leaves<'a>(command: &'a clap::Command, found: &mut Vec<&'a clap::Command>) {
        if !command.has_subcommands() {
            found.push(command);
        }
        let shown = command.get_subcommands().filter(|one| !one.is_hide_set());
        shown.for_each(|one| leaves(one, found));
    }

    #[test]
    fn every_command_has_an_example_and_limits() {
        let program = Arguments::described();
        let mut found = Vec::new();
        leaves(&program, &mut found);
        assert!(found.len() > 25, "{}", found.len());
        for command in found {
            let name = command.get_name();
            let after = command.get_after_help().map(ToString::to_string).unwrap_or_default();
            assert!(after.contains("Example") || name == "help", "{name} has no example");
            for limit in ["within", "megabytes"] {
                let has = command.get_arguments().any(|one| one.get_id() == limit);
                assert!(has || INSTANT.contains(&name), "{name} has no --{limit}");
            }
        }
    }
}
