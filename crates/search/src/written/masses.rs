//! The determinant of the masses on the constraints of a Lagrangian system, as a density.
//!
//! With the masses M = ∂²T/∂w², constraints f and A = ∂f/∂w let B = det [[M, Aᵀ], [A, 0]]. Along the constraints
//! dq dp is |B|/√det(AAᵀ) times the volume of the level; where A has constant length, |B| times it.

use crate::terms::is_one;
use liouville::case::Case;
use liouville::formula::Formula;
use liouville::mechanics::{System, VariableRole};
use liouville::number::rational::Rational;
use liouville::proof::Polynomial;

use super::fraction::Fraction;
use super::reader::Reader;
use super::writer::{self, Constants};

/// Largest number of velocities and constraints together.
const MOST_ROWS: usize = 6;

/// Densities to be tried; none without constraints, or where T and these are no fractions in the velocities.
pub fn densities(case: &Case) -> Vec<Formula> {
    made(case).unwrap_or_default()
}

fn made(case: &Case) -> Option<Vec<Formula>> {
    let model = &case.model;
    let System::Lagrangian(own) = &model.system else { return None };
    let mut reader = Reader::new(case).expanding();
    let (mut velocities, mut start) = (Vec::new(), 0);
    for (role, variable) in own.roles.iter().zip(&model.state) {
        if matches!(role, VariableRole::Velocity) {
            velocities.extend((start..start + variable.len()).map(|k| model.component_name(k)));
        }
        start += variable.len();
    }
    let rows = velocities.len() + own.constraints.len();
    if own.constraints.is_empty() || own.vakonomic || rows > MOST_ROWS {
        return None;
    }
    let tokens: Option<Vec<u32>> = velocities.iter().map(|name| reader.tokens.of(name)).collect();
    let tokens = tokens?;
    let slopes = |own: &Fraction| -> Option<Vec<Fraction>> {
        tokens.iter().map(|token| slope(own, *token)).collect()
    };
    let kinetic = reader.read(own.kinetic.text())?;
    let masses: Option<Vec<Vec<Fraction>>> = slopes(&kinetic)?.iter().map(slopes).collect();
    let masses = masses?;
    let mut forms = Vec::new();
    for constraint in &own.constraints {
        forms.push(slopes(&reader.read(constraint.text())?)?);
    }
    let zero = Fraction::number(&Rational::from(0));
    let mut bordered: Vec<Vec<Fraction>> = Vec::new();
    for (k, row) in masses.into_iter().enumerate() {
        bordered.push(row.into_iter().chain(forms.iter().map(|form| form[k].clone())).collect());
    }
    for form in &forms {
        bordered.push(form.iter().cloned().chain(vec![zero.clone(); forms.len()]).collect());
    }
    let mut products = Vec::new();
    for one in &forms {
        let row = forms.iter().map(|other| {
            one.iter()
                .zip(other)
                .try_fold(zero.clone(), |sum, (a, b)| sum.plus(&a.times(b)?, false))
        });
        products.push(row.collect::<Option<Vec<Fraction>>>()?);
    }
    let density = determinant(&bordered)?;
    let density = writer::written(&mut reader, &density, Constants::Left)?.text;
    let gram = determinant(&products)?;
    let gram = writer::written(&mut reader, &gram, Constants::Left)?.text;
    let is_same = gram == density;
    let [density, gram] = [density, gram].map(|text| case.formula(&text).ok());
    let (density, gram) = (density?, gram?);
    if is_one(&gram) {
        return Some(vec![density]);
    }
    let root = gram.bracketed().sqrt().ok()?;
    let along = if is_same { root } else { (density.bracketed() / &root).ok()? };
    Some(vec![density, along])
}

/// The derivative by a variable that the denominator does not contain.
fn slope(own: &Fraction, token: u32) -> Option<Fraction> {
    if own.below.variables().contains(&token) {
        return None;
    }
    let variable = Fraction::variable(token);
    let mut sum = Fraction::number(&Rational::from(0));
    for (power, part) in own.above.by_powers(token).into_iter().filter(|(power, _)| *power > 0) {
        let part: Polynomial = part.scaled(&Rational::from(i64::from(power)));
        let part = Fraction::whole(part).times(&variable.power(i64::from(power) - 1)?)?;
        sum = sum.plus(&part, false)?;
    }
    sum.over(&Fraction::whole(own.below.clone()))
}

/// The determinant by its first row.
fn determinant(rows: &[Vec<Fraction>]) -> Option<Fraction> {
    let Some((first, rest)) = rows.split_first() else { return Some(Fraction::one()) };
    let mut sum = Fraction::number(&Rational::from(0));
    for (k, entry) in first.iter().enumerate().filter(|(_, entry)| !entry.above.is_zero()) {
        let without = |row: &Vec<Fraction>| [&row[..k], &row[k + 1..]].concat();
        let minor = determinant(&rest.iter().map(without).collect::<Vec<_>>())?;
        sum = sum.plus(&entry.times(&minor)?, k % 2 == 1)?;
    }
    Some(sum)
}
