//! Roots as independent symbols, for values with more roots than can be told apart.
//!
//! What is zero for symbols in the place of the roots is zero for the roots, however they depend on
//! each other. docs/soundness.md, "Many roots".

use rustc_hash::{FxHashMap, FxHashSet};

use crate::graph::{Expr, Fault, Graph, Step, record};
use crate::number::rational::Rational;
use crate::number::{BinaryOperation, UnaryFunction};
use crate::scalar::Scalar;

use super::bounds::InputDistribution;
use super::digest::SeedDigest;
use super::lower::Algebraic;
use super::rewrite::power;
use super::trial::{Certificate, Roots, Trial, TrialResult};

/// Values with square roots of rational functions as their only non-rational parts.
struct FreeRoots<'g> {
    graph: &'g Graph,
    /// Steps that the values need.
    reached: Vec<bool>,
    /// Whether a step contains a root, by place.
    has_root: Vec<bool>,
    /// Places of the radicands, each once.
    radicands: Vec<usize>,
    /// Places of the rational factors of denominators.
    divisors: Vec<usize>,
}

/// Proves that groups of values are zero with a symbol in the place of each root; `None` for a group
/// for which this does not succeed.
///
/// `special` are the places of all roots, moduli, signs and functions of the groups. Only square
/// roots of rational functions are treated, and no denominator that is a sum with roots.
pub fn zeros_for_free_roots(
    graph: &Graph,
    groups: &[&[Expr]],
    special: &[usize],
    sources: &[InputDistribution],
    digest: SeedDigest,
) -> Result<Vec<Option<Certificate>>, Fault> {
    let none = vec![None; groups.len()];
    let Some(free) = FreeRoots::of(graph, groups, special) else { return Ok(none) };
    if !free.is_defined(sources, digest)? {
        return Ok(none);
    }
    // A radicand outside of its root may have to be the square of the symbol, or what it is.
    let mut found = free.zeros(groups, sources, digest, false)?;
    if found.iter().any(Option::is_none) {
        let others = free.zeros(groups, sources, digest, true)?;
        found.iter_mut().zip(others).for_each(|(own, other)| *own = own.take().or(other));
    }
    Ok(found)
}

impl<'g> FreeRoots<'g> {
    fn of(graph: &'g Graph, groups: &[&[Expr]], special: &[usize]) -> Option<Self> {
        let reached = graph.reached(groups.concat());
        let mut is_special = vec![false; graph.len()];
        special.iter().for_each(|place| is_special[*place] = true);
        let mut known = FxHashSet::default();
        let mut free = Self {
            graph,
            has_root: vec![false; graph.len()],
            radicands: Vec::new(),
            divisors: Vec::new(),
            reached,
        };
        for place in (0..graph.len()).filter(|place| free.reached[*place]) {
            let step = graph.step(place);
            free.has_root[place] = step.arguments().any(|argument| free.has_root[argument]);
            if is_special[place] {
                let (radicand, _) = half_power(step)?;
                if free.has_root[radicand] || matches!(graph.step(radicand), Step::Constant(_)) {
                    return None;
                }
                free.has_root[place] = true;
                if known.insert(radicand) {
                    free.radicands.push(radicand);
                }
            }
        }
        let denominators = (0..graph.len()).filter_map(|place| match graph.step(place) {
            _ if !free.reached[place] => None,
            Step::Unary(UnaryFunction::Recip, a) => Some(a),
            Step::Power(a, exponent) => (*exponent < Rational::from(0)).then_some(a),
            _ => None,
        });
        let divisors = free.factors(denominators.collect())?;
        Some(Self { divisors, ..free })
    }

    /// Returns the rational factors of values that are products of roots and of rational functions;
    /// `None` if one is not.
    fn factors(&self, mut open: Vec<usize>) -> Option<Vec<usize>> {
        let mut rational = FxHashSet::default();
        while let Some(place) = open.pop() {
            match self.graph.step(place) {
                _ if !self.has_root[place] => {
                    rational.insert(place);
                }
                Step::Unary(UnaryFunction::Neg | UnaryFunction::Recip, a) => open.push(a),
                Step::Binary(BinaryOperation::Mul, a, b) => open.extend([a, b]),
                Step::Power(a, exponent) if exponent.to_integer().is_some() => open.push(a),
                step => {
                    half_power(step)?;
                }
            }
        }
        let mut rational: Vec<usize> = rational.into_iter().collect();
        rational.sort_unstable();
        Some(rational)
    }

    /// Whether no radicand and no rational divisor is zero: a root of 0 is no free symbol.
    fn is_defined(&self, sources: &[InputDistribution], digest: SeedDigest) -> Result<bool, Fault> {
        let places: Vec<usize> = self.radicands.iter().chain(&self.divisors).copied().collect();
        let (made, values) = record(sources.len(), |inputs| {
            let mut reached = self.reached.clone();
            reached.iter_mut().zip(&self.has_root).for_each(|(own, has)| *own &= !has);
            let values = self.graph.replay(&reached, inputs, |_, _, _| None);
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
        all.resize(sources.len() + self.radicands.len(), InputDistribution::Uniform);
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

    /// Records the groups with the last inputs in the place of the roots.
    fn replay(&self, groups: &[&[Expr]], inputs: &[Expr], squares: bool) -> Option<Vec<Vec<Expr>>> {
        let symbols = &inputs[inputs.len() - self.radicands.len()..];
        let by_radicand: FxHashMap<usize, Expr> =
            self.radicands.iter().copied().zip(symbols.iter().copied()).collect();
        let root = |place: usize, step: Step<'_>, _: &[Option<Expr>]| {
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
mod tests {
    use num_dual::DualNum;

    use super::*;

    /// Whether a function of two inputs is proved to be zero.
    fn is_zero(build: impl FnOnce(&[Expr]) -> Expr) -> bool {
        let (graph, value) = record(2, build).expect("records");
        let special: Vec<usize> =
            (0..graph.len()).filter(|place| half_power(graph.step(*place)).is_some()).collect();
        let sources = [InputDistribution::Uniform; 2];
        let digest = SeedDigest::of(1, &graph, &[vec![value]]);
        let found = zeros_for_free_roots(&graph, &[&[value]], &special, &sources, digest);
        matches!(found.expect("records")[..], [Some(_)])
    }

    #[test]
    fn zeros_need_no_relation_of_roots() {
        let cancels = |x: &[Expr]| {
            let (a, b) = ((x[0] * x[0] + x[1]).sqrt(), (x[1] + x[0]).sqrt());
            (a + b) * x[0] / b - a * (x[0] / b) - x[0]
        };
        assert!(is_zero(cancels), "(a + b) x/b = a x/b + x");
        let depends = |x: &[Expr]| x[0].sqrt() * x[1].sqrt() - (x[0] * x[1]).sqrt();
        assert!(!is_zero(depends), "√x √y = √(xy) needs a relation");
        let near = |x: &[Expr]| {
            let a = (x[0] * x[0] + x[1]).sqrt();
            (a + x[0]) * (a - x[0]) - a * a + x[0] * x[0] * x[1].sqrt()
        };
        assert!(!is_zero(near), "x² is not x² √y");
    }

    #[test]
    fn a_radicand_is_the_square_of_its_root() {
        let radicand = |x: &[Expr]| x[0] * x[0] + x[1];
        let squares = |x: &[Expr]| {
            let (a, b) = (radicand(x).sqrt(), (x[1] + x[0]).sqrt());
            (a + b) * (a - b) - radicand(x) + (x[1] + x[0])
        };
        assert!(is_zero(squares), "(a + b)(a − b) = A − B");
        let powers = |x: &[Expr]| {
            let a = radicand(x);
            (x[0] + x[1]) * a.power(&Rational::new(-1, 2))
                - (x[0] * (a.sqrt() / a) + x[1] / a.sqrt())
        };
        assert!(is_zero(powers), "(x + y) A^(−1/2) = x √A/A + y/√A");
        let opened = |x: &[Expr]| {
            let a = radicand(x);
            a.sqrt() * a.sqrt() - x[0] * x[0] - x[1] + (x[0] - x[0] * x[1].sqrt())
        };
        assert!(!is_zero(opened), "x is not x √y");
        // Without the root's relation the divisor is not zero.
        let hidden = |x: &[Expr]| {
            let a = radicand(x);
            let gap = a - x[0] * x[0] - x[1];
            (x[0] + x[1]) * gap.recip() - x[0] * gap.recip() - x[1] * gap.recip() + a.sqrt()
                - a.sqrt()
        };
        assert!(!is_zero(hidden), "1/(A − x² − y)");
    }

    #[test]
    fn hundreds_of_roots_are_no_obstacle() {
        let sum = |x: &[Expr]| {
            let terms = (1..=300).map(|k| {
                let radicand = x[0] * x[0] + x[1] * Expr::rational(&Rational::from(k));
                x[0] * (radicand.sqrt() / radicand)
            });
            let terms: Vec<Expr> = terms.collect();
            let sum = |by: Expr| terms.iter().fold(by, |sum, term| sum + *term * by);
            sum(x[1] + x[0]) - sum(x[1]) - sum(x[0])
        };
        assert!(is_zero(sum), "(x + y)(1 + Σ) = x(1 + Σ) + y(1 + Σ)");
    }

    #[test]
    fn what_may_have_no_value_is_left_out() {
        let divides = |x: &[Expr]| {
            let gap = x[0].sqrt() * x[1].sqrt() - (x[0] * x[1]).sqrt();
            (x[0] + x[1]) * gap.recip() - x[0] * gap.recip() - x[1] * gap.recip()
        };
        assert!(!is_zero(divides), "1/(√x √y − √(xy)) has no value for x, y > 0");
        let zero = |x: &[Expr]| {
            let a = ((x[0] + x[1]) * (x[0] - x[1]) - x[0] * x[0] + x[1] * x[1]).sqrt();
            (x[0] + x[1]) * a.recip() - x[0] * a.recip() - x[1] * a.recip()
        };
        assert!(!is_zero(zero), "1/√0");
        let nested = |x: &[Expr]| {
            let a = (x[0].sqrt() + x[1]).sqrt();
            (a + x[0]) * (a - x[0]) - a * a + x[0] * x[0]
        };
        assert!(!is_zero(nested), "a root within a root");
        let products = |x: &[Expr]| {
            let a = (x[0] * x[0] + x[1]).sqrt();
            (a * x[0]).recip() * (x[0] + x[1]) - a.recip() - (a * x[0]).recip() * x[1]
        };
        assert!(is_zero(products), "(x + y)/(a x) = 1/a + y/(a x)");
    }
}
