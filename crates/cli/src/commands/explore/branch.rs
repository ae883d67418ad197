//! The command `liouville motion continue`.

use clap::Args;
use liouville::case::{Angle, Case};
use liouville::number::rational::Rational;
use liouville_flow::{
    Branch, BranchPoint, BranchRequest, BranchSection, Columns, Coordinate, CrossingSurface, Fixed,
    FlowError, Lexicon, branch, declared_range, number_with_pi,
};

use super::CommandOutput;
use super::eval::Opened;
use super::ink::{Ink, Sheet};
use super::motion::wrong_formula;
use super::output::Ending;
use super::periodic::OrbitSearch;
use super::surface::read_surface;
use super::telling;
use super::watching::watched;
use crate::report::branch::BranchReport;
use liouville_search::Meter;

#[derive(Debug, Args)]
pub struct ContinueArgs {
    #[command(flatten)]
    pub search: OrbitSearch,
    /// Quantity that varies: a parameter (a_g), a component of one (c3, I12), the energy, or an
    /// integral that the case claims and that is proved
    #[arg(long, value_name = "NAME")]
    pub parameter: String,
    /// Lower end of its range; by default that of the range in the case
    #[arg(long, value_name = "A", allow_hyphen_values = true)]
    pub from: Option<String>,
    /// Upper end of its range
    #[arg(long, value_name = "B", allow_hyphen_values = true)]
    pub to: Option<String>,
    /// Quantities reported and drawn, by formulas: --axes 'x, |γ|²'. By default l, L/G of a rolling
    /// body, and otherwise the first component of the state that --section leaves free
    #[arg(long, value_name = "FORMULAS", allow_hyphen_values = true)]
    pub axes: Option<String>,
    /// Largest number of points, each way from the start
    #[arg(long, default_value_t = 200, value_parser = clap::value_parser!(u32).range(1..=100_000))]
    pub count: u32,
    /// Longest step along the branch, as a part of the range
    #[arg(long, default_value = "0.02", value_parser = parse_step)]
    pub step: f64,
    #[command(flatten)]
    pub ink: Ink,
}

fn parse_step(text: &str) -> Result<f64, String> {
    let step = text.parse().ok().filter(|step| (1e-6..=0.5).contains(step));
    step.ok_or("write a number from 1e-6 to 0.5".to_string())
}

pub fn run(options: &ContinueArgs) -> Result<CommandOutput, String> {
    watched(options.search.subject.limits, None, || answer(options))
}

/// Follows the branch and writes its file; returns the report, and whether the branch was stopped
/// before its end.
pub fn answer(options: &ContinueArgs) -> Result<(String, bool), String> {
    let subject = &options.search.subject;
    let inputs: Vec<_> =
        [subject.case.as_path()].into_iter().chain(options.search.starts.inputs()).collect();
    let out = options.ink.output(Ending::CHARTS, &inputs)?;
    let opened = subject.opened()?;
    let case = &opened.case;
    if case.model.system.has_arbitrary_function() {
        return Err(subject.told(&FlowError::Arbitrary));
    }
    let (name, varied) =
        Coordinate::of_branch(case, options.parameter.trim()).map_err(|mistake| {
            format!("error: --parameter: {}\nhelp: {}", mistake.message, mistake.help)
        })?;
    let range = options.range(&opened, &name, varied)?;
    let surface = options.search.section.as_deref();
    let surface = surface.map(|text| read_surface(case, text)).transpose()?;
    let columns = options.columns(case, surface.as_ref())?;
    let titles = columns.as_ref().map(Columns::titles);
    let titles = titles.map_or_else(|| vec!["l".to_string(), "L/G".to_string()], <[_]>::to_vec);
    let (turns, proof, found) = options.follow(case, varied, &range, surface.as_ref(), columns)?;
    let report = BranchReport {
        case,
        name: &name,
        range: &range,
        titles: &titles,
        surface: surface.as_ref().map(CrossingSurface::text),
        period: options.search.period,
        turns,
        proof,
        branch: &found,
    };
    options.ink.save(
        out.as_ref(),
        &Sheet {
            title: &case.title,
            csv: &|| report.csv(),
            json: &|| report.json(),
            picture: &|| (report.caption(), report.plots()),
        },
    )?;
    let text = if subject.json { report.json()? } else { report.text() };
    Ok((text, report.is_stopped()))
}

impl ContinueArgs {
    /// Range of what varies, the lower end first.
    fn range(
        &self,
        opened: &Opened,
        name: &str,
        varied: Coordinate,
    ) -> Result<[Rational; 2], String> {
        let declared = declared(self, opened, varied);
        let end = |option: &str, text: Option<&String>, place: usize| {
            match (text, &declared) {
            (Some(text), _) => number_with_pi(text).ok_or_else(|| {
                format!(
                    "error: {option}: `{text}` is not a number\nhelp: write one, such as 3/2 or 0.25"
                )
            }),
            (None, Some(declared)) => Ok(declared[place].clone()),
            (None, None) => Err(format!(
                "error: the range of `{name}` is not known\nhelp: give --from and --to"
            )),
        }
        };
        let from = end("--from", self.from.as_ref(), 0)?;
        let to = end("--to", self.to.as_ref(), 1)?;
        if from >= to {
            return Err(format!(
                "error: --from {from} is not below --to {to}\nhelp: give the lower end by --from; the branch is followed both ways"
            ));
        }
        if let Some([low, high]) = &declared {
            for (option, value) in [("--from", &from), ("--to", &to)] {
                if value < low || value > high {
                    return Err(format!(
                        "error: {option} {value} is outside {low}..{high}, the range of `{name}` in the case\n\
                         help: stay within, or change the range in the case"
                    ));
                }
            }
        }
        Ok([from, to])
    }

    /// Quantities of the options; `None` for those of a rolling body.
    fn columns(
        &self,
        case: &Case,
        surface: Option<&CrossingSurface>,
    ) -> Result<Option<Columns>, String> {
        let free = surface.map(CrossingSurface::default_axes);
        let first = free.as_deref().and_then(|free| free.split(',').next());
        let Some(text) = self.axes.as_deref().or(first) else { return Ok(None) };
        let columns = Columns::read(Lexicon::new(case), text)
            .map_err(|mistake| wrong_formula("--axes", text, &mistake))?;
        match columns.titles().iter().any(|title| title == "t") && !case_has(case, "t") {
            true => Err("error: --axes: a point of a branch has no time\n\
                         help: leave `t` out: the period is always reported"
                .to_string()),
            false => Ok(Some(columns)),
        }
    }

    /// Finds the closed orbit, and follows its branch. Returns the number of times that the orbit is
    /// run through, and the proof that it closes, too.
    fn follow(
        &self,
        case: &Case,
        varied: Coordinate,
        range: &[Rational; 2],
        surface: Option<&CrossingSurface>,
        columns: Option<Columns>,
    ) -> Result<(u32, Result<String, String>, Branch), String> {
        let search = &self.search;
        let mut starts = search.starts(case)?;
        let (Some(given), true) = (starts.pop(), starts.is_empty()) else {
            return Err("error: a branch has one start\nhelp: give --start once".to_string());
        };
        let g0: Angle;
        let mut fixed = Vec::new();
        let section = match surface {
            Some(surface) => {
                fixed = search.plane.fixed(case)?;
                BranchSection::Surface(surface)
            }
            None if liouville_flow::has_andoyer_section(&case.model) => {
                let (angle, own) = search.plane.of(case)?;
                fixed.push(Fixed::energy(own));
                g0 = angle;
                BranchSection::Andoyer(&g0)
            }
            None => {
                return Err("error: the section of the orbits is not known\n\
                            help: give --section 'x = 0' with a surface that they cross"
                    .to_string());
            }
        };
        let orbit = search.proved(case, search.orbit(case, given, None)?)?;
        let turns = orbit.cycle.turns;
        let proof = orbit.proof.unwrap_or(Err("no proof was tried".to_string()));
        let request = BranchRequest {
            case,
            section,
            columns,
            varied,
            range: range.clone(),
            fixed,
            integrals: orbit.cycle.integrals,
            time: orbit.cycle.period.value,
            start: orbit.cycle.start,
            count: self.count as usize,
            longest: self.step,
        };
        let found = telling(Meter::default(), |tell| {
            let tell = std::cell::RefCell::new(tell);
            let progress = |point: &BranchPoint| {
                let words = format!("{} = {}", self.parameter, point.value);
                (tell.borrow_mut())(&words);
            };
            branch(&request, &progress)
        })
        .map_err(|error| search.subject.told(&error))?;
        Ok((turns, proof, found))
    }
}

fn case_has(case: &Case, name: &str) -> bool {
    case.model.vocabulary.find(name).is_some()
}

/// Range of what varies in the case itself, without a value of `--set`.
fn declared(options: &ContinueArgs, opened: &Opened, varied: Coordinate) -> Option<[Rational; 2]> {
    let subject = &options.search.subject;
    let Coordinate::Parameter { index, .. } = varied else { return None };
    let own = &opened.case.model.parameters.get(index)?.name;
    let is_other = |text: &&String| {
        let name = text.split('=').next().unwrap_or_default().trim();
        liouville::formula::canonical_name(name).as_deref().unwrap_or(name) != own
    };
    let settings: Vec<String> = subject.settings.iter().filter(is_other).cloned().collect();
    let read = super::eval::read_text(&subject.case, &opened.text, &settings).ok()?;
    declared_range(&read.case, varied)
}
