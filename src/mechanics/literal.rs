//! Recorded values without which formulas, as written, have none.

use super::configuration::Parameters;
use super::model::Model;
use super::phase::Phase;
use crate::formula::{Formula, Value};
use crate::graph::{Expr, literally, record};
use crate::number::UnaryFunction;
use crate::scalar::Scalar;

impl<T: Scalar> Phase<'_, T> {
    /// Evaluates the bases of the powers with an exponent that varies, in a formula and what it uses.
    pub fn bases_of_powers(&self, formula: &Formula) -> Vec<T> {
        let all = self.with_what_it_uses(formula).into_iter();
        all.flat_map(|used| T::literally(|| self.bases_in(used))).collect()
    }

    fn bases_in(&self, formula: &Formula) -> Vec<T> {
        let model = self.model();
        formula.bases(&|symbol| model.varies(symbol), &mut |symbol| self.literal_value(symbol))
    }

    /// Lists a formula with the abbreviations in it and in the formulas of its parameters, and these.
    fn with_what_it_uses<'f>(&'f self, formula: &'f Formula) -> Vec<&'f Formula> {
        let model = self.model();
        let own = std::iter::once(formula).chain(model.parameter_formulas_of(&[formula]));
        own.flat_map(|own| model.vocabulary.with_abbreviations(own, &model.abbreviations)).collect()
    }
}

impl Phase<'_, Expr> {
    /// Records the components of formulas so that they are defined exactly where everything written
    /// is; components that are defined everywhere are omitted.
    pub fn literal_values<'f>(&self, formulas: impl IntoIterator<Item = &'f Formula>) -> Vec<Expr> {
        let written = |f: &'f Formula| {
            let mut values = self.evaluate_literally(f).components();
            values.extend(self.presupposed(f));
            values
        };
        let values = formulas.into_iter().flat_map(written);
        values.filter(|value| !value.is_always_defined()).collect()
    }

    /// Evaluates as written what a formula has no value without, though its value need not show it: the
    /// integrand of each ∫, and the logarithm of the base of each power with an exponent that varies,
    /// which may come out as a whole number; so of the formulas of the parameters in it.
    pub fn presupposed(&self, formula: &Formula) -> Vec<Expr> {
        let of = |used: &Formula| {
            literally(|| {
                let bases = self.bases_in(used).into_iter();
                let mut lookup = |symbol| self.literal_value(symbol);
                let integrands = used.antiderivatives(&mut lookup).into_iter().map(|(f, _)| f);
                let logarithms = bases.map(|base| base.apply(UnaryFunction::Ln));
                logarithms.chain(integrands).collect::<Vec<Expr>>()
            })
        };
        self.with_what_it_uses(formula).into_iter().flat_map(of).collect()
    }

    /// Records the parts of a chart's formulas that depend on the parameters alone, such that all exist
    /// wherever the formulas do.
    pub fn literal_constants(&self, chart: &Model, formulas: &[Formula]) -> Vec<Expr> {
        let own = &self.configuration.parameters;
        let given: Vec<Expr> = own.iter().flatten().flat_map(Value::components).collect();
        let recorded = record(given.len() + chart.dimension(), |inputs| {
            let (mut rest, inputs) = inputs.split_at(given.len());
            let again = |value: &Option<Value<Expr>>| {
                let value = value.as_ref()?;
                let (components, others) = rest.split_at(value.components().len());
                rest = others;
                Some(Value::from_components(value.value_type(), components))
            };
            let parameters: Parameters<Expr> = own.iter().map(again).collect();
            Phase::with_parameters(chart, parameters, inputs).literal_values(formulas)
        });
        // Where nothing is required, more states count.
        let Ok((graph, outputs)) = recorded else { return Vec::new() };
        let reached = graph.reached(outputs.iter().copied());
        let values = literally(|| graph.replay(&reached, &given, |_, _, _| None));
        let is_part = |place: usize| values[place].is_some();
        let mut is_needed = vec![false; values.len()];
        outputs.iter().for_each(|output| is_needed[graph.place(*output)] = true);
        for (place, step) in graph.steps().enumerate() {
            if reached[place] && !is_part(place) {
                step.arguments().for_each(|argument| is_needed[argument] = true);
            }
        }
        let needed = values.iter().zip(is_needed).filter(|(_, is_needed)| *is_needed);
        let needed = needed.filter_map(|(value, _)| *value);
        needed.filter(|value| !value.is_always_defined()).collect()
    }
}
