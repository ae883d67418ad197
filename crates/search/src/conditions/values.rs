//! Values of one parameter for which a field has more polynomial integrals than in general.
//!
//! The rates of the monomials at random states are a matrix whose null vectors are integrals. A value
//! with more of them lowers its rank, so it is a root of every maximal minor; minors of other states
//! and of other columns have no further root in common. What is left of the common divisor without
//! these values is reported.

use liouville::case::Case;
use liouville::formula::{Formula, Type};
use liouville::mechanics::{Draw, ParameterOrigin, SamplerSpec, System};
use liouville::number::rational::Rational;
use liouville::proof::ProofRng;

use super::ParameterCondition;
use super::minors::{determinant, equation, scalars};
use super::polynomial::{Polynomial, PrimePolynomials};
use super::relation::{Relation, Round, ScalarParameter, explained, unexplained};
use crate::ansatz::system::{Column, LinearSystem, PrimePoint};
use crate::echelon::Echelon;
use crate::orbit::{self, monomials};
use crate::streams::SearchStream;
use crate::terms::{one, read};
use crate::{Effort, SearchError, SearchReport};

/// Largest number of unknowns.
const UNKNOWNS: usize = 220;
/// Number of minors that are compared, and the largest number if some roots are not explained.
const MINORS: (u64, u64) = (2, 4);
/// Smallest number of values of a minor, followed by the largest.
const VALUES: (usize, usize) = (32, 2048);
/// Number of rows beyond the unknowns.
const SPARE: usize = 8;
/// First stream of states for minors.
const STREAM: u64 = 1000;

/// Finds the values of single parameters of a field for which there are more polynomial integrals of at
/// most the degree of the search, and the integrals there.
pub fn conditions(
    case: &Case,
    effort: &Effort,
    report: &mut SearchReport,
    progress: &mut dyn FnMut(&str),
) -> Result<(), SearchError> {
    if !matches!(case.model.system, System::Field(_) | System::Hamiltonian(_)) {
        return Ok(());
    }
    let all = scalars(case);
    let mut told: Vec<String> = Vec::new();
    for degree in 1..=effort.degree {
        for parameter in &all {
            let name = &parameter.name;
            progress(&format!("values of {name} with more integrals of degree {degree}"));
            let Some(search) = ParametricEquations::new(case, degree, parameter.draw, effort)?
            else {
                return Ok(());
            };
            let rounds = if all.len() > 1 { 2 } else { 1 };
            let Some(found) = search.rounds(rounds)? else { continue };
            let explained = explained(parameter, &all, &found.rounds);
            let mut equations: Vec<String> = Vec::new();
            for relation in &explained.relations {
                let text = relation.to_string();
                if told.contains(&text) {
                    continue;
                }
                if let Relation::Value(_, value) = relation {
                    integrals_at(case, name, value, effort, report)?;
                }
                equations.push(text);
            }
            let first = found.rounds.first().filter(|_| all.len() == 1);
            let others = first.and_then(|own| equation(name, own, &found.rest));
            let open = match others {
                Some(_) => OpenValues::default(),
                None => OpenValues {
                    unexplained: explained.unexplained,
                    roots: found.rest.len().saturating_sub(1),
                },
            };
            equations.extend(others.filter(|own| !told.contains(own)));
            if equations.is_empty() && open.count() == 0 {
                continue;
            }
            told.extend(equations.iter().cloned());
            report.conditions.push(ParameterCondition {
                of: format!("more polynomial integrals of degree at most {degree}, by {name}"),
                equations,
                grounds: format!(
                    "minors of the equations for the coefficients; {}",
                    open.words(parameter)
                ),
            });
        }
    }
    Ok(())
}

/// Numbers of values that are not written as relations.
#[derive(Clone, Copy, Default)]
struct OpenValues {
    /// Values in the prime field with more integrals.
    unexplained: usize,
    /// Common roots of some minors that are not in the field.
    roots: usize,
}

impl OpenValues {
    fn count(self) -> usize {
        self.unexplained + self.roots
    }

    /// Says how many values there may be besides those told.
    fn words(self, parameter: &ScalarParameter) -> String {
        let own = match self.unexplained {
            0 => None,
            n => Some(unexplained(n, parameter)),
        };
        let roots = match self.roots {
            0 => None,
            n => Some(format!("up to {n} further values, none of them rational, may have more")),
        };
        match (own, roots) {
            (None, None) => "modulo a prime of 61 bits no other value has more".to_string(),
            (own, roots) => own.into_iter().chain(roots).collect::<Vec<_>>().join("; "),
        }
    }
}

/// Searches a case with a value of one parameter for integrals besides those in general.
fn integrals_at(
    case: &Case,
    name: &str,
    value: &Rational,
    effort: &Effort,
    report: &mut SearchReport,
) -> Result<(), SearchError> {
    let mut fixed = case.clone();
    for parameter in fixed.model.parameters.iter_mut().filter(|own| own.name == name) {
        let draw = Draw::OneOf(vec![value.clone()]);
        parameter.origin = ParameterOrigin::Free(SamplerSpec::Scalar(draw));
    }
    let known = report.found.iter().filter(|own| own.kind == "integral" && own.with.is_empty());
    let mut own = SearchReport { found: known.cloned().collect(), ..SearchReport::default() };
    let before = own.found.len();
    orbit::search(&fixed, effort, false, &mut own, &mut |_| {})?;
    for mut found in own.found.into_iter().skip(before).filter(|own| own.kind == "integral") {
        found.with.push(("value", format!("{name} = {value}")));
        report.found.push(found);
    }
    Ok(())
}

/// Special values of a parameter.
#[derive(Default)]
struct SpecialValues {
    /// Values in the prime field, for each choice of the other parameters.
    rounds: Vec<Round>,
    /// Polynomial of the last round whose roots are not in the field.
    rest: Polynomial,
}

/// Equations for the coefficients of polynomial integrals, as functions of one parameter.
struct ParametricEquations<'e> {
    system: LinearSystem,
    columns: Vec<usize>,
    draw: usize,
    effort: &'e Effort,
    is_on_level: bool,
}

impl<'e> ParametricEquations<'e> {
    /// Sets up the equations; `None` if there are too many.
    fn new(
        case: &Case,
        degree: u32,
        draw: usize,
        effort: &'e Effort,
    ) -> Result<Option<Self>, SearchError> {
        let model = &case.model;
        let dimension = model.dimension();
        let names: Vec<String> = (0..dimension).map(|k| model.component_name(k)).collect();
        let terms: Vec<Formula> = read(names.iter().map(String::as_str), &model.vocabulary);
        let is_scalar = |own: &Formula| own.value_type() == Type::Scalar;
        let count = monomials::count(dimension, degree);
        if terms.len() < dimension || !terms.iter().all(is_scalar) || count > UNKNOWNS {
            return Ok(None);
        }
        let mut system = LinearSystem::record(case, effort, |jet, recording| {
            recording.derive(jet.along_field(), &terms, &[one()]);
        })?;
        let variables: Vec<usize> = (0..dimension).collect();
        let product = |exponents| Column::Product { derivation: 0, factor: 0, exponents };
        let all = monomials::up_to(&variables, dimension, degree);
        // The constant is the first.
        system.columns = all.into_iter().skip(1).map(product).collect();
        let columns = (0..system.columns.len()).collect();
        let is_on_level = !model.level.is_empty();
        Ok(Some(Self { system, columns, draw, effort, is_on_level }))
    }

    /// Finds the special values for some choices of the other parameters; `None` if there is no choice of
    /// the parameters, or no fraction.
    fn rounds(&self, count: u64) -> Result<Option<SpecialValues>, SearchError> {
        let mut found = SpecialValues::default();
        for round in 0..count {
            let Some(base) = self.system.at(round, round) else { return Ok(None) };
            let Some((values, rest)) = self.special(&base, round)? else { return Ok(None) };
            let (parameters, modulus) = (base.parameters, base.modulus);
            found.rounds.push(Round { values, parameters, modulus });
            found.rest = rest;
        }
        Ok(Some(found))
    }

    fn with(&self, base: &PrimePoint, value: u64) -> PrimePoint {
        let mut at = base.clone();
        at.parameters[self.draw] = value;
        at
    }

    /// Number of independent integrals; `None` if too few states have values.
    fn nullity(&self, at: &PrimePoint) -> Result<Option<usize>, SearchError> {
        let columns = match self.is_on_level {
            true => self.system.distinct(at, &self.columns)?,
            false => Some(self.columns.clone()),
        };
        let Some(columns) = columns else { return Ok(None) };
        Ok(self.system.null_space(at, &columns)?.map(|vectors| vectors.len()))
    }

    /// Finds the values with more integrals than in general, and a polynomial with the other roots that
    /// some minors have in common.
    fn special(
        &self,
        base: &PrimePoint,
        round: u64,
    ) -> Result<Option<(Vec<u64>, Polynomial)>, SearchError> {
        let m = &base.modulus;
        let ring = PrimePolynomials(*m);
        let mut rng = SearchStream::Minors.under(self.effort.options.seed + 100 + round);
        let Some(general) = self.nullity(base)? else { return Ok(None) };
        let columns = match self.is_on_level {
            true => match self.system.distinct(base, &self.columns)? {
                Some(columns) => columns,
                None => return Ok(None),
            },
            false => self.columns.clone(),
        };
        let mut common: Polynomial = Vec::new();
        let (mut found, mut rest) = (Vec::new(), Vec::new());
        for number in 0..MINORS.1 {
            let Some(own) = self.minor(base, number, &columns, &mut rng)? else { return Ok(None) };
            common = ring.square_free(&ring.common(&common, &own));
            if number + 1 < MINORS.0 {
                continue;
            }
            found.clear();
            rest.clone_from(&common);
            for value in ring.roots(&common, &mut rng) {
                self.effort.halt.check()?;
                // Without a state the field has no integrals there either.
                if self.nullity(&self.with(base, value))?.is_some_and(|own| own > general) {
                    found.push(value);
                }
                rest = ring.divided(&rest, &[m.sub(0, value), m.one()]).0;
            }
            if rest.len() < 2 {
                break;
            }
        }
        Ok(Some((found, rest)))
    }

    /// Finds the numerator of a maximal minor at other states and with other columns.
    fn minor(
        &self,
        base: &PrimePoint,
        number: u64,
        columns: &[usize],
        rng: &mut ProofRng,
    ) -> Result<Option<Polynomial>, SearchError> {
        let m = base.modulus;
        let ring = PrimePolynomials(m);
        let stream = STREAM + number;
        let mut order = columns.to_vec();
        for k in (1..order.len()).rev() {
            order.swap(k, (m.to_integer(rng.element(&m)) % (k as u64 + 1)) as usize);
        }
        let count = order.len() + SPARE;
        let at = self.with(base, rng.element(&m));
        let Some(rows) = self.system.rows(&at, stream, &order, count) else { return Ok(None) };
        let mut echelon = Echelon::new(order.len(), m);
        let mut kept = Vec::new();
        for (place, row) in rows.into_iter().enumerate() {
            self.effort.halt.check()?;
            if echelon.push(row) {
                kept.push(place);
            }
        }
        let pivots: Vec<usize> =
            (0..order.len()).filter(|k| echelon.has_pivot(*k)).map(|k| order[k]).collect();
        let mut values = Vec::new();
        let mut wanted = VALUES.0;
        while wanted <= VALUES.1 {
            while values.len() < wanted {
                self.effort.halt.check()?;
                let value = rng.element(&m);
                let at = self.with(base, value);
                let Some(rows) = self.system.rows(&at, stream, &pivots, count) else {
                    return Ok(None);
                };
                let matrix = kept.iter().map(|place| rows[*place].clone()).collect();
                values.push((value, determinant(&m, matrix, &self.effort.halt)?));
            }
            if let Some(found) = ring.polynomial(&values) {
                return Ok(Some(found));
            }
            if let Some((numerator, _)) = ring.fraction(&values) {
                return Ok(Some(numerator));
            }
            wanted += wanted.div_ceil(2);
        }
        Ok(None)
    }
}
