//! Polynomial integrals of higher degree, class by class.
//!
//! Beyond the degree to which all monomials are searched together, those of each class of exponents
//! are: the matrix of thousands of monomials has blocks of dozens. Null vectors are kept where their
//! gradients, at a random point modulo a prime, are independent of those of the known integrals and of
//! each other.

use std::collections::BTreeMap;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Duration;

use rayon::prelude::*;

use liouville::order::StableOrder;

use super::super::ansatz::coefficients::NullVector;
use super::super::ansatz::note_unwritten;
use super::super::ansatz::system::{Column, LinearSystem, PrimePoint};
use super::super::room::Room;
use super::super::terms::one;
use super::super::{Effort, Halt, SearchError, SearchReport};
use super::adjoin::{self, PolynomialField};
use super::known::IndependentIntegrals;
use super::lattice::ExponentLattice;
use super::leading::LeadingField;
use super::relations::combined_gradient;
use super::setting::OrbitSetting;
use super::sparse::sparse;
use super::turned::turned;
use super::{claims, images, monomials};

/// Largest number of monomials of one degree that are listed.
const LISTED: usize = 60_000;
/// Largest number of unknowns of one class.
const WIDEST: usize = 2400;

/// Time after the end of a search for what was found before.
const GRACE: Duration = Duration::from_secs(1);

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
        classes.order_by_key(Vec::len);
        let times = if setting.is_on_level() { 2.0 } else { 1.0 };
        let cost: f64 = classes.iter().map(|own| times * (own.len() as f64).powi(3) / 2.0).sum();
        if cost > steps || classes.iter().any(|own| own.len() > WIDEST) {
            return Ok(None);
        }
        // Several classes are under way at a time: the meter counts whole ones.
        let effort = Effort { halt: setting.effort.halt.within_a_step(), ..setting.effort.clone() };
        let mut system = LinearSystem::record(setting.case, &effort, |jet, recording| {
            recording.derive(jet.along_field(), &setting.terms, &[one()]);
        })?;
        let product = |exponents| Column::Product { derivation: 0, factor: 0, exponents };
        system.columns = all.iter().cloned().map(product).collect();
        let Some(at) = system.at(0, 0) else { return Ok(Some(cost)) };
        let leading = LeadingField::of(setting, &self.field, variables, degree)?;
        let step = ClassStep {
            system: &system,
            at: &at,
            all: &all,
            degree,
            is_on_level: setting.is_on_level(),
            leading,
            room: Room::new(effort.ansatz.megabytes.saturating_mul(1_000_000)),
        };
        let (found, end) = step.of_all(classes, &setting.effort.halt)?;
        // What was found before the end of the time is not lost.
        system.halt_by(setting.effort.halt.extended(GRACE));
        self.tell(&system, &at, &all, (variables, degree, counted), found, (known, report))?;
        end.map(|()| Some(cost))
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
        candidates.order_by_key(|(support, _)| support.len());
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
            system.halt().check()?;
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
            let functions = setting.functions(&own)?;
            let places: Vec<usize> = (0..support.len()).collect();
            let Some(formula) = coefficients.sum(&places, &functions)? else { continue };
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

/// The search of the classes of one degree, each alone.
struct ClassStep<'d> {
    system: &'d LinearSystem,
    at: &'d PrimePoint,
    /// Exponents of all monomials.
    all: &'d [Vec<u32>],
    degree: u32,
    is_on_level: bool,
    leading: Option<LeadingField>,
    /// Memory of the classes that are under way.
    room: Room,
}

impl ClassStep<'_> {
    /// Null vectors of all classes, in order, from all threads, and whether the search was stopped before
    /// the last; the classes come by increasing size.
    fn of_all(&self, classes: Vec<Vec<usize>>, halt: &Halt) -> Result<Finished, SearchError> {
        let work = |own: &Vec<usize>| own.len().pow(2);
        let (done, all_work) = (AtomicUsize::new(0), classes.iter().map(work).sum());
        let one = |places: Vec<usize>| -> Result<Vec<ClassVectors>, SearchError> {
            halt.check()?;
            let own = work(&places);
            let found = self.room.run(bytes(places.len()), || self.of_class(places))?;
            halt.meter().set(own + done.fetch_add(own, Ordering::Relaxed), all_work);
            Ok(found)
        };
        // The largest first, so that no thread is left alone with one of them at the end.
        let found = classes.into_par_iter().rev().with_max_len(1).map(one);
        let found: Vec<Result<Vec<ClassVectors>, SearchError>> = found.collect();
        finished(found.into_iter().rev())
    }

    /// Null vectors of the monomials in these places, in two bases; none of either if a theorem says so.
    fn of_class(&self, places: Vec<usize>) -> Result<Vec<ClassVectors>, SearchError> {
        let (system, at) = (self.system, self.at);
        if let Some(leading) = &self.leading {
            let forms: Vec<&Vec<u32>> = places.iter().map(|place| &self.all[*place]).collect();
            let is_highest = |own: &&Vec<u32>| own.iter().sum::<u32>() == self.degree;
            let forms: Vec<&Vec<u32>> = forms.into_iter().filter(is_highest).collect();
            // An integral of lower degree was found before.
            if 2 * forms.len() <= places.len() && leading.excludes(&forms)? {
                return Ok(Vec::new());
            }
        }
        let columns = match self.is_on_level {
            false => places,
            true => match system.distinct(at, &places)? {
                Some(columns) => columns,
                None => return Ok(Vec::new()),
            },
        };
        let Some(vectors) = system.null_space(at, &columns)? else { return Ok(Vec::new()) };
        if vectors.is_empty() {
            return Ok(Vec::new());
        }
        // In another order the reduced vectors may have fewer terms.
        let backwards = columns.iter().rev().copied().collect();
        let others = turned(&at.modulus, vectors.clone(), system.halt())?;
        let made = [(columns, vectors), (backwards, others)];
        let sparse =
            |(columns, vectors)| ClassVectors { columns, vectors: sparse(&at.modulus, vectors) };
        Ok(made.map(sparse).into())
    }
}

/// Null vectors of classes, and whether the search was stopped.
type Finished = (Vec<ClassVectors>, Result<(), SearchError>);

/// Joins what was found in the classes, some of which may have been stopped.
fn finished(
    classes: impl Iterator<Item = Result<Vec<ClassVectors>, SearchError>>,
) -> Result<Finished, SearchError> {
    let (mut all, mut end) = (Vec::new(), Ok(()));
    for class in classes {
        match class {
            Ok(own) => all.extend(own),
            Err(SearchError::Stopped) => end = Err(SearchError::Stopped),
            Err(other) => return Err(other),
        }
    }
    Ok((all, end))
}

/// Bound on the bytes that an elimination of so many unknowns takes: the entries behind the pivots, with
/// their columns.
fn bytes(unknowns: usize) -> u64 {
    (unknowns as u64).pow(2) / 2 * (size_of::<u64>() + size_of::<u32>()) as u64
}

fn difference(a: &[i64], b: &[i64]) -> Vec<i64> {
    a.iter().zip(b).map(|(a, b)| a - b).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn classes_that_were_finished_are_not_lost() {
        let class = |column| vec![ClassVectors { columns: vec![column], vectors: Vec::new() }];
        let stopped = || Err(SearchError::Stopped);
        let columns = |classes: Vec<Result<Vec<ClassVectors>, SearchError>>| {
            let (found, end) = finished(classes.into_iter()).expect("no other error");
            (found.iter().map(|own| own.columns[0]).collect::<Vec<_>>(), end.is_ok())
        };
        assert_eq!(columns(vec![Ok(class(3)), Ok(class(1))]), (vec![3, 1], true));
        assert_eq!(columns(vec![Ok(class(3)), stopped(), Ok(class(1))]), (vec![3, 1], false));
        assert_eq!(columns(vec![stopped(), stopped()]), (vec![], false));
        let other = vec![stopped(), Err(SearchError::NoPoints)];
        assert!(matches!(finished(other.into_iter()), Err(SearchError::NoPoints)));
    }
}
