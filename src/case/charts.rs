//! The table `[level.chart]`: a parametrisation of the level set.

use super::error::{Mistake, Problem};
use super::formulas::formula;
use super::section::CaseTable;
use super::state::{self, State};
use crate::formula::{Formula, Type, canonical_name};
use crate::mechanics::{
    Chart, Dependence, Draw, GivenChart, Meaning, Model, TIME, Variable, Vocabulary,
};

/// Reads the table: inputs with ranges, and a formula for each state variable; `None` where there
/// is a mistake.
///
/// The formulas may use the parameters, abbreviations made of them, and the inputs. `draws` are
/// those of the state's components.
pub fn chart(section: &CaseTable<'_>, model: &Model, draws: &[Draw]) -> Option<Chart> {
    let Some(table) = section.keep(section.section("inputs"))? else {
        let remedy = "a chart needs inputs = { u = \"-2..2\", … }";
        section.mistakes().add(section.missing("inputs", remedy));
        return None;
    };
    let keys = table.entries().into_iter();
    let own: Vec<String> = keys.filter_map(|(key, _)| canonical_name(key.get_ref())).collect();
    // an input may have the name of an abbreviation
    let mut names: Vocabulary = model.vocabulary.only(|entry| {
        let is_input =
            matches!(entry.meaning, Meaning::Abbreviation(_)) && own.contains(&entry.name);
        entry.reach == Dependence::Parameters && !is_input
    });
    let mut inputs = state::state(&table, &mut names, Dependence::Phase, None);
    if inputs.variables.iter().any(|input| input.shape.is_some()) {
        section.mistakes().add(table.complaint(Problem::Other {
            message: "an input of a chart is a scalar, a vector or a matrix".to_string(),
            remedy: "give the entries of a symmetric or skew matrix as a vector".to_string(),
        }));
        return None;
    }
    add_time(section, model, &mut names, &mut inputs, draws);
    let mut formulas: Vec<Option<Formula>> = vec![None; model.state.len()];
    let mut broken = false;
    let mut abbreviations = model.abbreviations.clone();
    for (key, value) in section.entries() {
        if key.get_ref() == "inputs" {
            continue;
        }
        let name = canonical_name(key.get_ref()).unwrap_or_default();
        let Some(index) = model.state.iter().position(|variable| variable.name == name) else {
            broken = true;
            if !section.mistakes().has_failed(&name) {
                let message = format!("`{}` is not a state variable", key.get_ref());
                let remedy = "a chart gives a formula for each state variable".to_string();
                let problem = Problem::Other { message, remedy };
                section.mistakes().add(Mistake::at(key.span(), problem));
            }
            continue;
        };
        let kind = model.state[index].kind;
        let text = section.as_text(key.get_ref(), value);
        let read =
            text.and_then(|text| formula(&text, &names, &name, Some(kind), Dependence::Phase));
        match section.keep(read) {
            Some(read) => {
                // Later formulas may use this variable.
                let meaning = Meaning::Abbreviation(abbreviations.len());
                names.add(&name, meaning, kind, Dependence::Phase);
                abbreviations.push(read.clone());
                formulas[index] = Some(read);
            }
            None => {
                broken = true;
                section.mistakes().fail(&name);
            }
        }
    }
    // A state variable with the name of an input is that input.
    for (formula, own) in formulas.iter_mut().zip(&model.state) {
        let is_input = inputs.variables.iter().any(|v| v.name == own.name && v.kind == own.kind);
        if formula.is_none() && is_input {
            *formula = Formula::parse(&own.name, &names).ok();
        }
    }
    if broken {
        return None;
    }
    if let Some(index) = formulas.iter().position(Option::is_none) {
        let name = &model.state[index].name;
        section.mistakes().add(section.complaint(Problem::Other {
            message: format!("the chart has no formula for `{name}`"),
            remedy: format!("add {name} = \"…\" under [level.chart]"),
        }));
        return None;
    }
    let model = Model {
        vocabulary: names,
        state: inputs.variables,
        abbreviations,
        level: Vec::new(),
        orientations: Vec::new(),
        extension: Vec::new(),
        variables: None,
        ..model.clone()
    };
    let formulas = formulas.into_iter().flatten().collect();
    Some(Chart::Given(Box::new(GivenChart { model, draws: inputs.draws, formulas })))
}

/// Adds time as an input where the chart gives no formula for it.
fn add_time(
    section: &CaseTable<'_>,
    model: &Model,
    names: &mut Vocabulary,
    inputs: &mut State,
    draws: &[Draw],
) {
    let Some(index) = model.state.iter().position(|own| own.name == TIME) else { return };
    let own = &model.state[index];
    let is_given = section.has(TIME) || inputs.variables.iter().any(|v| v.name == TIME);
    if own.kind == Type::Scalar && !is_given {
        let first = model.state[..index].iter().map(Variable::len).sum();
        let draws = draws.get(first..=first).unwrap_or_default().to_vec();
        inputs.add(TIME, own.kind, draws, names, Dependence::Phase);
    }
}
