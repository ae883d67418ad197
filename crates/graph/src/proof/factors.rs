//! Factors of values that are polynomials, and linear dependence of such values.

use crate::graph::{Expr, Graph, Step};

use super::exponentials::{Exponentials, Variable};
use super::polynomial::{Fraction, MOST_WORK, Polynomial, Span, fraction, fraction_of};
use crate::number::rational::Rational;
use crate::number::{BinaryOperation, UnaryFunction};
use crate::scalar::Scalar;

/// Reads a value as a polynomial in inputs and in values that are no sums and no products, by their places.
pub(super) fn polynomial(graph: &Graph, value: Expr) -> Option<Polynomial> {
    let read = fraction(graph, graph.place(value), &|at, step| {
        let is_part = match step {
            Step::Constant(_) | Step::Unary(UnaryFunction::Neg, _) => false,
            Step::Unary(UnaryFunction::Recip, a) => !matches!(graph.step(a), Step::Constant(_)),
            Step::Input(_) | Step::Unary(..) => true,
            Step::Binary(operation, ..) => operation == BinaryOperation::Pow,
            Step::Power(_, exponent) => exponent.to_integer().is_none_or(|power| power < 0),
        };
        is_part.then(|| u32::try_from(at).ok().map(Polynomial::variable)).flatten()
    })?;
    read.polynomial()
}

/// Largest number of steps of a value that may be a square.
const MOST_STEPS: usize = 80;

/// Factors of a value, as polynomials in inputs and in values of functions.
pub struct Factors {
    all: Vec<Factor>,
    variables: Vec<Variable>,
}

/// A polynomial, a sum of multiples of values at places less ln a, or A − r B.
enum Factor {
    Whole(Polynomial),
    Exponent { terms: Vec<(usize, i64)>, value: Rational },
    Difference { above: Polynomial, below: Polynomial, root: SignedRoot },
}

/// A number ± ⁿ√a with a ≥ 0.
#[derive(Clone)]
struct SignedRoot {
    is_negative: bool,
    radicand: Rational,
    index: u32,
}

impl SignedRoot {
    fn value(&self) -> Expr {
        let root = Expr::rational(&self.radicand).power(&Rational::new(1, i64::from(self.index)));
        if self.is_negative { -root } else { root }
    }
}

impl Factors {
    /// Finds factors of which one is 0 wherever the value, a quotient of polynomials in inputs and functions, is
    /// 0, none if it never is; `None` if it is a polynomial that does not fall apart.
    pub fn of(graph: &Graph, value: Expr) -> Option<Self> {
        let Read { whole, variables } = Read::of(graph, value)?;
        let mut all = whole.above.factors();
        let is_whole = all.first() == whole.above.monic().as_ref();
        let is_simpler = !is_whole || whole.below.number().is_none();
        let count = all.len();
        let is_exponential = |own: &Polynomial| match own.as_term() {
            Some((_, [(variable, _)])) => {
                matches!(variables.get(*variable as usize), Some(Variable::Exponential(_)))
            }
            _ => false,
        };
        all.retain(|own| !is_exponential(own));
        let is_divided = count > 1 || count > all.len() || count == 1 && is_simpler;
        let all = all.into_iter().map(Factor::Whole).collect();
        is_divided.then_some(Self { all, variables })
    }

    /// Finds several polynomials that are all 0 exactly where a value is 0, a sum of squares with factors of one
    /// sign; `None` if it is none.
    pub fn of_squares(graph: &Graph, value: Expr) -> Option<Self> {
        let Read { whole, variables } = Read::of(graph, value)?;
        let all = whole.polynomial()?.squares()?.into_iter().map(Factor::Whole).collect();
        Some(Self { all, variables })
    }

    /// Finds the exponent that is 0 exactly where a value c e^u + d e^v with several exponentials is: u − v − ln(−d/c), and
    /// none for −d/c < 0. `None` if it is none.
    pub fn of_exponentials(graph: &Graph, value: Expr) -> Option<Self> {
        let Read { whole, variables } = Read::of(graph, value)?;
        let above = &whole.above;
        let mut found = above.terms();
        let (Some((one, first)), Some((two, second)), None) =
            (found.next(), found.next(), found.next())
        else {
            return None;
        };
        if above.variables().len() < 2 {
            return None;
        }
        let mut terms: Vec<(usize, i64)> = Vec::new();
        for (sign, powers) in [(1, first), (-1, second)] {
            for (variable, power) in powers {
                let own = variables.get(*variable as usize)?.exponent(graph)?;
                let times = sign * i64::from(*power);
                for (place, count) in own {
                    terms.push((place, count.checked_mul(times)?));
                }
            }
        }
        let value = -&(two * &one.recip()?);
        let factor = Factor::Exponent { terms, value: value.clone() };
        let all = if value.is_negative() { Vec::new() } else { vec![factor] };
        Some(Self { all, variables })
    }

    /// Finds one or two differences of which one is 0 exactly where a value c Aⁿ + d Bⁿ with n ≥ 3 is: A − r B, and
    /// A + r B for even n, with r = ⁿ√(−d/c). `None` if it is none.
    pub fn of_powers(graph: &Graph, value: Expr) -> Option<Self> {
        let Read { whole, variables } = Read::of(graph, value)?;
        let found = whole.polynomial()?.binomial()?;
        let signs = if found.exponent % 2 == 0 {
            vec![false, true]
        } else {
            vec![found.ratio.is_negative()]
        };
        let of_sign = |is_negative: bool| {
            let root =
                SignedRoot { is_negative, radicand: found.ratio.abs(), index: found.exponent };
            Factor::Difference { above: found.above.clone(), below: found.below.clone(), root }
        };
        Some(Self { all: signs.into_iter().map(of_sign).collect(), variables })
    }

    /// Number of factors.
    pub fn count(&self) -> usize {
        self.all.len()
    }

    /// Records a factor from the values at places.
    pub fn value(&self, index: usize, at: impl Fn(usize) -> Option<Expr>) -> Option<Expr> {
        let at = &at;
        let of = |variable: u32| self.variables.get(variable as usize)?.value(at);
        Some(match self.all.get(index)? {
            Factor::Whole(own) => own.value(&of)?,
            Factor::Exponent { terms, value } => {
                let logarithm = Expr::rational(value).apply(UnaryFunction::Ln);
                let add = |sum: Expr, (place, count): &(usize, i64)| {
                    Some(sum + at(*place)? * Expr::rational(&Rational::from(*count)))
                };
                let zero = Expr::rational(&Rational::from(0));
                terms.iter().try_fold(zero, add)? - logarithm
            }
            Factor::Difference { above, below, root } => {
                above.value(&of)? - root.value() * below.value(&of)?
            }
        })
    }
}

/// A value as a quotient of polynomials in inputs and in values of functions.
pub(super) struct Read {
    pub(super) whole: Fraction,
    variables: Vec<Variable>,
}

impl Read {
    /// Reads a value; exponentials whose exponents are related are products of powers of few.
    pub(super) fn of(graph: &Graph, value: Expr) -> Option<Self> {
        let places = places_of_variables(graph, value);
        let Some(related) = Exponentials::of(graph, &places) else {
            let (whole, places) = fraction_in_functions(graph, value)?;
            return Some(Self {
                whole,
                variables: places.into_iter().map(Variable::Place).collect(),
            });
        };
        let first = places.len();
        let given = |at: usize, _: Step<'_>| {
            let index = places.binary_search(&at).ok()?;
            match related.at(at, first) {
                Some(own) => Some(own),
                None => Some(Fraction::whole(Polynomial::variable(u32::try_from(index).ok()?))),
            }
        };
        let whole = fraction_of(graph, graph.place(value), &given)?.without_common_terms()?;
        let own = places.into_iter().map(Variable::Place);
        Some(Self { whole, variables: own.chain(related.variables()).collect() })
    }
}

/// Lists the places of inputs and of values of functions in a value.
fn places_of_variables(graph: &Graph, value: Expr) -> Vec<usize> {
    let is_variable = |step: Step<'_>| match step {
        Step::Input(_) => true,
        Step::Unary(function, _) => {
            use UnaryFunction::{Atan, Cos, Exp, Ln, Sin};
            // Roots and moduli are divided by their own rules.
            matches!(function, Exp | Ln | Sin | Cos | Atan)
        }
        _ => false,
    };
    let reached = graph.reached([value]);
    let steps = graph.steps().enumerate().filter(|(place, _)| reached[*place]);
    steps.filter(|(_, step)| is_variable(*step)).map(|(place, _)| place).collect()
}

/// Reads a value as a quotient of polynomials in inputs and in values of functions, whose places are returned.
pub(super) fn fraction_in_functions(graph: &Graph, value: Expr) -> Option<(Fraction, Vec<usize>)> {
    let places = places_of_variables(graph, value);
    let variable = |place: usize| -> Option<Polynomial> {
        let index = places.binary_search(&place).ok()?;
        Some(Polynomial::variable(u32::try_from(index).ok()?))
    };
    let whole = fraction(graph, graph.place(value), &|at, _| variable(at))?;
    Some((whole, places))
}

/// Whether a value, a quotient of polynomials in inputs and functions, is the square of one times a number, or has
/// a factor as 1 − cos u, which is the square 2 sin²(u/2).
pub fn is_square(graph: &Graph, value: Expr) -> bool {
    let size = graph.reached([value]).into_iter().filter(|reached| *reached).count();
    let whole = (size <= MOST_STEPS).then(|| fraction_in_functions(graph, value)).flatten();
    let Some((whole, places)) = whole else { return false };
    let is_turn = |variable: &u32| {
        let step = places.get(*variable as usize).map(|place| graph.step(*place));
        matches!(step, Some(Step::Unary(UnaryFunction::Sin | UnaryFunction::Cos, _)))
    };
    let vanishes =
        |variable: u32| [false, true].iter().any(|own| whole.above.vanishes_at(variable, *own));
    whole.square().is_some() || whole.above.variables().into_iter().filter(is_turn).any(vanishes)
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
    /// Finds values, among those that may be left out, that are combinations of the others left, or multiples of one
    /// of them, the last ones first. All are recorded literally, and are polynomials in inputs and other values;
    /// what needs more than the others to have a value stays.
    pub fn of(graph: &Graph, values: &[Expr], may_be_left_out: &[bool]) -> Self {
        let mut polynomials: Vec<Option<Polynomial>> =
            values.iter().map(|value| polynomial(graph, *value)).collect();
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
            let is_multiple = |other: &Polynomial| own.over(other, &mut { MOST_WORK }).is_some();
            let follows =
                others.rest(&own).is_zero() || polynomials.iter().flatten().any(is_multiple);
            let left = values
                .iter()
                .enumerate()
                .filter(|(other, _)| *other != index && !implied.contains(other));
            let left: Vec<Expr> = left.map(|(_, value)| *value).collect();
            match follows && graph.left_out(&left, &[values[index]]).is_empty() {
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
    use crate::graph::{Evaluator, Tape, literally, record};
    use crate::number::rational::Rational;
    use crate::proof::rng::ProofRng;

    /// Number of factors found of a value, whose product is proved to be a multiple of it.
    fn factors(build: impl FnOnce(&[Expr]) -> Expr) -> usize {
        let (graph, value) = record(3, build).expect("records");
        let Some(found) = Factors::of(&graph, value) else { return 1 };
        let reached = graph.reached([value]);
        let (graph, [product, value]) = record(3, |x| {
            let values = graph.repeated(&reached, x);
            let all = (0..found.count())
                .map(|index| found.value(index, |place| values[place]).expect("recorded"));
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
        let function = record(3, |x| (x[0] + 2.0).exp() * x[1] - x[1]).expect("records");
        let found = Factors::of(&function.0, function.1).map(|found| found.count());
        assert_eq!(found, Some(2), "with a function");
    }

    #[test]
    fn squares_that_are_written_out_are_seen() {
        let is_square = |build: &dyn Fn(&[Expr]) -> Expr| {
            let (graph, value) = record(3, |x| build(x)).expect("records");
            super::is_square(&graph, value)
        };
        assert!(is_square(&|x| x[0] * x[0] - x[0] * x[1] * 2.0 + x[1] * x[1]), "(x − y)²");
        assert!(is_square(&|x| -x[0].cos().powi(2) + 1.0), "sin²x");
        assert!(is_square(&|x| x[0].cos() + 1.0), "2 cos²(x/2)");
        assert!(!is_square(&|x| x[0].cos() + 2.0));
        assert!(!is_square(&|x| x[0] * x[0] - x[0] * x[1] + x[1] * x[1]));
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
        // A multiple by a variable says nothing where the variable is 0, and follows everywhere.
        assert_eq!(dependence(&|x| with(x, x[0] * (x[0] + x[1] - one))), left_out(&[2]));
        assert_eq!(dependence(&|x| with(x, x[0] - x[0] + x[1] * 0.0)), none, "no equation");
        assert_eq!(dependence(&|x| with(x, (x[0] + x[1] - one).sin())), none);
        let of_functions = |x: &[Expr]| [x[0].exp() - x[2], x[1].sin() - x[0] * x[1].sqrt()];
        let third = |x: &[Expr]| {
            let [f, g] = of_functions(x);
            vec![f, g, f * two - g * three]
        };
        assert_eq!(dependence(&third), left_out(&[2]), "in functions");
        let more = |x: &[Expr]| {
            let [f, g] = of_functions(x);
            vec![f, g, literally(|| f * two - g * three + x[2].ln() - x[2].ln())]
        };
        assert_eq!(dependence(&more), left_out(&[1]), "the last one needs z > 0");
        let twice = dependence(&|x| vec![x[0] - one, x[0] * two - two, x[0] * three - three]);
        assert_eq!(twice, left_out(&[1, 2]));
    }
}
