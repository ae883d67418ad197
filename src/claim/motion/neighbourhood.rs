//! Parameters that vary about their fixed values.

use crate::claim::Reader;
use crate::mechanics::{Meaning, Model, Parameter, ParameterOrigin, SamplerSpec};
use crate::number::rational::Rational;

/// All values of a parameter within a distance of the fixed one, component by component.
#[derive(Clone, Debug)]
pub struct Neighbourhood {
    /// Index of the parameter.
    pub parameter: usize,
    /// Name of the parameter.
    pub name: String,
    /// Largest distance of each component.
    pub half: Rational,
    /// Distance as typed.
    typed: String,
}

impl Neighbourhood {
    /// Reads a table such as `{ a_g = "± 1e-5" }`.
    pub(super) fn read<R: Reader>(from: &R, key: &'static str) -> Result<Vec<Self>, R::Error> {
        let entries = from.words_in(key)?.unwrap_or_default();
        let one = |(name, text): &(String, String)| Self::one(from, key, name, text);
        entries.iter().map(one).collect()
    }

    fn one<R: Reader>(
        from: &R,
        key: &'static str,
        name: &str,
        text: &str,
    ) -> Result<Self, R::Error> {
        let complaint = |message: String, remedy: &str| Err(from.complaint(key, message, remedy));
        let model = from.model();
        let found = model.vocabulary.find(name).map(|entry| entry.meaning);
        let Some(Meaning::Parameter(parameter)) = found else {
            return complaint(format!("`{name}` is not a parameter"), "name one of [parameters]");
        };
        let own = &model.parameters[parameter];
        let ParameterOrigin::Fixed(values) = &own.origin else {
            let remedy = "give it a number in [parameters], and vary that";
            return complaint(format!("`{name}` has no fixed value to vary about"), remedy);
        };
        if model.is_rigid(parameter, &[]) {
            let message = format!("`{name}` is used in a size or an index, and cannot vary");
            return complaint(message, "vary another parameter");
        }
        let Some((centre, half)) = text.split_once('±') else {
            let message = format!("`{name} = {text}` does not give a distance");
            return complaint(message, &format!("write {name} = \"± 1e-5\""));
        };
        let is_named = |centre: &str| match (centre.parse::<Rational>(), values.as_slice()) {
            (Ok(centre), [value]) => centre == *value,
            _ => false,
        };
        if !centre.trim().is_empty() && !is_named(centre.trim()) {
            let message = format!("`{}` is not the value of `{name}`", centre.trim());
            return complaint(message, &format!("write {name} = \"±{half}\""));
        }
        let distance = half.trim().parse::<Rational>().ok();
        let Some(distance) = distance.filter(|half| *half > Rational::from(0)) else {
            let message = format!("`{}` is not a distance", half.trim());
            return complaint(message, "write a positive number, such as 1e-5");
        };
        let found = Self {
            parameter,
            name: own.name.clone(),
            half: distance,
            typed: half.trim().to_string(),
        };
        if found.recipe(own).is_none() {
            let message = format!("`{name}` is a matrix that is not diagonal");
            return complaint(message, "vary scalars, vectors and diagonal matrices");
        }
        Ok(found)
    }

    /// Returns the statement in a few words.
    pub fn text(&self) -> String {
        format!("{} ± {}", self.name, self.typed)
    }

    /// Returns the parameter's recipe: its components within the distance of their values.
    pub fn recipe(&self, parameter: &Parameter) -> Option<SamplerSpec> {
        match &parameter.origin {
            ParameterOrigin::Fixed(values) => {
                SamplerSpec::around(parameter.kind, values, &self.half)
            }
            _ => None,
        }
    }

    /// Frees the parameter in a model. `None` where it is not fixed there.
    pub fn free(&self, model: &mut Model) -> Option<()> {
        let own = model.parameters.get_mut(self.parameter)?;
        own.origin = ParameterOrigin::Free(self.recipe(own)?);
        Some(())
    }
}
