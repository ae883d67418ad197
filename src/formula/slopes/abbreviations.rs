//! The chain rule through abbreviations, and names whose derivative is not known.

use super::super::Formula;
use super::super::arena::{NodeId, NodeOperation};
use super::super::error::FormulaError;
use super::super::scope::{Symbol, SymbolOrigin};
use super::{Slope, Slopes};

/// Limit on the abbreviations that are made of one another.
const MOST_NESTED: usize = 100;

impl Slopes<'_, '_> {
    pub(super) fn symbol(&mut self, symbol: Symbol) -> Slope {
        let scope = self.scope;
        match scope.origin(symbol) {
            SymbolOrigin::Variable | SymbolOrigin::Constant => Ok(None),
            SymbolOrigin::Computed => Err(self.opaque(symbol)),
            SymbolOrigin::Defined(formula) => {
                if !self.depends(formula, 0)? {
                    return Ok(None);
                }
                let root = match self.written_out.get(&symbol) {
                    Some(root) => *root,
                    None => self.write_out(symbol, formula),
                };
                if self.depth == MOST_NESTED {
                    return Err(self.too_deep());
                }
                self.depth += 1;
                let slope = self.slope(root);
                self.depth -= 1;
                slope
            }
        }
    }

    fn too_deep(&self) -> FormulaError {
        let help = format!("at most {MOST_NESTED} abbreviations may be made of one another");
        self.refused("this derivative is nested too deeply", &help)
    }

    fn opaque(&self, symbol: Symbol) -> FormulaError {
        let symbols = &self.builder.arena.symbols;
        let slot = symbols.iter().position(|(own, _)| *own == symbol);
        let name = slot.map_or("this", |slot| self.builder.arena.names[slot].as_str());
        let what = format!("`{name}` is computed by the system, and has no derivative here");
        self.refused(&what, "write it as a formula of the state variables")
    }

    /// Whether a formula depends on the variable, also through abbreviations.
    fn depends(&mut self, formula: &Formula, depth: usize) -> Result<bool, FormulaError> {
        if depth == MOST_NESTED {
            return Err(self.too_deep());
        }
        let scope = self.scope;
        let mut any = false;
        for symbol in formula.symbols() {
            let known = self.dependent.get(&symbol).copied();
            let depends = match (known, scope.origin(symbol)) {
                (Some(known), _) => known,
                (None, SymbolOrigin::Defined(inner)) => self.depends(inner, depth + 1)?,
                // refused when it is met
                (None, SymbolOrigin::Computed) => true,
                (None, SymbolOrigin::Variable | SymbolOrigin::Constant) => false,
            };
            self.dependent.insert(symbol, depends);
            any |= depends;
        }
        Ok(any)
    }

    /// Appends the nodes of an abbreviation.
    fn write_out(&mut self, symbol: Symbol, formula: &Formula) -> NodeId {
        let arena = &mut self.builder.arena;
        let mut map: Vec<NodeId> = Vec::new();
        for own in &formula.arena.nodes {
            let span = self.span.clone();
            map.push(match &own.operation {
                NodeOperation::Symbol(slot) => {
                    let (symbol, kind) = formula.arena.symbols[*slot];
                    arena.push_symbol(symbol, kind, span, || formula.arena.names[*slot].clone())
                }
                other => arena.push(other.on(|node| map[node]), own.value_type, span),
            });
        }
        for symbol in &formula.arena.fixed {
            if !arena.fixed.contains(symbol) {
                arena.fixed.push(*symbol);
            }
        }
        let root = arena.nodes.len() - 1;
        self.written_out.insert(symbol, root);
        root
    }
}
