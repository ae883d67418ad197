//! Formulas in LaTeX, with commands of amsmath only.

use super::mathml::without_tilde;
use liouville::formula::{Layout, Type};

/// Renders a formula in math mode, without the dollars.
pub fn formula(layout: &Layout) -> String {
    match layout {
        Layout::Number(digits) => digits.clone(),
        Layout::Name { letter, kind, index, primes } => name(letter, *kind, index, *primes),
        Layout::Word(word) => format!("\\operatorname{{{word}}}"),
        Layout::Sign(sign) => command(sign),
        Layout::Space => "\\,".to_string(),
        Layout::Row(parts) => parts.iter().map(formula).collect::<Vec<_>>().join(" "),
        Layout::Fenced(open, inner, close) if inner.is_tall() => {
            format!("\\left{open} {} \\right{close}", formula(inner))
        }
        Layout::Fenced("|", inner, _) => format!("\\lvert {} \\rvert", formula(inner)),
        Layout::Fenced(open, inner, close) => format!("{open}{}{close}", formula(inner)),
        Layout::Fraction(above, below) => {
            format!("\\frac{{{}}}{{{}}}", formula(above), formula(below))
        }
        Layout::Root(inner) => format!("\\sqrt{{{}}}", formula(inner)),
        Layout::Raised(base, exponent) => {
            format!("{{{}}}^{{{}}}", formula(base), formula(exponent))
        }
        Layout::Lowered(base, index) => format!("{{{}}}_{{{}}}", formula(base), formula(index)),
        Layout::Matrix(rows) => {
            let line = |row: &Vec<Layout>| row.iter().map(formula).collect::<Vec<_>>().join(" & ");
            let lines = rows.iter().map(line).collect::<Vec<_>>().join(" \\\\ ");
            format!("\\begin{{pmatrix}} {lines} \\end{{pmatrix}}")
        }
    }
}

fn command(sign: &str) -> String {
    match sign {
        "−" => "-".to_string(),
        "×" => "\\times".to_string(),
        "⊗" => "\\otimes".to_string(),
        "·" => "\\cdot".to_string(),
        "↦" => "\\mapsto".to_string(),
        "∫" => "\\int".to_string(),
        other => other.to_string(),
    }
}

fn name(letter: &str, kind: Type, index: &str, primes: usize) -> String {
    let (plain, tilde) = without_tilde(letter);
    let (before, plain) = match plain.strip_prefix('∂').filter(|rest| !rest.is_empty()) {
        Some(rest) => ("\\partial ", rest.to_string()),
        None => ("", plain),
    };
    let mut text = match (kind, plain.chars().count()) {
        (_, 2..) => format!("\\mathit{{{}}}", plain.chars().map(letters).collect::<String>()),
        (Type::Scalar, _) => letters_of(&plain),
        (Type::Vector(_) | Type::Matrix(..), _) => {
            format!("\\boldsymbol{{{}}}", letters_of(&plain))
        }
    };
    if tilde {
        text = format!("\\tilde{{{text}}}");
    }
    let index = match index.is_empty() {
        true => String::new(),
        false => format!("_{{{index}}}"),
    };
    format!("{before}{text}{index}{}", "'".repeat(primes))
}

fn letters_of(text: &str) -> String {
    text.chars().map(letters).collect::<String>().trim_end().to_string()
}

/// Greek letters as commands.
fn letters(letter: char) -> String {
    let name = match letter {
        'α' => "alpha",
        'β' => "beta",
        'γ' => "gamma",
        'δ' => "delta",
        'ε' => "varepsilon",
        'ζ' => "zeta",
        'η' => "eta",
        'θ' => "theta",
        'ι' => "iota",
        'κ' => "kappa",
        'λ' => "lambda",
        'μ' => "mu",
        'ν' => "nu",
        'ξ' => "xi",
        'π' => "pi",
        'ρ' => "rho",
        'σ' => "sigma",
        'τ' => "tau",
        'φ' => "varphi",
        'χ' => "chi",
        'ψ' => "psi",
        'ω' => "omega",
        'Γ' => "Gamma",
        'Δ' => "Delta",
        'Θ' => "Theta",
        'Λ' => "Lambda",
        'Ξ' => "Xi",
        'Π' => "Pi",
        'Σ' => "Sigma",
        'Φ' => "Phi",
        'Ψ' => "Psi",
        'Ω' => "Omega",
        '𝒥' => return "\\mathcal{J}".to_string(),
        other => return other.to_string(),
    };
    format!("\\{name} ")
}

/// Escapes the characters that LaTeX would read as commands.
pub fn escaped(text: &str) -> String {
    let mut out = String::new();
    for c in text.chars() {
        match c {
            '&' | '%' | '$' | '#' | '_' | '{' | '}' => out.extend(['\\', c]),
            '~' => out.push_str("\\textasciitilde{}"),
            '^' => out.push_str("\\textasciicircum{}"),
            '\\' => out.push_str("\\textbackslash{}"),
            c => out.push(c),
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn special_characters_are_escaped() {
        assert_eq!(escaped("a_1^2 & {50%}"), "a\\_1\\textasciicircum{}2 \\& \\{50\\%\\}");
    }
}
