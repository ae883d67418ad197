//! Places of claims: all of phase space, the level set, or some of its equations.

use std::fmt;

use serde::{Serialize, Serializer};

use crate::mechanics::Model;

/// A place of claims by its name in reports.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum PlaceName {
    /// All of phase space.
    Everywhere,
    /// The level set.
    Level,
    /// Some equations of the level set.
    Equations(String),
    /// The images of the states of a place under the map of a claim.
    ImagesOf(Box<PlaceName>),
}

impl fmt::Display for PlaceName {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Everywhere => out.write_str("everywhere"),
            Self::Level => out.write_str("level"),
            Self::Equations(text) => out.write_str(text),
            Self::ImagesOf(place) => match &**place {
                Self::Everywhere => out.write_str("at the images of all states"),
                Self::Level => out.write_str("at the images of the level"),
                other => write!(out, "at the images of {other}"),
            },
        }
    }
}

impl Serialize for PlaceName {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

/// The level equations that states must satisfy.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct LevelSubset {
    /// One entry for each level equation of the model.
    pub kept: Vec<bool>,
}

impl LevelSubset {
    /// Makes the place of all equations: the level set.
    pub fn level(model: &Model) -> Self {
        Self { kept: vec![true; model.level.len()] }
    }

    /// Makes the place without equations: all of phase space.
    pub fn everywhere(model: &Model) -> Self {
        Self { kept: vec![false; model.level.len()] }
    }

    /// Makes the place of the equation with this text, regardless of spaces and spelling.
    pub fn equation(model: &Model, text: &str) -> Option<Self> {
        let plain = |text: &str| {
            let text: String = text.split_whitespace().collect();
            text.replace('−', "-").replace("gamma", "γ").replace("omega", "ω")
        };
        let wanted = plain(text);
        // An equation between vectors, and one between sums of squares, is several.
        let exact = model.level.iter().position(|equation| plain(&equation.text) == wanted);
        let kept: Vec<bool> = match exact {
            Some(index) => (0..model.level.len()).map(|other| other == index).collect(),
            None => model.level.iter().map(|own| plain(own.written()) == wanted).collect(),
        };
        // All states of these equations are more than the level where the file chooses halves of it, and what is left
        // of an equation has more states than it.
        let mut all = model.level.iter().zip(&kept).filter(|(_, kept)| **kept);
        let is_wider = !model.orientations.is_empty() && kept.iter().all(|kept| *kept)
            || exact.is_none() && all.any(|(own, _)| own.lacks_entries);
        (kept.contains(&true) && !is_wider).then_some(Self { kept })
    }

    /// Lists the places of interest that properly contain this one, widest first.
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

    /// Returns the name of the place in reports.
    pub fn name(&self, model: &Model) -> PlaceName {
        if self.kept.iter().all(|kept| *kept) && !self.kept.is_empty() {
            return PlaceName::Level;
        }
        let kept: Vec<&str> = model
            .level
            .iter()
            .zip(&self.kept)
            .filter(|(_, kept)| **kept)
            .map(|(equation, _)| equation.text.as_str())
            .collect();
        match kept.is_empty() {
            true => PlaceName::Everywhere,
            false => PlaceName::Equations(kept.join(", ")),
        }
    }
}
