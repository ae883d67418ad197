//! Densities and integrals Π f^α e^g from factors with known cofactors.
//!
//! v(ln Π f^α e^g) = Σ α K + v(g) is linear in the exponents α and the coefficients of g, which may
//! contain angles of conjugate factors, and fractions h/f^m where nothing is found without them.
//! With β div v and a constant λ added, one linear system has densities (β = 1), integrals with
//! powers, logarithms and exponentials, and functions of constant rate λ as its null vectors.

use liouville::graph::Tape;

use super::super::ansatz::system::PrimePoint;
use super::super::budget::Budget;
use super::super::echelon::{Echelon, nonzero};
use super::super::terms::recorded;
use super::super::{FoundKind, SearchError, SearchReport};
use super::angle::{AngleForm, ConjugatePair};
use super::claims;
use super::factor::RatedPolynomial;
use super::images::{self, Images};
use super::known::IndependentIntegrals;
use super::monomials;
use super::quotients::{self, Quotient, rate_of_monomial};
use super::setting::{OrbitSetting, SPARE_ORDERS, run};
use liouville::claim::LevelSubset;

/// Largest number of monomials of g.
const MONOMIALS: usize = 60;
/// Largest degree of g.
const DEGREE: u32 = 4;

/// A term of the logarithmic rate.
#[derive(Clone, Debug)]
pub enum RateTerm {
    /// Rate of a monomial.
    Monomial(Vec<u32>),
    /// Rate of a monomial over a power of a factor.
    Quotient(Quotient),
    /// Cofactor of a factor.
    Factor(usize),
    /// Rate of the angle of conjugate factors.
    Angle(usize),
    /// Constant rate.
    Constant,
    /// Divergence of the field.
    Divergence,
    /// Minus the value of a known integral.
    Known(usize),
}

/// A way to write a function.
#[derive(Clone, Copy, Debug)]
pub struct Style {
    /// Whether logarithms and roots are those of moduli, where the sign is not known.
    pub has_moduli: bool,
    /// Form of the angles.
    pub angle: AngleForm,
}

/// Records the divergence of a field; of an extended one that of the field itself.
pub fn divergence(setting: &OrbitSetting<'_>) -> Result<Tape, SearchError> {
    let own = setting.origin.map(|origin| &origin.extension.divergence);
    let kept = LevelSubset::level(&setting.case.model).kept;
    let (graph, divergence) = recorded(setting.case, |jet| match own {
        Some(formula) => jet.phase.scalar(formula),
        None => jet.divergence() - jet.level_cofactor(&kept),
    })?;
    Ok(Tape::new(&graph, &[divergence]))
}

/// The linear system for some factors.
pub struct ExponentSystem<'s, 'c> {
    /// Case with its points.
    pub setting: &'s OrbitSetting<'c>,
    variables: &'s [usize],
    /// Factors with known cofactors.
    pub factors: &'s [RatedPolynomial],
    /// Conjugate factors.
    pub pairs: &'s [ConjugatePair],
    /// Terms of the logarithmic rate.
    pub columns: Vec<RateTerm>,
    divergence: Tape,
    /// Known integrals that are rates.
    pub known: Vec<RatedPolynomial>,
}

impl<'s, 'c> ExponentSystem<'s, 'c> {
    /// Sets up the system.
    pub fn of(
        setting: &'s OrbitSetting<'c>,
        variables: &'s [usize],
        factors: &'s [RatedPolynomial],
        pairs: &'s [ConjugatePair],
    ) -> Result<Self, SearchError> {
        let fits = |degree: &u32| monomials::count(variables.len(), *degree) <= MONOMIALS;
        let degree = (1..=DEGREE).rev().find(fits).unwrap_or(1);
        let all = monomials::up_to(variables, setting.dimension(), degree);
        let monomials = all.into_iter().skip(1).map(RateTerm::Monomial);
        let own = (0..factors.len()).map(RateTerm::Factor);
        let angles = (0..pairs.len()).map(RateTerm::Angle);
        let last = [RateTerm::Constant, RateTerm::Divergence];
        let columns = monomials.chain(own).chain(angles).chain(last).collect();
        let divergence = divergence(setting)?;
        Ok(Self { setting, variables, factors, pairs, columns, divergence, known: Vec::new() })
    }

    /// Null vectors on some columns, each with its last nonzero entry, 1, in a different column.
    pub fn relations(
        &self,
        at: &PrimePoint,
        columns: &[usize],
    ) -> Result<Vec<Vec<u64>>, SearchError> {
        self.common(std::slice::from_ref(at), columns)
    }

    /// Null vectors for several choices of the parameters in one field.
    pub fn common(
        &self,
        all: &[PrimePoint],
        columns: &[usize],
    ) -> Result<Vec<Vec<u64>>, SearchError> {
        let Some(first) = all.first() else { return Ok(Vec::new()) };
        let mut echelon = Echelon::new(columns.len(), first.modulus);
        let (mut dependent, budget) = (0, Budget::of(self.setting.effort));
        for number in 0..4 * (columns.len() + SPARE_ORDERS) as u64 {
            budget.check(&echelon)?;
            let at = &all[number as usize % all.len()];
            let Some(row) = self.row(at, number, columns)? else { continue };
            dependent = if echelon.push(row) { 0 } else { dependent + 1 };
            if dependent == SPARE_ORDERS {
                return Ok(echelon.null_space());
            }
        }
        Ok(Vec::new())
    }

    fn row(
        &self,
        at: &PrimePoint,
        number: u64,
        columns: &[usize],
    ) -> Result<Option<Vec<u64>>, SearchError> {
        let m = at.modulus;
        let Some((point, orbit)) = self.setting.orbit(at, number, 2)? else { return Ok(None) };
        let inputs = [point.parameters.as_slice(), &point.state].concat();
        let rates = |k: usize| orbit[k][1];
        let mut values: Vec<Option<(u64, u64)>> = vec![None; self.factors.len()];
        for column in columns {
            let place = match &self.columns[*column] {
                RateTerm::Factor(place) => *place,
                RateTerm::Quotient(own) => own.factor,
                _ => continue,
            };
            if values[place].is_none() {
                values[place] = self.factors[place].at(at, &point);
            }
        }
        let entry = |column: &usize| match &self.columns[*column] {
            RateTerm::Monomial(own) => Some(rate_of_monomial(at, &point, &rates, own)),
            RateTerm::Quotient(own) => own.rate(at, &point, &rates, values[own.factor]?),
            RateTerm::Factor(place) => {
                let (own, rate) = values[*place]?;
                (own != 0).then(|| m.mul(rate, m.inverse(own)))
            }
            RateTerm::Angle(place) => self.pairs[*place].rate(at, &point),
            RateTerm::Constant => Some(m.one()),
            RateTerm::Divergence => run(&self.divergence, m, &inputs).map(|values| values[0]),
            RateTerm::Known(place) => {
                self.known[*place].at(at, &point).map(|(own, _)| m.sub(0, own))
            }
        };
        Ok(columns.iter().map(entry).collect())
    }

    /// Searches with fractions as well if there may be more.
    pub fn search_with_fractions(
        mut self,
        known: &mut IndependentIntegrals,
        report: &mut SearchReport,
    ) -> Result<(), SearchError> {
        let variables = self.variables.len();
        let most = self.setting.origin.map_or(variables, |own| own.case.model.dimension());
        let has_density = report.formulas(FoundKind::Density).next().is_some();
        let has_rate = report.found.iter().any(|own| own.kind == FoundKind::ConstantRate);
        if has_density && has_rate && known.within(self.variables) + 1 >= most {
            return Ok(());
        }
        let own = quotients::terms(self.setting, self.variables, self.factors);
        if own.is_empty() {
            return Ok(());
        }
        let is_monomial = |column: &RateTerm| matches!(column, RateTerm::Monomial(_));
        let place = self.columns.iter().take_while(|column| is_monomial(column)).count();
        self.columns.splice(place..place, own);
        self.search(known, report)
    }

    /// Solves the system, and adds proved finds to the report.
    pub fn search(
        &self,
        known: &mut IndependentIntegrals,
        report: &mut SearchReport,
    ) -> Result<(), SearchError> {
        let Some(at) = self.setting.at(0, 0) else { return Ok(()) };
        let all: Vec<usize> = (0..self.columns.len()).collect();
        let is_quotient = |column: &usize| matches!(self.columns[*column], RateTerm::Quotient(_));
        let has_quotients = all.iter().any(is_quotient);
        // In some of the variables there may be a simpler one with the others.
        let is_whole = self.variables.len() == self.setting.dimension();
        for vector in self.relations(&at, &all)? {
            self.setting.effort.halt.check()?;
            let support = nonzero(&vector);
            let Some(last) = support.last() else { continue };
            // Without fractions it has been found before.
            if has_quotients && !support.iter().any(is_quotient) {
                continue;
            }
            match self.columns[*last] {
                // A polynomial or rational integral, for which there is a search of its own; or 0.
                RateTerm::Monomial(_) | RateTerm::Quotient(_) => {}
                RateTerm::Factor(_) | RateTerm::Angle(_) => {
                    self.integral(&support, known, report)?;
                }
                // The field itself says that t' = 1.
                RateTerm::Constant if self.is_variable(&support) => {}
                // One that is longer differs from a known one by an integral.
                RateTerm::Constant if has_quotients => {
                    let is_told =
                        report.found.iter().any(|own| own.kind == FoundKind::ConstantRate);
                    if is_whole && !is_told {
                        self.rate(&support, report)?;
                    }
                }
                RateTerm::Constant => self.rate(&support, report)?,
                RateTerm::Divergence if has_quotients && !is_whole => {}
                RateTerm::Divergence if support.len() > 1 => self.density(&support, report)?,
                RateTerm::Divergence | RateTerm::Known(_) => {}
            }
        }
        Ok(())
    }

    /// Whether a null vector says that a variable of the case has a constant rate.
    fn is_variable(&self, support: &[usize]) -> bool {
        let origin = self.setting.origin;
        let state = origin.map_or(self.setting.dimension(), |own| own.case.model.dimension());
        match support {
            [first, _] => match &self.columns[*first] {
                RateTerm::Monomial(own) => {
                    own.iter().sum::<u32>() == 1 && own[..state].contains(&1)
                }
                _ => false,
            },
            _ => false,
        }
    }

    /// Coefficients of the null vector on a support, for all values of the parameters.
    pub fn vector(
        &self,
        support: &[usize],
    ) -> Result<Option<images::ParametricVector>, SearchError> {
        let make = |at: &PrimePoint| self.relations(at, support).ok()?.pop();
        let images = Images { setting: self.setting, width: support.len(), is_split: false, make };
        images::vector(&images)
    }

    /// Ways to write a function, which differ in their domains.
    pub fn styles(&self, support: &[usize]) -> Vec<Style> {
        let has_angle =
            support.iter().any(|column| matches!(self.columns[*column], RateTerm::Angle(_)));
        let forms: &[AngleForm] = match has_angle {
            true => &[AngleForm::Circular, AngleForm::Hyperbolic],
            false => &[AngleForm::Circular],
        };
        let with =
            |angle: &AngleForm| [true, false].map(|has_moduli| Style { has_moduli, angle: *angle });
        forms.iter().flat_map(with).collect()
    }

    fn integral(
        &self,
        support: &[usize],
        known: &mut IndependentIntegrals,
        report: &mut SearchReport,
    ) -> Result<(), SearchError> {
        let Some(vector) = self.vector(support)? else { return Ok(()) };
        let is_power = |column: &usize| matches!(self.columns[*column], RateTerm::Factor(_));
        let is_product =
            support.iter().all(is_power) && (0..support.len()).all(|k| vector.is_number(k));
        for style in self.styles(support) {
            let formula = match is_product {
                true => self.product(support, &vector, style)?,
                false => self.logarithm(support, &vector, style)?,
            };
            let Some(formula) = formula else { continue };
            if claims::integral(self.setting, &formula, report)? {
                known.add(formula, None, self.variables);
                break;
            }
        }
        Ok(())
    }

    fn rate(&self, support: &[usize], report: &mut SearchReport) -> Result<(), SearchError> {
        let Some(vector) = self.vector(support)? else { return Ok(()) };
        let rate = vector.minus(support.len() - 1)?;
        for style in self.styles(support) {
            let Some(function) = self.logarithm(support, &vector, style)? else { continue };
            if claims::rate(self.setting, &function, &rate, report)? {
                break;
            }
        }
        Ok(())
    }
}

/// Searches for densities and integrals from cofactors, if there are more of them than at the last
/// time; returns how many there are.
pub fn combine(
    setting: &OrbitSetting<'_>,
    variables: &[usize],
    factors: &[RatedPolynomial],
    last: Option<usize>,
    known: &mut IndependentIntegrals,
    report: &mut SearchReport,
) -> Result<Option<usize>, SearchError> {
    if last != Some(factors.len()) {
        ExponentSystem::of(setting, variables, factors, &[])?.search(known, report)?;
    }
    Ok(Some(factors.len()))
}
