//! Commands and their options.

pub mod answers;
pub mod bodies;
pub mod cases;
mod certificates;
pub mod check;
mod check_args;
pub mod completions;
pub mod eval;
pub mod explain;
pub mod explore;
pub mod export;
mod files;
mod headings;
pub mod jobs;
mod judging;
mod limits;
pub mod merge;
pub mod names;
pub mod new;
mod out;
mod progress;
mod run;
mod sampling;
pub mod schema;
mod styles;
pub mod table;
mod threads;
pub mod verify;
mod watch;

use std::ffi::OsString;
use std::io::{ErrorKind, IsTerminal, Write};
use std::path::Path;

pub use crate::answer::CommandOutput;
pub use check_args::{CheckArgs, CheckFormat};
pub use limits::{LimitArgs, STOPPED};
pub use run::run;
pub use sampling::{SamplingArgs, parse_threads};

use crate::source;
use anstream::ColorChoice;
use clap::{CommandFactory, FromArgMatches, Parser, Subcommand, ValueEnum};

/// First steps, below the list of commands.
const FIRST_STEPS: &str = "\
Examples:
  liouville new rolling body.toml      start a case of a rolling body
  liouville check body.toml -v         judge its claims, with the evidence
  liouville report body.toml           list all of its invariants
  liouville cases list kovalevskaya    search the catalogue";

/// Decides which tensor invariants a mechanical system has.
#[derive(Debug, Parser)]
#[command(name = "liouville", version, max_term_width = 100, after_help = FIRST_STEPS)]
pub struct Arguments {
    /// Colours in the output
    #[arg(
        long,
        global = true,
        value_name = "WHEN",
        value_enum,
        default_value_t,
        hide_possible_values = true,
        help = "Colours in the output: auto, always or never"
    )]
    pub color: ColorArg,
    #[command(subcommand)]
    pub command: Command,
}

#[derive(Debug, Subcommand)]
pub enum Command {
    /// Judge the claims of case files
    #[command(after_help = "\
Examples:
  liouville check body.toml -v
  liouville check cases/plane --claim F2
  liouville check --source '(3.19)' --source 'Table 1, row 4'
  liouville check - < body.toml
  liouville check body.toml --settings bodies.csv --out verdicts.csv
  liouville check body.toml --settings bodies.csv --part 3/40 --out parts/
  liouville check body.toml --certificate proofs; python3 docs/certificates/check.py proofs/*")]
    Check(CheckArgs),
    /// Evaluate the field, its divergence and all claims of a case at one state
    #[command(
        after_help = "Example:\n  liouville eval plane/balanced-ball --set m=5/4 --digits 50"
    )]
    Eval(eval::Eval),
    #[command(flatten)]
    Explore(Box<explore::ExploreCommand>),
    /// Merge the parts of a job into the file that a single run would write
    #[command(after_help = "\
Examples:
  for i in 1 2 3 4; do liouville motion chart figures/fig-8 --x c1=0..2 --y c2=0..2 --part $i/4 --out parts/; done
  liouville merge parts --out chart.png
  liouville merge parts --out chart.pdf -- --colour exponent --width 85")]
    Merge(merge::Merge),
    /// Check certificates of proofs about motion, by integer ball arithmetic
    #[command(after_help = "\
Examples:
  liouville check figures/fig-8 --motion --claim 'no density' --certificate proofs
  liouville verify proofs/*.json")]
    Verify(verify::Verify),
    /// Print a hierarchy table of the papers, filled from verdicts
    #[command(after_help = "Example:\n  liouville table 1 --format latex")]
    Table(table::TableArgs),
    /// Write a commented template of a case
    #[command(after_help = "Example:\n  liouville new field system.toml")]
    New(new::New),
    /// Export the field, the level equations and the claims of a case as code
    #[command(after_help = "\
Examples:
  liouville export plane/balanced-ball --to python --claim F2 --out ball.py
  liouville export system.toml --to sympy")]
    Export(export::ExportArgs),
    /// List the names that formulas of a case may use
    #[command(after_help = "Example:\n  liouville names plane/balanced-ball")]
    Names(names::NamesArgs),
    /// Print a glossary entry
    #[command(after_help = "Example:\n  liouville explain witness")]
    Explain(explain::Explain),
    /// List, show or copy cases of the catalogue inside the program
    #[command(after_help = "Example:\n  liouville cases list rattleback")]
    Cases(cases::Cases),
    /// Print the JSON Schema of case files, for editors that complete and check them
    #[command(after_help = "Example:\n  liouville schema > liouville.schema.json")]
    Schema,
    /// Print the script that completes commands in a shell
    #[command(after_help = "\
Example:
  liouville completions bash > ~/.local/share/bash-completion/completions/liouville")]
    Completions(completions::Completions),
    /// Write the manual pages
    #[command(after_help = "Example:\n  liouville man ~/.local/share/man/man1")]
    Man(completions::Man),
}

/// Choice of colours.
#[derive(Clone, Copy, Debug, Default, ValueEnum)]
pub enum ColorArg {
    /// On a terminal, unless NO_COLOR is set
    #[default]
    Auto,
    Always,
    Never,
}

impl From<ColorArg> for ColorChoice {
    fn from(choice: ColorArg) -> Self {
        match choice {
            ColorArg::Auto => ColorChoice::Auto,
            ColorArg::Always => ColorChoice::Always,
            ColorArg::Never => ColorChoice::Never,
        }
    }
}

impl Arguments {
    /// Reads the arguments of the program; former names work, and are left out of the help.
    pub fn read(arguments: impl IntoIterator<Item = OsString>) -> Self {
        Self::parse_from(arguments).unwrap_or_else(|error| refuse(&error))
    }

    fn parse_from(arguments: impl IntoIterator<Item = OsString>) -> Result<Self, clap::Error> {
        Self::from_arg_matches(&Self::described().try_get_matches_from(arguments)?)
    }

    /// All commands and options; former names are hidden.
    fn described() -> clap::Command {
        let mut command = Self::command();
        let former = explore::FormerCommand::augment_subcommands(clap::Command::new("former"));
        for one in former.get_subcommands() {
            command = command.mut_subcommand(one.get_name(), |own| own.hide(true));
        }
        headings::grouped(headings::ordered(with_negative_numbers(command)))
    }
}

/// Lets options take negative numbers, whose own messages are better than one about an option `-1`.
fn with_negative_numbers(command: clap::Command) -> clap::Command {
    let takes_value = |own: &clap::Arg| !own.is_positional() && own.get_action().takes_values();
    command
        .mut_args(|own| if takes_value(&own) { own.allow_negative_numbers(true) } else { own })
        .mut_subcommands(with_negative_numbers)
}

/// Words of the reader of arguments about numbers, and ours.
const NUMBER_WORDS: [(&str, &str); 4] = [
    ("invalid digit found in string", "write a whole number, 0 or more"),
    ("cannot parse integer from empty string", "write a whole number, 0 or more"),
    ("number too large to fit in target type", "write a smaller number"),
    ("invalid float literal", "write a number"),
];

/// Words of its advice to take an unknown option for a file, which no user means.
const AS_VALUE: &str = "as a value, use '";
/// Unknown options, and what is meant.
const INSTEAD: [(&str, &str); 4] = [
    ("-o", "--out"),
    ("-t", "--time"),
    ("--latex", "--format latex"),
    ("--markdown", "--format markdown"),
];

/// Text of wrong arguments.
fn in_our_words(text: &str) -> String {
    let text = NUMBER_WORDS
        .iter()
        .fold(text.to_string(), |text, (theirs, ours)| text.replace(theirs, ours));
    let mut lines: Vec<String> = Vec::new();
    for line in text.split_inclusive('\n') {
        if !line.contains(AS_VALUE) {
            lines.push(line.to_string());
            continue;
        }
        match INSTEAD.iter().find(|(wrong, _)| line.contains(&format!("-- {wrong}"))) {
            Some((_, right)) => lines.push(format!("  tip: write '{right}'\n")),
            // An empty line goes with it.
            None => _ = lines.pop_if(|line| line.trim().is_empty()),
        }
    }
    lines.concat()
}

/// Prints what is wrong with the arguments, or the help that is asked for, and ends the program.
fn refuse(error: &clap::Error) -> ! {
    if !error.use_stderr() {
        error.exit();
    }
    anstream::eprint!("{}", in_our_words(&error.render().ansi().to_string()));
    std::process::exit(error.exit_code())
}

/// Prints the answer, or the problem, and returns the exit code; invalid input exits with 2.
pub fn finish(answer: Result<CommandOutput, String>) -> u8 {
    match answer {
        Ok(answer) => {
            let mut out = anstream::stdout().lock();
            match out.write_all(answer.text.as_bytes()).and_then(|()| out.flush()) {
                // A reader that closes the pipe has read enough.
                Err(error) if error.kind() != ErrorKind::BrokenPipe => {
                    anstream::eprintln!("error: cannot write the answer: {error}");
                    return 2;
                }
                _ => {}
            }
            answer.code
        }
        Err(problem) => {
            anstream::eprintln!("{problem}");
            2
        }
    }
}

/// Writes a file that must not exist yet.
fn write_new(path: &Path, text: &str) -> Result<(), String> {
    let file = std::fs::OpenOptions::new().write(true).create_new(true).open(path);
    file.and_then(|mut file| file.write_all(text.as_bytes())).map_err(|error| {
        let shown = path.display();
        match error.kind() {
            ErrorKind::AlreadyExists => {
                format!(
                    "error: {shown} exists already\nhelp: give another name, or remove it first"
                )
            }
            _ => format!(
                "error: cannot write {shown}: {error}\nhelp: give a path in a folder that exists"
            ),
        }
    })
}

/// Whether to colour what goes to a terminal, or elsewhere.
pub fn colour(terminal: bool) -> bool {
    match ColorChoice::global() {
        ColorChoice::Always | ColorChoice::AlwaysAnsi => true,
        ColorChoice::Never => false,
        ColorChoice::Auto => {
            terminal && std::env::var_os("NO_COLOR").is_none_or(|value| value.is_empty())
        }
    }
}

/// Width to lay tables out for: that of the terminal, or a fixed one for files and pipes.
pub fn width() -> u16 {
    const WIDE: u16 = 160;
    if !std::io::stdout().is_terminal() {
        return WIDE;
    }
    let asked = std::env::var("COLUMNS").ok().and_then(|text| text.parse().ok());
    let of_terminal = || terminal_size::terminal_size().map(|(width, _)| width.0);
    asked.or_else(of_terminal).unwrap_or(WIDE).clamp(60, 240)
}
