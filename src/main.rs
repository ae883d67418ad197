//! The command line: arguments in, exit code out.

mod cli;

use std::process::ExitCode;

use clap::Parser;

fn main() -> ExitCode {
    let arguments = cli::Arguments::parse();
    let answer = match arguments.command {
        cli::Command::Check(options) => cli::check::run(&options),
        cli::Command::Eval(options) => cli::eval::run(&options),
        cli::Command::Table(options) => cli::table::run(&options),
        #[cfg(feature = "explore")]
        cli::Command::Explore(command) => command.run(),
    };
    cli::finish(answer)
}
