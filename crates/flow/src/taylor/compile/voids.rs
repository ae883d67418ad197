//! Steps that may be 0 over a time, and are never negative, as max(x, 0) and |x|: where the base of a root is 0 the root
//! is, and where it is negative there is no motion.

use crate::taylor::germ::Affine;
use crate::taylor::removable::affine;
use liouville::graph::{Graph, Step};
use liouville::number::rational::Rational;
use liouville::number::{BinaryOperation, UnaryFunction};

/// Whether each step of a graph contains a modulus and is not negative, by its form.
pub(super) fn may_be_zero(graph: &Graph) -> Vec<bool> {
    let is_modulus = |step: Step<'_>| matches!(step, Step::Unary(UnaryFunction::Abs, _));
    if !graph.steps().any(is_modulus) {
        return vec![false; graph.len()];
    }
    let all: Vec<usize> = (0..graph.len()).collect();
    let affine = affine(graph, &all);
    // ±(c |X| + λ X + μ) with |λ| ≤ c and μ ≥ 0
    let is_maximum = |place: usize, sign: i64| -> Option<bool> {
        let own = affine.get(&place)?.times(&Rational::from(sign));
        let mut moduli = own.terms.iter().filter_map(|(place, weight)| match graph.step(*place) {
            Step::Unary(UnaryFunction::Abs, a) => Some((*place, a, weight.clone())),
            _ => None,
        });
        let (modulus, argument, weight) = moduli.next()?;
        let rest = own.plus(&Affine::of_step(modulus), &-&weight);
        let [slope, constant] = rest.along(affine.get(&argument)?)?;
        let is_steeper = slope > weight || -&slope > weight;
        Some(!is_steeper && !constant.is_negative())
    };
    let mut has_modulus = Vec::new();
    // Whether each step is not negative, and whether it is not positive.
    let mut signs = Vec::<[bool; 2]>::new();
    for (place, step) in graph.steps().enumerate() {
        let own = is_modulus(step) || step.arguments().any(|argument| has_modulus[argument]);
        has_modulus.push(own);
        let at = |a: usize| signs[a];
        let found = match step {
            Step::Constant(value) => [!value.is_negative(), value.is_negative() || value.is_zero()],
            Step::Unary(UnaryFunction::Abs | UnaryFunction::Sqrt | UnaryFunction::Exp, _) => {
                [true, false]
            }
            Step::Unary(UnaryFunction::Recip, a) => at(a),
            Step::Unary(UnaryFunction::Neg, a) => [at(a)[1], at(a)[0]],
            Step::Binary(BinaryOperation::Mul, a, b) if a == b => [true, false],
            Step::Binary(BinaryOperation::Mul, a, b) => {
                let ([p, m], [q, n]) = (at(a), at(b));
                [p && q || m && n, p && n || m && q]
            }
            Step::Binary(BinaryOperation::Add, a, b) => {
                [at(a)[0] && at(b)[0], at(a)[1] && at(b)[1]]
            }
            Step::Binary(BinaryOperation::Sub, a, b) => {
                [at(a)[0] && at(b)[1], at(a)[1] && at(b)[0]]
            }
            Step::Power(a, exponent) => {
                [exponent.to_integer().is_none_or(|n| n % 2 == 0) || at(a)[0], false]
            }
            _ => [false; 2],
        };
        let [above, below] = [(0, 1), (1, -1)].map(|(index, sign): (usize, i64)| {
            found[index] || is_maximum(place, sign) == Some(true)
        });
        signs.push([above, below]);
    }
    has_modulus.iter().zip(signs).map(|(has, [above, _])| *has && above).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use liouville::graph::{Expr, record};
    use liouville::scalar::Scalar;
    use num_dual::DualNum;

    #[test]
    fn bases_that_may_be_negative_have_no_roots_there() {
        let found = |build: &dyn Fn(Expr, Expr) -> Expr| {
            let (graph, value) = record(2, |x| build(x[0], x[1])).expect("records");
            may_be_zero(&graph)[graph.place(value)]
        };
        let number = |n: i64| Expr::rational(&Rational::from(n));
        let above = |x: Expr| (x + x.modulus()) / number(2);
        assert!(found(&|x, _| x.modulus()) && found(&|x, _| above(x)));
        assert!(found(&|x, y| above(x - y) + above(-x - number(1)) * number(3)));
        assert!(found(&|x, y| above(x) * (y * y)), "a product of what is not negative");
        let half = |x: Expr| x / number(2);
        assert!(found(&|x, _| half(x) + half(x.modulus())), "as max(x, 0) may be written");
        assert!(!found(&|x, _| x + half(x.modulus())) && !found(&|x, _| above(x) - number(1)));
        assert!(found(&|x, _| x.modulus() - x) && found(&|x, _| above(x).sqrt()));
        assert!(!found(&|x, _| x.modulus() - number(1)), "negative for |x| < 1");
        assert!(!found(&|x, y| x + y.modulus()) && !found(&|x, _| -above(x)));
        assert!(!found(&|x, y| above(x) * y) && !found(&|x, y| x * x + y * y), "no modulus");
    }
}
