//! Bases of powers whose exponent varies: such a power has a value for a positive base alone.

use super::arena::{NodeId, NodeOperation};
use super::{Formula, Symbol, Value, evaluate};
use crate::scalar::Scalar;

/// Exponents of powers that have a value for positive bases alone.
pub(crate) struct Exponents<'e> {
    /// Whether a symbol is not the same number everywhere.
    pub varies: &'e dyn Fn(Symbol) -> bool,
    /// Whether a symbol that varies depends on lists of numbers alone.
    pub is_listed: &'e dyn Fn(Symbol) -> bool,
}

impl Formula {
    /// Whether the exponent of a power contains a symbol that varies.
    pub(crate) fn has_varying_exponent(&self, varies: &dyn Fn(Symbol) -> bool) -> bool {
        let mut nodes = self.arena.nodes.iter();
        nodes.any(|node| match node.operation {
            NodeOperation::PowerOf(_, exponent) => self.contains(exponent, varies),
            _ => false,
        })
    }

    /// Evaluates the formula literally, and adds 0·ln X to each power X^Y with an exponent that varies, but
    /// for one with listed symbols alone that is the same number for all of their values.
    ///
    /// # Panics
    /// As [`evaluate`](Formula::evaluate).
    pub(crate) fn evaluate_with_logarithms<T: Scalar>(
        &self,
        exponents: &Exponents<'_>,
        lookup: &mut dyn FnMut(Symbol) -> Value<T>,
    ) -> Value<T> {
        let is_free = |symbol| (exponents.varies)(symbol) && !(exponents.is_listed)(symbol);
        let asks = |exponent: NodeId, value: T| {
            self.contains(exponent, &is_free)
                || (self.contains(exponent, exponents.varies) && !value.is_number())
        };
        let mut values = evaluate::literal_values_with(&self.arena, lookup, Some(&asks));
        values.pop().unwrap_or_else(|| Value::Scalar(T::undefined()))
    }

    /// Whether a part of the formula contains a symbol of some kind.
    fn contains(&self, part: NodeId, is_meant: &dyn Fn(Symbol) -> bool) -> bool {
        let mut open = vec![part];
        while let Some(node) = open.pop() {
            let operation = &self.arena.nodes[node].operation;
            if let NodeOperation::Symbol(slot) = operation
                && is_meant(self.arena.symbols[*slot].0)
            {
                return true;
            }
            operation.on(|argument| {
                open.push(argument);
                argument
            });
        }
        false
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Scope, Type};
    use super::*;

    struct Letters;

    impl Scope for Letters {
        fn lookup(&self, name: &str) -> Option<(Symbol, Type)> {
            let index = ["a", "x", "y"].iter().position(|known| *known == name)?;
            Some((Symbol(index as u32), Type::Scalar))
        }
        fn names(&self) -> Vec<String> {
            Vec::new()
        }
    }

    #[test]
    fn exponents_that_vary_ask_for_positive_bases() {
        let has_value = |text: &str| {
            let formula = Formula::parse(text, &Letters).expect("a formula");
            let mut value = |Symbol(own): Symbol| Value::Scalar([2.0, -3.0, 4.0][own as usize]);
            let exponents = Exponents {
                varies: &|symbol| symbol != Symbol(0),
                is_listed: &|symbol| symbol == Symbol(2),
            };
            let found = formula.evaluate_with_logarithms(&exponents, &mut value).scalar();
            !found.expect("a scalar").is_nan()
        };
        assert!(has_value("x^a + x^3 + (x − y)^2"), "a does not vary");
        assert!(!has_value("(x − y)^(a*y)") && !has_value("x^(x + 5)"));
        assert!(has_value("y^x + a^(x + y)"), "the bases are positive");
        assert!(!has_value("[x^y, a][2]"), "a part of a list asks for all");
    }
}
