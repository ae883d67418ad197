//! Binding strength of the text of a formula: where it needs brackets inside another.

use super::lexer::{TokenKind, tokens};

/// Operator that a text consists of at its loosest, loosest first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Bond {
    /// `a + b`, `a − b`
    Sum,
    /// `a × b`, `a ⊗ b`
    Cross,
    /// `a*b`, `a/b`
    Product,
    /// `−a`, `√a`
    Prefix,
    /// `a^b`, `a²`, `Aᵀ`
    Power,
    /// A name, a number, a call, or anything between brackets.
    Whole,
}

/// Loosest operator of a text outside of all brackets.
pub(super) fn bond(text: &str) -> Bond {
    let Ok(tokens) = tokens(text) else { return Bond::Sum };
    let mut loosest = Bond::Whole;
    let mut open = Vec::new();
    let (mut wants_operand, mut in_exponent) = (true, false);
    for token in &tokens {
        let outside = open.is_empty();
        let found = match token.kind {
            TokenKind::Open | TokenKind::OpenSquare => {
                open.push(token.kind);
                wants_operand = true;
                continue;
            }
            TokenKind::Bar if wants_operand => {
                open.push(TokenKind::Bar);
                continue;
            }
            TokenKind::Close | TokenKind::CloseSquare | TokenKind::Bar => {
                open.pop();
                (wants_operand, in_exponent) = (false, false);
                continue;
            }
            // a^−b is one power
            TokenKind::Minus | TokenKind::Root if wants_operand && in_exponent => continue,
            TokenKind::Minus | TokenKind::Root if wants_operand => Bond::Prefix,
            TokenKind::Plus | TokenKind::Minus => Bond::Sum,
            TokenKind::Cross | TokenKind::Outer => Bond::Cross,
            TokenKind::Times | TokenKind::Slash => Bond::Product,
            TokenKind::Caret | TokenKind::Superscript | TokenKind::Transpose => Bond::Power,
            _ => Bond::Whole,
        };
        wants_operand = match token.kind {
            TokenKind::Superscript | TokenKind::Transpose => false,
            TokenKind::Comma => true,
            _ => found != Bond::Whole,
        };
        in_exponent = token.kind == TokenKind::Caret;
        if outside {
            loosest = loosest.min(found);
        }
    }
    loosest
}

/// Whether the text begins with a minus, and needs brackets after another operator.
pub(super) fn is_signed(text: &str) -> bool {
    text.starts_with(['-', '−', '–'])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_loosest_operator_counts() {
        for (text, expected) in [
            ("a + b*c", Bond::Sum),
            ("−a + b", Bond::Sum),
            ("a × b", Bond::Cross),
            ("−a*b", Bond::Product),
            ("(a + b)/c", Bond::Product),
            ("|a × b|*c", Bond::Product),
            ("√a", Bond::Prefix),
            ("−x²", Bond::Prefix),
            ("x^−2", Bond::Power),
            ("x^(1/2)", Bond::Power),
            ("|a × b|²", Bond::Power),
            ("I⁻¹", Bond::Power),
            ("(a + b)", Bond::Whole),
            ("|a − |b||", Bond::Whole),
            ("[a + b, −c]", Bond::Whole),
            ("γ[3]", Bond::Whole),
            ("exp(a + b)", Bond::Whole),
            ("1/2", Bond::Product),
            ("0.5", Bond::Whole),
        ] {
            assert_eq!(bond(text), expected, "{text}");
        }
    }
}
