//! Abbreviations written out in a formula that contains derivatives of them.

use super::Formula;
use super::arena::{Arena, NodeId, NodeOperation};
use super::scope::Symbol;

impl Formula {
    /// Writes a name of the same type out as a formula, also in derivatives; the result has another text.
    pub(crate) fn with_written_out(&self, name: Symbol, by: &Formula, text: &str) -> Formula {
        let mut arena = Arena::default();
        let mut map: Vec<NodeId> = Vec::new();
        for (node, own) in self.arena.nodes.iter().enumerate() {
            let is_named = match own.operation {
                NodeOperation::Symbol(slot) => self.arena.symbols[slot].0 == name,
                _ => false,
            };
            let last = match is_named {
                true => append(&mut arena, by, &mut Vec::new(), 0..by.arena.nodes.len(), text),
                false => append(&mut arena, self, &mut map, node..node + 1, text),
            };
            if is_named {
                map.push(last);
            }
        }
        let fixed = self.arena.fixed.iter().chain(&by.arena.fixed).filter(|own| **own != name);
        for symbol in fixed {
            if !arena.fixed.contains(symbol) {
                arena.fixed.push(*symbol);
            }
        }
        Formula { text: text.to_string(), arena }
    }
}

/// Appends nodes of a formula, and returns the last one; `map` has the new places of those before them.
fn append(
    arena: &mut Arena,
    formula: &Formula,
    map: &mut Vec<NodeId>,
    nodes: std::ops::Range<NodeId>,
    text: &str,
) -> NodeId {
    for own in &formula.arena.nodes[nodes] {
        let span = 0..text.len();
        map.push(match &own.operation {
            NodeOperation::Symbol(slot) => {
                let (symbol, kind) = formula.arena.symbols[*slot];
                arena.push_symbol(symbol, kind, span, || formula.arena.names[*slot].clone())
            }
            other => arena.push(other.on(|node| map[node]), own.value_type, span),
        });
    }
    arena.nodes.len() - 1
}
