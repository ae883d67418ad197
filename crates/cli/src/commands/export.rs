//! The command `liouville export`.

use std::io::IsTerminal;
use std::path::{Path, PathBuf};

use crate::report::export::{self, Language};
use crate::report::{diagnostic, sha256};
use clap::Args;
use liouville::case::Case;
use liouville::program::Program;

use super::check::is_meant;
use super::eval::read_settings;
use super::{CommandOutput, colour, out, source};

#[derive(Debug, Args)]
pub struct ExportArgs {
    /// Case file, `-` for standard input, or a case of the catalogue inside the program
    pub case: PathBuf,
    /// Language of the code
    #[arg(long, value_enum)]
    pub to: Language,
    /// Write only claims whose name or source contains this text, or matches it if it has `*` or
    /// `?`
    #[arg(long = "claim", value_name = "TEXT")]
    pub claims: Vec<String>,
    /// Give a parameter a value: --set m=5/4 --set 'I=[2,2,3]'
    #[arg(long = "set", value_name = "NAME=VALUE")]
    pub settings: Vec<String>,
    /// Write to this file instead of standard output
    #[arg(long, value_name = "FILE")]
    pub out: Option<PathBuf>,
}

pub fn run(options: &ExportArgs) -> Result<CommandOutput, String> {
    if let Some(path) = &options.out {
        out::check(path, "--out", &[&options.case])?;
    }
    let shown = options.case.display().to_string();
    let (text, case) = source::read(&options.case, &read_settings(&options.settings)?);
    let coloured = colour(std::io::stderr().is_terminal());
    let case = case.map_err(|error| {
        diagnostic::rendered(&diagnostic::of_case(&shown, &text, &error, coloured))
    })?;
    let wanted = |name: &str, source: &str| {
        options.claims.is_empty()
            || options.claims.iter().any(|pattern| is_meant(name, source, pattern))
    };
    let keep: Vec<bool> =
        case.claims.iter().map(|claim| wanted(&claim.name, &claim.source)).collect();
    if !options.claims.is_empty() && !keep.contains(&true) {
        return Err(nothing_meant(&case, &wanted, &options.claims));
    }
    let program = Program::of(&case, |index| keep[index]).map_err(|error| {
        diagnostic::of_file(&shown, &error.to_string(), FAULT, coloured).rendered
    })?;
    let mut origin = vec![format!(
        "Written by liouville {} from {shown}, SHA-256 {}.",
        env!("CARGO_PKG_VERSION"),
        sha256(&text)
    )];
    origin.extend(options.settings.iter().map(|setting| format!("Given by --set: {setting}.")));
    let module = module(options.out.as_deref(), &options.case);
    let whole =
        export::ExportedCase { case: &case, program: &program, module: &module, origin: &origin };
    let code = export::render(&whole, options.to).map_err(|problem| {
        let help = "export to sympy, maple or mathematica, whose numbers are exact";
        diagnostic::of_file(&shown, &problem, help, coloured).rendered
    })?;
    match &options.out {
        None => Ok(CommandOutput { text: code, code: 0 }),
        Some(path) => {
            out::write(path, "--out", &code)?;
            Ok(CommandOutput { text: format!("{}\n", path.display()), code: 0 })
        }
    }
}

const FAULT: &str = "write the formula with operations that hold for every number";

/// Message for patterns that no claim with a residual matches.
fn nothing_meant(case: &Case, wanted: &dyn Fn(&str, &str) -> bool, patterns: &[String]) -> String {
    let motions = case.motions.iter().any(|own| wanted(&own.name, &own.source));
    let absences = case.absences.iter().any(|own| wanted(&own.name, &own.source));
    let patterns = patterns.join("` or `");
    match motions || absences {
        true => format!(
            "error: `{patterns}` is a claim about motion or of absence, which has no residual\n\
             help: leave out --claim to export the field and the other claims"
        ),
        false => format!(
            "error: no claim has a name or source like `{patterns}`\n\
             help: `liouville check -v` shows the names"
        ),
    }
}

/// Name of a module: that of the file written, or of the case.
fn module(out: Option<&Path>, case: &Path) -> String {
    let stem = out.unwrap_or(case).file_stem().and_then(|stem| stem.to_str()).unwrap_or_default();
    let plain = |c: char| if c.is_ascii_alphanumeric() { c } else { '_' };
    let name: String = stem.chars().map(plain).collect();
    match name.starts_with(|c: char| c.is_ascii_alphabetic()) {
        true => name,
        false => format!("case_{}", name.trim_start_matches('_')),
    }
}
