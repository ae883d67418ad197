//! Where a claim is made: everywhere, on the level set, or on a part of its equations.

use crate::mechanics::Model;

/// The level equations that states are to satisfy.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Place {
    /// One entry a level equation of the model.
    pub kept: Vec<bool>,
}

impl Place {
    /// All equations: the level set.
    pub fn level(model: &Model) -> Self {
        Self { kept: vec![true; model.level.len()] }
    }

    /// No equation: all of phase space.
    pub fn everywhere(model: &Model) -> Self {
        Self { kept: vec![false; model.level.len()] }
    }

    /// The equation of this text alone; spaces and spelling do not matter.
    pub fn equation(model: &Model, text: &str) -> Option<Self> {
        let plain = |text: &str| {
            let text: String = text.split_whitespace().collect();
            text.replace('−', "-").replace("gamma", "γ").replace("omega", "ω")
        };
        let index = model.level.iter().position(|equation| plain(&equation.text) == plain(text))?;
        let mut place = Self::everywhere(model);
        place.kept[index] = true;
        Some(place)
    }

    /// The places that contain this one properly and are worth asking about, widest first.
    pub fn wider(&self, model: &Model) -> Vec<Self> {
        let mut wider = Vec::new();
        if self.kept.iter().any(|kept| *kept) {
            wider.push(Self::everywhere(model));
        }
        if self.kept.iter().filter(|kept| **kept).count() == 2 {
            for dropped in (0..self.kept.len()).filter(|index| self.kept[*index]) {
                let mut place = self.clone();
                place.kept[dropped] = false;
                wider.push(place);
            }
        }
        wider
    }

    /// How a report names this place.
    pub fn name(&self, model: &Model) -> String {
        if self.kept.iter().all(|kept| *kept) && !self.kept.is_empty() {
            return "level".to_string();
        }
        let kept: Vec<&str> = model
            .level
            .iter()
            .zip(&self.kept)
            .filter(|(_, kept)| **kept)
            .map(|(equation, _)| equation.text.as_str())
            .collect();
        if kept.is_empty() { "everywhere".to_string() } else { kept.join(", ") }
    }
}
