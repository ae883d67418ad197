//! States on parts on which radicands are proved to vanish.
//!
//! A ball about 0 does not show that its root exists: √(y + |y|) on a level that makes y by a root,
//! for y < 0. Where the radicand is identically 0, it is put to 0, and the root is √0.

use super::antiderivative_value;
use super::existence::signed_extents;
use super::field::{DrawnGroup, Where};
use super::judging::Judging;
use super::ladder::LADDER_BITS;
use super::sampler::Sampler;
use crate::graph::{Evaluator, Expr, Fault, Graph, Step, Tape, literally, record};
use crate::mechanics::Draw;
use crate::number::mixed::{Mixed, Number};
use crate::number::rational::Rational;
use crate::number::{Domain, Enclosing};
use crate::proof::{Group, InputRegion, Prover, conditions};
use crate::scalar::Scalar;

/// Number of drawn states that are tried on each part.
const STATES: u64 = 64;

impl Judging<'_> {
    /// Whether a state is known at which the values are not identically 0 and all that is required
    /// exists, as it does around it; radicands that vanish on a part of the states are put to 0 there.
    pub(super) fn has_state_with_zeros(
        &self,
        sampler: &Sampler,
        found: &Where,
    ) -> Result<bool, Fault> {
        let DrawnGroup { graph, group } = &found.drawn;
        let (extents, sources) = (sampler.extents(), sampler.sources());
        let prover = Prover { sources: &sources, extents: &extents, seed: self.options.seed };
        for part in prover.nonzero_parts(graph, group)? {
            if Settled::of(&part, graph, group)?.has_state(sampler) {
                return Ok(true);
            }
        }
        Ok(false)
    }
}

/// The required values as they are on a part, together with what makes the part.
struct Settled {
    required: Vec<Expr>,
    /// The part, with the other radicands and the arguments of logarithms and powers, all of which
    /// have to be positive.
    inside: InputRegion,
}

impl Settled {
    fn of(part: &InputRegion, graph: &Graph, group: &Group) -> Result<Self, Fault> {
        let reached = graph.reached(group.required.iter().copied());
        let facts = graph.reached(group.facts.iter().copied());
        let zeros: Vec<usize> = part.zeros.iter().map(|value| graph.place(*value)).collect();
        let own = part.graph.reached(part.positive.iter().copied());
        let count = graph.inputs().max(part.graph.inputs());
        let (made, found) = record(count, |inputs| {
            let zero = |place, _: Step<'_>, _: &[Option<Expr>]| {
                zeros.contains(&place).then(|| Expr::rational(&Rational::from(0)))
            };
            let at = |made: &[Option<Expr>], graph: &Graph, values: &[Expr]| {
                let all = values.iter().map(|value| made[graph.place(*value)]);
                all.collect::<Option<Vec<Expr>>>()
            };
            let required = literally(|| graph.replay(&reached, inputs, zero));
            let facts = graph.replay(&facts, inputs, |_, _, _| None);
            let own = part.graph.replay(&own, inputs, |_, _, _| None);
            let mut positive = at(&own, &part.graph, &part.positive)?;
            positive.extend(at(&facts, graph, &group.facts)?);
            Some((at(&required, graph, &group.required)?, positive))
        })?;
        let (required, mut positive) = found.ok_or(Fault::ForeignValue)?;
        let reached = made.reached(required.iter().copied());
        let facts = conditions(&made, &reached).into_iter();
        positive.extend(facts.map(|(place, _)| made.at(place)));
        let inside =
            InputRegion { graph: made, positive, signs: part.signs.clone(), zeros: Vec::new() };
        Ok(Self { required, inside })
    }

    fn has_state(&self, sampler: &Sampler) -> bool {
        let (domain, inside) = (Mixed::new(LADDER_BITS[0]), &self.inside);
        let tape = Tape::new(&inside.graph, &[&inside.positive[..], &self.required].concat());
        let mut evaluator = Evaluator::new(&tape, domain);
        let mut counts = |mut inputs: Vec<Number>| {
            let further = inside.graph.inputs().saturating_sub(inputs.len());
            inputs.extend((0..further).map(|k| domain.constant(&antiderivative_value(k))));
            let has_signs = inside.signs.iter().all(|(input, positive)| {
                inputs.get(*input).is_some_and(|sign| is_positive(sign) == *positive)
            });
            if !has_signs {
                return false;
            }
            evaluator.run(&inputs);
            let mut values = evaluator.outputs();
            values.by_ref().take(inside.positive.len()).all(is_positive)
                && values.all(|value| Mixed::enclosure(value, 0).is_some())
        };
        let found = || {
            signed_extents(sampler, inside).into_iter().find_map(|extents| {
                let draws = sampler.recipes().iter().zip(inside.point(&extents)?);
                let number =
                    |(draw, x): (&Draw, f64)| draw.only().or_else(|| Rational::from_f64(x));
                draws.map(number).map(|number| number.map(Number::Exact)).collect()
            })
        };
        (0..STATES).any(|index| counts(sampler.drawn(&domain, 1, index)))
            || found().is_some_and(counts)
    }
}

/// Whether a number is known to be positive.
fn is_positive(value: &Number) -> bool {
    Mixed::excludes_zero(value, 0) && Mixed::enclosure(value, 0).is_some_and(|(mid, _)| mid > 0.0)
}
