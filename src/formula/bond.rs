//! Binding strength of the text of a formula: where it needs brackets inside another.

use super::lexer::{Kind, tokens};

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
            Kind::Open | Kind::OpenSquare => {
                open.push(token.kind);
                wants_operand = true;
                continue;
            }
            Kind::Bar if wants_operand => {
                open.push(Kind::Bar);
                continue;
            }
            Kind::Close | Kind::CloseSquare | Kind::Bar => {
                open.pop();
                (wants_operand, in_exponent) = (false, false);
                continue;
            }
            // a^−b is one power
            Kind::Minus | Kind::Root if wants_operand && in_exponent => continue,
            Kind::Minus | Kind::Root if wants_operand => Bond::Prefix,
            Kind::Plus | Kind::Minus => Bond::Sum,
            Kind::Cross | Kind::Outer => Bond::Cross,
            Kind::Times | Kind::Slash => Bond::Product,
            Kind::Caret | Kind::Superscript | Kind::Transpose => Bond::Power,
            _ => Bond::Whole,
        };
        wants_operand = match token.kind {
            Kind::Superscript | Kind::Transpose => false,
            Kind::Comma => true,
            _ => found != Bond::Whole,
        };
        in_exponent = token.kind == Kind::Caret;
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
