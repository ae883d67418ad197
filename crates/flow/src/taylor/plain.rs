//! Values of the field in plain numbers at states within a step, and bounds of their rounding.

use crate::taylor::code::{BoundProgram, InitialOperation, Place, PlacedRule, part};
use crate::taylor::number::SeriesNumber;
use crate::taylor::series::Series;
use liouville::graph::{Kernel, with_widest_vectors};
use liouville::number::UnaryFunction;

/// Multiple of the rounding of a component at its largest by which it may be wrong later.
const PASSED: f64 = 4.0;
/// Size below which an argument has no side of 0: its terms underflow.
pub(crate) const FAINT: f64 = 1e-280;

impl<T: SeriesNumber> BoundProgram<T> {
    /// Computes order 0 of every operation: the functions themselves.
    #[inline(always)]
    pub(crate) fn values(&self, memory: &mut [T]) {
        for (operation, finish) in self.operations.iter().zip(&self.finishes) {
            let at = |x: &Place| memory[*x as usize];
            let value = match &operation.rule {
                PlacedRule::Sum => {
                    let mut sum = operation.constant;
                    for term in part(&self.terms, operation.terms) {
                        sum = sum.fused(term.fixed, at(&term.x));
                    }
                    for factor in part(&self.factors, operation.factors) {
                        let [x, y] = [factor.x, factor.y].map(|k| self.terms[k as usize].x);
                        sum = sum.fused(factor.weight * at(&x), at(&y));
                    }
                    sum.settled()
                }
                PlacedRule::Theta => T::ZERO,
                PlacedRule::Recip(x) => at(x).recip(),
                PlacedRule::Sqrt(x) => at(x).apply(UnaryFunction::Sqrt),
                PlacedRule::Exp(x) => at(x).apply(UnaryFunction::Exp),
                PlacedRule::Ln(x) => at(x).apply(UnaryFunction::Ln),
                PlacedRule::Sin { x, .. } => at(x).apply(UnaryFunction::Sin),
                PlacedRule::Cos { x, .. } => at(x).apply(UnaryFunction::Cos),
                PlacedRule::Atan { x, .. } => at(x).apply(UnaryFunction::Atan),
                PlacedRule::Power { x, exponent, .. } => at(x).power(exponent),
                PlacedRule::Saturating { function, x, .. } => function.at(at(x)),
                PlacedRule::Sign(_) => operation.constant,
                PlacedRule::Near(x, reach) => near(at(x), *reach),
                PlacedRule::Void(x) => void(at(x)),
            };
            // Order 0 does not enter the inner sums: behind order 1 there are zeros.
            memory[finish.place as usize] = value;
        }
    }
}

/// 1 in the lanes in which |x| is below half the reach of a series, and 0 in the others.
#[inline(always)]
fn near<T: SeriesNumber>(x: T, reach: f64) -> T {
    T::from_lanes(|lane| match x.lane(lane).leading().abs() < 0.5 * reach {
        true => T::One::ONE,
        false => T::One::ZERO,
    })
}

/// 1 in the lanes in which x is not positive, and 0 in the others.
#[inline(always)]
fn void<T: SeriesNumber>(x: T) -> T {
    T::from_lanes(|lane| match x.lane(lane).leading() <= 0.0 {
        true => T::One::ONE,
        false => T::One::ZERO,
    })
}

/// Work of computing the values at the probed state.
struct PlainValues<'s, T: SeriesNumber>(&'s mut Series<T>);

impl<T: SeriesNumber> Kernel for PlainValues<'_, T> {
    #[inline(always)]
    fn run(self) {
        let series = self.0;
        if !T::values_by_machine(series) {
            series.code.values(&mut series.probed);
        }
    }
}

impl<T: SeriesNumber> Series<T> {
    /// Computes the field at a state, besides the present expansion.
    pub(crate) fn probe(&mut self, state: &[T]) {
        for (component, value) in self.code.state.iter().zip(state) {
            self.probed[component.place as usize] = *value;
        }
        with_widest_vectors(PlainValues(self));
    }

    /// Rate of a component at the probed state.
    #[inline(always)]
    pub(crate) fn probed_rate(&self, index: usize) -> T {
        self.probed[self.code.state[index].rate as usize]
    }

    /// Argument of a sign at the probed state.
    pub(crate) fn probed_argument(&self, sign: usize) -> T {
        self.probed[self.signed(sign).0 as usize]
    }

    /// Value of a further function at the probed state.
    pub(crate) fn probed_output(&self, index: usize) -> T {
        self.probed[self.code.outputs[index] as usize]
    }

    /// Bound of the error of a further function at the probed state, by rounding and by these errors of
    /// the state.
    pub(crate) fn output_error(&self, index: usize, lane: usize, known: Vec<f64>) -> f64 {
        self.errors(&self.probed, lane, known)[self.index(self.code.outputs[index])]
    }

    /// Bounds of the errors of the rates at the probed state, by rounding and by these errors of the
    /// state.
    pub(crate) fn rate_errors(&self, lane: usize, known: Vec<f64>) -> Vec<f64> {
        let errors = self.errors(&self.probed, lane, known);
        self.code.state.iter().map(|component| errors[self.index(component.rate)]).collect()
    }

    /// Bound of the error of a row at the present state, where no component is known better than it
    /// was at its largest so far.
    pub(crate) fn value_error(&self, row: Place, lane: usize, peaks: &[T]) -> f64 {
        let known = |peak: &T| PASSED * T::EPSILON * peak.lane(lane).leading();
        self.errors(&self.memory, lane, peaks.iter().map(known).collect())[self.index(row)]
    }

    /// First sign at the probed state that is not that of its argument, with these errors of the state.
    pub(crate) fn turned_away(&self, lane: usize, known: Vec<f64>) -> Option<usize> {
        let errors = self.errors(&self.probed, lane, known);
        (0..self.signs()).find(|sign| {
            let place = self.signed(*sign).0;
            let value = self.probed_argument(*sign).lane(lane).leading();
            let is_known = value.abs() > PASSED * errors[self.index(place)].max(FAINT);
            is_known && (value > 0.0) != self.is_positive(*sign, lane)
        })
    }

    /// Index of a row by its place.
    fn index(&self, place: Place) -> usize {
        let first = self.code.state.first().map_or(0, |component| component.place);
        (place - first) as usize / (T::WIDTH + self.orders)
    }

    /// Errors of all rows at a state to first order (Higham 2002, section 3.3).
    fn errors(&self, memory: &[T], lane: usize, known: Vec<f64>) -> Vec<f64> {
        let value = |place: Place| memory[place as usize].lane(lane).leading();
        let mut errors = known;
        // A program without its outputs leaves rows out.
        errors.resize(memory.len().div_ceil(T::WIDTH + self.orders), 0.0);
        for (operation, finish) in self.code.operations.iter().zip(&self.code.finishes) {
            let at = |x: Place| (value(x), errors[self.index(x)]);
            errors[self.index(finish.place)] = self.error(operation, value(finish.place), lane, at);
        }
        errors
    }

    /// Error of an operation with this value, from the values of its arguments and their errors.
    fn error(
        &self,
        operation: &InitialOperation<T>,
        own: f64,
        lane: usize,
        at: impl Fn(Place) -> (f64, f64),
    ) -> f64 {
        let rounding = T::EPSILON * own.abs();
        let by = |x: Place, slope: &dyn Fn(f64) -> f64| {
            let (value, error) = at(x);
            slope(value).abs() * error + rounding
        };
        match &operation.rule {
            PlacedRule::Sum => self.sum_error(operation, lane, at),
            PlacedRule::Theta
            | PlacedRule::Sign(_)
            | PlacedRule::Near(..)
            | PlacedRule::Void(_) => 0.0,
            PlacedRule::Recip(x) => by(*x, &|_| own * own),
            PlacedRule::Sqrt(x) => by(*x, &|_| 0.5 / own),
            PlacedRule::Exp(x) => by(*x, &|_| own),
            PlacedRule::Ln(x) => by(*x, &|x| x.recip()),
            PlacedRule::Sin { x, .. } | PlacedRule::Cos { x, .. } => by(*x, &|_| 1.0),
            PlacedRule::Saturating { x, slope, .. } => by(*x, &|_| 2.0 * at(*slope).0),
            PlacedRule::Atan { x, square } => by(*x, &|_| at(*square).0.recip()),
            PlacedRule::Power { x, factor, .. } => {
                by(*x, &|x| factor.lane(lane).leading() * own / x)
            }
        }
    }

    /// Error of constant + Σ c x + Σ c x y, added in any order.
    fn sum_error(
        &self,
        operation: &InitialOperation<T>,
        lane: usize,
        at: impl Fn(Place) -> (f64, f64),
    ) -> f64 {
        let number = |x: T| x.lane(lane).leading();
        let terms = part(&self.code.terms, operation.terms);
        let factors = part(&self.code.factors, operation.factors);
        let (mut size, mut error) = (number(operation.constant).abs(), 0.0);
        for term in terms {
            let (weight, (x, own)) = (number(term.fixed).abs(), at(term.x));
            size += weight * x.abs();
            error += weight * own;
        }
        for factor in factors {
            let [(x, of_x), (y, of_y)] =
                [factor.x, factor.y].map(|k| at(self.code.terms[k as usize].x));
            let weight = number(factor.weight).abs();
            size += weight * (x * y).abs();
            error += weight * (x.abs() * of_y + y.abs() * of_x);
        }
        error + T::EPSILON * (1 + terms.len() + factors.len()) as f64 * size
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::taylor::program::TaylorProgram;
    use liouville::graph::{Expr, record};
    use liouville::number::double_double::DoubleDouble;
    use liouville::number::rational::Rational;
    use liouville::scalar::Scalar;
    use num_dual::DualNum;

    fn field() -> TaylorProgram {
        let number = |n: i64| Expr::rational(&Rational::from(n));
        let rates = |x: &[Expr]| {
            let far = (x[0] + number(1 << 40)) * (x[0] + number(1 << 40));
            vec![far - number(1 << 40) * number(1 << 40), x[1].exp() * x[0].sin() + x[1].recip()]
        };
        let (graph, rates) = record(2, rates).expect("a field");
        TaylorProgram::compile(&graph, &rates, &[]).expect("a program")
    }

    #[test]
    fn a_probe_leaves_the_expansion_as_it_is() {
        let mut series = Series::<f64>::new(&field(), 20);
        for _ in 0..40 {
            series.expand(&[0.25, 0.5]);
            let before = series.memory.clone();
            series.probe(&[0.75, 0.125]);
            assert!(series.memory == before);
            let expected = libm::exp(0.125) * libm::sin(0.75) + 8.0;
            assert!((series.probed_rate(1) - expected).abs() < 1e-14);
        }
    }

    #[test]
    fn errors_are_those_of_the_operands() {
        let state = [0.25, 0.5];
        let mut series = Series::<f64>::new(&field(), 20);
        series.probe(&state);
        let found = series.rate_errors(0, vec![f64::EPSILON; 2]);
        let unit = f64::EPSILON * 2f64.powi(80);
        assert!(found[0] > unit && found[0] < 20.0 * unit, "{found:?}");
        assert!(found[1] > 4.0 * f64::EPSILON && found[1] < 40.0 * f64::EPSILON, "{found:?}");
        let mut series = Series::<DoubleDouble>::new(&field(), 34);
        series.probe(&state.map(DoubleDouble::from_f64));
        assert!(series.rate_errors(0, vec![0.0; 2])[1] < 1e-30);
    }
}
