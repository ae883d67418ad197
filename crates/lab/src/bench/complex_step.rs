//! Derivatives by a complex step: f'(x)·d = Im f(x + i h d)/h with h = 10⁻¹⁰⁰.
//!
//! There is no subtraction, and h² vanishes against every rounding error, so the error is that of
//! f.

use super::candidate::{Block, Candidate};
use super::underived::{AlongAxis, AlongField, Underived};
use liouville::graph::Evaluator;
use liouville::number::arb::Approximation;
use liouville::number::complex::{Complex, Complexes};
use liouville::number::float::Float;
use liouville::verdict::TAPE_LANES;

const STEP: f64 = 1e-100;

type Run<'t> = Evaluator<'t, Complex<TAPE_LANES>>;

/// Residual by complex steps.
pub struct ComplexStep<'t> {
    underived: &'t Underived,
    states: &'t [Block],
    along_field: Option<(&'t AlongField, Evaluator<'t, Float<TAPE_LANES>>, Run<'t>)>,
    along_axes: Vec<(&'t AlongAxis, Run<'t>)>,
    moved: Vec<Complexes<TAPE_LANES>>,
    results: [f64; TAPE_LANES],
}

impl<'t> ComplexStep<'t> {
    /// Prepares the complex steps of these tapes at these states.
    pub fn new(underived: &'t Underived, states: &'t [Block]) -> Self {
        let run = |tape| Evaluator::new(tape, Complex::<TAPE_LANES>);
        let field = |tape| Evaluator::new(tape, Float::<TAPE_LANES>);
        let along_field = underived.along_field.as_ref();
        Self {
            underived,
            states,
            along_field: along_field.map(|part| (part, field(&part.field), run(&part.value))),
            along_axes: underived.along_axes.iter().map(|part| (part, run(&part.values))).collect(),
            moved: Vec::new(),
            results: [0.0; TAPE_LANES],
        }
    }
}

impl Candidate for ComplexStep<'_> {
    fn run(&mut self, block: usize) {
        let inputs = &self.states[block];
        let first = self.underived.parameters;
        self.moved.clear();
        self.moved.extend(inputs.iter().map(|re| Complexes { re: *re, im: [0.0; TAPE_LANES] }));
        self.results = [0.0; TAPE_LANES];
        if let Some((part, field, value)) = &mut self.along_field {
            field.run(inputs);
            for (moved, rate) in self.moved[first..].iter_mut().zip(field.outputs()) {
                moved.im = rate.map(|rate| STEP * rate);
            }
            value.run(&self.moved);
            let result = value.output(0);
            for lane in 0..TAPE_LANES {
                let unit = if part.logarithmic { result.re[lane] } else { 1.0 };
                self.results[lane] += result.im[lane] / STEP / unit;
            }
            for moved in &mut self.moved {
                moved.im = [0.0; TAPE_LANES];
            }
        }
        for (part, values) in &mut self.along_axes {
            self.moved[part.input].im = [STEP; TAPE_LANES];
            values.run(&self.moved);
            self.moved[part.input].im = [0.0; TAPE_LANES];
            for (term, result) in part.terms.iter().zip(values.outputs()) {
                for lane in 0..TAPE_LANES {
                    self.results[lane] += term.weight(inputs, lane) * (result.im[lane] / STEP);
                }
            }
        }
    }

    fn value(&self, lane: usize) -> Option<Approximation> {
        Approximation::from_f64(self.results[lane])
    }
}
