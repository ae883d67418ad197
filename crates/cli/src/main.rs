//! The command line: arguments in, exit code out.

mod commands;

use std::process::ExitCode;

fn main() -> ExitCode {
    let arguments = commands::Arguments::read();
    let answer = match arguments.command {
        commands::Command::Check(options) => commands::check::run(&options),
        commands::Command::Eval(options) => commands::eval::run(&options),
        commands::Command::Table(options) => commands::table::run(&options),
        commands::Command::Explore(command) => command.run(),
        commands::Command::New(options) => commands::new::run(&options),
        commands::Command::Export(options) => commands::export::run(&options),
        commands::Command::Names(options) => commands::names::run(&options),
        commands::Command::Explain(options) => commands::explain::run(&options),
        commands::Command::Cases(options) => commands::cases::run(&options),
    };
    commands::finish(answer)
}
