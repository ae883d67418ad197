//! A chart of the level set: free inputs, and each state variable as a function of them.

use super::super::ClaimError;
use super::super::shapes::state_draws;
use super::super::state::State;
use super::super::value::{FormulaSource, ValueSpec};
use super::ModelBuilder;
use crate::formula::{Formula, Type, canonical_name};
use crate::mechanics::{Chart, Dependence, GivenChart, Meaning, Model};

/// Inputs with their ranges, and formulas of the state variables.
pub(super) type ChartSource = (Vec<(String, ValueSpec)>, Vec<(String, FormulaSource)>);

impl ModelBuilder {
    /// Gives a chart of the level set: inputs with their ranges, and formulas of the state variables in the
    /// parameters, the inputs and the variables before. A variable without a formula is an input itself.
    #[must_use]
    pub fn chart<V: Into<ValueSpec>, F: Into<FormulaSource>>(
        mut self,
        inputs: impl IntoIterator<Item = (String, V)>,
        formulas: impl IntoIterator<Item = (String, F)>,
    ) -> Self {
        let inputs = inputs.into_iter().map(|(name, range)| (name, range.into())).collect();
        let formulas = formulas.into_iter().map(|(name, own)| (name, own.into())).collect();
        self.chart = Some((inputs, formulas));
        self
    }
}

/// Reads the chart of a model.
pub(super) fn chart(model: &Model, (inputs, given): ChartSource) -> Result<Chart, ClaimError> {
    let mut names = model.vocabulary.only(|entry| entry.reach == Dependence::Parameters);
    let mut state = State { variables: Vec::new(), draws: Vec::new(), rotations: None };
    for (name, range) in &inputs {
        let remedy = "give the chart's input a new name and a range, as \"-2..2\"";
        let refuse = |message: &str| ClaimError::new(name, message, remedy);
        let name = canonical_name(name).filter(|name| names.find(name).is_none());
        let name = name.ok_or_else(|| refuse("it is no name, or taken already"))?;
        let range = range.given(&model.vocabulary).map_err(|message| refuse(&message))?;
        let Some((kind, draws)) = state_draws(&range) else {
            return Err(refuse("an input needs a range from which its values are drawn"));
        };
        state.add(&name, kind, draws, &mut names, Dependence::Phase);
    }
    let mut formulas: Vec<Option<Formula>> = vec![None; model.state.len()];
    let mut abbreviations = model.abbreviations.clone();
    for (name, source) in &given {
        let Some(place) = model.state.iter().position(|own| own.name == *name) else {
            let message = "a chart gives formulas of state variables alone";
            return Err(ClaimError::new(name, message, "declare it by `state`"));
        };
        let kind = model.state[place].kind;
        let read = read(name, source, kind, &names)?;
        // Later formulas may use this variable.
        names.add(name, Meaning::Abbreviation(abbreviations.len()), kind, Dependence::Phase);
        abbreviations.push(read.clone());
        formulas[place] = Some(read);
    }
    let whole = formulas.into_iter().zip(&model.state).map(|(formula, own)| match formula {
        Some(formula) => Ok(formula),
        None => read(&own.name, &FormulaSource::from(own.name.as_str()), own.kind, &names),
    });
    let formulas = whole.collect::<Result<_, _>>()?;
    let model = Model {
        vocabulary: names,
        state: state.variables,
        abbreviations,
        level: Vec::new(),
        orientations: Vec::new(),
        extension: Vec::new(),
        variables: None,
        ..model.clone()
    };
    Ok(Chart::Given(Box::new(GivenChart { model, draws: state.draws, formulas })))
}

fn read(
    name: &str,
    source: &FormulaSource,
    kind: Type,
    names: &crate::mechanics::Vocabulary,
) -> Result<Formula, ClaimError> {
    let remedy = "use parameters, inputs of the chart, and the variables before";
    let read = match source {
        FormulaSource::Formula(own) => {
            names.check_own(own).map(|()| own.clone()).map_err(|other| {
                ClaimError::new(name, format!("`{other}` is not a name of the chart"), remedy)
            })
        }
        FormulaSource::Text(text) => Formula::parse(text, names)
            .map_err(|error| ClaimError::new(name, error.message(), remedy)),
        FormulaSource::Failed(error) => Err(ClaimError::new(name, error.message(), remedy)),
    }?;
    match read.value_type() == kind {
        true => Ok(read),
        false => {
            let message = format!("`{read}` is a {}", read.value_type());
            Err(ClaimError::new(name, message, &format!("give a {kind}")))
        }
    }
}
