//! Texts of formulas as fractions.

use liouville::case::Case;
use liouville::formula::{Type, canonical_name};
use liouville::mechanics::Meaning;
use liouville::number::rational::Rational;
use liouville::proof::Polynomial;

use super::super::orbit::parsed::{
    base_and_power, closes, factors, inside, is_modulus, is_name, terms,
};
use super::fraction::Fraction;
use super::named::{self, NamedExpressions};
use super::squares;
use super::tokens::Tokens;
use super::writer::{self, Constants};

/// Largest depth of functions in functions.
const DEEPEST: usize = 6;

/// Functions f with f(−u) = −f(u).
const ODD: [&str; 8] = ["atan", "asin", "sin", "tan", "sinh", "tanh", "asinh", "atanh"];

/// Reads texts of a case.
pub struct Reader<'c> {
    pub tokens: Tokens<'c>,
    pub named: NamedExpressions,
    depth: usize,
    /// Whether abbreviations are read as what they stand for.
    expands: bool,
}

impl<'c> Reader<'c> {
    /// Reads the expressions of the file first.
    pub fn new(case: &'c Case) -> Self {
        let named = NamedExpressions::default();
        let mut reader = Self { tokens: Tokens::new(case), named, depth: 0, expands: false };
        reader.named = NamedExpressions::of(&mut reader);
        named::show_energy(&mut reader);
        reader
    }

    /// The same, which reads abbreviations as what they stand for.
    pub fn expanding(mut self) -> Self {
        self.expands = true;
        self
    }

    pub fn case(&self) -> &'c Case {
        self.tokens.case
    }

    /// Reads a text; `None` if it is no fraction of polynomials in its names and functions, or long.
    pub fn read(&mut self, text: &str) -> Option<Fraction> {
        let own = self.sum(text)?;
        self.simplified(own)
    }

    /// The fraction with even powers of roots written out.
    pub fn simplified(&self, own: Fraction) -> Option<Fraction> {
        let roots: Vec<(u32, Polynomial)> =
            self.tokens.squares().map(|(root, square)| (root, square.clone())).collect();
        own.without_squares(&roots, |token| self.tokens.is_constant(token))
    }

    fn sum(&mut self, text: &str) -> Option<Fraction> {
        if text.contains(['×', '·', '⊗']) {
            return None;
        }
        let mut sum = Fraction::number(&Rational::from(0));
        for (is_negative, term) in terms(text) {
            sum = sum.plus(&self.product(term)?, is_negative)?;
        }
        Some(sum)
    }

    fn product(&mut self, text: &str) -> Option<Fraction> {
        let mut product = Fraction::one();
        for (is_below, factor) in factors(text) {
            let own = self.factor(factor)?;
            product = if is_below { product.over(&own)? } else { product.times(&own)? };
        }
        Some(product)
    }

    fn factor(&mut self, text: &str) -> Option<Fraction> {
        if text.is_empty() {
            return None;
        }
        for (ending, exponent) in [("^(1/2)", 1), ("^(−1/2)", -1), ("^(-1/2)", -1)] {
            if let Some(base) = text.strip_suffix(ending)
                && (is_entry(base) || inside(base).is_some())
            {
                let root = format!("√({})", inside(base).unwrap_or(base));
                return self.function(&root)?.power(exponent);
            }
        }
        if let Some((base, exponent)) = text.strip_suffix(')').and_then(|own| own.split_once("^("))
            && (is_entry(base) || inside(base).is_some())
            && closes(&text[base.len() + 1..])
        {
            let base = self.rewritten(base)?;
            let exponent = self.rewritten(exponent)?;
            let base = if is_entry(&base) { base } else { format!("({base})") };
            return self.token(&format!("{base}^({exponent})"));
        }
        if text.contains('⁻') && inside(text).is_none() {
            return self.token(text);
        }
        let (base, power) = base_and_power(text);
        if base.starts_with(|letter: char| letter.is_ascii_digit()) {
            let own = base.parse::<Rational>().ok();
            return match own {
                Some(own) => Fraction::number(&own).power(power),
                None => self.token(text),
            };
        }
        if let Some(inner) = inside(base)
            && !has_comma(inner)
        {
            return self.sum(inner)?.power(power);
        }
        if let Some(text) = self.abbreviated(base) {
            return self.sum(&text)?.power(power);
        }
        let own = if is_entry(base) { self.token(base)? } else { self.function(base)? };
        own.power(power)
    }

    /// Meaning of an abbreviation, where these are read so.
    fn abbreviated(&self, name: &str) -> Option<String> {
        let model = &self.case().model;
        match model.vocabulary.find(name).filter(|_| self.expands)?.meaning {
            Meaning::Abbreviation(place) => {
                let own = model.abbreviations.get(place)?;
                (own.value_type() == Type::Scalar).then(|| own.text().to_string())
            }
            _ => None,
        }
    }

    /// A function, or another formula, with its argument written in lowest terms.
    fn function(&mut self, text: &str) -> Option<Fraction> {
        let (name, argument) = match is_modulus(text) {
            true => ("|", text.strip_prefix('|')?.strip_suffix('|')?),
            false => {
                let start = text.find('(');
                let called = start.filter(|start| {
                    *start > 0
                        && text[..*start].chars().all(|c| c.is_alphanumeric() || c == '√')
                        && closes(&text[*start..])
                });
                match called {
                    Some(start) => (&text[..start], inside(&text[start..])?),
                    None => return self.token(text),
                }
            }
        };
        if has_comma(argument) || self.depth >= DEEPEST {
            return self.token(text);
        }
        self.depth += 1;
        let read = self.sum(argument).and_then(|own| self.simplified(own));
        self.depth -= 1;
        let Some(read) = read else { return self.token(text) };
        if name == "atan" && read.above == read.below {
            let quarter = Fraction::number(&Rational::new(1, 4));
            return self.token("π")?.times(&quarter);
        }
        if matches!(name, "ln" | "log")
            && let Some(own) = self.logarithm(name, argument)
        {
            return Some(own);
        }
        let written = match name {
            "|" => self.modulus(&read)?,
            _ => self.shorter(&read, argument)?,
        };
        if ODD.contains(&name) {
            let opposite = Fraction::number(&Rational::from(-1)).times(&read)?;
            let turned = writer::written(self, &opposite, Constants::Kept)?.text;
            if turned.chars().count() < written.chars().count() {
                let own = self.token(&format!("{name}({turned})"))?;
                return Fraction::number(&Rational::from(-1)).times(&own);
            }
        }
        let name = if name == "sqrt" { "√" } else { name };
        let called = match name {
            "√" if is_name(&written) => format!("√{written}"),
            "|" => format!("|{written}|"),
            name => format!("{name}({written})"),
        };
        let token = self.tokens.of(&called)?;
        if name == "√" && read.is_polynomial() {
            self.tokens.set_square(token, read.above);
        }
        Some(Fraction::variable(token))
    }

    /// A text in lowest terms, where that is shorter.
    fn rewritten(&mut self, text: &str) -> Option<String> {
        let text = inside(text).unwrap_or(text);
        let read = self.sum(text).and_then(|own| self.simplified(own))?;
        self.shorter(&read, text)
    }

    fn shorter(&mut self, read: &Fraction, text: &str) -> Option<String> {
        let written = writer::written(self, read, Constants::Kept)?.text;
        let is_shorter = written.chars().count() < text.chars().count();
        Some(if is_shorter { written } else { text.to_string() })
    }

    /// Content of bars, without a minus sign before it.
    fn modulus(&mut self, read: &Fraction) -> Option<String> {
        let opposite = Fraction::number(&Rational::from(-1)).times(read)?;
        let mut texts = Vec::new();
        for own in [read, &opposite] {
            texts.push(writer::written(self, own, Constants::Kept)?.text);
        }
        texts.into_iter().min_by_key(|own| own.chars().count())
    }

    /// ln |c u| as ln |u| + ln |c|, without bars around a sum of squares; `None` where c is 1 and there are bars.
    fn logarithm(&mut self, name: &str, argument: &str) -> Option<Fraction> {
        let inner = if is_modulus(argument) {
            argument.strip_prefix('|')?.strip_suffix('|')?
        } else {
            argument
        };
        let read = self.sum(inner).and_then(|own| self.simplified(own))?;
        let (number, whole) = writer::content(&read)?;
        let is_bare = !is_modulus(argument);
        let opposite = Fraction::number(&Rational::from(-1)).times(&whole)?;
        let is_square = |own: &Fraction| own.is_polynomial() && squares::is_sum(&own.above);
        let whole = if !is_bare && is_square(&opposite) { opposite } else { whole };
        if read.above.number().is_some() || is_bare && number.is_negative() {
            return None;
        }
        let text = match is_bare || is_square(&whole) {
            true => writer::written(self, &whole, Constants::Kept)?.text,
            false => format!("|{}|", self.modulus(&whole)?),
        };
        let mut sum = self.token(&format!("{name}({text})"))?;
        let (above, below) = number.abs().parts();
        for (part, is_negative) in [(above, false), (below, true)] {
            if part != 1.into() {
                sum = sum.plus(&self.token(&format!("{name}({part})"))?, is_negative)?;
            }
        }
        Some(sum)
    }

    fn token(&mut self, text: &str) -> Option<Fraction> {
        // A file may write phi for φ.
        let canonical = canonical_name(text).filter(|_| self.expands);
        self.tokens.of(canonical.as_deref().unwrap_or(text)).map(Fraction::variable)
    }
}

/// Whether a text is a name, or an entry of a vector or matrix.
fn is_entry(text: &str) -> bool {
    let Some((name, index)) = text.split_once('[') else { return is_name(text) };
    let Some((index, primes)) = index.split_once(']') else { return false };
    let is_index = |letter: char| letter.is_ascii_digit() || letter == ',';
    is_name(name) && index.chars().all(is_index) && primes.chars().all(|letter| letter == '\'')
}

/// Whether a comma stands outside of inner brackets.
pub fn has_comma(text: &str) -> bool {
    let mut depth = 0usize;
    text.chars().any(|letter| {
        match letter {
            '(' | '[' => depth += 1,
            ')' | ']' => depth = depth.saturating_sub(1),
            _ => {}
        }
        letter == ',' && depth == 0
    })
}
