//! Evaluation of a tape over blocks of states in any number domain.

use super::dispatch::{Kernel, with_widest_vectors};
use super::tape::{Instruction, Tape};
use crate::number::Domain;
use crate::number::rational::Rational;

/// A tape with its working memory in one domain; built once, run on many blocks.
pub struct Evaluator<'t, D: Domain> {
    tape: &'t Tape,
    domain: D,
    /// One block for each slot, and a spare block for the next result.
    blocks: Vec<Aligned<D::Block>>,
    /// Index into `blocks` for each slot.
    places: Vec<usize>,
    spare: usize,
}

/// A block on a cache line's border, so that no vector straddles two lines.
#[derive(Clone)]
#[repr(align(64))]
struct Aligned<B>(B);

impl<'t, D: Domain> Evaluator<'t, D> {
    /// Prepares the constants of `tape` in `domain`.
    pub fn new(tape: &'t Tape, domain: D) -> Self {
        let blank = Aligned(domain.constant(&Rational::from(0)));
        let mut blocks = vec![blank; tape.slots + 1];
        for (block, value) in blocks[tape.inputs..].iter_mut().zip(&tape.constants) {
            block.0 = domain.constant(value);
        }
        Self { tape, domain, blocks, places: (0..tape.slots).collect(), spare: tape.slots }
    }

    /// Computes the outputs from one block for each input; inputs left out keep their values.
    pub fn run<'b>(&mut self, inputs: impl IntoIterator<Item = &'b D::Block>)
    where
        D: 'b,
    {
        self.load(inputs);
        with_widest_vectors(Execution(self));
    }

    /// Returns the value of output `index` after the last run.
    pub fn output(&self, index: usize) -> &D::Block {
        &self.blocks[self.places[self.tape.outputs[index] as usize]].0
    }

    /// Returns all outputs of the last run.
    pub fn outputs(&self) -> impl Iterator<Item = &D::Block> {
        (0..self.tape.outputs.len()).map(|index| self.output(index))
    }

    fn load<'b>(&mut self, inputs: impl IntoIterator<Item = &'b D::Block>)
    where
        D: 'b,
    {
        for (place, input) in self.places.iter().take(self.tape.inputs).zip(inputs) {
            self.blocks[*place].0.clone_from(input);
        }
    }
}

/// The loop over the instructions of a tape.
struct Execution<'e, 't, D: Domain>(&'e mut Evaluator<'t, D>);

impl<D: Domain> Kernel for Execution<'_, '_, D> {
    #[inline(always)]
    fn run(self) {
        let Evaluator { tape, domain, blocks, places, spare } = self.0;
        for instruction in &tape.instructions {
            // The result is made in the spare block, which then changes places with the target's: a
            // result may replace an argument, and no argument is in the spare block.
            let target = match *instruction {
                Instruction::Unary { function, a, out } => {
                    let (x, result) = beside(blocks, places[a as usize], *spare);
                    domain.unary(function, x, result);
                    out
                }
                Instruction::Binary { operation, a, b, out } => {
                    let (a, b) = (places[a as usize], places[b as usize]);
                    if a == b {
                        let (x, result) = beside(blocks, a, *spare);
                        domain.binary(operation, x, x, result);
                    } else if let Ok([x, y, result]) = blocks.get_disjoint_mut([a, b, *spare]) {
                        domain.binary(operation, &x.0, &y.0, &mut result.0);
                    }
                    out
                }
                Instruction::Power { a, exponent, out } => {
                    let (x, result) = beside(blocks, places[a as usize], *spare);
                    domain.power(x, &tape.exponents[exponent as usize], result);
                    out
                }
            };
            std::mem::swap(&mut places[target as usize], spare);
        }
    }
}

/// Borrows an argument together with the spare block for the result.
#[inline(always)]
fn beside<B>(blocks: &mut [Aligned<B>], argument: usize, spare: usize) -> (&B, &mut B) {
    let (low, high) = blocks.split_at_mut(argument.max(spare));
    let (low, high) = (&mut low[argument.min(spare)].0, &mut high[0].0);
    if argument < spare { (low, high) } else { (high, low) }
}

#[cfg(test)]
mod tests {
    use super::super::{Expr, record};
    use super::*;
    use crate::number::ball::Ball;
    use crate::number::exact::Exact;
    use crate::number::float::Float;
    use crate::number::rational::Rational;
    use crate::scalar::Scalar;
    use num_dual::DualNum;

    #[test]
    fn slots_are_reused() {
        let (graph, sum) = record(1, |x| (0..100).fold(x[0], |sum, _| (sum * x[0] + x[0]).sqrt()))
            .expect("records");
        let tape = Tape::new(&graph, &[sum]);
        assert!(tape.slots <= 4, "a chain needs two slots beside its input, not {}", tape.slots);
    }

    #[test]
    fn dead_code_is_left_out() {
        let (graph, kept) = record(1, |x| {
            let _unused = x[0].exp().sin();
            x[0] + x[0]
        })
        .expect("records");
        assert_eq!(Tape::new(&graph, &[kept]).operations(), 1, "only the sum is computed");
    }

    #[test]
    fn every_instruction_set_gives_the_same_bits() {
        let (graph, values) = record(2, |x| {
            let quotient = (x[0] * x[1] - x[0]).recip() * (x[1].modulus() + x[0] * x[0]).sqrt();
            [quotient, quotient.exp() * x[1] - quotient, (quotient * quotient + x[0]).ln()]
        })
        .expect("records");
        let tape = Tape::new(&graph, &values);
        let inputs: [[f64; 64]; 2] = [0.37, 1.91]
            .map(|seed: f64| std::array::from_fn(|lane| (seed * lane as f64).sin() * 3.0));
        let balls = inputs
            .map(|block| Ball::<64>.values(&block.map(|x| Rational::from_f64(x).expect("finite"))));
        let mut wide = Evaluator::new(&tape, Ball::<64>);
        wide.run(&balls);
        let mut plain = Evaluator::new(&tape, Ball::<64>);
        plain.load(&balls);
        Execution(&mut plain).run();
        // The sign and payload of a NaN are arbitrary.
        let bits = |block: &[f64; 64]| block.map(|x| if x.is_nan() { 0 } else { x.to_bits() });
        for (wide, plain) in wide.outputs().zip(plain.outputs()) {
            assert!(bits(&wide.mid) == bits(&plain.mid), "midpoints");
            assert!(bits(&wide.rad) == bits(&plain.rad), "radii");
        }
    }

    #[test]
    fn nothing_hides_a_division_by_zero() {
        let (graph, values) = record(1, |x| {
            let zero = x[0] - x[0];
            let pole = zero.recip();
            [zero * pole, pole - pole, pole * zero.sqrt(), (pole * x[0]).powi(0)]
        })
        .expect("records");
        let tape = Tape::new(&graph, &values);
        let mut ball = Evaluator::new(&tape, Ball::<1>);
        ball.run(&[Ball::<1>.constant(&Rational::from(3))]);
        for (index, value) in ball.outputs().enumerate() {
            assert!(!value.is_defined(0), "expression {index} contains 1/0");
        }
    }

    #[test]
    fn all_domains_agree_on_a_rational_function() {
        let (graph, value) = record(2, |x| {
            let third = Expr::rational(&Rational::new(1, 3));
            (x[0] * x[0] - third) / (x[1] + x[0]) - x[1].powi(-2)
        })
        .expect("records");
        let tape = Tape::new(&graph, &[value]);
        let state = [Rational::new(3, 7), Rational::new(-5, 4)];
        let mut exact = Evaluator::new(&tape, Exact);
        exact.run(&state.clone().map(Some));
        let reference = exact.output(0).clone().expect("a rational value");

        let mut float = Evaluator::new(&tape, Float::<4>);
        float.run(&state.clone().map(|x| [x.to_f64().0; 4]));
        let (nearest, _) = reference.to_f64();
        assert!((float.output(0)[3] - nearest).abs() < 1e-15, "f64 is near the exact value");

        let mut ball = Evaluator::new(&tape, Ball::<4>);
        ball.run(&state.map(|x| Ball::<4>.values(&[x])));
        let enclosure = ball.output(0);
        let mid = Rational::from_f64(enclosure.mid[2]).expect("finite");
        let rad = Rational::from_f64(enclosure.rad[2]).expect("finite");
        assert!((&mid - &reference).abs() <= rad, "the ball holds the exact value");
        assert!(enclosure.rad[2] < 1e-14, "and is narrow");
    }
}
