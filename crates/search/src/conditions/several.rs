//! Equations between the parameters of a field under which it has more polynomial integrals.
//!
//! All conditions of codimension one are found ([`locus`](super::locus)), and those of higher
//! codimension that become such conditions where one or two simple equations hold: a parameter is 0, or
//! two components of a tensor are equal. Where a condition is linear in some parameter, this one is
//! eliminated, and the integrals are sought and proved.

use liouville::case::Case;
use liouville::mechanics::System;

use super::ParameterCondition;
use super::equations::ParametricEquations;
use super::hypersurface::Hypersurface;
use super::locus::{SpecialLocus, special};
use super::split::SplitCase;
use super::values::{self, integrals_with};
use crate::branches;
use crate::budget::STEPS;
use crate::{Effort, SearchError, SearchReport};

/// Largest number of simple equations that hold at once.
const SIMPLE: usize = 2;

/// Finds the conditions on the parameters of a field under which there are more polynomial integrals of
/// at most the degree of the search, and the integrals there.
pub fn conditions(
    case: &Case,
    effort: &Effort,
    report: &mut SearchReport,
    progress: &mut dyn FnMut(&str),
) -> Result<(), SearchError> {
    if !matches!(case.model.system, System::Field(_) | System::Hamiltonian(_)) {
        return Ok(());
    }
    let whole = SplitCase::of(case);
    if whole.scalars.is_empty() {
        return Ok(());
    }
    if !branches::are_true(case, effort)? {
        report.remark(
            "no values of the parameters with more integrals are sought: the formulas contain a \
             modulus, or a root that depends on others"
                .to_string(),
        );
        return Ok(());
    }
    if whole.scalars.len() == 1 {
        return values::conditions(&whole, effort, report, progress);
    }
    let mut search = ConditionSearch { effort, report, progress, told: Vec::new(), steps: 0.0 };
    let Some(first) = search.examined(&whole, &[], &[])? else {
        return values::conditions(&whole, effort, report, progress);
    };
    search.simple(&whole, &first)
}

/// A simple equation between scalars, by their names.
#[derive(Clone, Debug, PartialEq, Eq)]
enum SimpleEquation {
    /// x = 0.
    Zero(String),
    /// x = y, two components of a tensor.
    Equal(String, String),
}

impl SimpleEquation {
    fn text(&self) -> String {
        match self {
            SimpleEquation::Zero(x) => format!("{x} = 0"),
            SimpleEquation::Equal(x, y) => format!("{x} = {y}"),
        }
    }

    /// The same equation where another one holds; `None` if that one implies it.
    fn under(&self, other: &Self) -> Option<Self> {
        // The name that stands for a value, or `None` for 0.
        let value = |name: &String| match other {
            SimpleEquation::Zero(x) if x == name => None,
            SimpleEquation::Equal(x, y) if x == name => Some(y.clone()),
            _ => Some(name.clone()),
        };
        match self {
            SimpleEquation::Zero(x) => value(x).map(SimpleEquation::Zero),
            SimpleEquation::Equal(x, y) => match (value(x), value(y)) {
                (Some(x), Some(y)) if x != y => Some(SimpleEquation::Equal(x, y)),
                (Some(x), None) | (None, Some(x)) => Some(SimpleEquation::Zero(x)),
                _ => None,
            },
        }
    }

    /// The case where it holds.
    fn applied(&self, split: &SplitCase) -> Option<SplitCase> {
        match self {
            SimpleEquation::Zero(x) => split.with(x, "0"),
            SimpleEquation::Equal(x, y) => split.with(x, y),
        }
    }

    /// Restricts conditions of a case to it; `None` if one of them holds there everywhere.
    fn restricted(
        &self,
        split: &SplitCase,
        surfaces: &[Hypersurface],
    ) -> Option<Vec<Hypersurface>> {
        let place = |name: &String| split.scalars.iter().position(|own| &own.name == name);
        let (place, other) = match self {
            SimpleEquation::Zero(x) => (place(x)?, None),
            SimpleEquation::Equal(x, y) => (place(x)?, Some(place(y)?)),
        };
        surfaces.iter().map(|own| own.restricted(place, other)).collect()
    }
}

/// A search with what it has told.
struct ConditionSearch<'s> {
    effort: &'s Effort,
    report: &'s mut SearchReport,
    progress: &'s mut dyn FnMut(&str),
    /// Sets of equations.
    told: Vec<Vec<String>>,
    /// Number of steps for one line at the highest degree.
    steps: f64,
}

impl ConditionSearch<'_> {
    /// Finds the conditions of codimension one of a case where some simple equations hold, besides known
    /// ones; returns all that are new. `None` if the equations are not fractions of low degree.
    fn examined(
        &mut self,
        split: &SplitCase,
        simple: &[SimpleEquation],
        known: &[Hypersurface],
    ) -> Result<Option<Vec<Hypersurface>>, SearchError> {
        let draws: Vec<usize> = split.scalars.iter().map(|own| own.draw).collect();
        let names: Vec<&str> = split.scalars.iter().map(|own| own.name.as_str()).collect();
        let names = names.join(", ");
        let mut all = known.to_vec();
        let mut is_complete = true;
        let mut last = 0;
        for degree in 1..=self.effort.degree {
            (self.progress)(&format!(
                "conditions on {names} for more integrals of degree {degree}"
            ));
            let Some(equations) = ParametricEquations::new(&split.case, degree, self.effort)?
            else {
                break;
            };
            let Some(own) = special(&equations, &draws, &all)? else {
                if degree == 1 {
                    return Ok(None);
                }
                let reason = "the equations take longer than --seconds allows, or are not \
                              fractions of low degree";
                self.report.remark(format!(
                    "conditions on {names} for more integrals of degree {degree} are not sought: {reason}"
                ));
                break;
            };
            last = degree;
            let SpecialLocus { surfaces, unexplained, steps } = own;
            self.steps = self.steps.max(steps);
            is_complete &= surfaces.is_empty() && unexplained == 0;
            self.tell(split, simple, degree, &surfaces, unexplained)?;
            all.extend(surfaces);
        }
        if simple.is_empty() && last > 0 && is_complete {
            self.report.conditions.push(ParameterCondition {
                of: format!("more polynomial integrals of degree at most {last}, by {names}"),
                equations: Vec::new(),
                grounds: format!("{GROUNDS}; {}{}", rest(0), split.reservation()),
            });
        }
        Ok(Some(all))
    }

    /// Reports conditions, and searches for the integrals where they hold.
    fn tell(
        &mut self,
        split: &SplitCase,
        simple: &[SimpleEquation],
        degree: u32,
        surfaces: &[Hypersurface],
        unexplained: usize,
    ) -> Result<(), SearchError> {
        let mut equations = Vec::new();
        for own in surfaces {
            let mut parts: Vec<String> = simple.iter().map(SimpleEquation::text).collect();
            parts.push(own.equation(&split.scalars));
            let text = parts.join(" and ");
            parts.sort();
            if self.told.contains(&parts) {
                continue;
            }
            self.told.push(parts);
            let solved = own.solved(&split.scalars);
            let fixed =
                solved.and_then(|(place, value)| split.with(&split.scalars[place].name, &value));
            if let Some(fixed) = fixed {
                let with = ("condition", text.clone());
                integrals_with(&fixed.case, with, self.effort, self.report)?;
            }
            equations.push(text);
        }
        // What remains open where simple equations hold is told with them.
        if equations.is_empty() && unexplained == 0 {
            return Ok(());
        }
        let names: Vec<&str> = split.scalars.iter().map(|own| own.name.as_str()).collect();
        let place: Vec<String> = simple.iter().map(SimpleEquation::text).collect();
        let place = match place.is_empty() {
            true => String::new(),
            false => format!(" where {}", place.join(" and ")),
        };
        self.report.conditions.push(ParameterCondition {
            of: format!(
                "more polynomial integrals of degree at most {degree}, by {}{place}",
                names.join(", ")
            ),
            equations,
            grounds: format!("{GROUNDS}; {}{}", rest(unexplained), split.reservation()),
        });
        Ok(())
    }

    /// Finds conditions where one or two simple equations hold.
    fn simple(&mut self, whole: &SplitCase, first: &[Hypersurface]) -> Result<(), SearchError> {
        let all = simple_equations(whole);
        let mut single: Vec<Option<Vec<Hypersurface>>> = Vec::new();
        let mut sets: Vec<Vec<usize>> = (0..all.len()).map(|k| vec![k]).collect();
        let pairs = (0..all.len()).flat_map(|i| (i + 1..all.len()).map(move |j| vec![i, j]));
        sets.extend(pairs);
        let most = (self.effort.seconds * STEPS / self.steps.max(1.0)) as usize;
        let admitted = sets.len().min(most);
        for set in &sets[..admitted] {
            self.effort.halt.check()?;
            let outcome = self.slice(whole, first, &all, set, &single)?;
            if set.len() == 1 {
                single.push(outcome);
            }
        }
        let texts: Vec<String> = all.iter().map(SimpleEquation::text).collect();
        let scope = match (admitted == sets.len(), admitted >= all.len()) {
            (true, _) => format!("one or {SIMPLE}"),
            (false, true) => "one".to_string(),
            (false, false) => "some".to_string(),
        };
        self.report.remark(format!(
            "conditions of several equations are sought only where {scope} of these hold: {}",
            texts.join(", ")
        ));
        Ok(())
    }

    /// Examines the case where a set of simple equations holds; returns its conditions, or `None` if it
    /// has more integrals itself.
    fn slice(
        &mut self,
        whole: &SplitCase,
        first: &[Hypersurface],
        all: &[SimpleEquation],
        set: &[usize],
        single: &[Option<Vec<Hypersurface>>],
    ) -> Result<Option<Vec<Hypersurface>>, SearchError> {
        let own = &all[set[0]];
        let Some(known) = own.restricted(whole, first) else { return Ok(None) };
        let Some(split) = own.applied(whole) else { return Ok(None) };
        if split.scalars.is_empty() {
            return Ok(None);
        }
        let Some(second) = set.get(1).map(|place| &all[*place]) else {
            return self.examined(&split, std::slice::from_ref(own), &known);
        };
        let Some(second) = second.under(own) else { return Ok(None) };
        // Conditions found where each of the two holds.
        let Some(Some(here)) = single.get(set[0]) else { return Ok(None) };
        let Some(known) = second.restricted(&split, here) else { return Ok(None) };
        if single.get(set[1]).is_none_or(Option::is_none) {
            return Ok(None);
        }
        let Some(split) = second.applied(&split) else { return Ok(None) };
        if split.scalars.is_empty() {
            return Ok(None);
        }
        self.examined(&split, &[own.clone(), second], &known)
    }
}

const GROUNDS: &str =
    "minors of the equations for the coefficients, on lines and planes of parameters";

/// Says how many conditions there may be besides those told.
fn rest(unexplained: usize) -> String {
    match unexplained {
        0 => "modulo a prime of 61 bits no other equation gives more".to_string(),
        n => format!(
            "further equations of degree {n} together, without short coefficients or too long to write, may give more"
        ),
    }
}

/// Lists the simple equations of a case: zero scalars, and equal components of a tensor.
fn simple_equations(whole: &SplitCase) -> Vec<SimpleEquation> {
    let names: Vec<&String> = whole.scalars.iter().map(|own| &own.name).collect();
    let zeros = names.iter().map(|name| SimpleEquation::Zero((*name).clone()));
    let pairs = (0..names.len()).flat_map(|i| (i + 1..names.len()).map(move |j| (i, j)));
    let related = pairs.filter(|(i, j)| whole.are_related(names[*i], names[*j]));
    let equal = related.map(|(i, j)| SimpleEquation::Equal(names[i].clone(), names[j].clone()));
    zeros.chain(equal).collect()
}
