//! The table `[state]`: variables with the ranges that their values are drawn from.

use std::borrow::Cow;

use toml::Spanned;
use toml::de::DeValue;

use super::error::{Mistake, Problem};
use super::parameters::named;
use super::section::CaseTable;
use super::shapes::{GivenValue, Refusal, given, state_draws};
use crate::formula::Type;
use crate::mechanics::{
    Dependence, Draw, MatrixShape, Meaning, NumberLine, Range, SamplerSpec, TIME, Variable,
    Vocabulary,
};

/// State variables with the draws of their components.
#[derive(Clone, Debug)]
pub struct State {
    /// Variables in order.
    pub variables: Vec<Variable>,
    /// Draw of each component.
    pub draws: Vec<Draw>,
    /// Names of the matrices that are rotations, on a level; `None` where none may be.
    pub rotations: Option<Vec<String>>,
}

/// Reads a table of names and ranges; `reach` is the dependence that the names stand for. `rotations` is there where the
/// equations of rotation matrices can be added to the level.
pub fn state(
    section: &CaseTable<'_>,
    vocabulary: &mut Vocabulary,
    reach: Dependence,
    rotations: Option<Vec<String>>,
) -> State {
    let mut state = State { variables: Vec::new(), draws: Vec::new(), rotations };
    add_state(section, vocabulary, reach, &mut state);
    state
}

/// Reads further state variables.
pub fn add_state(
    section: &CaseTable<'_>,
    vocabulary: &mut Vocabulary,
    reach: Dependence,
    state: &mut State,
) {
    for (key, value) in section.entries() {
        let Some(name) = section.keep(named(key)) else { continue };
        if let Some(own) = &mut state.rotations
            && vocabulary.find(&name).is_none()
            && value.get_ref().as_str().is_some_and(|text| text.trim() == "rotation")
        {
            own.push(name.clone());
            let draw = Draw::Within(Range::between((-1, 1), (1, 1)));
            state.add(&name, Type::MATRIX, vec![draw; 9], vocabulary, reach);
            continue;
        }
        match variable(section, &name, (key, value), vocabulary) {
            Ok((kind, draws, None)) => state.add(&name, kind, draws, vocabulary, reach),
            Ok((kind, draws, Some(shape))) => {
                let vector = vector_of(&name);
                if vocabulary.find(&vector).is_some() {
                    let reason = format!("it is the vector that `{name}` is made of");
                    let problem = Problem::BadName { name: vector, reason };
                    section.mistakes().add(Mistake::at(key.span(), problem));
                    continue;
                }
                state.add(&vector, kind, draws, vocabulary, reach);
                if let Some(own) = state.variables.last_mut() {
                    own.shape = Some(shape);
                }
            }
            Err(mistake) => {
                section.mistakes().add(mistake);
                if vocabulary.find(&name).is_none() {
                    section.mistakes().fail(&name);
                }
            }
        }
    }
}

/// Name of the vector of the entries of a matrix: `M_` for M, `M_'` for M'.
fn vector_of(name: &str) -> String {
    let end = name.trim_end_matches('\'').len();
    format!("{}_{}", &name[..end], &name[end..])
}

impl State {
    /// Adds a variable, and its name.
    pub fn add(
        &mut self,
        name: &str,
        kind: Type,
        draws: Vec<Draw>,
        vocabulary: &mut Vocabulary,
        reach: Dependence,
    ) {
        vocabulary.add(name, Meaning::State(self.variables.len()), kind, reach);
        self.variables.push(Variable { name: name.to_string(), kind, shape: None });
        self.draws.extend(draws);
    }

    /// Adds time, which is drawn between -2 and 2, and may be any.
    pub fn add_time(&mut self, vocabulary: &mut Vocabulary, reach: Dependence) {
        let draw = Draw::Of(NumberLine::All, Range::between((-2, 1), (2, 1)));
        self.add(TIME, Type::Scalar, vec![draw], vocabulary, reach);
    }
}

type Entry<'a> = (&'a Spanned<Cow<'a, str>>, &'a Spanned<DeValue<'a>>);

/// Advice for a range that is written as an interval, `[-1, 1]`.
fn range_meant(text: &str) -> Option<String> {
    let is_bracket = |letter: char| matches!(letter, '[' | ']' | '(' | ')');
    let inner = text.trim().strip_prefix(is_bracket)?.strip_suffix(is_bracket)?;
    let (low, high) = inner.split_once([',', ';'])?;
    let is_number = |own: &str| own.trim().replace('−', "-").parse::<f64>().is_ok();
    let is_range = is_number(low) && is_number(high);
    is_range.then(|| format!("write \"{}..{}\"", low.trim(), high.trim()))
}

/// Type of a state variable, the draws of its components, and the shape of the matrix made of them.
fn variable(
    section: &CaseTable<'_>,
    name: &str,
    key: Entry<'_>,
    vocabulary: &Vocabulary,
) -> Result<(Type, Vec<Draw>, Option<MatrixShape>), Mistake> {
    let (key, value) = key;
    if vocabulary.find(name).is_some() {
        let (name, reason) = (name.to_string(), "it is taken already".to_string());
        return Err(Mistake::at(key.span(), Problem::BadName { name, reason }));
    }
    let remedy = "write \"-2..2\", \"vector(-1..1)\", \"vector(5, -1..1)\", \"matrix(4, 4, -1..1)\" or \
         \"skew(4, -1..1)\"";
    let remedy = match value.get_ref() {
        DeValue::String(text) => range_meant(text).unwrap_or_else(|| remedy.to_string()),
        _ => remedy.to_string(),
    };
    let wrong = |message: String| {
        Mistake::at(value.span(), Problem::Other { message, remedy: remedy.clone() })
    };
    let given = given(value, vocabulary).map_err(|refusal| match refusal {
        Refusal::Message(message) => wrong(message),
        Refusal::Form(message, remedy) => {
            Mistake::at(value.span(), Problem::Other { message, remedy })
        }
        Refusal::OneValue(only) => {
            let message = Refusal::empty_range(&only, &only);
            let remedy = format!("write a wider range, or declare `{name}` in [parameters]");
            Mistake::at(value.span(), Problem::Other { message, remedy })
        }
        Refusal::Size(error, start) => {
            let inner = start + error.span().start..start + error.span().end;
            let text = section.as_text(name, value);
            let place = text.map_or(value.span(), |text| text.locate(inner));
            Mistake::at(place, Problem::Formula(error))
        }
    })?;
    if let GivenValue::Drawn(recipe) = &given
        && recipe.draws().iter().any(|draw| matches!(draw, Draw::OneOf(_)))
    {
        let message = format!(
            "`{name}` has a list of values, and a state counts with the states around it: lists are for [parameters]"
        );
        return Err(wrong(message));
    }
    let (rows, is_skew) = match &given {
        GivenValue::Drawn(SamplerSpec::Skew(rows, _)) => (*rows, true),
        GivenValue::Drawn(SamplerSpec::Symmetric(rows, _)) => (*rows, false),
        _ => (0, false),
    };
    if let (GivenValue::Drawn(recipe), true) = (&given, rows > 0) {
        let draws = recipe.draws();
        return match draws.len() {
            0 => Err(wrong(format!("`{name}` has no entry that is not 0"))),
            count => {
                let shape = MatrixShape { name: name.to_string(), rows, is_skew };
                Ok((Type::Vector(count), draws, Some(shape)))
            }
        };
    }
    state_draws(&given).map(|(kind, draws)| (kind, draws, None)).ok_or_else(|| match given {
        GivenValue::Drawn(_) => wrong(format!(
            "`{name}` has components that depend on each other: states are drawn component by component"
        )),
        _ => wrong(format!("`{name}` needs a range from which its states are drawn")),
    })
}
