//! Memoised values of the names in formulas.

use std::cell::{Cell, RefCell};

use rustc_hash::FxHashMap;

use crate::formula::{Formula, Symbol, Value};
use crate::scalar::Scalar;

/// Largest depth of nested formulas that is evaluated by recursion.
const DEEP: u32 = 64;

/// Values of symbols at one point, computed on first use.
pub(super) struct Memo<T> {
    known: RefCell<FxHashMap<Symbol, Value<T>>>,
    depth: Cell<u32>,
}

impl<T> Default for Memo<T> {
    fn default() -> Self {
        Self { known: RefCell::default(), depth: Cell::new(0) }
    }
}

impl<T: Scalar> Memo<T> {
    /// Returns the value of `symbol`; `evaluate` computes it, from its `formula` if it has one.
    ///
    /// A chain of formulas deeper than [`DEEP`] is evaluated from its end, on a list instead of
    /// the stack.
    pub fn value<'f>(
        &self,
        symbol: Symbol,
        formula: &dyn Fn(Symbol) -> Option<&'f Formula>,
        evaluate: &dyn Fn(Symbol) -> Value<T>,
    ) -> Value<T> {
        if let Some(value) = self.known.borrow().get(&symbol) {
            return value.clone();
        }
        if self.depth.get() == DEEP {
            let unknown = |symbol| formula(symbol).filter(|_| !self.has(symbol));
            settle(symbol, unknown, |symbol| {
                self.depth.set(0);
                self.value(symbol, formula, evaluate);
                self.depth.set(DEEP);
            });
            return self.value(symbol, formula, evaluate);
        }
        self.depth.set(self.depth.get() + 1);
        let value = evaluate(symbol);
        self.depth.set(self.depth.get() - 1);
        self.known.borrow_mut().insert(symbol, value.clone());
        value
    }

    fn has(&self, symbol: Symbol) -> bool {
        self.known.borrow().contains_key(&symbol)
    }
}

/// Evaluates the formulas that the formula of `symbol` uses before it. `formula` returns the
/// formula of a symbol that has no value yet.
fn settle<'f>(
    symbol: Symbol,
    formula: impl Fn(Symbol) -> Option<&'f Formula>,
    evaluate: impl Fn(Symbol),
) {
    let mut stack = vec![symbol];
    while let Some(top) = stack.last().copied() {
        let inner = formula(top).and_then(|own| own.symbols().find(|s| formula(*s).is_some()));
        match inner {
            Some(inner) => stack.push(inner),
            None => {
                evaluate(top);
                stack.pop();
            }
        }
    }
}
