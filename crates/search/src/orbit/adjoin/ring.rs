//! Polynomials in the state and in functions of it, which become further variables.
//!
//! A function is adjoined once: exponentials by arguments that are linearly independent over the
//! rational numbers, sines and cosines of such arguments in pairs, roots with their inverses. What
//! depends on them is written in them: e^(2x) = (e^x)², sin 2φ = 2 sin φ cos φ, x/r³ = x (1/r)³,
//! (e^x)^a = e^(a x), 2^x = e^(x ln 2). Functions of the parameters alone that are no fractions or
//! square roots, such as ln 2, take the place of further parameters.

use liouville::number::rational::Rational;

pub use super::atom::{Atom, ConstantFunction, Of};
use super::polynomial::{Monomial, RingPolynomial, combination};
use super::reduction::Reduction;

/// Largest power of a function that is written out.
const HIGHEST: i64 = 24;

/// A reason to begin anew: an argument has to be divided.
#[derive(Clone, Debug)]
pub struct Divided {
    /// Argument that was taken first.
    pub argument: RingPolynomial,
    /// Divisor that makes later arguments whole multiples.
    pub by: i64,
}

/// The ring of polynomials in the variables so far.
#[derive(Clone, Debug, Default)]
pub struct AdjoinedRing {
    /// Variables in the order in which they were adjoined.
    pub atoms: Vec<Atom>,
    /// Arguments of exponentials, and of sines and cosines, with the variable of each.
    arguments: [Vec<(RingPolynomial, usize)>; 2],
    /// Arguments to be divided.
    pub divided: Vec<Divided>,
    /// Whether reading failed as an argument has to be divided.
    pub is_refined: bool,
    /// Exponentials, sines and cosines that were read, as polynomials of the ring.
    pub functions: Vec<RingPolynomial>,
}

/// A quotient in which the functions are adjoined; `None` where this is impossible.
type Made = Option<RingPolynomial>;

impl AdjoinedRing {
    /// Starts with the components of parameters and state; `divided` are arguments to be divided.
    pub fn new(parameters: usize, state: usize, divided: Vec<Divided>) -> Self {
        let parameters = vec![Atom::Parameter; parameters];
        let atoms = [parameters, vec![Atom::State; state]].concat();
        Self { atoms, divided, ..Self::default() }
    }

    /// Adds a variable.
    fn push(&mut self, atom: Atom) -> usize {
        self.atoms.push(atom);
        self.atoms.len() - 1
    }

    /// Whether a polynomial depends on parameters only.
    pub fn is_constant(&self, polynomial: &RingPolynomial) -> bool {
        let is_constant = |k: &usize| matches!(self.atoms[*k], Atom::Parameter | Atom::Constant(_));
        polynomial.variables().iter().all(is_constant)
    }

    /// A function of the parameters as a variable.
    fn constant(&mut self, own: Of) -> RingPolynomial {
        let same = |atom: &Atom| matches!(atom, Atom::Constant(of) if *of == own);
        let place = self.atoms.iter().position(same);
        let place = place.unwrap_or_else(|| self.push(Atom::Constant(own)));
        RingPolynomial::variable(place, 1)
    }

    /// Power with a rational exponent.
    pub fn power(&mut self, base: &RingPolynomial, exponent: &Rational) -> Made {
        let (above, below) = exponent.small_parts()?;
        if above.abs() > HIGHEST || !(1..=HIGHEST).contains(&below) {
            return None;
        }
        match below {
            1 if above >= 0 => base.raised(above as u32),
            1 => self.inverse(base)?.raised(above.unsigned_abs() as u32),
            _ => self.root(base, above, below as u32),
        }
    }

    /// 1/p, factor by factor; sin² + cos² is 1.
    pub fn inverse(&mut self, own: &RingPolynomial) -> Made {
        let reduced = Reduction::of(&self.atoms, false).reduced(own);
        let single = reduced.filter(|reduced| reduced.single().is_some());
        let own = single.as_ref().unwrap_or(own);
        let (value, monomial, rest) = own.split()?;
        let mut made = RingPolynomial::constant(value.recip()?);
        for (variable, power) in monomial {
            made = made.times(&self.inverse_of_atom(variable)?.raised(power)?)?;
        }
        match rest.value() {
            Some(_) => Some(made),
            None => made.times(&self.inverse_of_sum(&rest)?),
        }
    }

    fn inverse_of_atom(&mut self, variable: usize) -> Made {
        let minus = Rational::from(-1);
        match self.atoms[variable].clone() {
            Atom::Exponential(argument) | Atom::ExponentialOf(argument, _) => {
                self.exponential(&argument.times_number(&minus))
            }
            Atom::Root(..) => Some(RingPolynomial::variable(variable + 1, 1)),
            Atom::Inverse(base, 1) => Some(base),
            Atom::Inverse(..) => Some(RingPolynomial::variable(variable - 1, 1)),
            Atom::Constant(Of::Inverse(base)) => Some(base),
            _ => self.inverse_of_sum(&RingPolynomial::variable(variable, 1)),
        }
    }

    /// 1/b as a variable, or as a power of 1/b^(1/n).
    fn inverse_of_sum(&mut self, base: &RingPolynomial) -> Made {
        if self.is_constant(base) {
            return Some(self.constant(Of::Inverse(base.clone())));
        }
        for (place, atom) in self.atoms.iter().enumerate() {
            let Atom::Inverse(own, order) = atom else { continue };
            let Some((value, ..)) = own.split() else { continue };
            if base.times_number(&value) == *own {
                return Some(RingPolynomial::variable(place, *order).times_number(&value));
            }
        }
        let place = self.push(Atom::Inverse(base.clone(), 1));
        Some(RingPolynomial::variable(place, 1))
    }

    /// b^(above/order) with order > 1.
    fn root(&mut self, base: &RingPolynomial, above: i64, order: u32) -> Made {
        if self.is_constant(base) {
            let root = match order {
                2 => Of::Root(base.clone()),
                _ => {
                    let share = RingPolynomial::constant(Rational::new(1, i64::from(order)));
                    Of::Function(ConstantFunction::Power(share), base.clone())
                }
            };
            let root = self.constant(root);
            return self.power(&root, &Rational::from(above));
        }
        // Square roots are functions of their own in proofs.
        if order % 2 == 1
            && let Some(argument) = self.exponent(base)
        {
            let power = Rational::new(above, i64::from(order));
            return self.exponential(&argument.times_number(&power));
        }
        // √(g³) is g √g, as g³ and g have one sign.
        if let Some((own, power)) = base.odd_root() {
            return self.power(&own, &Rational::new(above * i64::from(power), i64::from(order)));
        }
        let same = |atom: &Atom| matches!(atom, Atom::Root(own, n) if own == base && *n == order);
        let place = match self.atoms.iter().position(same) {
            Some(place) => place,
            None => {
                let place = self.push(Atom::Root(base.clone(), order));
                self.push(Atom::Inverse(base.clone(), order));
                place
            }
        };
        let (whole, rest) = (above / i64::from(order), above % i64::from(order));
        match above {
            0.. => base.raised(whole as u32)?.times(&RingPolynomial::variable(place, rest as u32)),
            _ => Some(RingPolynomial::variable(place + 1, above.unsigned_abs() as u32)),
        }
    }

    /// Whole coefficients of an argument in those before, as (variable, multiple); a new argument is
    /// added by `add`.
    fn multiples(
        &mut self,
        kind: usize,
        argument: &RingPolynomial,
        add: fn(&mut Self, &RingPolynomial) -> usize,
    ) -> Option<Vec<(usize, i64)>> {
        let basis: Vec<RingPolynomial> =
            self.arguments[kind].iter().map(|(own, _)| own.clone()).collect();
        if let Some(found) = combination(argument, &basis) {
            let mut all = Vec::new();
            for (value, (own, variable)) in found.iter().zip(&self.arguments[kind]) {
                let (above, below) = value.small_parts()?;
                if below != 1 {
                    self.divided.push(Divided { argument: own.clone(), by: below });
                    self.is_refined = true;
                    return None;
                }
                if above != 0 {
                    all.push((*variable, above));
                }
            }
            return Some(all);
        }
        let mut own = argument.clone();
        // A divided argument may have to be divided again.
        for divided in self.divided.clone() {
            if divided.argument == own {
                own = own.times_number(&Rational::new(1, divided.by));
            }
        }
        let variable = add(self, &own);
        self.arguments[kind].push((own, variable));
        self.multiples(kind, argument, add)
    }

    /// e^u.
    pub fn exponential(&mut self, argument: &RingPolynomial) -> Made {
        if argument.is_zero() {
            return Some(RingPolynomial::constant(Rational::from(1)));
        }
        if self.is_constant(argument) {
            let own = Of::Function(ConstantFunction::Exponential, argument.clone());
            return Some(self.constant(own));
        }
        let add = |ring: &mut Self, own: &RingPolynomial| ring.push(Atom::Exponential(own.clone()));
        let multiples = self.multiples(0, argument, add)?;
        if multiples.iter().any(|(_, power)| power.abs() > HIGHEST) {
            return None;
        }
        if multiples.iter().all(|(_, power)| *power > 0) {
            let powers: Monomial =
                multiples.iter().map(|(variable, power)| (*variable, *power as u32)).collect();
            return Some(RingPolynomial::term(powers, Rational::from(1)));
        }
        let (own, power) = match multiples.as_slice() {
            [(variable, power)] => (vec![(*variable, -1)], power.unsigned_abs() as u32),
            _ => (multiples.clone(), 1),
        };
        let same = |atom: &Atom| matches!(atom, Atom::ExponentialOf(_, powers) if *powers == own);
        let place = match self.atoms.iter().position(same) {
            Some(place) => place,
            None => {
                let share = Rational::new(1, i64::from(power));
                self.push(Atom::ExponentialOf(argument.times_number(&share), own))
            }
        };
        Some(RingPolynomial::variable(place, power))
    }

    /// The exponent of a product of exponentials; `None` of another polynomial.
    fn exponent(&self, own: &RingPolynomial) -> Made {
        let (monomial, value) = own.single()?;
        if !value.is_one() || monomial.is_empty() {
            return None;
        }
        let mut sum = RingPolynomial::default();
        for (variable, power) in monomial {
            let argument = match &self.atoms[*variable] {
                Atom::Exponential(argument) | Atom::ExponentialOf(argument, _) => argument,
                Atom::Constant(Of::Function(ConstantFunction::Exponential, argument)) => argument,
                _ => return None,
            };
            sum = sum.plus(argument, &Rational::from(i64::from(*power)))?;
        }
        Some(sum)
    }

    /// cos u and sin u.
    pub fn circular(&mut self, argument: &RingPolynomial) -> Option<[RingPolynomial; 2]> {
        let one = RingPolynomial::constant(Rational::from(1));
        if argument.is_zero() {
            return Some([one, RingPolynomial::default()]);
        }
        if self.is_constant(argument) {
            let own = [ConstantFunction::Cosine, ConstantFunction::Sine];
            return Some(own.map(|own| self.constant(Of::Function(own, argument.clone()))));
        }
        let add = |ring: &mut Self, own: &RingPolynomial| {
            let sine = ring.push(Atom::Sine(own.clone()));
            ring.push(Atom::Cosine(own.clone()));
            sine
        };
        let minus = Rational::from(-1);
        let mut made = [one, RingPolynomial::default()];
        for (sine, power) in self.multiples(1, argument, add)? {
            if power.abs() > HIGHEST {
                return None;
            }
            let sign = Rational::from(power.signum());
            let (c, s) = (
                RingPolynomial::variable(sine + 1, 1),
                RingPolynomial::variable(sine, 1).times_number(&sign),
            );
            for _ in 0..power.abs() {
                let [a, b] = &made;
                made = [
                    a.times(&c)?.plus(&b.times(&s)?, &minus)?,
                    a.times(&s)?.plus(&b.times(&c)?, &Rational::from(1))?,
                ];
            }
        }
        Some(made)
    }

    /// ln b.
    pub fn logarithm(&mut self, own: &RingPolynomial) -> Made {
        if let Some(argument) = self.exponent(own) {
            return Some(argument);
        }
        if self.is_constant(own) {
            return match own.value() {
                Some(value) if value.is_one() => Some(RingPolynomial::default()),
                _ => Some(self.constant(Of::Function(ConstantFunction::Logarithm, own.clone()))),
            };
        }
        self.function(
            own,
            |atom| matches!(atom, Atom::Logarithm(base, _) if base == own),
            |ring| Some(Atom::Logarithm(own.clone(), ring.inverse(own)?)),
        )
    }

    /// atan u.
    pub fn arctangent(&mut self, own: &RingPolynomial) -> Made {
        if self.is_constant(own) {
            return match own.is_zero() {
                true => Some(RingPolynomial::default()),
                false => {
                    Some(self.constant(Of::Function(ConstantFunction::Arctangent, own.clone())))
                }
            };
        }
        self.function(
            own,
            |atom| matches!(atom, Atom::Arctangent(base, _) if base == own),
            |ring| {
                let one = RingPolynomial::constant(Rational::from(1));
                let below = one.plus(&own.times(own)?, &Rational::from(1))?;
                Some(Atom::Arctangent(own.clone(), ring.inverse(&below)?))
            },
        )
    }

    /// b^e.
    pub fn general_power(&mut self, base: &RingPolynomial, exponent: &RingPolynomial) -> Made {
        if let Some(argument) = self.exponent(base) {
            return self.exponential(&argument.times(exponent)?);
        }
        if !self.is_constant(exponent) {
            let argument = self.logarithm(base)?;
            return self.exponential(&argument.times(exponent)?);
        }
        if self.is_constant(base) {
            let own = ConstantFunction::Power(exponent.clone());
            return Some(self.constant(Of::Function(own, base.clone())));
        }
        for place in 0..self.atoms.len() {
            let Atom::Power(own, other, _) = &self.atoms[place] else { continue };
            if own != base {
                continue;
            }
            let less = exponent.plus(other, &Rational::from(-1))?;
            if let Some(step) = less.value().and_then(|value| value.to_integer()) {
                let rest = self.power(base, &Rational::from(step))?;
                return RingPolynomial::variable(place, 1).times(&rest);
            }
        }
        self.function(
            base,
            |_| false,
            |ring| Some(Atom::Power(base.clone(), exponent.clone(), ring.inverse(base)?)),
        )
    }

    fn function(
        &mut self,
        of: &RingPolynomial,
        is_same: impl Fn(&Atom) -> bool,
        make: impl FnOnce(&mut Self) -> Option<Atom>,
    ) -> Made {
        if self.is_constant(of) {
            return None;
        }
        let place = match self.atoms.iter().position(is_same) {
            Some(place) => place,
            None => {
                let atom = make(self)?;
                self.push(atom)
            }
        };
        Some(RingPolynomial::variable(place, 1))
    }
}
