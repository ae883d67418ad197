//! Functions that a bracket, or its time, is multiplied by: products of powers of factors that the
//! case offers.
//!
//! With v = N P ∂H, a function s makes sP a Poisson bracket if and only if
//! Σ_l (P_il ∂_lP_jk + P_il ∂_l(ln s) P_jk) + cyclic = 0. This is linear in the exponents of
//! s = Π fᵅ, and v = (N/s) (sP) ∂H. Where P is one of a family, the products of these exponents and
//! the numbers of the family are taken as further unknowns.

use super::super::library;
use super::super::linear::SampledFunctions;
use super::super::orbit;
use super::super::terms::{is_one, numeric_exponent, one, recorded};
use super::super::{Effort, FoundKind, SearchError, SearchReport};
use liouville::case::Case;
use liouville::claim::{ClaimKind, Density};
use liouville::formula::{Formula, FormulaError, FormulaResult, Type};
use liouville::graph::{Expr, Graph, Step};
use liouville::mechanics::calculus::DualPoint;
use liouville::number::rational::Rational;
use liouville::number::{BinaryOperation, UnaryFunction};

/// Largest number of factors.
const FACTORS: usize = 12;
/// Largest number of multipliers that are tried.
const MULTIPLIERS: usize = 8;
/// Exponents of a factor that is tried as a multiplier.
const TRIED: [i64; 3] = [-1, 1, -2];

/// Factors of multipliers.
pub(super) struct Scales {
    factors: Vec<Formula>,
    /// Places of the factors that are rational functions.
    rational: Vec<usize>,
    /// Densities that are products of whole powers of these.
    densities: Vec<Scale>,
}

/// A product of powers of the factors, by its exponents.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Scale(Vec<Rational>);

impl Scale {
    /// Whether the product is empty.
    pub(super) fn is_one(&self) -> bool {
        self.0.iter().all(Rational::is_zero)
    }

    /// The quotient of two products.
    pub(super) fn over(&self, other: &Self) -> Self {
        Self(self.0.iter().zip(&other.0).map(|(a, b)| a - b).collect())
    }
}

impl Scales {
    /// Lists the factors: denominators and roots in the field and in the densities known, Darboux
    /// polynomials, factors that the system offers, and the densities.
    pub(super) fn of(
        case: &Case,
        effort: &Effort,
        report: &SearchReport,
    ) -> Result<Self, SearchError> {
        let claimed = case.claims.iter().filter_map(|claim| match &claim.kind {
            ClaimKind::Density(Density(formula)) if !effort.blind => Some(formula),
            _ => None,
        });
        let densities: Vec<Formula> =
            report.functions(FoundKind::Density).chain(claimed).cloned().collect();
        let mut all = orbit::factors(case, effort, &densities)?;
        let curves = report.found.iter().filter(|found| found.kind == FoundKind::DarbouxPolynomial);
        all.extend(curves.filter_map(|found| found.function().cloned()));
        all.extend(library::factors(&case.model));
        all.truncate(FACTORS);
        let first_density = all.len();
        all.extend(densities);
        all.retain(|own| own.value_type() == Type::Scalar);
        let (graph, (values, slopes)) = recorded(case, |jet| {
            let values: Vec<Expr> = all.iter().map(|own| jet.phase.scalar(own)).collect();
            let slopes: Vec<_> = all.iter().map(|own| jet.logarithmic_gradient(own)).collect();
            (values, slopes)
        })?;
        // Products of powers of earlier ones, and constants, have no use of their own.
        let mut functions = SampledFunctions::new(case, &graph, &slopes, effort)?;
        let (kept, relations) = match functions.relations() {
            Err(SearchError::NoPoints) => (Vec::new(), Vec::new()),
            other => {
                let other = other?;
                (other.independent(), other.rational()?.0)
            }
        };
        let rational: Vec<usize> =
            (0..kept.len()).filter(|k| is_rational(&graph, values[kept[*k]])).collect();
        let written = |relation: &Vec<Rational>| -> Option<Scale> {
            let last = relation.iter().rposition(|entry| !entry.is_zero())?;
            let own: Vec<Rational> = kept.iter().map(|k| -&relation[*k]).collect();
            let is_whole = |(place, entry): (usize, &Rational)| {
                entry.is_zero() || (entry.to_integer().is_some() && rational.contains(&place))
            };
            let is_product = last >= first_density && own.iter().enumerate().all(is_whole);
            is_product.then_some(Scale(own)).filter(|own| !own.is_one())
        };
        let densities = relations.iter().filter_map(written).collect();
        let factors = kept.iter().map(|k| all[*k].clone()).collect();
        Ok(Self { factors, rational, densities })
    }

    /// The product without factors.
    pub(super) fn one(&self) -> Scale {
        Scale(vec![Rational::from(0); self.factors.len()])
    }

    /// Lists the multipliers N that are tried in v = N P ∂H: 1, the inverses of densities, then powers of
    /// rational factors.
    pub(super) fn multipliers(&self) -> Vec<Scale> {
        let power = |exponent: i64| {
            self.rational.iter().map(move |place| {
                let mut own = self.one();
                own.0[*place] = Rational::from(exponent);
                own
            })
        };
        let inverses = self.densities.iter().map(|own| self.one().over(own));
        let mut all = vec![self.one()];
        for own in inverses.chain(TRIED.into_iter().flat_map(power)) {
            if !all.contains(&own) && all.len() <= MULTIPLIERS {
                all.push(own);
            }
        }
        all
    }

    /// Writes a product as a numerator and a denominator, each `None` where it is 1.
    pub(super) fn parts(&self, scale: &Scale) -> Result<[Option<Formula>; 2], FormulaError> {
        let (mut above, mut below) = (None, None);
        for (factor, exponent) in self.factors.iter().zip(&scale.0) {
            if exponent.is_zero() {
                continue;
            }
            let (part, size) = match exponent.is_negative() {
                true => (&mut below, exponent.abs()),
                false => (&mut above, exponent.clone()),
            };
            let power = match size.is_one() {
                true => factor.clone(),
                false => factor.power(&numeric_exponent(size)?)?,
            };
            *part = Some(match part.take() {
                None => power,
                Some(before) => (&before * &power)?,
            });
        }
        Ok([above, below])
    }

    /// Writes a product as a formula.
    pub(super) fn formula(&self, scale: &Scale) -> FormulaResult {
        self.scaled(&one(), scale)
    }

    /// Writes the product of a formula and a scale.
    pub(super) fn scaled(&self, formula: &Formula, scale: &Scale) -> FormulaResult {
        if scale.is_one() || formula.constant().is_some_and(|value| value.is_zero()) {
            return Ok(formula.clone());
        }
        match self.parts(scale)? {
            [None, None] => Ok(formula.clone()),
            [Some(above), None] if is_one(formula) => Ok(above),
            [Some(above), None] => &above * formula,
            [None, Some(below)] => formula / &below,
            [Some(above), Some(below)] if is_one(formula) => &above / &below,
            [Some(above), Some(below)] => (&above * formula)? / &below,
        }
    }

    /// Finds numbers c and a product s for which s(P + Σ cB) satisfies Jacobi's identity at random
    /// states of the level; P is the first tensor. The products of the unknowns are unknowns too.
    pub(super) fn mended(
        &self,
        case: &Case,
        tensors: &[Vec<Vec<Formula>>],
        effort: &Effort,
    ) -> Result<Option<(Vec<Rational>, Scale)>, SearchError> {
        let dimension = case.model.dimension();
        if dimension < 3 || tensors.len() + self.factors.len() < 2 {
            return Ok(None);
        }
        let pairs: Vec<(usize, usize)> =
            (0..tensors.len()).flat_map(|a| (a..tensors.len()).map(move |b| (a, b))).collect();
        let (graph, columns) = recorded(case, |jet| {
            let fields: Vec<TensorJet> =
                tensors.iter().map(|own| TensorJet::of(own, jet)).collect();
            let slopes: Vec<Vec<Expr>> =
                self.factors.iter().map(|factor| jet.logarithmic_gradient(factor)).collect();
            // Of P alone the terms without a factor come last: theirs is the number 1.
            let mut columns = Vec::new();
            for (a, b) in pairs.iter().rev() {
                let (own, other) = (&fields[*a], &fields[*b]);
                let both = |term: &dyn Fn(&TensorJet, &TensorJet) -> Vec<Expr>| match a == b {
                    true => term(own, own),
                    false => {
                        let sums = term(own, other).into_iter().zip(term(other, own));
                        sums.map(|(x, y)| x + y).collect()
                    }
                };
                columns.extend(slopes.iter().map(|slope| both(&|p, q| p.turned(slope, q))));
                columns.push(both(&TensorJet::moved));
            }
            columns
        })?;
        let mut functions = SampledFunctions::new(case, &graph, &columns, effort)?;
        let relations = match functions.relations() {
            Err(SearchError::NoPoints) => return Ok(None),
            other => other?,
        };
        let (vectors, _) = relations.rational()?;
        let is_solution = |own: &&Vec<Rational>| own.last().is_some_and(Rational::is_one);
        let Some(vector) = vectors.iter().find(is_solution) else { return Ok(None) };
        // Blocks of a pair: the exponents times its numbers, and its numbers.
        let blocks: Vec<&[Rational]> = vector.chunks(self.factors.len() + 1).rev().collect();
        let numbers = blocks.iter().take(tensors.len()).skip(1);
        let numbers = numbers.filter_map(|block| block.last().cloned()).collect();
        let exponents = blocks.first().map_or(&[][..], |block| &block[..self.factors.len()]);
        Ok(Some((numbers, Scale(exponents.to_vec()))))
    }
}

/// A skew tensor at a state, with its derivatives along the coordinates.
struct TensorJet {
    values: Vec<Vec<Expr>>,
    slopes: Vec<Vec<Vec<Expr>>>,
}

impl TensorJet {
    fn of(entries: &[Vec<Formula>], jet: &DualPoint<'_, Expr>) -> Self {
        let table = |of: &dyn Fn(&Formula) -> Expr| -> Vec<Vec<Expr>> {
            entries.iter().map(|row| row.iter().map(of).collect()).collect()
        };
        let axes = jet.along_axes().iter();
        let slopes = axes.map(|at| table(&|own| at.scalar(own).eps)).collect();
        Self { values: table(&|own| jet.phase.scalar(own)), slopes }
    }

    /// Σ_l P_il ∂_lQ_jk + cyclic, for i < j < k.
    fn moved(&self, other: &Self) -> Vec<Expr> {
        let all = 0..self.values.len();
        self.cyclic(&|i, j, k| all.clone().map(|l| self.values[i][l] * other.slopes[l][j][k]).sum())
    }

    /// Σ_l P_il u_l Q_jk + cyclic, for i < j < k.
    fn turned(&self, slope: &[Expr], other: &Self) -> Vec<Expr> {
        let turned = |row: &Vec<Expr>| row.iter().zip(slope).map(|(p, u)| *p * *u).sum();
        let turned: Vec<Expr> = self.values.iter().map(turned).collect();
        self.cyclic(&|i, j, k| turned[i] * other.values[j][k])
    }

    fn cyclic(&self, term: &dyn Fn(usize, usize, usize) -> Expr) -> Vec<Expr> {
        let n = self.values.len();
        let pairs = (0..n).flat_map(|i| (i + 1..n).map(move |j| (i, j)));
        let triples = pairs.flat_map(|(i, j)| (j + 1..n).map(move |k| (i, j, k)));
        triples.map(|(i, j, k)| term(i, j, k) + term(j, k, i) + term(k, i, j)).collect()
    }
}

/// Whether a value is a rational function of the inputs as it is recorded.
fn is_rational(graph: &Graph, value: Expr) -> bool {
    let reached = graph.reached([value]);
    let steps = graph.steps_at(&reached);
    steps.map(|(_, step)| step).all(|step| match step {
        Step::Unary(function, _) => matches!(function, UnaryFunction::Neg | UnaryFunction::Recip),
        Step::Binary(operation, ..) => operation != BinaryOperation::Pow,
        Step::Power(_, exponent) => exponent.parts().1 == 1.into(),
        _ => true,
    })
}
