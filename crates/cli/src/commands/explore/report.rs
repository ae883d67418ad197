//! The command `liouville report`.

use std::io::IsTerminal;
use std::path::PathBuf;

use crate::report::{CaseDigest, diagnostic, survey as written};
use clap::{Args, ValueEnum};
use liouville::case::Case;
use liouville_search::Halt;
use liouville_search::survey::{self, Survey};

use super::bodies::{self, BodiesArgs};
use super::eval::open_signed;
use super::motion::Threads;
use super::share::Share;
use super::telling;
use super::{CommandOutput, LimitArgs, SamplingArgs, colour, out, width};

#[derive(Debug, Args)]
pub struct ReportArgs {
    /// Case file; claims are not needed
    pub case: PathBuf,
    /// Give a parameter a value: --set m=5/4 --set 'I=[2,2,3]'; others stay general
    #[arg(long = "set", value_name = "NAME=VALUE")]
    pub settings: Vec<String>,
    #[command(flatten)]
    pub bodies: BodiesArgs,
    /// Output format; text for a terminal, unless --out implies another
    #[arg(long, value_enum)]
    pub format: Option<ReportFormat>,
    /// Print JSON
    #[arg(long, conflicts_with = "format")]
    pub json: bool,
    /// Write to this file in place of standard output; .html, .md, .tex and .json set the format.
    /// With --settings the results, as .csv, .json or .jsonl; with --part the folder of the parts
    #[arg(long, value_name = "FILE")]
    pub out: Option<PathBuf>,
    #[command(flatten)]
    pub share: Share,
    /// Show evidence and witnesses in text
    #[arg(short, long, conflicts_with = "bodies_table")]
    pub verbose: bool,
    #[command(flatten)]
    pub limits: LimitArgs,
    #[command(flatten)]
    pub sampling: SamplingArgs,
}

/// Format of a report.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum ReportFormat {
    /// Text for a terminal
    Text,
    /// Markdown, with formulas as LaTeX between dollars
    Markdown,
    /// LaTeX, as a complete document
    Latex,
    /// One self-contained page
    Html,
    /// One row for each body of --settings
    Csv,
    /// JSON, one line for each body of --settings
    Jsonl,
}

/// Endings of files that imply a format.
const ENDINGS: [&str; 7] = ["html", "htm", "md", "markdown", "tex", "json", "txt"];

pub fn run(options: &ReportArgs) -> Result<CommandOutput, String> {
    if options.bodies.settings.is_some() {
        return bodies::report(options);
    }
    let of_bodies = match options.format {
        Some(ReportFormat::Csv) => Some("csv"),
        Some(ReportFormat::Jsonl) => Some("jsonl"),
        _ => None,
    };
    bodies::refuse(&options.share, of_bodies)?;
    if let Some(path) = &options.out {
        out::check(path, "--out", &[&options.case])?;
        if options.format.is_none() && !options.json {
            out::check_ending(path, "--out", &ENDINGS)?;
        }
    }
    let (case, digest) = open_signed(&options.case, &options.settings)?;
    let halt = Halt::default();
    let found = telling(halt.meter().clone(), |progress| {
        survey::survey(&case, &options.sampling.options(), &halt, progress)
    });
    let found = found.map_err(|error| {
        let shown = options.case.display().to_string();
        let coloured = colour(std::io::stderr().is_terminal());
        diagnostic::of_file(&shown, &error.to_string(), error.help(), coloured).rendered
    })?;
    let text = match form(options) {
        PageFormat::Json => {
            let json = written::json(&found).and_then(|json| digest.sign(&json));
            json.map_err(|error| format!("error: {error}"))? + "\n"
        }
        PageFormat::Readable(format) => readable(&case, &found, &digest, format, options),
    };
    match &options.out {
        None => Ok(CommandOutput { text, code: 0 }),
        Some(path) => {
            out::write(path, "--out", &text)?;
            Ok(CommandOutput { text: format!("{}\n", path.display()), code: 0 })
        }
    }
}

/// Form of the output.
enum PageFormat {
    Json,
    Readable(ReportFormat),
}

/// Form requested, or implied by the name of the file.
fn form(options: &ReportArgs) -> PageFormat {
    let extension = options.out.as_deref().and_then(|path| path.extension()?.to_str());
    match (options.json, options.format, extension) {
        (true, ..) => PageFormat::Json,
        (_, Some(format), _) => PageFormat::Readable(format),
        (_, None, Some("json")) => PageFormat::Json,
        (_, None, Some("html" | "htm")) => PageFormat::Readable(ReportFormat::Html),
        (_, None, Some("md" | "markdown")) => PageFormat::Readable(ReportFormat::Markdown),
        (_, None, Some("tex")) => PageFormat::Readable(ReportFormat::Latex),
        (_, None, _) => PageFormat::Readable(ReportFormat::Text),
    }
}

fn readable(
    case: &Case,
    found: &Survey,
    digest: &CaseDigest,
    format: ReportFormat,
    options: &ReportArgs,
) -> String {
    let origin = &digest.line();
    match format {
        ReportFormat::Text | ReportFormat::Csv | ReportFormat::Jsonl => {
            let colour = options.out.is_none() && colour(std::io::stdout().is_terminal());
            written::text(
                found,
                origin,
                written::PageStyle { verbose: options.verbose, colour, width: width() },
            )
        }
        ReportFormat::Markdown => written::markdown(found, origin),
        ReportFormat::Latex => written::latex(found, origin),
        ReportFormat::Html => {
            let sampling = &options.sampling;
            let motion = liouville_flow::portrait(
                case,
                sampling.seed,
                Threads { threads: sampling.threads }.count(),
            );
            written::html(found, origin, motion.as_ref())
        }
    }
}
