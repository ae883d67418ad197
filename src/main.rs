//! The command line: arguments in, exit code out.

mod cli;

use std::process::ExitCode;

use clap::Parser;

fn main() -> ExitCode {
    let arguments = cli::Arguments::parse();
    let answer = match arguments.command {
        cli::Command::Bench(options) => cli::bench::run(&options),
        cli::Command::Chart(options) => cli::chart::run(&options),
        cli::Command::Check(options) => cli::check::run(&options),
        cli::Command::Eval(options) => cli::eval::run(&options),
        cli::Command::Exponents(options) => cli::exponents::run(&options),
        cli::Command::Orbit(options) => cli::orbit::run(&options),
        cli::Command::Periodic(options) => cli::periodic::run(&options),
        cli::Command::Report(options) => cli::report::run(&options),
        cli::Command::Search(options) => cli::search::run(&options),
        cli::Command::Section(options) => cli::section::run(&options),
        cli::Command::Table(options) => cli::table::run(&options),
        cli::Command::Stress(options) => cli::stress::run(&options),
    };
    cli::finish(answer)
}
