//! Equations of a variety from points on it.

use super::real::Terms;
use crate::echelon::Echelon;
use crate::series::exponents;
use crate::terms::equation;
use liouville::formula::exponent_text;
use liouville::number::prime::Modulus;
use liouville::number::rational::Rational;
use liouville::proof::reconstruct;

/// Number of points beyond the number of monomials.
const SPARE_POINTS: usize = 8;

/// An equation between components of the parameters.
pub struct VarietyEquation {
    /// The equation as text.
    pub text: String,
    /// Its left side less the right one, in the components.
    pub terms: Terms,
}

/// Finds the equations of least degree that hold at all points; `None` if none has degree
/// at most `most`, or if there are too few points.
pub fn equations(
    names: &[String],
    points: &[Vec<u64>],
    modulus: &Modulus,
    most: u32,
) -> Option<Vec<VarietyEquation>> {
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    for degree in 1..=most {
        let monomials: Vec<Vec<u32>> =
            (0..=degree).flat_map(|total| exponents(names.len(), total)).collect();
        if points.len() < monomials.len() + SPARE_POINTS {
            return None;
        }
        let mut echelon = Echelon::new(monomials.len(), *modulus);
        for point in points {
            echelon.push(monomials.iter().map(|e| power(point, e, modulus)).collect());
        }
        let texts: Vec<String> = monomials.iter().map(|e| monomial(&names, e)).collect();
        let texts: Vec<&str> = texts.iter().map(String::as_str).collect();
        let rational = |vector: Vec<u64>| -> Option<Vec<Rational>> {
            vector.iter().map(|x| reconstruct(*x, modulus)).collect()
        };
        let found: Vec<VarietyEquation> = echelon
            .null_space()
            .into_iter()
            .filter_map(rational)
            .map(|vector| VarietyEquation::of(&vector, &monomials, &texts))
            .collect();
        if !found.is_empty() {
            return Some(found);
        }
    }
    None
}

/// Number of points needed for equations of this degree.
pub fn needed(coordinates: usize, degree: u32) -> usize {
    (0..=degree).map(|total| exponents(coordinates, total).len()).sum::<usize>() + SPARE_POINTS
}

/// Evaluates a monomial.
pub fn power(coordinates: &[u64], exponents: &[u32], m: &Modulus) -> u64 {
    coordinates
        .iter()
        .zip(exponents)
        .fold(m.one(), |product, (x, e)| m.mul(product, m.power(*x, u64::from(*e))))
}

/// Writes a monomial.
pub fn monomial(names: &[&str], exponents: &[u32]) -> String {
    let used = names.iter().zip(exponents).filter(|(_, e)| **e > 0);
    let factors: Vec<String> = used
        .map(|(name, e)| match e {
            1 => name.to_string(),
            e => format!("{name}{}", exponent_text(i64::from(*e))),
        })
        .collect();
    if factors.is_empty() { "1".to_string() } else { factors.join("*") }
}

impl VarietyEquation {
    /// Makes the equation with some coefficients of monomials.
    pub fn of(coefficients: &[Rational], monomials: &[Vec<u32>], texts: &[&str]) -> Self {
        let terms = monomials.iter().cloned().zip(coefficients.iter().cloned());
        let terms = terms.filter(|(_, value)| !value.is_zero()).collect();
        Self { text: equation(coefficients, texts), terms }
    }
}

/// Lists conditions on single components: x = 0, and x = y for components with similar names.
pub fn simple(names: &[String], point: &[u64], among: &[usize]) -> Vec<VarietyEquation> {
    let mut found = Vec::new();
    let unit = |place: usize| (0..names.len()).map(|k| u32::from(k == place)).collect();
    for (place, k) in among.iter().enumerate() {
        if point[*k] == 0 {
            let terms = vec![(unit(*k), Rational::from(1))];
            found.push(VarietyEquation { text: format!("{} = 0", names[*k]), terms });
        }
        let letter = |k: usize| names[k].chars().next();
        for j in &among[..place] {
            if point[*j] == point[*k] && letter(*j) == letter(*k) && point[*k] != 0 {
                let text = format!("{} = {}", names[*j], names[*k]);
                let terms = vec![(unit(*j), Rational::from(1)), (unit(*k), Rational::from(-1))];
                found.push(VarietyEquation { text, terms });
            }
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use liouville::proof::ProofRng;

    #[test]
    fn a_hyperbola_is_found_from_its_points() {
        let mut rng = ProofRng::new(3, 0);
        let m = rng.prime(&[], &[]);
        let names: Vec<String> = ["k", "R"].map(str::to_string).to_vec();
        let points: Vec<Vec<u64>> = (0..20)
            .map(|_| {
                let radius = rng.element(&m);
                let curvature = m.mul(m.sub(0, m.integer(2)), m.inverse(radius));
                vec![curvature, radius]
            })
            .collect();
        let found = |points: &[Vec<u64>]| -> Vec<String> {
            let found = equations(&names, points, &m, 3).expect("there is one");
            found.into_iter().map(|own| own.text).collect()
        };
        assert_eq!(found(&points), ["2 + k*R = 0"]);
        let mut point = |x: fn(&Modulus, u64) -> u64| {
            let radius = rng.element(&m);
            vec![x(&m, radius), radius]
        };
        let equal: Vec<Vec<u64>> = (0..20).map(|_| point(|_, x| x)).collect();
        assert_eq!(found(&equal), ["k − R = 0"]);
        let fixed: Vec<Vec<u64>> = (0..20).map(|_| point(|m, _| m.integer(2))).collect();
        assert_eq!(found(&fixed), ["2 − k = 0"]);
        let alone = simple(&names, &[0, 5], &[0, 1]);
        assert_eq!(alone.iter().map(|own| own.text.as_str()).collect::<Vec<_>>(), ["k = 0"]);
    }
}
