//! Degrees in the functions that a file writes, and in those of a ring, which are fewer: e^(2x) and e^(−x) are powers of
//! e^x, and sin 2x is a polynomial in sin x and cos x.

use std::collections::{BTreeMap, BTreeSet};

use super::Extension;
use super::polynomial::{Monomial, RingPolynomial};
use super::ring::{AdjoinedRing, Atom};

/// Largest power of an exponential that is looked at.
const HIGHEST: i64 = 24;

impl Extension {
    /// Largest degree in the class of a fraction of polynomials of degree 1 in the state and the functions that were
    /// read.
    ///
    /// Let f_i = Π b_j^(k_ij) be these functions in those of the class, m_j = max(0, −k_ij), and K the largest of 1 and
    /// the Σ_j k_ij. A polynomial of degree N in the f_i times Π b_j^(N m_j) has degree N (K + Σ m_j) at most.
    pub fn share(&self) -> u32 {
        let (mut above, mut below) = (1, BTreeMap::new());
        for function in &self.ring.functions {
            for (monomial, _) in function.terms() {
                above = above.max(parted(&self.ring, monomial, &mut below));
            }
        }
        below.values().fold(above, |sum, power| sum.saturating_add(*power))
    }

    /// Degree of numerator and denominator of a known integral in the state and the functions that the field
    /// contains, by its place among those given; `None` if it contains others, or if it is not known.
    pub fn written_degree(&self, place: usize) -> Option<u32> {
        let sides = self.sides(place)?;
        let written = self.ring.functions.get(..self.functions_of_field)?;
        let terms = || sides.iter().flat_map(RingPolynomial::terms).map(|(own, _)| own);
        let mut sizes = vec![0u32; terms().count()];
        let mut exponentials: BTreeSet<usize> = BTreeSet::new();
        for (term, size) in terms().zip(&mut sizes) {
            for (variable, power) in term {
                match &self.ring.atoms[*variable] {
                    Atom::Parameter | Atom::Constant(_) => {}
                    Atom::State | Atom::Root(..) => *size = size.saturating_add(*power),
                    Atom::Sine(_) | Atom::Cosine(_) => {
                        let own = RingPolynomial::variable(*variable, 1);
                        written.contains(&own).then_some(())?;
                        *size = size.saturating_add(*power);
                    }
                    Atom::Exponential(_) => {
                        exponentials.insert(*variable);
                    }
                    _ => return None,
                }
            }
        }
        for variable in exponentials {
            let power = |term: &Monomial| {
                let own = term.iter().find(|(other, _)| *other == variable);
                own.map_or(0, |(_, power)| i64::from(*power))
            };
            let costs = costs(&steps(&self.ring, written, variable));
            // Both sides may be multiplied by a power.
            let shifted = |shift: i64| {
                let add = |(term, size): (&Monomial, &u32)| {
                    Some(size.saturating_add(*costs.get(&(power(term) + shift))?))
                };
                terms().zip(&sizes).map(add).collect::<Option<Vec<u32>>>()
            };
            let all = (-HIGHEST..=HIGHEST).filter_map(shifted);
            sizes = all.min_by_key(|sizes| sizes.iter().copied().max())?;
        }
        sizes.into_iter().max()
    }
}

/// Powers of an exponential that are functions of a list.
fn steps(ring: &AdjoinedRing, functions: &[RingPolynomial], variable: usize) -> BTreeSet<i64> {
    let power = |own: &RingPolynomial| {
        let (monomial, _) = own.single()?;
        let [(other, power)] = monomial.as_slice() else { return None };
        let power = i64::from(*power);
        match &ring.atoms[*other] {
            Atom::Exponential(_) if *other == variable => Some(power),
            Atom::ExponentialOf(_, powers) => match powers.as_slice() {
                [(base, own)] if *base == variable => own.checked_mul(power),
                _ => None,
            },
            _ => None,
        }
    };
    functions.iter().filter_map(power).collect()
}

/// Smallest number of steps whose sum is a power, by powers.
fn costs(steps: &BTreeSet<i64>) -> BTreeMap<i64, u32> {
    let mut all = BTreeMap::from([(0, 0)]);
    let mut last = vec![0];
    for cost in 1.. {
        let reached = last.iter().flat_map(|from| steps.iter().map(move |step| from + step));
        let new: BTreeSet<i64> = reached
            .filter(|power| power.abs() <= 2 * HIGHEST && !all.contains_key(power))
            .collect();
        if new.is_empty() {
            break;
        }
        all.extend(new.iter().map(|power| (*power, cost)));
        last = new.into_iter().collect();
    }
    all
}

/// Degree of a monomial without its negative powers, whose largest size is noted for each variable.
fn parted(ring: &AdjoinedRing, monomial: &[(usize, u32)], below: &mut BTreeMap<usize, u32>) -> u32 {
    let mut powers: BTreeMap<usize, i64> = BTreeMap::new();
    let mut add = |variable: usize, power: i64| {
        let own = powers.entry(variable).or_default();
        *own = own.saturating_add(power);
    };
    for (variable, power) in monomial {
        let power = i64::from(*power);
        match &ring.atoms[*variable] {
            Atom::Parameter | Atom::Constant(_) => {}
            Atom::ExponentialOf(_, others) => {
                others.iter().for_each(|(other, own)| add(*other, own.saturating_mul(power)));
            }
            _ => add(*variable, power),
        }
    }
    let small = |power: i64| u32::try_from(power.unsigned_abs()).unwrap_or(u32::MAX);
    let mut degree = 0u32;
    for (variable, power) in powers {
        match power >= 0 {
            true => degree = degree.saturating_add(small(power)),
            false => {
                let own = below.entry(variable).or_default();
                *own = (*own).max(small(power));
            }
        }
    }
    degree
}
