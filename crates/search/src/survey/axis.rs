//! Candidates for axes of revolution of a body or a surface.

use liouville::case::Case;
use liouville::formula::Type;
use liouville::mechanics::System;

/// A candidate for an axis of revolution of the body and its inertia tensor.
#[derive(Clone, Debug)]
pub struct RevolutionAxis {
    /// Name of the axis.
    pub name: String,
    /// Unit vector along the axis.
    pub vector: String,
    /// Index among the axes of the frame, if it is one of these.
    pub index: Option<usize>,
    /// Name of the state's second vector: γ, or r of a surface given as a level.
    second: &'static str,
}

/// Lists the candidates: the axes of the frame, and those along the vectors of the case.
pub fn tried(case: &Case) -> Vec<RevolutionAxis> {
    let second = match &case.model.system {
        System::Rubber(_) | System::Spinning(_) => "γ",
        System::Ball(ball) if ball.surface.is_level() => "r",
        System::Ball(_) => "γ",
        _ => return Vec::new(),
    };
    let frame = ["[1, 0, 0]", "[0, 1, 0]", "[0, 0, 1]"];
    let mut axes: Vec<RevolutionAxis> = frame
        .into_iter()
        .enumerate()
        .map(|(k, vector)| RevolutionAxis {
            name: format!("e{}", k + 1),
            vector: vector.to_string(),
            index: Some(k),
            second,
        })
        .collect();
    let vectors = case.model.parameters.iter().filter(|one| one.kind == Type::VECTOR);
    axes.extend(vectors.map(|one| RevolutionAxis {
        name: one.name.clone(),
        vector: format!("({0}/|{0}|)", one.name),
        index: None,
        second,
    }));
    axes
}

impl RevolutionAxis {
    /// Returns the replacements for the placeholders of a family.
    pub fn words(&self) -> Vec<(&'static str, String)> {
        let a = &self.vector;
        let component = |name: &str| match self.index {
            Some(k) => format!("{name}{}", k + 1),
            None => format!("({name},{a})"),
        };
        let (across, along) = match self.index {
            Some(k) => (format!("I{}", (k + 1) % 3 + 1), format!("I{}", k + 1)),
            None => (format!("(trace(I) − ({a},I*{a}))/2"), format!("({a},I*{a})")),
        };
        vec![
            ("@name", self.name.clone()),
            ("@I1", across),
            ("@I3", along),
            ("@a", a.clone()),
            ("@x", self.second.to_string()),
            ("@ω", component("ω")),
            ("@γ", component("γ")),
            ("@S", component("S")),
            ("@M", component("M")),
            ("@r", component("r")),
        ]
    }
}
