//! Errors of the values of further functions at a state, by a running analysis of their rounding
//! (Higham 2002, section 3.3): each row of the program has an error from those before it, and its own.

use crate::taylor::number::{SeriesNumber, applied, powered};
use crate::taylor::program::{RowInstruction, Rule, TaylorProgram};
use crate::taylor::saturating::Saturating;
use liouville::number::UnaryFunction;
use liouville::number::double_double::DoubleDouble;

/// Value of a row, and a bound of its error to first order.
#[derive(Clone, Copy, Default)]
struct Rounded {
    value: f64,
    error: f64,
}

impl TaylorProgram {
    /// Error of a further function's value at a state that is known to rounding, where it is computed
    /// in numbers of this type. No component is known better than a number of this size.
    pub(crate) fn rounding<T: SeriesNumber>(
        &self,
        output: usize,
        state: &[DoubleDouble],
        size: f64,
    ) -> f64 {
        let mut rows = vec![Rounded::default(); self.rows];
        for (row, x) in rows.iter_mut().zip(state) {
            *row = Rounded { value: x.hi, error: T::EPSILON * x.hi.abs().max(size) };
        }
        for instruction in &self.instructions {
            rows[instruction.out] = rounded(instruction, &rows, T::EPSILON);
        }
        rows[self.outputs[output]].error
    }
}

/// Value and error of a row.
fn rounded(instruction: &RowInstruction, rows: &[Rounded], epsilon: f64) -> Rounded {
    let own = |value: f64, slope: f64, x: Rounded| Rounded {
        value,
        error: slope.abs() * x.error + epsilon * value.abs(),
    };
    match &instruction.rule {
        Rule::Sum => sum(instruction, rows, epsilon),
        Rule::Theta(_) | Rule::Choice(_) | Rule::Bounded(..) => Rounded::default(),
        Rule::Saturating { function, x, .. } => {
            let bound = match function {
                Saturating::Sinh | Saturating::Cosh => Saturating::Cosh.at(rows[*x].value),
                Saturating::Asinh => 1.0,
                Saturating::Atanh => (1.0 - rows[*x].value * rows[*x].value).recip(),
                _ => Saturating::Fall.at(0.5 * rows[*x].value),
            };
            own(function.at(rows[*x].value), bound, rows[*x])
        }
        Rule::Near(x, reach) => {
            let is_near = rows[*x].value.abs() < 0.5 * reach;
            Rounded { value: f64::from(u8::from(is_near)), error: 0.0 }
        }
        Rule::Void(x) => {
            let is_void = rows[*x].value <= 0.0;
            Rounded { value: f64::from(u8::from(is_void)), error: 0.0 }
        }
        Rule::Sign(x) => Rounded { value: 1f64.copysign(rows[*x].value), error: 0.0 },
        Rule::Recip(x) => {
            let x = rows[*x];
            let value = x.value.recip();
            own(value, value * value, x)
        }
        Rule::Sqrt(x) => {
            let x = rows[*x];
            let value = x.value.sqrt();
            own(value, 0.5 / value, x)
        }
        Rule::Exp(x) => {
            let value = applied(UnaryFunction::Exp, rows[*x].value);
            own(value, value, rows[*x])
        }
        Rule::Ln(x) => {
            let x = rows[*x];
            own(applied(UnaryFunction::Ln, x.value), x.value.recip(), x)
        }
        Rule::Sin { x, .. } => own(applied(UnaryFunction::Sin, rows[*x].value), 1.0, rows[*x]),
        Rule::Cos { x, .. } => own(applied(UnaryFunction::Cos, rows[*x].value), 1.0, rows[*x]),
        Rule::Atan { x, square } => {
            let slope = rows[*square].value.recip();
            own(applied(UnaryFunction::Atan, rows[*x].value), slope, rows[*x])
        }
        Rule::Power { x, exponent } => {
            let x = rows[*x];
            let value = powered(x.value, exponent);
            own(value, exponent.to_f64().0 * value / x.value, x)
        }
    }
}

/// Value and error of constant + Σ c x + Σ c x y, added in any order.
fn sum(instruction: &RowInstruction, rows: &[Rounded], epsilon: f64) -> Rounded {
    let form = &instruction.form;
    let constant = form.constant.as_ref().map_or(0.0, |value| value.to_f64().0);
    let (mut value, mut size, mut error) = (constant, constant.abs(), 0.0);
    let mut add = |term: f64, own: f64| {
        value += term;
        size += term.abs();
        error += own;
    };
    for (weight, x) in &form.linear {
        let (weight, x) = (weight.to_f64().0, rows[*x]);
        add(weight * x.value, weight.abs() * x.error);
    }
    for (weight, x, y) in &form.products {
        let (weight, x, y) = (weight.to_f64().0, rows[*x], rows[*y]);
        let crossed = x.value.abs() * y.error + y.value.abs() * x.error;
        add(weight * x.value * y.value, weight.abs() * crossed);
    }
    let terms = 1 + form.linear.len() + form.products.len();
    Rounded { value, error: error + epsilon * terms as f64 * size }
}

#[cfg(test)]
mod tests {
    use super::*;
    use liouville::graph::{Expr, record};
    use liouville::number::rational::Rational;
    use liouville::scalar::Scalar;

    fn error(function: impl Fn(Expr) -> Expr, at: f64) -> f64 {
        let zero = || Expr::rational(&Rational::from(0));
        let recorded = record(1, |state| (function(state[0]), zero()));
        let (graph, (output, rest)) = recorded.expect("a graph");
        let program = TaylorProgram::compile(&graph, &[rest], &[output]).expect("a program");
        program.rounding::<f64>(0, &[DoubleDouble::from_f64(at)], 0.0)
    }

    #[test]
    fn errors_are_those_of_the_operands() {
        let number = |x: i64| Expr::rational(&Rational::from(x));
        let unit = f64::EPSILON;
        let far = error(|x| (x + number(1 << 40)) * (x + number(1 << 40)), 0.5);
        let size = 2f64.powi(80);
        assert!(far > unit * size && far < 20.0 * unit * size, "{far:e}");
        let near = error(|x| x * x, 0.5);
        assert!(near > 0.25 * unit && near < 2.0 * unit, "{near:e}");
        let steep = error(|x| number(1) / x, 1e-3);
        assert!(steep > 1e3 * unit && steep < 4e3 * unit, "{steep:e}");
    }
}
