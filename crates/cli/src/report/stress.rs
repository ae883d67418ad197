//! Report of `stress`: digits lost and verdicts kept, as a table, JSON, and a heat map.

use std::fmt::Write;

use serde::Serialize;

use liouville_draw::{
    Axis, Bar, Figure, Layer, Paint, Plot, Size, gradient, math, plain, power_of_ten, svg,
};
use liouville_lab::stress::{Loss, Tally};

/// A sweep with its results at each power of ten.
#[derive(Clone, Debug, Serialize)]
pub struct SweepReport {
    /// Name of the scenario.
    pub name: &'static str,
    /// Results for each exponent of x.
    pub points: Vec<StressPoint>,
    /// Tally of all its verdicts.
    pub verdicts: Tally,
    /// Reasons why claims could not be judged, each once.
    pub problems: Vec<String>,
}

/// Results at one power of ten.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct StressPoint {
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
        let all = || self.scenarios.iter().flat_map(|s| s.points.iter().map(|p| p.exponent));
        let (low, high) = (all().min().unwrap_or(0), all().max().unwrap_or(0));
        let columns = usize::try_from(high - low + 1).unwrap_or(1);
        let rows = self.scenarios.len();
        let mut paints = vec![None; columns * 2 * rows];
        for (row, sweep) in self.scenarios.iter().enumerate() {
            for point in &sweep.points {
                let column = usize::try_from(point.exponent - low).unwrap_or(0);
                for (half, digits) in
                    point.loss.iter().flat_map(|loss| [loss.field, loss.residual]).enumerate()
                {
                    paints[(2 * row + half) * columns + column] = Some(shade(digits));
                }
            }
        }
        let names = self.scenarios.iter().enumerate();
        let names = names.map(|(row, s)| ((rows - row) as f64 - 0.5, s.name.to_string())).collect();
        let powers = (low..=high).filter(|exponent| exponent % 4 == 0);
        let powers = powers.map(|e| (f64::from(e), power_of_ten(i64::from(e)))).collect();
        let ends = [f64::from(low) - 0.5, f64::from(high) + 0.5];
        let mut plot = Plot::new(
            Axis::with_ticks(math("x"), ends, powers),
            Axis::with_ticks(plain(""), [0.0, rows as f64], names),
        );
        plot.aspect = 0.045 * rows as f64;
        plot.layers.push(Layer::Cells(columns, paints));
        let ticks = (0..=4).map(|k| (4.0 * f64::from(k), (4 * k).to_string())).collect();
        plot.bar = Some(Bar {
            axis: Axis::with_ticks(plain("digits lost"), [0.0, 16.0], ticks),
            paints: (0..64).map(|k| shade((f64::from(k) + 0.5) / 4.0)).collect(),
        });
        let figure = Figure {
            title: "Digits that f64 loses".to_string(),
            caption: vec![plain("Upper half of a row: the field; lower half: the residuals.")],
            plots: vec![plot],
            columns: 1,
            size: Size { width: 180.0, height: None, dot: 0.2, opacity: 1.0 },
        };
        svg(&figure.scene())
    }
}

/// Formats a number of digits lost: 0 to 9, then letters.
fn digit(lost: f64) -> char {
    char::from_digit((lost.round() as u32).min(16), 17).unwrap_or('?')
}

/// Colour of a loss: from yellow, no digits, to dark blue, all of them.
fn shade(lost: f64) -> Paint {
    gradient(1.0 - lost / 16.0)
}
