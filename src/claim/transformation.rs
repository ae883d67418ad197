//! Maps of phase space: symmetries, reversors, scalings, and maps to other systems.

use super::boxes::{Boxes, multiple_text};
use super::elsewhere::{inverse_at, one_antiderivative, system_at, written_at};
use super::images::Transformation;
use super::statement::open_constant;
use super::{Condition, Jets, Need, Reader, Statement, ValueShape, difference, quadrature_defects};
use crate::formula::{Formula, Layout, Type};
use crate::graph::{Expr, record};
use crate::mechanics::calculus::DualPoint;
use crate::mechanics::{Dependence, Meaning, Model, Phase, Variable};
use crate::scalar::Scalar;

/// σ takes solutions to solutions, and the level to itself: dσ·v = λ v∘σ, where t → λt; of a map,
/// Φ∘σ = σ∘Φ.
#[derive(Clone, Debug)]
pub struct Symmetry {
    map: Transformation,
    time: Option<Formula>,
}

/// σ reverses time and takes the level to itself: dσ·v = -v∘σ, and σ∘σ = id; of a map, Φ∘σ∘Φ = σ.
#[derive(Clone, Debug)]
pub struct Reversor(Transformation);

/// The claim that in new variables y = φ(x) the motion obeys N⁻¹y' = g(y).
#[derive(Clone, Debug)]
pub struct Map {
    /// Model of the new variables with their names; its parameters are the case's.
    target: Box<Model>,
    images: Vec<Formula>,
    rates: Vec<Formula>,
    multiplier: Option<Formula>,
}

impl Map {
    /// Returns the point φ(x).
    fn there<T: Scalar>(&self, phase: &Phase<'_, T>) -> Phase<'_, T> {
        let images = self.images.iter().flat_map(|image| phase.evaluate(image).components());
        phase.in_model(&self.target, &images.collect::<Vec<T>>())
    }
}

/// Whether a scalar formula is recorded as 0.
fn vanishes(model: &Model, formula: &Formula) -> bool {
    let parameters = model.free_components();
    let recorded = record(parameters + model.dimension(), |inputs| {
        let (parameters, state) = inputs.split_at(parameters);
        Phase::new(model, parameters, state).scalar(formula)
    });
    recorded.is_ok_and(|(graph, value)| {
        graph.constant_value(value).is_some_and(|value| value.is_zero())
    })
}

impl Statement for Symmetry {
    const NAME: &'static str = "symmetry";
    const COMPANIONS: &'static [&'static str] = &["time"];
    const SHAPES: &'static [(&'static str, ValueShape)] = &[(Self::NAME, ValueShape::Table)];
    const JETS: Jets = Jets::TwoPoints;
    const OF_MAPS: bool = true;

    fn text(&self) -> Option<String> {
        Some(self.map.text.clone())
    }

    fn layout(&self, boxes: Boxes<'_>) -> Option<Layout> {
        Some(boxes.images(&self.map, self.time.as_ref()))
    }

    fn particulars(&self) -> Option<String> {
        Some(format!("t → {}", multiple_text(self.time.as_ref()?, "t")))
    }

    fn read<R: Reader>(from: &R) -> Result<Self, R::Error> {
        let mut map = Transformation::read(from, Self::NAME)?;
        let time = from.formula("time", Some(Type::Scalar))?;
        if time.is_some() && from.model().system.is_map() {
            let message = "a map has no time to scale".to_string();
            return Err(from.complaint("time", message, "remove `time`"));
        }
        let moves = |time: &Formula| {
            let names = &from.model().vocabulary;
            names.with_abbreviations(time, &from.model().abbreviations).iter().any(|formula| {
                let mut reaches = formula.symbols().map(|symbol| names.entry(symbol).reach);
                reaches.any(|reach| reach > Dependence::Parameters)
            })
        };
        if time.as_ref().is_some_and(moves) {
            let message = "`time` depends on the state, and t → λt has a number λ".to_string();
            return Err(from.complaint("time", message, "write λ by numbers and parameters"));
        }
        let is_zero = |time: &Formula| from.complete_model().is_some_and(|own| vanishes(own, time));
        if time.as_ref().is_some_and(is_zero) {
            let message = "`time` is 0, and t → 0 is not a change of time".to_string();
            return Err(from.complaint("time", message, "give λ with t → λt, not 0"));
        }
        map.scale_clock(from.complete_model(), time.as_ref());
        Ok(Self { map, time })
    }

    fn at_images_of_maps(&self) -> Vec<&Formula> {
        self.map.formulas()
    }

    fn presence(&self, jet: &DualPoint<'_, Expr>, kept: &[bool]) -> Vec<Expr> {
        system_at(&self.map.point(&jet.phase), kept)
    }

    /// No time runs where λ is 0.
    fn written_elsewhere(&self, jet: &DualPoint<'_, Expr>) -> Vec<Expr> {
        self.time.iter().flat_map(|own| inverse_at(&jet.phase, own)).collect()
    }

    fn limit_of_refutation(&self, model: &Model) -> Option<&'static str> {
        open_constant(model, &model.dynamics())
    }

    fn formulas(&self) -> Vec<&Formula> {
        self.map.formulas().into_iter().chain(&self.time).collect()
    }

    fn remark(&self, model: &Model, _: &[bool]) -> Option<String> {
        self.map.kinks(model)
    }

    fn changes(&self) -> Vec<usize> {
        self.map.parameters.iter().map(|(index, _)| *index).collect()
    }

    fn conditions(&self, jet: &DualPoint<'_, Expr>, kept: &[bool]) -> Vec<Condition> {
        let columns = jet.along_axes().iter().map(|phase| self.map.image(phase));
        let columns: Vec<_> = columns.collect();
        let rank = columns.len();
        let row = |k: usize| columns.iter().map(|column| column[k].eps).collect();
        let mut rows: Vec<Vec<Expr>> = (0..rank).map(row).collect();
        // On a level it is enough that no direction tangent to it is lost.
        let gradients = jet.level_gradients(kept);
        let fixed = gradients.len();
        rows.extend(gradients);
        let invertible = Condition {
            need: Need::Rank { rows, rank, fixed },
            otherwise: "the map cannot be inverted".to_string(),
            is_essential: false,
        };
        let model = jet.phase.model();
        let steady = Condition::continuous(self.map.image(&jet.phase), "the map");
        let is_flow = !model.system.is_map();
        let open = one_antiderivative(model, &model.dynamics());
        open.into_iter().chain([invertible]).chain(is_flow.then_some(steady)).collect()
    }

    fn residual<T: Scalar>(&self, jet: &DualPoint<'_, T>, kept: &[bool]) -> Vec<T> {
        let there = self.map.point(&jet.phase);
        let mut residual = match jet.phase.model().system.is_map() {
            true => difference(self.map.image(&jet.image()), there.field().to_vec()),
            false => {
                let time = self.time.as_ref().map_or_else(T::one, |time| jet.phase.scalar(time));
                let rates = there.field().iter().map(|rate| time * *rate).collect();
                difference(self.map.pushed(jet), rates)
            }
        };
        residual.extend(jet.level_at(&there, kept));
        residual.extend(self.map.parameters_move(jet));
        residual
    }
}

impl Statement for Reversor {
    const NAME: &'static str = "reversor";
    const SHAPES: &'static [(&'static str, ValueShape)] = &[(Self::NAME, ValueShape::Table)];
    const JETS: Jets = Jets::TwoPoints;
    const OF_MAPS: bool = true;

    fn text(&self) -> Option<String> {
        Some(self.0.text.clone())
    }

    fn layout(&self, boxes: Boxes<'_>) -> Option<Layout> {
        Some(boxes.images(&self.0, None))
    }

    fn read<R: Reader>(from: &R) -> Result<Self, R::Error> {
        let mut map = Transformation::read(from, Self::NAME)?;
        map.scale_clock(from.complete_model(), Some(&Formula::number(-1)));
        Ok(Self(map))
    }

    fn presence(&self, jet: &DualPoint<'_, Expr>, kept: &[bool]) -> Vec<Expr> {
        let there = self.0.point(&jet.phase);
        let mut values = system_at(&there, kept);
        values.extend(self.0.formulas().into_iter().flat_map(|own| written_at(&there, own)));
        if jet.phase.model().system.is_map() {
            let next = jet.image();
            values.extend(self.0.formulas().into_iter().flat_map(|own| written_at(&next, own)));
            values.extend(system_at(&self.0.point(&next), kept));
        }
        values
    }

    fn limit_of_refutation(&self, model: &Model) -> Option<&'static str> {
        open_constant(model, &model.dynamics())
    }

    fn conditions(&self, jet: &DualPoint<'_, Expr>, _: &[bool]) -> Vec<Condition> {
        let model = jet.phase.model();
        let steady = Condition::continuous(self.0.image(&jet.phase), "the map");
        let is_flow = !model.system.is_map();
        let open = one_antiderivative(model, &model.dynamics());
        open.into_iter().chain(is_flow.then_some(steady)).collect()
    }

    fn formulas(&self) -> Vec<&Formula> {
        self.0.formulas()
    }

    fn changes(&self) -> Vec<usize> {
        self.0.parameters.iter().map(|(index, _)| *index).collect()
    }

    fn residual<T: Scalar>(&self, jet: &DualPoint<'_, T>, kept: &[bool]) -> Vec<T> {
        let there = self.0.point(&jet.phase);
        let twice = self.0.point(&there);
        let mut residual = match jet.phase.model().system.is_map() {
            true => {
                let beyond = self.0.point(&jet.image());
                difference(beyond.field().to_vec(), there.state())
            }
            false => {
                let rates = there.field().iter().map(|rate| -*rate).collect();
                difference(self.0.pushed(jet), rates)
            }
        };
        residual.extend(difference(twice.state(), jet.phase.state()));
        residual.extend(jet.level_at(&there, kept));
        residual.extend(self.0.parameters_move(jet));
        for (index, _) in &self.0.parameters {
            let value = |at: &Phase<'_, T>| at.configuration.parameter(*index).components();
            residual.extend(difference(value(&twice), value(&jet.phase)));
        }
        residual
    }
}

impl Statement for Map {
    const NAME: &'static str = "map";
    const COMPANIONS: &'static [&'static str] = &["field", "multiplier"];
    const SHAPES: &'static [(&'static str, ValueShape)] =
        &[(Self::NAME, ValueShape::Table), ("field", ValueShape::Table)];

    fn read<R: Reader>(from: &R) -> Result<Self, R::Error> {
        let model = from.model();
        let (names, images): (Vec<String>, Vec<Formula>) =
            from.table(Self::NAME)?.into_iter().unzip();
        if names.is_empty() {
            let message = "`map` names no new variable".to_string();
            return Err(from.complaint(Self::NAME, message, "give one: { M = \"Ĩ*ω\" }"));
        }
        // In the equations of the new variables their names hide the old ones.
        let mut vocabulary = model.vocabulary.only_parameters();
        let mut state = Vec::new();
        for (index, (name, image)) in names.iter().zip(&images).enumerate() {
            let kind = image.value_type();
            vocabulary.add(name, Meaning::State(index), kind, Dependence::Phase);
            state.push(Variable { name: name.clone(), kind, shape: None });
        }
        let target = model.with_names(vocabulary, state);
        let mut rates = vec![None; names.len()];
        let given = from.table_in("field", &target.vocabulary)?;
        for (name, rate) in given.ok_or_else(|| from.missing("field"))? {
            let plain = name.strip_suffix('\'').unwrap_or(&name);
            let Some(index) = names.iter().position(|known| known == plain) else {
                let message = format!("`{name}` is not the rate of a new variable");
                return Err(from.complaint("field", message, "name the variables of `map`"));
            };
            if rate.value_type() != images[index].value_type() {
                return Err(from.unlike("field", images[index].value_type(), rate.value_type()));
            }
            rates[index] = Some(rate);
        }
        let missing = names.iter().zip(&rates).filter(|(_, rate)| rate.is_none());
        let missing: Vec<String> = missing.map(|(name, _)| format!("`{name}`")).collect();
        let Some(rates) = rates.into_iter().collect::<Option<Vec<Formula>>>() else {
            let message = format!("`field` has no rate for {}", missing.join(", "));
            return Err(from.complaint("field", message, "give one for each name in `map`"));
        };
        let multiplier = from.formula("multiplier", Some(Type::Scalar))?;
        Ok(Self { target: Box::new(target), images, rates, multiplier })
    }

    fn formulas(&self) -> Vec<&Formula> {
        self.images.iter().chain(&self.multiplier).collect()
    }

    fn particulars(&self) -> Option<String> {
        let names = || self.target.state.iter().map(|variable| variable.name.as_str());
        let images =
            names().zip(&self.images).map(|(name, own)| format!("{name} = {}", own.text()));
        let rates = names().zip(&self.rates).map(|(name, own)| format!("{name}' = {}", own.text()));
        let factor = self.multiplier.iter().map(|own| format!("multiplier {}", own.text()));
        Some(images.chain(rates).chain(factor).collect::<Vec<_>>().join("; "))
    }

    fn conditions(&self, jet: &DualPoint<'_, Expr>, _: &[bool]) -> Vec<Condition> {
        let rows: Vec<_> = self.images.iter().flat_map(|image| jet.gradients(image)).collect();
        let independent = Condition {
            need: Need::Rank { rank: rows.len(), rows, fixed: 0 },
            otherwise: "the new variables obey a relation".to_string(),
            is_essential: false,
        };
        let images = self.images.iter().flat_map(|image| jet.phase.evaluate(image).components());
        vec![independent, Condition::continuous(images.collect(), "the map")]
    }

    fn residual<T: Scalar>(&self, jet: &DualPoint<'_, T>, _: &[bool]) -> Vec<T> {
        let there = self.there(&jet.phase);
        let multiplier = self.multiplier.as_ref().map_or_else(T::one, |n| jet.phase.scalar(n));
        let pairs = self.images.iter().zip(&self.rates);
        pairs
            .flat_map(|(image, rate)| {
                let claimed = there.evaluate(rate).components();
                let claimed = claimed.into_iter().map(|x| x * multiplier).collect();
                difference(jet.rates(image), claimed)
            })
            .collect()
    }

    fn written_elsewhere(&self, jet: &DualPoint<'_, Expr>) -> Vec<Expr> {
        self.there(&jet.phase).literal_values(&self.rates)
    }

    fn quadrature_defects_elsewhere(&self, jet: &DualPoint<'_, Expr>) -> Vec<Expr> {
        let there = DualPoint::new(self.there(&jet.phase));
        self.rates.iter().flat_map(|rate| quadrature_defects(&there, rate, &[])).collect()
    }
}
