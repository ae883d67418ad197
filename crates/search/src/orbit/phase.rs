//! Sums of cyclic coordinates as arguments of sines, cosines and exponentials.

use super::super::ansatz::system::PrimePoint;
use super::setting::OrbitSetting;
use liouville::formula::{Formula, FormulaError};
use liouville::number::rational::Rational;

/// A factor of an argument.
#[derive(Clone, Debug)]
pub enum Multiple {
    Number(Rational),
    /// A coordinate of the parameters, or its inverse.
    Parameter {
        place: usize,
        is_below: bool,
    },
}

/// A function of cyclic coordinates.
#[derive(Clone, Debug)]
pub struct Phase {
    /// Coordinates with the signs in which they occur.
    pub parts: Vec<(usize, bool)>,
    pub multiple: Multiple,
    /// Whether its functions are sine and cosine, and not the exponential.
    pub is_circular: bool,
}

impl Phase {
    /// Value of the multiple.
    pub fn factor(&self, at: &PrimePoint) -> Option<u64> {
        match &self.multiple {
            Multiple::Number(own) => at.modulus.rational(own),
            Multiple::Parameter { place, is_below } => {
                let own = *at.coordinates.get(*place)?;
                let is_value = own != 0 || !is_below;
                is_value.then(|| if *is_below { at.modulus.inverse(own) } else { own })
            }
        }
    }

    /// Rate at a state, without the multiple.
    pub fn rate(&self, at: &PrimePoint, rates: &[u64]) -> u64 {
        let m = at.modulus;
        self.parts.iter().fold(0, |sum, (k, is_negative)| match is_negative {
            true => m.sub(sum, rates[*k]),
            false => m.add(sum, rates[*k]),
        })
    }

    /// Argument of the sine or exponential.
    pub fn argument(&self, setting: &OrbitSetting<'_>) -> Result<Formula, FormulaError> {
        let mut sum: Option<Formula> = None;
        for (k, is_negative) in &self.parts {
            let own = &setting.terms[*k];
            sum = Some(match (sum, is_negative) {
                (None, false) => own.clone(),
                (None, true) => -own,
                (Some(sum), false) => (&sum + own)?,
                (Some(sum), true) => (&sum - own)?,
            });
        }
        let sum = sum.unwrap_or_else(|| Formula::number(0));
        let bracketed = if self.parts.len() > 1 { sum.bracketed() } else { sum.clone() };
        match &self.multiple {
            Multiple::Number(own) if *own == Rational::from(1) => Ok(sum),
            Multiple::Number(own) if own.parts().1 == 1.into() => {
                &Formula::number(own.clone()) * &bracketed
            }
            Multiple::Number(own) => {
                let below = Rational::from_parts(own.parts().1, 1.into());
                &bracketed / &Formula::number(below)
            }
            Multiple::Parameter { place, is_below } => {
                let own = &setting.coordinates()[*place];
                if *is_below { &bracketed / own } else { own * &bracketed }
            }
        }
    }
}
