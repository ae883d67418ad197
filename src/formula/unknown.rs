//! Unknown names and suggestions for them.

use crate::order::StableOrder;

use super::error::{FormulaError, Span, excerpt};
use super::lexer::TokenKind;
use super::names::{canonical_name, look_alike, spelled_names};
use super::parser::Parser;
use super::scope::resolve;
use super::spelling::{nearest, split};
use super::{binders, functions};

/// Limit on the names listed in a message.
const MOST_LISTED: usize = 24;

/// Functions of other languages, and their notation here.
const ELSEWHERE: [(&[&str], &str); 31] = [
    (
        &["grad", "gradient", "nabla", "diff", "derivative", "d"],
        "write `∂F/∂x`, or `partial(F, x)`",
    ),
    (&["sec"], "write `1/cos(x)`"),
    (&["csc", "cosec"], "write `1/sin(x)`"),
    (&["cot", "cotan", "ctg"], "write `1/tan(x)`"),
    (&["sech"], "write `1/cosh(x)`"),
    (&["csch", "cosech"], "write `1/sinh(x)`"),
    (&["coth", "cth"], "write `1/tanh(x)`"),
    (&["tg"], "write `tan(x)`"),
    (&["arctg"], "write `atan(x)`"),
    (&["arcsinh", "arsh"], "write `asinh(x)`"),
    (&["arccosh", "arch"], "write `acosh(x)`"),
    (&["arctanh", "arth"], "write `atanh(x)`"),
    (&["sh"], "write `sinh(x)`"),
    (&["ch"], "write `cosh(x)`"),
    (&["th"], "write `tanh(x)`"),
    (&["log10", "lg"], "write `log(x)/log(10)`"),
    (&["log2"], "write `log(x)/log(2)`"),
    (&["cbrt"], "write `x^(1/3)`, for x > 0"),
    (&["pow"], "write `a^b`"),
    (
        &["int", "integrate", "quad"],
        "an antiderivative is written `∫(f, x)`; no function cuts decimals off",
    ),
    (
        &["floor", "ceil", "round", "frac"],
        "functions with steps are not known here, apart from `sign(x)`",
    ),
    (&["erf"], "write `2/√pi*∫(exp(−x^2), x)`, which is an antiderivative"),
    (&["gamma", "Gamma", "factorial"], "the gamma function is not known here"),
    (
        &["J0", "J1", "Y0", "Y1", "besselj", "bessel"],
        "Bessel's functions are not known here: make them state variables that obey their equation",
    ),
    (&["where", "piecewise", "cases"], "write cases with `max`, `min`, `sign` and `|x|`"),
    (&["fabs"], "write `|x|`"),
    (&["heaviside", "step", "theta", "θ"], "write `(1 + sign(x))/2`"),
    (&["eye", "identity", "unit"], "write `E`, or `E(4)` for four rows"),
    (&["zeros", "ones"], "write `zero(4)`, or `vector(i, 1..4, 1)`"),
    (&["Σ", "Π", "prod"], "write `sum(i, 1..n, a[i])` or `product(i, 1..n, a[i])`"),
    (
        &["sn", "cn", "dn", "am"],
        "elliptic functions are not known here: make them state variables, s' = c*d, c' = −s*d, \
         d' = −k²*s*c",
    ),
];

/// Names of books, and the name here, where the system has it.
const BOOKS: [(&[&str], &str); 3] = [
    (&["H", "Ham", "hamiltonian", "Hamiltonian", "ℋ"], "energy"),
    (&["w", "W", "Omega", "Ω"], "ω"),
    (&["rdot", "vel"], "r'"),
];

impl Parser<'_> {
    /// The error for an unknown name.
    pub(super) fn unknown_name(&self, name: &str, span: Span) -> FormulaError {
        let is_first = self.builder.text[..span.start].trim().is_empty();
        if is_first && self.peek() == TokenKind::Comparison {
            return self.equation(self.token().span.clone()).with_unknown(name);
        }
        let called = self.peek() == TokenKind::Open;
        let kind = if called { "function" } else { "name" };
        let error = FormulaError::new(span.clone(), format!("unknown {kind} `{}`", excerpt(name)))
            .with_unknown(name);
        match self.meant(name, &span, called) {
            Some(help) => error.with_help(help),
            None => error,
        }
    }

    /// Suggestion for an unknown name.
    fn meant(&self, name: &str, span: &Span, called: bool) -> Option<String> {
        let known = |piece: &str| resolve(piece, self.scope).is_some();
        if called && let Some((_, help)) = ELSEWHERE.iter().find(|(all, _)| all.contains(&name)) {
            return Some(help.to_string());
        }
        let before = self.builder.text[..span.start].trim_end();
        if let ("T" | "t", Some(base)) = (name, before.strip_suffix('^')) {
            let start = base
                .rfind(|c: char| !c.is_alphanumeric())
                .map_or(0, |at| at + base[at..].chars().next().map_or(0, char::len_utf8));
            return Some(format!("a transpose is written `{}ᵀ`", &base[start..]));
        }
        let has_rate = |base: &&str| known(&format!("{base}'"));
        let rest = &self.builder.text[span.end..];
        let differential = name.strip_prefix('d').filter(|_| rest.trim_start().starts_with("/dt"));
        let dotted = || name.strip_suffix("dot").or_else(|| name.strip_prefix("dot"));
        if let Some(base) = differential.or_else(dotted).filter(has_rate) {
            return Some(format!("the rate of `{base}` is written `{base}'`"));
        }
        if let Some(base) = name.strip_suffix("''").filter(has_rate) {
            return Some(format!(
                "second rates have no names: write the rate of the variable that `{base}'` is equal to"
            ));
        }
        if name.starts_with('∂') || self.builder.text[span.start..].starts_with("d/dt") {
            return Some(
                "derivatives are taken for you: rate = \"F\" claims the rate of F, and `x'` is \
                 that of a state variable x"
                    .to_string(),
            );
        }
        if let Some((_, own)) =
            BOOKS.iter().find(|(all, own)| !called && all.contains(&name) && known(own))
        {
            return Some(format!("did you mean `{own}`?"));
        }
        if let Some(pieces) = split(name, known) {
            return Some(format!("write `{}`?", pieces.join("*")));
        }
        let stem = name.trim_end_matches(|c: char| c.is_ascii_digit());
        if stem.len() < name.len() && !called && functions::is_function(stem) {
            return Some(format!("write `{stem}({})`", &name[stem.len()..]));
        }
        let is_lagrangian = known("energy") && !["γ", "ω"].iter().any(|own| known(own));
        if let ("T" | "U" | "V" | "L", false, true) = (name, called, is_lagrangian) {
            return Some(format!(
                "parts of the energy have the names that [let] gives them: {name} = \"…\", to be used in \
                 [lagrangian] too"
            ));
        }
        let mut names = self.scope.names();
        names.order();
        if let Some(help) = look_alike(name, names.iter().map(String::as_str)) {
            return Some(help);
        }
        let canonical = canonical_name(name).unwrap_or_default();
        let own =
            if called { functions::names().chain(binders::names()).collect() } else { vec![] };
        let all = || names.iter().map(String::as_str).chain(own.iter().copied());
        let guess = [name, &canonical].into_iter().find_map(|name| nearest(name, all()));
        let guess = guess.map(str::to_string).or_else(|| greek(name, known));
        if let Some(guess) = guess {
            return Some(format!("did you mean `{guess}`?"));
        }
        if let ("e1" | "e2" | "e3", false) = (name, called) {
            let axis =
                ["[1,0,0]", "[0,1,0]", "[0,0,1]"][usize::from(name.as_bytes()[1] - b'1') % 3];
            return Some(format!("write `{axis}`"));
        }
        if called {
            let mut own = own;
            own.sort_unstable();
            own.dedup();
            return Some(format!("the functions are {}", own.join(", ")));
        }
        listed(names)
    }
}

/// Known names, in one sentence.
fn listed(names: Vec<String>) -> Option<String> {
    let count = names.len();
    let shown: Vec<String> = names.into_iter().take(MOST_LISTED).collect();
    let rest = count - shown.len();
    match (count, rest) {
        (0, _) => Some(
            "write a number, or declare the name in [parameters]; a range \"0.5..2\" has its place in \
             [parameters] and [state]"
                .to_string(),
        ),
        (_, 0) => Some(format!("the names here are {}; {OWN}", shown.join(", "))),
        _ => Some(format!("the names here are {} and {rest} more; {OWN}", shown.join(", "))),
    }
}

/// Sentence on adding names.
const OWN: &str = "others are declared in [parameters] or [let]";

/// English name of a Greek letter that is misspelled at the start of a name, with what follows it, if
/// the whole is a known name.
fn greek(name: &str, known: impl Fn(&str) -> bool) -> Option<String> {
    let stem = name.trim_end_matches(|c: char| c.is_ascii_digit() || matches!(c, '_' | '\''));
    let letter = nearest(stem, spelled_names())?;
    let meant = format!("{letter}{}", &name[stem.len()..]);
    canonical_name(&meant).filter(|name| known(name)).map(|_| meant)
}
