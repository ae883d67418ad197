//! The command line: arguments in, exit code out.

mod commands;

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::process::ExitCode;

use commands::{Answer, Command, Limits};

fn main() -> ExitCode {
    let command = commands::Arguments::read().command;
    let limits = limits(&command);
    if let Err(problem) = limits.check() {
        return commands::finish(Err(problem));
    }
    match limits.run(move || whole(&command)) {
        Ok(answer) => commands::finish(answer),
        Err(stop) => {
            anstream::eprintln!("error: not finished: {stop}\nhelp: allow more, or ask for less");
            ExitCode::from(commands::STOPPED)
        }
    }
}

/// Limits of a command that has nothing to show before its end.
fn limits(command: &Command) -> Limits {
    match command {
        Command::Eval(options) => options.limits,
        Command::Verify(options) => options.limits,
        Command::Explore(command) => command.limits(),
        _ => Limits::default(),
    }
}

/// Runs a command; a fault of the program becomes a message.
fn whole(command: &Command) -> Result<Answer, String> {
    catch_unwind(AssertUnwindSafe(|| run(command))).unwrap_or_else(|_| {
        Err("error: the program failed\n\
             help: this is a fault of the program: please report it with the case and the command"
            .to_string())
    })
}

fn run(command: &Command) -> Result<Answer, String> {
    match command {
        Command::Check(options) => commands::check::run(options),
        Command::Eval(options) => commands::eval::run(options),
        Command::Verify(options) => commands::verify::run(options),
        Command::Table(options) => commands::table::run(options),
        Command::Explore(command) => command.run(),
        Command::New(options) => commands::new::run(options),
        Command::Export(options) => commands::export::run(options),
        Command::Names(options) => commands::names::run(options),
        Command::Explain(options) => commands::explain::run(options),
        Command::Cases(options) => commands::cases::run(options),
        Command::Schema => commands::schema::run(),
        Command::Completions(options) => commands::completions::completions(options),
        Command::Man(options) => commands::completions::man(options),
    }
}
