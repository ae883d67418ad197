//! Functions as lines of code: values that are used more than once, or have a name, get a line;
//! the others are written where they are used.

use liouville::graph::{Expr, Graph, Step};
use liouville::number::rational::Rational;
use liouville::number::{BinaryOperation, UnaryFunction as Unary};
use liouville::program::{FunctionSubject, NamedFunction};

use super::ExportedCase;
use super::names::ExportNames;
use super::tangents;
use super::target::{Target, TargetTerm};

/// A function as lines of code.
pub struct CodeLines {
    /// Subject of the function.
    pub part: FunctionSubject,
    /// Name of the function.
    pub name: String,
    /// Inputs that it uses, by their place among the components.
    pub inputs: Vec<usize>,
    /// Intermediate values with their names, in order.
    pub lines: Vec<(String, String)>,
    /// Values of the function.
    pub outputs: Vec<String>,
    /// Operations without which it has no value, in exact languages: others add 0 times these.
    pub required: Vec<String>,
}

/// Writes a function of the program.
pub fn body(
    target: &dyn Target,
    export: &ExportedCase<'_>,
    names: &mut ExportNames,
    function: &NamedFunction,
) -> CodeLines {
    let graph = &export.program.graph;
    let name = names.function(target, export, function.part);
    let needed = function.outputs.iter().chain(&function.required).copied();
    let has_tangent = target.tangent(&TargetTerm::atom("")).is_some();
    let reached = tangents::reached(graph, needed.clone(), has_tangent);
    let mut uses = vec![0usize; graph.len()];
    for place in (0..graph.len()).filter(|place| reached[*place]) {
        for part in tangents::parts(graph, place, has_tangent) {
            uses[part] += 1;
        }
    }
    for value in needed {
        uses[graph.place(value)] += 1;
    }
    let (terms, has_line) = (vec![None; graph.len()], vec![false; graph.len()]);
    let mut writer = LineWriter { target, graph, terms, has_line, uses };
    let (mut inputs, mut lines, mut count) = (Vec::new(), Vec::new(), 0);
    for place in (0..graph.len()).filter(|place| reached[*place]) {
        let mut term = match graph.step(place) {
            Step::Input(input) => {
                inputs.push(input);
                TargetTerm::atom(&names.inputs[input])
            }
            step => match tangents::tangent(graph, place).filter(|_| has_tangent) {
                Some(u) => writer.tangent(u),
                None => writer.term(step),
            },
        };
        let is_computed = graph.step(place).arguments().next().is_some();
        let own = names.of_step(place);
        let is_shared = writer.uses[place] > 1 || term.weight > target.width();
        if is_computed && (own.is_some() || is_shared) {
            let name = own.cloned().unwrap_or_else(|| names.temporary(target, &mut count));
            lines.push((name.clone(), term.text));
            term = TargetTerm::atom(name);
            writer.has_line[place] = true;
        }
        writer.terms[place] = Some(term);
    }
    inputs.sort_unstable();
    let term = |value: &Expr| writer.at(graph.place(*value));
    let mut outputs: Vec<TargetTerm> = function.outputs.iter().map(term).collect();
    let required: Vec<TargetTerm> = function.required.iter().map(term).collect();
    if !target.is_exact() {
        // 0 times NaN is NaN: the sum of these is 0, or it is not a number.
        let zero = target.number(&Rational::from(0));
        let mut guard: Option<TargetTerm> = None;
        for own in &required {
            let own = target.product(&zero, own);
            let sum = guard.map_or(own.clone(), |before| target.sum(&before, "+", &own));
            let name = names.temporary(target, &mut count);
            lines.push((name.clone(), sum.text));
            guard = Some(TargetTerm::atom(name));
        }
        if let Some(guard) = guard {
            outputs.iter_mut().for_each(|own| *own = target.sum(own, "+", &guard));
        }
    }
    let texts = |terms: Vec<TargetTerm>| terms.into_iter().map(|own| own.text).collect();
    let required = if target.is_exact() { texts(required) } else { Vec::new() };
    CodeLines { part: function.part, name, inputs, lines, outputs: texts(outputs), required }
}

/// The terms written so far.
struct LineWriter<'w> {
    target: &'w dyn Target,
    graph: &'w Graph,
    terms: Vec<Option<TargetTerm>>,
    /// Whether a value has a line, and is a name in the lines after it.
    has_line: Vec<bool>,
    uses: Vec<usize>,
}

impl LineWriter<'_> {
    fn term(&self, step: Step<'_>) -> TargetTerm {
        let target = self.target;
        let weight: usize = step.arguments().map(|place| self.at(place).weight).sum();
        let mut term = match step {
            Step::Constant(value) => target.number(value),
            Step::Input(_) => return TargetTerm::atom(""),
            Step::Unary(Unary::Neg, a) => target.negative(&self.at(a)),
            Step::Unary(Unary::Recip, a) => target.reciprocal(&self.at(a)),
            Step::Unary(function, a) => target.call(function, &self.at(a)),
            Step::Power(a, exponent) => target.power(&self.at(a), exponent),
            Step::Binary(BinaryOperation::Add, a, b) => target.sum(&self.at(a), "+", &self.at(b)),
            Step::Binary(BinaryOperation::Sub, a, b) => target.sum(&self.at(a), "-", &self.at(b)),
            Step::Binary(BinaryOperation::Pow, a, b) => target.power_of(&self.at(a), &self.at(b)),
            Step::Binary(BinaryOperation::Mul, a, b) => self
                .quotient(a, b)
                .or_else(|| self.quotient(b, a))
                .unwrap_or_else(|| target.product(&self.at(a), &self.at(b))),
        };
        term.weight = weight.max(1);
        term
    }

    /// tanh u
    fn tangent(&self, u: usize) -> TargetTerm {
        let argument = self.at(u);
        let weight = argument.weight.max(1);
        let term = self.target.tangent(&argument).unwrap_or(argument);
        TargetTerm { weight, ..term }
    }

    /// a/c where b is 1/c and written nowhere else.
    fn quotient(&self, a: usize, b: usize) -> Option<TargetTerm> {
        match self.graph.step(b) {
            Step::Unary(Unary::Recip, c) if self.uses[b] == 1 && !self.has_line[b] => {
                self.target.quotient(&self.at(a), &self.at(c))
            }
            _ => None,
        }
    }

    fn at(&self, place: usize) -> TargetTerm {
        self.terms[place].clone().unwrap_or_else(|| TargetTerm::atom(""))
    }
}
