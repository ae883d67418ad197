//! The table `[field]`: the rates of the variables.

use super::error::{Mistake, Problem};
use super::family::{Key, Rates, Unreadable};
use super::section::CaseTable;
use super::shaped;
use crate::formula::{Formula, Type, excerpt, look_alike, skeleton};
use crate::mechanics::{Dependence, Parameter, TIME, Variable, Vocabulary};

/// Names of a file, and its parameters.
#[derive(Clone, Copy)]
pub struct Names<'n> {
    pub vocabulary: &'n Vocabulary,
    pub parameters: &'n [Parameter],
}

/// Reads the formulas of each variable whose rate is given, under its name with or without a prime.
pub fn given_rates(
    section: &CaseTable<'_>,
    variables: &[Variable],
    names: Names<'_>,
    reach: Dependence,
) -> Vec<GivenRate> {
    let vocabulary = names.vocabulary;
    // A matrix that is made of components is written as such.
    let written: Vec<Variable> = variables.iter().map(shaped::written).collect();
    let mut rates: Vec<Rates> = variables.iter().map(|_| Rates::default()).collect();
    let mut broken = vec![false; variables.len()];
    for (key, value) in section.entries() {
        let (index, read) = match Key::read(key.get_ref(), &written, vocabulary) {
            Ok(found) => found,
            Err(Unreadable::Unknown(name)) if section.mistakes().has_failed(&name) => continue,
            Err(unreadable) => {
                // the rate of a name that looks like this one is not missing too
                if let Unreadable::Unknown(name) = &unreadable {
                    let mut own = written.iter().map(|own| skeleton(&own.name));
                    let place = own.position(|own| own == skeleton(name));
                    place.into_iter().for_each(|place| broken[place] = true);
                }
                let problem = unknown_rate(key.get_ref(), unreadable, &written);
                section.mistakes().add(Mistake::at(key.span(), problem));
                continue;
            }
        };
        let plain = read.name.clone();
        match section.keep(section.as_text(key.get_ref(), value)) {
            None => broken[index] = true,
            Some(text) => {
                if !rates[index].add(read, key.span(), text) {
                    let reason = format!("the rate of `{plain}` is given twice");
                    let name = key.get_ref().to_string();
                    section
                        .mistakes()
                        .add(Mistake::at(key.span(), Problem::BadName { name, reason }));
                }
            }
        }
    }
    let read = |((variable, rates), broken): ((&Variable, Rates), bool)| match rates.is_empty() {
        true if broken => GivenRate::Broken,
        true => GivenRate::Missing,
        false => {
            let whole = rates.formulas(&shaped::written(variable), vocabulary, reach);
            let formulas = whole.and_then(|whole| match &variable.shape {
                Some(shape) => {
                    let place = rates.place();
                    shaped::components(shape, whole, names)
                        .map_err(|problem| Mistake::new(place, problem))
                }
                None => Ok(whole),
            });
            match section.keep(formulas) {
                Some(formulas) => GivenRate::Given(formulas),
                None => GivenRate::Broken,
            }
        }
    };
    variables.iter().zip(rates).zip(broken).map(read).collect()
}

/// Rate of a variable in a file.
pub enum GivenRate {
    /// Formulas whose components, concatenated, are the rate.
    Given(Vec<Formula>),
    /// A rate given with a mistake.
    Broken,
    /// No rate.
    Missing,
}

fn unknown_rate(key: &str, unreadable: Unreadable, variables: &[Variable]) -> Problem {
    let (message, remedy) = match unreadable {
        Unreadable::Message(message, remedy) => (message, remedy.to_string()),
        Unreadable::Unknown(name) => {
            let meant = look_alike(&name, variables.iter().map(|own| own.name.as_str()));
            let names: Vec<&str> = variables.iter().map(|v| v.name.as_str()).collect();
            let stem = name.trim_end_matches(|c: char| c.is_ascii_digit());
            let is_vector = |of: &&str| {
                let is_of =
                    |own: &Variable| own.name == **of && matches!(own.kind, Type::Vector(_));
                variables.iter().any(is_of)
            };
            // x_2 is read as x2.
            let vector = [stem, stem.trim_end_matches('_')].into_iter().find(is_vector);
            let remedy = match (names.as_slice(), vector) {
                (_, Some(vector)) if stem != name => {
                    format!("write \"{vector}[{}]'\"", &name[stem.len()..])
                }
                _ if meant.is_some() => meant.unwrap_or_default(),
                ([], _) => "declare the variable in [state] first".to_string(),
                _ => format!("[state] has {}; write \"x'\" = \"…\"", names.join(", ")),
            };
            (format!("`{}` is not the rate of a state variable", excerpt(key)), remedy)
        }
    };
    Problem::Other { message, remedy }
}

/// Reads the rates of all variables; `None` if one is missing, or wrong.
pub fn rates(
    section: &CaseTable<'_>,
    variables: &[Variable],
    names: Names<'_>,
) -> Option<Vec<Formula>> {
    all_of(section, variables, names, true)
}

/// Reads the images of all variables under a map; nothing if one is missing, or wrong.
pub fn images(
    section: &CaseTable<'_>,
    variables: &[Variable],
    names: Names<'_>,
) -> Option<Vec<Formula>> {
    all_of(section, variables, names, false)
}

fn all_of(
    section: &CaseTable<'_>,
    variables: &[Variable],
    names: Names<'_>,
    are_rates: bool,
) -> Option<Vec<Formula>> {
    let given = given_rates(section, variables, names, Dependence::Phase);
    let mut all = Some(Vec::new());
    for (variable, rate) in variables.iter().zip(given) {
        let formulas = match rate {
            GivenRate::Given(formulas) => Some(formulas),
            GivenRate::Broken => None,
            GivenRate::Missing
                if are_rates && variable.name == TIME && variable.kind == Type::Scalar =>
            {
                section.keep(one(names.vocabulary).map(|one| vec![one]))
            }
            GivenRate::Missing => {
                let name = &shaped::written(variable).name;
                let (message, remedy) = match are_rates {
                    true => (
                        format!("[field] has no rate for `{name}`"),
                        format!("add \"{name}'\" = \"…\""),
                    ),
                    false => (
                        format!("[map] has no image of `{name}`"),
                        format!("add \"{name}\" = \"…\"; \"{name}\" where it stays"),
                    ),
                };
                section.mistakes().add(section.complaint(Problem::Other { message, remedy }));
                None
            }
        };
        match (&mut all, formulas) {
            (Some(all), Some(formulas)) => all.extend(formulas),
            _ => all = None,
        }
    }
    all
}

/// Rate of time.
fn one(vocabulary: &Vocabulary) -> Result<Formula, Mistake> {
    Formula::parse("1", vocabulary).map_err(|error| Mistake::whole(Problem::Formula(error)))
}
