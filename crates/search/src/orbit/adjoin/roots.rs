//! Roots in the field of a case.

use liouville::case::Case;
use liouville::formula::Formula;
use liouville::graph::Step;
use liouville::mechanics::System;
use liouville::number::UnaryFunction;
use liouville::number::rational::Rational;

use super::super::super::terms::{recorded, varying};
use super::parts::{Read, read};
use super::read::StepReader;
use super::ring::{AdjoinedRing, Atom, Of};
use super::write::RingNames;
use super::{Effort, SearchError, absence};

/// Number of roots and moduli in a field or map, as it is recorded.
pub fn root_steps(case: &Case) -> Result<usize, SearchError> {
    let (graph, field) = recorded(case, |jet| jet.phase.field().to_vec())?;
    let reached = graph.reached(field);
    let steps = graph.steps_at(&reached);
    let is_root = |step: &Step<'_>| match step {
        Step::Unary(function, _) => matches!(function, UnaryFunction::Sqrt | UnaryFunction::Abs),
        Step::Power(_, exponent) => exponent.to_integer().is_none(),
        _ => false,
    };
    Ok(steps.filter(|(_, step)| is_root(step)).count())
}

/// Whether the `roots` in a field are square roots of functions of which none depends on others.
pub fn has_independent_roots(
    case: &Case,
    effort: &Effort,
    roots: usize,
) -> Result<bool, SearchError> {
    let Some(Read { ring, .. }) = read(case, effort, (&[], true), Vec::new())? else {
        return Ok(false);
    };
    let is_root = |atom: &&Atom| matches!(atom, Atom::Root(..) | Atom::Constant(Of::Root(_)));
    // Of fewer some have been written by others, as √(x²) is x.
    Ok(ring.atoms.iter().filter(is_root).count() == roots
        && absence::has_independent_roots(&case.model, &ring, effort.options.seed))
}

/// Lists the square roots of functions of the parameters in a field or map, or in a Lagrangian's
/// equations of motion, with the number under a root of a number.
pub fn roots(case: &Case) -> Result<Vec<(Formula, Option<Rational>)>, SearchError> {
    let system = &case.model.system;
    let is_written = system.is_given_by_formulas() || matches!(system, System::Lagrangian(_));
    if !is_written {
        return Ok(Vec::new());
    }
    let parameters = case.model.free_components();
    let (graph, field) = recorded(case, |jet| jet.phase.field().to_vec())?;
    let reached = graph.reached(field);
    let mut ring = AdjoinedRing::new(parameters, case.model.dimension(), Vec::new());
    let mut reader = StepReader::new(&graph);
    let varies = varying(&graph, parameters);
    for (place, step) in graph.steps().enumerate() {
        let is_root = match step {
            Step::Unary(function, _) => function == UnaryFunction::Sqrt,
            Step::Power(_, exponent) => exponent.parts().1 == 2.into(),
            _ => false,
        };
        if is_root && reached[place] && !varies[place] {
            reader.read(place, &mut ring);
        }
    }
    let names = RingNames::of(case, &ring);
    let mut found = Vec::new();
    for (atom, name) in ring.atoms.iter().zip(&names.original) {
        if let Atom::Constant(Of::Root(base)) = atom
            && let Ok(formula) = case.formula(name)
        {
            found.push((formula, base.value()));
        }
    }
    Ok(found)
}
