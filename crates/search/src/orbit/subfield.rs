//! The part of a field that does without its functions, as a field of its own.
//!
//! Of a sleigh with its positions, the heading and the velocities form such a part: their rates contain no
//! sine. What is found for them is judged as a claim about the whole case.

use liouville::case::Case;
use liouville::formula::Type;
use liouville::mechanics::{Meaning, Model, SamplerSpec, System};

use super::super::terms::recorded;
use super::super::{Effort, SearchError, SearchReport};
use super::adjoin::with_parameters;
use super::{blocks, explicit};

/// Searches the largest closed set of variables whose rates are rational, unless these are all.
pub fn search(
    case: &Case,
    effort: &Effort,
    further: bool,
    report: &mut SearchReport,
    progress: &mut dyn FnMut(&str),
) -> Result<(), SearchError> {
    let part = match rational_part(case) {
        Err(SearchError::Unbuilt(error)) => {
            report.remark(format!("variables with rational rates are not searched alone: {error}"));
            return Ok(());
        }
        other => other?,
    };
    let Some(part) = part else { return Ok(()) };
    let mut own = SearchReport::default();
    super::search(&part, &effort.in_names_of(&part), further, &mut own, progress)?;
    for found in &own.found {
        effort.halt.check()?;
        explicit::take(case, &|text| text.to_string(), found, effort, report)?;
    }
    Ok(())
}

/// The field of these variables; `None` if there are fewer than two, or no others.
fn rational_part(case: &Case) -> Result<Option<Case>, SearchError> {
    let model = &case.model;
    let System::Field(field) = &model.system else { return Ok(None) };
    if !model.level.is_empty() || model.state.iter().any(|own| own.kind != Type::Scalar) {
        return Ok(None);
    }
    let (graph, rates) = recorded(case, |jet| jet.phase.field().to_vec())?;
    let is_rational = |set: &Vec<usize>| {
        let reached = graph.reached(set.iter().map(|k| rates[*k]));
        (0..graph.len())
            .filter(|place| reached[*place])
            .all(|place| graph.step(place).is_rational())
    };
    let sets = blocks::closed(case)?.into_iter().filter(is_rational);
    let mut part: Vec<usize> = sets.flatten().collect();
    part.sort_unstable();
    part.dedup();
    if part.len() < 2 || part.len() == model.dimension() {
        return Ok(None);
    }
    let mut own = with_parameters(Model::field().title("part"), model);
    for k in &part {
        let Some(draw) = case.free_draws.get(*k) else { return Ok(None) };
        own = own.variable(&model.state[*k].name, SamplerSpec::Scalar(draw.clone()));
    }
    // Some of what the file defines may contain other variables.
    for (_, entry) in model.vocabulary.iter() {
        if let Meaning::Abbreviation(place) = entry.meaning
            && let Some(formula) = model.abbreviations.get(place)
            && own.formula(formula.text()).is_ok()
        {
            own = own.define(&entry.name, formula.text());
        }
    }
    for k in &part {
        own = own.rate(&model.state[*k].name, field[*k].text());
    }
    own.build().map(Some).map_err(SearchError::Unbuilt)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn definitions_of_a_file_are_taken_over() {
        // s stands in the rates of x and y, and f in none of theirs.
        let text = "title = 'x'\n[parameters]\na = '1..2'\n[let]\ns = 'x + a*y'\nf = 'exp(x*z)'\n[state]\n\
                    x = '1..2'\ny = '1..2'\nz = '1..2'\n[field]\nx = 'x*s'\ny = '-y*s'\nz = 'f + s'\n";
        let case = Case::parse(text, &[]).expect("a case");
        let part = rational_part(&case).expect("recorded").expect("x and y");
        assert_eq!(part.model.state_names(), ["x", "y"]);
        let System::Field(rates) = &part.model.system else { panic!("a field") };
        assert_eq!([rates[0].text(), rates[1].text()], ["x*s", "-y*s"]);
        assert!(part.formula("s").is_ok() && part.formula("f").is_err(), "f contains z");
    }
}
