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
                // the rate of a name that looks like this one, or is its position, is not missing too
                if let Unreadable::Unknown(name) = &unreadable {
                    let of = name.strip_suffix('\'').or(of_rate(key.get_ref())).unwrap_or(name);
                    let place = written
                        .iter()
                        .position(|own| own.name == of || skeleton(&own.name) == skeleton(name));
                    place.into_iter().for_each(|place| broken[place] = true);
                }
                let problem = unknown_rate(key.get_ref(), unreadable, &written, section.is("map"));
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
            let is_map = section.is("map");
            let formulas = formulas.map_err(|mistake| explained(mistake, variables, !is_map));
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

fn unknown_rate(
    key: &str,
    unreadable: Unreadable,
    variables: &[Variable],
    is_map: bool,
) -> Problem {
    let (prime, what) =
        if is_map { ("", "variable of the map") } else { ("'", "rate of a state variable") };
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
                    format!("write \"{vector}[{}]{prime}\"", &name[stem.len()..])
                }
                (all, _) if name.strip_suffix('\'').is_some_and(|own| all.contains(&own)) => {
                    format!(
                        "declare the velocity in [state], as \"{name}\" = \"-1..1\"; its rate is \"{name}'\""
                    )
                }
                (all, _) if of_rate(key).is_some_and(|own| all.contains(&own)) => {
                    format!("write \"{}{prime}\" = \"…\"", of_rate(key).unwrap_or_default())
                }
                _ if meant.is_some() => meant.unwrap_or_default(),
                ([], _) => "declare the variable in [state] first".to_string(),
                _ => format!("[state] has {}; write \"x{prime}\" = \"…\"", names.join(", ")),
            };
            (
                format!("`{}` is not {} {what}", excerpt(key), if is_map { "a" } else { "the" }),
                remedy,
            )
        }
    };
    Problem::Other { message, remedy }
}

/// Name of the variable whose rate is written as dx/dt, or as in programs.
fn of_rate(key: &str) -> Option<&str> {
    let key = key.trim();
    let quotient = key.strip_prefix('d').and_then(|rest| rest.strip_suffix("/dt"));
    let wrapped = |name: &str| key.strip_prefix(name)?.strip_prefix('(')?.strip_suffix(')');
    let found = quotient.or_else(|| ["D", "der", "diff"].into_iter().find_map(wrapped));
    let found =
        found.or_else(|| key.strip_prefix("\\dot").map(|rest| rest.trim_matches(['{', '}'])));
    let found = found.or_else(|| key.strip_suffix("_dot").or_else(|| key.strip_suffix("dot")));
    found.or_else(|| key.strip_prefix('d')).map(|name| name.trim().trim_end_matches("(t)"))
}

/// Says what to write where a formula of [field] or [map] takes a rate or an image for a name.
fn explained(mistake: Mistake, variables: &[Variable], are_rates: bool) -> Mistake {
    let name = mistake.unknown_name().unwrap_or_default().to_string();
    let Some(own) = name.strip_suffix('\'').filter(|own| variables.iter().any(|v| v.name == **own))
    else {
        return mistake;
    };
    let (what, of) = match are_rates {
        true => ("rates are functions of the state", "rate"),
        false => ("images are functions of the state before the step", "image"),
    };
    let remedy = format!(
        "{what}: put the {of} of `{own}` in [let], under a name of its own, and write that name in both"
    );
    let problem = Problem::Other { message: format!("unknown name `{name}`"), remedy };
    Mistake { problem, ..mistake }
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
            // A position with its velocity in the state is a second-order equation.
            GivenRate::Missing if are_rates && has_velocity(variable, variables) => {
                let velocity = Formula::parse(&format!("{}'", variable.name), names.vocabulary);
                let velocity = velocity.map_err(|error| Mistake::whole(Problem::Formula(error)));
                section.keep(velocity.map(|own| vec![own]))
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

/// Whether another variable is the velocity of this one by its name.
fn has_velocity(variable: &Variable, variables: &[Variable]) -> bool {
    let is_velocity = |own: &Variable| {
        own.name.strip_suffix('\'') == Some(variable.name.as_str()) && own.kind == variable.kind
    };
    variable.shape.is_none() && variables.iter().any(is_velocity)
}

/// Rate of time.
fn one(vocabulary: &Vocabulary) -> Result<Formula, Mistake> {
    Formula::parse("1", vocabulary).map_err(|error| Mistake::whole(Problem::Formula(error)))
}

#[cfg(test)]
mod tests {
    use crate::case::Case;
    use crate::mechanics::System;

    #[test]
    fn an_equation_of_second_order_needs_the_range_of_its_velocity_alone() {
        let text = "title = 'x'\n[state]\nx = '-1..1'\n\"x'\" = '-1..1'\nr = 'vector(-1..1)'\n\
                    \"r'\" = 'vector(-1..1)'\n[field]\n\"x''\" = '-sin(x)'\n\"r''\" = '-r'\n";
        let case = Case::parse(text, &[]).expect("a case");
        let System::Field(rates) = &case.model.system else { panic!("a field") };
        let texts: Vec<&str> = rates.iter().map(|rate| rate.text()).collect();
        assert_eq!(texts, ["x'", "-sin(x)", "r'", "-r"]);
        // Without a range the velocity has no states.
        let error =
            Case::parse(&text.replace("\"x'\" = '-1..1'\n", ""), &[]).expect_err("no range");
        assert!(error.to_string().contains("`x''` is not the rate of a state variable"), "{error}");
    }

    #[test]
    fn ends_of_ranges_are_formulas_of_numbers() {
        let text = "title = 'x'\n[parameters]\na = '0..2*pi'\n[state]\n\"φ\" = '-π..π'\n\
                    \"θ\" = 'vector(0..pi*(1 + 1)/3)'\nu = 'sqrt(2)..sqrt(3)'\n[field]\n\"φ\" = 'a'\n\"θ\" = 'θ'\nu = '1'\n";
        let case = Case::parse(text, &[]).expect("a case");
        let draws: Vec<String> = case.free_draws.iter().map(|draw| format!("{draw:?}")).collect();
        assert_eq!(draws.len(), 5, "{draws:?}");
        let shown = case.model.free_parameters().next().expect("a parameter");
        assert_eq!(format!("{:?}", shown.name), "\"a\"");
        for (range, word) in [("-k..k", "`-k` is not a number"), ("0..180°", "in degrees")] {
            let error = Case::parse(&text.replace("-π..π", range), &[]).expect_err("no range");
            assert!(error.to_string().contains(word), "{range}: {error}");
        }
    }
}
