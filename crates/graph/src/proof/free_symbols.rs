//! Roots, moduli and functions as independent symbols, for values with more of them than can be told
//! apart.
//!
//! What is zero for symbols in their place is zero for them, however they depend on each other.
//! docs/soundness.md, "Free symbols".

use rustc_hash::{FxHashMap, FxHashSet};

use crate::graph::{Expr, Fault, Graph, Step, record};
use crate::number::rational::Rational;
use crate::number::{BinaryOperation, UnaryFunction};
use crate::scalar::Scalar;

use super::bounds::InputDistribution;
use super::digest::SeedDigest;
use super::explore::Question;
use super::lower::Algebraic;
use super::rewrite::power;
use super::trial::{Certificate, Roots, Trial, TrialResult};

/// Values whose roots, moduli and functions are symbols.
struct FreeSymbols<'g> {
    graph: &'g Graph,
    /// Steps that the values need.
    reached: Vec<bool>,
    /// Whether a step contains a symbol, by place.
    has_symbol: Vec<bool>,
    /// Places of the rational radicands of square roots, each once.
    radicands: Vec<usize>,
    /// Places of all other steps with a symbol of their own.
    others: Vec<usize>,
    /// Places of the rational factors of denominators, of X for the factors |X|, and of A for √A.
    divisors: Vec<usize>,
    /// The same for those that contain symbols.
    doubtful: Vec<usize>,
}

/// Largest number of values with symbols that are proved to vanish on no open set.
const MOST_DOUBTFUL: usize = 128;

/// Proves that the groups of a question are zero with symbols in the place of roots, moduli and
/// functions; `None` for a group for which this does not succeed.
///
/// A step gets a symbol only if it exists where the required values do, and no denominator may vanish on
/// an open set unless it is one of theirs; `is_thin` tells whether a value is proved not to.
pub fn zeros_for_free_symbols(
    question: &Question<'_>,
    is_thin: &dyn Fn(Expr) -> Result<bool, Fault>,
    inputs: usize,
    digest: SeedDigest,
) -> Result<Vec<Option<Certificate>>, Fault> {
    let (graph, groups) = (question.graph, &question.groups[..]);
    let none = vec![None; groups.len()];
    let Some(free) = FreeSymbols::of(question) else { return Ok(none) };
    // A sign of a level is a symbol like others.
    let sources = vec![InputDistribution::Uniform; inputs];
    if free.doubtful.len() > MOST_DOUBTFUL || !free.is_defined(&sources, digest)? {
        return Ok(none);
    }
    for place in &free.doubtful {
        if !is_thin(graph.at(*place))? {
            return Ok(none);
        }
    }
    // A radicand outside of its root may have to be the square of the symbol, or what it is.
    let mut found = free.zeros(groups, &sources, digest, false)?;
    if found.iter().any(Option::is_none) && !free.radicands.is_empty() {
        let others = free.zeros(groups, &sources, digest, true)?;
        found.iter_mut().zip(others).for_each(|(own, other)| *own = own.take().or(other));
    }
    Ok(found)
}

impl<'g> FreeSymbols<'g> {
    fn of(question: &Question<'g>) -> Option<Self> {
        let Question { graph, groups, special, required } = question;
        let reached = graph.reached(groups.concat());
        let given = graph.reached(required.iter().copied());
        let mut is_special = vec![false; graph.len()];
        special.iter().for_each(|place| is_special[*place] = true);
        let bases: FxHashSet<usize> = graph
            .steps()
            .zip(&given)
            .filter_map(|(step, given)| match step {
                Step::Binary(BinaryOperation::Pow, a, _) if *given => Some(a),
                _ => None,
            })
            .collect();
        let mut known = FxHashSet::default();
        let mut free = Self {
            graph,
            has_symbol: vec![false; graph.len()],
            radicands: Vec::new(),
            others: Vec::new(),
            divisors: Vec::new(),
            doubtful: Vec::new(),
            reached,
        };
        for place in (0..graph.len()).filter(|place| free.reached[*place]) {
            let step = graph.step(place);
            free.has_symbol[place] = step.arguments().any(|argument| free.has_symbol[argument]);
            // Sums are there for their signs.
            let is_rational =
                matches!(step, Step::Input(_) | Step::Binary(BinaryOperation::Add, ..));
            if !is_special[place] || is_rational {
                continue;
            }
            let is_plain =
                |a: usize| !free.has_symbol[a] && !matches!(graph.step(a), Step::Constant(_));
            match half_power(step).filter(|(radicand, _)| is_plain(*radicand)) {
                Some((radicand, _)) => {
                    if known.insert(radicand) {
                        free.radicands.push(radicand);
                    }
                }
                None => {
                    let exists = given[place]
                        || match step {
                            // x^y exists where x > 0, and so does ln x.
                            Step::Unary(UnaryFunction::Ln, a) => bases.contains(&a),
                            Step::Unary(..) => step.need().is_none(),
                            _ => false,
                        };
                    if !exists {
                        return None;
                    }
                    free.others.push(place);
                }
            }
            free.has_symbol[place] = true;
        }
        let denominators = (0..graph.len()).filter_map(|place| match graph.step(place) {
            _ if !free.reached[place] || given[place] => None,
            Step::Unary(UnaryFunction::Recip, a) => Some(a),
            Step::Power(a, exponent) => (*exponent < Rational::from(0)).then_some(a),
            _ => None,
        });
        let inverted: FxHashSet<usize> = graph
            .steps()
            .zip(&given)
            .filter_map(|(step, given)| match step {
                Step::Unary(UnaryFunction::Recip, a) if *given => Some(a),
                _ => None,
            })
            .collect();
        let denominators = denominators.collect();
        free.add_factors(denominators, &inverted);
        Some(free)
    }

    /// Adds the factors of denominators, which may vanish on no open set.
    fn add_factors(&mut self, mut open: Vec<usize>, inverted: &FxHashSet<usize>) {
        let mut seen = FxHashSet::default();
        while let Some(place) = open.pop() {
            if !seen.insert(place) {
                continue;
            }
            match self.graph.step(place) {
                _ if !self.has_symbol[place] => self.divisors.push(place),
                Step::Unary(UnaryFunction::Neg | UnaryFunction::Recip, a) => open.push(a),
                Step::Binary(BinaryOperation::Mul, a, b) => open.extend([a, b]),
                Step::Power(a, exponent) if exponent.to_integer().is_some() => open.push(a),
                Step::Unary(UnaryFunction::Exp, _) | Step::Binary(BinaryOperation::Pow, ..) => {}
                _ if inverted.contains(&place) => {}
                Step::Unary(UnaryFunction::Abs | UnaryFunction::Sqrt, a) | Step::Power(a, _) => {
                    open.push(a);
                }
                _ => self.doubtful.push(place),
            }
        }
        self.divisors.sort_unstable();
        self.doubtful.sort_unstable();
    }

    /// Whether no radicand and no rational divisor is zero: a root of 0 is no free symbol.
    fn is_defined(&self, sources: &[InputDistribution], digest: SeedDigest) -> Result<bool, Fault> {
        let places: Vec<usize> = self.radicands.iter().chain(&self.divisors).copied().collect();
        let (made, values) = record(sources.len(), |inputs| {
            let mut reached = self.reached.clone();
            reached.iter_mut().zip(&self.has_symbol).for_each(|(own, has)| *own &= !has);
            let values = self.graph.repeated(&reached, inputs);
            places.iter().map(|place| Some(vec![values[*place]?])).collect::<Option<Vec<_>>>()
        })?;
        let Some(values) = values else { return Ok(false) };
        let algebraic = Algebraic::plain(&made, sources);
        let values: Vec<&[Expr]> = values.iter().map(Vec::as_slice).collect();
        let results = Trial::new(&algebraic, digest).test(&values, Roots::default());
        Ok(results.iter().all(|result| matches!(result, TrialResult::NonZero)))
    }

    /// Proves groups to be zero for free symbols; with `squares`, each radicand is the square of
    /// its symbol wherever it occurs.
    fn zeros(
        &self,
        groups: &[&[Expr]],
        sources: &[InputDistribution],
        digest: SeedDigest,
        squares: bool,
    ) -> Result<Vec<Option<Certificate>>, Fault> {
        let none = vec![None; groups.len()];
        let mut all = sources.to_vec();
        let symbols = self.radicands.len() + self.others.len();
        all.resize(sources.len() + symbols, InputDistribution::Uniform);
        let (made, values) = record(all.len(), |inputs| self.replay(groups, inputs, squares))?;
        let Some(values) = values else { return Ok(none) };
        if values.iter().flatten().any(|value| made.is_nowhere_defined(*value)) {
            return Ok(none);
        }
        let algebraic = Algebraic::plain(&made, &all);
        let values: Vec<&[Expr]> = values.iter().map(Vec::as_slice).collect();
        let results = Trial::new(&algebraic, digest).test(&values, Roots::default());
        let zeros = results.into_iter().map(|result| match result {
            TrialResult::Zero(certificate) => Some(certificate),
            _ => None,
        });
        Ok(zeros.collect())
    }

    /// Records the groups with the last inputs in the place of roots, moduli and functions.
    fn replay(&self, groups: &[&[Expr]], inputs: &[Expr], squares: bool) -> Option<Vec<Vec<Expr>>> {
        let count = self.radicands.len() + self.others.len();
        let (symbols, others) = inputs[inputs.len() - count..].split_at(self.radicands.len());
        let by_place: FxHashMap<usize, Expr> =
            self.others.iter().copied().zip(others.iter().copied()).collect();
        let by_radicand: FxHashMap<usize, Expr> =
            self.radicands.iter().copied().zip(symbols.iter().copied()).collect();
        let root = |place: usize, step: Step<'_>, _: &[Option<Expr>]| {
            if let Some(symbol) = by_place.get(&place) {
                return Some(*symbol);
            }
            if let Some(root) = by_radicand.get(&place).filter(|_| squares) {
                return Some(*root * *root);
            }
            let (radicand, power) = half_power(step)?;
            Some(by_radicand.get(&radicand)?.power(&power))
        };
        let values = self.graph.replay(&self.reached, inputs, root);
        let at = |expr: &Expr| values[self.graph.place(*expr)];
        groups.iter().map(|group| group.iter().map(at).collect()).collect()
    }
}

/// Returns the argument of a root, or of an odd power of one, and that power.
fn half_power(step: Step<'_>) -> Option<(usize, Rational)> {
    let (argument, exponent) = power(step)?;
    let power = &exponent * &Rational::from(2);
    power.to_integer().is_some().then_some((argument, power))
}

#[cfg(test)]
mod tests;
