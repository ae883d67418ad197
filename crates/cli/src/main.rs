//! The program `liouville`.

use std::process::ExitCode;

fn main() -> ExitCode {
    ExitCode::from(liouville_cli::run(std::env::args_os()))
}
