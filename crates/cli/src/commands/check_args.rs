//! Arguments of `liouville check`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use super::{LimitArgs, SamplingArgs, bodies, explore};

/// Folder that is judged where no path is given; that of the catalogue where there is none.
pub const CATALOGUE_FOLDER: &str = "cases";

#[derive(Clone, Debug, Args)]
pub struct CheckArgs {
    /// Case files, folders of them, or `-` for standard input; paths that do not exist are looked
    /// up in the catalogue inside the program
    #[arg(default_value = CATALOGUE_FOLDER)]
    pub paths: Vec<PathBuf>,
    /// Give a parameter a value: --set m=5/4 --set 'I=[2,2,3]'
    #[arg(long = "set", value_name = "NAME=VALUE")]
    pub settings: Vec<String>,
    #[command(flatten)]
    pub bodies: bodies::BodiesArgs,
    /// Show only claims whose kind is this text, or whose name or source contains it, or matches it
    /// if it has `*` or `?`
    #[arg(long = "claim", value_name = "TEXT")]
    pub claims: Vec<String>,
    /// Show only claims with this label of a publication: an equation, theorem, figure or cell of a
    /// table, or a pattern with `*` or `?`
    #[arg(long = "source", value_name = "LABEL")]
    pub sources: Vec<String>,
    /// Output format
    #[arg(long, value_enum, default_value_t = CheckFormat::Text, conflicts_with = "json")]
    pub format: CheckFormat,
    /// Print JSON
    #[arg(long)]
    pub json: bool,
    /// Write the results of --settings to this file, .csv, .json or .jsonl; with --part the folder
    /// of the parts
    #[arg(long, value_name = "FILE", requires = "bodies_table")]
    pub out: Option<PathBuf>,
    #[command(flatten)]
    pub share: explore::share::Share,
    /// Perturb every true formula, and refute each mutant that is not equivalent
    #[arg(long, conflicts_with = "bodies_table")]
    pub mutants: bool,
    /// Write a certificate of each proof by points of prime fields to this folder, for the checker
    /// in docs/certificates; with --motion also of each closed orbit, for `liouville verify`
    #[arg(long, value_name = "FOLDER", conflicts_with = "bodies_table")]
    pub certificate: Option<PathBuf>,
    /// Also check claims about motion (slow: minutes for cases/figures)
    #[arg(long)]
    pub motion: bool,
    /// Show each claim of each case, with witnesses and evidence
    #[arg(short, long, conflicts_with = "bodies_table")]
    pub verbose: bool,
    /// Print only the summary
    #[arg(short, long, conflicts_with = "verbose")]
    pub quiet: bool,
    /// Judge again whenever a file changes, until Ctrl-C
    #[arg(long, conflicts_with_all = ["bodies_table", "certificate"])]
    pub watch: bool,
    #[command(flatten)]
    pub limits: LimitArgs,
    #[command(flatten)]
    pub sampling: SamplingArgs,
}

/// Format of the verdicts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum CheckFormat {
    /// Text for a terminal
    Text,
    /// JSON, one document
    Json,
    /// JSON, one line for each body of --settings
    Jsonl,
    /// One line for each claim, with a header; for each body with --settings
    Csv,
    /// Annotations of GitHub's workflows: errors where a verdict is not as expected, warnings where a
    /// claim is undecided
    Github,
    /// JUnit's XML, for continuous integration
    Junit,
    /// A table of all claims as a LaTeX document, for any LaTeX
    Latex,
    /// A table of all claims as Markdown
    Markdown,
    /// A table of all claims as a web page
    Html,
}

impl CheckFormat {
    /// Whether it is a table with the formulas of all claims.
    pub fn is_table(self) -> bool {
        matches!(self, CheckFormat::Latex | CheckFormat::Markdown | CheckFormat::Html)
    }
}
