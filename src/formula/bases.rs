//! Bases of powers whose exponent varies: such a power has a value for a positive base alone.

use super::arena::{NodeId, NodeOperation};
use super::{Formula, Symbol, Value, evaluate};
use crate::scalar::Scalar;

impl Formula {
    /// Evaluates the base of every power whose exponent contains a symbol that varies, in the order of
    /// the text.
    ///
    /// # Panics
    /// As [`evaluate`](Formula::evaluate).
    pub fn bases<T: Scalar>(
        &self,
        varies: &dyn Fn(Symbol) -> bool,
        lookup: &mut dyn FnMut(Symbol) -> Value<T>,
    ) -> Vec<T> {
        let nodes = self.arena.nodes.iter();
        let base = |operation: &NodeOperation| match *operation {
            NodeOperation::PowerOf(a, b) if self.contains(b, varies) => Some(a),
            _ => None,
        };
        let bases: Vec<NodeId> = nodes.filter_map(|node| base(&node.operation)).collect();
        if bases.is_empty() {
            return Vec::new();
        }
        let values = evaluate::values(&self.arena, lookup);
        bases.into_iter().filter_map(|base| values[base].scalar()).collect()
    }

    /// Whether the value of the formula needs a symbol of some kind.
    pub(crate) fn needs(&self, is_meant: &dyn Fn(Symbol) -> bool) -> bool {
        let last = self.arena.nodes.len().checked_sub(1);
        last.is_some_and(|last| self.contains(last, is_meant))
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
    fn bases_are_those_of_exponents_that_vary() {
        let of = |text: &str| -> Vec<f64> {
            let formula = Formula::parse(text, &Letters).expect("a formula");
            let value = |Symbol(own): Symbol| Value::Scalar([2.0, 3.0, 5.0][own as usize]);
            formula.bases(&|symbol| symbol != Symbol(0), &mut { value })
        };
        assert_eq!(of("x^a + x^3 + (x − y)^(1/2)"), [], "a does not vary");
        assert_eq!(of("(x − y)^(a*y − 2) + a^(x + 0*y)"), [-2.0, 2.0]);
        assert_eq!(of("x^(y^x)"), [5.0, 3.0]);
    }
}
