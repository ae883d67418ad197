//! Equations without the roots in them, and roots of values that are 0.

use crate::graph::{Expr, Graph, Step};
use crate::number::UnaryFunction;
use crate::number::rational::Rational;

use super::polynomial::{MOST_WORK, Polynomial, fraction};

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

#[cfg(test)]
mod tests {
    use num_dual::DualNum;

    use super::*;
    use crate::graph::{Evaluator, Tape, record};

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
}
