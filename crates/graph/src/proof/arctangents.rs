//! Arctangents of tangents: atan(tan w) = w − kπ where (k − ½)π ≤ w ≤ (k + ½)π.
//!
//! The angle w is u, u/2, or what either lacks to π/4 or π/2:
//!
//! ```text
//! tan u = sin u/cos u           tan(u/2) = sin u/(1 + cos u)
//! tan(π/2 − u) = cos u/sin u    tan(π/4 − u/2) = cos u/(1 + sin u)
//! tan(π/2 − u/2) = sin u/(1 − cos u)    tan(π/4 + u/2) = cos u/(1 − sin u)
//! ```

use std::f64::consts::FRAC_PI_2;

use crate::graph::{Expr, Step};
use crate::number::UnaryFunction::{Atan, Cos, Sin};
use crate::number::rational::Rational;
use crate::scalar::Scalar;

use super::angles::arguments;
use super::cells::Cell;
use super::explore::Explorer;
use super::fact::SignFact;
use super::relations::Defect;
use super::rewrite::Rewrite;
use super::trial::{Certificate, both};

/// Largest number of arctangents that are looked at, and of angles in each.
const MOST_FOUND: usize = 4;
/// Largest number k of half turns.
const MOST_TURNS: i64 = 4;

/// An angle f u + e π/4, as twice f and e, whose tangent is N/D.
struct Form {
    halves: i64,
    eighths: i64,
    /// N and D from sin u and cos u.
    fraction: fn(Expr, Expr) -> [Expr; 2],
}

fn one() -> Expr {
    Expr::rational(&Rational::from(1))
}

const FORMS: [Form; 6] = [
    Form { halves: 2, eighths: 0, fraction: |s, c| [s, c] },
    Form { halves: 1, eighths: 0, fraction: |s, c| [s, one() + c] },
    Form { halves: -2, eighths: 2, fraction: |s, c| [c, s] },
    Form { halves: -1, eighths: 1, fraction: |s, c| [c, one() + s] },
    Form { halves: -1, eighths: 2, fraction: |s, c| [s, one() - c] },
    Form { halves: 1, eighths: 1, fraction: |s, c| [c, one() - s] },
];

/// An angle as a multiple of u and of π/4.
#[derive(Clone, Copy, Debug)]
pub struct PlainAngle {
    /// Place of u.
    place: usize,
    /// Twice the multiple of u.
    halves: i64,
    /// The multiple of π/4.
    eighths: i64,
}

impl PlainAngle {
    /// Records the angle, from the values at places.
    pub fn value(self, values: &[Option<Expr>]) -> Option<Expr> {
        let angle = values[self.place]? * Expr::rational(&Rational::new(self.halves, 2));
        Some(angle + one().apply(Atan) * Expr::rational(&Rational::from(self.eighths)))
    }
}

/// Returns a number of f64 not below this number of quarter turns, or not above it.
fn quarter_turns(quarters: i64, is_above: bool) -> f64 {
    let near = quarters as f64 * FRAC_PI_2;
    match (quarters == 0, is_above == (quarters > 0)) {
        (true, _) => 0.0,
        // FRAC_PI_2 is below π/2, and the product is rounded to the nearest.
        (_, true) => {
            if quarters > 0 {
                near.next_up().next_up()
            } else {
                near.next_down().next_down()
            }
        }
        (_, false) if quarters.unsigned_abs().is_power_of_two() => near,
        (_, false) => {
            if quarters > 0 {
                near.next_down()
            } else {
                near.next_up()
            }
        }
    }
}

impl Explorer<'_> {
    /// Finds the arctangents of tangents that the values of a cell need.
    pub fn arctangents(
        &self,
        cell: &Cell,
        known: &[(usize, SignFact)],
    ) -> (Vec<Rewrite>, Option<Certificate>) {
        let reached = cell.graph.reached(cell.values.iter().copied());
        let steps = cell.graph.steps().enumerate().filter(|(place, _)| reached[*place]);
        let all = steps.filter_map(|(_, step)| match step {
            Step::Unary(Atan, a) if !matches!(cell.graph.step(a), Step::Constant(_)) => Some(a),
            _ => None,
        });
        let (mut rewrites, mut certificate) = (Vec::new(), None);
        for argument in all.take(MOST_FOUND) {
            let angles = arguments(&cell.graph, &[cell.graph.at(argument)]);
            let mut angles = angles.into_iter().take(MOST_FOUND);
            if let Some((angle, own)) = angles.find_map(|u| self.angle_of(cell, known, argument, u))
            {
                rewrites.push(Rewrite::Arctangent { argument, angle });
                certificate = both(certificate, Some(own));
            }
        }
        (rewrites, certificate)
    }

    /// The angle between −π/2 and π/2 whose tangent is the value at a place, by an angle u.
    fn angle_of(
        &self,
        cell: &Cell,
        known: &[(usize, SignFact)],
        argument: usize,
        u: usize,
    ) -> Option<(PlainAngle, Certificate)> {
        let graph = &cell.graph;
        let test = Defect { graph, sources: self.sources, digest: self.digest, is_related: true };
        FORMS.iter().find_map(|form| {
            let (sign, certificate) = [1, -1].into_iter().find_map(|sign| {
                let defect = |values: &[Option<Expr>]| {
                    let (a, u) = (values[argument]?, values[u]?);
                    let [above, below] = (form.fraction)(u.apply(Sin), u.apply(Cos));
                    Some(vec![a * below - above * Expr::rational(&Rational::from(sign))])
                };
                Some((sign, test.vanishing(&[argument, u], &defect)?))
            })?;
            let turns = (-MOST_TURNS..=MOST_TURNS).find(|k| {
                // (k − ½)π ≤ f u + e π/4 ≤ (k + ½)π, in quarter turns of u
                let ends = [4 * k - 2, 4 * k + 2].map(|end| (end - form.eighths) / form.halves);
                let [low, high] = [ends[0].min(ends[1]), ends[0].max(ends[1])];
                let compared = |turn: &dyn Fn() -> Expr| {
                    let difference = |values: &[Option<Expr>]| Some(values[u]? - turn());
                    cell.sign_of(known, self.prover.extents, &[u], difference)
                };
                let is_beyond = |quarters: i64, is_above: bool| {
                    let exact =
                        || one().apply(Atan) * Expr::rational(&Rational::from(2 * quarters));
                    // Ends of ranges are numbers of f64 inside of π/2.
                    let stricter = Rational::from_f64(quarter_turns(quarters, is_above));
                    compared(&exact) == Some(is_above)
                        || stricter
                            .is_some_and(|own| compared(&|| Expr::rational(&own)) == Some(is_above))
                };
                is_beyond(low, true) && is_beyond(high, false)
            })?;
            let eighths = sign * (form.eighths - 4 * turns);
            let angle = PlainAngle { place: u, halves: sign * form.halves, eighths };
            Some((angle, certificate))
        })
    }
}
