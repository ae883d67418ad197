//! Steps that may be 0 over a time, and are never negative, as max(x, 0) and |x|: where the base of a root is 0 the root
//! is, and where it is negative there is no motion.

use crate::taylor::germ::Affine;
use crate::taylor::removable::affine;
use liouville::graph::{Graph, Step};
use liouville::number::{BinaryOperation, UnaryFunction};

/// Whether each step of a graph contains a modulus and is not negative, by its form.
pub(super) fn may_be_zero(graph: &Graph) -> Vec<bool> {
    let is_modulus = |step: Step<'_>| matches!(step, Step::Unary(UnaryFunction::Abs, _));
    if !graph.steps().any(is_modulus) {
        return vec![false; graph.len()];
    }
    let all: Vec<usize> = (0..graph.len()).collect();
    let affine = affine(graph, &all);
    // c |X| + λ X + μ with |λ| ≤ c and μ ≥ 0
    let is_maximum = |place: usize| -> Option<bool> {
        let own = affine.get(&place)?;
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
    let (mut has_modulus, mut is_not_negative) = (Vec::new(), Vec::<bool>::new());
    for (place, step) in graph.steps().enumerate() {
        let own = is_modulus(step) || step.arguments().any(|argument| has_modulus[argument]);
        has_modulus.push(own);
        let known = |a: usize| is_not_negative[a];
        let found = match step {
            Step::Constant(value) => !value.is_negative(),
            Step::Unary(UnaryFunction::Abs | UnaryFunction::Sqrt | UnaryFunction::Exp, _) => true,
            Step::Unary(UnaryFunction::Recip, a) => known(a),
            Step::Binary(BinaryOperation::Mul, a, b) => a == b || known(a) && known(b),
            Step::Binary(BinaryOperation::Add, a, b) => known(a) && known(b),
            Step::Power(a, exponent) => {
                let is_even = exponent.to_integer().is_none_or(|n| n % 2 == 0);
                is_even || known(a)
            }
            _ => false,
        };
        is_not_negative.push(found || is_maximum(place) == Some(true));
    }
    has_modulus.iter().zip(is_not_negative).map(|(has, known)| *has && known).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use liouville::graph::{Expr, record};
    use liouville::number::rational::Rational;
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
        assert!(found(&|x, y| above(x) * y * y), "a product of what is not negative");
        let half = |x: Expr| x / number(2);
        assert!(found(&|x, _| half(x) + half(x.modulus())), "as max(x, 0) may be written");
        assert!(!found(&|x, _| x + half(x.modulus())) && !found(&|x, _| above(x) - number(1)));
        assert!(found(&|x, _| x.modulus() - x) && found(&|x, _| above(x).sqrt()));
        assert!(!found(&|x, _| x.modulus() - number(1)), "negative for |x| < 1");
        assert!(!found(&|x, y| x + y.modulus()) && !found(&|x, _| -above(x)));
        assert!(!found(&|x, y| above(x) * y) && !found(&|x, y| x * x + y * y), "no modulus");
    }
}
