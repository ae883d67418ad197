//! Factors of products.

use super::{Graph, Step};
use crate::number::{BinaryOperation, UnaryFunction};

impl Graph {
    /// Walks the factors of the value at a place, with their places. −a is the step −a, which counts as −1, and the
    /// factors of a; `inside` gives a value whose factors are walked in the place of those of another step, such
    /// as A for √A.
    pub fn factors_at<'g>(
        &'g self,
        place: usize,
        inside: impl Fn(Step<'g>) -> Option<usize> + 'g,
    ) -> impl Iterator<Item = (usize, Step<'g>)> {
        let mut open = vec![place];
        std::iter::from_fn(move || {
            loop {
                let place = open.pop()?;
                let step = self.step(place);
                match step {
                    Step::Binary(BinaryOperation::Mul, a, b) => open.extend([b, a]),
                    Step::Unary(UnaryFunction::Neg, a) => {
                        open.push(a);
                        return Some((place, step));
                    }
                    _ => match inside(step) {
                        Some(a) => open.push(a),
                        None => return Some((place, step)),
                    },
                }
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::super::record;
    use super::*;
    use crate::graph::Expr;
    use num_dual::DualNum;

    #[test]
    fn factors_of_products_are_walked_in_their_order() {
        let build = |x: &[Expr]| -(x[0] * 2.0) * (x[1] * x[2]).sqrt() * (x[0] + x[1]);
        let (graph, value) = record(3, |x| build(x)).expect("records");
        let walked = |through: bool| {
            let inside = move |step: Step<'_>| match step {
                Step::Unary(UnaryFunction::Sqrt, a) if through => Some(a),
                _ => None,
            };
            let all = graph.factors_at(graph.place(value), inside);
            all.map(|(_, step)| match step {
                Step::Constant(_) | Step::Unary(UnaryFunction::Neg, _) => "number",
                Step::Input(_) => "input",
                Step::Unary(UnaryFunction::Sqrt, _) => "root",
                _ => "sum",
            })
            .filter(|word| *word != "number")
            .collect::<Vec<_>>()
        };
        assert_eq!(walked(false), ["input", "root", "sum"]);
        assert_eq!(walked(true), ["input", "input", "input", "sum"]);
    }
}
