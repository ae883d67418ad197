//! Formulas in MathML Core, which browsers typeset natively.

use liouville::formula::{Layout, Type};

/// Renders a formula in a line, or as a block if `display`.
pub fn formula(layout: &Layout, display: bool) -> String {
    let style = if display { " display=\"block\"" } else { "" };
    format!("<math{style}>{}</math>", row(layout))
}

/// Escapes the characters that XML would read as markup.
pub fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

/// Renders a box as one element.
fn row(layout: &Layout) -> String {
    match layout {
        Layout::Number(digits) => format!("<mn>{}</mn>", escaped(digits)),
        Layout::Name { letter, kind, index, primes } => name(letter, *kind, index, *primes),
        Layout::Word(word) => format!("<mi mathvariant=\"normal\">{word}</mi>"),
        Layout::Sign(sign) => format!("<mo>{}</mo>", escaped(sign)),
        Layout::Space => "<mspace width=\"0.17em\"/>".to_string(),
        Layout::Row(parts) => format!("<mrow>{}</mrow>", parts.iter().map(row).collect::<String>()),
        Layout::Fenced(open, inner, close) => {
            let (grows, inner) = (inner.is_tall(), row(inner));
            let fence = |form: &str, sign: &str| {
                format!("<mo fence=\"true\" form=\"{form}\" stretchy=\"{grows}\">{sign}</mo>")
            };
            format!("<mrow>{}{inner}{}</mrow>", fence("prefix", open), fence("postfix", close))
        }
        Layout::Fraction(above, below) => {
            format!("<mfrac>{}{}</mfrac>", row(above), row(below))
        }
        Layout::Root(inner) => format!("<msqrt>{}</msqrt>", row(inner)),
        Layout::Raised(base, exponent) => format!("<msup>{}{}</msup>", row(base), row(exponent)),
        Layout::Lowered(base, index) => format!("<msub>{}{}</msub>", row(base), row(index)),
        Layout::Matrix(rows) => {
            let cells = |line: &Vec<Layout>| -> String {
                line.iter().map(|cell| format!("<mtd>{}</mtd>", row(cell))).collect()
            };
            let lines: String =
                rows.iter().map(|line| format!("<mtr>{}</mtr>", cells(line))).collect();
            format!("<mrow><mo>(</mo><mtable>{lines}</mtable><mo>)</mo></mrow>")
        }
    }
}

fn name(letter: &str, kind: Type, index: &str, primes: usize) -> String {
    let class = match kind {
        Type::Scalar => "",
        Type::Vector(_) => " class=\"vector\"",
        Type::Matrix(..) => " class=\"matrix\"",
    };
    let (plain, tilde) = without_tilde(letter);
    let mut text = match plain.strip_prefix('∂').filter(|rest| !rest.is_empty()) {
        Some(rest) => format!("<mrow><mo>∂</mo><mi{class}>{}</mi></mrow>", escaped(rest)),
        None => format!("<mi{class}>{}</mi>", escaped(&plain)),
    };
    if tilde {
        text = format!("<mover accent=\"true\">{text}<mo>~</mo></mover>");
    }
    let primes = "′".repeat(primes);
    match (index.is_empty(), primes.is_empty()) {
        (true, true) => text,
        (false, true) => format!("<msub>{text}<mi mathvariant=\"normal\">{index}</mi></msub>"),
        (true, false) => format!("<msup>{text}<mo>{primes}</mo></msup>"),
        (false, false) => format!(
            "<msubsup>{text}<mi mathvariant=\"normal\">{index}</mi><mo>{primes}</mo></msubsup>"
        ),
    }
}

/// Letter without its tilde, and whether it had one.
pub fn without_tilde(letter: &str) -> (String, bool) {
    match letter.strip_suffix('\u{303}') {
        Some(rest) => (rest.to_string(), true),
        None if letter == "Ĩ" => ("I".to_string(), true),
        None => (letter.to_string(), false),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_have_accents_indices_and_primes() {
        let set = |text: &str, kind| formula(&Layout::name(text, kind), false);
        assert_eq!(set("m", Type::Scalar), "<math><mi>m</mi></math>", "a letter");
        assert_eq!(
            set("a_g", Type::Scalar),
            "<math><msub><mi>a</mi><mi mathvariant=\"normal\">g</mi></msub></math>",
            "an index"
        );
        assert_eq!(
            set("Ĩ", Type::MATRIX),
            "<math><mover accent=\"true\"><mi class=\"matrix\">I</mi><mo>~</mo></mover></math>",
            "a tilde"
        );
        assert_eq!(
            set("ω'", Type::VECTOR),
            "<math><msup><mi class=\"vector\">ω</mi><mo>′</mo></msup></math>",
            "a rate"
        );
    }
}
