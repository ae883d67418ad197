//! Names and symbols of a formula.

use super::kind::Type;
use super::scope::Symbol;
use super::{Formula, canonical_name};

impl Formula {
    /// Names used, each once, in the order of first use, as the scope spells them.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.arena.names.iter().map(String::as_str)
    }

    /// Whether the formula uses a name of its scope, by itself or by a component: `γ3` uses `γ`.
    pub fn uses(&self, name: &str) -> bool {
        let canonical = canonical_name(name);
        let name = canonical.as_deref().unwrap_or(name);
        self.names().any(|own| own == name)
    }

    /// Same formula with other symbols for its names; `None` where `other` has none.
    pub(crate) fn with_symbols(
        &self,
        other: impl FnMut(Symbol, &str, Type) -> Option<Symbol>,
    ) -> Option<Self> {
        Some(Self { text: self.text.clone(), arena: self.arena.with_symbols(other)? })
    }

    /// Types of the symbols used.
    pub fn symbol_types(&self) -> impl Iterator<Item = Type> {
        self.arena.symbols.iter().map(|(_, kind)| *kind)
    }

    /// Symbols used, with their names.
    pub fn named_symbols(&self) -> impl Iterator<Item = (Symbol, &str)> {
        self.symbols().zip(self.names())
    }
}
