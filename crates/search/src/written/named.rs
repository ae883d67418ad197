//! Expressions of a file, its definitions and what stands in brackets, that occur as factors of finds.

use liouville::mechanics::{Meaning, System};
use liouville::number::rational::Rational;
use liouville::order::StableOrder;
use liouville::proof::{MOST_POLYNOMIAL_WORK, Polynomial};

use super::super::orbit::parsed::is_name;
use super::fraction::Fraction;
use super::products;
use super::reader::{Reader, has_comma};

/// Smallest number of terms of an expression that has a use.
const FEWEST_TERMS: usize = 3;
/// Largest number of expressions.
const MOST: usize = 60;
/// Name of the Hamiltonian.
const ENERGY: &str = "energy";
/// Longest expression, in bytes.
const LONGEST: usize = 400;

/// Polynomials with the texts of the file.
#[derive(Default)]
pub struct NamedExpressions {
    all: Vec<(Polynomial, String)>,
    has_hyperbolic: bool,
    /// Hamiltonian.
    energy: Option<Fraction>,
}

impl NamedExpressions {
    /// Reads the definitions, and what stands in brackets in the equations of motion.
    pub fn of(reader: &mut Reader<'_>) -> Self {
        let case = reader.case();
        let model = &case.model;
        let mut texts: Vec<(String, String)> = Vec::new();
        let mut wholes: Vec<String> = Vec::new();
        for (_, entry) in model.vocabulary.iter() {
            if let Meaning::Abbreviation(place) = entry.meaning
                && let Some(own) = model.abbreviations.get(place)
                && model.vocabulary.find(&entry.name).is_some()
            {
                texts.push((own.text().to_string(), entry.name.clone()));
                wholes.push(own.text().to_string());
            }
        }
        match &model.system {
            System::Field(rates) | System::Map(rates) => {
                wholes.extend(rates.iter().map(|own| own.text().to_string()));
            }
            System::Hamiltonian(own) => wholes.push(own.function.text().to_string()),
            System::Lagrangian(own) => {
                wholes.push(own.kinetic.text().to_string());
                wholes.extend(own.potential.iter().map(|own| own.text().to_string()));
            }
            _ => {}
        }
        for inner in wholes.iter().flat_map(|own| bracketed(own)) {
            texts.push((inner.to_string(), spaced(inner)));
        }
        let is_hyperbolic =
            |own: &String| ["cosh(", "sinh(", "tanh("].iter().any(|f| own.contains(f));
        let has_hyperbolic = wholes.iter().any(is_hyperbolic);
        let mut all: Vec<(Polynomial, String)> = Vec::new();
        for (text, name) in texts.into_iter().take(MOST) {
            // A product would need brackets as a divisor.
            let is_factor = is_name(&name) || products::is_sum(&name);
            if text.len() > LONGEST || has_comma(&text) || !is_factor {
                continue;
            }
            let Some(own) = reader.read(&text).filter(|own| own.is_polynomial()) else { continue };
            let own = own.above;
            if own.size() >= FEWEST_TERMS && all.iter().all(|(other, _)| *other != own) {
                all.push((own, name));
            }
        }
        let energy = match &model.system {
            System::Hamiltonian(own) if case.formula(ENERGY).is_ok() => {
                reader.read(own.function.text())
            }
            _ => None,
        };
        Self { all, has_hyperbolic, energy }
    }

    /// The text of the file for a polynomial, with the number that it has to be multiplied by.
    pub fn of_polynomial(&self, own: &Polynomial) -> Option<(Rational, String)> {
        let monic = own.monic()?;
        let same = |(other, _): &&(Polynomial, String)| other.monic().as_ref() == Some(&monic);
        let (named, text) = self.all.iter().find(same)?;
        let quotient = own.over(named, &mut { MOST_POLYNOMIAL_WORK })?;
        Some((quotient.number()?, text.clone()))
    }

    /// The number by which the Hamiltonian is multiplied, with its name; `None` of another fraction.
    pub fn multiple_of_energy(&self, own: &Fraction) -> Option<(Rational, String)> {
        let quotient = own.over(self.energy.as_ref()?)?.reduced()?;
        let number = quotient.above.number().filter(|own| !own.is_zero())?;
        Some((&number * &quotient.below.number()?.recip()?, ENERGY.to_string()))
    }

    /// Whether the file contains a hyperbolic function.
    pub fn has_hyperbolic(&self) -> bool {
        self.has_hyperbolic
    }
}

/// Gives a Hamiltonian that is one root its name wherever the root occurs.
pub fn show_energy(reader: &mut Reader<'_>) {
    let case = reader.case();
    let System::Hamiltonian(own) = &case.model.system else { return };
    let read = reader.read(own.function.text()).filter(|_| case.formula(ENERGY).is_ok());
    let Some(read) = read.filter(Fraction::is_polynomial) else { return };
    if let Some((value, [(token, 1)])) = read.above.as_term()
        && *value == Rational::from(1)
        && !is_name(reader.tokens.text(*token))
    {
        reader.tokens.show(*token, ENERGY);
    }
}

/// Writes a sum with spaces about its signs.
fn spaced(text: &str) -> String {
    let letters: Vec<char> = text.chars().collect();
    let mut written = String::with_capacity(text.len());
    for (place, letter) in letters.iter().enumerate() {
        let before = place.checked_sub(1).map(|place| letters[place]);
        let ends_term = |own: char| own.is_alphanumeric() || [')', ']', '}', '\''].contains(&own);
        let is_exponent = before == Some('e')
            && place.checked_sub(2).is_some_and(|place| letters[place].is_ascii_digit());
        match letter {
            '+' | '-' | '−' if before.is_some_and(ends_term) && !is_exponent => {
                written.push(' ');
                written.push(*letter);
                written.extend(letters.get(place + 1).filter(|next| **next != ' ').map(|_| ' '));
            }
            _ => written.push(*letter),
        }
    }
    written
}

/// Texts inside of round brackets, outer ones first.
fn bracketed(text: &str) -> Vec<&str> {
    let mut open = Vec::new();
    let mut found = Vec::new();
    for (place, letter) in text.char_indices() {
        match letter {
            '(' => open.push(place + 1),
            ')' => {
                if let Some(start) = open.pop() {
                    found.push((start, &text[start..place]));
                }
            }
            _ => {}
        }
    }
    found.order_by_key(|(start, _)| *start);
    found.into_iter().map(|(_, own)| own).collect()
}

#[cfg(test)]
mod tests {
    use super::spaced;

    #[test]
    fn signs_of_sums_have_spaces() {
        assert_eq!(spaced("1-x^2-y^2"), "1 - x^2 - y^2");
        assert_eq!(spaced("a + b-c"), "a + b - c");
        assert_eq!(spaced("x^(-2)+2e-5*y"), "x^(-2) + 2e-5*y");
    }
}
