//! States around which required values exist, though balls do not show it.
//!
//! A ball about 0 does not show that its root exists: √(y + |y|) on a level that makes y by a root,
//! for y < 0. Around a state at which y is not 0, |y| is −y, and the root is √0.

use num_traits::Zero;

use super::antiderivative_value;
use super::existence::signed_extents;
use super::field::{DrawnGroup, Where};
use super::judging::Judging;
use super::ladder::{LADDER_BITS, Open};
use super::recorded::RecordedClaim;
use super::sampler::Sampler;
use crate::graph::{Evaluator, Expr, Fault, Graph, Step, Tape, literally, record};
use crate::mechanics::{Draw, combinations};
use crate::number::mixed::{Mixed, Number};
use crate::number::rational::Rational;
use crate::number::{Domain, Enclosing, UnaryFunction};
use crate::proof::{Group, InputRegion, Prover, SquareRoot, conditions, point};

/// Number of drawn states that are tried on each part.
const STATES: u64 = 64;
/// Largest number of parts with other signs that are searched for a state.
const MOST_SEARCHED: usize = 4;
/// Largest number of moduli that are replaced inside of each other.
const MOST_PASSES: usize = 8;

impl Judging<'_> {
    /// Looks for states around which all formulas of claims exist that are known to be 0 wherever they
    /// do, but were seen at no state.
    pub(super) fn unseen_states(
        &self,
        sampler: &Sampler,
        open: &mut Open<'_, '_>,
    ) -> Result<(), Fault> {
        for (item, status) in open.iter_mut() {
            let is_unseen = status.settled.is_none() && status.is_zero;
            if is_unseen
                && status.undefined.is_some()
                && item.context.quadrature_defects.is_empty()
                && !sampler.is_numerical()
                && self.has_any_state(item, sampler)?
            {
                status.undefined = None;
            }
        }
        Ok(())
    }

    /// Whether a state is known around which all that a claim requires exists.
    fn has_any_state(&self, item: &RecordedClaim<'_>, sampler: &Sampler) -> Result<bool, Fault> {
        let common = self.common.required_at(sampler.kept());
        let group = Group {
            outputs: item.residual.clone(),
            required: [&item.requirement[..], &common, &item.context.value].concat(),
            ..Group::default()
        };
        for fixed in combinations(sampler.recipes()).unwrap_or_default() {
            let groups = std::slice::from_ref(&group);
            let (graph, groups) = sampler.compose_groups(self.graph, groups, &fixed)?;
            let Some(group) = groups.first() else { continue };
            if has_state(&sampler.with(&fixed), &Surroundings::of(&graph, group)?)? {
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// Whether a state is known on a part on which the values are not identically 0, around which all
    /// that is required exists.
    pub(super) fn has_state_around(&self, sampler: &Sampler, found: &Where) -> Result<bool, Fault> {
        let DrawnGroup { graph, group } = &found.drawn;
        let (extents, sources) = (sampler.extents(), sampler.sources());
        let prover = Prover { sources: &sources, extents: &extents, seed: self.options.seed };
        let whole = Surroundings::of(graph, group)?;
        for part in prover.nonzero_parts(graph, group)? {
            if has_state(sampler, &whole.inside(&part)?)? {
                return Ok(true);
            }
        }
        Ok(false)
    }
}

/// Whether a state is known around which all required values of a part exist.
fn has_state(sampler: &Sampler, part: &Surroundings) -> Result<bool, Fault> {
    let mut searched: Vec<Surroundings> = Vec::new();
    let drawn = (0..STATES).map(|index| sampler.drawn(&domain(), 1, index));
    for state in drawn.chain(part.points(sampler, &[])) {
        let Some(state) = part.completed(state) else { continue };
        let around = part.around(&state)?;
        if around.exist_at(&state) {
            return Ok(true);
        }
        if searched.len() < MOST_SEARCHED {
            searched.push(around);
        }
    }
    for around in searched {
        let conditions = around.conditions_of(&around.required);
        let points = around.points(sampler, &conditions);
        let mut completed = points.into_iter().filter_map(|state| around.completed(state));
        if completed.any(|state| around.exist_at(&state)) {
            return Ok(true);
        }
    }
    Ok(false)
}

/// Makes the domain in which states are examined.
fn domain() -> Mixed {
    Mixed::new(LADDER_BITS[0])
}

/// Another value of some steps.
type Replacement<'r> = &'r dyn Fn(usize, Step<'_>, &[Option<Expr>]) -> Option<Expr>;

/// Required values, and values that are positive where they are as written here.
struct Surroundings {
    graph: Graph,
    required: Vec<Expr>,
    positive: Vec<Expr>,
    /// Sign inputs, and whether each is 1.
    signs: Vec<(usize, bool)>,
}

impl Surroundings {
    /// Takes the requirement of a group as it stands.
    fn of(graph: &Graph, group: &Group) -> Result<Self, Fault> {
        let whole = [&group.required[..], &group.facts].concat();
        let reached = graph.reached(whole.iter().copied());
        let (made, found) = record(graph.inputs(), |inputs| {
            let values = literally(|| graph.repeated(&reached, inputs));
            at(&values, graph, &whole)
        })?;
        let mut required = found.ok_or(Fault::ForeignValue)?;
        let positive = required.split_off(group.required.len());
        Ok(Self { graph: made, required, positive, signs: Vec::new() })
    }

    /// Restricts to a part.
    fn inside(&self, part: &InputRegion) -> Result<Self, Fault> {
        let reached = part.graph.reached(part.positive.iter().copied());
        let mut found = self.replayed(&|_, _, _| None, |inputs| {
            let values = part.graph.repeated(&reached, inputs);
            at(&values, &part.graph, &part.positive)
        })?;
        found.signs = part.signs.clone();
        Ok(found)
    }

    /// Completes the draws of a state by what follows them; `None` if it is not known to be inside.
    fn completed(&self, mut state: Vec<Number>) -> Option<Vec<Number>> {
        let further = self.graph.inputs().saturating_sub(state.len());
        state.extend((0..further).map(|k| domain().constant(&antiderivative_value(k))));
        let has_signs = self.signs.iter().all(|(input, positive)| {
            state.get(*input).is_some_and(|sign| is_positive(sign) == *positive)
        });
        (has_signs && self.values(&state, &self.positive).iter().all(is_positive)).then_some(state)
    }

    fn values(&self, state: &[Number], of: &[Expr]) -> Vec<Number> {
        let tape = Tape::new(&self.graph, of);
        let mut evaluator = Evaluator::new(&tape, domain());
        evaluator.run(state);
        evaluator.outputs().cloned().collect()
    }

    /// Replaces moduli, and roots of squares, by what they are around a state.
    fn around(&self, state: &[Number]) -> Result<Self, Fault> {
        let mut found = self.replayed(&|_, _, _| None, |_| Some(Vec::new()))?;
        for _ in 0..MOST_PASSES {
            let Some(next) = found.resolved(state)? else { break };
            found = next;
        }
        Ok(found)
    }

    /// Replaces those moduli and roots of squares whose signs at a state are known; `None` if there
    /// are none.
    fn resolved(&self, state: &[Number]) -> Result<Option<Self>, Fault> {
        let reached = self.graph.reached(self.required.iter().copied());
        let steps = self.graph.steps().enumerate().filter(|(place, _)| reached[*place]);
        let mut moduli: Vec<(usize, Option<SquareRoot>, Expr)> = Vec::new();
        for (place, step) in steps {
            match step {
                Step::Unary(UnaryFunction::Abs, a) => {
                    moduli.push((place, None, self.graph.at(a)));
                }
                Step::Unary(UnaryFunction::Sqrt, a) => {
                    let square = SquareRoot::of(&self.graph, self.graph.at(a));
                    let square = square.filter(|square| !square.is_negative());
                    moduli.extend(square.map(|square| (place, Some(square), self.graph.at(a))));
                }
                _ => {}
            }
        }
        if moduli.is_empty() {
            return Ok(None);
        }
        // The argument of each modulus, and the root of each square.
        let (graph, arguments) = record(self.graph.inputs(), |inputs| {
            let values = self.graph.repeated(&reached, inputs);
            let argument = |(_, square, a): &(usize, Option<SquareRoot>, Expr)| match square {
                Some(square) => square.value(|place| values[place]),
                None => values[self.graph.place(*a)],
            };
            moduli.iter().map(argument).collect::<Option<Vec<Expr>>>()
        })?;
        let arguments = arguments.ok_or(Fault::ForeignValue)?;
        let own = Self { graph, required: Vec::new(), positive: Vec::new(), signs: Vec::new() };
        let known: Vec<Option<bool>> = own
            .values(state, &arguments)
            .iter()
            .map(|value| Mixed::excludes_zero(value, 0).then(|| is_positive(value)))
            .collect();
        if known.iter().all(Option::is_none) {
            return Ok(None);
        }
        let signed = |value: Expr, positive: bool| if positive { value } else { -value };
        let replaced = |place: usize, _: Step<'_>, values: &[Option<Expr>]| {
            let index = moduli.iter().position(|(own, ..)| *own == place)?;
            let (_, square, a) = &moduli[index];
            let argument = values[self.graph.place(*a)]?;
            let value = match square {
                // √(1 + 0 √x) is 1 where √x exists.
                Some(square) => square.value(|place| values[place])? + argument * Expr::zero(),
                None => argument,
            };
            Some(signed(value, known[index]?))
        };
        let more = |inputs: &[Expr]| {
            let reached = own.graph.reached(arguments.iter().copied());
            let values = own.graph.repeated(&reached, inputs);
            let all = arguments.iter().zip(&known).filter_map(|(argument, known)| {
                known.map(|positive| Some(signed(values[own.graph.place(*argument)]?, positive)))
            });
            all.collect()
        };
        self.replayed(&replaced, more).map(Some)
    }

    /// Records the values anew, literally, with further positive values. A root is 0 where what is under
    /// it folds to 0 and its parts exist.
    fn replayed(
        &self,
        replaced: Replacement<'_>,
        more: impl FnOnce(&[Expr]) -> Option<Vec<Expr>>,
    ) -> Result<Self, Fault> {
        let required = self.graph.reached(self.required.iter().copied());
        let positive = self.graph.reached(self.positive.iter().copied());
        let (graph, found) = record(self.graph.inputs(), |inputs| {
            let folded = self.graph.replay(&required, inputs, replaced);
            let written = |place: usize, step: Step<'_>, values: &[Option<Expr>]| match step {
                Step::Unary(UnaryFunction::Sqrt, a) if folded[a]?.is_zero() => {
                    Some(values[a]? * Expr::zero())
                }
                _ => replaced(place, step, values),
            };
            let values = literally(|| self.graph.replay(&required, inputs, written));
            let before = self.graph.repeated(&positive, inputs);
            let mut positive = at(&before, &self.graph, &self.positive)?;
            positive.extend(more(inputs)?);
            Some((at(&values, &self.graph, &self.required)?, positive))
        })?;
        let (required, positive) = found.ok_or(Fault::ForeignValue)?;
        Ok(Self { graph, required, positive, signs: self.signs.clone() })
    }

    /// Returns the radicands, and the arguments of logarithms and powers, in some values.
    fn conditions_of(&self, values: &[Expr]) -> Vec<Expr> {
        let reached = self.graph.reached(values.iter().copied());
        let found = conditions(&self.graph, &reached).into_iter();
        found.map(|(place, _)| self.graph.at(place)).collect()
    }

    /// Whether all required values exist at a state inside, and around it.
    fn exist_at(&self, state: &[Number]) -> bool {
        let exists = |value: &Number| Mixed::enclosure(value, 0).is_some();
        self.values(state, &self.positive).iter().all(is_positive)
            && self.values(state, &self.conditions_of(&self.required)).iter().all(is_positive)
            && self.values(state, &self.required).iter().all(exists)
    }

    /// Searches for states inside, and at which further values are positive.
    fn points(&self, sampler: &Sampler, further: &[Expr]) -> Vec<Vec<Number>> {
        let mut positive = [&self.positive[..], further].concat();
        // All of them must exist, too.
        positive.extend(self.conditions_of(&positive));
        let all = signed_extents(sampler, &self.signs).into_iter();
        let found = all.filter_map(|extents| {
            let point = point(&self.graph, &extents, &positive)?;
            let number = |(draw, x): (&Draw, f64)| draw.only().or_else(|| Rational::from_f64(x));
            let numbers = sampler.recipes().iter().zip(point).map(number);
            numbers.map(|number| number.map(Number::Exact)).collect()
        });
        found.collect()
    }
}

/// Returns the values of a replay that belong to some values of the graph.
fn at(values: &[Option<Expr>], graph: &Graph, of: &[Expr]) -> Option<Vec<Expr>> {
    of.iter().map(|value| values[graph.place(*value)]).collect()
}

/// Whether a number is known to be positive.
fn is_positive(value: &Number) -> bool {
    Mixed::is_positive(value, 0)
}
