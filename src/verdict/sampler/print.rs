//! States in exact numbers, and as text with enough digits to find them again.

use std::cell::LazyCell;

use crate::case::Case;
use crate::graph::Evaluator;
use crate::mechanics::{Draw, ParameterOrigin};
use crate::number::arb::ArbBall;
use crate::number::exact::Exact;
use crate::number::mixed::{Mixed, Number};
use crate::number::rational::Rational;

use super::{Sampler, TAPE_LANES};

/// Number of spare bits in a printed state.
const SPARE_BITS: u32 = 64;
/// Number of spare digits in a printed state.
const SPARE_DIGITS: usize = 8;

impl Sampler {
    /// Computes parameters and state of one state, exact where they are rational.
    pub fn exact(&self, index: u64) -> Vec<Option<Rational>> {
        self.exact_from(self.numbers(1, index).swap_remove(0))
    }

    fn exact_from(&self, values: Vec<Rational>) -> Vec<Option<Rational>> {
        let mut evaluator = Evaluator::new(&self.unguarded, Exact);
        evaluator.run(&values.into_iter().map(Some).collect::<Vec<_>>());
        let state_begins = self.tape.outputs() - self.dimension;
        evaluator
            .outputs()
            .enumerate()
            .map(|(k, value)| value.clone().filter(|_| self.newton.is_none() || k < state_begins))
            .collect()
    }

    /// Prints parameters and state; irrational numbers with enough digits to distinguish states of
    /// `bits` bits, so that a residual computed in this precision can be reproduced.
    pub fn printed(&self, index: u64, bits: u32) -> Vec<String> {
        if bits > f64::MANTISSA_DIGITS {
            return self.printed_from(&self.numbers(1, index).swap_remove(0), bits);
        }
        let start = index - index % TAPE_LANES as u64;
        let lane = (index % TAPE_LANES as u64) as usize;
        let balls = LazyCell::new(|| self.balls(start));
        // Newton's method may start from later draws than the first.
        let is_drawn = |k: usize, exact: &Rational| {
            self.newton.is_none()
                || (exact.to_f64().0 - balls[k].mid[lane]).abs() <= balls[k].rad[lane]
        };
        let text = |(k, value): (usize, Option<Rational>)| match value {
            Some(exact) if is_drawn(k, &exact) => exact.to_string(),
            _ => format!("{:?}", balls[k].mid[lane]),
        };
        self.exact(index).into_iter().enumerate().map(text).collect()
    }

    /// Prints a state made from given numbers, with digits for `bits` bits.
    pub fn printed_from(&self, numbers: &[Rational], bits: u32) -> Vec<String> {
        let domain = ArbBall::new(bits + SPARE_BITS);
        let digits = (f64::from(bits) * std::f64::consts::LOG10_2) as usize + SPARE_DIGITS;
        let precise = LazyCell::new(|| self.made_from(&domain, numbers));
        let written = |k: usize| precise[k].as_ref()?.decimal(digits);
        // Exact numbers know that y² - 2y·y + y² is 0, and has a root.
        let mixed = LazyCell::new(|| self.made_from(&Mixed::new(bits + SPARE_BITS), numbers));
        let partly_exact = |k: usize| match &mixed[k] {
            Number::Exact(value) => Some(value.to_string()),
            Number::Ball(ball) => ball.decimal(digits),
            Number::Nothing | Number::Doubtful => None,
        };
        let rounded = |k: usize| written(k).or_else(|| partly_exact(k));
        let text = |(k, value): (usize, Option<Rational>)| match value {
            Some(exact) => exact.to_string(),
            None => rounded(k).unwrap_or_else(|| f64::NAN.to_string()),
        };
        self.exact_from(numbers.to_vec()).into_iter().enumerate().map(text).collect()
    }

    /// Lists the parameters drawn from lists, with the values they have at every state, where the draws
    /// count.
    pub fn listed(&self, case: &Case, counts: impl Fn(usize) -> bool) -> String {
        let mut draws = self.recipes.iter().enumerate();
        let mut listed = Vec::new();
        for parameter in case.model.free_parameters() {
            let ParameterOrigin::Free(recipe) = &parameter.origin else { continue };
            let own = draws.by_ref().take(recipe.draws().len());
            let values: Vec<String> = own
                .filter_map(|(place, draw)| match draw {
                    Draw::OneOf(values) if counts(place) => Some(values.first()?.to_string()),
                    _ => None,
                })
                .collect();
            match &values[..] {
                [] => {}
                [one] => listed.push(format!("{} = {one}", parameter.name)),
                all => listed.push(format!("{} from {}", parameter.name, all.join(", "))),
            }
        }
        listed.join(", ")
    }
}
