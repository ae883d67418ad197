//! Integrals of maps x_i → c_i Π x_j^(a_ij) in the logarithms of the state.
//!
//! In X_i = ln |x_i| such a map is affine, X → A X + ln |c|. Its polynomial and rational integrals are
//! sought as those of any map: products Π (w_k, X)^(m_k) of eigenvectors w_k of A with Π λ_k^(m_k) = 1
//! are among them, as ln x/ln y for (x², y²). Two eigenvectors with real eigenvalues other than these have
//! the integral ln |(w₁, X)| ln |λ₂| − ln |(w₂, X)| ln |λ₁|, and where an eigenvalue is 1 that of degree 1
//! or none.

use liouville::case::Case;
use liouville::formula::Formula;
use liouville::number::rational::Rational;

use super::super::integrals::tell_if_proved;
use super::super::{Effort, FoundKind, SearchError, SearchReport};
use super::adjoin::MonomialMap;
use super::cleared::input_names;
use super::known::has_told_all;
use super::setting::OrbitSetting;
use super::{along_orbits, magnitude};

/// Largest whole eigenvalue that is tried.
const EIGENVALUES: i64 = 64;

/// Searches a map by monomials for integrals with logarithms; proved ones go into the report.
pub fn search(
    case: &Case,
    effort: &Effort,
    report: &mut SearchReport,
    progress: &mut dyn FnMut(&str),
) -> Result<(), SearchError> {
    if has_told_all(case, report) {
        return Ok(());
    }
    let Some(map) = MonomialMap::of(case)? else { return Ok(()) };
    progress("integrals with the logarithms of the state");
    let names = input_names(case);
    let (parameters, state) = names.split_at(case.model.free_components());
    let mut logarithms = Vec::new();
    for name in state {
        let Ok(component) = case.formula(name) else { return Ok(()) };
        logarithms.push(Formula::call("ln", &[&magnitude::of_case(case, effort, &component)?])?);
    }
    let logarithms: Vec<String> = logarithms.iter().map(|own| own.text().to_string()).collect();
    let mut own = SearchReport::default();
    if let Ok(setting) = OrbitSetting::of(&map.case, effort)? {
        along_orbits(&setting, &[], &mut own, progress)?;
    }
    let found = own.functions(FoundKind::Integral).map(|own| own.text().to_string());
    let pairs = map.exponents.as_ref().map(|own| of_eigenvectors(own, map.coefficients()));
    for text in found.chain(pairs.unwrap_or_default()) {
        effort.halt.check()?;
        let Ok(formula) = case.formula(&map.back(&text, &logarithms, parameters)) else { continue };
        tell_if_proved(case, &formula, effort, report)?;
    }
    Ok(())
}

/// Integrals of two eigenvectors with different whole eigenvalues, in the names of the logarithms.
fn of_eigenvectors(matrix: &[Vec<Rational>], coefficients: &[Option<String>]) -> Vec<String> {
    let mut all: Vec<(i64, String)> = Vec::new();
    for value in (-EIGENVALUES..=EIGENVALUES).filter(|value| value.abs() > 1) {
        let Some(vector) = eigenvector(matrix, value) else { continue };
        // (w, X) + (w, ln |c|)/(λ − 1) is multiplied by λ.
        let share = Rational::new(1, value - 1);
        let mut terms = Vec::new();
        for (k, weight) in vector.iter().enumerate().filter(|(_, weight)| !weight.is_zero()) {
            terms.push(multiple(weight, &format!("aux{k}")));
            if coefficients[k].is_some() {
                terms.push(multiple(&(weight * &share), &format!("shift{k}")));
            }
        }
        all.push((value, format!("ln(|{}|)", terms.join(" + "))));
    }
    let Some(((first, own), others)) = all.split_first() else { return Vec::new() };
    let pair = |(second, other): &(i64, String)| {
        format!("ln({})*{own} - ln({})*{other}", second.abs(), first.abs())
    };
    others.iter().map(pair).collect()
}

/// Multiple of a name.
fn multiple(value: &Rational, name: &str) -> String {
    let (above, below) = value.parts();
    match (value.is_one(), below == 1.into(), value.is_negative()) {
        (true, ..) => name.to_string(),
        (_, true, false) => format!("{above}*{name}"),
        (_, true, true) => format!("({above})*{name}"),
        _ => format!("({above}/{below})*{name}"),
    }
}

/// A vector w with wA = λw, if there is one up to a factor.
fn eigenvector(matrix: &[Vec<Rational>], value: i64) -> Option<Vec<Rational>> {
    let count = matrix.len();
    // Rows of Aᵀ − λ.
    let entry = |row: usize, column: usize| {
        let own = matrix[column][row].clone();
        if row == column { &own - &Rational::from(value) } else { own }
    };
    let mut rows: Vec<Vec<Rational>> =
        (0..count).map(|row| (0..count).map(|column| entry(row, column)).collect()).collect();
    let mut pivots: Vec<usize> = Vec::new();
    for column in 0..count {
        let done = pivots.len();
        let Some(found) = (done..count).find(|row| !rows[*row][column].is_zero()) else { continue };
        rows.swap(done, found);
        let inverse = rows[done][column].recip()?;
        let pivot: Vec<Rational> = rows[done].iter().map(|own| own * &inverse).collect();
        for (_, row) in rows.iter_mut().enumerate().filter(|(place, _)| *place != done) {
            let factor = row[column].clone();
            row.iter_mut().zip(&pivot).for_each(|(own, other)| *own = &*own - &(&factor * other));
        }
        rows[done] = pivot;
        pivots.push(column);
    }
    let free: Vec<usize> = (0..count).filter(|column| !pivots.contains(column)).collect();
    let [free] = free[..] else { return None };
    let mut vector = vec![Rational::from(0); count];
    vector[free] = Rational::from(1);
    for (row, column) in pivots.iter().enumerate() {
        vector[*column] = &Rational::from(0) - &rows[row][free];
    }
    Some(vector)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn eigenvectors_are_exact() {
        let matrix = [[2, 1], [0, 3]].map(|row| row.map(Rational::from).to_vec());
        assert_eq!(eigenvector(&matrix, 3), Some([0, 1].map(Rational::from).to_vec()));
        let own = eigenvector(&matrix, 2).expect("w = (1, −1) up to a factor");
        assert!((&own[0] + &own[1]).is_zero());
        assert_eq!(eigenvector(&matrix, 5), None);
        let twice = [[2, 0], [0, 2]].map(|row| row.map(Rational::from).to_vec());
        assert_eq!(eigenvector(&twice, 2), None, "there are many");
    }
}
