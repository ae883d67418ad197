//! Hypotheses of theorems of absence: the parameters for which they hold.

use liouville::mechanics::{Draw, Model, Parameter, ParameterOrigin};

/// Puts the hypotheses on the parameters before a statement, which begins with a small letter.
pub fn stated(model: &Model, statement: &str) -> String {
    sentence(&own(model, false), statement)
}

/// Puts a hypothesis on the listed values before a theorem about a case in which `fixed` has one value in
/// place of each list of `model`: such a value is not a given one.
pub fn headed(hypothesis: &str, model: &Model, fixed: &Model, theorem: &str) -> String {
    let statement = match sentence(&own(fixed, false), "").as_str() {
        "" => theorem,
        known => theorem.strip_prefix(known).unwrap_or(theorem),
    };
    // A sentence without hypotheses begins with a capital letter.
    let mut letters = statement.chars();
    let first: String = letters.next().into_iter().flat_map(char::to_lowercase).collect();
    let others = own(model, true);
    let all: Vec<&str> = [hypothesis].into_iter().chain(others).collect();
    sentence(&all, &format!("{first}{}", letters.as_str()))
}

/// The hypotheses on the parameters without a list, and on those with one where these are not named.
fn own(model: &Model, are_lists_named: bool) -> Vec<&'static str> {
    let is_fixed = |own: &Parameter| matches!(own.origin, ParameterOrigin::Fixed(_));
    let has_fixed = model.parameters.iter().any(is_fixed);
    let has_free = match are_lists_named {
        true => model.parameters.iter().any(|own| !is_fixed(own) && !is_listed(own)),
        false => model.free_components() > 0,
    };
    [
        has_free.then_some("generic values of the free parameters"),
        has_fixed.then_some(match (has_free, are_lists_named) {
            (true, _) => "the given values of the fixed ones",
            (false, true) => "the given values of the fixed parameters",
            (false, false) => "the given values of the parameters",
        }),
    ]
    .into_iter()
    .flatten()
    .collect()
}

/// Whether a parameter has a list of several values.
pub fn is_listed(parameter: &Parameter) -> bool {
    let several = |draw: &Draw| matches!(draw, Draw::OneOf(values) if values.len() > 1);
    match &parameter.origin {
        ParameterOrigin::Free(recipe) => recipe.draws().iter().any(several),
        _ => false,
    }
}

/// A sentence from hypotheses and a statement, which begins with a small letter.
fn sentence(hypotheses: &[&str], statement: &str) -> String {
    match hypotheses {
        [] => {
            let mut letters = statement.chars();
            let first: String = letters.next().into_iter().flat_map(char::to_uppercase).collect();
            format!("{first}{}", letters.as_str())
        }
        all => format!("For {}, {statement}", all.join(", and ")),
    }
}

#[cfg(test)]
mod tests {
    use liouville::case::Case;

    use super::*;

    fn case(parameters: &str) -> Case {
        let text = format!(
            "title='x'\n[parameters]\n{parameters}\n[state]\nx='1..2'\n[field]\n\"x'\"='x'\n"
        );
        Case::parse(&text, &[]).expect("a case")
    }

    #[test]
    fn listed_values_are_not_given_ones() {
        let says = |parameters: &str, fixed: &str| {
            let (case, fixed) = (case(parameters), case(fixed));
            let own = stated(&fixed.model, "there is none.");
            headed("a = 1", &case.model, &fixed.model, &own)
        };
        assert_eq!(says("a='one of 1, 2'", "a=1"), "For a = 1, there is none.");
        assert_eq!(
            says("a='one of 1, 2'\nb='1..2'", "a=1\nb='1..2'"),
            "For a = 1, and generic values of the free parameters, there is none."
        );
        assert_eq!(
            says("a='one of 1, 2'\nb=3", "a=1\nb=3"),
            "For a = 1, and the given values of the fixed parameters, there is none."
        );
        assert_eq!(
            says("a='one of 1, 2'\nb=3", "a='one of 1, 2'\nb=3"),
            "For a = 1, and the given values of the fixed parameters, there is none."
        );
        assert_eq!(
            headed("a = 1", &case("a='one of 1, 2'").model, &case("a=1").model, "There is none."),
            "For a = 1, there is none."
        );
    }

    #[test]
    fn only_parameters_that_are_there_are_named() {
        let says = |parameters: &str| stated(&case(parameters).model, "there is none.");
        assert_eq!(says(""), "There is none.");
        assert_eq!(says("a=2"), "For the given values of the parameters, there is none.");
        assert_eq!(says("a='1..2'"), "For generic values of the free parameters, there is none.");
        let both = "For generic values of the free parameters, and the given values of the fixed ones, there \
                    is none.";
        assert_eq!(says("a='1..2'\nb=3"), both);
    }
}
