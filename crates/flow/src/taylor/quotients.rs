//! Products in which quotients are functions of their own: x/|x| is a sign, quotients of exponential
//! functions are tanh u or 1/(1 + eᵘ), and u/(1 − e⁻ᵘ) has a value at u = 0.
//!
//! A Taylor program has a row s = ±1 for the sign of x, which is constant over a step, and |x| is s x.
//! Quotients of both, as in slopes of |x|, are s alone, also where x is 0.

use crate::taylor::removable::{Germs, Removable};
use crate::taylor::saturating::{Saturating, area, exponent, hyperbolic, logistic};
use liouville::graph::{Expr, Graph, Step};
use liouville::number::rational::Rational;
use liouville::number::{BinaryOperation, UnaryFunction};

/// Largest number of factors of a product that is looked at.
const MOST_FACTORS: usize = 64;

/// A product c Π f^n over the places of a graph.
#[derive(Clone, Debug)]
pub(super) struct Product {
    pub(super) coefficient: Rational,
    pub(super) factors: Vec<(usize, i32)>,
    /// Whether a factor is that of a divisor too, and is left out.
    cancels: bool,
}

impl Product {
    /// Writes the step at a place as a product of steps that are none.
    fn of(graph: &Graph, place: usize) -> Option<Self> {
        let mut product =
            Self { coefficient: Rational::from(1), factors: Vec::new(), cancels: false };
        product.multiply(graph, place, 1)?;
        Some(product)
    }

    fn multiply(&mut self, graph: &Graph, place: usize, power: i32) -> Option<()> {
        match graph.step(place) {
            Step::Constant(value) => {
                let value = if power > 0 { value.clone() } else { value.recip()? };
                self.coefficient = &self.coefficient * &value;
            }
            Step::Unary(UnaryFunction::Neg, a) => {
                self.coefficient = -&self.coefficient;
                self.multiply(graph, a, power)?;
            }
            Step::Unary(UnaryFunction::Recip, a) => self.multiply(graph, a, -power)?,
            Step::Binary(BinaryOperation::Mul, a, b) => {
                self.multiply(graph, a, power)?;
                self.multiply(graph, b, power)?;
            }
            _ => self.add(place, power),
        }
        (self.factors.len() <= MOST_FACTORS).then_some(())
    }

    fn add(&mut self, place: usize, power: i32) {
        match self.factors.iter_mut().find(|(own, _)| *own == place) {
            Some((_, own)) => {
                self.cancels |= (*own > 0) != (power > 0);
                *own += power;
            }
            None => self.factors.push((place, power)),
        }
        self.factors.retain(|(_, power)| *power != 0);
    }

    /// Whether all factors of this product, to the power ±1, are among those of another.
    fn is_in(&self, other: &Self, power: i32) -> bool {
        let meets = |(factor, own): &(usize, i32)| other.power(*factor) * power * own >= own * own;
        !self.factors.is_empty() && self.factors.iter().all(meets)
    }

    fn power(&self, place: usize) -> i32 {
        self.factors.iter().find(|(own, _)| *own == place).map_or(0, |(_, power)| *power)
    }
}

/// A factor that stands for a quotient.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Factor {
    /// Sign of the step at a place.
    Sign(usize),
    /// Function of the step at a place.
    Saturating(Saturating, usize),
    /// eᵘ/(1 + eᵘ), u the step at a place.
    Rising(usize),
}

impl Factor {
    fn argument(self) -> usize {
        match self {
            Factor::Sign(place) | Factor::Saturating(_, place) | Factor::Rising(place) => place,
        }
    }
}

/// A product with functions in place of quotients.
#[derive(Clone, Debug)]
pub(super) struct Simpler {
    pub(super) rest: Product,
    pub(super) factors: Vec<Factor>,
    /// Quotients with limits where their divisors are 0.
    pub(super) limits: Vec<Removable>,
    /// Whether the product jumps where a sign changes, as far as its form shows.
    pub(super) jumps: bool,
}

impl Simpler {
    /// The product at a place, before anything is replaced.
    fn whole(graph: &Graph, place: usize) -> Option<Self> {
        let is_product = matches!(
            graph.step(place),
            Step::Binary(BinaryOperation::Mul, ..) | Step::Unary(UnaryFunction::Recip, _)
        );
        let rest = Product::of(graph, place).filter(|_| is_product)?;
        Some(Self { rest, factors: Vec::new(), limits: Vec::new(), jumps: false })
    }

    /// Replaces quotients whose limits are proved. Nothing may cancel, for it is as written that the
    /// field has a value.
    fn proved(germs: &mut Germs<'_>, place: usize) -> Option<Self> {
        let mut simpler = Self::whole(germs.graph, place).filter(|own| !own.rest.cancels)?;
        simpler.limits(germs);
        let is_proved = simpler.limits.iter().all(|own| own.proved.is_some());
        (is_proved && !simpler.limits.is_empty()).then_some(simpler)
    }

    /// Replaces the quotients in the product at a place. `None` where there are none.
    pub(super) fn of(germs: &mut Germs<'_>, place: usize) -> Option<Self> {
        let graph = germs.graph;
        let mut simpler = Self::whole(graph, place)?;
        simpler.signs(graph)?;
        let has_roots = simpler.roots(graph)?;
        simpler.limits(germs);
        simpler.saturating(graph);
        let is_simpler = has_roots || !simpler.factors.is_empty() || !simpler.limits.is_empty();
        is_simpler.then_some(simpler)
    }

    /// Cancels moduli and their arguments.
    fn signs(&mut self, graph: &Graph) -> Option<()> {
        let rest = &mut self.rest;
        for (modulus, power) in rest.factors.clone() {
            let Step::Unary(UnaryFunction::Abs, a) = graph.step(modulus) else { continue };
            let argument = Product::of(graph, a)?;
            // |x|⁻¹ x and |x| x⁻¹
            let toward = -power.signum();
            for _ in 0..power.unsigned_abs() {
                if !argument.is_in(rest, toward) {
                    break;
                }
                rest.add(modulus, toward);
                for (factor, own) in &argument.factors {
                    rest.add(*factor, -toward * own);
                }
                let scale = argument.coefficient.clone();
                let scale = if toward > 0 { scale.recip()? } else { scale };
                rest.coefficient = &rest.coefficient * &scale;
                let stays = argument.factors.iter().all(|(factor, _)| rest.power(*factor) > 0);
                self.factors.push(Factor::Sign(a));
                self.jumps |= !stays && rest.power(modulus) <= 0;
            }
        }
        Some(())
    }

    /// Writes x/√x as √x where x contains a modulus: max(x, 0) is 0 for a while. Returns whether there is
    /// one.
    fn roots(&mut self, graph: &Graph) -> Option<bool> {
        let (rest, mut found) = (&mut self.rest, false);
        for (root, power) in rest.factors.clone().into_iter().filter(|(_, power)| *power < 0) {
            let Step::Unary(UnaryFunction::Sqrt, a) = graph.step(root) else { continue };
            let argument = Product::of(graph, a)?;
            if !graph
                .reached_from(&[a])
                .iter()
                .enumerate()
                .any(|(place, is_part)| *is_part && modulus_at(graph, place).is_some())
            {
                continue;
            }
            for _ in 0..power.unsigned_abs() {
                if rest.power(root) >= 0 || !argument.is_in(rest, 1) {
                    break;
                }
                rest.add(root, 2);
                for (factor, own) in &argument.factors {
                    rest.add(*factor, -own);
                }
                rest.coefficient = &rest.coefficient * &argument.coefficient.recip()?;
                found = true;
            }
        }
        Some(found)
    }

    /// Takes out quotients that have limits where their divisors are 0.
    fn limits(&mut self, germs: &mut Germs<'_>) {
        while let Some(found) = Removable::of(germs, &self.rest.factors) {
            found.factors.iter().for_each(|(place, power)| self.rest.add(*place, -power));
            self.limits.push(found);
        }
    }

    /// Replaces quotients of exponential functions.
    fn saturating(&mut self, graph: &Graph) {
        let divisors = self.rest.factors.clone().into_iter().filter(|(_, power)| *power < 0);
        for (sum, _) in divisors {
            if let Some((false, exponents)) = hyperbolic(graph, sum) {
                self.hyperbolic(graph, sum, exponents);
            } else if let Some(exponent) = logistic(graph, sum) {
                self.logistic(graph, sum, exponent);
            }
        }
    }

    /// Replaces (eᵘ − e⁻ᵘ)/(eᵘ + e⁻ᵘ) = tanh u and 1/(eᵘ + e⁻ᵘ) = 1/(2 cosh u).
    fn hyperbolic(&mut self, graph: &Graph, cosine: usize, exponents: [usize; 2]) {
        let [u, opposite] = exponents;
        for (sine, power) in self.rest.factors.clone() {
            let Some((true, [first, _])) = hyperbolic(graph, sine) else { continue };
            if first != u && first != opposite {
                continue;
            }
            for _ in 0..power.min(-self.rest.power(cosine)).max(0) {
                self.rest.add(sine, -1);
                self.rest.add(cosine, 1);
                self.factors.push(Factor::Saturating(Saturating::Tanh, first));
            }
        }
        while self.rest.power(cosine) <= -2 {
            self.rest.add(cosine, 2);
            self.rest.coefficient = &self.rest.coefficient * &Rational::new(1, 4);
            self.factors.push(Factor::Saturating(Saturating::Fall, u));
        }
        if self.rest.power(cosine) == -1 {
            self.rest.add(cosine, 1);
            self.rest.coefficient = &self.rest.coefficient * &Rational::new(1, 2);
            self.factors.push(Factor::Saturating(Saturating::Bell, u));
        }
    }

    /// Replaces eᵘ/(1 + eᵘ) and 1/(1 + eᵘ).
    fn logistic(&mut self, graph: &Graph, sum: usize, u: usize) {
        for (factor, power) in self.rest.factors.clone() {
            if exponent(graph, factor) != Some(u) {
                continue;
            }
            for _ in 0..power.min(-self.rest.power(sum)).max(0) {
                self.rest.add(factor, -1);
                self.rest.add(sum, 1);
                self.factors.push(Factor::Rising(u));
            }
        }
        while self.rest.power(sum) < 0 {
            self.rest.add(sum, 1);
            self.factors.push(Factor::Saturating(Saturating::Logistic, u));
        }
    }

    /// Places on which the product depends.
    fn arguments(&self) -> impl Iterator<Item = usize> {
        let factors = self.factors.iter().map(|factor| factor.argument());
        let limits = self.limits.iter().flat_map(Removable::arguments);
        self.rest.factors.iter().map(|(place, _)| *place).chain(factors).chain(limits)
    }
}

/// Steps of a graph that some values need, and the products among them that have simpler forms.
pub(super) struct Needed {
    pub(super) places: Vec<bool>,
    pub(super) simpler: Vec<Option<Simpler>>,
}

impl Needed {
    /// Finds what these values need as written, but for quotients whose limits are proved.
    pub(super) fn exactly(graph: &Graph, wanted: &[usize]) -> Self {
        Self::with(graph, wanted, Simpler::proved, |_| None)
    }

    /// Finds what these values need where quotients have rules of their own.
    pub(super) fn by(graph: &Graph, wanted: &[usize]) -> Self {
        let argument = |place: usize| {
            // 1/|x| is made from 1/x.
            let modulus = match graph.step(place) {
                Step::Unary(UnaryFunction::Recip, a) => modulus_at(graph, a),
                _ => None,
            };
            let sine = hyperbolic(graph, place).filter(|(is_sine, _)| *is_sine);
            modulus.or(sine.map(|(_, [u, _])| u)).or(area(graph, place).map(|own| own.1))
        };
        Self::with(graph, wanted, Simpler::of, argument)
    }

    /// The same with the products that `simplify` knows, and the steps that need one argument alone.
    fn with(
        graph: &Graph,
        wanted: &[usize],
        simplify: impl Fn(&mut Germs<'_>, usize) -> Option<Simpler>,
        argument: impl Fn(usize) -> Option<usize>,
    ) -> Self {
        let (mut places, mut simpler) = (graph.reached_from(wanted), vec![None; graph.len()]);
        let is_part = |place: usize| {
            let step = graph.step(place);
            let is_algebraic = |function| {
                matches!(function, UnaryFunction::Neg | UnaryFunction::Recip | UnaryFunction::Sqrt)
            };
            matches!(step, Step::Unary(function, _) if !is_algebraic(function))
        };
        if !(0..graph.len()).any(|place| places[place] && is_part(place)) {
            return Self { places, simpler };
        }
        let mut germs = Germs::new(graph);
        places.fill(false);
        wanted.iter().for_each(|place| places[*place] = true);
        for place in (0..graph.len()).rev() {
            if !places[place] {
                continue;
            }
            simpler[place] = simplify(&mut germs, place);
            match &simpler[place] {
                Some(own) => own.arguments().for_each(|argument| places[argument] = true),
                None => match argument(place) {
                    Some(argument) => places[argument] = true,
                    None => {
                        let own = graph.step(place);
                        own.arguments().for_each(|argument| places[argument] = true);
                    }
                },
            }
        }
        Self { places, simpler }
    }
}

/// Whether one of some values jumps where a sign changes, as far as their form shows.
pub(crate) fn jumps(graph: &Graph, values: &[Expr]) -> bool {
    let wanted: Vec<usize> = values.iter().map(|value| graph.place(*value)).collect();
    Needed::by(graph, &wanted).simpler.iter().flatten().any(|own| own.jumps)
}

/// Argument of the step at a place if that is a modulus.
pub(super) fn modulus_at(graph: &Graph, place: usize) -> Option<usize> {
    match graph.step(place) {
        Step::Unary(UnaryFunction::Abs, a) => Some(a),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use liouville::graph::record;
    use liouville::scalar::Scalar;
    use num_dual::DualNum;

    fn simpler(build: impl Fn(Expr, Expr) -> Expr) -> Option<Simpler> {
        let (graph, value) = record(2, |x| build(x[0], x[1])).expect("records");
        Simpler::of(&mut Germs::new(&graph), graph.place(value))
    }

    #[test]
    fn quotients_of_moduli_are_signs() {
        let two = || Expr::rational(&Rational::from(2));
        let sign = simpler(|x, y| y * (x / x.modulus())).expect("a sign");
        assert!(sign.jumps && sign.rest.factors.len() == 1, "{sign:?}");
        let sign = simpler(|x, y| (x - y).modulus() / (x - y) * x).expect("a sign of x − y");
        assert!(sign.jumps, "{sign:?}");
        let sign = simpler(|x, y| two() * x * y / (x * y).modulus()).expect("a sign of x y");
        assert!(sign.jumps && sign.rest.factors.is_empty(), "{sign:?}");
        assert_eq!(sign.rest.coefficient, Rational::from(2));
        let sign = simpler(|x, _| x * x / x.modulus()).expect("s x");
        assert!(!sign.jumps, "{sign:?}");
        assert!(
            simpler(|x, y| y / x.modulus()).is_none() && simpler(|x, y| x * y.modulus()).is_none()
        );
    }

    #[test]
    fn quotients_of_exponentials_are_functions() {
        let one = || Expr::rational(&Rational::from(1));
        let found = |build: &dyn Fn(Expr, Expr) -> Expr| {
            let (graph, value) = record(2, |x| build(x[0], x[1])).expect("records");
            Simpler::of(&mut Germs::new(&graph), graph.place(value))
                .map(|own| (own.factors.len(), own.rest))
        };
        let (count, rest) = found(&|x, y| (x - y).tanh() * y).expect("a tangent");
        assert!(count == 1 && rest.factors.len() == 1 && rest.coefficient.is_one(), "{rest:?}");
        let (count, rest) = found(&|x, _| (x.cosh() * x.cosh()).recip()).expect("its slope");
        assert!(count == 1 && rest.factors.is_empty() && rest.coefficient.is_one(), "{rest:?}");
        for build in [
            &(|x: Expr, _: Expr| (one() + x.exp()).recip()) as &dyn Fn(Expr, Expr) -> Expr,
            &|x, _| x.exp() / (one() + x.exp()),
        ] {
            let (count, rest) = found(build).expect("a logistic function");
            assert!(count == 1 && rest.factors.is_empty() && rest.coefficient.is_one(), "{rest:?}");
        }
        let (count, rest) = found(&|x, y| x.sinh() / y.cosh()).expect("1/cosh y");
        assert!(count == 1 && rest.factors.len() == 1, "of two arguments: {rest:?}");
        assert!(rest.coefficient == Rational::new(1, 2), "{rest:?}");
    }
}
