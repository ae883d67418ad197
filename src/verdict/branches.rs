//! Whether a level set that is solved for some variables is met in full: where what is divided by
//! vanishes together with what is left there is a part that the solution leaves out.
//!
//! x (y² + z² − 1) = 0 is solved by x = 0 where y² + z² ≠ 1, and the cylinder is another part of it.

use super::bench::Bench;
use super::sampler::Sampler;
use crate::graph::{Evaluator, Expr, Fault, Tape, record};
use crate::level::Pivot;
use crate::number::Enclosing;
use crate::number::mixed::{Mixed, Number};
use crate::number::rational::Rational;
use crate::proof::{Group, Prover, are_coprime, is_nowhere_zero};
use crate::scalar::Scalar;

impl Bench<'_> {
    /// Why states may leave out a part of their place, if that is so.
    pub(super) fn missed_part(&self, sampler: &Sampler) -> Result<Option<String>, Fault> {
        let mut open = Vec::new();
        for pivot in sampler.pivots() {
            if !self.is_definite(sampler, pivot)? {
                open.push(pivot);
            }
        }
        // Factors of one equation that is left do no harm if they have no common factor.
        if let [pivot] = open[..]
            && !pivot.entries.is_empty()
            && are_coprime(sampler.graph(), &pivot.entries, self.options.seed)
        {
            return Ok(None);
        }
        let texts: Vec<String> = open
            .iter()
            .flat_map(|pivot| &pivot.equations)
            .map(|index| format!("`{}`", self.case.model.level[*index].text))
            .collect();
        Ok((!texts.is_empty()).then(|| {
            format!(
                "the level may fall apart: {} {} solved where what is divided by is not 0, and may \
                 hold elsewhere too; state each part in a case of its own, or give [level.chart]",
                texts.join(" and "),
                if texts.len() == 1 { "is" } else { "are" },
            )
        }))
    }

    /// Whether a pivot is known to vanish at no real state.
    fn is_definite(&self, sampler: &Sampler, pivot: &Pivot) -> Result<bool, Fault> {
        let graph = sampler.graph();
        for value in [pivot.slope, pivot.whole] {
            if graph.constant_value(value).is_some_and(|value| !value.is_zero())
                || self.is_number(sampler, value)?
                || is_nowhere_zero(graph, &sampler.extents(), &sampler.facts(), value)
            {
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// Whether a value is one number other than 0 at all states, as |γ|² is on the sphere.
    fn is_number(&self, sampler: &Sampler, value: Expr) -> Result<bool, Fault> {
        let (graph, domain) = (sampler.graph(), Mixed::new(256));
        let tape = Tape::new(graph, &[value]);
        let mut evaluator = Evaluator::new(&tape, domain);
        evaluator.run(&sampler.drawn(&domain, 1, 0));
        let guess = match evaluator.output(0) {
            Number::Exact(number) => Some(number.clone()),
            value => Mixed::enclosure(value, 0).and_then(|(mid, _)| simple(mid)),
        };
        let Some(number) = guess.filter(|number| !number.is_zero()) else { return Ok(false) };
        let reached = graph.reached([value]);
        let (graph, difference) = record(graph.inputs(), |inputs| {
            let values = graph.replay(&reached, inputs, |_, _, _| None);
            Some(values[graph.place(value)]? - Expr::rational(&number))
        })?;
        let Some(difference) = difference else { return Ok(false) };
        let (extents, sources) = (sampler.extents(), sampler.sources());
        let prover = Prover { sources: &sources, extents: &extents, seed: self.options.seed };
        let outcomes = prover.prove(&graph, &[Group::of(vec![difference])])?;
        Ok(outcomes.iter().all(|outcome| outcome.is_zero()))
    }
}

/// The fraction of small parts that a number nearly is, if it is nearly one.
fn simple(value: f64) -> Option<Rational> {
    const LARGEST: f64 = 1e4;
    let (mut rest, mut before, mut last) = (value, (0.0, 1.0), (1.0, 0.0));
    loop {
        let whole = rest.floor();
        (before, last) = (last, (whole * last.0 + before.0, whole * last.1 + before.1));
        if last.1 > LARGEST || !last.0.is_finite() {
            return None;
        }
        if (last.0 / last.1 - value).abs() <= 16.0 * f64::EPSILON * value.abs() {
            return (last.0.abs() < 1e9).then(|| Rational::new(last.0 as i64, last.1 as i64));
        }
        rest = 1.0 / (rest - whole);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn simple_fractions_are_recognised() {
        let fraction = |n, d| Some(Rational::new(n, d));
        assert_eq!(simple(4.0 + 1e-15), fraction(4, 1));
        assert_eq!(simple(-1.0 / 3.0), fraction(-1, 3));
        assert_eq!(simple(22.0 / 7.0), fraction(22, 7));
        assert_eq!(simple(std::f64::consts::PI), None);
    }
}
