//! Values as formulas of a simpler form: divided into factors, and collected in the variables of the state.

use std::cell::{Cell, RefCell};

use crate::graph::{Expr, Graph, Step, record};
use crate::number::rational::Rational;
use crate::number::{BinaryOperation, UnaryFunction};

use super::balanced::balanced_sum;
use super::factored::product;
use super::normal::normalised;
use super::paired::pair_sum;
use super::polynomial::{Fraction, MOST_WORK, Polynomial, fraction};

/// Longest text.
pub(super) const MOST_LETTERS: usize = 20_000;

/// A formula that is equal to a value wherever this has a value.
pub struct SimplerForm {
    /// Text of the formula.
    pub text: String,
    /// Whether it divides by more than a number.
    pub divides: bool,
}

/// A polynomial in values whose names are given.
pub struct NamedPolynomial<'n> {
    /// Coefficients, each with the powers of the values.
    pub terms: Vec<(Rational, Vec<u32>)>,
    /// Names of the values.
    pub names: Vec<&'n str>,
}

/// A way of writing a polynomial, up to the given sign, so that it is seen never to be negative.
pub type ShownSign<'f> = &'f dyn Fn(&NamedPolynomial<'_>) -> Option<String>;

/// Writes a value as c Π f^m / q, and as Σ c x^k / q, where x are the inputs from `first` on and functions of
/// them, c depends on the inputs before alone, and nothing cancels, and as Σ k (x − y)(F(x) − F(y)); `names` are those of the inputs. Factors of odd
/// powers are written by `shown` where it can.
///
/// Empty if the value is no quotient of polynomials in inputs and functions, or if it is too large.
pub fn simpler_forms(
    graph: &Graph,
    value: Expr,
    first: usize,
    names: &[String],
    shown: ShownSign<'_>,
) -> Vec<SimplerForm> {
    let normal = normalised(graph, &[value]);
    let own = forms_of(graph, value, first, names, shown);
    let others = normal.iter().flat_map(|(graph, values)| {
        values.iter().flat_map(|value| forms_of(graph, *value, first, names, shown))
    });
    own.into_iter().chain(others).collect()
}

/// Lists the forms of a value as it is recorded.
fn forms_of(
    graph: &Graph,
    value: Expr,
    first: usize,
    names: &[String],
    shown: ShownSign<'_>,
) -> Vec<SimplerForm> {
    let Some(read) = ReadValue::of(graph, value, first, names) else { return Vec::new() };
    let divides = read.whole.below.number().is_none();
    let whole = |text: String| match divides {
        true => format!("({text})/({})", read.whole.below.text(&read.names)),
        false => text,
    };
    let forms = [
        read.factored(graph, names, shown),
        read.by_parameters(graph, names, shown),
        read.collected(),
        pair_sum(&read, graph, names),
    ];
    let balanced = balanced_sum(&read, graph);
    let found = forms.into_iter().flatten().map(whole).chain(balanced);
    found
        .map(|text| text.replace(" + -", " - "))
        .filter(|text| text.len() < MOST_LETTERS)
        .map(|text| SimplerForm { text, divides })
        .collect()
}

/// Divides a fraction by what divides both of its parts; a denominator that is a number becomes 1.
pub fn reduced(whole: Fraction) -> Option<Fraction> {
    let mut work = MOST_WORK;
    let common = whole.above.common_divisor(&whole.below, &mut work)?;
    let (above, below) = match common.number() {
        Some(_) => (whole.above, whole.below),
        None => (whole.above.over(&common, &mut work)?, whole.below.over(&common, &mut work)?),
    };
    let one = || Polynomial::constant(&Rational::from(1));
    Some(match below.number().and_then(|number| number.recip()) {
        Some(inverse) => Fraction { above: above.scaled(&inverse), below: one() },
        None => Fraction { above, below },
    })
}

/// Records a value again as a quotient in lowest terms, equal to it wherever it has a value: K/K is 1. `None` if it is no
/// quotient of polynomials in inputs and functions.
pub fn reduced_value(graph: &Graph, value: Expr) -> Option<(Graph, Expr)> {
    let (places, whole) = read_fraction(graph, value)?;
    let reached = graph.reached_from(&places);
    let (own, value) = record(graph.inputs(), |inputs| {
        let values = graph.repeated(&reached, inputs);
        whole.value(&|variable| values[*places.get(variable as usize)?])
    })
    .ok()?;
    Some((own, value?))
}

/// Reads a value as a fraction in lowest terms, with the places of its variables.
fn read_fraction(graph: &Graph, value: Expr) -> Option<(Vec<usize>, Fraction)> {
    let places: RefCell<Vec<usize>> = RefCell::default();
    let whole = fraction(graph, graph.place(value), &|at, step| {
        if !is_variable(step) {
            return None;
        }
        let mut places = places.borrow_mut();
        let index = places.iter().position(|place| *place == at).unwrap_or(places.len());
        if index == places.len() {
            places.push(at);
        }
        u32::try_from(index).ok().map(Polynomial::variable)
    })?;
    Some((places.into_inner(), reduced(whole)?))
}

/// A reduced fraction in inputs and values of functions, with the names of these.
pub(super) struct ReadValue {
    pub(super) whole: Fraction,
    /// Places of the variables of the fraction.
    pub(super) places: Vec<usize>,
    pub(super) names: Vec<String>,
    /// Whether a variable depends on the inputs from a given one on.
    pub(super) is_own: Vec<bool>,
}

impl ReadValue {
    /// Reads a quotient of polynomials in inputs, whose variables are their numbers.
    pub(super) fn of_inputs(
        graph: &Graph,
        value: Expr,
        first: usize,
        names: &[String],
    ) -> Option<Self> {
        let input = |_: usize, step: Step<'_>| match step {
            Step::Input(number) => u32::try_from(number).ok().map(Polynomial::variable),
            _ => None,
        };
        Some(Self {
            whole: reduced(fraction(graph, graph.place(value), &input)?)?,
            places: Vec::new(),
            names: names.to_vec(),
            is_own: (0..names.len()).map(|number| number >= first).collect(),
        })
    }

    pub(super) fn of(graph: &Graph, value: Expr, first: usize, names: &[String]) -> Option<Self> {
        let (places, whole) = read_fraction(graph, value)?;
        let of_state = |place: &usize| {
            let reached = graph.reached_from(&[*place]);
            let is_state = |step| matches!(step, Step::Input(number) if number >= first);
            (0..=*place).any(|at| reached[at] && is_state(graph.step(at)))
        };
        let written: Option<Vec<String>> =
            places.iter().map(|place| text(graph, *place, names)).collect();
        Some(Self {
            whole,
            names: written?,
            places: places.clone(),
            is_own: places.iter().map(of_state).collect(),
        })
    }

    /// Writes Σ c x^k.
    fn collected(&self) -> Option<String> {
        let is_own = |variable: &u32| self.is_own[*variable as usize];
        let own: Vec<u32> = self.whole.above.variables().into_iter().filter(is_own).collect();
        let power = |(variable, exponent): (&u32, &u32)| {
            (self.names[*variable as usize].clone(), false, *exponent)
        };
        let term = |(powers, coefficient): (&Vec<u32>, &Polynomial)| {
            let coefficient = match coefficient.number() {
                Some(number) => number.to_string(),
                None => format!("({})", coefficient.text(&self.names)),
            };
            product(coefficient, own.iter().zip(powers).map(power))
        };
        let terms: Vec<String> = self.whole.above.collected(&own).iter().map(term).collect();
        (!terms.is_empty()).then(|| terms.join(" + "))
    }
}

/// Reads a value as a fraction of the variables at known places.
pub(super) fn read_with(graph: &Graph, place: usize, places: &[usize]) -> Option<Fraction> {
    let missing = Cell::new(false);
    let read = fraction(graph, place, &|at, step| {
        if !is_variable(step) {
            return None;
        }
        let index = places.iter().position(|own| *own == at);
        missing.set(missing.get() || index.is_none());
        u32::try_from(index.unwrap_or_default()).ok().map(Polynomial::variable)
    });
    read.filter(|_| !missing.get())
}

/// Whether a step is read as a variable: an input, or a function that is no sum, product or whole power.
fn is_variable(step: Step<'_>) -> bool {
    match step {
        Step::Constant(_) | Step::Unary(UnaryFunction::Neg | UnaryFunction::Recip, _) => false,
        Step::Input(_) | Step::Unary(..) => true,
        Step::Binary(operation, ..) => operation == BinaryOperation::Pow,
        Step::Power(_, exponent) => exponent.to_integer().is_none(),
    }
}

/// Writes the value at a place; `None` if it is too long.
pub(super) fn text(graph: &Graph, place: usize, names: &[String]) -> Option<String> {
    let reached = graph.reached_from(&[place]);
    let mut texts: Vec<String> = Vec::with_capacity(place + 1);
    for (at, step) in graph.steps().enumerate().take(place + 1) {
        let of = |place: usize| texts[place].as_str();
        let own = match step {
            _ if !reached[at] => String::new(),
            Step::Constant(value) => format!("({value})"),
            Step::Input(number) => names.get(number)?.clone(),
            Step::Unary(function, a) => match function {
                UnaryFunction::Neg => format!("(-{})", of(a)),
                UnaryFunction::Recip => format!("(1/{})", of(a)),
                UnaryFunction::Sqrt => format!("sqrt({})", of(a)),
                UnaryFunction::Abs => format!("abs({})", of(a)),
                UnaryFunction::Exp => format!("exp({})", of(a)),
                UnaryFunction::Ln => format!("ln({})", of(a)),
                UnaryFunction::Sin => format!("sin({})", of(a)),
                UnaryFunction::Cos => format!("cos({})", of(a)),
                UnaryFunction::Atan => format!("atan({})", of(a)),
            },
            Step::Binary(operation, a, b) => match operation {
                BinaryOperation::Add => format!("({} + {})", of(a), of(b)),
                BinaryOperation::Sub => format!("({} - {})", of(a), of(b)),
                BinaryOperation::Mul => format!("({}*{})", of(a), of(b)),
                BinaryOperation::Pow => format!("({}^({}))", of(a), of(b)),
            },
            Step::Power(a, exponent) => format!("({}^({exponent}))", of(a)),
        };
        if own.len() > MOST_LETTERS {
            return None;
        }
        texts.push(own);
    }
    texts.pop()
}

#[cfg(test)]
mod tests {
    use num_dual::DualNum;

    use super::*;
    use crate::scalar::Scalar;

    /// Writes a value of a, x, y, of which the first is a parameter.
    fn forms(build: impl FnOnce(&[Expr]) -> Expr) -> Vec<String> {
        let names = ["a", "x", "y"].map(String::from);
        let (graph, value) = record(3, build).expect("records");
        simpler_forms(&graph, value, 1, &names, &|_| None)
            .into_iter()
            .map(|form| form.text)
            .collect()
    }

    #[test]
    fn values_are_divided_into_factors_and_collected() {
        let own = forms(|v| v[0] * v[1] * v[2].modulus() - v[1] * v[2].modulus() * 3.0);
        assert_eq!(own.len(), 3, "{own:?}");
        assert_eq!(own[2], "(a - 3)*x*abs(y)", "{own:?}");
        let own = forms(|v| (v[1] - 1.0) * (v[1].recip() - 1.0) * v[1]);
        assert_eq!(own[0], "-(x - 1)^2", "x cancels: {own:?}");
        let own = forms(|v| v[0] * v[1] * v[1] - v[1] * v[2] * v[0] * v[0]);
        let own = own.iter().find(|text| text.contains(" + ")).or(own.first());
        assert!(own.is_some(), "by parameters");
        let own = forms(|v| v[1].sin() / v[2] - v[0] / v[2]);
        assert!(own.iter().all(|text| text.ends_with(")/(y)")), "{own:?}");
    }
}
