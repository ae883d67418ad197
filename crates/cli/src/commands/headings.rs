//! Order of the commands and headings of the options in `--help`.

use clap::{Arg, Command};

/// Commands by family: judge, find, move, files, shell, and the program itself.
const ORDER: [&str; 19] = [
    "check",
    "eval",
    "verify",
    "search",
    "report",
    "site",
    "table",
    "motion",
    "sweep",
    "new",
    "names",
    "explain",
    "cases",
    "export",
    "merge",
    "schema",
    "completions",
    "man",
    "measure",
];

/// Number of options above which they are grouped.
const MOST_IN_ONE_LIST: usize = 15;

/// Headings, each with the names of its options; all others are under "Options".
const HEADINGS: [(&str, &[&str]); 6] = [
    ("Starts", &["start", "starts", "state", "index", "orbits"]),
    (
        "Section",
        &["section", "g0", "energy", "fix", "axes", "crossings", "skip", "direction", "period"],
    ),
    ("Output", &["out", "format", "json", "every", "columns", "track", "verbose", "quiet"]),
    (
        "Picture",
        &[
            "panels",
            "colour",
            "shade",
            "sphere",
            "no-marks",
            "width",
            "height",
            "dpi",
            "point-size",
            "opacity",
            "title",
            "caption",
            "dark",
        ],
    ),
    ("Tables and parts", &["settings", "part", "force"]),
    (
        "Sampling and limits",
        &[
            "seed",
            "states",
            "trust",
            "threads",
            "within",
            "megabytes",
            "count-seconds",
            "count-megabytes",
        ],
    ),
];

/// Puts the commands in order.
pub fn ordered(command: Command) -> Command {
    ORDER.iter().enumerate().fold(command, |command, (place, name)| {
        command.mut_subcommand(name, |own| own.display_order(place))
    })
}

/// Groups the options of commands with many.
pub fn grouped(command: Command) -> Command {
    let command = match command.get_opts().count() > MOST_IN_ONE_LIST {
        true => command.mut_args(under_heading),
        false => command,
    };
    command.mut_subcommands(grouped)
}

fn under_heading(own: Arg) -> Arg {
    let name = own.get_long().unwrap_or_default();
    let heading = HEADINGS.iter().find(|(_, names)| names.contains(&name));
    match heading {
        Some((heading, _)) => own.help_heading(*heading),
        None => own,
    }
}
