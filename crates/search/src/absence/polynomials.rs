//! Absence of polynomials in all variables of a field, with constant coefficients.
//!
//! A row is a random state modulo a prime, with the same parameters in all rows. A column is a monomial, or its
//! derivative along the field. Its rank is at most that for generic parameters: the null space contains all integrals.

use super::super::SearchError;
use super::super::ansatz::coefficients::{PrimitiveVector, Ratio};
use super::super::ansatz::monomials::AnsatzVariables;
use super::super::ansatz::recording::Recording;
use super::super::ansatz::subspace::complement;
use super::super::ansatz::system::{Column, LinearSystem, PrimePoint};
use super::super::ask::judged_alone;
use super::super::lists::HAS_LISTS;
use super::super::multipliers::WEIGHTS;
use super::super::orbit::monomials::count;
use super::super::products::{DEGREE_PRIMES, Generators};
use super::known::{contains_integrals, has_lists, rank};
use super::leading;
use super::{AbsenceCase, AbsenceOutcome, Counted, found, generated};
use crate::echelon::nonzero;
use liouville::claim::Claim;
use liouville::formula::{Formula, FormulaError};
use liouville::graph::Expr;
use liouville::mechanics::calculus::DualPoint;
use liouville::number::rational::Rational;
use liouville::order::StableOrder;
use liouville::scalar::Scalar;
use liouville::verdict::Verdict;

/// Lower bound on the elementary steps of an elimination per second.
const STEPS: f64 = 5e8;

/// Judges a claim by polynomials in all variables; `None` if the field has no value modulo a prime.
pub fn judge(
    asked: &AbsenceCase<'_>,
    variables: &AnsatzVariables,
    counted: Counted,
    degree: u32,
) -> Result<Option<AbsenceOutcome>, SearchError> {
    let open = |reason: String| Ok(Some(AbsenceOutcome::Open(reason)));
    if has_lists(asked.case) {
        return open(HAS_LISTS.to_string());
    }
    if contains_integrals(asked.case)? {
        return open("the field contains ∫".to_string());
    }
    let unknowns = count(variables.count(), degree);
    let systems = match counted {
        Counted::Integrals => 2.0,
        Counted::Densities => WEIGHTS.len() as f64 + 2.0,
    };
    let seconds = systems * (unknowns as f64).powi(3) / STEPS;
    if seconds > asked.effort.seconds {
        return open(format!(
            "degree {degree} has {unknowns} unknowns, and may take {seconds:.0} s: ask for a lower one"
        ));
    }
    let mut monomials = variables.monomials(0, 0..=degree);
    monomials.order_by_key(|own| own.iter().sum::<u32>());
    let counting = Counting::new(asked, variables, degree, monomials)?;
    let Some(counting) = counting else { return Ok(None) };
    match counted {
        Counted::Integrals => counting.no_integral().map(Some),
        Counted::Densities => counting.no_density().map(Some),
    }
}

/// Returns the outcome if the field has no value at any state modulo a prime.
pub fn nothing() -> AbsenceOutcome {
    AbsenceOutcome::Open(SearchError::NoPoints.to_string())
}

/// Count of the polynomials of a field.
pub struct Counting<'a> {
    pub(super) asked: &'a AbsenceCase<'a>,
    variables: &'a AnsatzVariables,
    degree: u32,
    monomials: Vec<Vec<u32>>,
    pub(super) system: LinearSystem,
    pub(super) at: PrimePoint,
    /// Known integrals, with their outputs.
    known: Vec<(Formula, usize)>,
    /// Direction for each choice of α; that of integrals is 0.
    pub(super) weighted: Vec<(i64, usize)>,
    /// Column of div v.
    pub(super) divergence: usize,
}

/// Space of the polynomials in known integrals.
pub struct Space {
    terms: Vec<Formula>,
    exponents: Vec<Vec<u32>>,
    /// Outputs that each product multiplies.
    products: Vec<Vec<usize>>,
    pub(super) dimension: usize,
}

impl<'a> Counting<'a> {
    /// Records the field; `None` if it has no value modulo a prime.
    fn new(
        asked: &'a AbsenceCase<'a>,
        variables: &'a AnsatzVariables,
        degree: u32,
        monomials: Vec<Vec<u32>>,
    ) -> Result<Option<Self>, SearchError> {
        let case = asked.case;
        let terms = asked.known.terms(case, &asked.effort)?;
        let (mut outputs, mut weighted, mut output) = (Vec::new(), Vec::new(), 0);
        let mut record = |jet: &DualPoint<'_, Expr>, own: &mut Recording| {
            let zero = Expr::rational(&Rational::from(0));
            own.derive_growing(jet.along_field(), &variables.terms, zero);
            outputs = terms.iter().map(|term| own.give(jet.phase.scalar(term))).collect();
            let divergence = jet.divergence();
            output = own.give(divergence);
            for alpha in WEIGHTS {
                let growth = Expr::rational(&Rational::from(alpha)) * divergence;
                let direction = own.derive_growing(jet.along_field(), &variables.terms, growth);
                weighted.push((alpha, direction));
            }
        };
        let mut system = LinearSystem::record(case, &asked.effort, &mut record)?;
        let product = |direction: usize| {
            monomials.iter().map(move |exponents| Column::Product {
                derivation: direction,
                factor: 0,
                exponents: exponents.clone(),
            })
        };
        let mut columns: Vec<Column> = product(0).collect();
        columns.push(Column::Given(output));
        columns.extend(weighted.iter().flat_map(|(_, direction)| product(*direction)));
        columns.extend(outputs.iter().map(|output| Column::Given(*output)));
        system.columns = columns;
        let divergence = monomials.len();
        let known = terms.into_iter().zip(outputs).collect();
        Ok(system.at(0, 0).map(|at| Self {
            asked,
            variables,
            degree,
            monomials,
            system,
            at,
            known,
            weighted,
            divergence,
        }))
    }

    /// Returns the columns of the monomials along the direction of this number.
    pub(super) fn columns(&self, direction: usize) -> Vec<usize> {
        let count = self.monomials.len();
        let start = if direction == 0 { 0 } else { 1 + direction * count };
        (start..start + count).collect()
    }

    /// Returns the degrees of the known integrals, on which all primes agree; `None` for one that is
    /// not a polynomial of the class.
    fn degrees(&self) -> Result<Option<Vec<Option<u32>>>, SearchError> {
        let Some(mut degrees) = self.degrees_at(&self.at)? else { return Ok(None) };
        for number in 1..DEGREE_PRIMES {
            let Some(at) = self.system.at(number, 0) else { return Ok(None) };
            let Some(others) = self.degrees_at(&at)? else { return Ok(None) };
            for (degree, other) in degrees.iter_mut().zip(others) {
                *degree = degree.filter(|degree| other == Some(*degree));
            }
        }
        Ok(Some(degrees))
    }

    /// Returns the degrees of the known integrals modulo a prime.
    fn degrees_at(&self, at: &PrimePoint) -> Result<Option<Vec<Option<u32>>>, SearchError> {
        let count = self.monomials.len();
        let first = 1 + (1 + self.weighted.len()) * count;
        let given: Vec<usize> = (first..first + self.known.len()).collect();
        let columns = [self.columns(0), given].concat();
        let Some(relations) = self.system.dependences(at, &columns)? else {
            return Ok(None);
        };
        Ok(Some(
            (0..self.known.len())
                .map(|k| {
                    let alone = |own: &&Vec<u64>| {
                        let others = own.iter().enumerate().skip(count);
                        own[count + k] != 0
                            && others.filter(|(at, _)| *at != count + k).all(|(_, x)| *x == 0)
                    };
                    let relation = relations.iter().find(alone)?;
                    let used = (0..count).filter(|column| relation[*column] != 0);
                    used.map(|column| self.monomials[column].iter().sum()).max()
                })
                .collect(),
        ))
    }

    /// Returns the polynomials in the known integrals up to the degree.
    pub(super) fn space(&self) -> Result<Option<Space>, SearchError> {
        let Some(degrees) = self.degrees()? else { return Ok(None) };
        let own: Vec<(&(Formula, usize), u32)> = self
            .known
            .iter()
            .zip(degrees)
            .filter_map(|(known, degree)| Some((known, degree.filter(|degree| *degree > 0)?)))
            .collect();
        let named = own.iter().map(|((term, _), degree)| (term.clone(), *degree)).collect();
        let exponents = Generators::of(named).exponents(self.degree, true);
        let terms: Vec<Formula> = own.iter().map(|((term, _), _)| term.clone()).collect();
        let product = |powers: &Vec<u32>| {
            let each = powers.iter().zip(&own);
            each.flat_map(|(power, ((_, output), _))| vec![*output; *power as usize]).collect()
        };
        let products = exponents.iter().map(product).collect();
        let effort = &self.asked.effort;
        let dimension = rank(self.asked.case, &terms, &exponents, &[], effort)?;
        Ok(dimension.map(|dimension| Space { terms, exponents, products, dimension }))
    }

    pub(super) fn class(&self) -> String {
        format!("a polynomial of degree at most {} in the variables of the state", self.degree)
    }

    fn no_integral(&self) -> Result<AbsenceOutcome, SearchError> {
        let columns = self.columns(0);
        let found = self.system.null_space(&self.at, &columns)?;
        let (Some(found), Some(space)) = (found, self.space()?) else {
            return Ok(nothing());
        };
        let dimension = found.len();
        if dimension < space.dimension {
            return Ok(AbsenceOutcome::Open(format!(
                "the count is {dimension}, fewer than the {} known integrals",
                space.dimension
            )));
        }
        if dimension == space.dimension {
            return Ok(AbsenceOutcome::Excluded {
                theorem: self.asked.theorem(&generated(self.asked, &self.class(), &space.terms)?),
                counted: super::reports::all_known(dimension),
            });
        }
        let padded: Vec<Vec<u64>> = found
            .into_iter()
            .map(|mut own| {
                own.resize(self.system.columns.len(), 0);
                own
            })
            .collect();
        let new = complement(&self.system, &self.at, &padded, &space.products)?.unwrap_or_default();
        let mut doubtful = None;
        for vector in &new {
            self.asked.effort.halt.check()?;
            match self.integral(vector, &space)? {
                Some((formula, true)) => {
                    return Ok(AbsenceOutcome::Exhibited(format!("integral, proved: {formula}")));
                }
                Some((formula, false)) => doubtful = doubtful.or(Some(formula)),
                None => {}
            }
        }
        // Coefficients may be no fractions of the parameters, as with rotations.
        if let Some(exhibit) = found::integral(self.asked, self.degree)? {
            return Ok(AbsenceOutcome::Exhibited(exhibit));
        }
        if let Some(formula) = doubtful {
            return Ok(AbsenceOutcome::Open(format!(
                "{formula} is an integral, and is no sum of products of the known ones up to this degree; \
                 products of a higher degree may cancel to it"
            )));
        }
        Ok(AbsenceOutcome::Bounded(format!(
            "at most {dimension} linearly independent integrals exist, constants included; {} are known, and no \
             other was found in closed form",
            space.dimension
        )))
    }

    /// Returns the integral of a null vector if it is proved and no combination of the products; and whether
    /// it is proved that it is no polynomial in the known integrals, an ∫ among them.
    fn integral(
        &self,
        vector: &[u64],
        space: &Space,
    ) -> Result<Option<(Formula, bool)>, SearchError> {
        let Some(formula) = self.written(vector, 0)? else { return Ok(None) };
        let case = self.asked.case;
        if !self.holds(Claim::integral(&formula))? {
            return Ok(None);
        }
        let own = [formula];
        let effort = &self.asked.effort;
        let with = rank(case, &space.terms, &space.exponents, &own, effort)?;
        if with != Some(space.dimension + 1) {
            return Ok(None);
        }
        let ([formula], known) = (own, self.asked.known.formulas());
        let is_new = self.asked.is_new(&formula)?
            || self.known.len() == known.len()
                && leading::are_independent(case, known, effort.options.seed)?;
        Ok(Some((formula, is_new)))
    }

    /// Writes Σ c_a x^a for all values of the parameters, if its coefficients are fractions in
    /// them.
    pub(super) fn written(
        &self,
        vector: &[u64],
        direction: usize,
    ) -> Result<Option<Formula>, SearchError> {
        let support = nonzero(vector);
        let start = self.columns(direction).first().copied();
        let columns = |start: usize| support.iter().map(|k| start + k).collect::<Vec<_>>();
        let Some(start) = start else { return Ok(None) };
        let Some(coefficients) = PrimitiveVector::of(&self.system, &columns(start))? else {
            return Ok(None);
        };
        let functions = self.functions(support.iter().copied())?;
        let sum = coefficients.sum(&(0..support.len()).collect::<Vec<_>>(), &functions)?;
        Ok(Some(sum.unwrap_or_else(|| Formula::number(0))))
    }

    /// Returns the monomials of some columns.
    pub(super) fn functions(
        &self,
        columns: impl Iterator<Item = usize>,
    ) -> Result<Vec<Ratio>, FormulaError> {
        columns.map(|k| self.variables.monomial(&self.monomials[k]).map(Ratio::of)).collect()
    }

    fn holds(&self, claim: Claim) -> Result<bool, SearchError> {
        let report = judged_alone(self.asked.case, claim, &self.asked.effort)?;
        Ok(report.is_some_and(|report| report.verdict == Verdict::Proved))
    }
}
