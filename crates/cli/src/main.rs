//! The command line: arguments in, exit code out.

mod commands;

use std::process::ExitCode;

use clap::Parser;

fn main() -> ExitCode {
    let arguments = commands::Arguments::parse();
    let answer = match arguments.command {
        commands::Command::Check(options) => commands::check::run(&options),
        commands::Command::Eval(options) => commands::eval::run(&options),
        commands::Command::Table(options) => commands::table::run(&options),
        commands::Command::Explore(command) => command.run(),
    };
    commands::finish(answer)
}
