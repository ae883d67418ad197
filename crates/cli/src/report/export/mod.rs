//! Straight-line code of a case in other languages, each in one file behind a common trait.

mod c;
mod julia;
mod latex;
mod lines;
mod maple;
mod mathematica;
mod matlab;
mod names;
mod python;
mod rust;
mod tangents;
mod target;

use clap::ValueEnum;
use liouville::case::Case;
use liouville::formula::Type;
use liouville::graph::Step;
use liouville::mechanics::ParameterOrigin;
use liouville::program::{FunctionSubject, InputRole, Program};

use lines::CodeLines;
use names::ExportNames;
use target::Target;

/// Words before an operation of a formula that simplified values do without.
const REQUIRED: &str = "No value where this has none";

/// A language of the exported code.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Language {
    /// Python with `math`, in doubles
    Python,
    /// Python with SymPy, exact
    Sympy,
    /// Julia, in doubles
    Julia,
    /// MATLAB or Octave, in doubles
    Matlab,
    /// Mathematica, exact
    Mathematica,
    /// Maple, exact
    Maple,
    /// C99, in doubles
    C,
    /// Rust, in doubles
    Rust,
    /// LaTeX, a document
    Latex,
}

/// A case ready to be written in another language.
pub struct ExportedCase<'e> {
    /// The case.
    pub case: &'e Case,
    /// Its program.
    pub program: &'e Program,
    /// Name of the module, where the language wants one.
    pub module: &'e str,
    /// Origin of the case: path, digest, values given to parameters.
    pub origin: &'e [String],
}

/// Writes the program of a case in a language; fails if a constant is beyond the range of doubles
/// in a language that has no other numbers.
pub fn render(export: &ExportedCase<'_>, language: Language) -> Result<String, String> {
    let target: &dyn Target = match language {
        Language::Python => &python::Python { is_symbolic: false },
        Language::Sympy => &python::Python { is_symbolic: true },
        Language::Julia => &julia::Julia,
        Language::Matlab => &matlab::Matlab,
        Language::Mathematica => &mathematica::Mathematica,
        Language::Maple => &maple::Maple,
        Language::C => &c::C,
        Language::Rust => &rust::Rust,
        Language::Latex => &latex::Latex,
    };
    let graph = &export.program.graph;
    let outputs = export.program.functions.iter().flat_map(|own| own.outputs.iter().copied());
    let reached = graph.reached(outputs);
    let is_beyond = |(place, step): (usize, Step<'_>)| match step {
        Step::Constant(value) if reached[place] => !value.to_f64().0.is_finite(),
        _ => false,
    };
    if !target.is_exact() && graph.steps().enumerate().any(is_beyond) {
        return Err("a number of the case is beyond the range of doubles".to_string());
    }
    let mut names = ExportNames::new(target, export);
    let bodies: Vec<CodeLines> = export
        .program
        .functions
        .iter()
        .map(|own| lines::body(target, export, &mut names, own))
        .collect();
    Ok(target.file(export, &names, &bodies))
}

impl ExportedCase<'_> {
    /// Lines that describe the case and its origin, for the head of a file.
    fn heading(&self) -> Vec<String> {
        let case = self.case;
        let mut lines = vec![case.title.clone()];
        if !case.source.is_empty() {
            lines.push(format!("Source: {}.", case.source));
        }
        lines.push(format!("System: {}.", case.system));
        let is_body = ["rubber-plane", "rubber-sphere", "rolling-plane", "rolling-sphere"];
        if is_body.contains(&case.system.as_str()) {
            lines.push("Vectors are in the body's axes.".to_string());
        }
        lines.push("Any consistent units.".to_string());
        lines.extend(self.origin.iter().cloned());
        for parameter in &case.model.parameters {
            let values = match &parameter.origin {
                ParameterOrigin::Fixed(values) => {
                    values.iter().map(|x| x.to_string()).collect::<Vec<_>>()
                }
                ParameterOrigin::Formula(formula) => vec![formula.text().to_string()],
                ParameterOrigin::Free(_) => continue,
            };
            lines.push(format!("Built in: {} = {}.", parameter.name, values.join(", ")));
        }
        lines.extend(self.matrices());
        lines.iter().map(|line| one_line(line)).collect()
    }

    /// Lines that describe a function, and what it has no value without.
    fn described(&self, body: &CodeLines) -> Vec<String> {
        let mut lines = self.subject(body.part);
        lines.extend(body.required.iter().map(|own| format!("{REQUIRED}: {}.", one_line(own))));
        lines
    }

    /// Lines that describe a function.
    fn subject(&self, part: FunctionSubject) -> Vec<String> {
        let claims = &self.case.claims;
        let lines = match part {
            FunctionSubject::Field if self.case.model.system.is_map() => {
                vec!["Image of the state under the map, component by component.".to_string()]
            }
            FunctionSubject::Field => {
                vec!["Time derivatives of the state, component by component.".to_string()]
            }
            FunctionSubject::Level => {
                let model = &self.case.model;
                let equations = model.level.iter().map(|own| own.text.clone());
                let equations = equations.collect::<Vec<_>>().join("; ");
                let halves = model.orientations.iter().map(|own| &own.equation.text);
                let halves = halves.map(|own| format!("The level is the half with {own}."));
                let sides = format!("Left minus right sides of the level equations: {equations}.");
                std::iter::once(sides).chain(halves).collect()
            }
            FunctionSubject::Value(index) => {
                let claim = &claims[index];
                let formula = claim.kind.formula().map_or("", |formula| formula.text());
                vec![format!("Value of claim `{}`: {formula}.", claim.name)]
            }
            FunctionSubject::Residual(index) => {
                let claim = &claims[index];
                let text = claim.kind.text().map_or(String::new(), |text| format!(" {text}"));
                let place = claim.place.name(&self.case.model);
                let meaning = match claim.kind.is_negated() {
                    false => "all are 0 where the claim holds",
                    true => "the claim is that they are not all 0 everywhere",
                };
                vec![
                    format!("Residual of claim `{}`, {}:{text}.", claim.name, claim.kind.name()),
                    format!("Claimed: {place}; {meaning}."),
                ]
            }
        };
        lines.iter().map(|line| one_line(line)).collect()
    }

    /// Components of the inputs of a role: place among the inputs of the program, and name.
    fn inputs(&self, is_state: bool) -> Vec<(usize, String)> {
        let all = self.program.components().into_iter().enumerate();
        let own = all.filter(|(_, (_, role))| (*role == InputRole::State) == is_state);
        own.map(|(place, (name, _))| (place, name)).collect()
    }

    /// Input components that a function uses: place in its list, and among all components.
    fn used(&self, body: &CodeLines, is_state: bool) -> Vec<(usize, usize)> {
        let own = self.inputs(is_state).into_iter().enumerate();
        let own = own.map(|(index, (place, _))| (index, place));
        own.filter(|(_, place)| body.inputs.contains(place)).collect()
    }

    /// Lines that take the input components a function uses from its two lists: parameters, then
    /// the state; `line` writes one from the name of the list, the place in it and the own name.
    fn taken(
        &self,
        body: &CodeLines,
        names: &ExportNames,
        line: impl Fn(&str, usize, &str) -> String,
    ) -> String {
        let of_list = |(list, is_state)| {
            let used = self.used(body, is_state).into_iter();
            used.map(move |(index, place)| (list, index, place))
        };
        let all = [("parameters", false), ("state", true)].into_iter().flat_map(of_list);
        all.map(|(list, index, place)| line(list, index, &names.inputs[place])).collect()
    }

    /// Names of the input components and the intermediate values of a function.
    fn locals<'n>(&self, body: &'n CodeLines, names: &'n ExportNames) -> Vec<&'n str> {
        let used = self.used(body, false).into_iter().chain(self.used(body, true));
        let used = used.map(|(_, place)| names.inputs[place].as_str());
        used.chain(body.lines.iter().map(|(name, _)| name.as_str())).collect()
    }

    /// Lines on the order of the inputs: place in the list, name in the code, name in the case.
    fn listed(&self, names: &ExportNames, first: usize) -> Vec<String> {
        let mut lines = Vec::new();
        for (list, is_state) in [("state", true), ("parameters", false)] {
            for (index, (place, name)) in self.inputs(is_state).into_iter().enumerate() {
                let own = &names.inputs[place];
                let origin = if *own == name { String::new() } else { format!(" = {name}") };
                lines.push(format!("{list}[{}]: {own}{origin}", index + first));
            }
        }
        lines
    }

    /// Sentences on the order of the entries of matrices among the inputs.
    fn matrices(&self) -> Vec<String> {
        let inputs = self.program.inputs.iter();
        let matrices = inputs.filter(|input| matches!(input.kind, Type::Matrix(..)));
        matrices.map(|input| format!("The entries of {} follow row by row.", input.name)).collect()
    }
}

/// Text on one line, without characters that end comments or strings.
fn one_line(text: &str) -> String {
    let text: Vec<&str> = text.split_whitespace().collect();
    text.join(" ").replace("*/", "* /").replace("(*", "( *").replace("*)", "* )")
}
