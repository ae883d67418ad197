//! Factors of values that are polynomials, and linear dependence of such values.

use crate::graph::{Expr, Graph, Step};

use super::polynomial::{MOST_WORK, Polynomial, Span, fraction};
use crate::number::UnaryFunction;
use crate::number::rational::Rational;

/// Reads a value as a polynomial in the inputs: the numerator, where it is a quotient.
fn numerator(graph: &Graph, value: Expr, with_quotients: bool) -> Option<Polynomial> {
    let read = fraction(graph, graph.place(value), &|_, step| match step {
        Step::Input(input) => u32::try_from(input).ok().map(Polynomial::variable),
        _ => None,
    })?;
    if with_quotients { Some(read.above) } else { read.polynomial() }
}

/// Whether a value contains a divisor.
fn is_quotient(graph: &Graph, value: Expr) -> bool {
    let is_divided = |step: Step<'_>| match step {
        Step::Unary(UnaryFunction::Recip, _) => true,
        Step::Power(_, exponent) => exponent.is_negative(),
        _ => false,
    };
    graph.steps().zip(graph.reached([value])).any(|(step, reached)| reached && is_divided(step))
}

/// Factors of a value, as polynomials in the inputs.
pub struct Factors(Vec<Polynomial>);

impl Factors {
    /// Finds factors of which one is 0 wherever the value, a quotient of polynomials, is 0; `None` if it
    /// is a polynomial that does not fall apart.
    pub fn of(graph: &Graph, value: Expr) -> Option<Self> {
        let whole = numerator(graph, value, true)?;
        let factors = whole.factors();
        let is_whole = factors.first() == whole.monic().as_ref();
        let is_simpler = !is_whole || is_quotient(graph, value);
        (factors.len() > 1 || factors.len() == 1 && is_simpler).then_some(Self(factors))
    }

    /// Number of factors.
    pub fn count(&self) -> usize {
        self.0.len()
    }

    /// Records a factor in the recording under way.
    pub fn value(&self, index: usize, inputs: &[Expr]) -> Option<Expr> {
        self.0.get(index)?.value(&|variable: u32| inputs.get(variable as usize).copied())
    }
}

/// An equation without the last root of another one.
pub struct Rationalised {
    /// The equation A² − B²C, where the other is A + B √C.
    equation: Polynomial,
    /// C, and −A B unless B is 0: they are not negative where the other equation holds.
    facts: Vec<Polynomial>,
    /// Places of the inputs and of the roots that remain, by variable.
    places: Vec<usize>,
}

impl Rationalised {
    /// Writes a value A + B √C, with polynomials A, B and C in inputs and roots, without its last root;
    /// `None` if it is none.
    pub fn of(graph: &Graph, value: Expr) -> Option<Self> {
        let reached = graph.reached([value]);
        let steps = graph.steps().enumerate().filter(|(place, _)| reached[*place]);
        let variables = steps.filter(|(_, step)| {
            matches!(step, Step::Input(_) | Step::Unary(UnaryFunction::Sqrt, _))
        });
        let places: Vec<usize> = variables.map(|(place, _)| place).collect();
        let is_root = |place: &&usize| matches!(graph.step(**place), Step::Unary(..));
        let last = *places.iter().rfind(is_root)?;
        let Step::Unary(_, radicand) = graph.step(last) else { return None };
        let variable = |place: usize| -> Option<u32> {
            places.binary_search(&place).ok().and_then(|index| u32::try_from(index).ok())
        };
        let read =
            |place: usize| fraction(graph, place, &|at, _| variable(at).map(Polynomial::variable));
        let whole = read(graph.place(value))?.above;
        let square = read(radicand)?.polynomial()?;
        let [a, b] = whole.split(variable(last)?, &square)?;
        let mut work = MOST_WORK;
        let (equation, facts) = match b.is_zero() {
            true => (a, vec![square]),
            false => {
                let minus = Rational::from(-1);
                let other = b.times(&b, &mut work)?.times(&square, &mut work)?.scaled(&minus);
                let fact = a.times(&b, &mut work)?.scaled(&minus);
                (a.times(&a, &mut work)?.plus(&other), vec![square, fact])
            }
        };
        Some(Self { equation, facts, places })
    }

    /// Records the equation and the facts, from the values at places.
    pub fn values(&self, at: impl Fn(usize) -> Option<Expr>) -> Option<(Expr, Vec<Expr>)> {
        let of = |variable: u32| at(*self.places.get(variable as usize)?);
        let facts = self.facts.iter().map(|fact| fact.value(&of)).collect::<Option<_>>()?;
        Some((self.equation.value(&of)?, facts))
    }
}

/// Finds the place of a root whose radicand, a quotient of polynomials in inputs and in the roots before it, is 0
/// wherever these have values.
pub fn vanishing_root(graph: &Graph, reached: &[bool]) -> Option<usize> {
    let root = |place: usize| match graph.step(place) {
        Step::Unary(UnaryFunction::Sqrt, radicand) => Some(radicand),
        _ => None,
    };
    let is_variable = |place: &usize| {
        reached[*place] && (matches!(graph.step(*place), Step::Input(_)) || root(*place).is_some())
    };
    let places: Vec<usize> = (0..reached.len()).filter(is_variable).collect();
    let variable = |place: usize| -> Option<u32> {
        places.binary_search(&place).ok().and_then(|index| u32::try_from(index).ok())
    };
    let read =
        |place: usize| fraction(graph, place, &|at, _| variable(at).map(Polynomial::variable));
    let roots: Vec<(usize, usize)> =
        places.iter().filter_map(|place| Some((*place, root(*place)?))).collect();
    let vanishes = |index: usize| -> Option<bool> {
        let mut above = read(roots[index].1)?.above;
        for (place, radicand) in roots[..index].iter().rev() {
            let own = variable(*place)?;
            if above.variables().contains(&own) {
                let [even, odd] = above.split(own, &read(*radicand)?.polynomial()?)?;
                above = even.plus(&odd.times(&Polynomial::variable(own), &mut { MOST_WORK })?);
            }
        }
        Some(above.is_zero())
    };
    (1..roots.len()).find(|index| vanishes(*index) == Some(true)).map(|index| roots[index].0)
}

/// Values that are combinations of others with rational multiples.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct LinearDependence {
    /// Places of values that are 0 where all others are.
    pub implied: Vec<usize>,
    /// The first value that is a number other than 0 where those before it are 0.
    pub contradiction: Option<usize>,
}

impl LinearDependence {
    /// Finds values, among those that may be left out, that are combinations of the others left, the
    /// last ones first. Values that are no polynomials in the inputs as they stand are passed over.
    pub fn of(graph: &Graph, values: &[Expr], may_be_left_out: &[bool]) -> Self {
        let mut polynomials: Vec<Option<Polynomial>> =
            values.iter().map(|value| numerator(graph, *value, false)).collect();
        // A number is no equation between variables, and no combination explains it.
        polynomials.iter_mut().for_each(|own| {
            own.take_if(|own| own.number().is_some());
        });
        let mut before = Span::default();
        for (index, own) in polynomials.iter().enumerate() {
            let Some(own) = own else { continue };
            if before.rest(own).number().is_some_and(|number| !number.is_zero()) {
                return Self { implied: Vec::new(), contradiction: Some(index) };
            }
            before.add(own);
        }
        let mut implied = Vec::new();
        for index in (0..values.len()).rev().filter(|index| may_be_left_out[*index]) {
            let Some(own) = polynomials[index].take() else { continue };
            let mut others = Span::default();
            polynomials.iter().flatten().for_each(|other| others.add(other));
            match others.rest(&own).is_zero() {
                true => implied.push(index),
                false => polynomials[index] = Some(own),
            }
        }
        implied.reverse();
        Self { implied, contradiction: None }
    }
}

#[cfg(test)]
mod tests {
    use num_dual::DualNum;

    use super::*;
    use crate::graph::{Evaluator, Tape, record};
    use crate::proof::rng::ProofRng;

    /// Number of factors found of a value, whose product is proved to be a multiple of it.
    fn factors(build: impl FnOnce(&[Expr]) -> Expr) -> usize {
        let (graph, value) = record(3, build).expect("records");
        let Some(found) = Factors::of(&graph, value) else { return 1 };
        let reached = graph.reached([value]);
        let (graph, [product, value]) = record(3, |x| {
            let values = graph.repeated(&reached, x);
            let all = (0..found.count()).map(|index| found.value(index, x).expect("recorded"));
            let product = all.reduce(|a, b| a * b).expect("several");
            [product, values[graph.place(value)].expect("replayed")]
        })
        .expect("records");
        let tape = Tape::new(&graph, &[product, value]);
        let mut run = Evaluator::new(&tape, crate::number::exact::Exact);
        let mut both = |x: [i64; 3]| {
            run.run(&x.map(|x| Some(Rational::from(x))));
            [0, 1].map(|k| run.output(k).clone().expect("a value"))
        };
        let ([a, b], [c, d]) = (both([5, -7, 11]), both([-3, 8, 2]));
        assert_eq!(&a * &d, &c * &b, "a multiple by a number");
        found.count()
    }

    #[test]
    fn factors_that_miss_a_variable_are_found() {
        let plus = |x: Expr| x + 1.0;
        let twice = record(3, |x| x[0] * x[0] - x[0] * 2.0 + 1.0).expect("records");
        assert_eq!(factors(|x| plus(x[0]) * (x[1] * 2.0 + x[0] * x[0] - x[0] + 1.0)), 2);
        assert_eq!(factors(|x| x[0].powi(3) + x[0] * x[1] * 2.0 + x[1] * 2.0 + 1.0), 2, "as sums");
        assert_eq!(factors(|x| (x[0] * x[0] + x[1] * x[1] - 1.0) * (x[0] - 3.0)), 2);
        assert_eq!(factors(|x| (x[0] + x[1]) * (x[1] - x[2]) * (x[2] * x[0] - 5.0)), 3);
        let quotient = |x: &[Expr]| (x[0] * x[1] - x[2]) * plus(x[2]) / (x[1] - 4.0);
        let quotient = record(3, quotient).expect("records");
        let found = Factors::of(&quotient.0, quotient.1).map(|found| found.count());
        assert_eq!(found, Some(2), "above");
        assert_eq!(factors(|x| x[0] * x[0] + x[1] * x[1] - 1.0), 1);
        assert!(Factors::of(&twice.0, twice.1).is_some(), "(x − 1)²");
        assert_eq!(factors(|x| (x[0] + 1.0) * (x[0] * x[0] - 3.0)), 2, "of one variable");
        assert_eq!(factors(|x| x[0] * (x[0] + 1.0) * (x[1] * x[1] - x[1])), 4, "of one variable");
        assert_eq!(factors(|x| (x[0] + 2.0).sin() * x[1]), 1, "no polynomial");
    }

    #[test]
    fn random_products_fall_apart_and_random_sums_do_not() {
        for seed in 0..40 {
            let mut rng = ProofRng::new(seed, 17);
            let mut digit =
                move || f64::from((0..3).fold(0, |n, _| 2 * n + i32::from(rng.coin())) - 3);
            let [a, b, c, d, e, f] = std::array::from_fn(|_| digit());
            let left = move |x: &[Expr]| x[0] * x[0] + x[1] * a + x[0] * b + c + 9.0;
            let right = move |x: &[Expr]| x[2] * x[2] * x[1] + x[2] * d + x[1] * e + f + 11.0;
            assert!(factors(|x| left(x) * right(x)) >= 2, "seed {seed}");
            factors(|x| left(x) * right(x) + x[0] * x[1] * x[2]);
        }
    }

    #[test]
    fn an_equation_without_a_root_has_the_same_zeros() {
        let zeros = |build: &dyn Fn(&[Expr]) -> Expr, points: &[[i64; 2]]| -> Vec<bool> {
            let (graph, value) = record(2, |x| build(x)).expect("records");
            let other = Rationalised::of(&graph, value).expect("has a root");
            let reached = graph.reached([value]);
            let (graph, values) = record(2, |x| {
                let own = graph.repeated(&reached, x);
                let (equation, facts) = other.values(|place| own[place]).expect("recorded");
                [vec![equation], facts].concat()
            })
            .expect("records");
            let tape = Tape::new(&graph, &values);
            let mut run = Evaluator::new(&tape, crate::number::exact::Exact);
            let mut is_zero = |x: &[i64; 2]| {
                run.run(&x.map(|x| Some(Rational::from(x))));
                let value = |k: usize| run.output(k).clone().expect("a value");
                value(0).is_zero() && (1..values.len()).all(|k| !value(k).is_negative())
            };
            points.iter().map(&mut is_zero).collect()
        };
        let root = |x: &[Expr]| x[0] - x[1].sqrt();
        assert_eq!(zeros(&root, &[[3, 9], [-3, 9], [3, 8], [0, 0]]), [true, false, false, true]);
        let sum = |x: &[Expr]| x[0] + x[1].sqrt() * (x[0] - 4.0);
        assert_eq!(zeros(&sum, &[[2, 1], [-4, 1], [0, 0], [3, 9]]), [true, false, true, true]);
        // The root goes, and y is still not negative.
        let square =
            |x: &[Expr]| (x[1].sqrt() + x[0]) * (x[1].sqrt() - x[0]) + x[0] * x[0] - x[1] + x[0];
        assert_eq!(zeros(&square, &[[0, 4], [0, -4], [1, 4]]), [true, false, false]);
    }

    #[test]
    fn combinations_are_told_from_other_values() {
        let dependence = |build: &dyn Fn(&[Expr]) -> Vec<Expr>| {
            let (graph, values) = record(3, |x| build(x)).expect("records");
            LinearDependence::of(&graph, &values, &vec![true; values.len()])
        };
        let none = LinearDependence::default();
        let left_out =
            |implied: &[usize]| LinearDependence { implied: implied.to_vec(), contradiction: None };
        let [one, two, three] = [1.0, 2.0, 3.0];
        let sum = |x: &[Expr]| vec![x[0] + x[1] - one, x[1] + x[2] - two];
        let with = |x: &[Expr], more: Expr| [sum(x), vec![more]].concat();
        assert_eq!(dependence(&|x| sum(x)), none);
        assert_eq!(dependence(&|x| with(x, x[0] + x[1] * two + x[2] - three)), left_out(&[2]));
        assert_eq!(dependence(&|x| with(x, x[0] + x[1] * two + x[2] * 2.000001 - three)), none);
        let contradiction = dependence(&|x| with(x, x[0] + x[1] * two + x[2] - 4.0));
        assert_eq!(contradiction.contradiction, Some(2));
        // A multiple by a variable says nothing where the variable is 0, and the other way round.
        assert_eq!(dependence(&|x| with(x, x[0] * (x[0] + x[1] - one))), none);
        assert_eq!(dependence(&|x| with(x, x[0] - x[0] + x[1] * 0.0)), none, "no equation");
        assert_eq!(dependence(&|x| with(x, (x[0] + x[1] - one).sin())), none);
        let twice = dependence(&|x| vec![x[0] - one, x[0] * two - two, x[0] * three - three]);
        assert_eq!(twice, left_out(&[1, 2]));
    }
}
