//! Report of `rotation`: rotation numbers along a line of starts, as text, JSON, CSV and a plot.

use serde_json::{Value, json};

use super::counted;
use super::cycle::shown;
use super::data::quoted;
use super::facts;
use liouville::case::Case;
use liouville_draw::{
    Axis, CATEGORIES, LegendEntry, MarkShape, MarkedPoint, Paint, Plot, Text, math, plain,
};
use liouville_flow::{FlowError, RotationNumber};

/// Rotation number of one motion of the line.
#[derive(Clone, Debug, PartialEq)]
pub struct RotationRow {
    /// Values of the start.
    pub start: Vec<f64>,
    /// Number of crossings.
    pub crossings: usize,
    /// Rotation number, if there is one.
    pub found: Option<RotationNumber>,
    /// Reason why the motion ended early, or did not start.
    pub problem: Option<FlowError>,
}

/// Rotation numbers with what they were asked for.
pub struct RotationReport<'r> {
    /// Case of the motions.
    pub case: &'r Case,
    /// Names of the values of a start.
    pub titles: Vec<String>,
    /// Surface that is crossed; `None` for g = g₀ of a rolling body.
    pub surface: Option<&'r str>,
    /// Angle that is counted, in words.
    pub around: String,
    /// Motions along the line.
    pub rows: &'r [RotationRow],
}

impl RotationRow {
    fn resonance(&self) -> Option<(u64, u64)> {
        self.found.and_then(|found| found.resonance)
    }
}

impl RotationReport<'_> {
    fn section(&self) -> String {
        self.surface.map_or("section g = g₀".to_string(), |surface| format!("section {surface}"))
    }

    /// Places of the values that vary along the line.
    fn varying(&self) -> Vec<usize> {
        let (first, last) = (self.rows.first(), self.rows.last());
        let differs = |place: &usize| {
            let value =
                |row: Option<&RotationRow>| row.and_then(|row| row.start.get(*place).copied());
            value(first) != value(last)
        };
        (0..self.titles.len()).filter(differs).collect()
    }

    /// Renders a line for each motion.
    pub fn text(&self) -> String {
        let count = |holds: &dyn Fn(&RotationRow) -> bool| {
            self.rows.iter().filter(|row| holds(row)).count()
        };
        let resonant = count(&|row| row.resonance().is_some());
        let without = count(&|row| row.found.is_none());
        let mut out = format!(
            "{}\n{}, rotation numbers {}: {}, {resonant} at a fraction, {without} without a number\n",
            self.case.title,
            self.section(),
            self.around,
            counted(self.rows.len(), "motion"),
        );
        let varying = self.varying();
        let titles: String =
            varying.iter().map(|place| format!("{:>14}", self.titles[*place])).collect();
        out.push_str(&format!("{titles}  turns per crossing\n"));
        for row in self.rows {
            let at: String =
                varying.iter().map(|place| format!("{:>14.8}", row.start[*place])).collect();
            let words = match (&row.found, &row.problem) {
                (_, Some(problem)) => {
                    let crossings = counted(row.crossings, "crossing");
                    format!("ended after {crossings}: {problem}")
                }
                (None, None) => "none: the order of the angles is not kept".to_string(),
                (Some(found), None) => match found.resonance {
                    Some((p, q)) => format!("{}  {p}/{q}", shown(found.turns)),
                    None => shown(found.turns),
                },
            };
            out.push_str(&format!("{at}  {words}\n"));
        }
        out
    }

    /// Renders a line for each motion with commas, below a line of titles.
    pub fn csv(&self) -> String {
        let own = ["rotation", "error", "p", "q", "crossings"];
        let titles = self.titles.iter().map(String::as_str).chain(own);
        let mut out = titles.map(quoted).collect::<Vec<_>>().join(",") + "\n";
        for row in self.rows {
            let mut cells: Vec<String> = row.start.iter().map(|x| format!("{x:?}")).collect();
            let found = row.found;
            let number = |x: Option<f64>| x.map_or(String::new(), |x| format!("{x:?}"));
            cells.push(number(found.map(|found| found.turns.value)));
            cells.push(number(found.map(|found| found.turns.error)));
            let fraction = found.and_then(|found| found.resonance);
            let whole = |x: Option<u64>| x.map_or(String::new(), |x| x.to_string());
            cells.extend([whole(fraction.map(|(p, _)| p)), whole(fraction.map(|(_, q)| q))]);
            cells.push(row.crossings.to_string());
            out.push_str(&(cells.join(",") + "\n"));
        }
        out
    }

    /// Renders all motions as JSON.
    pub fn json(&self) -> Result<String, String> {
        let row = |row: &RotationRow| -> Value {
            let found = row.found;
            json!({
                "start": row.start,
                "rotation": found.map(|found| found.turns.value),
                "error": found.map(|found| found.turns.error),
                "fraction": found.and_then(|found| found.resonance).map(|(p, q)| [p, q]),
                "crossings": row.crossings,
                "problem": row.problem.as_ref().map(ToString::to_string),
            })
        };
        let root = json!({
            "title": self.case.title,
            "section": self.surface,
            "angle": self.around,
            "axes": self.titles,
            "motions": self.rows.iter().map(row).collect::<Vec<_>>(),
        });
        let text =
            serde_json::to_string_pretty(&root).map_err(|error| format!("error: {error}"))?;
        Ok(text + "\n")
    }

    /// Draws the rotation numbers over the first value that varies, with marks at fractions.
    pub fn plot(&self) -> Plot {
        let place = self.varying().first().copied().unwrap_or_default();
        let known = |row: &RotationRow| Some([*row.start.get(place)?, row.found?.turns.value]);
        let title = self.titles.get(place).map_or("", String::as_str);
        let across = Axis::over(
            math(title),
            self.rows.iter().filter_map(|row| row.start.get(place).copied()),
        );
        let up = Axis::over(
            plain("rotation number"),
            self.rows.iter().filter_map(|row| known(row).map(|at| at[1])),
        );
        let mut plot = Plot::new(across, up);
        let runs = self.rows.chunk_by(|a, b| a.resonance() == b.resonance());
        for run in runs {
            let fraction = run.first().and_then(RotationRow::resonance);
            let label = |index: usize| {
                let (p, q) = fraction.filter(|_| index == run.len() / 2)?;
                Some(format!("{p}/{q}"))
            };
            let (mark, paint) = match fraction {
                Some(_) => (MarkShape::Ring, Paint::Ink),
                None => (MarkShape::Dot, CATEGORIES[0]),
            };
            let marks = run.iter().enumerate().filter_map(|(index, row)| {
                let label = label(index);
                Some(MarkedPoint { at: known(row)?, mark, paint, label, has_rim: false })
            });
            plot.marks.extend(marks);
        }
        if self.rows.iter().any(|row| row.resonance().is_some()) {
            let text = plain("resonance p/q");
            plot.legend.push(LegendEntry { mark: MarkShape::Ring, paint: Paint::Ink, text });
        }
        plot
    }

    /// Words below the picture.
    pub fn caption(&self) -> Text {
        let turns = plain(&facts::unbroken(&format!("turns {}", self.around).replace('-', "−")));
        let words = [facts::section(self.surface), turns];
        facts::listed(words.into_iter().chain(facts::parameters(self.case, &[])))
    }
}
