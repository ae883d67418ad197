//! Families of brackets: skew P whose entries are sums of unknown numbers times w xᵃ.
//!
//! w is 1, a component of a parameter, or the inverse of one. On a level set, functions w xᵃ that
//! depend there on earlier ones are left out, so that no bracket of the family vanishes on the level.

use super::super::linear::SampledFunctions;
use super::super::series::exponents;
use super::super::terms::{combined, integers, one, recorded};
use super::super::{Effort, SearchError};
use super::brackets::Weight;
use super::components;
use super::monomials::power_product;
use liouville::case::Case;
use liouville::formula::{Formula, FormulaError};

/// Highest degree of entries with numbers as coefficients.
const DEGREE: u32 = 3;
/// Highest degree of entries with parameters in their coefficients.
const WEIGHTED: u32 = 2;
/// Number of unknowns above which the degree is lowered.
const UNKNOWNS: usize = 1500;

/// Lower bound on the elementary steps of an elimination per second.
const STEPS: f64 = 5e8;

/// The unknown coefficient of w xᵃ in P_ij, i < j.
pub(super) struct BracketUnknown {
    pub(super) pair: (usize, usize),
    pub(super) weight: usize,
    pub(super) exponents: Vec<u32>,
}

/// A family of brackets.
pub(super) struct BracketFamily {
    pub(super) weights: Vec<Weight>,
    /// Components of the state.
    pub(super) names: Vec<Formula>,
    pub(super) degree: u32,
    pub(super) unknowns: Vec<BracketUnknown>,
    /// Sums of functions w xᵃ, zero on the level, by which the functions left out depend on others;
    /// `None` if these sums are not known.
    pub(super) vanishing: Option<Vec<Formula>>,
}

impl BracketFamily {
    /// Makes the families of a case: numbers as coefficients first, then parameters.
    pub(super) fn all(case: &Case, effort: &Effort) -> Result<Vec<Self>, SearchError> {
        let plain = Self::new(case, effort, vec![Weight::Above(one())], DEGREE)?;
        let weights = weights(case, effort)?;
        if weights.len() < 2 {
            return Ok(vec![plain]);
        }
        Ok(vec![plain, Self::new(case, effort, weights, WEIGHTED)?])
    }

    /// The family of {x_i,x_j} = c_ij x_i x_j, which all satisfy Jacobi's identity; `None` on a level.
    pub(super) fn log_canonical(case: &Case, effort: &Effort) -> Result<Option<Self>, SearchError> {
        if !case.model.level.is_empty() {
            return Ok(None);
        }
        let weights = weights(case, effort)?;
        let names = names(case)?;
        let pairs = pairs(names.len());
        let unknown = |weight: usize, pair: &(usize, usize)| {
            let exponents =
                (0..names.len()).map(|k| u32::from(k == pair.0 || k == pair.1)).collect();
            BracketUnknown { pair: *pair, weight, exponents }
        };
        let unknowns = (0..weights.len())
            .flat_map(|weight| pairs.iter().map(move |pair| unknown(weight, pair)))
            .collect();
        Ok(Some(Self { weights, names, degree: 2, unknowns, vanishing: None }))
    }

    fn new(
        case: &Case,
        effort: &Effort,
        weights: Vec<Weight>,
        highest: u32,
    ) -> Result<Self, SearchError> {
        let names = names(case)?;
        let dimension = names.len();
        let pairs = pairs(dimension);
        let mut degree = highest;
        let (functions, vanishing) = loop {
            let own = Functions::up_to(degree, weights.len(), dimension);
            let (kept, vanishing) = own.on_level(case, effort, &weights, &names)?;
            if kept.len() * pairs.len() <= UNKNOWNS || degree == 0 {
                break (kept, vanishing);
            }
            degree -= 1;
        };
        let mut unknowns = Vec::new();
        for (weight, exponents) in functions {
            let one = |pair: &(usize, usize)| BracketUnknown {
                pair: *pair,
                weight,
                exponents: exponents.clone(),
            };
            unknowns.extend(pairs.iter().map(one));
        }
        Ok(Self { weights, names, degree, unknowns, vanishing })
    }

    /// Upper bound on the seconds that a solution takes.
    pub(super) fn seconds(&self) -> f64 {
        (self.unknowns.len() as f64).powi(3) / STEPS
    }

    /// Whether another family contains this one.
    pub(super) fn is_within(&self, other: &Self) -> bool {
        self.weights.len() <= other.weights.len() && self.degree <= other.degree
    }
}

/// Components of the state.
fn names(case: &Case) -> Result<Vec<Formula>, FormulaError> {
    case.model.state_formulas()
}

/// Pairs i < j of components.
fn pairs(dimension: usize) -> Vec<(usize, usize)> {
    (0..dimension).flat_map(|i| (i + 1..dimension).map(move |j| (i, j))).collect()
}

/// The index of w, and the exponents, of some functions w xᵃ.
type Places = Vec<(usize, Vec<u32>)>;

/// Functions w xᵃ.
struct Functions(Places);

impl Functions {
    fn up_to(degree: u32, weights: usize, dimension: usize) -> Self {
        let monomials: Vec<Vec<u32>> =
            (0..=degree).flat_map(|total| exponents(dimension, total)).collect();
        let of_weight = |weight| monomials.iter().map(move |own| (weight, own.clone()));
        Self((0..weights).flat_map(of_weight).collect())
    }

    /// Keeps the functions that do not depend on earlier ones on the level; also returns the sums by
    /// which the others do.
    fn on_level(
        self,
        case: &Case,
        effort: &Effort,
        weights: &[Weight],
        names: &[Formula],
    ) -> Result<(Places, Option<Vec<Formula>>), SearchError> {
        if case.model.level.is_empty() {
            return Ok((self.0, Some(Vec::new())));
        }
        let terms: Result<Vec<Formula>, FormulaError> = self
            .0
            .iter()
            .map(|(weight, own)| weights[*weight].on(&power_product(names, own)?))
            .collect();
        let terms = terms?;
        let (graph, values) = recorded(case, |jet| {
            terms.iter().map(|term| vec![jet.phase.scalar(term)]).collect::<Vec<_>>()
        })?;
        let relations = SampledFunctions::new(case, &graph, &values, effort)?.relations()?;
        let (vectors, irrational) = relations.rational()?;
        let mut vanishing = Vec::new();
        for vector in &vectors {
            vanishing.extend(combined(&integers(vector), &terms)?);
        }
        let kept = relations.independent().into_iter().map(|k| self.0[k].clone()).collect();
        Ok((kept, (irrational == 0).then_some(vanishing)))
    }
}

/// Lists 1, the components of the parameters, and their inverses, without those that depend on
/// others.
fn weights(case: &Case, effort: &Effort) -> Result<Vec<Weight>, SearchError> {
    let own = components(case);
    let above = [one()].into_iter().chain(own.iter().cloned()).map(Weight::Above);
    let all: Vec<Weight> = above.chain(own.iter().cloned().map(Weight::Below)).collect();
    let mut formulas = Vec::new();
    for weight in &all {
        formulas.push(weight.formula()?);
    }
    let (graph, values) = recorded(case, |jet| {
        formulas.iter().map(|weight| vec![jet.phase.scalar(weight)]).collect::<Vec<_>>()
    })?;
    let mut functions = SampledFunctions::new(case, &graph, &values, effort)?;
    let defined = functions.defined();
    functions.restrict(&defined);
    let independent = functions.relations()?.independent();
    Ok(independent.into_iter().map(|k| all[defined[k]].clone()).collect())
}
