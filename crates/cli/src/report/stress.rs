//! Report of `stress`: digits lost and verdicts kept, as a table, JSON, and a heat map.

use std::fmt::Write;

use serde::Serialize;

use liouville_lab::stress::{Loss, Tally};

/// A sweep with its results at each power of ten.
#[derive(Clone, Debug, Serialize)]
pub struct SweepReport {
    /// Name of the scenario.
    pub name: &'static str,
    /// Results for each exponent of x.
    pub points: Vec<Point>,
    /// Tally of all its verdicts.
    pub verdicts: Tally,
    /// Reasons why claims could not be judged, each once.
    pub problems: Vec<String>,
}

/// Results at one power of ten.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Point {
    /// Exponent of x = 10^exponent.
    pub exponent: i32,
    /// Digits lost in f64.
    #[serde(flatten)]
    pub loss: Option<Loss>,
}

/// Results of all sweeps.
#[derive(Clone, Debug, Serialize)]
pub struct StressReport {
    /// Seed of all random numbers.
    pub seed: u64,
    /// Sweeps of the run.
    pub scenarios: Vec<SweepReport>,
    /// Tally of all verdicts.
    pub verdicts: Tally,
    /// Duration in seconds.
    pub seconds: f64,
}

impl StressReport {
    /// Renders the sweeps as text: a row for each, a digit for each power of ten.
    pub fn text(&self) -> String {
        let width = self.scenarios.iter().map(|s| s.name.chars().count()).max().unwrap_or(0);
        let mut out = String::from(
            "Digits that f64 loses, of 16, in the field and in the residuals, for x = 10^from … 10^to \
             (a letter is 10 and more):\n\n",
        );
        for sweep in &self.scenarios {
            let exponents = || sweep.points.iter().map(|point| point.exponent);
            let row = |digits: fn(&Loss) -> f64| -> String {
                sweep
                    .points
                    .iter()
                    .map(|p| p.loss.as_ref().map_or('·', |l| digit(digits(l))))
                    .collect()
            };
            let (from, to) = (exponents().min().unwrap_or(0), exponents().max().unwrap_or(0));
            let verdicts = match (sweep.verdicts.judged, sweep.verdicts.wrong) {
                (0, _) => String::new(),
                (n, 0) => format!("{n} claims, none wrong, {} decided", sweep.verdicts.decided),
                (n, wrong) => format!("{n} claims, {wrong} WRONG"),
            };
            let padding = " ".repeat(width - sweep.name.chars().count());
            let _ = writeln!(out, "{}{padding}  field     {}", sweep.name, row(|l| l.field));
            let _ = writeln!(
                out,
                "{:width$}  residual  {}  10^{from} … 10^{to}  {verdicts}",
                "",
                row(|l| l.residual)
            );
            for problem in &sweep.problems {
                let _ = writeln!(out, "{:width$}  problem   {problem}", "");
            }
        }
        let Tally { judged, wrong, decided } = self.verdicts;
        let _ = writeln!(
            out,
            "\n{judged} claims of stressed cases judged: {wrong} wrong, {decided} proved or refuted; \
             {:.1} s, seed {}",
            self.seconds, self.seed
        );
        out
    }

    /// Renders the sweeps as JSON.
    pub fn json(&self) -> Result<String, serde_json::Error> {
        serde_json::to_string_pretty(self)
    }

    /// Draws the heat map: sweeps down, powers of ten across, one half of a cell for the field and
    /// one for the residuals.
    pub fn heat_map(&self) -> String {
        const CELL: f64 = 17.0;
        const LEFT: f64 = 270.0;
        const TOP: f64 = 56.0;
        let all = || self.scenarios.iter().flat_map(|s| s.points.iter().map(|p| p.exponent));
        let (low, high) = (all().min().unwrap_or(0), all().max().unwrap_or(0));
        let width = LEFT + CELL * f64::from(high - low + 1) + 30.0;
        let height = TOP + CELL * self.scenarios.len() as f64 + 70.0;
        let mut svg = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" \
             font-family=\"sans-serif\" font-size=\"11\">\n<style>.ink{{fill:#222}}.paper{{fill:#fff}}\
             @media (prefers-color-scheme:dark){{.ink{{fill:#ddd}}.paper{{fill:#161616}}}}</style>\n\
             <rect class=\"paper\" width=\"{width}\" height=\"{height}\"/>\n\
             <text class=\"ink\" x=\"12\" y=\"24\" font-size=\"15\">Digits that f64 loses (upper half of \
             a cell: field, lower half: residuals)</text>\n"
        );
        let across = |exponent: i32| LEFT + CELL * f64::from(exponent - low);
        for (row, sweep) in self.scenarios.iter().enumerate() {
            let y = TOP + CELL * row as f64;
            let _ = writeln!(
                svg,
                "<text class=\"ink\" x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\">{}</text>",
                LEFT - 8.0,
                y + 12.0,
                sweep.name
            );
            for point in &sweep.points {
                let Some(loss) = point.loss else { continue };
                for (half, digits) in [loss.field, loss.residual].into_iter().enumerate() {
                    let _ = writeln!(
                        svg,
                        "<rect x=\"{:.1}\" y=\"{:.1}\" width=\"{:.1}\" height=\"{:.1}\" fill=\"{}\"/>",
                        across(point.exponent),
                        y + half as f64 * (CELL - 1.0) / 2.0,
                        CELL - 1.0,
                        (CELL - 1.0) / 2.0,
                        colour(digits)
                    );
                }
            }
        }
        let bottom = TOP + CELL * self.scenarios.len() as f64;
        for exponent in (low..=high).filter(|exponent| exponent % 4 == 0) {
            let _ = writeln!(
                svg,
                "<text class=\"ink\" x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"middle\">10\
                 <tspan dy=\"-4\" font-size=\"8\">{exponent}</tspan></text>",
                across(exponent) + CELL / 2.0,
                bottom + 16.0
            );
        }
        for digits in 0..=16 {
            let x = LEFT + CELL * f64::from(digits);
            let _ = writeln!(
                svg,
                "<rect x=\"{x:.1}\" y=\"{:.1}\" width=\"{CELL}\" height=\"12\" fill=\"{}\"/>\
                 <text class=\"ink\" x=\"{:.1}\" y=\"{:.1}\" font-size=\"8\" text-anchor=\"middle\">{digits}</text>",
                bottom + 30.0,
                colour(f64::from(digits)),
                x + CELL / 2.0,
                bottom + 52.0
            );
        }
        svg.push_str("</svg>\n");
        svg
    }
}

/// Formats a number of digits lost: 0 to 9, then letters.
fn digit(lost: f64) -> char {
    char::from_digit((lost.round() as u32).min(16), 17).unwrap_or('?')
}

/// Colour of a loss: from green, no digits, over yellow to red, all digits.
fn colour(lost: f64) -> String {
    let share = (lost / 16.0).clamp(0.0, 1.0);
    let stops = [(44.0, 140.0, 96.0), (236.0, 200.0, 70.0), (190.0, 40.0, 40.0)];
    let (a, b, t) = match share < 0.5 {
        true => (stops[0], stops[1], share * 2.0),
        false => (stops[1], stops[2], share * 2.0 - 1.0),
    };
    let mix = |a: f64, b: f64| (a + (b - a) * t).round() as u8;
    format!("#{:02x}{:02x}{:02x}", mix(a.0, b.0), mix(a.1, b.1), mix(a.2, b.2))
}
