//! Names of a program in a language: spelled as it allows, and different from each other.

use std::collections::{BTreeMap, BTreeSet};

use liouville::program::FunctionSubject;

use super::ExportedCase;
use super::target::Target;

/// Longest part of a claim's name in the name of a function.
const LONGEST: usize = 40;

/// Names of inputs, of intermediate values and of functions.
pub struct ExportNames {
    /// Names of the input components, in the order of the graph.
    pub inputs: Vec<String>,
    /// Names of steps that are values with a name in the case, by place.
    steps: BTreeMap<usize, String>,
    taken: BTreeSet<String>,
}

impl ExportNames {
    /// Spells the names of all inputs and of all named values.
    pub fn new(target: &dyn Target, export: &ExportedCase<'_>) -> Self {
        let taken = target.reserved().iter().map(|word| word.to_string()).collect();
        let mut names = Self { inputs: Vec::new(), steps: BTreeMap::new(), taken };
        for (name, _) in export.program.components() {
            let own = names.fresh(target, target.name(&name));
            names.inputs.push(own);
        }
        let graph = &export.program.graph;
        for named in &export.program.named {
            for (place, value) in named.values.iter().enumerate() {
                let step = graph.step(graph.place(*value));
                let is_computed = step.arguments().next().is_some();
                if is_computed && !names.steps.contains_key(&graph.place(*value)) {
                    let name = target.name(&named.kind.component(&named.name, place));
                    let own = names.fresh(target, name);
                    names.steps.insert(graph.place(*value), own);
                }
            }
        }
        names
    }

    /// Name of a step that the case names.
    pub fn of_step(&self, place: usize) -> Option<&String> {
        self.steps.get(&place)
    }

    /// Name of the nth intermediate value, or of a later one if that is taken.
    pub fn temporary(&self, target: &dyn Target, count: &mut usize) -> String {
        loop {
            *count += 1;
            let name = target.temporary(*count);
            if !self.taken.contains(&name) {
                return name;
            }
        }
    }

    /// Name of a function.
    pub fn function(
        &mut self,
        target: &dyn Target,
        export: &ExportedCase<'_>,
        part: FunctionSubject,
    ) -> String {
        let of_claim = |word: &str, index: usize| {
            let words = words(&export.case.claims[index].name);
            let mut all = vec![word];
            all.extend(words.iter().map(String::as_str));
            target.function_name(&all)
        };
        let name = match part {
            FunctionSubject::Field if export.case.model.system.is_map() => {
                target.function_name(&["image"])
            }
            FunctionSubject::Field => target.function_name(&["field"]),
            FunctionSubject::Level => target.function_name(&["level"]),
            FunctionSubject::Value(index) => of_claim("value", index),
            FunctionSubject::Residual(index) => of_claim("residual", index),
        };
        self.fresh(target, name)
    }

    fn fresh(&mut self, target: &dyn Target, name: String) -> String {
        let mut own = name.clone();
        let mut count = 1;
        while self.taken.contains(&own) {
            count += 1;
            own = target.another(&name, count);
        }
        self.taken.insert(own.clone());
        own
    }
}

/// Words of a text in ASCII, at most so many letters that a name stays readable.
pub fn words(text: &str) -> Vec<String> {
    let spelled: String = text
        .chars()
        .map(|c| match c {
            c if c.is_ascii_alphanumeric() => c.to_string(),
            'Α'..='ω' | 'Ĩ' | '𝒥' => liouville::formula::ascii_name(&c.to_string()),
            '\'' | '′' => "_prime_".to_string(),
            _ => "_".to_string(),
        })
        .collect();
    let mut length = 0;
    let all = spelled.split('_').filter(|word| !word.is_empty());
    let short = all.take_while(|word| {
        length += word.len() + 1;
        length <= LONGEST
    });
    short.map(str::to_string).collect()
}
