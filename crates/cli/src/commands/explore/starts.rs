//! Starts of motions, as options and files give them.

use std::path::{Path, PathBuf};

use clap::Args;
use liouville::case::Case;
use liouville::formula::canonical_name;
use liouville::number::rational::Rational;
use liouville::verdict;
use liouville_flow::{FlowError, Start, number_with_pi};
use liouville_report::evidence::shell_quoted;

use super::source;

/// Starts of the motions.
#[derive(Clone, Debug, Args)]
pub struct Starts {
    /// Start: 'x=1 y=1/2 z=0', or the components of the state in order, 1,1/2,0; on a section also
    /// the values of its two axes. May be repeated
    #[arg(long, value_name = "START", allow_hyphen_values = true)]
    pub start: Vec<String>,
    /// Starts from a file, one a line; a first line may name the columns
    #[arg(long, value_name = "FILE.csv")]
    pub starts: Option<PathBuf>,
    /// Text of that file, if it is at hand.
    #[arg(skip)]
    pub text: Option<String>,
}

/// Starts with their names, or the reasons why there are none.
pub type Named = Vec<(String, Result<Start, FlowError>)>;

/// A start as a user gives it.
#[derive(Clone, Debug, PartialEq)]
pub enum GivenStart {
    /// All components of the state.
    State(Vec<Rational>),
    /// Values of something else, such as the axes of a section.
    Values(Vec<Rational>),
}

impl Starts {
    /// Reads all starts, with their names for reports.
    pub fn read(&self, case: &Case) -> Result<Vec<(String, GivenStart)>, String> {
        let mut found = Vec::new();
        for text in &self.start {
            let given = given(case, text).map_err(|error| {
                let help = match text.contains('=') {
                    true => format!("\nhelp: give every variable a value, as {}", example(case)),
                    false => String::new(),
                };
                format!("error: --start: {error}{help}")
            })?;
            found.push((text.trim().to_string(), given));
        }
        if let Some(path) = &self.starts {
            let text = match &self.text {
                Some(text) => text.clone(),
                None => source::text(path, "give --starts a CSV file: a start on each line")?,
            };
            found.extend(from_text(case, path, &text)?);
        }
        Ok(found)
    }

    /// Files that are read.
    pub fn inputs(&self) -> Option<&Path> {
        self.starts.as_deref()
    }
}

pub fn given(case: &Case, text: &str) -> Result<GivenStart, String> {
    if text.contains('=') {
        let state = verdict::read_state(case, text).map_err(|error| error.to_string())?;
        return Ok(GivenStart::State(state));
    }
    let numbers: Option<Vec<Rational>> = text.split(',').map(number_with_pi).collect();
    let numbers = numbers.ok_or_else(|| {
        format!("`{text}` is not a start: write {} or {}", example(case), "numbers with commas")
    })?;
    Ok(sorted(case, numbers))
}

/// A whole state, where there are as many numbers as components.
fn sorted(case: &Case, numbers: Vec<Rational>) -> GivenStart {
    match numbers.len() == case.model.dimension() {
        true => GivenStart::State(numbers),
        false => GivenStart::Values(numbers),
    }
}

/// A state in the notation of `--start`, as an example.
pub fn example(case: &Case) -> String {
    let variables = case.model.state.iter();
    let part = |variable: &liouville::mechanics::Variable| match variable.len() {
        1 => format!("{}=1", variable.name),
        count => format!("{}=[{}]", variable.name, vec!["1"; count].join(",")),
    };
    let text = variables.map(part).collect::<Vec<_>>().join(" ");
    // Quotes that a shell needs, also where none is needed.
    if text.contains('\'') { shell_quoted(&text) } else { format!("'{text}'") }
}

/// Message about a number of values that fits nothing.
pub fn misfit(case: &Case, found: usize, otherwise: Option<&str>) -> String {
    let dimension = case.model.dimension();
    let otherwise = otherwise.map_or(String::new(), |other| format!(", or {other}"));
    format!(
        "error: a start has {found} value{}, and the state has {dimension}\n\
         help: write {}, or its components in order{otherwise}",
        if found == 1 { "" } else { "s" },
        example(case)
    )
}

fn from_text(case: &Case, path: &Path, text: &str) -> Result<Vec<(String, GivenStart)>, String> {
    let shown = path.display();
    let mut order: Option<Vec<usize>> = None;
    let mut found = Vec::new();
    let lines = text.lines().enumerate().map(|(index, line)| (index + 1, line.trim()));
    let mut lines = lines.filter(|(_, line)| !line.is_empty() && !line.starts_with('#')).peekable();
    if let Some((number, line)) = lines.peek().copied() {
        let is_header = line.split(',').any(|field| number_with_pi(field).is_none());
        if is_header {
            let names = header(case, line)
                .map_err(|error| format!("error: {shown}, line {number}: {error}"))?;
            order = Some(names);
            lines.next();
        }
    }
    for (number, line) in lines {
        let wrong = |message: String| format!("error: {shown}, line {number}: {message}");
        let mut numbers = Vec::new();
        for field in line.split(',') {
            let field = field.trim();
            let value = number_with_pi(field);
            numbers.push(value.ok_or_else(|| wrong(format!("`{field}` is not a number")))?);
        }
        let given = match &order {
            None => sorted(case, numbers),
            Some(order) if order.len() == numbers.len() => {
                let mut state = vec![Rational::from(0); order.len()];
                order.iter().zip(numbers).for_each(|(place, x)| state[*place] = x);
                GivenStart::State(state)
            }
            Some(order) => {
                let (found, expected) = (numbers.len(), order.len());
                return Err(wrong(format!("{found} values below {expected} names")));
            }
        };
        found.push((format!("line {number}"), given));
    }
    match found.is_empty() {
        true => Err(format!("error: {shown} has no starts\nhelp: write one a line, with commas")),
        false => Ok(found),
    }
}

/// Places in the state of the columns of a file.
fn header(case: &Case, line: &str) -> Result<Vec<usize>, String> {
    let known = case.model.state_names();
    let mut order = Vec::new();
    for name in line.split(',') {
        let name = name.trim().trim_matches('"');
        let name = canonical_name(name).unwrap_or_else(|| name.to_string());
        let place = known.iter().position(|known| *known == name);
        let place = place.ok_or_else(|| {
            format!("`{name}` is not a component of the state; these are {}", known.join(", "))
        })?;
        if order.contains(&place) {
            return Err(format!("`{name}` is there twice"));
        }
        order.push(place);
    }
    match (0..known.len()).find(|place| !order.contains(place)) {
        Some(place) => Err(format!("there is no column `{}`", known[place])),
        None => Ok(order),
    }
}
