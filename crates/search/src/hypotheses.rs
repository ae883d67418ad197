//! Hypotheses of theorems of absence: the parameters for which they hold.

use liouville::mechanics::{Model, Parameter, ParameterOrigin};

/// Puts the hypotheses on the parameters before a statement, which begins with a small letter.
pub fn stated(model: &Model, statement: &str) -> String {
    let is_fixed = |own: &Parameter| matches!(own.origin, ParameterOrigin::Fixed(_));
    let has_fixed = model.parameters.iter().any(is_fixed);
    let hypotheses = match (model.free_components() > 0, has_fixed) {
        (true, true) => {
            "For generic values of the free parameters, and the given values of the fixed ones, "
        }
        (true, false) => "For generic values of the free parameters, ",
        (false, true) => "For the given values of the parameters, ",
        (false, false) => {
            let mut letters = statement.chars();
            let first: String = letters.next().into_iter().flat_map(char::to_uppercase).collect();
            return format!("{first}{}", letters.as_str());
        }
    };
    format!("{hypotheses}{statement}")
}

#[cfg(test)]
mod tests {
    use liouville::case::Case;

    use super::*;

    #[test]
    fn only_parameters_that_are_there_are_named() {
        let says = |parameters: &str| {
            let text = format!(
                "title='x'\n[parameters]\n{parameters}\n[state]\nx='1..2'\n[field]\n\"x'\"='x'\n"
            );
            stated(&Case::parse(&text, &[]).expect("a case").model, "there is none.")
        };
        assert_eq!(says(""), "There is none.");
        assert_eq!(says("a=2"), "For the given values of the parameters, there is none.");
        assert_eq!(says("a='1..2'"), "For generic values of the free parameters, there is none.");
        let both = "For generic values of the free parameters, and the given values of the fixed ones, there \
                    is none.";
        assert_eq!(says("a='1..2'\nb=3"), both);
    }
}
