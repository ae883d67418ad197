//! Orbits modulo a prime: Taylor series of a field, coefficient by coefficient, and points of a map.
//!
//! x' = f(x) with f made of + − × ÷ and powers. Coefficient k + 1 of x follows from coefficient k of
//! f(x), and this from those of x up to k, operation by operation: a run to order n takes n²/2
//! products for each product in f.

use liouville::case::Case;
use liouville::graph::{Graph, Step};
use liouville::number::prime::Modulus;
use liouville::number::rational::Rational;
use liouville::number::{BinaryOperation, UnaryFunction};

use super::super::terms::{recorded, varying};
use super::super::{Halt, SearchError};

/// One operation of a field; arguments are places of earlier operations.
#[derive(Clone, Debug)]
enum Rule {
    Constant(Rational),
    Parameter(usize),
    Variable(usize),
    Minus(usize),
    Inverse(usize),
    Sum(usize, usize),
    Difference(usize, usize),
    Product(usize, usize),
    Power(usize, Rational),
}

/// A field whose orbits have Taylor series modulo a prime, or a map whose orbits have points there.
#[derive(Clone, Debug)]
pub struct Flow {
    steps: Vec<Rule>,
    /// Whether an operation depends on the state.
    varies: Vec<bool>,
    rates: Vec<usize>,
    /// Whether it is a map: the rates are the components of the image.
    pub is_map: bool,
    /// Whether the field is a rational function of the state and the parameters.
    pub is_rational: bool,
    /// Whether it is one of the state, with roots of parameters as coefficients.
    pub is_rational_in_state: bool,
}

impl Flow {
    /// Records the field of a case; `None` if it contains functions that prime fields lack.
    pub fn of(case: &Case) -> Result<Option<Self>, SearchError> {
        let model = &case.model;
        let (graph, rates) = recorded(case, |jet| jet.phase.field().to_vec())?;
        if graph.inputs() > model.free_components() + model.dimension() {
            return Ok(None);
        }
        let reached = graph.reached(rates.iter().copied());
        let places = rates.iter().map(|rate| graph.place(*rate)).collect();
        let read = Self::read(&graph, &reached, places, model.free_components());
        Ok(read.map(|own| Self { is_map: model.system.is_map(), ..own }))
    }

    /// The functions in the field of a case, or in the map, that prime fields lack, in words.
    pub fn missing(case: &Case) -> Result<String, SearchError> {
        let (graph, rates) = recorded(case, |jet| jet.phase.field().to_vec())?;
        let reached = graph.reached(rates);
        let name = |step: Step<'_>| match step {
            Step::Unary(UnaryFunction::Exp, _) => Some("exp"),
            Step::Unary(UnaryFunction::Ln, _) => Some("ln"),
            Step::Unary(UnaryFunction::Sin, _) => Some("sin"),
            Step::Unary(UnaryFunction::Cos, _) => Some("cos"),
            Step::Unary(UnaryFunction::Atan, _) => Some("atan"),
            Step::Unary(UnaryFunction::Abs, _) => Some("|x|"),
            Step::Binary(BinaryOperation::Pow, ..) => Some("x^y"),
            Step::Input(_) | Step::Constant(_) | Step::Unary(..) => None,
            Step::Binary(..) | Step::Power(..) => None,
        };
        let steps = graph.steps().zip(reached).filter(|(_, is_reached)| *is_reached);
        let mut names: Vec<&str> = Vec::new();
        for own in steps.filter_map(|(step, _)| name(step)) {
            if !names.contains(&own) {
                names.push(own);
            }
        }
        let inputs = case.model.free_components() + case.model.dimension();
        names.extend((graph.inputs() > inputs).then_some("∫"));
        Ok(match names.split_last() {
            Some((last, [])) => last.to_string(),
            Some((last, others)) => format!("{} and {last}", others.join(", ")),
            None => String::new(),
        })
    }

    /// Elementary steps of the series of an orbit up to this order: one for each product of two
    /// coefficients, and some for each coefficient, whose sums are reduced and kept.
    pub fn steps(&self, orders: usize) -> f64 {
        const EACH: f64 = 8.0;
        let is_product =
            |rule: &&Rule| matches!(rule, Rule::Product(..) | Rule::Inverse(_) | Rule::Power(..));
        let products = self.steps.iter().filter(is_product).count() as f64;
        let (rules, orders) = (self.steps.len() as f64, orders as f64);
        EACH * rules * orders + products * orders.powi(2) / 2.0
    }

    fn read(
        graph: &Graph,
        reached: &[bool],
        places: Vec<usize>,
        parameters: usize,
    ) -> Option<Self> {
        let (mut is_rational, mut is_rational_in_state) = (true, true);
        let varies = varying(graph, parameters);
        let mut at = vec![0; graph.len()];
        let (mut steps, mut steps_vary) = (Vec::new(), Vec::new());
        for (place, step) in graph.steps_at(reached) {
            let own = match step {
                Step::Constant(value) => Rule::Constant(value.clone()),
                Step::Input(input) if input < parameters => Rule::Parameter(input),
                Step::Input(input) => Rule::Variable(input - parameters),
                Step::Unary(UnaryFunction::Neg, a) => Rule::Minus(at[a]),
                Step::Unary(UnaryFunction::Recip, a) => Rule::Inverse(at[a]),
                Step::Unary(UnaryFunction::Sqrt, a) => {
                    is_rational = false;
                    is_rational_in_state &= !varies[a];
                    Rule::Power(at[a], Rational::new(1, 2))
                }
                Step::Unary(..) | Step::Binary(BinaryOperation::Pow, ..) => return None,
                Step::Binary(BinaryOperation::Add, a, b) => Rule::Sum(at[a], at[b]),
                Step::Binary(BinaryOperation::Sub, a, b) => Rule::Difference(at[a], at[b]),
                Step::Binary(BinaryOperation::Mul, a, b) => Rule::Product(at[a], at[b]),
                Step::Power(a, exponent) => {
                    let is_whole = exponent.parts().1 == 1.into();
                    is_rational &= is_whole;
                    is_rational_in_state &= is_whole || !varies[a];
                    Rule::Power(at[a], exponent.clone())
                }
            };
            at[place] = steps.len();
            steps.push(own);
            steps_vary.push(varies[place]);
        }
        let rates = places.into_iter().map(|place| at[place]).collect();
        let varies = steps_vary;
        Some(Self { steps, varies, rates, is_map: false, is_rational, is_rational_in_state })
    }

    /// Computes the coefficients of order below `orders` of the orbit from a state, or as many points
    /// of the orbit of a map; `None` where there is no value or no series.
    pub fn orbit(
        &self,
        m: &Modulus,
        parameters: &[u64],
        state: &[u64],
        orders: usize,
        halt: &Halt,
    ) -> Result<Option<Vec<Vec<u64>>>, SearchError> {
        match self.is_map {
            true => self.points(m, parameters, state, orders, halt),
            false => self.series(m, parameters, state, orders, halt),
        }
    }

    /// Whether the rates, or the image, have values at a state: each root has one at half of the states.
    pub fn has_values(&self, m: &Modulus, parameters: &[u64], state: &[u64], halt: &Halt) -> bool {
        let image = self.points(m, parameters, state, 2, halt);
        image.is_ok_and(|image| image.is_some())
    }

    /// Computes points of the orbit of a map, component by component.
    fn points(
        &self,
        m: &Modulus,
        parameters: &[u64],
        state: &[u64],
        count: usize,
        halt: &Halt,
    ) -> Result<Option<Vec<Vec<u64>>>, SearchError> {
        let Some(constants) = self.constants(m, parameters) else { return Ok(None) };
        let mut orbit: Vec<Vec<u64>> = state.iter().map(|x| vec![*x]).collect();
        let mut values = vec![0; self.steps.len()];
        for k in 0..count.saturating_sub(1) {
            if k % 64 == 63 {
                halt.check()?;
                halt.meter().set(k, count);
            }
            for (place, step) in self.steps.iter().enumerate() {
                let value = match step {
                    Rule::Constant(_) | Rule::Parameter(_) => Some(constants[place]),
                    Rule::Variable(i) => Some(orbit[*i][k]),
                    Rule::Minus(a) => Some(m.sub(0, values[*a])),
                    Rule::Sum(a, b) => Some(m.add(values[*a], values[*b])),
                    Rule::Difference(a, b) => Some(m.sub(values[*a], values[*b])),
                    Rule::Product(a, b) => Some(m.mul(values[*a], values[*b])),
                    Rule::Inverse(a) => (values[*a] != 0).then(|| m.inverse(values[*a])),
                    Rule::Power(a, exponent) => power(m, values[*a], exponent),
                };
                let Some(value) = value else { return Ok(None) };
                values[place] = value;
            }
            for (variable, image) in orbit.iter_mut().zip(&self.rates) {
                variable.push(values[*image]);
            }
        }
        Ok(Some(orbit))
    }

    fn series(
        &self,
        m: &Modulus,
        parameters: &[u64],
        state: &[u64],
        orders: usize,
        halt: &Halt,
    ) -> Result<Option<Vec<Vec<u64>>>, SearchError> {
        let mut orbit: Vec<Vec<u64>> = Vec::with_capacity(state.len());
        for x in state {
            let mut series = Vec::with_capacity(orders.max(1));
            series.push(*x);
            orbit.push(series);
        }
        let Some(constants) = self.constants(m, parameters) else { return Ok(None) };
        let Some(exponents) = self.exponents(m) else { return Ok(None) };
        // The coefficients of each operation, one operation after another.
        let mut values: Vec<u64> = vec![0; self.steps.len() * orders];
        let at = |place: usize| place * orders;
        let mut inverses: Vec<u64> = vec![0; self.steps.len()];
        // Coefficients times their orders, of what is raised to a power.
        let mut slopes: Vec<Vec<u64>> = vec![Vec::new(); self.steps.len()];
        let by_order = m.inverses_up_to(orders);
        for k in 0..orders.saturating_sub(1) {
            if k % 64 == 63 {
                halt.check()?;
                halt.meter().set(k, orders);
            }
            for (place, step) in self.steps.iter().enumerate() {
                if k > 0 && !self.varies[place] {
                    continue;
                }
                let own = at(place);
                let next = match step {
                    Rule::Constant(_) | Rule::Parameter(_) => constants[place],
                    Rule::Variable(i) => orbit[*i][k],
                    Rule::Minus(a) => m.sub(0, values[at(*a) + k]),
                    Rule::Sum(a, b) => m.add(values[at(*a) + k], values[at(*b) + k]),
                    Rule::Difference(a, b) => m.sub(values[at(*a) + k], values[at(*b) + k]),
                    // All coefficients of a constant but the first are 0.
                    Rule::Product(a, b) if !self.varies[*a] => {
                        m.mul(values[at(*a)], values[at(*b) + k])
                    }
                    Rule::Product(a, b) if !self.varies[*b] => {
                        m.mul(values[at(*a) + k], values[at(*b)])
                    }
                    Rule::Product(a, b) => {
                        m.convolved(&values[at(*a)..=at(*a) + k], &values[at(*b)..=at(*b) + k])
                    }
                    Rule::Inverse(a) | Rule::Power(a, _) if k == 0 => {
                        let start = values[at(*a)];
                        let power = match step {
                            Rule::Power(_, exponent) => power(m, start, exponent),
                            _ => (start != 0).then(|| m.inverse(start)),
                        };
                        let Some(power) = power.filter(|_| start != 0) else { return Ok(None) };
                        inverses[place] = m.inverse(start);
                        power
                    }
                    Rule::Inverse(a) => {
                        let x = &values[at(*a) + 1..=at(*a) + k];
                        let sum = m.convolved(x, &values[own..own + k]);
                        m.sub(0, m.mul(sum, inverses[place]))
                    }
                    // y = x^q: x y' = q x' y, so that k x₀ y_k = Σ (q j − (k − j)) x_j y_{k−j}.
                    Rule::Power(a, _) => {
                        let (x, y) = (&values[at(*a) + 1..=at(*a) + k], &values[own..own + k]);
                        let order = m.integer(k as u64);
                        slopes[place].push(m.mul(order, x[k - 1]));
                        let by_slopes = m.convolved(&slopes[place], y);
                        let all = m.mul(m.add(exponents[place], m.one()), by_slopes);
                        let sum = m.sub(all, m.mul(order, m.convolved(x, y)));
                        m.mul(sum, m.mul(inverses[place], by_order[k]))
                    }
                };
                values[own + k] = next;
            }
            for (variable, rate) in orbit.iter_mut().zip(&self.rates) {
                variable.push(m.mul(values[at(*rate) + k], by_order[k + 1]));
            }
        }
        Ok(Some(orbit))
    }

    fn constants(&self, m: &Modulus, parameters: &[u64]) -> Option<Vec<u64>> {
        let value = |step: &Rule| match step {
            Rule::Constant(value) => m.rational(value),
            Rule::Parameter(index) => parameters.get(*index).copied(),
            _ => Some(0),
        };
        self.steps.iter().map(value).collect()
    }

    fn exponents(&self, m: &Modulus) -> Option<Vec<u64>> {
        let value = |step: &Rule| match step {
            Rule::Power(_, exponent) => m.rational(exponent),
            _ => Some(0),
        };
        self.steps.iter().map(value).collect()
    }
}

/// Computes x^q for x ≠ 0, if the field has it.
fn power(m: &Modulus, x: u64, exponent: &Rational) -> Option<u64> {
    let (above, below) = exponent.small_parts()?;
    let base = match below {
        1 => x,
        2 => m.root(x)?,
        _ => return m.odd_power(x, exponent),
    };
    let raised = m.power(base, above.unsigned_abs());
    (x != 0).then(|| if above < 0 { m.inverse(raised) } else { raised })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn flow(field: &str, state: &str) -> Flow {
        let text = format!("title='x'\nsystem='field'\n[state]\n{state}\n[field]\n{field}\n");
        let case = Case::parse(&text, &[]).expect("a case");
        Flow::of(&case).expect("recorded").expect("it has series")
    }

    #[test]
    fn orbits_of_a_map_are_its_points() {
        let text =
            "title='x'\nsystem='map'\n[state]\nx='1..2'\ny='1..2'\n[map]\nx='y'\ny='(1 + y)/x'\n";
        let case = Case::parse(text, &[]).expect("a case");
        let map = Flow::of(&case).expect("recorded").expect("it has points");
        assert!(map.is_map && map.is_rational);
        let m = Modulus::new(2_305_843_009_213_693_951);
        let [three, seven] = [3, 7].map(|n| m.integer(n));
        let orbit = map.orbit(&m, &[], &[three, seven], 6, &Halt::default()).expect("no halt");
        let orbit = orbit.expect("points");
        let eight_thirds = m.mul(m.integer(8), m.inverse(three));
        assert_eq!(orbit[1][..2], [seven, eight_thirds]);
        assert_eq!((orbit[0][5], orbit[1][5]), (three, seven), "Gauss: the period is 5");
        let none = map.orbit(&m, &[], &[0, seven], 6, &Halt::default());
        assert_eq!(none.expect("no halt"), None, "1/0");
    }

    #[test]
    fn orbits_are_the_known_series() {
        let m = Modulus::new(2_305_843_009_213_693_951);
        let two = m.integer(2);
        // x' = x²: x = 2/(1 − 2s)
        let square = flow("\"x'\" = \"x²\"", "x = \"1..2\"");
        let orbit = square.orbit(&m, &[], &[two], 6, &Halt::default()).expect("no halt");
        let expected: Vec<u64> = (1..=6).map(|k| m.integer(1 << k)).collect();
        assert_eq!(orbit, Some(vec![expected]), "2, 4, 8, …");
        // x' = 1/y, y' = 1: with y = 1 + s, x = x₀ + ln y, and with √y the root of 1 + s
        let inverse = flow("\"x'\" = \"1/y\"\n\"y'\" = \"1\"", "x = \"1..2\"\ny = \"1..2\"");
        let orbit = inverse.orbit(&m, &[], &[0, m.one()], 5, &Halt::default());
        let orbit = orbit.expect("no halt").expect("a series");
        let third = m.inverse(m.integer(3));
        assert_eq!(orbit[0][3], third, "s³/3");
        assert!(inverse.is_rational, "no root");
        let root = flow("\"x'\" = \"√y\"\n\"y'\" = \"1\"", "x = \"1..2\"\ny = \"1..2\"");
        let orbit = root.orbit(&m, &[], &[0, m.one()], 5, &Halt::default());
        let orbit = orbit.expect("no halt").expect("a series");
        assert_eq!(m.mul(orbit[0][2], m.integer(4)), m.one(), "√(1 + s) = 1 + s/2 − …");
        assert!(!root.is_rational, "a root");
    }
}
