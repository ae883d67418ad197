//! Poles of a formula: its denominators and the arguments of its logarithms.

use std::borrow::Cow;

use super::arena::{ElementaryFunction, NodeOperation};
use super::{Formula, Symbol};

/// Part of a formula that must not be zero.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Denominator<'f> {
    /// Text as written; the cosine of what the tangent is taken of.
    pub text: Cow<'f, str>,
    /// Symbols that it depends on.
    pub symbols: Vec<Symbol>,
}

impl Formula {
    /// Parts of the formula that are divided by, inverted, raised to a power that may be negative,
    /// or taken the logarithm of.
    pub fn denominators(&self) -> Vec<Denominator<'_>> {
        let nodes = &self.arena.nodes;
        let below = nodes.iter().filter_map(|node| match &node.operation {
            NodeOperation::Divide(_, b) => Some((*b, false)),
            NodeOperation::Power(a, exponent) if exponent.is_negative() => Some((*a, false)),
            NodeOperation::PowerOf(a, _)
            | NodeOperation::Inverse(a)
            | NodeOperation::Solve(a, _) => Some((*a, false)),
            NodeOperation::Function(ElementaryFunction::Ln | ElementaryFunction::Sign, a) => {
                Some((*a, false))
            }
            NodeOperation::Function(ElementaryFunction::Tan, a) => Some((*a, true)),
            _ => None,
        });
        let described = |(node, is_tangent): (usize, bool)| {
            let place = &nodes[node].span;
            let inside =
                nodes.iter().filter(|n| place.start <= n.span.start && n.span.end <= place.end);
            let symbols = inside.filter_map(|n| match n.operation {
                NodeOperation::Symbol(slot) => Some(self.arena.symbols[slot].0),
                _ => None,
            });
            let text = self.text.get(place.clone()).unwrap_or_default().trim();
            let text = match is_tangent {
                true => Cow::Owned(format!("cos({text})")),
                false => Cow::Borrowed(text),
            };
            Denominator { text, symbols: symbols.collect() }
        };
        below.map(described).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Scope, Type};
    use super::*;

    struct Letters;

    impl Scope for Letters {
        fn lookup(&self, name: &str) -> Option<(Symbol, Type)> {
            let index = ["a", "b", "x"].iter().position(|known| *known == name)?;
            Some((Symbol(index as u32), Type::Scalar))
        }
        fn names(&self) -> Vec<String> {
            Vec::new()
        }
    }

    #[test]
    fn what_must_not_vanish_is_found() {
        let of = |text: &str| -> Vec<String> {
            let formula = Formula::parse(text, &Letters).expect("a formula");
            formula.denominators().iter().map(|part| part.text.to_string()).collect()
        };
        assert_eq!(of("a*x + b/2"), ["2"]);
        assert_eq!(of("(a + 1)/(1 − x²)"), ["(1 − x²)"]);
        assert_eq!(of("log(x) + a*x^(-1)"), ["x", "x"]);
        let formula = Formula::parse("a/(b + x*b)", &Letters).expect("a formula");
        let symbols = &formula.denominators()[0].symbols;
        assert!(symbols.contains(&Symbol(2)) && !symbols.contains(&Symbol(0)), "{symbols:?}");
    }
}
