//! Names, functions and inner products of formulas as variables of polynomials.

use liouville::case::Case;
use liouville::formula::Type;
use liouville::mechanics::Dependence;
use liouville::proof::Polynomial;

/// A variable of polynomials.
struct Token {
    text: String,
    /// Whether it depends on parameters alone.
    is_constant: bool,
    /// Text in formulas, where that is another one.
    shown: Option<String>,
    /// Square of a root, where that is a polynomial.
    square: Option<Polynomial>,
}

/// The variables so far, by their texts.
pub struct Tokens<'c> {
    pub case: &'c Case,
    all: Vec<Token>,
}

impl<'c> Tokens<'c> {
    pub fn new(case: &'c Case) -> Self {
        let mut tokens = Self { case, all: Vec::new() };
        let model = &case.model;
        // Terms follow the order of the file.
        for name in [model.parameter_names(), model.state_names()].concat() {
            tokens.of(&name);
        }
        tokens
    }

    /// The variable of a text; `None` if this is no scalar formula of the case.
    pub fn of(&mut self, text: &str) -> Option<u32> {
        let place = match self.all.iter().position(|own| own.text == text) {
            Some(place) => place,
            None => {
                let formula = self.case.formula(text).ok()?;
                if formula.value_type() != Type::Scalar {
                    return None;
                }
                let vocabulary = &self.case.model.vocabulary;
                let is_parameter =
                    |symbol| vocabulary.entry(symbol).reach == Dependence::Parameters;
                let is_constant = formula.symbols().all(is_parameter);
                self.all.push(Token {
                    text: text.to_string(),
                    is_constant,
                    shown: None,
                    square: None,
                });
                self.all.len() - 1
            }
        };
        u32::try_from(place).ok()
    }

    /// Sets the square of a root.
    pub fn set_square(&mut self, token: u32, square: Polynomial) {
        if let Some(own) = self.all.get_mut(token as usize) {
            own.square = Some(square);
        }
    }

    /// Roots with their squares.
    pub fn squares(&self) -> impl Iterator<Item = (u32, &Polynomial)> {
        let own = |(place, token): (usize, &'_ Token)| (place as u32, token.square.is_some());
        let places: Vec<u32> =
            self.all.iter().enumerate().map(own).filter(|own| own.1).map(|own| own.0).collect();
        places
            .into_iter()
            .filter_map(|place| Some((place, self.all[place as usize].square.as_ref()?)))
    }

    /// Writes a token by another text.
    pub fn show(&mut self, token: u32, text: &str) {
        if let Some(own) = self.all.get_mut(token as usize) {
            own.shown = Some(text.to_string());
        }
    }

    pub fn text(&self, token: u32) -> &str {
        let own = self.all.get(token as usize);
        own.map_or("", |own| own.shown.as_deref().unwrap_or(&own.text))
    }

    pub fn is_constant(&self, token: u32) -> bool {
        self.all.get(token as usize).is_some_and(|own| own.is_constant)
    }
}
