//! Logarithmic axes with decades as ticks, the same for all panels.

use std::fmt::Write;

use super::{LEFT, PANEL, RIGHT, WIDTH};
use liouville_lab::bench::Row;

/// Decade at which smaller errors are drawn: exact results have no place on a logarithmic axis.
const LEAST_ERROR: f64 = -90.0;

/// Range of decades on both axes, as powers of ten.
pub struct Axes {
    errors: (f64, f64),
    times: (f64, f64),
}

impl Axes {
    /// Axes for these rows, to whole decades, with room for labels next to the outermost points.
    pub fn of<'r>(rows: impl Iterator<Item = &'r Row>) -> Self {
        let (mut errors, mut times) = ((-16.0f64, -10.0f64), (1.0f64, 2.0f64));
        for row in rows {
            let error = decade(row.max_error.filter(|error| *error > 0.0).unwrap_or(1e-16));
            errors = (errors.0.min(error.floor()), errors.1.max(error.ceil()));
            let time = row.ns_per_state.max(1e-1).log10();
            times = (times.0.min((time - 0.1).floor()), times.1.max((time + 0.1).ceil()));
        }
        // Room for a label to the right of the largest error.
        let room = (0.21 * (errors.1 - errors.0)).ceil().max(3.0);
        Self { errors: (errors.0 - 3.0, errors.1 + room), times }
    }

    /// Left, top, right and bottom of the plot.
    pub fn frame(&self, top: f64) -> [f64; 4] {
        [LEFT, top, WIDTH - RIGHT, top + PANEL]
    }

    /// Position of a point; at the left border if the result is exact, or has no error.
    pub fn place(&self, error: Option<f64>, nanoseconds: f64, top: f64) -> (f64, f64) {
        let error = error.filter(|error| *error > 0.0).map_or(self.errors.0, decade);
        (self.across(error), self.up(nanoseconds.max(1e-1).log10(), top))
    }

    fn across(&self, decade: f64) -> f64 {
        let share = (decade - self.errors.0) / (self.errors.1 - self.errors.0);
        LEFT + share.clamp(0.0, 1.0) * (WIDTH - LEFT - RIGHT)
    }

    fn up(&self, decade: f64, top: f64) -> f64 {
        let share = (decade - self.times.0) / (self.times.1 - self.times.0);
        top + (1.0 - share.clamp(0.0, 1.0)) * PANEL
    }

    /// Draws grid, frame, ticks and the names of the axes.
    pub fn draw(&self, out: &mut String, top: f64) {
        let bottom = top + PANEL;
        let right = WIDTH - RIGHT;
        // A tick label is about 40 pixels wide.
        let every = ((self.errors.1 - self.errors.0) / 16.0).ceil().max(1.0) as i64;
        for exponent in self.errors.0 as i64..=self.errors.1 as i64 {
            // Beyond 1 there is room for labels only.
            if exponent % every != 0 || exponent > 0 {
                continue;
            }
            let x = self.across(exponent as f64);
            let _ = writeln!(
                out,
                "<line class=\"grid\" x1=\"{x:.1}\" y1=\"{top:.1}\" x2=\"{x:.1}\" y2=\"{bottom:.1}\"/>\n\
                 <text class=\"small\" x=\"{x:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{}</text>",
                bottom + 16.0,
                power_of_ten(exponent)
            );
        }
        for exponent in self.times.0 as i64..=self.times.1 as i64 {
            let y = self.up(exponent as f64, top);
            let _ = writeln!(
                out,
                "<line class=\"grid\" x1=\"{LEFT}\" y1=\"{y:.1}\" x2=\"{right}\" y2=\"{y:.1}\"/>\n\
                 <text class=\"small\" x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\">{}</text>",
                LEFT - 8.0,
                y + 4.0,
                time(exponent)
            );
        }
        let _ = writeln!(
            out,
            "<rect class=\"frame\" x=\"{LEFT}\" y=\"{top:.1}\" width=\"{:.1}\" height=\"{PANEL}\"/>\n\
             <text class=\"small\" x=\"{right}\" y=\"{:.1}\" text-anchor=\"end\">largest error / scale</text>\n\
             <text class=\"small\" x=\"{right}\" y=\"{:.1}\" text-anchor=\"end\">time a state ↑</text>",
            right - LEFT,
            bottom + 34.0,
            top - 10.0
        );
    }
}

fn decade(error: f64) -> f64 {
    error.log10().max(LEAST_ERROR)
}

/// Formats a power of ten: 10⁻¹⁶.
fn power_of_ten(exponent: i64) -> String {
    let superscript = |digit: char| match digit {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        _ => digit.to_digit(10).and_then(|d| char::from_u32('⁰' as u32 + d)).unwrap_or(digit),
    };
    format!("10{}", exponent.to_string().chars().map(superscript).collect::<String>())
}

/// Formats a power of ten nanoseconds: 10 ns, 1 µs.
fn time(exponent: i64) -> String {
    let (unit, least) = match exponent {
        ..3 => ("ns", 0),
        3..6 => ("µs", 3),
        6..9 => ("ms", 6),
        _ => ("s", 9),
    };
    let number = 10f64.powi((exponent - least) as i32);
    format!("{number} {unit}")
}
