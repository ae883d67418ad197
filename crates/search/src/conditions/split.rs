//! A case whose tensors are written by their components: each becomes a scalar parameter.
//!
//! A diagonal J becomes `[[J1, 0, 0], [0, J2, 0], [0, 0, J3]]` with free scalars J1, J2, J3. The names
//! are those under which formulas read the components, so a formula means the same in both cases.

use liouville::case::Case;
use liouville::formula::{Formula, FormulaError, Type};
use liouville::mechanics::{
    Dependence, Draw, Meaning, Parameter, ParameterOrigin, SamplerSpec, Vocabulary,
};

use super::relation::ScalarParameter;

/// A case with its free numbers.
pub struct SplitCase {
    /// The case, with scalars in place of tensors.
    pub case: Case,
    /// Parameters drawn from ranges.
    pub scalars: Vec<ScalarParameter>,
    /// For each scalar the place of the tensor that it is a component of; `None` for scalars of the
    /// case.
    pub tensors: Vec<Option<usize>>,
    /// Names of parameters with a list of values.
    pub listed: Vec<String>,
    /// Names of scalars that do not vary, as the equations are no fractions in them.
    pub held: Vec<String>,
}

impl SplitCase {
    /// Writes the free tensors of a case by scalars.
    pub fn of(case: &Case) -> Self {
        let mut case = case.clone();
        let mut of_tensor: Vec<Option<usize>> = vec![None; case.model.parameters.len()];
        for index in 0..case.model.parameters.len() {
            divide(&mut case, index);
            of_tensor.resize(case.model.parameters.len(), Some(index));
        }
        let (mut scalars, mut listed) = (Vec::new(), Vec::new());
        let mut draw = 0;
        let mut tensors = Vec::new();
        for (Parameter { name, origin, .. }, tensor) in case.model.parameters.iter().zip(of_tensor)
        {
            let ParameterOrigin::Free(recipe) = origin else { continue };
            match recipe {
                SamplerSpec::Scalar(Draw::Within(_) | Draw::Of(..)) => {
                    scalars.push(ScalarParameter { name: name.clone(), draw });
                    tensors.push(tensor);
                }
                recipe => {
                    let is_list = |own: &Draw| match own {
                        Draw::OneOf(values) => values.len() > 1,
                        Draw::Sign => true,
                        Draw::Within(_) | Draw::Of(..) => false,
                    };
                    if recipe.draws().iter().any(is_list) {
                        listed.push(name.clone());
                    }
                }
            }
            draw += recipe.draws().len();
        }
        Self { case, scalars, tensors, listed, held: Vec::new() }
    }
}

impl SplitCase {
    /// Gives scalars, by their places, values as formulas of the others.
    pub fn with(&self, values: Vec<(usize, Formula)>) -> Option<Self> {
        let mut case = self.case.clone();
        for (place, value) in values {
            let name = &self.scalars[place].name;
            let own = case.model.parameters.iter_mut().find(|own| &own.name == name)?;
            own.origin = match value.constant() {
                Some(number) => ParameterOrigin::Fixed(vec![number]),
                None => ParameterOrigin::Formula(value),
            };
        }
        Some(Self::of(&case).holding(self.held.clone()))
    }

    /// The scalars as formulas.
    pub fn letters(&self) -> Result<Vec<Formula>, FormulaError> {
        let vocabulary = &self.case.model.vocabulary;
        self.scalars.iter().map(|own| Formula::name(&own.name, vocabulary)).collect()
    }

    /// The same case with some scalars at random values.
    pub fn holding(mut self, held: Vec<String>) -> Self {
        let kept: Vec<bool> = self.scalars.iter().map(|own| !held.contains(&own.name)).collect();
        let mut places = kept.iter();
        self.scalars.retain(|_| places.next() == Some(&true));
        let mut places = kept.iter();
        self.tensors.retain(|_| places.next() == Some(&true));
        Self { held, ..self }
    }

    /// Says for which values of other parameters a statement is made; empty if there are none.
    pub fn reservation(&self) -> String {
        let mut text = String::new();
        if !self.listed.is_empty() {
            text.push_str(&format!("; with the first value of {}", self.listed.join(", ")));
        }
        if !self.held.is_empty() {
            text.push_str(&format!("; with random values of {}", self.held.join(", ")));
        }
        text
    }
}

/// Writes one parameter by scalars, if it is a tensor that is linear in its draws.
fn divide(case: &mut Case, index: usize) {
    let model = &case.model;
    let parameter = &model.parameters[index];
    let (kind, name) = (parameter.kind, parameter.name.clone());
    let ParameterOrigin::Free(recipe) = &parameter.origin else { return };
    let Some((entries, draws)) = entries(recipe) else { return };
    let place_of = |number: usize| entries.iter().position(|own| *own == Entry::Plus(number));
    let mut names: Vec<String> = Vec::new();
    for number in 0..draws.len() {
        let Some(place) = place_of(number) else { return };
        let is_diagonal = is_diagonal(kind, &entries);
        let Some(own) = component_name((&name, kind), place, is_diagonal, &model.vocabulary) else {
            return;
        };
        names.push(own);
    }
    let mut divided = case.clone();
    let model = &mut divided.model;
    let mut own = Vec::new();
    for (name, draw) in names.iter().zip(draws) {
        let meaning = Meaning::Parameter(model.parameters.len());
        model.vocabulary.add(name, meaning, Type::Scalar, Dependence::Parameters);
        own.extend(model.vocabulary.formula_of(meaning));
        let origin = ParameterOrigin::Free(SamplerSpec::Scalar(draw));
        model.parameters.push(Parameter { name: name.clone(), kind: Type::Scalar, origin });
    }
    let parts = entries.iter().map(|entry| match entry {
        Entry::Zero => Formula::number(0),
        Entry::Plus(number) => own[*number].clone(),
        Entry::Minus(number) => -&own[*number],
    });
    if let Ok(whole) = kind.filled(&parts.collect::<Vec<_>>()) {
        model.parameters[index].origin = ParameterOrigin::Formula(whole);
        *case = divided;
    }
}

/// An entry of a tensor in terms of its independent components.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Entry {
    Zero,
    /// The independent component with this number.
    Plus(usize),
    /// Its negative.
    Minus(usize),
}

/// Finds the independent components of a tensor, and the draw of each; `None` for scalars, for
/// tensors that are not linear in their draws, and for lists of values.
fn entries(recipe: &SamplerSpec) -> Option<(Vec<Entry>, Vec<Draw>)> {
    let draws = match recipe {
        SamplerSpec::Scalar(_) | SamplerSpec::Rotation | SamplerSpec::FullInertia(_) => {
            return None;
        }
        SamplerSpec::Inertia(range) => vec![Draw::Within(range.clone()); 3],
        SamplerSpec::AxisymmetricInertia(range) => vec![Draw::Within(range.clone()); 2],
        _ => recipe.draws(),
    };
    if !draws.iter().all(|own| matches!(own, Draw::Within(_) | Draw::Of(..))) {
        return None;
    }
    // Entries that are equal for these numbers are equal, as their sums of two are distinct.
    let numbers: Vec<f64> = (0..recipe.draws().len()).map(|k| ((k * k + 1) << k) as f64).collect();
    if numbers.len() > MOST_DRAWS {
        return None;
    }
    let mut independent: Vec<f64> = Vec::new();
    let mut entries = Vec::new();
    for value in recipe.make(&numbers).components() {
        let place = |value: f64| independent.iter().position(|own| *own == value);
        entries.push(match (value == 0.0, place(value), place(-value)) {
            (true, ..) => Entry::Zero,
            (false, Some(number), _) => Entry::Plus(number),
            (false, None, Some(number)) => Entry::Minus(number),
            (false, None, None) => {
                independent.push(value);
                Entry::Plus(independent.len() - 1)
            }
        });
    }
    (independent.len() == draws.len()).then_some((entries, draws))
}

/// Largest number of draws of a tensor.
const MOST_DRAWS: usize = 25;

/// Whether all entries off the diagonal are 0.
fn is_diagonal(kind: Type, entries: &[Entry]) -> bool {
    let Type::Matrix(_, columns) = kind else { return false };
    let is_off = |place: usize| place % columns != place / columns;
    let mut others = entries.iter().enumerate().filter(|(place, _)| is_off(*place));
    others.all(|(_, own)| *own == Entry::Zero)
}

/// Finds a name for a component that formulas read as this component, if they read it at all.
fn component_name(
    (name, kind): (&str, Type),
    place: usize,
    is_diagonal: bool,
    vocabulary: &Vocabulary,
) -> Option<String> {
    let own = match kind {
        Type::Matrix(_, columns) => match (place / columns + 1, place % columns + 1) {
            (row, _) if is_diagonal => format!("{name}{row}"),
            (row, column) => format!("{name}{row}{column}"),
        },
        _ => format!("{name}{}", place + 1),
    };
    vocabulary.find(&own).is_none().then_some(own)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tensors_are_divided_into_components() {
        let text = "title = 'x'\n[parameters]\nJ = 'inertia(0.5..5)'\nc = 'vector(-1..1)'\n\
                    S = 'skew(-1..1)'\nQ = 'rotation'\na = 'one of 1, 2'\nb = '1..2'\n[state]\n\
                    M = 'vector(-1..1)'\n[field]\n\"M'\" = 'M × (J*M) + S*c + a*b*Q*c'\n";
        let case = Case::parse(text, &[]).expect("a case");
        let split = SplitCase::of(&case);
        let names: Vec<&str> = split.scalars.iter().map(|own| own.name.as_str()).collect();
        assert_eq!(names, ["b", "J1", "J2", "J3", "c1", "c2", "c3", "S12", "S13", "S23"]);
        assert_eq!(split.listed, ["a"]);
        let tensors = &split.tensors;
        assert_eq!(tensors[0], None);
        assert!(tensors[1] == tensors[3] && tensors[1] != tensors[4] && tensors[1].is_some());
        let written = |name: &str| {
            let parameters = &split.case.model.parameters;
            let own = parameters.iter().find(|own| own.name == name).expect("a parameter");
            match &own.origin {
                ParameterOrigin::Formula(formula) => formula.text().to_string(),
                _ => String::new(),
            }
        };
        assert_eq!(written("J"), "[[J1, 0, 0], [0, J2, 0], [0, 0, J3]]");
        assert_eq!(written("S"), "[[0, S12, S13], [−S12, 0, S23], [−S13, −S23, 0]]");
        assert_eq!(written("c"), "[c1, c2, c3]");
        assert_eq!(written("Q"), "", "a rotation stays whole");
    }
}
