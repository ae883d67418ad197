//! The command `liouville motion section`.

use std::path::PathBuf;

use crate::parts::{Form, Identity, Job, json_line, json_unit};
use crate::report::data::DataTable;
use crate::report::exponents::MotionRow;
use crate::report::section::sphere;
use clap::Args;
use liouville::case::{Case, FixedLine};
use liouville::part::Part;
use liouville_draw::{Plot, Text, plain};
use liouville_flow::{FlowError, SectionOrbit, SurfaceOrbit};
use serde::{Deserialize, Serialize};

use super::chart::parse_size;
use super::eval::Opened;
use super::ink::Ink;
use super::motion::{
    CrossingArgs, MotionArgs, Threads, parse_count, parse_float, parse_positive, parse_start,
    rendered,
};
use super::output::{Ending, Output};
use super::share::{Share, Target, carry_out};
use super::starts::Starts;
use super::watching::watched;
use super::{CommandOutput, andoyer, surface, write};

#[derive(Clone, Debug, Args)]
pub struct SectionArgs {
    #[command(flatten)]
    pub subject: MotionArgs,
    /// Further cases: all are drawn as one picture, with letters
    #[arg(value_name = "CASE")]
    pub others: Vec<PathBuf>,
    /// Plots across and down of a picture of several cases; as square as can be by default
    #[arg(long, value_name = "NXxNY", value_parser = parse_size)]
    pub panels: Option<[usize; 2]>,
    #[command(flatten)]
    pub crossing: CrossingArgs,
    /// Number of orbits to start, spread over the sphere; with --section, of states drawn
    #[arg(long, value_parser = parse_count)]
    pub orbits: Option<usize>,
    #[command(flatten)]
    pub starts: Starts,
    /// Integrate backwards in time
    #[arg(long)]
    pub backwards: bool,
    /// Colour the orbits by the value of this claim's formula, instead of one by one; `one` draws all
    /// in one colour
    #[arg(long, value_name = "CLAIM")]
    pub colour: Option<String>,
    /// Integrate forwards and backwards in time, in two colours: attractor and repeller
    #[arg(long, conflicts_with_all = ["backwards", "colour"])]
    pub both_ways: bool,
    /// Shade the density of the crossings in place of single dots, for attractors
    #[arg(long, conflicts_with_all = ["both_ways", "colour", "separatrices"])]
    pub shade: bool,
    /// Draw the sphere of (l, L/G) as two discs, L > 0 and L < 0, in a projection that preserves areas
    #[arg(long, conflicts_with_all = ["shade", "others", "section", "part"])]
    pub sphere: bool,
    /// Leave out the marks of the periodic points that the case claims
    #[arg(long)]
    pub no_marks: bool,
    /// Draw the images of these lines of fixed points of reversors: L=0, l=0 (and π), l=π/2 (and
    /// 3π/2)
    #[arg(long, value_delimiter = ',')]
    pub lines: Vec<FixedLine>,
    /// Number of images of the lines, forwards and backwards
    #[arg(long, value_parser = parse_positive)]
    pub images: Option<usize>,
    /// Draw the stable and unstable curves of the hyperbolic point near l,L/G (of period n: l,L/G,n);
    /// may be repeated
    #[arg(long, value_name = "L,Z[,N]", value_parser = parse_point, allow_hyphen_values = true)]
    pub separatrices: Vec<([f64; 2], usize)>,
    /// Classify each orbit by its exponents over this time and back: --classes, --classes=5000
    #[arg(long, value_name = "TIME", num_args = 0..=1, require_equals = true, default_missing_value = "2000", value_parser = parse_time)]
    pub classes: Option<f64>,
    #[command(flatten)]
    pub ink: Ink,
    #[command(flatten)]
    pub share: Share,
    #[command(flatten)]
    pub threads: Threads,
}

/// Reads a time for which motions are classified.
fn parse_time(text: &str) -> Result<f64, String> {
    let time = parse_float(text).ok().filter(|time: &f64| *time > 0.0 && time.is_finite());
    time.ok_or("write a positive time".to_string())
}

/// Reads a point of a section with its period.
fn parse_point(text: &str) -> Result<([f64; 2], usize), String> {
    match text.match_indices(',').nth(1) {
        None => Ok((parse_start(text)?, 1)),
        Some((comma, _)) => {
            let period = text[comma + 1..].trim().parse().ok().filter(|n| (1..=1000).contains(n));
            let period = period.ok_or("the period is a number from 1 to 1000".to_string())?;
            Ok((parse_start(&text[..comma])?, period))
        }
    }
}

/// Section of one case.
pub struct Drawn {
    pub title: String,
    /// Words below its picture.
    pub facts: Text,
    /// Report for the terminal, or JSON.
    pub text: String,
    pub plot: Option<Plot>,
    pub data: Option<DataTable<'static>>,
}

/// Wish of a section: the file's ending, and the number of plots side by side.
#[derive(Clone, Copy)]
pub struct Wish {
    pub ending: Option<Ending>,
    pub columns: usize,
}

impl Wish {
    pub fn is_picture(self) -> bool {
        self.ending.is_some_and(Ending::is_picture)
    }

    pub fn is_data(self) -> bool {
        self.ending.is_some_and(|ending| !ending.is_picture())
    }
}

/// A motion with its crossings.
#[derive(Debug, Serialize, Deserialize)]
pub enum Unit {
    /// Motion through g = g₀.
    Andoyer {
        /// Motion.
        orbit: SectionOrbit,
        /// The same motion the other way in time, if that is drawn too.
        other: Option<Box<SectionOrbit>>,
        /// Its exponents, if it is classified.
        class: Option<Box<MotionRow>>,
    },
    /// Motion through a surface.
    Surface {
        /// Name of the start.
        start: String,
        /// Motion.
        orbit: SurfaceOrbit,
    },
}

pub fn run(options: &SectionArgs) -> Result<CommandOutput, String> {
    if options.share.part.is_some() {
        if !options.others.is_empty() {
            return Err("error: --part is for one case\n\
                        help: compute the parts of each case, and merge each to data"
                .to_string());
        }
        let job = SectionJob::new(options.clone(), options.subject.opened()?)?;
        let threads = options.threads.count();
        return carry_out(
            &job,
            &options.share,
            Target { out: options.ink.out.as_deref(), threads },
        );
    }
    watched(options.subject.limits, Some(&options.share.remedy()), || answer(options))
}

/// Follows the motions and writes their file; returns the report, and whether some were stopped.
fn answer(options: &SectionArgs) -> Result<(String, bool), String> {
    let first = &options.subject;
    let others =
        options.others.iter().map(|case| MotionArgs { case: case.clone(), ..first.clone() });
    let subjects: Vec<MotionArgs> = [first.clone()].into_iter().chain(others).collect();
    let cases: Vec<Case> = subjects.iter().map(MotionArgs::open).collect::<Result<_, _>>()?;
    let layout = Layout::new(options, cases.len())?;
    let (mut all, mut is_stopped) = (Vec::new(), false);
    for (subject, case) in subjects.iter().zip(&cases) {
        let units =
            compute(case, subject, options, layout.wish, Part::WHOLE, options.threads.count())?;
        is_stopped |= units.iter().any(|unit| unit.problem() == Some(&FlowError::Stopped));
        all.push(drawn(case, subject, options, layout.wish, units)?);
    }
    Ok((layout.finish(options, all)?.text, is_stopped))
}

impl Unit {
    /// Reason why the motion ended early.
    fn problem(&self) -> Option<&FlowError> {
        match self {
            Unit::Andoyer { orbit, .. } => orbit.problem.as_ref(),
            Unit::Surface { orbit, .. } => orbit.problem.as_ref(),
        }
    }
}

/// Follows the motions of a part.
fn compute(
    case: &Case,
    subject: &MotionArgs,
    options: &SectionArgs,
    wish: Wish,
    part: Part,
    threads: usize,
) -> Result<Vec<Unit>, String> {
    match options.crossing.section.is_some() {
        true => surface::compute(case, subject, options, wish, (part, threads)),
        false => andoyer::compute(case, subject, options, (part, threads)),
    }
}

/// Section of one case by its motions.
fn drawn(
    case: &Case,
    subject: &MotionArgs,
    options: &SectionArgs,
    wish: Wish,
    units: Vec<Unit>,
) -> Result<Drawn, String> {
    match options.crossing.section.is_some() {
        true => surface::drawn(case, subject, options, wish, units),
        false => andoyer::drawn(case, subject, options, wish, units),
    }
}

/// Section of a case, which may be computed in parts.
#[derive(Debug)]
pub struct SectionJob {
    options: SectionArgs,
    opened: Opened,
}

impl SectionJob {
    pub(in crate::commands) fn new(options: SectionArgs, opened: Opened) -> Result<Self, String> {
        if options.share.part.is_none() {
            Layout::new(&options, 1)?;
        }
        Ok(Self { options, opened })
    }

    /// Titles of the axes of a surface; `None` for g = g₀.
    pub fn axes(&self) -> Result<Option<Vec<String>>, String> {
        match self.options.crossing.section.is_some() {
            true => surface::axes(&self.opened.case, &self.options).map(Some),
            false => Ok(None),
        }
    }
}

impl Job for SectionJob {
    type Unit = Unit;

    fn identity(&self) -> Result<Identity, String> {
        let (case, options) = (&self.opened.case, &self.options);
        let (count, request) = match options.crossing.section.is_some() {
            true => surface::request_text(case, options)?,
            false => andoyer::request_text(case, options)?,
        };
        let (text, share) = (&self.opened.text, &options.share);
        Ok(options.subject.identity("section", text, (count as u64, request), share))
    }

    fn form(&self) -> Form {
        Form::Json
    }

    fn compute(&self, part: Part, threads: usize) -> Result<Vec<Unit>, String> {
        let Self { options, opened: Opened { case, .. } } = self;
        compute(case, &options.subject, options, Wish { ending: None, columns: 1 }, part, threads)
    }

    fn line(&self, _: u64, unit: &Unit) -> Result<String, String> {
        json_line(unit)
    }

    fn unit(&self, line: &str) -> Result<Unit, String> {
        json_unit(line)
    }

    fn report(&self, units: Vec<Unit>) -> Result<CommandOutput, String> {
        let Self { options, opened: Opened { case, .. } } = self;
        let layout = Layout::new(options, 1)?;
        let drawn = drawn(case, &options.subject, options, layout.wish, units)?;
        layout.finish(options, vec![drawn])
    }
}

/// File to write, and places of the plots in it.
struct Layout {
    out: Option<Output>,
    columns: usize,
    wish: Wish,
}

impl Layout {
    /// Layout of this number of cases.
    fn new(options: &SectionArgs, count: usize) -> Result<Self, String> {
        let square = (1..).find(|side| side * side >= count).unwrap_or(1);
        let [columns, rows] = options.panels.unwrap_or([square, count.div_ceil(square)]);
        if columns * rows < count {
            return Err(format!(
                "error: --panels has room for {} of {count} cases\nhelp: write --panels {square}x{}",
                columns * rows,
                count.div_ceil(square)
            ));
        }
        let out = options.output()?;
        let wish = Wish { ending: out.as_ref().map(|out| out.ending), columns };
        if wish.is_data() && count > 1 {
            return Err("error: several cases are one picture, and no data\n\
                        help: end --out in .svg, .pdf or .png, or give one case"
                .to_string());
        }
        Ok(Self { out, columns, wish })
    }

    /// Writes the file, and reports.
    fn finish(
        &self,
        options: &SectionArgs,
        mut drawn: Vec<Drawn>,
    ) -> Result<CommandOutput, String> {
        let mut saved = String::new();
        if let Some(out) = &self.out {
            let plots = drawn.iter_mut().filter_map(|one| one.plot.take());
            let (plots, columns) = match options.sphere {
                true => (plots.flat_map(|plot| sphere::discs(&plot)).collect(), 2),
                false => (plots.collect::<Vec<Plot>>(), self.columns),
            };
            let bytes = match drawn.first().and_then(|one| one.data.as_ref()) {
                Some(data) => {
                    if options.crossing.section.is_some() {
                        let (rows, columns) = (data.rows.len(), data.columns.join(", "));
                        saved = format!("{}: {rows} rows of {columns}\n", out.path.display());
                    }
                    rendered(data, out.ending)
                }
                None => options.ink.drawn(words(&drawn), plots, columns, out.ending)?,
            };
            write(&out.path, "--out", bytes)?;
        }
        let text = match (options.subject.json, &drawn[..]) {
            (true, [one]) => one.text.clone() + "\n",
            (true, all) => {
                let all =
                    all.iter().map(|one| serde_json::from_str::<serde_json::Value>(&one.text));
                let all = all
                    .collect::<Result<Vec<_>, _>>()
                    .map_err(|error| format!("error: {error}"))?;
                serde_json::json!({ "sections": all }).to_string() + "\n"
            }
            (false, all) => {
                all.iter().map(|one| one.text.as_str()).collect::<Vec<_>>().join("\n") + &saved
            }
        };
        Ok(CommandOutput { text, code: 0 })
    }
}

/// Title and caption: of several plots the titles, with their letters.
fn words(drawn: &[Drawn]) -> (&str, Vec<Text>) {
    match drawn {
        [one] => (one.title.as_str(), vec![one.facts.clone()]),
        all => {
            let letters = all.iter().zip('a'..);
            let named = letters.map(|(one, letter)| format!("({letter})\u{a0}{}", one.title));
            ("", vec![plain(&named.collect::<Vec<_>>().join("; "))])
        }
    }
}

impl SectionArgs {
    /// File to write.
    pub fn output(&self) -> Result<Option<Output>, String> {
        let inputs = [self.subject.case.as_path()].into_iter().chain(self.starts.inputs());
        let inputs: Vec<_> = inputs.chain(self.others.iter().map(PathBuf::as_path)).collect();
        self.ink.output(Ending::ALL, &inputs)
    }
}
