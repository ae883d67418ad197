//! Maps of phase space to itself, given by images of variables and parameters.

use super::clock::clock;
use super::{Reader, difference, kinks};
use crate::formula::{Formula, Symbol};
use crate::graph::record;
use crate::mechanics::calculus::DualPoint;
use crate::mechanics::{Meaning, Model, ParameterOrigin, Phase, TIME};
use crate::scalar::Scalar;

/// A map σ of phase space to itself, which may change parameters too.
#[derive(Clone, Debug)]
pub(super) struct Transformation {
    /// One image for each state variable; variables without one are unchanged.
    pub state: Vec<Option<Formula>>,
    /// Images of parameters, by index.
    pub parameters: Vec<(usize, Formula)>,
    /// The images by name, as `φ → −φ, p → p`.
    pub text: String,
}

impl Transformation {
    /// Reads the table of `key`.
    pub fn read<R: Reader>(from: &R, key: &'static str) -> Result<Self, R::Error> {
        let model = from.model();
        let (state, parameters) = (vec![None; model.state.len()], Vec::new());
        let mut map = Self { state, parameters, text: String::new() };
        let mut texts = Vec::new();
        let images = from.table(key)?;
        if images.is_empty() {
            let message = format!("`{key}` names no variable to transform");
            return Err(from.complaint(key, message, "give an image: { \"γ\" = \"−γ\" }"));
        }
        for (name, image) in images {
            let expected = match model.vocabulary.find(&name) {
                Some(entry) => entry,
                None => return Err(unknown(from, key, &name)),
            };
            if expected.kind != image.value_type() {
                let message = format!(
                    "`{name}` is a {}, and its image a {}",
                    expected.kind,
                    image.value_type()
                );
                return Err(from.complaint(key, message, "give an image of the same kind"));
            }
            texts.push(format!("{name} → {}", image.text().trim()));
            match expected.meaning {
                Meaning::State(index) => map.state[index] = Some(image),
                Meaning::Parameter(index) => {
                    if let ParameterOrigin::Formula(formula) = &model.parameters[index].origin
                        && let Some(symbol) =
                            formula.symbols().find(|own| is_parameter(model, *own))
                    {
                        let other = model.vocabulary.entry(symbol).name.clone();
                        let message = format!(
                            "`{name}` is computed from `{other}`, and has no image of its own"
                        );
                        let remedy = format!("give the image of `{other}`");
                        return Err(from.complaint(key, message, &remedy));
                    }
                    map.parameters.push((index, image));
                }
                _ => return Err(unknown(from, key, &name)),
            }
        }
        map.text = texts.join(", ");
        Ok(map)
    }

    /// Gives the variable t its image λt, if the map does not name it.
    pub fn scale_clock(&mut self, model: Option<&Model>, factor: Option<&Formula>) {
        let (Some(model), Some(factor)) = (model, factor) else { return };
        let Some(index) = clock(model) else { return };
        let image = Formula::parse(TIME, &model.vocabulary).and_then(|time| factor * &time);
        if let (None, Ok(image)) = (&self.state[index], image) {
            self.state[index] = Some(image);
        }
    }

    /// All images.
    pub fn formulas(&self) -> Vec<&Formula> {
        let parameters = self.parameters.iter().map(|(_, image)| image);
        self.state.iter().flatten().chain(parameters).collect()
    }

    /// Returns the remark for a map with a modulus.
    pub fn kinks(&self, model: &Model) -> Option<String> {
        let parameters = model.free_components();
        let recorded = record(parameters + model.dimension(), |inputs| {
            let (parameters, state) = inputs.split_at(parameters);
            self.image(&Phase::new(model, parameters, state))
        });
        recorded.ok().and_then(|(graph, image)| kinks::of_map(&graph, &image))
    }

    /// Computes σ(x).
    pub fn image<T: Scalar>(&self, at: &Phase<'_, T>) -> Vec<T> {
        let values = self.state.iter().enumerate().map(|(index, image)| match image {
            Some(image) => at.evaluate(image),
            None => at.configuration.variable(index),
        });
        values.flat_map(|value| value.components()).collect()
    }

    /// Returns the point σ(x), with the parameters that σ assigns to it.
    pub fn point<'m, T: Scalar>(&self, at: &Phase<'m, T>) -> Phase<'m, T> {
        let parameters: Vec<_> =
            self.parameters.iter().map(|(index, image)| (*index, at.evaluate(image))).collect();
        at.with(&parameters, &self.image(at))
    }

    /// Zero where the parameters that σ gives do not change along the motion, as parameters must not.
    pub fn parameters_move<T: Scalar>(&self, jet: &DualPoint<'_, T>) -> Vec<T> {
        let images = self.parameters.iter().map(|(_, image)| image);
        if !jet.phase.model().system.is_map() {
            return images.flat_map(|image| jet.rates(image)).collect();
        }
        let there = jet.image();
        let values = |at: &Phase<'_, T>, image| at.evaluate(image).components();
        images
            .flat_map(|image| difference(values(&there, image), values(&jet.phase, image)))
            .collect()
    }

    /// Computes dσ·v.
    pub fn pushed<T: Scalar>(&self, jet: &DualPoint<'_, T>) -> Vec<T> {
        self.image(jet.along_field()).into_iter().map(|x| x.eps).collect()
    }
}

fn is_parameter(model: &Model, symbol: Symbol) -> bool {
    matches!(model.vocabulary.entry(symbol).meaning, Meaning::Parameter(_))
}

fn unknown<R: Reader>(from: &R, key: &'static str, name: &str) -> R::Error {
    let message = format!("`{name}` is neither a state variable nor a parameter");
    let names: Vec<&str> = from.model().state.iter().map(|own| own.name.as_str()).collect();
    let remedy =
        format!("the state variables are {}; parameters may change, too", names.join(", "));
    from.complaint(key, message, &remedy)
}
