//! Substitution of a formula for a name.

use crate::order::StableOrder;

use super::arena::{Arena, ElementaryFunction, Node, NodeId, NodeOperation};
use super::binders::is_form;
use super::bond::{Bond, is_signed};
use super::compose::FormulaResult;
use super::error::{FormulaError, Span};
use super::kind::Type;
use super::lexer::{TokenKind, tokens};
use super::typing::{Builder, Infix, Operand};
use super::{Formula, canonical_name, functions};

/// A piece of the text and what is written in its place.
struct Edit {
    span: Span,
    text: String,
    /// Place of the other formula's text in the new piece.
    inside: usize,
    /// Length of the index written behind it, where a component stood.
    index: usize,
}

impl Formula {
    /// Replaces a name, and its components, by a formula of the same type.
    ///
    /// The names of both formulas keep their meaning: those of `by` belong to its own scope, which
    /// has to be an extension of this formula's scope or the other way round.
    ///
    /// # Errors
    /// The types differ, the name stands in an index or in an indexed form such as `sum`, or
    /// something would be divided by zero.
    pub fn substitute(&self, name: &str, by: &Formula) -> FormulaResult {
        let canonical = canonical_name(name);
        let name = canonical.as_deref().unwrap_or(name);
        let Some(slot) = self.arena.names.iter().position(|own| own == name) else {
            return Ok(self.clone());
        };
        let (symbol, kind) = self.arena.symbols[slot];
        let whole = 0..self.text.len();
        if kind != by.value_type() {
            let message = format!("`{name}` is a {kind}, and `{by}` is a {}", by.value_type());
            return Err(FormulaError::new(whole, message));
        }
        if self.arena.fixed.contains(&symbol) {
            let message = format!("`{name}` is used in an index or a size, and cannot be replaced");
            return Err(FormulaError::new(whole, message));
        }
        self.without_forms()?;
        let edits = self.edits(slot, name, by)?;
        let mut text = String::new();
        let mut done = 0;
        for edit in &edits {
            text.push_str(&self.text[done..edit.span.start]);
            text.push_str(&edit.text);
            done = edit.span.end;
        }
        text.push_str(&self.text[done..]);
        let arena = Rebuilding { formula: self, by, slot, edits: &edits }.run(&text)?;
        Ok(Formula { text, arena })
    }

    /// Fails where an index of a form could catch a name, and in derivatives.
    fn without_forms(&self) -> Result<(), FormulaError> {
        let derivative = |node: &&Node| matches!(node.operation, NodeOperation::Partial { .. });
        if let Some(node) = self.arena.nodes.iter().find(derivative) {
            let message = "nothing can be put into a derivative";
            return Err(FormulaError::new(node.span.clone(), message));
        }
        let tokens = tokens(&self.text)?;
        let calls = tokens.iter().zip(tokens.iter().skip(1));
        let is_call =
            |kind: TokenKind, next: TokenKind| kind == TokenKind::Name && next == TokenKind::Open;
        for (token, _) in calls.filter(|(own, next)| is_call(own.kind, next.kind)) {
            let name = &self.text[token.span.clone()];
            if is_form(name) && !self.arena.names.iter().any(|own| own == name) {
                let message = format!("nothing can be put into `{name}(…)`, which has an index");
                return Err(FormulaError::new(token.span.clone(), message));
            }
        }
        Ok(())
    }

    /// Changes of the text, in its order.
    fn edits(&self, slot: usize, name: &str, by: &Formula) -> Result<Vec<Edit>, FormulaError> {
        let all = tokens(&self.text)?;
        let mut edits: Vec<Edit> = Vec::new();
        for (node, own) in self.arena.nodes.iter().enumerate() {
            if own.operation != NodeOperation::Symbol(slot) {
                continue;
            }
            // brackets around a name belong to its node
            let place = all.iter().position(|token| {
                token.kind == TokenKind::Name
                    && own.span.start <= token.span.start
                    && token.span.end <= own.span.end
            });
            let Some(place) = place else { continue };
            let span = all[place].span.clone();
            if edits.iter().any(|edit| edit.span == span) {
                continue;
            }
            let written = canonical_name(&self.text[span.clone()]);
            let is_whole = written.as_deref() == Some(name);
            let index = match self.arena.nodes.get(node + 1).map(|next| &next.operation) {
                Some(NodeOperation::Component(_, i)) if !is_whole => format!("[{}]", i + 1),
                Some(NodeOperation::Entry(_, i, j)) if !is_whole => {
                    format!("[{},{}]", i + 1, j + 1)
                }
                _ => String::new(),
            };
            let before = all[..place].last().map(|token| token.kind);
            let after = all.get(place + 1).map_or(TokenKind::End, |token| token.kind);
            let wants = before.filter(|_| place > 0).map_or(Bond::Sum, |kind| {
                let starts = |kind: TokenKind| {
                    matches!(kind, TokenKind::Open | TokenKind::OpenSquare | TokenKind::Comma)
                };
                let is_prefix = place < 2
                    || starts(all[place - 2].kind)
                    || matches!(
                        all[place - 2].kind,
                        TokenKind::Times | TokenKind::Slash | TokenKind::Caret
                    );
                behind(kind, is_prefix)
            });
            let wants = if index.is_empty() { wants.max(before_sign(after)) } else { Bond::Whole };
            let follows_operator = before.is_some_and(|kind| behind(kind, true) > Bond::Sum);
            let in_brackets = by.bond() < wants || (follows_operator && is_signed(by.written()));
            let (open, close) = if in_brackets { ("(", ")") } else { ("", "") };
            let text = format!("{open}{}{close}{index}", by.written());
            edits.push(Edit { span, text, inside: open.len(), index: index.len() });
        }
        edits.order_by_key(|edit| edit.span.start);
        Ok(edits)
    }
}

/// Bond required behind an operator.
fn behind(operator: TokenKind, is_prefix: bool) -> Bond {
    match operator {
        TokenKind::Minus if is_prefix => Bond::Power,
        TokenKind::Plus | TokenKind::Minus => Bond::Cross,
        TokenKind::Cross | TokenKind::Outer => Bond::Product,
        TokenKind::Times | TokenKind::Slash => Bond::Prefix,
        TokenKind::Root => Bond::Power,
        TokenKind::Caret => Bond::Whole,
        _ => Bond::Sum,
    }
}

/// Bond required before an operator.
fn before_sign(operator: TokenKind) -> Bond {
    match operator {
        TokenKind::Cross | TokenKind::Outer | TokenKind::Times | TokenKind::Slash => Bond::Product,
        TokenKind::Caret
        | TokenKind::Superscript
        | TokenKind::Transpose
        | TokenKind::OpenSquare => Bond::Whole,
        _ => Bond::Sum,
    }
}

/// The tree of a formula, built again with another formula for a symbol.
struct Rebuilding<'f> {
    formula: &'f Formula,
    by: &'f Formula,
    slot: usize,
    edits: &'f [Edit],
}

impl Rebuilding<'_> {
    fn run(&self, text: &str) -> Result<Arena, FormulaError> {
        let mut builder = Builder { arena: Arena::default(), text };
        let mut map: Vec<NodeId> = Vec::new();
        for own in &self.formula.arena.nodes {
            let span = self.moved(own.span.start, false)..self.moved(own.span.end, true);
            let node = match &own.operation {
                NodeOperation::Symbol(slot) if *slot == self.slot => {
                    self.put(&mut builder, &own.span, span)
                }
                NodeOperation::Symbol(slot) => {
                    let (symbol, kind) = self.formula.arena.symbols[*slot];
                    let name = || self.formula.arena.names[*slot].clone();
                    builder.arena.push_symbol(symbol, kind, span, name)
                }
                other => folded(&mut builder, &other.on(|node| map[node]), own.value_type, span)?,
            };
            map.push(node);
        }
        for symbol in self.formula.arena.fixed.iter().chain(&self.by.arena.fixed) {
            if !builder.arena.fixed.contains(symbol) {
                builder.arena.fixed.push(*symbol);
            }
        }
        Ok(builder.arena)
    }

    /// New place of a place in the text; inside a piece that is replaced, its beginning or its end.
    fn moved(&self, place: usize, is_end: bool) -> usize {
        let mut at = place;
        for edit in self.edits {
            let (start, end) = (edit.span.start, edit.span.end);
            if place >= end && (place > start || is_end) {
                at = at + edit.text.len() - (end - start);
            } else if place > start {
                let before = at - (place - start);
                return if is_end { before + edit.text.len() } else { before };
            }
        }
        at
    }

    /// Appends the other formula in the place of a symbol.
    fn put(&self, builder: &mut Builder<'_>, old: &Span, span: Span) -> NodeId {
        let inside = |edit: &&Edit| old.start <= edit.span.start && edit.span.end <= old.end;
        let edit = self.edits.iter().find(inside);
        let start =
            edit.map_or(span.start, |edit| self.moved(edit.span.start, false) + edit.inside);
        let span = span.start..span.end - edit.map_or(0, |edit| edit.index);
        let mut map: Vec<NodeId> = Vec::new();
        for own in &self.by.arena.nodes {
            let moved = |place: usize| (place + start).saturating_sub(self.by.leading());
            let span = moved(own.span.start)..moved(own.span.end);
            map.push(match &own.operation {
                NodeOperation::Symbol(slot) => {
                    let (symbol, kind) = self.by.arena.symbols[*slot];
                    let name = || self.by.arena.names[*slot].clone();
                    builder.arena.push_symbol(symbol, kind, span, name)
                }
                other => builder.arena.push(other.on(|node| map[node]), own.value_type, span),
            });
        }
        let last = builder.arena.nodes.len() - 1;
        builder.arena.nodes[last].span = span;
        last
    }
}

/// Appends an operation, as its value where its operands have become numbers.
fn folded(
    builder: &mut Builder<'_>,
    operation: &NodeOperation,
    kind: Type,
    span: Span,
) -> Result<NodeId, FormulaError> {
    let at = |builder: &Builder<'_>, node: NodeId| -> Operand {
        builder.operand(node, builder.arena.nodes[node].span.clone())
    };
    let infix = |builder: &mut Builder<'_>, infix: Infix, a: NodeId, b: NodeId| {
        let (a, b) = (at(builder, a), at(builder, b));
        builder.infix(infix, &a, &b).map(|built| built.node)
    };
    let node = match *operation {
        NodeOperation::Add(a, b) => infix(builder, Infix::Add, a, b)?,
        NodeOperation::Subtract(a, b) => infix(builder, Infix::Subtract, a, b)?,
        NodeOperation::Multiply(a, b) => infix(builder, Infix::Multiply, a, b)?,
        NodeOperation::Divide(a, b) => infix(builder, Infix::Divide, a, b)?,
        NodeOperation::Negate(a) => {
            let a = at(builder, a);
            builder.negate(&a, span.clone()).node
        }
        NodeOperation::Function(ElementaryFunction::Modulus, a) => {
            let a = at(builder, a);
            builder.modulus(&a, span.clone())?.node
        }
        NodeOperation::Extreme(which, ref parts) => {
            let parts: Vec<Operand> = parts.iter().map(|part| at(builder, *part)).collect();
            functions::extreme(builder, which, &parts, span.clone())?.node
        }
        NodeOperation::Power(a, ref exponent) => {
            let a = at(builder, a);
            let exponent_span = a.span.end..span.end;
            builder.constant_power(&a, exponent, exponent_span, span.clone())?.node
        }
        NodeOperation::PowerOf(a, b) => {
            let (a, b) = (at(builder, a), at(builder, b));
            builder.power(&a, &b)?.node
        }
        _ => return Ok(builder.arena.push(operation.clone(), kind, span)),
    };
    // the builder does not know of brackets around the operation
    builder.arena.nodes[node].span = span;
    Ok(node)
}
