//! Formulas in LaTeX, with commands of amsmath only.

use super::mathml::without_tilde;
use liouville::formula::{Layout, Type, ascii_name};

/// Functions that LaTeX has as commands.
const COMMANDS: [&str; 13] =
    ["sin", "cos", "tan", "cot", "sinh", "cosh", "tanh", "exp", "ln", "log", "det", "max", "min"];

/// Renders a formula in math mode, without the dollars.
pub fn formula(layout: &Layout) -> String {
    match layout {
        Layout::Number(digits) => digits.clone(),
        Layout::Name { letter, kind, index, primes } => name(letter, *kind, index, *primes),
        Layout::Word(word) if COMMANDS.contains(word) => format!("\\{word} "),
        Layout::Word(word) if word.ends_with(':') => format!("\\text{{{word}}}"),
        Layout::Word(word) => format!("\\operatorname{{{word}}}"),
        Layout::Sign(sign) => command(sign),
        Layout::Space => "\\,".to_string(),
        Layout::Row(parts) => parts.iter().map(formula).collect::<Vec<_>>().join(" "),
        Layout::Fenced(open, inner, close) if inner.is_tall() => {
            format!("\\left{} {} \\right{}", fence(open), formula(inner), fence(close))
        }
        Layout::Fenced("|", inner, _) => format!("\\lvert {} \\rvert", formula(inner)),
        Layout::Fenced(open, inner, close) => {
            format!("{}{}{}", fence(open), formula(inner), fence(close))
        }
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

/// A bracket as it is typed.
fn fence(sign: &str) -> String {
    match sign {
        "{" | "}" => format!("\\{sign}"),
        sign => sign.to_string(),
    }
}

/// Estimates the width, in letters, of the widest part that TeX does not break into lines.
pub fn widest(layout: &Layout) -> usize {
    match layout {
        Layout::Row(parts) => parts.iter().map(widest).max().unwrap_or(0),
        Layout::Fenced(_, inner, _) if !inner.is_tall() => widest(inner),
        other => letters_wide(other) as usize,
    }
}

/// Estimates the width of a box in letters.
fn letters_wide(layout: &Layout) -> f64 {
    /// Size of an index, an exponent and the parts of a fraction in a line.
    const SMALL: f64 = 0.7;
    match layout {
        Layout::Number(digits) => digits.len() as f64,
        Layout::Name { letter, index, primes, .. } => {
            letter.chars().count() as f64 + SMALL * (index.chars().count() + primes) as f64
        }
        Layout::Word(word) => word.len() as f64,
        Layout::Sign(_) => 2.0,
        Layout::Space => 0.3,
        Layout::Row(parts) => parts.iter().map(letters_wide).sum(),
        Layout::Fenced(_, inner, _) => 1.0 + letters_wide(inner),
        Layout::Fraction(above, below) => SMALL * letters_wide(above).max(letters_wide(below)),
        Layout::Root(inner) => 1.0 + letters_wide(inner),
        Layout::Raised(base, small) | Layout::Lowered(base, small) => {
            letters_wide(base) + SMALL * letters_wide(small)
        }
        Layout::Matrix(rows) => {
            let wide = |row: &Vec<Layout>| row.iter().map(|cell| 1.0 + letters_wide(cell)).sum();
            rows.iter().map(wide).fold(1.0, f64::max)
        }
    }
}

fn command(sign: &str) -> String {
    match sign {
        "−" => "-".to_string(),
        "∈" => "\\in".to_string(),
        "±" => "\\pm".to_string(),
        "≤" => "\\le".to_string(),
        "→" => "\\to".to_string(),
        "∂" => "\\partial".to_string(),
        "…" => "\\dots".to_string(),
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

/// A document with the encoding that Cyrillic letters need, where it has some.
pub fn with_encoding(document: String) -> String {
    let is_cyrillic = |letter: char| ('Ѐ'..='ӿ').contains(&letter);
    match document.contains(is_cyrillic) {
        true => document.replacen(
            "\\documentclass{article}\n",
            "\\documentclass{article}\n\\usepackage[T2A]{fontenc}\n",
            1,
        ),
        false => document,
    }
}

/// Whole exponent of a number behind the sign ^ at a place, as in 2^-220.
fn whole_exponent(text: &str, place: usize) -> Option<&str> {
    let is_number = text[..place].ends_with(|letter: char| letter.is_ascii_digit());
    let own = text[place..].strip_prefix('^').filter(|_| is_number)?;
    let digits = own.strip_prefix('-').unwrap_or(own);
    let count = digits.chars().take_while(char::is_ascii_digit).count();
    (count > 0).then(|| &own[..own.len() - digits.len() + count])
}

/// Sets a text in letters that any LaTeX reads.
pub fn prose(text: &str) -> String {
    let sign = |c: char| {
        let math = match c {
            '₀'..='₉' => return Some(format!("${{}}_{}$", u32::from(c) - u32::from('₀'))),
            'ᵢ' => "_i",
            'ₖ' => "_k",
            '∥' => "\\parallel ",
            '✓' => "\\checkmark ",
            '✗' => "\\times ",
            '²' => "^2",
            '³' => "^3",
            '¹' => "^1",
            '⁰' => "^0",
            '⁴' => "^4",
            '⁵' => "^5",
            '⁶' => "^6",
            '⁷' => "^7",
            '⁸' => "^8",
            '⁹' => "^9",
            'ⁿ' => "^n",
            '⁻' => "^-",
            '½' => "\\tfrac12 ",
            '↦' => "\\mapsto ",
            '⟨' => "\\langle ",
            '⟩' => "\\rangle ",
            '×' => "\\times ",
            '·' => "\\cdot ",
            '−' => "-",
            '⊗' => "\\otimes ",
            '√' => "\\surd ",
            '∫' => "\\int ",
            '≤' => "\\le ",
            '≥' => "\\ge ",
            '≠' => "\\ne ",
            '∞' => "\\infty ",
            'ᵀ' => "^T",
            '∂' => "\\partial ",
            '∇' => "\\nabla ",
            '→' => "\\to ",
            '∈' => "\\in ",
            'ℝ' => "\\mathbb{R}",
            '±' => "\\pm ",
            '∓' => "\\mp ",
            '°' => "^\\circ",
            'µ' => "\\mu ",
            '…' => "\\dots ",
            '“' => return Some("``".to_string()),
            '”' => return Some("''".to_string()),
            '‘' => return Some("`".to_string()),
            '№' => return Some("No.".to_string()),
            '–' => return Some("--".to_string()),
            '—' => return Some("---".to_string()),
            '’' => return Some("'".to_string()),
            '§' => return Some("\\S ".to_string()),
            _ => return None,
        };
        Some(format!("${{}}{math}$"))
    };
    let mut out = String::new();
    let mut letters = text.char_indices();
    while let Some((place, c)) = letters.next() {
        let exponent = whole_exponent(text, place);
        match (sign(c), c) {
            _ if exponent.is_some() => {
                let own = exponent.unwrap_or_default();
                out.push_str(&format!("$^{{{own}}}$"));
                own.chars().for_each(|_| _ = letters.next());
            }
            (Some(sign), _) => out.push_str(&sign),
            (None, c) if c.is_ascii() => out.push_str(&escaped(&c.to_string())),
            // Accented letters and Cyrillic ones are read as they are.
            (None, 'À'..='ſ' | 'Ѐ'..='ӿ') => out.push(c),
            (None, c) => {
                let own = formula(&Layout::name(&c.to_string(), Type::Scalar));
                match own.is_ascii() {
                    true => out.push_str(&format!("${own}$")),
                    false => out.push_str(&ascii_name(&c.to_string())),
                }
            }
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sums_are_broken_and_fractions_are_not() {
        let name = |text: &str| Layout::name(text, Type::Scalar);
        let sum = Layout::Row(vec![name("a"), Layout::Sign("+"), name("b"), Layout::Sign("+")]);
        assert_eq!(widest(&sum), 2, "a sign");
        assert_eq!(widest(&Layout::Root(Box::new(sum.clone()))), 7, "all of a root");
        let quotient = Layout::Fraction(Box::new(sum), Box::new(name("c")));
        assert_eq!(widest(&quotient), 4, "a smaller fraction");
    }

    #[test]
    fn special_characters_are_escaped() {
        assert_eq!(escaped("a_1^2 & {50%}"), "a\\_1\\textasciicircum{}2 \\& \\{50\\%\\}");
    }

    #[test]
    fn signs_and_exponents_of_a_text_are_set() {
        assert_eq!(prose("mu ± i"), "mu ${}\\pm $ i");
        assert_eq!(prose("error < 2^-222, x^2"), "error < 2$^{-222}$, x\\textasciicircum{}2");
        assert_eq!(prose("Волчок"), "Волчок");
        let document = |text: &str| with_encoding(format!("\\documentclass{{article}}\n{text}"));
        assert!(document("Волчок").contains("[T2A]{fontenc}") && !document("top").contains("T2A"));
    }
}
