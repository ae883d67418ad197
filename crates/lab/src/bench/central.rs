//! Central differences in f64: f'(x)·d ≈ (f(x + h d) - f(x - h d))/2h.
//!
//! Truncation errs by h², rounding by u/h; both are least near h = ∛ε times the size of x. Hence
//! h|d| = ∛ε |x|, which leaves about ε^(2/3) = 4·10⁻¹¹ of the derivative's size.

use super::candidate::{Block, Candidate};
use super::underived::{AlongAxis, AlongField, Term, Underived};
use liouville::graph::Evaluator;
use liouville::number::arb::Approximation;
use liouville::number::float::Float;
use liouville::verdict::TAPE_LANES;

type Run<'t> = Evaluator<'t, Float<TAPE_LANES>>;

/// Residual by central differences.
pub struct Central<'t> {
    underived: &'t Underived,
    states: &'t [Block],
    along_field: Option<(&'t AlongField, Run<'t>, Run<'t>)>,
    along_axes: Vec<(&'t AlongAxis, Run<'t>)>,
    moved: Block,
    results: [f64; TAPE_LANES],
}

impl<'t> Central<'t> {
    /// Prepares the differences of these tapes at these states.
    pub fn new(underived: &'t Underived, states: &'t [Block]) -> Self {
        let run = |tape| Evaluator::new(tape, Float::<TAPE_LANES>);
        let along_field = underived.along_field.as_ref();
        Self {
            underived,
            states,
            along_field: along_field.map(|part| (part, run(&part.field), run(&part.value))),
            along_axes: underived.along_axes.iter().map(|part| (part, run(&part.values))).collect(),
            moved: Vec::new(),
            results: [0.0; TAPE_LANES],
        }
    }
}

impl Candidate for Central<'_> {
    fn run(&mut self, block: usize) {
        let inputs = &self.states[block];
        let (first, count) = (self.underived.parameters, self.underived.dimension);
        let reach = norm(&inputs[first..first + count]).map(|size| f64::EPSILON.cbrt() * size);
        self.moved.clone_from(inputs);
        self.results = [0.0; TAPE_LANES];
        if let Some((part, field, value)) = &mut self.along_field {
            field.run(inputs);
            let direction: Block = field.outputs().copied().collect();
            let speed = norm(&direction);
            let step: [f64; TAPE_LANES] = std::array::from_fn(|lane| reach[lane] / speed[lane]);
            let mut at = |sign: f64| {
                for (k, rate) in direction.iter().enumerate() {
                    let (x, moved) = (&inputs[first + k], &mut self.moved[first + k]);
                    for lane in 0..TAPE_LANES {
                        moved[lane] = x[lane] + sign * step[lane] * rate[lane];
                    }
                }
                value.run(&self.moved);
                *value.output(0)
            };
            let (ahead, behind) = (at(1.0), at(-1.0));
            for lane in 0..TAPE_LANES {
                // The mean of both is ρ up to h², as the quotient is the derivative.
                let unit = if part.logarithmic { 0.5 * (ahead[lane] + behind[lane]) } else { 1.0 };
                // At an equilibrium the derivative is 0, though there is no direction to step
                // along.
                let slope = (ahead[lane] - behind[lane]) / (2.0 * step[lane] * unit);
                self.results[lane] += if speed[lane] == 0.0 { 0.0 } else { slope };
            }
            self.moved.clone_from(inputs);
        }
        for (part, values) in &mut self.along_axes {
            let x = &inputs[part.input];
            let mut at = |sign: f64| {
                let moved = &mut self.moved[part.input];
                for lane in 0..TAPE_LANES {
                    moved[lane] = x[lane] + sign * reach[lane];
                }
                let place = *moved;
                values.run(&self.moved);
                (place, values.outputs().copied().collect::<Block>())
            };
            let ((to, ahead), (from, behind)) = (at(1.0), at(-1.0));
            self.moved[part.input] = *x;
            for (k, term) in part.terms.iter().enumerate() {
                for lane in 0..TAPE_LANES {
                    // The distance between the points as they were rounded.
                    let slope = (ahead[k][lane] - behind[k][lane]) / (to[lane] - from[lane]);
                    self.results[lane] += term.weight(inputs, lane) * slope;
                }
            }
        }
    }

    fn value(&self, lane: usize) -> Option<Approximation> {
        Approximation::from_f64(self.results[lane])
    }
}

impl Term {
    /// Factor of a derivative in one lane.
    pub fn weight(&self, inputs: &Block, lane: usize) -> f64 {
        self.factor.map_or(self.sign, |input| self.sign * inputs[input][lane])
    }
}

/// Length of a vector in each lane.
fn norm(vector: &[[f64; TAPE_LANES]]) -> [f64; TAPE_LANES] {
    std::array::from_fn(|lane| vector.iter().map(|x| x[lane] * x[lane]).sum::<f64>().sqrt())
}
