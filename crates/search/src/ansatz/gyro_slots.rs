//! Rotors and gyroscopic terms in the places where they enter the equations of motion: *slots*.

use super::forces::{with_gyroscopic, with_gyrostat, with_rates};
use super::gyro_family::{GyroEntry, GyroFamily};
use crate::Given;
use crate::terms::{TermSum, is_one};
use liouville::formula::{Formula, FormulaError, FormulaResult, Type};
use liouville::mechanics::Model;

/// Terms by slot.
pub type Slots = Vec<Option<Formula>>;

/// Coefficient of a generator: whether it is the negative of a formula, and this formula.
pub type Part = Option<(bool, Formula)>;

impl GyroFamily {
    /// Lists what enters the equations if each generator has a coefficient: the rotor; the term; or the
    /// terms of the rates of the velocities.
    pub fn slots(&self, parts: &[Part]) -> Result<Slots, FormulaError> {
        let times = |part: &Formula, head: &Formula| -> FormulaResult {
            if is_one(part) { Ok(head.clone()) } else { part * head }
        };
        match &self.entry {
            GyroEntry::Rotor => {
                let zero = Formula::number(0);
                let signed = |part: &Part| match part {
                    None => zero.clone(),
                    Some((false, own)) => own.clone(),
                    Some((true, own)) => -own,
                };
                let all: Vec<Formula> = parts.iter().map(signed).collect();
                Ok(vec![Some(Formula::vector(&all.iter().collect::<Vec<_>>())?)])
            }
            GyroEntry::Term => {
                let mut sum = TermSum::default();
                for (part, head) in parts.iter().zip(&self.heads) {
                    if let Some((is_negative, part)) = part {
                        sum.add(*is_negative, &times(part, head)?)?;
                    }
                }
                Ok(vec![sum.total()])
            }
            GyroEntry::Pairs(pairs) => {
                let mut sums: Vec<TermSum> =
                    self.heads.iter().map(|_| TermSum::default()).collect();
                for (part, [i, j]) in parts.iter().zip(pairs) {
                    if let Some((is_negative, part)) = part {
                        sums[*i].add(*is_negative, &times(part, &self.heads[*j])?)?;
                        sums[*j].add(!is_negative, &times(part, &self.heads[*i])?)?;
                    }
                }
                Ok(sums.into_iter().map(TermSum::total).collect())
            }
        }
    }

    /// Adds a rotor or terms to a model; `None` if it does not take them.
    pub fn with(&self, model: &Model, slots: &[Option<Formula>]) -> Option<Model> {
        match (&self.entry, slots.first()?) {
            (GyroEntry::Rotor, Some(rotor)) => with_gyrostat(model, rotor),
            (GyroEntry::Term, Some(term)) => with_gyroscopic(model, term),
            (GyroEntry::Rotor | GyroEntry::Term, None) => None,
            (GyroEntry::Pairs(_), _) => {
                let terms: Option<Vec<(usize, Formula)>> =
                    self.rates(slots).map(|(head, slot)| Some((self.place(head)?, slot))).collect();
                with_rates(model, &terms?)
            }
        }
    }

    fn rates<'a>(
        &'a self,
        slots: &'a [Option<Formula>],
    ) -> impl Iterator<Item = (&'a Formula, Formula)> {
        let own = self.heads.iter().zip(slots);
        own.filter_map(|(head, slot)| Some((head, slot.clone()?)))
    }

    fn place(&self, head: &Formula) -> Option<usize> {
        self.variables.terms.iter().position(|term| term.text() == head.text())
    }

    /// Text of what was added.
    pub fn text(&self, slots: &[Option<Formula>]) -> String {
        match self.entry {
            GyroEntry::Rotor | GyroEntry::Term => {
                slots.iter().flatten().map(ToString::to_string).collect()
            }
            GyroEntry::Pairs(_) => {
                let own =
                    self.rates(slots).map(|(head, slot)| format!("{slot} in the rate of {head}"));
                own.collect::<Vec<_>>().join(", ")
            }
        }
    }

    /// Word for what was added.
    pub fn word(&self) -> &'static str {
        match self.entry {
            GyroEntry::Rotor => "gyrostat",
            GyroEntry::Term => "gyroscopic term",
            GyroEntry::Pairs(_) => "force",
        }
    }

    /// Kind of the addition, with its text.
    pub fn given(&self, text: String) -> Given {
        match self.entry {
            GyroEntry::Rotor => Given::Gyrostat(text),
            GyroEntry::Term => Given::GyroscopicTerm(text),
            GyroEntry::Pairs(_) => Given::Force(text),
        }
    }

    /// Σ constant · slot, slot by slot.
    pub fn combined<'t>(
        &self,
        parts: &[(&'t Formula, &'t [Option<Formula>])],
    ) -> Result<Vec<Option<Formula>>, FormulaError> {
        let count = parts.first().map_or(0, |(_, slots)| slots.len());
        (0..count)
            .map(|slot| {
                let own = parts.iter().filter_map(|(by, slots)| Some((*by, slots[slot].as_ref()?)));
                summed(own)
            })
            .collect()
    }
}

/// Σ constant · part, with brackets around each part but names and vectors; `None` for an empty sum.
pub fn summed<'t>(
    parts: impl Iterator<Item = (&'t Formula, &'t Formula)>,
) -> Result<Option<Formula>, FormulaError> {
    let mut sum = TermSum::default();
    for (by, part) in parts {
        sum.add(false, &multiple(by, part)?)?;
    }
    Ok(sum.total())
}

/// A constant times a part, with brackets around it unless it is a name or a vector.
pub fn multiple(by: &Formula, part: &Formula) -> FormulaResult {
    if part.value_type() != Type::Scalar {
        return by * part;
    }
    let is_name = |part: &Formula| {
        part.text().chars().all(|letter| letter.is_alphanumeric() || "_'[]".contains(letter))
    };
    match (is_one(by), is_one(part)) {
        (true, _) => Ok(part.clone()),
        (_, true) => Ok(by.clone()),
        _ if is_name(part) => by * part,
        _ => by * part.bracketed(),
    }
}
