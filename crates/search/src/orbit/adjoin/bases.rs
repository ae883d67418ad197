//! Denominators, radicands and other functions as factors of densities and integrals.

use liouville::formula::Formula;
use liouville::number::rational::Rational;

use super::polynomial::RingPolynomial;
use super::ring::{AdjoinedRing, Atom};
use super::write::{self, RingNames};

/// Largest number of factors.
const FACTORS: usize = 40;

/// Parts g, h and D of bases of denominators and roots that are multiples of g² − D h².
pub fn circles(
    ring: &AdjoinedRing,
    formula: impl Fn(&RingPolynomial) -> Option<Formula>,
) -> Vec<[Formula; 3]> {
    let mut all: Vec<(usize, usize, Rational)> = Vec::new();
    for atom in &ring.atoms {
        let (Atom::Root(base, _) | Atom::Inverse(base, _)) = atom else { continue };
        let squares = base.terms().map(|(own, value)| match own.as_slice() {
            [(variable, 2)] if matches!(ring.atoms[*variable], Atom::State) => {
                Some((*variable, value))
            }
            _ => None,
        });
        let Some(squares) = squares.collect::<Option<Vec<_>>>() else { continue };
        let [(g, a), (h, b)] = squares[..] else { continue };
        let Some(inverse) = a.recip() else { continue };
        let own = (g, h, &-b * &inverse);
        if !all.contains(&own) {
            all.push(own);
        }
    }
    let variable = |place| formula(&RingPolynomial::variable(place, 1));
    let parts = all.into_iter().map(|(g, h, square)| {
        Some([variable(g)?, variable(h)?, formula(&RingPolynomial::constant(square))?])
    });
    parts.flatten().collect()
}

/// Bases of denominators and roots, sines and cosines, and the sums of a root and a variable.
pub fn factors(
    ring: &AdjoinedRing,
    names: &RingNames,
    formula: impl Fn(&RingPolynomial) -> Option<Formula>,
) -> Vec<Formula> {
    let mut all: Vec<RingPolynomial> = Vec::new();
    let state = (0..ring.atoms.len()).filter(|k| matches!(ring.atoms[*k], Atom::State));
    let state: Vec<usize> = state.collect();
    for (place, atom) in ring.atoms.iter().enumerate() {
        let this = RingPolynomial::variable(place, 1);
        match atom {
            Atom::Root(base, _) => {
                all.push(base.clone());
                let sum = |k: &usize| this.plus(&RingPolynomial::variable(*k, 1), &1.into());
                all.extend(state.iter().filter_map(sum));
            }
            Atom::Inverse(base, 1) => all.push(base.clone()),
            Atom::Sine(_) | Atom::Cosine(_) | Atom::Logarithm(..) => all.push(this),
            _ => {}
        }
    }
    let mut texts: Vec<String> = Vec::new();
    all.retain(|own| {
        let text = write::written(own, &names.extended);
        let is_new = !texts.contains(&text);
        texts.push(text);
        is_new
    });
    all.truncate(FACTORS);
    all.iter().filter_map(formula).collect()
}
