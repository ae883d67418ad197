//! Tokens of a formula: characters without grammar.

use super::error::{FormulaError, Span};
use super::names::identifier_length;

/// Kind of a token; the texts of numbers and names are read off the span.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum TokenKind {
    Number,
    Name,
    /// A power written above the line: `²`, `⁻¹`.
    Superscript,
    Transpose,
    Plus,
    Minus,
    Cross,
    Outer,
    Times,
    Slash,
    Caret,
    Root,
    Integral,
    Open,
    Close,
    OpenSquare,
    CloseSquare,
    Bar,
    Comma,
    /// The sign `..` between the ends of a range.
    Range,
    /// A comparison such as `=`, `≠`, `<` in a condition on indices.
    Comparison,
    /// End of the text; its span is empty.
    End,
}

/// Token with its place.
#[derive(Clone, Debug)]
pub(super) struct Token {
    pub kind: TokenKind,
    pub span: Span,
}

/// Splits a formula into tokens, an [`TokenKind::End`] last.
pub(super) fn tokens(text: &str) -> Result<Vec<Token>, FormulaError> {
    let mut tokens = Vec::new();
    let mut start = 0;
    while let Some(first) = text[start..].chars().next() {
        if first.is_whitespace() {
            start += first.len_utf8();
            continue;
        }
        let (kind, length) = token(&text[start..], first)
            .ok_or_else(|| stray(first, start..start + first.len_utf8(), &text[..start]))?;
        tokens.push(Token { kind, span: start..start + length });
        start += length;
    }
    tokens.push(Token { kind: TokenKind::End, span: start..start });
    Ok(tokens)
}

/// Reads the token at the start of `rest`; returns its kind and its length in bytes.
fn token(rest: &str, first: char) -> Option<(TokenKind, usize)> {
    if let Some(length) = comparison_length(rest) {
        return Some((TokenKind::Comparison, length));
    }
    if rest.starts_with("..") {
        return Some((TokenKind::Range, 2));
    }
    let sign = match first {
        '+' => TokenKind::Plus,
        '-' | '−' | '–' => TokenKind::Minus,
        '×' | '⨯' => TokenKind::Cross,
        '⊗' => TokenKind::Outer,
        '*' | '·' | '⋅' | '∙' | '∗' => TokenKind::Times,
        '/' => TokenKind::Slash,
        '^' => TokenKind::Caret,
        '√' => TokenKind::Root,
        '∫' => TokenKind::Integral,
        'ᵀ' | '⊤' => TokenKind::Transpose,
        '(' => TokenKind::Open,
        ')' => TokenKind::Close,
        '[' => TokenKind::OpenSquare,
        ']' => TokenKind::CloseSquare,
        '|' => TokenKind::Bar,
        ',' => TokenKind::Comma,
        '…' | '‥' => TokenKind::Range,
        _ => {
            return [
                (TokenKind::Number, number_length(rest)),
                (TokenKind::Superscript, superscript_length(rest)),
                (TokenKind::Name, identifier_length(rest)),
            ]
            .into_iter()
            .find(|(_, length)| *length > 0);
        }
    };
    Some((sign, first.len_utf8()))
}

/// Length in bytes of a comparison sign at the start of the text.
fn comparison_length(text: &str) -> Option<usize> {
    let signs = ["!=", "<=", ">=", "==", "≠", "≤", "≥", "=", "<", ">"];
    signs.into_iter().find(|sign| text.starts_with(sign)).map(str::len)
}

/// Length in bytes of a number at the start of the text: `12`, `3.5`, `.5`, `1e-3`.
fn number_length(text: &str) -> usize {
    if let Some(c) = text.chars().next().filter(|c| fraction(*c).is_some()) {
        return c.len_utf8();
    }
    let bytes = text.as_bytes();
    let digits =
        |from: usize| bytes.iter().skip(from).take_while(|byte| byte.is_ascii_digit()).count();
    let mut length = digits(0);
    if bytes.get(length) == Some(&b'.') && digits(length + 1) > 0 {
        length += 1 + digits(length + 1);
    }
    if length > 0 && matches!(bytes.get(length), Some(b'e' | b'E')) {
        let sign = usize::from(matches!(bytes.get(length + 1), Some(b'+' | b'-')));
        let exponent = digits(length + 1 + sign);
        // without digits the e is the start of a name: `2e`
        length += if exponent > 0 { 1 + sign + exponent } else { 0 };
    }
    length
}

/// Plain form of `½` and the like.
pub(super) fn fraction(c: char) -> Option<&'static str> {
    let known = [('½', "1/2"), ('⅓', "1/3"), ('⅔', "2/3"), ('¼', "1/4"), ('¾', "3/4")];
    known.into_iter().find(|(sign, _)| *sign == c).map(|(_, text)| text)
}

fn superscript_length(text: &str) -> usize {
    let sign = text.chars().next().filter(|c| matches!(c, '⁻' | '⁺')).map_or(0, char::len_utf8);
    let digits = &text[sign..];
    let length = digits.find(|c| superscript_digit(c).is_none()).unwrap_or(digits.len());
    if length > 0 { sign + length } else { 0 }
}

fn superscript_digit(c: char) -> Option<char> {
    let digit = "⁰¹²³⁴⁵⁶⁷⁸⁹".chars().position(|known| known == c)?;
    char::from_digit(u32::try_from(digit).ok()?, 10)
}

/// Number that a superscript raises to, in ordinary digits.
pub(super) fn superscript_number(text: &str) -> String {
    let plain = |c| match c {
        '⁻' => Some('-'),
        '⁺' => None,
        _ => superscript_digit(c),
    };
    text.chars().filter_map(plain).collect()
}

/// Modules of other languages, before whose functions they stand.
const MODULES: [&str; 9] = ["np", "math", "numpy", "Math", "sympy", "sp", "jnp", "mpmath", "torch"];

/// Whether a text ends with this word.
fn is_last_word(text: &str, word: &str) -> bool {
    text.strip_suffix(word).is_some_and(|rest| !rest.ends_with(|c: char| c.is_alphanumeric()))
}

/// The error for a character without meaning; `before` is the text before it.
fn stray(c: char, span: Span, before: &str) -> FormulaError {
    let error = FormulaError::new(span, format!("`{c}` has no meaning in a formula"));
    match c {
        '.' if MODULES.iter().any(|own| is_last_word(before, own)) => {
            error.with_help("functions are written by their names alone, as `sin(x)`")
        }
        '.' if follows_a_name(before) => {
            error.with_help("a dot product is written `(a,b)`, a component `a[1]`")
        }
        '.' => error.with_help("a number has digits on both sides of its point, as in 3.5"),
        '{' | '}' => error
            .with_help("group with ( ); a bracket {F,G} is claimed by bracket = [\"F\", \"G\"]"),
        '⟨' | '⟩' | '〈' | '〉' => error.with_help("a dot product is written `(a,b)`"),
        '∧' => error.with_help("a cross product is written `a × b`"),
        '⊙' | '∘' | '⊤' | '†' => error.with_help("products are `a*b`, `(a,b)` and `a × b`"),
        '∇' => error.with_help(
            "derivatives are taken for you: rate = \"F\" claims the rate of F, a slope is `∂F/∂x`, and −∇h of \
             a rolling body is `r`",
        ),
        '$' => error.with_help("formulas are not LaTeX: leave the dollars out"),
        '“' | '”' | '„' | '‘' | '’' | '"' => error.with_help("leave these quotes out"),
        '±' => error.with_help("a parameter takes a range: \"0.9..1.1\""),
        '_' => error.with_help("a component is written `a[1]`, a norm `|a|`"),
        '‖' => error.with_help("write a norm as |a|"),
        '⁻' | '⁺' => error.with_help("digits follow the sign, as in ⁻¹"),
        ';' => error.with_help("separate with `,`"),
        '\\' => error.with_help("formulas are not LaTeX: write `a/b`, `√a`, `γ`, `a*b`"),
        '&' => error.with_help("write conditions one after the other, separated by commas"),
        '!' => error.with_help("write n! as `product(k, 1..n, k)`"),
        '%' => error.with_help("write 5 % as 0.05; a remainder is `k mod n`, in an index"),
        '∛' => error.with_help("write `x^(1/3)`"),
        '÷' | ':' | '⁄' | '∕' => error.with_help("write `a/b`"),
        _ => error
            .with_help("formulas have names, numbers and the signs + − * / ^ √ × ⊗ ∫ | ( ) [ ]"),
    }
}

/// Whether a text ends with a name, or a bracket, in place of a number.
fn follows_a_name(text: &str) -> bool {
    let text = text.trim_end();
    let bare = text.trim_end_matches(|c: char| c.is_ascii_digit());
    bare.ends_with(|c: char| c.is_alphabetic() || matches!(c, ')' | ']' | '\'' | '_'))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn kinds(text: &str) -> Vec<TokenKind> {
        tokens(text).expect("tokens").into_iter().map(|token| token.kind).collect()
    }

    #[test]
    fn numbers_stop_where_names_begin() {
        use TokenKind::{End, Name, Number};
        assert_eq!(kinds("2m"), [Number, Name, End], "a factor without its sign");
        assert_eq!(kinds("2e"), [Number, Name, End], "e without digits is a name");
        assert_eq!(kinds("2.5e-3"), [Number, End], "an exponent");
        assert_eq!(kinds(".5"), [Number, End], "a leading point");
        assert_eq!(kinds("f2'"), [Name, End], "digits and primes inside a name");
    }

    #[test]
    fn superscripts_and_transposes_end_a_name() {
        use TokenKind::{End, Name, Superscript, Transpose};
        assert_eq!(kinds("γ²"), [Name, Superscript, End], "a square");
        assert_eq!(kinds("B⁻¹"), [Name, Superscript, End], "an inverse");
        assert_eq!(kinds("Bᵀ"), [Name, Transpose, End], "a transpose");
        assert_eq!(superscript_number("⁻¹²"), "-12", "read as a number");
    }

    #[test]
    fn every_span_lies_on_character_boundaries() {
        let text = "|Ĩ*ω × γ|² − 2·𝒥ᵀ[1,2]";
        let spans: Vec<Span> =
            tokens(text).expect("tokens").into_iter().map(|token| token.span).collect();
        assert_eq!(&text[spans[1].clone()], "Ĩ", "a letter with its tilde");
        assert!(spans.iter().all(|span| text.get(span.clone()).is_some()), "sliceable");
    }

    #[test]
    fn stray_characters_are_named() {
        let error = tokens("a ? b").expect_err("not a formula");
        assert_eq!((error.message(), error.span()), ("`?` has no meaning in a formula", 2..3));
        let error = tokens("ω.γ").expect_err("not a formula");
        assert_eq!(error.help(), Some("a dot product is written `(a,b)`, a component `a[1]`"));
        let error = tokens("3.").expect_err("not a number");
        assert_eq!(error.help(), Some("a number has digits on both sides of its point, as in 3.5"));
    }

    #[test]
    fn ranges_and_comparisons_are_signs() {
        use TokenKind::{Comparison, End, Name, Number, Range};
        assert_eq!(kinds("1..n"), [Number, Range, Name, End], "not the number 1.");
        assert_eq!(kinds("0.5..2"), [Number, Range, Number, End], "decimals end before it");
        assert_eq!(kinds("i ≠ j"), [Name, Comparison, Name, End], "one sign");
        assert_eq!(kinds("i<=j"), [Name, Comparison, Name, End], "two characters, one sign");
    }
}
