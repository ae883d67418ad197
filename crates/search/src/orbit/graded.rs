//! Polynomial integrals of higher degree, class by class.
//!
//! Beyond the degree to which all monomials are searched together, those of each class of exponents
//! are: the matrix of thousands of monomials has blocks of dozens. Null vectors are kept where their
//! gradients, at a random point modulo a prime, are independent of those of the known integrals and of
//! each other.

use std::collections::BTreeMap;

use super::super::ansatz::coefficients::{NullVector, Ratio};
use super::super::ansatz::monomials::power_product;
use super::super::ansatz::note_unwritten;
use super::super::ansatz::system::{Column, LinearSystem, PrimePoint};
use super::super::terms::one;
use super::super::{SearchError, SearchReport};
use super::adjoin::{self, PolynomialField};
use super::known::IndependentIntegrals;
use super::lattice::ExponentLattice;
use super::leading::LeadingField;
use super::relations::combined_gradient;
use super::setting::OrbitSetting;
use super::sparse::sparse;
use super::{claims, images, monomials};

/// Largest number of monomials of one degree that are listed.
const LISTED: usize = 60_000;
/// Largest number of unknowns of one class.
const WIDEST: usize = 2400;

/// Terms of the rates, and the equations of the level, of the case of a setting.
pub struct GradedSearch<'s, 'c> {
    setting: &'s OrbitSetting<'c>,
    field: PolynomialField,
}

/// Null vectors of one class.
struct ClassVectors {
    columns: Vec<usize>,
    vectors: Vec<Vec<u64>>,
}

impl<'s, 'c> GradedSearch<'s, 'c> {
    /// Reads the field; `None` if it is not a polynomial in the variables of the setting.
    pub fn of(setting: &'s OrbitSetting<'c>) -> Result<Option<Self>, SearchError> {
        if setting.flow.is_map {
            return Ok(None);
        }
        let field = adjoin::polynomial_field(setting.case)?;
        Ok(field.map(|field| Self { setting, field }))
    }

    /// The lattice of the differences that stay within a class.
    fn lattice(&self, variables: &[usize]) -> Option<ExponentLattice> {
        let mut lattice = ExponentLattice::default();
        let mut first: Option<Vec<i64>> = None;
        for variable in variables {
            for term in &self.field.rates[*variable] {
                let mut shift = term.clone();
                shift[*variable] -= 1;
                match &first {
                    None => first = Some(shift),
                    Some(first) => lattice.push(difference(&shift, first))?,
                }
            }
        }
        for terms in &self.field.level {
            for pair in terms.windows(2) {
                lattice.push(difference(&pair[1], &pair[0]))?;
            }
        }
        Some(lattice)
    }

    /// Searches the polynomials of one degree in some variables, within a number of steps; returns the
    /// steps taken, or `None` if there are too many. `counted` is the number of independent integrals of
    /// the degrees before, those that could not be written among them.
    pub fn of_degree(
        &self,
        variables: &[usize],
        degree: u32,
        steps: f64,
        counted: usize,
        known: &mut IndependentIntegrals,
        report: &mut SearchReport,
    ) -> Result<Option<f64>, SearchError> {
        let (setting, dimension) = (self.setting, self.setting.dimension());
        if monomials::count(variables.len(), degree) > LISTED {
            return Ok(None);
        }
        let Some(lattice) = self.lattice(variables) else { return Ok(None) };
        let mut all = monomials::up_to(variables, dimension, degree);
        all.remove(0);
        all = setting.standard(all);
        let mut classes: BTreeMap<Vec<i64>, Vec<usize>> = BTreeMap::new();
        for (place, own) in all.iter().enumerate() {
            if place % 256 == 255 {
                setting.effort.halt.check()?;
            }
            let own = own.iter().map(|power| i64::from(*power)).collect();
            let Some(class) = lattice.class(own) else { return Ok(None) };
            classes.entry(class).or_default().push(place);
        }
        // Classes without a monomial of this degree were searched before.
        let is_new = |places: &Vec<usize>| {
            places.last().is_some_and(|last| all[*last].iter().sum::<u32>() == degree)
        };
        let mut classes: Vec<Vec<usize>> = classes.into_values().filter(is_new).collect();
        classes.sort_by_key(Vec::len);
        let times = if setting.is_on_level() { 2.0 } else { 1.0 };
        let cost: f64 = classes.iter().map(|own| times * (own.len() as f64).powi(3) / 2.0).sum();
        if cost > steps || classes.iter().any(|own| own.len() > WIDEST) {
            return Ok(None);
        }
        let mut system = LinearSystem::record(setting.case, setting.effort, |jet, recording| {
            recording.derive(jet.along_field(), &setting.terms, &[one()]);
        })?;
        let product = |exponents| Column::Product { derivation: 0, factor: 0, exponents };
        system.columns = all.iter().cloned().map(product).collect();
        let Some(at) = system.at(0, 0) else { return Ok(Some(cost)) };
        let mut leading = LeadingField::of(setting, &self.field, variables)?;
        let mut found = Vec::new();
        let work = |own: &Vec<usize>| own.len().pow(2);
        let (mut done, all_work) = (0, classes.iter().map(work).sum());
        for places in classes {
            setting.effort.halt.check()?;
            setting.effort.halt.meter().set(done, all_work);
            done += work(&places);
            if let Some(leading) = &mut leading {
                let forms: Vec<&Vec<u32>> = places.iter().map(|place| &all[*place]).collect();
                let is_highest = |own: &&Vec<u32>| own.iter().sum::<u32>() == degree;
                let forms: Vec<&Vec<u32>> = forms.into_iter().filter(is_highest).collect();
                // An integral of lower degree was found before.
                if 2 * forms.len() <= places.len() && leading.excludes(variables, &forms)? {
                    continue;
                }
            }
            let columns = match setting.is_on_level() {
                false => places,
                true => match system.distinct(&at, &places)? {
                    Some(columns) => columns,
                    None => continue,
                },
            };
            let Some(vectors) = system.null_space(&at, &columns)? else { continue };
            if vectors.is_empty() {
                continue;
            }
            // In another order the reduced vectors may have fewer terms.
            let turned: Vec<usize> = columns.iter().rev().copied().collect();
            let others = system.null_space(&at, &turned)?.unwrap_or_default();
            for (columns, vectors) in [(columns, vectors), (turned, others)] {
                found.push(ClassVectors { columns, vectors: sparse(&at.modulus, vectors) });
            }
        }
        self.tell(&system, &at, &all, (variables, degree, counted), found, (known, report))?;
        Ok(Some(cost))
    }

    /// Reports the null vectors that are independent of the known integrals.
    fn tell(
        &self,
        system: &LinearSystem,
        at: &PrimePoint,
        all: &[Vec<u32>],
        (variables, degree, counted): (&[usize], u32, usize),
        found: Vec<ClassVectors>,
        (known, report): (&mut IndependentIntegrals, &mut SearchReport),
    ) -> Result<(), SearchError> {
        let setting = self.setting;
        let mut candidates: Vec<(Vec<usize>, Vec<u64>)> = Vec::new();
        for ClassVectors { columns, vectors } in found {
            for vector in vectors {
                let used = (0..vector.len()).filter(|k| vector[*k] != 0);
                candidates.push(used.map(|k| (columns[k], vector[k])).unzip());
            }
        }
        candidates.sort_by_key(|(support, _)| support.len());
        let Some((point, mut gradients)) = known.gradients(setting, at)? else { return Ok(()) };
        let gradient = |(support, values): &(Vec<usize>, Vec<u64>)| {
            let own: Vec<Vec<u32>> = support.iter().map(|k| all[*k].clone()).collect();
            combined_gradient(at, &own, values, &point)
        };
        // Functions of integrals that could not be written are no easier to write; on a level others are,
        // as polynomials that are equal there to fractions.
        let mut together = gradients.clone();
        let new = candidates.iter().filter(|own| together.push(at, gradient(own))).count();
        if !setting.is_on_level() && known.algebraic_within(variables) + new <= counted {
            return Ok(());
        }
        let mut unwritten = None;
        for (support, values) in candidates {
            setting.effort.halt.check()?;
            let own: Vec<Vec<u32>> = support.iter().map(|k| all[*k].clone()).collect();
            let mut own_gradients = gradients.clone();
            let gradient = combined_gradient(at, &own, &values, &point);
            if !own_gradients.push(at, gradient.clone()) {
                continue;
            }
            let vector = NullVector { system, columns: &support };
            let Some(coefficients) = images::coefficients(&vector)? else {
                unwritten = unwritten.or(Some((support.len(), gradient)));
                continue;
            };
            let functions: Result<Vec<Ratio>, _> =
                own.iter().map(|own| power_product(&setting.terms, own).map(Ratio::of)).collect();
            let places: Vec<usize> = (0..support.len()).collect();
            let Some(formula) = coefficients.sum(&places, &functions?)? else { continue };
            if claims::integral(setting, &formula, report)? {
                known.add(formula, Some(degree), variables);
                gradients = own_gradients;
            }
        }
        if let Some((terms, gradient)) = unwritten
            && gradients.push(at, gradient)
        {
            let what = format!("an integral of degree {degree} with {terms} terms");
            note_unwritten(setting.case, &what, report);
        }
        Ok(())
    }
}

fn difference(a: &[i64], b: &[i64]) -> Vec<i64> {
    a.iter().zip(b).map(|(a, b)| a - b).collect()
}
