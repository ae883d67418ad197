//! Names of a case and their meanings.

use std::sync::Arc;

use rustc_hash::{FxHashMap, FxHashSet};

use super::quantity::Quantity;
use crate::formula::{Formula, Scope, Symbol, SymbolOrigin, Type};

/// The meaning of a name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Meaning {
    /// An entry of the model's parameters.
    Parameter(usize),
    /// An entry of the model's state.
    State(usize),
    /// An entry of the model's abbreviations.
    Abbreviation(usize),
    /// A quantity that the system defines.
    Quantity(Quantity),
}

/// The dependence of a quantity; later levels include earlier ones.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Dependence {
    /// Parameters only.
    Parameters,
    /// Parameters and the configuration γ.
    Configuration,
    /// The whole state.
    Phase,
}

/// A name with its meaning.
#[derive(Clone, Debug)]
pub struct VocabularyEntry {
    /// Canonical name.
    pub name: String,
    /// Meaning of the name.
    pub meaning: Meaning,
    /// Type of the value: scalar, vector or matrix.
    pub kind: Type,
    /// Dependence of the value.
    pub reach: Dependence,
    /// Integer value, if the file fixes one.
    pub whole: Option<i64>,
    /// Formula of an abbreviation.
    definition: Option<Arc<Formula>>,
}

/// All names of a case.
#[derive(Clone, Debug, Default)]
pub struct Vocabulary {
    entries: Vec<VocabularyEntry>,
    by_name: FxHashMap<String, u32>,
    awaited: FxHashSet<String>,
}

impl Vocabulary {
    /// Notes a name that is declared later: formulas read before it cannot use its other meanings, such as
    /// the number e or the component v1.
    pub fn await_name(&mut self, name: &str) {
        self.awaited.insert(name.to_string());
    }

    /// Adds a name; a later entry of the same name hides the earlier one.
    pub fn add(&mut self, name: &str, meaning: Meaning, kind: Type, reach: Dependence) {
        self.awaited.remove(name);
        self.by_name.insert(name.to_string(), self.entries.len() as u32);
        self.entries.push(VocabularyEntry {
            name: name.to_string(),
            meaning,
            kind,
            reach,
            whole: None,
            definition: None,
        });
    }

    /// Adds an abbreviation, the one with this index in the model.
    pub fn define(&mut self, name: &str, index: usize, formula: &Formula, reach: Dependence) {
        self.add(name, Meaning::Abbreviation(index), formula.value_type(), reach);
        if let Some(entry) = self.entries.last_mut() {
            entry.definition = Some(Arc::new(formula.clone()));
        }
    }

    /// Notes the integer value that the file fixes for a name.
    pub fn set_whole(&mut self, name: &str, whole: i64) {
        if let Some(index) = self.by_name.get(name) {
            self.entries[*index as usize].whole = Some(whole);
        }
    }

    /// Adds an entry without making it accessible by name; returns its symbol.
    pub fn hide(&mut self, name: &str, meaning: Meaning, kind: Type, reach: Dependence) -> Symbol {
        self.entries.push(VocabularyEntry {
            name: name.to_string(),
            meaning,
            kind,
            reach,
            whole: None,
            definition: None,
        });
        Symbol(self.entries.len() as u32 - 1)
    }

    /// Makes an entry accessible by a name.
    pub fn bind(&mut self, name: &str, symbol: Symbol) {
        self.by_name.insert(name.to_string(), symbol.0);
    }

    /// Returns the same entries, with only those accessible by name that depend on parameters
    /// alone.
    ///
    /// Symbols keep their meaning, so that abbreviations can still be evaluated.
    pub fn only_parameters(&self) -> Self {
        self.only(|entry| entry.reach == Dependence::Parameters)
    }

    /// Returns the same entries, with only some of them accessible by name.
    pub fn only(&self, keep: impl Fn(&VocabularyEntry) -> bool) -> Self {
        let mut kept = self.clone();
        kept.by_name.retain(|_, index| keep(&self.entries[*index as usize]));
        kept
    }

    /// Returns the entry of a symbol.
    pub fn entry(&self, symbol: Symbol) -> &VocabularyEntry {
        &self.entries[symbol.0 as usize]
    }

    /// Returns the entry of a name.
    pub fn find(&self, name: &str) -> Option<&VocabularyEntry> {
        self.by_name.get(name).map(|index| &self.entries[*index as usize])
    }

    /// Iterates over all entries with their symbols.
    pub fn iter(&self) -> impl Iterator<Item = (Symbol, &VocabularyEntry)> {
        self.entries.iter().enumerate().map(|(index, entry)| (Symbol(index as u32), entry))
    }

    /// The name with a meaning, as a formula; `None` where nothing has it.
    pub fn formula_of(&self, meaning: Meaning) -> Option<Formula> {
        let (symbol, own) = self.iter().find(|(_, own)| own.meaning == meaning)?;
        Some(Formula::symbol(&own.name, symbol, own.kind))
    }

    /// Returns a formula with the abbreviations it uses, directly or through others.
    pub fn with_abbreviations<'f>(
        &self,
        formula: &'f Formula,
        abbreviations: &'f [Formula],
    ) -> Vec<&'f Formula> {
        let mut met = vec![false; abbreviations.len()];
        let mut all = vec![formula];
        let mut next = 0;
        while let Some(formula) = all.get(next).copied() {
            next += 1;
            for symbol in formula.symbols() {
                if let Meaning::Abbreviation(index) = self.entry(symbol).meaning
                    && !std::mem::replace(&mut met[index], true)
                {
                    all.push(&abbreviations[index]);
                }
            }
        }
        all
    }

    /// Returns the names that a formula depends on, directly or through abbreviations.
    pub fn uses(&self, formula: &Formula, abbreviations: &[Formula]) -> Vec<&VocabularyEntry> {
        let formulas = self.with_abbreviations(formula, abbreviations).into_iter();
        formulas.flat_map(|f| f.symbols().map(|symbol| self.entry(symbol))).collect()
    }

    /// Checks that every symbol of a formula means here what the formula calls it; otherwise returns
    /// the name that does not. Names that others hide are among them.
    pub fn check_own(&self, formula: &Formula) -> Result<(), String> {
        self.check(formula, |_, _| true)
    }

    /// Checks that every name of a formula is accessible here, with the same meaning; otherwise
    /// returns the name that is not.
    pub fn check_named(&self, formula: &Formula) -> Result<(), String> {
        self.check(formula, |symbol, name| {
            self.by_name.get(name).is_some_and(|index| *index == symbol.0)
        })
    }

    fn check(
        &self,
        formula: &Formula,
        is_known: impl Fn(Symbol, &str) -> bool,
    ) -> Result<(), String> {
        let types = formula.symbol_types().collect::<Vec<_>>();
        for ((symbol, name), kind) in formula.named_symbols().zip(types) {
            let entry = self.entries.get(symbol.0 as usize);
            let is_same = entry.is_some_and(|entry| {
                let bound = self.by_name.get(name) == Some(&symbol.0);
                entry.kind == kind && (entry.name == name || bound)
            });
            if !is_same || !is_known(symbol, name) {
                return Err(name.to_string());
            }
        }
        let is_own = |symbol: &Symbol| self.entries.get(symbol.0 as usize).is_some();
        match formula.fixed_symbols().iter().all(is_own) {
            true => Ok(()),
            false => Err("an index".to_string()),
        }
    }

    /// Returns the entry with the largest dependence among the names in `formula`.
    pub fn reach(&self, formula: &Formula) -> Option<&VocabularyEntry> {
        formula.symbols().map(|symbol| self.entry(symbol)).max_by_key(|entry| entry.reach)
    }
}

impl Scope for Vocabulary {
    fn lookup(&self, name: &str) -> Option<(Symbol, Type)> {
        let index = *self.by_name.get(name)?;
        Some((Symbol(index), self.entries[index as usize].kind))
    }

    fn names(&self) -> Vec<String> {
        self.by_name.keys().cloned().collect()
    }

    fn awaits(&self, name: &str) -> bool {
        self.awaited.contains(name)
    }

    fn whole_number(&self, name: &str) -> Option<i64> {
        self.find(name)?.whole
    }

    fn origin(&self, symbol: Symbol) -> SymbolOrigin<'_> {
        let entry = self.entry(symbol);
        match (entry.meaning, &entry.definition) {
            (_, Some(formula)) => SymbolOrigin::Defined(formula),
            (Meaning::State(_), None) => SymbolOrigin::Variable,
            (_, None) if entry.reach == Dependence::Parameters => SymbolOrigin::Constant,
            _ => SymbolOrigin::Computed,
        }
    }
}
